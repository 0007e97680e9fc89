# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What benches keep between runs must not outlive the code that made it: the figures would be of old code."""

from __future__ import annotations

from pathlib import Path

import pytest

from kept import kept_folder


@pytest.fixture
def maker(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package of two modules that makes something."""
    package = tmp_path / "a_maker_of_takes"
    (package / "inner").mkdir(parents=True)
    for path in ("__init__.py", "inner/__init__.py", "inner/render.py"):
        (package / path).write_text("")
    monkeypatch.syspath_prepend(tmp_path)
    return package


def test_the_folder_stays_while_the_code_does_and_is_another_once_any_module_has_changed(maker: Path) -> None:
    assert kept_folder("bench", maker.name) == kept_folder("bench", maker.name)
    before = kept_folder("bench", maker.name), kept_folder("bench", "kept", f"{maker.name}.inner.render")
    (maker / "inner" / "render.py").write_text("RATE = 30.0\n")
    after = kept_folder("bench", maker.name), kept_folder("bench", "kept", f"{maker.name}.inner.render")
    assert len({*before, *after}) == 4


def test_a_maker_that_is_not_there_is_named() -> None:
    with pytest.raises(ModuleNotFoundError, match="no_such_maker"):
        kept_folder("bench", "no_such_maker")
