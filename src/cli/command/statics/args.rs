//! The arguments of `ozols statics`.

use crate::cli::option::named::{Loops, Named};
use clap::{Args as ClapArgs, ValueEnum, ValueHint};
use std::path::PathBuf;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum StaticsMethod {
    /// The δ-point method, for four-link groups with a closed contour.
    Delta,
    /// Its projective form.
    Projective,
    /// The equilibrium equations of every link, for any group.
    Equilibrium,
    /// All three, and how far they differ.
    All,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum StaticsFormat {
    Text,
    Json,
    /// One joint a line.
    Csv,
}

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Statics {
    /// A path, `-`, or the name of a built-in mechanism; parallel-shears with --stability unless named.
    #[arg(value_name = "FILE", required_unless_present = "stability", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) file: Option<Named>,
    #[command(flatten)]
    pub(in crate::cli) loops: Loops,
    /// How the reactions of four-link groups with a closed contour are found.
    #[arg(long, value_enum, default_value = "all")]
    pub(in crate::cli) method: StaticsMethod,
    /// Range of the first drive and number of steps, such as 0:360deg:72; the file's stroke by default. Radians where no
    /// unit stands, the file's length unit for drives that slide.
    #[arg(long, value_name = "FROM:TO:STEPS", allow_hyphen_values = true)]
    pub(in crate::cli) stroke: Option<String>,
    /// A state named in the file.
    #[arg(long, default_value = "free")]
    pub(in crate::cli) state: String,
    /// In a state that [workload.grip] loads: the part whose contact forces load the jaws, in the file's unit; the hardest
    /// to hold by default.
    #[arg(long, value_name = "D")]
    pub(in crate::cli) diameter: Option<f64>,
    /// Model the mechanism in its plane (normal z), whatever the file says.
    #[arg(long)]
    pub(in crate::cli) planar: bool,
    /// All six components of each joint's reaction, redundant constraints and all; by default where a mechanism is not
    /// planar or not determinate in its plane.
    #[arg(long, conflicts_with_all = ["planar", "groups", "stability", "svg"])]
    pub(in crate::cli) spatial: bool,
    /// Contacts with a clamped object only push, with the friction and faces of [[workload.contact]]; otherwise they are the
    /// joints they are in the file, and the report says which of them would pull.
    #[arg(long, conflicts_with_all = ["groups", "stability", "svg"])]
    pub(in crate::cli) unilateral: bool,
    /// Only the Assur groups, under each possible drive.
    #[arg(long, conflicts_with_all = ["stability", "svg", "stroke"])]
    pub(in crate::cli) groups: bool,
    /// Compare the methods with exact arithmetic near each of their failures; charts and tables go to the folder of -o.
    #[arg(long, requires = "output", conflicts_with = "svg")]
    pub(in crate::cli) stability: bool,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    pub(in crate::cli) format: StaticsFormat,
    /// Write charts of the cycle to this folder, too.
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) svg: Option<PathBuf>,
    /// Write to a file instead of standard output; a folder with --stability.
    #[arg(long, short, value_name = "FILE")]
    pub(in crate::cli) output: Option<PathBuf>,
}
