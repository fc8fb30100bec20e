//! Links of an SDF file: place, weight and shapes.

use crate::geom::rigid::RigidMotion;
use crate::robots::convert::payload::{LinkShape, Solid};
use crate::robots::convert::text::pose;
use crate::robots::convert::to_sdf::ToSdf;
use crate::robots::mechanism::series_of_single_joints::{Names, escape, number, numbers};
use std::fmt::Write;

impl ToSdf<'_> {
    pub(super) fn link(&mut self, l: usize) {
        if self.links[&l] == "world" {
            self.ground(l);
            return;
        }
        let scene = self.scene;
        let mut inside = String::new();
        let mut names = Names::default();
        let at = &scene.places[l];
        if *at != RigidMotion::IDENTITY {
            let _ = writeln!(inside, "      <pose>{}</pose>", pose(at));
        }
        match scene.weight(l) {
            Some(w) => {
                let (w, _) = scene.admitted(l, w, true, &mut self.out.lost);
                let [xx, yy, zz, xy, xz, yz] = w.tensor.map(number);
                let _ = writeln!(
                    inside,
                    "      <inertial><pose>{}</pose><mass>{}</mass><inertia><ixx>{xx}</ixx><iyy>{yy}</iyy><izz>{zz}</izz><ixy>{xy}</ixy><ixz>{xz}</ixz><iyz>{yz}</iyz></inertia></inertial>",
                    pose(&w.place),
                    w.mass
                );
            }
            None => {
                let _ = writeln!(inside, "      {}", scene.light.sdf());
                let why = "links without mass weigh next to nothing: SDF takes 1 kg for granted";
                if !self.out.told.iter().any(|t| t == why) {
                    self.out.told.push(why.to_owned());
                }
            }
        }
        for s in scene.shapes(l) {
            self.shape(l, s, &mut names, &mut inside);
        }
        let name = escape(&self.links[&l]);
        let _ = write!(
            self.head,
            "    <link name=\"{name}\">\n{inside}    </link>\n"
        );
    }

    /// The world has no shapes in a model: a link that stands still has them.
    fn ground(&mut self, world: usize) {
        let scene = self.scene;
        if scene.shapes(world).is_empty() {
            return;
        }
        let mut inside = String::new();
        let mut names = Names::default();
        for s in scene.shapes(world) {
            self.shape(world, s, &mut names, &mut inside);
        }
        let name = self.names.fit("ground");
        let _ = write!(
            self.head,
            "    <link name=\"{}\">\n{inside}    </link>\n",
            escape(&name)
        );
        let joint = self.names.fit(&format!("world-{name}"));
        self.ground = Some(name.clone());
        let ends = ["world".to_owned(), name];
        self.put(&joint, "fixed", &ends, &RigidMotion::IDENTITY, "");
    }

    fn shape(&mut self, l: usize, s: &LinkShape, names: &mut Names, out: &mut String) {
        if !s.words.is_empty() {
            self.out.lost.no_word(
                "contact settings of a shape",
                s.name.as_deref().or(Some(&self.scene.robot.links[l])),
            );
        }
        let geometry = match &s.solid {
            Solid::Box(edges) => format!("<box><size>{}</size></box>", numbers(*edges)),
            Solid::Sphere(r) => format!("<sphere><radius>{}</radius></sphere>", number(*r)),
            Solid::Cylinder(r, l) => round("cylinder", *r, *l),
            Solid::Capsule(r, l) => round("capsule", *r, *l),
            Solid::Ellipsoid(half) => {
                format!("<ellipsoid><radii>{}</radii></ellipsoid>", numbers(*half))
            }
            Solid::Plane([x, y]) => {
                format!(
                    "<plane><normal>0 0 1</normal><size>{} {}</size></plane>",
                    number(*x),
                    number(*y)
                )
            }
            Solid::Mesh(file, scale) => {
                format!(
                    "<mesh><uri>{}</uri><scale>{}</scale></mesh>",
                    escape(file),
                    numbers(*scale)
                )
            }
        };
        for tag in s.use_.tags() {
            let wanted = s.name.clone().unwrap_or_else(|| (*tag).to_owned());
            let name = escape(&names.fit(&wanted));
            let colour = match (s.colour, *tag) {
                (Some(c), "visual") => {
                    let c = c.map(|x| number(x).to_string()).join(" ");
                    format!("<material><ambient>{c}</ambient><diffuse>{c}</diffuse></material>")
                }
                _ => String::new(),
            };
            let _ = writeln!(
                out,
                "      <{tag} name=\"{name}\"><pose>{}</pose><geometry>{geometry}</geometry>{colour}</{tag}>",
                pose(&s.place)
            );
        }
    }
}

fn round(word: &str, r: f64, l: f64) -> String {
    format!(
        "<{word}><radius>{}</radius><length>{}</length></{word}>",
        number(r),
        number(l)
    )
}
