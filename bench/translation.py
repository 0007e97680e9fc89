"""How well and how fast Spanish is translated: our models, the trivial baseline and a peer, side by side.

The 39 pairs of the paper as published, and typed without accents and marks; generated sentences of words and
constructions that training never saw; sentences written apart from the generator (test/data/README.md). A
translation counts where it is the expected one gloss by gloss, or one that is accepted. Spelled words count
as the word that they spell.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import time
from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from gloss_baselines import lemmas_in_spanish_order, spoken_to_signed
from report import Figure, percentiles

from teo_sign_translator.corpus.accepted_translations import accepts, plain_gloss
from teo_sign_translator.corpus.generator import Generator
from teo_sign_translator.corpus.paper_pairs import gloss_name, paper_pairs
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.pipeline.translator import Translator
from teo_sign_translator.pointer.examples import without_accents
from teo_sign_translator.pointer.metrics import score
from teo_sign_translator.resources import data_file

Glosses = tuple[str, ...]
System = Callable[[str], Glosses]

HELD_OUT = 1000
"""Most sentences of each held-out part."""
_GENERATED = 30_000
"""Pairs to generate: some hundreds of each part are among them."""
_TIMED = 500
_SENTENCES = Path(__file__).parents[1] / "test" / "data"


def measure() -> list[Figure]:
    """All figures, a row for each set of sentences."""
    systems: dict[str, System] = {
        "ours": _ours(Translator.load()),
        "paper's": _ours(Translator.load("lstm256")),
        "lemmas": lemmas_in_spanish_order,
        "spoken-to-signed": spoken_to_signed,
    }
    return [*_paper(systems), *_held_out(systems), *_everyday(systems), *_speed()]


def _ours(translator: Translator) -> System:
    def translate(sentence: str) -> Glosses:
        try:
            return tuple(str(translator.translate(sentence)).split())
        except TranslationError as error:
            return (f"[{error.code}]",)

    return translate


def _paper(systems: dict[str, System]) -> Iterable[Figure]:
    pairs = [(pair.sentence, tuple(map(gloss_name, pair.glosses))) for pair in paper_pairs()]
    for what, typed in (("as published", str), ("no accents, no marks, no capitals", _carelessly)):
        right = {
            name: sum(_same(system(typed(spanish)), wanted) for spanish, wanted in pairs)
            for name, system in systems.items()
        }
        yield Figure(f"the paper's {len(pairs)} pairs, {what}: exact", _row(right))


def _held_out(systems: dict[str, System]) -> Iterable[Figure]:
    parts: defaultdict[str, list[tuple[str, Glosses]]] = defaultdict(list)
    generator = Generator.load(data_file("grammar"), Morphology.load())
    for pair in generator.pairs(_GENERATED, seed=2):
        if pair.split.startswith("test") and len(parts[pair.split]) < HELD_OUT:
            parts[pair.split].append((pair.spanish, pair.glosses))
    for part, pairs in sorted(parts.items()):
        expected = [_plain(wanted) for _, wanted in pairs]
        scores = {
            name: score(expected, [_plain(system(spanish)) for spanish, _ in pairs])
            for name, system in systems.items()
        }
        what = f"generated, {part}, {len(pairs)} sentences"
        yield Figure(f"{what}: exact [%]", _row({name: f"{100 * s.exact:.1f}" for name, s in scores.items()}))
        bleu = {name: f"{s.bleu:.1f}" for name, s in scores.items()}
        yield Figure(f"{what}: sacreBLEU (tokenize none)", _row(bleu))


def _everyday(systems: dict[str, System]) -> Iterable[Figure]:
    for file in sorted(_SENTENCES.glob("*.txt")):
        sentences, patterns = _lines(file.name), _lines(f"{file.stem}.glosses")
        pairs = list(zip(sentences, patterns, strict=True))
        right = {
            name: sum(accepts(pattern, system(sentence)) for sentence, pattern in pairs)
            for name, system in systems.items()
        }
        yield Figure(f"{len(pairs)} {file.stem} sentences: accepted", _row(right))


def _lines(file: str) -> list[str]:
    return (_SENTENCES / file).read_text(encoding="utf-8").splitlines()


def _row(values: Mapping[str, object]) -> str:
    return ", ".join(f"{name} {value}" for name, value in values.items())


def _same(got: Glosses, wanted: Glosses) -> bool:
    return _plain(got) == _plain(wanted)


def _plain(words: Glosses) -> Glosses:
    return tuple(map(plain_gloss, words))


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
    sentences = _lines("everyday.txt")
    times = []
    for index in range(_TIMED + 20):
        begun = time.perf_counter()
        translator.translate("¿Dónde vive tu hermana?" if index % 2 else "Mañana no puedo ir al cine.")
        times.append(time.perf_counter() - begun)
    begun = time.perf_counter()
    translator.translate_all(sentences * 20)
    per_second = len(sentences) * 20 / (time.perf_counter() - begun)
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return [
        percentiles("translate a short sentence, one core", times[20:]),
        Figure("translate a file, one core", f"{per_second:.0f} sentences a second"),
        Figure("load the translator; most memory", f"{loaded:.2f} s; {memory:.0f} MB"),
    ]


if __name__ == "__main__":
    print(json.dumps(_measure_speed()))
