# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What one hand does: postures one after the other, as steps of a score will have them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from teo_common.arrays import Array
from teo_sign_authoring.notation.score_schema import Part
from teo_sign_authoring.signwriting.hand_symbols import (
    CLOSED,
    OPENED,
    Orientation,
    Side,
    displacement_words,
    for_hand,
)
from teo_sign_authoring.signwriting.hands import WrittenHand
from teo_sign_authoring.signwriting.movement import (
    Circling,
    Closing,
    Movement,
    Path,
    Segment,
    Swinging,
    Turning,
)
from teo_sign_authoring.signwriting.written_sign import UnreadableError
from teo_sign_capture.signing_space import OTHER_HAND as OTHER_HAND_NAMES
from teo_sign_capture.signing_space import split_place, written_place

# [cm] A hand that only touches comes from so far and goes back as far between two touches.
_APPROACH = 6.0
# [cm] What a bent wrist moves the middle of the hand: TEO's bends sideways only, its arm makes it.
_WRIST_WAY = 5.0
# [px] Arrows of one hand that are about as far from it have no order.
_ORDER = 4.0
# [cm] A hand that goes aside from what it touched also goes off it.
_LEAVES = 3.0
# Cosine between a way and the way to what is touched from which on the hand comes to it.
_COMES = 0.3
_EIGHTHS = 8

OTHER_HAND = frozenset(OTHER_HAND_NAMES)


@dataclass(frozen=True, kw_only=True)
class Spot:
    """A place of articulation and a displacement from it.

    Attributes:
        name: One of `places.NAMES`.
        offset: Front, in, up [cm]. Shape (3,).
    """

    name: str
    offset: Array

    @classmethod
    def read(cls, words: str) -> Spot:
        """From words: "cheek 12 in"."""
        name, offset = split_place(words)
        return cls(name=name, offset=100.0 * offset)

    def moved(self, way: Array) -> Spot:
        """The spot that way from here [cm]."""
        return replace(self, offset=self.offset + way)

    @property
    def words(self) -> str:
        """As a score has it."""
        return f"{self.name} {displacement_words(self.offset)}".strip()

    def distance(self, other: Spot) -> float:
        """From one spot to another [cm]; `_APPROACH` where one is on the other hand and one is not."""
        if self.name == other.name:
            return float(np.linalg.norm(self.offset - other.offset))
        if OTHER_HAND & {self.name, other.name}:
            return _APPROACH
        between = 100.0 * (written_place(self.name).point - written_place(other.name).point)
        return float(np.linalg.norm(between + self.offset - other.offset))


@dataclass(frozen=True, kw_only=True)
class Beat:
    """A posture of one hand and how it comes there.

    Attributes:
        spot: Where the hand is.
        part: Which part of it.
        shape: Its handshape.
        orientation: How it is held.
        arc: How far the way here swings out: front, in, up [cm]; None for straight. Shape (3,).
        circle: A circle made from here; None for none.
        swing: A joint that goes to and fro here; None for none.
        touches: Whether the hand meets something here.
    """

    spot: Spot
    part: Part
    shape: str
    orientation: Orientation
    arc: Array | None = None
    circle: Circling | None = None
    swing: Swinging | None = None
    touches: bool = False


@dataclass(frozen=True, kw_only=True)
class Stance:
    """Where a drawing of a hand is.

    Attributes:
        hand: The drawing.
        spot: Its place.
        part: The part of the hand that is there.
        towards: Where what it touches lies; None if it touches nothing. Shape (3,).
        times: How often it touches.
        slides: Whether it stays in touch while it moves.
        free: Whether the place is only about where the sign is made, not where it begins.
    """

    hand: WrittenHand
    spot: Spot
    part: Part
    towards: Array | None = None
    times: int = 1
    slides: bool = False
    free: bool = False

    def beat(self, spot: Spot | None = None, **changes: object) -> Beat:
        """The posture of the drawing, here or at another spot."""
        beat = Beat(
            spot=spot or self.spot,
            part=self.part,
            shape=self.hand.shape,
            orientation=self.hand.orientation,
            touches=spot is None and self.towards is not None,
        )
        return replace(beat, **changes)  # type: ignore[arg-type]  # fields of Beat


@dataclass(frozen=True, kw_only=True)
class HandMovements:
    """What one hand does, sorted by kind."""

    ways: tuple[Movement, ...]
    closing: Closing | None
    swing: Swinging | None
    turns: bool
    losses: tuple[str, ...] = field(default=())


def sorted_movements(movements: tuple[Movement, ...], first: WrittenHand) -> HandMovements:
    """A hand's movements by kind, ways in their order.

    Raises:
        UnreadableError: "movement_order", "movement" where movements do not go together.
    """
    ways = [movement for movement in movements if isinstance(movement.kind, (Path, Circling))]
    merged: list[Movement] = []
    for movement in ways:
        same = next((index for index, other in enumerate(merged) if _same(movement, other)), None)
        if same is None:
            merged.append(movement)
        elif isinstance(movement.kind, Path):
            kind = merged[same].kind
            assert isinstance(kind, Path)
            merged[same] = replace(merged[same], kind=replace(kind, times=kind.times + movement.kind.times))
    if len(merged) > 2:
        raise UnreadableError("movement_order", f"{len(merged)} ways of one hand: expected at most two")
    if len(merged) == 2:
        far = [movement.symbol.distance(first.symbol.middle) for movement in merged]
        if abs(far[0] - far[1]) < _ORDER:
            keys = " and ".join(movement.symbol.key for movement in merged)
            raise UnreadableError("movement_order", f"{keys}: nothing says which is first")
        merged = [merged[index] for index in np.argsort(far).tolist()]
    closings = {movement.kind for movement in movements if isinstance(movement.kind, Closing)}
    swings = {movement.kind for movement in movements if isinstance(movement.kind, Swinging)}
    if len(closings) > 1 or len(swings) > 1:
        raise UnreadableError("movement", "several movements of the fingers or the forearm of one hand")
    losses = tuple(
        f"{movement.symbol.key}, {movement.symbol.name}: TEO's arm makes what the wrist does"
        for movement in merged
        if isinstance(movement.kind, Path) and movement.kind.bent_wrist
    )
    return HandMovements(
        ways=tuple(merged),
        closing=next(iter(closings), None),
        swing=next(iter(swings), None),
        turns=any(isinstance(movement.kind, Turning) for movement in movements),
        losses=losses,
    )


def _same(one: Movement, other: Movement) -> bool:
    if isinstance(one.kind, Path) and isinstance(other.kind, Path):
        same_symbol = (one.symbol.base, one.symbol.rotation) == (other.symbol.base, other.symbol.rotation)
        return same_symbol and not one.kind.to_and_fro
    return False


def beats_of(
    stances: tuple[Stance, ...], moves: HandMovements, side: Side, *, opposite: bool = False
) -> list[Beat]:
    """The postures of one hand.

    Args:
        stances: Its one or two drawings.
        moves: What it does.
        side: Which hand it is.
        opposite: Whether it begins where the other hand turns back: hands that move by turns.

    Raises:
        UnreadableError: "movement" if one turn of the forearm has no end that is drawn.
    """
    if moves.turns and len(stances) == 1:
        raise UnreadableError("movement", "a turn of the forearm whose end is not drawn")
    beats = list(_ways(stances, moves, side, opposite))
    if moves.closing is not None and len(stances) == 1:
        beats = _with_closing(beats, moves.closing)
    if moves.swing is not None:
        beats[-1] = replace(beats[-1], swing=moves.swing)
    return beats


def _ways(stances: tuple[Stance, ...], moves: HandMovements, side: Side, opposite: bool) -> Iterator[Beat]:
    first, last = stances[0], stances[-1]
    if not moves.ways:
        yield from _without_way(stances)
        return
    reached: Spot | None = None
    for movement in moves.ways:
        if isinstance(movement.kind, Circling):
            circle = _for_hand_circle(movement.kind, side, opposite)
            begins = first.spot.moved(circle.first) if reached is None else reached
            yield replace(last.beat(begins), circle=circle, touches=first.towards is not None)
            reached = begins
            continue
        assert isinstance(movement.kind, Path), "ways are paths and circles"
        path = _for_hand(movement.kind, side)
        start = _start(first, last, path) if reached is None else reached
        for beat in _path_beats(stances, path, start, opposite, begins=reached is None):
            yield beat
            reached = beat.spot


def _without_way(stances: tuple[Stance, ...]) -> Iterator[Beat]:
    first = stances[0]
    if len(stances) == 2:
        second = stances[1]
        # Without an arrow a hand that is drawn twice stays where it is, unless it touches in both.
        moves = first.towards is not None and second.towards is not None
        yield first.beat()
        yield second.beat() if moves else replace(second.beat(first.spot), touches=first.towards is not None)
        return
    if first.towards is None:
        yield first.beat()
        return
    away = first.spot.moved(-_APPROACH * first.towards)
    for _ in range(first.times):
        yield first.beat(away)
        yield first.beat()


def _start(first: Stance, last: Stance, path: Path) -> Spot:
    """Where a way begins: at the hand, or so that it ends there if it comes to what the hand touches."""
    way = path.way
    if last is not first and last.towards is not None and first.towards is None:
        return last.spot.moved(-way)
    if first.towards is not None and last is first:
        length = float(np.linalg.norm(way))
        if length > 0.0 and float(way @ first.towards) / length > _COMES:
            return first.spot.moved(-way)
    if first.free and path.times == 1:
        return first.spot.moved(-way / 2.0)
    return first.spot


def _path_beats(
    stances: tuple[Stance, ...], path: Path, start: Spot, opposite: bool, *, begins: bool
) -> Iterator[Beat]:
    first, last = stances[0], stances[-1]
    way = path.way
    end = start.moved(way)
    if first.towards is not None and not first.slides and start is first.spot:
        end = end.moved(-_LEAVES * first.towards)
    if last.towards is not None and last is not first:
        end = last.spot
    there = [
        last.beat(spot, arc=segment.bulge if segment.bulge.any() else None)
        for spot, segment in zip(_corners(start, end, path.segments), path.segments, strict=True)
    ]
    back = replace(first.beat(start), arc=None)
    at_start = first.towards is not None and start.words == first.spot.words
    at_end = last.towards is not None and end.words == last.spot.words
    there[-1] = replace(there[-1], touches=at_end)
    back = replace(back, touches=at_start)
    if opposite and path.to_and_fro:
        there, back = [back], there[-1]
    if begins:
        yield back
    for index in range(path.times):
        if path.to_and_fro:
            yield from there if index % 2 == 0 else [back]
        else:
            if index:
                yield back
            yield from there


def _corners(start: Spot, end: Spot, segments: tuple[Segment, ...]) -> list[Spot]:
    """Where each segment ends; the last at the end."""
    spots = [start]
    for segment in segments[:-1]:
        spots.append(spots[-1].moved(segment.way))
    return [*spots[1:], end]


def _for_hand(path: Path, side: Side) -> Path:
    segments = path.segments
    if path.bent_wrist:
        scale = _WRIST_WAY / max(float(np.linalg.norm(path.way)), 1e-9)
        segments = tuple(Segment(way=scale * each.way, bulge=scale * each.bulge) for each in segments)
    return replace(
        path,
        segments=tuple(
            Segment(way=for_hand(each.way, side), bulge=for_hand(each.bulge, side)) for each in segments
        ),
    )


def _for_hand_circle(circle: Circling, side: Side, opposite: bool) -> Circling:
    sign = -1.0 if opposite else 1.0
    return replace(circle, first=sign * for_hand(circle.first, side), then=sign * for_hand(circle.then, side))


def circle_spots(beat: Beat) -> list[Spot]:
    """The circle of a beat as eight spots a turn."""
    assert beat.circle is not None
    middle = beat.spot.moved(-beat.circle.first)
    count = round(_EIGHTHS * beat.circle.turns)
    angles = 2.0 * np.pi * np.arange(1, count + 1) / _EIGHTHS
    return [
        middle.moved(np.cos(angle) * beat.circle.first + np.sin(angle) * beat.circle.then) for angle in angles
    ]


def _with_closing(beats: list[Beat], closing: Closing) -> list[Beat]:
    """A hand that opens or closes on its way, or where it is."""
    drawn = beats[0].shape
    change, back = (OPENED, CLOSED) if closing.opens else (CLOSED, OPENED)
    after = change.get(drawn)
    if after is None or (not closing.opens and drawn in ("fist", "bunched", "pinch", "two_flick", "ring")):
        # The hand is drawn as it is in the end.
        if drawn not in back:
            raise UnreadableError("movement", f"{drawn}: TEO has no handshape that it opens or closes from")
        before, after = back[drawn], drawn
    else:
        before = drawn
    if len(beats) == 1:
        beats = [beats[0], beats[0]]
    changed = [replace(beat, shape=before) for beat in beats[:-1]] + [replace(beats[-1], shape=after)]
    for _ in range(closing.times - 1):
        changed += [replace(changed[-1], shape=before, arc=None), replace(changed[-1], arc=None)]
    return changed
