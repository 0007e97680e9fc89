# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import time

from teo_ros2cli.graph.discovery import count_participants, look_again

HEADER = "   sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode\n"


def table(*ports: int) -> str:
    return HEADER + "".join(
        f"  {i}: 0100007F:{port:04X} 00000000:0000 07 0 0\n" for i, port in enumerate(ports)
    )


def test_discovery_ports_of_the_domain_are_counted_once() -> None:
    # Domain 3: multicast 8150, participants 0 and 1 with discovery ports 8160 and 8162, user ports 8161 and
    # 8163.
    assert count_participants(table(8150, 8160, 8161, 8162, 8163, 8160), 3) == 2
    assert count_participants(table(8160, 8162), 4) == 0
    assert count_participants(table(7410, 7411, 53, 65535), 0) == 1


def test_what_appears_a_moment_late_is_found_and_what_never_comes_ends_the_look() -> None:
    looks = iter([[], [], ["std_msgs/msg/String"]])
    assert look_again(lambda: next(looks)) == ["std_msgs/msg/String"]
    started = time.monotonic()
    assert look_again(lambda: []) == []
    assert time.monotonic() - started >= 0.75  # three of the announcements of config/fastdds.xml
