"""How far TEO is from touching itself."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray


class Clearance(NamedTuple):
    """The closest pair of links."""

    distance: float
    """Distance [m]; negative is the depth of the overlap."""
    first: str
    """Name of one link."""
    second: str
    """Name of the other link."""


class ClearanceChecker:
    """Distances between the collision shapes of links that can meet."""

    def __init__(self, model: pin.Model, urdf: str) -> None:
        self._model = model
        self._data = model.createData()
        self._geometry = pin.buildGeomFromUrdfString(model, urdf, pin.GeometryType.COLLISION)

    def clearance(self, q: NDArray[np.float64]) -> Clearance:
        """Smallest distance at a configuration."""
        raise NotImplementedError
