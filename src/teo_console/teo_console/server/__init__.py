# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The web server: one static page, a websocket, and who may speak to them. Knows nothing of ROS."""
