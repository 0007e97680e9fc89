# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Makes corpora: pairs by the hundred thousand, the same ones for the same seed."""

from __future__ import annotations

from bisect import bisect
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
from pathlib import Path
from random import Random

from teo_common.text_folding import folded
from teo_sign_training.corpus.derivation import Chooser, Derivation, GeneratedSentence
from teo_sign_training.corpus.grammar import LEXICAL, Grammar, Template, templates
from teo_sign_training.corpus.grammar_file import load_grammar
from teo_sign_training.corpus.pairs import Pair
from teo_sign_training.corpus.phrases import NoFillerError
from teo_sign_training.corpus.words import WordLists, is_held_out
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology

#: Share of each split.
SHARES = {"train": 0.93, "dev": 0.02, "test_words": 0.02, "test_templates": 0.02, "test_both": 0.01}
#: Share of the sentences in constructions that training was made without, beside the splits of `SHARES`.
_CONSTRUCTIONS_SHARE = 0.02
#: No template gives more than this share of the pairs.
LARGEST_SHARE = 0.03
#: A template that gives nothing new this often in a row has given all it has.
_EXHAUSTED_AFTER = 60
#: Longest sentence [words and marks].
_LONGEST = 24


@dataclass
class Generator:
    """A grammar with its words, the held-out ones named, ready to make pairs."""

    grammar: Grammar
    words: WordLists

    @classmethod
    def load(cls, grammar_folder: Path, morphology: Morphology) -> Generator:
        """Read a grammar, and the word lists of the `lexicon` folder beside it.

        Raises:
            TranslationError: "invalid_grammar" or "invalid_data".
        """
        grammar = load_grammar(grammar_folder)
        unknown = sorted(grammar.held_out - {template.name for template in templates(grammar)})
        if unknown:
            raise TranslationError(
                "invalid_grammar", f"{grammar_folder}: held_out: expected names of templates, got {unknown}"
            )
        words = WordLists.load(grammar_folder, morphology, grammar)
        words.held_out = _held_out_words(grammar, words)
        return cls(grammar, words)

    @cached_property
    def _held_forms(self) -> frozenset[str]:
        """Held-out words as they stand inside a sentence."""
        return frozenset(word.lower() for word in self.words.held_out)

    def pairs(
        self,
        count: int,
        seed: int,
        leave_out: Iterable[str] = (),
        *,
        hold_out_constructions: bool = False,
    ) -> Iterator[Pair]:
        """Yield pairs, split by split: different sentences, but for the set phrases that train repeats.

        Args:
            count: About how many; a little fewer if the grammar has no more.
            seed: The same seed gives the same pairs.
            leave_out: Sentences that must not occur, in whatever accents, marks, capitals and spaces.
            hold_out_constructions: Whether the grammar's `constructions` occur in a split of their own alone.
        """
        grammar = self.grammar.without_constructions() if hold_out_constructions else self.grammar
        every = templates(grammar)
        seen_templates = [each for each in every if each.name not in grammar.held_out]
        new_templates = [each for each in every if each.name in grammar.held_out]
        seen = _Seen(leave_out)
        for index, (split, share) in enumerate(SHARES.items()):
            chosen = new_templates if split in ("test_templates", "test_both") else seen_templates
            if chosen:
                random = Random(seed * len(SHARES) + index)
                held = split in ("test_words", "test_both")
                derivation = Derivation(grammar, self.words, Chooser(random, held))
                yield from self._split(
                    split, round(count * share), chosen, derivation, random, seen, held=held
                )
        if hold_out_constructions:
            kept = {each.name for each in every}
            chosen = [each for each in templates(self.grammar) if each.name not in kept]
            random = Random(seed * len(SHARES) + len(SHARES))
            derivation = Derivation(self.grammar, self.words, Chooser(random))
            size = round(count * _CONSTRUCTIONS_SHARE)
            yield from self._split("test_constructions", size, chosen, derivation, random, seen, held=False)

    def _split(
        self,
        split: str,
        count: int,
        chosen: list[Template],
        derivation: Derivation,
        random: Random,
        seen: _Seen,
        *,
        held: bool,
    ) -> Iterator[Pair]:
        left = list(chosen)
        made = [0] * len(chosen)
        places = list(range(len(chosen)))
        largest = max(int(LARGEST_SHARE * count), 1) if len(chosen) * LARGEST_SHARE > 1 else count
        total = 0
        while total < count and left:
            bounds = list(accumulate(template.weight for template in left))
            spent: int | None = None
            while total < count and spent is None:
                place = bisect(bounds, random.random() * bounds[-1])
                sentence = self._new(derivation, left[place], seen, split, held=held)
                if sentence is None:
                    spent = place
                    continue
                seen.add(sentence.text)
                total += 1
                made[places[place]] += 1
                yield Pair(sentence.text, sentence.glosses, sentence.alignment, left[place].name, split)
                if made[places[place]] >= largest:
                    spent = place
            if spent is not None:
                del left[spent], places[spent]

    def _new(
        self, derivation: Derivation, template: Template, seen: _Seen, split: str, *, held: bool
    ) -> GeneratedSentence | None:
        for _ in range(_EXHAUSTED_AFTER):
            try:
                sentence = derivation.sentence(template.rule, template.spread)
            except NoFillerError:
                continue
            most = template.rule.repeat if split == "train" else 1
            if seen.has(sentence.text, most) or len(sentence.words) > _LONGEST or not sentence.glosses:
                continue
            if held != bool(sentence.lemmas & self.words.held_out):
                continue
            if not held and any(word in self._held_forms for word in sentence.words):
                continue
            return sentence
        return None


class _Seen:
    """Sentences that must not come (again)."""

    def __init__(self, unwanted: Iterable[str]) -> None:
        self._unwanted = frozenset(map(folded, unwanted))
        self._made: Counter[str] = Counter()

    def add(self, sentence: str) -> None:
        self._made[sentence] += 1

    def has(self, sentence: str, most: int) -> bool:
        """Whether a sentence has come as often as it may."""
        return self._made[sentence] >= most or (bool(self._unwanted) and folded(sentence) in self._unwanted)


def _held_out_words(grammar: Grammar, words: WordLists) -> frozenset[str]:
    """Content words that only tests see: by hash, except those that the grammar itself names."""
    named = {item.word for rule in grammar.rules() for item in rule.text}
    named |= {item.gloss.lower() for rule in grammar.rules() for item in rule.glosses}
    named |= {
        value
        for rule in grammar.rules()
        for slot in rule.slots
        if slot.category in LEXICAL
        for _, values in slot.arguments
        for value in values.split(",")
    }
    named |= {word for words_ in grammar.word_lists.values() for word in words_}  # everyday words
    named |= {part.lemma for shape in grammar.shapes for part in shape.parts}
    every = sorted(
        {
            words.clitics.bare(word.lemma)[0] if word in words.verbs else word.lemma
            for entries in (words.nouns, words.adjectives, words.names, words.verbs)
            for word in entries
        }
    )
    spellings = Counter(lemma.lower() for lemma in every)  # the surname Nieto is a grandson too
    return frozenset(
        lemma
        for lemma in every
        if is_held_out(lemma) and lemma not in named and spellings[lemma.lower()] == 1
    )
