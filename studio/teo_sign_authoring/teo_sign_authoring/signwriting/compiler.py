# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A sign in SignWriting as a sign score."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise, zip_longest
from typing import Literal

import numpy as np
from pydantic import ValidationError

from teo_common.arrays import Array
from teo_sign_authoring.notation.score_schema import Circle, HandScore, HeadScore, Score, Step, Wiggle
from teo_sign_authoring.signwriting.beats import (
    OTHER_HAND,
    Beat,
    HandMovements,
    Stance,
    beats_of,
    circle_spots,
    sorted_movements,
)
from teo_sign_authoring.signwriting.hand_symbols import (
    SIDES,
    Side,
    direction_words,
    displacement_words,
    handshape_of,
)
from teo_sign_authoring.signwriting.hands import WrittenHands, read_hands
from teo_sign_authoring.signwriting.movement import Circling, Hands, Movement, is_finger_movement, movement_of
from teo_sign_authoring.signwriting.place import read_landmarks
from teo_sign_authoring.signwriting.stances import are_mirrored, read_contacts, read_stances
from teo_sign_authoring.signwriting.written_sign import (
    ALTERNATING,
    EARS,
    EVERY_OTHER_TIME,
    FAST,
    HANDS,
    HEAD_MOVEMENTS,
    HEAD_RIM,
    HEADS,
    LIMBS,
    MOVEMENTS,
    NOSE,
    SLOW,
    Symbol,
    UnreadableError,
    read_fsw,
    symbols_of,
)

# [deg] A nod and a turn that are seen; TEO bows by 10 at most.
_BOW, _TURN = 8.0, 25.0
_STRAIGHT, _FLOOR_STRAIGHT, _CURVE, _FLOOR_CURVE = 0x301, 0x303, 0x304, 0x305


def _head_postures(symbols: tuple[Symbol, ...]) -> tuple[list[tuple[float, float]], tuple[str, ...]]:
    """Turns and bows of the head, one after the other [deg], and what of its movements TEO cannot make.

    A turn is to the right, a bow forward. With fill 0 the movement is made once, with 1 twice.
    """
    postures: list[tuple[float, float]] = []
    losses: list[str] = []
    for symbol in symbols_of(symbols, HEAD_MOVEMENTS):
        posture = _posture(symbol)
        if posture is None:
            losses.append(f"{symbol.key}, {symbol.name}: TEO's head turns and bows only")
        else:
            postures += [posture, (0.0, 0.0)] * (1 + min(symbol.fill, 2))
    return postures, tuple(losses)


def _posture(symbol: Symbol) -> tuple[float, float] | None:
    if symbol.rotation in (0, 4) and symbol.base in (_STRAIGHT, _FLOOR_STRAIGHT):
        up = symbol.rotation == 0
        forward = up if symbol.base == _FLOOR_STRAIGHT else not up
        return 0.0, _BOW if forward else -_BOW
    if symbol.rotation in (2, 6) and symbol.base in (_FLOOR_STRAIGHT, _CURVE, _FLOOR_CURVE):
        return (_TURN if symbol.rotation == 6 else -_TURN), 0.0
    return None


def _face_words(symbols: tuple[Symbol, ...]) -> str:
    """What the face does, by the names of its symbols."""
    bare = {0x2FF, HEAD_RIM, EARS, *HEAD_MOVEMENTS, *NOSE, 0x33B, 0x36A}
    names = [symbol.name for symbol in symbols_of(symbols, HEADS) if symbol.base not in bare]
    return ", ".join(dict.fromkeys(names))


# SignWriting gives no durations. Measured signs move at about half a metre a second, and no movement takes
# less than 0.2 s; symbols of dynamics are a third faster or two thirds slower than that.
_SPEED, _LEAST_TIME = 50.0, 0.2  # [cm/s], [s]
_FAST, _SLOW = 0.67, 1.67
# [s] A touch is held so long, and so is the end of a sign.
_TOUCH_HOLD, _LAST_HOLD = 0.1, 0.25
# [s] Once to and fro, of fingers, wrist or forearm; and [deg] by how much.
_SWING_TIME, _SWINGS = 0.35, {"fingers": 30.0, "wrist": 25.0, "forearm": 40.0}
# [s] A round of a circle.
_ROUND_TIME = 0.6
# Planes of circles in the axes of a hand's score (front, in, up), by their normals: clockwise is from the
# first vector to the second.
_CIRCLE_PLANES: tuple[tuple[Literal["front", "side", "top"], Array, Array], ...] = (
    ("front", np.array([0.0, 0.0, 1.0]), np.array([0.0, -1.0, 0.0])),
    ("side", np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])),
    ("top", np.array([1.0, 0.0, 0.0]), np.array([0.0, -1.0, 0.0])),
)
# [cm] Shapes of robot and hand are that rough: nearer hands would go into what they touch.
TOUCHING = 1.0
# [cm] Hands are as mirrors at one place if they are nearer.
_SAME_PLACE = 5.0


@dataclass(frozen=True, kw_only=True)
class Compilation:
    """A sign as a score.

    Attributes:
        score: The score.
        losses: What of the writing it does not show, a sentence each; empty if it shows all.
    """

    score: Score
    losses: tuple[str, ...]


def compile_fsw(gloss: str, fsw: str, *, source: str, gap: float = TOUCHING) -> Compilation:
    """Compile a sign.

    Args:
        gloss: Its name.
        fsw: The sign in Formal SignWriting.
        source: What the score names as its source.
        gap: How far a hand stays off what it touches [cm].

    Raises:
        LutError: "bad_fsw", "unknown_symbol".
        UnreadableError: "movement", "movement_order", "order", "handshape", "no_hand", "too_many_hands",
            "limb", "posture".
    """
    symbols = read_fsw(fsw)
    hands = read_hands(symbols_of(symbols, HANDS), _arrows(symbols))
    movements = _read_movements(symbols, hands)
    landmarks = read_landmarks(symbols)
    contacts, losses = read_contacts(symbols, hands, landmarks)
    face = _face_words(symbols)
    turns, head_losses = _head_postures(symbols)
    losses += (*_handshape_losses(symbols), *_limb_losses(symbols, hands), *head_losses)
    if face:
        losses += (f"TEO has no face: {face}",)
    stances = read_stances(hands, contacts, landmarks, gap)
    alternating = any(symbol.base in (ALTERNATING, EVERY_OTHER_TIME) for symbol in symbols)
    main: Side = "right" if hands.right else "left"
    moves = {side: _moves_of(side, hands, movements) for side in SIDES if hands.of(side)}
    for each in moves.values():
        losses += each.losses
    for contact in contacts:
        # A hand that rubs is drawn without an arrow where it goes round on the spot.
        if contact.slides and not any(each.ways for each in moves.values()):
            key, name = contact.symbol.key, contact.symbol.name
            losses += (f"{key}, {name}: no arrow says which way, TEO's hand touches only",)
    rights = beats_of(stances[0] if main == "right" else stances[1], moves[main], main)
    lefts: list[Beat] = []
    if hands.right and hands.left:
        opposite = alternating and moves["left"].ways != ()
        lefts = beats_of(stances[1], moves["left"], "left", opposite=opposite)
    losses += _spot_losses(rights, lefts, stances[0])
    if gap > TOUCHING:
        losses += (f"TEO's hands stay {gap:g} cm off what they touch: they would go into it",)
    pace = _pace(symbols)
    mirrored = bool(lefts) and are_mirrored(hands) and not alternating and _alike(rights, lefts)
    steps = _steps(rights, [] if mirrored else lefts, pace)
    steps = _with_head(steps, turns)
    written: Score
    try:
        written = Score(
            gloss=gloss,
            kind="lexical",
            standing="described",
            source=source,
            face=face,
            notes="; ".join(dict.fromkeys(losses)),
            hands="mirrored" if mirrored else "both" if lefts else "right",
            steps=list(steps),
            forms=None,
        )
    except ValidationError as error:
        raise UnreadableError("posture", error.errors()[0]["msg"].removeprefix("Value error, ")) from error
    return Compilation(score=written, losses=tuple(dict.fromkeys(losses)))


def _arrows(symbols: tuple[Symbol, ...]) -> tuple[Movement, ...]:
    found = (movement_of(symbol) for symbol in symbols_of(symbols, MOVEMENTS))
    return tuple(movement for movement in found if movement is not None)


def _read_movements(symbols: tuple[Symbol, ...], hands: WrittenHands) -> tuple[Movement, ...]:
    """All movements, those of fingers given to the hand they stand beside.

    Raises:
        UnreadableError: "movement" for a symbol that is not read.
    """
    movements: list[Movement] = []
    for symbol in symbols_of(symbols, MOVEMENTS):
        movement = movement_of(symbol)
        if movement is None:
            raise UnreadableError("movement", f"{symbol.key}, {symbol.name}: a movement that is not read")
        if is_finger_movement(symbol) and hands.right and hands.left:
            movement = replace(movement, hands=_nearer_hand(symbol, hands))
        movements.append(movement)
    return tuple(movements)


def _nearer_hand(symbol: Symbol, hands: WrittenHands) -> Hands:
    far = {side: min(hand.symbol.distance(symbol.middle) for hand in hands.of(side)) for side in SIDES}
    if abs(far["right"] - far["left"]) < 3.0:
        return "both"
    return min(far, key=lambda side: far[side])


def _moves_of(side: Side, hands: WrittenHands, movements: tuple[Movement, ...]) -> HandMovements:
    other = hands.of("left" if side == "right" else "right")
    own = tuple(movement for movement in movements if not other or movement.hands in (side, "both"))
    return sorted_movements(own, hands.of(side)[0])


def _handshape_losses(symbols: tuple[Symbol, ...]) -> tuple[str, ...]:
    losses = []
    for symbol in symbols_of(symbols, HANDS):
        shape = handshape_of(symbol.base)
        if shape is not None and shape.loss:
            losses.append(f"{symbol.key}, {symbol.name}: TEO's hand does not show {shape.loss}")
    return tuple(losses)


def _limb_losses(symbols: tuple[Symbol, ...], hands: WrittenHands) -> tuple[str, ...]:
    limbs = symbols_of(symbols, LIMBS)
    if limbs and not (hands.right and hands.left):
        raise UnreadableError("limb", f"{limbs[0].key}, {limbs[0].name}: an arm without its hand")
    return tuple(f"{symbol.key}, {symbol.name}: the forearm goes where TEO's arm has it" for symbol in limbs)


def _spot_losses(rights: list[Beat], lefts: list[Beat], stances: tuple[Stance, ...]) -> tuple[str, ...]:
    if lefts and stances and rights[0].spot.name in OTHER_HAND and any(beat.circle for beat in lefts):
        return ("the left hand's circle is followed by the right hand that is on it",)
    return ()


def _pace(symbols: tuple[Symbol, ...]) -> float:
    bases = {symbol.base for symbol in symbols}
    return _FAST if FAST in bases else _SLOW if SLOW in bases else 1.0


def _alike(rights: list[Beat], lefts: list[Beat]) -> bool:
    """Whether the left hand does what the right one does, as its mirror."""
    return len(rights) == len(lefts) and all(
        right.spot.distance(left.spot) <= _SAME_PLACE
        and right.shape == left.shape
        and _same_circle(right.circle, left.circle)
        and right.swing == left.swing
        for right, left in zip(rights, lefts, strict=True)
    )


def _same_circle(one: Circling | None, other: Circling | None) -> bool:
    if one is None or other is None:
        return one is other
    return bool(np.allclose(one.first, other.first) and np.allclose(one.then, other.then))


def _steps(rights: list[Beat], lefts: list[Beat], pace: float) -> list[Step]:
    """The beats of both hands as steps; a hand that has no more beats stays."""
    if lefts:
        rights, lefts = _spelled_out(rights), _spelled_out(lefts)
    steps: list[Step] = []
    before: tuple[Beat | None, Beat | None] = (None, None)
    for right, left in zip_longest(rights, lefts):
        right, left = right or before[0], left or before[1]
        assert right is not None
        time = max(
            (_time(old, new) for old, new in ((before[0], right), (before[1], left)) if old and new),
            default=0.3,
        )
        arc = None if lefts or right.arc is None else displacement_words(right.arc) or None
        touches = right.touches or (left is not None and left.touches)
        swing = right.swing or (left.swing if left else None)
        both_swing = left is None or (right.swing is not None and left.swing is not None)
        steps.append(
            Step(
                time=round(pace * time, 2),
                right=_changes(before[0], right),
                left=None if left is None else _changes(before[1], left),
                arc=arc,
                hold=_TOUCH_HOLD if touches else 0.0,
                circle=_circle(right, pace) if right.circle is not None and not lefts else None,
                wiggle=None
                if swing is None
                else Wiggle(
                    joint=swing.joint,
                    angle=_SWINGS[swing.joint],
                    times=swing.times,
                    time=round(pace * _SWING_TIME * swing.times, 2),
                    hand=None if both_swing else "right" if right.swing else "left",
                ),
            )
        )
        before = (right, left)
    return [*steps[:-1], steps[-1].model_copy(update={"hold": _LAST_HOLD})]


def _time(old: Beat, new: Beat) -> float:
    return max(_LEAST_TIME, old.spot.distance(new.spot) / _SPEED)


def _spelled_out(beats: list[Beat]) -> list[Beat]:
    """Beats with their arcs and circles as postures: of two hands that do not mirror each other."""
    spelled = [replace(beats[0], circle=None, arc=None), *_circle_beats(beats[0])]
    for before, beat in pairwise(beats):
        if beat.arc is not None and beat.spot.name == before.spot.name:
            middle = before.spot.moved((beat.spot.offset - before.spot.offset) / 2.0 + beat.arc)
            spelled.append(replace(beat, spot=middle, arc=None, touches=False, circle=None, swing=None))
        spelled += [replace(beat, arc=None, circle=None), *_circle_beats(beat)]
    return spelled


def _circle_beats(beat: Beat) -> list[Beat]:
    if beat.circle is None:
        return []
    return [replace(beat, spot=spot, circle=None, swing=None, arc=None) for spot in circle_spots(beat)]


def _circle(beat: Beat, pace: float) -> Circle | None:
    """A beat's circle as a score has it: its plane, and which way round.

    Raises:
        UnreadableError: "movement" if it lies aslant.
    """
    assert beat.circle is not None
    first, then = beat.circle.first, beat.circle.then
    normal = np.abs(np.cross(first, then))
    index = int(np.argmax(normal))
    radius = float(np.linalg.norm(first))
    if normal[index] < 0.9 * radius**2:
        raise UnreadableError("movement", "a circle that lies aslant")
    plane, one, other = _CIRCLE_PLANES[index]
    clockwise = float((first @ one) * (then @ other) - (first @ other) * (then @ one)) > 0.0
    return Circle(
        plane=plane,
        radius=round(radius, 1),
        turns=beat.circle.turns,
        start=direction_words(first),
        clockwise=clockwise,
        time=round(pace * _ROUND_TIME * beat.circle.turns, 2),
        hand=None,
    )


def _changes(before: Beat | None, beat: Beat) -> HandScore | None:
    """What is new of a hand since the posture before; None if nothing is."""
    now = _written(beat)
    if before is None:
        return HandScore.model_validate(now)
    old = _written(before)
    if now["palm"] != old["palm"]:
        old.pop("fingers")  # the two are said together
    new = {name: value for name, value in now.items() if old.get(name) != value}
    return HandScore.model_validate(new) if new else None


def _written(beat: Beat) -> dict[str, str]:
    return {
        "shape": beat.shape,
        "place": beat.spot.words,
        "part": beat.part,
        "palm": direction_words(beat.orientation.palm),
        "fingers": direction_words(beat.orientation.fingers),
    }


def _with_head(steps: list[Step], postures: list[tuple[float, float]]) -> list[Step]:
    """The head's postures laid over the hands', the last ones added at the end."""
    moved = []
    for step, posture in zip_longest(steps, postures):
        head = None if posture is None else HeadScore(turn=posture[0], bow=posture[1])
        moved.append(
            Step.model_validate({"time": 0.25, "head": head})
            if step is None
            else step.model_copy(update={"head": head})
        )
    return moved
