"""Sweeps over the parameters of a mechanism file, here or on many machines."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _native
from ._mechanism import _entry, _range, asked
from ._outcome import Drawing
from ._parts import Digest, build, shared_out
from ._view import Told, View

if TYPE_CHECKING:
    import distributed

__all__ = ["Sweep", "sweep"]


class Sweep(Told):
    """A finished table of a sweep: what its rows say together, as items and attributes; a sequence of rows with :attr:`rows`.

    ``print(swept)`` shows the command's text, :meth:`to_pandas` the figures, a line a sample.

    >>> import ozols
    >>> swept = ozols.sweep("parallelogram-3-rods", grid=3, search=False)
    >>> [(f.redundant, f.samples) for f in swept.states[0].redundant]
    [(6, 6), (7, 3)]
    >>> swept.rows[0].at.to_dict()
    {'height': 100.0, 'offset': -2.0}
    >>> swept.plot("redundant")[:4]
    '<svg'
    """

    __slots__ = ("_folder", "path")

    def __init__(self, path: str | os.PathLike[str], folder: Any = None) -> None:
        self.path = Path(path)
        # Keeps a folder that nobody else has.
        self._folder = folder
        super().__init__(_native.sweep_read(self.path))

    @property
    def rows(self) -> list[View]:
        """All that is known of each sample, in order of the samples."""
        return [View(json.loads(line)) for line in self._lines()[1:-1]]

    def _lines(self) -> list[str]:
        return self.path.read_text(encoding="utf-8").splitlines()

    def digest(self) -> Digest:
        """How many rows, and a hash of them that does not depend on their order."""
        foot = json.loads(self._lines()[-1])
        return Digest({"rows": foot["rows"]}, int(foot["digest"], 16))

    def plot(self, quantity: str = "redundant", over: Iterable[str] = ()) -> Drawing:
        """``redundant``, ``mobility``, ``force`` or ``best-cost`` over two parameters, or over one."""
        return Drawing(_native.sweep_plot(self.path, quantity, list(over)))

    def _repr_svg_(self) -> str:
        return self.plot()


def _file(mechanism: str | os.PathLike[str] | Mapping[str, Any]) -> tuple[str, str]:
    """Name and text of a mechanism file."""
    if isinstance(mechanism, Mapping):
        return "mechanism.json", json.dumps(mechanism, indent=2, default=_entry, ensure_ascii=False)
    if isinstance(mechanism, str) and "\n" in mechanism:
        return "mechanism.toml", mechanism
    path = Path(mechanism)
    built_in = None if path.is_file() else _native.builtin_text(os.fspath(mechanism))
    if built_in is not None:
        return f"{mechanism}.toml", built_in
    try:
        return os.fspath(path), path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as e:
        raise _native.Error(f"cannot read {path}: {e}") from e


def sweep(
    mechanism: str | os.PathLike[str] | Mapping[str, Any],
    *,
    grid: int = 5,
    sobol: int | None = None,
    seed: int = 1,
    search: Mapping[str, Any] | bool = True,
    top: int = 3,
    stroke: str | tuple[float, float, int] | None = None,
    methods: bool = False,
    as_written: bool = False,
    out: str | os.PathLike[str] | None = None,
    client: distributed.Client | None = None,
    shards: int | None = None,
    threads: int = 0,
    progress: Callable[[int, int], object] | None = None,
) -> Sweep:
    """Takes the ``[parameter]`` ranges of a mechanism over a grid, or over Sobol's sequence, and analyses, searches and loads each.

    ``mechanism`` is a path, the name of a built-in mechanism, the text of a file in TOML, or its keys. ``search`` has keywords of
    :meth:`Mechanism.search`, or is false. The table is kept in ``out``, and what it lacks is added; with a Dask ``client`` it is
    made in ``shards`` parts in the folder ``OUT.parts``, which the workers must share. Rows are the same either way. ``progress``
    hears samples, or parts with a client.
    """
    file, text = _file(mechanism)
    wanted = None if search is False else asked({} if search is True else search)
    spec = {
        "file": file,
        "text": text,
        "grid": grid,
        "sobol": sobol,
        "seed": seed,
        "search": wanted,
        "top": top,
        "stroke": None if stroke is None else _range(stroke),
        "methods": methods,
        "as_written": as_written,
    }
    head, samples = _native.sweep_plan(spec)
    folder = None
    if out is None:
        if client is not None:
            raise _native.Error("with a client, name the table: out=")
        folder = tempfile.TemporaryDirectory(prefix="ozols-sweep-")
        out = Path(folder.name) / "sweep.jsonl"
    out = Path(out)
    if client is None:
        _native.sweep_make(spec, out, (1, 1), threads, progress)
        return Sweep(out, folder)
    if not _finished(out, head):
        build(
            client,
            _part,
            spec,
            what="sweep",
            name=head,
            out=out,
            merge=_merge,
            shards=shared_out(client, samples) if shards is None else shards,
            threads=threads or 1,
            progress=progress,
        )
    return Sweep(out)


def _finished(out: Path, head: str) -> bool:
    """Whether a table is there whole; what is not is carried on by whoever made it."""
    if not out.exists():
        return False
    lines = out.read_text(encoding="utf-8").splitlines()
    if not lines or lines[0] != head:
        raise _native.Error(f"{out} is of another sweep; choose another name, or the same sweep")
    if '"digest"' not in lines[-1]:
        raise _native.Error(f"{out} is not finished; carry on without a client, or choose another name")
    return True


def _part(spec: dict[str, Any], path: Path, part: tuple[int, int], threads: int) -> Digest:
    rows, total, _ = _native.sweep_make(spec, path, part, threads, None)
    return Digest({"rows": rows}, int(total, 16))


def _merge(whole: Path, parts: list[Path]) -> Digest:
    rows, total = _native.sweep_merge(whole, parts)
    return Digest({"rows": rows}, int(total, 16))
