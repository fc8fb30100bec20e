//! Linkages that are no Assur groups are told by how much.

use crate::common::*;
use ozols::statics::assur::AssurError;

/// Joints of a type between links in the plane of x and y, the first of them driven.
fn refused(joints: &str) -> AssurError {
    let links = if joints.contains(" c ") {
        "0 a b* c"
    } else {
        "0 a b*"
    };
    let m = read(&write_mechanism("name = \"it\"", links, joints));
    let planar = PlanarMechanism::new(&m, StateId::FREE).unwrap();
    decompose_groups(&planar, &planar.driven_pairs()).unwrap_err()
}

/// With its drive locked the crank is one body with the frame, and so is what is fixed to it: a hinge holds two rows again.
#[test]
fn a_hinge_within_a_body_is_two_constraints_too_many() {
    let said = refused(
        "0 | 0 a | revolute | 0, 0, 0 | 0, 0, 1 | drive = true
         1 | a b | fixed | 1, 0, 0 | 0, 0, 1
         2 | a b | revolute | 2, 0, 0 | 0, 0, 1",
    );
    let AssurError::Overconstrained { bodies, excess } = said else {
        panic!("{said}");
    };
    assert_eq!((bodies.as_str(), excess), ("0, a, b", 2));
}

/// With the drive locked, two links on hinges of the crank keep a turn each.
#[test]
fn every_loose_link_of_a_chain_counts() {
    let said = refused(
        "0 | 0 a | revolute | 0, 0, 0 | 0, 0, 1 | drive = true
         1 | a b | revolute | 1, 0, 0 | 0, 0, 1
         2 | a c | revolute | 2, 0, 0 | 0, 0, 1",
    );
    assert!(
        matches!(said, AssurError::Underconstrained { freedoms: 2, .. }),
        "{said}"
    );
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
