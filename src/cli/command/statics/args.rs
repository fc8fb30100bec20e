//! The arguments of `ozols statics`.

use crate::cli::prelude::*;
use crate::model::loads::Tolerances;
use crate::view::statics::told::ToldStatics;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum StaticsMethod {
    /// The δ-point method, for four-link groups with a closed loop.
    Delta,
    /// Its projective form.
    Projective,
    /// The equilibrium equations of every link, for any group.
    Equilibrium,
    /// All three methods, and the differences between them.
    All,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct Statics {
    #[command(flatten)]
    pub(crate) file: File,
    /// Method for the reactions of four-link groups with a closed loop.
    #[arg(long, value_enum, default_value = "all")]
    pub(crate) method: StaticsMethod,
    /// Range of the first drive as FROM:TO:STEPS, for example 0:360deg:72 [default: the file's stroke]. Numbers without a unit
    /// are radians, or the file's length unit for sliding drives.
    #[arg(long, value_name = "FROM:TO:STEPS", allow_hyphen_values = true)]
    pub(crate) stroke: Option<String>,
    /// State of the file.
    #[arg(long, default_value = "free")]
    pub(crate) state: String,
    /// In a state that [workload.grip] loads: part whose contact forces load the jaws, in the file's unit [default: the hardest
    /// to hold].
    #[arg(long, value_name = "D")]
    pub(crate) diameter: Option<f64>,
    /// Model the mechanism in its plane (normal z), even if the file is spatial.
    #[arg(long)]
    pub(crate) planar: bool,
    /// Compute all six components of each joint's reaction, even with redundant constraints [default if a mechanism is not planar
    /// or not determinate in its plane].
    #[arg(long, conflicts_with_all = ["planar", "groups", "svg"])]
    pub(crate) spatial: bool,
    /// Let contacts with a clamped part only push, with the friction and faces of [[workload.contact]]. Otherwise they are the
    /// joints of the file, and the report lists those that would pull.
    #[arg(long, conflicts_with_all = ["groups", "svg"])]
    pub(crate) unilateral: bool,
    /// Print the assembly forces of inaccurate joints: tolerances of position and angle, such as 0.05mm,0.1deg, or the general
    /// tolerances fine (0.15 mm, 0.5°), medium (0.3 mm, 0.5°) and coarse (0.8 mm, 1°) of ISO 2768 for 30 to 120 mm [default:
    /// [tolerances] of the file, else fine].
    #[arg(long, value_name = "FIT", num_args = 0..=1, value_parser = parse_fit, conflicts_with_all = ["planar", "spatial", "unilateral", "groups", "svg", "stroke", "diameter"])]
    pub(crate) misfit: Option<Option<Tolerances>>,
    /// Force that a person applies at each joint in assembly, in N [default: that of the file, else 50].
    #[arg(long, value_name = "N", requires = "misfit")]
    pub(crate) hand_force: Option<f64>,
    /// Print only the Assur groups, under each possible drive.
    #[arg(long, conflicts_with_all = ["svg", "stroke"])]
    pub(crate) groups: bool,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    pub(crate) format: TextJsonOrCsv,
    /// Also write charts of the cycle to this folder.
    #[arg(long, value_name = "DIR")]
    pub(crate) svg: Option<PathBuf>,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
}

impl Statics {
    /// Writes a text.
    pub(crate) fn write_text(&self, text: String) -> anyhow::Result<Done> {
        output::write_bytes(self.output.as_deref(), text)
    }

    /// Writes reactions in the format asked for; a text ends with what to do next.
    pub(crate) fn put_reactions(
        &self,
        shown: &ToldStatics<'_>,
        next: &[NextCommand],
    ) -> anyhow::Result<Done> {
        let width = output::output_width(self.output.as_deref());
        self.write_text(match self.format {
            TextJsonOrCsv::Json => output::json_text(&shown.json())?,
            TextJsonOrCsv::Csv => shown.csv(),
            TextJsonOrCsv::Text => shown.text(width) + &next_commands::steps_text(next, width),
        })
    }
}

/// Parses tolerances of position and angle, or the name of a fit.
fn parse_fit(text: &str) -> Result<Tolerances, String> {
    if let Some(named) = Tolerances::named(text) {
        return Ok(named);
    }
    let parsed = text.split_once(',').and_then(|(position, angle)| {
        let number = |text: &str, unit| text.trim().strip_suffix(unit)?.trim().parse::<f64>().ok();
        let both = [number(position, "mm")?, number(angle, "deg")?];
        let in_range = both.iter().all(|x| (0.0..=1e3).contains(x));
        in_range.then(|| Tolerances {
            position: both[0] * 1e-3,
            angle: both[1].to_radians(),
        })
    });
    parsed.ok_or_else(|| {
        "give two tolerances such as 0.05mm,0.1deg, or fine, medium or coarse, or nothing for those of the file".to_owned()
    })
}
