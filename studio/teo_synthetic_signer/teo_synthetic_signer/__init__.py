# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""People who sign before a depth camera: rendered colour and depth, with the true place of each keypoint.

`render_take` gives the frames of a take. The names below are loaded when they are first used, so that
importing the package costs nothing.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
