# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From a rule whose slots are filled to its words and its glosses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from teo_sign_training.corpus.fillers import NoFillerError
from teo_sign_training.corpus.grammar import Grammar, Rule
from teo_sign_training.corpus.patterns import CLITIC, VERB, GlossItem, TextItem
from teo_sign_training.corpus.tokens import Phrase, SaidVerb, SaidWord, Sign
from teo_sign_training.corpus.verb_phrase import say_verb, verb_signs
from teo_sign_training.corpus.words import WordLists
from teo_sign_translator.errors import TranslationError

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
            govern ("tengo fiebre"), the path of `directed_verbs` shows whom a clitic means ("te ayudo").
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
            subject.say(VERB, phrase.verb.said.finite)
        return phrase.tokens

    def _literal(self, item: TextItem) -> SaidWord:
        token = SaidWord(item.word)
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
        for carrier, token in zip(carrying, said.clitics, strict=True):
            shown = directed and "feels" not in carrier.features
            if shown or carrier.features["clitic"] in self.words.clitics.accusative:
                carrier.leave_out(CLITIC)
            carrier.say(CLITIC, token)
        if subject:
            subject.say(VERB, said.finite)
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
            if source in (VERB, CLITIC):
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
