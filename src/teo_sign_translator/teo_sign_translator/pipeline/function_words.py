"""The readable list of words that a translation into LSE may leave out."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path

from teo_common.text_folding import fold
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import TAGS, Reading
from teo_sign_translator.resources import data_file
from teo_sign_translator.tables import read_rows
from teo_sign_translator.text.source_words import SourceWord

_ANY = "*"


class FunctionWords:
    """Tells function words from words with a meaning of their own."""

    def __init__(self, lemmas: dict[str, frozenset[str]]) -> None:
        """Take lemmas by the beginning of the tag that they must have; `*` among them stands for all."""
        self._lemmas = dict(lemmas)

    @classmethod
    def load(cls, path: Path | None = None) -> FunctionWords:
        """Read the list.

        Args:
            path: The file; by default the package's `data/function_words.tsv`, which explains its columns.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        path = path or data_file("function_words.tsv")
        lemmas: dict[str, frozenset[str]] = {}
        for number, (tag, listed) in read_rows(path, columns=2):
            if tag in lemmas or not any(_begins(known, tag) for known in TAGS):
                raise TranslationError(
                    "invalid_data",
                    f"{path}, line {number}: expected the beginning of a tag, once, got '{tag}'",
                )
            lemmas[tag] = frozenset(lemma.strip() for lemma in listed.split(","))
        return cls(lemmas)

    def may_be_left_out(self, word: SourceWord) -> bool:
        """Whether one of a word's readings is a function word, or it is a mark.

        Who types accents means them: "quién" is not "quien"; "esta" may be "está".
        """
        plain = word.form == fold(word.form)
        return word.is_mark or any(self.lists(reading) for reading in word.readings if plain or reading.exact)

    def lists(self, reading: Reading) -> bool:
        """Whether this reading is that of a function word."""
        found = self._by_tag.get(reading.tag)
        if found is None:
            listed = [lemmas for tag, lemmas in self._lemmas.items() if _begins(reading.tag, tag)]
            found = self._by_tag[reading.tag] = frozenset[str]().union(*listed)
        return _ANY in found or reading.lemma in found

    @cached_property
    def _by_tag(self) -> dict[str, frozenset[str]]:
        return {}


def _begins(tag: str, beginning: str) -> bool:
    return tag == beginning or tag.startswith(f"{beginning}:")
