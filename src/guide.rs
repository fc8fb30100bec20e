//! The guide: what the program does, system by system, with outputs that the tests repeat.
//!
//! Start with [`first_hour`], or draw in the [`studio`]. [`structure`] explains redundant constraints and the search for
//! redesigns, [`ranking`] the order under a workload.
//!
//! - Files: [`robots`], [`assemblies`] of CAD programs, the [`catalog`] of grippers.
//! - Forces: [`kinetostatics`], [`grip`], [`drive`].
//! - How sure and how fast: [`mobility`], [`speed`], other tools ([`beside`]).
//! - Programs: [`rust`], [`python`]. Contributors: [`architecture`], [`adding`], [`changelog`].
//!
//! Every block that begins with `$ ozols` is run by the tests (`tests/it/documents.rs`); `...` marks omitted lines.

#[doc = include_str!("guide/first_hour.md")]
pub mod first_hour {}

#[doc = include_str!("guide/studio.md")]
pub mod studio {}

#[doc = include_str!("guide/structure.md")]
pub mod structure {}

#[doc = include_str!("guide/grip.md")]
pub mod grip {}

#[doc = include_str!("guide/kinetostatics.md")]
pub mod kinetostatics {}

#[doc = include_str!("guide/drive.md")]
pub mod drive {}

#[doc = include_str!("guide/ranking.md")]
pub mod ranking {}

#[doc = include_str!("guide/mobility.md")]
pub mod mobility {}

#[doc = include_str!("guide/robots.md")]
pub mod robots {}

#[doc = include_str!("guide/assemblies.md")]
pub mod assemblies {}

#[doc = include_str!("guide/beside.md")]
pub mod beside {}

#[doc = include_str!("guide/catalog.md")]
pub mod catalog {}

#[doc = include_str!("guide/speed.md")]
pub mod speed {}

#[doc = include_str!("guide/rust.md")]
pub mod rust {}

#[doc = include_str!("guide/python.md")]
pub mod python {}

#[doc = include_str!("guide/adding.md")]
pub mod adding {}
#[doc = include_str!("guide/architecture.md")]
pub mod architecture {}

#[doc = include_str!("../CHANGELOG.md")]
pub mod changelog {}
