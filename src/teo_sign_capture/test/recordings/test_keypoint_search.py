# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import av
import numpy as np
import pytest
from pose_format import Pose

from teo_sign_capture.recordings.keypoint_search import find_points

GREETING = Path(__file__).parents[3] / "teo_console" / "test" / "data" / "greeting.mp4"


def beside(out: Path, who: Sequence[str]) -> Path:
    """A film of the greeting, in the left half of the picture, the right half, or both, image by image."""
    with av.open(str(GREETING)) as source, av.open(str(out), "w") as container:
        images = [frame.to_ndarray(format="rgb24") for frame in source.decode(video=0)][: len(who)]
        height, width = images[0].shape[:2]
        stream = container.add_stream("libx264", rate=15)
        stream.width, stream.height, stream.pix_fmt = 2 * width, height, "yuv420p"
        for image, there in zip(images, who, strict=True):
            empty = np.broadcast_to(image[2, 2], image.shape)
            halves = (image if "left" in there else empty, image if "right" in there else empty)
            frame = av.VideoFrame.from_ndarray(np.concatenate(halves, axis=1), format="rgb24")
            container.mux(stream.encode(frame))
        container.mux(stream.encode(None))
    return out


@pytest.mark.slow
def test_of_two_people_the_first_is_followed_and_the_other_mentioned(tmp_path: Path) -> None:
    who = ["right"] * 4 + ["left right"] * 12 + ["left"] * 4
    film = beside(tmp_path / "two.mp4", who)
    (said,) = find_points(film, tmp_path / "two.pose")
    assert "expected one person, got several" in said
    pose = Pose.read((tmp_path / "two.pose").read_bytes())
    across, seen = pose.body.data[:, 0, :25, 0].data, pose.body.confidence[:, 0, :25] > 0.0
    width = pose.header.dimensions.width
    assert (across[seen] > 0.5 * width).all(), "only the one on the right"
    assert seen[:16].any(axis=1).all() and not seen[17:].any()


def test_one_person_is_nothing_to_speak_of(tmp_path: Path) -> None:
    assert find_points(beside(tmp_path / "one.mp4", ["left"] * 4), tmp_path / "one.pose") == ()
