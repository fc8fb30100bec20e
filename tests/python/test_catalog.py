"""Catalogues opened, asked, and put elsewhere; built here as the command builds them."""

import json
import sqlite3

import pytest
from conftest import ozols as command
from conftest import printed

import ozols

SPEC = {"links": "4..6", "symmetries": ["mirror"], "ideas": 3}


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A catalogue that the command made."""
    path = tmp_path_factory.mktemp("catalog") / "grippers.db"
    flags = ["--links", "4..6", "--symmetry", "mirror", "--ideas", 3]
    assert command("catalog", "build", *flags, "-o", path).returncode == 0
    return path


def test_a_catalogue_built_here_is_the_commands(built, in_tmp):
    heard = []
    with ozols.catalog.build(SPEC, out="mine.db", progress=lambda *p: heard.append(p)) as mine, ozols.catalog.open(built) as its:
        assert heard[-1] == (5, 5)
        assert mine.spec == its.spec
        assert mine.digest() == its.digest()
        assert mine.digest().rows["structures"] == len(mine) == 5
    heard.clear()
    ozols.catalog.build(SPEC, out="mine.db", progress=lambda *p: heard.append(p)).close()
    assert heard == []


def test_a_digest_sees_every_value(built, in_tmp):
    (in_tmp / "other.db").write_bytes(built.read_bytes())
    with ozols.catalog.open(built) as its:
        digest = its.digest()
    with sqlite3.connect("other.db") as db:
        db.execute("UPDATE counts SET variants = variants + 1 WHERE changes = (SELECT max(changes) FROM counts)")
    with ozols.catalog.open("other.db") as other:
        assert other.digest().rows == digest.rows and other.digest() != digest


def test_tables_are_what_the_command_answers(built):
    with ozols.catalog.open(built) as its:
        for table, key in ozols.catalog.TABLES.items():
            answer = command("catalog", "query", built, f"SELECT * FROM {table} ORDER BY {key}", "--format", "json")
            there = json.loads(answer.stdout)
            assert its.query(table) == there
            frame, arrow, polar = its.to_pandas(table), its.to_arrow(table), its.to_polars(table)
            assert len(frame) == arrow.num_rows == len(polar) == len(there) > 0
            assert list(frame) == arrow.column_names == polar.columns == list(there[0])


def test_counts_beyond_63_bits_stay_exact(built, in_tmp):
    (in_tmp / "large.db").write_bytes(built.read_bytes())
    many = 3**70
    with sqlite3.connect("large.db") as db:
        db.execute("UPDATE layouts SET determinate = ?", [str(many)])
    with ozols.catalog.open("large.db") as large:
        assert {row["determinate"] for row in large.query("layouts")} == {many}
        assert set(large.to_pandas("layouts")["determinate"]) == {many}
        assert {int(x) for x in large.to_arrow("layouts")["determinate"].to_pylist()} == {many}


def test_parquet_is_read_by_others(built, in_tmp):
    import duckdb
    import pandas

    with ozols.catalog.open(built) as its:
        its.to_parquet("out")
        wanted = its.query("SELECT links, count(*) AS n FROM structures JOIN layouts ON structure = id GROUP BY links")
        frame = its.to_pandas("ideas")
    tables = "'out/structures.parquet' s JOIN 'out/layouts.parquet' l ON l.structure = s.id"
    sql = f"SELECT links, count(*) AS n FROM {tables} GROUP BY links"
    assert duckdb.sql(sql).fetchall() == [tuple(row.values()) for row in wanted]
    back = pandas.read_parquet("out/ideas.parquet")
    assert list(back["changes"]) == list(frame["changes"])
    assert [int(n) for n in back["variants"]] == [int(n) for n in frame["variants"]]


def test_a_structure_is_a_mechanism(built, in_tmp):
    with ozols.catalog.open(built) as its:
        row = its.query("SELECT * FROM layouts ORDER BY structure LIMIT 1")[0]
        mechanism = its.mechanism(row["structure"])
        state = mechanism.analyze().states[0]
        assert (state.mobility, state.redundant) == (row["mobility"], row["redundant"])
        assert mechanism.search(max_mobility=1, top=1).admissible == row["determinate_w1"]
        assert {row["input"] for row in its.query("front")} == {"slide"}
        with pytest.raises(ozols.Error, match="no layout of a structure 6-x"):
            its.mechanism("6-x")


def test_what_is_wrong_is_said(built, in_tmp):
    (in_tmp / "text.db").write_text("no database at all, but a text of some length that is none")
    for path in ("gone.db", "text.db"):
        with pytest.raises(ozols.Error, match=f"{path} is not a catalogue"):
            ozols.catalog.open(path)
    with ozols.catalog.open(built) as its, pytest.raises(ozols.Error, match="no such table"):
        its.query("SELECT * FROM nowhere")
    for spec, why in [
        ({"links": "5"}, "is not a range of even numbers"),
        ({"inputs": ["push"]}, "expected `slide` or `turn`"),
        ({"link": "4"}, "unknown field `link`"),
    ]:
        with pytest.raises(ozols.Error, match=why):
            ozols.catalog.build(spec, out="wrong.db")
    with pytest.raises(ozols.Error, match="holds another catalogue"):
        ozols.catalog.build({**SPEC, "ideas": 4}, out=built)
    assert printed("catalog", "query", built)
