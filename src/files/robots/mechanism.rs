//! From a robot to a mechanism file.

pub(in crate::robots) mod build;
pub(in crate::robots) mod entries;
pub(in crate::robots) mod loop_closing;
pub(in crate::robots) mod loop_options;
pub(in crate::robots) mod outputs;
pub(in crate::robots) mod series_of_single_joints;
