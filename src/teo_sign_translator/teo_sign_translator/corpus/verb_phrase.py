# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A verb with its tense, auxiliaries and clitic pronouns."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence

from teo_sign_translator.corpus.grammar import Shape
from teo_sign_translator.corpus.tokens import Phrase, SaidVerb, Sign, Token, VerbPhrase
from teo_sign_translator.corpus.words import WordLists
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.morphology.enclitics import attach_pronouns

_TENSE_SIGNS = {"past": "PASADO", "future": "FUTURO"}
#: First person plural of the present.
_WE_NOW = "V:ind:pres:1p"
#: Tags that take the person behind them.
_FINITE = ("ind:", "sub:", "cond", "imp")
#: Reflexive pronoun by person.
REFLEXIVES = {"1s": "me", "2s": "te", "3s": "se", "1p": "nos", "2p": "os", "3p": "se"}

_ORDER = {"se": 0, "te": 1, "os": 1, "me": 2, "nos": 2}
_LAST = 3
_THIRD_ACCUSATIVE = frozenset(("lo", "la", "los", "las"))


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
    pronouns = [*([REFLEXIVES[person]] if pronominal else []), *clitics]
    ordered = in_order(pronouns)
    tokens: list[Token] = []
    parts: dict[str, Token] = {}
    carriers: list[Token] = []
    finite: Token | None = None
    main: Token | None = None
    for part in shape.parts:
        if part.literal == "^":
            carriers = [Token(clitic) for clitic in ordered]
            tokens += carriers
            continue
        if part.literal:
            token = Token(part.literal)
        else:
            tag = f"V:{part.tag}"
            if part.tag.startswith(_FINITE):
                tag += f":{person}"
            form = words.inflect(part.lemma or lemma, tag)
            token = Token(attach_pronouns(form, ordered) if part.enclitic and ordered else form)
            if part.enclitic:
                carriers = [token] * len(ordered)
            if not part.lemma:
                main = token
            if finite is None:
                finite = token
        parts.setdefault(part.lemma or part.literal, token)
        tokens.append(token)
    assert finite is not None and main is not None, shape.name
    return VerbPhrase(tokens, finite, main, _carriers(pronouns, ordered, carriers, clitics), parts)


def in_order(clitics: Sequence[str]) -> tuple[str, ...]:
    """Clitics as they stand before or behind a verb: `("lo", "le")` is `("se", "lo")`."""
    ordered = tuple(sorted(clitics, key=lambda clitic: _ORDER.get(clitic, _LAST)))
    if len(ordered) > 1 and set(ordered) & _THIRD_ACCUSATIVE:
        changed = ["se" if clitic in ("le", "les") else clitic for clitic in ordered]
        return tuple(sorted(changed, key=lambda clitic: _ORDER.get(clitic, _LAST)))
    return ordered


def verb_signs(lemma: str, shape: Shape, phrase: VerbPhrase) -> list[Sign]:
    """The glosses of a verb and of what its shape adds."""
    signs: list[Sign] = []
    for gloss, source in shape.glosses:
        said = [phrase.parts[source]] if source else []
        signs.append(Sign(lemma.upper(), [*said, phrase.main]) if gloss == "*" else Sign(gloss, said))
    return signs


def tense_signs(verb: SaidVerb | None, time: Phrase | None, says: Collection[str]) -> list[Sign]:
    """The time expression, and before it the mark of tense.

    Args:
        verb: Whose tense it is.
        time: The expression, if there is one.
        says: Times that words of the clause make clear ("any": whichever it is); then the mark has no gloss.
    """
    said = time.signs if time else []
    gloss = _TENSE_SIGNS.get(verb.shape.time) if verb and verb.shape.mark else None
    if verb is None or gloss is None:
        clear = time.features.get("says", "") if time else ""  # "si mañana hace sol": what follows is to come
        return [Sign("", tense=clear), *said] if clear in _TENSE_SIGNS else said
    if "any" in says or verb.shape.time in says:
        return [Sign("", tense=verb.shape.time), *said]
    sources = [verb.said.finite] if verb.said else []
    return [Sign(gloss, sources, tense=verb.shape.time), *said]


def marked_once(signs: Sequence[Sign]) -> list[Sign]:
    """The signs without PASADO or FUTURO where that time has been said already.

    LSE sets the time once, for all that follows.
    """
    kept: list[Sign] = []
    marked = ""
    for sign in signs:
        if sign.gloss and not (sign.tense and sign.tense == marked):
            kept.append(sign)
        marked = sign.tense or marked
    return kept


def marks_ambiguous(signs: Iterable[Sign], morphology: Morphology) -> bool:
    """Whether PASADO is said for a form that is the present too: "quedamos" needs a time word to be past."""
    return any(
        token.text.endswith("mos")
        and token.text != "hemos"  # "hemos comido" is past
        and any(reading.tag == _WE_NOW and reading.exact for reading in morphology.readings(token.text))
        for sign in signs
        if sign.tense == "past"
        for token in sign.sources
    )


def _carriers(
    pronouns: Sequence[str], ordered: Sequence[str], carriers: Sequence[Token], clitics: Sequence[str]
) -> list[Token]:
    """The word that says each of the clitics; "le" may have become "se"."""
    own = len(pronouns) - len(clitics)
    found: list[Token] = []
    for clitic in clitics:
        written = clitic if clitic in ordered[own:] or clitic in ordered else "se"
        places = [place for place, each in enumerate(ordered) if each == written]
        found.append(carriers[places[-1]])
    return found
