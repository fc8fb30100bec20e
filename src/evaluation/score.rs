//! Scores of variants under a workload, the order they make, and the whole way from a [`request`] to its [`outcome`].
//!
//! # Scores
//!
//! The cost of a variant adds up joint by joint, so the diagram gives variants in its order. Loads of joints, conditioning of the
//! equations and effects of clearances on the outputs do not add up. They are computed variant by
//! variant ([`evaluate`](evaluation::evaluate)) for a pool of the cheapest, and [`ranking`](outcome::ranking) says whether
//! a variant outside of the pool could still win. The poses of the stroke under the file's loads
//! and the parts that a grip holds are in [`load_cases`](evaluation::load_cases).
//!
//! # Speed
//!
//! A variant moves as the original mechanism does. The poses, the twists of every option, their powers on the loads along the
//! spanning tree, and their Gram matrices are therefore computed once. A variant of the ten-link gripper then needs copies of
//! some 24 rows of 24 + 7 numbers. One elimination follows, with seven right sides: the loads, and a unit force along each axis
//! on each jaw. The last steps are 13 sums of wrenches and the two ends of a spectrum of 24 values.
//!
//! `cargo bench --bench score` gives variants per second on one and two threads. In a profile of it, the
//! [`spectrum`](evaluation::spectrum) takes two thirds of the time. Wrenches and elimination take a sixth each.
//!
//! # Proof
//!
//! Variants come in order of cost and no more than a block of them is held, so a pool may be as large as the space. It
//! ends early once cost and the [`lower_bound`](evaluation::lower_bound) of the other terms put all later ones behind.
//! Conditioning has no bound but 0, nor has the peak moment where every joint may be exchanged for one that bears none. If
//! that does not exclude them, a branch and bound over the diagram searches the variants outside of the pool. Its equations are those
//! of the choices so far. Once they determine the reactions, peaks and error are bounds for the whole branch.

pub mod evaluation;
pub mod joint_types;
pub mod outcome;
pub mod request;
pub mod run;
