# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a word that connects others means, by the words around it.

"Por" gives a reason ("no fui por la lluvia"), a way ("pasé por tu casa") or who did it ("escrito por mi
madre"); "sobre" says what is spoken of ("un libro sobre la guerra") or on what something lies ("un libro
sobre la mesa"). LSE signs the reason and the place above, and nothing for the others. "Que" without its
accent joins or compares, and asks nothing; "por poco" is almost; a person behind a preposition may only tell
who is meant ("el chico que vive conmigo").
"""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import replace
from pathlib import Path

from teo_sign_translator.morphology import gloss_name
from teo_sign_translator.morphology.lexicon import nouns
from teo_sign_translator.pipeline.completeness import CompleteTranslation, own_places, read_gloss
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.pointer import OutputGloss
from teo_sign_translator.text.source_word import CLITICS, COMPANIONS, FINITE, SourceWord

#: Classes of nouns through which, by which or at which something is done.
_WAYS = frozenset({"place", "building", "room", "furniture", "body", "time"})
#: Classes of nouns on which something may lie.
_BEARERS = frozenset({"furniture", "object", "device", "vehicle", "container", "body", "music", "room"})
#: Classes on which nothing lies.
_TOPICS = frozenset({"abstract", "event", "media", "subject", "money", "illness", "time", "document"})
#: Who may have done what a participle says.
_AGENTS = frozenset({"person", "family", "profession", "animal", "group"})
#: Classes on which a thing lies even if it may be about them: a book on the table.
_SURFACES = frozenset({"furniture", "room"})
#: What may stand between a preposition and its noun, and between what is spoken of and the preposition.
_BETWEEN = ("DET", "A:", "NUM", "ADV", "PRON:obj")
_QUANTITIES = ("DET:quant", "PRON:neg", "NUM")
_COMING = "V:ind:fut"
_WENT = "V:ind:impf"
#: What begins something that is done.
_DONE = ("V:ind", "ADV:neg", *CLITICS)


class Connectives:
    """Reads the words of a language that connect others."""

    def __init__(self, folder: Path) -> None:
        """Read a language's text folder.

        Raises:
            TranslationError: "invalid_data" naming file and field.
        """
        language = PipelineWords.load(folder)
        self._said, self._preferring = language.connectives, language.comparisons.preferring
        self._future = language.completeness
        self._going = gloss_name(self._future.goes)
        self._classes = {noun.lemma: frozenset(noun.classes) for noun in nouns(folder)}

    def read(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """A translation without what no such word means here, and with what one does.

        Args:
            words: Of the sentence.
            said: A translation of it.
        """
        said = self._without_going(words, self._without_already(words, self._with_almost(words, said)))
        wrong = [place for place, gloss in enumerate(said.glosses) if self._is_wrong(words, gloss)]
        said = said.without(wrong)
        for place, word in enumerate(words):
            claimed = any(place in gloss.sources for gloss in said.glosses)
            if word.form == self._said.upon and not claimed and self._bears(words, place):
                said = self._with_above(said, place, _noun_behind(words, place))
        return self._with_almost_before(words, self._with_companion(words, said))

    def _with_companion(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with "with" or "for" where somebody only tells who is meant: "el que vive conmigo"."""
        for at, gloss in enumerate(said.glosses):
            place = gloss.sources[0] if len(gloss.sources) == 1 else 0
            if not words[place].tag.startswith(COMPANIONS):
                continue
            forms = [word.form for word in words[max(0, place - 1) : place + 1]]
            name = next((self._said.companions[form] for form in forms if form in self._said.companions), "")
            before = next((back for back in range(place, 0, -1) if words[back].form == self._said.that), 0)
            is_relative = before > 0 and words[before - 1].tag.startswith("N:")
            if name and is_relative and (at == 0 or said.glosses[at - 1].gloss != name):
                return said.with_glosses(at, read_gloss(name, place))
        return said

    def _with_almost(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with what almost happened: "por poco pierdo el tren", but not "por poco dinero"."""
        little = [
            (at + 1,)
            for at, word in enumerate(words[:-2])
            if word.form == self._said.through
            and words[at + 1].form == self._said.little
            and words[at + 2].tag.startswith(_DONE)
        ]
        if any(gloss.gloss == self._said.almost for gloss in said.glosses):
            return said.without([at for at, gloss in enumerate(said.glosses) if gloss.sources in little])
        glosses = tuple(
            replace(gloss, gloss=self._said.almost) if gloss.sources in little else gloss
            for gloss in said.glosses
        )
        return replace(said, glosses=glosses)

    def _with_almost_before(
        self, words: Sequence[SourceWord], said: CompleteTranslation
    ) -> CompleteTranslation:
        """The same with "almost" before what it belongs to: "casi todos" is CASI TODO."""
        own = [own_places(words, gloss) for gloss in said.glosses]
        almost = next((at for at, gloss in enumerate(said.glosses) if gloss.gloss == self._said.almost), -1)
        if almost < 0 or len(own[almost]) != 1:
            return said
        behind = own[almost].pop() + 1
        of = next((at for at, places in enumerate(own) if places == {behind}), -1)
        if of < 0 or not words[behind].tag.startswith(_QUANTITIES):
            return said
        order = [at for at in range(len(own)) if at != almost]
        order.insert(order.index(of), almost)
        return said.in_order(order)

    def _without_going(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same without a verb that says only what was to come, "iba a llamarte", and goes nowhere."""
        going = {
            at
            for at, word in enumerate(words)
            if word.tag.startswith(_WENT) and self._future.says_only_the_future(words, at)
        }
        named = [going & {*gloss.sources} and gloss.gloss == self._going for gloss in said.glosses]
        return said.without([at for at, is_going in enumerate(named) if is_going])

    def _without_already(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same without "already" before what is still to come: "ya te enseñaré"."""

        def comes(place: int) -> bool:
            done = (word.tag for word in words[place:] if word.tag.startswith(FINITE))
            return next(done, "").startswith(_COMING)

        already = (at for at, gloss in enumerate(said.glosses) if gloss.gloss == self._said.already)
        return said.without([at for at in already if any(map(comes, own_places(words, said.glosses[at])))])

    def _is_wrong(self, words: Sequence[SourceWord], gloss: OutputGloss) -> bool:
        if gloss.gloss in self._said.asked:
            asks = words[-1].form == "?" or any(word.tag.startswith("WH") for word in words)
            return not (gloss.sources or asks) or any(
                self._joins(words, at) or self._compares(words, at) for at in gloss.sources
            )
        is_reason = gloss.gloss in self._said.reasons
        if not is_reason and gloss.gloss != self._said.above:
            return False
        preposition = self._said.through if is_reason else self._said.upon
        place = next((at for at in gloss.sources if words[at].form == preposition), -1)
        if place < 0:
            return False
        behind = self._classes_of(words, _noun_behind(words, place))
        if is_reason:
            is_agent = place > 0 and any(
                reading.tag.startswith("V:part") for reading in words[place - 1].readings
            )
            return not behind.isdisjoint(_WAYS | (_AGENTS if is_agent else frozenset()))
        is_topic = not _TOPICS.isdisjoint(behind) and _BEARERS.isdisjoint(behind)
        return is_topic or self._is_about(words, place)

    def _joins(self, words: Sequence[SourceWord], place: int) -> bool:
        """Whether "que" asks nothing: typed with care it is no "qué", but in "no sé que hacer"."""
        follows = words[place + 1 :]
        asks = bool(follows) and follows[0].tag == "V:inf"
        return words[place].form == self._said.that and _is_typed_with_care(words) and not asks

    def _compares(self, words: Sequence[SourceWord], place: int) -> bool:
        """Whether a word asks nothing, but names what is liked less: "prefiero leer que salir"."""
        preferred = any(word.readings[0].lemma in self._preferring for word in words[:place])
        return preferred and words[place].form == self._said.that and words[-1].form != "?"

    def _is_about(self, words: Sequence[SourceWord], place: int) -> bool:
        """Whether what stands before a preposition can be about something, and not lie on what is behind."""
        before = next((word for word in reversed(words[:place]) if not word.tag.startswith(_BETWEEN)), None)
        if before is None or before.readings[0].lemma not in self._said.about:
            return False
        lies = before.tag.startswith("N")
        return not lies or _SURFACES.isdisjoint(self._classes_of(words, _noun_behind(words, place)))

    def _bears(self, words: Sequence[SourceWord], place: int) -> bool:
        bearing = not _BEARERS.isdisjoint(self._classes_of(words, _noun_behind(words, place)))
        is_preposition = words[place].tag == "PREP"
        return bearing and is_preposition and not self._is_about(words, place)

    def _classes_of(self, words: Sequence[SourceWord], place: int) -> Set[str]:
        """Classes of a noun; none at no place."""
        return self._classes.get(words[place].readings[0].lemma, frozenset()) if place >= 0 else frozenset()

    def _with_above(self, said: CompleteTranslation, place: int, noun: int) -> CompleteTranslation:
        """The same with the place above behind the gloss of a noun; as it is if none says the noun alone."""
        behind = next((at + 1 for at, gloss in enumerate(said.glosses) if gloss.sources == (noun,)), 0)
        if not behind:
            return said
        return said.with_glosses(behind, read_gloss(self._said.above, place))


def _is_typed_with_care(words: Sequence[SourceWord]) -> bool:
    """Whether a sentence is no question and has its capital and its mark, so that "que" is not "qué"."""
    return words[0].text[:1].isupper() and words[-1].is_mark and words[-1].form != "?"


def _noun_behind(words: Sequence[SourceWord], place: int) -> int:
    """Where the noun of a preposition is; -1 if there is none."""
    behind = (at for at in range(place + 1, len(words)) if not words[at].tag.startswith(_BETWEEN))
    noun = next(behind, -1)
    return noun if noun >= 0 and words[noun].tag.startswith("N:") else -1
