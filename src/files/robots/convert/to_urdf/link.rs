//! Links of a URDF: weight and shapes.

use crate::geom::rigid::RigidMotion;
use crate::robots::convert::payload::{LinkShape, Solid};
use crate::robots::convert::text::xyz_rpy;
use crate::robots::convert::to_urdf::{Loops, ToUrdf};
use crate::robots::mechanism::series_of_single_joints::{escape, number, numbers};
use std::fmt::Write;

impl ToUrdf<'_> {
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
        if inside.is_empty() {
            let _ = writeln!(self.head, "  <link name=\"{name}\"/>");
        } else {
            let _ = write!(self.head, "  <link name=\"{name}\">\n{inside}  </link>\n");
        }
    }

    fn shape(&mut self, l: usize, s: &LinkShape, back: &RigidMotion, out: &mut String) {
        let called = s.name.as_deref().unwrap_or(&self.scene.robot.links[l]);
        if !s.words.is_empty() {
            self.out
                .lost
                .no_word("contact settings of a shape", Some(called));
        }
        let parts = self.solids(&s.solid, back.then(&s.place), called);
        for (i, (at, shape)) in parts.iter().enumerate() {
            let named = s.name.as_ref().filter(|_| i == 0);
            let named = named.map_or(String::new(), |n| format!(" name=\"{}\"", escape(n)));
            for tag in s.use_.tags() {
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

    /// What stands for a solid: one shape that URDF or Drake has, a few in its place, or none, which is told.
    fn solids(
        &mut self,
        solid: &Solid,
        place: RigidMotion,
        called: &str,
    ) -> Vec<(RigidMotion, String)> {
        let drake = self.loops == Loops::Drake;
        let lost = &mut self.out.lost;
        let one = match solid {
            Solid::Box(edges) => format!("<box size=\"{}\"/>", numbers(*edges)),
            Solid::Sphere(r) => ball(*r),
            Solid::Cylinder(r, l) => round("cylinder", *r, *l),
            Solid::Capsule(r, l) if drake => round("drake:capsule", *r, *l),
            Solid::Capsule(r, l) => {
                let why = "a cylinder and two balls stand for it";
                lost.one("capsule", Some(called), why);
                let end = |z: f64| (place.then(&RigidMotion::shift([0.0, 0.0, z])), ball(*r));
                let middle = (place, round("cylinder", *r, *l));
                return vec![middle, end(l / 2.0), end(-l / 2.0)];
            }
            Solid::Ellipsoid(half) if drake => {
                let [a, b, c] = half.map(number);
                format!("<drake:ellipsoid a=\"{a}\" b=\"{b}\" c=\"{c}\"/>")
            }
            Solid::Ellipsoid(_) => {
                lost.no_word("ellipsoid", Some(called));
                return Vec::new();
            }
            Solid::Plane(_) => {
                lost.no_word("plane", Some(called));
                return Vec::new();
            }
            Solid::Mesh(file, scale) => {
                let (file, scale) = (escape(file), numbers(*scale));
                format!("<mesh filename=\"{file}\" scale=\"{scale}\"/>")
            }
        };
        vec![(place, one)]
    }
}

fn ball(r: f64) -> String {
    format!("<sphere radius=\"{}\"/>", number(r))
}

fn round(tag: &str, r: f64, l: f64) -> String {
    let (r, l) = (number(r), number(l));
    format!("<{tag} radius=\"{r}\" length=\"{l}\"/>")
}
