# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Morphology: what a word may be, and how a lemma is inflected.

`Morphology` gives a word's readings (dictionary form, tag, clitics), also where its accents were not typed,
and the forms of a lemma. Its lists are `lexicon` and `morphology` of the language.
"""

from teo_sign_translator.morphology.analyser import MAX_READINGS, Morphology
from teo_sign_translator.morphology.readings import TAGS, Reading, gloss_name, tag_class

__all__ = ["MAX_READINGS", "TAGS", "Morphology", "Reading", "gloss_name", "tag_class"]
