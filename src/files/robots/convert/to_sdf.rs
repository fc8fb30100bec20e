//! A robot as SDF: links where they stand in the pose that is written, every joint between the links that it has, those that
//! close loops among them. A joint takes its place from the drawn pose, so that its value is zero there.

mod link;

use crate::geom::rigid::RigidMotion;
use crate::geom::vector::Vector;
use crate::model::joint_type::JointType;
use crate::robots::convert::mimics::{Follows, mimics};
use crate::robots::convert::payload::Dynamics;
use crate::robots::convert::plan::{Moves, Single, singles};
use crate::robots::convert::scene::{RobotScene, Text, limits, name_of};
use crate::robots::convert::text::pose;
use crate::robots::mechanism::series_of_single_joints::{Names, escape, number, numbers};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fmt::Write;

/// What a file collects.
struct ToSdf<'a> {
    scene: &'a RobotScene<'a>,
    names: Names,
    links: BTreeMap<usize, String>,
    joints: BTreeMap<usize, String>,
    /// The link that carries what stands on the world.
    ground: Option<String>,
    mimics: BTreeMap<usize, Follows>,
    head: String,
    body: String,
    out: Text,
    /// Joints whose values are shifted.
    shifted: usize,
}

/// Writes it.
pub(crate) fn sdf(scene: &RobotScene<'_>) -> Text {
    let mut w = ToSdf {
        scene,
        names: Names::default(),
        links: BTreeMap::new(),
        joints: BTreeMap::new(),
        ground: None,
        mimics: BTreeMap::new(),
        head: String::new(),
        body: String::new(),
        out: Text::default(),
        shifted: 0,
    };
    let (robot, plan) = (scene.robot, scene.plan);
    w.names.fit("world");
    let order = std::iter::once(plan.root).chain(plan.branches.iter().map(|b| b.link));
    let order: Vec<usize> = order.collect();
    for &l in &order {
        let name = if robot.world == Some(l) {
            "world".to_owned()
        } else {
            w.fit(&robot.links[l])
        };
        w.links.insert(l, name);
    }
    for (j, part) in robot.joints.iter().enumerate() {
        // A body without joints has no name for what holds it but its own.
        let name = if part.is_nameless(robot) {
            w.names.fit(&format!("{}_mount", part.id))
        } else {
            w.fit(&part.id)
        };
        w.joints.insert(j, name);
    }
    w.mimics = mimics(scene, |_| true, true, &mut w.out.lost);
    for &l in &order {
        w.link(l);
    }
    if robot.world != Some(plan.root) {
        let name = w.fit(&format!("world-{}", robot.links[plan.root]));
        let ends = ["world".to_owned(), w.links[&plan.root].clone()];
        w.put(&name, "fixed", &ends, &RigidMotion::IDENTITY, "");
    }
    for j in 0..robot.joints.len() {
        w.joint(j);
    }
    w.whole()
}

/// A joint of SDF that has all of a joint's freedoms, with its axes; none where they need links in between.
fn as_one(joint_type: &JointType, all: &[Single]) -> Option<(&'static str, Vec<Vector>)> {
    match (joint_type, all) {
        (_, []) => Some(("fixed", Vec::new())),
        (JointType::Spherical, _) => Some(("ball", Vec::new())),
        (JointType::Universal, [x, y]) => {
            // The frame of the first link's end as the second link sees it: turned back by all that the joint has done.
            let moved = x.displacement().then(&y.displacement());
            Some(("universal", vec![moved.inverse().direction(x.axis), y.axis]))
        }
        (_, [s]) => Some((kind(s), vec![s.axis])),
        _ => None,
    }
}

/// How far a screw goes in a turn, where it is one.
fn thread(s: &Single) -> String {
    let Moves::Screw(pitch) = s.moves else {
        return String::new();
    };
    let turn = number(pitch * TAU);
    format!("      <screw_thread_pitch>{turn}</screw_thread_pitch>\n")
}

impl ToSdf<'_> {
    /// A name that no other link or joint has; what SDF keeps for itself is changed.
    fn fit(&mut self, wanted: &str) -> String {
        let plain = if wanted.starts_with("__") && wanted.ends_with("__") {
            wanted.trim_matches('_')
        } else {
            wanted
        };
        let name = self.names.fit(plain);
        if name != wanted {
            let why = "names of links and joints are unique together there";
            self.out
                .lost
                .one("name that another has", Some(wanted), why);
        }
        name
    }

    fn joint(&mut self, j: usize) {
        let part = self.scene.part(j).clone();
        let [Some(a), Some(b)] = part.links.map(|l| self.links.get(&l).cloned()) else {
            return;
        };
        // The world is no child in SDF: such a joint is seen from its other end.
        let back = b == "world";
        let (a, b) = if back { (b, a) } else { (a, b) };
        let [first, second] = if back { [1, 0] } else { [0, 1] };
        let all = singles(&part, back);
        if all.len() == 6 && a == "world" && !part.closes {
            self.out
                .told
                .push(format!("{b} floats, as what no joint holds does there"));
            return;
        }
        self.unsaid(j);
        if part.values.len() == 1 && part.values[0] != 0.0 {
            self.shifted += 1;
        }
        let name = self.joints[&j].clone();
        let far = part.sides[second];
        if let Some((kind, axes)) = as_one(&part.joint_type, &all) {
            let mut more = String::new();
            for (i, axis) in axes.iter().enumerate() {
                let alone = axes.len() == 1;
                more += &self.axis(j, i, *axis, alone);
            }
            if let [s] = &all[..] {
                more += &thread(s);
            }
            if kind == "ball" && self.scene.payload.of(j, 0).damping != 0.0 {
                self.out
                    .lost
                    .no_word("damping of a ball joint", Some(&part.id));
            }
            self.put(&name, kind, &[a, b], &far, &more);
            return;
        }
        let near = self.scene.places[part.links[first]].then(&part.sides[first]);
        self.series(j, &all, [a, b], near, far);
    }

    /// Freedoms in series, through light links where they stand in the pose.
    fn series(
        &mut self,
        j: usize,
        all: &[Single],
        [from, to]: [String; 2],
        near: RigidMotion,
        end: RigidMotion,
    ) {
        let name = self.joints[&j].clone();
        let (mut from, mut at) = (from, near);
        for (i, s) in all.iter().enumerate() {
            at = at.then(&s.displacement());
            let own = match i {
                0 => name.clone(),
                i => self.names.fit(&name_of(&name, i)),
            };
            let last = i + 1 == all.len();
            let held = if last {
                to.clone()
            } else {
                let light = self.names.fit(&format!("{own}~link"));
                let _ = write!(
                    self.head,
                    "    <link name=\"{}\">\n      <pose>{}</pose>\n      {}\n    </link>\n",
                    escape(&light),
                    pose(&at),
                    self.scene.light.sdf()
                );
                light
            };
            let far = if last { end } else { RigidMotion::IDENTITY };
            let mut more = self.axis(j, s.freedom, s.axis, false);
            more += &thread(s);
            self.put(&own, kind(s), &[from, held.clone()], &far, &more);
            from = held;
        }
    }

    fn axis(&self, j: usize, i: usize, axis: Vector, alone: bool) -> String {
        let tag = if i == 1 && !alone && self.scene.part(j).joint_type == JointType::Universal {
            "axis2"
        } else {
            "axis"
        };
        let value = if alone {
            self.scene.part(j).values[0]
        } else {
            0.0
        };
        let d = self.scene.payload.of(j, i);
        let mut inside = format!("<xyz>{}</xyz>", numbers(axis));
        let limits = alone.then(|| limits(self.scene, j)).flatten();
        let mut bounds = String::new();
        if let Some((low, high)) = limits {
            let (low, high) = (number(low - value), number(high - value));
            let _ = write!(bounds, "<lower>{low}</lower><upper>{high}</upper>");
        }
        for (tag, x) in [("effort", d.effort), ("velocity", d.velocity)] {
            if x.is_finite() {
                let _ = write!(bounds, "<{tag}>{x}</{tag}>");
            }
        }
        if !bounds.is_empty() {
            let _ = write!(inside, "<limit>{bounds}</limit>");
        }
        let rest = if d.stiffness > 0.0 {
            d.rest - value
        } else {
            0.0
        };
        let said = [
            ("damping", d.damping),
            ("friction", d.friction),
            ("spring_reference", rest),
            ("spring_stiffness", d.stiffness),
        ];
        if said.iter().any(|s| s.1 != 0.0) {
            let said = said.map(|(tag, x)| format!("<{tag}>{}</{tag}>", number(x)));
            let _ = write!(inside, "<dynamics>{}</dynamics>", said.concat());
        }
        if let Some(f) = self.mimics.get(&j).filter(|_| alone) {
            let _ = write!(
                inside,
                "<mimic joint=\"{}\" axis=\"axis\"><multiplier>{}</multiplier><offset>{}</offset><reference>0</reference></mimic>",
                escape(&self.joints[&f.leader]),
                number(f.ratio),
                number(f.offset)
            );
        }
        format!("      <{tag}>{inside}</{tag}>\n")
    }

    /// What resists a joint and has no word here.
    fn unsaid(&mut self, j: usize) {
        let payload = self.scene.payload;
        let id = &self.scene.part(j).id;
        let d: Dynamics = payload.of(j, 0);
        let lost = &mut self.out.lost;
        if d.armature != 0.0 {
            lost.no_word("armature of a joint", Some(id));
        }
        if !d.words.is_empty() {
            lost.no_word("solver settings of a joint", Some(id));
        }
        if payload.closures.get(&j).is_some_and(|w| !w.is_empty()) {
            lost.no_word("solver settings of a loop closure", Some(id));
        }
    }

    pub(super) fn put(
        &mut self,
        name: &str,
        kind: &str,
        [parent, child]: &[String; 2],
        at: &RigidMotion,
        more: &str,
    ) {
        let [parent, child] = [parent, child].map(|l| escape(l));
        let place = if *at == RigidMotion::IDENTITY {
            String::new()
        } else {
            format!("      <pose>{}</pose>\n", pose(at))
        };
        let _ = write!(
            self.body,
            "    <joint name=\"{}\" type=\"{kind}\">\n{place}      <parent>{parent}</parent>\n      <child>{child}</child>\n{more}    </joint>\n",
            escape(name),
        );
    }

    /// Frames of links by name. A model's frames hang on its links: those of the world on what stands on it.
    fn frames(&mut self) -> String {
        let mut frames = String::new();
        for (name, link, at) in &self.scene.payload.frames {
            let on = match self.links.get(link) {
                Some(on) if on == "world" => self.ground.as_ref(),
                on => on,
            };
            let Some(on) = on else {
                let why = "nothing stands there that it could hang on";
                self.out.lost.one("frame of the world", Some(name), why);
                continue;
            };
            let (free, on) = (escape(&self.names.fit(name)), escape(on));
            let at = pose(at);
            let _ = writeln!(
                frames,
                "    <frame name=\"{free}\" attached_to=\"{on}\"><pose>{at}</pose></frame>"
            );
        }
        frames
    }

    fn whole(mut self) -> Text {
        let payload = self.scene.payload;
        for a in &payload.actuators {
            self.out.lost.no_word(
                "actuator",
                a.name.as_deref().or(Some(&self.scene.part(a.joint).id)),
            );
        }
        for (j, part) in self.scene.robot.joints.iter().enumerate() {
            if part.drive && !payload.actuators.iter().any(|a| a.joint == j) {
                self.out
                    .lost
                    .no_word("mark of a driven joint", Some(&part.id));
            }
        }
        if !payload.option.is_empty() {
            self.out.lost.no_word("option", None);
        }
        match self.shifted {
            0 => {}
            n => self.out.told.push(format!(
                "values and limits of {n} joints count from the drawn pose there: they are shifted"
            )),
        }
        let frames = self.frames();
        let version = if self.mimics.is_empty() {
            "1.9"
        } else {
            "1.11"
        };
        let known = match self.scene.known {
            "" => String::new(),
            k => format!("  {k}\n"),
        };
        let name = self.scene.robot.name.replace("::", ":");
        self.out.text = format!(
            "<?xml version=\"1.0\"?>\n<sdf version=\"{version}\">\n{known}  <model name=\"{}\">\n{}{frames}{}  </model>\n</sdf>\n",
            escape(&name),
            self.head,
            self.body
        );
        self.out
    }
}

/// The word for a joint of one freedom.
fn kind(s: &Single) -> &'static str {
    match s.moves {
        Moves::Turn => "revolute",
        Moves::Slide => "prismatic",
        Moves::Screw(_) => "screw",
    }
}
