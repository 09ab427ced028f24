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
    """Yield a temporary path beside ``path`` to write to; at the end the file written there replaces ``path``.

    If the context is left by an exception, ``path`` stays as it was and the temporary file is removed (see
    `unfinished`).
    """
    with unfinished(path) as draft:
        yield draft
        draft.replace(path)


@contextmanager
def keeping(path: Path) -> Iterator[Path]:
    """Yield a temporary path to write to; at the end the file replaces ``path``, unless a user wrote or edited that.

    Then the new file is put beside ``path``, as NAME.new.SUFFIX, and AtlasError says so.
    """
    with unfinished(path) as draft:
        yield draft
        with turn(path.parent):
            substitutes = settle({path.name: draft}, path.parent)
    tell(path.parent, substitutes)


@contextmanager
def unfinished(path: Path) -> Iterator[Path]:
    """Yield a temporary path beside ``path`` to write to; a file still there at the end of the context is removed.

    Missing folders are made. Temporary files that a killed process of this machine left for the same ``path`` are
    removed. The temporary name holds the process number and ends as ``path`` does. An OSError names ``path``, not
    that name.
    """
    draft = _unfinished(path, os.getpid())
    try:
        with named(path, draft):
            path.parent.mkdir(parents=True, exist_ok=True)
            for leftover in path.parent.glob(f".unfinished-*-{escape(path.name)}"):
                pid = leftover.name.split("-")[1]
                if leftover == _unfinished(path, pid) and pid.isdecimal() and not alive(int(pid)):
                    leftover.unlink(missing_ok=True)
            yield draft
    finally:
        with suppress(OSError):
            draft.unlink(missing_ok=True)


def _unfinished(path: Path, pid: int | str) -> Path:
    return path.with_name(f".unfinished-{pid}-{path.name}")


def alive(pid: int) -> bool:
    """Return whether the process with number `pid` runs on this machine; False for a zombie.

    True where that cannot be found out: another user's process, an impossible number, or a system without /proc.
    """
    try:
        os.kill(pid, 0)
        return Path(f"/proc/{pid}/stat").read_bytes().rpartition(b") ")[2][:1] != b"Z"
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True  # another user's, no number of a process, or a system without /proc


def exchange(new: Path, old: Path) -> bool:
    """Exchange the folders `new` and `old` in one step, or rename `new` to `old` if nothing is there; return True.

    Return False, with nothing changed, if `old` is a link or no folder, or if the system cannot exchange folders.
    Both must be on one file system.
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
def named(path: Path, draft: Path | None = None) -> Iterator[None]:
    """Context that re-raises an OSError with the file name ``path``, if the error names no file or names `draft`.

    An OSError without an error number, or about another file, passes unchanged.
    """
    try:
        yield
    except OSError as error:
        if error.errno is None or (error.filename and (draft is None or Path(error.filename) != draft)):
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error


def lines_of(file: TextIO, name: str) -> Iterator[str]:
    """Yield the lines of an open text file; `name` is the file's name in errors.

    Raises AtlasError for a line longer than MAX_LINE_LENGTH characters, such as the first of /dev/zero.
    """
    while line := file.readline(MAX_LINE_LENGTH):
        if len(line) == MAX_LINE_LENGTH and line[-1] != "\n":
            raise AtlasError(f"{name} has a line of more than {MAX_LINE_LENGTH} characters: it is no table of numbers.")
        yield line


def check(path: Path) -> None:
    """Raise OSError, which names ``path``, if no file can be written there; an existing file is unchanged.

    Missing folders are made.
    """
    draft = _unfinished(path, os.getpid())
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        draft.touch()
        draft.unlink()
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from error


def write(path: Path, content: str | bytes) -> None:
    """Write a file as a whole, text as UTF-8, and replace an existing one. Missing folders are made."""
    with replacing(path) as draft:
        draft.write_bytes(content.encode() if isinstance(content, str) else content)


def settle(drafts: Mapping[str, Path], out: Path, further_lines: Iterable[str] = ()) -> dict[str, str]:
    """Move new files (`drafts`, paths by final name) into the folder `out`, which this process holds by `turn`.

    A file there that is not as atlas wrote it, by the folder's digest list or by `further_lines` of such a list, stays:
    the new file is put beside it. Return the names used instead by intended name, {} if every file took its place.
    Raises IsADirectoryError where a folder has a file's name.
    """
    digests = {name: digest_of(draft) or "" for name, draft in drafts.items()}
    old_lines = lines(out)
    before = old_lines | {line for line in further_lines if line[66:] in digests}
    places = free_names(digests, out, before)
    names = {*places.values()}
    for name in names:
        if (out / name).is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(out / name))
    after = {line for line in before if line[66:] not in names or not edited(out, line[66:], {line})}
    after |= {f"{digests[name]}  {file}" for name, place in places.items() for file in (name, place)}
    if after != old_lines:
        write(out / WRITTEN, listed(after))
        hide_notes(out)
    for name, draft in drafts.items():
        if digest_of(out / places[name]) != digests[name]:
            draft.replace(out / places[name])
    return {name: place for name, place in places.items() if place != name}


def tell(out: Path, substitutes: Mapping[str, str]) -> None:
    """Raise AtlasError that names the files which `settle` put beside edited ones in the folder `out`; nothing if none.

    `substitutes` is the result of `settle`: names used instead, by intended name.
    """
    if substitutes:
        faults = "; ".join(
            f"{out / old} is not as atlas wrote it: the new one is {Path(new).name}" for old, new in substitutes.items()
        )
        raise AtlasError(f"{faults}.")


def lines(folder: Path) -> set[str]:
    """Return the lines "DIGEST  NAME" of a folder's list of files as atlas wrote them; the empty set without a list."""
    try:
        return {*(folder / WRITTEN).read_text(encoding="utf-8").splitlines()}
    except OSError:
        return set()


def listed(lines: Iterable[str]) -> str:
    """Return the lines "DIGEST  NAME" as one sorted text, each with a line end."""
    return "".join(f"{line}\n" for line in sorted(lines))


def hide_notes(folder: Path) -> None:
    """Add the names of atlas's own notes to .git/info/exclude of the repository that holds the folder, once.

    Nothing happens outside a repository, or in one that cannot be written.
    """
    root = folder.resolve()
    git = next((top / ".git" for top in (root, *root.parents) if (top / ".git").exists()), None)
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
    """Return whether `folder` has, under `name`, a link or a file whose line "DIGEST  NAME" is not in `lines`.

    False for a folder, and where nothing is there.
    """
    path = folder / name
    if path.is_symlink():
        return True
    return path.exists() and not path.is_dir() and f"{digest_of(path)}  {name}" not in lines


def free_names(digests: Mapping[str, str], folder: Path, lines: set[str]) -> dict[str, str]:
    """Return the names to write in `folder`, by intended name, for new files, whose `digests` are by name.

    That is the intended name itself, or NAME.new.SUFFIX where a file under that name is not in the digest list
    `lines` and differs from the new one.
    """
    places = {}
    for name, digest in digests.items():
        place = name
        while edited(folder, place, lines) and ((folder / place).is_symlink() or digest_of(folder / place) != digest):
            place = str(Path(place).with_suffix(f".new{Path(place).suffix}"))
        places[name] = place
    return places


def digest_of(path: Path) -> str | None:
    """Return the SHA-256 of a file's bytes in hexadecimal, None if there is no file."""
    if not path.is_file():
        return None
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


@contextmanager
def turn(folder: Path) -> Iterator[None]:
    """Hold an exclusive lock on a folder during the context, after waiting for other processes that hold the lock.

    The lock is on the folder itself, so that no lock file is left in it.
    """
    opened = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(opened, fcntl.LOCK_EX)
        yield
    finally:
        os.close(opened)
