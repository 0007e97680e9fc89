# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import av
import numpy as np
import pytest

from teo_description import DescriptionError
from teo_description.pictures.rendering import MotionVideo, captioned, film_strip, write_video


def frames(count, height=48, width=64):
    for index in range(count):
        yield np.full((height, width, 3), 20 * index % 256, np.uint8)


def test_film_plays_with_every_frame_in_order_for_as_long_as_they_last(tmp_path):
    path = tmp_path / "motion.mp4"
    with MotionVideo(path, frames_per_second=12.5) as video:
        for frame in frames(10):
            video.add(frame)
        assert not path.exists(), "it appears when it is whole"
    assert [file.name for file in tmp_path.iterdir()] == ["motion.mp4"]
    with av.open(str(path)) as container:
        stream = container.streams.video[0]
        assert (stream.codec_context.name, stream.pix_fmt) == ("h264", "yuv420p")
        assert (stream.width, stream.height, float(stream.average_rate)) == (64, 48, 12.5)
        assert container.duration / av.time_base == pytest.approx(10 / 12.5, abs=0.05)
        decoded = [frame.to_ndarray(format="rgb24").mean() for frame in container.decode(stream)]
    assert decoded == pytest.approx([20 * index for index in range(10)], abs=4)


def test_a_failure_leaves_no_file_and_keeps_an_older_one(tmp_path):
    path = tmp_path / "motion.mp4"
    path.write_bytes(b"older film")
    with pytest.raises(RuntimeError, match="the robot fell"), MotionVideo(path) as video:
        video.add(next(frames(1)))
        raise RuntimeError("the robot fell")
    assert path.read_bytes() == b"older film"
    assert len(list(tmp_path.iterdir())) == 1


@pytest.mark.parametrize(
    ("shapes", "code"),
    [
        ([], "empty_motion"),
        *(([shape], "wrong_shape") for shape in ((47, 64, 3), (48, 63, 3), (48, 64), (48, 64, 4))),
        ([(48, 64, 3), (96, 64, 3)], "wrong_shape"),
    ],
)
def test_frames_that_video_cannot_hold_are_refused_and_leave_no_file(tmp_path, shapes, code):
    with pytest.raises(DescriptionError) as caught:
        write_video(tmp_path / "motion.mp4", [np.zeros(shape, np.uint8) for shape in shapes])
    assert caught.value.code == code
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("path", "rate", "code"),
    [
        *(("m.mp4", rate, "bad_rate") for rate in (0.0, -25.0, math.nan, 1e9)),
        ("no/m.mp4", 25.0, "missing_folder"),
    ],
)
def test_impossible_rates_and_folders_are_refused(tmp_path, path, rate, code):
    with pytest.raises(DescriptionError) as caught:
        MotionVideo(tmp_path / path, frames_per_second=rate)
    assert caught.value.code == code


def test_captions_that_run_out_leave_the_rest_without(tmp_path):
    path = tmp_path / "motion.mp4"
    write_video(path, frames(3, 240, 320), ["MI NOMBRE"], frames_per_second=10)
    with av.open(str(path)) as container:
        feet = [frame.to_ndarray(format="rgb24")[-10:].mean() for frame in container.decode(video=0)]
    assert feet[0] > 150
    assert max(feet[1:]) < 60


class TestCaption:
    picture = np.full((240, 320, 3), 90, np.uint8)

    def test_text_stands_on_a_light_band_at_the_foot(self):
        result = captioned(self.picture, "¿Qué tal? MAÑANA")
        assert np.array_equal(result[:200], self.picture[:200])
        band = result[-19:]
        assert np.median(band) > 180
        assert band.min() < 80
        assert (self.picture == 90).all()

    def test_accents_make_a_difference(self):
        assert not np.array_equal(captioned(self.picture, "MAÑANA"), captioned(self.picture, "MANANA"))
        assert not np.array_equal(captioned(self.picture, "TÚ"), captioned(self.picture, "TU"))

    def test_no_text_changes_nothing(self):
        for text in ("", "  \n "):
            assert np.array_equal(captioned(self.picture, text), self.picture)

    @pytest.mark.parametrize("text", ["palabra " * 20_000, "a\nb\tc", "\x00\x07", "🙂 日本", "\ud800"])
    def test_odd_text_is_drawn_and_never_fails(self, text):
        result = captioned(self.picture, text)
        assert result.shape == self.picture.shape
        assert np.array_equal(result[:150], self.picture[:150])

    def test_long_text_keeps_inside_the_picture(self):
        result = captioned(self.picture, "ESTERNOCLEIDOMASTOIDEO " * 30)
        assert result[-19:, :4].min() > 180
        assert result[-19:, -4:].min() > 180


class TestFilmStrip:
    def test_frames_stand_in_rows(self):
        strip = film_strip(list(frames(5)), columns=2)
        assert strip.shape == (3 * 48 + 4 * 4, 2 * 64 + 3 * 4, 3)
        assert (strip[4:52, 4:68] == 0).all()
        assert (strip[4:52, 72:136] == 20).all()
        assert (strip[108:156, 4:68] == 80).all()
        assert (strip[108:156, 72:136] == 255).all()
        assert film_strip(list(frames(2)), columns=6).shape == (56, 2 * 64 + 12, 3), "a short row"

    def test_captions_go_on_their_frames(self):
        strip = film_strip(list(frames(2, 240, 320)), ["", "A"], columns=1)
        assert (strip[4:244, 4:324] == 0).all()
        assert strip[244 + 4 : 244 + 4 + 240].max() > 200

    def test_what_makes_no_strip_is_refused(self):
        pictures = list(frames(2))
        for arguments, code in (
            (([],), "empty_motion"),
            ((pictures, (), 0), "bad_columns"),
            ((pictures, ("a", "b", "c")), "wrong_shape"),
            (([*pictures, *frames(1, 50)],), "wrong_shape"),
        ):
            with pytest.raises(DescriptionError) as caught:
                film_strip(*arguments)
            assert caught.value.code == code
