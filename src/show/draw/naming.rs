//! The names in a drawing: of joints and links, each with its look and a wish for a place.

use crate::draw::prelude::*;
use crate::svg::labels::{self, AvoidedLine, LabelPlace, Wish};

/// The room for a name; longer ones are shortened.
const ROOM: f64 = 150.0;
/// The size of the names of links.
const LINK: f64 = 12.0;

/// A name to be placed.
#[derive(Debug, Clone)]
pub(crate) struct Name {
    pub(crate) wish: Wish,
    pub(crate) class: String,
    pub(crate) size: f64,
    pub(crate) text: String,
    /// The id of its joint, by which a program finds the name.
    pub(crate) joint: Option<String>,
}

impl Name {
    /// Creates a small name at least `clear` away from its anchor.
    pub(crate) fn small(class: String, text: String, anchor: Point, clear: f64) -> Name {
        Name {
            wish: Wish::for_text(&text, SMALL, anchor, clear),
            class,
            size: SMALL,
            text,
            joint: None,
        }
    }

    /// Draws it around a point.
    pub(crate) fn draw_name(&self, sheet: &mut Sheet, at: Point) {
        let write =
            |s: &mut Sheet| s.write_text(&self.class, self.size, at, Anchor::Middle, &self.text);
        match &self.joint {
            Some(id) => sheet.draw_group("data-joint-name", id, [0.0; 2], write),
            None => write(sheet),
        }
    }
}

/// Finds places for names, and adds these to `taken`.
pub(crate) fn place_names(
    names: Vec<Name>,
    taken: &mut Vec<Rect>,
    lines: &[AvoidedLine],
) -> Vec<(LabelPlace, Name)> {
    let wishes: Vec<Wish> = names.iter().map(|n| n.wish.clone()).collect();
    let places = labels::place_labels(&wishes, taken, lines);
    places.into_iter().zip(names).collect()
}

/// Draws the lines from names to what they name.
pub(crate) fn draw_leaders(sheet: &mut Sheet, names: &[(LabelPlace, Name)]) {
    for (a, b) in names.iter().filter_map(|(place, _)| place.leader) {
        sheet.draw_line("lead", a, b);
    }
}

impl Subject<'_> {
    /// Returns the ids of joints, each to be placed at a distance from a point.
    pub(crate) fn joint_names(&self, joints: &[(JointId, Point, f64)]) -> Vec<Name> {
        let ids = joints.iter().map(|(j, ..)| &*self.mechanism.joints[*j].id);
        let ids: Vec<&str> = ids.collect();
        let texts = shorten_names(&ids, SMALL, ROOM).into_iter().zip(&ids);
        let one = |(&(joint, at, clear), (text, id)): (&(JointId, Point, f64), (String, &&str))| {
            let class = format!("small soft{}", self.joint_mark(joint).mark_class());
            Name {
                joint: Some((*id).to_owned()),
                ..Name::small(class, text, at, clear)
            }
        };
        joints.iter().zip(texts).map(one).collect()
    }

    /// Returns the ids of links; `place` gives the anchor of a name of some width, its distance and middles to try first.
    pub(crate) fn link_names(
        &self,
        links: &[LinkId],
        place: impl Fn(usize, f64) -> (Point, f64, Vec<(Point, f64)>),
    ) -> Vec<Name> {
        let ids = links.iter().map(|&l| &*self.mechanism.links[l].id);
        let texts = shorten_names(&ids.collect::<Vec<_>>(), LINK, ROOM);
        let one = |(n, text): (usize, String)| {
            let (anchor, clear, first) = place(n, text_width(&text, LINK));
            Name {
                wish: Wish {
                    first,
                    ..Wish::for_text(&text, LINK, anchor, clear)
                },
                class: format!("name{}", self.link_mark(links[n]).mark_class()),
                size: LINK,
                text,
                joint: None,
            }
        };
        texts.into_iter().enumerate().map(one).collect()
    }
}
