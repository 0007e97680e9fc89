#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
# Style, types, package graph and licence lines of the whole workspace; `lint.sh types` checks types alone.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

check_types() {
    local package name
    for package in src/*/ studio/*/ tools/*/; do
        name="$(basename "$package")"
        if [ -d "$package$name" ]; then mypy "$package$name"; fi
    done
    mypy scripts studio/bench
}

if [ "${1:-}" = types ]; then
    check_types
    exit
fi
ruff check .
ruff format --check .
check_types
lint-imports --no-logo
python scripts/spdx.py --check
