"""One person over time: from keypoints in images and depth to joints in space."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.body_25 import BODY_25
from teo_skeleton_retriever.body_estimator import ARMS, BodyEstimator
from teo_skeleton_retriever.body_layouts import as_body_25
from teo_skeleton_retriever.depth_lookup import DepthLookup, Surfaces
from teo_skeleton_retriever.detected import Detected, detected
from teo_skeleton_retriever.face_70 import FACE_70
from teo_skeleton_retriever.face_estimator import FaceEstimator
from teo_skeleton_retriever.frame import Frame
from teo_skeleton_retriever.hand_21 import HAND_21
from teo_skeleton_retriever.hand_estimator import HandEstimator, supported
from teo_skeleton_retriever.hand_fit import HandFit
from teo_skeleton_retriever.person_2d import Person2D
from teo_skeleton_retriever.retriever_parameters import RetrieverParameters
from teo_skeleton_retriever.skeleton_3d import Keypoints3D

_HEAD = [BODY_25.index[name] for name in ("Nose", "REye", "LEye")]


class PersonParts(NamedTuple):
    """The keypoints of one person at one time."""

    body: Keypoints3D
    left_hand: Keypoints3D
    right_hand: Keypoints3D
    face: Keypoints3D


class PersonEstimator:
    """Follows one person, of whom it is known which detection is theirs."""

    def __init__(self, parameters: RetrieverParameters) -> None:
        self._parameters = parameters
        self._body = BodyEstimator(parameters)
        self._hands = {side: HandEstimator(parameters) for side in ARMS}
        self._face = FaceEstimator(parameters)
        self._lookup = DepthLookup(
            radius=0.008, gap=0.03, nearest=parameters.min_depth, farthest=parameters.max_depth
        )

    def step(self, frame: Frame, person: Person2D, distance: float) -> PersonParts:
        """Take one image.

        Args:
            frame: the image.
            person: who was seen in it.
            distance: of the person along the optical axis [m].
        """
        least = self._parameters.min_confidence
        body = detected(as_body_25(person.body), len(BODY_25), frame.camera, least)
        seen = {
            side: detected(keypoints, len(HAND_21), frame.camera, least)
            for side, keypoints in (("R", person.right_hand), ("L", person.left_hand))
        }
        expected = self._body.expected(frame.stamp)
        fits = self._fit_hands(frame, person, seen, expected[:, 2], distance)
        wrists = {
            side: (float(fit.depths[0]), float(fit.sigma[0]))
            for side, fit in fits.items()
            if fit is not None and supported(fit)
        }
        done = self._body.step(frame, body, distance=distance, wrists=wrists)
        hands = {}
        for side, hand in self._hands.items():
            wrist = done.keypoints.points[ARMS[side][2]]
            fit = fits[side]
            if fit is not None and side in done.wrists:
                fit = fit._replace(depths=fit.depths + done.wrists[side] - fit.depths[0])
            hands[side] = hand.step(frame.stamp, seen[side], fit, wrist=wrist, focal=frame.camera.fx)
        face = detected(person.face, len(FACE_70), frame.camera, least)
        head = done.keypoints.points[_HEAD, 2]
        depth = float(np.nanmean(head)) if np.isfinite(head).any() else float("nan")
        return PersonParts(done.keypoints, hands["L"], hands["R"], self._face.step(frame, face, depth))

    def _fit_hands(
        self,
        frame: Frame,
        person: Person2D,
        seen: dict[str, Detected],
        expected: FloatArray,
        distance: float,
    ) -> dict[str, HandFit | None]:
        sides = [side for side in seen if seen[side].seen.any()]
        if not sides:
            return dict.fromkeys(seen)
        wrists = {side: float(expected[ARMS[side][2]]) for side in sides}
        n = len(HAND_21)
        about = np.repeat([w if np.isfinite(w) else distance for w in wrists.values()], n)
        pixels = np.concatenate([seen[side].pixels for side in sides])
        both = self._lookup.surfaces(frame.depth, pixels, focal=frame.camera.fx, distance=about)
        worlds = {"R": person.right_hand_world, "L": person.left_hand_world}
        fits: dict[str, HandFit | None] = dict.fromkeys(seen)
        for i, side in enumerate(sides):
            fits[side] = self._hands[side].fit(
                frame.stamp,
                seen[side],
                Surfaces(*(array[i * n : (i + 1) * n] for array in both)),
                world=worlds[side],
                scale=self._body.size.scale,
                wrist=wrists[side],
            )
        return fits
