//! Forces near dead points.

use crate::accuracy::change::Noise;
use crate::accuracy::said::{Reply, Said};
use crate::accuracy::special::Sketch;
use crate::accuracy::study::{Effort, Progress, Study};
use crate::file::text::mechanism_from_str;
use crate::model::mechanism::StateId;
use crate::statics::reactions::solve::Reactions;

/// The digits that are asked for.
const DIGITS: [i32; 3] = [6, 9, 12];
/// The force on the knee, three times a unit vector across the bars.
const FORCE: [i32; 3] = [-2000, -1000, 2000];

/// Returns the study of reactions in space of two bars, whose knee is pushed towards the line through their ends, where they have a dead
/// point. Lever arms give the truth. Reactions that are called nearly singular are not called exact.
pub(super) fn study_dead_points(effort: Effort, progress: Progress<'_>) -> Study {
    let (each, step) = if effort.quick { (4, 3) } else { (24, 1) };
    let exponents: Vec<i32> = (-15..=-1).step_by(step).collect();
    let values = exponents.iter().map(|&e| 10f64.powi(e)).collect();
    let study = Study::new("stability-dead-point", values);
    let names = DIGITS.map(|d| format!("{d} digits"));
    study.ask_cases(names, each, progress, |v, case| {
        let noise = &mut Noise::new(effort.seed, case);
        let [left, right] = [(); 2].map(|()| 100 + (50.0 * noise.draw_uniform()) as i32);
        // Along (1, 2, 2) / 3, and above it along (2, 1, -2) / 3.
        let at = |along: i32, up: i32| {
            let e = -exponents[v];
            let [x, y, z] = [(1, 2), (2, 1), (2, -2)]
                .map(|(a, b)| format!("\"({} + {}/10^{e})/3\"", a * along, b * up));
            format!("[{x}, {y}, {z}]")
        };
        let mut file = Sketch::with_links(["0", "a", "b"]);
        let ends = [
            ("0", "a", -left, 0),
            ("a", "b", 0, 100),
            ("b", "0", right, 0),
        ];
        for (a, b, along, up) in ends {
            file.add_joint([a, b], "revolute", &at(along, up), "[2, -2, 1]");
        }
        let load = format!(
            "[[workload.force]]\nlink = \"a\"\npoint = {}\nforce = {FORCE:?}\n",
            at(0, 100)
        );
        let text = file.text("toggle") + &load;
        let m = mechanism_from_str("toggle.toml", &text).expect("a generated file is valid");
        let found = Reactions::solve_at_home(&m, StateId::FREE, &m.loads).ok();
        let [left, right] = [left, right].map(f64::from);
        let height = 100.0 * 10f64.powi(exponents[v]);
        let truth = 3000.0 / height / (1.0 / left + 1.0 / right) * (height / left).hypot(1.0);
        let reply = |digits: i32| {
            let near = |force: f64| (force / truth - 1.0).abs() < 10f64.powi(-digits);
            let said = found.as_ref().map_or(Said::Open, |s| {
                let right = near(s.reactions[0].force_size());
                Said::judge(true, !s.nearly_singular(), right)
            });
            Some(Reply::new(said, || format!("bars over {left} and {right}")))
        };
        DIGITS.map(reply).into()
    })
}
