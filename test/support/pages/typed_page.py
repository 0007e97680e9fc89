# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Typing the command blocks of a page into shells, as a reader would."""

from __future__ import annotations

import subprocess
import threading
from pathlib import Path
from typing import NamedTuple

_ANSWER = "typed_page:"
# For where there is no sudo and all is done by root: without `-u USER`, the rest is run as it is.
_SUDO = '#!/bin/sh\nif [ "$1" = -u ]; then shift 2; fi\nexec "$@"\n'


class Block(NamedTuple):
    """A block of commands."""

    where: str
    """The machine that its first line names."""
    text: str
    """All of it."""


def blocks_of(page: Path) -> list[Block]:
    """The blocks of a page that are shell commands and begin with `# MACHINE`, in their order."""
    parts = page.read_text(encoding="utf-8").split("```")[1::2]
    shells = [part.removeprefix("sh\n") for part in parts if part.startswith("sh\n")]
    return [Block(text.splitlines()[0].removeprefix("# ").split(",")[0], text) for text in shells]


class Shell:
    """A bash that is typed into."""

    def __init__(self, *command: str, environment: dict[str, str], home: Path) -> None:
        """Begin.

        Args:
            command: What starts `bash` there.
            environment: Its variables.
            home: The user's folder there; `sudo` is put into `bin` there, for machines without.
        """
        (home / "bin").mkdir(parents=True, exist_ok=True)
        (home / "bin" / "sudo").write_text(_SUDO)
        (home / "bin" / "sudo").chmod(0o755)
        path = f"{home / 'bin'}:{environment['PATH']}"
        self.said: list[str] = []
        self._answers: list[int] = []
        self._changed = threading.Condition()
        self._process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            process_group=0,
            env=environment | {"HOME": str(home), "PATH": path, "USER": "root"},
        )
        threading.Thread(target=self._listen, daemon=True).start()

    def type(self, text: str, *, timeout: float = 180.0) -> None:
        """Type a block and wait until it is done; `text` that ends with `&` is done at once.

        Args:
            text: What is typed.
            timeout: Longest wait [s].

        Raises:
            AssertionError: Its last command failed, or it takes too long.
        """
        count = len(self._answers)
        assert self._process.stdin is not None
        # On a line of its own: a `bash` that the block has started reads on from here.
        print(text.rstrip(), f'\necho "{_ANSWER} $?"', file=self._process.stdin, flush=True)
        with self._changed:
            assert self._changed.wait_for(lambda: len(self._answers) > count, timeout), (
                text,
                self.said[-20:],
            )
        assert self._answers[-1] == 0, (text, self.said[-20:])

    def wait_for(self, text: str, *, timeout: float) -> None:
        """Wait until a line with a text has been said.

        Raises:
            AssertionError: It has not been, for `timeout` [s].
        """
        with self._changed:
            found = self._changed.wait_for(lambda: any(text in line for line in self.said), timeout)
            assert found, (text, self.said[-20:])

    def _listen(self) -> None:
        assert self._process.stdout is not None
        for line in self._process.stdout:
            with self._changed:
                if line.startswith(_ANSWER):
                    self._answers.append(int(line.split()[1]))
                else:
                    self.said.append(line.rstrip())
                self._changed.notify_all()
