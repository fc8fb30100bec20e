"""The compiled library: views as JSON, which the package turns into objects."""

import os
from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeAlias, final

__all__ = [
    "VERSION",
    "Error",
    "Mechanism",
    "Outcome",
    "Variant",
    "Variants",
    "builtin_names",
    "catalog_build",
    "catalog_merge",
    "catalog_plan",
    "command",
    "printed",
    "search",
]

VERSION: str

_Path: TypeAlias = str | os.PathLike[str]

class Error(ValueError):
    """An error of the library. Its text names the keywords of the call."""

@final
class Mechanism:
    name: str
    @staticmethod
    def builtin(name: str) -> Mechanism: ...
    @staticmethod
    def from_file(path: _Path) -> tuple[Mechanism, str]: ...
    @staticmethod
    def from_toml(text: str) -> Mechanism: ...
    @staticmethod
    def from_json(text: str) -> Mechanism: ...
    @staticmethod
    def from_robot(
        path: _Path,
        asked: str,
        loops: tuple[str, bytes] | None,
    ) -> tuple[Mechanism, str]: ...
    def export(self, format: str) -> str: ...
    def draw(self, kind: str, state: str) -> str: ...

@final
class Outcome:
    def counts(self) -> str: ...
    def data(self) -> str: ...
    def csv(self) -> str: ...
    def text(self) -> str: ...
    def variants(self, all: bool, sample: int | None, seed: int) -> Variants: ...

@final
class Variants(Iterator[Variant]):
    def __next__(self) -> Variant: ...

@final
class Variant:
    position: int
    text: str
    data: str
    def mechanism(self) -> Mechanism: ...
    def draw(self, kind: str, state: str) -> str: ...

def builtin_names() -> list[str]: ...
def search(mechanism: Mechanism, asked: str, progress: Callable[[int, int, int], object] | None) -> Outcome: ...
def catalog_plan(json: str) -> tuple[str, list[str]]: ...
def catalog_build(
    json: str,
    path: _Path,
    part: tuple[int, int],
    threads: int,
    progress: Callable[[int, int], object] | None,
) -> int: ...
def catalog_merge(path: _Path, parts: Sequence[_Path]) -> int: ...
def command(words: Sequence[str]) -> int: ...
def printed(words: Sequence[str], mechanism: Mechanism | None = None) -> str: ...
