//! Reactions as the equations that determine them have them, with the grip that causes them where there is one.

use crate::grip;
use crate::grip::clamping::DiameterRow;
use crate::grip::jaw_loads::Gripping;
use crate::model::loads::Stroke;
use crate::redundancy::stress::exact_self_stresses;
use crate::statics::contour_group::solutions::GroupMethod;
use crate::statics::solve::SolvedReactions;
use crate::view::grip::clamped::{Clamped, pose};
use crate::view::prelude::*;
use crate::view::reactions::Reactions;
use crate::view::reactions::stroke::ReactionsOverStroke;
use crate::view::reactions::text::reactions;
use crate::view::statics::StaticsData;
use crate::view::statics::csv::csv;
use crate::view::statics::text::statics;

/// Reactions in a plane, in one pose, or over a stroke.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum ToldReactions<'a> {
    /// In the plane, over a stroke or in one pose.
    Planar(Box<StaticsData<'a>>),
    /// In space, in one pose.
    Pose(Box<Reactions<'a>>),
    /// In space, over a stroke.
    Stroke(ReactionsOverStroke<'a>),
}

/// The answer of `ozols statics`.
#[derive(Debug, Serialize)]
pub struct ToldStatics<'a> {
    /// The reactions.
    #[serde(flatten)]
    pub reactions: ToldReactions<'a>,
    /// The state, where the reactions do not name it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub state: Option<&'a str>,
    /// The grip that loads the mechanism.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grip: Option<Clamped<'a>>,
    /// The pose in words.
    #[serde(skip)]
    pose: String,
}

impl<'a> ToldReactions<'a> {
    fn new(
        m: &'a Mechanism,
        state: StateId,
        stroke: Option<Stroke>,
        found: &'a SolvedReactions,
        methods: &'a [GroupMethod],
    ) -> Self {
        match found {
            SolvedReactions::Planar(found) => {
                ToldReactions::Planar(Box::new(StaticsData::new(m, found, methods)))
            }
            SolvedReactions::Spatial(found) => match (&found.positions[..], stroke) {
                ([(_, Ok(one))], None) => {
                    ToldReactions::Pose(Box::new(Reactions::new(m, state, one)))
                }
                _ => ToldReactions::Stroke(ReactionsOverStroke::new(m, state, found)),
            },
        }
    }
}

impl<'a> ToldStatics<'a> {
    /// What was found of a state over a stroke, or in the pose of the file; the four-link groups by `methods`.
    #[must_use]
    pub fn new(
        m: &'a Mechanism,
        state: StateId,
        stroke: Option<Stroke>,
        found: &'a SolvedReactions,
        methods: &'a [GroupMethod],
    ) -> Self {
        let mut reactions = ToldReactions::new(m, state, stroke, found, methods);
        if let (ToldReactions::Pose(told), SolvedReactions::Spatial(found)) =
            (&mut reactions, found)
        {
            told.compare_with(exact_self_stresses(m, state, &found.drives));
        }
        ToldStatics {
            reactions,
            state: None,
            grip: None,
            pose: "pose of the file".to_owned(),
        }
    }

    /// What was found round the part of a row.
    #[must_use]
    pub fn round_a_part(
        g: &'a Gripping,
        row: &'a DiameterRow,
        found: &'a grip::clamped::Clamped,
    ) -> Self {
        let m = &found.mechanism;
        let methods = &GroupMethod::ALL;
        let reactions = ToldReactions::new(m, g.state, None, &found.found, methods);
        let flat = matches!(reactions, ToldReactions::Planar(_));
        ToldStatics {
            reactions,
            state: flat.then(|| m.states[g.state].as_str()),
            grip: Some(Clamped {
                grip: g,
                row,
                found,
            }),
            pose: pose(g, row),
        }
    }

    /// As CSV, in SI units.
    #[must_use]
    pub fn csv(&self) -> String {
        match &self.reactions {
            ToldReactions::Planar(s) => csv(s),
            ToldReactions::Pose(s) => s.csv(),
            ToldReactions::Stroke(s) => s.csv(),
        }
    }

    /// The report, fitted to a terminal of `width` columns where one is given.
    #[must_use]
    pub fn text(&self, width: Option<u16>) -> String {
        let flat = matches!(self.reactions, ToldReactions::Planar(_));
        let grip = self.grip.as_ref().map(|g| g.text(flat, width));
        grip.unwrap_or_default()
            + &match &self.reactions {
                ToldReactions::Planar(s) => statics(s, width),
                ToldReactions::Pose(s) => reactions(s, &self.pose, width),
                ToldReactions::Stroke(s) => s.text(width),
            }
    }
}
