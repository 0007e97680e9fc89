# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The corpus as a whole, against the lexicon, simplemma and the published order of LSE."""

from __future__ import annotations

import re
from collections import Counter
from itertools import pairwise
from statistics import median

import pytest
import simplemma

from teo_sign_training.corpus.generator import LARGEST_SHARE, SHARES
from teo_sign_translator.data_files import data_file, read_rows
from teo_sign_translator.morphology.spanish import unaccented as strip_accents
from teo_sign_translator.text.source_words import source_words

QUESTION_GLOSSES = {
    "QUÉ", "QUIÉN", "CUÁL", "CÓMO", "CUÁNDO", "DÓNDE", "CUÁNTO", "CUÁNTOS", "POR_QUÉ", "PARA_QUÉ",
}  # fmt: skip
ENCLITICS = re.compile(r"(?<=[aeiouáéíóúrdnzl])(se|me|te|nos|os)?(lo|la|los|las|le|les|me|te|nos|os|se)$")
NEGATIONS = ("NO", "NUNCA", "NADA", "NADIE", "TODAVÍA_NO", "TAMPOCO")


@pytest.fixture(scope="module")
def train(pairs):
    return [pair for pair in pairs if pair.split == "train"]


def test_the_same_seed_gives_the_same_pairs_and_another_seed_others(generator):
    first = list(generator.pairs(100, seed=1))
    assert first == list(generator.pairs(100, seed=1))
    assert first != list(generator.pairs(100, seed=2))


def test_every_sentence_occurs_once_but_set_phrases_and_every_split_has_its_share(generator, pairs):
    assert len(pairs) == 5000
    assert set(Counter(pair.split for pair in pairs)) == set(SHARES)
    repeat = {
        f"{family.name}.{rule.name}": rule.repeat
        for family in generator.grammar.families
        for rule in family.rules
    }
    seen = Counter((pair.text, ".".join(pair.rule.split(".")[:2])) for pair in pairs)
    assert max(seen.values()) > 1
    assert not [each for each, count in seen.items() if count > repeat[each[1]]]
    taught = {pair.text for pair in pairs if pair.split == "train"}
    others = [pair.text for pair in pairs if pair.split != "train"]
    assert len(set(others)) == len(others)
    assert not taught & set(others)


def test_held_out_words_and_templates_are_nowhere_in_train_but_in_what_tests_them(generator, pairs, train):
    held = {lemma.upper() for lemma in generator.words.held_out}
    assert len(held) > 150
    assert not [pair for pair in train if held & set(pair.glosses)]
    tested = [pair for pair in pairs if pair.split in ("test_words", "test_both")]
    assert tested
    assert all(held & set(pair.glosses) for pair in tested)
    new = {pair.rule for pair in pairs if pair.split in ("test_templates", "test_both")}
    assert new
    assert not new & {pair.rule for pair in train}


SAYS_A_CONSTRUCTION = re.compile(
    r"\b(más|menos) (?!mal|para)(\w+ )?que\b|\btan \w+ como\b"  # comparisons, but not "menos mal que"
    r"|\blo que\b|\b(con|de) (el|la|los|las) que\b"  # relative clauses
    r"|\b(sé|sabe|sabes) (si|dónde|quién(es)?|cuándo|cuánto)\b"  # indirect questions
    r"|\bhace \w+ (días|semanas|meses|años) que\b|\bdesde hace\b"  # durations
    r"|\bllev(o|as|a|amos|áis|an) \w+ (días|semanas|meses|años)\b"
)


def test_constructions_held_out_are_said_in_a_split_of_their_own_alone(generator):
    pairs = list(generator.pairs(2000, seed=3, hold_out_constructions=True))
    taught = [pair.text for pair in pairs if pair.split != "test_constructions"]
    held = [pair for pair in pairs if pair.split == "test_constructions"]
    assert len(held) == 40
    assert not [spanish for spanish in taught if SAYS_A_CONSTRUCTION.search(spanish.lower())]
    conditional = [spanish for spanish in taught if re.search(r"\bsi\b", spanish.lower())]
    assert all(spanish.lower().startswith("a ver si ") for spanish in conditional)  # a wish
    assert len([pair for pair in held if SAYS_A_CONSTRUCTION.search(pair.text.lower())]) > 5
    assert [pair for pair in held if pair.text.startswith("Si ")]


def test_without_holding_them_out_every_construction_is_taught(generator, train):
    taught = {pair.rule for pair in train}
    for construction, names in generator.grammar.constructions.items():
        said = [rule for rule in taught if any(rule.startswith(f"{name}.") or rule == name for name in names)]
        assert said, construction


def test_no_template_makes_more_than_its_share_and_most_sentences_are_short(train):
    template, count = Counter(pair.rule for pair in train).most_common(1)[0]
    assert count <= LARGEST_SHARE * len(train) + 1, template
    assert median(len(pair.text.split()) for pair in train) <= 7


def test_alignments_point_into_the_sentence_and_every_content_word_is_signed(pairs, morphology):
    left_out = [
        (tag, None if lemmas == "*" else {lemma.strip() for lemma in lemmas.split(",")})
        for _, (tag, lemmas) in read_rows(data_file("function_words.tsv"), 2)
    ]

    def may_be_left_out(word):
        return any(
            reading.tag.startswith(tag) and (lemmas is None or reading.lemma in lemmas)
            for reading in word.readings
            for tag, lemmas in left_out
        )

    lost = []
    for pair in pairs:
        words = source_words(pair.text, morphology)
        signed = {place for places in pair.alignment for place in places}
        assert max(signed) < len(words), pair
        for place, word in enumerate(words):
            is_mark = word.readings[0].tag == "MARK"
            goes_to = word.readings[0].lemma == "ir"  # "va a hacer frío": an auxiliary
            courtesy = word.form == "favor" and words[place - 1].form == "por"  # the translator signs it
            if not (place in signed or is_mark or goes_to or courtesy or may_be_left_out(word)):
                lost.append((word.text, pair.text))
    assert not lost


def test_glosses_point_at_the_words_that_say_them(pairs, morphology):
    """A gloss that is the lemma of some word in the sentence, and stands once, points at such a word."""
    wrong = []
    for pair in pairs:
        words = source_words(pair.text, morphology)
        lemmas = [{reading.lemma.upper() for reading in word.readings} for word in words]
        for gloss, places in zip(pair.glosses, pair.alignment, strict=True):
            having = [place for place, each in enumerate(lemmas) if gloss in each]
            if len(having) == 1 and places and having[0] not in places and len(gloss) > 4:
                wrong.append((gloss, pair.text))
    assert len(wrong) < len(pairs) / 500, wrong[:10]


def test_articles_agree_with_their_nouns(pairs, morphology):
    gender = {}
    for _, (lemma, column, *_) in read_rows(data_file("lexicon/nouns.tsv"), 4):
        gender.setdefault(lemma, set()).add(column)
    articles = {"el": "m", "la": "f", "un": "m", "una": "f"}
    stressed = {
        "agua", "aula", "águila", "arma", "hambre", "alma", "área", "ala", "hada", "hacha", "ancla",
        "arca", "ave",
    }  # fmt: skip
    checked = 0
    for pair in pairs:
        if pair.rule == "statement.object_first":
            continue  # "La basura la bajo": its pronoun stands before a verb
        words = pair.text.lower().strip("¿¡.?!").replace(",", "").split()
        for article, noun in pairwise(words):
            if article in articles and gender.get(noun) in ({"m"}, {"f"}):
                if any(reading.tag.startswith("V") for reading in morphology.readings(noun)):
                    continue  # "la bajo": a pronoun before a verb that is written as a noun
                checked += 1
                expected = "m" if noun in stressed else next(iter(gender[noun]))
                assert articles[article] == expected, pair.text
    assert checked > 300


def test_every_word_is_spanish(pairs, generator):
    lists = generator.words
    known = {
        word.lemma.lower()
        for entries in (lists.names, lists.nouns, lists.adjectives, lists.adverbs)
        for word in entries
    }
    unknown = Counter()
    for pair in pairs:
        for word in pair.text.lower().replace("¿", "").replace("¡", "").split():
            bare = word.strip(".,?!")
            host = strip_accents(ENCLITICS.sub("", bare))
            spellings = (bare, host, host + "r", host + "d", host + "s", host[:-1] + "ír")
            if not (
                bare.isdigit()
                or bare in known
                or any(simplemma.is_known(spelling, lang="es") for spelling in spellings)
            ):
                unknown[bare] += 1
    # simplemma lacks a few everyday forms (ojalá, veintisiete); a fault of the generator would give hundreds.
    assert sum(unknown.values()) < len(pairs) / 100, unknown.most_common(40)


def test_articles_copulas_prepositions_and_and_are_not_signed(train):
    unsigned = {"EL", "LA", "UN", "UNO", "SER", "Y", "DE", "EN", "A", "CON", "AL", "DEL", "QUE"}
    assert not [pair for pair in train if unsigned & set(pair.glosses)]


def test_the_question_word_is_last(train):
    questions = [
        pair
        for pair in train
        if pair.rule.startswith("questions_")
        and pair.text.endswith("?")
        and "qué tal" not in pair.text.lower()
    ]
    assert len(questions) > 300
    assert not [pair for pair in questions if pair.glosses[-1] not in QUESTION_GLOSSES]


def test_negation_comes_last_in_statements(train):
    statements = [
        pair
        for pair in train
        if pair.rule.startswith("statement.") and pair.text.lower().startswith(("no ", "nunca ", "tampoco "))
    ]
    assert len(statements) > 5
    wrong = [pair for pair in statements if not set(pair.glosses[-2:]) & set(NEGATIONS)]
    assert not wrong


def test_nothing_is_signed_that_signers_leave_out(train):
    """Counted on elicited phrases and the LSE-RADIS narratives: see the corpus README."""
    ours = [pair for pair in train if pair.rule != "paper"]
    for pair in ours:
        words = pair.text.lower()
        if {"PASADO", "FUTURO"} & set(pair.glosses):
            assert re.search(r"pasad|hace|dentro|\bde (peque|jov|niñ)|futuro|una vez", words), pair
        assert "SENTIR" not in pair.glosses, pair
        signs = list(zip(pair.glosses, pair.alignment, strict=True))
        assert not [sign for sign, after in pairwise(signs) if sign == after and sign[1]], pair


def test_a_translation_is_about_as_long_as_signers_make_it(train):
    """4.2 signs for 5.8 words, 0.72 signs a word."""
    words = sum(len(re.findall(r"\w+", pair.text)) for pair in train)
    assert 0.68 < sum(len(pair.glosses) for pair in train) / words < 0.80


def test_numbers_stand_before_what_they_count(train):
    counted = [
        pair
        for pair in train
        if pair.rule.startswith(("possession.have_number", "numbers.costs", "weather.degrees"))
    ]
    assert len(counted) > 10
    assert not [pair for pair in counted if pair.glosses[-1].isdigit() and "con" not in pair.text]


def test_time_comes_first_and_replaces_the_mark_of_tense(train):
    timed = [pair for pair in train if pair.rule.startswith(("statement.", "yes_no.when."))]
    for spanish, gloss in (("ayer", "AYER"), ("anoche", "ANOCHE"), ("hoy", "HOY")):
        found = [pair for pair in timed if spanish in pair.text.lower().strip("¿?.").split()]
        assert found
        first = [pair for pair in found if f"desde {spanish}" not in pair.text.lower()]
        assert all(pair.glosses[0] == gloss for pair in first if spanish != "ayer" or "AYER" in pair.glosses)
        assert not [pair for pair in found if "PASADO" in pair.glosses[:1] or "FUTURO" in pair.glosses]
