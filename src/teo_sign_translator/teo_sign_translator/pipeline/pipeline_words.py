# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What completing, inflecting and judging a translation need to know of a language: `pipeline.yaml`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from teo_sign_translator.data_files import read_sections
from teo_sign_translator.text.source_word import SourceWord

_FILE = "pipeline.yaml"


@dataclass(frozen=True)
class CompletenessWords:
    """What may go without a gloss though it is no function word; the section `completeness`.

    Attributes:
        goes: Verb that only says the future before an infinitive; empty for none.
        goes_to: Word between that verb and the infinitive.
        courtesy: Words of a courtesy, in order; empty for none.
        courtesy_gloss: The gloss of all of them.
        of_things: Verbs whose third person is nobody: a pointing gloss is not said for them.
        unsaid: Glosses of words that the sign language leaves out, however often the model says them.
    """

    goes: str
    goes_to: str
    courtesy: tuple[str, ...]
    courtesy_gloss: str
    of_things: frozenset[str]
    unsaid: frozenset[str]

    def says_only_the_future(self, words: Sequence[SourceWord], place: int) -> bool:
        """Whether a word is "voy" of "voy a comer", which a word of time may replace."""
        following = words[place + 1 : place + 3]
        return (
            any(reading.lemma == self.goes for reading in words[place].readings)
            and len(following) == 2
            and following[0].form == self.goes_to
            and any(reading.tag == "V:inf" for reading in following[1].readings)
        )


@dataclass(frozen=True)
class PersonWords:
    """Who acts on whom, for signs that agree; the section `persons`. Persons are 1, 2 and 3.

    Attributes:
        objects: Object pronouns with their person.
        things: Those of the third person that may be things.
        reflexive: The pronoun that a dative becomes beside one of those.
        subjects: Subject pronouns with their person.
        polite: Those of the addressee whose verb is of the third person.
        towards: Words before the person that something is done to.
        own_possessive: Possessive that names a third person.
        own_imperatives: Verbs whose imperative is no form of the third person.
        experiencer_verbs: Verbs whose object is who feels.
    """

    objects: dict[str, str]
    things: frozenset[str]
    reflexive: str
    subjects: dict[str, str]
    polite: frozenset[str]
    towards: frozenset[str]
    own_possessive: str
    own_imperatives: frozenset[str]
    experiencer_verbs: frozenset[str]


@dataclass(frozen=True)
class SubjectWords:
    """Who does what a verb says; the section `subjects`. All are empty where its form says who.

    Attributes:
        joiner: Word that joins a clause in the subjunctive to the verb before it.
        link: Word that may stand between the two.
        object: Object pronoun of the signer.
        pointing: Glosses that point at persons, by person and number: 1s, 2p.
        clitics: Object pronouns that a verb may end with, each with its person and number.
        concessives: Words that open a clause whose subject is that of the clause beside it: although.
        adjuncts: Others: when, if.
        impersonal: Verbs whose third person may be nobody.
        believing: Verbs of what is held true, which may be about oneself in the subjunctive, too.
        wanting: Verbs of what one wants somebody to do.
        calling: Verbs of what somebody is called.
        asking: Verbs that ask whom they are said to for something.
        able: Verb of what one can do.
        deeds: Verbs of what people do to each other.
        beside: Prepositions before whom somebody is with.
    """

    joiner: str
    link: str
    object: str
    pointing: dict[str, str]
    clitics: dict[str, str]
    concessives: frozenset[str]
    adjuncts: frozenset[str]
    impersonal: frozenset[str]
    believing: frozenset[str]
    wanting: frozenset[str]
    calling: frozenset[str]
    asking: frozenset[str]
    able: str
    deeds: frozenset[str]
    beside: frozenset[str]


@dataclass(frozen=True)
class ConnectiveWords:
    """Prepositions and "that", which mean more than one thing; the section `connectives`. All may be empty.

    Attributes:
        through: Preposition of reasons, of ways, and of who did it.
        reasons: Glosses that give a reason.
        upon: Preposition of what is spoken of, and of what something lies on.
        above: Gloss of the place above.
        about: Verbs and nouns that are about something.
        that: Word that joins, compares and asks.
        asked: Glosses that ask, which a word that joins or compares is taken for.
        companions: Glosses of prepositions before a person, and of those that are one word with it.
        little: Word that means "almost" between the preposition of reasons and a verb.
        almost: Gloss of that.
        already: Gloss of what is done, which says nothing of what is to come.
    """

    through: str
    reasons: frozenset[str]
    upon: str
    above: str
    about: frozenset[str]
    that: str
    asked: frozenset[str]
    companions: dict[str, str]
    little: str
    almost: str
    already: str


@dataclass(frozen=True)
class ComparisonWords:
    """What is compared; the section `comparisons`. All may be empty.

    Attributes:
        than: Word before the second of what is compared.
        of: Word of what something belongs to.
        preferring: Verbs of liking more.
        going: Verbs of going somewhere to do something.
        degrees: Words that compare.
        now: Gloss of the time that another one is compared with.
        before: Dictionary forms of what stands for a time or thing before this one: "que el pasado".
    """

    than: str
    of: str
    preferring: frozenset[str]
    going: frozenset[str]
    degrees: frozenset[str]
    now: str
    before: frozenset[str]


@dataclass(frozen=True)
class DenialWords:
    """What is denied; the section `denials`. All may be empty.

    Attributes:
        denying: Word that denies.
        negation: Its gloss.
        negatives: Glosses that deny and say more.
        too: Words of "too", behind "not only".
        rather: Word of "but" behind what is denied.
        but: Its gloss.
        all: Dictionary forms of those of whom one is left out.
        apart: Words before who is left out.
    """

    denying: str
    negation: str
    negatives: frozenset[str]
    too: frozenset[str]
    rather: str
    but: str
    all: frozenset[str]
    apart: frozenset[str]


@dataclass(frozen=True)
class CountWords:
    """How many; the section `counts`. All may be empty.

    Attributes:
        how_many: Gloss of a question word that may count, too: how many, so many.
        many: Its gloss where it counts.
        one: Articles that count, before a measure or behind "only".
        only: Words of "only".
        measures: Nouns of measures.
        is_verb: Verb behind which an article never counts: "solo era un susto".
        span: The two words of a span of numbers: from, to.
        until: Gloss between these.
        at_age: The two words before an age.
        age: Its gloss.
        ago: Word before it.
        past: Gloss of what is over.
    """

    how_many: str
    many: str
    one: frozenset[str]
    only: frozenset[str]
    measures: frozenset[str]
    is_verb: str
    span: tuple[str, ...]
    until: str
    at_age: tuple[str, ...]
    age: str
    ago: str
    past: str


@dataclass(frozen=True)
class ReliabilityWeights:
    """How likely a translation is right; the section `reliability`, as `pipeline/reliability.py` uses it.

    Attributes:
        base: Of any translation.
        least: For the least confidence among its glosses.
        doubt: For each gloss that the model is not sure of.
        gloss: For each gloss.
        verb: For each verb of the sentence.
        adjective: For each adjective.
    """

    base: float
    least: float
    doubt: float
    gloss: float
    verb: float
    adjective: float


@dataclass(frozen=True)
class PipelineWords:
    """All of it.

    Attributes:
        completeness: What may go without a gloss.
        persons: Who acts on whom.
        subjects: Who does what a verb says.
        connectives: Which mean more than one thing.
        comparisons: What is compared.
        denials: What is denied.
        counts: How many.
        reliability: How likely a translation is right.
    """

    completeness: CompletenessWords
    persons: PersonWords
    subjects: SubjectWords
    connectives: ConnectiveWords
    comparisons: ComparisonWords
    denials: DenialWords
    counts: CountWords
    reliability: ReliabilityWeights

    @property
    def of_nobody(self) -> frozenset[str]:
        """Dictionary forms of verbs whose third person nobody need do: "llueve", "hace frío", "me gusta"."""
        return self.completeness.of_things | self.subjects.impersonal | self.persons.experiencer_verbs

    @classmethod
    @cache
    def load(cls, folder: Path) -> PipelineWords:
        """Read the file of a language's text folder, once.

        Raises:
            TranslationError: "invalid_data" naming file and field.
        """
        sections = {
            "completeness": CompletenessWords,
            "persons": PersonWords,
            "subjects": SubjectWords,
            "connectives": ConnectiveWords,
            "comparisons": ComparisonWords,
            "denials": DenialWords,
            "counts": CountWords,
            "reliability": ReliabilityWeights,
        }
        return cls(**read_sections(folder / _FILE, sections))
