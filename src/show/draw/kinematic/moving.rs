//! A kinematic scheme over the way of its drive: one picture a pose, shown one after the other.

use crate::draw::kinematic::moving::frame::Carried;
use crate::draw::kinematic::{Kinematic, MovingPicture, Spot};
use crate::draw::prelude::*;
use crate::draw::symbol::placed::Symbol;
use crate::motion::drive_range::Way;
use crate::motion::pose::Pose;

pub(crate) mod frame;

/// Pictures a second.
pub(crate) const RATE: usize = 30;

/// A motion.
#[derive(Debug)]
pub struct Moving {
    /// The pose of the file, which has the links' sizes.
    pub(crate) pose: Pose,
    /// The motion of the drive.
    pub(crate) way: Way,
    /// The drive and how far it goes, in words.
    pub(crate) words: String,
    /// The unit of positions of the way: what 1 is in it, and its symbol, the file's length unit where the drive slides.
    pub(crate) unit: (f64, &'static str),
}

/// Draws the kinematic scheme over a motion, animated by a style sheet: the pose of the file stands still for readers who want
/// less motion, on paper and in programs that know no animation. A self-stress of the pose of the file, given with its name, is shown in
/// every pose.
///
/// # Examples
/// ```
/// use ozols::{draw::{Sight, Subject, kinematic_moving}, model::mechanism::StateId, page::moving::Moving};
/// let four_bar = ozols::built_in("four-bar")?;
/// let moving = Moving::new(&four_bar, StateId::FREE, None, None).expect("the crank turns");
/// let subject = Subject { mechanism: &four_bar, state: StateId::FREE, analysis: None, marks: None };
/// assert!(kinematic_moving(&subject, &Sight::default(), &moving, None).svg.contains("@keyframes"));
/// # Ok::<(), ozols::Error>(())
/// ```
#[must_use]
pub fn kinematic_moving(
    subject: &Subject<'_>,
    sight: &Sight,
    moving: &Moving,
    stress: Option<(&str, &SelfStress)>,
) -> Drawing {
    let mut rest = Kinematic::new(subject, sight);
    let (poses, start) = (moving.poses(), moving.way.start);
    let lines = rest.moving_lines(&poses);
    let frames = poses.iter().map(|c| rest.picture_in(Some(c), &lines));
    let mut frames: Vec<MovingPicture> = frames.collect();
    let arrows = stress.map(|(_, s)| rest.arrows_along(s, &poses, start));
    for (frame, arrows) in frames.iter_mut().zip(arrows.into_iter().flatten()) {
        frame.arrows = arrows;
    }
    rest.trace_motion(moving, &poses);
    let stress = stress.map(|(name, _)| format!("; {name}"));
    rest.shows = Some(moving.words.clone() + &stress.unwrap_or_default());
    let mut legend = rest.legend_rows();
    legend.extend(flag_row(&frames[start]));
    legend.extend(rest.arrow_rows(&frames[start].arrows));
    let arrows = frames.iter().filter_map(|f| rest.arrow_room(&f.arrows));
    let area = arrows.fold(rest.room_of(&frames, start), |all, r| all.with(&r));
    rest.on_sheet(area, legend, |sheet, by| {
        sheet.write_style(&animation_style(frames.len(), moving.way.closed));
        sheet.draw_group("data-drawing", "", by, |s| {
            rest.draw_traces(s);
            rest.draw_ground(s);
            rest.draw_frames(s, &frames, start);
        });
    })
}

/// Draws the kinematic scheme at the pose of the file, with the paths of its points over a motion and perhaps a self-stress.
#[must_use]
pub fn kinematic_along(
    subject: &Subject<'_>,
    sight: &Sight,
    moving: &Moving,
    stress: Option<(&str, &SelfStress)>,
) -> Drawing {
    let mut rest = Kinematic::new(subject, sight);
    rest.trace_motion(moving, &moving.poses());
    rest.show_stress(stress);
    rest.draw_sheet()
}

impl Moving {
    /// Returns the poses, each once.
    pub(super) fn poses(&self) -> Vec<Carried<'_>> {
        let pose = &self.pose;
        let links = self.way.links.iter();
        let mut poses: Vec<Carried<'_>> = links.map(|links| Carried { pose, links }).collect();
        if self.way.closed {
            poses.pop();
        }
        poses
    }
}

impl Kinematic<'_> {
    /// Shows the path of each point over the poses of a motion.
    pub(super) fn trace_motion(&mut self, moving: &Moving, poses: &[Carried<'_>]) {
        let tips = self.traced_tips().into_iter();
        let of = tips.map(|(link, tip)| {
            let at = |c: &Carried<'_>| self.projection.flat_point(c.carried_point(link, tip));
            poses.iter().map(at).collect()
        });
        self.traces = (of.collect(), moving.way.closed);
    }

    /// Draws each symbol once, and the pictures that use them.
    fn draw_frames(&self, sheet: &mut Sheet, frames: &[MovingPicture], start: usize) {
        let m = self.subject.mechanism;
        let order = self.outer_first();
        let mut store: Vec<String> = Vec::new();
        let mut used: Vec<Vec<usize>> = Vec::new();
        for f in frames {
            let of = self.spots.iter().zip(&f.places).enumerate();
            let of = of.map(|(i, (spot, place))| {
                let of = &m.joints[spot.joint].joint_type;
                let mut piece = Sheet::default();
                let mark = self.subject.joint_mark(spot.joint);
                self.symbol_of(i, of, place).draw_symbol(&mut piece, mark);
                let piece = piece.into_text();
                store.iter().position(|s| *s == piece).unwrap_or_else(|| {
                    store.push(piece);
                    store.len() - 1
                })
            });
            used.push(of.collect());
        }
        sheet.write_defs(&store);
        for spot in &self.spots {
            sheet.note_symbol(spot.rect);
        }
        for (n, (f, used)) in frames.iter().zip(&used).enumerate() {
            sheet.draw_frame(n, n == start, |s| {
                self.draw_picture(s, f, false);
                for &i in &order {
                    let id = &m.joints[self.spots[i].joint].id;
                    s.joint_use(id, &format!("m{}", used[i]), f.at[i]);
                }
                let shapes = f.arrows.iter().flat_map(|a| self.arrow_shapes(a));
                s.draw_shapes(&shapes.collect::<Vec<_>>());
            });
        }
    }
}

/// Returns the style that shows each picture in its turn. They run back and forth unless the drive makes a full turn.
fn animation_style(n: usize, closed: bool) -> String {
    let seconds = n as f64 / RATE as f64;
    let back = if closed { "" } else { " alternate" };
    let part = |k: usize| format!("{:.3}%", 100.0 * k as f64 / n as f64);
    let mut out = String::from("\n");
    let mut rules = String::new();
    for k in 0..n {
        let before = if k == 0 { "" } else { "0%{visibility:hidden}" };
        let (from, to) = (part(k), part(k + 1));
        // writing to a string does not fail
        let _ = writeln!(
            out,
            "@keyframes ozf{k}{{{before}{from}{{visibility:visible}}{to}{{visibility:{}}}}}",
            if k + 1 == n { "visible" } else { "hidden" }
        );
        let _ = writeln!(
            rules,
            ".ozd .f{k}{{animation:ozf{k} {seconds:.2}s step-end infinite{back}}}"
        );
    }
    out + "@media screen and (prefers-reduced-motion:no-preference){\n" + &rules + "}\n"
}

/// Returns the legend row of flags, or `None` if the picture has none.
pub(super) fn flag_row(frame: &MovingPicture) -> Option<(Swatch, String)> {
    let there = frame.wires.iter().any(|w| w.class == "flag");
    there.then(|| {
        let flag = Shape::line("flag", vec![[0.0; 2], [7.0, -7.0]]);
        let text = "flag on a link that turns in its place";
        (Swatch::Shapes(vec![flag]), text.to_owned())
    })
}

impl Kinematic<'_> {
    /// Returns the name of the drawing.
    pub(super) fn view_title(&self) -> String {
        format!("Kinematic scheme {}", self.projection.view.name)
    }

    /// Returns the rectangle that the pictures take. One of them has the symbols of the file's pose.
    pub(super) fn room_of(&self, frames: &[MovingPicture], start: usize) -> Rect {
        let mut area = bounds_of(&frames[start].at);
        for (n, frame) in frames.iter().enumerate() {
            for (spot, at) in self.spots.iter().zip(&frame.at) {
                // a symbol may turn
                let reach = 2.0 * spot.symbol.reach_of_room();
                let own = if n == start {
                    spot.rect
                } else {
                    Rect::around(*at, reach, reach)
                };
                area = area.with(&own);
            }
            for wire in &frame.wires {
                let margin = if wire.link { 4.0 } else { 3.0 };
                area = area.with(&bounds_of(&wire.points).grown_by(margin));
            }
        }
        for g in &self.grounds {
            area = area.with(&g.ground_room());
        }
        let traced = self.traces.0.iter().flatten().copied();
        for p in traced.chain(self.points.iter().map(|p| p.at)) {
            area = area.with(&Rect::around(p, 6.0, 6.0));
        }
        area
    }

    pub(super) fn draw_ground(&self, sheet: &mut Sheet) {
        for g in &self.grounds {
            sheet.note_symbol(g.ground_room());
            sheet.draw_shapes(&g.ground_shapes());
        }
    }

    /// Returns the symbol of a type that replaces that of a joint.
    pub(super) fn symbol_of(&self, i: usize, of: &JointType, place: &JointInSpace) -> Symbol {
        let Spot { joint, symbol, .. } = &self.spots[i];
        let view = &self.projection.view;
        Symbol::new(
            self.subject,
            *joint,
            of,
            place,
            view,
            symbol.size,
            symbol.slide,
        )
    }

    /// Returns the joints, with those first that others are drawn inside.
    pub(super) fn outer_first(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.spots.len()).collect();
        let size = |i: usize| self.spots[i].symbol.size;
        order.sort_by(|&a, &b| size(b).total_cmp(&size(a)));
        order
    }
}
