"""Results by the keys of the JSON that the command prints."""

from __future__ import annotations

import csv
import html
import io
import json
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, get_args, get_type_hints

from . import _native

if TYPE_CHECKING:
    import pandas

    from ._mechanism import Mechanism

#: Maximum number of rows of a table in a notebook.
ROWS = 30


def _wrapped(value: Any, kind: type[View]) -> Any:
    if isinstance(value, dict):
        return kind(value)
    if isinstance(value, list):
        return [_wrapped(v, kind) for v in value]
    return value


def _plain(value: Any) -> bool:
    return not isinstance(value, (dict, list))


def table(records: Sequence[Mapping[str, Any]]) -> str:
    """Returns rows as an HTML table, at most :data:`ROWS` of them."""
    columns = list(dict.fromkeys(k for r in records for k in r))

    def cells(tag: str, values: list[Any]) -> str:
        shown = ("" if v is None else f"{v:.6g}" if isinstance(v, float) else str(v) for v in values)
        return "<tr>" + "".join(f"<{tag}>{html.escape(v)}</{tag}>" for v in shown) + "</tr>"

    rows = [cells("td", [r.get(c) for c in columns]) for r in records[:ROWS]]
    more = f"<p>and {len(records) - ROWS} more</p>" if len(records) > ROWS else ""
    return f"<table><thead>{cells('th', columns)}</thead><tbody>{''.join(rows)}</tbody></table>{more}"


class View(Mapping[str, Any]):
    """A mapping whose keys are also attributes. A subclass declares the types of its main keys.

    >>> import ozols
    >>> state = ozols.Mechanism.builtin("bennett").analyze().states[0]
    >>> state.mobility == state["mobility"] == 1
    True
    """

    __slots__ = ("_data",)
    #: The classes of the values that are views, by key.
    _kinds: ClassVar[Mapping[str, type[View]]] = {}

    def __init_subclass__(cls) -> None:
        cls._kinds = {**cls._kinds, **_views_of(cls)}

    def __init__(self, data: dict[str, Any]) -> None:
        self._data = data

    def __getitem__(self, key: str) -> Any:
        return _wrapped(self._data[key], self._kinds.get(key, View))

    def __getattr__(self, key: str) -> Any:
        if key.startswith("_"):
            raise AttributeError(key)
        try:
            return self[key]
        except KeyError:
            known = ", ".join(self._data)
            raise AttributeError(f"there is no {key}; there are {known}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._data]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._data!r})"

    def to_dict(self) -> dict[str, Any]:
        """Returns the plain dictionary."""
        return self._data


def _views_of(cls: type[View]) -> dict[str, type[View]]:
    """Returns the declared keys of a class whose values are views or lists of views."""
    named = {k: (*get_args(hint), hint)[0] for k, hint in get_type_hints(cls).items() if not k.startswith("_")}
    return {k: kind for k, kind in named.items() if isinstance(kind, type) and issubclass(kind, View)}


class Answer(View):
    """A result: its keys, and the text that the command prints.

    ``print(answer)`` shows the text; a notebook shows the declared keys of :attr:`records` as a table.
    """

    __slots__ = ("_mechanism", "_printed", "_words")
    #: The key of the main table.
    _rows: ClassVar[str | None] = None

    def __init__(self, words: Sequence[str], mechanism: Mechanism | None = None) -> None:
        """Runs a command; the mechanism is its file ``-``."""
        self._words, self._mechanism = words, mechanism
        self._printed: dict[tuple[str, ...], str] = {}
        data = json.loads(self._print("--format=json"))
        data.pop("format", None)
        super().__init__(data)

    def _print(self, *words: str) -> str:
        """Returns what the command prints with further words. It runs once for the same words."""
        if words not in self._printed:
            command, *others = self._words
            about = None if self._mechanism is None else self._mechanism._native
            self._printed[words] = _native.printed([command, *words, *others], about)
        return self._printed[words]

    @property
    def text(self) -> str:
        """The text that the command prints."""
        return self._print()

    @property
    def csv(self) -> str | None:
        """The main table as CSV, if the command prints one."""
        return None

    def __str__(self) -> str:
        return self.text

    @property
    def records(self) -> list[dict[str, Any]]:
        """The rows of the main table (states, positions or joints), or an empty list if there is none."""
        if (printed := self.csv) is not None:
            return list(csv.DictReader(io.StringIO(printed)))
        rows = self._data.get(self._rows, []) if self._rows else []
        return [{k: v for k, v in row.items() if _plain(v)} for row in rows]

    def to_pandas(self) -> pandas.DataFrame:
        """Returns :attr:`records` as a table of pandas."""
        import pandas

        if (printed := self.csv) is not None:
            return pandas.read_csv(io.StringIO(printed))
        return pandas.DataFrame(self.records)

    def _repr_html_(self) -> str:
        records = self.records
        if not records:
            return f"<pre>{html.escape(self.text)}</pre>"
        kind = self._kinds.get(self._rows or "")
        declared = get_type_hints(kind) if kind else {}
        return table([{k: v for k, v in row.items() if not declared or k in declared} for row in records])
