# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How well and how fast Spanish is translated: our model, the paper's, a trivial baseline and a peer.

The sets, from the easiest to the hardest, are those of test/data/README.md: pairs that were taught, sentences
that are known, generated ones of which something was held out of training, blind ones, and those of a
signer. A translation counts where it is the expected one gloss by gloss, or one that is accepted; a spelled
word counts as the word that it spells.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import time
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from statistics import median

import blind_sentences
from glosses.annotated_signs import read_annotated
from glosses.measures import overlap
from glosses.systems import SENTENCES, System, judged, lines, plain, right_shares, systems
from report import Figure, percentiles, share
from teo_common.text_folding import without_accents
from teo_sign_training.corpus import Pair
from teo_sign_training.corpus.generator import Generator
from teo_sign_training.corpus.paper_pairs import paper_pairs
from teo_sign_training.fitting.metrics import score
from teo_sign_translator.data_files import data_file
from teo_sign_translator.morphology import Morphology, gloss_name
from teo_sign_translator.pipeline.translator import Translator

# Pairs to generate: 300 to 600 of each held-out part are among them.
_GENERATED = 30_000
_TIMED = 500
# Where the translator's README has a model trained that was not taught the held-out constructions.
_WITHOUT_CONSTRUCTIONS = Path(__file__).parents[2] / "out" / "held_out_constructions"
_DIGITS = {"UNO": "1", "DOS": "2", "TRES": "3", "CUATRO": "4", "CINCO": "5", "SEIS": "6", "SIETE": "7"}
_PARTS = {
    "test_words": "words never seen",
    "test_templates": "rule and predicate never seen together",
    "test_both": "neither seen",
    "test_constructions": "constructions never seen, by a model trained without them",
}


def measure(every: int = 1) -> list[Figure]:
    """All figures, a row for each set of sentences, by every so manieth sentence of the larger ones."""
    translators = systems()
    return [
        *_taught(translators),
        *_known(translators, every),
        *_held_out(translators, every),
        *_constructions(every),
        *(figure for language in blind_sentences.LANGUAGES for figure in blind_sentences.figures(language)),
        *_signed(translators),
        *_speed(),
    ]


def _taught(systems: Mapping[str, System]) -> Iterable[Figure]:
    """The paper's pairs, which both models are trained on; our search prefers the taught translation."""
    pairs = [(pair.sentence, plain(tuple(map(gloss_name, pair.glosses)))) for pair in paper_pairs()]
    for what, typed in (("as published", str), ("no accents, no marks, no capitals", _carelessly)):
        right = {
            name: sum(system(typed(spanish)) == wanted for spanish, wanted in pairs)
            for name, system in systems.items()
        }
        yield Figure(f"training pairs: the paper's {len(pairs)}, {what}: exact", _row(right))


def _known(systems: Mapping[str, System], every: int) -> Iterable[Figure]:
    sentences = judged("known")[::every]
    counts = [len(accepted) for _, accepted in sentences]
    right = right_shares(systems, sentences)
    accepts = f"accepted for each: median {median(counts):.0f}, most {max(counts)}"
    yield Figure(f"{len(sentences)} known sentences: accepted (95 % interval), {accepts}", _row(right))


def _held_out(systems: Mapping[str, System], every: int) -> Iterable[Figure]:
    parts = _generated(_GENERATED // every, hold_out_constructions=False)
    for part, pairs in sorted(parts.items()):
        yield from _exact(part, pairs, systems)


def _constructions(every: int) -> Iterable[Figure]:
    """Of a model that was trained without them, if there is one."""
    what = f"generated, {_PARTS['test_constructions']}"
    if not (_WITHOUT_CONSTRUCTIONS / "pointer.safetensors").is_file():
        yield Figure(what, "not measured: train that model first, see the translator's README")
        return
    pairs = _generated(_GENERATED // every, hold_out_constructions=True)["test_constructions"]
    others = systems(Translator.load(directory=_WITHOUT_CONSTRUCTIONS))
    yield from _exact("test_constructions", pairs, others)
    for construction, names in _generator().grammar.constructions.items():
        own = [pair for pair in pairs if _says(pair.rule, names)]
        right = sum(others["ours"](pair.text) == plain(pair.glosses) for pair in own)
        yield Figure(
            f"of these, {construction.replace('_', ' ')}: exact of {len(own)}", share(right, len(own))
        )


def _says(template: str, names: Iterable[str]) -> bool:
    """Whether a template is of a family or a rule, or has an alternative of a category (`vp.better_than`)."""
    alternatives = template.split(".")[2:]
    return any(
        f"{template}.".startswith(f"{name}.") or name.partition(".")[2] in alternatives for name in names
    )


@cache
def _generator() -> Generator:
    return Generator.load(data_file("grammar"), Morphology.load())


def _generated(count: int, *, hold_out_constructions: bool) -> Mapping[str, list[Pair]]:
    """Sentences of each part that training has not seen, of so many that are generated, by split."""
    parts: defaultdict[str, list[Pair]] = defaultdict(list)
    for pair in _generator().pairs(count, seed=2, hold_out_constructions=hold_out_constructions):
        if pair.split.startswith("test"):
            parts[pair.split].append(pair)
    return parts


def _exact(part: str, pairs: Sequence[Pair], systems: Mapping[str, System]) -> Iterable[Figure]:
    expected = [plain(pair.glosses) for pair in pairs]
    scores = {
        name: score(expected, [system(pair.text) for pair in pairs]) for name, system in systems.items()
    }
    what = f"generated, {_PARTS[part]}, {len(pairs)} sentences"
    right = {name: share(round(each.exact * each.count), each.count) for name, each in scores.items()}
    yield Figure(f"{what}: exact (95 % interval)", _row(right))
    bleu = {name: f"{each.bleu:.1f}" for name, each in scores.items()}
    yield Figure(f"{what}: sacreBLEU (tokenize none)", _row(bleu))


def _signed(systems: Mapping[str, System]) -> Iterable[Figure]:
    """Two stories that a person signed; what shows or points has no word, and is in no system's reach."""
    sentences = read_annotated(SENTENCES / "radis" / "narratives.tsv")
    worded = [
        (sentence.spanish, _in_digits(plain(sentence.signs))) for sentence in sentences if sentence.signs
    ]
    signed = [signs for _, signs in worded]
    found = {
        name: overlap(signed, [_in_digits(system(spanish)) for spanish, _ in worded])
        for name, system in systems.items()
    }
    what = (
        f"real pairs, {len(worded)} of {len(sentences)} sentences with {sum(map(len, signed))} worded signs"
    )
    precision = {name: f"{100 * each.precision:.1f}, {100 * each.recall:.1f}" for name, each in found.items()}
    yield Figure(f"{what}: bag precision, recall [%]", _row(precision))
    order = {name: f"{100 * each.in_order:.0f} % of {each.pairs}" for name, each in found.items()}
    yield Figure(f"{what}: pairs of common signs in the signer's order", _row(order))


def _in_digits(glosses: Sequence[str]) -> tuple[str, ...]:
    """Glosses with the numbers that annotators write in words as our translators write them."""
    return tuple(_DIGITS.get(gloss, gloss) for gloss in glosses)


def _row(values: Mapping[str, object]) -> str:
    return ", ".join(f"{name} {value}" for name, value in values.items())


def _carelessly(sentence: str) -> str:
    return "".join(c for c in without_accents(sentence.lower()) if c.isalnum() or c == " ")


def _speed() -> list[Figure]:
    """Latency, batch, start-up and memory, in a process of its own that is kept to one core."""
    env = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run([sys.executable, __file__], env=env, capture_output=True, text=True, check=True)
    return [Figure(what, value) for what, value in json.loads(done.stdout)]


def _measure_speed() -> list[Figure]:
    started = time.perf_counter()
    translator = Translator.load()
    loaded = time.perf_counter() - started
    sentences = lines("known.txt")
    times = []
    for index in range(_TIMED + 20):
        begun = time.perf_counter()
        translator.translate("¿Dónde vive tu hermana?" if index % 2 else "Mañana no puedo ir al cine.")
        times.append(time.perf_counter() - begun)
    begun = time.perf_counter()
    translator.translate_all(sentences * 4)
    per_second = len(sentences) * 4 / (time.perf_counter() - begun)
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return [
        percentiles("translate a short sentence, one core", times[20:]),
        Figure("translate a file, one core", f"{per_second:.0f} sentences a second"),
        Figure("load the translator; most memory", f"{loaded:.2f} s; {memory:.0f} MB"),
    ]


if __name__ == "__main__":
    print(json.dumps(_measure_speed()))
