# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How much of what people say has a sign: words signed, sentences without a spelled word, seconds a sentence.

Three ways of looking words up in the package's table, in the same run: a word's lemma by its name alone,
what the translator says without substitutes, and with them.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Sequence, Set
from statistics import median

import wordfreq

from glosses.annotated_signs import read_annotated
from glosses.systems import SENTENCES, lemmas_in_spanish_order, lines
from report import Figure
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import PeakTorque, peak_torques
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.morphology.readings import tag_class
from teo_sign_translator.output.output_words import lexical
from teo_sign_translator.output.sign_choice import SignChooser, SubstituteLists, Substitutes
from teo_sign_translator.output.sign_coverage import Coverage, Showing
from teo_sign_translator.output.translation import Kind as OutputKind
from teo_sign_translator.output.translation import Sentence
from teo_sign_translator.pipeline.translator import Translator
from teo_signs.errors import PlanError
from teo_signs.lexicon import DEFAULT_STANDING
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign_schema import STANDINGS
from teo_signs.tokens import Kind, Token

LEMMAS = 2_000
# Forms that hold the first lemmas, each of which has a handful of frequent forms.
_FORMS = 20_000
_CONTENT = ("N", "A", "V", "ADV")
# Verbs that LSE leaves out.
_UNSIGNED = {"ser", "estar", "haber"}


def measure(every: int = 1) -> list[Figure]:
    """Figures of the package's table, by every so manieth sentence.

    They are counts alone, so that blind sentences stay unseen.
    """
    signs = founded_signs()
    known = lines("known.txt")[::every]
    # None while the blind sentences are used up (test/data/README.md).
    blind = lines("blind.txt")[::every] if (SENTENCES / "blind.txt").is_file() else []
    stories = sorted({each.spanish for each in read_annotated(SENTENCES / "radis" / "narratives.tsv")})[
        ::every
    ]
    figures = [
        *_texts(f"{len(known)} known sentences", known, signs),
        *(_texts(f"{len(blind)} blind sentences", blind, signs) if blind else ()),
        *_texts(f"{len(stories)} sentences of two stories (RADIS)", stories, signs),
        _frequent_lemmas(signs),
    ]
    return [*figures, *_seconds(known, signs)]


def founded_signs() -> frozenset[str]:
    """Glosses of the package's table whose signs the executor makes by default."""
    founded = STANDINGS[: STANDINGS.index(DEFAULT_STANDING) + 1]
    return frozenset(
        gloss
        for gloss, sign in Lut.open(default_lut_directory()).items()
        if sign.kind == "lexical" and sign.provenance.standing in founded
    )


def covered(texts: Sequence[str], signs: Set[str], substitutes: Substitutes) -> Coverage:
    """What of some texts has signs."""
    translator = Translator.load(substitutes=substitutes)
    counted, guesses = Coverage(), frozenset(Lut.open(default_lut_directory())) - signs
    for answer in translator.translate_all(texts, signs):
        if not isinstance(answer, TranslationError):
            counted.add(answer, guesses)
    return counted


def _texts(what: str, texts: Sequence[str], signs: Set[str]) -> list[Figure]:
    lemmas = [lemma for text in texts for lemma in lemmas_in_spanish_order(text)]
    looked_up = sum(lemma in signs or lemma.isdecimal() for lemma in lemmas)
    by_substitutes = {allowed: covered(texts, signs, allowed) for allowed in Substitutes}
    steps = ", ".join(
        f"with {allowed.name.lower()} {_share(counted.signed, counted.words)}"
        for allowed, counted in by_substitutes.items()
    )
    ours = by_substitutes[Substitutes.PARAPHRASE]
    spanish = sum(len(re.findall(r"\w+", text)) for text in texts)
    return [
        Figure(f"{what}: words signed", f"lemmas by name {_share(looked_up, len(lemmas))}; ours: {steps}"),
        Figure(
            f"{what}: without a spelled word but names",
            f"{_share(ours.whole, ours.sentences)} of {ours.sentences}",
        ),
        Figure(
            f"{what}: how the words are shown",
            ", ".join(f"{showing} {_share(ours.showings[showing], ours.words)}" for showing in Showing),
        ),
        Figure(f"{what}: output words for each Spanish word", f"{ours.words / spanish:.2f}"),
    ]


def _frequent_lemmas(signs: Set[str]) -> Figure:
    """Share of running text, of the content words whose lemma is among the most frequent of Spanish."""
    morphology = Morphology.load()
    chooser = SignChooser(SubstituteLists.load(), morphology)
    frequency: defaultdict[str, float] = defaultdict(float)
    for form in wordfreq.top_n_list("es", _FORMS):
        readings = morphology.readings(form)
        lemma = readings[0].lemma
        if tag_class(readings[0].tag) in _CONTENT and lemma not in _UNSIGNED:
            frequency[lemma] += wordfreq.word_frequency(form, "es")
    first = dict(Counter(frequency).most_common(LEMMAS))
    shown: Counter[str] = Counter()
    types: Counter[str] = Counter()
    for lemma, share in first.items():
        word = lexical(lemma.upper(), (lemma,), 1.0)
        way = "named" if lemma.upper() in signs else "letters"
        if way == "letters" and chooser.choose([word], signs)[0].kind is OutputKind.LEXICAL:
            way = "substituted"
        shown[way] += share
        types[way] += 1
    total = sum(first.values())
    by_name, by_other, spelled = (_share(shown[way], total) for way in ("named", "substituted", "letters"))
    return Figure(
        f"general Spanish: running content words of the {len(first)} most frequent lemmas (wordfreq)",
        f"signed by name {by_name} ({types['named']} lemmas), by another sign {by_other} "
        f"({types['substituted']}), spelled {spelled}",
    )


def _seconds(texts: Sequence[str], signs: Set[str]) -> list[Figure]:
    """How long TEO signs a sentence, and how much of that time it spells."""
    robot = Robot.load()
    planner = Planner(Lut.open(default_lut_directory()), robot=robot, max_duration=1e4)
    translator = Translator.load()
    seconds, peaks, spelling, total, refused = [], [], 0.0, 0.0, 0
    for answer in translator.translate_all(texts, signs):
        if isinstance(answer, TranslationError):
            continue
        for sentence in answer.sentences:
            try:
                plan = planner.plan(tokens_of(sentence))
            except PlanError:
                refused += 1
                continue
            seconds.append(plan.duration)
            peaks.append(peak_torques(plan, robot)[0])
            total += plan.duration
            ends = [0.0, *(token.start + token.duration for token in plan.timings)]
            spelling += sum(
                end - before
                for token, before, end in zip(plan.timings, ends, ends[1:], strict=False)
                if token.token.kind is Kind.LETTER
            )
    return [
        Figure(
            f"{len(seconds)} known sentences signed",
            f"median {median(seconds):.1f} s; letters and the ways to them {_share(spelling, total)}"
            + (f"; {refused} refused" if refused else ""),
        ),
        _torque(peaks),
    ]


def _torque(peaks: Sequence[PeakTorque]) -> Figure:
    """How near the joint that is loaded most is to its effort limit, which is a placeholder."""
    most = max(peaks, key=lambda peak: peak.share)
    return Figure(
        "most torque in them, over the effort limit of the URDF (a placeholder)",
        f"median {100.0 * median(peak.share for peak in peaks):.0f} %, most {100.0 * most.share:.0f} % "
        f"({most.torque:.1f} N m, {most.joint})",
    )


def tokens_of(sentence: Sentence) -> list[Token]:
    """A translated sentence as the executor takes it."""
    return [
        Token(
            gloss=token.gloss,
            kind=Kind(int(token.kind)),
            word_index=token.word_index,
            inflection=token.inflection,
        )
        for token in sentence.tokens
    ]


def _share(part: float, total: float) -> str:
    return f"{100 * part / total:.0f} %"
