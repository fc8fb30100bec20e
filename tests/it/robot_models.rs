//! Real models against the figures of other engines, and loop closures from files beside them.

use crate::common::ozols;
use crate::robots::{ARM, figures, folder, model, none, refused};
use ozols::robots::{Options, import};

// Five mimic joints follow the sixth: W = 6 of the tree of joints alone, 1 with the couplings.
#[test]
fn mimic_joints_are_couplings() {
    let i = model(
        "robotiq_ros_urdf/robotiq_arg2f_85_model.expanded.urdf",
        &Options::default(),
    );
    assert_eq!(figures(&i, 1e-9), [7, 6, 0, 6, 1, 0]);
    assert_eq!(
        (i.report.coupling_rows, i.report.approximated.len()),
        (0, 0)
    );
    let kept = i.report.kept.unwrap();
    assert_eq!((kept.couplings, kept.mobility), (5, Some((6, 1))));
    assert!(
        i.report
            .text("x.urdf")
            .contains("5 couplings of joints: W = 6 without, 1 with")
    );
    assert!(i.toml().unwrap().contains("# mimics finger_joint times 1"));
    assert_eq!(i.report.dropped["visual"].0, 11);
}

#[test]
fn nothing_moves() {
    let path = folder().join("robotiq_ros_urdf/robotiq-3f-gripper_mesh.expanded.urdf");
    let e = refused("mesh.urdf", &std::fs::read_to_string(path).unwrap());
    assert!(e.contains("nothing can move: all 4 links"), "{e}");
}

// The models of ../shared/models against the peers' figures there: MuJoCo 4.0 and Pinocchio 4.1 on the same files.
//
// A peer counts rows of the constraints that cut the loops; ozols counts 6 for each contour and gives the cutting joint
// its freedoms, so that σ is the same. A coupling of joint angles is a row of theirs and of ours, so that W is the same
// too; the report also has W without the couplings, which is higher by their number where none of them is redundant.
struct Peer {
    path: &'static str,
    loops: Option<&'static str>,
    tolerance: f64,
    /// Couplings between joint angles.
    couplings: usize,
    /// Velocities, rows, rank.
    peer: [i64; 3],
    /// n, p, k, f, W, σ.
    ours: [i64; 6],
}

/// A model whose loops stand in a file beside it, with exact coordinates and no couplings.
const fn beside(path: &'static str, loops: &'static str, peer: [i64; 3], ours: [i64; 6]) -> Peer {
    Peer {
        path,
        loops: Some(loops),
        tolerance: 1e-9,
        couplings: 0,
        peer,
        ours,
    }
}

const PEERS: [Peer; 8] = [
    Peer {
        path: "robotiq_2f85_v4/2f85.nomesh.xml",
        loops: None,
        tolerance: 1e-9,
        couplings: 1,
        peer: [6, 7, 5],
        ours: [7, 8, 2, 12, 1, 2],
    },
    Peer {
        path: "xarm7_hand/hand.nomesh.xml",
        loops: None,
        tolerance: 1e-9,
        couplings: 1,
        peer: [6, 7, 5],
        ours: [7, 8, 2, 12, 1, 2],
    },
    // Its coordinates are rounded to 1e-8 m: the peer's dropped singular values reach 2.9e-8.
    Peer {
        path: "toddlerbot_2xc/toddlerbot_2xc.nomesh.xml",
        loops: None,
        tolerance: 1e-6,
        couplings: 9,
        peer: [50, 21, 12],
        ours: [46, 49, 4, 62, 38, 9],
    },
    beside(
        "epr_5bar_linkage/robot.urdf",
        "epr_5bar_linkage/robot.yaml",
        [6, 6, 3],
        [7, 7, 1, 6, 3, 3],
    ),
    beside(
        "epr_5bar_linkage_iso6d/robot.urdf",
        "epr_5bar_linkage_iso6d/robot.yaml",
        [8, 6, 6],
        [9, 9, 1, 8, 2, 0],
    ),
    beside(
        "epr_digit_like/robot.urdf",
        "epr_digit_like/robot.yaml",
        [27, 18, 18],
        [28, 30, 3, 27, 9, 0],
    ),
    beside(
        "epr_talos_like/robot.urdf",
        "epr_talos_like/robot.yaml",
        [13, 6, 6],
        [14, 14, 1, 13, 7, 0],
    ),
    // The peer's figures are of an open pose (residual 0.9 m); at the closed pose found here they are the same.
    beside(
        "drake_strandbeest/strandbeest_nomesh.urdf",
        "drake_strandbeest/strandbeest_ball_constraints.json",
        [73, 108, 72],
        [74, 109, 36, 181, 1, 36],
    ),
];

fn with_loops(side: Option<&str>) -> Options {
    Options {
        loops: side.map(|s| (s.to_owned(), std::fs::read(folder().join(s)).unwrap())),
        ..Options::default()
    }
}

#[test]
fn peers() {
    for p in &PEERS {
        let i = model(p.path, &with_loops(p.loops));
        let found = figures(&i, p.tolerance);
        assert_eq!(found, p.ours, "{}", p.path);
        assert_eq!(i.report.coupling_rows, 0, "{}", p.path);
        let ([nv, rows, rank], [.., w, sigma]) = (p.peer, found);
        assert_eq!((w, sigma), (nv - rank, rows - rank), "{}", p.path);
        let kept = i.report.kept.map(|k| (k.couplings, k.mobility.unwrap()));
        let both = |w: usize| (p.couplings, (w + p.couplings, w));
        let wanted = (p.couplings > 0).then(|| both(usize::try_from(w).unwrap()));
        assert_eq!(kept, wanted, "{}", p.path);
    }
}

// Drake's four-bars: as drawn all links lie on one another; put together, and with the coupler cut in two and welded.
// A planar four-bar in space: W = 1, σ = 3.
#[test]
fn four_bars() {
    let together = Options {
        assemble: true,
        ..Options::default()
    };
    let i = model("drake_four_bar/four_bar_loop.sdf", &together);
    assert_eq!(figures(&i, 1e-9), [4, 4, 1, 4, 1, 3]);
    let i = model("drake_four_bar/four_bar_weld.sdf", &together);
    assert_eq!(figures(&i, 1e-9), [5, 5, 1, 4, 1, 3]);
    let i = model("drake_four_bar/four_bar_loop.sdf", &Options::default());
    assert_eq!(i.report.approximated.len(), 4);
    assert!(i.report.approximated[0].what.contains("--assemble"));
    // The third is closed by a bushing in Drake's code; its links are side by side, so that a revolute joint there
    // does not close, and a cylindrical one does: W = 1, σ = 2.
    let closed = |kind: &str| {
        let side = format!(
            "[[loop]]\nid = \"bushing\"\na = \"Bc_bushing\"\nb = \"Cb_bushing\"\ntype = \"{kind}\"\n"
        );
        let options = Options {
            loops: Some(("side.toml".to_owned(), side.into_bytes())),
            ..Options::default()
        };
        let bytes = std::fs::read(folder().join("drake_four_bar/four_bar.sdf")).unwrap();
        import("four_bar.sdf", &bytes, &none, &options)
    };
    assert_eq!(
        figures(&closed("cylindrical").unwrap(), 1e-9),
        [4, 4, 1, 5, 1, 2]
    );
    let e = closed("revolute").unwrap_err().to_string();
    assert!(
        e.contains("do not close") && e.contains("\"bushing\" between B and C"),
        "{e}"
    );
}

#[test]
fn side_files() {
    let with = |name: &str, side: &str| {
        let options = Options {
            loops: Some((name.to_owned(), side.as_bytes().to_vec())),
            ..Options::default()
        };
        import("arm.urdf", ARM.as_bytes(), &none, &options)
    };
    let i = with(
        "s.toml",
        "[[loop]]\na = \"base\"\nb = \"tip\"\npoint_a = [-0.2, 0.1, 1]\ntype = \"revolute\"\n",
    )
    .unwrap();
    // Two hinges and a slide at rest between them: rigid, σ = 3 as in any planar triangle.
    assert_eq!(figures(&i, 1e-9), [3, 3, 1, 3, 0, 3]);
    let bomb = "a: &a [x,x,x,x,x,x,x,x,x]\nb: &b [*a,*a,*a,*a,*a,*a,*a,*a,*a]\nc: &c [*b,*b,*b,*b,*b,*b,*b,*b,*b]\nd: &d [*c,*c,*c,*c,*c,*c,*c,*c,*c]\ne: &e [*d,*d,*d,*d,*d,*d,*d,*d,*d]\nf: &f [*e,*e,*e,*e,*e,*e,*e,*e,*e]\ng: &g [*f,*f,*f,*f,*f,*f,*f,*f,*f]\nh: [*g,*g,*g,*g,*g,*g,*g,*g,*g]\n";
    for (name, side, words) in [
        ("s.txt", "", "the ending is unknown"),
        ("s.yaml", "x: 1", "no loops found"),
        ("s.yaml", "closed_loop: [[p, nowhere]]", "\"nowhere\""),
        ("s.yaml", "closed_loop: [[p]]", "not a pair"),
        ("s.yaml", "closed_loop: [[p, p]]", "to itself"),
        ("s.yaml", "closed_loop: [[base, tip]]\ntype: [5d]", "\"5d\""),
        ("s.yaml", bomb, "s.yaml"),
        ("s.json", "[{}]", "body_A"),
        ("s.json", "{", "s.json"),
        ("s.toml", "[[loop]]\na = \"base\"\n", "b of loop-1"),
        (
            "s.toml",
            "[[loop]]\na = \"base\"\nb = \"tip\"\nx = 1\n",
            "unknown key x",
        ),
        (
            "s.toml",
            "[[loop]]\na = \"base\"\nb = \"tip\"\npoint_a = [nan, 0, 0]\n",
            "point_a",
        ),
        (
            "s.toml",
            "[[loop]]\na = \"base\"\nb = \"tip\"\naxis_b = [0, 0, 0]\n",
            "axis_b",
        ),
        ("s.yaml", &("[".repeat(100_000)), "s.yaml"),
    ] {
        let e = with(name, side).unwrap_err().to_string();
        assert!(e.contains(words), "{words}: {e}");
    }
}

// A description stands wherever a FILE does; what is not exact is said on standard error.
#[test]
fn descriptions_as_files() {
    let file = folder().join("robotiq_2f85_v4/2f85.nomesh.xml");
    let o = ozols(&[
        "analyze",
        file.to_str().unwrap(),
        "--method",
        "svd",
        "--format",
        "json",
    ])
    .output()
    .unwrap();
    assert_eq!(o.status.code(), Some(0));
    assert!(!String::from_utf8(o.stderr).unwrap().contains("coupling"));
    let v: serde_json::Value = serde_json::from_slice(&o.stdout).unwrap();
    assert_eq!(
        (&v["states"][0]["redundant"], &v["states"][0]["mobility"]),
        (&2.into(), &1.into())
    );
}
