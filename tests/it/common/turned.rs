//! A mechanism in other axes of the file.

use super::*;
use ozols::statics::reactions::geometry::dot;

/// Returns the mechanism with its places, directions and loads turned by a matrix of thirds, and then moved.
pub(crate) fn turned_and_moved(m: &Mechanism, shift: [f64; 3]) -> Mechanism {
    let turn = [[2.0, -2.0, 1.0], [1.0, 2.0, 2.0], [-2.0, -1.0, 2.0]];
    let turn = turn.map(|r: [f64; 3]| r.map(|x| x / 3.0));
    let by = |v: &mut [Expr; 3], shift: [f64; 3]| {
        let from = to_vector(v);
        *v = [0, 1, 2].map(|i| {
            format!("{:.15}", dot(turn[i], from) + shift[i])
                .parse()
                .unwrap()
        });
    };
    let mut out = m.clone();
    let mut parts = out.edit();
    for j in &mut parts.joints {
        by(&mut j.frame.point, shift);
        by(&mut j.frame.axis, [0.0; 3]);
        by(&mut j.frame.reference, [0.0; 3]);
    }
    for mass in parts.links.iter_mut().filter_map(|l| l.mass.as_mut()) {
        by(&mut mass.centre, shift);
        if let Some(Inertia::Tensor([xx, yy, zz, xy, yz, zx])) = mass.inertia {
            let rows = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
            let of = |i: usize, k: usize| dot(turn[i], rows.map(|r| dot(r, turn[k])));
            let places = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];
            mass.inertia = Some(Inertia::Tensor(places.map(|(i, k)| of(i, k))));
        }
    }
    for f in &mut parts.loads.forces {
        by(&mut f.point, shift);
        by(&mut f.force, [0.0; 3]);
    }
    for m in &mut parts.loads.moments {
        by(&mut m.moment, [0.0; 3]);
    }
    if let Some(gravity) = &mut parts.loads.gravity {
        by(gravity, [0.0; 3]);
    }
    drop(parts);
    out
}

/// Returns a four-bar with these corners in a plane through a point, which two vectors span; the first hinge has the motor, or none.
pub(crate) fn four_bar_in_plane(
    [across, up]: [Vector; 2],
    origin: Vector,
    corners: [[f64; 2]; 4],
    driven: bool,
) -> Mechanism {
    let normal = commas(cross(across, up));
    let line = |(i, [x, y]): (usize, [f64; 2])| {
        let at = commas(add_scaled(add_scaled(origin, x, across), y, up));
        let (next, drive) = ((i + 1) % 4, driven && i == 0);
        format!("{i}-{next} | {i} {next} | revolute | {at} | {normal} | drive = {drive}")
    };
    let joints = corners.into_iter().enumerate().map(line).join("\n");
    read(&write_mechanism("name = \"tilted\"", "0 1 2 3*", &joints))
}

/// Returns a double wishbone: each arm on two bushes along a slanted line, a knuckle between two ball joints, a tie rod.
pub(crate) fn double_wishbone() -> String {
    write_mechanism(
        "name = \"it\"",
        "0 lower upper tie knuckle*",
        "
        lower-front | 0 lower | revolute | -150, 350, 95 | 310, -12, 8
        lower-rear | 0 lower | revolute | 160, 338, 103 | 310, -12, 8
        upper-front | 0 upper | revolute | -90, 420, 310 | 200, 9, -14
        upper-rear | 0 upper | revolute | 110, 429, 296 | 200, 9, -14
        lower-ball | lower knuckle | spherical | 4, 720, 80 | 0, 0, 1
        upper-ball | upper knuckle | spherical | -9, 680, 330 | 0, 0, 1
        rack-end | 0 tie | spherical | -120, 360, 150 | 0, 0, 1
        tie-end | tie knuckle | spherical | -130, 700, 140 | 0, 0, 1
        ",
    )
}
