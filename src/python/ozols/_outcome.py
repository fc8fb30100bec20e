"""Outcomes of searches, and their variants."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

from . import _native
from ._results import Change
from ._view import View, table

if TYPE_CHECKING:
    import os

    import pandas

    from ._mechanism import Mechanism


class Drawing(str):
    """A drawing as SVG. A notebook shows it."""

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the drawing to a file."""
        Path(path).write_text(self, encoding="utf-8")

    def _repr_svg_(self) -> str:
        return self


class Variant(View):
    """A redesign: ``position``, ``cost``, ``mobility``, ``redundant``, ``changes``, ``scores`` and the other keys of the JSON.

    ``print(variant)`` shows it in one line.
    """

    __slots__ = ("_made", "_native")
    position: int
    cost: float
    mobility: int
    redundant: int
    changes: list[Change]

    def __init__(self, native: _native.Variant, made: Callable[[_native.Mechanism], Mechanism]) -> None:
        super().__init__(json.loads(native.data))
        self._native = native
        self._made = made

    def __str__(self) -> str:
        return self._native.text

    def mechanism(self) -> Mechanism:
        """Returns the redesign as a mechanism."""
        return self._made(self._native.mechanism())

    def draw(self, kind: str = "kinematic", *, state: str = "free") -> Drawing:
        """Returns a drawing of the redesign with its changes marked."""
        return Drawing(self._native.draw(kind, state))

    def _repr_svg_(self) -> str:
        return self.draw()

    def _row(self) -> dict[str, Any]:
        keys = ("position", "cost", "mobility", "redundant")
        by_type: dict[str, list[str]] = {}
        for change in self._data["changes"]:
            by_type.setdefault(change["to"], []).append(change["joint"])
        changes = "; ".join(f"{', '.join(joints)} -> {to}" for to, joints in by_type.items())
        return {**{k: self._data[k] for k in keys}, "changes": changes}


class Outcome(Sequence[Variant]):
    """The outcome of a search: a sequence of the requested variants, with counts of all variants.

    >>> import ozols
    >>> found = ozols.Mechanism.builtin("gripper-10").search(top=3)
    >>> found.admissible, len(found), found[0].cost
    (25761436, 3, 11.5)
    >>> [v.redundant for v in found.sample(3, seed=7)]
    [0, 0, 0]
    >>> sum(1 for v, _ in zip(found.all(), range(1000)))
    1000
    """

    def __init__(self, native: _native.Outcome, made: Callable[[_native.Mechanism], Mechanism]) -> None:
        self._native = native
        self._made = made

    def _shown(self, variants: Iterable[_native.Variant]) -> Iterator[Variant]:
        return (Variant(v, self._made) for v in variants)

    @cached_property
    def counts(self) -> View:
        """All keys of the JSON except the variants and the remarks on them."""
        return View(json.loads(self._native.counts()))

    def to_dict(self) -> dict[str, Any]:
        """Returns the JSON that the command prints, without the keys ``format`` and ``seconds``."""
        data: dict[str, Any] = json.loads(self._native.data())
        # The package has its own version.
        del data["format"]
        return data

    def to_csv(self) -> str:
        """Returns the requested variants as CSV, as the command writes it."""
        return self._native.csv()

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the requested variants as a table of pandas."""
        import pandas

        rows = [line for line in self.to_csv().splitlines() if not line.startswith("#")]
        return pandas.read_csv(io.StringIO("\n".join(rows)))

    @property
    def space(self) -> int:
        """The number of variants in the search space."""
        return int(self.counts["space"])

    @property
    def determinate(self) -> int:
        """The number of variants with at most the allowed redundant constraints; a lower bound if not :attr:`exact`."""
        return int(self.counts["determinate"])

    @property
    def admissible(self) -> int:
        """The number of variants that meet every condition in the drawn pose; a lower bound if not :attr:`exact`."""
        return int(self.counts["admissible"])

    @property
    def lasting(self) -> int | None:
        """The number of variants that keep the motion throughout the motion of the mechanism as built. These are the ones listed.

        ``None`` if the motion is not followed; ``counts["pose_only"]`` has the reason.
        """
        lasting = self.counts.get("lasting")
        return None if lasting is None else int(lasting)

    @property
    def exact(self) -> bool:
        """Whether the search was complete, so that counts are exact and the list has the best variants."""
        return bool(self.counts["exact"])

    @property
    def certainty(self) -> str | None:
        """The reason why the counts of a complete search are not exact, or ``None`` if they are exact.

        ``"numeric"`` (ranks by singular values; ``counts.numeric`` has the ranges), ``"contradicted"`` or ``"undecided"``.
        """
        return self.counts.get("certainty")

    @property
    def determinate_by_mobility(self) -> dict[int, int]:
        """The numbers of determinate variants by mobility W."""
        return {int(w): int(n) for w, n in self.counts["by_mobility"].items()}

    @property
    def admissible_by_mobility(self) -> dict[int, int]:
        """The numbers of admissible variants by mobility W."""
        return {int(w): int(n) for w, n in self.counts["admissible_by_mobility"].items()}

    @cached_property
    def variants(self) -> list[Variant]:
        """The requested variants, best first."""
        return list(self._shown(self._native.variants(False, None, 0)))

    def all(self) -> Iterator[Variant]:
        """Returns an iterator over every variant that the search lists, cheapest first. It does not store them."""
        return self._shown(self._native.variants(True, None, 0))

    def sample(self, count: int, seed: int = 1) -> Iterator[Variant]:
        """Returns admissible variants drawn at random, each with equal probability."""
        return self._shown(self._native.variants(False, count, seed))

    def __iter__(self) -> Iterator[Variant]:
        return iter(self.variants)

    def __len__(self) -> int:
        return len(self.variants)

    @overload
    def __getitem__(self, at: int) -> Variant: ...
    @overload
    def __getitem__(self, at: slice) -> list[Variant]: ...
    def __getitem__(self, at: int | slice) -> Variant | list[Variant]:
        return self.variants[at]

    def __str__(self) -> str:
        return self._native.text()

    def __repr__(self) -> str:
        least = "" if self.exact else "at least "
        name = self.counts["mechanism"]
        return f"<ozols.Outcome of {name}: {least}{self.admissible} admissible of {self.space} variants>"

    def _repr_html_(self) -> str:
        least = "" if self.exact else "at least "
        lasting = self.lasting
        found = f"{self.admissible:,}" if lasting is None else f"{lasting:,}"
        drawn = "" if lasting is None else f", {self.admissible:,} in the drawn pose"
        head = f"<p>{least}{found} admissible of {self.space:,} variants{drawn}</p>"
        return head + table([v._row() for v in self])
