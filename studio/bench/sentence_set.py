# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How many sentences of one set are translated as accepted, and what became of the others.

`--name known --language ase` is test/data/ase/known.txt with known.glosses beside it. Blind sentences are
shown to a model by the bench `blind_sentences` alone.
"""

from __future__ import annotations

from collections.abc import Iterator

from glosses.systems import judged, right_shares, translating
from report import Figure
from teo_sign_languages import DEFAULT_LANGUAGE


def measure(name: str = "known", language: str = DEFAULT_LANGUAGE, wrong: int = 0) -> Iterator[Figure]:
    """The share that each system has right, then so many sentences that our model has wrong."""
    sentences = judged(name, language)
    every = translating(language)
    for system, right in right_shares(every, sentences).items():
        yield Figure(f"{len(sentences)} sentences of {name} ({language}), {system}", right)
    for sentence, accepted in sentences:
        said = every["ours"](sentence)
        if wrong and said not in accepted:
            wrong -= 1
            yield Figure(sentence, " ".join(said))
