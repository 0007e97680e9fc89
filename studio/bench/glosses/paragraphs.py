# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentences of texts, each as it stands there: are they as accepted, and in how many signs?

A line of test/data/paragraphs.glosses says which text its sentence belongs to, then its translations there.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

from glosses.accepted_translations import accepted
from glosses.measures import Glosses, fewest_edits
from glosses.systems import lemmas_in_spanish_order, lines, plain
from report import Figure, share
from teo_sign_translator.output.translation import Sentence, printed
from teo_sign_translator.pipeline.translator import Translator

_SET = "paragraphs"


def measure() -> Iterator[Figure]:
    """Of each sentence within its text, of the same alone, and of its dictionary forms."""
    translator = Translator.load()
    texts: defaultdict[str, list[tuple[str, frozenset[Glosses]]]] = defaultdict(list)
    for sentence, row in zip(lines(f"{_SET}.txt"), lines(f"{_SET}.glosses"), strict=True):
        text, pattern = row.split("\t")
        texts[text].append((sentence, accepted(pattern)))
    every = [each for text in texts.values() for each in text]
    alone = [_signed(translator.translate(sentence).sentences) for sentence, _ in every]
    within = [
        signed
        for text in texts.values()
        for signed in _within(translator, [sentence for sentence, _ in text])
    ]
    words = [plain(lemmas_in_spanish_order(sentence)) for sentence, _ in every]
    what = f"{len(every)} sentences of {len(texts)} texts"
    for name, said in (("within their text", within), ("alone", alone), ("dictionary forms", words)):
        answers = list(zip(said, (translations for _, translations in every), strict=True))
        right = sum(glosses in translations for glosses, translations in answers)
        edits = [fewest_edits(translations, glosses) for glosses, translations in answers]
        wrong, glosses = (sum(column) for column in zip(*edits, strict=True))
        yield Figure(f"{what}, {name}: as accepted", share(right, len(every)))
        yield Figure(
            f"{what}, {name}: glosses to edit, of 100; signs", f"{100 * wrong / glosses:.1f}; {_count(said)}"
        )


def _within(translator: Translator, text: list[str]) -> Iterator[Glosses]:
    """The glosses of each sentence of a text that is translated as a whole."""
    said = list(translator.translate(" ".join(text)).sentences)
    for sentence in text:
        size = len(translator.translate(sentence).sentences)
        yield _signed(said[:size])
        del said[:size]
    assert not said, text


def _signed(sentences: tuple[Sentence, ...] | list[Sentence]) -> Glosses:
    return plain(tuple(" ".join(printed(sentence.tokens) for sentence in sentences).split()))


def _count(said: list[Glosses]) -> int:
    return sum(map(len, said))
