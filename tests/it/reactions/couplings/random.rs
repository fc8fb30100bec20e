//! Random geared mechanisms of one drive, as files, and loads on them.

use crate::common::*;

/// Numbers that are the same for the same seed.
pub(super) struct Random(ChaCha8Rng);

impl Random {
    pub(super) fn new(seed: u64) -> Random {
        Random(ChaCha8Rng::seed_from_u64(seed))
    }

    /// Below a number.
    fn below(&mut self, n: u64) -> usize {
        (self.0.next_u64() % n) as usize
    }

    /// From minus a number to it.
    fn around(&mut self, most: i64) -> i64 {
        self.below(2 * most as u64 + 1) as i64 - most
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len() as u64)]
    }
}

const HEAD: &str = "name = \"random\"\nlength_unit = \"mm\"";

/// A tree of hinges and slides, each coupled to one before it, so that one motion is left: gears about parallel axes, racks, and
/// what only says its ratio.
pub(super) fn train(random: &mut Random) -> String {
    let n = 3 + random.below(3);
    let (mut joints, mut slides) = (String::new(), vec![false]);
    for l in 1..=n {
        // On the frame more often than on a link before.
        let on = if random.below(10) < 7 {
            0
        } else {
            random.below(l as u64)
        };
        let point = commas([random.around(60), random.around(60), 0]);
        let (kind, axis) = match random.below(4) {
            0 => ("prismatic", [1 + random.around(1) * 2, random.around(3), 0]),
            1 => ("revolute", [1, -2, 2]),
            _ => ("revolute", random.one_of(&[[0, 0, 1], [0, 0, -2]])),
        };
        let [a, b] = random.one_of(&[[on, l], [l, on]]);
        let (axis, drive) = (commas(axis), l == 1);
        joints += &format!("j{l} | {a} {b} | {kind} | {point} | {axis} | drive = {drive}\n");
        slides.push(kind == "prismatic");
    }
    let links = (0..=n).map(|l| l.to_string()).join(" ") + "*";
    let mut text = write_mechanism(HEAD, &links, &joints);
    for (l, slide) in slides.iter().enumerate().skip(2) {
        let to = 1 + random.below(l as u64 - 1);
        let ratio = random.one_of(&[-2, -1, 3, -3, 5]);
        let gear = random.below(10) < 7;
        // The twin knows a rack before its pinion.
        let [a, b] = if *slide { [l, to] } else { [to, l] };
        text += &format!(
            "[[coupling]]\njoints = [\"j{a}\", \"j{b}\"]\nratio = {ratio}\ngear = {gear}\n"
        );
    }
    text
}

/// A loop in space with two geared cranks on the frame and nothing redundant: 1 + 1 + 3 + 2 + 1 freedoms, 6 rows and the gear.
pub(super) fn five_bar(random: &mut Random) -> String {
    let mut point = || commas([random.around(50), random.around(50), 20 + random.around(30)]);
    let [b, c, d] = [point(), point(), point()];
    let mut axis = || {
        commas([
            1 + random.below(4) as i64,
            random.around(4),
            random.around(4),
        ])
    };
    let (second, third) = (axis(), axis());
    let joints = format!(
        "a | 0 1 | revolute | 0, 0, 0 | 0, 0, 1 | drive = true
         b | 1 2 | spherical | {b}
         c | 2 3 | revolute | {c} | {second}
         d | 3 4 | universal | {d} | {third}
         e | 4 0 | revolute | 90, 20, 0 | 0, 0, 1"
    );
    let ratio = random.one_of(&[-2, -1, 3, -3]);
    let gear = random.below(10) < 7;
    write_mechanism(HEAD, "0 1 2* 3 4", &joints)
        + &format!("[[coupling]]\njoints = [\"a\", \"e\"]\nratio = {ratio}\ngear = {gear}\n")
}

/// Forces at random points of every link but the frame, and moments.
pub(super) fn with_loads(m: &mut Mechanism, random: &mut Random) {
    let frame = m.frame_link();
    let links: Vec<_> = m.link_ids().filter(|&l| l != frame).collect();
    for link in links {
        let mut vector = |most: i64| [0, 1, 2].map(|_| random.around(most).into());
        m.edit().loads.forces.push(ExternalForce {
            states: None,
            link,
            point: vector(80),
            force: vector(100),
            range: None,
        });
        m.edit().loads.moments.push(ExternalMoment {
            link,
            moment: vector(9),
            states: None,
        });
    }
}
