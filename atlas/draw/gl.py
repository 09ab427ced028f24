"""Which GL library can draw off-screen here: EGL, OSMesa or none.

Without one the first off-screen picture kills the process, so the question is put to a child, and the answer remembered
until something changes that it depends on: the libraries installed, their drivers, the environment.

``python -m atlas.draw.gl`` prints the answer; with ``--install`` it first installs what is missing, where it may.
"""

import hashlib
import json
import os
import subprocess
import sys
from contextlib import suppress
from functools import cache
from pathlib import Path

from atlas import files, programs
from atlas.errors import AtlasError
from atlas.libraries import release
from atlas.places import own_folder

VARIABLE = "VTK_DEFAULT_OPENGL_WINDOW"
CHOICE = "ATLAS_GL"
WINDOWS = {"egl": "vtkEGLRenderWindow", "osmesa": "vtkOSOpenGLRenderWindow"}
KNOWN = (*WINDOWS, "native")
NONE = "none"
DRIVERS = (
    "/usr/share/glvnd/egl_vendor.d",
    "/usr/lib/dri",
    "/usr/lib64/dri",
    *(f"/usr/lib/{machine}-linux-gnu/dri" for machine in ("x86_64", "aarch64")),
)
PACKAGES = ("libegl1", "libgl1-mesa-dri")

_PROBE = """
from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkRenderer
import vtkmodules.vtkRenderingOpenGL2
window = vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetSize(8, 8)
window.AddRenderer(vtkRenderer())
window.Render()
print(window.GetClassName())
"""
_TIMEOUT = 60
_APT = "/usr/bin/apt-get"


@cache
def library() -> str | None:
    """Return 'egl', 'osmesa', 'native' (not Linux) or None; the variable ATLAS_GL overrides what the probe finds.

    Raises AtlasError where that variable is none of these.
    """
    choice = os.environ.get(CHOICE, "").lower()
    if choice == NONE:
        return None
    if choice:
        if choice not in KNOWN:
            raise AtlasError(f"{CHOICE}={choice} names no GL library; known: {', '.join((*KNOWN, NONE))}")
        return choice
    file = _answer_file()
    try:
        known = json.loads(file.read_text(encoding="utf-8"))["library"] if file else None
    except (OSError, ValueError, KeyError, TypeError):
        known = None  # there is none, or half of one: probe again
    if known not in {*KNOWN, NONE}:
        known = next((name for name in _candidates() if _draws(name)), NONE)
        if file:
            with suppress(OSError):  # it is probed again next time
                files.write(file, json.dumps({"library": known}))
    return None if known == NONE else str(known)


def prepare() -> str | None:
    """Tell VTK which window to open and return the library's name, or None when nothing can draw."""
    found = library()
    if found in WINDOWS:
        os.environ[VARIABLE] = WINDOWS[found]
    return found


def advice() -> str:
    """Return the line that says what is left out without GL, and which command installs it."""
    return (
        "no GL library can draw off-screen: shaded figures are drawn by the vector renderer; to have them: "
        f"{_install_command()}"
    )


def _install_command() -> str:
    """Return the command that installs what is missing."""
    if _vtk() is None:
        return f"{sys.executable} -m pip install pyvista vtk"
    return f"sudo apt-get install {' '.join(PACKAGES)}"


def _vtk() -> str | None:
    """Return the version of VTK, or None without VTK or PyVista."""
    vtk, pyvista = release("vtk"), release("pyvista")
    return f"{vtk}/{pyvista}" if vtk and pyvista else None


def _candidates() -> tuple[str, ...]:
    """Return what to try, best first."""
    if _vtk() is None:
        return ()
    return tuple(WINDOWS) if sys.platform.startswith("linux") else ("native",)


def _draws(name: str) -> bool:
    """Whether a child process can open an off-screen window with this library."""
    environment = dict(os.environ)
    if name in WINDOWS:
        environment[VARIABLE] = WINDOWS[name]
    try:
        child = programs.run([sys.executable, "-P", "-c", _PROBE], _TIMEOUT, env=environment)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return child.returncode == 0 and (name not in WINDOWS or WINDOWS[name] in child.stdout)


def _answer_file() -> Path | None:
    """Return where the answer is remembered: a file named after all that it depends on; None without a place for it."""
    seen = [sys.prefix, sys.platform, str(_vtk()), *os.uname()[1:5:3]] if hasattr(os, "uname") else [sys.prefix]
    seen += [f"{key}={os.environ.get(key, '')}" for key in ("LD_LIBRARY_PATH", "LIBGL_DRIVERS_PATH", "DISPLAY")]
    for place in map(Path, ("/etc/ld.so.cache", "/dev/dri", *DRIVERS)):
        state = place.stat() if place.exists() else None
        seen.append(f"{place} {(state.st_mtime_ns, state.st_size) if state else None}")
    key = hashlib.sha256(os.fsencode("\n".join(seen))).hexdigest()[:20]
    folder = own_folder()
    return folder / f"gl-{key}.json" if folder else None


def _may_install() -> bool:
    """Return whether we are root on a machine with apt-get."""
    return sys.platform.startswith("linux") and os.geteuid() == 0 and Path(_APT).exists()


def _install() -> bool:
    """Install the GL libraries where we may; return whether that was done, and say why it was not."""
    if not _may_install():
        return False
    environment = dict(os.environ, DEBIAN_FRONTEND="noninteractive")
    for words in (["update", "-qq"], ["install", "-y", "-qq", "--no-install-recommends", *PACKAGES]):
        apt = subprocess.run([_APT, *words], env=environment, capture_output=True, text=True, check=False)  # noqa: S603  fixed words
    if apt.returncode:
        reason = (apt.stderr.strip() or "it does not say why").splitlines()[-1]
        print(f"atlas: apt-get could not install {' '.join(PACKAGES)}: {reason}", file=sys.stderr)  # noqa: T201  the one line
    return apt.returncode == 0


def main(arguments: list[str]) -> int:
    """Print in one line what can draw; with --install, install it first if possible. Only a misspelt choice fails."""
    try:
        found = library()
    except AtlasError as error:
        print(f"atlas: {error}", file=sys.stderr)  # noqa: T201  the one line
        return 2
    if found is None and "--install" in arguments and _vtk() is not None and CHOICE not in os.environ and _install():
        library.cache_clear()
        file = _answer_file()
        if file:
            file.unlink(missing_ok=True)
        found = library()
        if found:
            print(f"installed {' '.join(PACKAGES)} for the shaded figures ({found})")  # noqa: T201  the one line
    if "--install" not in arguments:  # there the first report says what it lacks
        print(found or advice())  # noqa: T201  the answer
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
