# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
from collections.abc import Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from pathlib import Path

import pytest
from made_bags import signing, write_bag
from refusals import refused

from teo_sign_capture.entries.bag_capture import CAPTURED, UNCHANGED, CaptureJob, Outcome, Settings, failures
from teo_sign_capture.entries.batch import find_jobs, read_manifest, run_jobs, workers
from teo_sign_capture.entries.take import Cut
from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut

slow = functools.partial(signing, rate=15.0)  # half the frames take half the time


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Two takes of CASA, one of HOLA, one recording of nobody who moves."""
    where = tmp_path / "recordings"
    write_bag(where / "CASA_1.mcap", slow(seed=1))
    write_bag(where / "CASA_2.mcap", slow(seed=2))
    write_bag(where / "HOLA" / "monday.mcap", slow(seed=3))
    write_bag(where / "NADA.mcap", slow(moves=[]))
    return where


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return Settings(table=tmp_path / "lut", cache=tmp_path / "cache")


def codes(outcomes: list[Outcome]) -> dict[str, str]:
    return {outcome.gloss: outcome.code for outcome in outcomes}


def test_names_of_bags_and_folders_are_glosses_and_takes(tmp_path: Path) -> None:
    for name in (
        *("CASA_1.mcap", "CASA_2.mcap", "casa_3.mp4", "Buenos días.mp4", "readme.txt"),
        *("HOLA/monday.mcap", "BUENOS_DÍAS_2/metadata.yaml", "BUENOS_DÍAS_2/x_0.mcap"),
    ):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    assert {job.gloss: {bag.name for bag in job.bags} for job in find_jobs(tmp_path)} == {
        "BUENOS_DÍAS": {"Buenos días.mp4", "BUENOS_DÍAS_2"},
        "CASA": {"CASA_1.mcap", "CASA_2.mcap", "casa_3.mp4"},
        "HOLA": {"monday.mcap"},
    }


def test_a_folder_without_bags_is_refused(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "nowhere"):
        with refused("no_bag"):
            find_jobs(path)


def test_one_that_fails_stops_no_other_and_a_second_run_does_what_is_missing(
    folder: Path, settings: Settings
) -> None:
    told: list[Outcome] = []
    with ThreadPoolExecutor(1) as pool:
        first = run_jobs(pool, find_jobs(folder), settings, told.append)
        assert codes(first) == {"CASA": CAPTURED, "HOLA": CAPTURED, "NADA": "no_motion"}
        assert len(told) == 3
        assert [outcome.gloss for outcome in failures(first)] == ["NADA"]
        entry = settings.table / "CASA.json"
        written = entry.stat().st_mtime_ns
        write_bag(folder / "NADA.mcap", slow(seed=9))
        (settings.table / "HOLA.json").unlink()
        second = run_jobs(pool, find_jobs(folder), settings, told.append)
    assert codes(second) == {"CASA": UNCHANGED, "HOLA": CAPTURED, "NADA": CAPTURED}
    assert entry.stat().st_mtime_ns == written
    assert Lut.open(settings.table)["CASA"].quality["takes_count"] == 2.0


class _Dying(ThreadPoolExecutor):
    """An executor whose workers are killed."""

    def submit(self, *_: object, **__: object):  # type: ignore[no-untyped-def]
        return super().submit(self._die)

    def _die(self) -> None:
        raise MemoryError("killed")


def test_a_worker_that_dies_is_an_outcome(settings: Settings) -> None:
    with _Dying(1) as pool:
        outcomes = run_jobs(pool, [CaptureJob(gloss="A", bags=())], settings, lambda _: None)
    assert codes(outcomes) == {"A": "crashed"}
    assert "MemoryError" in outcomes[0].message


def test_a_manifest_names_bags_parts_and_hands(tmp_path: Path) -> None:
    path = tmp_path / "signs.csv"
    path.write_text("bag,gloss,start,end,hands,person\na.mcap,HOLA,1.5,2.5,right,3\nb/c,DÍA,,,,\nd,DÍA,,,,\n")
    day, hello = read_manifest(path)
    assert hello == CaptureJob(
        gloss="HOLA",
        bags=(tmp_path / "a.mcap",),
        cut=Cut(start=1.5, end=2.5),
        handedness="right",
        person=3,
    )
    assert day.bags == (tmp_path / "b/c", tmp_path / "d")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "columns"),
        ("bag,gloss\n", "a row for each take"),
        ("bag,gloss,speed\na,B,1\n", "columns"),
        ("bag,gloss\na.mcap,\n", "line 2"),
        ("bag,gloss,start\na,B,soon\n", "line 2"),
        ("bag,gloss,hands\na,B,three\n", "line 2"),
        ("bag,gloss,start\na,B,1\nb,B,2\n", "line 3"),
        ("bag,gloss\na,B,c,d\n", "line 2"),
    ],
)
def test_a_bad_manifest_is_refused_with_its_line(tmp_path: Path, text: str, said: str) -> None:
    path = tmp_path / "signs.csv"
    path.write_text(text)
    with refused("bad_manifest", said):
        read_manifest(path)


@pytest.fixture
def cluster() -> Iterator[str]:
    """A Dask scheduler with one worker process, as on another machine."""
    from distributed import LocalCluster

    with LocalCluster(
        n_workers=1, threads_per_worker=1, processes=True, dashboard_address=None, host="127.0.0.1"
    ) as running:
        yield running.scheduler_address


@pytest.mark.slow
def test_a_dask_cluster_does_the_same_work(cluster: str, folder: Path, settings: Settings) -> None:
    jobs = [job for job in find_jobs(folder) if job.gloss in ("HOLA", "NADA")]
    with workers(1, cluster) as executor:
        assert isinstance(executor, Executor)
        outcomes = run_jobs(executor, jobs, settings, lambda _: None)
    assert codes(outcomes) == {"HOLA": CAPTURED, "NADA": "no_motion"}
    assert "HOLA" in Lut.open(settings.table)


def test_a_scheduler_that_does_not_answer_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("teo_sign_capture.entries.batch._CONNECT_TIMEOUT", 0.3)
    with pytest.raises(LutError, match="Dask") as error, workers(1, "tcp://127.0.0.1:9"):
        pass
    assert error.value.code == "no_cluster"
