//! A joint type by itself: its two links as solids, aslant and along the axis z, with an arrow for each freedom.

mod arrows;
mod bodies;
mod by_symbol;
mod paint;
mod solids;
mod view;

use self::solids::PairPart;
use self::view::ReadyView;
use crate::draw::place::projection;
use crate::draw::sheet::{Caption, Drawing, Shape, Sheet, Swatch, plan};
use crate::model::joint_type::JointType;
use crate::svg::plane::{Rect, add};
use itertools::Itertools;

/// The space between the two views.
const BETWEEN: f64 = 36.0;

/// The look of what only these drawings have.
const STYLE: &str = include_str!("pairs/pair.css");

/// Draws a joint type in two views: as it is made where it has a name of its own, else by its symbol.
#[must_use]
pub fn joint_type(of: &JointType) -> Drawing {
    let faces = bodies::bodies(of);
    if faces.is_empty() {
        return by_symbol::joint_type(of);
    }
    let views = [projection::aslant(), projection::along_z()];
    let [left, right] = views.map(|v| ReadyView::new(&faces, of.freedoms(), &v));
    let wide = |r: Rect| r.right - r.left;
    let tall = |r: Rect| r.bottom - r.top;
    let height = tall(left.room).max(tall(right.room));
    let area = Rect {
        left: 0.0,
        top: 0.0,
        right: wide(left.room) + BETWEEN + wide(right.room),
        bottom: height,
    };
    let line = class_and_freedoms(of);
    let caption = Caption {
        title: of.name(),
        subtitle: [&line, "left aslant, right along the axis z"],
        description: &format!(
            "The joint type {}, {line}, as two links in two views, with an arrow for each freedom.",
            of.name()
        ),
        legend: legend(&faces, of),
    };
    let plan = plan(&caption, area, 0.0);
    let mut sheet = Sheet::new(&caption, &plan);
    sheet.style(STYLE);
    let second = wide(left.room) + BETWEEN;
    for (seen, x, name) in [(left, 0.0, "aslant"), (right, second, "along z")] {
        let top = (height - tall(seen.room)) / 2.0;
        let corner = [x - seen.room.left, top - seen.room.top];
        sheet.group("data-view", name, add(corner, plan.shift), |s| {
            seen.draw(s);
        });
    }
    sheet.finish(&caption, &plan)
}

/// The class of a type and its freedoms by name.
fn class_and_freedoms(of: &JointType) -> String {
    let freedoms = of.freedoms().iter().map(|f| f.name()).join(", ");
    let freedoms = if freedoms.is_empty() {
        "none"
    } else {
        &freedoms
    };
    format!("class {}, freedoms: {freedoms}", of.class())
}

/// What the tones and the arrows are, as far as they are there.
fn legend(faces: &[solids::SolidFace], of: &JointType) -> Vec<(Swatch, String)> {
    let corners = vec![[-13.0, -6.0], [13.0, -6.0], [13.0, 6.0], [-13.0, 6.0]];
    let swatch = |class: &str| {
        let box_of = |class: &str| Shape::Path {
            class: class.to_owned(),
            points: corners.clone(),
            closed: true,
        };
        vec![box_of(class), box_of("edge")]
    };
    let mut out = vec![
        (Swatch::Shapes(swatch("body-a")), "one link".to_owned()),
        (
            Swatch::Shapes(swatch("body-b")),
            "the other link".to_owned(),
        ),
    ];
    if faces.iter().any(|f| f.part == PairPart::Between) {
        let between = Swatch::Shapes(swatch("body-c"));
        out.push((between, "a part between them".to_owned()));
    }
    if faces.iter().any(|f| f.cut) {
        let mut strokes = swatch("cut");
        strokes.extend((-1..=1).map(|i| {
            let x = 7.0 * f64::from(i);
            Shape::line("hatch".to_owned(), vec![[x - 5.0, 5.0], [x + 5.0, -5.0]])
        }));
        out.push((Swatch::Shapes(strokes), "cut open".to_owned()));
    }
    if !of.freedoms().is_empty() {
        let arrow = Shape::line("freedom".to_owned(), vec![[-12.0, 0.0], [12.0, 0.0]]);
        out.push((Swatch::Shapes(vec![arrow]), "a freedom".to_owned()));
    }
    out
}
