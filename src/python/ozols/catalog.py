"""Catalogues of gripper structures: building them, on many machines if needed, and opening them as tables.

A catalogue is an SQLite file with the tables ``structures``, ``layouts``, ``counts`` and ``ideas``
(``ozols catalog query FILE "SELECT sql FROM sqlite_schema"`` explains every column).
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import sqlite3
from collections.abc import Callable, Mapping
from decimal import Decimal
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _native
from ._mechanism import Mechanism
from ._parts import Digest, shared_out
from ._parts import build as build_parts

if TYPE_CHECKING:
    import distributed
    import pandas
    import polars
    import pyarrow

#: The tables, each with the key of its rows.
TABLES = {
    "structures": "id",
    "layouts": "structure",
    "counts": "structure, mobility, changes",
    "ideas": "structure, place",
}
#: Columns of counts of variants: numbers, or their digits as text beyond 63 bits.
COUNTS = {"determinate", "determinate_w1", "variants"}
#: The tables of structures, each with the column of the structure.
BUILT = {"structures": "id", "layouts": "structure", "counts": "structure", "ideas": "structure"}


def open(path: str | os.PathLike[str]) -> Catalog:
    """Opens a catalogue for reading."""
    return Catalog(path)


class Catalog:
    """An open catalogue. Queries are names of tables or views, or SQL."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        try:
            self._db = sqlite3.connect(f"{self.path.resolve().as_uri()}?mode=ro", uri=True)
            self._meta: dict[str, str] = dict(self._db.execute("SELECT key, value FROM meta"))
        except sqlite3.Error as e:
            raise _native.Error(f"{self.path} is not a catalogue of ozols: {e}") from e

    @property
    def spec(self) -> str:
        """The specification of its structures as TOML, or an empty string if it is incomplete."""
        return self._meta.get("spec", "")

    def close(self) -> None:
        """Closes the file."""
        self._db.close()

    def __enter__(self) -> Catalog:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __len__(self) -> int:
        count: int = self._db.execute("SELECT count(*) FROM structures").fetchone()[0]
        return count

    def ids(self) -> list[str]:
        """Returns the short names of the structures, ascending."""
        return [id for (id,) in self._db.execute("SELECT id FROM structures ORDER BY id")]

    def mechanism(self, id: str) -> Mechanism:
        """Returns the layout of a structure."""
        sql = "SELECT mechanism FROM layouts WHERE structure = ?1"
        found = self._db.execute(sql, [id]).fetchone()
        if found is None:
            raise _native.Error(f"{self.path} has no layout of a structure {id}")
        return Mechanism.from_toml(found[0])

    def _ask(self, what: str, params: Any = ()) -> tuple[list[str], list[tuple[Any, ...]]]:
        order = f" ORDER BY {TABLES[what]}" if what in TABLES else ""
        sql = f"SELECT * FROM {what}{order}" if what.isidentifier() else what
        try:
            cursor = self._db.execute(sql, params)
            names = [column[0] for column in cursor.description or ()]
            rows = cursor.fetchall()
        except sqlite3.Error as e:
            raise _native.Error(f"{self.path}: {e}") from e
        counted = [i for i, name in enumerate(names) if name in COUNTS]
        if counted:
            rows = [tuple(int(v) if i in counted and v is not None else v for i, v in enumerate(r)) for r in rows]
        return names, rows

    def query(self, what: str, params: Any = ()) -> list[dict[str, Any]]:
        """Returns rows as dictionaries; ``params`` replace each ``?`` in SQL."""
        names, rows = self._ask(what, params)
        return [dict(zip(names, row)) for row in rows]

    def to_pandas(self, what: str = "structures", params: Any = ()) -> pandas.DataFrame:
        """Returns a table of pandas. Counts beyond 63 bits are Python integers."""
        import pandas

        names, rows = self._ask(what, params)
        return pandas.DataFrame(rows, columns=names)

    def to_arrow(self, what: str = "structures", params: Any = ()) -> pyarrow.Table:
        """Returns a table of Arrow. Counts of variants are decimals of 38 digits."""
        import pyarrow

        names, rows = self._ask(what, params)
        kinds = {"INTEGER": pyarrow.int64(), "REAL": pyarrow.float64(), "TEXT": pyarrow.string()}
        known = self._db.execute(f"PRAGMA table_info({what})") if what in TABLES else ()
        declared = {name: kinds.get(kind) for _, name, kind, *_ in known}
        arrays = []
        for name, values in zip(names, zip(*rows) if rows else [()] * len(names)):
            kind = pyarrow.decimal128(38) if name in COUNTS else declared.get(name)
            if name in COUNTS:
                values = tuple(None if v is None else Decimal(v) for v in values)
            arrays.append(pyarrow.array(values, kind))
        return pyarrow.table(arrays, names).replace_schema_metadata({"ozols.spec": self.spec})

    def to_polars(self, what: str = "structures", params: Any = ()) -> polars.DataFrame:
        """Returns a table of polars, through Arrow."""
        import polars

        return polars.DataFrame(self.to_arrow(what, params))

    def to_parquet(self, folder: str | os.PathLike[str]) -> list[Path]:
        """Writes every table to a Parquet file in a folder, and returns the paths."""
        from pyarrow import parquet

        folder = Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        out = []
        for name in TABLES:
            out.append(folder / f"{name}.parquet")
            parquet.write_table(self.to_arrow(name), out[-1], compression="zstd")
        return out

    def digest(self) -> Digest:
        """Returns the numbers of rows of its structures by table, and a hash that does not depend on their order."""
        rows, total = {}, 0
        for table, key in BUILT.items():
            rows[table] = 0
            for row in self._db.execute(f"SELECT * FROM {table} WHERE {key} IN (SELECT id FROM structures)"):
                rows[table] += 1
                total += int.from_bytes(hashlib.sha256(json.dumps([table, *row]).encode()).digest(), "big")
        return Digest(rows, total)

    def __repr__(self) -> str:
        return f"<ozols.catalog.Catalog {self.path}: {len(self)} structures>"


def build(
    spec: Mapping[str, Any] | None = None,
    *,
    out: str | os.PathLike[str],
    client: distributed.Client | None = None,
    shards: int | None = None,
    threads: int = 0,
    progress: Callable[[int, int], object] | None = None,
) -> Catalog:
    """Builds the structures that a catalogue lacks, in this process or on the workers of a Dask client.

    ``spec`` has the keys of a specification file: ``links``, ``inputs``, ``symmetries`` and so on. In this process, ``threads``
    (0: all processors) share the structures, and ``progress`` is called with the structures done and their total number. With
    a client, ``shards`` tasks of ``threads`` (0: one) each build a part in the folder ``OUT.parts``, which the workers must share;
    ``progress`` is called with parts. Finished parts are kept after an interruption. The rows are the same either way.
    """
    words = json.dumps(dict(spec or {}))
    canonical, ids = _native.catalog_plan(words)
    out = Path(out)
    if client is None:
        _native.catalog_build(words, out, (1, 1), threads, progress)
        return open(out)
    if out.exists():
        with open(out) as there:
            if there.spec not in ("", canonical):
                raise _native.Error(f"{out} holds another catalogue; choose another file, or the same specification")
            if there.ids() == ids:
                return open(out)
    if shards is None:
        shards = shared_out(client, len(ids))

    def merge(whole: Path, made_of: list[Path]) -> Digest:
        # Drawn mechanisms of an older file are kept.
        if out.exists():
            shutil.copyfile(out, whole)
        _native.catalog_merge(whole, made_of)
        with open(whole) as made:
            return made.digest()

    build_parts(
        client,
        _part,
        words,
        what="catalog",
        name=canonical,
        out=out,
        merge=merge,
        shards=shards,
        threads=threads or 1,
        progress=progress,
    )
    made = open(out)
    if made.ids() != ids:
        raise _native.Error(f"{out} does not have the structures of its specification: delete it, and build again")
    return made


def _part(words: str, path: Path, part: tuple[int, int], threads: int) -> Digest:
    _native.catalog_build(words, path, part, threads, None)
    with open(path) as made:
        return made.digest()
