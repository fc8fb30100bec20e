//! A robot as a description has it: links, joints, loops, couplings, and where they stand in the text.

pub(in crate::robots) mod coupling;
pub(in crate::robots) mod digits;
pub(in crate::robots) mod kinematics;
pub(in crate::robots) mod loops;
pub(in crate::robots) mod massless;
pub(in crate::robots) mod mimic;
pub(in crate::robots) mod origin;
pub(in crate::robots) mod parts;
pub(in crate::robots) mod physical;
