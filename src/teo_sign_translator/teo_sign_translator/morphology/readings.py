# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Readings of words, and the closed list of their tags: what a word is, and in which form.

A tag is a class and its features, joined by `:`. Compare the class with `tag_class`, or a feature with
`tag.startswith("ADV:time")`.

- Verbs: `V:inf`, `V:ger`, `V:part:ms` (gender, number), `V:ind:pres:1s` (indicative `pres`, `impf`
  imperfect, `pret` preterite, `fut` future; person, number), `V:cond:1s`, `V:sub:pres:1s`, `V:sub:impf:1s`,
  `V:imp:2s`.
- Of languages without persons or genders: `V:ind:pres`, `V:ind:pret`, `V:imp` for all persons, `V:part`,
  `N:s`, `N:p`, `A`, `A:comp` (bigger), `A:sup` (biggest), `DET:def`, `DET:indef`, `DET:dem`, `DET:quant`,
  `DET:poss:1s`, `PRON:3s:m` (he), `PRON:poss:1s`, `PRON:refl:1s`, `POSS` (Ana's).
- `N:ms`, `A:fp`: noun, adjective; gender `m`, `f`, `c` (common: el/la estudiante), number `s`, `p`, `n`
  (either: la/las crisis).
- `ADV`, `ADV:neg` (no, nunca, tampoco), `ADV:place`, `ADV:degree`, `ADV:manner`, `ADV:sentence` (sí,
  quizá), `ADV:time:past` (ayer), `ADV:time:present` (ahora), `ADV:time:future` (mañana),
  `ADV:time:frequency` (siempre), `ADV:time` (luego).
- `WH`, `WH:fp`: question word; cuántas.
- `DET:def:ms` (el; `DET:def:ns` is lo), `DET:indef:ms` (un), `DET:dem:ms` (este), `DET:quant:ms` (mucho,
  otro, todo, algún, cada), `DET:poss:1s:cs`: possessive before the noun, of whom (`1s` mi, `2s` tu, `3s`
  su, `1p` nuestro, `2p` vuestro), then gender and number.
- Pronouns: subject `PRON:1s`, `PRON:1p:f` (nosotras is nosotros `PRON:1p:f`, ellas is ellos `PRON:3p:f`);
  object `PRON:obj:1s`, `PRON:obj:3s` (le), `PRON:obj:3s:f` (la; lemma lo), `PRON:refl` (se); `PRON:prep:1s`
  (mí), `PRON:with:1s` (conmigo), `PRON:poss:1s:ms` (mío), `PRON:dem` (esto), `PRON:ind` (algo), `PRON:neg`
  (nadie), `PRON:rel` (que).
- `PREP`, `PREP:art` (al is a, del is de), `CONJ`, `INT` interjection, `NUM` number (lemma in digits),
  `MARK`.
- `NAME` (surname, or a name that is not known), `NAME:m`, `NAME:f` (given names), `NAME:place`.
- `X`: nothing known, most likely a noun.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

PERSONS = ("1s", "2s", "3s", "1p", "2p", "3p")
#: There is no imperative of the first person singular.
IMPERATIVE_PERSONS = PERSONS[1:]
_GENDER_NUMBER = ("ms", "fs", "mp", "fp")
_COMMON_NUMBER = ("cs", "cp")

#: Tenses by the tag's beginning; each has all six persons.
_TENSES = (
    "V:ind:pres",
    "V:ind:impf",
    "V:ind:pret",
    "V:ind:fut",
    "V:cond",
    "V:sub:pres",
    "V:sub:impf",
)

VERB_TAGS = (
    "V:inf",
    "V:ger",
    *(f"V:part:{form}" for form in _GENDER_NUMBER),
    *(f"{tense}:{person}" for tense, person in product(_TENSES, PERSONS)),
    *(f"V:imp:{person}" for person in IMPERATIVE_PERSONS),
)
_NOMINAL = tuple(gender + number for gender, number in product("mfc", "spn"))
_NOUN_TAGS = tuple(f"N:{form}" for form in _NOMINAL)
_ADJECTIVE_TAGS = tuple(f"A:{form}" for form in _NOMINAL)
ADVERB_TAGS = (
    "ADV",
    "ADV:neg",
    "ADV:place",
    "ADV:degree",
    "ADV:manner",
    "ADV:sentence",
    "ADV:time",
    "ADV:time:past",
    "ADV:time:present",
    "ADV:time:future",
    "ADV:time:frequency",
)
_DETERMINER_TAGS = (
    *(f"DET:{kind}:{form}" for kind, form in product(("def", "indef", "dem"), _GENDER_NUMBER)),
    "DET:def:ns",
    *(f"DET:quant:{form}" for form in (*_GENDER_NUMBER, *_COMMON_NUMBER)),
    *(f"DET:poss:{owner}:{form}" for owner, form in product(("1s", "2s", "3s"), _COMMON_NUMBER)),
    *(f"DET:poss:{owner}:{form}" for owner, form in product(("1p", "2p"), _GENDER_NUMBER)),
)
_PRONOUN_TAGS = (
    *(f"PRON:{person}" for person in PERSONS),
    *(f"PRON:{person}:f" for person in ("1p", "2p", "3p")),
    *(f"PRON:obj:{person}" for person in PERSONS),
    *(f"PRON:obj:{form}" for form in ("3s:m", "3s:f", "3p:m", "3p:f")),
    "PRON:refl",
    *(f"PRON:{case}:{person}" for case, person in product(("prep", "with"), ("1s", "2s", "3s"))),
    *(f"PRON:poss:{owner}:{form}" for owner, form in product(("1s", "2s", "3s", "1p", "2p"), _GENDER_NUMBER)),
    "PRON:dem",
    "PRON:ind",
    "PRON:neg",
    "PRON:rel",
)
_OTHER_TAGS = (
    *(f"WH{form}" for form in ("", *(f":{form}" for form in (*_GENDER_NUMBER, *_COMMON_NUMBER)))),
    "PREP",
    "PREP:art",
    "CONJ",
    "INT",
    "NUM",
    "NAME",
    "NAME:m",
    "NAME:f",
    "NAME:place",
    "MARK",
    "X",
)

#: Of languages without persons, genders or agreement.
_PLAIN_TAGS = (
    "V:ind:pres",
    "V:ind:pret",
    "V:imp",
    "V:part",
    "N:s",
    "N:p",
    "A",
    "A:comp",
    "A:sup",
    "DET:def",
    "DET:indef",
    "DET:dem",
    "DET:quant",
    *(f"DET:poss:{owner}" for owner in PERSONS),
    *(f"PRON:poss:{owner}" for owner in PERSONS),
    *(f"PRON:refl:{owner}" for owner in PERSONS),
    "PRON:3s:m",
    "PRON:3s:f",
    "POSS",
    "AUX",
)

#: Every tag there is; the order is stable, new tags are added at the end of their part.
TAGS = (
    *VERB_TAGS,
    *_NOUN_TAGS,
    *_ADJECTIVE_TAGS,
    *ADVERB_TAGS,
    *_DETERMINER_TAGS,
    *_PRONOUN_TAGS,
    *_OTHER_TAGS,
    *_PLAIN_TAGS,
)


def tag_class(tag: str) -> str:
    """The first part of a tag: `"V"` of `"V:ind:pres:1s"`."""
    return tag.partition(":")[0]


@dataclass(frozen=True, slots=True)
class Reading:
    """One way to read a word.

    Attributes:
        lemma: Dictionary form in lower case with accents: "comer", "niño"; a name keeps its capital: "Ana"; a
            number is in digits: "7".
        tag: One of `TAGS`.
        clitics: Pronouns that hang on a verb, as written: ("me", "lo") in "dímelo".
        exact: False if the word must be written with other accents to be this ("como" for "cómo"), or if the
            word is not known and this is a guess.
    """

    lemma: str
    tag: str
    clitics: tuple[str, ...] = ()
    exact: bool = True


def gloss_name(written: str) -> str:
    """A gloss as the look-up table names it: `"Por favor"` is `"POR_FAVOR"`."""
    return written.strip().upper().replace(" ", "_")
