//! Where a sweep looks, and what counts as a load.

use super::{LOADED, sweep};
use ozols::file::text::mechanism_from_str;
use ozols::geom::expr::Expr;
use ozols::model::loads::MassProperties;
use ozols::sweep::SweepRequest;
use ozols::sweep::forces::is_loaded;
use ozols::sweep::space::Sampling;

fn nothing_more() -> SweepRequest {
    SweepRequest {
        search: None,
        top: 0,
        stroke: None,
        methods: false,
        as_written: false,
    }
}

/// Each parameter has a sequence of its own: two of one range do not go together.
#[test]
fn parameters_of_one_range_are_drawn_apart() {
    let text = LOADED.replacen(
        "rod = 96",
        "rod = 96\nz = { range = [20, 40], default = 30 }",
        1,
    );
    let text = text.replacen(
        "[[joint]]",
        "[[point]]\nid = \"p\"\nlink = \"1\"\npoint = [0, 0, \"z\"]\n[[joint]]",
        1,
    );
    let sampling = Sampling::Sobol { count: 64, seed: 7 };
    let space = sweep(&text, sampling, nothing_more()).space;
    let pairs: Vec<[f64; 2]> = (0..64)
        .map(|n| {
            let values = space.sample(n).values;
            ["x", "z"].map(|k| values[k].to_f64())
        })
        .collect();
    // Of four quarters each has its share.
    for low in [[true, true], [true, false], [false, true], [false, false]] {
        let here = |p: &&[f64; 2]| [p[0] < 30.0, p[1] < 30.0] == low;
        let n = pairs.iter().filter(here).count();
        assert!((12..=20).contains(&n), "{low:?}: {n}");
    }
}

/// A mass is no load where nothing pulls or moves it.
#[test]
fn masses_load_where_they_are_pulled_or_moved() {
    let mut m = crate::common::built_in("four-bar");
    m.loads = Default::default();
    assert!(!is_loaded(&m));
    let last = m.links.len() - 1;
    m.links[ozols::model::mechanism::LinkId::new(last)].mass = Some(MassProperties {
        mass: 1.0,
        centre: [0, 0, 0].map(Expr::from),
        inertia: None,
    });
    assert!(!is_loaded(&m));
    let mut pulled = m.clone();
    pulled.loads.gravity = Some([0, 0, -10].map(Expr::from));
    assert!(is_loaded(&pulled));
    m.loads.drive_speeds = vec![0.0];
    assert!(!is_loaded(&m));
    m.loads.drive_speeds = vec![2.0];
    assert!(is_loaded(&m));
}

/// A range without a default is looked at in its middle where nothing is swept.
#[test]
fn a_range_without_a_default_stands_in_its_middle() {
    let at = |default: &str| {
        let text = LOADED.replacen(", default = 30 }", default, 1);
        let m = mechanism_from_str("swept.toml", &text).unwrap();
        let pin = m.joint("1-2").unwrap();
        m.joints[pin].frame.point[0].to_f64()
    };
    assert_eq!([at(" }"), at(", default = 24 }")], [30.0, 24.0]);
}
