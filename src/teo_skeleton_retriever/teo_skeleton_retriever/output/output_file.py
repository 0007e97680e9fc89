"""Files that appear under their name only when they are whole."""

from __future__ import annotations

import os
from pathlib import Path

from teo_skeleton_retriever.errors import OutputError


def temporary_for(path: Path, suffix: str) -> Path:
    """Name the file to write in the place of another until that is whole.

    Args:
        path: where the whole file is to be.
        suffix: that its name must have.

    Returns:
        A name in the same folder, so that replacing the one by the other is a single step.

    Raises:
        OutputError: there is no such folder, or the name ends otherwise.
    """
    if path.suffix != suffix:
        raise OutputError("bad_name", f"expected a name that ends in {suffix}, got {path.name}")
    if not path.parent.is_dir():
        raise OutputError("missing_folder", f"expected a folder for {path.name}, got {path.parent}")
    return path.with_name(f".{path.name}.{os.getpid()}")
