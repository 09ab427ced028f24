"""Files written whole or not at all: under another name beside their place first, then renamed.

What a user may have edited, or put there, is not replaced: only files that are still as they were written here are, by
the digests in a list in their folder.
"""

import ctypes
import errno
import fcntl
import hashlib
import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from glob import escape
from pathlib import Path
from typing import TextIO

from atlas.errors import AtlasError

WRITTEN = ".written"
"""The list of a folder's files as they were written, in it: lines of digest and name, as `sha256sum` has them."""

EXCLUDED = f"# notes of atlas, which it makes again\n{WRITTEN}\n*.costs.json\n"
"""Lines in the exclusions of a git repository that files are written to."""

MAX_LINE_LENGTH = 1 << 20
"""Characters of a line that is read."""

HERE, EXCHANGE = -100, 2
"""AT_FDCWD and RENAME_EXCHANGE of Linux."""


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield a path to write to, see `unfinished`; at the end the file written there replaces ``path``."""
    with unfinished(path) as part:
        yield part
        part.replace(path)


@contextmanager
def keeping(path: Path) -> Iterator[Path]:
    """Yield a path to write to; at the end that file replaces ``path``, unless the user wrote or edited ``path``.

    Then the new one is beside it, and AtlasError says so.
    """
    with unfinished(path) as part:
        yield part
        with turn(path.parent):
            beside = settle({path.name: part}, path.parent)
    tell(path.parent, beside)


@contextmanager
def unfinished(path: Path) -> Iterator[Path]:
    """Yield a path beside ``path`` to write to; a file that is still there at the end of the context is removed.

    Missing folders are made; what a process on this machine has left that was killed while it wrote is removed. The
    other name ends in the same suffix. An OSError names ``path``, not the other name.
    """
    part = _unfinished(path, os.getpid())
    try:
        with named(path, part):
            path.parent.mkdir(parents=True, exist_ok=True)
            for left in path.parent.glob(f".unfinished-*-{escape(path.name)}"):
                pid = left.name.split("-")[1]
                if left == _unfinished(path, pid) and pid.isdecimal() and not alive(int(pid)):
                    left.unlink(missing_ok=True)
            yield part
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


def _unfinished(path: Path, pid: int | str) -> Path:
    return path.with_name(f".unfinished-{pid}-{path.name}")


def alive(pid: int) -> bool:
    """Return whether a process of that number runs on this machine; a zombie does not."""
    try:
        os.kill(pid, 0)
        return Path(f"/proc/{pid}/stat").read_bytes().rpartition(b") ")[2][:1] != b"Z"
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True  # another user's, no number of a process, or a system without /proc


def exchange(new: Path, old: Path) -> bool:
    """Let two folders change places at once, or put the new one where none is; False if this system cannot do that.

    Nor is it done where the place is a link or no folder. Both are on one file system.
    """
    if not old.exists() and not old.is_symlink():
        new.rename(old)
        return True
    if old.is_symlink() or not old.is_dir():
        return False
    try:
        rename = ctypes.CDLL(None).renameat2
    except (AttributeError, OSError, TypeError):
        return False
    return bool(rename(HERE, os.fsencode(new.absolute()), HERE, os.fsencode(old.absolute()), EXCHANGE) == 0)


@contextmanager
def named(path: Path, part: Path | None = None) -> Iterator[None]:
    """Context in which an OSError without a file name, or with that of `part`, is raised with the name ``path``."""
    try:
        yield
    except OSError as error:
        if error.errno is None or (error.filename and (part is None or Path(error.filename) != part)):
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error


def lines_of(file: TextIO, name: str) -> Iterator[str]:
    """Yield the lines of a text. Raises AtlasError for one that does not end, as the first of /dev/zero."""
    while line := file.readline(MAX_LINE_LENGTH):
        if len(line) == MAX_LINE_LENGTH and line[-1] != "\n":
            raise AtlasError(f"{name} has a line of more than {MAX_LINE_LENGTH} characters: it is no table of numbers.")
        yield line


def check(path: Path) -> None:
    """Raise OSError if no file can be written there; an existing file is unchanged."""
    part = _unfinished(path, os.getpid())
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        part.touch()
        part.unlink()
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from error


def write(path: Path, content: str | bytes) -> None:
    """Write a file, text as UTF-8."""
    with replacing(path) as part:
        part.write_bytes(content.encode() if isinstance(content, str) else content)


def settle(parts: Mapping[str, Path], out: Path, known: Iterable[str] = ()) -> dict[str, str]:
    """Let files, by their names in a folder, take their places there; it must be this process's `turn`.

    What is there and is not as it was written, by the folder's list or by ``known`` lines of one, stays: the new file
    is beside it. Return the names of those, and under which the new ones are.
    """
    made = {name: digest_of(part) or "" for name, part in parts.items()}
    there = lines(out)
    before = there | {line for line in known if line[66:] in made}
    places = free(made, out, before)
    names = {*places.values()}
    for name in names:
        if (out / name).is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(out / name))
    after = {line for line in before if line[66:] not in names or not edited(out, line[66:], {line})}
    after |= {f"{made[name]}  {one}" for name, place in places.items() for one in (name, place)}
    if after != there:
        write(out / WRITTEN, listed(after))
        hide_notes(out)
    for name, part in parts.items():
        if digest_of(out / places[name]) != made[name]:
            part.replace(out / places[name])
    return {name: place for name, place in places.items() if place != name}


def tell(out: Path, beside: Mapping[str, str]) -> None:
    """Raise AtlasError where there are files beside those that were not written here, or were edited since."""
    if beside:
        told = "; ".join(
            f"{out / old} is not as atlas wrote it: the new one is {Path(new).name}" for old, new in beside.items()
        )
        raise AtlasError(f"{told}.")


def lines(folder: Path) -> set[str]:
    """Return the list of a folder, nothing where there is none."""
    try:
        return {*(folder / WRITTEN).read_text(encoding="utf-8").splitlines()}
    except OSError:
        return set()


def listed(lines: Iterable[str]) -> str:
    """Return such a list as text."""
    return "".join(f"{line}\n" for line in sorted(lines))


def hide_notes(folder: Path) -> None:
    """Let git see no notes of ours in a user's repository: by its own exclusions, which it shows nobody."""
    here = folder.resolve()
    git = next((top / ".git" for top in (here, *here.parents) if (top / ".git").exists()), None)
    if git is None:
        return
    if git.is_file():  # of a worktree or a submodule: the repository's folder stands in it
        git = git.parent / git.read_text(encoding="utf-8").removeprefix("gitdir:").strip()
    common = git / "commondir"
    exclude = git / (common.read_text(encoding="utf-8").strip() if common.exists() else "") / "info" / "exclude"
    with suppress(OSError):  # of a repository that we may only read
        text = exclude.read_text(encoding="utf-8") if exclude.exists() else ""
        if EXCLUDED not in text:
            write(exclude, f"{text.rstrip()}\n{EXCLUDED}".lstrip())


def edited(folder: Path, name: str, lines: set[str]) -> bool:
    """Whether something stands there that is no folder, and no file as it was written."""
    path = folder / name
    if path.is_symlink():
        return True
    return path.exists() and not path.is_dir() and f"{digest_of(path)}  {name}" not in lines


def free(made: Mapping[str, str], folder: Path, lines: set[str]) -> dict[str, str]:
    """Return where files with these digests may stand: under their names, or beside what was edited."""
    places = {}
    for name, digest in made.items():
        place = name
        while edited(folder, place, lines) and ((folder / place).is_symlink() or digest_of(folder / place) != digest):
            place = str(Path(place).with_suffix(f".new{Path(place).suffix}"))
        places[name] = place
    return places


def digest_of(path: Path) -> str | None:
    """Return the digest of a file, None if there is no file."""
    if not path.is_file():
        return None
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


@contextmanager
def turn(folder: Path) -> Iterator[None]:
    """Wait for one's turn in a folder; the lock is on the folder itself, so that nothing is left in it."""
    opened = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(opened, fcntl.LOCK_EX)
        yield
    finally:
        os.close(opened)
