"""From limbs to people: the strongest limb first, each joined to whom it belongs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.detectors.paf.paf_limbs import Limbs
from teo_skeleton_retriever.detectors.paf.paf_model import PafModel
from teo_skeleton_retriever.detectors.paf.paf_peaks import Peaks
from teo_skeleton_retriever.detectors.paf.paf_thresholds import PafThresholds

PEAK_SHARE = 0.1
"""How much the confidence of its two parts counts beside a limb's own score when limbs are ranked."""
FEWEST_BESIDE_FEET = 5
"""Other parts that somebody with feet must have: feet alone are often shoes, or reflections."""


@dataclass
class _Person:
    peaks: dict[int, int]
    """index of the peak by part"""
    score: float


def assemble(
    peaks: Peaks, limbs: Limbs, model: PafModel, thresholds: PafThresholds
) -> tuple[FloatArray, ...]:
    """Put people together.

    Limbs are taken in the order of their score. One between two free parts begins a person; one to a free
    part extends the person of the other; one between two people joins them if they have no part in common;
    one that contradicts what stronger limbs have settled is left out.

    Returns:
        x, y [px], confidence of each person's parts, zero where not found; shape (parts, 3) each.
    """
    rank = limbs.score + PEAK_SHARE * (peaks.score[limbs.first] + peaks.score[limbs.second])
    owner: dict[int, _Person] = {}
    for limb in np.argsort(-rank, kind="stable"):
        first, second = int(limbs.first[limb]), int(limbs.second[limb])
        _join(first, second, float(limbs.score[limb]), owner, peaks)
    people = list({id(person): person for person in owner.values()}.values())
    return tuple(_table(person, peaks, model) for person in people if _is_person(person, model, thresholds))


def _join(first: int, second: int, limb_score: float, owner: dict[int, _Person], peaks: Peaks) -> None:
    one = owner.get(first) or _alone(first, peaks)
    other = owner.get(second) or _alone(second, peaks)
    if one is other:
        one.score += limb_score
    elif one.peaks.keys().isdisjoint(other.peaks):
        one.peaks |= other.peaks
        one.score += other.score + limb_score
        for peak in one.peaks.values():
            owner[peak] = one


def _alone(peak: int, peaks: Peaks) -> _Person:
    return _Person({int(peaks.part[peak]): peak}, float(peaks.score[peak]))


def _is_person(person: _Person, model: PafModel, thresholds: PafThresholds) -> bool:
    parts = len(person.peaks)
    feet = sum(model.layout.keypoints[part].endswith(("Toe", "Heel")) for part in person.peaks)
    return (
        parts >= thresholds.parts
        and person.score / parts >= thresholds.score
        and not (feet and parts - feet < FEWEST_BESIDE_FEET)
    )


def _table(person: _Person, peaks: Peaks, model: PafModel) -> FloatArray:
    table = np.zeros((len(model.layout), 3))
    for part, peak in person.peaks.items():
        table[part] = *peaks.position[peak], peaks.score[peak]
    return table
