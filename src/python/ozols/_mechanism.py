"""Mechanisms: reading, building, analysis, search, workload and drawing."""

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
from ._results import Analysis, Drive, Grip, Statics, Stroke

__all__ = ["Builder", "Drawing", "Mechanism"]


def _entry(value: Any) -> Any:
    """Returns a value that JSON has no type for: numpy values as lists or numbers, fractions and symbols as expressions."""
    return value.tolist() if hasattr(value, "tolist") else str(value)


def _names(words: Iterable[str]) -> list[str]:
    """Returns a list of names, given as a list or as one string with commas."""
    return words.split(",") if isinstance(words, str) else list(words)


def _pairs(rules: Mapping[str, Iterable[str]] | Iterable[str]) -> list[tuple[str, list[str]]]:
    if isinstance(rules, Mapping):
        return [(k, _names(v)) for k, v in rules.items()]
    return [(k, []) for k in _names(rules)]


def _range(stroke: str | tuple[float, float, int]) -> str:
    return stroke if isinstance(stroke, str) else ":".join(map(str, stroke))


def _words(**options: str | float | bool | None) -> list[str]:
    """Returns the words of a command for options, without those that are ``None`` or false."""
    given = [(f"--{k.replace('_', '-')}", v) for k, v in options.items() if v is not None and v is not False]
    return [name if value is True else f"{name}={value}" for name, value in given]


def _costs(path: str | os.PathLike[str]) -> dict[str, str]:
    try:
        return {"name": os.fspath(path), "text": Path(path).read_text(encoding="utf-8")}
    except (OSError, UnicodeDecodeError) as e:
        raise _native.Error(f"costs: cannot read {path}: {e}") from e


def _asked(given: Mapping[str, Any]) -> str:
    """Returns the keywords of a search as a request in JSON, without those that are ``None``."""
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
    """A mechanism: links, joints, and the joint types that a search may use.

    Create one with :meth:`builtin`, :meth:`from_file`, :meth:`from_dict` and similar methods, or with a :class:`Builder`. It is
    immutable and can be pickled.

    >>> Mechanism.builtin("four-bar")
    <ozols.Mechanism four-bar: 4 links, 4 joints>
    """

    __slots__ = ("_native",)

    def __init__(self, native: _native.Mechanism) -> None:
        self._native = native

    @classmethod
    def builtin(cls, name: str) -> Mechanism:
        """Returns a built-in mechanism; :meth:`builtins` lists their names."""
        return cls(_native.Mechanism.builtin(name))

    @staticmethod
    def builtins() -> list[str]:
        """Returns the names of the built-in mechanisms.

        >>> "bennett" in Mechanism.builtins()
        True
        """
        return _native.builtin_names()

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Mechanism:
        """Reads a mechanism file (TOML, or JSON if the name ends in ``.json``) or a robot description (.urdf, .xml, .sdf).

        Warns about what a description leaves open.
        """
        return cls._doubtful(_native.Mechanism.from_file(path))

    @classmethod
    def from_toml(cls, text: str) -> Mechanism:
        """Reads the text of a mechanism file in TOML."""
        return cls(_native.Mechanism.from_toml(text))

    @classmethod
    def from_json(cls, text: str) -> Mechanism:
        """Reads the text of a mechanism file in JSON."""
        return cls(_native.Mechanism.from_json(text))

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Mechanism:
        """Reads the keys of a mechanism file (``ozols schema``).

        A number means its printed decimals. Expressions are strings such as ``"sqrt(3)/2"``, fractions, or sympy symbols.
        """
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
        """Reads a robot description (URDF, MJCF or SDF, by its root element) or a CAD assembly.

        ``pose`` sets joint values in radians and metres. ``loops`` is a file of loop closures. Warns about what the file leaves open.
        """
        side = None if loops is None else (os.fspath(loops), Path(loops).read_bytes())
        values = [(k, [v] if isinstance(v, (int, float)) else list(v)) for k, v in (pose or {}).items()]
        asked = {
            "pose": values,
            "floating": floating,
            "assemble": assemble,
            "open": open,
            "models": [os.fspath(folder) for folder in models],
            "assembly": assembly,
            "frame": frame,
            "outputs": _names(outputs),
        }
        return cls._doubtful(_native.Mechanism.from_robot(path, json.dumps(asked, default=_entry), side))

    from_urdf = from_mjcf = from_sdf = from_robot

    @classmethod
    def _doubtful(cls, read: tuple[_native.Mechanism, str]) -> Mechanism:
        native, doubts = read
        if doubts:
            warnings.warn(doubts, stacklevel=3)
        return cls(native)

    @property
    def name(self) -> str:
        """The name."""
        return self._native.name

    def to_dict(self) -> dict[str, Any]:
        """Returns the keys of the mechanism file. :meth:`from_dict` reads them."""
        data: dict[str, Any] = json.loads(self.export("json"))
        return data

    def export(self, format: str) -> str:
        """Returns the mechanism as text: ``toml``, ``json``, ``urdf``, ``mjcf``, ``sdf`` or ``dot``.

        >>> Mechanism.builtin("four-bar").export("sdf")[:14]
        '<?xml version='
        """
        return self._native.export(format)

    def analyze(self, state: str = "all", *, method: str = "auto", tolerance: float | None = None) -> Analysis:
        """Returns mobility and redundant constraints in each state, as ``ozols analyze``.

        >>> Mechanism.builtin("bennett").analyze().states[0].redundant
        3
        """
        return Analysis(["analyze", "-", *_words(state=state, method=method, tolerance=tolerance)], self)

    def stroke(
        self,
        range: str | tuple[float, float, int],
        *,
        drive: str | None = None,
        state: str = "free",
        tolerance: float | None = None,
    ) -> Stroke:
        """Returns the mobility and rank at poses over a range of the drive.

        A range is ``"0:360deg:72"``, or a tuple of start, end and steps, in radians or the length unit of the file.

        >>> Mechanism.builtin("four-bar").stroke("0:90deg:3").poses[-1].mobility
        1
        """
        # Singular values have a tolerance.
        method = None if tolerance is None else "svd"
        words = _words(stroke=_range(range), drive=drive, state=state, tolerance=tolerance, method=method)
        return Stroke(["analyze", "-", *words], self)

    def statics(
        self,
        state: str = "free",
        *,
        stroke: str | tuple[float, float, int] | None = None,
        spatial: bool = False,
        unilateral: bool = False,
    ) -> Statics:
        """Returns the joint reactions under the loads of the file, as ``ozols statics``. The table has one row per joint.

        ``spatial`` gives all six components also for a planar mechanism. With ``unilateral``, contacts with an object only push.
        """
        over = None if stroke is None else _range(stroke)
        words = _words(state=state, stroke=over, spatial=spatial, unilateral=unilateral)
        return Statics(["statics", "-", *words], self)

    def grip(
        self,
        *,
        accelerations: Iterable[Sequence[float]] = (),
        any_acceleration: float | None = None,
    ) -> Grip:
        """Returns what a lever gripper can hold and the drive moment it needs, as ``ozols grip``.

        Accelerations are in m/s², in the axes of the gripper; ``any_acceleration`` acts in any direction.

        >>> Mechanism.builtin("lever-gripper").grip()["holds"]
        True
        """
        further = [f"--acceleration={','.join(map(str, a))}" for a in accelerations]
        return Grip(["grip", "-", *further, *_words(any_acceleration=any_acceleration)], self)

    def drive(self) -> Drive:
        """Returns the design of the spring drive in ``[workload.drive]``, as ``ozols drive``.

        >>> "design" in Mechanism.builtin("torsion-module").drive()
        True
        """
        return Drive(["drive", "-"], self)

    def draw(self, kind: str = "kinematic", *, state: str = "free") -> Drawing:
        """Returns a drawing as SVG: the ``kinematic`` scheme from the coordinates, or the structural ``scheme``."""
        return Drawing(self._native.draw(kind, state))

    def studio(self, *, show: bool = True) -> Mechanism:
        """Opens the mechanism in the studio in the browser, and returns the edited mechanism when its window is closed, saved or not.

        With ``show=False`` only the address is printed. The studio runs in its own folder and does not write to your files.
        """
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "mechanism.toml"
            file.write_text(self.export("toml"), encoding="utf-8")
            words = [sys.executable, "-m", "ozols", "studio", str(file), *([] if show else ["--no-open"])]
            with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as running:
                print(running.stdout.readline() if running.stdout else "", end="", flush=True)
            if running.returncode:
                raise subprocess.CalledProcessError(running.returncode, words)
            # Without a save, the last state of the window is in the autosave file.
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
        drives: str | None = None,
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
        """Returns every redesign that meets the conditions: exact counts, and the best redesigns one by one.

        The keywords are the options of ``ozols search``. Give names as a list or with commas. ``forbid`` takes joints, or joints
        with names of options; ``unloading`` takes types, or types with joints; ``costs`` takes a file of costs; ``rank`` takes
        terms, or terms with weights. ``symmetry`` is ``all``, ``symmetric`` or ``one-per-orbit``. ``progress`` is called with the
        layers done, the total number of layers, and the nodes so far.

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
    """Builds a mechanism joint by joint. ``data`` has the keys of the file so far, for keys without a method.

    >>> plan = Builder("four-bar", mode="planar").link("frame", role="frame").link("rocker", role="output")
    >>> plan = plan.joint("A", "frame", "crank", point=(0, 0, 0), axis=(0, 0, 1), drive=True)
    >>> plan = plan.joint("B", "crank", "coupler", point=(0, 1, 0), axis=(0, 0, 1))
    >>> plan = plan.joint("C", "coupler", "rocker", point=(3, "sqrt(5)", 0), axis=(0, 0, 1))
    >>> plan = plan.joint("D", "rocker", "frame", point=(3, 0, 0), axis=(0, 0, 1))
    >>> plan.build().analyze().states[0].mobility
    1
    """

    def __init__(self, name: str, **keys: Any) -> None:
        """Starts a mechanism. ``keys`` are those of the file: ``length_unit``, ``description``, ``search`` and so on."""
        self.data: dict[str, Any] = {"name": name, **keys, "link": [], "joint": []}

    def link(self, id: str, **keys: Any) -> Builder:
        """Adds a link with the keys of ``[[link]]``, such as ``role="output"``."""
        self.data["link"].append({"id": id, **keys})
        return self

    def joint(
        self, id: str, first: str, second: str, *, type: str = "revolute", point: Sequence[Any] = (0, 0, 0), **keys: Any
    ) -> Builder:
        """Adds a joint between two links with the keys of ``[[joint]]``, and the links that are new."""
        known = {link["id"] for link in self.data["link"]}
        for link in dict.fromkeys((first, second)):
            if link not in known:
                self.link(link)
        self.data["joint"].append({"id": id, "links": [first, second], "type": type, "point": point, **keys})
        return self

    def build(self) -> Mechanism:
        """Returns the mechanism."""
        return Mechanism.from_dict(self.data)
