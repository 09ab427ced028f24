"""Signals and the processes of a command: Ctrl-C and SIGTERM end them all, and leave nothing behind."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from atlas import processes, programs
from atlas.book import bibliography, pandoc
from atlas.errors import AtlasError

ROOT = Path(__file__).parents[2]
MAIN = str(ROOT / "atlas" / "__main__.py")
SWEEP = (
    "sweep elementary --set ratio=0.1:2:400 --set B2=1 --set B3=0.2 --set omega2=0.1:3:50 --quantity k --quantity phi "
    "--digits 30 --rows 100 --jobs 2 --out t.csv"
)


def workers_of(process: "subprocess.Popen[str]") -> list[str]:
    """Return the numbers of the processes that a command has started."""
    return Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()


@pytest.mark.slow
@pytest.mark.usefixtures("interrupts")
@pytest.mark.parametrize("wait", [0.0, 0.1, 0.5])
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_to_the_group_ends_a_sweep(tmp_path: Path, number: signal.Signals, wait: float) -> None:
    """From the moment on that workers are started: one line, no process, no file of multiprocessing, no lock."""
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    environment = os.environ | {"TMPDIR": str(temporary)}
    command = [sys.executable, "-P", MAIN, *SWEEP.split()]
    with subprocess.Popen(
        command, cwd=tmp_path, env=environment, stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        while len(workers_of(process)) < 3:  # the tracker of resources is one of them
            time.sleep(0.005)
        time.sleep(wait)
        os.killpg(process.pid, number)
        try:
            _, message = process.communicate(timeout=120)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            raise
    assert (process.returncode, message.split("\n", 1)) == (128 + number, ["", "atlas: interrupted\n"])
    assert not [*temporary.iterdir()]
    assert {path.name for path in tmp_path.iterdir()} <= {"temporary", "t.csv.parts"}


@pytest.mark.usefixtures("interrupts")
@pytest.mark.parametrize("module", ["typing", "click", "flint"])
def test_ctrl_c_while_libraries_are_loaded_prints_no_traceback(tmp_path: Path, module: str) -> None:
    """At the start of the package, of the command line, and in the midst of a command; by file, module and script."""
    (tmp_path / f"{module}.py").write_text(
        "import os, signal, sys\nos.kill(os.getpid(), signal.SIGINT)\n"
        f"sys.path.remove(os.path.dirname(__file__))\ndel sys.modules[__name__]\nimport {module}\n"
    )
    words = "motion --ratio 1.5 --field 1 2 --omega2 0.7 --times 1".split()
    environment = os.environ | {"PYTHONPATH": f"{tmp_path}{os.pathsep}{ROOT}"}
    script = tmp_path / "atlas"  # as pip writes it
    script.write_text("import sys\nfrom atlas.__main__ import main\nsys.exit(main())\n")
    for start in ([MAIN], ["-m", "atlas"], [str(script)]):
        done = subprocess.run(
            [sys.executable, *start, *words], env=environment, cwd=tmp_path, capture_output=True, text=True, check=False
        )
        assert done.stdout == ""
        assert (done.returncode, done.stderr.strip()) in {(-signal.SIGINT, ""), (130, "atlas: interrupted")}


@pytest.mark.slow
@pytest.mark.usefixtures("interrupts")
def test_ctrl_c_is_not_lost_in_a_library(tmp_path: Path) -> None:
    """One that is loaded and takes the exception for its own; one that never ends its loading is ended."""
    (tmp_path / "flint.py").write_text(
        "import os, signal, time\ntry:\n    os.kill(os.getpid(), signal.SIGINT); time.sleep(0.05)\n"
        "except BaseException: pass\nwhile os.environ['ENDLESS'] == 'yes': time.sleep(0.01)\n"
        "def __getattr__(name): return time.sleep(9)\n"
    )
    for endless in ("yes", "no"):
        begun = time.monotonic()
        done = subprocess.run(
            [sys.executable, MAIN, *"motion --ratio 1.5 --field 1 2 --omega2 0.7 --times 1".split()],
            env=os.environ | {"PYTHONPATH": f"{tmp_path}{os.pathsep}{ROOT}", "ENDLESS": endless},
            capture_output=True, text=True, check=False, timeout=60,
        )  # fmt: skip
        assert (done.returncode, done.stderr.strip(), done.stdout) == (130, "atlas: interrupted", "")
        assert time.monotonic() - begun < 8


@pytest.mark.slow
def test_an_error_waits_for_no_long_call() -> None:
    """A row of many digits takes a minute: its process is ended, also with more in the queue than a pipe holds."""
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        _give_up()
    assert time.monotonic() - begun < 15


def _give_up() -> None:
    with processes.pool(2) as pool:
        for _ in range(9):
            pool.submit(_wait, 30.0, bytes(1 << 20))
        time.sleep(1.0)
        raise KeyboardInterrupt


def _wait(seconds: float, _: bytes) -> None:
    time.sleep(seconds)


def test_workers_are_never_interrupted() -> None:
    """SIGINT is blocked in each from its start; the process that started it decides about the end."""
    for context in ("spawn", "fork", processes.prepare("json")):
        with processes.pool(2, None, context) as pool:
            assert pool.submit(signal.pthread_sigmask, signal.SIG_BLOCK, []).result() == {signal.SIGINT}
        assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, [])


def test_a_worker_that_dies_while_calls_are_given_up_ends_the_pool() -> None:
    """No call that has not begun is waited for, whatever has become of the workers."""
    begun = time.monotonic()
    with processes.pool(2) as pool:
        calls = [pool.submit(time.sleep, 0.5) for _ in range(200)]
        for pid in [*pool._processes]:
            os.kill(pid, signal.SIGKILL)
    assert time.monotonic() - begun < 50.0
    assert all(call.done() for call in calls)


@pytest.mark.parametrize("locale", ["C", "POSIX", "no_SUCH"])
def test_a_program_that_is_run_reads_names_in_any_locale(
    tmp_path: Path, locale: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Pandoc finds a file in a folder of letters that the user's locale lacks; Python says the same in its words."""
    monkeypatch.setenv("LC_ALL", locale)
    monkeypatch.setenv("LC_CTYPE", locale)
    folder = tmp_path / "é ü 物"
    folder.mkdir()
    (folder / "é.bib").write_text("@misc{a, title = {Thé}, author = {Ünal, É.}, year = {2001}}", encoding="utf-8")
    assert "Ünal" in bibliography.read(folder / "é.bib").named["a"]
    program = "import locale; print(locale.setlocale(locale.LC_CTYPE, ''), locale.nl_langinfo(locale.CODESET))"
    assert programs.run([sys.executable, "-I", "-c", program], 20).stdout.split()[-1] == "UTF-8"


def test_names_are_read_in_utf8_where_python_is_told_not_to(tmp_path: Path) -> None:
    """With PYTHONUTF8=0 in the locale C, a file of letters that ASCII lacks is found and named in errors."""
    (tmp_path / "é.csv").write_text("t\n", encoding="utf-8")
    ascii_alone = os.environ | {"PYTHONUTF8": "0", "LC_ALL": "C"}
    process = subprocess.run(
        [sys.executable, "-m", "atlas", "fit", "é.csv"], cwd=tmp_path, env=ascii_alone, capture_output=True, check=False
    )
    assert (process.returncode, process.stderr.decode()[:13]) == (2, "atlas: é.csv,")


def test_the_first_line_of_pandocs_error_is_reported() -> None:
    """The reason stands there, and hints below it."""
    with pytest.raises(AtlasError, match="could not set the text of the report: Unknown input format nosuch"):
        pandoc.run(["-f", "nosuch"], "")
