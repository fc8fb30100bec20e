//! What is redundant in every closed pose is not said to be so at the drawn pose only, and what is so there only is not said to
//! last.
//!
//! The closed poses of these mechanisms are known by construction: beams and plates are shifted, platforms swing on equal legs,
//! four-bars have their elbow where two circles meet. The twin lays J out from points and directions, in the poses themselves,
//! and takes its rank by elimination. It shares no code with the program.

use crate::common::*;
use crate::fuzz::runs;
use ozols::redundancy::duplicate_constraints::held_twice;
use ozols::redundancy::other_poses::Where;

type V = [f64; 3];

#[derive(Debug, Clone, Copy)]
enum Joint {
    Ball(V),
    Slide(V, V),
    Turn(V, V),
    /// With its slide a radian.
    Screw(V, V, f64),
}

impl Joint {
    fn twists(self) -> Vec<[f64; 6]> {
        let one = |w: V, v: V| [w[0], w[1], w[2], v[0], v[1], v[2]];
        match self {
            Joint::Ball(p) => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
                .map(|e| one(e, cross(p, e)))
                .to_vec(),
            Joint::Slide(_, a) => vec![one([0.0; 3], a)],
            Joint::Turn(p, a) => vec![one(a, cross(p, a))],
            Joint::Screw(p, a, h) => vec![one(a, add_scaled(cross(p, a), h, a))],
        }
    }

    /// The joint in other coordinates; directions keep the length of the map.
    fn mapped(self, map: &dyn Fn(V) -> V) -> Joint {
        match self {
            Joint::Ball(p) => Joint::Ball(map(p)),
            Joint::Slide(p, a) => Joint::Slide(map(p), map(a)),
            Joint::Turn(p, a) => Joint::Turn(map(p), map(a)),
            Joint::Screw(p, a, h) => Joint::Screw(map(p), map(a), h),
        }
    }
}

/// Legs of two joints from the frame to one platform.
type Legs = Vec<[Joint; 2]>;

/// Rows and rank of the closure matrix.
fn rows_and_rank(legs: &Legs, size: f64) -> (usize, usize) {
    let contours = legs.len() - 1;
    let column = |n: usize, t: [f64; 6]| -> Vec<f64> {
        let t = [0, 1, 2, 3, 4, 5].map(|i| if i < 3 { t[i] } else { t[i] / size });
        let of = |c: usize| match n {
            0 => t,
            n if n == c + 1 => t.map(|x| -x),
            _ => [0.0; 6],
        };
        (0..contours).flat_map(of).collect()
    };
    let twists = |(n, leg): (usize, &[Joint; 2])| {
        let all = leg.iter().flat_map(|j| j.twists());
        all.map(move |t| (n, t)).collect_vec()
    };
    let columns = legs.iter().enumerate().flat_map(twists);
    let columns = columns.map(|(n, t)| column(n, t)).collect();
    (6 * contours, rank_of_rows(columns))
}

/// The mechanism as a file, its numbers with so many decimals, or whole.
fn file(legs: &Legs, decimals: Option<usize>) -> String {
    let v = |p: V| match decimals {
        Some(d) => p.map(|x| format!("{x:.d$}")).join(", "),
        None => p.map(|x| x.to_string()).join(", "),
    };
    let mut joints = String::new();
    for (n, leg) in legs.iter().enumerate() {
        for (i, joint) in leg.iter().enumerate() {
            let (kind, at, axis, more) = match *joint {
                Joint::Ball(p) => ("spherical", p, String::new(), String::new()),
                Joint::Slide(p, a) => ("prismatic", p, v(a), String::new()),
                Joint::Turn(p, a) => ("revolute", p, v(a), String::new()),
                Joint::Screw(p, a, h) => ("helical", p, v(a), format!("pitch = {h}")),
            };
            let ends = [format!("f l{n}"), format!("l{n} p")];
            let at = v(at);
            joints += &format!("j{n}{i} | {} | {kind} | {at} | {axis} | {more}\n", ends[i]);
        }
    }
    let links = (0..legs.len()).map(|n| format!(" l{n}")).join("");
    write_mechanism("name = \"m\"", &format!("f p*{links}"), &joints)
}

/// A mechanism, and its legs in the drawn pose and in other closed poses.
#[derive(Debug)]
struct Known {
    poses: Vec<Legs>,
    /// Whether what is redundant is so in every pose.
    lasts: bool,
}

fn gantry(width: i32, off: i32, rise: i32) -> Known {
    let a = [0.0, 1.0, 0.0];
    let ball = [
        [0.0; 3],
        [f64::from(width), f64::from(off), f64::from(rise)],
    ];
    let at = |t: f64| {
        ball.map(|p| [Joint::Slide(p, a), Joint::Ball(add_scaled(p, t, a))])
            .to_vec()
    };
    Known {
        poses: [0.0, 0.7, -1.3].map(at).to_vec(),
        lasts: true,
    }
}

fn plate(feet: &[(i32, i32)], screws: bool) -> Known {
    let a = [0.0, 0.0, 1.0];
    let at = |t: f64| {
        let leg = |&(x, y): &(i32, i32)| {
            let p = [f64::from(x), f64::from(y), 0.0];
            let guide = if screws {
                Joint::Screw(p, a, 2.0)
            } else {
                Joint::Slide(p, a)
            };
            [guide, Joint::Ball(add_scaled(p, t, a))]
        };
        feet.iter().map(leg).collect()
    };
    Known {
        poses: [0.0, 0.9, -1.7].map(at).to_vec(),
        lasts: true,
    }
}

fn wren(feet: &[[i32; 3]], leg: [i32; 3]) -> Known {
    let l = leg.map(f64::from);
    // The leg turned about some axis, by the formula of Rodrigues.
    let turned = |t: f64| {
        let k: V = [2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0];
        let along: f64 = (0..3).map(|i| k[i] * l[i]).sum();
        let across = cross(k, l);
        [0, 1, 2].map(|i| l[i] * t.cos() + across[i] * t.sin() + k[i] * along * (1.0 - t.cos()))
    };
    let at = |t: f64| {
        let l = turned(t);
        let leg = |p: &[i32; 3]| {
            let p = p.map(f64::from);
            [Joint::Ball(p), Joint::Ball(add_scaled(p, 1.0, l))]
        };
        feet.iter().map(leg).collect()
    };
    Known {
        poses: [0.0, 0.4, -0.8].map(at).to_vec(),
        lasts: true,
    }
}

/// A four-bar with all pins on a line, that moves on where a circle about the elbow meets one about the far bearing; none where
/// it does not move or its lengths are those of a kite or a parallelogram.
fn in_line(pins: [i32; 3], balls: bool) -> Option<Known> {
    let [b, c, d] = pins.map(f64::from);
    let bars = [b, c - b, d - c, d];
    let alike = (0..4).any(|i| (0..i).any(|j| bars[i].abs() == bars[j].abs()));
    if alike || bars.contains(&0.0) || -bars[0] * bars[1] * bars[2] * bars[3] <= 0.0 {
        return None;
    }
    let z = [0.0, 0.0, 1.0];
    let at = |t: f64| -> Option<Legs> {
        let elbow = [b * t.cos(), b * t.sin()];
        let across = [d - elbow[0], -elbow[1]];
        let far = across[0].hypot(across[1]);
        let along = (far * far + bars[1] * bars[1] - bars[2] * bars[2]) / (2.0 * far);
        let height = bars[1] * bars[1] - along * along;
        let height = if t == 0.0 { 0.0 } else { height };
        if height < 0.0 {
            return None;
        }
        let (u, h) = (across.map(|x| x / far), height.sqrt());
        let tip = [
            elbow[0] + along * u[0] - h * u[1],
            elbow[1] + along * u[1] + h * u[0],
            0.0,
        ];
        let pin = |p: V| {
            if balls {
                Joint::Ball(p)
            } else {
                Joint::Turn(p, z)
            }
        };
        Some(vec![
            [Joint::Turn([0.0; 3], z), pin([elbow[0], elbow[1], 0.0])],
            [Joint::Turn([d, 0.0, 0.0], z), pin(tip)],
        ])
    };
    Some(Known {
        poses: vec![at(0.0)?, at(0.2)?],
        lasts: false,
    })
}

fn known() -> impl Strategy<Value = Known> {
    let foot = (-9..10, -9..10);
    let place = [-9..10, -9..10, -9..10];
    let apart = |feet: &Vec<(i32, i32)>| {
        let [a, b, c] = [feet[0], feet[1], feet[2]];
        (b.0 - a.0) * (c.1 - a.1) != (b.1 - a.1) * (c.0 - a.0)
    };
    prop_oneof![
        (1..20, prop_oneof![Just(0), 1..9], -9..10).prop_map(|(w, o, r)| gantry(w, o, r)),
        (proptest::collection::vec(foot, 3..6), any::<bool>())
            .prop_filter("not in a line", move |(feet, _)| apart(feet))
            .prop_map(|(feet, screws)| plate(&feet, screws)),
        (proptest::collection::vec(place, 6..8), [1..9, -9..9, -9..9])
            .prop_map(|(feet, leg)| wren(&feet, leg)),
        ([-12..13, -12..13, -12..13], any::<bool>())
            .prop_filter_map("does not move", |(pins, balls)| in_line(pins, balls)),
    ]
}

/// The turn of a quaternion of whole numbers, times its length squared: whole numbers again.
fn turn(quaternion: [i32; 4], by: f64) -> impl Fn(V) -> V {
    let q = quaternion.map(f64::from);
    let norm: f64 = q.iter().map(|x| x * x).sum();
    let turn = RigidMotion::from_quaternion([0.0; 3], q);
    move |p| turn.map_direction(p).map(|x| by * (norm * x).round())
}

proptest! {
    #![proptest_config(runs(24))]

    #[test]
    fn what_is_redundant_in_every_pose_lasts_and_nothing_else_does(
        known in known(),
        quaternion in [1..4, -3..4, -3..4, -3..4],
        power in 0..4,
        decimals in prop_oneof![3 => Just(None), 1 => (6_usize..13).prop_map(Some)],
    ) {
        let size = 20.0;
        let (rows, rank) = rows_and_rank(&known.poses[0], size);
        let most = known.poses.iter().map(|p| rows_and_rank(p, size).1).max().unwrap();
        prop_assert_eq!(known.lasts, most == rank);
        let norm = f64::from(quaternion.iter().map(|q| q * q).sum::<i32>());
        // Rounded numbers are of a turned mechanism of its own size, whole numbers of one that has grown.
        let by = if decimals.is_some() { norm.recip() } else { 10_f64.powi(power) };
        let map = turn(quaternion, by);
        let drawn: Legs = known.poses[0]
            .iter()
            .map(|leg| leg.map(|j| j.mapped(&map)))
            .collect();
        let text = file(&drawn, decimals);
        let m = read(&text);
        let found = held_twice(&m, &|_| false, &|_| true, Some(&|_| true)).unwrap();
        if decimals.is_some() {
            // Coarse digits may leave a figure open, and may not make it wrong.
            if let Some(Where::Pose { elsewhere, .. }) = found.over {
                prop_assert!(elsewhere >= rows - most, "{elsewhere} {:?}\n{text}", known);
            }
            return Ok(());
        }
        prop_assert_eq!(found.range(), (rows - rank, rows - rank), "{}", text);
        prop_assert_eq!(found.lasting, rows - most, "{:?}\n{}", found.over, text);
        let passing = matches!(found.over, Some(Where::Pose { .. }));
        prop_assert_eq!(passing, !known.lasts, "{:?}\n{}", found.over, text);
        prop_assert_eq!(found.list.len(), rows - rank, "{}", text);
    }
}
