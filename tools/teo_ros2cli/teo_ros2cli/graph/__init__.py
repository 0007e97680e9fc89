# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Taking part in a running ROS graph through rclpy: discovery, subscribing, recording, playing, calling."""
