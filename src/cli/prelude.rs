//! Names that most commands use.

pub(crate) use crate::api::{self, MAX_DESCRIPTION_BYTES};
pub(crate) use crate::cli::option::named::{File, Loops, Named};
pub(crate) use crate::cli::option::{Global, TextJsonOrCsv, TextOrJson, ToFile, load};
pub(crate) use crate::cli::terminal::output::{Tone, colour_verdicts};
pub(crate) use crate::cli::terminal::progress::{Bar, print_line};
pub(crate) use crate::cli::terminal::{Done, interrupt, output};
pub(crate) use crate::file::disk;
pub(crate) use crate::format::{count_noun, four_digits};
pub(crate) use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
pub(crate) use crate::redundancy::analysis::{Method, StateAnalysis, analyse_states};
pub(crate) use crate::redundancy::release::Release;
pub(crate) use crate::score::outcome::Outcome;
pub(crate) use crate::score::request::{List, Request};
pub(crate) use crate::view::terminal::next_commands::{self, NextCommand};
pub(crate) use crate::view::terminal::{fit_lines, row_cells, text_table};
pub(crate) use crate::{builtin, robots};
pub(crate) use anyhow::{Context, bail, ensure};
pub(crate) use clap::{Args as ClapArgs, ValueEnum, ValueHint};
pub(crate) use itertools::Itertools;
pub(crate) use std::path::{Path, PathBuf};
