//! Well-known schemes laid out by hand, against force curves that were published with them (`tests/data/forces.json`).

use super::number;
use crate::common::*;
use ozols::synthesis::figures::LayoutFigures;
use ozols::synthesis::layout::{Layout, most_symmetric};
use ozols::synthesis::place::direction::WholeDirection;
use ozols::synthesis::places::{Places, Teeth};
use ozols::synthesis::rules::Rules;
use ozols::synthesis::sketch::Sketch;
use ozols::synthesis::stroke::judge::Judge;

/// The task of `forces.json`: tips 30 mm apart when closed, each opens by 10 mm. They are drawn closed.
fn published_task() -> Task {
    default_with(|t: &mut Task| (t.narrowest, t.widest) = (29.999, 50.0))
}

/// Tips are drawn so much farther ahead than there, in mm.
const AHEAD: f64 = 20.0;

/// A scheme laid out by hand: joints by the links' names in `classics.toml`.
struct ByHand {
    paired: Structure,
    rules: Rules,
    at: Places,
}

impl ByHand {
    fn new(id: &str) -> ByHand {
        let classic = known_classics().iter().find(|c| c.id == id).unwrap();
        let paired = most_symmetric(&classic.structure).unwrap();
        let lay = paired.symmetry_lays().swap_remove(0);
        let rules = Rules::new(&paired, &lay).unwrap();
        let count = rules.joints.len();
        let half = 15.0;
        let mut points = vec![[0.0; 2]; count];
        points.extend([[120.0, half], [120.0, -half]]);
        let at = Places {
            points,
            along: vec![WholeDirection::AHEAD; count],
            pinned: rules.joints.iter().map(|j| j.links[0]).collect(),
            teeth: vec![Teeth::Gears([1, 1]); count],
        };
        ByHand { paired, rules, at }
    }

    /// The joint of two links; links are told by what they do.
    fn joint(&self, a: usize, b: usize) -> usize {
        let links = [a.min(b), a.max(b)];
        self.rules
            .joints
            .iter()
            .position(|j| j.links == links)
            .unwrap()
    }

    /// The link between two that are not joined.
    fn between(&self, a: usize, b: usize) -> usize {
        let chain = &self.paired.structure.chain;
        let both =
            |l: &usize| chain.pair_between(*l, a).is_some() && chain.pair_between(*l, b).is_some();
        (0..chain.links()).find(both).unwrap()
    }

    /// Puts a joint in a place, its image where that belongs.
    fn put(&mut self, joint: usize, [x, y]: [f64; 2]) {
        let image = self.rules.image_pairs().find(|i| i.1 == joint);
        let (joint, y) = image.map_or((joint, y), |(of, _)| (of, -y));
        self.at.points[joint] = [x + AHEAD, y];
    }

    fn turn(&mut self, joint: usize, along: WholeDirection) {
        let image = self.rules.image_pairs().find(|i| i.1 == joint);
        let (joint, along) = image.map_or((joint, along), |(of, _)| (of, along.mirror_x()));
        self.at.along[joint] = along;
    }

    fn figures(mut self) -> LayoutFigures {
        self.rules.settle_joints(&mut self.at);
        let limits = default_with(|l: &mut Limits| l.task = published_task());
        let sketch = Sketch::new(&self.paired, self.rules.clone(), limits);
        let layout = Layout {
            looks: Judge::new(&sketch).drawn_figures(&self.at).unwrap(),
            rules: self.rules,
            at: self.at,
            limits,
            start: 0,
        };
        layout_figures(&self.paired, &layout).unwrap()
    }
}

/// Force curves of `forces.json`, from closed to open in eleven steps.
#[test]
fn forces_are_those_published_for_four_schemes() {
    let told: Value = serde_json::from_str(&read_data("forces.json")).unwrap();
    let check = |id: &str, f: LayoutFigures| {
        let scheme = &told[id];
        let curve = scheme["closed_to_open"].as_array().unwrap().iter();
        let curve: Vec<f64> = curve.map(|q| q.as_f64().unwrap()).collect();
        let least = curve.iter().copied().fold(f64::INFINITY, f64::min);
        let most = curve.iter().copied().fold(0.0, f64::max);
        let near = |told: f64, found: f64, what: &str| {
            assert!(
                (found / told - 1.0).abs() < 1e-3,
                "{id}: {what}: told {told}, found {found}"
            );
        };
        near(
            least.min(scheme["least"].as_f64().unwrap()),
            f.force[0],
            "least",
        );
        near(most, f.force[2], "greatest");
        near(scheme["mean"].as_f64().unwrap(), f.force[1], "mean");
        near(scheme["stroke"].as_f64().unwrap(), f.travel, "travel");
    };
    let size = |id: &str, key: &str| number(&told[id]["layout"], key);

    let id = "piston-links-angular";
    let mut g = ByHand::new(id);
    let roles = g.paired.structure.roles.clone();
    let (f, j, driver) = (roles.frame, roles.jaws[0], roles.drive_links()[1]);
    let rod = g.between(driver, j);
    g.put(g.joint(f, j), [size(id, "hinge_x"), size(id, "hinge_y")]);
    g.put(g.joint(rod, j), [size(id, "tail_x"), size(id, "tail_y")]);
    g.put(
        g.joint(rod, driver),
        [size(id, "piston_x"), size(id, "piston_y")],
    );
    check(id, g.figures());

    let id = "toggle-sliding-jaws";
    let mut g = ByHand::new(id);
    let roles = g.paired.structure.roles.clone();
    let (f, j, driver) = (roles.frame, roles.jaws[0], roles.drive_links()[1]);
    let rod = g.between(driver, j);
    g.turn(g.joint(f, j), WholeDirection::ACROSS);
    g.put(g.joint(f, j), [60.0, 10.0]);
    let u = size(id, "u_closed");
    g.put(g.joint(rod, j), [50.0, size(id, "jaw_pin_y_closed")]);
    g.put(g.joint(rod, driver), [50.0 - u, size(id, "piston_pin_y")]);
    check(id, g.figures());

    let id = "cylinder-between-jaws-gears";
    let mut g = ByHand::new(id);
    let roles = g.paired.structure.roles.clone();
    let (frame, jaw, [u, v]) = (roles.frame, roles.jaws[0], roles.input);
    let chain = &g.paired.structure.chain;
    let cylinder = if chain.pair_between(u, jaw).is_some() {
        u
    } else {
        v
    };
    g.put(
        g.joint(frame, jaw),
        [size(id, "hinge_x"), size(id, "hinge_y")],
    );
    g.put(
        g.joint(cylinder, jaw),
        [size(id, "tail_x"), size(id, "tail_y")],
    );
    g.put(g.joint(u, v), [size(id, "tail_x"), 0.0]);
    check(id, g.figures());

    let id = "rack-two-segments";
    let mut g = ByHand::new(id);
    let roles = g.paired.structure.roles.clone();
    let (frame, jaw, driver) = (roles.frame, roles.jaws[0], roles.drive_links()[1]);
    g.put(
        g.joint(frame, jaw),
        [size(id, "hinge_x"), size(id, "hinge_y")],
    );
    // The pitch line is at y = 5, between the hinges at 22.5: of the two sides of a pinion the inner one.
    let mesh = g.joint(driver, jaw);
    let image = g.rules.image_pairs().find(|i| i.1 == mesh);
    let (of, inner) = image.map_or((mesh, 35), |(of, _)| (of, -35));
    g.at.teeth[of] = Teeth::Rack(inner);
    check(id, g.figures());
}

/// A wedge has a closed form: half the cotangent of the angle between slot and drive, all over the stroke.
#[test]
fn a_wedge_pulls_by_its_angle() {
    for (slot, cotangent) in [(6, 4.0 / 3.0), (5, 15.0 / 8.0), (9, 3.0 / 4.0)] {
        let mut g = ByHand::new("wedge-hook");
        let roles = g.paired.structure.roles.clone();
        let (frame, jaw, driver) = (roles.frame, roles.jaws[0], roles.drive_links()[1]);
        g.turn(g.joint(frame, jaw), WholeDirection::ACROSS);
        g.put(g.joint(frame, jaw), [60.0, 30.0]);
        g.turn(g.joint(driver, jaw), WholeDirection::number(slot));
        g.put(g.joint(driver, jaw), [40.0, 12.0]);
        let f = g.figures();
        for force in f.force {
            assert!((force - cotangent / 2.0).abs() < 1e-6, "{f:?}");
        }
        assert!((f.travel - 10.0 * cotangent).abs() < 0.01, "{f:?}");
    }
}
