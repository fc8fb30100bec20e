//! The unit of length says nothing: all lengths times a power of ten, and every word of the analysis stays.

use crate::common::*;

/// A length that is written with `exponent` zeros more.
fn times(e: &Expr, exponent: i32) -> Expr {
    let by: Expr = format!("1e{exponent}").parse().unwrap();
    e.scaled_as_written(e * &by, by.to_f64())
}

/// The mechanism with all lengths times a power of ten.
fn scaled(m: &Mechanism, exponent: i32) -> Mechanism {
    let mut out = m.clone();
    let frame = |f: &mut Frame| {
        f.point = f.point.each_ref().map(|x| times(x, exponent));
        f.pitch = times(&f.pitch, exponent);
    };
    for joint in &mut out.edit().joints {
        frame(&mut joint.frame);
        joint.options.iter_mut().for_each(|o| frame(&mut o.frame));
        joint.unloading.iter_mut().for_each(|o| frame(&mut o.frame));
    }
    for coupling in &mut out.edit().couplings {
        coupling.ratio = match coupling.ends.map(|e| e.freedom.is_slide()) {
            [false, true] => times(&coupling.ratio, exponent),
            [true, false] => times(&coupling.ratio, -exponent),
            _ => continue,
        };
    }
    out
}

/// What an analysis says, without its numbers of doubles.
fn said(m: &Mechanism) -> Vec<String> {
    let states: Vec<StateId> = m.state_ids().collect();
    let of = |s: &ozols::redundancy::analysis::StateAnalysis| {
        let choice: String = s
            .choice
            .iter()
            .flat_map(|c| c.chars())
            .filter(|c| !"0123456789.-e".contains(*c))
            .collect();
        let shares: Vec<_> = s.per_contour.iter().map(|c| c.redundant).collect();
        format!(
            "{} {} {} {} {:?} {} {} {shares:?} {choice}",
            s.mobility,
            s.redundant,
            s.working_mobility,
            s.local_mobility,
            s.at_most(),
            s.finite.format_figure(),
            s.finite.describe(),
        )
    };
    match analyse_states(m, &states, Method::Auto) {
        Ok(found) => found.iter().map(of).collect(),
        Err(e) => vec![e.to_string()],
    }
}

#[test]
fn no_built_in_mechanism_depends_on_its_unit_of_length() {
    for name in ozols::builtin::names() {
        // Specifications of a catalogue are no mechanisms.
        let Ok(m) = ozols::built_in(name) else {
            continue;
        };
        let own = said(&m);
        for exponent in [-6, 1] {
            assert_eq!(
                own,
                said(&scaled(&m, exponent)),
                "{name} times 1e{exponent}"
            );
        }
    }
}

/// A plate on parallel legs of one length with a ball at each end: poses of such plates are singular, and are followed.
fn plate() -> impl Strategy<Value = String> {
    let foot = (-12i32..13, -12i32..13);
    let feet = prop::collection::btree_set(foot, 3..7);
    (feet, 5i32..25, -9i32..10).prop_map(|(feet, height, lean)| {
        let (mut links, mut joints) = ("f p*".to_owned(), String::new());
        for (i, (x, y)) in feet.iter().enumerate() {
            links += &format!(" l{i}");
            joints += &format!("a{i} | f l{i} | spherical | {x}, {y}, 0\n");
            joints += &format!("b{i} | l{i} p | spherical | {}, {y}, {height}\n", x + lean);
        }
        write_mechanism("name = \"plate\"", &links, &joints)
    })
}

proptest! {
    #![proptest_config(crate::fuzz::runs(8))]
    #[test]
    fn plates_on_legs_do_not_depend_on_their_unit_of_length(text in plate(), exponent in -6i32..7) {
        let m = read(&text);
        prop_assert_eq!(said(&m), said(&scaled(&m, exponent)));
    }
}
