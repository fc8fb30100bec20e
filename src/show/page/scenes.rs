//! A mechanism in space, to be turned and moved: as far as its drive goes, its idle freedoms, its self-stresses.

use crate::draw::{Drawing, Moving, Scene, Subject, Swap, kinematic_scene};
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::redundancy::analysis::StateAnalysis;
use crate::redundancy::stress::SelfStress;
use crate::score::outcome::Outcome;
use crate::view::analysis::Analysis;

/// Idle freedoms, and self-stresses, of a state that are shown in space.
pub const SHOWN: usize = 24;

/// Returns the mechanism in space in each state, or `None` if its pose has no numbers.
///
/// # Examples
/// ```
/// let gripper = ozols::built_in("gripper-10")?;
/// let scenes = ozols::page::scenes::state_scenes(&gripper, &ozols::analyze(&gripper)?, None);
/// assert_eq!(scenes.len(), gripper.states.len());
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn state_scenes(
    mechanism: &Mechanism,
    states: &[StateAnalysis],
    search: Option<&Outcome>,
) -> Vec<Option<(Drawing, Scene)>> {
    let one = |(found, state): (&StateAnalysis, StateId)| {
        let m = found.meant.as_deref().unwrap_or(mechanism);
        let swaps = search.into_iter();
        let swaps = swaps.flat_map(|found| state_swaps(mechanism, found, state));
        let swaps: Vec<Swap<'_>> = swaps.map(|(_, swap)| swap).collect();
        moving_scene(m, (found, state), &swaps)
    };
    states.iter().zip(mechanism.state_ids()).map(one).collect()
}

/// Returns it in one state, with what redesigns put at its joints; at rest if nothing moves.
pub fn moving_scene(
    m: &Mechanism,
    of: (&StateAnalysis, StateId),
    swaps: &[Swap<'_>],
) -> Option<(Drawing, Scene)> {
    let (found, state) = of;
    let told = Analysis::new(m, std::slice::from_ref(found), &[]);
    let told = told.states.first()?;
    let drive = Moving::new(m, state, None, None).ok();
    let idle = (0..found.idle.len().min(SHOWN))
        .filter_map(|k| Moving::idle_motion(m, found, state, k).ok());
    let mut moving: Vec<Moving> = drive.into_iter().chain(idle).collect();
    let known = |s: &SelfStress| s.joints.iter().any(|w| w.borne.is_some());
    let stresses = found.self_stresses.iter().enumerate();
    let stresses = stresses.filter(|(_, s)| known(s)).take(SHOWN);
    let stresses: Vec<_> = stresses.map(|(k, s)| (told.name(k), s)).collect();
    if moving.is_empty() {
        moving.push(Moving::still_pose(m, state).ok()?);
    }
    Some(draw_scene(
        m,
        (Some(found), state),
        &moving,
        &stresses,
        swaps,
    ))
}

/// Draws it in one state: its motions, its self-stresses, and what redesigns put at its joints.
fn draw_scene(
    m: &Mechanism,
    (analysis, state): (Option<&StateAnalysis>, StateId),
    moving: &[Moving],
    stresses: &[(String, &SelfStress)],
    swaps: &[Swap<'_>],
) -> (Drawing, Scene) {
    let subject = Subject {
        mechanism: m,
        state,
        analysis,
        marks: None,
    };
    kinematic_scene(&subject, moving, stresses, swaps)
}

/// Returns the picture of a mechanism at rest, without title and legend.
///
/// # Examples
/// ```
/// use ozols::page::scenes::still_picture;
/// let bennett = ozols::built_in("bennett")?;
/// assert!(still_picture(&bennett).is_some_and(|svg| svg.starts_with("<svg")));
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn still_picture(m: &Mechanism) -> Option<String> {
    let rest = [Moving::still_pose(m, StateId::FREE).ok()?];
    let (Drawing { svg, .. }, scene) = draw_scene(m, (None, StateId::FREE), &rest, &[], &[]);
    let [left, top, right, bottom] = scene.room();
    let room = format!("viewBox=\"{left} {top} {} {}\"", right - left, bottom - top);
    let (before, rest) = svg.split_once("width=\"")?;
    let (_, after) = rest.split_once("viewBox=\"")?;
    let (_, after) = after.split_once('"')?;
    Some(format!("{before}{room}{after}"))
}

/// Returns the scene of a mechanism at rest, as in its file, with the joints of redesigns.
pub fn still_scene(
    m: &Mechanism,
    of: (Option<&StateAnalysis>, StateId),
    swaps: &[Swap<'_>],
) -> Option<Scene> {
    let rest = [Moving::still_pose(m, of.1).ok()?];
    Some(draw_scene(m, of, &rest, &[], swaps).1)
}

/// Returns what the variants of a search may put at the joints of a state, each with its variable and choice, for
/// [`kinematic_scene`](crate::draw::kinematic_scene).
#[must_use]
pub fn state_swaps<'a>(
    m: &'a Mechanism,
    found: &Outcome,
    state: StateId,
) -> Vec<([usize; 2], Swap<'a>)> {
    let there: Vec<JointId> = m.joints_in(state).collect();
    let mut out = Vec::new();
    for (v, variable) in found.search.space.variables.iter().enumerate() {
        for (c, choice) in variable.choices.iter().enumerate().skip(1) {
            let joints = variable.joints.iter().filter(|j| there.contains(j));
            out.extend(joints.filter_map(|&joint| {
                let swap = Swap {
                    joint,
                    option: m.joints[joint].options.get(choice.option)?,
                    unloading: choice.unloading.is_some(),
                };
                Some(([v, c], swap))
            }));
        }
    }
    out
}
