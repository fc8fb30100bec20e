//! ozols finds the redundant constraints of a mechanism, contour by contour, and every way of lowering joint classes or
//! inserting unloading joints that removes them without changing the working motion.
//!
//! # The idea
//!
//! Give every joint a basis of unit twists in the reference pose and stack the closure equations of the k independent
//! contours into a matrix J with 6k rows and f columns. Then the mobility is W = f - rank J, the number of redundant
//! constraints is σ = 6k - rank J, and Ozols' σ = W + 6k - f holds identically ([`redundancy::analysis`]).
//!
//! Lowering a joint's class appends columns to J. What a partly chosen mechanism means to the choices still to come is
//! only the space of motions it leaves, so variants fold into a decision diagram whose nodes are subspaces over a prime
//! field ([`mod@search`]): spaces of 10^10 variants are counted exactly in milliseconds.
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
//! More in [Using ozols from Rust](guide::rust). What stands at the root is meant for others; the modules are the program's
//! own rooms, public so that tests, benches and the curious may look, and their items may change from one version to the
//! next.
//!
//! # Layers
//!
//! mechanism -> search -> outcome -> view: [`guide::architecture`] says what each module holds and which may import which.
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
