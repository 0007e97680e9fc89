# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How many of the blind sentences are translated as accepted: measured once for each model that is released.

Run alone, it shows the blind sentences of a language to its shipped model and to the baselines, unless that
model has seen them. Figures, not translations, are kept in test/data/blind.json by the hash of the model's
weights, and printed from then on: what is looked at twice is known.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from statistics import median
from typing import Any

from glosses.measures import Glosses, fewest_edits, overlap
from glosses.systems import SENTENCES, Judged, System, judged, sentence_set, translating
from report import Figure, share
from teo_sign_languages import DEFAULT_LANGUAGE, load_language

_RECORD = SENTENCES / "blind.json"
LANGUAGES = (DEFAULT_LANGUAGE, "ase")


def measure(language: str = DEFAULT_LANGUAGE) -> list[Figure]:
    """Figures of a language's shipped model, measured now if it has not seen the sentences."""
    record = _recorded()
    kept = record.setdefault(language, {})
    if _weights(language) not in kept and _there(language):
        kept[_weights(language)] = _measured(judged("blind", language), translating(language))
        _RECORD.write_text(json.dumps(record, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    return list(figures(language))


def figures(language: str) -> Iterator[Figure]:
    """What was measured of a language's shipped model."""
    what = f"{language}, blind sentences"
    results = _recorded().get(language, {}).get(_weights(language))
    if results is None:
        command = f"make bench BENCH='blind_sentences --language {language}'"
        done = command if _there(language) else "they are used up"
        yield Figure(what, f"not measured for this model: {done}")
        return
    total, by_system = results["sentences"], results["systems"]
    right = ", ".join(f"{name} {share(each['accepted'], total)}" for name, each in by_system.items())
    accepts = f"accepted for each: median {results['median']}, most {results['most']}"
    yield Figure(f"{total} {what}: accepted (95 % interval), {accepts}", right)
    edits = ", ".join(f"{name} {each['edits']:.1f}" for name, each in by_system.items())
    yield Figure(f"{what}: glosses to edit for the nearest accepted translation, of 100", edits)
    bags = [
        f"{name} {each['precision']:.1f}, {each['recall']:.1f}"
        for name, each in by_system.items()
        if "precision" in each
    ]
    if bags:
        yield Figure(f"{what}: bag precision, recall [%]", ", ".join(bags))


def _there(language: str) -> bool:
    """Whether a language has blind sentences, and not all have been looked at."""
    return sentence_set("blind", language).with_suffix(".txt").is_file()


def _measured(sentences: Judged, every: Mapping[str, System]) -> dict[str, Any]:
    counts = [len(accepted) for _, accepted in sentences]
    results: dict[str, Any] = {
        "sentences": len(sentences),
        "median": round(median(counts)),
        "most": max(counts),
        "systems": {},
    }
    for name, system in every.items():
        got = [system(sentence) for sentence, _ in sentences]
        pairs = [(accepted, each) for (_, accepted), each in zip(sentences, got, strict=True)]
        wrong, glosses = (
            sum(column) for column in zip(*(fewest_edits(*pair) for pair in pairs), strict=True)
        )
        common = overlap([_nearest(*pair) for pair in pairs], got)
        results["systems"][name] = {
            "accepted": sum(each in accepted for accepted, each in pairs),
            "edits": round(100 * wrong / glosses, 1),
            "precision": round(100 * common.precision, 1),
            "recall": round(100 * common.recall, 1),
            "pairs": common.pairs,
            "in_order": round(100 * common.in_order, 1),
        }
    return results


def _nearest(translations: frozenset[Glosses], got: Glosses) -> Glosses:
    """The translation that asks for the fewest edits; of equals the first in the alphabet."""
    return min(sorted(translations), key=lambda each: fewest_edits([each], got)[0])


def _recorded() -> dict[str, Any]:
    record: dict[str, Any] = json.loads(_RECORD.read_text(encoding="utf-8"))
    return record


def _weights(language: str) -> str:
    """The hash of the shipped model's weights."""
    weights = load_language(language).models / "pointer.safetensors"
    return hashlib.sha256(weights.read_bytes()).hexdigest()
