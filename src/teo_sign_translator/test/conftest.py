# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import sys
from pathlib import Path

# What several tests here need stands beside them.
sys.path.insert(0, str(Path(__file__).parent))
