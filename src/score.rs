//! Scores of variants under a workload, and the order they make.
//!
//! The cost of a variant adds up joint by joint, so the diagram gives variants in its order. What the joints bear, how well
//! conditioned the equations are and what clearances do to the outputs does not add up; it is computed variant by variant
//! ([`evaluate`]) for a pool of the cheapest, and [`ranking`] says whether a variant outside of the pool could still win.
//! What it is computed for, the poses of the stroke under the file's loads and the parts that a grip holds, is in [`cases`].
//!
//! # Speed
//!
//! The motion of a variant is that of the mechanism as it is, so the poses, the twists of every option, their powers on the
//! loads sent along the spanning tree and their Gram matrices are computed once. What is left for a variant of the ten-link
//! gripper is to copy some 24 rows of 24 + 7 numbers, one elimination with seven right sides (the loads, and a unit force
//! along each axis on each jaw), 13 sums of wrenches and the two ends of a spectrum of 24 values. `benches/score.rs` measures
//! it. `ozols search gripper-10-loaded --pool 400000 --check none --threads 1` takes 6.5 s of processor time (release build,
//! other work on the machine), that is 16 µs a variant and core with the giving and sorting of the variants: 6e4 variants a
//! second and core, 1.2e5 on two cores by processor time. By count of operations (not profiled) the tridiagonal form for
//! the conditioning, some 18,000, and the elimination, some 14,000 less what its zeros save, are what limits it.

pub mod bearing;
pub mod cases;
pub mod elimination;
pub mod evaluate;
pub mod floor;
pub mod joint_types;
pub mod pareto;
pub mod ranking;
pub mod slow;
pub mod spectrum;
pub mod table;
pub mod terms;
