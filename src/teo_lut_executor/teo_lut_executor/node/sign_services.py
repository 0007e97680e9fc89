# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Answers about the look-up table: `list_signs` and `get_sign`."""

from __future__ import annotations

from teo_sign_msgs.msg import SignToken
from teo_sign_msgs.srv import GetSign, ListSigns

from teo_lut_executor.node.messages import sign_trajectory
from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut
from teo_signs.sign import gloss_key

_KINDS = {"lexical": SignToken.KIND_LEXICAL, "letter": SignToken.KIND_LETTER, "number": SignToken.KIND_NUMBER}


def list_signs(lut: Lut, request: ListSigns.Request, response: ListSigns.Response) -> list[str]:
    """Fill in the glosses that begin with the prefix, and their kinds.

    Returns:
        Why entries were left out; a sentence each.
    """
    problems: list[str] = []
    prefix = gloss_key(request.prefix)
    for gloss in lut.glosses():
        if gloss.startswith(prefix):
            try:
                kind = _KINDS[lut[gloss].kind]
            except LutError as error:
                problems.append(f"not listed: {error}")
                continue
            response.glosses.append(gloss)
            response.kinds.append(kind)
    return problems


def get_sign(lut: Lut, request: GetSign.Request, response: GetSign.Response) -> None:
    """Fill in one sign, or why there is none ("unknown_sign", "invalid_sign")."""
    try:
        sign = lut[request.gloss]
        response.entry = lut.path(request.gloss).read_text(encoding="utf-8")
    except (LutError, OSError) as error:
        unknown = isinstance(error, LutError) and error.code == "unknown_sign"
        response.code = "unknown_sign" if unknown else "invalid_sign"
        response.message = str(error)
        return
    response.trajectory = sign_trajectory(sign)
    response.handedness = sign.handedness
    response.success = True
