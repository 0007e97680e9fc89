# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What `lut import --signwriting` makes of a dictionary, and whether a lexical database says the same of it.

ASL-LEX 2.0 (Sehyr and others, Journal of Deaf Studies and Deaf Education 26, 2021; CC BY-NC 4.0) codes
handshape and major location of 2,723 American signs. It is read where the user has it, `signdata-*.csv`, and
no sign is made from it. A word has several signs, and an entry may be another one than the coded.
"""

from __future__ import annotations

import csv
import json
import random
import re
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from report import Figure, share, spread
from teo_sign_authoring.notation.score_schema import Step
from teo_sign_authoring.signwriting.compiler import compile_fsw
from teo_sign_capture.signing_space import OTHER_HAND
from teo_signs.look_up_table import Lut

# What each handshape of the project is in ASL-LEX. It has no ILY and no 7.
_SHAPES = {
    "index": "1 flat_1 d g",
    "hook": "bent_1 curved_1 flat_1",
    "two": "h v r k p flat_h flat_v flat_n",
    "bent_two": "bent_v curved_v curved_h flat_h flat_v flat_n",
    "thumb_two": "3 open_h k p",
    "two_flick": "flat_n",
    "four": "4 closed_b curved_4 flat_4",
    "open": "5 4 stacked_5 open_b",
    "claw": "curved_5 flatspread_5 stacked_5 curved_4 flat_4 spread_e spread_open_e open_e e closed_e",
    "bent": "flat_b flatspread_5 flat_m flat_4",
    "flat": "open_b closed_b",
    "cupped": "c o flat_b curved_5 flatspread_5",
    "bunched": "o flat_o e open_e flat_m",
    "three": "w flat_m",
    "little": "i",
    "thumb_little": "y",
    "horns": "horns flat_horns",
    "middle_flick": "8 open_8",
    "ring": "f open_f d",
    "l": "l bent_l curved_l g",
    "pinch": "baby_o g bent_l curved_l",
    "thumb": "a",
    "fist": "s a t e closed_e",
}
# ASL-LEX's major locations of the project's places; all others are in the air. The wrist ends the arm.
_LOCATIONS = {
    "Head": "head_top forehead temple eye nose ear cheek mouth mouth_corner chin throat "
    "face_space beside_head",
    "Body": "shoulder other_shoulder upper_chest chest other_chest belly",
    "Hand": " ".join(OTHER_HAND),
    "Arm": "other_wrist",
}


class _Begin(NamedTuple):
    """How a sign begins: the handshape of the right hand and its place."""

    shape: str
    place: str


def measure(report: str = "", lut: str = "", asllex: str = "") -> Iterator[Figure]:
    """Figures of an import into `lut` with `report`; compared with ASL-LEX's table if it is given."""
    outcomes = json.loads(Path(report).read_text("utf-8"))
    results = Counter(each["result"] for each in outcomes)
    tried = [each for each in outcomes if each["result"] != "skipped"]
    made = [each for each in tried if each["result"] != "refused"]
    yield Figure(f"compiled, of {len(tried)} signs", share(len(made), len(tried)))
    yield Figure("of them with losses; skipped", f"{results['with_losses']}; {results['skipped']}")
    refused = Counter(each["code"] for each in tried if each["result"] == "refused")
    yield Figure("refused", ", ".join(f"{count} {code}" for code, count in refused.most_common()))
    qualities = [sign.quality for sign in Lut.open(lut, language="ase").values()]
    for name, unit in (
        ("place_error_mm", "mm"),
        ("palm_angle_error_deg", "°"),
        ("finger_angle_error_deg", "°"),
    ):
        yield Figure(name, spread([quality[name] for quality in qualities], unit))
    near = sum(
        quality["place_error_mm"] <= 50.0
        and max(quality["palm_angle_error_deg"], quality["finger_angle_error_deg"]) <= 45.0
        for quality in qualities
    )
    yield Figure("within 50 mm and 45° of what is written", share(near, len(qualities)))
    if asllex:
        yield from _compared(made, Path(asllex))


def _compared(made: Sequence[dict[str, Any]], file: Path) -> Iterator[Figure]:
    coded: dict[str, list[dict[str, str]]] = defaultdict(list)
    with file.open(encoding="utf-8-sig", newline="") as lines:
        for row in csv.DictReader(lines):
            coded[_word(row["EntryID"])].append(row)
    pairs = [
        (_begin(each["gloss"], each["fsw"]), coded[word])
        for each in made
        if (word := _word(each["gloss"])) in coded
    ]
    others = [rows for _, rows in pairs]
    random.Random(1).shuffle(others)
    by_chance = [(begin, rows) for (begin, _), rows in zip(pairs, others, strict=True)]
    for what, agrees in (("handshape", _same_shape), ("place", _same_place), ("both", _same)):
        found, chance = (
            sum(any(agrees(begin, row) for row in rows) for begin, rows in each)
            for each in (pairs, by_chance)
        )
        yield Figure(
            f"{what} as ASL-LEX has it, of {len(pairs)} entries; of other words",
            f"{share(found, len(pairs))}; {100 * chance / len(pairs):.0f} %",
        )
    missed = Counter(
        f"{row['Handshape.2.0']} as {begin.shape}"
        for begin, rows in pairs
        for row in rows[:1]
        if not any(_same_shape(begin, each) for each in rows)
    )
    yield Figure("handshapes most often another", ", ".join(f"{n} {m}" for m, n in missed.most_common(6)))


def _word(name: str) -> str:
    """A word without the number of its variant."""
    return re.sub(r"_\d+$", "", name.lower())


def _begin(gloss: str, fsw: str) -> _Begin:
    step = compile_fsw(gloss, fsw, source=gloss).score.steps[0]
    assert isinstance(step, Step), "the first step is no repetition"
    hand = step.right
    assert hand is not None and hand.shape is not None and hand.place is not None
    return _Begin(hand.shape, hand.place.split()[0])


def _same_shape(begin: _Begin, row: dict[str, str]) -> bool:
    return row["Handshape.2.0"] in _SHAPES.get(begin.shape, "").split()


def _same_place(begin: _Begin, row: dict[str, str]) -> bool:
    found = [location for location, places in _LOCATIONS.items() if begin.place in places.split()]
    return row["MajorLocation.2.0"] in (found or ["Neutral"])


def _same(begin: _Begin, row: dict[str, str]) -> bool:
    return _same_shape(begin, row) and _same_place(begin, row)
