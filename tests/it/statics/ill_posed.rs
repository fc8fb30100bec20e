//! Linkages that are no Assur groups are told by how much.

use crate::common::*;
use ozols::statics::assur::{AssurError, decompose_groups};
use ozols::statics::planar::PlanarMechanism;

/// Joints of a type between links in the plane of x and y, the first of them driven.
fn refused(joints: &[(&str, &str, &str, [i32; 2])]) -> AssurError {
    let mut text = "name = \"it\"\nlink = [{ id = \"0\", role = \"frame\" }, { id = \"a\" }, { id = \"b\", role = \"output\" }, { id = \"c\" }]\n".to_owned();
    if !joints.iter().any(|j| j.1 == "c" || j.2 == "c") {
        text = text.replace(", { id = \"c\" }", "");
    }
    for (i, (kind, from, to, [x, y])) in joints.iter().enumerate() {
        let drive = if i == 0 { "drive = true\n" } else { "" };
        text += &format!(
            "[[joint]]\nid = \"j{i}\"\nlinks = [\"{from}\", \"{to}\"]\ntype = \"{kind}\"\npoint = [{x}, {y}, 0]\naxis = [0, 0, 1]\n{drive}"
        );
    }
    let m = mechanism_from_str("it.toml", &text).unwrap();
    let planar = PlanarMechanism::new(&m, StateId::FREE).unwrap();
    let drives = planar.driven_pairs();
    decompose_groups(&planar, &drives).unwrap_err()
}

/// With its drive locked the crank is one body with the frame, and so is what is fixed to it: a hinge holds two rows again.
#[test]
fn a_hinge_within_a_body_is_two_constraints_too_many() {
    let said = refused(&[
        ("revolute", "0", "a", [0, 0]),
        ("fixed", "a", "b", [1, 0]),
        ("revolute", "a", "b", [2, 0]),
    ]);
    let AssurError::Overconstrained { bodies, excess } = said else {
        panic!("{said}");
    };
    assert_eq!((bodies.as_str(), excess), ("0, a, b", 2));
}

/// With the drive locked, two links on hinges of the crank keep a turn each.
#[test]
fn every_loose_link_of_a_chain_counts() {
    let said = refused(&[
        ("revolute", "0", "a", [0, 0]),
        ("revolute", "a", "b", [1, 0]),
        ("revolute", "a", "c", [2, 0]),
    ]);
    let AssurError::Underconstrained { freedoms, .. } = said else {
        panic!("{said}");
    };
    assert_eq!(freedoms, 2);
}

/// Four links in a closed contour have that one, dyads none.
#[test]
fn contours_of_a_group_are_counted() {
    use ozols::statics::assur_class::Kind;
    let m = super::read_planar(super::shears_text());
    let planar = PlanarMechanism::new(&m, StateId::FREE).unwrap();
    let groups = decompose_groups(&planar, &planar.driven_pairs())
        .unwrap()
        .groups;
    let mut closed = 0;
    for group in &groups {
        let is_closed = group.class.kind == Kind::FourLinkContour;
        closed += usize::from(is_closed);
        assert_eq!(group.class.contours, usize::from(is_closed));
    }
    assert!(closed > 0);
}
