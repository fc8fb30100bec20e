//! The arguments of `ozols grip`.

use crate::cli::option::format::TextOrJson;
use crate::cli::option::named::File;
use clap::Args as ClapArgs;
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Grip {
    #[command(flatten)]
    pub(in crate::cli) file: File,
    /// A further acceleration of the gripper in m/s², in its axes (repeatable): 5,0,-2.
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    pub(in crate::cli) acceleration: Vec<[f64; 3]>,
    /// A further acceleration of the gripper in m/s², in any direction; `ozols drive` prints one.
    #[arg(long, value_name = "A")]
    pub(in crate::cli) any_acceleration: Option<f64>,
    /// A motion as CSV, one step a line: columns ax, ay, az in m/s², and if wanted gx, gy, gz (gravity in the gripper's axes),
    /// time, diameter. The least clamping is found for every step.
    #[arg(long, value_name = "CSV", value_hint = clap::ValueHint::FilePath)]
    pub(in crate::cli) motion: Option<PathBuf>,
    /// How firmly the contacts of any clamped mechanism hold the part, with friction and without, and how far from its loss; the
    /// file needs no [workload.grip].
    #[arg(long, conflicts_with_all = ["acceleration", "any_acceleration", "motion", "svg"])]
    pub(in crate::cli) closure: bool,
    /// The clamped state; the first with contacts by default.
    #[arg(long, requires = "closure")]
    pub(in crate::cli) state: Option<String>,
    /// Also the share of samples with closure whose contacts are out by up to so much, in the file's unit of length.
    #[arg(long, value_name = "LENGTH", requires = "closure")]
    pub(in crate::cli) tolerance: Option<f64>,
    /// How many samples.
    #[arg(long, value_name = "N", requires = "tolerance", default_value = "200")]
    pub(in crate::cli) samples: usize,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    pub(in crate::cli) format: TextOrJson,
    /// Also write charts, each as SVG and CSV, into this folder.
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) svg: Option<PathBuf>,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    pub(in crate::cli) output: Option<PathBuf>,
}

fn vector(text: &str) -> Result<[f64; 3], String> {
    let numbers: Vec<f64> = text
        .split(',')
        .map(|t| t.trim().parse::<f64>().ok().filter(|x| x.abs() <= 1e6))
        .collect::<Option<_>>()
        .unwrap_or_default();
    <[f64; 3]>::try_from(numbers)
        .map_err(|_| "give three numbers such as 5,0,-2, none beyond 1e6".to_owned())
}
