# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Confidence maps and limb fields of known people.

Drawn as Cao et al. (TPAMI 2021, equations 6 to 9) define what the networks are trained to give: Gaussians at
the parts (the highest of all people), unit vectors within a width of the limbs (the mean of all people).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from teo_skeleton_retriever.detectors.part_affinity import BODY_25_MODEL, PafModel

STRIDE = 8
"""Pixels of the network's input for each cell of its output."""
SIGMA = 7.0
"""Of the Gaussians [px]: that of OpenPose's training."""
LIMB_WIDTH = 8.0
"""To either side [px]: one cell, as in OpenPose's training."""

# A person who stands upright, facing us, one unit high, from the neck.
_STANDING = {
    **{"Nose": (0, -0.12), "Neck": (0, 0), "MidHip": (0, 0.32)},
    **{"RShoulder": (-0.11, 0), "RElbow": (-0.14, 0.17), "RWrist": (-0.15, 0.32)},
    **{"LShoulder": (0.11, 0), "LElbow": (0.14, 0.17), "LWrist": (0.15, 0.32)},
    **{"RHip": (-0.07, 0.32), "RKnee": (-0.08, 0.55), "RAnkle": (-0.08, 0.78)},
    **{"LHip": (0.07, 0.32), "LKnee": (0.08, 0.55), "LAnkle": (0.08, 0.78)},
    **{"REye": (-0.03, -0.15), "LEye": (0.03, -0.15), "REar": (-0.07, -0.13), "LEar": (0.07, -0.13)},
    **{"LBigToe": (0.11, 0.84), "LSmallToe": (0.15, 0.83), "LHeel": (0.06, 0.83)},
    **{"RBigToe": (-0.11, 0.84), "RSmallToe": (-0.15, 0.83), "RHeel": (-0.06, 0.83)},
}


def person(
    x: float,
    y: float,
    height: float = 300.0,
    model: PafModel = BODY_25_MODEL,
    **moved: tuple[float, float] | None,
) -> np.ndarray:
    """A person's parts [px], neck at x, y; (25, 2) or (18, 2).

    Args:
        moved: parts elsewhere than in standing, in heights from the neck; None for what is not seen.
    """
    places = {**_STANDING, **moved}
    parts = np.full((len(model.layout), 2), np.nan)
    for name, index in model.layout.index.items():
        place = places[name]
        if place is not None:
            parts[index] = x + height * place[0], y + height * place[1]
    return parts


def draw(
    people: Sequence[np.ndarray], size: tuple[int, int], model: PafModel = BODY_25_MODEL
) -> tuple[np.ndarray, np.ndarray]:
    """Maps (parts, rows, columns) and fields (channels, rows, columns) for a network's input of this size."""
    columns, rows = size[0] // STRIDE, size[1] // STRIDE
    # Where the cells' middles are [px].
    y, x = (np.mgrid[:rows, :columns] + 0.5) * STRIDE - 0.5
    maps = np.zeros((len(model.layout), rows, columns), np.float32)
    fields = np.zeros((model.field_channels, rows, columns), np.float32)
    for part in range(len(model.layout)):
        for parts in people:
            if np.isfinite(parts[part]).all():
                squared = (x - parts[part, 0]) ** 2 + (y - parts[part, 1]) ** 2
                maps[part] = np.maximum(maps[part], np.exp(-squared / (2.0 * SIGMA**2)))
    for (first, second), channels in zip(model.limbs, model.fields, strict=True):
        covered = np.zeros((rows, columns))
        for parts in people:
            along = parts[second] - parts[first]
            length = np.linalg.norm(along)
            if not length > 0.0:  # also where one of them is not seen
                continue
            u, v = along / length
            forth = (x - parts[first, 0]) * u + (y - parts[first, 1]) * v
            aside = np.abs((x - parts[first, 0]) * v - (y - parts[first, 1]) * u)
            on_limb = (forth >= -STRIDE / 2) & (forth <= length + STRIDE / 2) & (aside <= LIMB_WIDTH)
            fields[channels[0]] += on_limb * u
            fields[channels[1]] += on_limb * v
            covered += on_limb
        fields[channels] /= np.maximum(covered, 1.0)
    return maps, fields
