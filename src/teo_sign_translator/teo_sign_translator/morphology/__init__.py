# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Spanish morphology: what a word may be, and how a lemma is inflected.

`Morphology` gives a word's readings (dictionary form, tag, clitics), also where its accents were not typed,
and the forms of a lemma. Its lists are `data/lexicon` and `data/morphology`.
"""

from teo_sign_translator.morphology.analyser import Morphology
from teo_sign_translator.morphology.reading import Reading
from teo_sign_translator.morphology.tags import TAGS, tag_class

__all__ = ["TAGS", "Morphology", "Reading", "tag_class"]
