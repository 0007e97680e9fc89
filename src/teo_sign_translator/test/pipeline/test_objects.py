# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whom something happens to, and who should do it, as a speaker of Spanish reads the sentence."""

from __future__ import annotations

import pytest
from loaded import TEXT, read

from teo_sign_translator.pipeline.completeness import CompleteTranslation
from teo_sign_translator.pipeline.doers import Doers
from teo_sign_translator.pipeline.objects import Objects
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.pipeline.topic import Topics
from teo_sign_translator.pipeline.wishes import Wishes
from teo_sign_translator.pointer import OutputGloss

OBJECTS = Objects(PipelineWords.load(TEXT), Topics(TEXT))
WISHES = Wishes(PipelineWords.load(TEXT), Topics(TEXT))
DOERS = Doers(PipelineWords.load(TEXT), Topics(TEXT))


def meant(rule: Objects | Wishes | Doers, sentence: str, model: str) -> str:
    """What is signed where a model says these glosses, each with the word that it says: `TÚ/te`."""
    words = read(sentence)
    forms = [word.form for word in words]
    glosses = []
    for each in model.split():
        gloss, _, form = each.partition("/")
        glosses.append(OutputGloss(gloss, (forms.index(form),) if form else (), 0.9, copied=False))
    said = CompleteTranslation(tuple(glosses), (False,) * len(glosses))
    return " ".join(gloss.gloss for gloss in rule.read(words, said).glosses)


@pytest.mark.parametrize(
    ("sentence", "model", "signed"),
    [
        # The signer or the addressee who does it is said by the verb's ending alone.
        ("La chica que te presenté.", "CHICA/chica TÚ/te PRESENTAR/presenté", "CHICA YO TÚ PRESENTAR"),
        ("El libro que me diste.", "LIBRO/libro YO/me DAR/diste", "LIBRO TÚ YO DAR"),
        ("Yo te llamo.", "YO/yo TÚ/te LLAMAR/llamo", "YO TÚ LLAMAR"),
        ("Te llamo.", "YO/llamo TÚ/te LLAMAR/llamo", "YO TÚ LLAMAR"),
        ("Luego te llamo.", "LUEGO/luego LLAMAR/llamo", "LUEGO LLAMAR"),  # nobody is taken for another one
        ("Me lavo.", "YO/me LAVAR/lavo", "YO LAVAR"),
        # Who is asked to do it.
        ("Déjame en paz.", "YO/déjame PAZ/paz DEJAR/déjame", "TÚ YO PAZ DEJAR"),
        ("Acuérdate de llamarme.", "YO/llamarme LLAMAR/llamarme", "TÚ YO LLAMAR"),
        ("Ven a verme.", "VENIR/ven YO/verme VER/verme", "TÚ VENIR YO VER"),
        ("Mándame un mensaje.", "MENSAJE/mensaje MANDAR/mándame", "MENSAJE MANDAR"),
        # A third person who is not named.
        ("Ayer me llamó.", "AYER/ayer YO/me LLAMAR/llamó", "AYER ÉL YO LLAMAR"),
        ("Ayer me llamó.", "AYER/ayer LLAMAR/llamó", "AYER ÉL YO LLAMAR"),
        ("El lunes te ha visto.", "LUNES/lunes TÚ/te VER/visto", "LUNES ÉL TÚ VER"),
        (
            "Vi a Ana, pero no me saludó.",
            "YO/vi ANA/ana VER/vi YO/me SALUDAR/saludó",
            "YO ANA VER ÉL YO SALUDAR",
        ),
        ("Me ha pedido dinero.", "DINERO/dinero PEDIR/pedido", "DINERO ÉL YO PEDIR"),
        ("Ayer me llamó Ana.", "AYER/ayer ANA/ana YO/me LLAMAR/llamó", "AYER ANA YO LLAMAR"),
        ("El colegio me llamó.", "COLEGIO/colegio YO/me LLAMAR/llamó", "COLEGIO YO LLAMAR"),
        ("Nadie me llamó.", "NADIE/nadie YO/me LLAMAR/llamó", "NADIE YO LLAMAR"),
        ("¿Quién te llamó?", "TÚ/te LLAMAR/llamó QUIÉN/quién", "TÚ LLAMAR QUIÉN"),
        ("¿Me ayuda?", "AYUDAR/ayuda", "AYUDAR"),  # the addressee, politely
        ("La mujer que me llamó.", "MUJER/mujer YO/me LLAMAR/llamó", "MUJER YO LLAMAR"),
        # Whom it is done to, unless that is the signer.
        ("¿Quién te llamó?", "LLAMAR/llamó QUIÉN/quién", "TÚ LLAMAR QUIÉN"),
        ("¿Cuándo os dan el pan?", "PAN/pan DAR/dan CUÁNDO/cuándo", "PAN VOSOTROS DAR CUÁNDO"),
        ("¿Quién me llamó?", "LLAMAR/llamó QUIÉN/quién", "LLAMAR QUIÉN"),
        ("Dile a Ana que me llame.", "ANA/ana DECIR/dile LLAMAR/llame", "ANA DECIR YO LLAMAR"),
        ("Se nos acabó el pan.", "PAN/pan ACABAR/acabó", "PAN ACABAR"),
        # Others, who would not be asked politely; and the addressee who is.
        ("Me han pagado.", "YO/me PAGAR/pagado", "ELLOS YO PAGAR"),
        ("¿Te han llamado?", "TÚ/te LLAMAR/llamado", "ELLOS TÚ LLAMAR"),
        ("¿Me ayuda?", "YO/me AYUDAR/ayuda", "USTED YO AYUDAR"),
        ("Venga, deja de llamarme.", "DEJAR/deja YO/llamarme LLAMAR/llamarme", "DEJAR YO LLAMAR"),
        # Who does it stands first, and others do what nobody is named for.
        ("Al perro lo persigue el gato.", "PERRO/perro GATO/gato PERSEGUIR/persigue", "GATO PERRO PERSEGUIR"),
        ("A Ana la vio Pedro.", "ANA/ana PEDRO/pedro VER/vio", "PEDRO ANA VER"),
        ("A mi hija le pega un niño.", "HIJA/hija NIÑO/niño MI/mi PEGAR/pega", "NIÑO HIJA MI PEGAR"),
        ("A mi madre le gusta Pedro.", "MADRE/madre PEDRO/pedro GUSTAR/gusta", "MADRE PEDRO GUSTAR"),
        ("Al perro lo lavamos.", "PERRO/perro NOSOTROS/lavamos LAVAR/lavamos", "PERRO NOSOTROS LAVAR"),
        ("El gato persigue al perro.", "GATO/gato PERRO/perro PERSEGUIR/persigue", "GATO PERRO PERSEGUIR"),
        ("El médico al que operaron.", "MÉDICO/médico OPERAR/operaron", "MÉDICO ELLOS OPERAR"),
        ("El niño al que cuidan mis padres.", "NIÑO/niño PADRES/padres CUIDAR/cuidan", "NIÑO PADRES CUIDAR"),
        # Nobody does it.
        ("Me duele mucho.", "YO/me DOLER/duele MUCHO/mucho", "YO DOLER MUCHO"),
        ("Me gusta llamar.", "YO/me LLAMAR/llamar GUSTAR/gusta", "YO LLAMAR GUSTAR"),
        ("Se me olvidó llamar.", "YO/me LLAMAR/llamar OLVIDAR/olvidó", "YO LLAMAR OLVIDAR"),
    ],
)
def test_who_is_left_out_is_not_taken_for_another(sentence: str, model: str, signed: str) -> None:
    assert meant(OBJECTS, sentence, model) == signed


@pytest.mark.parametrize(
    ("sentence", "model", "signed"),
    [
        ("Espero que apruebe.", "YO/espero ESPERAR/espero APROBAR/apruebe", "YO ESPERAR ÉL APROBAR"),
        ("Me da miedo que se caigan.", "YO/me MIEDO/miedo CAER/caigan", "YO MIEDO ELLOS CAER"),
        ("Me gusta que me mientan.", "YO/me GUSTAR/gusta MENTIR/mientan", "YO GUSTAR ELLOS YO MENTIR"),
        (
            "Espero que me devuelva el libro.",
            "ESPERAR/espero LIBRO/libro DEVOLVER/devuelva",
            "ESPERAR ÉL YO LIBRO DEVOLVER",
        ),
        # What somebody else wants is asked of the signer.
        (
            "Mi jefe quiere que trabaje.",
            "JEFE/jefe QUERER/quiere TRABAJAR/trabaje",
            "JEFE QUERER YO TRABAJAR",
        ),
        ("¿Qué quieres que haga?", "QUERER/quieres HACER/haga QUÉ/qué", "QUERER YO HACER QUÉ"),
        # One more of the signer that no word says.
        (
            "No quiero que me mientan.",
            "YO/quiero QUERER/quiero MENTIR/mientan YO",
            "YO QUERER ELLOS YO MENTIR",
        ),
        ("Le dejo la llave para que venga.", "LLAVE/llave DEJAR/dejo VENIR/venga", "LLAVE DEJAR ÉL VENIR"),
        # Somebody is named, or meant already.
        ("Quiero que me llame Ana.", "QUERER/quiero ANA/ana LLAMAR/llame", "QUERER ANA LLAMAR"),
        ("Mi madre quiere que Ana venga.", "MADRE/madre QUERER/quiere VENIR/venga", "MADRE QUERER VENIR"),
        ("¿Quieres que haga sol?", "QUERER/quieres SOL/sol HACER/haga", "QUERER SOL HACER"),
        ("Me pide que venga.", "YO/me PEDIR/pide VENIR/venga", "YO PEDIR VENIR"),
        ("Quiero que venga.", "QUERER/quiero ÉL/venga VENIR/venga", "QUERER ÉL VENIR"),
        # Nobody does it, or the signer.
        ("Espero que llueva.", "ESPERAR/espero LLOVER/llueva", "ESPERAR LLOVER"),
        ("Espero que te guste.", "ESPERAR/espero TÚ/te GUSTAR/guste", "ESPERAR TÚ GUSTAR"),
        ("Busco un coche que gaste poco.", "COCHE/coche GASTAR/gaste BUSCAR/busco", "COCHE GASTAR BUSCAR"),
        ("No creo que pueda venir.", "CREER/creo VENIR/venir PODER/pueda", "CREER VENIR PODER"),
        ("Me ataban para que no entrara.", "YO/me ATAR/ataban ENTRAR/entrara", "YO ATAR ENTRAR"),
    ],
)
def test_who_wishes_something_is_not_taken_for_who_should_do_it(
    sentence: str, model: str, signed: str
) -> None:
    assert meant(WISHES, sentence, model) == signed


@pytest.mark.parametrize(
    ("sentence", "model", "signed"),
    [
        # Only somebody else is named, whom it is done to or with.
        ("Llamó a su madre.", "MADRE/madre SU/su LLAMAR/llamó", "ÉL MADRE SU LLAMAR"),
        ("Ayer cenó con mi hermano.", "AYER/ayer HERMANO/hermano CENAR/cenó", "AYER ÉL HERMANO CENAR"),
        ("Vio a ese hombre.", "ESE/ese HOMBRE/hombre VER/vio", "ÉL ESE HOMBRE VER"),
        ("Está enfadada conmigo.", "YO/conmigo ENFADADO/enfadada", "ÉL YO ENFADADO"),
        ("Se ríe de mí.", "YO/mí REÍR/ríe", "ÉL YO REÍR"),
        ("Cuida a su madre.", "MADRE/madre SU/su CUIDAR/cuida", "ÉL MADRE SU CUIDAR"),
        # Who does it is named, or is nobody, or is asked.
        ("Ana llamó a su madre.", "ANA/ana MADRE/madre LLAMAR/llamó", "ANA MADRE LLAMAR"),
        ("Llamó Ana a su madre.", "ANA/ana MADRE/madre LLAMAR/llamó", "ANA MADRE LLAMAR"),
        (
            "Los sordos hablan con sus amigos.",
            "SORDO/sordos AMIGO/amigos HABLAR/hablan",
            "SORDO AMIGO HABLAR",
        ),
        ("Llama al médico.", "MÉDICO/médico LLAMAR/llama", "MÉDICO LLAMAR"),
        ("¿Llamó a su madre?", "MADRE/madre LLAMAR/llamó", "MADRE LLAMAR"),
        ("Despidieron a mi hermano.", "HERMANO/hermano DESPEDIR/despidieron", "HERMANO DESPEDIR"),
        ("No se puede entrar con perros.", "PERRO/perros ENTRAR/entrar NO/no", "PERRO ENTRAR NO"),
        ("Le gusta a mi hermano.", "HERMANO/hermano GUSTAR/gusta", "HERMANO GUSTAR"),
        ("Fue al médico.", "MÉDICO/médico IR/fue", "MÉDICO IR"),
        # Who is asked to do it to somebody.
        ("Dile a Ana que venga.", "ANA/ana DECIR/dile VENIR/venga", "TÚ ANA DECIR VENIR"),
        ("Dile a Ana que venga.", "ANA/ana TÚ/dile DECIR/dile VENIR/venga", "TÚ ANA DECIR VENIR"),
        ("No se lo digas a papá.", "PAPÁ/papá DECIR/digas NO/no", "TÚ PAPÁ DECIR NO"),
        ("Quiero que se lo digas a Ana.", "ANA/ana DECIR/digas QUERER/quiero", "ANA DECIR QUERER"),
        # Whom the signer does something to does the next thing.
        ("La llamé y no contestó.", "YO/llamé LLAMAR/llamé CONTESTAR/contestó", "YO LLAMAR ÉL CONTESTAR"),
        (
            "La llamé y no contestó.",
            "YO/llamé ELLA/la LLAMAR/llamé CONTESTAR/contestó",
            "YO ELLA LLAMAR ELLA CONTESTAR",
        ),
        ("Los invité y vinieron.", "YO/invité INVITAR/invité VENIR/vinieron", "YO INVITAR ELLOS VENIR"),
        ("Le escribí y contestó Ana.", "YO/escribí ESCRIBIR/escribí ANA/ana", "YO ESCRIBIR ANA"),
        (
            "Lo llamé, pero no cogió el teléfono.",
            "LLAMAR/llamé PERO/pero COGER/cogió",
            "LLAMAR PERO ÉL COGER",
        ),
        ("Lo lavé y me fui.", "YO/lavé LAVAR/lavé IR/fui", "YO LAVAR IR"),
    ],
)
def test_who_is_named_is_not_taken_for_who_does_it(sentence: str, model: str, signed: str) -> None:
    assert meant(DOERS, sentence, model) == signed
