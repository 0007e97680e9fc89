# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From colour and depth images to people in space: keypoints of bodies, hands and faces.

`retrieve_recording` goes through a whole recording; an `ImageRetriever`, made of a detector and a
`Retriever`, takes one image after the other. The names below are loaded when they are first used, so that
importing the package costs nothing.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
