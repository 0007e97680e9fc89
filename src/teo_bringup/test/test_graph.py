# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Processes under supervision: what they say, how they end, what becomes of the others."""

from __future__ import annotations

import os
import re
import select
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from teo_bringup.graph import Graph, GraphError, executable_of
from teo_bringup.supervised_process import MOST_RESTARTS
from teo_bringup.up import main
from teo_common.node_process import tell_supervisor

PATIENCE = 120.0  # [s] for a Python process to start on a loaded machine
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

# By the protocol alone (sd_notify(3)): a process that loads ROS for it takes a second.
READY = (
    "import os, socket; socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)"
    ".sendto(b'READY=1', os.environ['NOTIFY_SOCKET'].replace('@', '\\0', 1))"
)


def python(code: str) -> tuple[str, ...]:
    return (sys.executable, "-c", code)


def wait_for(text: str, path: Path) -> None:
    deadline = time.monotonic() + PATIENCE
    while text not in path.read_text():
        assert time.monotonic() < deadline, f"no {text!r} in {path}: {path.read_text()!r}"
        time.sleep(0.02)


def test_a_package_or_executable_that_is_not_there_is_named() -> None:
    with pytest.raises(GraphError, match="teo_nowhere"):
        executable_of("teo_nowhere", "node")
    with pytest.raises(GraphError, match="no_such_node"):
        executable_of("teo_bringup", "no_such_node")


@pytest.mark.parametrize("number", [None, signal.SIGTERM], ids=["at the block's end", "passed on"])
def test_every_process_gets_one_signal_to_end_and_no_other(
    number: signal.Signals | None, tmp_path: Path
) -> None:
    names = ("one", "other")
    with Graph(tmp_path) as graph:
        for name in names:
            graph.start(name, *python(LISTENER))
        for name in names:
            wait_for("ready", tmp_path / f"{name}.log")
        if number is not None:
            graph.tell_to_end(number)
            assert graph.stop("one") == 7
    for name in names:
        said = (tmp_path / f"{name}.log").read_text().split()
        assert said == ["ready", "got", (number or signal.SIGINT).name]


def test_the_first_that_ends_is_named_with_its_status_and_what_it_said(
    capfd: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "hasty.log").write_text("of an earlier run\n")
    with Graph(tmp_path, printed=True) as graph:
        graph.start("patient", *python(LISTENER))
        graph.start("hasty", *python("import sys; print('first', flush=True); sys.exit('no look-up table')"))
        assert graph.wait() == ("hasty", 1)
        with pytest.raises(GraphError, match=r"hasty .* status 1(.|\n)*no look-up table"):
            graph.check()
        assert graph.tail("hasty", 1) == "no look-up table"
    assert (tmp_path / "hasty.log").read_text() == "first\nno look-up table\n"
    printed = [line for line in capfd.readouterr().out.splitlines() if "hasty" in line]
    assert printed == ["[hasty] first", "[hasty] no look-up table"]


def test_a_process_is_ready_when_it_says_so_and_not_before(tmp_path: Path) -> None:
    with Graph(tmp_path) as graph:
        graph.start("one", *python(f"import time; time.sleep(0.2); {READY}; time.sleep(60)"))
        graph.start("dumb", *python("import time; time.sleep(60)"))
        assert not graph.is_ready("one")
        deadline = time.monotonic() + PATIENCE
        while not graph.is_ready("one"):
            assert time.monotonic() < deadline
            time.sleep(0.02)
        assert not graph.is_ready()


def test_what_was_ready_and_fails_is_started_again_until_it_fails_too_often(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("teo_bringup.supervised_process.RESTART_DELAY", 0.01)
    with Graph(tmp_path, printed=True) as graph:
        graph.start("feeble", *python(f"{READY}; print('alive', flush=True); raise SystemExit(3)"))
        assert graph.keep_up(restarts=True, when_ready=lambda: None) == ("feeble", 3)
    assert (tmp_path / "feeble.log").read_text().count("alive") == 1 + MOST_RESTARTS
    assert capfd.readouterr().err.count("started again") == MOST_RESTARTS


@pytest.mark.parametrize(
    ("code", "restarts", "status"),
    [
        ("raise SystemExit(4)", True, 4),  # it could never serve
        (f"{READY}", True, 0),  # it was told to end by somebody
        (f"{READY}; raise SystemExit(4)", False, 4),
    ],
)
def test_what_a_restart_would_not_help_ends_the_watch(
    code: str, restarts: bool, status: int, tmp_path: Path
) -> None:
    with Graph(tmp_path) as graph:
        graph.start("one", *python(f"print('alive', flush=True); {code}"))
        assert graph.keep_up(restarts=restarts, when_ready=lambda: None) == ("one", status)
    assert (tmp_path / "one.log").read_text() == "alive\n"


def test_processes_end_with_a_supervisor_that_is_killed(tmp_path: Path) -> None:
    supervisor = f"""
import pathlib, time
from teo_bringup.graph import Graph
graph = Graph(pathlib.Path({str(tmp_path)!r}))
graph.start("one", {sys.executable!r}, "-c", {LISTENER!r})
print(graph.process_id("one"), flush=True)
time.sleep(60)
"""
    with subprocess.Popen(python(supervisor), stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        child = os.pidfd_open(int(process.stdout.readline()))
        wait_for("ready", tmp_path / "one.log")
        process.kill()
        ended, _, _ = select.select([child], [], [], PATIENCE)
        os.close(child)
    assert ended


def test_a_notice_to_a_supervisor_that_is_gone_does_not_hinder(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("NOTIFY_SOCKET", "@nobody-is-there")
    tell_supervisor("READY=1")
    assert "nobody-is-there" in capsys.readouterr().err


def up(*arguments: str, notices: str = "") -> subprocess.Popen[str]:
    return subprocess.Popen(
        [str(executable_of("teo_bringup", "up")), *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=os.environ | {"NOTIFY_SOCKET": notices},
    )


def wait_until_ready(systemd: socket.socket, process: subprocess.Popen[str]) -> None:
    systemd.settimeout(0.5)
    deadline = time.monotonic() + 2 * PATIENCE
    while True:
        try:
            assert systemd.recv(100) == b"READY=1"
            return
        except TimeoutError:
            assert process.poll() is None, process.communicate()[0]
            assert time.monotonic() < deadline, "expected the nodes to be ready"


@pytest.mark.usefixtures("domain_id")
@pytest.mark.slow
def test_up_keeps_every_node_up_until_it_is_told_to_end(tmp_path: Path) -> None:
    """As systemd starts it: told when all can serve; one is killed, returns, and all end without a word."""
    said: list[str] = []
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as systemd:
        systemd.bind(str(tmp_path / "notices"))
        process = up("--namespace", "lab", "--log-folder", str(tmp_path), notices=str(tmp_path / "notices"))
        watchdog = threading.Timer(4 * PATIENCE, process.kill)
        watchdog.start()
        try:
            assert process.stdout is not None
            wait_until_ready(systemd, process)
            nodes = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
            killed = next(n for n in nodes if b"translator_node" in Path(f"/proc/{n}/cmdline").read_bytes())
            os.kill(int(killed), signal.SIGKILL)
            wait_until_ready(systemd, process)
            process.terminate()
            said = process.communicate(timeout=PATIENCE)[0].splitlines()
        finally:
            watchdog.cancel()
            process.kill()
    assert process.returncode == 0, said
    assert not [line for line in said if "Traceback" in line or not line.startswith("[")]
    assert "[up] translator ended with status -9; it is started again" in said
    for name in ("translator", "executor", "driver"):
        assert said.count(f"[up] {name} is ready") == (2 if name == "translator" else 1)
    assert (tmp_path / "translator.log").read_text().count("[lab.translator]: ready") == 2


@pytest.mark.usefixtures("domain_id")
def test_up_ends_with_the_status_of_a_node_that_fails(tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.yaml"
    wrong.write_text('executor:\n  ros__parameters:\n    lut_directory: "/nowhere"\n')
    process = up("executor", "--params-file", str(wrong))
    try:
        said, _ = process.communicate(timeout=2 * PATIENCE)
    finally:
        process.kill()
    assert process.returncode == 1, said
    assert "executor ended with status 1" in said
    assert "/nowhere" in said


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> Callable[..., dict[str, Any]]:
    """What `up` would run for a command line."""
    kept: list[dict[str, Any]] = []
    monkeypatch.setattr("teo_bringup.up._run", lambda **asked: kept.append(asked))

    def ask(*arguments: str) -> dict[str, Any]:
        with pytest.raises(SystemExit):
            main(arguments)
        return kept[-1]

    return ask


def test_up_starts_each_node_once_with_all_that_is_for_every_node(
    asked: Callable[..., dict[str, Any]], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "logs"))
    shared = ("--namespace", "/left/", "--use-sim-time", "--ros-args", "-p", "model:=lstm256")
    given = asked("driver", "console", "driver", *shared)
    assert given["nodes"] == ["driver", "console"]
    assert given["log_folder"].parent == tmp_path / "logs"
    assert given["for_nodes"][:2] == ["--ros-args", "--params-file"]
    ours, theirs = given["for_nodes"][3:7], given["for_nodes"][7:]
    assert ours == ["-r", "__ns:=/left", "-p", "use_sim_time:=true"]
    assert theirs == ["--ros-args", "-p", "model:=lstm256"]
    monkeypatch.delenv("ROS_LOG_DIR")
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    usual = asked()
    assert usual["nodes"] == ["translator", "executor", "driver"]
    assert usual["for_nodes"][3:] == []
    assert usual["log_folder"].parent == tmp_path / "log"


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["camera"], r"expected some of .*retriever.* got camera"),
        (["--params-file", "nowhere.yaml"], "nowhere.yaml"),
        (["-r", "__ns:=/teo"], "--ros-args before what the nodes get"),
    ],
    ids=["no such node", "no such file", "no --ros-args"],
)
def test_up_refuses_what_it_cannot_start(
    arguments: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    assert ended.value.code == 2
    assert re.search(told, capsys.readouterr().err)
