//! Descriptions carried over whole from one format to another: MJCF, SDF, URDF with its loops as `<loop_joint>`, in a file
//! beside it or as Drake's tags. Links keep their frames where the target has frames of its own, joints their names.

mod admitted;
mod closure;
mod judge;
mod lost;
mod mimics;
pub(super) mod payload;
mod plan;
mod scene;
pub(super) mod solid;
mod text;
mod to_mjcf;
mod to_sdf;
mod to_urdf;

pub use closure::LoopClosure;
pub use judge::{JudgedLoop, Judgement, Motions, Wanted, figures};
pub use lost::{Lost, LostKind};

use crate::file::problem::ImportError;
use crate::robots::convert::payload::Payload;
use crate::robots::convert::plan::TreePlan;
use crate::robots::convert::scene::{RobotScene, Text};
use crate::robots::description::digits;
use crate::robots::description::massless::Light;
use crate::robots::description::origin::Origin;
use crate::robots::description::parts::Robot;
use crate::robots::import::Imported;
use crate::robots::mechanism::loop_closing::size;
use crate::robots::{mjcf, sdf, urdf};
use to_urdf::Loops;

/// What is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// MuJoCo's format.
    Mjcf,
    /// SDFormat.
    Sdf,
    /// URDF with `<loop_joint>`.
    Urdf,
    /// URDF with its loops in a YAML file beside it, as those who use Pinocchio write them.
    UrdfYaml,
    /// URDF with Drake's tags.
    Drake,
}

impl Target {
    /// All, with the words for them and what they are.
    pub const ALL: [(&'static str, Target, &'static str); 5] = [
        (
            "mjcf",
            Target::Mjcf,
            "MJCF, loops as connect and weld of sites",
        ),
        ("sdf", Target::Sdf, "SDF, loops closed by joints"),
        ("urdf", Target::Urdf, "URDF, loops as <loop_joint>"),
        (
            "urdf-yaml",
            Target::UrdfYaml,
            "URDF, loops in a YAML file beside it, as for Pinocchio",
        ),
        (
            "drake",
            Target::Drake,
            "URDF, loops as <drake:ball_constraint>",
        ),
    ];

    /// The one that the ending of a file's name stands for.
    #[must_use]
    pub fn of_ending(ending: &str) -> Option<Target> {
        match ending.to_ascii_lowercase().as_str() {
            "xml" | "mjcf" => Some(Target::Mjcf),
            "sdf" | "world" => Some(Target::Sdf),
            "urdf" => Some(Target::Urdf),
            _ => None,
        }
    }
}

/// A description in another format.
#[derive(Debug)]
pub struct Converted {
    /// The text.
    pub text: String,
    /// The text of the file of loops beside it, in YAML.
    pub beside: Option<String>,
    /// What was lost, by kind.
    pub lost: Lost,
    /// What differs and is not lost, a sentence each.
    pub told: Vec<String>,
    /// The pose in which the loops are closed: values of the joints that are not at zero there.
    pub pose: Vec<(String, Vec<f64>)>,
    /// What was asked of loop closures, one by one.
    pub closures: Vec<JudgedLoop>,
    /// W and σ of what was read, its closures as asked, where the digits decide them.
    pub figures: Option<(usize, usize)>,
    /// Constraints that only repeat others, as the format has no better words: σ of what is written is so many more.
    pub repeated: usize,
}

/// Writes an imported description in another format.
///
/// # Errors
/// What is wrong with the parts of the description that an import leaves out, with its place.
pub fn convert(
    imported: &Imported,
    target: Target,
    wanted: &Wanted,
) -> Result<Converted, ImportError> {
    let origin = &imported.origin;
    let payload = payload(origin)?;
    let judged = judge::judge(imported, wanted)?;
    let (robot, closures) = (judged.robot, judged.closures);
    let (known, light) = (
        digits::comment(imported.file.tolerance.as_ref()),
        Light::in_description(&origin.document).lighter(),
    );
    let plan = TreePlan::new(&robot, origin.frame);
    let scene = RobotScene {
        robot: &robot,
        payload: &payload,
        plan: &plan,
        places: &origin.places,
        light,
        known: &known,
        size: size(&robot),
    };
    let Text {
        text,
        beside,
        lost,
        told,
        repeated,
    } = match target {
        Target::Mjcf => to_mjcf::mjcf(&scene),
        Target::Sdf => to_sdf::sdf(&scene),
        Target::Urdf => to_urdf::urdf(&scene, Loops::LoopJoint),
        Target::UrdfYaml => to_urdf::urdf(&scene, Loops::Beside),
        Target::Drake => to_urdf::urdf(&scene, Loops::Drake),
    };
    let mut all = payload.lost.clone();
    all.add(lost);
    Ok(Converted {
        text,
        beside,
        lost: all,
        told,
        pose: pose(&robot, &plan, target),
        closures,
        figures: judged.figures,
        repeated,
    })
}

/// What the elements of the description say besides kinematics.
fn payload(origin: &Origin) -> Result<Payload, ImportError> {
    let root = origin.element(origin.root);
    match root.name() {
        "mujoco" => mjcf::payload::read(root, &origin.robot),
        "sdf" => sdf::payload::read(root, &origin.robot),
        _ => urdf::payload::read(root, &origin.robot),
    }
}

/// Values of joints that are not at zero; SDF counts from the pose that it draws.
fn pose(robot: &Robot, plan: &TreePlan, target: Target) -> Vec<(String, Vec<f64>)> {
    if target == Target::Sdf {
        return Vec::new();
    }
    let one =
        |p: &&crate::robots::description::parts::Part| p.values.len() == 1 && p.values[0] != 0.0;
    let joints = plan.branches.iter().map(|b| &robot.joints[b.joint]);
    let zero = |z: f64| if target == Target::Mjcf { z } else { 0.0 };
    joints
        .filter(one)
        .map(|p| (p.id.clone(), vec![p.values[0] + zero(p.zero)]))
        .collect()
}
