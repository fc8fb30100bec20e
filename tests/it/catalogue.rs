//! Structures laid out: exactly symmetric, one motion that closes the jaws, determinate variants as published.

use crate::common::*;
mod by_hand;
mod carried_on;
mod chains;
mod command;
mod damaged;
mod determinate;
mod find;
mod general;
mod given_up;
mod killed;
mod orbits;
mod out_of_plane;
mod paired;
mod pairs;
mod planes;
mod rows;
mod store;
mod stroke;
mod tasks;
mod three_jaws;
mod workload;

use ozols::analyze;
use ozols::catalog::RowError;
use ozols::catalog::general::General;
use ozols::catalog::row::{Laid, StructureRow, row_of_pair};
use ozols::chains::Symmetry;
use ozols::chains::roles::Subject;
use ozols::file::schema::{Coordinate, DriveWord};
use ozols::synthesis::layout::{Layout, NoLayout};
use ozols::synthesis::mechanism::mechanism_file;
use ozols::synthesis::place::Place;
use ozols::synthesis::structure::Form;
use ozols::synthesis::structure::listed::hinged_structures;
use std::ops::Deref;
use stroke::read_layout;

/// A layout with only hinges, as pins at exact places.
struct Drawn {
    pins: Vec<(usize, usize)>,
    at: Vec<Place>,
    tips: Vec<Place>,
    layout: Layout,
}

impl Drawn {
    fn new(s: &Structure, layout: Layout) -> Drawn {
        let joints = layout.rules.joints.iter();
        Drawn {
            pins: joints.map(|j| (j.links[0], j.links[1])).collect(),
            at: layout.places(),
            tips: s.tip_places(&layout.limits.task),
            layout,
        }
    }
}

impl Deref for Drawn {
    type Target = Layout;

    fn deref(&self) -> &Layout {
        &self.layout
    }
}

fn layout(s: &Structure, limits: &Limits, seed: u64) -> Result<Drawn, NoLayout> {
    let found = ozols::synthesis::layout::lay_out(s, limits, seed);
    found.map(|l| Drawn::new(s, l))
}

/// Calls with every structure of two jaws and some forms of all chains of so many links.
fn each_structure(
    links: usize,
    forms: &[(Input, Form)],
    with: impl FnMut(&Subject<'_>, Structure),
) {
    each_structure_of(links, 2, forms, with);
}

/// Calls with every structure of so many jaws and some forms of all chains of so many links.
fn each_structure_of(
    links: usize,
    jaws: usize,
    forms: &[(Input, Form)],
    mut with: impl FnMut(&Subject<'_>, Structure),
) {
    for chain in list_chains(links, 1).unwrap() {
        let (chain, automorphisms) = chain.canonical_form();
        let subject = Subject::new(&chain, &automorphisms);
        for s in hinged_structures(&subject, jaws, forms) {
            with(&subject, s);
        }
    }
}

fn form_of(input: Input, symmetry: Symmetry, parallel: bool) -> (Input, Form) {
    let of = Form::of_symmetry(symmetry);
    let form = Form {
        parallel,
        hinges: true,
        ..of
    };
    (input, form)
}

/// The row of a structure that is built alone.
fn structure_row(structure: &Structure, spec: &Spec) -> Result<StructureRow, RowError> {
    let general = General::search_general(structure, spec)?;
    row_of_pair(structure, spec, general.as_ref())
}

fn plain_spec(ideas: usize) -> Spec {
    default_with(|s: &mut Spec| s.ideas = ideas)
}

/// A structure a test lays out: places by joint.
/// Places of pins in thousandths of a millimetre.
fn places_of_pins(l: &Drawn) -> BTreeMap<(usize, usize), [i32; 2]> {
    assert!(l.at.iter().all(|p| p.thirds == 0));
    let thousandths = |p: &Place| [0, 1].map(|k| 1000 * p.whole[k] + p.fine[k]);
    let places = l.at.iter().map(thousandths);
    l.pins.iter().copied().zip(places).collect()
}

#[test]
fn symmetric_layouts_are_as_many_as_can_be_and_exactly_symmetric() {
    let mirror = form_of(Input::Slide, Symmetry::Mirror, false);
    let half_turn = form_of(Input::Turn, Symmetry::HalfTurn, false);
    // `topology.md`: mirror possible, half-turn possible.
    for (links, form, possible) in [
        (4, mirror, 0),
        (6, mirror, 2),
        (8, mirror, 5),
        (6, half_turn, 2),
        (8, half_turn, 0),
    ] {
        let mut laid = 0;
        each_structure(links, &[form], |subject, s| {
            let Ok(l) = layout(&s, &Limits::default(), 1) else {
                return;
            };
            laid += 1;
            // Whichever way round: some automorphism that swaps the jaws carries every pin to its image.
            let at = places_of_pins(&l);
            let image = |[x, y]: [i32; 2]| match form.1.symmetry {
                Symmetry::Mirror => [x, -y],
                _ => [-x, -y],
            };
            let carries = |swap: &Vec<usize>| {
                at.iter().all(|(&(u, v), &place)| {
                    let (p, q) = (swap[u], swap[v]);
                    at[&(p.min(q), p.max(q))] == image(place)
                })
            };
            assert!(
                subject.iter_swaps(&s.structure.roles).any(carries),
                "{}",
                s.name()
            );
        });
        assert_eq!(laid, possible, "{links} {form:?}");
    }
}

#[test]
fn parallelograms_are_exact_and_their_jaws_do_not_turn() {
    let mut seen = 0;
    each_structure(
        6,
        &Form::of_hinges().filter(|(_, f)| f.parallel).collect_vec(),
        |_, s| {
            let Ok(row) = structure_row(&s, &plain_spec(0)) else {
                panic!("{}", s.name())
            };
            let Ok(Laid {
                layout, figures, ..
            }) = row.laid
            else {
                return;
            };
            seen += 1;
            let at = places_of_pins(&Drawn::new(&s, layout));
            let pin = |u: usize, v: usize| at[&(u.min(v), u.max(v))];
            for r in s.parallelogram_rings().unwrap() {
                let [a, b, c, d] = r.map(|[u, v]| pin(u, v));
                let side = |a: [i32; 2], b: [i32; 2]| [b[0] - a[0], b[1] - a[1]];
                assert_eq!(side(a, c), side(b, d), "{}", s.name());
            }
            assert!(figures.turns.iter().all(|t| *t < 1e-6), "{figures:?}");
        },
    );
    assert!(seen > 0);
}

/// The twin at the drawn place: how fast the tips part.
#[test]
fn the_drive_closes_the_jaws_as_fast_as_the_layout_says() {
    let forms = [
        form_of(Input::Slide, Symmetry::Generic, false),
        form_of(Input::Turn, Symmetry::Generic, false),
    ];
    let (mut n, mut ways) = (0, Vec::new());
    each_structure(6, &forms, |_, s| {
        n += 1;
        if n % 8 != 0 {
            return;
        }
        let l = layout(&s, &Limits::default(), 1).unwrap();
        let twin = read_layout(&s, &l);
        let pose = twin.seen(twin.drawn());
        let rate = 1.0 / pose.drive();
        let stated = l.looks.closing;
        assert!(
            (rate.abs() - stated).abs() < 1e-4 * stated,
            "{}: {rate} {stated}",
            s.name()
        );
        // Against each other: the sum of both tips' speeds is more than either.
        let [a, b] = l.looks.tips[..] else {
            panic!("two tips")
        };
        assert!(a[1] < 0.0 && b[1] > 0.0, "{:?}", l.looks);
        let found = layout_figures(&s, &l).unwrap();
        ways.push(found.closes);
        assert_eq!(found.closes, -rate.signum(), "{}", s.name());
    });
    assert!(ways.contains(&1.0) && ways.contains(&-1.0), "{ways:?}");
}

/// Solves a square system given by columns.
pub(crate) fn solve_square(columns: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let n = right.len();
    assert_eq!(columns.len(), n);
    let mut rows: Vec<Vec<f64>> = (0..n)
        .map(|r| columns.iter().map(|c| c[r]).chain([right[r]]).collect())
        .collect();
    for c in 0..n {
        let p = (c..n)
            .max_by(|&a, &b| rows[a][c].abs().total_cmp(&rows[b][c].abs()))
            .unwrap();
        rows.swap(c, p);
        let own = rows[c].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(r, _)| *r != c) {
            let factor = row[c] / own[c];
            row.iter_mut().zip(&own).for_each(|(x, o)| *x -= factor * o);
        }
    }
    (0..n).map(|i| rows[i][n] / rows[i][i]).collect()
}

/// All solutions of homogeneous equations, one for each unknown that is left free.
fn free_motions(mut rows: Vec<Vec<f64>>, n: usize) -> Vec<Vec<f64>> {
    let mut pivots: Vec<(usize, usize)> = Vec::new();
    for c in 0..n {
        let free = (0..rows.len()).filter(|r| pivots.iter().all(|p| p.0 != *r));
        let best = free.max_by(|&a, &b| rows[a][c].abs().total_cmp(&rows[b][c].abs()));
        let Some(p) = best.filter(|&p| rows[p][c].abs() > 1e-9) else {
            continue;
        };
        let own = rows[p].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(r, _)| *r != p) {
            let factor = row[c] / own[c];
            row.iter_mut().zip(&own).for_each(|(x, o)| *x -= factor * o);
        }
        pivots.push((p, c));
    }
    let motion = |free: usize| {
        let mut out = vec![0.0; n];
        out[free] = 1.0;
        let bound = pivots.iter();
        bound.for_each(|&(r, c)| out[c] = -rows[r][free] / rows[r][c]);
        out
    };
    let free = (0..n).filter(|c| pivots.iter().all(|p| p.1 != *c));
    free.map(motion).collect()
}

/// The mechanism with its pins moved by less than half a millimetre, so that no two axes through them coincide: the
/// published counts are those of generic places, and whole millimetres may be special.
fn generic_mechanism(s: &Structure, l: &Drawn, change_input: bool) -> Mechanism {
    let mut file = mechanism_file(
        s,
        l,
        &Spec::default().option_menu().unwrap(),
        &Workload::default(),
    );
    for (i, (joint, at)) in file.joint.iter_mut().zip(&l.at).enumerate() {
        // The golden ratio's multiples are spread evenly.
        let off = |k: usize| (((2 * i + k + 1) * 6_180_339) % 10_000_000) as i64;
        let exact = |whole: i32, k| format!("{whole} + {}/20000000", off(k));
        let [x, y] = [0, 1].map(|k| exact(at.whole[k], k));
        joint.point = [x, y, "0".to_owned()].map(Coordinate::Expression);
        change_input.then(|| joint.drive = DriveWord::default());
    }
    ozols::from_json(&file.json().to_string()).unwrap()
}

#[test]
fn the_mechanism_of_a_row_has_the_figures_of_the_row_when_it_is_read_again() {
    let forms = Form::of_hinges().collect_vec();
    let mut n = 0;
    each_structure(6, &forms, |_, s| {
        n += 1;
        if n % 9 != 0 {
            return;
        }
        let StructureRow { laid: Ok(laid), .. } = structure_row(&s, &plain_spec(3)).unwrap() else {
            return;
        };
        let again = ozols::from_toml(&laid.file).unwrap();
        let free = &analyze(&again).unwrap()[0];
        assert_eq!((free.mobility, free.redundant), laid.as_built);
        let request = default_with(|r: &mut Request| r.max_mobility = Some(1));
        let outcome = ozols::search(&again, &request).unwrap();
        assert_eq!(outcome.determinate.by_mobility_and_changes, laid.counts);
        assert_eq!(
            outcome.admissible.total,
            laid.variant_count(Some(1)),
            "{}",
            s.name()
        );
        let best = outcome.variants().next().unwrap();
        assert_eq!(best.cost_milli(), laid.ideas[0].cost_milli);
        // Every joint is a hinge square to the plane but the input, and no place is off the thousandth of a millimetre.
        for j in &again.joints {
            let slides = j.drive && s.drive_input() == Input::Slide;
            assert_eq!(j.joint_type == JointType::Prismatic, slides);
            let thousandths = to_vector(&j.frame.point).map(|x| (1000.0 * x).round() / 1000.0);
            assert_eq!(thousandths, to_vector(&j.frame.point));
        }
    });
}

#[test]
fn why_a_structure_has_no_layout_is_said() {
    let mirror = form_of(Input::Slide, Symmetry::Mirror, false);
    let mut whys = BTreeMap::new();
    each_structure(8, &[mirror], |_, s| {
        if let Err(why) = layout(&s, &Limits::default(), 1) {
            *whys.entry(why.to_string()).or_insert(0) += 1;
        }
    });
    // `topology.md`: of 53 graph-symmetric ones 48 have no regular mirror layout.
    assert_eq!(whys.values().sum::<i32>(), 48, "{whys:?}");
    assert!(whys.contains_key("the drive cannot move"), "{whys:?}");
    let strict = default_with(|l: &mut Limits| (l.ratio, l.crossings) = (1.5, 0));
    let turning = form_of(Input::Turn, Symmetry::Generic, false);
    let mut refused = 0;
    each_structure(6, &[turning], |_, s| {
        let found = layout(&s, &strict, 1);
        refused += usize::from(found.is_err_and(|e| e.to_string().contains("links of 1 : ")));
    });
    assert!(refused > 0);
}
