"""Makes sentences: fills the slots of a rule, then says both of its sides."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

from teo_sign_translator.corpus.grammar import LEXICAL, Grammar, Rule, Shape, Slot
from teo_sign_translator.corpus.number_words import LIMIT, number_words
from teo_sign_translator.corpus.patterns import CLITIC, VERB, GlossItem
from teo_sign_translator.corpus.spanish_text import write
from teo_sign_translator.corpus.tokens import Phrase, SaidVerb, Sign, Token
from teo_sign_translator.corpus.verb_phrase import say_verb, verb_signs
from teo_sign_translator.corpus.words import Pool, Word, WordLists
from teo_sign_translator.errors import TranslationError

#: Handed down to all that is inside, unless the rule says otherwise.
_INHERITED = ("mood", "shapes", "who", "time", "pol", "says", "self")
#: Shapes of the present that speak of what is to come.
_PLANS = ("present", "must", "want", "can", "want_enclitic", "can_enclitic", "need", "should", "subjunctive")
_TENSE_SIGNS = {"past": "PASADO", "future": "FUTURO"}


class NoFillerError(Exception):
    """Nothing fits a slot this time; another try may succeed."""


class Chooser(Protocol):
    """Chooses at each place of a sentence."""

    def rule(self, path: str, rules: Sequence[Rule]) -> Rule:
        """One of the alternatives, of which there is at least one."""

    def word(self, path: str, pool: Pool) -> Word | None:
        """One of the words; None if there is none."""

    def shape(self, path: str, shapes: Sequence[Shape]) -> Shape:
        """One of the verb shapes, of which there is at least one."""

    def number(self, path: str, low: int, high: int, step: int) -> int:
        """A number."""

    def in_words(self, path: str, value: int) -> bool:
        """Whether a number is written in words."""


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
    _shapes: dict[tuple[str, ...], tuple[Shape, ...]] = field(default_factory=dict)

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
        lost = [sign.gloss for sign in phrase.signs if any(id(token) not in places for token in sign.sources)]
        if lost:
            raise TranslationError(
                "invalid_grammar",
                f"{rule.where}: expected the words of {lost} in '{text}': they are not said",
            )
        alignment = tuple(
            tuple(sorted({places[id(token)] for token in sign.sources})) for sign in phrase.signs
        )
        return Sentence(
            text,
            tuple(sign.gloss for sign in phrase.signs),
            alignment,
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
            if looked_up := _looked_up(value, features, slots):
                taken[key] = looked_up
        if taken.get("clitic") == "dative":
            taken["clitic"] = "les" if taken.get("number") == "p" else "le"
        verb = next((phrase.verb for phrase in slots.values() if phrase.verb), None)
        return Phrase(taken, tokens, signs, head.head if head else (tokens[0] if tokens else None), verb)

    def _arguments(
        self, slot: Slot, features: Mapping[str, str], slots: Mapping[str, Phrase]
    ) -> dict[str, str]:
        arguments = {key: features[key] for key in _INHERITED if key in features}
        if slot.category in LEXICAL and slot.category != "verb":
            arguments = {}
        for key, value in slot.arguments:
            looked_up = _looked_up(value, features, slots)
            if key == "shapes" and looked_up and "shapes" in arguments:
                arguments[key] += f"&{looked_up}"  # what the clause allows and what the verb does
            elif looked_up:
                arguments[key] = looked_up
            else:
                arguments.pop(key, None)
        return arguments

    def _alternative(
        self, category: str, arguments: Mapping[str, str], path: str, fixed: str | None, rule: Rule
    ) -> Rule:
        rules = self.grammar.categories[category]
        if fixed is not None:
            chosen = next(each for each in rules if each.name == fixed)
            if not _fits(chosen, arguments):
                raise NoFillerError(f"{rule.where}: {fixed} does not fit")
            return chosen
        fitting = [each for each in rules if _fits(each, arguments)]
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
        features = dict(word.features)
        if category == "noun":
            form = self._noun_form(word)
        elif category == "adj":
            gender, number = arguments.get("gender", "m"), arguments.get("number", "s")
            form = self._adjective_form(word, gender, number)
        else:
            form = word.lemma
        features["lemma"] = word.lemma
        token = Token(form)
        gloss = word.lemma.upper().replace(" ", "_")
        return Phrase(features, [token], [Sign(gloss, [token])], token)

    def _noun_form(self, word: Word) -> str:
        return self.words.inflect(word.lemma, word.features["tag"])

    def _adjective_form(self, word: Word, gender: str, number: str) -> str:
        column = word.features["gender"]
        letter = {"m+f": gender, "mf": "c"}.get(column)
        tag = f"A:{letter}{number}" if letter else "A:cn"
        return self.words.inflect(word.lemma, tag)

    def _number(self, arguments: Mapping[str, str], path: str) -> Phrase:
        low, high = int(arguments.get("min", 2)), int(arguments.get("max", 20))
        value = self.chooser.number(path, low, high, int(arguments.get("step", 1)))
        gender = arguments.get("gender", "")
        plain = value < LIMIT and (not gender or (value % 10 != 1 and value < 200) or value == 11)
        text = str(value)
        if plain and arguments.get("as") != "digits" and self.chooser.in_words(path, value):
            text = number_words(value)
        token = Token(text)
        features = {"number": "s" if value == 1 else "p", "gender": gender or "m", "person": "3"}
        return Phrase(features, [token], [Sign(str(value), [token])], token)

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
        shapes = self._fitting_shapes(
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

    def _fitting_shapes(self, mood: str, says: str, kind: str, only: str) -> tuple[Shape, ...]:
        key = (mood, says, kind, only)
        if key not in self._shapes:
            lists = self.grammar.word_lists
            allowed = [
                {name for each in part.split(",") for name in lists.get(each, (each,))}
                for part in only.split("&")
                if part
            ]
            self._shapes[key] = tuple(
                shape
                for shape in self.grammar.shapes
                if shape.mood == mood
                and all(shape.name in names for names in allowed)
                and (shape.kind != "event" or kind == "event")
                and _time_fits(says, shape, kind)
            )
        return self._shapes[key]

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
                    _resolve(slots[item.agree], VERB, phrase.verb.said.finite)
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
            _resolve(carrier, CLITIC, token)
        if subject:
            _resolve(subject, VERB, said.finite)

    def _signs(
        self,
        item: GlossItem,
        slots: Mapping[str, Phrase],
        literals: Mapping[str, Token],
    ) -> list[Sign]:
        if item.tense:
            return _tense_signs(slots[item.tense].verb, slots.get(item.slot))
        if item.slot:
            phrase = slots[item.slot]
            twice = (
                item.twice and phrase.features.get("number") == "p" and "plural_only" not in phrase.features
            )
            return [*phrase.signs, *phrase.signs] if twice else phrase.signs
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


def _tense_signs(verb: SaidVerb | None, time: Phrase | None) -> list[Sign]:
    said = time.signs if time else []
    gloss = _TENSE_SIGNS.get(verb.shape.time) if verb and verb.shape.mark else None
    if verb is None or gloss is None or (time and time.features.get("says")):
        return said
    sources = [verb.said.finite] if verb.said else []
    return [Sign(gloss, sources), *said]


def _resolve(phrase: Phrase, pending: str, token: Token) -> None:
    for sign in phrase.signs:
        if sign.pending == pending:
            sign.sources.append(token)
            sign.pending = ""


def _looked_up(value: str, features: Mapping[str, str], slots: Mapping[str, Phrase]) -> str:
    if not value.startswith("$"):
        return value
    name, dot, key = value[1:].partition(".")
    return slots[name].features.get(key, "") if dot else features.get(name, "")


def _fits(rule: Rule, features: Mapping[str, str]) -> bool:
    for key, allowed in rule.when:
        given = features.get(key, "-").split(",")
        forbidden = [value[1:] for value in allowed if value.startswith("!")]
        if forbidden:
            if any(value in forbidden for value in given):
                return False
        elif not any(value in allowed for value in given):
            return False
    return True


def _time_fits(says: str, shape: Shape, kind: str) -> bool:
    """Whether a tense goes with a time word: "mañana" goes with the present of events too ("mañana voy")."""
    if says in ("", "any"):
        return True
    if says == "past":
        return shape.time == "past" and shape.dated
    if says == "future":
        return shape.time == "future" or (
            shape.time == "present" and shape.name in _PLANS and kind == "event"
        )
    return shape.time == says
