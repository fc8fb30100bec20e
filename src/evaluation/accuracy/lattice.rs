//! Mechanisms of any number of contours, whose mobility is known by construction.

use super::change::Noise;
use super::special::Sketch;
use crate::file::text::mechanism_from_str;
use crate::model::mechanism::Mechanism;

/// Returns the file of a row of toggles that is shaky of order 2^levels: each knee is pushed by the one before by the square of its
/// motion. At the pose it has one freedom, and none in truth [Connelly and Servatius 1994; Calladine and Pellegrino 1991].
pub fn toggle_row(levels: usize, noise: &mut Noise) -> String {
    let mut length = || 100 + (30.0 * noise.draw_uniform()) as i64;
    let mut file = Sketch::default();
    // The first knee lies between two bars along x, each further one between two bars across the last push.
    let mut knee = [0, 0];
    for k in 0..levels {
        let moved = |by: i64| {
            let mut at = knee;
            at[k % 2] += by;
            at
        };
        let (a, b) = (format!("a{k}"), format!("b{k}"));
        file.add_pin(["0", &a], moved(-length()));
        file.add_pin([&a, &b], knee);
        if k > 0 {
            file.add_pin([&format!("b{}", k - 1), &a], knee);
        }
        knee = moved(length());
        if k + 1 == levels {
            file.add_pin([&b, "0"], knee);
        }
    }
    file.text("toggles")
}

/// The motions of the joints of a random ladder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scene {
    /// Hinges across one plane.
    Plane,
    /// Hinges, balls, universal and cylindrical joints across one plane: the equations split into those in the plane and those out of it.
    AboutPlane,
    /// Hinges through one point.
    Sphere,
    /// Hinges anywhere.
    Space,
}

impl Scene {
    /// All of them.
    pub const ALL: [Scene; 4] = [Scene::Plane, Scene::AboutPlane, Scene::Sphere, Scene::Space];

    /// Returns its name in pictures.
    pub fn name(self) -> &'static str {
        match self {
            Scene::Plane => "plane",
            Scene::AboutPlane => "in and out of a plane",
            Scene::Sphere => "sphere",
            Scene::Space => "space",
        }
    }
}

/// The options of the joints of a ladder.
const OPTIONS: [&str; 4] = ["revolute", "cylindrical", "universal", "spherical"];

/// Returns a ladder: a four-bar, and three more joints for each further contour, at random places, with four options each. The
/// diagram of eight contours in a plane does not fit into the default budget.
///
/// # Panics
/// Never: the text is valid.
pub fn make_ladder(scene: Scene, contours: usize, noise: &mut Noise) -> Mechanism {
    let mut file = Sketch::default();
    let mut pin = |a: usize, b: usize| {
        let mut three = || [(); 3].map(|()| noise.draw_integer(10));
        let [x, y, z] = three();
        let (point, axis) = match scene {
            Scene::Plane | Scene::AboutPlane => ([x, y, 0], [0, 0, 1]),
            Scene::Sphere => ([x, y, z + 1], [x, y, z + 1]),
            Scene::Space => (three(), [x, y, z + 1]),
        };
        let kind = match (scene, usize::try_from(z % 8)) {
            (Scene::AboutPlane, Ok(nth @ 0..4)) => OPTIONS[nth],
            _ => OPTIONS[0],
        };
        let [point, axis] = [point, axis].map(|v| format!("{v:?}"));
        file.add_joint([&a.to_string(), &b.to_string()], kind, &point, &axis);
    };
    for (a, b) in [(0, 1), (1, 3), (3, 2), (2, 0)] {
        pin(a, b);
    }
    let (mut side, mut other) = (1, 2);
    for i in 1..contours {
        let (a, b) = (2 * i + 2, 2 * i + 3);
        pin(side, a);
        pin(a, b);
        pin(b, other);
        (side, other) = (a, b);
    }
    with_search_options(
        &file,
        &format!("{scene:?}-ladder-{contours}").to_lowercase(),
    )
}

/// Returns a scissor lift of some stages. A slider on the frame drives the lowest one, and the platform slides on the highest one. Each joint has
/// four options, as those of a ladder.
///
/// # Panics
/// Never: the text is valid.
///
/// # Examples
/// ```
/// use ozols::accuracy::lattice::make_lift;
/// // A scissor lift is planar: three redundant constraints in each of its loops.
/// let free = &ozols::analyze(&make_lift(3))?[0];
/// assert_eq!(free.redundant, free.mobility + 6 * free.contours - free.freedoms);
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn make_lift(stages: usize) -> Mechanism {
    let mut file = Sketch::with_links(["0", "slide"]);
    let slider = |file: &mut Sketch, ends: [&str; 2], y: i64| {
        file.add_joint(ends, "prismatic", &format!("[60, {y}, 0]"), "[1, 0, 0]");
    };
    slider(&mut file, ["0", "slide"], 0);
    let (mut left, mut right) = ("0".to_owned(), "slide".to_owned());
    let mut low = 0;
    for i in 1..=stages {
        let (a, b) = (format!("a{i}"), format!("b{i}"));
        file.add_pin([&left, &a], [0, low]);
        file.add_pin([&right, &b], [60, low]);
        file.add_pin([&a, &b], [30, low + 20]);
        (left, right) = (b, a);
        low += 40;
    }
    file.add_pin([&right, "shoe"], [60, low]);
    slider(&mut file, ["platform", "shoe"], low);
    file.add_pin([&left, "platform"], [0, low]);
    with_search_options(&file, &format!("scissor-lift-{stages}"))
}

/// Returns a mechanism in which each joint has the options of a ladder.
fn with_search_options(file: &Sketch, name: &str) -> Mechanism {
    let text = format!("{}[search]\noptions = {OPTIONS:?}\n", file.text(name));
    mechanism_from_str("searched.toml", &text).expect("a generated file is valid")
}
