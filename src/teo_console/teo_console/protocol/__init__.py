# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What page and node say to each other over the websocket, as types: JSON both ways, poses as binary frames.

`from_page` and `to_page` are tagged unions by their field `type`; `schema` writes both as JSON Schema.
"""
