//! Twists of options, by the same mechanism in other units, and by the joint built.

use super::*;
use crate::file::text::mechanism_from_str;
use crate::geom::expr::Expr;
use crate::geom::vector::{length, sub};
use crate::model::joint_type::JointType;
use crate::model::ranking::{ClearanceSum, Term};
use crate::rank::exact::field::exact_field;
use crate::score::evaluation::elimination::Scratch;
use crate::score::evaluation::evaluate::Evaluator;
use crate::search::answer::k_best::Assignment;
use crate::search::diagram::Control;
use crate::search::question::conditions::Conditions;

/// Creates a hinge and a joint behind it, in a unit of which `metre` make a metre.
fn two_joints(second: &str, unit: &str, metre: i64) -> Mechanism {
    let text = format!(
        "name = \"it\"\nlength_unit = \"{unit}\"\n\
         [[link]]\nid = \"0\"\nrole = \"frame\"\n[[link]]\nid = \"1\"\n[[link]]\nid = \"2\"\n\
         [[joint]]\nid = \"a\"\nlinks = [\"0\", \"1\"]\ntype = \"revolute\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n\
         [[joint]]\nid = \"b\"\nlinks = [\"1\", \"2\"]\ntype = \"{second}\"\npoint = [{}, {metre}, 0]\naxis = [1, 2, 2]\n",
        3 * metre
    );
    mechanism_from_str("it.toml", &text).unwrap()
}

/// Returns the place of the second joint.
fn behind(geometry: &Geometry) -> PlacedJoint {
    let joint = JointId::new(1);
    PlacedJoint {
        joint,
        variable: 0,
        slot: 0,
        contours: Vec::new(),
        point: geometry.points[joint],
        held: None,
        along_tree: Vec::new(),
        couplings: Vec::new(),
    }
}

/// Checks that a screw advances equally far per radian in any unit of its file.
#[test]
fn the_pitch_of_a_screw_is_a_length() {
    let twist = |unit: &str, metre: i64| {
        let m = two_joints("revolute", unit, metre);
        let pose = Pose::of_file(&m, StateId::FREE).unwrap();
        let geometry = Geometry::new(&m, StateId::FREE, &pose).unwrap();
        let place = behind(&geometry);
        let mut option = m.joints[1].options[0].clone();
        option.joint_type = JointType::Helical;
        option.frame.pitch = Expr::from(2 * metre);
        let found = option_twists(&m, &geometry, &pose, &place, &option).unwrap();
        assert_eq!(found.len(), 1);
        let t = found[0].1;
        // Along the axis, for a turn of one radian: two metres, in the size.
        let along: f64 = (0..3).map(|i| t[i] * t[3 + i]).sum();
        assert!(
            (along * geometry.size - 2.0).abs() < 1e-12,
            "{unit} {along}"
        );
        t
    };
    let (long, short) = (twist("m", 1), twist("mm", 1000));
    for (a, b) in long.iter().zip(short) {
        assert!((a - b).abs() < 1e-12, "{long:?} {short:?}");
    }
}

/// Checks a joint that slides in a guide and turns about two pins behind it. The guide is in its first link at any angles of
/// the pins.
#[test]
fn a_guide_stays_with_the_first_link() {
    let m = two_joints("universal", "m", 1);
    let home = Pose::of_file(&m, StateId::FREE).unwrap();
    let turned = |c: usize| 0.3 + 0.4 * f64::from(u8::try_from(c).unwrap());
    let pose = home.moved_to(&(0..home.columns.len()).map(turned).collect::<Vec<_>>());
    let geometry = Geometry::new(&m, StateId::FREE, &pose).unwrap();
    let mut option = m.joints[1].options[0].clone();
    option.joint_type = JointType::CylindricalUniversal;
    let twists = option_twists(&m, &geometry, &pose, &behind(&geometry), &option).unwrap();
    let slide = twists.iter().find(|(f, _)| *f == Freedom::Tz).unwrap().1;
    let axis = [1.0, 2.0, 2.0].map(|x: f64| x / 3.0);
    let [first, second] = [1, 2].map(|l| pose.links[l].map_direction(axis));
    assert!(length(sub(first, second)) > 0.1, "the pins have turned");
    assert_eq!(slide[..3], [0.0; 3]);
    assert!(length(sub([slide[3], slide[4], slide[5]], first)) < 1e-12);
}

/// Creates a coupler on three equal cranks, one more than needed, and a force across the third. The pin of a crank in a slot
/// removes the redundant constraint, and bears a force across the slot.
fn three_cranks(turned: bool, stroke: &str) -> Mechanism {
    let mut text =
        "name = \"it\"\nmode = \"planar\"\nlength_unit = \"m\"\nsearch.options = [\"revolute\", \"slotted\"]\n"
            .to_owned();
    for (id, role) in [
        (0, "role = \"frame\""),
        (1, ""),
        (2, ""),
        (3, ""),
        (4, "role = \"output\""),
    ] {
        text += &format!("[[link]]\nid = \"{id}\"\n{role}\n");
    }
    for (id, links, x, y) in [
        ("a", [0, 1], 0, 0),
        ("b", [0, 2], 3, 0),
        ("c", [0, 3], 7, 0),
        ("d", [1, 4], 0, 2),
        ("e", [2, 4], 3, 2),
        ("f", [3, 4], 7, 2),
    ] {
        let [from, to] = if turned { [links[1], links[0]] } else { links };
        text += &format!(
            "[[joint]]\nid = \"{id}\"\nlinks = [\"{from}\", \"{to}\"]\ntype = \"revolute\"\ndrive = {}\n\
             point = [{x}, {y}, 0]\naxis = [0, 0, 1]\nreference = [1, 2, 0]\n",
            id == "a"
        );
    }
    text += "[[workload.force]]\nlink = \"4\"\npoint = [5, 3, 0]\nforce = [20, -70, 0]\n\
             [[workload.force]]\nlink = \"3\"\npoint = [8, 1, 0]\nforce = [40, 10, 0]\n";
    mechanism_from_str("it.toml", &(text + stroke)).unwrap()
}

/// Checks that scores by tables are those of the variants as built and solved, in either order of a joint's links.
fn as_built(stroke: &str) {
    for turned in [false, true] {
        let m = three_cranks(turned, stroke);
        let search = Search::new(exact_field(&m, 0).unwrap(), m, Conditions::default()).unwrap();
        let diagrams = search.build_diagrams(Control::NONE);
        let evaluator = Evaluator::new(&search, ClearanceSum::Worst).unwrap();
        let mut compared = 0;
        // With a slot at both ends a crank slides as it likes, and is nowhere for certain.
        let of_one_slot = |v: &Assignment| v.key.changes() == 1;
        for v in search.cheapest_variants(&diagrams, 20).filter(of_one_slot) {
            let (fast, slow) = (
                evaluator.score_variant(&v, &mut Scratch::default()),
                evaluator.reference_scores(&v),
            );
            assert_eq!(fast.is_ok(), slow.is_ok(), "{:?}", v.choices);
            let (Ok(fast), Ok(slow)) = (fast, slow) else {
                continue;
            };
            compared += 1;
            for t in [Term::PeakForce, Term::Conditioning, Term::OutputError] {
                let (a, b) = (fast.term_value(t), slow.term_value(t));
                let near = (a - b).abs() < 1e-6 * b;
                assert!(near, "{turned} {:?} {}: {a} {b}", v.choices, t.name());
            }
        }
        assert_eq!(compared, 5);
    }
}

#[test]
fn variants_score_in_the_pose_of_the_file_as_they_do_built() {
    as_built("");
}

#[test]
fn a_slot_turns_with_the_link_that_has_it_when_built() {
    as_built("[workload.stroke]\nfrom = 0.0\nto = 0.9\nsteps = 1\n");
}
