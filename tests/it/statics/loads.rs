//! What loads a linkage in its plane: components by hand, power, and when the plane does not do.

use crate::common::*;
use ozols::statics::kinetostatics::LoadSource;
use ozols::statics::solve::{Model, SolvedReactions, solve_reactions};

/// A four-bar 0-1-2-3 drawn by x and y, stood in the plane of `along` and `up`.
fn four_bar(along: [f64; 3], up: [f64; 3]) -> Mechanism {
    let corners = [[0.0, 0.0], [0.0, 1.0], [3.0, 3.0], [4.0, 0.0]];
    four_bar_in_plane([along, up], [0.0; 3], corners, true)
}

fn exact(v: [f64; 3]) -> [Expr; 3] {
    v.map(|x| Expr::from_f64(x).unwrap())
}

fn link(m: &Mechanism, id: &str) -> LinkId {
    m.links_with_ids().find(|(_, l)| l.id == id).unwrap().0
}

/// In the plane of (0.8, 0, -0.6) and y, whose normal is (0.6, 0, 0.8): gravity (1, 2, -10) has 0.8 + 6 along the first and 2
/// along the second, and principal inertias of 0.1, 0.2 and 0.5 are 0.36 · 0.1 + 0.64 · 0.5 about the normal.
#[test]
fn loads_have_their_components_in_a_plane_that_leans() {
    let mut m = four_bar([0.8, 0.0, -0.6], [0.0, 1.0, 0.0]);
    let coupler = link(&m, "2");
    m.edit().links[coupler].mass = Some(MassProperties {
        mass: 2.0,
        centre: exact([1.2, 1.5, -0.9]),
        inertia: Some(Inertia::Principal([0.1, 0.2, 0.5])),
    });
    m.edit().loads.gravity = Some(exact([1.0, 2.0, -10.0]));
    m.edit().loads.drive_speeds = vec![2.0];
    let found = planar_statics(&m, StateId::FREE, None).unwrap();
    let moment = &found.moments[0];
    let weight = moment
        .loads
        .iter()
        .find(|l| l.source == LoadSource::Gravity);
    let g = weight.unwrap().force;
    assert_nine_digits(g[0].hypot(g[1]), 2.0 * 6.8f64.hypot(2.0));
    let body = &moment.links[0];
    let inertia = -body.moment / body.angular_acceleration;
    assert_nine_digits(inertia, 0.36 * 0.1 + 0.64 * 0.5);
    // The centre lies in the plane, 1.5 along and 1.5 up.
    assert_nine_digits(body.centre[0].hypot(body.centre[1]), 1.5f64.hypot(1.5));
}

/// What acts on the frame loads nothing that moves, and is not among the loads; an inertia force acts at its moment over it.
#[test]
fn the_frame_bears_its_own_and_inertia_acts_aside() {
    let mut m = four_bar([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    for (id, force) in [("0", 5.0), ("2", 7.0)] {
        let link = link(&m, id);
        m.edit().loads.forces.push(ExternalForce {
            link,
            point: exact([1.0, 1.0, 0.0]),
            force: exact([force, 0.0, 0.0]),
            range: None,
            states: None,
        });
    }
    let coupler = link(&m, "2");
    m.edit().links[coupler].mass = Some(MassProperties {
        mass: 2.0,
        centre: exact([1.5, 2.0, 0.0]),
        inertia: Some(Inertia::Plane(0.3)),
    });
    m.edit().loads.drive_speeds = vec![2.0];
    let found = planar_statics(&m, StateId::FREE, None).unwrap();
    let moment = &found.moments[0];
    let frame = found.linkage.mechanism.frame;
    assert!(moment.loads.iter().all(|l| l.body != frame));
    assert!(moment.loads.iter().any(|l| l.force[0].abs() == 7.0));
    let inertia = &moment.links;
    assert!(inertia[0].moment.abs() > 1e-3);
    let [x, y] = inertia[0].force;
    assert_nine_digits(inertia[0].inertia_offset() * x.hypot(y), inertia[0].moment);
}

/// Two drives together do the work that the loads and the inertia of the links ask.
#[test]
fn the_power_of_all_drives_balances_the_loads() {
    let joints = "
        0-1 | 0 1 | revolute | 0, 0, 0 | 0, 0, 1 | drive = true
        1-2 | 1 2 | revolute | 0, 1, 0 | 0, 0, 1
        2-3 | 2 3 | revolute | 2, 3, 0 | 0, 0, 1
        3-4 | 3 4 | revolute | 4, 2, 0 | 0, 0, 1
        4-0 | 4 0 | revolute | 5, 0, 0 | 0, 0, 1 | drive = true";
    let text = write_mechanism("name = \"five\"\nmode = \"planar\"", "0 1 2* 3 4", joints);
    let role = "role = \"output\"\n";
    let heavy = format!("{role}mass = 2\ncentre = [1, 2, 0]\ninertia = 0.2\n");
    let mut m = read(&replace_once(&text, role, &heavy));
    m.edit().loads.gravity = Some(exact([0.0, -10.0, 0.0]));
    m.edit().loads.drive_speeds = vec![1.0, -0.7];
    let found = planar_statics(&m, StateId::FREE, None).unwrap();
    let now = &found.moments[0];
    assert!(now.load_power.abs() > 0.1);
    assert_nine_digits(now.drive_power, -now.load_power);
    let efforts = now.reactions.iter().filter_map(|r| r.effort);
    assert!(efforts.clone().count() == 2 && efforts.clone().all(|e| e.abs() > 1e-3));
}

/// A weight beside the plane of a flat linkage tips it, which only its six components tell.
#[test]
fn a_weight_beside_the_plane_asks_for_space() {
    for (height, planar) in [(0.0, true), (0.5, false)] {
        let mut m = four_bar([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        let coupler = link(&m, "2");
        m.edit().links[coupler].mass = Some(MassProperties {
            mass: 2.0,
            centre: exact([1.5, 2.0, height]),
            inertia: None,
        });
        m.edit().loads.gravity = Some(exact([0.0, -10.0, 0.0]));
        let found = solve_reactions(&m, StateId::FREE, None, Model::Either).unwrap();
        let is_planar = matches!(found, SolvedReactions::Planar(_));
        assert_eq!(is_planar, planar, "{height}");
    }
}

/// Where nothing turns, two slides across each other say which plane it is: theirs.
#[test]
fn two_slides_span_their_plane() {
    let joints = "
        x | 0 1 | prismatic | 0, 0, 0 | 1, 0, 0 | drive = true
        z | 1 2 | prismatic | 0, 0, 0 | 0, 0, 1 | drive = true";
    let text = &write_mechanism("name = \"table\"", "0 1 2*", joints);
    let planar = PlanarMechanism::new(&read(text), StateId::FREE).unwrap();
    assert_eq!(planar.axes[2].map(f64::abs), [0.0, 1.0, 0.0]);
}
