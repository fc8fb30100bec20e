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
