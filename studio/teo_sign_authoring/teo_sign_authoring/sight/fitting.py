# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Networks of `teo_skeleton_retriever.lifting` fitted to rendered people."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import torch
from torch import nn

from teo_common.arrays import Array
from teo_sign_authoring.sight.rendered_people import RenderedPerson
from teo_skeleton_retriever.layouts.person_layout import BODY, HANDS
from teo_skeleton_retriever.lifting.arms import ADULT, SeenArm, arm_inputs
from teo_skeleton_retriever.lifting.clip import ELBOW, HIP, SHOULDER, SIDES, WRIST, Points, PoseClip
from teo_skeleton_retriever.lifting.hands import free_bones, hand_inputs
from teo_skeleton_retriever.lifting.lifted_person import CAMERA, SeenPerson, at_joints, drawn_in

# [m] Below the shoulders; wrists under it hang.
_RAISED = -0.45
# [px] Deviation of a detector that makes no other mistake, and guesses no depth of the body: others than
# MediaPipe see nearly so.
_PIXELS = 1.5
# [m] Shoulders are seen so far above their joints, hips below.
_OFF_JOINTS = 0.015
# Share of the frames in which the detector is taken to guess no depth of the body, not to see the elbow, the
# other hand, or how the hand is turned.
_HIDDEN = 0.1
# Hands of which every so manieth is shown as it is, too.
_EVERY_EXACT = 10
# Deviation of what is added to inputs, so that no single frame is learned: of directions, of places [m].
_NOISE = {"hands": 0.08, "arms": 0.015}
# Enough for 600 people: shown 400, networks of these were 1 mm worse on people they had not seen.
_UNITS, _DROPPED = 128, 0.1
_PASSES, _TOGETHER = 120, 256
_RATE, _DECAY = 2e-3, 1e-3


class Examples(NamedTuple):
    """Inputs and what is to come out. Shapes (n, inputs), (n, outputs)."""

    inputs: Array
    outputs: Array


def arm_examples(people: Sequence[RenderedPerson], random: np.random.Generator) -> Examples:
    """Raised arms: depths of elbow and wrist before the middle of the shoulders [m], as of an adult."""
    found = [each for person in people for each in _arms(person, random)]
    return Examples(*(np.concatenate(parts) for parts in zip(*found, strict=True)))


def _arms(person: RenderedPerson, random: np.random.Generator) -> Iterator[tuple[Array, Array]]:
    truth = person.truth - person.truth[:, list(SHOULDER.values())].mean(axis=1, keepdims=True)
    truth *= ADULT / true_size(truth)
    facing = _facing(truth)
    for clip, true in ((person.clip, truth), (_exact(person.clip, facing, random), facing)):
        seen = SeenPerson(drawn_in(at_joints(clip), true))
        for side in SIDES:
            arm = seen.arm(side)
            known = np.isfinite(arm.wrist).all(axis=1) & (true[:, WRIST[side], 2] > _RAISED)
            depths = true[:, [ELBOW[side], WRIST[side]], 0]
            for shown in (arm, _hidden(arm, random)):
                yield arm_inputs(shown)[known], depths[known]


def true_size(truth: Array) -> float:
    """Shoulders, upper arm and forearm together, which `ADULT` is of everybody who is lifted [m]."""
    chain = truth[:, [SHOULDER["left"], SHOULDER["right"], ELBOW["right"], WRIST["right"]]]
    return float(np.median(np.linalg.norm(np.diff(chain, axis=1), axis=2).sum(axis=1)))


def _facing(truth: Array) -> Array:
    """A person turned to the camera: nothing tells a turn where no depth is guessed. Shape (T, n, 3)."""
    away = np.median(truth[:, SHOULDER["left"]] - truth[:, SHOULDER["right"]], axis=0)
    turn = float(np.arctan2(away[0], away[1]))
    cosine, sine = np.cos(turn), np.sin(turn)
    facing: Array = truth @ np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    return facing


def _exact(clip: PoseClip, truth: Array, random: np.random.Generator) -> PoseClip:
    """What a detector would see that only trembles, and guesses depths of hands alone."""
    body = clip.body.places
    pair = list(SHOULDER.values())
    breadth = np.nanmedian(np.linalg.norm(np.diff(body[:, pair, 1:], axis=1), axis=2))
    pixels = float(breadth / np.median(np.linalg.norm(np.diff(truth[:, pair, 1:], axis=1), axis=2)))

    def part(points: Points, rows: slice) -> Points:
        there = truth[:, rows].copy()
        if rows == BODY:
            there[:, list(SHOULDER.values()), 2] += _OFF_JOINTS
            there[:, list(HIP.values()), 2] -= _OFF_JOINTS
        nearer = 1.0 - there[..., :1] / CAMERA
        places = pixels * there / nearer + random.normal(0.0, _PIXELS, there.shape)
        if rows == BODY:
            places[..., 0] = np.nan
        places[~points.seen] = np.nan
        return replace(points, places=places)

    return clip.with_parts(part)


def _hidden(arm: SeenArm, random: np.random.Generator) -> SeenArm:
    """An arm of which in some frames something is not seen."""
    shown = {}
    for name in ("elbow", "other", "guess", "hand"):
        values = getattr(arm, name).copy()
        values[random.random(len(values)) < _HIDDEN] = np.nan
        shown[name] = values
    return arm._replace(**shown)


def hand_examples(people: Sequence[RenderedPerson]) -> Examples:
    """Hands: how much the directions of the bones beyond the palm differ from what is seen."""
    inputs, outputs = [], []
    for person in people:
        seen = SeenPerson(person.clip)
        for side, mirror in (("right", (1.0, 1.0, 1.0)), ("left", (1.0, -1.0, 1.0))):
            hand, true = seen.hands[side].points * mirror, person.truth[:, HANDS[side[0].upper()]] * mirror
            known = np.flatnonzero(np.isfinite(hand).all(axis=(1, 2)))
            exact = known[::_EVERY_EXACT]
            for shown, there in ((hand[known], true[known]), (true[exact], true[exact])):
                inputs.append(hand_inputs(shown))
                outputs.append(free_bones(there) - free_bones(shown))
    changes = np.concatenate(outputs)
    return Examples(np.concatenate(inputs), changes.reshape(len(changes), -1))


def fit(name: str, examples: Examples, seed: int = 0) -> dict[str, Array]:
    """Weights of a network, as `load_network` reads them.

    Args:
        name: "arms" or "hands". Arms also learn how sure their depths are.
        examples: What is shown and what is to be said.
        seed: Of the first weights and the order.
    """
    torch.manual_seed(seed)
    torch.set_num_threads(1)  # a small network's threads wait for each other
    inputs = torch.tensor(examples.inputs, dtype=torch.float32)
    outputs = torch.tensor(examples.outputs, dtype=torch.float32)
    sure = name == "arms"
    count = outputs.shape[1] * (2 if sure else 1)
    drop = nn.Dropout(_DROPPED)
    layers = [nn.Linear(inputs.shape[1], _UNITS), nn.Linear(_UNITS, _UNITS), nn.Linear(_UNITS, count)]
    network = nn.Sequential(layers[0], nn.ReLU(), drop, layers[1], nn.ReLU(), drop, layers[2])
    optimiser = torch.optim.AdamW(network.parameters(), _RATE, weight_decay=_DECAY)
    steps = _PASSES * (len(inputs) // _TOGETHER + 1)
    slower = torch.optim.lr_scheduler.CosineAnnealingLR(optimiser, steps)
    for _ in range(_PASSES):
        for some in torch.split(torch.randperm(len(inputs)), _TOGETHER):
            shown = inputs[some] + _NOISE[name] * torch.randn(len(some), inputs.shape[1])
            said = network(shown)
            if sure:
                middle, spread = said.chunk(2, dim=1)
                loss = (((middle - outputs[some]) / spread.exp()) ** 2 / 2.0 + spread).sum(dim=1).mean()
            else:
                loss = ((said - outputs[some]) ** 2).sum(dim=1).mean()
            optimiser.zero_grad()
            loss.backward()
            optimiser.step()
            slower.step()
    return {
        f"{name}.{kind}.{at}": getattr(layer, kind).detach().numpy()
        for at, layer in enumerate(layers)
        for kind in ("weight", "bias")
    }
