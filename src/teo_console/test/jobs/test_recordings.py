# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Recordings are taken for what they hold, whatever they claim, and do not stay."""

from __future__ import annotations

import asyncio
import io
from collections.abc import AsyncIterator, Callable, Iterator
from pathlib import Path

import av
import numpy as np
import pytest

from teo_console.errors import ConsoleError
from teo_console.jobs import recordings as module
from teo_console.jobs.queue import JobQueue
from teo_console.jobs.recordings import Recordings

# A bag by its first bytes; what is in it is for the command that reads it.
BAG = b"\x89MCAP0\r\n" + bytes(1000)


def film(
    container: str = "webm", codec: str = "libvpx", size: tuple[int, int] = (320, 240), n: int = 20
) -> bytes:
    """A film of noise at 10 images a second."""
    out = io.BytesIO()
    with av.open(out, "w", format=container) as writer:
        stream = writer.add_stream(codec, rate=10)
        stream.width, stream.height = size
        stream.pix_fmt = "yuv420p"
        image = np.random.default_rng(1).integers(0, 255, (size[1], size[0], 3), dtype=np.uint8)
        for _ in range(n):
            writer.mux(stream.encode(av.VideoFrame.from_ndarray(image, format="rgb24")))
        writer.mux(stream.encode())
    return out.getvalue()


async def pieces(content: bytes) -> AsyncIterator[bytes]:
    for start in range(0, len(content), 50_000):
        yield content[start : start + 50_000]


@pytest.fixture
def recordings(runner: asyncio.Runner, tmp_path: Path) -> Iterator[Recordings]:
    jobs = JobQueue()
    opened = Recordings(tmp_path / "recordings", jobs)
    yield opened
    opened.close()
    runner.run(jobs.close())


@pytest.mark.parametrize(
    ("container", "codec", "suffix"),
    [("webm", "libvpx", ".webm"), ("mp4", "libx264", ".mp4"), ("mov", "libx264", ".mp4")],
)
async def test_a_film_is_known_by_its_content(
    recordings: Recordings, container: str, codec: str, suffix: str
) -> None:
    # Telephones name what a film holds in any encoding.
    content = film(container, codec).replace(b"VideoHandler", "Gestor vídeo".encode("mac_roman"))
    taken = await recordings.receive(pieces(content), 0.0)
    assert taken.path.suffix == suffix
    assert (taken.figures["width"], taken.figures["height"], taken.figures["images"]) == (320, 240, 20)
    assert taken.figures["seconds"] == pytest.approx(1.9, abs=0.01)
    assert taken.path.stat().st_mode & 0o077 == 0 or taken.folder.stat().st_mode & 0o077 == 0


@pytest.mark.parametrize(
    "content",
    [
        pytest.param(bytes, id="nothing"),
        pytest.param(lambda: b"<html><script>alert(1)</script></html>" * 100, id="a page"),
        pytest.param(
            lambda: b"#EXTM3U\n#EXTINF:10,\nhttp://127.0.0.1/secret\n", id="a playlist that fetches"
        ),
        pytest.param(lambda: b"\x7fELF" + bytes(1000), id="a program"),
        pytest.param(lambda: b"\x1a\x45\xdf\xa3" + bytes(range(256)) * 50, id="begins as a film"),
        pytest.param(lambda: b"\x00\x00\x00\x18ftypmp42" + bytes(range(256)) * 50, id="begins as another"),
        pytest.param(lambda: film()[:700], id="a film cut short"),
        pytest.param(lambda: film(size=(64, 48)), id="pictures too small for fingers"),
        pytest.param(lambda: film(n=1), id="a film of one image"),
    ],
)
async def test_what_is_no_film_is_refused_and_nothing_of_it_stays(
    recordings: Recordings, tmp_path: Path, content: Callable[[], bytes]
) -> None:
    with pytest.raises(ConsoleError) as refused:
        await recordings.receive(pieces(content()), 0.0)
    assert refused.value.code == "bad_film"
    assert not list(tmp_path.glob("recordings/*"))


async def test_what_is_too_large_is_refused_before_it_is_all_here(
    recordings: Recordings, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "MOST_BYTES", 120_000)
    sent = []

    async def endless() -> AsyncIterator[bytes]:
        while True:
            sent.append(1)
            yield bytes(50_000)

    with pytest.raises(ConsoleError) as caught:
        await recordings.receive(endless(), 0.0)
    assert caught.value.code == "too_large"
    assert len(sent) == 3


async def test_recordings_that_pages_have_half_sent_count(recordings: Recordings) -> None:
    sent = asyncio.Event()

    async def slowly() -> AsyncIterator[bytes]:
        yield BAG[:10]
        await sent.wait()
        yield BAG[10:]

    coming = [asyncio.create_task(recordings.receive(slowly(), 0.0)) for _ in range(40)]
    await asyncio.sleep(0.0)
    sent.set()
    ended = await asyncio.gather(*coming, return_exceptions=True)
    assert [error.code for error in ended if isinstance(error, ConsoleError)] == ["busy"] * 8


async def test_a_recording_goes_when_it_is_discarded_grows_old_or_the_console_ends(
    recordings: Recordings,
) -> None:
    first, second, third = [await recordings.receive(pieces(BAG), now) for now in (0.0, 10.0, 3000.0)]
    recordings.discard(first.id)
    assert not first.folder.exists()
    with pytest.raises(ConsoleError, match="still here"):
        recordings.get(first.id)
    recordings.forget_old(3700.0)
    assert not second.folder.exists()
    assert recordings.get(third.id) is third
    recordings.close()
    assert not third.folder.exists()
