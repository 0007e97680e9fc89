# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A sign is made only for the sense of a word that it says; what its table lacks is spelled."""

from __future__ import annotations

import pytest
from loaded import translator

from teo_sign_translator.output.translation import Kind

# Text, glosses that are signed, glosses that are not.
CASES = [
    ("Mi vecina acaba de irse.", "YA", "TERMINAR"),
    ("Llegué tarde por la nieve.", "PORQUE", "MOTIVO"),
    ("Estudio para que mi madre esté contenta.", "MOTIVO", "PORQUE"),
    ("Mi clase acaba a las tres y media.", "Y_MEDIA", "MEDIO"),
    ("Quiero media manzana.", "MEDIO", "Y_MEDIA"),
    ("La media está rota.", "", "MEDIO Y_MEDIA"),
    ("La clase empieza a las cuatro y cuarto.", "Y_CUARTO", "CUARTO"),
    ("Salgo a las ocho menos cuarto.", "MENOS_CUARTO", "MENOS CUARTO"),
    ("Son las cinco en punto.", "EN_PUNTO", "PRONTO"),
    ("Mi cuarto es grande.", "DORMITORIO", "CUARTO"),
    ("El cuarto de baño está ocupado.", "BAÑO", "CUARTO DORMITORIO"),
    ("Falta un cuarto de hora.", "HORA", "CUARTO Y_CUARTO"),
    ("Vivo en el cuarto piso.", "CUARTO", "DORMITORIO"),
    ("Espera un segundo.", "", "SEGUNDO"),
    ("Vivo en el segundo piso.", "SEGUNDO", ""),
    ("¿Dónde está el servicio?", "SERVICIO", ""),
    ("El servicio de limpieza es bueno.", "", "SERVICIO"),
    ("La niña juega con la muñeca.", "MUÑECO", "MUÑECA"),
    ("Me duele la muñeca.", "MUÑECA", "MUÑECO"),
    ("Me siento en el banco.", "BANCO_ASIENTO", "BANCO"),
    ("Voy al banco a sacar dinero.", "BANCO", "BANCO_ASIENTO"),
    ("El otoño es una estación del año.", "ESTACIÓN_DEL_AÑO", "ESTACIÓN"),
    ("La estación de tren está lejos.", "ESTACIÓN", "ESTACIÓN_DEL_AÑO"),
    ("Hace mal tiempo.", "TIEMPO_ATMOSFÉRICO", "TIEMPO"),
    ("Llego tarde.", "", "TARDE"),
    ("Esta tarde trabajo.", "TARDE", "POR_LA_TARDE"),
    ("Por la tarde trabajo.", "POR_LA_TARDE", "TARDE"),
    ("Mañana por la mañana trabajo.", "MAÑANA POR_LA_MAÑANA", ""),
    ("Mañana trabajo.", "MAÑANA", "POR_LA_MAÑANA"),
    ("No me gusta la leche.", "NO_GUSTAR", "GUSTAR NO"),
    ("Me gusta la leche.", "GUSTAR", "NO_GUSTAR"),
    ("No tengo moto.", "NO_TENER", "NO"),
    ("No tengo sed.", "NO", "NO_TENER"),
    ("Me lavo los dientes.", "LAVAR_LOS_DIENTES", "DIENTE LAVAR"),
    ("Lavo la camisa.", "LAVAR", "LAVAR_LOS_DIENTES"),
    ("La parada de autobús está cerca.", "PARADA_DE_AUTOBÚS", "PARADA AUTOBÚS"),
    ("¿Qué hora es?", "QUÉ_HORA_ES", "HORA CUÁL"),
    ("Buenos días.", "BUENOS_DÍAS", "BIEN DÍA"),
    ("Tengo la mano derecha rota.", "DERECHA", "DERECHO"),
    ("El derecho es difícil.", "DERECHO", "DERECHA"),
    ("La comida está lista.", "", "LISTO"),
    ("Es un chico listo.", "LISTO", ""),
    ("El marco de la ventana.", "MARCO", "MARCAR"),
    ("He perdido la vista.", "VISTA", "VESTIR"),
    ("El medio ambiente.", "MEDIOAMBIENTE", "MEDIO"),
    ("El gato está bajo la mesa.", "DEBAJO", "BAJO"),
    # What is signed in a word's place says one of its senses.
    ("El banco cobra intereses muy altos.", "BANCO", "INTERESANTE"),
    ("Tengo mucho interés en el curso.", "INTERESANTE", ""),
    ("Las entradas están agotadas.", "", "CANSADO"),
    ("Mi madre está agotada.", "CANSADO", ""),
    ("La cola del gato es negra.", "", "FILA"),
    ("Hay mucha cola en el cine.", "FILA", ""),
    ("La cajera me dio la vuelta.", "", "MÁQUINA"),
    ("Siento mucho lo de tu padre.", "PENA", "PERDÓN"),
    ("Lo siento, llego tarde.", "PERDÓN", "PENA"),
    ("He tenido un sueño raro.", "SOÑAR", "DORMIR"),
    ("El picante me sienta mal.", "", "SENTARSE"),
    ("Ella misma lo hizo.", "", "IGUAL"),
    ("Vamos al mismo colegio.", "IGUAL", ""),
    ("Va usted en dirección contraria.", "", "DOMICILIO"),
    ("Mañana hay elecciones.", "VOTO", "ELEGIR"),
    ("¿Recibiste mi carta?", "OBTENER", ""),
    ("La alcaldesa nos recibió en su despacho.", "", "OBTENER"),
    ("¿Cuál es la dirección de la farmacia?", "DOMICILIO", ""),
    ("Quedamos a las tres, ¿vale?", "DE_ACUERDO", ""),
    ("Vale, un momento.", "DE_ACUERDO", ""),
    ("Lo siento, mi madre está enferma.", "PERDÓN", "PENA"),
    ("¿Cuándo llegaste?", "CUÁNDO_PASADO", "CUÁNDO"),
    ("¿Cuándo llegas?", "CUÁNDO", "CUÁNDO_PASADO"),
]
SIGNS = frozenset(gloss for _, *columns in CASES for column in columns for gloss in column.split())


@pytest.mark.parametrize(("text", "signed", "not_signed"), CASES)
def test_the_sense_of_the_sentence_is_signed_and_no_other(text: str, signed: str, not_signed: str) -> None:
    glosses = {
        token.gloss
        for sentence in translator().translate(text, SIGNS).sentences
        for token in sentence.tokens
        if token.kind is Kind.LEXICAL
    }
    assert glosses >= {*signed.split()} and glosses.isdisjoint(not_signed.split())


def test_several_glosses_stay_where_the_table_has_no_one_sign_for_them() -> None:
    (sentence,) = translator().translate("No me gusta la leche.", SIGNS - {"NO_GUSTAR"}).sentences
    assert [token.gloss for token in sentence.tokens][-2:] == ["GUSTAR", "NO"]


def test_a_sense_that_the_table_lacks_is_spelled_and_says_for_which_gloss() -> None:
    (sentence,) = translator().translate("Mi cuarto.", {"CUARTO"}).sentences
    letters = [token.gloss for token in sentence.tokens if token.meant == "CUARTO"]
    assert letters == list("CUARTO")
    assert "CUARTO" in str(translator().translate("Mi cuarto."))  # while the table is not known
