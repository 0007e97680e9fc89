# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The default language on the default robot stays what it was, byte for byte, whatever is made general.

`test/data/ssp_tokens.tsv` holds sentences and what they gave before languages became data, and the table's
hash is of that day. A better model or sign changes them on purpose: take over what the failure shows.
"""

from __future__ import annotations

import hashlib
from pathlib import Path

from teo_sign_translator import Translator
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import motion_hash

TOKENS = Path(__file__).parent / "data" / "ssp_tokens.tsv"
MOTIONS = "d6c6141d4408b5dad6af1a4074db732e5b64f0851a5aac381c0efd4958fc20ba"


def test_sentences_give_the_same_tokens() -> None:
    recorded = dict(line.split("\t") for line in TOKENS.read_text("utf-8").splitlines())
    signs = frozenset(Lut.open(default_lut_directory()))
    answers = Translator.load().translate_all(list(recorded), signs)
    assert dict(zip(recorded, map(str, answers), strict=True)) == recorded


def test_signs_are_the_same_motions() -> None:
    signs = Lut.open(default_lut_directory()).items()
    hashed = "".join(f"{gloss} {motion_hash(sign)}\n" for gloss, sign in signs)
    assert hashlib.sha256(hashed.encode()).hexdigest() == MOTIONS
