# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The film that the demo makes while the robot moves."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]

# Far more frames than a pipe holds, for a process that is killed before it has drawn them.
PROGRAM = """
import multiprocessing, sys
from pathlib import Path
from film import LiveFilm

if __name__ == "__main__":
    with LiveFilm(Path(sys.argv[1]), "teo") as film:
        multiprocessing.active_children()[0].kill()
        for number in range(5000):
            film.add({"FrontalRightElbow": 0.001 * number}, "HOLA")
    print("whole" if film.whole else "not whole")
"""


def test_a_film_whose_drawing_ends_early_is_not_whole_and_keeps_nobody_waiting(tmp_path: Path) -> None:
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    environment = {**os.environ, "PYTHONPATH": f"{ROOT / 'scripts'}:{os.environ.get('PYTHONPATH', '')}"}
    command = [sys.executable, str(program), str(tmp_path / "film.mp4")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True, env=environment)
    assert done.stdout == "not whole\n", done.stderr
    assert not (tmp_path / "film.mp4").exists()
