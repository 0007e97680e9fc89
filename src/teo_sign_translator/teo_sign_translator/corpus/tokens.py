"""Words and glosses while a sentence is made; which gloss stands for which word is kept from the start."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from teo_sign_translator.corpus.grammar import Shape
    from teo_sign_translator.corpus.verb_phrase import VerbPhrase
    from teo_sign_translator.corpus.words import Word


@dataclass(slots=True, eq=False)
class Token:
    """A Spanish word or mark.

    Attributes:
        text: As written inside a sentence.
        article: Whether it is a feminine singular that "el agua" changes.
    """

    text: str
    article: bool = False


@dataclass(slots=True, eq=False)
class Sign:
    """A gloss.

    Attributes:
        gloss: Upper case.
        sources: The words that it stands for.
        pending: What else will say it, once that is known: `patterns.VERB` or `CLITIC`.
        tense: Time that it marks for all that follows: "past" or "future"; empty for other glosses. One
            without a gloss marks that a time word has said so.
    """

    gloss: str
    sources: list[Token] = field(default_factory=list)
    pending: str = ""
    tense: str = ""


@dataclass(slots=True, eq=False)
class Phrase:
    """A part of a sentence in both languages.

    Attributes:
        features: Person, number, gender and the like.
        tokens: Spanish.
        signs: LSE.
        head: The word that stands for the whole.
        verb: Its first verb, which shows the tense.
    """

    features: dict[str, str]
    tokens: list[Token]
    signs: list[Sign]
    head: Token | None = None
    verb: SaidVerb | None = None

    def say(self, pending: str, token: Token) -> None:
        """Add a word to the signs that wait for it."""
        for sign in self.signs:
            if sign.pending == pending:
                sign.sources.append(token)
                sign.pending = ""


@dataclass(slots=True, eq=False)
class SaidVerb:
    """A verb that is chosen first and said when its place in the sentence comes.

    Attributes:
        word: The verb.
        shape: Its tense and auxiliaries.
        said: What it has become.
    """

    word: Word
    shape: Shape
    said: VerbPhrase | None = None
