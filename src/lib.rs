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
//! field ([`search`]): spaces of 10^10 variants are counted exactly in milliseconds.
//!
//! # Example
//!
//! ```
//! use ozols::file::text::mechanism_from_str;
//! use ozols::model::mechanism::StateId;
//! use ozols::redundancy::analysis::{Method, analyse, exact_field};
//! use ozols::search::request::{Request, Search};
//!
//! let text = ozols::builtin::text("gripper-10").expect("it is built in");
//! let gripper = mechanism_from_str("gripper-10.toml", text)?;
//! let free = &analyse(&gripper, &[StateId::FREE], Method::Modular)?[0];
//! assert_eq!((free.mobility, free.redundant), (1, 11)); // [Pogrebnyak 2018]
//!
//! let search = Search::new(exact_field(&gripper, 0)?, &gripper, Request::default())?;
//! let diagrams = search.build(&|| false, &mut |_| {});
//! let determinate = search.counts(&diagrams.determinate, false);
//! assert_eq!(search.size().to_string(), "13841287201");
//! assert_eq!(determinate.total.to_string(), "6340592477");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Layers
//!
//! linalg -> geom, verify -> model -> closure -> motion -> rank, statics -> grip, drive -> redundancy, file -> search,
//! robots -> score, draw, accuracy -> view -> page -> cli. Imports go one way; a test holds them to it. [`chart`] draws
//! finished numbers and imports nothing, as [`terms`] says what words mean.
//!
//! # Sources
//!
//! - `[Pogrebnyak 2018]` R. P. Pogrebnyak, repeated constraints in the schemes of a link slider-crank gripper mechanism,
//!   Science and Transport Progress 4 (76), 2018.
//! - `[Bychkov, Dvornikov & Zhukov 2018]` I. V. Bychkov, L. T. Dvornikov, I. A. Zhukov, the kinetostatic analysis of the
//!   four-link group of Assur with a closed loop on the example of the mechanism of metallurgical parallel shears (in
//!   Russian), 2018, No 4, p. 32-37, DOI 10.26730/1999-4125-2018-4-32-37.
//! - `[Horton 1987]` J. D. Horton, "A polynomial-time algorithm to find the shortest cycle basis of a graph", SIAM J.
//!   Comput. 16, 1987.
//! - `[Pavlenko & Godunko 2010]` I. I. Pavlenko, M. O. Godunko, transmission relations of the force arms of clamping levers
//!   of robot grippers, Kirovohrad National Technical University, 2010.
//! - `[Klyuchkovskyi 1999]` S. M. Klyuchkovskyi, a universal module of transport and feeding mechanisms for robots and
//!   cyclic automata, UDC 621.01, 1999.

pub mod accuracy;
pub mod builtin;
pub mod chart;
pub mod cli;
pub mod closure;
pub mod draw;
pub mod drive;
pub mod file;
mod format;
pub mod geom;
pub mod grip;
pub mod guide;
pub mod linalg;
pub mod model;
pub mod motion;
pub mod page;
pub mod rank;
pub mod redundancy;
pub mod robots;
pub mod score;
pub mod search;
pub mod statics;
pub mod terms;
pub mod verify;
pub mod view;
