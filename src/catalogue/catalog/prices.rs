//! What the parts of a gripper cost, in revolute joints, by what is bought and what has to be fitted for it.

use crate::model::joint_type::JointType;
use crate::model::mechanism::CostSpec;

/// A gear pair, or a rack and its pinion, in thousandths: two parts with teeth, and their distance is to be kept.
const TEETH_MILLI: i64 = 3000;

/// The price of each part by its name.
pub(super) fn prices() -> [(&'static str, f64); 5] {
    #[allow(clippy::cast_precision_loss, reason = "a few thousand")]
    let whole = |milli: i64| milli as f64 / 1000.0;
    let joint = |of: JointType| whole(of.default_cost_milli());
    [
        ("hinge", joint(JointType::Revolute)),
        ("slide", joint(JointType::Prismatic)),
        ("gear", whole(TEETH_MILLI)),
        ("slot", joint(JointType::Slotted)),
        ("link", whole(CostSpec::LINK_MILLI)),
    ]
}
