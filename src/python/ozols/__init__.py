"""Redundant constraints of mechanisms, contour by contour, and every redesign that removes them.

A mechanism goes in; an analysis, a search, reactions or a drawing come out:

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

What is found has the keys of the JSON that the command ``ozols`` prints, as items and as attributes, and ``to_pandas()``.
What goes wrong is an :class:`ozols.Error` with the command's words. Long work leaves other threads running; Ctrl-C ends it.
"""

from . import catalog
from ._mechanism import Builder, Drawing, Mechanism
from ._native import VERSION as __version__
from ._native import Error
from ._outcome import Outcome, Variant
from ._view import Told, View

__all__ = [
    "Builder",
    "Drawing",
    "Error",
    "Mechanism",
    "Outcome",
    "Told",
    "Variant",
    "View",
    "__version__",
    "catalog",
]
