//! Reactions in a plane, in one pose or over a stroke, with the grip that causes them if there is one.

use crate::grip;
use crate::grip::clamping::DiameterRow;
use crate::grip::jaw_loads::Gripping;
use crate::model::loads::Stroke;
use crate::redundancy::stress::exact_self_stresses;
use crate::statics::contour_group::solutions::GroupMethod;
use crate::statics::solve::SolvedReactions;
use crate::view::grip::clamped::{Clamped, pose_words};
use crate::view::prelude::*;
use crate::view::reactions::Reactions;
use crate::view::reactions::stroke::ReactionsOverStroke;
use crate::view::statics::{StaticsData, statics_csv};

/// Reactions in a plane, in one pose, or over a stroke.
#[derive(Debug)]
pub enum ToldReactions<'a> {
    /// In the plane, over a stroke or in one pose.
    Planar(StaticsData<'a>),
    /// In space, in one pose.
    Pose(Reactions<'a>),
    /// In space, over a stroke.
    Stroke(ReactionsOverStroke<'a>),
}

/// The answer of `ozols statics`.
#[derive(Debug)]
pub struct ToldStatics<'a> {
    /// The reactions.
    pub reactions: ToldReactions<'a>,
    /// The grip that loads the mechanism.
    grip: Option<Clamped<'a>>,
    /// The pose in words.
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
            SolvedReactions::Planar(found) => ToldReactions::Planar(StaticsData {
                of: m,
                found,
                methods,
            }),
            SolvedReactions::Spatial(found) => match (&found.positions[..], stroke) {
                ([(_, Ok(one))], None) => ToldReactions::Pose(Reactions::new(m, state, one)),
                _ => ToldReactions::Stroke(ReactionsOverStroke::new(m, state, found)),
            },
        }
    }
}

impl<'a> ToldStatics<'a> {
    /// Describes the reactions of a state over a stroke, or in the pose of the file; the four-link groups by `methods`.
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
            grip: None,
            pose: "pose of the file".to_owned(),
        }
    }

    /// Describes the reactions of a mechanism that holds the part of a row.
    pub fn round_a_part(
        g: &'a Gripping,
        row: &'a DiameterRow,
        found: &'a grip::clamped::Clamped,
    ) -> Self {
        let (m, methods) = (&found.mechanism, &GroupMethod::ALL);
        ToldStatics {
            reactions: ToldReactions::new(m, g.state, None, &found.found, methods),
            grip: Some(Clamped {
                grip: g,
                row,
                found,
            }),
            pose: pose_words(g, row),
        }
    }

    /// Returns all of it as data.
    pub fn json(&self) -> Value {
        let mut out = match &self.reactions {
            ToldReactions::Planar(s) => s.json(),
            ToldReactions::Pose(s) => s.json(),
            ToldReactions::Stroke(s) => s.json(),
        };
        if let Some(grip) = &self.grip {
            if let ToldReactions::Planar(s) = &self.reactions {
                out["state"] = json!(s.of.states[grip.grip.state]);
            }
            out["grip"] = grip.json();
        }
        out
    }

    /// Returns the reactions as CSV, in SI units.
    pub fn csv(&self) -> String {
        match &self.reactions {
            ToldReactions::Planar(s) => statics_csv(s),
            ToldReactions::Pose(s) => s.csv(),
            ToldReactions::Stroke(s) => s.csv(),
        }
    }

    /// Returns the report, fitted to a terminal of `width` columns if one is given.
    pub fn text(&self, width: Option<u16>) -> String {
        let flat = matches!(self.reactions, ToldReactions::Planar(_));
        let grip = self.grip.as_ref().map(|g| g.text(flat, width));
        grip.unwrap_or_default()
            + &match &self.reactions {
                ToldReactions::Planar(s) => s.text(width),
                ToldReactions::Pose(s) => s.text(&self.pose, width),
                ToldReactions::Stroke(s) => s.text(width),
            }
    }
}
