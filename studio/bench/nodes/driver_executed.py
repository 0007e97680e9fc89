# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver executes of random sentences, judged by its positions alone.

`python -m nodes.driver_executed [SENTENCES]` draws sentences from the package's table, plans them, has the
driver's core execute them, and looks at random moments of each: four positions, a millisecond apart. Their
differences are velocity, acceleration and jerk (`MotionLimits.reached`); MuJoCo, which neither planner nor
driver uses for it, says which parts of the robot touch. What has been judged is kept for as long as the code
is the same, so that a run that was cut off goes on where it was.
"""

from __future__ import annotations

import json
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray
from rich.progress import track

from executed_motion import following
from kept import kept_folder
from report import Figure
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.sentence_form import SentenceForm, SentenceType
from teo_motion.trajectory.limits import MotionLimits
from teo_names import COMMANDED_JOINTS, HOME, urdf_text
from teo_signs.errors import PlanError
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.tokens import Kind, Token

SENTENCES = 10_000
_SHORT = 100  # sentences among the other benches
MOMENTS = 100  # of each sentence: 10^6 in all, since another sentence shows more than more moments of one
_BURST, _APART = 4, 0.001  # positions at a moment; time between two [s]
_SECOND = 1_000_000_000

# The least significant digit of a position of some radians, seen through three differences.
_ROUNDING = {"position": 1.5e-5, "velocity": 1e-6, "acceleration": 1e-6, "jerk": 1e-5}
_NEAR = 0.002  # [m]; parts that are nearer than this are looked at
# What decides about the figures.
_MAKERS = (
    "teo_motion",
    "teo_signs",
    "teo_sim_driver.checking",
    "teo_sim_driver.motion",
    "teo_sim_driver.joint_follower",
    "nodes.driver_executed",
)
_KINDS = {"lexical": Kind.LEXICAL, "letter": Kind.LETTER, "number": Kind.NUMBER}


@dataclass
class Judged:
    """One sentence. Shares are of the limit, the most seen."""

    number: int
    refused: str = ""
    """Reason of the planner or the driver, if it was not executed."""
    duration: float = 0.0
    beyond: float = -np.inf
    """The most that a joint was outside its limits [rad]; negative inside."""
    velocity: float = 0.0
    acceleration: float = 0.0
    jerk: float = 0.0
    nearest: float = _NEAR
    """Least distance of two parts [m], if under 2 mm."""
    parts: str = ""


class Judge:
    """The limits of the motion, and distances by MuJoCo."""

    def __init__(self) -> None:
        self._limits = MotionLimits.of_robot()
        spec = mujoco.MjSpec.from_string(urdf_text())
        for geom in spec.geoms:
            geom.margin = _NEAR / 2.0
        self._model = model = spec.compile()
        self._data = mujoco.MjData(model)
        self._places = [model.joint(name).qposadr[0] for name in COMMANDED_JOINTS]
        # Phalanges that follow a tendon.
        self._led = model.jnt_qposadr[model.eq_obj1id]
        self._leading = model.jnt_qposadr[model.eq_obj2id]
        self._parts = [model.body(body).name for body in model.geom_bodyid]
        for name, angle in HOME.items():
            self._data.joint(name).qpos[0] = angle
        # Geoms of which a contact counts: not of one hand, nor built into each other.
        self._apart = np.array(
            [[not one_hand(first, second) for second in self._parts] for first in self._parts]
        )
        _, built = self._near(np.array([HOME[name] for name in COMMANDED_JOINTS]))
        for first, second in built:
            same = [np.array([part == each for part in self._parts]) for each in (first, second)]
            self._apart[np.ix_(*same)] = self._apart[np.ix_(*reversed(same))] = False

    def judge(self, judged: Judged, positions: NDArray[np.float64]) -> None:
        """Look at the moments of a sentence. Shape (moments, burst, joints)."""
        reached = self._limits.reached(positions, _APART)
        judged.beyond, judged.velocity, judged.acceleration, judged.jerk = reached
        for moment in positions[:, 0]:
            distances, pairs = self._near(moment)
            if distances.size and distances.min() < judged.nearest:
                judged.nearest = float(distances.min())
                judged.parts = " and ".join(pairs[int(distances.argmin())])

    def _near(self, positions: NDArray[np.float64]) -> tuple[NDArray[np.float64], list[tuple[str, str]]]:
        """Distances [m] of parts that are nearer than `_NEAR` and may not be, and which they are."""
        model, data = self._model, self._data
        data.qpos[self._places] = positions
        data.qpos[self._led] = model.eq_data[:, 0] + model.eq_data[:, 1] * data.qpos[self._leading]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        geoms = data.contact.geom
        counted = self._apart[geoms[:, 0], geoms[:, 1]]
        pairs = [sorted((self._parts[one], self._parts[other])) for one, other in geoms[counted]]
        return data.contact.dist[counted], [(first, second) for first, second in pairs]


def one_hand(first: str, second: str) -> bool:
    """Whether both are parts of the same hand, which may touch each other."""
    return any(
        all(part.startswith(side) or part == f"Frontal{side}Wrist_link" for part in (first, second))
        for side in ("Left", "Right")
    )


def measure(sentences: int = _SHORT) -> list[Figure]:
    """Judge so many sentences, those that are kept included."""
    kept = kept_folder("driver_executed", *_MAKERS)
    kept.mkdir(parents=True, exist_ok=True)
    record = kept / "judged.jsonl"
    done = _read(record)
    missing = [number for number in range(sentences) if number not in done]
    if missing:
        judge, table = Judge(), Lut.open(default_lut_directory())
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
    return {each.number: each for each in (Judged(**json.loads(line)) for line in lines)}


def _executed(number: int, judge: Judge, planner: Planner, table: Lut) -> Judged:
    rng = np.random.default_rng([13, number])
    judged = Judged(number)
    form = SentenceForm(type=rng.choice(list(SentenceType)), negated=bool(rng.random() < 0.2))
    try:
        plan = planner.plan(random_tokens(rng, table), form=form)
    except PlanError as error:
        judged.refused = error.code
        return judged
    follower = following(plan, period=0.01)
    judged.duration = plan.duration
    seen, last = [], 0
    for moment in np.sort(rng.uniform(0.0, plan.duration, MOMENTS)):
        begin = max(round(moment * _SECOND), last)
        while begin - last > _SECOND // 100:  # as the node steps
            last += _SECOND // 100
            follower.step(last)
        times = [begin + round(i * _APART * _SECOND) for i in range(_BURST)]
        seen.append([follower.step(time).positions for time in times])
        last = times[-1]
    judge.judge(judged, np.array(seen))
    if follower.report().limited_steps:
        judged.refused = "steps_limited"
    return judged


def random_tokens(rng: np.random.Generator, table: Lut) -> list[Token]:
    """One to six signs of the table, letters and numbers among them, now and then faster or slower."""
    tokens = []
    glosses = sorted(table)
    for word in range(rng.integers(1, 7)):
        sign = table[str(rng.choice(glosses))]
        scale = float(rng.choice([0.7, 1.0, 1.0, 1.0, 1.5]))
        tokens.append(Token(gloss=sign.gloss, kind=_KINDS[sign.kind], duration_scale=scale, word_index=word))
    return tokens


def _figures(judged: list[Judged]) -> Iterator[Figure]:
    executed = [each for each in judged if not each.refused]
    codes = Counter(each.refused for each in judged if each.refused)
    moments = len(executed) * MOMENTS
    hours = sum(each.duration for each in executed) / 3600.0
    yield Figure(
        "random sentences executed", f"{len(executed)} of {len(judged)}, {hours:.1f} h; not: {dict(codes)}"
    )
    for name, limit in (("beyond", 0.0), ("velocity", 1.0), ("acceleration", 1.0), ("jerk", 1.0)):
        values = np.array([getattr(each, name) for each in executed])
        what = "position" if name == "beyond" else name
        broken = int((values > limit + _ROUNDING[what]).sum())
        most = f"{values.max():.1e} rad beyond" if name == "beyond" else f"{values.max():.6f} of the limit"
        yield Figure(f"sentences over the limit of {what}, {moments} moments", f"{broken}; most {most}")
    touching = [each for each in executed if each.nearest < 0.0]
    near = min(executed, key=lambda each: each.nearest)
    yield Figure(
        f"sentences in which parts of the robot touch, {moments} moments",
        f"{len(touching)}; nearest {near.nearest * 1e3:.2f} mm ({near.parts or 'none under 2 mm'})",
    )


if __name__ == "__main__":
    for figure in measure(int(sys.argv[1]) if len(sys.argv) > 1 else SENTENCES):
        print(f"{figure.what}: {figure.value}")
