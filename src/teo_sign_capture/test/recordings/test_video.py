# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import av
import cv2
import numpy as np
import pytest
from av.stream import Disposition
from refusals import refused

from teo_common.arrays import Array
from teo_sign_capture.recordings.keypoint_search import evenly
from teo_sign_capture.recordings.pose_file import pose_file, read_pose_file
from teo_sign_capture.recordings.video import FASTEST, count_images, film_webcam, is_video, video_images

WIDTH, HEIGHT = 96, 64


def film(path: Path, times: list[float], codec: str = "libx264") -> Path:
    """Images that are bright above and darker below, each at its time."""
    with av.open(str(path), "w") as container:
        stream = container.add_stream(codec, rate=30)
        stream.width, stream.height, stream.pix_fmt = WIDTH, HEIGHT, "yuv420p"
        stream.codec_context.time_base = Fraction(1, 1000)
        picture = np.full((HEIGHT, WIDTH, 3), 60, np.uint8)
        picture[: HEIGHT // 2] = 220
        for time in times:
            frame = av.VideoFrame.from_ndarray(picture, format="rgb24")
            frame.pts, frame.time_base = round(1000.0 * time), Fraction(1, 1000)
            container.mux(stream.encode(frame))
        container.mux(stream.encode(None))
    return path


@pytest.mark.parametrize(("suffix", "codec"), [(".mp4", "libx264"), (".mov", "libx264"), (".webm", "libvpx")])
def test_images_come_with_the_times_that_the_file_says(tmp_path: Path, suffix: str, codec: str) -> None:
    times = [0.0, 0.04, 0.08, 0.15, 0.19, 0.4]
    path = film(tmp_path / f"clip{suffix}", times, codec)
    assert is_video(path)
    assert [one.time for one in video_images(path)] == pytest.approx(times, abs=2e-3)


def test_a_fast_video_is_thinned(tmp_path: Path) -> None:
    path = film(tmp_path / "fast.mp4", [index / 60.0 for index in range(61)])
    times = [one.time for one in video_images(path)]
    assert len(times) == pytest.approx(FASTEST, abs=2)
    assert times[-1] > 0.95


def test_a_phone_held_upright_gives_upright_images(tmp_path: Path) -> None:
    path = film(tmp_path / "phone.mp4", [0.0, 0.04, 0.08])
    content = path.read_bytes()
    # The matrix of the track's header says how a player turns it: by 90 deg (ISO/IEC 14496-12, 8.3.2).
    at = content.index(b"tkhd") + 4 + 4 + 4 * 5 + 8 + 8
    words = [0, 1 << 16, 0, -1 << 16, 0, 0, HEIGHT << 16, 0, 1 << 30]
    turned = b"".join(word.to_bytes(4, "big", signed=True) for word in words)
    path.write_bytes(content[:at] + turned + content[at + 36 :])
    ours = next(iter(video_images(path))).image
    shown = cv2.VideoCapture(str(path)).read()[1]
    assert ours.shape == (WIDTH, HEIGHT, 3) == shown.shape
    assert np.abs(ours.astype(int) - shown[..., ::-1].astype(int)).max() < 30
    assert ours[:, -5:].mean() != pytest.approx(ours[:, :5].mean(), abs=50.0)


def test_a_film_whose_names_are_in_another_encoding_is_read(tmp_path: Path) -> None:
    path = film(tmp_path / "iphone.mov", [0.0, 0.04, 0.08])
    content = path.read_bytes()
    assert b"VideoHandler" in content  # as FFmpeg names it; an iPhone: "Gestor de contenido de vídeo Apple"
    path.write_bytes(content.replace(b"VideoHandler", "Gestor vídeo".encode("mac_roman")))
    assert count_images(path) > 0
    assert len(list(video_images(path))) == 3


def test_a_cover_is_not_taken_for_the_film(tmp_path: Path) -> None:
    made = film(tmp_path / "film.mp4", [index / 25.0 for index in range(10)])
    path = tmp_path / "covered.mkv"
    with av.open(str(made)) as source, av.open(str(path), "w") as out:
        cover = out.add_stream("mjpeg", rate=1)
        cover.width, cover.height, cover.pix_fmt = 16, 16, "yuvj420p"
        moving = out.add_stream_from_template(source.streams.video[0])
        cover.disposition = Disposition.attached_pic
        blank = av.VideoFrame.from_ndarray(np.zeros((16, 16, 3), np.uint8), format="rgb24")
        out.mux(cover.encode(blank))
        for packet in source.demux(video=0):
            if packet.pts is not None:
                packet.stream = moving
                out.mux(packet)
    images = list(video_images(path))
    assert len(images) == 10
    assert images[0].image.shape == (HEIGHT, WIDTH, 3)


def test_what_is_no_video_is_refused_with_a_reason(tmp_path: Path) -> None:
    path = tmp_path / "broken.mp4"
    path.write_bytes(b"no video at all" * 100)
    with refused("unreadable_video", r"broken\.mp4"):
        list(video_images(path))


def points(times: Array) -> Array:
    """Points that move at an even speed."""
    made = np.zeros((len(times), 67, 4))
    made[..., :2] = (100.0 * times)[:, None, None] + np.arange(67)[:, None]
    made[..., 3] = 0.9
    return made


def test_points_of_an_uneven_video_are_where_they_were_at_even_times() -> None:
    random = np.random.default_rng(2)
    times = np.cumsum(random.uniform(0.03, 0.05, 40))
    times -= times[0]
    rate, even = evenly(times, points(times))
    np.testing.assert_allclose(even[..., :2], points(np.arange(len(even)) / rate)[..., :2], atol=1e-6)


def test_nothing_is_made_up_where_images_are_missing() -> None:
    times = np.array([0.0, 0.04, 0.08, 0.12, 0.48, 0.52, 0.56])
    seen = points(times)
    seen[1, 5] = 0.0
    rate, even = evenly(times, seen)
    assert rate == pytest.approx(25.0)
    lost = even[..., 3] == 0.0
    assert lost[4:12].all()
    assert lost[1, 5]
    assert lost.sum() == 8 * 67 + 1


def test_a_pose_file_holds_what_was_found(tmp_path: Path) -> None:
    seen = points(np.arange(5) / 25.0)
    seen[:, 5, 0] += 200.0  # the left shoulder is on the right of the picture
    seen[:, 25:, 2] = 0.01 * np.arange(42)
    seen[2, 46:] = 0.0
    path = tmp_path / "clip.pose"
    path.write_bytes(pose_file(25.0, seen, (640, 480)))
    clip = read_pose_file(path)
    assert clip.rate == pytest.approx(25.0)
    np.testing.assert_allclose(clip.left_hand.places[..., 1], seen[:, 25:46, 0], atol=1e-3)
    np.testing.assert_allclose(clip.left_hand.places[..., 0], -seen[:, 25:46, 2], atol=1e-6)
    assert not clip.right_hand.seen[2].any()
    assert clip.right_hand.seen[3].all()


def test_a_camera_is_filmed_as_long_as_it_gives_images(tmp_path: Path) -> None:
    states: list[str] = []
    source = film(tmp_path / "camera.mp4", [index / 25.0 for index in range(20)])
    out = tmp_path / "films" / "A.mp4"
    film_webcam(str(source), out, seconds=5.0, on_state=states.append, countdown=0)
    assert len(list(av.open(str(out)).decode(video=0))) == 20
    assert states == ["sign now", "done"]
    with refused("no_camera"):
        film_webcam(str(tmp_path / "none.mp4"), out, seconds=1.0, on_state=states.append)
