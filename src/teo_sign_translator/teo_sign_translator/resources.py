"""Where the package's data files and models are."""

from __future__ import annotations

from pathlib import Path

PACKAGE = "teo_sign_translator"


def _share() -> Path:
    """Folder that holds `data` and `models`: the source tree's, or the installed share folder."""
    source = Path(__file__).resolve().parents[1]
    if (source / "data" / "paper_pairs.tsv").is_file():
        return source
    from ament_index_python.packages import get_package_share_directory

    return Path(get_package_share_directory(PACKAGE))


def data_file(name: str) -> Path:
    """Path of a file of the package's `data` folder."""
    return _share() / "data" / name


def models_directory() -> Path:
    """Folder of the models that ship with the package."""
    return _share() / "models"
