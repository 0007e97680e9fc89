# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A release's files are those of the commit, each language's and robot's, and their hashes hold."""

from __future__ import annotations

import hashlib
import os
import subprocess
import tarfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
LANGUAGES = ROOT / "src" / "teo_sign_languages" / "languages"


def release(out: Path) -> dict[str, str]:
    """The files that it makes, by name, with the hashes that it lists."""
    environment = os.environ | {"OUT": str(out)}
    subprocess.run([ROOT / "scripts" / "release.sh"], check=True, capture_output=True, env=environment)
    listed = (out / "release" / "SHA256SUMS").read_text(encoding="utf-8").splitlines()
    return {name: digest for digest, name in (line.split() for line in listed)}


def test_the_same_commit_gives_the_same_files_with_their_hashes(tmp_path: Path) -> None:
    first, second = release(tmp_path / "a"), release(tmp_path / "b")
    assert first == second
    for name, digest in first.items():
        assert hashlib.sha256((tmp_path / "a" / "release" / name).read_bytes()).hexdigest() == digest


def test_each_table_and_model_is_in_one_of_them(tmp_path: Path) -> None:
    released: set[str] = set()
    for name in release(tmp_path):
        with tarfile.open(tmp_path / "release" / name) as archive:
            released |= {member.name for member in archive.getmembers() if member.isfile()}
    kinds = ("*/models/*", "*/tables/*/*")
    expected = {str(path.relative_to(ROOT)) for kind in kinds for path in LANGUAGES.glob(kind)}
    assert released == expected
