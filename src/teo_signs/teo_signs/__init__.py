# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A sign and the table of signs: file, schema, evidence, tokens, lexicon, mirroring, likeness, export."""

from teo_signs.errors import LutError, PlanError
from teo_signs.lexicon import DEFAULT_STANDING, Lexicon, SignedToken
from teo_signs.look_up_table import Lut, default_lut_directory, user_lut_directory
from teo_signs.sign import Sign, gloss_key
from teo_signs.sign_file import read_sign, save_sign
from teo_signs.sign_schema import STANDINGS, Provenance, Standing, sign_json_schema
from teo_signs.tokens import Kind, Token, parse_printed

__all__ = [
    "DEFAULT_STANDING",
    "STANDINGS",
    "Kind",
    "Lexicon",
    "Lut",
    "LutError",
    "PlanError",
    "Provenance",
    "Sign",
    "SignedToken",
    "Standing",
    "Token",
    "default_lut_directory",
    "gloss_key",
    "parse_printed",
    "read_sign",
    "save_sign",
    "sign_json_schema",
    "user_lut_directory",
]
