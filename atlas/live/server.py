"""The server of the explorer: on this machine alone, for who knows the token in its address, and for no other page."""

import hmac
import json
import secrets
from collections.abc import Callable
from dataclasses import asdict
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import parse_qsl, urlsplit

from atlas.errors import AtlasError
from atlas.live import answers
from atlas.live.subjects import everything, subject
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
PAGES = {
    "": ("explore.html", "text/html"),
    "explore.js": ("explore.js", "text/javascript"),
    "scene.js": ("scene.js", "text/javascript"),
    "sliders.js": ("sliders.js", "text/javascript"),
    "style.css": ("style.css", "text/css"),
    "explore.css": ("explore.css", "text/css"),
    "icon.svg": ("icon.svg", "image/svg+xml"),
}
JSON = "application/json"
Content = tuple[bytes, str]


class Explorer(ThreadingHTTPServer):
    """A server for one user; `address` is what to open."""

    daemon_threads = True

    def __init__(self, start: str, port: int = 0) -> None:
        try:
            super().__init__((HOST, port), Handler)
        except OSError as error:
            raise AtlasError(f"The port {port} cannot be used ({error.strerror}): choose another, or none.") from error
        self.token, self.start = secrets.token_urlsafe(24), start
        self.hosts = {f"{name}:{self.server_address[1]}" for name in (HOST, "localhost")}

    @property
    def address(self) -> str:
        """The address with the token, without which nothing is answered."""
        return f"http://{HOST}:{self.server_address[1]}/{self.token}/"

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Say nothing of a browser that has gone away; all else is told as it is by the standard library."""
        import sys

        if not isinstance(sys.exception(), ConnectionError):
            super().handle_error(request, client_address)


class Handler(BaseHTTPRequestHandler):
    """One request: refused if it is not from this page on this machine, else answered."""

    protocol_version, disable_nagle_algorithm = "HTTP/1.1", True
    timeout = 20  # seconds for which a connection may say nothing, half a request as well
    server: Explorer

    def do_GET(self) -> None:
        """Answer, or refuse."""
        try:
            url = urlsplit(self.path)
        except ValueError:  # as `http://[::1/`
            self._send(HTTPStatus.BAD_REQUEST, b"this is no address", "text/plain")
            return
        _, token, *rest = [*url.path.split("/"), ""]
        refused = self._refused(token)
        if refused:
            self._send(HTTPStatus.FORBIDDEN, refused.encode(), "text/plain")
            return
        try:
            content = self._content("/".join(rest).rstrip("/"), dict(parse_qsl(url.query)))
        except AtlasError as error:
            content = json.dumps({"error": str(error)}).encode(), JSON
        except OSError as error:  # as on a full disk
            content = json.dumps({"error": f"{error.strerror or error}: nothing could be saved"}).encode(), JSON
        if content is None:
            self._send(HTTPStatus.NOT_FOUND, b"there is nothing here", "text/plain")
        else:
            self._send(HTTPStatus.OK, *content)

    def _refused(self, token: str) -> str:
        """Return why a request is refused, or nothing."""
        if self.headers.get("Host", "") not in self.server.hosts:
            return "this server answers at 127.0.0.1 only"
        origin = self.headers.get("Origin")
        if origin is not None and origin.removeprefix("http://") not in self.server.hosts:
            return "this server answers its own page only"
        if not hmac.compare_digest(token.encode(), self.server.token.encode()):
            return "the address lacks the token that `atlas explore` has printed"
        return ""

    def _content(self, place: str, query: dict[str, str]) -> Content | None:
        """Return what is at a place, and its kind. Raises AtlasError for values that have no picture."""
        if place in PAGES:
            name, kind = PAGES[place]
            return _page(name), kind
        answer = ANSWERS.get(place)
        return answer(self.server, query) if answer else None

    def _send(self, status: HTTPStatus, body: bytes, kind: str) -> None:
        self.send_response(status)
        charset = "; charset=utf-8" if kind.startswith("text/") else ""
        for name, value in {**HEADERS, "Content-Type": kind + charset, "Content-Length": str(len(body))}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_: Any) -> None:
        """Keep the terminal quiet: the address has the token."""


def _page(name: str) -> bytes:
    """Return a file of the page; its style is that of the reports, without their fonts."""
    from atlas.report.templates import templates

    if name == "style.css":
        return templates("html").get_template(name).render(faces={}).encode()
    return (folder("templates") / "html" / name).read_bytes()


def _subjects(server: Explorer, _query: dict[str, str]) -> Content:
    return json.dumps({"start": server.start, **everything()}).encode(), JSON


def _sliders(_server: Explorer, query: dict[str, str]) -> Content:
    chosen = subject(query.get("subject", ""))
    return json.dumps({"title": chosen.title, "sliders": [asdict(slider) for slider in chosen.sliders]}).encode(), JSON


def _state(_server: Explorer, query: dict[str, str]) -> Content:
    proven = query.pop("proven", "") == "1"
    topic = subject(query.pop("subject", ""))
    answer = answers.state(topic, answers.values_of(topic, query), proven=proven)
    return json.dumps(answer, separators=(",", ":")).encode(), JSON


def _figure(_server: Explorer, query: dict[str, str]) -> Content:
    kind = query.pop("format", "svg")
    if kind not in answers.FILES:
        raise AtlasError(f"no figure can be saved as {kind!r}; known: {', '.join(answers.FILES)}")
    topic = subject(query.pop("subject", ""))
    return answers.picture(topic, answers.values_of(topic, query), kind), answers.FILES[kind]


ANSWERS: dict[str, Callable[[Explorer, dict[str, str]], Content]] = {
    "subjects": _subjects,
    "sliders": _sliders,
    "state": _state,
    "figure": _figure,
}
