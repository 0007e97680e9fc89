# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `capture_node`, in one table."""

from __future__ import annotations

from teo_common.parameters import ROBOT, ParameterRow
from teo_sign_capture.recordings.live_take import LONGEST_WAIT
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.sign_schema import SOURCE_STANDINGS

CAPTURE_PARAMETERS = (
    ROBOT,
    ParameterRow(
        name="language",
        default=DEFAULT_LANGUAGE,
        description="Sign language that entries are of, by its ISO 639-3 code.",
    ),
    ParameterRow(
        name="lut_directory",
        default="",
        description="Directory that entries go to; empty for the user's own table of language and robot.",
    ),
    ParameterRow(
        name="recordings_directory",
        default="",
        description="Where recordings are kept; empty for the user's cache.",
    ),
    ParameterRow(
        name="pictures_directory",
        default="",
        description="Where pictures of demonstration and robot go; empty for beside the entries.",
    ),
    ParameterRow(
        name="standing",
        default="recorded",
        description=f"How well founded what is shown is: {', '.join(SOURCE_STANDINGS)}.",
    ),
    ParameterRow(
        name="licence",
        default="not stated: ask the person who signs before passing it on",
        description="Terms of the recordings, for the entries.",
    ),
    ParameterRow(
        name="longest_wait",
        default=LONGEST_WAIT,
        low=1.0,
        high=60.0,
        description="Time after the countdown in which a sign must end [s].",
    ),
)
