"""Makes sentences: fills the slots of a rule, then says both of its sides."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from teo_sign_translator.corpus.choosers import Chooser
from teo_sign_translator.corpus.features import fits, looked_up
from teo_sign_translator.corpus.fillers import can_be_in_words, number_phrase, word_phrase
from teo_sign_translator.corpus.grammar import LEXICAL, Grammar, Rule, Slot
from teo_sign_translator.corpus.patterns import CLITIC, VERB, GlossItem
from teo_sign_translator.corpus.spanish_text import write
from teo_sign_translator.corpus.tenses import Tenses
from teo_sign_translator.corpus.tokens import Phrase, SaidVerb, Sign, Token
from teo_sign_translator.corpus.verb_phrase import (
    marked_once,
    marks_ambiguous,
    say_verb,
    tense_signs,
    verb_signs,
)
from teo_sign_translator.corpus.words import WordLists
from teo_sign_translator.errors import TranslationError

#: Handed down to all that is inside, unless the rule says otherwise.
_INHERITED = ("mood", "shapes", "who", "time", "pol", "says", "self")


class NoFillerError(Exception):
    """Nothing fits a slot this time; another try may succeed."""


class Sentence(NamedTuple):
    """A sentence in both languages.

    Attributes:
        spanish: As written.
        glosses: In signing order.
        alignment: For each gloss the words it stands for.
        lemmas: Of the words that were chosen.
        words: The Spanish words and marks in order, lower case.
    """

    spanish: str
    glosses: tuple[str, ...]
    alignment: tuple[tuple[int, ...], ...]
    lemmas: frozenset[str]
    words: tuple[str, ...]


@dataclass
class Derivation:
    """Makes one sentence after another.

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

    def sentence(self, rule: Rule, spread: Mapping[str, str]) -> Sentence:
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
        stressed = frozenset(self.grammar.word_lists.get("stressed_a", ()))
        text, places = write(phrase.tokens, stressed)
        signs = marked_once(phrase.signs)
        if marks_ambiguous(signs, self.words.morphology):
            raise NoFillerError(f"{rule.where}: present or past")
        lost = [sign.gloss for sign in signs if any(id(token) not in places for token in sign.sources)]
        if lost:
            raise TranslationError(
                "invalid_grammar",
                f"{rule.where}: expected the words of {lost} in '{text}': they are not said",
            )
        return Sentence(
            text,
            tuple(sign.gloss for sign in signs),
            tuple(tuple(sorted({places[id(token)] for token in sign.sources})) for sign in signs),
            frozenset(self._lemmas),
            tuple(token.text for token in phrase.tokens),
        )

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
        tokens, literals = self._spanish(rule, slots, features)
        signs = [sign for item in rule.glosses for sign in self._signs(item, slots, literals)]
        head = slots.get(rule.head)
        taken = {**(head.features if head else {})}
        for key, value in rule.features:
            if found := looked_up(value, features, slots):
                taken[key] = found
        if taken.get("clitic") == "dative":
            taken["clitic"] = "les" if taken.get("number") == "p" else "le"
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
        return number_phrase(value, gender, in_words=wordy and self.chooser.in_words(path, value))

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

    def _spanish(
        self,
        rule: Rule,
        slots: Mapping[str, Phrase],
        handed: Mapping[str, str],
    ) -> tuple[list[Token], dict[str, Token]]:
        tokens: list[Token] = []
        literals: dict[str, Token] = {}
        for item in rule.spanish:
            if item.word:
                token = Token(item.word)
                if item.agree:
                    features = slots[item.agree].features
                    column = ("ms", "fs", "mp", "fp").index(
                        features.get("gender", "m")[0] + features.get("number", "s")
                    )
                    token = Token(self.grammar.paradigms[item.word][column], column == 1)
                again = 2
                key = item.word
                while key in literals:
                    key, again = f"{item.word}#{again}", again + 1
                literals[key] = token
                tokens.append(token)
            else:
                phrase = slots[item.slot]
                if phrase.verb and not phrase.verb.said:
                    subject = slots[item.agree] if item.agree else None
                    self._say(rule, phrase, subject, slots, handed)
                elif item.agree and phrase.verb and phrase.verb.said:
                    slots[item.agree].say(VERB, phrase.verb.said.finite)
                tokens += phrase.tokens
        return tokens, literals

    def _say(
        self,
        rule: Rule,
        phrase: Phrase,
        subject: Phrase | None,
        slots: Mapping[str, Phrase],
        handed: Mapping[str, str],
    ) -> None:
        verb = phrase.verb
        assert verb is not None
        features = subject.features if subject else handed
        person = features.get("person", "3") + features.get("number", "s")
        carrying = [each for each in slots.values() if "clitic" in each.features]
        try:
            said = say_verb(
                self.words,
                verb.word.lemma,
                verb.shape,
                person,
                [each.features["clitic"] for each in carrying],
                pronominal=bool(verb.word.features.get("pronominal")),
            )
        except TranslationError as error:
            if verb.shape.mood == "imp":
                raise NoFillerError(str(error)) from error
            raise TranslationError(error.code, f"{rule.where}: {error}") from error
        verb.said = said
        phrase.tokens = said.tokens
        phrase.signs = verb_signs(verb.word.lemma, verb.shape, said)
        phrase.head = said.main
        for carrier, token in zip(carrying, said.clitics, strict=True):
            carrier.say(CLITIC, token)
        if subject:
            subject.say(VERB, said.finite)

    def _signs(
        self,
        item: GlossItem,
        slots: Mapping[str, Phrase],
        literals: Mapping[str, Token],
    ) -> list[Sign]:
        if item.tense:
            says = [phrase.features.get("says", "") for phrase in slots.values()]
            return tense_signs(slots[item.tense].verb, slots.get(item.slot), says)
        if item.slot:
            phrase = slots[item.slot]
            twice = (
                item.twice and phrase.features.get("number") == "p" and "plural_only" not in phrase.features
            )
            also = slots[item.also].head if item.also else None
            signs = (
                [replace(sign, sources=[*sign.sources, also]) for sign in phrase.signs]
                if also
                else phrase.signs
            )
            return [*signs, *signs] if twice else signs
        sign = Sign(item.gloss)
        for source in item.sources:
            if source in (VERB, CLITIC):
                sign.pending = source
            elif source.startswith("{"):
                head = slots[source.strip("{}")].head
                if head is not None:
                    sign.sources.append(head)
            else:
                sign.sources.append(literals[source])
        verb = next((phrase.verb for phrase in slots.values() if phrase.verb), None)
        if sign.pending == VERB and verb and verb.said:
            sign.sources.append(verb.said.finite)
            sign.pending = ""
        return [sign]
