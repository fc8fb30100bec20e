"""Files of robots and assemblies: what is redundant in them, and the same files without it."""

from __future__ import annotations

import os
from collections.abc import Iterable

from . import _native
from ._results import Lint

__all__ = ["fix", "lint"]


def lint(*files: str | os.PathLike[str]) -> Lint:
    """Returns the redundant constraints of robot descriptions, CAD assemblies and mechanism files, as ``ozols lint``.

    Each entry of ``files`` names the loops, what is redundant in each, and what removes it.
    """
    return Lint(["lint", *(os.fspath(file) for file in files)])


def fix(
    file: str | os.PathLike[str],
    output: str | os.PathLike[str],
    *,
    at: Iterable[str] = (),
    variant: int | None = None,
) -> str:
    """Writes a robot description or CAD assembly without its redundant constraints to ``output``, as ``ozols fix``.

    ``at`` names the joints, loops or couplings that may change; by default all except drives. ``variant`` applies a variant of
    the search instead of the cheapest releases. Returns a summary of the changes. Raises :class:`ozols.Error`, and writes
    nothing, if the joints that may change do not remove everything.
    """
    words = [f"--output={os.fspath(output)}", *(f"--at={name}" for name in at)]
    if variant is not None:
        words.append(f"--variant={variant}")
    return _native.printed(["fix", *words, "--", os.fspath(file)])
