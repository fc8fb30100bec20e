//! How every page looks.

pub(super) const STYLE: &str = include_str!("page.css");
