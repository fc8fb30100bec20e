"""What the tests of the package share: the command that the wheel installed."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

COMMAND = Path(sys.executable).with_name("ozols")


def ozols(*args: object) -> subprocess.CompletedProcess[str]:
    """Runs the command ``ozols``."""
    return subprocess.run([COMMAND, *map(str, args)], capture_output=True, text=True, check=False)


def printed(*args: object) -> dict:
    """The JSON that the command prints, without the number of its contract."""
    done = ozols(*args, "--format", "json")
    assert done.returncode in (0, 1), done.stderr
    data = json.loads(done.stdout)
    if isinstance(data, dict):
        assert data.pop("format") == 1
    return data


@pytest.fixture
def in_tmp(tmp_path, monkeypatch):
    """A folder of one's own to work in."""
    monkeypatch.chdir(tmp_path)
    return tmp_path
