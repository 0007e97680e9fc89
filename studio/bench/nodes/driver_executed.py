# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver executes of random sentences, judged by its positions alone.

Sentences are drawn from the package's table, planned, executed by the driver's core, and looked at in random
moments: four positions, a millisecond apart (`executed_motion`). What has been judged is kept for as long as
the code is the same, so that a run that was cut off goes on where it was.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from rich.progress import track

from executed_motion import NEAR, STEP, ContactJudge, Reached, following, judged
from kept import kept_folder
from report import Figure
from signs.random_signs import random_tokens
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.sentence_form import SentenceForm, SentenceType
from teo_signs.errors import PlanError
from teo_signs.look_up_table import Lut, default_lut_directory

MOMENTS = 100  # of each sentence: another sentence shows more than more moments of one
_BURST = 4  # positions at a moment
_SECOND = 1_000_000_000
_SCALES = (0.7, 1.0, 1.0, 1.0, 1.5)
# What decides about the figures.
_MAKERS = ("teo_motion", "teo_signs", "teo_sim_driver", "executed_motion", "nodes.driver_executed")

_UNSEEN = Reached(-np.inf, 0.0, 0.0, 0.0)


@dataclass
class Judged:
    """One sentence."""

    number: int
    refused: str = ""
    """Reason of the planner or the driver, if it was not executed."""
    duration: float = 0.0
    reached: Reached = _UNSEEN
    nearest: float = NEAR
    """Least distance of two parts [m], if under 2 mm."""
    parts: str = ""


def measure(sentences: int = 100) -> list[Figure]:
    """Judge so many sentences, those that are kept included."""
    kept = kept_folder("driver_executed", *_MAKERS)
    kept.mkdir(parents=True, exist_ok=True)
    record = kept / "judged.jsonl"
    done = _read(record)
    missing = [number for number in range(sentences) if number not in done]
    if missing:
        judge, table = ContactJudge(), Lut.open(default_lut_directory())
        planner = Planner(table, robot=Robot.load())
        with record.open("a") as file:
            for number in track(missing, "sentences"):
                done[number] = _executed(number, judge, planner, table)
                file.write(json.dumps(asdict(done[number])) + "\n")
                file.flush()
    return list(_figures([done[number] for number in range(sentences)]))


def _read(record: Path) -> dict[int, Judged]:
    if not record.is_file():
        return {}
    lines = [line for line in record.read_text().splitlines(keepends=True) if line.endswith("}\n")]
    found = [Judged(**json.loads(line)) for line in lines]
    for each in found:
        each.reached = Reached(*each.reached)  # JSON made a list of it
    return {each.number: each for each in found}


def _executed(number: int, judge: ContactJudge, planner: Planner, table: Lut) -> Judged:
    dice = np.random.default_rng([13, number])
    found = Judged(number)
    form = SentenceForm(type=dice.choice(list(SentenceType)), negated=bool(dice.random() < 0.2))
    try:
        plan = planner.plan(random_tokens(dice, table, most=6, scales=_SCALES), form=form)
    except PlanError as error:
        found.refused = error.code
        return found
    follower = following(plan, period=0.01)
    found.duration = plan.duration
    seen, last = [], 0
    for moment in np.sort(dice.uniform(0.0, plan.duration, MOMENTS)):
        begin = max(round(moment * _SECOND), last)
        while begin - last > _SECOND // 100:  # as the node steps
            last += _SECOND // 100
            follower.step(last)
        times = [begin + round(i * STEP * _SECOND) for i in range(_BURST)]
        seen.append([follower.step(time).positions for time in times])
        last = times[-1]
    bursts = np.array(seen)
    found.reached = judged(bursts)
    found.nearest, found.parts = judge.nearest(bursts[:, 0])
    if follower.report().limited_steps:
        found.refused = "steps_limited"
    return found


def _figures(found: list[Judged]) -> Iterator[Figure]:
    executed = [each for each in found if not each.refused]
    codes = Counter(each.refused for each in found if each.refused)
    hours = sum(each.duration for each in executed) / 3600.0
    yield Figure(
        "random sentences executed", f"{len(executed)} of {len(found)}, {hours:.1f} h; not: {dict(codes)}"
    )
    what = f"{len(executed) * MOMENTS} moments"
    broken = Counter(limit for each in executed for limit in each.reached.broken())
    beyond, *shares = np.max([each.reached for each in executed], axis=0)
    most = ", ".join(f"{share:.6f}" for share in shares)
    yield Figure(f"sentences over a limit, {what}", f"{dict(broken) or 0}")
    yield Figure(
        "most velocity, acceleration, jerk over the limit; position beyond", f"{most}; {beyond:.1e} rad"
    )
    touching = sum(each.nearest < 0.0 for each in executed)
    near = min(executed, key=lambda each: each.nearest)
    yield Figure(
        f"sentences in which parts of the robot touch, {what}",
        f"{touching}; nearest {near.nearest * 1e3:.2f} mm ({near.parts or 'none under 2 mm'})",
    )
