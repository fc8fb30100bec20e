//! Force and form closure of clamped mechanisms, by hand and against a linear programme of its own.

mod programme;

use crate::common::*;
use ozols::grip::clamped_part::{ClampedPart, PartError};
use ozols::grip::force_closure::{ForceClosure, closure};
use std::fmt::Write;

/// A contact of a part with the frame: type, point, normal, and lines of `[[workload.contact]]`.
pub(crate) struct At {
    pub(crate) kind: &'static str,
    pub(crate) point: [f64; 3],
    pub(crate) normal: [f64; 3],
    pub(crate) face: String,
}

/// A part that touches nothing but faces of the frame.
pub(crate) fn vice(contacts: &[At]) -> String {
    let hinge = "hinge | 0 handle | revolute | 0, 0, 9 | 0, 0, 1 | drive = true";
    let mut out = file_of("name = \"vice\"", "0 handle* part!", hinge);
    for (i, c) in contacts.iter().enumerate() {
        let At {
            kind,
            point,
            normal,
            face,
        } = c;
        write!(
            out,
            "[[joint]]\nid = \"c{i}\"\nlinks = [\"0\", \"part\"]\ntype = \"{kind}\"\npoint = {point:?}\naxis = {normal:?}\n\
             state = \"clamped\"\n"
        )
        .unwrap();
        if !face.is_empty() {
            write!(out, "[[workload.contact]]\njoint = \"c{i}\"\n{face}\n").unwrap();
        }
    }
    out
}

pub(crate) fn part(text: &str) -> ClampedPart {
    let m = ozols::from_toml(text).unwrap();
    let state = m.state("clamped").unwrap();
    ClampedPart::new(&m, state).unwrap()
}

fn found(text: &str) -> [ForceClosure; 2] {
    let part = part(text);
    [&part.faces, &part.smooth()].map(|faces| closure(&part, faces).unwrap())
}

fn flat(y: f64, face: &str) -> At {
    At {
        kind: "fixed",
        point: [0.0, y, 0.0],
        normal: [0.0, 1.0, 0.0],
        face: face.to_owned(),
    }
}

/// The load along an axis of (moment; force), the less of its two ways.
fn along(c: &ForceClosure, axis: usize) -> f64 {
    let own = c.along.iter().filter(|(d, _)| d[axis].abs() == 1.0);
    own.map(|(_, load)| *load).fold(f64::INFINITY, f64::min)
}

/// By hand, two round faces of radius r a distance 2h apart, N/2 on each: friction bears μN along them, μrN about their normal
/// where the pressure is at the rim, and tipping takes rN of the pressure and μhN of friction at once.
#[test]
fn a_vice_of_two_round_faces_holds_what_it_does_by_hand() {
    let (mu, r, h) = (0.2, 0.05, 0.1);
    let face = format!("friction = {mu}\nradius = {r}");
    let [force, form] = found(&vice(&[flat(h, &face), flat(-h, &face)]));
    let tip = (r + mu * h) / h;
    for (axis, by_hand) in [tip, mu * r / h, tip, mu, 1.0, mu].into_iter().enumerate() {
        near(along(&force, axis), by_hand, 1e-5);
    }
    // Friction along the face and about its normal comes of one pressure.
    assert!(force.is_closed() && force.at_least <= force.at_most);
    assert!(force.at_most <= mu * r / h + 1e-6, "{force:?}");
    assert!(!form.is_closed());
    let open: Vec<usize> = (0..6).filter(|&a| along(&form, a) < 1e-6).collect();
    assert_eq!(open, [1, 3, 5]);
}

/// Faces without a stated size bear any moment that friction and pressure can: about the line through both no friction at that line
/// does, but their turn. Smooth, they turn freely.
#[test]
fn round_faces_without_end_hold_any_turn_about_their_normal() {
    let face = "friction = 0.2";
    let [force, form] = found(&vice(&[flat(0.1, face), flat(-0.1, face)]));
    assert!(force.is_closed(), "{force:?}");
    assert!(along(&force, 1) > 100.0, "{force:?}");
    near(along(&form, 1), 0.0, 1e-6);
}

/// What is no contact has no part in it: the margins are the same wherever another joint is.
#[test]
fn margins_do_not_depend_on_what_touches_nothing() {
    let face = "friction = 0.3\nradius = 0.05";
    let text = vice(&[flat(0.1, face), flat(-0.1, face)]);
    let margins = |hinge: &str| found(&text.replacen("[0, 0, 9]", hinge, 1))[0].clone();
    let (here, there) = (margins("[0, 0, 9]"), margins("[0.3, -0.4, 0.1]"));
    near(here.at_most, there.at_most, 1e-6);
    near(here.at_least, there.at_least, 1e-6);
    near(along(&here, 0), along(&there, 0), 1e-6);
}

/// By hand: on a ball pivot in its face a pad bears no moment, so one face alone bears that about the normal, with half the pressure.
#[test]
fn a_pad_on_a_ball_pivot_bears_no_moment() {
    let (mu, r, h) = (0.2, 0.05, 0.1);
    let face = format!("friction = {mu}\nradius = {r}");
    let both = vice(&[flat(h, &face), flat(-h, &face)]);
    let pivot = format!(
        "[[link]]\nid = \"pad\"\n[[joint]]\nid = \"pivot\"\nlinks = [\"0\", \"pad\"]\ntype = \"spherical\"\npoint = [0, {h}, 0]\n[[joint]]\nid = \"c0\"\nlinks = [\"pad\", \"part\"]"
    );
    let padded = both.replacen(
        "[[joint]]\nid = \"c0\"\nlinks = [\"0\", \"part\"]",
        &pivot,
        1,
    );
    assert_ne!(both, padded);
    assert_eq!(part(&padded).motions.len(), 9);
    let [force, _] = found(&padded);
    near(along(&force, 1), mu * r / h / 2.0, 1e-5);
    // Tipping: the fixed face takes r N/2 of pressure, and friction at both is a couple as before.
    near(along(&force, 0), (r / 2.0 + mu * h) / h, 1e-5);
    near(along(&force, 3), mu, 1e-5);
}

/// What no drive holds gives way: a jaw on a hinge bears nothing, and the margin is that of the other contacts.
#[test]
fn a_jaw_that_no_drive_holds_bears_nothing() {
    let face = "friction = 0.2\nradius = 0.05";
    let driven = vice(&[flat(0.1, face), flat(-0.1, face)])
        .replacen("point = [0, 0, 9]", "point = [1, 0.1, 0]", 1)
        .replacen("\"c0\"\nlinks = [\"0\"", "\"c0\"\nlinks = [\"handle\"", 1);
    assert!(found(&driven)[0].is_closed());
    let loose = driven.replace("drive = true", "");
    let [force, _] = found(&loose);
    assert!(!force.is_closed());
    near(along(&force, 4), 0.0, 1e-6);
}

/// Three points below, two behind, one aside: the six of a datum; the seventh pushes into the corner.
fn datum([x, y, z]: [f64; 3]) -> Vec<At> {
    let points = [
        ([1.0, 0.5, -1.0], [0.0, 0.0, 1.0]),
        ([-1.0, 0.5, -1.0], [0.0, 0.0, 1.0]),
        ([0.0, -1.0, -1.0], [0.0, 0.0, 1.0]),
        ([0.5, -1.0, 0.2], [0.0, 1.0, 0.0]),
        ([-0.5, -1.0, 0.2], [0.0, 1.0, 0.0]),
        ([-1.0, 0.1, 0.1], [1.0, 0.0, 0.0]),
        ([0.4, 0.3, 0.6], [-1.0, -1.0, -1.0]),
    ];
    let at = points.map(|([a, b, c], normal)| At {
        kind: "sphere-on-plane",
        point: [a + x, b + y, c + z],
        normal,
        face: String::new(),
    });
    at.into()
}

/// By hand: the three, two and one points of a datum with weights 0.25, 0.35, 0.4; 0.7, 0.3; 1 balance a push into the corner. A law
/// of Somov: six points never hold a body without friction.
#[test]
fn seven_points_can_close_a_body_and_six_cannot() {
    let points = datum([0.0; 3]);
    let six = found(&vice(&points[..6]));
    assert!(!six[1].is_closed() && !six[0].is_closed());
    let [force, form] = found(&vice(&points));
    assert!(form.is_closed(), "{form:?}");
    // Points without stated friction have none.
    near(force.at_most, form.at_most, 1e-9);
    assert!(form.at_least > 0.0 && form.at_least <= form.at_most);
}

/// Loads are about the part's middle: where a part and its contacts are in the file changes none of its margins, of which the least
/// is found off the axes.
#[test]
fn margins_do_not_depend_on_the_origin() {
    let at = |place| found(&vice(&datum(place)))[1].clone();
    let here = at([0.0; 3]);
    let axes = (0..6)
        .map(|axis| along(&here, axis))
        .fold(f64::INFINITY, f64::min);
    assert!(here.at_most < 0.9 * axes, "{here:?}");
    for there in [[8.0, -4.0, 0.0], [-2.0, 16.0, 32.0]] {
        let there = at(there);
        near(there.at_most, here.at_most, 1e-4);
        near(there.at_least, here.at_least, 1e-4);
    }
}

/// A law of Reuleaux: in a plane four contacts can, three never.
#[test]
fn three_contacts_in_a_plane_never_close() {
    let planar = |n: usize| {
        let text = vice(
            &(0..n)
                .map(|i| {
                    let angle = 0.3 + std::f64::consts::TAU * i as f64 / n as f64;
                    let (s, c) = angle.sin_cos();
                    // Off the middle by turns, so that both senses of rotation are stopped.
                    let off = if i % 2 == 0 { 0.4 } else { -0.4 };
                    At {
                        kind: "sphere-on-plane",
                        point: [c - off * s, s + off * c, 0.0],
                        normal: [-c, -s, 0.0],
                        face: String::new(),
                    }
                })
                .collect_vec(),
        );
        text.replacen("name = \"vice\"", "name = \"vice\"\nmode = \"planar\"", 1)
    };
    let three = found(&planar(3));
    assert!(!three[1].is_closed() && three[1].along.len() == 6);
    assert!(found(&planar(4))[1].is_closed());
}

/// The bound from above does not depend on the axes or the unit of the file; the places of contacts do not move with either.
#[test]
fn margins_do_not_depend_on_the_unit() {
    let face = |k: f64| format!("friction = 0.3\nradius = {}", 0.05 * k);
    let at = |k: f64| vice(&[flat(0.1 * k, &face(k)), flat(-0.1 * k, &face(k))]);
    let metres = found(&at(1.0));
    let in_mm = at(1000.0).replacen(
        "name = \"vice\"",
        "name = \"vice\"\nlength_unit = \"mm\"",
        1,
    );
    let mm = found(&in_mm);
    near(metres[0].at_most, mm[0].at_most, 1e-6);
    near(metres[0].at_least, mm[0].at_least, 1e-6);
}

fn run(text: &str, more: &[&str]) -> (Option<i32>, String, String) {
    run_on("grip", "vice.toml", text, &[&["--closure"], more].concat())
}

/// Round faces as wide as they are apart bear the friction μ of both in three directions, by hand, and more in the others: a margin of
/// μ/√3. Below what the programmes tell from nothing a sample is not decided, and counts as neither.
#[test]
fn closure_within_the_accuracy_of_the_programmes_is_undecided() {
    for (friction, closed) in [(0.0, Some(false)), (1.3e-6, None), (1e-4, Some(true))] {
        let face = format!("friction = {friction}\nradius = 0.1");
        let part = part(&vice(&[flat(0.1, &face), flat(-0.1, &face)]));
        let found = closure(&part, &part.faces).unwrap();
        assert_eq!(found.closed, closed, "{friction}");
    }
}

#[test]
fn the_command_tells_both_closures_of_any_clamped_mechanism() {
    let (code, said, errors) = run(
        &vice(&[flat(0.1, "friction = 0"), flat(-0.1, "friction = 0")]),
        &[],
    );
    assert_eq!(code, Some(1), "{errors}");
    has(
        &said,
        "force closure: no, nothing resists moment about y, moment about -y, force along x",
    );
    let v = json(&["grip", "gripper-10-loaded", "--closure", "--format", "json"]);
    assert_eq!(v["object"], "a");
    assert_eq!(v["force_closure"]["closed"], true);
    assert_eq!(v["form_closure"]["closed"], false);
    assert_eq!(v["contacts"][0]["shape"], "disc");
    // A grip states friction and length of its part for the contacts that it names.
    let v = json(&["grip", "lever-gripper", "--closure", "--format", "json"]);
    assert_eq!(v["contacts"].list().len(), 4);
    assert_eq!(v["contacts"][0]["friction"], 0.2);
    near(v["contacts"][0]["reach"].real(), 0.06, 1e-12);
    assert_eq!(v["force_closure"]["closed"], true);
    let open = v["form_closure"]["along"].list();
    let open = open.iter().filter(|l| l["resisted"].real() < 1e-6);
    // A round part slides along itself and turns about itself.
    for load in open {
        let (f, m) = (&load["force"][2], &load["moment"][2]);
        assert!(f.real() != 0.0 || m.real() != 0.0, "{load}");
    }
}

#[test]
fn what_has_no_part_between_contacts_is_refused() {
    let m = built_in("four-bar");
    let none = ClampedPart::new(&m, StateId::FREE);
    assert!(matches!(none, Err(PartError::NoPart { .. })));
    let text = vice(&[flat(0.1, ""), flat(-0.1, "")]).replacen("\"fixed\"", "\"revolute\"", 1);
    let m = ozols::from_toml(&text).unwrap();
    let joined = ClampedPart::new(&m, m.state("clamped").unwrap());
    assert!(
        matches!(joined, Err(PartError::Joined { .. })),
        "{joined:?}"
    );
}
