# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A `ros2` command for machines whose ROS 2 comes from PyPI; it steps aside for the genuine one.

For other packages: `bags.writer.BagWriter` and `bags.bag.open_bag` write and read bags, `definitions` gives
the schema and the hash of a type. The rooms use each other in one direction: `cli`, `graph`, `bags`, then
`messages` and `definitions`. rclpy is loaded only by commands that need a graph.
"""
