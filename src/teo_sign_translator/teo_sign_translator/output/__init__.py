"""What is signed: output words while a sentence is put together, the signs that show them, and its tokens.

An `OutputWord` is a gloss, a spelled word, a number or a pause, with the typed words that it says.
`SignChooser` makes it of what has signs. A `Translation` holds the numbered tokens of all sentences.
"""

from teo_sign_translator.output.output_words import OutputWord
from teo_sign_translator.output.sign_choice import SignChooser, read_signs
from teo_sign_translator.output.translation import Kind, Origin, Sentence, Token, Translation

__all__ = [
    "Kind",
    "Origin",
    "OutputWord",
    "Sentence",
    "SignChooser",
    "Token",
    "Translation",
    "read_signs",
]
