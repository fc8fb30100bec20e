//! Poses of small mechanisms, by hand: screws, couplings, paths, ways and what a plane leaves out.

use crate::common::*;
use ozols::geom::extent::Extent;
use ozols::motion::drive_range::{Way, follow_range};
use ozols::motion::jaws::jaws_meet;

/// A nut of 10 mm lead goes 10 mm a turn, whatever the size of what it belongs to.
#[test]
fn a_screw_goes_its_lead_in_a_turn() {
    let m = read(
        "name = \"jack\"\nlength_unit = \"mm\"\nlink = [{ id = \"0\", role = \"frame\" }, { id = \"1\" }, { id = \"2\", role = \"output\" }]\n\
        [[joint]]\nid = \"s\"\nlinks = [\"0\", \"1\"]\ntype = \"helical\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\nlead = 10\ndrive = true\n\
        [[joint]]\nid = \"h\"\nlinks = [\"1\", \"2\"]\ntype = \"revolute\"\npoint = [300, 0, 400]\naxis = [1, 0, 0]\n",
    );
    let pose = Pose::of_file(&m, StateId::FREE).unwrap();
    assert!(pose.length > 100.0);
    let there = pose.moved_to(&[TAU, 0.0]);
    let nut = m.joints[m.joint_named("s").unwrap()].links[1];
    let at = pose.carry_point(&there.links, nut, [20.0, 0.0, 5.0]);
    assert_all_nine_digits(at, [20.0, 0.0, 15.0]);
}

/// Two hinges geared to each other: once out of step they stay so, however often they are moved.
#[test]
fn couplings_remember_what_has_moved() {
    let m = read(
        "name = \"gears\"\nlink = [{ id = \"0\", role = \"frame\" }, { id = \"1\" }, { id = \"2\", role = \"output\" }]\n\
        [[joint]]\nid = \"a\"\nlinks = [\"0\", \"1\"]\ntype = \"revolute\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n\
        [[joint]]\nid = \"b\"\nlinks = [\"0\", \"2\"]\ntype = \"revolute\"\npoint = [3, 0, 0]\naxis = [0, 0, 1]\n\
        [[coupling]]\njoints = [\"a\", \"b\"]\nratio = -2\n",
    );
    let pose = Pose::of_file(&m, StateId::FREE).unwrap();
    let open = pose.closure_gaps(&[0.1, 0.0]);
    assert_eq!(open.len(), 1);
    assert!(open[0].abs() > 0.01);
    let there = pose.moved_to(&[0.1, 0.0]);
    assert_nine_digits(there.closure_gaps(&[0.0, 0.0])[0], open[0]);
    assert_nine_digits(
        there.moved_to(&[-0.1, 0.0]).closure_gaps(&[0.0, 0.0])[0],
        0.0,
    );
}

/// A link behind a joint that is named from it to the frame moves by the other sign.
#[test]
fn paths_pass_joints_either_way() {
    let m = built_in("four-bar");
    let pose = Pose::of_file(&m, StateId::FREE).unwrap();
    let joint = pose.columns[0].joint;
    let rows = |forward: bool| {
        let all = pose.jacobian_with(&[vec![(joint, forward)]], &[]);
        let first = pose.rows();
        (0..6).map(|i| all[(first + i, 0)]).collect_vec()
    };
    let (there, back) = (rows(true), rows(false));
    assert!(there.iter().any(|x| x.abs() > 0.1));
    for (a, b) in there.iter().zip(&back) {
        assert_nine_digits(*a, -b);
    }
}

/// A way counts from the pose of the file, to either side alike.
#[test]
fn ways_count_from_the_files_pose() {
    let m = built_in("four-bar");
    let pose = Pose::of_file(&m, StateId::FREE).unwrap();
    let way = follow_range(&pose, 0, &[], Some([-0.3, 0.3]), 20);
    assert!(way.start > 0);
    assert_nine_digits(way.at[way.start], 0.0);
    assert!(way.at.windows(2).all(|w| w[0] < w[1]));
    assert!(way.at[0] < 0.0);
}

/// Two jaws 2 m apart go towards each other by 0.4 m each a step: between the second and the third they meet.
#[test]
fn jaws_meet_between_poses() {
    let m = read(
        "name = \"jaws\"\nlength_unit = \"m\"\nlink = [{ id = \"0\", role = \"frame\" }, { id = \"a\", role = \"output\" }, { id = \"b\", role = \"output\" }]\n\
        [[joint]]\nid = \"x\"\nlinks = [\"0\", \"a\"]\ntype = \"prismatic\"\npoint = [-1, 0, 0]\naxis = [1, 0, 0]\ndrive = true\n\
        [[joint]]\nid = \"y\"\nlinks = [\"0\", \"b\"]\ntype = \"prismatic\"\npoint = [1, 0, 0]\naxis = [1, 0, 0]\n\
        [[point]]\nid = \"p\"\nlink = \"a\"\npoint = [-1, 0, 0]\n[[point]]\nid = \"q\"\nlink = \"b\"\npoint = [1, 0, 0]\n",
    );
    let pose = Pose::of_file(&m, StateId::FREE).unwrap();
    let step = |k: f64| {
        let by = 0.4 * k / pose.length;
        let mut links = pose.links.clone();
        for (id, sign) in [("a", 1.0), ("b", -1.0)] {
            let link = m.links_with_ids().find(|(_, l)| l.id == id).unwrap().0;
            links[link.index()] = RigidMotion::from_translation([sign * by, 0.0, 0.0]);
        }
        links
    };
    let way = Way {
        at: vec![0.0, 1.0, 2.0, 3.0, 4.0],
        links: (0..5).map(|k| step(f64::from(k))).collect(),
        start: 0,
        closed: false,
        ends: [None, None],
    };
    let [back, on] = jaws_meet(&m, StateId::FREE, &pose, &way);
    assert_eq!(back, None);
    assert_nine_digits(on.unwrap(), 2.5);
    // Where the last pose is the first again, the same are behind it, a whole turn back.
    let way = Way {
        closed: true,
        ..way
    };
    let [back, _] = jaws_meet(&m, StateId::FREE, &pose, &way);
    assert!(back.is_none_or(|at| at < 0.0), "{back:?}");
}

/// A ball in a plane turns about the normal alone: two freedoms are told to be left out.
#[test]
fn what_a_plane_leaves_out_is_told() {
    let m = read(
        "name = \"flat\"\nmode = \"planar\"\nlink = [{ id = \"0\", role = \"frame\" }, { id = \"1\", role = \"output\" }]\n\
        [[joint]]\nid = \"a\"\nlinks = [\"0\", \"1\"]\ntype = \"revolute\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n\
        [[joint]]\nid = \"b\"\nlinks = [\"0\", \"1\"]\ntype = \"spherical\"\npoint = [1, 0, 0]\n",
    );
    let closure = Closure::new(&Reals, &m, StateId::FREE).unwrap();
    assert_eq!(closure.left_out, [(JointId::new(1), 2)]);
    let frames = m.joints.iter().flat_map(|j| &j.frame.point);
    let exact = ExactField::for_expressions(frames, 0).unwrap();
    let closure = Closure::new(&exact, &m, StateId::FREE).unwrap();
    assert_eq!(closure.left_out, [(JointId::new(1), 2)]);
}

#[test]
fn an_extent_is_half_a_diagonal_about_the_middle() {
    let e = Extent::from_points(&[[1.0, 2.0, 3.0], [3.0, 6.0, 5.0], [2.0, 3.0, 4.0]]);
    assert_eq!(e.middle, [2.0, 4.0, 4.0]);
    assert_nine_digits(e.length, 6f64.sqrt());
}

/// A crane of metres turned by a quarter: what stood on its boom along x stands along y, and what slides there slides along y.
#[test]
fn a_mechanism_is_written_anew_where_it_has_gone() {
    let m = read(
        "name = \"crane\"\nlength_unit = \"mm\"\nlink = [{ id = \"0\", role = \"frame\" }, { id = \"1\" }, { id = \"2\", role = \"output\" }]\n\
        [[joint]]\nid = \"turn\"\nlinks = [\"0\", \"1\"]\ntype = \"revolute\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\ndrive = true\n\
        [[joint]]\nid = \"run\"\nlinks = [\"1\", \"2\"]\ntype = \"prismatic\"\npoint = [3000, 0, 2000]\naxis = [1, 0, 0]\n",
    );
    let pose = Pose::of_file(&m, StateId::FREE).unwrap();
    let there = pose.moved_to(&[TAU / 4.0, 0.1]);
    let anew = ozols::motion::move_mechanism(&m, &there).unwrap();
    let frame = &anew.joints[anew.joint_named("run").unwrap()].frame;
    let slid = 0.1 * pose.length;
    assert_all_nine_digits(to_vector(&frame.point), [0.0, 3000.0 + slid, 2000.0]);
    assert_all_nine_digits(to_vector(&frame.axis), [0.0, 1.0, 0.0]);
    let still = &anew.joints[anew.joint_named("turn").unwrap()].frame;
    assert_all_nine_digits(to_vector(&still.point), [0.0; 3]);
}

/// A pin stands on the first of its links and its slot in the second: where it slides, it stays on the first.
#[test]
fn a_pin_stays_on_its_link() {
    let m = read(
        "name = \"pin\"\nlength_unit = \"mm\"\nlink = [{ id = \"0\", role = \"frame\" }, { id = \"1\" }, { id = \"2\", role = \"output\" }]\n\
        [[joint]]\nid = \"turn\"\nlinks = [\"0\", \"1\"]\ntype = \"revolute\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\ndrive = true\n\
        [[joint]]\nid = \"pin\"\nlinks = [\"1\", \"2\"]\ntype = \"slotted\"\npoint = [3000, 0, 500]\naxis = [0, 0, 1]\nreference = [1, 0, 0]\n",
    );
    let pose = Pose::of_file(&m, StateId::FREE).unwrap();
    let columns = pose.columns.iter();
    let q: Vec<f64> = columns
        .map(|c| match (c.joint.index(), c.freedom.is_slide()) {
            (0, _) => TAU / 4.0,
            (_, true) => 0.1,
            (_, false) => 0.0,
        })
        .collect();
    let anew = ozols::motion::move_mechanism(&m, &pose.moved_to(&q)).unwrap();
    let frame = &anew.joints[anew.joint_named("pin").unwrap()].frame;
    assert_all_nine_digits(to_vector(&frame.point), [0.0, 3000.0, 500.0]);
}

/// A link between two guides in a line slides between them alone, one between two hinges in a line turns.
#[test]
fn idle_motions_slide_or_turn() {
    for (kind, turns) in [("prismatic", false), ("revolute", true)] {
        let m = read(&format!(
            "name = \"idle\"\nlink = [{{ id = \"0\", role = \"frame\" }}, {{ id = \"1\" }}, {{ id = \"2\", role = \"output\" }}]\n\
            [[joint]]\nid = \"a\"\nlinks = [\"0\", \"1\"]\ntype = \"{kind}\"\npoint = [0, 0, 0]\naxis = [1, 0, 0]\n\
            [[joint]]\nid = \"b\"\nlinks = [\"1\", \"2\"]\ntype = \"{kind}\"\npoint = [2, 0, 0]\naxis = [1, 0, 0]\n\
            [[joint]]\nid = \"c\"\nlinks = [\"2\", \"0\"]\ntype = \"fixed\"\npoint = [3, 0, 0]\n"
        ));
        let found = analyse_states(&m, &[StateId::FREE], Method::Modular).unwrap();
        let idle = &found[0].idle;
        assert_eq!((idle.len(), idle[0].links.len()), (1, 1), "{kind}");
        assert_eq!(idle[0].turns, turns, "{kind}");
    }
}

/// A contour that is open by more gapes more, a quarter turn and beyond.
#[test]
fn gaps_grow_beyond_a_quarter_turn() {
    let m = built_in("door-two-hinges");
    let pose = Pose::of_file(&m, StateId::FREE).unwrap();
    let gap = |degrees: f64| {
        let gaps = pose.closure_gaps(&[degrees.to_radians(), 0.0]);
        gaps.iter().map(|x| x * x).sum::<f64>().sqrt()
    };
    let all: Vec<f64> = (0..=12).map(|i| gap(10.0 * f64::from(i))).collect();
    assert!(
        all[0] < 1e-12 && all.windows(2).all(|w| w[0] < w[1]),
        "{all:?}"
    );
}
