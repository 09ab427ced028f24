"""Which GL library can draw off-screen here: EGL, OSMesa or none.

Without one the first off-screen picture kills the process, so the question is put to a child, and the answer remembered
until something changes that it depends on: the libraries installed, their drivers, the environment.

``python -m atlas.gl`` prints the answer.
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
_TIMEOUT_SECONDS = 60


@cache
def library() -> str | None:
    """Return the name of the library that can draw off-screen here: 'egl', 'osmesa', 'native' (not Linux), or None.

    The variable ATLAS_GL sets the answer ('none' gives None); AtlasError where it is none of these names. Else a child
    process tries them, and the answer is kept in a file.
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
        answer = json.loads(file.read_text(encoding="utf-8"))[file.stem] if file else None
    except (OSError, ValueError, KeyError, TypeError):
        answer = None  # there is none, or half of one: probe again
    if answer not in {*KNOWN, NONE}:
        answer = next((name for name in _candidates() if _draws(name)), NONE)
        if file:
            with suppress(OSError):  # it is probed again next time
                files.write(file, json.dumps({file.stem: answer}))
    return None if answer == NONE else str(answer)


def prepare() -> str | None:
    """Set the environment variable that tells VTK which window to open; return the library's name as `library` does."""
    name = library()
    if name in WINDOWS:
        os.environ[VARIABLE] = WINDOWS[name]
    return name


def advice() -> str:
    """Return one line: shaded figures are drawn as line drawings, and this command installs the libraries."""
    vtk, packages = f"{sys.executable} -m pip install pyvista vtk", "sudo apt-get install libegl1 libgl1-mesa-dri"
    command = vtk if _vtk() is None else packages
    return (
        f"no GL library can draw off-screen: shaded figures are drawn by the vector renderer; to have them: {command}"
    )


def _vtk() -> str | None:
    """Return the versions of VTK and PyVista as "VTK/PYVISTA", or None if one of them is not installed."""
    vtk, pyvista = release("vtk"), release("pyvista")
    return f"{vtk}/{pyvista}" if vtk and pyvista else None


def _candidates() -> tuple[str, ...]:
    """Return the names of the GL libraries to try, best first; () without VTK and PyVista."""
    if _vtk() is None:
        return ()
    return tuple(WINDOWS) if sys.platform.startswith("linux") else ("native",)


def _draws(name: str) -> bool:
    """Return whether a child process can draw in an off-screen window of the library `name`.

    False also if that takes more than 60 s of processor time.
    """
    environment = programs.environment()
    if name in WINDOWS:
        environment[VARIABLE] = WINDOWS[name]
    try:
        child = programs.run([sys.executable, "-P", "-c", _PROBE], _TIMEOUT_SECONDS, env=environment)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return child.returncode == 0 and (name not in WINDOWS or WINDOWS[name] in child.stdout)


def _answer_file() -> Path | None:
    """Return the path of the file that keeps the answer of `library`; None without a folder that can be written.

    The name of the file holds a digest of what the answer depends on: libraries, drivers, versions, environment.
    """
    dependencies = [sys.prefix, sys.platform, str(_vtk()), *os.uname()[1:5:3]] if hasattr(os, "uname") else [sys.prefix]
    dependencies += [f"{key}={os.environ.get(key, '')}" for key in ("LD_LIBRARY_PATH", "LIBGL_DRIVERS_PATH", "DISPLAY")]
    for place in map(Path, ("/etc/ld.so.cache", "/dev/dri", *DRIVERS)):
        state = place.stat() if place.exists() else None
        dependencies.append(f"{place} {(state.st_mtime_ns, state.st_size) if state else None}")
    key = hashlib.sha256(os.fsencode("\n".join(dependencies))).hexdigest()[:20]
    folder = own_folder()
    return folder / f"gl-{key}.json" if folder else None


def main() -> int:
    """Print the name of the library that can draw, or the advice; return 0, or 2 for a misspelt ATLAS_GL."""
    try:
        print(library() or advice())  # noqa: T201  the answer
    except AtlasError as error:
        print(f"atlas: {error}", file=sys.stderr)  # noqa: T201  the one line
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
