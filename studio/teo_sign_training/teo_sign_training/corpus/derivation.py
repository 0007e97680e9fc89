# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Makes sentences: fills the slots of a rule, and of the rules that fill them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import accumulate
from random import Random
from typing import NamedTuple, TypeVar

from teo_sign_training.corpus.grammar import (
    CLITIC,
    DOER,
    LEXICAL,
    VERB,
    GlossItem,
    Grammar,
    Rule,
    Shape,
    Slot,
    Tenses,
    TextItem,
    fits,
)
from teo_sign_training.corpus.phrases import (
    NoFillerError,
    Phrase,
    SaidVerb,
    Sign,
    can_be_in_words,
    denied_once,
    looked_up,
    number_phrase,
    say_verb,
    verb_signs,
    without_addressee,
    word_phrase,
)
from teo_sign_training.corpus.words import ListedWord, Pool, WordLists
from teo_sign_training.corpus.writing import SaidWord, write
from teo_sign_translator.errors import TranslationError

_Weighted = TypeVar("_Weighted", Rule, Shape)

#: Share of the slots that are given a held-out word, where there is one, in sentences that test words.
_HELD_SHARE = 0.5
#: Share of contractions that are written where both ways are right ("don't", "do not"): most are in messages,
#: few in school texts, and a model has to read both.
_CONTRACTED_SHARE = 0.6
#: Numbers up to this are mostly written in words, as people do.
_WORDS_UP_TO = 12


@dataclass
class Chooser:
    """Chooses by weight at each place of a sentence; its `path` (`S.P.n`) names the place.

    Attributes:
        random: Source of chance.
        held: Whether held-out words are to be taken.
    """

    random: Random
    held: bool = False

    def rule(self, path: str, rules: Sequence[Rule]) -> Rule:
        """One of the alternatives, by weight."""
        del path
        return self._by_weight(rules)

    def word(self, path: str, pool: Pool) -> ListedWord | None:
        """A word, by weight."""
        del path
        return pool.draw(self.random, self.held and self.random.random() < _HELD_SHARE)

    def shape(self, path: str, shapes: Sequence[Shape]) -> Shape:
        """A verb shape, by weight."""
        del path
        return self._by_weight(shapes)

    def number(self, path: str, low: int, high: int, step: int) -> int:
        """A number, the small ones more often where there are many."""
        del path
        count = (high - low) // step + 1
        return low + step * int(count * self.random.random() ** 1.5)

    def in_words(self, path: str, value: int) -> bool:
        """Small numbers mostly in words, large ones mostly in digits."""
        del path
        return self.random.random() < (0.7 if value <= _WORDS_UP_TO else 0.3)

    def contracted(self) -> bool:
        """Whether two words are written as one where both ways are right."""
        return self.random.random() < _CONTRACTED_SHARE

    def _by_weight(self, items: Sequence[_Weighted]) -> _Weighted:
        return self.random.choices(items, cum_weights=list(accumulate(item.weight for item in items)))[0]


_COLUMNS = ("ms", "fs", "mp", "fp")


@dataclass
class Sides:
    """The two sides of a rule whose slots are filled.

    Attributes:
        rule: Whose sides.
        slots: What fills its slots; the verbs among it are said here.
        handed: Features handed down to the rule: the person of a verb without a subject of its own.
        words: Inflects.
        grammar: Gives the forms of agreeing words. Of its lists `unsaid_verbs` have no sign beside what they
            govern ("tengo fiebre"), the path of `directed_verbs` shows whom a clitic means ("te ayudo"), and
            `person_verbs` are done to people alone ("lo saludo").
    """

    rule: Rule
    slots: Mapping[str, Phrase]
    handed: Mapping[str, str]
    words: WordLists
    grammar: Grammar
    _literals: dict[str, SaidWord] = field(default_factory=dict)

    def said(self) -> tuple[list[SaidWord], list[Sign]]:
        """The words, then the glosses.

        Raises:
            NoFillerError: If a verb has no such imperative.
            TranslationError: "no_form" if it has no other form that it should have.
        """
        tokens = [token for item in self.rule.text for token in self._tokens(item)]
        signs = [sign for item in self.rule.glosses for sign in self._signs(item)]
        signs.sort(key=lambda sign: not sign.leads)
        for sign in signs:
            sign.leads = False
        return tokens, signs

    def _tokens(self, item: TextItem) -> list[SaidWord]:
        if item.word:
            return [self._literal(item)]
        phrase = self.slots[item.slot]
        subject = self.slots[item.agree] if item.agree else None
        if phrase.verb and not phrase.verb.said:
            self._say(phrase, phrase.verb, subject)
        elif subject and phrase.verb and phrase.verb.said:
            _say_subject(subject, phrase.verb, phrase.verb.said.finite)
        return phrase.tokens

    def _literal(self, item: TextItem) -> SaidWord:
        token = SaidWord(item.word.replace("_", " "))
        if item.agree:
            features = self.slots[item.agree].features
            column = _COLUMNS.index(features.get("gender", "m")[0] + features.get("number", "s"))
            token = SaidWord(self.grammar.paradigms[item.word][column], _COLUMNS[column] == "fs")
        key, again = item.word, 2
        while key in self._literals:
            key, again = f"{item.word}#{again}", again + 1
        self._literals[key] = token
        return token

    def _say(self, phrase: Phrase, verb: SaidVerb, subject: Phrase | None) -> None:
        features = subject.features if subject else self.handed
        carrying = [each for each in self.slots.values() if "clitic" in each.features]
        try:
            said = say_verb(
                self.words,
                verb.word.lemma,
                verb.shape,
                features.get("person", "3") + features.get("number", "s"),
                [each.features["clitic"] for each in carrying],
                pronominal=bool(verb.word.features.get("pronominal")),
            )
        except TranslationError as error:
            if verb.shape.mood == "imp":
                raise NoFillerError(str(error)) from error
            raise TranslationError(error.code, f"{self.rule.where}: {error}") from error
        verb.said = said
        phrase.tokens = said.tokens
        alone = verb.word.lemma not in self.grammar.word_lists.get("unsaid_verbs", ())
        phrase.signs = verb_signs(verb.word.lemma, verb.shape, said, said_alone=alone, denied=self._denies())
        phrase.head = said.main
        directed = verb.word.lemma in self.grammar.word_lists.get("directed_verbs", ())
        of_people = verb.word.lemma in self.grammar.word_lists.get("person_verbs", ())
        for carrier, token in zip(carrying, said.clitics, strict=True):
            shown = directed and "feels" not in carrier.features
            thing = not of_people and carrier.features["clitic"] in self.words.clitics.accusative
            if shown or thing:
                carrier.leave_out(CLITIC)
            verb.acts |= any(sign.pending == CLITIC for sign in carrier.signs)
            carrier.say(CLITIC, token)
        verb.acts |= any("whom" in phrase.features for phrase in self.slots.values())
        if subject:
            _say_subject(subject, verb, said.finite)
            for sign in phrase.signs:  # before it stands its subject
                sign.leads = False

    def _denies(self) -> bool:
        """Whether the clause is negative: it is told so, or a slot says so."""
        said = (phrase.features.get("pol") for phrase in self.slots.values())
        return "neg" in (self.handed.get("pol"), *said)

    def _signs(self, item: GlossItem) -> list[Sign]:
        return self._of_slot(item) if item.slot else [self._gloss(item)]

    def _of_slot(self, item: GlossItem) -> list[Sign]:
        phrase = self.slots[item.slot]
        signs = phrase.signs
        also = self.slots[item.also].head if item.also else None
        if also:
            signs = [replace(sign, sources=[*sign.sources, also]) for sign in signs]
        return signs

    def _gloss(self, item: GlossItem) -> Sign:
        sign = Sign(item.gloss)
        for source in item.sources:
            if source in (VERB, CLITIC, DOER):
                sign.pending = source
            elif source.startswith("{"):
                head = self.slots[source.strip("{}")].head
                if head is not None:
                    sign.sources.append(head)
            else:
                sign.sources.append(self._literals[source])
        verb = next((phrase.verb for phrase in self.slots.values() if phrase.verb), None)
        if sign.pending == VERB and verb and verb.said:
            sign.sources.append(verb.said.finite)
            sign.pending = ""
        return sign


def _say_subject(subject: Phrase, verb: SaidVerb, finite: SaidWord) -> None:
    """Make a verb's ending say its subject; an understood one only where another could be meant."""
    subject.say(VERB, finite)
    if verb.acts:
        subject.say(DOER, finite)
    else:
        subject.leave_out(DOER)


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
    """Derives sentences from rules; a `Chooser` decides at each place."""

    grammar: Grammar
    words: WordLists
    chooser: Chooser
    _lemmas: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        self._tenses = Tenses(self.grammar.shapes, self.grammar.word_lists)

    def sentence(self, rule: Rule, spread: Mapping[str, str]) -> GeneratedSentence:
        """Make a sentence of a rule.

        Raises:
            NoFillerError: Try again.
            TranslationError: "no_form" or "invalid_grammar".
        """
        self._lemmas.clear()
        phrase = self._phrase(rule, {}, "", spread)
        text, places = write(phrase.tokens, self.grammar.writing, self._contracts)
        lists = self.grammar.word_lists
        phrase.leave_out(DOER)
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
