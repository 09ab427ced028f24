"""Writing whole or not at all: every file is made beside its place and renamed into it.

A build that is killed leaves the files of the last good one as they were; what it left behind is swept up by the next.
"""

import fcntl
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import mkdtemp

from atlas.errors import AtlasError

PREFIX = ".making-"
LOCK = ".lock"


@contextmanager
def staging(out: Path) -> Iterator[Path]:
    """Give a folder beside `out`'s files to make new ones in; it is gone afterwards, whatever happens."""
    try:
        out.mkdir(parents=True, exist_ok=True)
        _sweep(out)
        folder = Path(mkdtemp(prefix=PREFIX, dir=out))
    except OSError as error:
        raise AtlasError(f"nothing can be written to {out}: {error.strerror}.") from error
    with (folder / LOCK).open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        try:
            yield folder
        except OSError as error:
            raise AtlasError(f"the build in {out} stopped: {error.strerror or error}.") from error
        finally:
            shutil.rmtree(folder, ignore_errors=True)


def publish(stage: Path, out: Path, files: list[str], owned: list[str]) -> None:
    """Rename files from the staging folder into their places in `out`, in this order, then remove what is stale.

    `owned` are the folders of `out` that hold nothing but this build's files: what else is in them goes.
    Two builds at once take turns here.
    """
    with (out / LOCK).open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        for name in files:
            place = out / name
            place.parent.mkdir(parents=True, exist_ok=True)
            (stage / name).replace(place)
        kept = {out / name for name in files}
        for folder in owned:
            for path in sorted((out / folder).rglob("*"), reverse=True):
                if path.is_dir() and not any(path.iterdir()):
                    path.rmdir()
                elif not path.is_dir() and path not in kept:
                    path.unlink()


def write(path: Path, content: str | bytes) -> None:
    """Write a file of the staging folder, with its folders."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content.encode() if isinstance(content, str) else content)


def _sweep(out: Path) -> None:
    """Remove what killed builds left: staging folders that no living process holds."""
    for folder in out.glob(f"{PREFIX}*"):
        try:
            with (folder / LOCK).open("r") as lock:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(folder, ignore_errors=True)
        except FileNotFoundError:
            shutil.rmtree(folder, ignore_errors=True)
        except BlockingIOError:
            continue
