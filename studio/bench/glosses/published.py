# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How near a language's model comes to published glosses, and to sentences held out of its grammar.

`python bench/glosses/published.py CODE` shows a language's blind published sentences to its shipped model and
to the trivial baseline, once: the figures are kept in `test/data/published.json` by the hash of the model's
weights, and a model that is there is refused. `figures` gives what is kept, and measures what needs no
keeping: sentences that are generated anew, and known ones.
"""

from __future__ import annotations

import hashlib
import json
import re
import sys
from collections import defaultdict
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

sys.path.insert(0, str(Path(__file__).parents[1]))

import simplemma

from glosses.accepted_translations import accepted, plain_gloss
from glosses.measures import Glosses, fewest_edits, overlap
from report import Figure, share
from teo_sign_languages import Language, available_languages, load_language
from teo_sign_training.corpus import Pair
from teo_sign_training.corpus.generator import Generator
from teo_sign_training.fitting.metrics import score
from teo_sign_translator.data_files import read_rows
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.pipeline.translator import Translator

#: Of a language's text folder: sentence, accepted glosses, `blind` or `known`, and where it is published.
FILE = "published_sentences.tsv"
_RECORD = Path(__file__).parents[3] / "test" / "data" / "published.json"
# Pairs to generate: about 300 of each held-out part are among them.
_GENERATED = 15_000
# What the trivial baseline leaves out: articles, copulas, "do", prepositions of place, "and".
_STOP_WORDS = frozenset(["the", "a", "an", "be", "do", "to", "in", "at", "on", "of", "and"])


class Published(NamedTuple):
    """A sentence whose translation somebody else has published.

    Attributes:
        sentence: In the spoken language.
        accepted: Its translations, each as its glosses' `plain_gloss`.
        status: "blind", or "known" for one that was looked at while the grammar was written.
        source: Where it is published.
    """

    sentence: str
    accepted: frozenset[Glosses]
    status: str
    source: str


def published(language: Language) -> list[Published]:
    """The published sentences of a language; none if it has no such file."""
    path = language.text / FILE
    if not path.is_file():
        return []
    return [
        Published(sentence, accepted(pattern), status, source)
        for _, (sentence, pattern, status, source) in read_rows(path, columns=4)
    ]


def figures() -> Iterable[Figure]:
    """For each language that has published sentences: what is held out, known and blind."""
    for code in available_languages():
        language = load_language(code)
        rows = published(language)
        if rows:
            yield from _held_out(language)
            yield from _known(language, [row for row in rows if row.status == "known"])
            yield from _blind(language)


def _held_out(language: Language) -> Iterable[Figure]:
    translate = _ours(language)
    parts: defaultdict[str, list[Pair]] = defaultdict(list)
    generator = Generator.load(language.text / "grammar", Morphology.load(language.text))
    for pair in generator.pairs(_GENERATED, seed=2):
        if pair.split.startswith("test"):
            parts[pair.split].append(pair)
    for part, pairs in sorted(parts.items()):
        expected = [tuple(map(plain_gloss, pair.glosses)) for pair in pairs]
        got = score(expected, [translate(pair.text) for pair in pairs])
        base = score(expected, [_baseline(pair.text) for pair in pairs])
        yield Figure(
            f"{language.code}, generated, {part}, {len(pairs)} sentences: exact; sacreBLEU",
            f"ours {share(round(got.exact * got.count), got.count)}; {got.bleu:.1f}, "
            f"lemmas {share(round(base.exact * base.count), base.count)}; {base.bleu:.1f}",
        )


def _known(language: Language, rows: Sequence[Published]) -> Iterable[Figure]:
    if rows:
        yield from _shown(f"{language.code}, published, known", _measured(language, rows))


def _blind(language: Language) -> Iterable[Figure]:
    kept = _recorded().get(language.code, {}).get(_weights(language))
    if kept is None:
        command = f"python bench/glosses/published.py {language.code}"
        yield Figure(f"{language.code}, published, blind", f"not measured for this model: {command}")
        return
    yield from _shown(f"{language.code}, published, blind", kept)


def _shown(what: str, results: dict[str, Any]) -> Iterable[Figure]:
    systems = results["systems"]
    right = ", ".join(
        f"{name} {share(each['accepted'], results['sentences'])}" for name, each in systems.items()
    )
    yield Figure(f"{what}, {results['sentences']} sentences: as published (95 % interval)", right)
    edits = ", ".join(f"{name} {each['edits']:.1f}" for name, each in systems.items())
    yield Figure(f"{what}: glosses to edit, of 100", edits)
    bags = ", ".join(
        f"{name} {each['precision']:.1f}, {each['recall']:.1f}" for name, each in systems.items()
    )
    yield Figure(f"{what}: bag precision, recall [%]", bags)
    order = ", ".join(f"{name} {each['in_order']:.0f} of {each['pairs']}" for name, each in systems.items())
    yield Figure(f"{what}: pairs of common glosses in the published order [%]", order)


def _measured(language: Language, rows: Sequence[Published]) -> dict[str, Any]:
    systems = {"ours": _ours(language), "lemmas": _baseline}
    results: dict[str, Any] = {"sentences": len(rows), "systems": {}}
    for name, system in systems.items():
        got = [system(row.sentence) for row in rows]
        edits = [fewest_edits(row.accepted, each) for row, each in zip(rows, got, strict=True)]
        wrong, glosses = (sum(column) for column in zip(*edits, strict=True))
        nearest = [_nearest(row.accepted, each) for row, each in zip(rows, got, strict=True)]
        common = overlap(nearest, got)
        results["systems"][name] = {
            "accepted": sum(each in row.accepted for row, each in zip(rows, got, strict=True)),
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


def _ours(language: Language) -> Any:
    translator = Translator.load(language=language.code)

    def translate(sentence: str) -> Glosses:
        try:
            return tuple(map(plain_gloss, str(translator.translate(sentence)).split()))
        except TranslationError as error:
            return (f"[{error.code}]",)

    return translate


def _baseline(sentence: str) -> Glosses:
    """Every word's lemma where it stands, stop words dropped."""
    words = re.findall(r"\w+", sentence.replace("'", ""))
    lemmas = (simplemma.lemmatize(word, lang="en").lower() for word in words)
    return tuple(plain_gloss("me" if each == "i" else each) for each in lemmas if each not in _STOP_WORDS)


def _recorded() -> dict[str, Any]:
    record: dict[str, Any] = json.loads(_RECORD.read_text(encoding="utf-8")) if _RECORD.is_file() else {}
    return record


def _weights(language: Language) -> str:
    return hashlib.sha256((language.models / "pointer.safetensors").read_bytes()).hexdigest()


def main() -> None:
    """Measure the shipped model of the language that is named on the blind sentences, unless it has been.

    Raises:
        SystemExit: It has been measured, or there are no such sentences.
    """
    language = load_language(sys.argv[1])
    rows = [row for row in published(language) if row.status == "blind"]
    record = _recorded()
    if not rows or _weights(language) in record.get(language.code, {}):
        raise SystemExit(
            f"expected blind sentences that the shipped model has not seen, got {len(rows)} in all"
        )
    record.setdefault(language.code, {})[_weights(language)] = _measured(language, rows)
    _RECORD.write_text(json.dumps(record, indent=2) + "\n", encoding="utf-8")
    for figure in _blind(language):
        print(f"{figure.what}: {figure.value}")


if __name__ == "__main__":
    main()
