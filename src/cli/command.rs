//! The commands, one a file.

pub(in crate::cli) mod accuracy;
pub(in crate::cli) mod analyze;
pub(in crate::cli) mod bench;
pub(in crate::cli) mod catalog;
pub(in crate::cli) mod check;
pub(in crate::cli) mod clamped;
pub(in crate::cli) mod completions;
pub(in crate::cli) mod convert;
pub(in crate::cli) mod draw;
pub(in crate::cli) mod drive;
pub(in crate::cli) mod explain;
pub(in crate::cli) mod export;
pub(in crate::cli) mod fix;
pub(in crate::cli) mod grip;
pub(in crate::cli) mod import;
pub(in crate::cli) mod lint;
pub(in crate::cli) mod list;
pub(in crate::cli) mod man;
pub(in crate::cli) mod new;
pub(in crate::cli) mod report;
pub(in crate::cli) mod search;
pub(in crate::cli) mod statics;
pub(in crate::cli) mod sweep;
pub(in crate::cli) mod types;
pub(in crate::cli) mod verify;
pub(in crate::cli) mod watch;
