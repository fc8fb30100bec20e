//! The arguments, as data.

use super::{
    accuracy, analyze, check, completions, draw, examples, explain, export, import, list, man, new,
    report, search, verify,
};
use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum, ValueHint};
use std::path::PathBuf;

/// A search engine for statically determinate mechanisms.
///
/// FILE is a path to a mechanism file (TOML, or JSON with the ending .json) or to a robot description (.urdf, .xml,
/// .sdf; see `ozols import` for more control), `-` for standard input, or the name of a built-in mechanism (see `ozols
/// list`).
#[derive(Debug, Parser)]
#[command(
    name = "ozols",
    version,
    max_term_width = 100,
    after_help = examples::MAIN
)]
pub(super) struct Args {
    /// What to do.
    #[command(subcommand)]
    pub(super) command: Command,
    /// No progress bar, no report of an import.
    #[arg(long, short, global = true)]
    pub(super) quiet: bool,
    /// Threads to use; all processors by default. Results do not depend on it.
    #[arg(long, global = true, value_name = "N")]
    pub(super) threads: Option<usize>,
    /// Seed of random samples.
    #[arg(long, global = true, value_name = "N", default_value_t = 1)]
    pub(super) seed: u64,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Mobility and redundant constraints in each state.
    #[command(after_help = examples::ANALYZE)]
    Analyze(analyze::Analyze),
    /// Every redesign that removes the redundant constraints: exact counts and the best ones.
    #[command(after_help = examples::SEARCH)]
    Search(search::Search),
    /// Assur groups of a planar mechanism, and its joint reactions over the cycle.
    #[command(after_help = examples::STATICS)]
    Statics(Statics),
    /// What a lever gripper can hold, and the drive moment it takes.
    #[command(after_help = examples::GRIP)]
    Grip(Grip),
    /// Size a torsional drive of two discs and run its programme.
    #[command(after_help = examples::DRIVE)]
    Drive(Drive),
    /// Confirm the certificates of rank that `ozols analyze --certificate` wrote.
    #[command(after_help = examples::VERIFY)]
    Verify(verify::Verify),
    /// Make a mechanism file of a robot description: URDF, MJCF or SDF.
    #[command(after_help = examples::IMPORT)]
    Import(import::Import),
    /// Draw the structural or the kinematic scheme as SVG.
    #[command(after_help = examples::DRAW)]
    Draw(draw::Draw),
    /// One HTML page: the verdict, drawings, contours, and the variants to sort, filter and look at.
    #[command(after_help = examples::REPORT)]
    Report(report::Report),
    /// Write a mechanism in another format: TOML, JSON, URDF, SDF, Graphviz DOT, GraphML.
    #[command(after_help = examples::EXPORT)]
    Export(export::Export),
    /// How right and how fast each method is on every built-in mechanism, and where its numbers fail.
    #[command(after_help = examples::ACCURACY)]
    Accuracy(accuracy::Accuracy),
    /// Write a commented mechanism file to start from.
    #[command(after_help = examples::NEW)]
    New(new::New),
    /// What a file describes, and what is wrong or doubtful in it.
    #[command(after_help = examples::CHECK)]
    Check(File),
    /// The built-in mechanisms.
    #[command(after_help = examples::LIST)]
    List(list::List),
    /// Print the file of a built-in mechanism.
    #[command(after_help = examples::SHOW)]
    Show(check::Show),
    /// Print the JSON Schema of the mechanism file.
    #[command(after_help = examples::SCHEMA)]
    Schema,
    /// What a word in the output or the help means.
    #[command(after_help = examples::EXPLAIN)]
    Explain(explain::Explain),
    /// Print the script that completes commands and options in a shell.
    #[command(after_help = examples::COMPLETIONS)]
    Completions(completions::Completions),
    /// Print the manual page, or write one for each command.
    #[command(after_help = examples::MAN)]
    Man(man::Man),
}

#[derive(Debug, ClapArgs)]
pub(super) struct File {
    /// A path, `-`, or the name of a built-in mechanism.
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(super) file: String,
}

#[derive(Debug, ClapArgs)]
pub(super) struct Grip {
    #[command(flatten)]
    pub(super) file: File,
    /// A further acceleration of the gripper in m/s², in its axes (repeatable): 5,0,-2.
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    pub(super) acceleration: Vec<[f64; 3]>,
    /// A further acceleration of the gripper in m/s², in any direction; `ozols drive` prints one.
    #[arg(long, value_name = "A")]
    pub(super) any_acceleration: Option<f64>,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    pub(super) format: AnalyzeFormat,
    /// Also write charts, each as SVG and CSV, into this folder.
    #[arg(long, value_name = "DIR")]
    pub(super) svg: Option<PathBuf>,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
}

#[derive(Debug, ClapArgs)]
pub(super) struct Drive {
    #[command(flatten)]
    pub(super) file: File,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    pub(super) format: AnalyzeFormat,
    /// Also write charts, each as SVG and CSV, into this folder.
    #[arg(long, value_name = "DIR")]
    pub(super) svg: Option<PathBuf>,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
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

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum AnalyzeFormat {
    Text,
    Json,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum StaticsMethod {
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
pub(super) enum StaticsFormat {
    Text,
    Json,
    /// One joint a line.
    Csv,
}

#[derive(Debug, ClapArgs)]
pub(super) struct Statics {
    /// A path, `-`, or the name of a built-in mechanism; parallel-shears with --stability unless named.
    #[arg(value_name = "FILE", required_unless_present = "stability", value_hint = ValueHint::FilePath)]
    pub(super) file: Option<String>,
    /// How the reactions of four-link groups with a closed contour are found.
    #[arg(long, value_enum, default_value = "all")]
    pub(super) method: StaticsMethod,
    /// Range of the first drive and number of steps, such as 0:360deg:72; the file's stroke by default. Radians where no
    /// unit stands, the file's length unit for drives that slide.
    #[arg(long, value_name = "FROM:TO:STEPS", allow_hyphen_values = true)]
    pub(super) stroke: Option<String>,
    /// A state named in the file.
    #[arg(long, default_value = "free")]
    pub(super) state: String,
    /// In a state that [workload.grip] loads: the part whose contact forces load the jaws, in the file's unit; the hardest
    /// to hold by default.
    #[arg(long, value_name = "D")]
    pub(super) diameter: Option<f64>,
    /// Model the mechanism in its plane (normal z), whatever the file says.
    #[arg(long)]
    pub(super) planar: bool,
    /// All six components of each joint's reaction, redundant constraints and all; by default where a mechanism is not
    /// planar or not determinate in its plane.
    #[arg(long, conflicts_with_all = ["planar", "groups", "stability", "svg"])]
    pub(super) spatial: bool,
    /// Only the Assur groups, under each possible drive.
    #[arg(long, conflicts_with_all = ["stability", "svg", "stroke"])]
    pub(super) groups: bool,
    /// Compare the methods with exact arithmetic near each of their failures; charts and tables go to the folder of -o.
    #[arg(long, requires = "output", conflicts_with = "svg")]
    pub(super) stability: bool,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    pub(super) format: StaticsFormat,
    /// Write charts of the cycle to this folder, too.
    #[arg(long, value_name = "DIR")]
    pub(super) svg: Option<PathBuf>,
    /// Write to a file instead of standard output; a folder with --stability.
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
}
