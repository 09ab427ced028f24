"""`atlas explore`: who is answered and who is not, numbers that are those of the commands, sliders of everything."""

import json
import os
import re
import shlex
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import nullcontext
from http.client import HTTPConnection, HTTPResponse
from pathlib import Path
from shutil import which
from socket import create_connection
from threading import Thread
from typing import Any
from urllib.parse import urlencode, urlsplit
from urllib.request import url2pathname

import pytest
from click.testing import CliRunner

from atlas import AtlasError, GeneralMotion
from atlas.cli.app import atlas as command_line
from atlas.cli.explore import started
from atlas.cli.explorer import answers
from atlas.cli.explorer.server import HEADERS, PAGES, Explorer, Handler
from atlas.cli.explorer.subjects import OfFamily, OfRecipe, everything, subject
from atlas.families.sliders import letters
from atlas.motions.register import FAMILIES
from atlas.motions.torus import kernel as asymmetric
from atlas.pictures import recipes
from atlas.places import folder


@pytest.fixture(scope="module")
def server() -> Iterator[Explorer]:
    """Run a server on a free port."""
    with Explorer("general") as explorer:
        thread = Thread(target=explorer.serve_forever)
        thread.start()
        yield explorer
        explorer.shutdown()
        thread.join()


def ask(server: Explorer, place: str, method: str = "GET", **headers: str) -> tuple[HTTPResponse, bytes]:
    """Ask for a place below the address, with headers of one's own."""
    port = server.server_address[1]
    connection = HTTPConnection("127.0.0.1", port, timeout=60)
    headers_own = {"Host": f"127.0.0.1:{port}", "Cookie": f"other=1; atlas={server.secret}"}
    connection.request(method, place, headers=headers_own | headers)
    answer = connection.getresponse()
    content = answer.read()
    connection.close()
    return answer, content


def answer_of(server: Explorer, place: str, **query: Any) -> dict[str, Any]:
    """Ask as the page does, and read the answer."""
    answer, content = ask(server, f"/{server.folder}/{place}?{urlencode(query)}")
    assert answer.status == 200
    found: dict[str, Any] = json.loads(content)
    return found


def shell_as_another_user(script: str, *words: str) -> str:
    """Return the output of a shell that runs as user and group 1001, without further groups."""
    words_user = ["setpriv", "--reuid=1001", "--regid=1001", "--clear-groups"]
    done = subprocess.run([*words_user, "sh", "-c", script, "sh", *words], capture_output=True, text=True, check=False)
    return done.stdout


def test_the_explorer_answers_on_this_machine_only(server: Explorer) -> None:
    """The address is one of this machine, and holds 192 bits that nobody guesses."""
    assert server.server_address[0] == "127.0.0.1"
    assert re.fullmatch(r"http://127\.0\.0\.1:\d+/[\w-]{32}", server.ticket())


def test_an_address_of_the_explorer_works_once(server: Explorer) -> None:
    """The address sets a cookie for the folder that its page leads to; who comes second gets neither."""
    ticket = urlsplit(server.ticket()).path
    assert ask(server, ticket, Origin="http://evil.example")[0].status == 403
    answer, page = ask(server, ticket, Cookie="")
    cookie, *limits = answer.getheader("Set-Cookie", "").split("; ")
    assert {*limits} == {f"Path=/{server.folder}/", "HttpOnly", "SameSite=Strict"}
    place = re.search(r'url=([^"]+)', page.decode())[1]
    assert ask(server, place, Cookie=cookie)[0].status == 200
    for used in (ticket, ticket + "/"):
        answer, page = ask(server, used, Cookie="")
        assert (answer.status, answer.getheader("Set-Cookie")) == (403, None)
        assert server.folder.encode() not in page


@pytest.mark.parametrize(
    "headers",
    [
        {"Host": "evil.example"},
        {"Host": "127.0.0.1.evil.example:{port}"},
        {"Host": "127.0.0.1"},
        {"Origin": "http://evil.example"},
        {"Origin": "null"},
        {"Origin": "https://127.0.0.1:{port}.evil.example"},
        {"Origin": "http://127.0.0.1:1"},
    ],
)
def test_foreign_hosts_and_origins_are_refused(server: Explorer, headers: dict[str, str]) -> None:
    """A name that another site has let point here, and a page of another origin, get nothing, token or not."""
    filled = {name: value.format(port=server.server_address[1]) for name, value in headers.items()}
    for place in ("", "state?subject=general", "scene.js"):
        answer, content = ask(server, f"/{server.folder}/{place}", **filled)
        assert answer.status == 403
        assert server.folder.encode() not in content


def test_the_explorer_answers_only_requests_with_folder_and_cookie(server: Explorer) -> None:
    """Neither the page nor a number, nor for another cookie; its own origin and the name localhost do with it."""
    port = server.server_address[1]
    for place in ("/", "/state?subject=general", f"/{server.folder[:-1]}/", f"/{server.folder}x/", "/scene.js", "//"):
        assert ask(server, place)[0].status == 403
    for cookie in (
        "",
        "atlas",
        "atlas=",
        f"atlas={server.secret[:-1]}",
        f"atlas={server.secret}x",
        f"a={server.secret}",
    ):
        assert ask(server, f"/{server.folder}/", Cookie=cookie)[0].status == 403
    for headers in ({"Origin": f"http://127.0.0.1:{port}"}, {"Host": f"localhost:{port}"}):
        assert ask(server, f"/{server.folder}/", **headers)[0].status == 200
    assert ask(server, f"/{server.folder}/", "POST")[0].status == 501
    assert ask(server, f"/{server.folder}/nothing")[0].status == 404
    assert ask(server, f"/{server.folder}/../../etc/passwd")[0].status == 404


def test_half_a_request_and_half_an_address_are_ended(
    server: Explorer, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    """An address that can't be read is refused; a request that stops is given up; of neither is there a traceback."""
    monkeypatch.setattr(Handler, "timeout", 0.05)
    for sent, answer in ((b"GET http://[::1/ HTTP/1.1\r\n\r\n", b"HTTP/1.1 400"), (b"GET / HTTP/1.1\r\nHo", b"")):
        with create_connection(server.server_address[:2], timeout=60) as connection:
            connection.sendall(sent)
            assert connection.makefile("rb").read()[: len(b"HTTP/1.1 400")] == answer
    assert capfd.readouterr().err == ""


def test_the_policy_lets_only_its_own_files_run(server: Explorer) -> None:
    """Every answer has it, refusals too; the page has no script or style of its own that it would stop."""
    for place in (f"/{server.folder}/", f"/{server.folder}/state?subject=ball", "/"):
        answer, _ = ask(server, place)
        assert {name: answer.getheader(name) for name in HEADERS} == HEADERS
    assert "unsafe" not in HEADERS["Content-Security-Policy"]
    assert "default-src 'none'" in HEADERS["Content-Security-Policy"]
    page = (folder("templates") / "html" / "explore.html").read_text(encoding="utf-8")
    assert not re.search(r"<script>|<style|style=|\son\w+=|https?:", page)
    for place in PAGES:
        assert ask(server, f"/{server.folder}/{place}")[0].status == 200
    assert b"{%" not in ask(server, f"/{server.folder}/style.css")[1]


@pytest.mark.slow
@pytest.mark.parametrize("name", [*FAMILIES])
def test_the_printed_command_gives_the_same_numbers(server: Explorer, name: str) -> None:
    """The command that is shown, asked for as many digits, prints the page's proven digits."""
    answer = answer_of(server, "state", subject=name, proven=1)
    words = shlex.split(answer["command"])[1:]
    done = CliRunner().invoke(command_line, [*words, "--digits", "10", "--json"])
    printed = json.loads(done.output)
    entries = {q.name: entry for q, entry in zip(FAMILIES[name].quantities, answer["numbers"], strict=True)}
    same = [key for key in entries if isinstance(printed.get(key), str)]
    assert same
    for key in same:
        assert entries[key]["value"] == printed[key]
        assert entries[key]["sure"] == ("10 digits proven" if re.search(r"\d", printed[key]) else "decided exactly")


def test_doubles_come_from_the_kernels_and_promise_no_digits(server: Explorer) -> None:
    """While a slider moves the numbers are doubles: the period is that of the class, and no digit is called proven."""
    answer = answer_of(server, "state", subject="general", ratio=0.9, omega1=0.4)
    numbers = {entry["name"]: entry for entry in answer["numbers"]}
    period = GeneralMotion(0.9, (1.0, 2.0), (0.4, 0.7, 0.2)).period
    assert float(numbers["period"]["value"]) == pytest.approx(period, rel=1e-5)
    assert {entry["sure"] for entry in answer["numbers"]} <= {"decided exactly", "double, no promise"}
    assert numbers["kind"]["sure"] == "decided exactly"
    assert answer_of(server, "state", subject="ball")["numbers"][0]["sure"] == "double, within 4 ulp"


def test_an_infinite_period_is_certain_and_a_free_body_turns_about_its_momentum(server: Explorer) -> None:
    """A sleeping top that may fall has no period: that is decided. Without a field there is no B to turn about."""
    for name, inputs in (("top", {"n2": 0, "n3": 1, "omega3": 0.2}), ("free", {"omega3": 0})):
        answer = answer_of(server, "state", subject=name, proven=1, **{"omega1": 0, "omega2": 0} | inputs)
        numbers = {entry["name"]: entry for entry in answer["numbers"]}
        assert (numbers["period"]["value"], numbers["period"]["sure"]) == ("infinite", "decided exactly")
    answer = answer_of(server, "state", subject="general", B2=0, B3=0)
    assert {entry["says"] for entry in answer["numbers"]} >= {"mean rate about the momentum"}


def test_a_proof_waits_until_the_sliders_rest(server: Explorer, monkeypatch: pytest.MonkeyPatch) -> None:
    """While a body of three moments is changed by a slider its closed form is neither made nor proved."""
    monkeypatch.setattr(asymmetric, "closed_form", lambda *_: pytest.fail("a closed form is made"))
    answer = answer_of(server, "state", subject="asymmetric", I1=0.83)
    numbers = {entry["name"]: entry for entry in answer["numbers"]}
    assert numbers["agreement"]["sure"] == "when the sliders rest"
    assert float(numbers["energy"]["value"]) > 0.0


def test_the_drawn_body_has_the_attitude_of_the_motion(server: Explorer) -> None:
    """The arrow of the axis is along R_3(t), and the view is the same at all times."""
    for t in (0.0, 3.7):
        panel = answer_of(server, "state", subject="general", t=t)["scene"]["wide"]["panels"][0]
        tail, tip = (panel["arrows"][0][i] for i in (4, 5))
        axis = GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2)).third_axis(t)
        direction = [(b - a) / 1.35 * 3.2 for a, b in zip(tail, tip, strict=True)]
        assert direction == pytest.approx(list(axis), abs=1e-5)


@pytest.mark.parametrize(
    ("name", "places"),
    [
        ("particle", [[0, 0, 1, 1]]),
        ("figure:geometric_phase", [[0, 0, 1, 1]]),
        ("figure:tipping_disk", [[0, 0, 1, 1]]),
        ("figure:cusps", [[0, 0, 1 / 3, 1], [1 / 3, 0, 1 / 3, 1], [2 / 3, 0, 1 / 3, 1]]),
    ],
)
def test_panels_that_turn_fill_the_picture(server: Explorer, name: str, places: list[list[float]]) -> None:
    """Panels with two axes, which do not turn, and titles take no room; the others have the shape of their cells."""
    answer, subject_drawn = answer_of(server, "state", subject=name, proven=0), subject(name)
    scene = subject_drawn.scene(answers.values_of(subject_drawn, {}))
    width, height = answer["size"]
    cell = scene.size[0] / scene.columns, scene.size[1] / -(-len(scene.panels) // scene.columns)
    assert [place[:4] for place in answer["scene"]["wide"]["places"]] == [pytest.approx(x, abs=1e-6) for x in places]
    assert width == scene.size[0]
    assert width * places[0][2] / (height * places[0][3]) == pytest.approx(cell[0] / cell[1])


@pytest.mark.slow
def test_the_shown_picture_is_saved_as_pdf_svg_or_png(server: Explorer) -> None:
    """PDF, SVG and PNG of the shown picture; another format is refused in a sentence."""
    for kind, head in (("pdf", b"%PDF"), ("svg", b"<?xml"), ("png", b"\x89PNG")):
        answer, content = ask(server, f"/{server.folder}/figure?subject=hyperbola&format={kind}")
        assert answer.getheader("Content-Type").startswith(answers.FILES[kind])
        assert content.startswith(head)
    assert "no figure can be saved as 'exe'" in answer_of(server, "figure", subject="hyperbola", format="exe")["error"]


@pytest.mark.parametrize(
    ("query", "says"),
    [
        ({"subject": "general", "ratio": "3"}, "No body has I = I3/I2 = 3.0"),
        ({"subject": "general", "ratio": "nan"}, "ratio must be a finite number, not 'nan'"),
        ({"subject": "general", "ratio": "x"}, "ratio must be a finite number, not 'x'"),
        ({"subject": "general", "spin": "1"}, "general has no parameter 'spin'; it has ratio, B2"),
        ({"subject": "generall"}, "did you mean 'general'?"),
        ({}, "there is no family or figure ''"),
    ],
)
def test_wrong_requests_are_answered_in_a_sentence(server: Explorer, query: dict[str, str], says: str) -> None:
    """In a sentence for the page, which goes on with the picture before."""
    assert says in answer_of(server, "state", **query)["error"]


def test_a_full_disk_is_reported_and_the_server_continues(
    server: Explorer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A figure that cannot be written on the way is a sentence, and the server goes on."""
    monkeypatch.setattr(answers, "TemporaryDirectory", lambda: nullcontext(str(tmp_path / "nosuch" / ("x" * 300))))
    assert "nothing could be saved" in answer_of(server, "figure", subject="hyperbola")["error"]
    monkeypatch.undo()
    assert ask(server, f"/{server.folder}/figure?subject=hyperbola")[1].startswith(b"<?xml")


def test_a_name_that_a_page_sends_is_never_a_file(server: Explorer, tmp_path: Path) -> None:
    """No recipe of a path is run or read, but for the one that was named at the start, in the same words."""
    mark, recipe_mine = tmp_path / "mark", tmp_path / "mine.py"
    recipe_mine.write_text(f'"Mine."\nopen({str(mark)!r}, "w").close()\ndef scene(*, a=1.0): ...\n')
    for name in (str(recipe_mine), f"figure:{recipe_mine}", f"../figures/{recipe_mine.name}", "../../figures/ball.py"):
        for place in ("state", "sliders", "figure"):
            assert "there is no family or figure" in answer_of(server, place, subject=name)["error"]
    assert not mark.exists()
    with Explorer(str(recipe_mine)) as another:
        Thread(target=another.serve_forever, daemon=True).start()
        assert [slider["name"] for slider in answer_of(another, "sliders", subject=str(recipe_mine))["sliders"]] == [
            "a"
        ]
        assert "must return a Scene" in answer_of(another, "state", subject=str(recipe_mine))["error"]
        another.shutdown()
    assert mark.exists()


@pytest.mark.slow
@pytest.mark.skipif(os.getuid() != 0 or not which("setpriv"), reason="needs root, to become another user")
def test_another_user_of_the_machine_is_refused(tmp_path: Path) -> None:
    """The arguments of all processes, the file that the browser is given, and the socket tell another user nothing.

    The server answers while the browser runs, which the variable BROWSER without & waits for.
    """
    browser = tmp_path / "browser"
    browser.write_text(
        f"#!/bin/sh\nprintf '%s' \"$1\" >{tmp_path}/given.new\nmv {tmp_path}/given.new {tmp_path}/given\nexec sleep 60"
    )
    browser.chmod(0o755)
    words = [sys.executable, "-m", "atlas", "explore", "ball"]
    environment = os.environ | {"BROWSER": f"{browser} %s", "DISPLAY": ""}
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True, env=environment) as program:
        try:
            address = program.stdout.readline().strip()
            while not (tmp_path / "given").exists():
                time.sleep(0.01)
            page = Path(url2pathname(urlsplit((tmp_path / "given").read_text()).path))
            ticket = re.search(r'url=([^"]+)', page.read_text())[1]
            output_listing = shell_as_another_user(
                "cat /proc/[0-9]*/cmdline | tr '\\0' ' '; cat $1 $1/* $2; ls -R $1", page.parent, page
            )
            assert str(page) in output_listing  # the arguments of the browser are seen
            for secret in (address, ticket):
                assert secret.rpartition("/")[2] not in output_listing
            assert (page.stat().st_mode & 0o777, page.parent.stat().st_mode & 0o777) == (0o600, 0o700)
            guessed = "import sys, urllib.request as r\ntry: r.urlopen(sys.argv[1])\nexcept OSError as e: print(e)"
            output_request = shell_as_another_user(
                '"$@"', "python3", "-c", guessed, f"{address.rpartition('/')[0]}/state?subject=ball"
            )
            assert "403" in output_request
        finally:
            program.terminate()
            program.communicate(timeout=60)
    assert not page.exists()


def test_sliders_of_all_families_and_figures_start_within_their_ranges() -> None:
    """All families but those without a start, with the ranges of the register; all figures, with theirs."""
    catalogue = everything()
    assert [name for name, _ in catalogue["families"]] == [*FAMILIES]
    assert [name.removeprefix("figure:") for name, _ in catalogue["figures"]] == recipes.names()
    assert all(subject(name).title == title for entries in catalogue.values() for name, title in entries)
    for subject_any in [*map(OfFamily, FAMILIES.values()), *(OfRecipe(recipes.load(name)) for name in recipes.names())]:
        for slider in subject_any.sliders:
            assert slider.low <= slider.start <= slider.high
            steps = (slider.high - slider.low) / slider.step
            counted = type(slider.start) is int or slider.name == "t"
            assert steps >= 1 if counted else 95 <= steps <= 950
            assert slider.step == 0.05 if slider.name == "t" else f"{slider.step:e}".startswith("1.000000e")
    assert next((x.low, x.high) for x in OfFamily(FAMILIES["general"]).sliders if x.name == "t") == (0.0, 60.0)
    three = {(x.low, x.start, x.high) for name in ("flight_poster", "tipping_disk") for x in subject(name).sliders}
    assert three >= {
        (1, 15, 45),
        (-3.0, 1e-3, 3.0),
    }  # a slider without a range ends at three times its start, or at three
    ranges = {slider.name: (slider.low, slider.high) for slider in subject("film_strip").sliders}
    assert ranges["field.2"] == next(p.range for p in FAMILIES["elementary"].parameters if p.name == "field")
    assert (
        type(OfRecipe(recipes.load("film_strip")).parameters(answers.values_of(subject("film_strip"), {}))["count"])
        is int
    )


def test_names_are_written_as_in_the_atlas() -> None:
    """Greek letters and indices below the line; contour levels, which tell of no motion, have no sliders."""
    names = ("omega2", "ratio", "field.2", "Omega3", "k", "t", "omega2.3", "azimuth", "unstable_band", "C1")
    assert [letters(name) for name in names] == [
        "ω₂",
        "I",
        "B₃",
        "Ω₃",
        "k",
        "t",
        "omega2.3",
        "azimuth",
        "unstable_band",
        "C₁",
    ]
    assert {slider.name for slider in subject("stability").sliders} >= {"field.1", "field.2"}
    assert not any(slider.name.startswith("levels") for slider in subject("stability").sliders)
    assert [slider.symbol for slider in subject("hyperbola").sliders][:3] == ["I", "B₂", "B₃"]


def test_unknown_names_are_refused_before_a_server_starts() -> None:
    """An unknown name is told with the nearest one."""
    with pytest.raises(AtlasError, match=r"no family or figure 'hyp_c'.* families are elementary, .*`atlas list`"):
        subject("hyp_c")


def test_an_impossible_body_is_refused_before_the_server_starts() -> None:
    """As by `atlas motion`."""
    with pytest.raises(AtlasError, match="the largest is at most the sum of the others"):
        started("--inertia 0.8 1 3 --field 0.2 1 0.6 --spin 2".split())


def test_a_port_in_use_is_reported(server: Explorer) -> None:
    """One line that names the port and the remedy, as for any wrong input."""
    with pytest.raises(AtlasError, match=f"port {server.server_address[1]} cannot be used .*another, or none"):
        Explorer("general", server.server_address[1])


@pytest.mark.usefixtures("interrupts")
def test_ctrl_c_ends_the_explorer() -> None:
    """It prints its address, and an interrupt ends it in peace."""
    words = [sys.executable, "-m", "atlas", "explore", "ball", "--no-browser"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as program:
        assert program.stdout is not None
        assert program.stdout.readline().startswith("http://127.0.0.1:")
        program.send_signal(signal.SIGINT)
        try:
            _, output = program.communicate(timeout=60)
        finally:
            program.kill()
    assert program.returncode in {0, 130}
    assert output in {"ended\n", "atlas: interrupted\n"}
