# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The web server against what the network may send it: other sites, other hosts, nonsense, floods, crowds."""

from __future__ import annotations

import asyncio
import json
import xml.etree.ElementTree as ET
import zlib
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import aiohttp
import pytest
from aiohttp import WSMsgType

from teo_console.errors import ConsoleError
from teo_console.protocol import MESSAGE_BYTES, Answer, FromPage
from teo_console.server.access import Access
from teo_console.server.app import drawable_urdf, make_app
from teo_console.server.hub import Hub
from teo_console.server.thread import ServerThread

pytestmark = pytest.mark.usefixtures("runner")
WEB = Path(__file__).parents[1] / "web"
PATIENCE = 20.0  # [s] for an answer on a loaded machine
CROWD = 50


LOCAL = Access.for_address("127.0.0.1", frozenset())
WIDE = Access.for_address("0.0.0.0", frozenset({"127.0.0.1", "lab.example"}))


async def done(asked: FromPage) -> Answer:
    return Answer(id=asked.id, success=True)


class Server:
    """A server on a free port, with a hub that says yes to everything."""

    def __init__(self, access: Access = LOCAL, serve: Callable[[FromPage], Any] = done) -> None:
        self.hub = Hub(serve)
        self.access = access
        self.thread = ServerThread(
            lambda: make_app(web_folder=WEB, access=access, hub=self.hub, urdf=lambda: "<robot/>"),
            "127.0.0.1",
            0,
        )
        self.url = f"http://127.0.0.1:{self.thread.port}"

    @asynccontextmanager
    async def page(self, session: aiohttp.ClientSession) -> AsyncIterator[aiohttp.ClientWebSocketResponse]:
        async with session.ws_connect(f"{self.url}/ws", origin=self.url) as socket:
            yield socket


@pytest.fixture
def server(request: pytest.FixtureRequest) -> Iterator[Server]:
    """One that only this machine reaches, or made with what a test asks for."""
    opened = Server(**getattr(request, "param", {}))
    yield opened
    opened.thread.close()


@pytest.fixture
def session(runner: asyncio.Runner) -> Iterator[aiohttp.ClientSession]:
    async def opened() -> aiohttp.ClientSession:
        return aiohttp.ClientSession()

    made = runner.run(opened())
    yield made
    runner.run(made.close())


async def answer_of(socket: aiohttp.ClientWebSocketResponse) -> dict[str, Any]:
    while True:
        message = await socket.receive(PATIENCE)
        assert message.type is WSMsgType.TEXT, message
        told: dict[str, Any] = json.loads(message.data)
        if told["type"] == "answer":
            return told


async def test_the_page_comes_with_headers_that_let_it_load_nothing_from_elsewhere(
    server: Server, session: aiohttp.ClientSession
) -> None:
    for path in ("/", "/js/main.js", "/api/robot.urdf", "/nothing/here"):
        async with session.get(server.url + path) as response:
            policy = response.headers["Content-Security-Policy"]
            assert "default-src 'self'" in policy
            assert "unsafe" not in policy
            assert "*" not in policy
            assert response.headers["X-Content-Type-Options"] == "nosniff"


async def test_what_the_page_loads_is_sent_compressed(server: Server) -> None:
    paths = [path for path in WEB.rglob("*") if path.suffix in (".js", ".css", ".json", ".svg")]
    sent = 0
    async with aiohttp.ClientSession(auto_decompress=False) as session:
        for path in paths:
            async with session.get(f"{server.url}/{path.relative_to(WEB)}") as answer:
                assert answer.headers["Content-Encoding"] == "deflate"
                coded = await answer.read()
            assert zlib.decompress(coded) == path.read_bytes()
            sent += len(coded)
    assert sent < sum(path.stat().st_size for path in paths) / 3


async def test_what_the_browser_has_is_told_without_a_body_and_the_connection_goes_on(server: Server) -> None:
    host = server.url.removeprefix("http://")
    reader, writer = await asyncio.open_connection(*host.split(":"))

    async def ask(method: str, more: str = "") -> tuple[str, dict[str, str], bytes]:
        told = f"{method} /js/main.js HTTP/1.1\r\nHost: {host}\r\nAccept-Encoding: gzip\r\n{more}\r\n"
        writer.write(told.encode())
        first, *lines = (await reader.readuntil(b"\r\n\r\n")).decode().strip().split("\r\n")
        headers = dict(line.lower().split(": ", 1) for line in lines)
        body = b""
        while method == "GET" and headers.get("transfer-encoding") == "chunked":
            size = int(await reader.readline(), 16)
            body += (await reader.readexactly(size + 2))[:-2]
            if not size:
                break
        return first.split()[1], headers, body

    status, headers, body = await ask("GET")
    assert status == "200" and zlib.decompress(body, wbits=47) == (WEB / "js/main.js").read_bytes()
    for more in (
        f"If-None-Match: {headers['etag']}\r\n",
        f"If-Modified-Since: {headers['last-modified']}\r\n",
    ):
        assert (await ask("GET", more))[0] == "304"
        assert (await ask("HEAD"))[0] == "200"
        assert (await ask("GET"))[2] == body  # the next answer begins where that one ended
    writer.close()


async def test_no_file_outside_the_page_is_given_out(server: Server, session: aiohttp.ClientSession) -> None:
    for path in ("/../setup.py", "/%2e%2e/setup.py", "/js/..%2f..%2fsetup.py", "//etc/passwd", "/js/"):
        url = aiohttp.client.URL(server.url + path, encoded=True)
        async with session.get(url) as response:
            assert response.status in (403, 404), path


async def test_another_host_name_is_refused(server: Server, session: aiohttp.ClientSession) -> None:
    for host in ("evil.example", f"evil.example:{server.thread.port}", "127.0.0.1.evil.example", "", "[::1"):
        async with session.get(server.url, headers={"Host": host}) as response:
            assert response.status == 403, host
            assert (await response.json())["code"] == "bad_host"


async def test_a_page_of_another_site_reaches_nothing(server: Server, session: aiohttp.ClientSession) -> None:
    origins = ("http://evil.example", "null", f"http://localhost:{server.thread.port}", "http://127.0.0.1:1")
    for origin in origins:
        with pytest.raises(aiohttp.WSServerHandshakeError) as refused:
            await session.ws_connect(f"{server.url}/ws", origin=origin)
        assert refused.value.status == 403, origin
        async with session.post(f"{server.url}/api/any", headers={"Origin": origin}) as response:
            assert (await response.json())["code"] == "bad_origin"
    with pytest.raises(aiohttp.WSServerHandshakeError):
        await session.ws_connect(f"{server.url}/ws")  # no browser, or one that hides where it is


async def test_what_makes_no_sense_is_answered_and_at_last_shut_out(
    server: Server, session: aiohttp.ClientSession
) -> None:
    async with server.page(session) as page:
        for message in ("", "{", "[1]", '{"type":"sign_text"}', '{"type":"x","id":1}'):
            await page.send_str(message)
            assert (await answer_of(page))["code"] == "malformed"
        await page.send_bytes(b"\x00\xff")
        assert (await answer_of(page))["code"] == "malformed"
        await page.send_str('{"type":"command","id":7,"order":"stop"}')
        assert await answer_of(page) == {"type": "answer", "id": 7, "success": True} | {
            "code": "", "message": "", "sign": None
        }  # fmt: skip
        for _ in range(4):
            await page.send_str("nonsense")
        while (message := await page.receive(PATIENCE)).type is WSMsgType.TEXT:
            pass
        assert message.type in (WSMsgType.CLOSE, WSMsgType.CLOSING, WSMsgType.CLOSED)


async def test_a_message_that_is_too_large_ends_the_connection_and_nothing_else(
    server: Server, session: aiohttp.ClientSession
) -> None:
    async with server.page(session) as page:
        await page.send_str("a" * (MESSAGE_BYTES + 1))
        message = await page.receive(PATIENCE)
        assert message.type in (WSMsgType.CLOSE, WSMsgType.CLOSED)
    async with session.get(server.url) as response:
        assert response.status == 200
    async with server.page(session) as page:
        await page.send_str('{"type":"command","id":1,"order":"pause"}')
        assert (await answer_of(page))["success"]


async def test_a_flood_is_slowed_down_with_a_reason(server: Server, session: aiohttp.ClientSession) -> None:
    async with server.page(session) as page:
        for number in range(100):
            await page.send_str(json.dumps({"type": "command", "id": number, "order": "pause"}))
        answers = [await answer_of(page) for _ in range(100)]
    assert sum(answer["success"] for answer in answers) >= 30  # what a person does at once
    assert sum(answer["code"] == "too_fast" for answer in answers) >= 30


async def test_fifty_pages_get_the_same_and_one_that_does_not_read_holds_nobody_up(
    server: Server, session: aiohttp.ClientSession
) -> None:
    server.thread.call(server.hub.welcome, '{"type":"welcome"}')
    pages = [await session.ws_connect(f"{server.url}/ws", origin=server.url) for _ in range(CROWD)]
    heard = [(await page.receive(PATIENCE)).data for page in pages]
    assert heard == ['{"type":"welcome"}'] * CROWD
    for number in range(20):
        server.thread.call(server.hub.pose, bytes([number]) * 4000)
        server.thread.call(server.hub.situation, json.dumps({"type": "situation", "number": number}))
    for page in pages[1:]:  # the first reads nothing
        while True:
            message = await page.receive(PATIENCE)
            if message.type is WSMsgType.TEXT and json.loads(message.data).get("number") == 19:
                break
    assert server.hub.pages == CROWD
    for page in pages:
        await page.close()
    while server.hub.pages:
        await asyncio.sleep(0.01)


async def never_the_first(asked: FromPage) -> Answer:
    if asked.id == 1:
        await asyncio.Event().wait()
    return await done(asked)


@pytest.mark.parametrize("server", [{"serve": never_the_first}], indirect=True)
async def test_an_order_does_not_wait_for_what_was_asked_before(
    server: Server, session: aiohttp.ClientSession
) -> None:
    async with server.page(session) as page:
        await page.send_str('{"type":"get_sign","id":1,"gloss":"HOLA"}')
        await page.send_str('{"type":"command","id":2,"order":"stop"}')
        assert (await answer_of(page))["id"] == 2


@pytest.mark.parametrize("server", [{"access": WIDE}], indirect=True)
async def test_listening_wider_takes_the_token_of_the_link(
    server: Server, session: aiohttp.ClientSession
) -> None:
    for path in ("", "/?token=wrong"):
        async with session.get(server.url + path) as response:
            assert response.status == 401
            assert (await response.json())["code"] == "no_token"
    with pytest.raises(aiohttp.WSServerHandshakeError):
        await session.ws_connect(f"{server.url}/ws", origin=server.url)
    # A browser that was here before: the server has another token since it was started again.
    jar, old = aiohttp.CookieJar(unsafe=True), {"teo_console": "of yesterday"}
    async with aiohttp.ClientSession(cookie_jar=jar, cookies=old) as guest:
        async with guest.get(server.url) as response:
            assert response.status == 401
        async with guest.get(server.access.link("127.0.0.1", server.thread.port)) as response:
            assert response.status == 200
            assert "token" not in str(response.url)  # it is not left in the history or in what is copied
        async with server.page(guest) as page:
            await page.send_str('{"type":"command","id":1,"order":"pause"}')
            assert (await answer_of(page))["success"]


def test_this_machine_alone_takes_no_token_and_tokens_differ() -> None:
    assert [Access.for_address(own, frozenset()).token for own in ("127.0.0.1", "::1")] == [None, None]
    tokens = {Access.for_address("0.0.0.0", frozenset()).token for _ in range(20)}
    assert len(tokens) == 20


def test_an_address_that_is_none_is_refused() -> None:
    with pytest.raises(ConsoleError) as refused:
        Access.for_address("everywhere", frozenset())
    assert refused.value.code == "bad_address"


def test_a_port_that_is_taken_is_named(server: Server) -> None:
    with pytest.raises(ConsoleError, match=str(server.thread.port)) as refused:
        ServerThread(aiohttp.web.Application, "127.0.0.1", server.thread.port)
    assert refused.value.code == "port_taken"


def test_a_robot_of_meshes_is_drawn_by_its_plain_shapes() -> None:
    mesh, box = '<geometry><mesh filename="a.STL"/></geometry>', '<geometry><box size="1 1 1"/></geometry>'
    both = (
        f"<link name='both'><visual>{mesh}</visual><collision><origin xyz='1 2 3'/>{box}</collision></link>"
    )
    bare = f"<link name='bare'><visual>{mesh}</visual><collision>{mesh}</collision></link>"
    plain = f"<link name='plain'><visual>{box}</visual></link>"
    robot = ET.fromstring(drawable_urdf(f"<robot name='r'>{both}{bare}{plain}</robot>"))
    drawn = {link.attrib["name"]: link.findall("visual") for link in robot}
    assert [len(drawn[name]) for name in ("both", "bare", "plain")] == [1, 0, 1]
    assert drawn["both"][0].find("geometry/box") is not None
    assert drawn["both"][0].find("origin").attrib["xyz"] == "1 2 3"
    untouched = f"<robot name='r'>{plain}</robot>"
    assert drawable_urdf(untouched) == untouched
    assert drawable_urdf("no XML") == "no XML"
