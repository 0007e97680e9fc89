# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
# make setup | run | demo TEXT="..." | test | lint | bench | docs; run and demo take VIEW=1
SHELL := /bin/bash
.DEFAULT_GOAL := help
TEXT ?= Hola, me llamo Ana. ¿Qué tal?
# VIEW=1: the console's page too, and what it teaches signs with.
SETUP := $(if $(VIEW),setup-view,setup-run)
ENV := . ./env.sh &&

.PHONY: help setup setup-run setup-view run demo test lint bench docs

help: ## what can be made
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:[^#]*## /\t/' | expand -t 10

setup: ## install what is missing and build the workspace
	@PYTHON="$(PYTHON)" scripts/setup.sh all

setup-run: # what signs, without what sees, trains and tests
	@PYTHON="$(PYTHON)" scripts/setup.sh run

setup-view: # that, the console, and what records signs
	@PYTHON="$(PYTHON)" scripts/setup.sh view

demo: $(SETUP) ## sign TEXT="...": leaves the bag, a video and a film strip in out/; VIEW=1 keeps a page open
	@$(ENV) python scripts/demo.py "$$TEXT" $(if $(VIEW),--view)

run: $(SETUP) ## start translator, executor and driver, until Ctrl-C; VIEW=1 with the page
	@$(ENV) exec ros2 run teo_bringup start $(if $(VIEW),--view)

test: setup ## all tests: on two cores what keeps no time with others, then the rest alone
	@$(ENV) python -m pytest -m "not dds" --numprocesses 2 --dist loadfile
	@$(ENV) python -m pytest -m dds

lint: setup ## style, types
	@$(ENV) scripts/lint.sh

docs: setup ## the pages of docs/ and of the API, in out/docs/
	@$(ENV) NO_MKDOCS_2_WARNING=1 mkdocs build --strict --quiet

bench: setup ## the figures of the README
	@$(ENV) PYTHONPATH="$$PWD/scripts:$$PWD/test/support:$$PYTHONPATH" python bench/run.py

export TEXT
