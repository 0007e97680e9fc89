# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Takes as films: what a phone or a webcam would have recorded, without depth and without truth."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.output.overlay import overlay_video
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.take.truth import SyntheticFrame

FILM_SUFFIX = ".mp4"


def write_film(frames: Iterable[SyntheticFrame], out: Path) -> Iterator[int]:
    """Write the colour images of frames as a film.

    Args:
        frames: In order of time.
        out: MP4 file to write, replaced if it exists; it appears whole or not at all.

    Yields:
        The number of frames written so far.

    Raises:
        SyntheticError: "not_written" if there is no such folder.
    """
    try:
        with overlay_video(out) as film:
            for number, frame in enumerate(frames, start=1):
                film.add(frame.color, frame.stamp)
                yield number
    except (RetrieverError, OSError) as error:
        raise SyntheticError(
            "not_written", f"{out}: expected a place to write a film to, got: {error}"
        ) from None
