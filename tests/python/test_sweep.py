"""Sweeps in this process: the command's tables, and what is made of them."""

from fractions import Fraction
from pathlib import Path

import pytest
from conftest import ozols as command

import ozols

NAME = "parallelogram-3-rods"


def test_a_sweep_is_the_commands(in_tmp):
    swept = ozols.sweep(NAME, grid=3, out="mine.jsonl", search={"options": ["spherical"], "max_changes": 3})
    words = ["sweep", NAME, "--grid", 3, "--options", "spherical", "--max-changes", 3, "-q"]
    done = command(*words, "-o", "theirs.jsonl", "--csv", "theirs.csv", "--svg", "theirs.svg")
    assert done.returncode == 0, done.stderr
    assert Path("mine.jsonl").read_bytes() == Path("theirs.jsonl").read_bytes()
    assert swept.csv == Path("theirs.csv").read_text()
    assert swept.plot() == Path("theirs.svg").read_text()
    assert done.stdout.startswith(str(swept))
    # What one has begun the other carries on.
    done = command(*words, "-o", "mine.jsonl")
    assert done.stdout.startswith(str(swept))


def test_rows_are_tables_and_views():
    swept = ozols.sweep(NAME, sobol=8, seed=5, search=False, stroke="0:20deg:2", methods=True)
    table = swept.to_pandas()
    assert len(table) == len(swept.rows) == swept.samples == 8
    assert list(table["height"]) == [row.at.height for row in swept.rows]
    assert set(table["certainty_free"]) == {"proven"}
    assert swept._repr_svg_().startswith("<svg")
    assert all(row.methods["modular"] == "right" for row in swept.rows)
    assert swept.methods["modular"] == {"right": 8}


def test_a_mechanism_may_be_text_or_keys_with_fractions(in_tmp):
    keys = ozols.Mechanism.builtin("four-bar").to_dict()
    keys["parameter"] = {"crank": {"values": [Fraction(91, 3), 30], "default": 30}}
    keys["joint"][1]["point"] = [0, "crank", 0]
    swept = ozols.sweep(keys, search=False)
    assert [row.exact.to_dict() if "exact" in row else {} for row in swept.rows] == [{"crank": "91/3"}, {}]
    assert swept.rows[0].states[0].redundant == 3
    # Without a sweep it is as it was.
    assert ozols.Mechanism.from_dict(keys) == ozols.Mechanism.builtin("four-bar")


def test_wrong_sweeps_are_errors(in_tmp):
    for wrong, said in [
        (lambda: ozols.sweep("four-bar"), "no parameter with a range"),
        (lambda: ozols.sweep("nowhere"), "cannot read nowhere"),
        (lambda: ozols.sweep(NAME, grid=1), "--grid must be at least 2"),
        (lambda: ozols.sweep(NAME, sobol=0), "--sobol must be from 1"),
        (lambda: ozols.sweep(NAME, grid=2, search=False).plot("speed"), "is none of"),
        (lambda: ozols.sweep(NAME, grid=2, search=False).plot(over=["x"]), "--over takes"),
    ]:
        with pytest.raises(ozols.Error, match=said):
            wrong()
    with pytest.raises(TypeError, match="no keyword 'speed'"):
        ozols.sweep(NAME, search={"speed": 1})


def test_progress_is_heard_and_what_it_raises_ends_the_sweep(in_tmp):
    heard = []

    def enough(done, of):
        heard.append((done, of))
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        ozols.sweep(NAME, grid=9, search=False, out="t.jsonl", threads=1, progress=enough)
    assert heard[0] == (4, 81)
    begun = Path("t.jsonl").read_bytes()
    ozols.sweep(NAME, grid=9, search=False, out="t.jsonl")
    assert Path("t.jsonl").read_bytes().startswith(begun)
