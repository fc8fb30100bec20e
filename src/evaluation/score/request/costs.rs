//! What a request says things cost.

use crate::file::costs::costs_from_str;
use crate::model::mechanism::{CostSpec, Mechanism};
use crate::score::request::{Request, RequestError};

impl Request {
    /// Puts the costs of the request in place of those of the mechanism.
    pub(in crate::score) fn price(&self, mechanism: &mut Mechanism) -> Result<(), RequestError> {
        let Some(file) = &self.costs else {
            return Ok(());
        };
        let stated = costs_from_str(&file.name, &file.text, mechanism)?;
        let old = std::mem::take(&mut mechanism.search.costs);
        let mut by_type_milli = stated.by_type_milli;
        let named = |list: &[(String, i64)], name: &str| list.iter().any(|(n, _)| n == name);
        let kept = old.by_type_milli.into_iter();
        let kept: Vec<_> = kept.filter(|(n, _)| !named(&by_type_milli, n)).collect();
        by_type_milli.extend(kept);
        by_type_milli.sort();
        mechanism.search.costs = CostSpec {
            by_type_milli,
            change_milli: stated.change_milli.or(old.change_milli),
            link_milli: stated.link_milli.or(old.link_milli),
            driven_milli: stated.driven_milli.or(old.driven_milli),
            harmful_milli: stated.harmful_milli.or(old.harmful_milli),
        };
        Ok(())
    }
}
