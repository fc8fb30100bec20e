//! Links of a URDF: weight and shapes.

use crate::geom::rigid::Motion;
use crate::robots::convert::payload::{Shape, Solid};
use crate::robots::convert::text::xyz_rpy;
use crate::robots::convert::to_urdf::{Loops, Writer};
use crate::robots::single_freedoms::{escape, number, numbers};
use std::fmt::Write;

impl Writer<'_> {
    /// A link and what it carries, its frame where the joint that holds it is.
    pub(super) fn link(&mut self, l: usize, moving: bool) {
        let back = self.frames[&l].inverse();
        let name = escape(&self.names[&l]);
        let mut inside = String::new();
        match self.scene.weight(l) {
            Some(w) => {
                let (w, _) = self.scene.admitted(l, w, moving, &mut self.out.lost);
                let [xx, yy, zz, xy, xz, yz] = w.tensor.map(number);
                let at = xyz_rpy(&back.then(&w.place));
                let _ = writeln!(
                    inside,
                    "    <inertial><origin {at}/><mass value=\"{}\"/><inertia ixx=\"{xx}\" ixy=\"{xy}\" ixz=\"{xz}\" iyy=\"{yy}\" iyz=\"{yz}\" izz=\"{zz}\"/></inertial>",
                    w.mass
                );
            }
            None if moving => {
                let _ = writeln!(inside, "    {}", self.scene.light.urdf());
            }
            None => {}
        }
        for s in self.scene.shapes(l) {
            self.shape(l, s, &back, &mut inside);
        }
        match inside.is_empty() {
            true => {
                let _ = writeln!(self.head, "  <link name=\"{name}\"/>");
            }
            false => {
                let _ = write!(self.head, "  <link name=\"{name}\">\n{inside}  </link>\n");
            }
        }
    }

    fn shape(&mut self, l: usize, s: &Shape, back: &Motion, out: &mut String) {
        let name = s.name.clone();
        let called = name.clone().or(Some(self.scene.robot.links[l].clone()));
        if !s.words.is_empty() {
            self.out
                .lost
                .no_word("contact settings of a shape", called.as_deref());
        }
        let place = back.then(&s.place);
        let beside = |z: f64| place.then(&Motion::shift([0.0, 0.0, z]));
        let drake = self.loops == Loops::Drake;
        let parts: Vec<(Motion, String)> = match &s.solid {
            Solid::Box(edges) => vec![(place, format!("<box size=\"{}\"/>", numbers(*edges)))],
            Solid::Sphere(r) => vec![(place, format!("<sphere radius=\"{}\"/>", number(*r)))],
            Solid::Cylinder(r, l) => vec![(place, cylinder(*r, *l))],
            Solid::Capsule(r, l) if drake => {
                vec![(
                    place,
                    format!(
                        "<drake:capsule radius=\"{}\" length=\"{}\"/>",
                        number(*r),
                        number(*l)
                    ),
                )]
            }
            Solid::Capsule(r, l) => {
                let why = "a cylinder and two balls stand for it";
                self.out.lost.one("capsule", called.as_deref(), why);
                let ball = format!("<sphere radius=\"{}\"/>", number(*r));
                let ends = [l / 2.0, -l / 2.0].map(|z| (beside(z), ball.clone()));
                std::iter::once((place, cylinder(*r, *l)))
                    .chain(ends)
                    .collect()
            }
            Solid::Ellipsoid([a, b, c]) if drake => {
                let [a, b, c] = [a, b, c].map(|x| number(*x));
                vec![(
                    place,
                    format!("<drake:ellipsoid a=\"{a}\" b=\"{b}\" c=\"{c}\"/>"),
                )]
            }
            Solid::Ellipsoid(_) | Solid::Plane(_) => {
                let kind = if matches!(s.solid, Solid::Plane(_)) {
                    "plane"
                } else {
                    "ellipsoid"
                };
                self.out.lost.no_word(kind, called.as_deref());
                Vec::new()
            }
            Solid::Mesh(file, scale) => {
                vec![(
                    place,
                    format!(
                        "<mesh filename=\"{}\" scale=\"{}\"/>",
                        escape(file),
                        numbers(*scale)
                    ),
                )]
            }
        };
        let tags = s.use_.tags();
        for (i, (at, shape)) in parts.iter().enumerate() {
            let named = name.as_ref().filter(|_| i == 0);
            let named = named.map_or(String::new(), |n| format!(" name=\"{}\"", escape(n)));
            for tag in tags {
                let colour = match (s.colour, *tag) {
                    (Some(c), "visual") => {
                        let c = c.map(|x| number(x).to_string()).join(" ");
                        format!("<material name=\"\"><color rgba=\"{c}\"/></material>")
                    }
                    _ => String::new(),
                };
                let at = xyz_rpy(at);
                let _ = writeln!(
                    out,
                    "    <{tag}{named}><origin {at}/><geometry>{shape}</geometry>{colour}</{tag}>"
                );
            }
        }
    }
}

fn cylinder(r: f64, l: f64) -> String {
    format!(
        "<cylinder radius=\"{}\" length=\"{}\"/>",
        number(r),
        number(l)
    )
}
