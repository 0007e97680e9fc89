#!/usr/bin/env bash
# Style and types of the whole workspace.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
ruff check .
ruff format --check .
for package in src/*/; do
    name="$(basename "$package")"
    if [ -d "$package$name" ]; then mypy "$package$name"; fi
done
mypy scripts bench
