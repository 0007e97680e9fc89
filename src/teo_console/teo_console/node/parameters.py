# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The console's parameters: a row each."""

from __future__ import annotations

from teo_common.parameters import ROBOT, ParameterRow
from teo_sign_languages import DEFAULT_LANGUAGE

PARAMETERS = (
    ROBOT,
    ParameterRow(
        name="language",
        default=DEFAULT_LANGUAGE,
        description="Sign language, by its ISO 639-3 code, until a translator tells the one that runs.",
        read_only=True,
    ),
    ParameterRow(
        name="address",
        default="127.0.0.1",
        description="IP address to listen at; 0.0.0.0 for all of the machine's, which takes a token.",
        read_only=True,
    ),
    ParameterRow(
        name="port",
        # Assigned to nobody by IANA, and below Linux's ephemeral range.
        default=8470,
        description="TCP port that the page is served at; 0 for any that is free.",
        low=0,
        high=65535,
        read_only=True,
    ),
    ParameterRow(
        name="allowed_hosts",
        default="",
        description="More names under which browsers may ask for the page, with commas between them.",
        read_only=True,
    ),
    ParameterRow(
        name="pose_rate",
        # As films have it; a browser draws what lies between.
        default=30.0,
        description="Poses sent to each page [Hz].",
        low=1.0,
        high=60.0,
        read_only=True,
    ),
)
