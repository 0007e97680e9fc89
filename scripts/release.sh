#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
# What a release has beside the source: each language's models, and its table for each robot, as versioned archives
# with their hashes. The same commit gives the same bytes, so that anybody can make and compare them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out="${OUT:-out}/release"
version="$(sed -n 's/^version: //p' CITATION.cff)"
rm -rf "$out"
mkdir -p "$out"

# pack NAME FOLDER: the files of a folder as they are committed, named from the root of the source.
pack() {
    git archive --format=tar HEAD "$2" | gzip --no-name --best >"$out/teo-signing-$version-$1.tar.gz"
}

for language in src/teo_sign_languages/languages/*/; do
    code="$(basename "$language")"
    [ ! -d "$language/models" ] || pack "$code-models" "${language}models"
    for table in "$language"tables/*/; do
        [ ! -d "$table" ] || pack "$code-$(basename "$table")-table" "${table%/}"
    done
done
(cd "$out" && sha256sum -- *.tar.gz >SHA256SUMS && cat SHA256SUMS)
