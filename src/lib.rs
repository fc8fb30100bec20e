//! ozols finds the redundant constraints of a mechanism, loop by loop, and every way of lowering joint classes or inserting
//! unloading joints that removes them without changing the working motion.
//!
//! # The idea
//!
//! Each joint has a basis of unit twists in the reference pose. The closure equations of the k independent loops form a matrix J
//! with 6k rows and f columns. The mobility is W = f - rank J, the number of redundant constraints is σ = 6k - rank J, and
//! Ozols' formula σ = W + 6k - f holds identically ([`redundancy::analysis`]).
//!
//! Lowering the class of a joint appends columns to J. The choices that remain depend on a partly chosen mechanism only through
//! a subspace. Variants therefore share the states of a decision diagram whose states are subspaces over a prime field
//! ([`mod@search`]): 10^10 variants are counted exactly in milliseconds.
//!
//! # Example
//!
//! ```
//! let gripper = ozols::built_in("gripper-10")?;
//! let free = &ozols::analyze(&gripper)?[0];
//! assert_eq!((free.mobility, free.redundant), (1, 11)); // [Pogrebnyak 2018]
//!
//! let outcome = ozols::search(&gripper, &ozols::Request::default())?;
//! assert_eq!(outcome.determinate.to_string(), "6340592477");
//! assert_eq!(outcome.admissible.to_string(), "25761436");
//! for v in outcome.variants().take(3) {
//!     println!("{v}");
//! }
//! # Ok::<(), ozols::Error>(())
//! ```
//!
//! [Using ozols from Rust](guide::rust) has more.
//!
//! # Modules
//!
//! The root has what most programs need: read ([`open`], [`import`], [`built_in`], [`from_toml`], [`from_json`]) or build
//! ([`Builder`]) a mechanism, then [`analyze`], [`search`](fn@search), [`draw`](fn@draw) and [`export`] it. For more control:
//!
//! | module | what it is for |
//! |---|---|
//! | [`model`] | a [`Mechanism`], its parts, and how to change them |
//! | [`file`](mod@file), [`robots`] | mechanism files; robot descriptions and CAD assemblies |
//! | [`redundancy`], [`rank`], [`motion`] | analyses by other methods, single constraints, poses |
//! | [`score`] | requests, progress of a search, outcomes and rankings |
//! | [`statics`], [`grip`], [`mod@drive`] | joint reactions and the workloads of grippers |
//! | [`chains`], [`synthesis`], [`catalog`] | new gripper structures, their layouts, and catalogues of them |
//! | [`view`], [`mod@draw`], [`chart`], [`page`] | results as text, JSON, CSV, SVG and HTML |
//! | [`accuracy`] | studies of accuracy and speed |
//!
//! [`guide::architecture`] describes each module and the allowed imports.
//!
//! # Versions
//!
//! The root and the documented modules follow semantic versioning: in 0.y.z a new y may change them, a new z does not. Items marked
//! `#[doc(hidden)]` may change at any time.
//!
//! # Sources
//!
//! - `[Pogrebnyak 2018]` R. P. Pogrebnyak, repeated constraints in the schemes of a link slider-crank gripper mechanism,
//!   Science and Transport Progress 4 (76), 2018.
//! - `[Bychkov, Dvornikov & Zhukov 2018]` I. V. Bychkov, L. T. Dvornikov, I. A. Zhukov, the kinetostatic analysis of the
//!   four-link group of Assur with a closed loop on the example of the mechanism of metallurgical parallel shears (in
//!   Russian), 2018, No 4, p. 32-37, DOI 10.26730/1999-4125-2018-4-32-37.
//! - `[McKay 1981]` B. D. McKay, "Practical graph isomorphism", Congressus Numerantium 30, 1981.
//! - `[Horton 1987]` J. D. Horton, "A polynomial-time algorithm to find the shortest cycle basis of a graph", SIAM J.
//!   Comput. 16, 1987.
//! - `[Pavlenko & Godunko 2010]` I. I. Pavlenko, M. O. Godunko, transmission relations of the force arms of clamping levers
//!   of robot grippers, Kirovohrad National Technical University, 2010.
//! - `[Klyuchkovskyi 1999]` S. M. Klyuchkovskyi, a universal module of transport and feeding mechanisms for robots and
//!   cyclic automata, UDC 621.01, 1999.

pub use api::{
    Error, Scheme, analyze, built_in, draw, export, from_json, from_toml, import, open, search,
};
pub use file::builder::Builder;
pub use model::mechanism::Mechanism;
pub use redundancy::analysis::StateAnalysis as Analysis;
pub use score::outcome::Outcome;
pub use score::outcome::variant::Variant;
pub use score::request::Request;

#[cfg(feature = "cli")]
use ozols_kernel::format;

pub use ozols_catalogue::{catalog, chains, synthesis};
pub use ozols_evaluation::{accuracy, score};
pub use ozols_files::{file, robots};
pub use ozols_forces::{drive, grip, statics};
pub use ozols_kernel::{
    closure, geom, linalg, meant, model, motion, rank, redundancy, search, shard, verify,
};
pub use ozols_plot::chart;
pub use ozols_show::{draw, page, terms, view};

mod api;
pub mod builtin;
#[cfg(feature = "cli")]
pub mod cli;
pub mod guide;
#[cfg(feature = "cli")]
pub mod studio;
