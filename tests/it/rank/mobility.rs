//! Mobility methods: the automatic choice on every built-in mechanism, turned, scaled and measured; finite mobility by proof
//! against finite mobility by following the motion; poses against finite differences.

use crate::common::*;
mod proven;

use ozols::rank::finite::{finite_mobility, followed_mobility};
use ozols::rank::method::generic;
use ozols_dense::Matrix;

/// The mechanism as another program would write it: turned, shifted by up to `away` of its size and scaled in doubles, with
/// `noise` on every number.
fn as_measured(m: &Mechanism, seed: u64, noise: f64, away: f64) -> Mechanism {
    let mut random = Noise::new(seed, 0);
    // A random quaternion.
    let [w, x, y, z] = [(); 4].map(|()| random.draw_uniform());
    let turn = RigidMotion::from_quaternion([0.0; 3], [w, x, y, z]);
    let scale = 10f64.powf(random.draw_uniform());
    let size = m
        .joints
        .iter()
        .flat_map(|j| &j.frame.point)
        .map(|x| x.to_f64().abs())
        .fold(1.0, f64::max);
    let shift = [(); 3].map(|()| away * size * random.draw_uniform());
    let turned = |v: &[Expr; 3]| turn.map_direction(to_vector(v));
    let mut out = m.clone();
    for joint in &mut out.edit().joints {
        let point = turned(&joint.frame.point);
        let reference = turned(&joint.frame.reference);
        let axis = turned(&joint.frame.axis);
        let mut number = |x: f64, of: f64| Expr::from_f64(x + noise * of * random.draw_uniform());
        joint.frame = Frame {
            point: [0, 1, 2].map(|i| number(scale * (point[i] + shift[i]), scale * size).unwrap()),
            axis: axis.map(|x| number(x, length(axis)).unwrap()),
            reference: reference.map(|x| number(x, length(reference)).unwrap()),
            pitch: Expr::from_f64(scale * joint.frame.pitch.to_f64()).unwrap(),
        };
        joint.options.clear();
        joint.unloading.clear();
    }
    out
}

#[test]
fn the_automatic_choice_is_right_on_every_built_in_mechanism_turned_and_measured() {
    let mut wrong = Vec::new();
    for (n, name) in builtin::names().into_iter().enumerate() {
        let m = built_in(name);
        for e in &m.expected {
            let state = m.state_named(&e.state).unwrap();
            let mut check = |what: String, m: &Mechanism| {
                let s = &analyse_states(m, &[state], Method::Auto).unwrap()[0];
                let is = (
                    s.mobility as i64,
                    s.finite.mobility as i64,
                    s.redundant as i64,
                );
                let stated = (
                    e.mobility.unwrap(),
                    e.finite_mobility.unwrap(),
                    e.redundant.unwrap(),
                );
                // Right or undecided: where rounding hides a branch, nothing else can be said, nor where noise is a thousand
                // times the last digit: what is no rounding is not taken away.
                let (most, sigma) = s
                    .at_most()
                    .map_or((is.0, is.2), |(w, sigma)| (w as i64, sigma as i64));
                let right = (is.0..=most).contains(&stated.0)
                    && (is.2..=sigma).contains(&stated.2)
                    && (what.contains("noise") || most == is.0)
                    && s.finite.could_be(stated.1);
                if !right {
                    wrong.push(format!(
                        "{name} {what}: stated W, finite W, σ {stated:?}, found {is:?}: {}; {}",
                        s.choice.clone().unwrap_or_default(),
                        s.finite.describe()
                    ));
                }
                assert_eq!(
                    s.per_contour.iter().map(|c| c.redundant).sum::<usize>()
                        + s.per_coupling.iter().map(|c| c.redundant).sum::<usize>(),
                    s.redundant,
                    "{name} {what}"
                );
                assert_eq!(
                    s.working_mobility + s.local_mobility,
                    s.mobility,
                    "{name} {what}"
                );
                if let Some(x) = s.external {
                    assert_eq!(x.redundant, x.by_rank, "{name} {what}");
                }
            };
            check("as it stands".to_owned(), &m);
            // A plane's normal that was measured is a plane no joint fits: planar files are not turned.
            if matches!(m.mode, Mode::Spatial) {
                let seed = 7 * n as u64;
                check(
                    "turned, rounded".to_owned(),
                    &as_measured(&m, seed, 0.0, 1.0),
                );
                let far = as_measured(&m, seed + 2, 0.0, 300.0);
                if name != "wren-platform" {
                    check("far from the origin".to_owned(), &far);
                }
                // Round the upright Wren platform a gap of 1e-12 leaves whole milliradians of play (turn and shift
                // enter by their product, squared): with noise its branches cannot be told apart.
                if name != "wren-platform" {
                    let noisy = as_measured(&m, seed + 1, 1e-12, 0.0);
                    check("with noise 1e-12".to_owned(), &noisy);
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Proof and pursuit share nothing but the file.
#[test]
fn what_is_proven_is_found_by_following_the_motion_too() {
    let mut proven = 0;
    for name in builtin::names() {
        let m = built_in(name);
        let exact = field_of(&m, StateId::FREE, 0).unwrap();
        let closure = Closure::new(&exact, &m, StateId::FREE).unwrap();
        let rank = modular::rank_modulo(&exact, &closure);
        let found = finite_mobility(&exact, &m, &closure, rank).unwrap();
        if found.is_proven() && closure.columns.len() < 60 {
            proven += 1;
            let by_motion =
                followed_mobility(&m, StateId::FREE, closure.columns.len() - rank, 0.0).unwrap();
            // Pursuit may leave it open, but never says otherwise.
            let mobility = found.mobility as i64;
            assert!(
                by_motion.could_be(mobility),
                "{name}: {found:?} {by_motion:?}"
            );
            assert!(!matches!(by_motion.how, How::Bound), "{name}");
        }
    }
    assert!(proven > 40, "{proven}");
}

/// A group of fewer dimensions needs fewer rows, and the rank stays; the dimension is that of the span at random places.
#[test]
fn groups_need_no_more_rows_than_dimensions() {
    use ozols::rank::finite::displacement_group::GroupKind;
    let mut fewer = 0;
    for name in builtin::names() {
        let m = built_in(name);
        let exact = field_of(&m, StateId::FREE, 0).unwrap();
        let closure = Closure::new(&exact, &m, StateId::FREE).unwrap();
        let group = whole_group(&exact, &m, StateId::FREE).unwrap();
        if matches!(m.mode, Mode::Spatial) && group.dimension() < 6 {
            fewer += 1;
            let reduced = group.rows_of(&closure);
            assert_eq!(reduced.dim, group.dimension(), "{name}");
            assert_eq!(
                modular::rank_modulo(&exact, &reduced),
                modular::rank_modulo(&exact, &closure),
                "{name}"
            );
        }
    }
    assert!(fewer > 15, "{fewer}");
    for (name, kind) in [
        ("four-bar", GroupKind::Planar),
        ("spherical-four-bar", GroupKind::Spherical),
        ("agile-eye", GroupKind::Spherical),
        ("door-two-hinges", GroupKind::Rotation),
        ("four-slides", GroupKind::Translation),
        ("bennett", GroupKind::Other),
    ] {
        let m = built_in(name);
        let exact = field_of(&m, StateId::FREE, 0).unwrap();
        assert_eq!(
            whole_group(&exact, &m, StateId::FREE).unwrap().kind(),
            kind,
            "{name}"
        );
    }
}

/// J is the derivative of the gaps.
#[test]
fn the_jacobian_is_the_derivative_of_the_gaps() {
    for name in ["rsur", "hooke-double", "stewart-gough", "screw-jack", "h4"] {
        let pose = Pose::of_file(&built_in(name), StateId::FREE).unwrap();
        let f = pose.columns.len();
        let zero = vec![0.0; f];
        let jacobian: Matrix = pose.jacobian_at(&zero);
        for c in 0..f {
            let h = 1e-6;
            let at = |x: f64| {
                let mut q = zero.clone();
                q[c] = x;
                pose.closure_gaps(&q)
            };
            for (r, (p, m)) in at(h).iter().zip(at(-h)).enumerate() {
                let slope = (p - m) / (2.0 * h);
                assert!((slope - jacobian[(r, c)]).abs() < 1e-8, "{name} {r} {c}");
            }
        }
    }
}

/// The naive formulas fail where the literature says they do.
#[test]
fn each_formula_has_its_known_failures() {
    for (mechanism, by, says) in [
        // Waldron 1966; Gogu 2005, table 1: the Bennett linkage.
        ("bennett", "count", -2),
        ("bennett", "generic", 0),
        ("bennett", "loops", 1),
        ("sarrus", "count", 0),
        ("parallelogram-3-rods", "count-planar", 0),
        ("parallelogram-3-rods", "loops", 0),
        ("tripteron", "count", 0),
        ("tripteron", "loops", 2),
        ("stewart-gough", "count", 6),
        // 6·4 - 25 - 1, 3·4 - 10 - 1, and 5 - 3 - 1 by contours.
        ("geared-five-bar", "count", -2),
        ("geared-five-bar", "count-planar", 1),
        ("geared-five-bar", "loops", 1),
        ("stewart-gough", "generic", 6),
        // Instantaneous methods cannot see that nothing moves.
        ("collinear-truss", "modular", 1),
        ("collinear-truss", "svd", 1),
        ("collinear-truss", "finite", 0),
        ("collinear-truss", "auto", 0),
    ] {
        let answer = registry::by_name(by)
            .unwrap()
            .answer(&built_in(mechanism), StateId::FREE)
            .unwrap();
        assert_eq!(answer.mobility, says, "{mechanism} by {by}");
    }
    let planar = registry::by_name("count-planar").unwrap();
    assert!(planar.answer(&built_in("bennett"), StateId::FREE).is_err());
}

/// Rank of the generic rigidity matrix of bars with random end points, by elimination over a large prime: what the pebble
/// game must agree with.
fn random_bars_rank(bodies: usize, bars: &[(usize, usize)], dim: usize, seed: u64) -> usize {
    use ozols::linalg::echelon;
    use ozols::linalg::modp::Field;
    let field = Field::new((1 << 61) - 1);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut any = || field.from_i64(i64::from(random.next_u32()));
    let rows: Vec<Vec<u64>> = bars
        .iter()
        .map(|&(a, b)| {
            // Plücker coordinates of a random line: every bar is one.
            let (p, d) = ([any(), any(), any()], [any(), any(), any()]);
            let minor =
                |i: usize, j: usize| field.sub(field.mul(p[i], d[j]), field.mul(p[j], d[i]));
            let line = if dim == 6 {
                vec![d[0], d[1], d[2], minor(1, 2), minor(2, 0), minor(0, 1)]
            } else {
                vec![d[0], d[1], minor(0, 1)]
            };
            let mut row = vec![0; dim * bodies];
            for (k, &x) in line.iter().enumerate() {
                row[dim * a + k] = x;
                row[dim * b + k] = field.neg(x);
            }
            row
        })
        .collect();
    echelon::rank_of(field, rows.iter().map(Vec::as_slice))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn the_pebble_game_is_the_rank_of_random_bars(
        bodies in 2..7_usize,
        ends in prop::collection::vec((0..7_usize, 0..7_usize), 0..40),
        spatial in any::<bool>(),
        seed in any::<u64>(),
    ) {
        let bars: Vec<_> = ends
            .into_iter()
            .map(|(a, b)| (a % bodies, b % bodies))
            .filter(|(a, b)| a != b)
            .collect();
        let dim = if spatial { 6 } else { 3 };
        prop_assert_eq!(
            generic::generic_rank(bodies, &bars, dim),
            random_bars_rank(bodies, &bars, dim, seed)
        );
    }

    /// What the file says does not depend on where it is measured from.
    #[test]
    fn decisions_do_not_depend_on_the_frame(pick in any::<prop::sample::Index>(), seed in any::<u64>()) {
        let names: Vec<_> = builtin::names();
        let m = built_in(names[pick.index(names.len())]);
        prop_assume!(matches!(m.mode, Mode::Spatial) && m.name != "wren-platform");
        let before = decide_state(&m, StateId::FREE).unwrap();
        let after = decide_state(&as_measured(&m, seed, 1e-13, 1.0), StateId::FREE).unwrap();
        // Off by a thousand units of the sixteenth digit, which may leave it open.
        let rank = before.verdict.rank();
        prop_assert!((after.verdict.at_least()..=after.verdict.rank()).contains(&rank), "{} {rank}: {}", m.name, after.line);
        // Coordinates off by rounding may leave open what exact ones decide, and never say otherwise.
        prop_assert!(after.finite.could_be(i64::try_from(before.finite.mobility).unwrap()), "{:?} {:?}", before.finite, after.finite);
    }
}

/// The line that a rod spins about goes through both its balls, and through no other joint.
#[test]
fn a_rod_spins_about_the_line_of_its_balls() {
    let m = built_in("rssr");
    let found = &ozols::analyze(&m).unwrap()[0];
    let [idle] = &found.idle[..] else {
        panic!("{:?}", found.idle)
    };
    let names = |ids: &[ozols::model::mechanism::JointId]| -> Vec<String> {
        ids.iter().map(|&j| m.joints[j].id.clone()).collect()
    };
    assert_eq!(idle.links, [m.link_named("2").unwrap()]);
    assert_eq!(
        (names(&idle.through), idle.turns),
        (vec!["1-2".to_owned(), "2-3".to_owned()], true)
    );
}
