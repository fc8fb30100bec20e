//! The slow twin of the catalogue's counts at places in general position.

use crate::common::*;
/// Determinate variants of W = 1 with the input joint unchanged, by the theory alone, with none of the engine: a spanning tree of the chain's graph gives its contours, each
/// added freedom is a column of three out-of-plane rows a contour, with the pins at random places modulo a prime, and all
/// choices of the menu at all joints but the input are walked as long as their columns are independent.
pub(super) fn determinate(chain: &Chain, input: (usize, usize)) -> u64 {
    const P: u64 = (1 << 31) - 1;
    let joints = chain.joints().into_iter();
    let edges: Vec<(usize, usize)> = joints.map(|j| (j.links[0], j.links[1])).collect();
    // Each link reached, with the signed edges from link 0.
    let mut path: Vec<Option<Vec<i64>>> = vec![None; chain.links()];
    path[0] = Some(vec![0; edges.len()]);
    let mut contours = Vec::new();
    let mut grown = true;
    while std::mem::take(&mut grown) {
        for (i, &(a, b)) in edges.iter().enumerate() {
            for (from, to, sign) in [(a, b, 1), (b, a, -1)] {
                if let (Some(way), None) = (path[from].clone(), &path[to]) {
                    let mut way = way;
                    way[i] += sign;
                    (path[to], grown) = (Some(way), true);
                }
            }
        }
    }
    for (i, &(a, b)) in edges.iter().enumerate() {
        let (to_a, to_b) = (path[a].as_ref().unwrap(), path[b].as_ref().unwrap());
        let mut contour: Vec<i64> = to_a.iter().zip(to_b).map(|(x, y)| x - y).collect();
        contour[i] += 1;
        if contour.iter().any(|&x| x != 0) {
            contours.push(contour);
        }
    }
    let rows = 3 * contours.len();
    let mut random = 88_172_645_463_325_252u64;
    let mut coordinate = || {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        random % P
    };
    // Turning about x, about y, sliding along z.
    let freedoms: Vec<[Vec<u64>; 3]> = (0..edges.len())
        .map(|i| {
            let (x, y) = (coordinate(), coordinate());
            [[1, 0, y], [0, 1, P - x], [0, 0, 1]].map(|twist| {
                let signed = |sign: i64| twist.map(|t| t * sign.rem_euclid(P as i64) as u64 % P);
                contours.iter().flat_map(|c| signed(c[i])).collect()
            })
        })
        .collect();
    let at = (input.0.min(input.1), input.0.max(input.1));
    let free = freedoms.iter().zip(&edges).filter(|(_, e)| **e != at);
    let free: Vec<_> = free.map(|(f, _)| f.clone()).collect();
    assert_eq!(free.len() + 1, edges.len());

    fn inverse(x: u64) -> u64 {
        let (mut power, mut square, mut e) = (1, x, P - 2);
        while e > 0 {
            if e & 1 == 1 {
                power = power * square % P;
            }
            (square, e) = (square * square % P, e >> 1);
        }
        power
    }
    fn walk(left: &[[Vec<u64>; 3]], held: &mut Vec<(usize, Vec<u64>)>, rows: usize) -> u64 {
        // Revolute, cylindrical, universal either way, spherical, sphere in cylinder.
        const MENU: [&[usize]; 6] = [&[], &[2], &[0], &[1], &[0, 1], &[0, 1, 2]];
        let Some((joint, rest)) = left.split_first() else {
            return u64::from(held.len() == rows);
        };
        if held.len() + 3 * left.len() < rows {
            return 0;
        }
        let before = held.len();
        let mut sum = 0;
        for option in MENU {
            let independent = option.iter().all(|&freedom| {
                let mut column = joint[freedom].clone();
                for (pivot, row) in held.iter() {
                    let factor = P - column[*pivot];
                    if factor < P {
                        let both = column.iter_mut().zip(row);
                        both.for_each(|(x, r)| *x = (*x + factor * r) % P);
                    }
                }
                let pivot = column.iter().position(|&x| x != 0);
                if let Some(pivot) = pivot {
                    let factor = inverse(column[pivot]);
                    column.iter_mut().for_each(|x| *x = *x * factor % P);
                    held.push((pivot, column));
                }
                pivot.is_some()
            });
            if independent {
                sum += walk(rest, held, rows);
            }
            held.truncate(before);
        }
        sum
    }
    walk(&free, &mut Vec::new(), rows)
}
