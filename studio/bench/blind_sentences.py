# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How many of the blind sentences are translated as accepted: measured once for each model that is released.

`python bench/blind_sentences.py` shows the sentences to the shipped model and the baselines and keeps the
figures, not the translations, in test/data/blind.json, by the hash of the model's weights. A model that is
there is not run again: what is looked at twice is known.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from statistics import median
from typing import Any

from glosses.measures import fewest_edits
from glosses.systems import SENTENCES, judged, systems
from report import Figure, share
from teo_sign_translator.model_files import models_directory

_RECORD = SENTENCES / "blind.json"
_SENTENCES = SENTENCES / "blind.txt"


def figures() -> Iterable[Figure]:
    """What was measured of the shipped model."""
    if not _SENTENCES.is_file():
        yield Figure("blind sentences", "used up: test/data/README.md says who writes new ones")
        return
    results = _recorded().get(_shipped())
    if results is None:
        yield Figure("blind sentences", "not measured for this model: python bench/blind_sentences.py")
        return
    total = results["sentences"]
    counts = [len(accepted) for _, accepted in judged("blind")]
    what = f"{total} blind sentences"
    accepts = f"accepted for each: median {median(counts):.0f}, most {max(counts)}"
    right = ", ".join(f"{name} {share(each['accepted'], total)}" for name, each in results["systems"].items())
    yield Figure(f"{what}: accepted (95 % interval), {accepts}", right)
    edits = ", ".join(f"{name} {each['gloss_errors']:.1f}" for name, each in results["systems"].items())
    yield Figure(f"{what}: glosses to edit for the nearest accepted translation [%]", edits)


def main() -> None:
    """Measure the shipped model, unless it has been.

    Raises:
        SystemExit: It has been measured, or there are no sentences.
    """
    if not _SENTENCES.is_file():
        raise SystemExit(f"expected blind sentences in {_SENTENCES}, got no such file: they are used up")
    record = _recorded()
    if _shipped() in record:
        raise SystemExit(f"the shipped model has seen the blind sentences: its figures are in {_RECORD}")
    sentences = judged("blind")
    results: dict[str, Any] = {"sentences": len(sentences), "systems": {}}
    for name, system in systems().items():
        got = [system(sentence) for sentence, _ in sentences]
        right = sum(each in accepted for each, (_, accepted) in zip(got, sentences, strict=True))
        edits = [fewest_edits(accepted, each) for each, (_, accepted) in zip(got, sentences, strict=True)]
        wrong, glosses = (sum(column) for column in zip(*edits, strict=True))
        results["systems"][name] = {"accepted": right, "gloss_errors": round(100 * wrong / glosses, 1)}
    record[_shipped()] = results
    _RECORD.write_text(json.dumps(record, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    for figure in figures():
        print(f"{figure.what}: {figure.value}")


def _recorded() -> dict[str, Any]:
    record: dict[str, Any] = json.loads(_RECORD.read_text(encoding="utf-8")) if _RECORD.is_file() else {}
    return record


def _shipped() -> str:
    """The hash of the shipped model's weights."""
    return hashlib.sha256((models_directory() / "pointer.safetensors").read_bytes()).hexdigest()


if __name__ == "__main__":
    main()
