"""Where a table goes: a file, or a folder of Parquet files that is read as one table."""

import hashlib
import os
from dataclasses import dataclass
from pathlib import Path
from tempfile import gettempdir

from atlas.errors import AtlasError
from atlas.places import own_folder
from atlas.study.sweep.parts import MANIFEST, Parts
from atlas.study.sweep.plan import Plan
from atlas.study.sweep.storage import Folder, Local, Remote, read
from atlas.study.sweep.tables import FORMATS, check_format


@dataclass(frozen=True)
class TableFile:
    """A file .csv, .npz or .parquet."""

    place: Path

    def __str__(self) -> str:
        return str(self.place)

    @property
    def ending(self) -> str:
        """Ending of the files of its parts."""
        return FORMATS[self.place.suffix].ending

    @property
    def parts(self) -> Folder:
        """Folder of its parts."""
        return Local(self.place.absolute()).beside(".parts")

    @property
    def lock(self) -> Path:
        """Its lock."""
        return self.place.with_name(f".{self.place.name}.lock")

    def check(self) -> None:
        """Raise AtlasError for a format that cannot be written."""
        check_format(self.place)

    def finish(self, plan: Plan, parts: Parts, names: list[str]) -> None:
        """Write the table from its parts, put it into its place, and delete them."""
        folder, whole = self.place.with_name(f"{self.place.name}.parts"), f"whole{self.place.suffix}"
        parts.announce(whole)
        heads = plan.headings if self.place.suffix == ".csv" else plan.names
        FORMATS[self.place.suffix].write(folder / whole, heads, plan.count, [folder / name for name in names])
        (folder / whole).replace(self.place)
        parts.clear()


@dataclass(frozen=True)
class DataSet:
    """A folder of Parquet files: one a part, and the manifest."""

    folder: Folder

    ending = "parquet"

    def __str__(self) -> str:
        return str(self.folder)

    @property
    def place(self) -> Path | str:
        """The folder or its address."""
        return self.folder.path if isinstance(self.folder, Local) else self.folder.address

    @property
    def parts(self) -> Folder:
        """Folder of the parts while some are missing: nobody shall take them for the table."""
        return (Local(self.folder.path.absolute()) if isinstance(self.folder, Local) else self.folder).beside(".parts")

    @property
    def lock(self) -> Path:
        """Its lock; that of an address holds for the sweeps of this machine."""
        if isinstance(self.folder, Local):
            return self.folder.path.with_name(f".{self.folder.path.name}.lock")
        name = hashlib.sha256(str(self).encode()).hexdigest()[:16]
        return (own_folder() or Path(gettempdir())) / f"sweep-{name}.lock"

    def check(self) -> None:
        """Raise AtlasError for a folder that holds other files than a table of a sweep."""
        check_format(Path("table.parquet"))
        Parts(self.folder)

    def finish(self, _: Plan, parts: Parts, names: list[str]) -> None:
        """Put the parts into their place, and the manifest before them: what lies there is known to be of a sweep."""
        Parts(self.folder).clear()
        self.folder.append(MANIFEST, read(parts.folder, MANIFEST) or b"")
        for name in names:
            parts.folder.move(name, self.folder)
        parts.clear()


def target(out: str | os.PathLike[str]) -> TableFile | DataSet:
    """Return where a table goes, from what a user wrote. AtlasError for a format that there is not."""
    text = os.fspath(out)
    path = Path(text)
    if "://" not in text and not text.endswith(("/", os.sep)) and not path.is_dir():
        check_format(path)
        return TableFile(path)
    if path.suffix not in {"", ".parquet"}:
        raise AtlasError(f"A table in a folder is of Parquet, as table.parquet/, not {text}.")
    return DataSet(Remote(text) if "://" in text else Local(path))
