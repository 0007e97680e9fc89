# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Files that appear under their name only when they are whole."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from teo_common.atomic_files import atomic_path
from teo_skeleton_retriever.errors import RetrieverError


@contextmanager
def output_file(path: Path, suffix: str) -> Iterator[Path]:
    """Give a temporary file that takes the place of another when the block ends well.

    Args:
        path: Where the whole file is to be; replaced if it exists.
        suffix: That its name must have.

    Raises:
        RetrieverError: There is no such folder, or the name ends otherwise.
    """
    if path.suffix != suffix:
        raise RetrieverError("bad_name", f"expected a name that ends in {suffix}, got {path.name}")
    if not path.parent.is_dir():
        raise RetrieverError("missing_folder", f"expected a folder for {path.name}, got {path.parent}")
    with atomic_path(path) as temporary:
        yield temporary
