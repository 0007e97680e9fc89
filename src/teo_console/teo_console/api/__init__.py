# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What pages ask for over /api: the dictionary, teaching, reviewing and practising. Knows nothing of ROS."""
