//! Closed walks of a mechanism, and the directions of its joints' freedoms.

use super::*;

/// Returns every closed walk that passes no link twice, once each, as joints in the order of the walk.
pub(crate) fn simple_cycles(m: &Mechanism, state: StateId) -> Vec<Vec<JointId>> {
    let joints: Vec<JointId> = m.joints_in(state).collect();
    let mut out = Vec::new();
    for &first in &joints {
        let [home, at] = m.joints[first].links;
        let mut open = vec![(vec![first], vec![at])];
        while let Some((walk, links)) = open.pop() {
            let here = links[links.len() - 1];
            for &j in joints.iter().filter(|j| **j > first && !walk.contains(j)) {
                let [a, b] = m.joints[j].links;
                if a != here && b != here {
                    continue;
                }
                let to = if a == here { b } else { a };
                let longer = [&walk[..], &[j]].concat();
                if to == home {
                    out.push(longer);
                } else if !links.contains(&to) {
                    open.push((longer, [&links[..], &[to]].concat()));
                }
            }
        }
    }
    out
}

/// Returns the axes x, y and z of a frame, x its reference made square to its axis z.
pub(crate) fn axes_of(frame: &Frame) -> [Vector; 3] {
    let z = unit(to_vector(&frame.axis));
    let reference = to_vector(&frame.reference);
    let x = unit(sub(reference, scale(z, dot(reference, z))));
    [x, cross(z, x), z]
}

/// Returns the direction of a freedom of a joint with this frame; that of a screw is its axis.
pub(crate) fn direction_of(frame: &Frame, freedom: Freedom) -> Vector {
    let [x, y, z] = axes_of(frame);
    match freedom {
        Freedom::Rx | Freedom::Tx => x,
        Freedom::Ry | Freedom::Ty => y,
        Freedom::Rz | Freedom::Tz | Freedom::Screw => z,
    }
}
