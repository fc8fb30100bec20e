//! FreeCAD documents made for tests: as little of one as a reader needs, packed as FreeCAD packs it.

use crate::common::split_words;
use std::io::{Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// A place: x, y, z, and a turn about x, y or z by degrees.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place(pub(crate) [f64; 3], pub(crate) char, pub(crate) f64);

pub(crate) const HERE: Place = Place([0.0; 3], 'z', 0.0);

impl Place {
    fn quaternion(self) -> [f64; 4] {
        let (sine, cosine) = (self.2.to_radians() / 2.0).sin_cos();
        let mut q = [0.0, 0.0, 0.0, cosine];
        q["xyz".find(self.1).unwrap()] = sine;
        q
    }

    pub(crate) fn xml(self) -> String {
        let ([x, y, z], [a, b, c, d]) = (self.0, self.quaternion());
        // The angle and axis that FreeCAD repeats the turn by are left wrong: they are not what counts.
        format!(
            "<PropertyPlacement Px=\"{x:.16}\" Py=\"{y:.16}\" Pz=\"{z:.16}\" Q0=\"{a:.16}\" Q1=\"{b:.16}\" Q2=\"{c:.16}\" Q3=\"{d:.16}\" A=\"9\" Ox=\"1\" Oy=\"0\" Oz=\"0\"/>"
        )
    }
}

/// An object: name, type, and its properties as XML.
pub(crate) type Object = (String, &'static str, String);

pub(crate) fn property(name: &str, value: &str) -> String {
    format!("<Property name=\"{name}\">{value}</Property>")
}

pub(crate) fn label(text: &str) -> String {
    property("Label", &format!("<String value=\"{text}\"/>"))
}

pub(crate) fn group(names: &[&str]) -> String {
    let all: String = names
        .iter()
        .map(|n| format!("<Link value=\"{n}\"/>"))
        .collect();
    let count = names.len();
    property(
        "Group",
        &format!("<LinkList count=\"{count}\">{all}</LinkList>"),
    )
}

pub(crate) fn part(name: &str, place: Place) -> Object {
    let placed = property("Placement", &place.xml());
    (name.to_owned(), "Part::Feature", label(name) + &placed)
}

pub(crate) fn grounded(part: &str) -> Object {
    let to = property("ObjectToGround", &format!("<Link value=\"{part}\"/>"));
    ("GroundedJoint".to_owned(), "App::FeaturePython", to)
}

/// Joint types in the order of FreeCAD 1.0.
pub(crate) const TYPES: &str = "
    Fixed Revolute Cylindrical Slider Ball Distance Parallel Perpendicular Angle RackPinion
    Screw Gears Belt";

/// The property of a type, with the list that it is a place in.
pub(crate) fn joint_type(word: &str, list: &[&str]) -> String {
    let index = list.iter().position(|t| *t == word).unwrap();
    let count = list.len();
    let words: String = list
        .iter()
        .map(|w| format!("<Enum value=\"{w}\"/>"))
        .collect();
    property(
        "JointType",
        &format!(
            "<Integer value=\"{index}\" CustomEnum=\"true\"/><CustomEnumList count=\"{count}\">{words}</CustomEnumList>"
        ),
    )
}

/// `Reference1` or `Reference2`, from an object along a path.
pub(crate) fn reference(which: usize, root: &str, path: &str) -> String {
    let sub = format!("<Sub value=\"{path}\"/>");
    property(
        &format!("Reference{which}"),
        &format!("<XLink file=\"\" stamp=\"\" name=\"{root}\" count=\"2\">{sub}{sub}</XLink>"),
    )
}

/// A joint of FreeCAD 1.0 between two parts, with its place in each; `more` are properties besides.
pub(crate) fn joint(name: &str, word: &str, ends: [(&str, Place); 2], more: &str) -> Object {
    let ends = [0, 1].map(|i| {
        let (path, place) = ends[i];
        let placed = property(&format!("Placement{}", i + 1), &place.xml());
        // A part alone is held by one of its edges.
        let path = if path.contains('.') {
            path.to_owned()
        } else {
            format!("{path}.Edge1")
        };
        reference(i + 1, "Assembly", &path) + &placed
    });
    let kind = joint_type(word, &split_words(TYPES));
    (
        name.to_owned(),
        "App::FeaturePython",
        label(name) + &kind + &ends.concat() + more,
    )
}

pub(crate) fn number(name: &str, x: f64) -> String {
    property(name, &format!("<Float value=\"{x:.16}\"/>"))
}

/// An assembly of objects: parts and joints by what they have.
pub(crate) fn assembled(name: &str, objects: &[Object]) -> Vec<Object> {
    let is_joint =
        |o: &&Object| o.2.contains("\"JointType\"") || o.2.contains("\"ObjectToGround\"");
    let names = |joints: bool| {
        let some = objects.iter().filter(|o| is_joint(o) == joints);
        some.map(|o| o.0.as_str()).collect::<Vec<_>>()
    };
    let group_name = format!("{name}Joints");
    let mut all = vec![(
        group_name.clone(),
        "Assembly::JointGroup",
        group(&names(true)),
    )];
    all.extend(objects.iter().cloned());
    let members = [vec![group_name.as_str()], names(false)].concat();
    let properties = label(name) + &group(&members);
    all.push((name.to_owned(), "Assembly::AssemblyObject", properties));
    all
}

/// `Document.xml` with these objects.
pub(crate) fn document(objects: &[Object]) -> String {
    let listed = objects.iter().enumerate();
    let listed: String = listed
        .map(|(i, (name, kind, _))| {
            format!("<Object type=\"{kind}\" name=\"{name}\" id=\"{i}\" />\n")
        })
        .collect();
    let data = objects.iter();
    let data: String = data
        .map(|(name, _, properties)| {
            format!("<Object name=\"{name}\"><Properties>{properties}</Properties></Object>\n")
        })
        .collect();
    format!(
        "<?xml version='1.0' encoding='utf-8'?>\n<Document SchemaVersion=\"4\"><Objects>\n{listed}</Objects>\n<ObjectData>\n{data}</ObjectData></Document>\n"
    )
}

/// An archive of members, the first of them the document.
pub(crate) fn packed(members: &[(&str, &[u8])]) -> Vec<u8> {
    let mut out = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in members {
        let deflated = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
        out.start_file(*name, deflated).unwrap();
        out.write_all(bytes).unwrap();
    }
    out.set_comment("FreeCAD Document").unwrap();
    out.finish().unwrap().into_inner()
}

/// A document of FreeCAD: its objects, and a picture beside them.
pub(crate) fn fcstd(objects: &[Object]) -> Vec<u8> {
    let document = document(objects);
    let picture: Vec<u8> = (0..=255).collect();
    packed(&[
        ("Document.xml", document.as_bytes()),
        ("thumbnails/Thumbnail.png", &picture),
        ("GuiDocument.xml", b"<Document/>"),
    ])
}

/// A planar four-bar of four hinges along z, each part where it stands: W = 1, σ = 3. `words` are the types of the joints.
pub(crate) fn four_bar(words: [&str; 4]) -> Vec<Object> {
    let [a, b, _, d] = CORNERS;
    // Parts stand at a corner each and are turned about z, so that places within them are not those of the world.
    let within = |world: [f64; 3], place: Place| {
        let (sine, cosine) = (-place.2.to_radians()).sin_cos();
        let [x, y, z] = [0, 1, 2].map(|i| world[i] - place.0[i]);
        Place([x * cosine - y * sine, x * sine + y * cosine, z], 'z', 0.0)
    };
    let parts = [
        ("Base", HERE),
        ("Crank", Place(a, 'z', 30.0)),
        ("Rod", Place(b, 'z', -75.0)),
        ("Rocker", Place(d, 'z', 100.0)),
    ];
    let mut objects = parts.map(|(name, place)| part(name, place)).to_vec();
    objects.push(grounded("Base"));
    for (i, (name, at)) in ["A", "B", "C", "D"].into_iter().zip(CORNERS).enumerate() {
        let ends = [parts[i], parts[(i + 1) % 4]].map(|(part, place)| (part, within(at, place)));
        objects.push(joint(name, words[i], ends, ""));
    }
    assembled("Assembly", &objects)
}

/// Where its hinges are, in mm.
const CORNERS: [[f64; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [0.0, 30.0, 0.0],
    [70.0, 60.0, 0.0],
    [80.0, 0.0, 0.0],
];

pub(crate) const HINGES: [&str; 4] = ["Revolute"; 4];
