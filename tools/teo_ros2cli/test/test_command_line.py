# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The command as a process, without a ROS graph."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from ros2_words import FILE, words_table

from teo_ros2cli.bags.metadata import TopicRecord
from teo_ros2cli.bags.writer import BagWriter
from teo_ros2cli.cli import options
from teo_ros2cli.interfaces import schema_of
from teo_ros2cli.main import COMMANDS


@pytest.fixture
def tools(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package `tools` with an executable that prints its arguments and one that waits for a signal."""
    index = tmp_path / "share/ament_index/resource_index/packages"
    index.mkdir(parents=True)
    (index / "tools").touch()
    programs = tmp_path / "lib/tools"
    programs.mkdir(parents=True)
    texts = {
        "show": "import json, sys; print(json.dumps(sys.argv[1:])); sys.exit(7)",
        "sleep": "import signal\ntry:\n print('ready', flush=True)\n signal.pause()\n"
        "except KeyboardInterrupt:\n print('interrupted', flush=True); raise SystemExit(3)",
        "broken": None,
    }
    for name, text in texts.items():
        path = programs / name
        path.write_text("nothing to run" if text is None else f"#!{sys.executable}\n{text}\n")
        path.chmod(0o755)
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"{tmp_path}{os.pathsep}{os.environ['AMENT_PREFIX_PATH']}")
    return tmp_path


@pytest.mark.usefixtures("tools")
def test_run_passes_arguments_and_the_exit_status_on(ros2: Callable[..., Any]) -> None:
    words = ["two words", "", "-h", "--help", "--ros-args", "-p", "text:=¿qué tal?", "--", "$HOME", "*"]
    done = ros2("run", "tools", "show", *words)
    assert json.loads(done.stdout) == words
    assert done.returncode == 7


@pytest.mark.usefixtures("tools")
@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 3), (signal.SIGTERM, -signal.SIGTERM)])
def test_run_passes_signals_on(start: Callable[..., Any], number: signal.Signals, status: int) -> None:
    running = start("run", "tools", "sleep")
    running.wait_for_line("ready")
    assert running.stop(number) == status


def test_ctrl_c_while_python_starts_is_answered_in_silence(ros2_path: Path) -> None:
    began = time.monotonic()
    subprocess.run([ros2_path, "--help"], stdout=subprocess.DEVNULL, check=True)
    took = time.monotonic() - began
    for share in (0.05, 0.3, 0.7):
        running = subprocess.Popen(
            [ros2_path, "topic", "list"], stdin=subprocess.DEVNULL, stderr=subprocess.PIPE
        )
        with contextlib.suppress(subprocess.TimeoutExpired):
            running.wait(share * took)
        running.send_signal(signal.SIGINT)
        assert running.communicate(timeout=120.0)[1] == b""
        assert running.returncode in (2, -signal.SIGINT)


@pytest.mark.usefixtures("tools")
def test_run_takes_a_prefix(ros2: Callable[..., Any]) -> None:
    done = ros2("run", "--prefix", "env SHOWN='a b'", "tools", "show", "x")
    assert json.loads(done.stdout) == ["x"]
    assert ros2("run", "--prefix", "no-such-command -x", "tools", "show").stderr.startswith("Prefix command")


@pytest.mark.usefixtures("tools")
@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["nothing", "show"], "Package 'nothing' not found\n"),
        (["tools", "nothing"], "No executable found\n"),
        (["tools", "broken"], "cannot be started"),
    ],
)
def test_run_says_what_is_missing(ros2_here: Callable[..., Any], words: list[str], sentence: str) -> None:
    done = ros2_here("run", *words)
    assert sentence in done.stderr
    assert (done.returncode, done.stdout) == (1, "")


def test_executables_are_listed(tools: Path, ros2_here: Callable[..., Any]) -> None:
    assert ros2_here("pkg", "executables", "tools").stdout == "tools broken\ntools show\ntools sleep\n"
    assert ros2_here("pkg", "executables", "tools", "--full-path").stdout.splitlines()[1] == str(
        tools / "lib/tools/show"
    )
    assert "teo_ros2cli ros2\n" in ros2_here("pkg", "executables").stdout
    assert ros2_here("pkg", "executables", "nothing").stderr == "Package 'nothing' not found\n"
    assert ros2_here("pkg", "prefix", "tools").stdout == f"{tools}\n"
    assert ros2_here("pkg", "prefix", "--share", "tools").stdout == f"{tools}/share/tools\n"
    assert {"tools", "std_msgs", "teo_ros2cli"} <= set(ros2_here("pkg", "list").stdout.splitlines())
    assert ros2_here("pkg", "xml", "-t", "name", "teo_ros2cli").stdout == "teo_ros2cli\n"


def test_help_is_everywhere(ros2: Callable[..., Any]) -> None:
    listing = ros2("-h").stdout
    assert all(f"  {name}" in listing for name in COMMANDS)
    # One process for all: each costs a tenth of a second.
    script = (
        "import sys, contextlib; from teo_ros2cli.main import COMMANDS, main\n"
        "for name, entry in COMMANDS.items():\n"
        "  for verb in getattr(entry, 'entries', ['']):\n"
        "    with contextlib.suppress(SystemExit):\n"
        "      main([name, *filter(None, [verb]), '--help'])\n"
        "assert 'rclpy' not in sys.modules\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=120, check=True
    )
    assert done.stdout.count("usage: ros2") > 30


@pytest.mark.parametrize(
    ("words", "choices"), [(["fly"], "'topic'"), (["topic", "fly"], "'echo'"), (["bag", "fly"], "'record'")]
)
def test_an_unknown_word_is_refused_with_the_choices(
    ros2_here: Callable[..., Any], words: list[str], choices: str
) -> None:
    done = ros2_here(*words)
    assert done.returncode == 2
    assert "invalid choice: 'fly' (choose from " in done.stderr
    assert choices in done.stderr


@pytest.mark.parametrize(
    "words",
    [
        ["topic", "pub", "/t"],
        ["topic", "pub", "-r", "0", "/t", "std_msgs/String"],
        ["topic", "echo", "--truncate-length", "-1", "/t"],
        ["topic", "hz", "-w", "0", "/t"],
        ["bag", "record", "--custom-data", "nothing"],
        ["bag", "play", "x", "-r", "-1"],
    ],
)
def test_impossible_options_are_refused_with_the_usage(
    ros2_here: Callable[..., Any], words: list[str]
) -> None:
    done = ros2_here(*words)
    assert done.returncode == 2
    assert done.stderr.startswith("usage: ros2 ")


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["/t", "std_msgs/msg/Nothing"], "'std_msgs/msg/Nothing' is invalid"),
        (["/t", "std_msgs/msg/String", "data"], "needs to be a dictionary"),
        (["-1", "-t", "3", "/t", "std_msgs/msg/String"], "Cannot pass both"),
    ],
)
def test_a_message_that_cannot_be_is_refused_before_joining_the_graph(
    ros2_here: Callable[..., Any], words: list[str], sentence: str
) -> None:
    done = ros2_here("topic", "pub", *words)
    assert (done.returncode, done.stdout) == (1, "")
    assert sentence in done.stderr


def test_a_profile_that_fast_dds_would_pass_over_is_refused_before_joining_the_graph(
    ros2: Callable[..., Any], tmp_path: Path
) -> None:
    profile = tmp_path / "tls.xml"
    for text, told in ((None, "No such file"), ("<dds", "expected profiles in XML")):
        if text is not None:
            profile.write_text(text)
        done = ros2("topic", "list", env=os.environ | {"FASTRTPS_DEFAULT_PROFILES_FILE": str(profile)})
        assert done.returncode == 1
        assert "/rosout" not in done.stdout  # where Fast DDS writes, too
        assert told in done.stderr
        assert "Traceback" not in done.stderr


def test_the_table_of_words_is_up_to_date() -> None:
    assert FILE.read_text(encoding="utf-8") == words_table(), "run python scripts/ros2_words.py"


@pytest.mark.parametrize(
    ("line", "first"),
    [
        ("ros2 topic p", ["pub"]),
        ("ros2 param set --timeout 3 --inc", ["--include-hidden-nodes"]),
        ("ros2 run tools s", ["show", "sleep"]),
        ("ros2 interface show std_msgs/msg/Strin", ["std_msgs/msg/String"]),
        ("ros2 service call /x std_srvs/srv/T", ["std_srvs/srv/Trigger"]),
    ],
)
def test_words_are_completed_in_the_shell(
    tools: Path, ros2_path: Path, tmp_path: Path, line: str, first: list[str]
) -> None:
    del tools
    answer = tmp_path / "words"
    asked = {
        "_ARGCOMPLETE": "1",
        "_ARGCOMPLETE_IFS": "\n",
        "_ARGCOMPLETE_STDOUT_FILENAME": str(answer),
        "COMP_LINE": line,
        "COMP_POINT": str(len(line)),
        "COMP_TYPE": "9",
    }
    subprocess.run([ros2_path], env={**os.environ, **asked}, timeout=120, check=True)
    assert [word.strip() for word in answer.read_text().splitlines()] == first


def test_datagrams_to_a_group_are_sent_and_received(start: Callable[..., Any], ros2_here: Any) -> None:
    words = ("--group", "225.0.0.7", "--port", "49177")
    receiver = start("multicast", "receive", *words, "--timeout", "20")
    receiver.wait_for_line("Waiting for UDP multicast datagram...")
    while receiver.process.poll() is None:  # it is bound a moment before or after it says so
        sent = ros2_here("multicast", "send", *words)
        if sent.returncode:
            pytest.skip(f"this machine has no network that takes multicast: {sent.stderr}")
        with contextlib.suppress(subprocess.TimeoutExpired):
            receiver.process.wait(0.2)
    assert receiver.finish() == 0
    assert receiver.lines[-1].startswith("Received from ")
    assert receiver.lines[-1].endswith(": 'Hello World!'")
    late = ros2_here("multicast", "receive", *words, "--timeout", "0.1")
    assert (late.returncode, late.stderr) == (1, "Timed out waiting for UDP multicast datagram\n")
    assert ros2_here("multicast", "send", "--group", "nowhere").returncode == 1


def test_bag_info_tells_what_is_wrong(tmp_path: Path, ros2_here: Callable[..., Any]) -> None:
    for name, count in (("good", 1000), ("empty", 0)):
        writer = BagWriter(tmp_path / name)
        writer.add_topic(TopicRecord("/t", "std_msgs/msg/UInt8"), schema_of("std_msgs/msg/UInt8"))
        for i in range(count):
            writer.write("/t", 10**18 + i, 10**18 + i, b"\0\1\0\0" + bytes([i % 256]))
            if i % 100 == 99:
                writer.flush()
        writer.close()
    assert ros2_here("bag", "info", "-t", str(tmp_path / "good" / "good_0.mcap")).stdout == "/t\n"

    empty = ros2_here("bag", "info", str(tmp_path / "empty"))
    assert empty.returncode == 0
    assert "holds no messages" in empty.stderr

    path = tmp_path / "good" / "good_0.mcap"
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    cut = ros2_here("bag", "info", str(tmp_path / "good"))
    assert cut.returncode == 0
    assert "is truncated or damaged" in cut.stderr
    assert " messages can be read" in cut.stderr
    count = next(int(line.split()[1]) for line in cut.stdout.splitlines() if line.startswith("Messages:"))
    assert 300 <= count < 1000

    path.write_bytes(b"")
    for bad in (tmp_path / "good", path, tmp_path / "nowhere"):
        done = ros2_here("bag", "info", str(bad))
        assert done.returncode == 1
        assert done.stderr.startswith("[ERROR] [ros2bag]: ")
        assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ([], "Need to specify at least one option"),
        (["-e", "("], "not a regular expression"),
        (["-a", "-o", "."], "already exists"),
        (["-a", "--qos-profile-overrides-path", "nowhere"], "cannot be read"),
    ],
)
def test_a_recording_that_cannot_be_is_refused(
    ros2_here: Callable[..., Any],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    words: list[str],
    sentence: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    done = ros2_here("bag", "record", *words)
    assert done.returncode == 1
    assert done.stderr.startswith("[ERROR] [ros2bag]: ")
    assert sentence in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_reader_that_leaves_is_no_error(ros2_path: Path) -> None:
    done = subprocess.run(
        f"'{ros2_path}' interface list | head -1; echo ${{PIPESTATUS[0]}}",
        shell=True,
        executable="bash",
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    assert done.stdout.splitlines()[0] == "Messages:"
    assert done.stdout.splitlines()[1] in ("0", "141")
    assert done.stderr == ""


def test_the_choices_of_quality_are_those_of_rclpy() -> None:
    from rclpy import qos

    assert set(options.QOS_PRESETS) == set(qos.QoSPresetProfiles.short_keys())
    for name, choices in options.QOS_POLICIES.items():
        assert set(choices) == set(getattr(qos, f"{name.capitalize()}Policy").short_keys())
