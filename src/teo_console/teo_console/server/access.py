# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who may speak to the server: checked on every request before anything else.

A page of somebody else's, open in the same browser, must reach nothing: DNS rebinding is stopped by the Host
header, cross-site requests and websockets by the Origin header. Listening beyond this machine wants a token.
"""

from __future__ import annotations

import hmac
import ipaddress
import secrets
from dataclasses import dataclass
from urllib.parse import urlsplit

from aiohttp import web
from aiohttp.typedefs import Handler, Middleware

from teo_console.errors import ConsoleError

_COOKIE = "teo_console"
_QUERY = "token"
# 128 bits: not to be guessed (RFC 6750, section 5.2, asks for tokens that cannot be).
_TOKEN_BYTES = 16
# A lesson and its break [s]; after it the link is opened again.
_COOKIE_AGE = 12 * 3600
_SAFE_METHODS = frozenset({"GET", "HEAD"})
LOOPBACK_NAMES = frozenset({"127.0.0.1", "localhost", "::1"})

# Everything comes from here, nothing is inline. Blobs are what the camera gives to this page, and `data:`
# what a picture is drawn into.
_CONTENT_SECURITY_POLICY = "; ".join(
    (
        "default-src 'self'",
        "img-src 'self' data: blob:",
        "media-src 'self' blob:",
        "object-src 'none'",
        "base-uri 'none'",
        "form-action 'self'",
        "frame-ancestors 'none'",
    )
)
_HEADERS = {
    "Content-Security-Policy": _CONTENT_SECURITY_POLICY,
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Permissions-Policy": "camera=(self), microphone=(self), geolocation=(), payment=(), usb=()",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    # Asked for again each time: a page of yesterday must not speak to a node of today.
    "Cache-Control": "no-cache",
}


@dataclass(frozen=True, kw_only=True)
class Access:
    """The rule of one server."""

    hosts: frozenset[str]
    """Names and addresses under which it may be asked for, without the port."""
    token: str | None = None
    """What a browser must have been given; None: none is needed."""

    @classmethod
    def for_address(cls, address: str, names: frozenset[str]) -> Access:
        """The rule for listening at an address: a token as soon as it is not this machine's own.

        Args:
            address: IP address to listen at; "0.0.0.0" and "::" are all of the machine's.
            names: Names and addresses under which others reach this machine.

        Raises:
            ConsoleError: "bad_address": it is no IP address.
        """
        try:
            parsed = ipaddress.ip_address(address)
        except ValueError as error:
            raise ConsoleError(
                "bad_address",
                f"expected an IP address to listen at, as 127.0.0.1 or 0.0.0.0, got {address!r}",
            ) from error
        if parsed.is_loopback:
            return cls(hosts=LOOPBACK_NAMES | {address})
        own = frozenset() if parsed.is_unspecified else frozenset({address})
        return cls(hosts=LOOPBACK_NAMES | own | names, token=secrets.token_urlsafe(_TOKEN_BYTES))

    def check(self, request: web.Request) -> None:
        """Let a request pass.

        Raises:
            ConsoleError: "bad_host", "bad_origin", "no_token".
        """
        host = request.headers.get("Host", "")
        if _name_of(host) not in self.hosts:
            raise ConsoleError(
                "bad_host",
                f"expected this server under {', '.join(sorted(self.hosts))}, was asked for {host!r}: "
                "name it in the parameter allowed_hosts if it is right",
            )
        origin = request.headers.get("Origin")
        upgrades = request.headers.get("Upgrade", "").lower() == "websocket"
        if origin is None and (upgrades or request.method not in _SAFE_METHODS):
            raise ConsoleError("bad_origin", "expected an Origin header, as browsers send, got none")
        if origin is not None and urlsplit(origin).netloc != host:
            raise ConsoleError("bad_origin", f"expected a page of http://{host}, got one of {origin!r}")
        if self.token is not None and not self._has_token(request):
            raise ConsoleError(
                "no_token", "expected the link with the token, which the console printed when it started"
            )

    def _has_token(self, request: web.Request) -> bool:
        # A cookie may be of a server before this one, whose link was opened again since.
        given = (request.query.get(_QUERY, ""), request.cookies.get(_COOKIE, ""))
        return self.token is not None and any(
            hmac.compare_digest(one.encode(), self.token.encode()) for one in given
        )

    def link(self, host: str, port: int) -> str:
        """Where a browser finds the page."""
        query = "" if self.token is None else f"?{_QUERY}={self.token}"
        return f"http://{f'[{host}]' if ':' in host else host}:{port}/{query}"

    def remembers(self, request: web.Request) -> web.Response | None:
        """For a page that came by the link: keep the token as a cookie, and take it out of the address."""
        if self.token is None or _QUERY not in request.query:
            return None
        response = web.Response(status=303, headers={"Location": request.path})
        response.set_cookie(
            _COOKIE, self.token, max_age=_COOKIE_AGE, httponly=True, samesite="Strict", path="/"
        )
        return response


def guard(access: Access) -> Middleware:
    """Make the middleware that applies the rule, and puts the headers on every answer."""

    @web.middleware
    async def guarded(request: web.Request, handler: Handler) -> web.StreamResponse:
        try:
            access.check(request)
            response = access.remembers(request) or await handler(request)
        except ConsoleError as error:
            response = refusal(error, 401 if error.code == "no_token" else 403)
        except web.HTTPException as error:
            error.headers.update(_HEADERS)
            raise
        if not response.prepared:
            response.headers.update(_HEADERS)
        return response

    return guarded


def refusal(error: ConsoleError, status: int) -> web.Response:
    """An error as a page of /api reads it."""
    return web.json_response({"code": error.code, "message": str(error)}, status=status)


def _name_of(host: str) -> str:
    """A Host header without its port; empty if it is none."""
    try:
        return urlsplit(f"//{host}").hostname or ""
    except ValueError:
        return ""
