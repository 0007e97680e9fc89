# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is compared, denied, counted or hardly happens, as a speaker of Spanish reads the sentence."""

from __future__ import annotations

import pytest
from loaded import translator


@pytest.mark.parametrize(
    ("sentence", "glosses"),
    [
        ("Por poco pierdo el tren.", "YO TREN PERDER CASI"),
        ("No es caro, sino barato.", "CARO NO BARATO"),
        ("No quiero café sino té.", "YO CAFÉ NO TÉ QUERER"),
        ("Mi madre no sabe que fumo.", "MADRE MI SABER NO YO FUMAR"),
        ("voy a llamarte", "YO TÚ LLAMAR"),
        ("no se que hacer", "YO HACER QUÉ SABER NO"),
        ("Trabajo de ocho a tres.", "HORA 8 HASTA 3 YO TRABAJAR"),
        ("Mi reloj es más viejo que el tuyo.", "RELOJ MI RELOJ TU VIEJO MÁS"),
        ("Prefiero el tren que el coche.", "YO PREFERIR TREN COCHE NO"),
        ("Prefiero el té al café.", "YO TÉ MÁS PREFERIR CAFÉ NO"),
        ("Prefiero ir a Madrid.", "YO PREFERIR MADRID IR"),
        ("Solo tengo un hijo.", "YO SOLO 1 HIJO"),
        ("Tengo una hija.", "YO HIJA"),
        ("No te lo diré nunca.", "YO TÚ DECIR NUNCA"),
        ("La amiga que vive contigo es sorda.", "AMIGO CON TÚ VIVIR SORDO"),
        ("El hombre que trabaja para mí es rico.", "HOMBRE PARA YO TRABAJAR RICO"),
        ("Todos vinieron menos mi hermano.", "TODO VENIR HERMANO MI NO"),
        ("Abrimos todos los días excepto el domingo.", "DÍA TODO NOSOTROS ABRIR DOMINGO NO"),
        ("Todos los pisos cuestan menos.", "PISO TODO COSTAR MENOS"),
        ("Pregunté cuánto costaba.", "YO PREGUNTAR COSTAR CUÁNTO"),
        ("¡Cuánto te quiero!", "YO TÚ QUERER MUCHO"),
        ("El viaje dura por lo menos seis horas.", "VIAJE DURAR MÍNIMO 6 HORA"),
        ("A partir del lunes trabajo en casa.", "DESDE LUNES YO CASA TRABAJAR"),
        ("Hay más gente que ayer.", "AYER AHORA GENTE MÁS HABER"),
        ("Dice que ayer llovió más.", "DECIR AYER LLOVER MÁS"),
        ("No solo es guapo, también es listo.", "GUAPO LISTO TAMBIÉN"),
        ("No hay quien lo entienda.", "NADIE ENTENDER"),
        ("La chica a la que quiero se llama Rosa.", "CHICA YO QUERER NOMBRE R-O-S-A"),
        ("La niña que vive arriba se llama Ana.", "NIÑA ARRIBA VIVIR NOMBRE A-N-A"),
        ("Ayer me llamó Ana.", "AYER A-N-A YO LLAMAR"),
        ("Como no comas, no hay postre.", "SI COMER NO POSTRE NO_HAY"),
        ("Como no vino, me fui.", "MOTIVO VENIR NO YO IR"),
        ("A menos que nieve, jugaremos.", "SI NEVAR NO NOSOTROS JUGAR"),
        ("dnd estas", "TÚ DÓNDE"),
        ("Prefiero estas.", "YO ESTE PREFERIR"),
        ("q comes esta noche", "HOY NOCHE TÚ COMER QUÉ"),
        ("Iba a llamarte.", "YO TÚ LLAMAR"),
        ("¿Hasta qué hora abrís?", "VOSOTROS ABRIR HASTA HORA CUÁL"),
        ("Empecé a los quince.", "YO EDAD 15 EMPEZAR"),
        ("Se lo di a los dos.", "YO 2 DAR"),
        ("Hace dos años que murió mi madre.", "PASADO 2 AÑO MADRE MI MORIR"),
        ("Hace dos años que no fumo.", "2 AÑO YO FUMAR NO"),
        ("Prefiero quedarme en casa a salir.", "YO PREFERIR CASA QUEDAR SALIR NO"),
        ("Prefiero ir a casa a comer.", "YO PREFERIR CASA IR COMER"),
        ("Pregúntale a tu padre a qué hora viene.", "TÚ PADRE TU PREGUNTAR ÉL VENIR HORA CUÁL"),
        ("¿Quién te ha dado permiso?", "PERMISO TÚ DAR QUIÉN"),
        ("La radio no funciona y nadie lo sabe.", "RADIO FUNCIONAR NO NADIE SABER"),
        ("Pedimos dos cafés y una tila.", "NOSOTROS 2 CAFÉ 1 TILA PEDIR"),
        ("Casi todos mis primos son sordos.", "PRIMO MI CASI TODO SORDO"),
        ("Ya te enseñaré a nadar.", "YO TÚ NADAR ENSEÑAR"),
        ("No tengo más que cinco euros.", "YO SOLO 5 EURO"),
        ("Acabo de hablar con tu padre y está enfadado.", "YO PADRE TU HABLAR ACABAR ÉL ENFADADO"),
        ("Igual no viene.", "VENIR NO QUIZÁS"),
        ("Igual te llamo luego.", "LUEGO YO TÚ LLAMAR QUIZÁS"),
        ("Me da igual.", "YO IGUAL"),
        ("Este chico me toma el pelo.", "ESTE CHICO YO BURLAR"),
    ],
)
def test_the_translator_says_what_the_words_mean(sentence: str, glosses: str) -> None:
    assert str(translator().translate(sentence)) == glosses
