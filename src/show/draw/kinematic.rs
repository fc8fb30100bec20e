//! The kinematic scheme: links and the symbols of joints where the coordinates have them.

use crate::draw::kinematic::body::{Arrow, DrawnWire, Marked, Wire, known_loads};
use crate::draw::naming::draw_leaders;
use crate::draw::place::projection::Projection;
use crate::draw::prelude::*;
use crate::draw::sheet::{Caption, draw_sheet};
use crate::draw::subject;
use crate::draw::symbol::ground::Ground;
use crate::draw::symbol::placed::{Swap, Symbol};

mod body;
mod gears;
mod legend;
mod loads;
pub(super) mod moving;
mod naming;
mod on_paper;
pub(super) mod scene;
mod wire;

/// The room below for the axes and the scale.
const STRIP: f64 = 84.0;

/// Draws the kinematic scheme.
///
/// # Examples
/// ```
/// use ozols::{draw::{Subject, kinematic}, model::mechanism::StateId};
/// let bennett = ozols::built_in("bennett")?;
/// let subject = Subject { mechanism: &bennett, state: StateId::FREE, analysis: None, marks: None };
/// let drawing = kinematic(&subject);
/// assert!(drawing.svg.starts_with("<svg") && drawing.labels.iter().any(|l| l.text.contains("bennett")));
/// # Ok::<(), ozols::Error>(())
/// ```
#[must_use]
pub fn kinematic(subject: &Subject<'_>) -> Drawing {
    kinematic_seen(subject, &Sight::default(), None)
}

/// Draws the kinematic scheme as seen from a side, with a self-stress as arrows on the links that it loads where one is given with its
/// name, which goes under the title.
///
/// # Examples
/// ```
/// use ozols::{draw::{Sight, Subject, kinematic_seen}, model::mechanism::StateId};
/// let four_bar = ozols::built_in("four-bar")?;
/// let free = &ozols::analyze(&four_bar)?[0];
/// let subject = Subject { mechanism: &four_bar, state: StateId::FREE, analysis: Some(free), marks: None };
/// let along_x = Sight { toward: Some([1.0, 0.0, 0.0]), ..Sight::default() };
/// let stress = Some(("the first of three", &free.self_stresses[0]));
/// assert!(kinematic_seen(&subject, &along_x, stress).svg.contains("the first of three"));
/// # Ok::<(), ozols::Error>(())
/// ```
#[must_use]
pub fn kinematic_seen(
    subject: &Subject<'_>,
    sight: &Sight,
    stress: Option<(&str, &SelfStress)>,
) -> Drawing {
    let mut drawn = Kinematic::new(subject, sight);
    drawn.show_stress(stress);
    drawn.draw_sheet()
}

/// Draws the kinematic scheme with room for the symbols of other joints in place of some.
#[must_use]
pub(crate) fn kinematic_with(subject: &Subject<'_>, swaps: &[Swap<'_>]) -> Drawing {
    let mut drawn = Kinematic::new(subject, &Sight::default());
    for swap in swaps {
        drawn.make_room(swap);
    }
    drawn.draw_sheet()
}

/// A joint on paper.
struct Spot {
    joint: JointId,
    at: Point,
    symbol: Symbol,
    /// The room of the symbol, the ring of a drive included.
    rect: Rect,
}

/// One picture of a moving scheme.
struct MovingPicture {
    /// The points of interest.
    points: Vec<Point>,
    /// The joints with their frames.
    places: Vec<JointInSpace>,
    at: Vec<Point>,
    /// The shapes on links.
    wires: Vec<DrawnWire>,
    /// The arrows of a self-stress.
    arrows: Vec<Arrow>,
}

/// A scheme under way.
struct Kinematic<'a> {
    subject: &'a Subject<'a>,
    spots: Vec<Spot>,
    links: Vec<(LinkId, Vec<usize>)>,
    /// The shapes of links and gears.
    wires: Vec<Wire>,
    grounds: Vec<Ground>,
    /// The joints in space.
    places: Vec<JointInSpace>,
    /// The points of interest of the links drawn.
    points: Vec<Marked>,
    /// The ways of points over a motion, and whether each ends where it began.
    traces: (Vec<Vec<Point>>, bool),
    /// The loads that are shown.
    arrows: Vec<Arrow>,
    /// The line under the title if it is not the figures.
    shows: Option<String>,
    projection: Projection,
}

impl Kinematic<'_> {
    /// Returns the free end of a link with one joint, unless it leads to a point of interest.
    fn loose_end(&self, link: usize) -> Option<Point> {
        let (link, of) = &self.links[link];
        let &[only] = of.as_slice() else { return None };
        if self.points_of(*link).next().is_some() {
            return None;
        }
        let at = self.spots[only].at;
        let others = self
            .links
            .iter()
            .filter(|(l, o)| o.len() > 1 && o.contains(&only) && !self.is_frame(*l));
        let others = others.flat_map(|(_, o)| o).filter(|&&i| i != only);
        let dirs: Vec<Point> = others.map(|&i| unit(sub(at, self.spots[i].at))).collect();
        let away = if dirs.is_empty() {
            [0.8, -0.6]
        } else {
            mean(dirs.into_iter())
        };
        Some(add(at, scale(unit(away), 48.0)))
    }

    /// Adds the arrows of a self-stress at the pose of the file, and its name.
    fn show_stress(&mut self, stress: Option<(&str, &SelfStress)>) {
        if let Some((name, stress)) = stress {
            self.arrows = self.arrows_of(&known_loads(stress), None);
            self.shows = Some(name.to_owned());
        }
    }

    fn is_frame(&self, link: LinkId) -> bool {
        self.subject.mechanism.links[link].role == Role::Frame
    }

    fn is_output(&self, link: LinkId) -> bool {
        self.subject.mechanism.links[link].role == Role::Output
    }

    fn draw_sheet(self) -> Drawing {
        let rest = self.picture_in(None, &[]);
        let names = self.place_labels(&rest);
        let labels = names.iter().map(|(place, _)| place.rect);
        let room = labels.chain(self.arrow_room(&self.arrows));
        let area = room.fold(self.room_of(std::slice::from_ref(&rest), 0), |a, r| {
            a.with(&r)
        });
        self.on_sheet(area, self.legend_rows(), |sheet, by| {
            sheet.draw_group("data-drawing", "", by, |s| {
                self.draw_ground(s);
                self.draw_at_rest(s, &rest);
                for (a, b) in self.coupling_lines() {
                    s.draw_line(subject::COUPLING, a, b);
                }
                draw_leaders(s, &names);
                self.draw_arrows(s);
                for (place, name) in &names {
                    name.draw_name(s, place.rect.middle());
                }
            });
        })
    }

    /// Lays out a sheet for an area and draws on it; `draw` gets the offset of the scheme on the sheet.
    fn on_sheet(
        &self,
        area: Rect,
        legend: Vec<(Swatch, String)>,
        draw: impl FnOnce(&mut Sheet, Point),
    ) -> Drawing {
        let [what, figures] = self.subject.subtitle_lines(&self.view_title());
        let shows = self.shows.iter().map(|shows| format!(" Shown: {shows}."));
        let caption = Caption {
            title: &self.subject.drawing_title(),
            subtitle: [&what, self.shows.as_ref().unwrap_or(&figures)],
            description: &(self.describe_drawing() + &shows.collect::<String>()),
            legend,
        };
        draw_sheet(&caption, area, STRIP, |sheet, shift, below| {
            draw(sheet, shift);
            sheet.draw_group("data-home", "scale", [0.0; 2], |s| {
                self.draw_axes(s, below + 34.0);
                self.draw_scale(s, below + 40.0);
            });
        })
    }

    /// Draws a picture with the symbols of the file's pose, in groups that name each part.
    fn draw_at_rest(&self, sheet: &mut Sheet, picture: &MovingPicture) {
        self.draw_traces(sheet);
        self.draw_picture(sheet, picture, true);
        for i in self.outer_first() {
            let (s, at) = (&self.spots[i], picture.at[i]);
            sheet.note_symbol(s.rect.moved_by(sub(at, s.at)));
            let mark = self.subject.joint_mark(s.joint);
            let id = &self.subject.mechanism.joints[s.joint].id;
            sheet.draw_group("data-joint", id, at, |sheet| {
                s.symbol.draw_symbol(sheet, mark);
            });
        }
    }

    /// Returns the classes of a link.
    fn link_classes(&self, link: usize, plate: bool) -> String {
        let (l, of) = &self.links[link];
        let here = of
            .iter()
            .all(|&i| self.subject.only_here(self.spots[i].joint));
        format!(
            "{}{}{}{}",
            if plate { "plate" } else { "bone" },
            if self.is_output(*l) { " out" } else { "" },
            self.subject.link_mark(*l).mark_class(),
            if here { " dash" } else { "" }
        )
    }
}
