"""Building mechanisms, errors, signals, notebooks, and the command in the wheel."""

import http.client
import json
import pickle
import signal
import subprocess
import sys
import threading
import time
import urllib.parse
from fractions import Fraction
from pathlib import Path

import pytest
from conftest import ozols as command

import ozols

Mechanism = ozols.Mechanism
ROBOTS = Path(__file__).parents[1] / "data/robots"


def four_bar(**keys):
    plan = ozols.Builder("mine", **keys).link("0", role="frame").link("3", role="output")
    plan.joint("A", "0", "1", point=(0, 0, 0), axis=(0, 0, 1), drive=True)
    plan.joint("B", "1", "2", point=(0, 1, 0), axis=(0, 0, 1))
    plan.joint("C", "2", "3", point=(3, Fraction(7, 3), 0), axis=(0, 0, 1))
    return plan.joint("D", "3", "0", point=(3, 0, 0), axis=(0, 0, 1))


def test_a_mechanism_is_built_joint_by_joint():
    built = four_bar().build()
    state = built.analyze().states[0]
    assert (state.links, state.joints, state.mobility, state.redundant) == (4, 4, 1, 3)
    assert Mechanism.from_dict(built.to_dict()) == built
    assert Mechanism.from_toml(built.export("toml")) == built
    assert built.to_dict()["joint"][2]["point"][1] == "7/3"


def test_numbers_of_numpy_are_numbers():
    import numpy

    plan = four_bar()
    plan.data["joint"][1]["point"] = numpy.array([0.0, 1.0, 0.0])
    plan.data["joint"][2]["point"] = (3, numpy.float64(2.5), 0)
    assert plan.build().analyze().states[0].redundant == 3


def test_a_mechanism_travels():
    gripper = Mechanism.builtin("gripper-10")
    there = pickle.loads(pickle.dumps(gripper))
    assert there == gripper and hash(there) == hash(gripper)
    assert there.search(top=1).determinate == 6_340_592_477


def test_files_and_robot_descriptions_are_read(in_tmp):
    mechanism = four_bar().build()
    Path("mine.json").write_text(mechanism.export("json"))
    assert Mechanism.from_file("mine.json") == mechanism
    robots = sorted(ROBOTS.rglob("*.urdf"))
    assert robots
    Path("four-bar.urdf").write_text(mechanism.export("urdf"))
    for read in (Mechanism.from_file, Mechanism.from_urdf):
        assert read("four-bar.urdf").analyze().states[0].redundant == 3


def test_doubts_about_a_description_are_warnings(in_tmp):
    Path("a.urdf").write_text(
        '<robot name="a"><link name="0"/><link name="1"/><link name="2"/>'
        '<joint name="j" type="revolute"><parent link="0"/><child link="1"/><axis xyz="0 0 1"/>'
        '<limit lower="0" upper="1" effort="1" velocity="1"/></joint>'
        '<joint name="k" type="revolute"><parent link="0"/><child link="2"/><axis xyz="0 0 1"/>'
        '<mimic joint="j" multiplier="2"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint></robot>'
    )
    done = command("analyze", "a.urdf")
    said = done.stderr.split("\n", 1)[1].strip() if done.stderr else ""
    if said:
        with pytest.warns(UserWarning) as heard:
            Mechanism.from_file("a.urdf")
        assert said.startswith(str(heard[0].message).strip())
    else:
        Mechanism.from_file("a.urdf")


WRONG = [
    (lambda: Mechanism.builtin("gripper-11"), None),
    (lambda: Mechanism.from_file("wrong.toml"), ["analyze", "wrong.toml"]),
    (lambda: Mechanism.from_file("gone.toml"), None),
    (lambda: Mechanism.builtin("four-bar").analyze("gone"), ["analyze", "four-bar", "--state", "gone"]),
    (
        lambda: Mechanism.builtin("gripper-10").search(forbid=["nope"]),
        ["search", "gripper-10", "--forbid", "nope"],
    ),
    (
        lambda: Mechanism.builtin("gripper-10").search(rank=["speed"]),
        ["search", "gripper-10", "--rank", "speed"],
    ),
    (lambda: Mechanism.builtin("four-bar").stroke("0:x:1"), ["analyze", "four-bar", "--stroke", "0:x:1"]),
    (
        lambda: Mechanism.builtin("four-bar").stroke("0:1:9", drive="z"),
        ["analyze", "four-bar", "--stroke", "0:1:9", "--drive", "z"],
    ),
    (lambda: Mechanism.builtin("four-bar").export("step"), None),
    (lambda: Mechanism.builtin("four-bar").draw("oil"), None),
    (lambda: Mechanism.builtin("four-bar").search(check="twice"), None),
    (lambda: Mechanism.builtin("four-bar").analyze(method="guess"), None),
]


def test_the_studio_gives_back_what_was_drawn(capfd):
    four_bar = ozols.Mechanism.builtin("four-bar")
    given = []
    beside = threading.Thread(target=lambda: given.append(four_bar.studio(show=False)))
    beside.start()
    said, until = "", time.monotonic() + 60
    while "\n" not in said:
        assert beside.is_alive() and time.monotonic() < until, "no address"
        said += capfd.readouterr().out
        time.sleep(0.05)
    address = urllib.parse.urlparse(said.strip())
    window = http.client.HTTPConnection(address.netloc)
    window.request("GET", f"{address.path}events")
    seen = window.getresponse()
    change = {"do": "set", "what": "joint", "id": "1-2", "key": "type", "value": "spherical"}
    own = {"Content-Type": "application/json", "Origin": f"http://{address.netloc}"}
    sent = http.client.HTTPConnection(address.netloc)
    sent.request("POST", f"{address.path}edit", json.dumps({"edits": [change], "revision": None}), own)
    assert sent.getresponse().status == 200
    seen.close()
    window.close()
    beside.join(60)
    assert given[0].analyze().states[0].redundant == 1


@pytest.mark.parametrize("at", range(len(WRONG)))
def test_errors_are_exceptions_with_the_commands_text(at, in_tmp):
    Path("wrong.toml").write_text('name = "w"\n[[joint]]\nid = "a"\nlinks = ["0", "1"]\ntype = "hinge"\npoint = [0, 0, 0]\n')
    wrong, words = WRONG[at]
    with pytest.raises(ozols.Error) as raised:
        wrong()
    assert isinstance(raised.value, ValueError) and str(raised.value)
    if words:
        done = command(*words)
        assert done.returncode == 2
        # Options of the command are keywords here.
        said = done.stderr.removeprefix("error: ").strip().replace("--forbid", "forbid").replace("--rank", "rank")
        assert said == str(raised.value).removeprefix("error: ")


def test_a_key_that_is_not_there_is_said():
    with pytest.raises(AttributeError, match="there is no speed; there are mechanism"):
        Mechanism.builtin("four-bar").analyze().speed  # noqa: B018
    with pytest.raises(TypeError):
        Mechanism.builtin("four-bar").search(speed=1)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"max_redundant": -1}, "max_redundant: invalid value: integer `-1`"),
        ({"nodes": "many"}, "nodes: invalid type: string"),
        ({"symmetry": "half"}, "symmetry: unknown variant `half`, expected one of `all`, `symmetric`, `one-per-orbit`"),
        ({"check": "twice"}, "check: unknown variant `twice`"),
        ({"method": "luck"}, "method: unknown variant `luck`"),
        ({"rank": {"cost": -1}}, "rank: cost=-1.0: give a weight from 0 to 1e12"),
        ({"rank": {"cost": float("nan")}}, "rank: cost=nan: give a weight"),
        ({"costs": "no/such.toml"}, "costs: cannot read no/such.toml"),
    ],
)
def test_a_keyword_that_is_none_is_named(asked, said):
    with pytest.raises(ozols.Error) as raised:
        Mechanism.builtin("four-bar").search(**asked)
    assert str(raised.value).startswith(said)


def test_every_keyword_asks_what_the_option_of_its_name_asks(in_tmp):
    costs = Path("dear.toml")
    costs.write_text("spherical = 9\n", encoding="utf-8")
    asked = {
        "options": "cylindrical,spherical",
        "max_mobility": 1,
        "max_changes": 7,
        "forbid": {"2-3": ["spherical"], "6-7": ["spherical"]},
        "hold": ["3", "7"],
        "costs": costs,
        "symmetry": "one-per-orbit",
        "top": 4,
        "nodes": 100_000,
        "rank": {"cost": 1, "changes": 0.1},
        "check": "prime",
        "poses": 1,
        "seed": 7,
    }
    words = ["--options", "cylindrical,spherical", "--max-mobility", "1", "--max-changes", "7", "--forbid", "2-3=spherical"]
    words += ["--forbid", "6-7=spherical", "--hold", "3", "--hold", "7", "--costs", str(costs), "--one-per-orbit", "--top", "4", "--nodes", "100000"]
    words += ["--rank", "cost=1,changes=0.1", "--check", "prime", "--poses", "1", "--seed", "7"]
    done = command("search", "gripper-10", *words, "--format", "csv")
    assert done.returncode == 0, done.stderr
    found = Mechanism.builtin("gripper-10").search(**asked)
    assert found.to_csv() == done.stdout and len(found) == 4


def test_progress_is_heard_and_what_it_raises_ends_the_search():
    heard = []
    found = Mechanism.builtin("gripper-10").search(progress=lambda *p: heard.append(p))
    assert found.exact and heard and all(done <= of and nodes > 0 for done, of, nodes in heard)

    def no(*_):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        Mechanism.builtin("gripper-10").search(progress=no)


# A search of minutes: fourteen links of its own, every joint with a dozen options.
LONG = """
import ozols, sys, time
m = ozols.Mechanism.builtin("gripper-10")
names = ["rz", "tz", "rx", "ry", "tx", "ty"]
import itertools
options = [{"freedoms": ["rz", *c], "name": "o" + "".join(c)} for k in (1, 2, 3) for c in itertools.combinations(names[1:], k)]
d = m.to_dict()
for i, j in enumerate(d["joint"]):
    # Axes in all directions, so that few nodes are alike.
    j["axis"], j["point"] = [i % 3 - 1, i * i % 7 - 3, 1 + i % 5], [i * i % 11, 3 * i % 13, i * i * i % 17]
    if not j.get("drive") and "state" not in j:
        j["options"] = options
d["search"] = {"options": options}
m = ozols.Mechanism.from_dict(d)
print("begun", flush=True)
begun = time.monotonic()
try:
    m.search(max_redundant=3, allow_output_change=True, nodes=100_000_000)
    print("ended", time.monotonic() - begun)
except KeyboardInterrupt:
    print("interrupted", flush=True)
    sys.exit(7)
"""


def test_ctrl_c_ends_a_search():
    child = subprocess.Popen([sys.executable, "-c", LONG], stdout=subprocess.PIPE, text=True)
    try:
        assert child.stdout.readline() == "begun\n"
        time.sleep(1.0)
        child.send_signal(signal.SIGINT)
        said, _ = child.communicate(timeout=60)
    finally:
        child.kill()
    assert (said, child.returncode) == ("interrupted\n", 7)


def test_other_threads_run_while_a_search_does():
    beats, done = [], threading.Event()

    def beat():
        while not done.is_set():
            beats.append(time.monotonic())
            time.sleep(0.001)

    def beats_amid_a_search():
        begun = time.monotonic()
        Mechanism.builtin("gripper-10").search(top=1)
        ended = time.monotonic()
        # What beats at either end may have had its turn before the search took the interpreter, or after.
        return any(begun + 0.002 < at < ended - 0.002 for at in beats)

    other = threading.Thread(target=beat)
    other.start()
    try:
        # A search takes some milliseconds, in which a busy machine may not give the other thread its turn.
        assert any(beats_amid_a_search() for _ in range(100))
    finally:
        done.set()
        other.join()


def test_a_notebook_shows_drawings_and_tables():
    gripper = Mechanism.builtin("gripper-10")
    found = gripper.search(top=2)
    for shown in (gripper, found[0], gripper.draw(), Mechanism.builtin("four-bar").stroke("0:9deg:2")):
        assert shown._repr_svg_().startswith("<svg")
    assert "<td>11.5</td>" in found._repr_html_() and "<p>21,817,629 admissible" in found._repr_html_()
    assert "<th>mobility</th>" in gripper.analyze()._repr_html_()
    assert Mechanism.builtin("parallel-shears").statics()._repr_html_().count("<tr>") > 3
    assert "at least" in repr(gripper.search(nodes=100, top=1))


def test_the_wheel_has_the_command():
    done = command("--version")
    assert done.stdout == f"ozols {ozols.__version__}\n"
    assert command("analyze", "nowhere").returncode == 2
    assert command("search", "gripper-10", "--max-changes", 1).returncode == 1
    piped = subprocess.run(
        [sys.executable, "-m", "ozols", "analyze", "-"],
        input=Mechanism.builtin("four-bar").export("toml"),
        capture_output=True,
        text=True,
        check=True,
    )
    assert "four-bar" in piped.stdout


def test_importing_is_quick_and_takes_nothing_with_it():
    code = "import sys, ozols; print([m for m in ('pandas', 'numpy', 'distributed', 'pyarrow') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
