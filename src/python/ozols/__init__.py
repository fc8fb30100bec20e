"""Redundant constraints of mechanisms, contour by contour, and every redesign that removes them.

A :class:`Mechanism` is read or built, then analysed, searched, loaded and drawn:

>>> import ozols
>>> gripper = ozols.Mechanism.builtin("gripper-10")
>>> free = gripper.analyze().states[0]
>>> free.mobility, free.redundant
(1, 11)
>>> outcome = gripper.search(max_mobility=1)
>>> outcome.determinate
6340592477
>>> print(outcome[0])
1. cost 11.5, W = 1, σ = 0: 1-2, 3-0, 1-6, 6-7, 9-1 -> spherical; 5-1 -> cylindrical

Results have the keys of the JSON that the command ``ozols`` prints, as items and as attributes, and ``to_pandas()``.
Errors are :class:`ozols.Error`, and name the keywords of the call. Long work lets other threads run; Ctrl-C ends it.
"""

from . import catalog
from ._commands import fix, lint
from ._mechanism import Builder, Drawing, Mechanism
from ._native import VERSION as __version__
from ._native import Error
from ._outcome import Outcome, Variant
from ._results import (
    Analysis,
    Change,
    Contour,
    Drive,
    Grip,
    GripRow,
    Lint,
    LintedFile,
    Pose,
    State,
    Statics,
    Stroke,
)
from ._view import Answer, View

__all__ = [
    "Analysis",
    "Answer",
    "Builder",
    "Change",
    "Contour",
    "Drawing",
    "Drive",
    "Error",
    "Grip",
    "GripRow",
    "Lint",
    "LintedFile",
    "Mechanism",
    "Outcome",
    "Pose",
    "State",
    "Statics",
    "Stroke",
    "Variant",
    "View",
    "__version__",
    "catalog",
    "fix",
    "lint",
]
