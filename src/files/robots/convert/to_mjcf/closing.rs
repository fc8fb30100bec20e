//! Joints that close loops: sites held together, with a small body on joints before one of them where the joint can move.

use crate::geom::rigid::RigidMotion;
use crate::robots::convert::plan::{Single, ending};
use crate::robots::convert::text::{attributes, pos_axes};
use crate::robots::convert::to_mjcf::ToMjcf;
use crate::robots::mechanism::series_of_single_joints::escape;

impl ToMjcf<'_> {
    pub(super) fn closing(&mut self, j: usize) {
        let part = self.scene.part(j).clone();
        let end = ending(&part);
        let mut sites = Vec::new();
        for (side, letter) in [(0, "a"), (1, "b")] {
            let site = self.sites.fit(&format!("{}~{letter}", part.id));
            if end.on[side].is_empty() {
                self.site(part.links[side], &site, &part.sides[side])
            } else {
                self.small(j, part.links[side], &part.sides[side], &end.on[side], &site)
            }
            sites.push(escape(&site));
        }
        let word = if end.point { "connect" } else { "weld" };
        let name = self.closures.fit(&part.id);
        let words = self.scene.payload.closures.get(&j);
        let words = words.map_or(String::new(), |w| {
            let kept = w.iter().filter(|(k, _)| k != "torquescale" || !end.point);
            attributes(&kept.cloned().collect::<Vec<_>>())
        });
        self.equalities.push(format!(
            "    <{word} name=\"{}\" site1=\"{}\" site2=\"{}\"{words}/>\n",
            escape(&name),
            sites[0],
            sites[1]
        ));
    }

    /// A small body on a link that has the freedoms in series, and a site.
    fn small(&mut self, joint: usize, link: usize, place: &RigidMotion, on: &[Single], site: &str) {
        let name = self.bodies.fit(&format!("{site}~body"));
        let mut lines = Vec::new();
        let whole = self.scene.part(joint).values.len() == 1;
        let before = self.qpos.len();
        for s in on {
            self.single_joint(joint, s, &RigidMotion::IDENTITY, whole, &mut lines);
        }
        // Their place in the keyframe is where the body stands in the file.
        let own: Vec<f64> = self.qpos.drain(before..).collect();
        self.small_qpos.entry(link).or_default().extend(own);
        let light = self.scene.light.mjcf([0.0; 3]);
        let all = self.beside.entry(link).or_default();
        all.push(format!(
            "<body name=\"{}\"{}>",
            escape(&name),
            pos_axes(place)
        ));
        all.push(format!("  {light}"));
        all.extend(lines.into_iter().map(|l| format!("  {l}")));
        all.push(format!("  <site name=\"{}\"/>", escape(site)));
        all.push("</body>".to_owned());
    }
}
