//! How every page looks.

pub(super) const STYLE: &str = concat!(include_str!("look.css"), include_str!("page.css"));
