//! Assembly forces of inaccurate joints, as text and JSON.

use crate::model::loads::Accuracy;
use crate::statics::reactions::misfit::Misfit;
use crate::view::prelude::*;

/// Joints in a text, those with the greatest force first.
const SHOWN: usize = 10;

/// The assembly forces of a mechanism.
#[derive(Debug, Clone, Copy)]
pub struct MisfitView<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// The state.
    pub state: StateId,
    /// Accuracy of the joints.
    pub accuracy: &'a Accuracy,
    /// The result.
    pub found: &'a Misfit,
}

impl MisfitView<'_> {
    /// Returns the result as JSON: the keys are a stable contract.
    #[must_use]
    pub fn json(&self) -> Value {
        let joints = self.found.joints.iter().map(|j| {
            let id = &self.mechanism.joints[j.joint].id;
            let within = self.accuracy.of_joint(j.joint);
            json!({ "joint": id, "tolerances": within, "force": j.force, "moment": j.moment })
        });
        json!({
            "mechanism": self.mechanism.name,
            "state": self.mechanism.states[self.state],
            "tolerances": self.accuracy.usual,
            "stiffness": { "linear": self.found.stiffness.linear, "angular": self.found.stiffness.angular },
            "hand_force": self.accuracy.hand_force,
            "by_hand": self.found.by_hand,
            "force": self.found.force,
            "joints": joints.collect::<Vec<_>>(),
        })
    }

    /// Returns the result as text: the verdict, then the joints with the greatest forces.
    #[must_use]
    pub fn text(&self, width: Option<u16>) -> String {
        let (m, found) = (self.mechanism, self.found);
        let head = format!("{}, state {}: ", m.name, m.states[self.state]);
        let [position, angle] = [
            self.accuracy.usual.position * 1e3,
            self.accuracy.usual.angle.to_degrees(),
        ];
        let own = match self.accuracy.joints.len() {
            0 => String::new(),
            n => format!(" ({} with other tolerances)", count_noun(n, "joint")),
        };
        let within = format!(
            "Joints within {} mm and {}°{own}, each axis normal with a third of that as standard deviation",
            four_digits(position),
            four_digits(angle)
        );
        // Below a millionth of a newton there is only rounding.
        let moments = found.joints.iter().map(|j| j.moment.most);
        if found.force.most.max(moments.fold(0.0, f64::max)) < 1e-6 {
            return fit_lines(
                &format!("{head}it assembles without force\n{within}.\n"),
                width,
            );
        }
        let Misfit {
            force,
            by_hand,
            stiffness,
            ..
        } = found;
        let verdict = format!(
            "{head}assembly takes {} N at the most loaded joint on average, and less than {} N in 95 % of cases; {:.1} % assemble with {} N at each joint\n{within}; stiffness {} N/m and {} N·m/rad.\n\n",
            four_digits(force.mean),
            four_digits(force.most),
            by_hand * 100.0,
            four_digits(self.accuracy.hand_force),
            four_digits(stiffness.linear),
            four_digits(stiffness.angular),
        );
        let sorted = found
            .joints
            .iter()
            .sorted_by(|a, b| b.force.mean.total_cmp(&a.force.mean));
        let rows = sorted.take(SHOWN).map(|j| {
            let figures = [j.force.mean, j.force.most, j.moment.mean, j.moment.most];
            std::iter::once(m.joints[j.joint].id.clone())
                .chain(figures.map(four_digits))
                .collect_vec()
        });
        let heads = "joint | mean force [N] | 95 % | mean moment [N·m] | 95 %";
        let table = text_table(heads, rows, width);
        let more = match found.joints.len().saturating_sub(SHOWN) {
            0 => String::new(),
            n => format!(
                "\n{} with less force; JSON has all.",
                count_noun(n, "more joint")
            ),
        };
        fit_lines(&verdict, width) + &table + &more + "\n"
    }
}
