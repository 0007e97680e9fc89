"""Spanish morphology: what a word may be, and how a lemma is inflected."""

from teo_sign_translator.morphology.analyser import Morphology
from teo_sign_translator.morphology.reading import Reading
from teo_sign_translator.morphology.tags import TAGS, tag_class

__all__ = ["TAGS", "Morphology", "Reading", "tag_class"]
