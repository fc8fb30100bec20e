//! Whole models, and loop closures from files beside them.

use crate::common::*;
use crate::robots::{ARM, folder, no_files, numeric_figures, read_model};

// Five mimic joints follow the sixth: W = 1.
#[test]
fn mimic_joints_are_couplings() {
    let i = read_model("mimic_gripper.urdf", &Options::default());
    assert_eq!(numeric_figures(&i, 1e-9), [7, 6, 0, 6, 1, 0]);
    assert_eq!(
        (i.report.coupling_rows, i.report.approximated.len()),
        (0, 0)
    );
    assert_eq!(i.mechanism.couplings.len(), 5);
    assert!(i.report.dropped.is_empty());
}

#[test]
fn nothing_moves() {
    let links: String = (0..4).map(|i| format!("<link name='l{i}'/>")).collect();
    let joint = |i: usize| {
        format!("<joint name='j{i}' type='fixed'><parent link='l0'/><child link='l{i}'/></joint>")
    };
    let joints: String = (1..4).map(joint).collect();
    let e = crate::robots::message_of(
        "mesh.urdf",
        format!("<robot name='r'>{links}{joints}</robot>"),
    );
    has(&e, "nothing can move: all 4 links");
}

fn with_loops(side: Option<&str>) -> Options {
    Options {
        loops: side.map(|s| (s.to_owned(), fs::read(folder().join(s)).unwrap())),
        ..Options::default()
    }
}

// n, p, k, f, W, σ of whole models, by hand: two planar four-bars closed by balls, σ = 1 each; five hinges and a sixth in
// parallel, σ = 3; a foot on a universal joint and two cranks with rods. tests/peers/run asks MuJoCo and Pinocchio for W and σ
// of these and of published models.
#[test]
fn figures_of_models() {
    for (path, loops, couplings, wanted) in [
        ("gripper.xml", None, 1, [7, 8, 2, 12, 1, 2]),
        (
            "five_bar.urdf",
            Some("five_bar.yaml"),
            0,
            [7, 7, 1, 6, 3, 3],
        ),
        ("leg.urdf", Some("leg.yaml"), 0, [8, 9, 2, 16, 4, 0]),
    ] {
        let i = read_model(path, &with_loops(loops));
        let found = numeric_figures(&i, 1e-9);
        assert_eq!(found, wanted, "{path}");
        assert_eq!(i.report.coupling_rows, 0, "{path}");
        assert_eq!(i.mechanism.couplings.len(), couplings, "{path}");
    }
}

// Four-bars: as drawn all links lie on one another; put together, and with the coupler cut in two and welded.
// A planar four-bar in space: W = 1, σ = 3.
#[test]
fn four_bars() {
    let together = default_with(|o: &mut Options| o.assemble = true);
    let i = read_model("four_bar_loop.sdf", &together);
    assert_eq!(numeric_figures(&i, 1e-9), [4, 4, 1, 4, 1, 3]);
    let i = read_model("four_bar_weld.sdf", &together);
    assert_eq!(numeric_figures(&i, 1e-9), [5, 5, 1, 4, 1, 3]);
    let i = read_model("four_bar_loop.sdf", &Options::default());
    assert_eq!(i.report.approximated.len(), 4);
    assert!(i.report.approximated[0].contains("`assemble`"));
    // The third is closed by a file beside it; its links are side by side, so that a revolute joint there
    // does not close, and a cylindrical one does: W = 1, σ = 2.
    let closed = |kind: &str| {
        let side =
            format!("[[loop]]\nid = \"bushing\"\na = \"near\"\nb = \"far\"\ntype = \"{kind}\"\n");
        let options = crate::robots::with_loops("side.toml", side);
        let bytes = fs::read(folder().join("four_bar_open.sdf")).unwrap();
        import("four_bar_open.sdf", &bytes, &no_files, &options)
    };
    assert_eq!(
        numeric_figures(&closed("cylindrical").unwrap(), 1e-9),
        [4, 4, 1, 5, 1, 2]
    );
    let e = closed("revolute").unwrap_err().to_string();
    has(&e, "do not close");
    has(&e, "\"bushing\" between coupler and rocker");
}

#[test]
fn side_files() {
    let with = |name: &str, side: &str| {
        let options = crate::robots::with_loops(name, side);
        import("arm.urdf", ARM.as_bytes(), &no_files, &options)
    };
    let i = with(
        "s.toml",
        "[[loop]]\na = \"base\"\nb = \"tip\"\npoint_a = [-0.2, 0.1, 1]\ntype = \"revolute\"\n",
    )
    .unwrap();
    // Two hinges and a slide at rest between them: rigid, σ = 3 as in any planar triangle.
    assert_eq!(numeric_figures(&i, 1e-9), [3, 3, 1, 3, 0, 3]);
    let bomb = "a: &a [x,x,x,x,x,x,x,x,x]\nb: &b [*a,*a,*a,*a,*a,*a,*a,*a,*a]\nc: &c [*b,*b,*b,*b,*b,*b,*b,*b,*b]\nd: &d [*c,*c,*c,*c,*c,*c,*c,*c,*c]\ne: &e [*d,*d,*d,*d,*d,*d,*d,*d,*d]\nf: &f [*e,*e,*e,*e,*e,*e,*e,*e,*e]\ng: &g [*f,*f,*f,*f,*f,*f,*f,*f,*f]\nh: [*g,*g,*g,*g,*g,*g,*g,*g,*g]\n";
    for (name, side, words) in [
        ("s.txt", "", "the ending is unknown"),
        ("s.yaml", "x: 1", "no loops found"),
        ("s.yaml", "closed_loop: [[p, nowhere]]", "\"nowhere\""),
        (
            "s.yaml",
            "closed_loop: [[p]]",
            "closed_loop: invalid length",
        ),
        ("s.yaml", "closed_loop: [[p, p]]", "to itself"),
        ("s.yaml", "closed_loop: [[base, tip]]\ntype: [5d]", "\"5d\""),
        ("s.yaml", bomb, "s.yaml"),
        ("s.json", "[{}]", "ball-1: missing field `a`"),
        ("s.json", "{", "s.json"),
        (
            "s.toml",
            "[[loop]]\na = \"base\"\n",
            "loop-1: missing field `b`",
        ),
        (
            "s.toml",
            "[[loop]]\na = \"base\"\nb = \"tip\"\nx = 1\n",
            "unknown field `x`",
        ),
        (
            "s.toml",
            "[[loop]]\na = \"base\"\nb = \"tip\"\npoint_a = [nan, 0, 0]\n",
            "three finite",
        ),
        (
            "s.toml",
            "[[loop]]\na = \"base\"\nb = \"tip\"\naxis_b = [0, 0, 0]\n",
            "an axis is zero",
        ),
        ("s.yaml", &("[".repeat(100_000)), "s.yaml"),
    ] {
        let e = with(name, side).unwrap_err().to_string();
        assert!(e.contains(words), "{words}: {e}");
    }
}
