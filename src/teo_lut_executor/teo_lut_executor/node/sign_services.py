# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Answers about the look-up table: `list_signs` and `get_sign`."""

from __future__ import annotations

from rclpy.node import Node
from teo_sign_msgs.msg import SignToken
from teo_sign_msgs.srv import GetSign, ListSigns

from teo_lut_executor.node.messages import sign_trajectory
from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut
from teo_signs.sign import gloss_key

_KINDS = {"lexical": SignToken.KIND_LEXICAL, "letter": SignToken.KIND_LETTER, "number": SignToken.KIND_NUMBER}


class SignServices:
    """Serves `list_signs` and `get_sign` from a table that may change meanwhile.

    Attributes:
        lut: The table.
    """

    def __init__(self, node: Node, lut: Lut) -> None:
        """Serve.

        Args:
            node: Serves.
            lut: The table.
        """
        self._node = node
        self.lut = lut
        self._services = (
            node.create_service(ListSigns, "list_signs", self._on_list),
            node.create_service(GetSign, "get_sign", self._on_get),
        )

    def refresh(self) -> None:
        """Read the table again where it has changed."""
        problem = self.lut.refresh()
        if problem:
            self._node.get_logger().error(
                f"look-up table not read again: {problem}", throttle_duration_sec=5.0
            )

    def close(self) -> None:
        """Serve no more."""
        for service in self._services:
            self._node.destroy_service(service)

    def _on_list(self, request: ListSigns.Request, response: ListSigns.Response) -> ListSigns.Response:
        self.refresh()
        for problem in _list_signs(self.lut, request, response):
            self._node.get_logger().warning(problem)
        return response

    def _on_get(self, request: GetSign.Request, response: GetSign.Response) -> GetSign.Response:
        self.refresh()
        _get_sign(self.lut, request, response)
        return response


def _list_signs(lut: Lut, request: ListSigns.Request, response: ListSigns.Response) -> list[str]:
    """Fill in the language, the glosses that begin with the prefix, and their kinds.

    Returns:
        Why entries were left out; a sentence each.
    """
    problems: list[str] = []
    response.language = lut.language.code
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


def _get_sign(lut: Lut, request: GetSign.Request, response: GetSign.Response) -> None:
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
