"""Commands that run as a separate process: :func:`lint`, :func:`fix`, and the workload of a mechanism."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterable, Sequence

from . import _native
from ._view import Answer

__all__ = ["fix", "lint"]

#: The exit code of a command that refuses its input.
REFUSED = 2


def run(words: Sequence[str | os.PathLike[str]]) -> subprocess.CompletedProcess[str]:
    """Runs a command of ``ozols`` and returns its output.

    Raises :class:`ozols.Error` with the text of the command if it refuses its input.
    """
    command = [sys.executable, "-m", "ozols", *words]
    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", check=False)
    if done.returncode >= REFUSED:
        raise _native.Error(done.stderr.removeprefix("error: ").strip())
    return done


def answer(words: Sequence[str | os.PathLike[str]], rows: str | None = None) -> Answer:
    """Returns the JSON and the text of a command; ``rows`` is the key of its main table."""
    text = run([*words, "--quiet"]).stdout
    return Answer((run([*words, "--quiet", "--format", "json"]).stdout, text, None, None), rows)


def options(**given: object) -> list[str]:
    """Returns keywords as options of a command: ``None`` and ``False`` are omitted, and ``True`` has no value."""
    words = []
    for name, value in given.items():
        if value is None or value is False:
            continue
        option = "--" + name.replace("_", "-")
        words.append(option if value is True else f"{option}={value}")
    return words


def lint(*files: str | os.PathLike[str]) -> Answer:
    """Returns the redundant constraints of robot descriptions, CAD assemblies and mechanism files, as ``ozols lint``.

    Each entry of ``files`` names the loops, what is redundant in each, and what removes it.
    """
    return answer(["lint", *files], "files")


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
    chosen = [word for name in at for word in ("--at", name)]
    done = run(["fix", file, "-o", output, *chosen, *options(variant=variant)])
    return done.stderr
