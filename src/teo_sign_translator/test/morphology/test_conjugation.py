# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Forms of verbs: against a table written by hand, and against simplemma's dictionary."""

from __future__ import annotations

import pytest
import simplemma
from loaded import TEXT

from teo_sign_translator.morphology import lexicon
from teo_sign_translator.morphology.conjugation import Conjugations
from teo_sign_translator.morphology.readings import PERSONS, VERB_TAGS

CONJUGATIONS = Conjugations(TEXT / "morphology/conjugations.tsv")


#: Six persons of a tense, or one form; from the Nueva gramática de la lengua española (RAE 2009).
TRUTH = """
amar V:ind:pres amo amas ama amamos amáis aman
comer V:ind:pret comí comiste comió comimos comisteis comieron
vivir V:sub:impf viviera vivieras viviera viviéramos vivierais vivieran
ser V:ind:pres soy eres es somos sois son
ser V:ind:pret fui fuiste fue fuimos fuisteis fueron
ser V:sub:pres sea seas sea seamos seáis sean
estar V:ind:pres estoy estás está estamos estáis están
estar V:ind:pret estuve estuviste estuvo estuvimos estuvisteis estuvieron
ir V:ind:pres voy vas va vamos vais van
ir V:ind:impf iba ibas iba íbamos ibais iban
ir V:sub:pres vaya vayas vaya vayamos vayáis vayan
ir V:ger yendo
haber V:ind:pres he has ha hemos habéis han
haber V:ind:fut habré habrás habrá habremos habréis habrán
tener V:ind:fut tendré tendrás tendrá tendremos tendréis tendrán
tener V:imp:2s ten
hacer V:ind:pret hice hiciste hizo hicimos hicisteis hicieron
hacer V:cond haría harías haría haríamos haríais harían
hacer V:part:ms hecho
hacer V:imp:2s haz
decir V:ind:pres digo dices dice decimos decís dicen
decir V:ind:pret dije dijiste dijo dijimos dijisteis dijeron
decir V:imp:2s di
poder V:ind:pres puedo puedes puede podemos podéis pueden
poder V:ger pudiendo
querer V:ind:pres quiero quieres quiere queremos queréis quieren
saber V:ind:pres sé sabes sabe sabemos sabéis saben
saber V:sub:pres sepa sepas sepa sepamos sepáis sepan
traer V:ind:pret traje trajiste trajo trajimos trajisteis trajeron
caber V:ind:pres quepo cabes cabe cabemos cabéis caben
oír V:ind:pres oigo oyes oye oímos oís oyen
oír V:ind:pret oí oíste oyó oímos oísteis oyeron
reír V:ind:pres río ríes ríe reímos reís ríen
dormir V:ind:pret dormí dormiste durmió dormimos dormisteis durmieron
pedir V:sub:impf pidiera pidieras pidiera pidiéramos pidierais pidieran
jugar V:ind:pres juego juegas juega jugamos jugáis juegan
jugar V:sub:pres juegue juegues juegue juguemos juguéis jueguen
conducir V:ind:pres conduzco conduces conduce conducimos conducís conducen
conducir V:ind:pret conduje condujiste condujo condujimos condujisteis condujeron
huir V:ind:pres huyo huyes huye huimos huís huyen
ver V:ind:impf veía veías veía veíamos veíais veían
ver V:part:ms visto
dar V:ind:pret di diste dio dimos disteis dieron
dar V:sub:pres dé des dé demos deis den
andar V:ind:pret anduve anduviste anduvo anduvimos anduvisteis anduvieron
caer V:ind:pret caí caíste cayó caímos caísteis cayeron
volver V:part:ms vuelto
oler V:ind:pres huelo hueles huele olemos oléis huelen
empezar V:ind:pret empecé empezaste empezó empezamos empezasteis empezaron
buscar V:sub:pres busque busques busque busquemos busquéis busquen
coger V:ind:pres cojo coges coge cogemos cogéis cogen
enviar V:ind:pres envío envías envía enviamos enviáis envían
actuar V:ind:pres actúo actúas actúa actuamos actuáis actúan
averiguar V:ind:pret averigüé averiguaste averiguó averiguamos averiguasteis averiguaron
reunir V:ind:pres reúno reúnes reúne reunimos reunís reúnen
llover V:ind:pres:3s llueve
soler V:ind:pres suelo sueles suele solemos soléis suelen
arrepentir V:imp:2s arrepiente
mantener V:imp:2s mantén
wasapear V:ind:pret wasapeé wasapeaste wasapeó wasapeamos wasapeasteis wasapearon
"""


@pytest.mark.parametrize("line", TRUTH.split("\n")[1:-1])
def test_verbs_have_the_forms_of_the_grammar(line: str) -> None:
    infinitive, tag, *expected = line.split()
    tags = [tag] if len(expected) == 1 else [f"{tag}:{person}" for person in PERSONS]
    assert [CONJUGATIONS.forms(infinitive, each)[0] for each in tags] == expected


def test_every_everyday_verb_has_every_form() -> None:
    for verb in lexicon.verbs(TEXT):
        for tag in VERB_TAGS:
            assert CONJUGATIONS.forms(verb, tag), (verb, tag)


def test_simplemma_leads_nearly_every_form_to_the_same_infinitive() -> None:
    # simplemma has one lemma a form: of ambiguous ones (vino, casa) another word; of participles, adjectives.
    tags = [tag for tag in VERB_TAGS if ":part" not in tag and not tag.startswith("V:imp")]
    total = agreed = 0
    for verb in lexicon.verbs(TEXT)[::10]:
        for tag in tags:
            total += 1
            agreed += simplemma.lemmatize(CONJUGATIONS.forms(verb, tag)[0], lang="es") == verb
    assert total > 5000
    assert agreed / total > 0.95
