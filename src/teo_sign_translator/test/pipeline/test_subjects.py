# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who does what is wished, as a speaker of Spanish reads the sentence."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from loaded import TEXT, read, translator

from teo_sign_translator.pipeline.completeness import CompleteTranslation
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.pipeline.subjects import Subjects
from teo_sign_translator.pipeline.topic import Topics
from teo_sign_translator.pointer import OutputGloss
from teo_sign_translator.text.source_word import SourceWord

SUBJECTS = Subjects(PipelineWords.load(TEXT), Topics(TEXT))


def meant(words: Sequence[SourceWord], gloss: str, place: int) -> str:
    """Whom a gloss that a verb's ending says points at."""
    said = CompleteTranslation((OutputGloss(gloss, (place,), 0.6, copied=False),), (False,))
    return " ".join(each.gloss for each in SUBJECTS.read(words, said).glosses)


@pytest.mark.parametrize(
    ("clause", "verb", "subject"),
    [
        ("Quiero que", "sea feliz", "ÉL"),
        ("No quiero que", "fume aquí", "ÉL"),
        ("Espero que no", "tenga fiebre", "ÉL"),
        ("Me alegro de que", "esté mejor", "ÉL"),
        ("Me gustaría que", "viniera mañana", "ÉL"),
        ("Hoy prefiero que ya no", "salga tarde", "ÉL"),
        ("Mi padre quiere que", "sea médico", "YO"),
        ("Me pidió que", "viniera mañana", "YO"),
        ("Espero que me", "llame mañana", "ÉL YO"),  # whom it happens to is the signer
        ("Me molesta que", "fume aquí", "ÉL"),
        ("No creo que", "venga hoy", "ÉL"),
        ("No creo que", "pueda ir", "YO"),
        ("Quiero que lo", "haga pronto", "ÉL"),
        ("No quiero que te", "vea nunca", "ÉL"),
        ("Quiero que Pedro lo", "haga pronto", "YO"),  # a model that says so is not mended here
        ("Ojalá", "sea feliz", "YO"),
        ("Cuando", "sea mayor", "YO"),
        ("Que", "sea feliz", "YO"),
        ("Quiero dormir antes de que", "salga tarde", "YO"),
        ("Quiero un trabajo que", "tenga cerca", "YO"),
        ("Quiero, que", "sea feliz", "YO"),
        ("Creo que", "estoy mejor", "YO"),
    ],
)
def test_what_the_signer_wishes_somebody_else_does(clause: str, verb: str, subject: str) -> None:
    words = read(f"{clause} {verb}.")
    place = next(place for place, word in enumerate(words) if word.form == verb.split()[0])
    assert meant(words, "YO", place) == subject


@pytest.mark.parametrize(
    ("sentence", "subject"),
    [
        ("Aunque esté cansada, voy a salir.", "YO"),
        ("Voy a trabajar, aunque tenga fiebre.", "YO"),
        ("Aunque esté cansada, va a salir.", "ÉL"),
        ("Me da pena que esté sola.", "ÉL"),
    ],
)
def test_in_what_is_conceded_somebody_else_is_not_meant_unsaid(sentence: str, subject: str) -> None:
    words = read(sentence)
    place = next(place for place, word in enumerate(words) if word.form in ("esté", "tenga"))
    assert meant(words, "ÉL", place) == subject


@pytest.mark.parametrize(
    ("sentence", "verb", "subject"),
    [
        # Beside who is named nobody is pointed at, least of all the signer.
        ("Si Ana viviera aquí, estaría contenta.", "estaría", ""),
        ("Si mi padre supiera esto, lloraría.", "lloraría", ""),
        ("Ana me dijo que tenía hambre.", "tenía", ""),
        ("Mi padre pensaba que podía ganar.", "podía", ""),
        # Nobody is named; the verb beside it says that it is somebody else.
        ("Cuando llegue a casa, se duchará.", "llegue", "ÉL"),
        ("Cuando sepa la verdad, se va a enfadar.", "sepa", "ÉL"),
        # Whoever is asked to do something.
        ("Cuando termine, llámeme.", "termine", ""),
        ("Hable más alto, que no le oigo.", "hable", ""),
        ("No se mueva.", "mueva", ""),
        ("olvide la contraseña", "olvide", "YO"),  # typed in haste for "olvidé"
        # Somebody is named beside it, or before.
        ("Aunque estuviera triste, la actriz sonreía.", "estuviera", "ÉL"),
        ("Si estuviera enfermo, su madre lloraría.", "estuviera", "ÉL"),
        ("Si tuviera dinero, mi madre estaría contenta.", "tuviera", "YO"),
        ("Si Carmen tuviera coche, iría a la playa.", "tuviera", ""),
        ("Mi abuelo nunca fue a misa, pero respetaba a los curas.", "respetaba", ""),
        ("Fui con mi abuelo, pero prefería el cine.", "prefería", "YO"),
        ("Cuando llegue a casa, te llamo.", "llegue", "YO"),
        ("Cuando llegue a casa, me duchará.", "llegue", "YO"),
        ("Si tuviera dinero, viajaría.", "viajaría", "YO"),
        ("Si fuera rica, viajaría por toda Asia.", "viajaría", "YO"),
        ("Si mi padre me viera, lloraría.", "lloraría", "YO"),
        ("Le dije que tenía hambre.", "tenía", "YO"),
        ("Dije que mi madre tenía hambre.", "tenía", "YO"),  # a model that says so is not mended here
        ("Mientras esté aquí, habrá problemas.", "esté", "YO"),
    ],
)
def test_an_ambiguous_verb_has_the_subject_of_the_clause_beside_it(
    sentence: str, verb: str, subject: str
) -> None:
    words = read(sentence)
    place = next(place for place, word in enumerate(words) if word.form == verb)
    glosses = (
        OutputGloss("YO", (place,), 0.6, copied=False),
        OutputGloss("VERBO", (place,), 0.9, copied=False),
    )
    said = SUBJECTS.read(words, CompleteTranslation(glosses, (False, False)))
    assert [gloss.gloss for gloss in said.glosses] == [*subject.split(), "VERBO"]


def test_who_is_named_already_is_not_pointed_at_twice() -> None:
    words = read("No quiero que me vea.")
    glosses = (
        OutputGloss("ÉL", (4,), 0.6, copied=False),
        OutputGloss("YO", (3, 4), 0.9, copied=False),
        OutputGloss("VER", (4,), 0.9, copied=False),
    )
    said = SUBJECTS.read(words, CompleteTranslation(glosses, (False,) * 3))
    assert [(gloss.gloss, gloss.sources) for gloss in said.glosses] == [
        ("ÉL", (4,)),
        ("YO", (3,)),
        ("VER", (4,)),
    ]


def test_who_asks_for_something_does_not_do_it() -> None:
    words = read("Cuando llegues, mándame una foto.")
    glosses = (OutputGloss("YO", (3,), 0.6, copied=False), OutputGloss("MANDAR", (3,), 0.9, copied=False))
    said = SUBJECTS.read(words, CompleteTranslation(glosses, (False, False)))
    assert [gloss.gloss for gloss in said.glosses] == ["MANDAR"]


@pytest.mark.parametrize(
    ("sentence", "expected"),
    [
        ("Nadie me lo ha contado.", "NADIE YO CONTAR"),
        ("No he contado nadie.", "YO CONTAR NADIE"),  # to nobody
    ],
)
def test_nobody_who_does_something_stands_before_whom_it_is_done_to(sentence: str, expected: str) -> None:
    words = read(sentence)
    place = {word.form: place for place, word in enumerate(words)}
    me = place.get("me", place.get("he", 0))
    glosses = tuple(
        OutputGloss(gloss, (source,), 0.9, copied=False)
        for gloss, source in (("YO", me), ("CONTAR", place["contado"]), ("NADIE", place["nadie"]))
    )
    said = SUBJECTS.read(words, CompleteTranslation(glosses, (False,) * 3))
    assert " ".join(gloss.gloss for gloss in said.glosses) == expected


@pytest.mark.parametrize("sentence", ["Quiero que sea feliz.", "Espero que apruebe el examen."])
def test_a_wish_for_somebody_else_points_at_the_signer_once(sentence: str) -> None:
    glosses = str(translator().translate(sentence)).split()
    assert glosses.count("YO") == 1 and "ÉL" in glosses
