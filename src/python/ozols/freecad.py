"""What ozols says of an assembly that is open in FreeCAD, and its joint types changed there.

Nothing here imports FreeCAD: a document is anything with ``saveCopy`` and ``Objects``, so that this is tested without it. The
macro and the panel beside the package (``src/python/freecad``) show what it gives. OZOLS may name the program to ask in place of
the package's own.
"""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Sequence

from . import _native

__all__ = ["Change", "Error", "Finding", "Found", "check", "take"]


class Error(RuntimeError):
    """What went wrong, in the words of the command line."""


@dataclass(frozen=True)
class Change:
    """Another type for a joint, as FreeCAD calls it."""

    joint: str
    before: str
    after: str

    def __str__(self) -> str:
        return f"{self.joint}: {self.before} -> {self.after}"


@dataclass(frozen=True)
class Finding:
    """A redundant constraint: the joint, what of it is held twice, and the joints that hold the same."""

    joint: str
    row: str
    duplicates: tuple[str, ...]
    millimetres: float | None
    degrees: float | None

    def __str__(self) -> str:
        return f"{self.joint}, {self.row}: also held by {', '.join(self.duplicates)}"


@dataclass(frozen=True)
class Found:
    """What was found in an assembly.

    ``freedoms`` is W, ``redundant`` σ, the least it can be where digits leave it open, and ``counted`` six a part less all
    constraints, which FreeCAD shows.
    """

    freedoms: int
    redundant: int
    counted: int | None
    findings: tuple[Finding, ...]
    changes: tuple[Change, ...]
    freedoms_then: int | None
    notes: tuple[str, ...]

    @property
    def text(self) -> str:
        """All of it in lines."""
        lines = [f"True number of freedoms: {self.freedoms}", f"Redundant constraints: {self.redundant}"]
        if self.counted is not None and self.counted != self.freedoms:
            lines.append(f"(six a part less all constraints would be {self.counted})")
        lines += [f"- {f}" for f in self.findings]
        if self.changes:
            lines.append("Cheapest change of joint types that removes all:")
            lines += [f"- {c}" for c in self.changes]
        if self.freedoms_then is not None and self.freedoms_then > self.freedoms:
            lines.append(f"({self.freedoms_then} freedoms then: a part may turn or slide by itself)")
        lines += [f"Note: {n}" for n in self.notes]
        return "\n".join(lines)


def _lint(path: str, assembly: str | None) -> dict[str, Any]:
    out = f"{path}.json"
    words = ["ozols", "lint", path, "--format", "json", "-o", out]
    if assembly:
        words += ["--assembly", assembly]
    program = os.environ.get("OZOLS")
    if program:
        subprocess.run([program, *words[1:]], capture_output=True, check=False)
    else:
        # Within this process: what FreeCAD calls its Python is no program that could be run.
        _native.command(words)
    if not Path(out).is_file():
        raise Error(f"{program or 'ozols'} wrote nothing; try `{' '.join(words)}` in a terminal")
    said: dict[str, Any] = json.loads(Path(out).read_text(encoding="utf-8"))
    for passed in said.get("passed_over", []):
        raise Error(passed["why"])
    one: dict[str, Any] = said["files"][0]
    return one


def check(document: Any, assembly: str | None = None) -> Found:
    """What ozols finds in a document as it is now, saved or not: a copy of it is looked at.

    :param document: FreeCAD's document, such as ``App.ActiveDocument``.
    :param assembly: label of the assembly, where there are several; the one with most joints by default.
    :raises Error: where the document cannot be read as an assembly, or nothing in it can move.
    """
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "assembly.FCStd")
        document.saveCopy(path)
        v = _lint(path, assembly)
    findings = tuple(
        Finding(
            f["constraint"],
            f["row"],
            tuple(f["duplicates"]),
            (f["misfit"] or {}).get("millimetres"),
            (f["misfit"] or {}).get("degrees"),
        )
        for f in v["findings"]
    )
    return Found(
        v["mobility"],
        v["redundant"],
        v["counted"],
        findings,
        tuple(Change(c["joint"], c["from"], c["to"]) for c in v["changes"]),
        v["mobility_then"],
        (*v["moved"], *v["approximated"]),
    )


def _joint(document: Any, label: str) -> Any:
    found = [o for o in document.Objects if hasattr(o, "JointType") and o.Label == label]
    if len(found) != 1:
        # Of two joints of one label the second is told with its name.
        found = [o for o in document.Objects if hasattr(o, "JointType") and label == f"{o.Label} ({o.Name})"] or found[:1]
    if not found:
        raise Error(f"there is no joint {label} in the document; look at it again")
    return found[0]


def take(document: Any, changes: Sequence[Change]) -> None:
    """Gives joints of an open document their new types, in one step that can be undone.

    :raises Error: where a joint is not there, or is of another type by now; nothing is changed then.
    """
    joints = [(_joint(document, c.joint), c) for c in changes]
    for joint, change in joints:
        if joint.JointType != change.before:
            raise Error(f"{change.joint} is {joint.JointType} by now, not {change.before}; look at the document again")
    document.openTransaction("Joint types without redundant constraints")
    for joint, change in joints:
        joint.JointType = change.after
    document.commitTransaction()
    document.recompute()
