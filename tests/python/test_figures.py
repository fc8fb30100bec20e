"""What Python gets is what the command prints."""

import json
from pathlib import Path
from typing import get_args, get_origin, get_type_hints

import pytest
from conftest import ozols as command
from conftest import printed

import ozols

Mechanism = ozols.Mechanism
ROBOTS = Path(__file__).parents[1] / "data/robots"

DOZEN = [
    "gripper-10",
    "gripper-10-loaded",
    "bennett",
    "bricard-trihedral",
    "four-bar",
    "sarrus",
    "parallel-shears",
    "stewart-gough",
    "delta",
    "hooke-joint",
    "peaucellier",
    "slider-crank-spatial",
    "lever-gripper",
]


def test_the_dozen_is_built_in():
    assert set(DOZEN) <= set(Mechanism.builtins())


@pytest.mark.parametrize("name", DOZEN)
def test_an_analysis_is_the_commands(name):
    told = Mechanism.builtin(name).analyze()
    assert told.to_dict() == printed("analyze", name)
    assert command("analyze", name).stdout.startswith(str(told))


@pytest.mark.parametrize("method", ["auto", "count", "svd", "modular", "generic"])
def test_methods_are_the_commands(method):
    told = Mechanism.builtin("sarrus").analyze("free", method=method)
    assert told.to_dict() == printed("analyze", "sarrus", "--state", "free", "--method", method)


SEARCHES = [
    ("gripper-10", {}, []),
    ("bennett", {}, []),
    ("four-bar", {"top": 3}, ["--top", 3]),
    (
        "gripper-10",
        {"max_mobility": 1, "options": ["cylindrical", "universal", "spherical"], "top": 4},
        ["--max-mobility", 1, "--options", "cylindrical,universal,spherical", "--top", 4],
    ),
    (
        "gripper-10",
        {"options": "cylindrical,spherical", "unloading": {"spherical": "1-2,1-6"}, "rank": "cost,changes", "top": 2},
        ["--options", "cylindrical,spherical", "--unloading", "spherical=1-2,1-6", "--rank", "cost,changes", "--top", 2],
    ),
    (
        "gripper-10",
        {"forbid": {"2-3": ["spherical"]}, "max_external": 2, "state": "clamped", "top": 2},
        ["--forbid", "2-3=spherical", "--max-external", 2, "--state", "clamped", "--top", 2],
    ),
    (
        "gripper-10",
        {"forbid": ["2-3", "3-0"], "allow": {"1-2": ["spherical"]}, "check": "none"},
        ["--forbid", "2-3", "--forbid", "3-0", "--allow", "1-2=spherical", "--check", "none"],
    ),
    (
        "gripper-10-loaded",
        {"rank": {"peak-force": 1, "cost": 0.5}, "pool": 300, "top": 5},
        ["--rank", "peak-force=1,cost=0.5", "--pool", 300, "--top", 5],
    ),
    ("gripper-10", {"symmetry": "one-per-orbit", "top": 2}, ["--one-per-orbit", "--top", 2]),
    ("gripper-10", {"distinct": True, "top": 3}, ["--distinct", "--top", 3]),
    ("gripper-10", {"max_changes": 3}, ["--max-changes", 3]),
    ("gripper-10", {"nodes": 200, "top": 2}, ["--nodes", 200, "--top", 2]),
    ("sarrus", {"hold": ["1"], "allow_output_change": True}, ["--hold", "1", "--allow-output-change"]),
]


@pytest.mark.parametrize(("name", "asked", "flags"), SEARCHES)
def test_a_search_is_the_commands(name, asked, flags):
    found = Mechanism.builtin(name).search(**asked)
    there = printed("search", name, *flags)
    del there["seconds"]
    assert found.to_dict() == there
    # Counts are integers, of any size.
    assert found.determinate == int(there["determinate"])
    assert found.admissible == int(there["admissible"])
    assert found.determinate_by_mobility == {int(w): int(n) for w, n in there["by_mobility"].items()}
    assert found.exact == there["exact"]
    # The variants one by one are those of the whole.
    assert [v.to_dict() for v in found] == there["variants"]
    assert found.to_csv() == command("search", name, *flags, "--format", "csv").stdout
    assert len(found.to_pandas()) == len(found)


def test_the_main_job_has_its_published_figures():
    found = Mechanism.builtin("gripper-10").search()
    assert found.space == 13_841_287_201
    assert found.determinate == 6_340_592_477
    assert found.determinate_by_mobility[1] == 7_150_020
    assert sum(found.determinate_by_mobility.values()) == found.determinate


def test_all_variants_come_in_order_and_a_sample_is_the_commands():
    found = Mechanism.builtin("gripper-10").search(options=["spherical"], max_mobility=2)
    every = list(found.all())
    assert len(every) == found.admissible == 40
    costs = [v.cost for v in every]
    assert costs == sorted(costs)
    assert len({json.dumps(v.to_dict()["changes"]) for v in every}) == len(every)
    flags = ["--options", "spherical", "--max-mobility", 2, "--sample", 5, "--seed", 9]
    there = printed("search", "gripper-10", *flags)["variants"]
    assert [v.to_dict() for v in found.sample(5, seed=9)] == there


def test_an_iteration_may_be_left_and_taken_up_by_another_thread():
    from concurrent.futures import ThreadPoolExecutor

    all_of_them = Mechanism.builtin("gripper-10").search(check="none").all()
    first = next(all_of_them)
    with ThreadPoolExecutor(1) as other:
        second = other.submit(next, all_of_them).result()
    assert (first.position, second.position) == (1, 2)
    del all_of_them


@pytest.mark.parametrize(
    ("name", "asked", "flags"),
    [
        ("parallel-shears", {}, []),
        ("parallel-shears", {"stroke": "0:30deg:2"}, ["--stroke", "0:30deg:2"]),
        ("parallel-shears", {"stroke": (0, 0.5, 2)}, ["--stroke", "0:0.5:2"]),
        ("gripper-10-loaded", {}, []),
        ("gripper-10-loaded", {"spatial": True}, ["--spatial"]),
        ("lever-gripper", {"state": "clamped"}, ["--state", "clamped"]),
        ("slider-crank-spatial", {"spatial": True, "stroke": "0:90deg:3"}, ["--spatial", "--stroke", "0:90deg:3"]),
    ],
)
def test_statics_are_the_commands(name, asked, flags):
    told = Mechanism.builtin(name).statics(**asked)
    assert told.to_dict() == printed("statics", name, *flags)
    done = command("statics", name, *flags, "--format", "csv")
    assert told.csv == done.stdout
    assert len(told.to_pandas()) == len(told.records) > 0
    assert command("statics", name, *flags).stdout.startswith(str(told))


def test_workloads_are_the_commands():
    hand = Mechanism.builtin("lever-gripper")
    module = Mechanism.builtin("torsion-module")
    flags = ["--acceleration", "5,0,-2", "--any-acceleration", 3]
    for told, line in (
        (hand.grip(), ("grip", "lever-gripper")),
        (hand.grip(accelerations=[(5, 0, -2)], any_acceleration=3), ("grip", "lever-gripper", *flags)),
        (module.drive(), ("drive", "torsion-module")),
    ):
        assert told.to_dict() == printed(*line)
        assert command(*line).stdout.startswith(str(told))
    with pytest.raises(ozols.Error, match="1e6"):
        hand.grip(any_acceleration=2e6)


def test_files_are_linted_and_fixed_as_by_the_command(in_tmp):
    Path("loop.urdf").write_text(Mechanism.builtin("four-bar").export("urdf"))
    told = ozols.lint("loop.urdf", ROBOTS / "leg.urdf")
    assert told.to_dict() == printed("lint", "loop.urdf", ROBOTS / "leg.urdf")
    assert command("lint", "loop.urdf", ROBOTS / "leg.urdf").stdout == str(told)
    assert told.files[0].redundant == 3 and list(told.to_pandas()["redundant"]) == [3, 0]
    assert "3 releases" in ozols.fix("loop.urdf", "fixed.urdf")
    assert command("fix", "loop.urdf", "-o", "by_command.urdf").returncode == 0
    assert Path("fixed.urdf").read_bytes() == Path("by_command.urdf").read_bytes()
    assert ozols.lint("fixed.urdf").files[0].redundant == 0
    with pytest.raises(ozols.Error, match="at nowhere: no such joint"):
        ozols.fix("loop.urdf", "other.urdf", at=["nowhere"])
    with pytest.raises(ozols.Error, match="nowhere.urdf"):
        ozols.lint("nowhere.urdf")
    assert not Path("other.urdf").exists()


def test_declared_keys_are_there_with_their_types():
    """The annotations of each class of results, against what the library returns."""
    gripper = Mechanism.builtin("gripper-10")
    loaded = Mechanism.builtin("parallel-shears").statics()
    seen = []

    def check(view):
        seen.append(type(view))
        for key, hint in get_type_hints(type(view)).items():
            if key.startswith("_"):
                continue
            value = view[key]
            wanted = (get_origin(hint) or hint, *get_args(hint))
            assert isinstance(value, (int, float) if wanted[0] is float else wanted[0]), (type(view), key, value)
            parts = value if wanted[0] is list else [value]
            for part in parts:
                assert isinstance(part, wanted[-1]) or wanted[-1] is float
                if isinstance(part, ozols.View):
                    check(part)

    for view in (
        gripper.analyze(),
        gripper.search(top=2)[0],
        Mechanism.builtin("four-bar").stroke("0:90deg:3"),
        loaded,
        Mechanism.builtin("lever-gripper").grip(),
        Mechanism.builtin("torsion-module").drive(),
        ozols.lint(ROBOTS / "five_bar.urdf"),
    ):
        check(view)
    named = {c for c in vars(ozols).values() if isinstance(c, type) and issubclass(c, ozols.View)}
    assert named - set(seen) - {ozols.View} == {ozols.Answer}


@pytest.mark.parametrize(("name", "range"), [("four-bar", "0:90deg:6"), ("slider-crank-spatial", "0:1:4")])
def test_a_stroke_is_the_commands(name, range, in_tmp):
    told = Mechanism.builtin(name).stroke(range)
    assert told.to_dict() == printed("analyze", name, "--stroke", range)["stroke"]
    assert command("analyze", name, "--stroke", range, "--svg", "s.svg").returncode == 0
    assert told.svg == (in_tmp / "s.svg").read_text()
    assert list(told.to_pandas()["at"]) == [p.at for p in told.poses]


@pytest.mark.parametrize("name", ["gripper-10", "bennett", "hooke-joint"])
@pytest.mark.parametrize("kind", ["scheme", "kinematic"])
def test_a_drawing_is_the_commands(name, kind, in_tmp):
    drawing = Mechanism.builtin(name).draw(kind)
    assert drawing == command("draw", name, "--kind", kind).stdout
    drawing.save("d.svg")
    assert (in_tmp / "d.svg").read_text() == drawing


def test_a_variant_is_a_mechanism_and_is_drawn_with_its_changes():
    first, second = Mechanism.builtin("gripper-10").search(top=2)
    assert second.draw() == command("draw", "gripper-10", "--variant", 2).stdout
    redesign = first.mechanism()
    assert redesign.name == "gripper-10-variant-1"
    assert redesign.analyze("free").states[0].redundant == 0
    assert str(first).startswith("1. cost 11.5, W = 1, σ = 0: 1-2, 3-0, ")


@pytest.mark.parametrize("format", ["toml", "json", "urdf", "mjcf", "sdf", "dot"])
def test_exports_are_the_commands(format, in_tmp):
    assert command("export", "four-bar", "--to", format).stdout == Mechanism.builtin("four-bar").export(format)


def test_a_stroke_has_a_tolerance():
    """Singular values decide the rank at each pose."""
    poses = Mechanism.builtin("four-bar").stroke("0:9deg:2", tolerance=1e-6).poses
    assert [(p.mobility, p.redundant) for p in poses] == [(1, 3)] * 3
