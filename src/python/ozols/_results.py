"""The results of a mechanism, with the types of their main keys. All other keys of the JSON are there, too."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ._view import Answer, View

if TYPE_CHECKING:
    from ._mechanism import Mechanism


class Contour(View):
    """A contour of a state and its share of the redundant constraints."""

    joints: list[str]
    redundant: int


class State(View):
    """The figures of a state."""

    state: str
    links: int
    joints: int
    contours: int
    freedoms: int
    rank: int
    mobility: int
    finite_mobility: int
    working_mobility: int
    local_mobility: int
    redundant: int
    per_contour: list[Contour]
    certainty: str


class Analysis(Answer):
    """The mobility and the redundant constraints of each state; the table has one row per state."""

    _rows = "states"
    mechanism: str
    length_unit: str
    states: list[State]


class Pose(View):
    """The figures at a position of the drive."""

    at: float
    rank: int
    mobility: int
    redundant: int


class Stroke(Answer):
    """The figures over a range of the drive; the table has one row per position, and a notebook shows the chart."""

    _rows = "poses"
    state: str
    drive: str
    unit: str
    poses: list[Pose]

    def __init__(self, words: Sequence[str], mechanism: Mechanism) -> None:
        super().__init__(words, mechanism)
        self._data = self._data["stroke"]

    @property
    def svg(self) -> str:
        """The chart of the figures."""
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "stroke.svg")
            self._print(f"--svg={file}")
            return file.read_text(encoding="utf-8")

    def _repr_svg_(self) -> str:
        return self.svg


class Statics(Answer):
    """The joint reactions; the table has one row per joint and position."""

    mechanism: str

    @property
    def csv(self) -> str | None:
        """The reactions as CSV, if the part is held."""
        return self._print("--format=csv") if self._data.get("held", True) else None


class GripRow(View):
    """The grip of a part of one diameter, in the units of the file."""

    diameter: float
    pivot_distance: float
    mass: float
    holds: bool


class Grip(Answer):
    """The grasp of a lever gripper. The table has one row per diameter."""

    _rows = "diameters"
    mechanism: str
    holds: bool
    hardest: GripRow
    diameters: list[GripRow]


class Drive(Answer):
    """The design of a spring drive."""

    mechanism: str
    half_swing: float
    period: float
    complete: bool
    design: View


class LintedFile(View):
    """The redundant constraints of a file."""

    file: str
    mobility: int
    redundant: int
    certainty: str
    findings: list[View]
    cheapest: list[View]


class Lint(Answer):
    """The redundant constraints of files; the table has one row per file."""

    _rows = "files"
    files: list[LintedFile]


class Change(View):
    """A changed joint: ``joint``, the type ``to`` which it changes, and, as an item, ``change["from"]``."""

    joint: str
    to: str
