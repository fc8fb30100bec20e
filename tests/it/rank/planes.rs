//! Planar mode and space agree: a joint in a plane keeps what its freedoms span there, however its frame lies.

use crate::common::*;
use ozols::closure::contour::contour_basis;

type Three = [i64; 3];

fn dot(a: Three, b: Three) -> i64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn cross(a: Three, b: Three) -> Three {
    let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// Joint types with what turns and slides they have about and along x, y and z.
const TYPES: [(&str, [bool; 3], [bool; 3]); 11] = [
    ("revolute", [false, false, true], [false; 3]),
    ("prismatic", [false; 3], [false, false, true]),
    ("cylindrical", [false, false, true], [false, false, true]),
    ("universal", [true, false, true], [false; 3]),
    ("slotted", [false, false, true], [true, false, false]),
    ("spherical", [true; 3], [false; 3]),
    ("planar", [false, false, true], [true, true, false]),
    (
        "cylindrical-universal",
        [true, false, true],
        [false, false, true],
    ),
    ("sphere-in-cylinder", [true; 3], [false, false, true]),
    (
        "cylinder-on-plane",
        [true, false, true],
        [true, true, false],
    ),
    ("sphere-on-plane", [true; 3], [true, true, false]),
];

/// A joint of a ring with its options, by index in [`TYPES`].
#[derive(Debug, Clone)]
struct Placed {
    types: Vec<usize>,
    point: Three,
    axis: Three,
    reference: Three,
}

/// A ring of links, closed once more by the last joint where there are enough.
#[derive(Debug, Clone)]
struct Ring {
    normal: Three,
    joints: Vec<Placed>,
    twice: bool,
}

impl Ring {
    fn links(&self, i: usize) -> [usize; 2] {
        let ring = self.joints.len() - usize::from(self.twice);
        if i < ring {
            [i, (i + 1) % ring]
        } else {
            [0, 2]
        }
    }

    /// The file, by what [`write_mechanism`] has of each joint behind its links.
    fn text(&self, mode: &str, joints: &[String]) -> String {
        let ring = self.joints.len() - usize::from(self.twice);
        let links = (0..ring).map(|i| format!("{i}{}", if i == 1 { "*" } else { "" }));
        let line = |(i, joint): (usize, &String)| {
            let [a, b] = self.links(i);
            format!("j{i} | {a} {b} | {joint}")
        };
        let joints = joints.iter().enumerate().map(line).join("\n");
        write_mechanism(
            &format!("name = \"ring\"\n{mode}"),
            &links.collect_vec().join(" "),
            &joints,
        )
    }

    /// In planar mode, the frames as they are.
    fn planar(&self) -> String {
        let joints: Vec<String> = self
            .joints
            .iter()
            .map(|j| {
                let names: Vec<&str> = j.types.iter().map(|&t| TYPES[t].0).collect();
                let [point, axis] = [j.point, j.axis].map(commas);
                let more = format!(
                    "reference = {:?}\\noptions = {:?}",
                    j.reference,
                    &names[1..]
                );
                format!("{} | {point} | {axis} | {more}", names[0])
            })
            .collect();
        let mode = format!("mode = \"planar\"\nplane_normal = {:?}", self.normal);
        self.text(&mode, &joints)
    }

    /// In space, each joint replaced by the pair that it is in the plane, with one of its types each.
    fn spatial(&self, choice: &[usize]) -> String {
        let pairs: Vec<String> = self
            .joints
            .iter()
            .zip(choice)
            .map(|(j, &t)| self.in_plane(j, t))
            .collect();
        self.text("", &pairs)
    }

    /// Every choice of a type at each joint.
    fn choices(&self) -> Vec<Vec<usize>> {
        self.joints
            .iter()
            .map(|j| j.types.iter().copied())
            .multi_cartesian_product()
            .collect()
    }

    /// What a type keeps in the plane, as type, freedoms, axis and reference: by cases, from which vectors are square.
    fn in_plane(&self, j: &Placed, t: usize) -> String {
        let (n, z, r) = (self.normal, j.axis, j.reference);
        let x = [0, 1, 2].map(|i| r[i] * dot(z, z) - z[i] * dot(z, r));
        let axes = [x, cross(z, x), z];
        let (_, turns, slides) = TYPES[t];
        let has = |set: [bool; 3]| (0..3).filter(|&i| set[i]).collect_vec();
        let lacks = |set: [bool; 3]| axes[(0..3).find(|&i| !set[i]).unwrap()];
        let turn = match has(turns)[..] {
            [] => false,
            [i] => cross(axes[i], n) == [0; 3],
            [_, _] => dot(lacks(turns), n) == 0,
            _ => true,
        };
        let along: Vec<Three> = match has(slides)[..] {
            [] => Vec::new(),
            [i] => Some(axes[i])
                .filter(|&a| dot(a, n) == 0)
                .into_iter()
                .collect(),
            _ => match cross(lacks(slides), n) {
                [0, 0, 0] => has(slides).into_iter().map(|i| axes[i]).collect(),
                a => vec![a],
            },
        };
        let mut freedoms = vec!["rz"; usize::from(turn)];
        freedoms.extend(["tx", "ty"].iter().take(along.len()));
        let any = if n[0] == 0 && n[1] == 0 {
            [1, 0, 0]
        } else {
            [0, 0, 1]
        };
        let reference = along.first().copied().unwrap_or(any);
        let (kind, more) = match freedoms.len() {
            0 => ("fixed", String::new()),
            _ => ("custom", format!("\\nfreedoms = {freedoms:?}")),
        };
        let [point, axis] = [j.point, n].map(commas);
        format!("{kind} | {point} | {axis} | reference = {reference:?}{more}")
    }
}

fn vector() -> impl Strategy<Value = Three> {
    prop::array::uniform3(-3i64..4).prop_filter("a direction", |v| *v != [0; 3])
}

fn placed(normal: Three) -> impl Strategy<Value = Placed> {
    let axis = (vector(), 0..3).prop_map(move |(v, how)| match (how, cross(normal, v)) {
        (0, _) | (1, [0, 0, 0]) => normal,
        (1, across) => across,
        _ => v,
    });
    let types = (
        0..TYPES.len(),
        prop::collection::vec(any::<bool>(), TYPES.len()),
    );
    let point = prop::array::uniform3(-9i64..10);
    (types, point, axis, vector())
        .prop_filter("a reference", |(.., z, r)| cross(*z, *r) != [0; 3])
        .prop_map(|((present, offered), point, axis, reference)| {
            let all = |t: usize| [TYPES[t].1, TYPES[t].2].concat();
            // What is offered allows what there is.
            let wider = |&t: &usize| {
                let pairs = all(t).into_iter().zip(all(present));
                t != present && offered[t] && pairs.into_iter().all(|(a, b)| a || !b)
            };
            let mut types = vec![present];
            types.extend((0..TYPES.len()).filter(wider).take(2));
            Placed {
                types,
                point,
                axis,
                reference,
            }
        })
}

fn ring() -> impl Strategy<Value = Ring> {
    (vector(), 3usize..6, any::<bool>()).prop_flat_map(|(normal, links, twice)| {
        let twice = twice && links > 3;
        let joints = prop::collection::vec(placed(normal), links + usize::from(twice));
        joints.prop_map(move |joints| Ring {
            normal,
            joints,
            twice,
        })
    })
}

/// How many variants there are by mobility, of all with few enough redundant constraints and of the admissible ones.
fn counts(m: &Mechanism, max_redundant: u32) -> [BTreeMap<i64, num_bigint::BigUint>; 2] {
    let conditions = default_with(|c: &mut Conditions| c.max_redundant = max_redundant);
    let (search, found) = searched(m, conditions);
    [(&found.determinate, false), (&found.admissible, true)]
        .map(|(diagram, filter)| search.count_variants(diagram, filter).by_mobility)
}

proptest! {
    #![proptest_config(crate::fuzz::runs(48))]
    #[test]
    fn a_plane_keeps_what_the_freedoms_of_joints_span_in_it(ring in ring(), allowed in 0u32..3) {
        let choices = ring.choices();
        prop_assume!(choices.len() <= 16);
        let plane = read(&ring.planar());
        let contours = contour_basis(&plane, StateId::FREE).len();
        let of = |m: &Mechanism| analysed(m);
        let in_space = |choice: &Vec<usize>| of(&read(&ring.spatial(choice)));
        let (a, b) = (of(&plane), in_space(&choices[0]));
        prop_assert_eq!(a.mobility, b.mobility);
        prop_assert_eq!(a.redundant + 3 * contours, b.redundant);
        prop_assert_eq!(a.working_mobility, b.working_mobility);
        // What is followed need not be decided both times.
        prop_assert!(a.finite.mobility <= b.finite.at_most() && b.finite.mobility <= a.finite.at_most());
        let mut wanted = [BTreeMap::new(), BTreeMap::new()];
        for found in choices.iter().map(in_space) {
            if found.redundant - 3 * contours > allowed as usize {
                continue;
            }
            let mobility = i64::try_from(found.mobility).unwrap();
            let admissible = found.working_mobility == b.working_mobility;
            for counts in &mut wanted[..1 + usize::from(admissible)] {
                *counts.entry(mobility).or_insert_with(num_bigint::BigUint::default) += 1u8;
            }
        }
        prop_assert_eq!(counts(&plane, allowed), wanted);
    }
}
