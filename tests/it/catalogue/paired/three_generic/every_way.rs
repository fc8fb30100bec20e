//! Grippers of three jaws by trying all: every way to join labelled links, every choice of roles, the least code of every numbering.
//! Motions are counted in floating point at scattered places. Nothing of it is code that counts structures.

use super::super::super::free_motions;
use crate::common::*;
use ozols::chains::PairKind;

/// What joins each two links, a letter or `-`: (0, 1), (0, 2), (1, 2) and so on.
type Joined = Vec<char>;

/// The least code of every numbering: what joins links, frame, links of the input, jaws.
pub(in super::super::super) type Code = (Joined, usize, Vec<usize>, Vec<usize>);

pub(in super::super::super) fn place(u: usize, v: usize) -> usize {
    let (u, v) = (u.min(v), u.max(v));
    v * (v - 1) / 2 + u
}

pub(in super::super::super) fn renumbered(joined: &[char], to: &[usize]) -> Joined {
    let mut out = joined.to_vec();
    for (u, v) in (0..to.len()).tuple_combinations() {
        out[place(to[u], to[v])] = joined[place(u, v)];
    }
    out
}

fn least(joined: &[char], frame: usize, input: &[usize], jaws: &[usize], links: usize) -> Code {
    let all = (0..links).permutations(links).map(|to| {
        let set = |of: &[usize]| of.iter().map(|&l| to[l]).sorted().collect_vec();
        (renumbered(joined, &to), to[frame], set(input), set(jaws))
    });
    all.min().unwrap()
}

pub(in super::super::super) fn code(s: &PairStructure) -> Code {
    let n = s.chain.links();
    let pairs = (0..n).flat_map(|v| (0..v).map(move |u| (u, v)));
    let letter = |(u, v)| {
        s.chain
            .pair_between(u, v)
            .map_or('-', PairKind::code_letter)
    };
    let joined = pairs.map(letter).collect_vec();
    least(&joined, s.roles.frame, &s.roles.input, &s.roles.jaws, n)
}

/// The motions of some links against the first of them, joints scattered over the plane, three numbers a link.
fn motions(joined: &[char], links: &[usize]) -> Vec<Vec<f64>> {
    let n = 3 * links.len();
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let mut add = |entries: &[(usize, f64)]| {
        let mut row = vec![0.0; n];
        entries.iter().for_each(|&(i, x)| row[i] += x);
        rows.push(row);
    };
    (0..3).for_each(|k| add(&[(k, 1.0)]));
    for (j, i) in (0..links.len()).tuple_combinations() {
        let at = place(links[j], links[i]);
        // Digits far behind the point: no three places are on one line, no three lines through one point.
        let off = |k: usize| (1e5 * ((6 * at + k + 1) as f64).sin()).fract();
        // Of the turning and the velocity at the origin of one link against the other.
        let mut line = |[m, x, y]: [f64; 3]| {
            let side = |l: usize, sign: f64| {
                [
                    (3 * l, sign * m),
                    (3 * l + 1, sign * x),
                    (3 * l + 2, sign * y),
                ]
            };
            add(&[side(i, 1.0), side(j, -1.0)].concat());
        };
        match joined[at] {
            'R' => {
                line([-off(1), 1.0, 0.0]);
                line([off(2), 0.0, 1.0]);
            }
            'P' => {
                line([1.0, 0.0, 0.0]);
                line([0.0, off(1), off(2)]);
            }
            'G' | 'S' => line([off(0), off(1), off(2)]),
            'D' => [0, 3]
                .into_iter()
                .for_each(|k| line([off(k), off(k + 1), off(k + 2)])),
            _ => {}
        }
    }
    free_motions(rows, n)
}

/// Freedoms by counting: three a link but one, two less a hinge, a slide or two slots, one less teeth or a slot.
fn mobility(joined: &[char], links: &[usize]) -> i64 {
    let takes = |(u, v): (&usize, &usize)| match joined[place(*u, *v)] {
        'R' | 'P' | 'D' => 2,
        'G' | 'S' => 1,
        _ => 0,
    };
    3 * (links.len() as i64 - 1) - links.iter().tuple_combinations().map(takes).sum::<i64>()
}

/// Whether it has one motion, in which every two links move, and each gear pair a link that hinges both or hinges one and lets the other
/// slide.
pub(in super::super::super) fn moves(joined: &[char], links: usize) -> bool {
    let all = (0..links).collect_vec();
    let carried = |(u, v): (usize, usize)| {
        let held = |c: usize| [joined[place(c, u)], joined[place(c, v)]];
        let carries = |c: &usize| matches!(held(*c), ['R', 'R'] | ['R', 'P'] | ['P', 'R']);
        let others = (0..links).filter(|c| ![u, v].contains(c));
        joined[place(u, v)] != 'G' || others.into_iter().any(|c| carries(&c))
    };
    if mobility(joined, &all) != 1 || !(0..links).tuple_combinations().all(carried) {
        return false;
    }
    let found = motions(joined, &all);
    let [motion] = &found[..] else { return false };
    let apart = |(u, v): (usize, usize)| {
        (0..3).any(|k| (motion[3 * u + k] - motion[3 * v + k]).abs() > 1e-7)
    };
    (0..links).tuple_combinations().all(apart)
}

/// Whether some of the links, but not all, hold all roles and have one motion among themselves.
fn has_less(joined: &[char], links: usize, roles: &[usize]) -> bool {
    let parts = (0..links)
        .powerset()
        .filter(|p| p.len() < links && p.len() > 2);
    let mut holding = parts.filter(|p| roles.iter().all(|l| p.contains(l)));
    holding.any(|p| motions(joined, &p).len() == 1)
}

/// The codes of all grippers of so many links with such pairs beside hinges, so many at most.
pub(in super::super::super) fn grippers(
    links: usize,
    kinds: &[PairKind],
    most: usize,
) -> BTreeSet<Code> {
    let letters = ['-', 'R']
        .into_iter()
        .chain(kinds.iter().map(|k| k.code_letter()));
    let letters = letters.collect_vec();
    let all = (0..links).collect_vec();
    let ways = (0..links * (links - 1) / 2).map(|_| letters.iter().copied());
    let few = |w: &Joined| w.iter().filter(|c| !"-R".contains(**c)).count() <= most;
    let chains: BTreeSet<Joined> = ways
        .multi_cartesian_product()
        .filter(|w| few(w) && mobility(w, &all) == 1)
        .filter(|w| {
            let mut numberings = (0..links).permutations(links);
            numberings.all(|to| renumbered(w, &to) >= *w)
        })
        .filter(|w| moves(w, links))
        .collect();
    let mut out = BTreeSet::new();
    for chain in &chains {
        for (u, v) in (0..links).tuple_combinations() {
            if !['R', 'P'].contains(&chain[place(u, v)]) {
                continue;
            }
            for frame in 0..links {
                for jaws in (0..links).filter(|l| *l != frame).combinations(3) {
                    let roles = [&jaws[..], &[frame, u, v]].concat();
                    if !has_less(chain, links, &roles) {
                        out.insert(least(chain, frame, &[u, v], &jaws, links));
                    }
                }
            }
        }
    }
    out
}
