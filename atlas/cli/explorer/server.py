"""The server of the explorer: on this machine alone, for the browser that opened an address that works once.

That address sets a cookie, which script can't read and no other site's page makes a browser send, for a folder of this
server with a random name: cookies are those of all servers at 127.0.0.1, also of another user's. The name in a request
is looked up among the families, the figures and the file that the user named at the start; it is never a path.
"""

import hmac
import json
import secrets
from collections.abc import Callable, Mapping
from dataclasses import asdict
from html import escape
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import parse_qsl, urlsplit

from atlas.cli.explorer import answers
from atlas.cli.explorer.subjects import Subject, everything, subject, subject_or_file
from atlas.errors import AtlasError
from atlas.places import folder

HOST = "127.0.0.1"
POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'"
)
HEADERS = {
    "Content-Security-Policy": POLICY,
    "Cache-Control": "no-store",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}
PAGES = "", "explore.js", "scene.js", "sliders.js", "style.css", "explore.css", "icon.svg"
KINDS = {"html": "text/html", "js": "text/javascript", "css": "text/css", "svg": "image/svg+xml"}
COOKIE = "atlas"
OPENS = '<!DOCTYPE html>\n<title>atlas explore</title>\n<meta http-equiv="refresh" content="0; url={}">\n'
"""A page that leads on. A redirect would not do: after one that came from a file no browser sends a strict cookie."""
CLOSED = "an address that `atlas explore` printed opens it, once: reload the page that it opened, or start it again"
JSON = "application/json"
Content = tuple[bytes, str]


class Explorer(ThreadingHTTPServer):
    """A server for one user.

    Parameters
    ----------
    start : str
        Name of the family or figure, or file of a recipe, that is shown first.
    port : int, optional
        Port at 127.0.0.1; a free one for 0.
    place : str, optional
        Fragment of the page's address, beginning with #: where the sliders stand at first.
    """

    daemon_threads = True

    def __init__(self, start: str, port: int = 0, place: str = "") -> None:
        try:
            super().__init__((HOST, port), Handler)
        except OSError as error:
            raise AtlasError(f"The port {port} cannot be used ({error.strerror}): choose another, or none.") from error
        self.start, self.place, self.tickets = start, place, set[str]()
        self.folder, self.secret = secrets.token_urlsafe(24), secrets.token_urlsafe(24)
        self.hosts = {f"{name}:{self.server_address[1]}" for name in (HOST, "localhost")}

    def ticket(self) -> str:
        """Return a new URL that opens the explorer once."""
        new = secrets.token_urlsafe(24)
        self.tickets.add(new)
        return f"http://{HOST}:{self.server_address[1]}/{new}"

    def admits(self, ticket: str) -> bool:
        """Return whether a text is a ticket that was issued and not used, and invalidate it."""
        used = {issued for issued in [*self.tickets] if _are_equal(issued, ticket)}
        self.tickets -= used
        return bool(used)

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Print an error of a request as the standard library does; ignore a closed connection."""
        import sys

        if not isinstance(sys.exception(), ConnectionError):
            super().handle_error(request, client_address)


class Handler(BaseHTTPRequestHandler):
    """Handler of one request to the `Explorer`: refused unless it comes from this page on this machine.

    `timeout` is in seconds.
    """

    protocol_version, disable_nagle_algorithm = "HTTP/1.1", True
    timeout = 20  # seconds for which a connection may say nothing, half a request as well
    server: Explorer

    def do_GET(self) -> None:
        """Send the answer to a request, a page or data, or status 400, 403 or 404 for one that is refused.

        A wrong value gives a JSON object with the key "error".
        """
        try:
            url = urlsplit(self.path)
        except ValueError:  # as `http://[::1/`
            self._send(HTTPStatus.BAD_REQUEST, b"this is no address", "text/plain")
            return
        _, folder, *segments = [*url.path.split("/"), ""]
        if refused := self._refused(folder):
            self._send(HTTPStatus.FORBIDDEN, refused.encode(), "text/plain")
            return
        if not _are_equal(folder, self.server.folder):
            start = f"/{self.server.folder}/"
            cookie = f"{COOKIE}={self.server.secret}; Path={start}; HttpOnly; SameSite=Strict"
            page = OPENS.format(escape(start + self.server.place))
            self._send(HTTPStatus.OK, page.encode(), "text/html", {"Set-Cookie": cookie})
            return
        try:
            content = self._content("/".join(segments).rstrip("/"), dict(parse_qsl(url.query)))
        except AtlasError as error:
            content = json.dumps({"error": str(error)}).encode(), JSON
        except OSError as error:  # as on a full disk
            content = json.dumps({"error": f"{error.strerror or error}: nothing could be saved"}).encode(), JSON
        if content is None:
            self._send(HTTPStatus.NOT_FOUND, b"there is nothing here", "text/plain")
        else:
            self._send(HTTPStatus.OK, *content)

    def _refused(self, folder: str) -> str:
        """Return the reason why a request is refused, "" if it is not; `folder` is the first part of its path.

        Refused are another host or origin, and a request with neither the session's cookie nor a valid ticket.
        """
        if self.headers.get("Host", "") not in self.server.hosts:
            return "this server answers at 127.0.0.1 only"
        origin = self.headers.get("Origin")
        if origin is not None and origin.removeprefix("http://") not in self.server.hosts:
            return "this server answers its own page only"
        if _are_equal(folder, self.server.folder):
            cookies = [cookie.strip() for cookie in self.headers.get("Cookie", "").split(";")]
            return "" if any(_are_equal(cookie, f"{COOKIE}={self.server.secret}") for cookie in cookies) else CLOSED
        return "" if self.server.admits(folder) else CLOSED

    def _content(self, place: str, query: dict[str, str]) -> Content | None:
        """Return (content as bytes, media type) at a path, None for an unknown path.

        `query` holds the texts after "?" by name. Raises AtlasError for values with no picture.
        """
        if place in PAGES:
            name = place or "explore.html"
            return _page(name), KINDS[name.partition(".")[2]]
        answer = ANSWERS.get(place)
        return answer(self.server, query) if answer else None

    def _send(self, status: HTTPStatus, body: bytes, kind: str, headers: Mapping[str, str] = {}) -> None:
        self.send_response(status)
        charset = "; charset=utf-8" if kind.startswith("text/") else ""
        described = {"Content-Type": kind + charset, "Content-Length": str(len(body))}
        for name, value in {**HEADERS, **described, **headers}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_: Any) -> None:
        """Log nothing: an address in the terminal may be one that opens the explorer."""


def _are_equal(a: str, b: str) -> bool:
    """Return whether two texts are equal, compared in constant time."""
    return hmac.compare_digest(a.encode(), b.encode())


def _requested_subject(server: Explorer, query: dict[str, str]) -> Subject:
    """Return the subject named in a query: the explorer's start, which may be a file, or a listed family or figure.

    The name is taken out of `query`. Raises AtlasError for an unknown name.
    """
    name = query.pop("subject", "")
    return subject_or_file(name) if name == server.start else subject(name)


def _page(name: str) -> bytes:
    """Return the bytes of a file of the page, `name` in templates/html.

    The style sheet is the reports', without fonts.
    """
    from atlas.book.templates import templates
    from atlas.pictures.style import STYLES

    if name == "style.css":
        return templates("html").get_template(name).render(faces={}, looks=STYLES).encode()
    return (folder("templates") / "html" / name).read_bytes()


def _subjects(server: Explorer, _query: dict[str, str]) -> Content:
    return json.dumps({"start": server.start, **everything()}).encode(), JSON


def _sliders(server: Explorer, query: dict[str, str]) -> Content:
    chosen = _requested_subject(server, query)
    return json.dumps({"title": chosen.title, "sliders": [asdict(slider) for slider in chosen.sliders]}).encode(), JSON


def _state(server: Explorer, query: dict[str, str]) -> Content:
    proven = query.pop("proven", "") == "1"
    topic = _requested_subject(server, query)
    answer = answers.state(topic, answers.values_of(topic, query), proven=proven)
    return json.dumps(answer, separators=(",", ":")).encode(), JSON


def _figure(server: Explorer, query: dict[str, str]) -> Content:
    kind = query.pop("format", "svg")
    if kind not in answers.FILES:
        raise AtlasError(f"no figure can be saved as {kind!r}; known: {', '.join(answers.FILES)}")
    topic = _requested_subject(server, query)
    return answers.picture(topic, answers.values_of(topic, query), kind), answers.FILES[kind]


ANSWERS: dict[str, Callable[[Explorer, dict[str, str]], Content]] = {
    "subjects": _subjects,
    "sliders": _sliders,
    "state": _state,
    "figure": _figure,
}
