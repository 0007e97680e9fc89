# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
# make setup | wheelhouse | run | demo TEXT="..." | test | slow | commands | lint | bench | docs | release; run and demo take ROBOT=gr1t2, LANGUAGE=ase, VIEW=1; bench takes BENCH=NAME
SHELL := /bin/bash
.DEFAULT_GOAL := help
TEXT ?= Hola, me llamo Ana. ¿Qué tal?
# Where the demo leaves what it makes.
OUT ?= out
# One of `ros2 run teo_description robots list`.
ROBOT ?= teo
# ISO 639-3 code of the sign language.
LANGUAGE ?= ssp
# VIEW=1: the console's page too, and what it teaches signs with.
SETUP := $(if $(VIEW),setup-view,setup-run)
ENV := . ./env.sh &&

.PHONY: help setup setup-run setup-view wheelhouse robots run demo test slow commands lint bench docs release

help: ## what can be made
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:[^#]*## /\t/' | expand -t 12

setup: ## install what is missing and build the workspace
	@PYTHON="$(PYTHON)" scripts/setup.sh all

setup-run: # what signs, without what sees, trains and tests
	@PYTHON="$(PYTHON)" scripts/setup.sh run

setup-view: # that, the console, and what records signs
	@PYTHON="$(PYTHON)" scripts/setup.sh view

wheelhouse: ## fetch all that setup installs, for a machine without a network
	@PYTHON="$(PYTHON)" scripts/setup.sh wheelhouse

demo: $(SETUP) ## sign TEXT="...": leaves the bag, a video and a film strip in OUT=out; VIEW=1 keeps a page open
	@$(ENV) python scripts/demo.py "$$TEXT" --out "$$OUT" --robot "$$ROBOT" --language "$$LANGUAGE" $(if $(VIEW),--view)

run: $(SETUP) ## start translator, executor and driver, until Ctrl-C; VIEW=1 with the page
	@$(ENV) exec ros2 run teo_bringup up --robot "$$ROBOT" --language "$$LANGUAGE" $(if $(VIEW),translator executor driver console)

test: setup ## the tests, without the slow ones: first what keeps no time with others, then what meets them over DDS
	@$(ENV) python -m pytest -m "not dds and not commands and not slow" --numprocesses 2 --dist loadfile
	@$(ENV) python -m pytest -m "dds and not commands and not slow" --numprocesses 2 --dist loadfile

slow: setup ## the tests that take long
	@$(ENV) python -m pytest -m "slow and not dds and not commands" --numprocesses 2 --dist worksteal
	@$(ENV) python -m pytest -m "slow and dds and not commands" --numprocesses 2 --dist loadfile

commands: setup ## the commands of every page, as they stand there
	@$(ENV) python -m pytest test/test_readme_commands.py -m commands --numprocesses 2 --maxschedchunk 1

robots: setup-run ## what other humanoids are drawn with, and the third one's description (215 MB)
	@.venv/bin/python -m pip install --disable-pip-version-check --quiet --no-deps -r requirements/robots.txt

lint: setup ## style, types
	@$(ENV) scripts/lint.sh

docs: setup ## the pages of docs/ and of the API, in out/docs/
	@$(ENV) NO_MKDOCS_2_WARNING=1 mkdocs build --strict --quiet

release: ## models and tables as versioned files with their hashes, in OUT/release
	@scripts/release.sh

bench: setup ## the figures of docs/figures.md; BENCH="NAME --option 1": those of one bench
	@$(ENV) PYTHONPATH="$$PWD/scripts:$$PWD/test/support/nodes:$$PWD/test/support/made:$$PWD/test/support/pages:$$PYTHONPATH" python studio/bench/run.py $(BENCH)

export TEXT OUT ROBOT LANGUAGE
