# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A verb with its tense, auxiliaries and clitic pronouns."""

from __future__ import annotations

from collections.abc import Sequence

from teo_sign_translator.corpus.grammar import Shape
from teo_sign_translator.corpus.tokens import Sign, Token, VerbPhrase
from teo_sign_translator.corpus.words import WordLists
from teo_sign_translator.morphology.enclitics import attach_pronouns

_CAN = "PODER"
_NO = "NO"
_NOTHING = frozenset(("NADA", "NADIE", "NINGUNO", "NUNCA"))
_ADDRESSEES = frozenset(("TÚ", "USTED", "VOSOTROS", "USTEDES"))
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


def without_addressee(signs: Sequence[Sign], *, asked: bool) -> list[Sign]:
    """The signs without TÚ or USTED where somebody is asked to do something: "¿Puedes venir?" is VENIR PODER.

    Left out is who is addressed, if only the ending of the verb that PODER stands for says so and PODER ends
    the question: signers leave the addressee out in 5 of 6 of such requests.
    """
    if not asked or not signs or signs[-1].gloss != _CAN:
        return list(signs)
    finite = signs[-1].sources
    return [sign for sign in signs if not (sign.gloss in _ADDRESSEES and sign.sources == finite[:1])]


def denied_once(signs: Sequence[Sign]) -> list[Sign]:
    """The signs without NO where one word more denies: "no digo nada" is DECIR NADA.

    Only where they stand side by side, so that both deny the same verb.
    """
    result: list[Sign] = []
    for sign in signs:
        last = result[-1].gloss if result else ""
        if sign.gloss == _NO and last in _NOTHING:
            result[-1].sources.extend(sign.sources)
        elif sign.gloss in _NOTHING and last == _NO:
            sign.sources.extend(result.pop().sources)
            result.append(sign)
        else:
            result.append(sign)
    return result


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
