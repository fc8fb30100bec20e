"""Checks an assembly that is open in FreeCAD, and changes its joint types there.

Nothing here imports FreeCAD: a document is anything with ``saveCopy`` and ``Objects``, so the tests do not need it. The
macro and the panel in ``src/python/freecad`` show the results. The environment variable OZOLS may name another program than the
one of the package.
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
    """An error of ozols."""


@dataclass(frozen=True)
class Change:
    """A change of the type of a joint, in the names of FreeCAD."""

    joint: str
    before: str
    after: str

    def __str__(self) -> str:
        return f"{self.joint}: {self.before} -> {self.after}"


@dataclass(frozen=True)
class Finding:
    """A redundant constraint: the joint, the constrained direction, and the joints that constrain it, too."""

    joint: str
    row: str
    duplicates: tuple[str, ...]
    millimetres: float | None
    degrees: float | None

    def __str__(self) -> str:
        return f"{self.joint}, {self.row}: also held by {', '.join(self.duplicates)}"


@dataclass(frozen=True)
class Found:
    """The result for an assembly.

    ``freedoms`` is W. ``redundant`` is σ, or its minimum if the digits leave it open. ``counted`` is six per part minus all
    constraints, the number that FreeCAD shows.
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
    """Returns the result for a document as it is now, saved or not. It reads a copy.

    :param document: FreeCAD's document, such as ``App.ActiveDocument``.
    :param assembly: label of the assembly if there are several; by default the one with most joints.
    :raises Error: if the document cannot be read as an assembly, or nothing in it can move.
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
        # If two joints have one label, the label of the second includes its name.
        found = [o for o in document.Objects if hasattr(o, "JointType") and label == f"{o.Label} ({o.Name})"] or found[:1]
    if not found:
        raise Error(f"there is no joint {label} in the document; check it again")
    return found[0]


def take(document: Any, changes: Sequence[Change]) -> None:
    """Sets the new types of joints in an open document, in one step that can be undone.

    :raises Error: if a joint does not exist or has another type by now; nothing is changed then.
    """
    joints = [(_joint(document, c.joint), c) for c in changes]
    for joint, change in joints:
        if joint.JointType != change.before:
            raise Error(f"{change.joint} is {joint.JointType} by now, not {change.before}; check the document again")
    document.openTransaction("Joint types without redundant constraints")
    for joint, change in joints:
        joint.JointType = change.after
    document.commitTransaction()
    document.recompute()
