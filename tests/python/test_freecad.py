"""The panel's side of FreeCAD without FreeCAD: stored documents in place of open ones."""

import re
import shutil
import sys
import types
import zipfile
from pathlib import Path

import pytest

from conftest import ozols as command
from ozols import freecad

TYPES = ["Fixed", "Revolute", "Cylindrical", "Slider", "Ball", "Distance", "Parallel"]
CORNERS = {"A": (0, 0), "B": (0, 30), "C": (70, 60), "D": (80, 0)}
ENDS = {"A": ("Base", "Crank"), "B": ("Crank", "Rod"), "C": ("Rod", "Rocker"), "D": ("Rocker", "Base")}


def prop(name, value):
    return f'<Property name="{name}">{value}</Property>'


def placed(name, x=0.0, y=0.0):
    return prop(name, f'<PropertyPlacement Px="{x}" Py="{y}" Pz="0" Q0="0" Q1="0" Q2="0" Q3="1"/>')


def joint(name):
    words = "".join(f'<Enum value="{t}"/>' for t in TYPES)
    out = prop("Label", f'<String value="{name}"/>')
    out += prop("JointType", f'<Integer value="1" CustomEnum="true"/><CustomEnumList count="7">{words}</CustomEnumList>')
    for i, part in enumerate(ENDS[name], 1):
        sub = f'<Sub value="{part}.Edge1"/>'
        out += prop(f"Reference{i}", f'<XLink file="" stamp="" name="Assembly" count="2">{sub}{sub}</XLink>')
        out += placed(f"Placement{i}", *CORNERS[name])
    return out


def stored(path):
    """A four-bar of four hinges along z, as FreeCAD stores it: W = 1, σ = 3."""
    parts = ["Base", "Crank", "Rod", "Rocker"]
    joints = ["Ground", *ENDS]
    group = lambda names: prop("Group", "<LinkList>" + "".join(f'<Link value="{n}"/>' for n in names) + "</LinkList>")
    objects = {p: ("Part::Feature", placed("Placement")) for p in parts}
    objects |= {"Ground": ("App::FeaturePython", prop("ObjectToGround", '<Link value="Base"/>'))}
    objects |= {j: ("App::FeaturePython", joint(j)) for j in ENDS}
    objects |= {"Joints": ("Assembly::JointGroup", group(joints))}
    objects |= {"Assembly": ("Assembly::AssemblyObject", group(["Joints", *parts]))}
    listed = "".join(f'<Object type="{kind}" name="{name}"/>' for name, (kind, _) in objects.items())
    data = "".join(f'<Object name="{name}"><Properties>{p}</Properties></Object>' for name, (_, p) in objects.items())
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as out:
        out.writestr("Document.xml", f"<Document><Objects>{listed}</Objects><ObjectData>{data}</ObjectData></Document>")


class Document:
    """What is used of FreeCAD's document, over a stored one: a type that is set stands in the next copy."""

    def __init__(self, path):
        self.path, self.said = Path(path), []
        self.Objects = [types.SimpleNamespace(Name=n, Label=n, JointType="Revolute") for n in ENDS]
        self.Objects.append(types.SimpleNamespace(Name="Base", Label="Base"))

    def saveCopy(self, path):
        with zipfile.ZipFile(self.path) as old, zipfile.ZipFile(path, "w") as new:
            text = old.read("Document.xml").decode()
            for o in self.Objects[:-1]:
                begin = text.index("JointType", text.index(f'<Object name="{o.Name}"'))
                index = f'Integer value="{TYPES.index(o.JointType)}"'
                text = text[:begin] + re.sub(r'Integer value="\d+"', index, text[begin:], count=1)
            new.writestr("Document.xml", text)

    def openTransaction(self, name):
        self.said.append("open")

    def commitTransaction(self):
        self.said.append("commit")

    def recompute(self):
        self.said.append("recompute")


@pytest.fixture
def document(tmp_path):
    stored(tmp_path / "four-bar.FCStd")
    return Document(tmp_path / "four-bar.FCStd")


def test_what_is_held_twice_is_told(document):
    found = freecad.check(document)
    assert (found.freedoms, found.redundant, found.counted) == (1, 3, -2)
    assert [f.row for f in found.findings] == ["z", "turn about x", "turn about y"]
    assert all(len(f.duplicates) == 3 and f.degrees < 1e-9 for f in found.findings)
    assert sorted(c.after for c in found.changes) == ["Ball", "Cylindrical"]
    assert "True number of freedoms: 1" in found.text and "would be -2" in found.text


def test_taking_the_change_leaves_nothing_redundant(document):
    freecad.take(document, freecad.check(document).changes)
    assert document.said == ["open", "commit", "recompute"]
    found = freecad.check(document)
    assert (found.freedoms, found.redundant, found.findings, found.changes) == (1, 0, (), ())


def test_what_changed_meanwhile_is_not_taken(document):
    changes = freecad.check(document).changes
    for o in document.Objects[:-1]:
        o.JointType = "Fixed"
    with pytest.raises(freecad.Error, match="by now"):
        freecad.take(document, changes)
    with pytest.raises(freecad.Error, match="no joint Z"):
        freecad.take(document, [freecad.Change("Z", "Revolute", "Ball")])
    assert document.said == []
    with pytest.raises(freecad.Error, match="nothing can move"):
        # All is fixed, in a row without a loop.
        document.Objects[:] = document.Objects[:1] + document.Objects[-1:]
        cut(document)
        freecad.check(document)


def cut(document):
    """Leaves the first joint alone, fixed."""
    with zipfile.ZipFile(document.path) as old:
        text = old.read("Document.xml").decode()
    for name in "BCD":
        text = text.replace(f'<Link value="{name}"/>', "")
    with zipfile.ZipFile(document.path, "w") as new:
        new.writestr("Document.xml", text)


def test_a_document_without_an_assembly_is_said(tmp_path):
    path = tmp_path / "empty.FCStd"
    with zipfile.ZipFile(path, "w") as out:
        out.writestr("Document.xml", "<Document><Objects/></Document>")
    bare = types.SimpleNamespace(saveCopy=lambda to: shutil.copy(path, to), Objects=[])
    with pytest.raises(freecad.Error, match="no assembly in the document"):
        freecad.check(bare)


def test_the_program_that_is_named_is_asked(document, monkeypatch):
    from conftest import COMMAND

    monkeypatch.setenv("OZOLS", str(COMMAND))
    assert freecad.check(document).redundant == 3


def test_the_same_as_the_command(document, tmp_path):
    done = command("lint", document.path)
    assert done.returncode == 1 and "3 redundant constraints" in done.stdout
    fixed = tmp_path / "fixed.FCStd"
    assert command("fix", document.path, "-o", fixed).returncode == 0
    assert command("lint", fixed).returncode == 0


class Widget:
    """As much of Qt as the panel asks for: what is set is kept, signals call at once."""

    def __init__(self, *words):
        self.slots, self.shown, self.enabled = [], "", True
        self.clicked = types.SimpleNamespace(connect=self.slots.append)

    def setPlainText(self, text):
        self.shown = text

    def setEnabled(self, yes):
        self.enabled = yes

    def findChild(self, *words):
        return None

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda *words: None


def test_the_panel_shows_and_takes(document, monkeypatch):
    """The panel's own code, with stand-ins for FreeCAD and Qt."""
    app = types.SimpleNamespace(ActiveDocument=None)
    qt = {n: type(n, (Widget,), {}) for n in ("QDockWidget", "QWidget", "QVBoxLayout", "QPushButton", "QPlainTextEdit")}
    side = types.SimpleNamespace(Qt=types.SimpleNamespace(RightDockWidgetArea=2))
    pyside = types.ModuleType("PySide")
    pyside.QtCore, pyside.QtGui = side, types.SimpleNamespace(**qt)
    for name, module in (("FreeCAD", app), ("FreeCADGui", types.SimpleNamespace(getMainWindow=Widget)), ("PySide", pyside)):
        monkeypatch.setitem(sys.modules, name, module)
    monkeypatch.syspath_prepend(str(Path(__file__).parents[2] / "src/python/freecad"))
    monkeypatch.delitem(sys.modules, "ozols_panel", raising=False)
    import ozols_panel

    panel = ozols_panel.Panel()
    panel.look()
    assert panel.text.shown == "no document is open" and not panel.take.enabled
    app.ActiveDocument = document
    panel.look()
    assert "Redundant constraints: 3" in panel.text.shown and panel.take.enabled
    panel.change()
    assert "Redundant constraints: 0" in panel.text.shown and not panel.take.enabled
    ozols_panel.show()
