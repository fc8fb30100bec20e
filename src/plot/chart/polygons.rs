//! Vectors set head to tail in adjacent panels: force plans that close in equilibrium.

use super::frame::{Head, begin_picture, begin_text, draw_stroke};
use crate::chart::data::{PAD, WIDTH};
use crate::format::{csv, four_digits};
use crate::svg::plane::{Point, Rect, add, bounds_of, path_data, plane_norm, scale, sub, unit};
use crate::svg::xml::Xml;

/// A vector of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanArrow {
    /// Its name.
    pub name: String,
    /// Components, with x to the right and y up.
    pub vector: [f64; 2],
    /// Index of one of the seven colours.
    pub colour: usize,
}

/// Vectors head to tail.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Title of the sum.
    pub title: String,
    /// The vectors in order.
    pub arrows: Vec<PlanArrow>,
}

impl Panel {
    /// Returns the size of the sum of the vectors, zero if the plan closes.
    ///
    /// # Examples
    /// ```
    /// use ozols::chart::{Panel, PlanArrow};
    /// let arrow = |name: &str, vector| PlanArrow { name: name.into(), vector, colour: 0 };
    /// let arrows = vec![arrow("F", [3.0, 4.0]), arrow("R", [-3.0, -4.0])];
    /// assert_eq!(Panel { title: "Link 1".into(), arrows }.closing_gap(), 0.0); // In equilibrium.
    /// ```
    #[must_use]
    pub fn closing_gap(&self) -> f64 {
        plane_norm(self.arrows.iter().fold([0.0; 2], |s, a| add(s, a.vector)))
    }

    fn longest_vector(&self) -> f64 {
        self.arrows
            .iter()
            .map(|a| plane_norm(a.vector))
            .fold(0.0, f64::max)
    }

    /// Returns the heads of the vectors from the origin, y down.
    fn vector_heads(&self) -> Vec<Point> {
        let mut at = [0.0; 2];
        let mut out = vec![at];
        for a in &self.arrows {
            at = add(at, [a.vector[0], -a.vector[1]]);
            out.push(at);
        }
        out
    }
}

/// Two panels side by side.
#[derive(Clone, Debug, PartialEq)]
pub struct PanelPair {
    /// The left and the right panel.
    pub panels: [Panel; 2],
    /// Whether both are drawn at one scale.
    pub one_scale: bool,
}

/// Plans in rows of two.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygons {
    /// The title.
    pub title: String,
    /// One sentence under the title, or empty.
    pub subtitle: String,
    /// Unit of the vectors.
    pub unit: String,
    /// The panels, two per row.
    pub rows: Vec<PanelPair>,
}

/// Height of a plan, height of a line of its list, and length of an arrowhead. `[px]`
const PLAN: f64 = 230.0;
const LINE: f64 = 15.0;
const HEAD: f64 = 9.0;

impl Polygons {
    /// Returns the picture.
    #[must_use]
    pub fn svg(&self) -> String {
        let head = Head::new(&self.title, &self.subtitle, WIDTH);
        let lines =
            |row: &PanelPair| row.panels.iter().map(|p| p.arrows.len()).max().unwrap_or(0) + 1;
        #[allow(clippy::cast_precision_loss, reason = "a few lines")]
        let heights: Vec<f64> = self
            .rows
            .iter()
            .map(|r| PLAN + 30.0 + LINE * lines(r) as f64 + PAD)
            .collect();
        let height = head.head_height() + heights.iter().sum::<f64>() + PAD;
        let about = "Vectors head to tail; a plan that closes is in equilibrium.";
        let mut xml = begin_picture((WIDTH, height), "oz", &self.title, about, &head);
        let mut top = head.head_height() + 6.0;
        let half = (WIDTH - 3.0 * PAD) / 2.0;
        for (row, taken) in self.rows.iter().zip(heights) {
            let boxes = row.panels.each_ref().map(|p| bounds_of(&p.vector_heads()));
            let fits = boxes.map(|b| {
                let (wide, high) = (b.right - b.left, b.bottom - b.top);
                ((half - 70.0) / wide.max(1e-300)).min((PLAN - 50.0) / high.max(1e-300))
            });
            for (k, panel) in row.panels.iter().enumerate() {
                let by = if row.one_scale {
                    fits[0].min(fits[1])
                } else {
                    fits[k]
                };
                #[allow(clippy::cast_precision_loss, reason = "two columns")]
                let left = PAD + k as f64 * (half + PAD);
                let room = Rect::new(left, top + 22.0, left + half, top + 22.0 + PLAN);
                begin_text(&mut xml, "sub", (left, top + 14.0), "").write_text(&panel.title);
                draw_plan(&mut xml, panel, &boxes[k], &room, by);
                self.write_list(&mut xml, panel, [left, room.bottom + LINE]);
            }
            top += taken;
        }
        xml.finish_document()
    }

    /// Writes the vectors by name and size.
    fn write_list(&self, xml: &mut Xml, panel: &Panel, [x, mut y]: Point) {
        for a in &panel.arrows {
            let line = format!("line c{}", a.colour);
            draw_stroke(xml, &line, (x, y - 4.0), (x + 18.0, y - 4.0));
            let angle = a.vector[1].atan2(a.vector[0]).to_degrees();
            let text = format!(
                "{}: {} {} at {angle:.1}°",
                a.name,
                four_digits(plane_norm(a.vector)),
                self.unit
            );
            begin_text(xml, "small", (x + 24.0, y), "").write_text(&text);
            y += LINE;
        }
        let share = panel.closing_gap() / panel.longest_vector().max(1e-300);
        let text = format!("closes to {share:.0e} of the longest");
        begin_text(xml, "small soft", (x + 24.0, y), "").write_text(&text);
    }

    /// Returns one vector per line.
    #[must_use]
    pub fn csv(&self) -> String {
        let panels = self.rows.iter().flat_map(|r| &r.panels);
        let row = |p: &Panel, a: &PlanArrow| {
            let [x, y] = a.vector.map(|x| format!("{x:?}"));
            vec![p.title.clone(), a.name.clone(), x, y]
        };
        let rows = panels.flat_map(|p| p.arrows.iter().map(move |a| row(p, a)));
        csv::write_table(&["plan", "vector", "x", "y"], rows)
    }
}

fn draw_plan(xml: &mut Xml, panel: &Panel, is: &Rect, room: &Rect, by: f64) {
    let to = |p: Point| add(room.middle(), scale(sub(p, is.middle()), by));
    let corners: Vec<Point> = panel.vector_heads().into_iter().map(to).collect();
    for (a, ends) in panel.arrows.iter().zip(corners.windows(2)) {
        let (from, to) = (ends[0], ends[1]);
        let (along, long) = (unit(sub(to, from)), plane_norm(sub(to, from)));
        if long < 0.5 {
            continue;
        }
        let barb = HEAD.min(long);
        let neck = sub(to, scale(along, barb));
        let aside = scale([-along[1], along[0]], barb / 3.0);
        draw_stroke(
            xml,
            &format!("line c{}", a.colour),
            from.into(),
            neck.into(),
        );
        let corners = [to, add(neck, aside), sub(neck, aside)];
        let head = xml
            .begin_tag("path")
            .set_text("class", &format!("f{}", a.colour));
        head.set_text("d", &path_data(&corners, true)).close_empty();
        if long >= 24.0 {
            let middle = scale(add(from, to), 0.5);
            // To the left of its direction, so that two opposite vectors have their names apart.
            let normal = [along[1], -along[0]];
            let at = add(middle, scale(normal, 8.0));
            let anchor = match normal[0] {
                x if x > 0.3 => "start",
                x if x < -0.3 => "end",
                _ => "middle",
            };
            begin_text(xml, "small halo", (at[0], at[1] + 4.0), anchor).write_text(&a.name);
        }
    }
}
