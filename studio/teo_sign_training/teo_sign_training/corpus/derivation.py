# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Makes sentences: fills the slots of a rule, and of the rules that fill them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from teo_sign_training.corpus.choosers import Chooser
from teo_sign_training.corpus.fillers import NoFillerError, can_be_in_words, number_phrase, word_phrase
from teo_sign_training.corpus.grammar import LEXICAL, Grammar, Rule, Slot, fits
from teo_sign_training.corpus.sides import Sides
from teo_sign_training.corpus.tenses import Tenses
from teo_sign_training.corpus.tokens import Phrase, SaidVerb, looked_up
from teo_sign_training.corpus.verb_phrase import denied_once, without_addressee
from teo_sign_training.corpus.words import WordLists
from teo_sign_training.corpus.written_text import write
from teo_sign_translator.errors import TranslationError

#: Handed down to all that is inside, unless the rule says otherwise.
_INHERITED = ("mood", "shapes", "who", "time", "pol", "says", "self")


class GeneratedSentence(NamedTuple):
    """A sentence in both languages.

    Attributes:
        text: As written.
        glosses: In signing order.
        alignment: For each gloss the words it stands for.
        lemmas: Of the words that were chosen.
        words: The words and marks in order, lower case.
    """

    text: str
    glosses: tuple[str, ...]
    alignment: tuple[tuple[int, ...], ...]
    lemmas: frozenset[str]
    words: tuple[str, ...]


@dataclass
class Derivation:
    """Derives sentences from rules; a `Chooser` decides at each place.

    Attributes:
        grammar: Rules.
        words: Word lists.
        chooser: Chooses.
    """

    grammar: Grammar
    words: WordLists
    chooser: Chooser
    _lemmas: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        self._tenses = Tenses(self.grammar.shapes, self.grammar.word_lists)

    def sentence(self, rule: Rule, spread: Mapping[str, str]) -> GeneratedSentence:
        """Make a sentence of a rule.

        Args:
            rule: Of a family.
            spread: The alternative of each spread slot.

        Raises:
            NoFillerError: Try again.
            TranslationError: "no_form" or "invalid_grammar".
        """
        self._lemmas.clear()
        phrase = self._phrase(rule, {}, "", spread)
        text, places = write(phrase.tokens, self.grammar.writing, self._contracts)
        lists = self.grammar.word_lists
        signs = denied_once(without_addressee(phrase.signs, lists, asked="?" in text), lists)
        lost = [sign.gloss for sign in signs if any(id(token) not in places for token in sign.sources)]
        if lost:
            raise TranslationError(
                "invalid_grammar",
                f"{rule.where}: expected the words of {lost} in '{text}': they are not said",
            )
        return GeneratedSentence(
            text,
            tuple(sign.gloss for sign in signs),
            tuple(tuple(sorted({places[id(token)] for token in sign.sources})) for sign in signs),
            frozenset(self._lemmas),
            tuple(token.text for token in phrase.tokens),
        )

    def _contracts(self, contraction: str) -> bool | None:
        """Whether a contraction is written; None for one that is read as one word, so that it always is."""
        apart = self.words.rules.expressions.stands_for(contraction)
        return self.chooser.contracted() if len(apart) > 1 else None

    def _phrase(
        self, rule: Rule, features: Mapping[str, str], path: str, spread: Mapping[str, str]
    ) -> Phrase:
        slots: dict[str, Phrase] = {}
        for slot in rule.slots:
            arguments = self._arguments(slot, features, slots)
            place = f"{path}.{slot.name}" if path else slot.name
            if slot.category == "verb":
                slots[slot.name] = self._verb(arguments, place, rule)
            elif slot.category in LEXICAL:
                slots[slot.name] = self._word(slot.category, arguments, place, rule)
            else:
                chosen = self._alternative(slot.category, arguments, place, spread.get(slot.name), rule)
                slots[slot.name] = self._phrase(chosen, arguments, place, {})
        tokens, signs = Sides(rule, slots, features, self.words, self.grammar).said()
        head = slots.get(rule.head)
        taken = {**(head.features if head else {})}
        for key, value in rule.features:
            if found := looked_up(value, features, slots):
                taken[key] = found
        if taken.get("clitic") == "dative":
            taken["clitic"] = self.grammar.writing.clitics.dative[taken.get("number") == "p"]
        verb = next((phrase.verb for phrase in slots.values() if phrase.verb), None)
        if verb and verb.said:
            taken.pop("clitic", None)  # said with the verb of this clause, not with that of another
        return Phrase(taken, tokens, signs, head.head if head else (tokens[0] if tokens else None), verb)

    def _arguments(
        self, slot: Slot, features: Mapping[str, str], slots: Mapping[str, Phrase]
    ) -> dict[str, str]:
        arguments = {key: features[key] for key in _INHERITED if key in features}
        if slot.category in LEXICAL and slot.category != "verb":
            arguments = {}
        for key, value in slot.arguments:
            found = looked_up(value, features, slots)
            if key == "shapes" and found and "shapes" in arguments:
                arguments[key] += f"&{found}"  # what the clause allows and what the verb does
            elif found:
                arguments[key] = found
            else:
                arguments.pop(key, None)
        return arguments

    def _alternative(
        self, category: str, arguments: Mapping[str, str], path: str, fixed: str | None, rule: Rule
    ) -> Rule:
        rules = self.grammar.categories[category]
        if fixed is not None:
            chosen = next(each for each in rules if each.name == fixed)
            if not fits(chosen, arguments):
                raise NoFillerError(f"{rule.where}: {fixed} does not fit")
            return chosen
        fitting = [each for each in rules if fits(each, arguments)]
        if not fitting:
            raise TranslationError(
                "invalid_grammar",
                f"{rule.where}: expected an alternative of '{category}' for {dict(arguments)}, found none",
            )
        return self.chooser.rule(path, fitting)

    def _word(self, category: str, arguments: Mapping[str, str], path: str, rule: Rule) -> Phrase:
        if category == "number":
            return self._number(arguments, path)
        try:
            word = self.chooser.word(path, self.words.pool(category, arguments))
        except TranslationError as error:
            raise TranslationError(error.code, f"{rule.where}: {error}") from error
        if word is None:
            raise NoFillerError(f"{rule.where}: no {category} for {dict(arguments)}")
        self._lemmas.add(word.lemma)
        return word_phrase(self.words, category, word, arguments)

    def _number(self, arguments: Mapping[str, str], path: str) -> Phrase:
        low, high = int(arguments.get("min", 2)), int(arguments.get("max", 20))
        value = self.chooser.number(path, low, high, int(arguments.get("step", 1)))
        gender = arguments.get("gender", "")
        wordy = can_be_in_words(value, gender) and arguments.get("as") != "digits"
        in_words = wordy and self.chooser.in_words(path, value)
        return number_phrase(value, gender, self.words.rules.numbers, in_words=in_words)

    def _verb(self, arguments: Mapping[str, str], path: str, rule: Rule) -> Phrase:
        chosen = {key: arguments[key] for key in ("frame", "lemma", "self") if key in arguments}
        try:
            word = self.chooser.word(path, self.words.pool("verb", chosen))
        except (TranslationError, KeyError) as error:
            raise TranslationError("invalid_grammar", f"{rule.where}: {error}") from error
        if word is None:
            raise NoFillerError(f"{rule.where}: no verb for {chosen}")
        if "frame" in chosen:
            self._lemmas.add(word.lemma)
        shapes = self._tenses.fitting(
            arguments.get("mood", "ind"),
            arguments.get("says", ""),
            arguments.get("kind", "") or word.features["kind"],
            arguments.get("shapes", ""),
        )
        if not shapes:
            raise NoFillerError(f"{rule.where}: no shape for {dict(arguments)}")
        shape = self.chooser.shape(path, shapes)
        features = {**word.features, "lemma": word.lemma, "tense": shape.time, "shape": shape.name}
        return Phrase(features, [], [], verb=SaidVerb(word, shape))
