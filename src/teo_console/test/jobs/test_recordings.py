# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Recordings are taken for what they hold, whatever they claim, and do not stay."""

from __future__ import annotations

import asyncio
import io
from collections.abc import AsyncIterator, Awaitable, Callable
from pathlib import Path

import av
import numpy as np
import pytest

from teo_console.errors import ConsoleError
from teo_console.jobs import recordings as module
from teo_console.jobs.queue import JobQueue
from teo_console.jobs.recordings import Recording, Recordings

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


def with_recordings(folder: Path, act: Callable[[Recordings], Awaitable[None]]) -> None:
    async def go() -> None:
        jobs = JobQueue()
        recordings = Recordings(folder, jobs)
        try:
            await act(recordings)
        finally:
            recordings.close()
            await jobs.close()

    asyncio.run(go())


def refusal(folder: Path, content: bytes) -> ConsoleError:
    """Why a content is refused; nothing of it may stay."""
    caught: list[ConsoleError] = []

    async def act(recordings: Recordings) -> None:
        with pytest.raises(ConsoleError) as info:
            await recordings.receive(pieces(content), 0.0)
        assert not folder.exists() or not list(folder.iterdir())
        caught.append(info.value)

    with_recordings(folder, act)
    return caught[0]


@pytest.mark.parametrize(
    ("container", "codec", "suffix"),
    [("webm", "libvpx", ".webm"), ("mp4", "libx264", ".mp4"), ("mov", "libx264", ".mp4")],
)
def test_a_film_is_known_by_its_content(tmp_path: Path, container: str, codec: str, suffix: str) -> None:
    async def act(recordings: Recordings) -> None:
        # Telephones name what a film holds in any encoding.
        content = film(container, codec).replace(b"VideoHandler", "Gestor vídeo".encode("mac_roman"))
        taken = await recordings.receive(pieces(content), 0.0)
        assert taken.path.suffix == suffix
        assert (taken.figures["width"], taken.figures["height"], taken.figures["images"]) == (320, 240, 20)
        assert taken.figures["seconds"] == pytest.approx(1.9, abs=0.01)
        assert taken.path.stat().st_mode & 0o077 == 0 or taken.folder.stat().st_mode & 0o077 == 0

    with_recordings(tmp_path / "recordings", act)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("nothing", b""),
        ("a page", b"<html><script>alert(1)</script></html>" * 100),
        ("a playlist that fetches", b"#EXTM3U\n#EXTINF:10,\nhttp://127.0.0.1/secret\n"),
        ("a program", b"\x7fELF" + bytes(1000)),
        ("noise that begins as a film", b"\x1a\x45\xdf\xa3" + bytes(range(256)) * 50),
        ("noise that begins as another", b"\x00\x00\x00\x18ftypmp42" + bytes(range(256)) * 50),
        ("a film cut short", film()[:700]),
        ("pictures too small for fingers", film(size=(64, 48))),
        ("a film of one image", film(n=1)),
    ],
)
def test_what_is_no_film_is_refused_and_nothing_of_it_stays(
    tmp_path: Path, name: str, content: bytes
) -> None:
    assert refusal(tmp_path / "recordings", content).code == "bad_film", name


def test_what_is_too_large_is_refused_before_it_is_all_here(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "MOST_BYTES", 120_000)
    sent = []

    async def endless() -> AsyncIterator[bytes]:
        while True:
            sent.append(1)
            yield bytes(50_000)

    async def act(recordings: Recordings) -> None:
        with pytest.raises(ConsoleError) as caught:
            await recordings.receive(endless(), 0.0)
        assert caught.value.code == "too_large"

    with_recordings(tmp_path / "recordings", act)
    assert len(sent) == 3


def test_recordings_that_pages_have_half_sent_count(tmp_path: Path) -> None:
    async def act(recordings: Recordings) -> None:
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

    with_recordings(tmp_path / "recordings", act)


def test_a_recording_goes_when_it_is_discarded_grows_old_or_the_console_ends(tmp_path: Path) -> None:
    folder = tmp_path / "recordings"
    taken: list[Recording] = []

    async def act(recordings: Recordings) -> None:
        first, second, third = [await recordings.receive(pieces(BAG), now) for now in (0.0, 10.0, 3000.0)]
        recordings.discard(first.id)
        assert not first.folder.exists()
        with pytest.raises(ConsoleError, match="still here"):
            recordings.get(first.id)
        recordings.forget_old(3700.0)
        assert not second.folder.exists()
        assert recordings.get(third.id) is third
        taken.append(third)

    with_recordings(folder, act)
    assert not taken[0].folder.exists()


def test_what_an_earlier_run_left_behind_is_deleted(tmp_path: Path) -> None:
    left = tmp_path / "recordings" / "abc" / "film.webm"
    left.parent.mkdir(parents=True)
    left.touch()
    with_recordings(tmp_path / "recordings", lambda _: asyncio.sleep(0))
    assert not left.exists()
