# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who holds the rights in each source file, and under which licence: adds the two lines, or checks them.

`python scripts/spdx.py` adds them where they are missing; `--check` names the files that lack them.
"""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Annotated

import typer

ROOT = Path(__file__).parents[1]
# Files that can carry a comment, by the ends of their names; hand-written data among them.
SUFFIXES = {".cmake", ".py", ".pyi", ".service", ".sh", ".yaml", ".yml", ".toml", ".msg", ".srv", ".action"}
NAMES = {"CMakeLists.txt", "Dockerfile", "Makefile", "run"}
HEADER = "# SPDX-FileCopyrightText: 2026 TEO signing project\n# SPDX-License-Identifier: Apache-2.0\n"
# Made by scripts or taken over from others, with a licence beside it.
_LEFT_OUT = ("bags/", "test/data/")


def sources() -> list[Path]:
    """Every file of the repository that is to carry the lines."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\0")
    return [
        ROOT / name
        for name in sorted(set(listed))
        if name
        and not name.startswith(_LEFT_OUT)
        and (Path(name).suffix in SUFFIXES or Path(name).name in NAMES)
        and (ROOT / name).is_file()
        and (ROOT / name).stat().st_size > 0
    ]


def has_header(text: str) -> bool:
    """Whether the two lines are a file's first, below its shebang if it has one."""
    return (text.partition("\n")[2] if text.startswith("#!") else text).startswith(HEADER)


def with_header(text: str) -> str:
    """Put the two lines into a file's text, below its shebang if it has one."""
    if text.startswith("#!"):
        shebang, _, rest = text.partition("\n")
        return f"{shebang}\n{HEADER}{rest}"
    return f"{HEADER}{text}"


def main(
    check: Annotated[
        bool, typer.Option("--check", help="Change nothing; exit with 1 if a file lacks them.")
    ] = False,
) -> None:
    """Add SPDX lines to every source file."""
    lacking = [path for path in sources() if not has_header(path.read_text(encoding="utf-8"))]
    for path in lacking:
        if check:
            print(f"{path.relative_to(ROOT)}: expected the SPDX lines; run python scripts/spdx.py")
        else:
            path.write_text(with_header(path.read_text(encoding="utf-8")), encoding="utf-8")
    raise typer.Exit(1 if check and lacking else 0)


if __name__ == "__main__":
    typer.run(main)
