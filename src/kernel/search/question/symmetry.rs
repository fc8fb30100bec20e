//! Whether the mirror pairs of a file, or the groups that a turn carries round, carry the mechanism over to itself, so that a variant and its image have the same
//! figures: links and joints, each with its options, exactly.

use crate::closure::isometry::{Isometry, PlacedType, Spot, frame_directions};
use crate::geom::exact::{ExactError, ExactField};
use crate::model::joint_type::{CoupledFreedom, Coupling, Freedom, JointType};
use crate::model::mechanism::{JointId, JointOption, LinkId, Mechanism, StateId};
use itertools::Itertools;
use thiserror::Error;

/// Why a mechanism is not its own image.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MirrorError {
    /// A file that names no images, of a mechanism that has none.
    #[error(
        "no mirror, half turn or third of a turn maps {mechanism} to itself; correct its points and axes, or name the images: `mirror = [[\"joint\", \"its image\"], ...]` under [search]"
    )]
    NoPairs {
        /// Name of the mechanism.
        mechanism: String,
    },
    /// A coupling without an image.
    #[error(
        "joints {coupling} are coupled, their images are not, or in another ratio; couple both pairs alike, or search without symmetry"
    )]
    UnlikeCoupling {
        /// The coupling.
        coupling: String,
    },
    /// Joints that are images of each other and offer different options.
    #[error(
        "joints {first} and {second} are images of each other but offer different options; give both the same list, at the same costs"
    )]
    UnlikeOptions {
        /// One joint.
        first: String,
        /// Its image.
        second: String,
    },
    /// Joints whose links are not each other's images.
    #[error(
        "joint {joint} has no image between the images of its links; name it with its image under [search] mirror or turn, or search without symmetry"
    )]
    NoImage {
        /// The joint.
        joint: String,
    },
    /// Links that are not alike to the search.
    #[error(
        "links {first} and {second} are images of each other, but only one of them is an output or held; treat both in the same way, or search without symmetry"
    )]
    UnlikeLinks {
        /// One link.
        first: String,
        /// Its image.
        second: String,
    },
    /// Joints that are not each other's images.
    #[error(
        "{option} of joint {first} has its image {off} from that of joint {second}, and counts of images need exact ones; correct the points and axes, or search without symmetry"
    )]
    Off {
        /// One joint.
        first: String,
        /// Its image.
        second: String,
        /// The option.
        option: String,
        /// How far it is off.
        off: String,
    },
    /// Three joints at one place.
    #[error(
        "the joints under [search] turn say no axis, three at a time at one place; add a group that is not on the axis, or search without symmetry"
    )]
    NoAxis,
    /// A drive whose image is not driven.
    #[error(
        "joint {driven} is driven and its image {image} is not: count all variants, or ask nothing of the drives"
    )]
    UnlikeDrives {
        /// The driven joint.
        driven: String,
        /// Its image.
        image: String,
    },
    /// The geometry has no image in the field.
    #[error(transparent)]
    Exact(#[from] ExactError),
}

/// Refuses kept drives whose images are not kept drives: of two variants that are images of each other, only one might keep the drives.
pub(in crate::search) fn check_drives(mechanism: &Mechanism) -> Result<(), MirrorError> {
    for drive in &mechanism.search.drives {
        let image = mechanism.search.image_of_joint(drive.joint);
        if mechanism.kept_drive(image).is_none() {
            let [driven, image] = [drive.joint, image].map(|j| mechanism.joints[j].id.clone());
            return Err(MirrorError::UnlikeDrives { driven, image });
        }
    }
    Ok(())
}

/// Refuses a mechanism that its mirror pairs do not map to itself, in the free state and in `state`.
///
/// # Errors
/// Returns an error if they do not.
pub(in crate::search) fn check_images(
    exact: &ExactField,
    mechanism: &Mechanism,
    state: Option<StateId>,
) -> Result<(), MirrorError> {
    if mechanism.search.symmetry_order() == 1 {
        return Err(MirrorError::NoPairs {
            mechanism: mechanism.name.clone(),
        });
    }
    let joints = check_structure(mechanism, state)?;
    check_joints(exact, mechanism, &joints)
}

/// Refuses images that differ in what they join, offer or are coupled to, wherever they are. Returns the joints there are.
pub(in crate::search) fn check_structure(
    mechanism: &Mechanism,
    state: Option<StateId>,
) -> Result<Vec<JointId>, MirrorError> {
    let states = std::iter::once(StateId::FREE).chain(state);
    let joints = states
        .flat_map(|s| mechanism.joints_in(s))
        .unique()
        .collect_vec();
    for &j in &joints {
        let (a, b) = (
            &mechanism.joints[j],
            &mechanism.joints[mechanism.search.image_of_joint(j)],
        );
        let offer = |o: &JointOption| (o.name.clone(), o.cost_milli);
        if !a
            .offered_options()
            .map(offer)
            .eq(b.offered_options().map(offer))
        {
            return Err(MirrorError::UnlikeOptions {
                first: a.id.clone(),
                second: b.id.clone(),
            });
        }
    }
    check_links(mechanism, &joints)?;
    match mechanism
        .couplings
        .iter()
        .find(|c| !is_coupled_alike(mechanism, c))
    {
        Some(c) => Err(MirrorError::UnlikeCoupling {
            coupling: c.name(mechanism),
        }),
        None => Ok(joints),
    }
}

/// Refuses joints that are not each other's images, option by option, in any of the planes they may be images in.
fn check_joints(
    exact: &ExactField,
    mechanism: &Mechanism,
    joints: &[JointId],
) -> Result<(), MirrorError> {
    let mut off = None;
    let mirrors = Isometry::find_mirrors(mechanism, &mechanism.search.mirror);
    let turns = &mechanism.search.turn;
    let turns = Isometry::find_turns(mechanism, &frame_directions(mechanism), turns);
    for carrier in mirrors.iter().map(|(mirror, _)| mirror).chain(&turns) {
        match by_carrier(exact, mechanism, joints, carrier) {
            // What is off in the likeliest plane is what a person wants to hear of.
            Err(e @ MirrorError::Off { .. }) => off = off.or(Some(e)),
            other => return other,
        }
    }
    Err(off.unwrap_or(MirrorError::NoAxis))
}

fn by_carrier(
    exact: &ExactField,
    mechanism: &Mechanism,
    joints: &[JointId],
    carrier: &Isometry,
) -> Result<(), MirrorError> {
    for &j in joints {
        let (a, b) = (
            &mechanism.joints[j],
            &mechanism.joints[mechanism.search.image_of_joint(j)],
        );
        for (one, other) in a.offered_options().zip(b.offered_options()) {
            let motion = |o: &JointOption| match o.joint_type {
                // A face: what friction leaves free.
                JointType::Fixed => JointType::Custom(vec![Freedom::Tz, Freedom::Rx, Freedom::Ry]),
                ref other => other.clone(),
            };
            let (one_type, other_type) = (motion(one), motion(other));
            let from = PlacedType {
                frame: &one.frame,
                joint_type: &one_type,
            };
            let to = PlacedType {
                frame: &other.frame,
                joint_type: &other_type,
            };
            if !carrier.maps_motions(exact, &mechanism.mode, from, to)? {
                let (from, to) = (Spot::from_frame(&one.frame), Spot::from_frame(&other.frame));
                let miss = carrier.miss_of_image(from, &one.joint_type, to);
                return Err(MirrorError::Off {
                    first: a.id.clone(),
                    second: b.id.clone(),
                    option: one.name.clone(),
                    off: miss.describe_miss(mechanism.length_unit.symbol),
                });
            }
        }
    }
    Ok(())
}

/// Refuses pairs that do not map links to links: the frame is its own image, and a joint of two links maps to a joint of their images.
fn check_links(mechanism: &Mechanism, joints: &[JointId]) -> Result<(), MirrorError> {
    let mut to: Vec<Option<LinkId>> = vec![None; mechanism.links.len()];
    to[mechanism.frame_link().index()] = Some(mechanism.frame_link());
    let mut changed = true;
    while changed {
        changed = false;
        for &j in joints {
            let [u, v] = mechanism.joints[j].links;
            let [x, y] = mechanism.joints[mechanism.search.image_of_joint(j)].links;
            for (near, far) in [(u, v), (v, u)] {
                let goes = match to[near.index()] {
                    Some(at) if at == x => y,
                    Some(at) if at == y => x,
                    _ => continue,
                };
                if to[far.index()].is_none() {
                    (to[far.index()], changed) = (Some(goes), true);
                }
            }
        }
    }
    for &j in joints {
        let ends = mechanism.joints[j].links.map(|l| to[l.index()]);
        let [x, y] = mechanism.joints[mechanism.search.image_of_joint(j)]
            .links
            .map(Some);
        if ends != [x, y] && ends != [y, x] {
            return Err(MirrorError::NoImage {
                joint: mechanism.joints[j].id.clone(),
            });
        }
    }
    for (l, image) in mechanism.link_ids().zip(&to) {
        let Some(image) = *image else { continue };
        let like = |l: LinkId| (mechanism.links[l].role, mechanism.search.hold.contains(&l));
        if like(l) != like(image) {
            let [first, second] = [l, image].map(|l| mechanism.links[l].id.clone());
            return Err(MirrorError::UnlikeLinks { first, second });
        }
    }
    Ok(())
}

/// Returns true if the mirror images of two coupled joints have the same coupling, in either sense of rotation.
fn is_coupled_alike(mechanism: &Mechanism, coupling: &Coupling) -> bool {
    /// Relative difference of equal ratios.
    const EQUAL: f64 = 1e-12;
    let [a, b] = coupling.ends.map(|e| CoupledFreedom {
        joint: mechanism.search.image_of_joint(e.joint),
        ..e
    });
    let ratio = coupling.ratio.to_f64().abs();
    mechanism.couplings.iter().any(|c| {
        let other = c.ratio.to_f64().abs();
        let near = |x: f64| (x / ratio - 1.0).abs() < EQUAL;
        (c.ends == [a, b] && near(other)) || (c.ends == [b, a] && near(1.0 / other))
    })
}
