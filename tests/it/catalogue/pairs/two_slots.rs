//! Two pins in two slots between the same links, against a twin that tries every way to join numbered links, and takes two slots for
//! what they are: two lines of action.

use super::super::carried_on::scattered;
use crate::common::*;
use ozols::chains::PairKind;
use ozols::chains::census::{Kinds, pair_census};
use ozols::chains::sharing::Menu;

const P: i64 = (1 << 31) - 1;

/// Pairs of some links, by a letter for each two of them, `-` where nothing joins them.
#[derive(Clone)]
struct Labelled {
    links: usize,
    letters: Vec<char>,
}

impl Labelled {
    fn pairs(&self) -> impl Iterator<Item = ([usize; 2], char)> + '_ {
        let two = (0..self.links).tuple_combinations();
        two.map(|(u, v)| [u, v]).zip(self.letters.iter().copied())
    }

    fn between(&self, u: usize, v: usize) -> char {
        let at = |ends: [usize; 2]| ends == [u.min(v), u.max(v)];
        self.pairs().find(|(ends, _)| at(*ends)).unwrap().1
    }

    /// The letters under another numbering.
    fn renumbered(&self, to: &[usize]) -> Vec<char> {
        let mut out = vec!['-'; self.letters.len()];
        let two: Vec<(usize, usize)> = (0..self.links).tuple_combinations().collect();
        for ([u, v], letter) in self.pairs() {
            let ends = (to[u].min(to[v]), to[u].max(to[v]));
            out[two.iter().position(|t| *t == ends).unwrap()] = letter;
        }
        out
    }

    fn has_carriers(&self) -> bool {
        let gears = self.pairs().filter(|p| p.1 == 'G').map(|p| p.0);
        gears.collect_vec().into_iter().all(|[u, v]| {
            let held = |c: usize| [self.between(c, u), self.between(c, v)];
            let others = (0..self.links).filter(|c| *c != u && *c != v);
            let carries = |kinds: [char; 2]| [['R', 'R'], ['R', 'P'], ['P', 'R']].contains(&kinds);
            others.map(held).any(carries)
        })
    }

    /// Whether it has one motion at places drawn at random, in which every two links move, and each link two pairs or more.
    fn is_chain(&self, random: &mut impl Iterator<Item = u64>) -> bool {
        let degree = |l: usize| {
            self.pairs()
                .filter(|(e, k)| *k != '-' && e.contains(&l))
                .count()
        };
        if (0..self.links).any(|l| degree(l) < 2) || !self.has_carriers() {
            return false;
        }
        let mut one = || i64::try_from(random.next().unwrap() % (1 << 30)).unwrap();
        let mut rows = Vec::new();
        for (ends, letter) in self.pairs() {
            let mut row = |entries: [i64; 3]| {
                let mut out = vec![0; 3 * self.links];
                for (k, e) in entries.into_iter().enumerate() {
                    out[3 * ends[0] + k] = e;
                    out[3 * ends[1] + k] = -e;
                }
                rows.push(out[3..].to_vec());
            };
            match letter {
                '-' => {}
                'R' => {
                    let [x, y] = [one(), one()];
                    row([-y, 1, 0]);
                    row([x, 0, 1]);
                }
                'P' => {
                    row([1, 0, 0]);
                    row([0, one(), one()]);
                }
                'D' => (0..2).for_each(|_| row([one(), one(), one()])),
                _ => row([one(), one(), one()]),
            }
        }
        // What is redundant in the plane already is none.
        if rows.len() != 3 * self.links - 4 {
            return false;
        }
        let Some(motion) = only_motion(rows, 3 * self.links - 3) else {
            return false;
        };
        let at_rest = [[0; 3]];
        let links = motion.chunks(3).map(|c| [c[0], c[1], c[2]]);
        at_rest.into_iter().chain(links).all_unique()
    }
}

fn inverse(x: i64) -> i64 {
    // Fermat's little theorem.
    let (mut out, mut power, mut left) = (1i64, x.rem_euclid(P), P - 2);
    while left > 0 {
        if left & 1 == 1 {
            out = out * power % P;
        }
        power = power * power % P;
        left >>= 1;
    }
    out
}

/// The one solution of homogeneous equations modulo a prime, up to its size; nothing where there is none or more than one.
fn only_motion(mut rows: Vec<Vec<i64>>, unknown: usize) -> Option<Vec<i64>> {
    let mut pivots: Vec<usize> = Vec::new();
    for column in 0..unknown {
        let from = pivots.len();
        let Some(at) = (from..rows.len()).find(|&r| rows[r][column].rem_euclid(P) != 0) else {
            continue;
        };
        rows.swap(from, at);
        let scale = inverse(rows[from][column]);
        let pivot = rows[from]
            .iter()
            .map(|x| x.rem_euclid(P) * scale % P)
            .collect_vec();
        for r in (0..rows.len()).filter(|&r| r != from) {
            let by = rows[r][column].rem_euclid(P);
            for (x, p) in rows[r].iter_mut().zip(&pivot) {
                *x = (x.rem_euclid(P) - by * p % P).rem_euclid(P);
            }
        }
        rows[from] = pivot;
        pivots.push(column);
    }
    let free = (0..unknown)
        .filter(|c| !pivots.contains(c))
        .exactly_one()
        .ok()?;
    let mut out = vec![0; unknown];
    out[free] = 1;
    for (row, &pivot) in rows.iter().zip(&pivots) {
        out[pivot] = (-row[free]).rem_euclid(P);
    }
    Some(out)
}

#[test]
fn as_many_as_every_way_to_join_numbered_links() {
    let kinds = [
        PairKind::Slide,
        PairKind::Gear,
        PairKind::Slot,
        PairKind::TwoSlots,
    ];
    let mut random = scattered(31);
    for links in 3..=4usize {
        let numberings = (0..links).permutations(links).collect_vec();
        let mut chains: BTreeMap<Kinds, [BTreeSet<Vec<String>>; 3]> = BTreeMap::new();
        let letters = (0..links * (links - 1) / 2).map(|_| "-GPRSD".chars());
        for letters in letters.multi_cartesian_product() {
            let one = Labelled { links, letters };
            let first = numberings.iter().map(|n| one.renumbered(n)).min();
            // One of each class is looked at.
            if first.as_ref() != Some(&one.letters) || !one.is_chain(&mut random) {
                continue;
            }
            let many = |letter| one.letters.iter().filter(|l| **l == letter).count();
            let kinds = Kinds {
                slides: many('P'),
                gears: many('G'),
                slots: many('S'),
                two_slots: many('D'),
            };
            let cell = chains.entry(kinds).or_default();
            let name = one.letters.iter().collect::<String>();
            // Choices that a numbering that changes nothing carries to each other are one.
            let same = numberings
                .iter()
                .filter(|n| one.renumbered(n) == one.letters);
            let same = same.collect_vec();
            cell[0].insert(vec![name.clone()]);
            for frame in 0..links {
                let least = same.iter().map(|n| n[frame]).min().unwrap();
                cell[1].insert(vec![name.clone(), least.to_string()]);
                for ([u, v], _) in one.pairs().filter(|p| "RP".contains(p.1)) {
                    let image = |n: &&Vec<usize>| (n[frame], n[u].min(n[v]), n[u].max(n[v]));
                    let least = same.iter().copied().map(|n| image(&n)).min().unwrap();
                    cell[2].insert(vec![name.clone(), format!("{least:?}")]);
                }
            }
        }
        let found = pair_census(
            links,
            Menu {
                kinds: &kinds,
                most: 15,
            },
            true,
        );
        let twin = chains
            .iter()
            .map(|(k, c)| (*k, [0, 1, 2].map(|i| c[i].len() as u64)));
        let counted = found.iter().map(|(k, c)| {
            (
                *k,
                [c.chains, c.frames, c.inputs_at_frame + c.inputs_between],
            )
        });
        assert_eq!(
            counted.collect::<BTreeMap<_, _>>(),
            twin.collect::<BTreeMap<_, _>>(),
            "{links} links"
        );
    }
}

/// Lines of action meet in a point: without slides two slots count as a hinge that is told apart.
#[test]
fn two_slots_count_as_hinges_do() {
    let both = |kind| {
        let kinds = [kind];
        let found = pair_census(
            6,
            Menu {
                kinds: &kinds,
                most: 1,
            },
            false,
        );
        found.into_values().map(|c| c.chains).collect_vec()
    };
    assert_eq!(both(PairKind::TwoSlots), both(PairKind::Slide));
}
