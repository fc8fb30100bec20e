"""Mechanisms: read, built, analysed, searched and drawn."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from . import _native
from ._outcome import Drawing, Outcome
from ._view import Chart, Told

__all__ = ["Builder", "Drawing", "Mechanism"]


def _entry(value: Any) -> Any:
    """What JSON has no word for: arrays and numbers of numpy; fractions and symbols become expressions."""
    return value.tolist() if hasattr(value, "tolist") else str(value)


def _names(words: Iterable[str]) -> list[str]:
    """A list of names, or one string of them with commas, as on the command line."""
    return words.split(",") if isinstance(words, str) else list(words)


def _pairs(rules: Mapping[str, Iterable[str]] | Iterable[str]) -> list[tuple[str, list[str]]]:
    if isinstance(rules, Mapping):
        return [(k, _names(v)) for k, v in rules.items()]
    return [(k, []) for k in _names(rules)]


def _range(stroke: str | tuple[float, float, int]) -> str:
    return stroke if isinstance(stroke, str) else ":".join(map(str, stroke))


def _costs(path: str | os.PathLike[str]) -> dict[str, str]:
    try:
        return {"name": os.fspath(path), "text": Path(path).read_text(encoding="utf-8")}
    except (OSError, UnicodeDecodeError) as e:
        raise _native.Error(f"costs: cannot read {path}: {e}") from e


def _asked(given: Mapping[str, Any]) -> str:
    """The keywords of a search as the library takes them: a request in JSON, without what is left to it."""
    rank = given["rank"]
    terms = rank.items() if isinstance(rank, Mapping) else ((t, 1.0) for t in _names(rank))
    asked = {
        **given,
        "hold": _names(given["hold"]),
        "unloading": [([k], v) for k, v in _pairs(given["unloading"])],
        "options": _names(given["options"]),
        "allow": _pairs(given["allow"] or {}),
        "forbid": _pairs(given["forbid"]),
        "costs": None if given["costs"] is None else _costs(given["costs"]),
        "rank": [f"{t}={float(w)!r}" for t, w in terms],
    }
    return json.dumps({k: v for k, v in asked.items() if v is not None}, default=_entry)


class Mechanism:
    """A mechanism: links, joints, and what a search may change.

    Made by :meth:`builtin`, :meth:`from_file`, :meth:`from_dict` and their like, or with a :class:`Builder`; it does not
    change afterwards, and may be pickled.

    >>> Mechanism.builtin("four-bar")
    <ozols.Mechanism four-bar: 4 links, 4 joints>
    """

    __slots__ = ("_native",)

    def __init__(self, native: _native.Mechanism) -> None:
        self._native = native

    @classmethod
    def builtin(cls, name: str) -> Mechanism:
        """One of the built-in mechanisms; :meth:`builtins` has their names."""
        return cls(_native.Mechanism.builtin(name))

    @staticmethod
    def builtins() -> list[str]:
        """Names of the built-in mechanisms.

        >>> "bennett" in Mechanism.builtins()
        True
        """
        return _native.builtin_names()

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Mechanism:
        """A mechanism file (TOML; JSON where the name ends so) or a robot description (.urdf, .xml, .sdf).

        Warns of what a description leaves in doubt.
        """
        return cls._doubtful(_native.Mechanism.from_file(path))

    @classmethod
    def from_toml(cls, text: str) -> Mechanism:
        """The text of a mechanism file in TOML."""
        return cls(_native.Mechanism.from_toml(text))

    @classmethod
    def from_json(cls, text: str) -> Mechanism:
        """The text of a mechanism file in JSON."""
        return cls(_native.Mechanism.from_json(text))

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Mechanism:
        """The keys of a mechanism file (``ozols schema``). Numbers are taken as they print; expressions are strings such as
        ``"sqrt(3)/2"``, fractions, or symbols of sympy."""
        return cls.from_json(json.dumps(data, indent=2, default=_entry, ensure_ascii=False))

    @classmethod
    def from_robot(
        cls,
        path: str | os.PathLike[str],
        *,
        loops: str | os.PathLike[str] | None = None,
        pose: Mapping[str, float | Sequence[float]] | None = None,
        floating: bool = False,
        assemble: bool = False,
        open: bool = False,
        models: Iterable[str | os.PathLike[str]] = (),
        assembly: str | None = None,
        frame: str | None = None,
        outputs: Iterable[str] = (),
    ) -> Mechanism:
        """A robot description (URDF, MJCF or SDF, by its root element) or a CAD assembly. The options are those
        of ``ozols export``.

        ``pose`` gives joints values in radians and metres. Warns of what is left in doubt.
        """
        side = None if loops is None else (os.fspath(loops), Path(loops).read_bytes())
        values = [(k, [v] if isinstance(v, (int, float)) else list(v)) for k, v in (pose or {}).items()]
        options = (side, values, floating, assemble, open, list(models), assembly, frame, _names(outputs))
        return cls._doubtful(_native.Mechanism.from_robot(path, *options))

    from_urdf = from_mjcf = from_sdf = from_robot

    @classmethod
    def _doubtful(cls, read: tuple[_native.Mechanism, str]) -> Mechanism:
        native, doubts = read
        if doubts:
            warnings.warn(doubts, stacklevel=3)
        return cls(native)

    @property
    def name(self) -> str:
        """Its name."""
        return self._native.name

    def to_dict(self) -> dict[str, Any]:
        """The keys of its file, every joint with its own options; :meth:`from_dict` reads them."""
        data: dict[str, Any] = json.loads(self.export("json"))
        return data

    def export(self, format: str) -> str:
        """Itself as text: ``toml``, ``json``, ``urdf``, ``mjcf``, ``sdf``, ``dot`` or ``graphml``.

        >>> Mechanism.builtin("four-bar").export("sdf")[:14]
        '<?xml version='
        """
        return self._native.export(format)

    def analyze(self, state: str = "all", *, method: str = "auto", tolerance: float | None = None) -> Told:
        """Mobility and redundant constraints in each state, as ``ozols analyze``.

        >>> Mechanism.builtin("bennett").analyze().states[0].redundant
        3
        """
        return Told(_native.analyze(self._native, state, method, tolerance), "states")

    def stroke(
        self,
        range: str | tuple[float, float, int],
        *,
        drive: str | None = None,
        state: str = "free",
        tolerance: float | None = None,
    ) -> Chart:
        """The figures over a range of the drive: what ``ozols analyze --stroke`` has as ``stroke``.

        A range is ``"0:360deg:72"``, or from, to and steps, in radians or the file's unit of length.

        >>> Mechanism.builtin("four-bar").stroke("0:90deg:3").poses[-1].mobility
        1
        """
        return Chart(_native.stroke(self._native, _range(range), drive, state, tolerance), "poses")

    def statics(
        self,
        state: str = "free",
        *,
        stroke: str | tuple[float, float, int] | None = None,
        spatial: bool = False,
        unilateral: bool = False,
    ) -> Told:
        """Joint reactions under the loads of the file, as ``ozols statics``; its table is one of joints.

        ``spatial``: all six components of each, where the plane would do. ``unilateral``: contacts with an object only push.
        """
        over = None if stroke is None else _range(stroke)
        return Told(_native.statics(self._native, state, over, spatial, unilateral))

    def draw(self, kind: str = "scheme", *, state: str = "free") -> Drawing:
        """A drawing as SVG: the structural ``scheme``, or the ``kinematic`` one from the coordinates."""
        return Drawing(self._native.draw(kind, state))

    def studio(self, *, show: bool = True) -> Mechanism:
        """Opens the mechanism in the studio, a page in the browser to draw and change it, and gives back what became of it once its
        window is closed, saved or not. With ``show=False`` the address is printed, to be opened by hand.

        It runs beside Python, in a folder of its own: nothing of yours is written to.
        """
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "mechanism.toml"
            file.write_text(self.export("toml"), encoding="utf-8")
            words = [sys.executable, "-m", "ozols", "studio", str(file), *([] if show else ["--no-open"])]
            with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as running:
                print(running.stdout.readline() if running.stdout else "", end="", flush=True)
            if running.returncode:
                raise subprocess.CalledProcessError(running.returncode, words)
            # What was not saved is what the window showed last.
            unsaved = file.with_name("mechanism.toml.autosave")
            return Mechanism.from_toml((unsaved if unsaved.exists() else file).read_text(encoding="utf-8"))

    def search(
        self,
        *,
        options: Iterable[str] = (),
        max_redundant: int = 0,
        max_mobility: int | None = None,
        max_changes: int | None = None,
        max_external: int | None = None,
        max_harmful: int | None = None,
        state: str | None = None,
        allow_loose_object: bool = False,
        allow_output_change: bool = False,
        drives: str = "kept",
        hold: Iterable[str] = (),
        allow: Mapping[str, Iterable[str]] | None = None,
        forbid: Mapping[str, Iterable[str]] | Iterable[str] = (),
        unloading: Mapping[str, Iterable[str]] | Iterable[str] = (),
        costs: str | os.PathLike[str] | None = None,
        symmetry: str = "all",
        top: int = 10,
        distinct: bool = False,
        rank: Mapping[str, float] | Iterable[str] = (),
        pool: int | None = None,
        poses: int = 0,
        pose_only: bool = False,
        counted: bool = True,
        check: str = "full",
        method: str = "diagram",
        as_written: bool = False,
        nodes: int | None = None,
        memory: int | None = None,
        seed: int = 1,
        progress: Callable[[int, int, int], object] | None = None,
    ) -> Outcome:
        """Every redesign that meets the conditions: exact counts, and the best of them one by one.

        The keywords are the options of ``ozols search``; names come as a list, or with commas between. ``forbid`` takes joints,
        or joints with names of options; ``unloading`` types, or types with joints; ``costs`` a file of costs; ``rank`` terms, or terms with
        weights; ``symmetry`` is ``all``, ``symmetric`` or ``one-per-orbit``. ``progress`` is called with layers done, layers in
        all, and nodes so far.

        >>> found = Mechanism.builtin("gripper-10").search(options=["cylindrical", "spherical"], max_changes=7)
        >>> found.determinate, found.admissible, found[0].cost
        (136800, 6240, 11.5)
        """
        given = {name: value for name, value in locals().items() if name not in ("self", "progress")}
        return Outcome(_native.search(self._native, _asked(given), progress), Mechanism)

    def __repr__(self) -> str:
        data = self.to_dict()
        return f"<ozols.Mechanism {self.name}: {len(data['link'])} links, {len(data['joint'])} joints>"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Mechanism) and self.export("json") == other.export("json")

    def __hash__(self) -> int:
        return hash(self.export("json"))

    def __reduce__(self) -> tuple[Any, ...]:
        return Mechanism.from_json, (self.export("json"),)

    def _repr_svg_(self) -> str:
        return self.draw()


class Builder:
    """A mechanism joint by joint. ``data`` is the file so far, for what has no method.

    >>> plan = Builder("four-bar", mode="planar").link("frame", role="frame").link("rocker", role="output")
    >>> plan = plan.joint("A", "frame", "crank", point=(0, 0, 0), axis=(0, 0, 1), drive=True)
    >>> plan = plan.joint("B", "crank", "coupler", point=(0, 1, 0), axis=(0, 0, 1))
    >>> plan = plan.joint("C", "coupler", "rocker", point=(3, "sqrt(5)", 0), axis=(0, 0, 1))
    >>> plan = plan.joint("D", "rocker", "frame", point=(3, 0, 0), axis=(0, 0, 1))
    >>> plan.build().analyze().states[0].mobility
    1
    """

    def __init__(self, name: str, **keys: Any) -> None:
        """``keys`` are those of the file: ``length_unit``, ``description``, ``search`` and so on."""
        self.data: dict[str, Any] = {"name": name, **keys, "link": [], "joint": []}

    def link(self, id: str, **keys: Any) -> Builder:
        """A link, with the keys of ``[[link]]``, such as ``role="output"``."""
        self.data["link"].append({"id": id, **keys})
        return self

    def joint(
        self, id: str, first: str, second: str, *, type: str = "revolute", point: Sequence[Any] = (0, 0, 0), **keys: Any
    ) -> Builder:
        """A joint between two links, with the keys of ``[[joint]]``; a link that is new is added."""
        known = {link["id"] for link in self.data["link"]}
        for link in dict.fromkeys((first, second)):
            if link not in known:
                self.link(link)
        self.data["joint"].append({"id": id, "links": [first, second], "type": type, "point": point, **keys})
        return self

    def build(self) -> Mechanism:
        """The mechanism."""
        return Mechanism.from_dict(self.data)
