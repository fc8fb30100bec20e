//! Three jaws: as many structures as move in threefold places, laid out exactly so, closing together.

use super::command::{free_state, path_in, query_lines};
use super::stroke::read_layout;
use super::{Drawn, each_structure_of, form_of, free_motions, layout, plain_spec, structure_row};
use crate::common::*;
use ozols::chains::Symmetry;
use ozols::chains::roles::Subject;

pub(super) fn third([x, y]: [f64; 2]) -> [f64; 2] {
    let (sine, cosine) = (2.0 * PI / 3.0).sin_cos();
    [cosine * x - sine * y, sine * x + cosine * y]
}

/// How many motions the links have with hinges at these places and the frame at rest, and whether driver and jaws move in
/// the only one: by eliminating in floating point. Shares nothing with the program's own look modulo a prime.
fn motions(s: &Structure, at: &BTreeMap<(usize, usize), [f64; 2]>) -> (usize, bool) {
    let n = 3 * s.structure.chain.links();
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let mut row = |entries: &[(usize, f64)]| {
        let mut row = vec![0.0; n];
        entries.iter().for_each(|(i, x)| row[*i] += x);
        rows.push(row);
    };
    (0..3).for_each(|k| row(&[(3 * s.structure.roles.frame + k, 1.0)]));
    for (&(u, v), [x, y]) in at {
        row(&[
            (3 * u, -y),
            (3 * u + 1, 1.0),
            (3 * v, *y),
            (3 * v + 1, -1.0),
        ]);
        row(&[
            (3 * u, *x),
            (3 * u + 2, 1.0),
            (3 * v, -x),
            (3 * v + 2, -1.0),
        ]);
    }
    let free = free_motions(rows, n);
    let [motion] = &free[..] else {
        return (free.len(), false);
    };
    let moves = |l: &usize| motion[3 * l..3 * l + 3].iter().any(|x| x.abs() > 1e-9);
    (
        1,
        moves(&s.structure.roles.drive_links()[1]) && s.structure.roles.jaws.iter().all(moves),
    )
}

/// Places that look random, carried to each other by thirds of a turn.
fn scattered(subject: &Subject<'_>, s: &Structure) -> BTreeMap<(usize, usize), [f64; 2]> {
    let turn = subject.iter_swaps(&s.structure.roles).next().unwrap();
    let mut at = BTreeMap::new();
    for (i, joint) in s.structure.chain.joints().into_iter().enumerate() {
        let joint = (joint.links[0], joint.links[1]);
        let image = |(u, v): (usize, usize)| (turn[u].min(turn[v]), turn[u].max(turn[v]));
        let off = |k: usize| ((3 * i + k) as f64 * 0.618_034).fract() - 0.5;
        let mut place = if image(joint) == joint {
            [0.0; 2]
        } else {
            [off(1), off(2)]
        };
        let mut joint = joint;
        while !at.contains_key(&joint) {
            at.insert(joint, place);
            (joint, place) = (image(joint), third(place));
        }
    }
    at
}

#[test]
fn threefold_structures_are_those_that_move_in_threefold_places() {
    let threefold = [form_of(Input::Turn, Symmetry::Threefold, false)];
    for (links, symmetric, possible) in [(6, 0, 0), (8, 2, 2), (10, 10, 0)] {
        let (mut all, mut by_twin, mut laid) = (0, 0, 0);
        each_structure_of(links, 3, &threefold, |subject, s| {
            all += 1;
            let (count, moving) = motions(&s, &scattered(subject, &s));
            by_twin += usize::from(count == 1 && moving);
            match layout(&s, &Limits::default(), 1) {
                Ok(_) => laid += 1,
                Err(why) => assert!(!moving, "{}: {why}", s.name()),
            }
        });
        assert_eq!(
            (all, by_twin, laid),
            (symmetric, possible, possible),
            "{links}"
        );
    }
}

#[test]
fn threefold_layouts_are_exact_and_their_jaws_close_together() {
    let threefold = [form_of(Input::Turn, Symmetry::Threefold, false)];
    let mut seen = 0;
    each_structure_of(8, 3, &threefold, |subject, s| {
        let row = structure_row(&s, &plain_spec(3)).unwrap();
        let laid = row.laid.unwrap();
        seen += 1;
        let m = ozols::from_toml(&laid.file).unwrap();
        let drawn = Drawn::new(&s, laid.layout.clone());
        let turn = subject.iter_swaps(&s.structure.roles).next().unwrap();
        let places: BTreeMap<(usize, usize), [f64; 2]> = m
            .joints
            .iter()
            .zip(&drawn.pins)
            .map(|(j, &pin)| {
                let [x, y, _] = to_vector(&j.frame.point);
                (pin, [x, y])
            })
            .collect();
        for (&(u, v), &place) in &places {
            let (p, q) = (turn[u].min(turn[v]), turn[u].max(turn[v]));
            let [x, y] = third(place);
            let image = places[&(p, q)];
            assert!(
                (x - image[0]).hypot(y - image[1]) < 1e-12,
                "{place:?} {image:?}"
            );
        }
        // Over the rationals with a root of three, not over rounded places.
        assert_eq!(
            (
                laid.finite.format_figure().as_str(),
                laid.finite.is_proven()
            ),
            ("1", true)
        );
        assert!(laid.exact && !laid.ideas.is_empty());
        // All three tips as fast towards the middle, as the layout says.
        let twin = read_layout(&s, &drawn);
        let pose = twin.seen(twin.drawn());
        near(
            2.0 * laid.layout.looks.closing * pose.drive().abs(),
            2.0,
            2e-4,
        );
        for speed in pose.parting() {
            near(speed, 0.5, 1e-4);
        }
        let f = &laid.figures;
        assert!(
            f.turns.iter().all(|t| (t - f.turns[0]).abs() < 1e-6),
            "{f:?}"
        );
    });
    assert_eq!(seen, 2);
}

#[test]
fn generic_structures_of_three_jaws_close_on_the_part() {
    let generic = [Input::Slide, Input::Turn].map(|i| form_of(i, Symmetry::Generic, false));
    let (mut does, mut all) = (0, 0);
    each_structure_of(6, 3, &generic, |_, s| {
        all += 1;
        let Ok(l) = layout(&s, &Limits::default(), 1) else {
            return;
        };
        if layout_figures(&s, &l).is_none_or(|f| f.shortfall.is_some()) {
            return;
        }
        does += 1;
        let twin = read_layout(&s, &l);
        let speeds = twin.seen(twin.drawn()).parting();
        assert!(speeds.iter().all(|v| *v > 0.0), "{}: {speeds:?}", s.name());
    });
    // Two inputs of each.
    assert_eq!(all, 2 * 31);
    // The transmission angle of 25 degrees is what most lack.
    assert!(does > 5, "{does} of {all}");
}

#[test]
fn the_command_takes_three_jaws() {
    let folder = tempdir().unwrap();
    let [db, toml] = ["three.db", "g.toml"].map(|n| path_in(&folder, n));
    has(
        &stdout_of(&format!(
            "catalog build --links 8 --symmetry threefold --ideas 2 --quiet -o {db} --jaws 3"
        )),
        "threefold",
    );
    let sql = "SELECT id FROM structures JOIN layouts ON structure = id WHERE jaws_at_frame = 3";
    let id = &query_lines(&db, sql)[0];
    let shown = stdout_of(&["catalog", "show", &db, id]);
    has(
        &shown,
        "around the part, 3 of them at the frame; laid out threefold",
    );
    has(&shown, "swinging, swinging and swinging");
    stdout_of(&["catalog", "export", &db, id, "--idea", "1", "-o", &toml]);
    let free = free_state(&toml);
    assert_eq!([&free["mobility"], &free["redundant"]], [1, 0]);
}
