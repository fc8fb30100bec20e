"""What the documents say runs, and gives what they say."""

import doctest
import importlib
import pkgutil
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

import ozols

SOURCES = Path(__file__).parents[2] / "src"
MODULES = ["ozols", *(f"ozols.{m.name}" for m in pkgutil.iter_modules(ozols.__path__) if m.name not in ("_native", "__main__"))]
OPTIONS = doctest.NORMALIZE_WHITESPACE


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name):
    found = doctest.testmod(importlib.import_module(name), optionflags=OPTIONS)
    assert found.failed == 0


def test_the_guide(in_tmp):
    text = (SOURCES / "guide/python.md").read_text()
    blocks = [block.split("```")[0] for block in text.split("```python\n")[1:]]
    assert len(blocks) > 4
    test = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, "python.md", "python.md", 0)
    runner = doctest.DocTestRunner(optionflags=OPTIONS)
    runner.run(test)
    assert runner.summarize().failed == 0


def test_the_tutorial(in_tmp):
    runpy.run_path(str(SOURCES / "python/tutorial.py"))
    assert Path("idea.svg").read_text().startswith("<svg")
    assert "<mujoco" in Path("gripper.xml").read_text()


def test_the_types_are_right(in_tmp):
    """The package by its own annotations and stubs, and the stubs by the library that was built."""
    checks = (
        ["mypy", "--strict", "--allow-untyped-calls", "--ignore-missing-imports", "-p", "ozols"],
        ["mypy.stubtest", "ozols._native"],
    )
    for check in checks:
        done = subprocess.run([sys.executable, "-m", *check], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr


def test_every_public_name_is_explained():
    for name in ozols.__all__:
        thing = getattr(ozols, name)
        assert name.startswith("__") or thing.__doc__, name
        for part, value in vars(thing).items() if isinstance(thing, type) else ():
            if not part.startswith("_") and callable(value):
                assert value.__doc__, f"{name}.{part}"
