# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Words and glosses while a sentence is made; which gloss stands for which word is kept from the start."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from teo_sign_training.corpus.grammar import Shape
from teo_sign_training.corpus.words import ListedWord, WordLists
from teo_sign_training.corpus.writing import Clitics, SaidWord
from teo_sign_translator.morphology import gloss_name
from teo_sign_translator.morphology.spanish import attach_pronouns
from teo_sign_translator.text.numerals import Numerals


@dataclass(slots=True, eq=False)
class Sign:
    """A gloss.

    Attributes:
        gloss: Upper case.
        sources: The words that it stands for.
        pending: What else will say it, once that is known: `grammar.VERB`, `CLITIC` or `DOER`.
        leads: Whether it governs an infinitive and stands at the front of its predicate.
    """

    gloss: str
    sources: list[SaidWord] = field(default_factory=list)
    pending: str = ""
    leads: bool = False


class VerbPhrase(NamedTuple):
    """A verb as said.

    Attributes:
        tokens: Words in order, clitics among them.
        finite: The word that shows person and tense.
        main: The word of the main verb.
        clitics: For each clitic, in the order given, the word that says it.
        parts: Words of auxiliaries and literals by lemma.
    """

    tokens: list[SaidWord]
    finite: SaidWord
    main: SaidWord
    clitics: list[SaidWord]
    parts: dict[str, SaidWord]


@dataclass(slots=True, eq=False)
class Phrase:
    """A part of a sentence in both languages.

    Attributes:
        features: Person, number, gender and the like.
        tokens: Words and marks.
        signs: Glosses.
        head: The word that stands for the whole.
        verb: Its first verb, which shows the tense.
    """

    features: dict[str, str]
    tokens: list[SaidWord]
    signs: list[Sign]
    head: SaidWord | None = None
    verb: SaidVerb | None = None

    def say(self, pending: str, token: SaidWord) -> None:
        """Make a word a source of the signs that are pending for it."""
        for sign in self.signs:
            if sign.pending == pending:
                sign.sources.append(token)
                sign.pending = ""

    def leave_out(self, pending: str) -> None:
        """Take away the signs that are pending for a word: another sign shows what they say."""
        self.signs = [sign for sign in self.signs if sign.pending != pending]


@dataclass(slots=True, eq=False)
class SaidVerb:
    """A verb that is chosen first and said when its place in the sentence comes.

    Attributes:
        word: The verb.
        shape: Its tense and auxiliaries.
        said: What it has become.
        acts: Whether a sign beside it says whom it is done to: alone, it would say who does it.
    """

    word: ListedWord
    shape: Shape
    said: VerbPhrase | None = None
    acts: bool = False


def looked_up(value: str, features: Mapping[str, str], slots: Mapping[str, Phrase]) -> str:
    """A value as written, or the feature it names: `$V.object` of slot V, `$pol` handed down; "" for none."""
    if not value.startswith("$"):
        return value
    name, dot, key = value[1:].partition(".")
    return slots[name].features.get(key, "") if dot else features.get(name, "")


#: One more than the largest number that is written in words here.
LIMIT = 10_000
#: From here on hundreds agree with what is counted ("doscientas casas").
_AGREEING_HUNDREDS = 200


class NoFillerError(Exception):
    """Nothing fits a slot this time; another try may succeed."""


def word_phrase(words: WordLists, category: str, word: ListedWord, arguments: Mapping[str, str]) -> Phrase:
    """A noun in its number, an adjective that agrees, a name or an adverb.

    Raises:
        TranslationError: "no_form" if the morphology does not know the word.
    """
    form = word.lemma.replace("_", " ")
    if category == "noun":
        form = words.inflect(word.lemma, word.features["tag"])
    elif category == "adj":
        number = arguments.get("number", "s")
        tags = {"m+f": f"A:{arguments.get('gender', 'm')}{number}", "mf": f"A:c{number}", "-": "A"}
        compared = f"A:{arguments['degree']}" if "degree" in arguments else ""
        form = words.inflect(word.lemma, compared or tags.get(word.features["gender"], "A:cn"))
    token = SaidWord(form)
    gloss = gloss_name(word.lemma)
    return Phrase({**word.features, "lemma": word.lemma}, [token], [Sign(gloss, [token])], token)


def can_be_in_words(value: int, gender: str) -> bool:
    """Whether a number may be in words: those that agree ("veintiún", "doscientas") are in digits."""
    agrees = value >= _AGREEING_HUNDREDS or (value % 10 == 1 and value != 11)
    return value < LIMIT and not (gender and agrees)


def number_phrase(value: int, gender: str, numbers: Numerals, *, in_words: bool) -> Phrase:
    """A number, in words or digits; one gloss of digits."""
    token = SaidWord(numbers.in_words(value) if in_words else str(value))
    features = {"number": "s" if value == 1 else "p", "gender": gender or "m", "person": "3"}
    return Phrase(features, [token], [Sign(str(value), [token])], token)


#: Tags that take the person behind them.
_FINITE = ("ind:", "sub:", "cond", "imp")


def say_verb(
    words: WordLists, lemma: str, shape: Shape, person: str, clitics: Sequence[str], *, pronominal: bool
) -> VerbPhrase:
    """Inflect a verb.

    Args:
        words: Inflects.
        lemma: Infinitive without pronoun.
        shape: Tense and auxiliaries.
        person: `1s` to `3p`.
        clitics: Object pronouns as if alone: `("lo", "le")`.
        pronominal: Whether it takes a reflexive pronoun of its person.

    Raises:
        TranslationError: "no_form" if it has no such form.
    """
    rules = words.clitics
    pronouns = [*([rules.reflexive[person]] if pronominal else []), *clitics]
    ordered = in_order(pronouns, rules)
    tokens: list[SaidWord] = []
    parts: dict[str, SaidWord] = {}
    carriers: list[SaidWord] = []
    finite: SaidWord | None = None
    main: SaidWord | None = None
    for part in shape.parts:
        if part.literal == "^":
            carriers = [SaidWord(clitic) for clitic in ordered]
            tokens += carriers
            continue
        if part.literal:
            token = SaidWord(part.literal.replace("_", " "))
        else:
            tag = f"V:{part.tag}"
            if part.tag.startswith(_FINITE):
                tag += f":{person}"
            form = words.inflect(part.lemma or lemma, tag)
            token = SaidWord(attach_pronouns(form, ordered) if part.enclitic and ordered else form)
            if part.enclitic:
                carriers = [token] * len(ordered)
            if not part.lemma:
                main = token
            if finite is None:
                finite = token
        parts.setdefault(part.lemma or part.literal, token)
        tokens.append(token)
    assert finite is not None and main is not None, shape.name
    return VerbPhrase(tokens, finite, main, _carriers(pronouns, ordered, carriers, clitics, rules), parts)


def in_order(clitics: Sequence[str], rules: Clitics) -> tuple[str, ...]:
    """Clitics as they stand before or behind a verb: `("lo", "le")` is `("se", "lo")`."""
    ordered = tuple(sorted(clitics, key=lambda clitic: rules.ranks.get(clitic, len(rules.ranks))))
    if len(ordered) > 1 and set(ordered) & rules.accusative:
        changed = [rules.beside_accusative if clitic in rules.dative else clitic for clitic in ordered]
        return tuple(sorted(changed, key=lambda clitic: rules.ranks.get(clitic, len(rules.ranks))))
    return ordered


def verb_signs(
    lemma: str, shape: Shape, phrase: VerbPhrase, *, said_alone: bool = True, denied: bool = False
) -> list[Sign]:
    """The glosses of a verb and of what its shape adds.

    What stands before the verb leads its predicate (QUERER PAN COMPRAR): complement verbs follow what
    governs them in 16 of 17 (LSE-RADIS). NO stands behind the verb that it denies, so that this one
    comes last there (PAN COMPRAR QUERER NO).

    Args:
        lemma: Infinitive without pronoun.
        shape: Tense and auxiliaries.
        phrase: The verb as said.
        said_alone: Whether the verb has a sign, and not only what it governs.
        denied: Whether the clause is negative.
    """
    before: list[Sign] = []
    signs: list[Sign] = []
    for gloss, source in shape.glosses:
        said = [phrase.parts[source]] if source else []
        if gloss != "*":
            signs.append(Sign(gloss, said))
        else:
            before, signs = signs, []
            if said_alone:
                signs.append(Sign(lemma.upper(), [*said, phrase.main]))
    if denied:
        return [*signs, *before]
    for sign in before:
        sign.leads = True
    return [*before, *signs]


def without_addressee(
    signs: Sequence[Sign], lists: Mapping[str, tuple[str, ...]], *, asked: bool
) -> list[Sign]:
    """The signs without TÚ or USTED where somebody is asked to do something: "¿Puedes venir?" is VENIR PODER.

    Left out is who is addressed, if only the ending of the verb that PODER stands for says so and PODER ends
    the question: signers leave the addressee out in 5 of 6 of such requests.

    Args:
        signs: Of the sentence.
        lists: Of the grammar; `asking_glosses` names such verbs, `addressee_glosses` who is addressed.
        asked: Whether it is a question.
    """
    if not asked or not signs or signs[-1].gloss not in lists.get("asking_glosses", ()):
        return list(signs)
    finite = signs[-1].sources
    return [
        sign
        for sign in signs
        if not (sign.gloss in lists.get("addressee_glosses", ()) and sign.sources == finite[:1])
    ]


def denied_once(signs: Sequence[Sign], lists: Mapping[str, tuple[str, ...]]) -> list[Sign]:
    """The signs without NO where one word more denies: "no digo nada" is DECIR NADA.

    Only where they stand side by side, so that both deny the same verb: glosses of the grammar's list
    `denying_once` are enough without those of `not_glosses`.
    """
    enough, denials = lists.get("denying_once", ()), lists.get("not_glosses", ())
    result: list[Sign] = []
    for sign in signs:
        last = result[-1].gloss if result else ""
        if sign.gloss in denials and last in enough:
            result[-1].sources.extend(sign.sources)
        elif sign.gloss in enough and last in denials:
            sign.sources.extend(result.pop().sources)
            result.append(sign)
        else:
            result.append(sign)
    return result


def _carriers(
    pronouns: Sequence[str],
    ordered: Sequence[str],
    carriers: Sequence[SaidWord],
    clitics: Sequence[str],
    rules: Clitics,
) -> list[SaidWord]:
    """The word that says each of the clitics; "le" may have become "se"."""
    own = len(pronouns) - len(clitics)
    found: list[SaidWord] = []
    for clitic in clitics:
        written = clitic if clitic in ordered[own:] or clitic in ordered else rules.beside_accusative
        places = [place for place, each in enumerate(ordered) if each == written]
        found.append(carriers[places[-1]])
    return found
