//! Small random mechanisms, with and without couplings.

use crate::common::*;
use crate::fuzz::readers::slow_search::{Q, axes, dot};

const TYPES: [&str; 6] = [
    "revolute",
    "prismatic",
    "cylindrical",
    "universal",
    "spherical",
    "slotted",
];
const AXES: [[i32; 3]; 6] = [
    [0, 0, 1],
    [0, 0, 1],
    [0, 0, 1],
    [1, 0, 0],
    [0, 1, 0],
    [1, 2, -1],
];

/// A random mechanism file with a few contours, sometimes with a clamped object.
pub(crate) fn random() -> impl Strategy<Value = String> {
    let joint = (
        0usize..6,
        prop::array::uniform3(-3i32..4),
        0usize..6,
        0usize..4,
    );
    (
        3usize..6,
        prop::collection::vec((any::<prop::sample::Index>(), joint.clone()), 6),
        prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), joint), 1..4),
        any::<bool>(),
        0u8..3,
    )
        .prop_map(|(links, tree, more, clamped, alone)| {
            let mark = |l| if l == links - 1 || l == 1 && links > 3 { "*" } else { "" };
            let mut names = (0..links).map(|l| format!("{l}{}", mark(l))).join(" ");
            let mut lines = String::new();
            let mut edges: Vec<_> = (1..links).map(|l| (tree[l - 1].0.index(l), l, tree[l - 1].1)).collect();
            edges.extend(
                more.iter().map(|(a, b, j)| (a.index(links), b.index(links), *j)).filter(|(a, b, _)| a != b),
            );
            for (i, (a, b, (kind, point, axis, changes))) in edges.iter().enumerate() {
                let options = match (TYPES[*kind], changes) {
                    ("revolute", 1) => "options = [\"revolute\", \"cylindrical\"]",
                    ("revolute", 2) => "options = [\"universal\", \"spherical\"]",
                    ("prismatic", 1) => "options = [\"cylindrical\"]",
                    ("universal", 1) => "options = [\"spherical\"]\\nunloading = [\"revolute\"]",
                    _ => "",
                };
                // Not of the tree, so that every link stays connected: a rest that is left as the part is clamped.
                let state = if clamped && alone == 0 && i + 1 == edges.len() && i + 1 >= links { "state = \"free\"" } else { "" };
                let (kind, point, axis) = (TYPES[*kind], commas(*point), commas(AXES[*axis]));
                lines += &format!("j{i} | {a} {b} | {kind} | {point} | {axis} | {options}\\n{state}\n");
            }
            if clamped {
                names += " part!";
                for (i, l) in [0, links - 1].iter().enumerate() {
                    let unloading = match (i, alone) {
                        (0, 2) => "unloading = [{ type = \"spherical\", point = [4, 2, 0] }]",
                        (0, _) => "",
                        _ => "unloading = [\"spherical\"]",
                    };
                    // Contacts with freedoms of their own, which are not the free state's.
                    let (kind, axis, options) = if links % 2 == 1 && i == 1 {
                        ("revolute", "1, 0, 0", "options = [\"spherical\"]\\n")
                    } else {
                        ("fixed", "", "")
                    };
                    lines += &format!("c{i} | {l} part | {kind} | 4, {i}, 1 | {axis} | {options}state = \"clamped\"\\n{unloading}\n");
                }
            }
            write_mechanism("name = \"random\"", &names, &lines)
        })
}

/// A random mechanism with up to three couplings, of contacts too; `None` where no two joints can be coupled.
pub(super) fn random_coupled() -> impl Strategy<Value = Option<String>> {
    let coupling = (
        any::<prop::sample::Index>(),
        any::<prop::sample::Index>(),
        prop::sample::select(vec!["-1", "2", "-3", "\"1/2\""]),
    );
    (random(), prop::collection::vec(coupling, 1..4)).prop_map(|(text, wanted)| {
        // Balls cannot be coupled; axes of several lengths that are all rational.
        let text = text
            .replace(
                "[\"universal\", \"spherical\"]",
                "[\"universal\", \"cylindrical\"]",
            )
            .replace(
                "\noptions = [\"spherical\"]\nunloading",
                "\noptions = [\"cylindrical-universal\"]\nunloading",
            )
            .replace("\noptions = [\"spherical\"]", "\noptions = [\"universal\"]")
            .replace("type = \"fixed\"", "type = \"revolute\"\naxis = [0, 2, 0]")
            .replace("axis = [1, 2, -1]", "axis = [1, 2, -2]")
            .replace("axis = [0, 1, 0]", "axis = [0, 3, 0]");
        let m = read(&text);
        let mut ends = Vec::new();
        for (j, joint) in m.joints_with_ids() {
            let ball = joint.joint_type == JointType::Spherical;
            for f in joint.joint_type.freedoms().iter().filter(|_| !ball) {
                let [z, x, _] = axes(&joint.frame);
                let rational = |v: &[Q]| {
                    let square = dot(v, v);
                    let root = Q::new(square.numer().sqrt(), square.denom().sqrt());
                    &root * &root == square
                };
                if matches!(f, Freedom::Rz | Freedom::Tz) && rational(&z) || rational(&x) {
                    ends.push((j, f.name()));
                }
            }
        }
        let (mut out, mut pairs) = (text, Vec::new());
        for (a, b, ratio) in wanted {
            if ends.is_empty() {
                break;
            }
            let (a, b) = (ends[a.index(ends.len())], ends[b.index(ends.len())]);
            if a.0 == b.0 || m.joints[a.0].states != m.joints[b.0].states || pairs.contains(&[a, b])
            {
                continue;
            }
            pairs.extend([[a, b], [b, a]]);
            let [x, y] = [a, b].map(|(j, f)| format!("{}:{f}", m.joints[j].id));
            out += &format!("[[coupling]]\njoints = [\"{x}\", \"{y}\"]\nratio = {ratio}\n");
        }
        (!pairs.is_empty()).then_some(out)
    })
}
