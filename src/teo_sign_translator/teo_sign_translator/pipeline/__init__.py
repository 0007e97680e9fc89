# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From a text to its translation: `Translator` reads it, asks a back end, and finds signs for what it says.

A back end translates sentences with its model. The pointer's (`PointerBackEnd`) asks its model once, puts
back the words that it left out (`completeness` says which, and where), and turns glosses into output words.
Other packages offer theirs by entry point, as `teo_sign_training` does for the published model.
"""
