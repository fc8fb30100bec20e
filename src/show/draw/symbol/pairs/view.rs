//! One view of a joint type: its axes behind, its links, the arrows of its freedoms in front, and the names beside them.

use super::arrows::{PaperAxis, axes};
use super::paint;
use super::solids::SolidFace;
use crate::draw::place::projection::{View, bounds};
use crate::draw::sheet::labels::{AvoidedLine, CROSSED, LabelPlace, Wish, place};
use crate::draw::sheet::shapes::grid;
use crate::draw::sheet::{Anchor, SMALL, Sheet};
use crate::model::joint_type::Freedom;
use crate::svg::plane::{Point, Rect, add, norm, polyline, scale, sub};
use crate::svg::text::width;

/// The size of the names of freedoms.
const NAME: f64 = 13.0;
/// How far apart points stand that are taken for a line or a face, in pixels.
const FINE: f64 = 5.0;

/// A view that is ready to be drawn round the origin of the joint's frame.
pub(super) struct ReadyView {
    faces: Vec<paint::PaperFace>,
    axes: Vec<PaperAxis>,
    /// The names of freedoms and of axes: class, size, text and place.
    names: Vec<(&'static str, f64, &'static str, LabelPlace)>,
    /// The room of all of it.
    pub(super) room: Rect,
}

impl ReadyView {
    /// Of these faces and freedoms from a side.
    pub(super) fn new(faces: &[SolidFace], freedoms: &[Freedom], view: &View) -> ReadyView {
        let faces = paint::seen(faces, view);
        let covered: Vec<Point> = faces.iter().flat_map(covered).collect();
        let axes = axes(freedoms, view, &covered);
        let names = names(&axes, &covered);
        let drawn = axes.iter().flat_map(strokes).flatten();
        let all: Vec<Point> = covered.iter().copied().chain(drawn).collect();
        let room = bounds(&all).grown(2.0);
        let room = names.iter().fold(room, |r, n| r.with(&n.3.rect));
        ReadyView {
            faces,
            axes,
            names,
            room,
        }
    }

    /// Draws it.
    pub(super) fn draw(&self, sheet: &mut Sheet) {
        for axis in &self.axes {
            for line in &axis.lines {
                sheet.path("fine", &polyline(line, false));
            }
            for head in &axis.heads {
                sheet.path("ink", &polyline(head, true));
            }
        }
        for face in &self.faces {
            face.draw(sheet);
        }
        for arrow in self.axes.iter().flat_map(|a| &a.arrows) {
            let name = arrow.freedom.name();
            sheet.group("data-freedom", name, [0.0; 2], |s| {
                for line in &arrow.lines {
                    s.path("freedom", &polyline(line, false));
                }
                for head in &arrow.heads {
                    s.path("freedom head", &polyline(head, true));
                }
            });
        }
        for (class, size, text, place) in &self.names {
            if let Some((a, b)) = place.leader {
                sheet.line("lead", a, b);
            }
            sheet.text(class, *size, place.rect.middle(), Anchor::Middle, text);
        }
    }
}

/// Points all over a face and round it.
fn covered(face: &paint::PaperFace) -> Vec<Point> {
    let room = bounds(&face.points);
    let size = (room.right - room.left).max(room.bottom - room.top);
    let mut round = face.points.clone();
    round.extend(face.points.first());
    let mut out = along(&round);
    out.extend(grid(&face.points, (size / FINE) as usize));
    out
}

/// Points along a line through some points.
fn along(line: &[Point]) -> Vec<Point> {
    let between = |w: &[Point]| {
        let (a, by) = (w[0], sub(w[1], w[0]));
        let pieces = (norm(by) / FINE).ceil().max(1.0);
        (0..=pieces as usize).map(move |i| add(a, scale(by, i as f64 / pieces)))
    };
    line.windows(2).flat_map(between).collect()
}

/// Points along all that an axis is drawn with.
fn strokes(axis: &PaperAxis) -> Vec<Vec<Point>> {
    let arrows = axis.arrows.iter();
    let own = arrows.flat_map(|a| a.lines.iter().chain(&a.heads));
    let all = axis.lines.iter().chain(&axis.heads).chain(own);
    all.map(|l| along(l)).collect()
}

/// Where names go: beside what they name, and on nothing.
fn names(
    axes: &[PaperAxis],
    covered: &[Point],
) -> Vec<(&'static str, f64, &'static str, LabelPlace)> {
    let box_of = |p: &Point| Rect::around(*p, FINE + 1.0, FINE + 1.0);
    let drawn: Vec<Vec<Point>> = axes.iter().flat_map(strokes).collect();
    let lines = drawn
        .iter()
        .flat_map(|l| l.windows(2))
        .map(|w| AvoidedLine {
            ends: (w[0], w[1]),
            weight: CROSSED,
        });
    let lines: Vec<AvoidedLine> = lines.collect();
    let mut taken: Vec<Rect> = covered
        .iter()
        .chain(drawn.iter().flatten())
        .map(box_of)
        .collect();
    let wish = |size: f64, text: &str, anchor: Point, clear: f64| Wish {
        width: width(text, size),
        height: size,
        anchor,
        clear,
        first: Vec::new(),
    };
    let mut out = Vec::new();
    let mut wishes = Vec::new();
    for axis in axes {
        for arrow in &axis.arrows {
            let name = arrow.freedom.name();
            out.push(("freedom", NAME, name));
            wishes.push(wish(NAME, name, arrow.middle, arrow.clear));
        }
    }
    for axis in axes {
        out.push(("small", SMALL + 1.0, axis.name));
        wishes.push(Wish {
            first: vec![(axis.beyond, 0.0)],
            ..wish(SMALL + 1.0, axis.name, axis.end, 8.0)
        });
    }
    let places = place(&wishes, &mut taken, &lines);
    let all = out.into_iter().zip(places);
    all.map(|((class, size, text), place)| (class, size, text, place))
        .collect()
}
