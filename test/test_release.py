# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A release's files are those of the commit, each language's and robot's, and their hashes hold."""

from __future__ import annotations

import hashlib
import os
import subprocess
import tarfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).parents[1]
LANGUAGES = ROOT / "src" / "teo_sign_languages" / "languages"


def release(out: Path) -> dict[str, str]:
    """The files that it makes, by name, with the hashes that it lists."""
    environment = os.environ | {"OUT": str(out)}
    subprocess.run([ROOT / "scripts" / "release.sh"], check=True, capture_output=True, env=environment)
    listed = (out / "release" / "SHA256SUMS").read_text(encoding="utf-8").splitlines()
    return {name: digest for digest, name in (line.split() for line in listed)}


def test_the_same_commit_gives_the_same_files_in_which_each_table_and_model_is(tmp_path: Path) -> None:
    with ThreadPoolExecutor() as at_once:
        first, second = at_once.map(release, (tmp_path / "a", tmp_path / "b"))
    assert first == second
    released: set[str] = set()
    for name, digest in first.items():
        path = tmp_path / "a" / "release" / name
        assert hashlib.sha256(path.read_bytes()).hexdigest() == digest
        with tarfile.open(path) as archive:
            released |= {member.name for member in archive.getmembers() if member.isfile()}
    kinds = ("*/models/*", "*/tables/*/*")
    expected = {str(path.relative_to(ROOT)) for kind in kinds for path in LANGUAGES.glob(kind)}
    assert released == expected
