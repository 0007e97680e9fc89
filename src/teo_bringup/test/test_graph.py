# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Processes under supervision: what they say, how they end, what becomes of the others."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from teo_bringup.graph import NODES, Graph, GraphError, executable_of
from teo_bringup.start import parse

PATIENCE = 30.0  # [s] for a Python process to start on a loaded machine
# Says that it is there, and at the end which signals came.
LISTENER = """
import signal, sys, time
got = []
for number in (signal.SIGINT, signal.SIGTERM):
    signal.signal(number, lambda number, _: got.append(signal.Signals(number).name))
print("ready", flush=True)
while not got:
    time.sleep(0.01)
time.sleep(0.3)  # a window for a second signal, which must not come: nothing tells of what does not happen
print("got", *got, flush=True)
sys.exit(7)
"""


def python(code: str) -> tuple[str, ...]:
    return (sys.executable, "-c", code)


def wait_for(text: str, path: Path) -> None:
    deadline = time.monotonic() + PATIENCE
    while text not in path.read_text():
        assert time.monotonic() < deadline, f"no {text!r} in {path}: {path.read_text()!r}"
        time.sleep(0.02)


def test_every_node_that_signs_is_installed() -> None:
    for package, executable in NODES.values():
        assert executable_of(package, executable).is_file()


@pytest.mark.parametrize("view", [False, True])
def test_the_console_is_started_where_it_is_asked_for(view: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    started: list[str] = []
    monkeypatch.setattr(Graph, "start", lambda *given: started.append(given[1]))
    with Graph() as graph:
        graph.start_nodes(view=view)
    assert started == [*NODES, *(["console"] if view else [])]


def test_a_package_or_executable_that_is_not_there_is_named() -> None:
    with pytest.raises(GraphError, match="teo_nowhere"):
        executable_of("teo_nowhere", "node")
    with pytest.raises(GraphError, match="no_such_node"):
        executable_of("teo_bringup", "no_such_node")


def test_the_block_ends_with_one_sigint_for_each_process(tmp_path: Path) -> None:
    with Graph(log_folder=tmp_path) as graph:
        graph.start("one", *python(LISTENER))
        graph.start("other", *python(LISTENER))
        for name in ("one", "other"):
            wait_for("ready", tmp_path / f"{name}.log")
    for name in ("one", "other"):
        assert (tmp_path / f"{name}.log").read_text().split() == ["ready", "got", "SIGINT"]


def test_a_signal_that_was_passed_on_is_not_followed_by_another(tmp_path: Path) -> None:
    with Graph(log_folder=tmp_path) as graph:
        graph.start("one", *python(LISTENER))
        wait_for("ready", tmp_path / "one.log")
        graph.tell_to_end(signal.SIGTERM)
        assert graph.stop("one") == 7
    assert (tmp_path / "one.log").read_text().split() == ["ready", "got", "SIGTERM"]


def test_it_waits_for_the_first_that_ends_and_gives_its_status(tmp_path: Path) -> None:
    with Graph(log_folder=tmp_path) as graph:
        graph.start("patient", *python(LISTENER))
        graph.start("hasty", *python("import sys; sys.exit(3)"))
        assert graph.wait() == ("hasty", 3)


def test_checking_tells_what_an_ended_process_said(tmp_path: Path) -> None:
    with Graph(log_folder=tmp_path) as graph:
        graph.start("hasty", *python("import sys; sys.exit('no look-up table')"))
        graph.wait()
        with pytest.raises(GraphError, match=r"hasty .* status 1(.|\n)*no look-up table"):
            graph.check()


def test_without_a_log_folder_each_line_is_printed_with_its_process(
    capfd: pytest.CaptureFixture[str],
) -> None:
    with Graph() as graph:
        graph.start("one", *python("print('first\\nsecond')"))
        graph.wait()
    assert capfd.readouterr().out.splitlines() == ["[one] first", "[one] second"]
    with pytest.raises(GraphError, match="log folder"):
        graph.tail("one")


def start(*arguments: str) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [str(executable_of("teo_bringup", "start")), *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


@pytest.mark.usefixtures("domain_id")
def test_start_runs_every_node_until_it_is_told_to_end() -> None:
    process = start("--namespace", "lab")
    assert process.stdout is not None
    said: list[str] = []
    watchdog = threading.Timer(4 * PATIENCE, process.kill)
    watchdog.start()
    try:
        # The driver says nothing; both others do once they listen.
        while not all(
            any(f"[lab.{name}]: ready" in line for line in said) for name in ("translator", "executor")
        ):
            line = process.stdout.readline()
            assert line, said
            said.append(line)
        process.terminate()
        rest, _ = process.communicate(timeout=PATIENCE)
    finally:
        watchdog.cancel()
        process.kill()
    assert process.returncode == 0, rest
    assert "Traceback" not in "".join(said) + rest
    assert all(line.startswith("[") for line in said)


@pytest.mark.usefixtures("domain_id")
def test_start_ends_with_the_status_of_the_first_node_that_fails(tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.yaml"
    wrong.write_text('executor:\n  ros__parameters:\n    lut_directory: "/nowhere"\n')
    process = start("--params-file", str(wrong))
    try:
        said, _ = process.communicate(timeout=4 * PATIENCE)
    finally:
        process.kill()
    assert process.returncode == 1, said
    assert "executor ended with status 1" in said
    assert "/nowhere" in said


def test_start_hands_namespace_clock_and_what_follows_on_to_every_node() -> None:
    given, _ = parse(["--namespace", "/left/", "--use-sim-time", "--ros-args", "-p", "model:=lstm256"])
    assert given[:2] == ["--ros-args", "--params-file"]
    assert given[3:] == [
        "-r",
        "__ns:=/left",
        "-p",
        "use_sim_time:=true",
        "--ros-args",
        "-p",
        "model:=lstm256",
    ]
    assert parse([]).for_nodes[3:] == []


def test_start_wants_a_file_of_parameters_that_is_there() -> None:
    process = start("--params-file", "nowhere.yaml")
    said, _ = process.communicate(timeout=PATIENCE)
    assert process.returncode == 2
    assert "nowhere.yaml" in said


def test_start_wants_ros_args_before_what_the_nodes_get() -> None:
    process = start("-r", "__ns:=/teo")
    said, _ = process.communicate(timeout=PATIENCE)
    assert process.returncode == 2
    assert "--ros-args" in said
