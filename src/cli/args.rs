//! The arguments, as data.

use super::examples;
use crate::robots::formats::{self, Format};
use clap::builder::{PossibleValue, PossibleValuesParser};
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
    Analyze(Analyze),
    /// Every redesign that removes the redundant constraints: exact counts and the best ones.
    #[command(after_help = examples::SEARCH)]
    Search(Search),
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
    Verify(Verify),
    /// Make a mechanism file of a robot description: URDF, MJCF or SDF.
    #[command(after_help = examples::IMPORT)]
    Import(Import),
    /// Draw the structural or the kinematic scheme as SVG.
    #[command(after_help = examples::DRAW)]
    Draw(Draw),
    /// One HTML page: the verdict, drawings, contours, and the variants to sort, filter and look at.
    #[command(after_help = examples::REPORT)]
    Report(Report),
    /// Write a mechanism in another format: TOML, JSON, URDF, SDF, Graphviz DOT, GraphML.
    #[command(after_help = examples::EXPORT)]
    Export(Export),
    /// How right and how fast each method is on every built-in mechanism, and where its numbers fail.
    #[command(after_help = examples::ACCURACY)]
    Accuracy(Accuracy),
    /// Write a commented mechanism file to start from.
    #[command(after_help = examples::NEW)]
    New(New),
    /// What a file describes, and what is wrong or doubtful in it.
    #[command(after_help = examples::CHECK)]
    Check(File),
    /// The built-in mechanisms.
    #[command(after_help = examples::LIST)]
    List(List),
    /// Print the file of a built-in mechanism.
    #[command(after_help = examples::SHOW)]
    Show(Show),
    /// Print the JSON Schema of the mechanism file.
    #[command(after_help = examples::SCHEMA)]
    Schema,
    /// What a word in the output or the help means.
    #[command(after_help = examples::EXPLAIN)]
    Explain(Explain),
    /// Print the script that completes commands and options in a shell.
    #[command(after_help = examples::COMPLETIONS)]
    Completions(Completions),
    /// Print the manual page, or write one for each command.
    #[command(after_help = examples::MAN)]
    Man(Man),
}

#[derive(Debug, ClapArgs)]
pub(super) struct New {
    /// The file to write; its ending is .toml, and the mechanism is named after it.
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(super) file: PathBuf,
    /// The built-in mechanism to start from.
    #[arg(long, value_name = "NAME", default_value = "four-bar")]
    pub(super) from: String,
    /// Replace a file that is there.
    #[arg(long)]
    pub(super) force: bool,
}

#[derive(Debug, ClapArgs)]
pub(super) struct Show {
    /// The name of a built-in mechanism.
    #[arg(value_name = "NAME")]
    pub(super) name: String,
}

#[derive(Debug, ClapArgs)]
pub(super) struct List {
    /// Only those with every one of these words in name, family or description.
    #[arg(value_name = "WORD")]
    pub(super) words: Vec<String>,
}

#[derive(Debug, ClapArgs)]
pub(super) struct Explain {
    /// The term, such as sigma, σ, or redundant constraint; all terms where left out.
    #[arg(value_name = "TERM")]
    pub(super) term: Vec<String>,
}

#[derive(Debug, ClapArgs)]
pub(super) struct Completions {
    /// The shell.
    #[arg(value_enum, value_name = "SHELL")]
    pub(super) shell: clap_complete::Shell,
}

#[derive(Debug, ClapArgs)]
pub(super) struct Man {
    /// Write a page for the program and one for each command into this folder.
    #[arg(long, short, value_name = "DIR")]
    pub(super) output: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum ImportFormat {
    Toml,
    Json,
}

#[derive(Debug, ClapArgs)]
pub(super) struct Import {
    /// A robot description: URDF, MJCF or SDF, by its root element.
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(super) file: String,
    /// A file of loop closures (YAML, JSON or TOML): [[loop]] with a, b and type; robot.yaml of
    /// example-parallel-robots; Drake's list of ball constraints.
    #[arg(long, value_name = "SIDE")]
    pub(super) loops: Option<PathBuf>,
    /// Value of a joint in radians or metres: elbow=0.3 (repeatable); several with commas for joints of several
    /// freedoms. Loops that are open there are closed from there.
    #[arg(long, value_name = "JOINT=VALUE", allow_hyphen_values = true)]
    pub(super) pose: Vec<String>,
    /// Let a robot without a fixed link float: a joint of six freedoms to the world.
    #[arg(long)]
    pub(super) floating: bool,
    /// SDF drawn in parts: every joint puts the frame that is its parent onto its child.
    #[arg(long)]
    pub(super) assemble: bool,
    /// Take loops that are open in the given pose as they are.
    #[arg(long)]
    pub(super) open: bool,
    /// The fixed link; the root by default.
    #[arg(long, value_name = "LINK")]
    pub(super) frame: Option<String>,
    /// A link whose motion is the working motion (repeatable); the ends of chains by default.
    #[arg(long, value_name = "LINK")]
    pub(super) working_link: Vec<String>,
    /// Output format.
    #[arg(long, value_enum, default_value = "toml")]
    pub(super) format: ImportFormat,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
}

fn export_formats() -> PossibleValuesParser {
    let value = |f: &'static Format| PossibleValue::new(f.word).help(f.about);
    PossibleValuesParser::new(formats::written().map(value))
}

#[derive(Debug, ClapArgs)]
pub(super) struct Export {
    #[command(flatten)]
    pub(super) file: File,
    /// The format.
    #[arg(long, value_parser = export_formats())]
    pub(super) to: String,
    /// Write variant K of the list that `ozols search FILE` gives, with the same of the options below.
    #[arg(long, value_name = "K")]
    pub(super) variant: Option<usize>,
    /// The state meant by --max-external; the file's first besides free by default.
    #[arg(long, value_name = "STATE", requires = "variant")]
    pub(super) state: Option<String>,
    #[command(flatten)]
    pub(super) question: Question,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum DrawKind {
    /// Links as polygons, joints as circles with their class, contours tinted by their redundant constraints.
    Scheme,
    /// Links and the symbols of joints in place, from the coordinates.
    Kinematic,
}

#[derive(Debug, ClapArgs)]
pub(super) struct Draw {
    #[command(flatten)]
    pub(super) file: File,
    /// What is drawn.
    #[arg(long, value_enum, default_value = "scheme")]
    pub(super) kind: DrawKind,
    /// A state named in the file.
    #[arg(long, default_value = "free")]
    pub(super) state: String,
    /// Draw variant K of the list that `ozols search FILE` gives, with the same of the options below, its changes marked.
    #[arg(long, value_name = "K")]
    pub(super) variant: Option<usize>,
    /// PNG instead of SVG (where built with the feature `png`); a file named .png is one anyway.
    #[arg(long)]
    pub(super) png: bool,
    /// Pixels of a PNG for each of the drawing's; 2 by default.
    #[arg(long, value_name = "X")]
    pub(super) scale: Option<f64>,
    /// Width of a PNG in pixels.
    #[arg(long, value_name = "PIXELS", conflicts_with = "scale")]
    pub(super) width: Option<u32>,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    #[command(flatten, next_help_heading = "The list that --variant is of")]
    pub(super) question: Question,
}

#[derive(Debug, ClapArgs)]
pub(super) struct File {
    /// A path, `-`, or the name of a built-in mechanism.
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(super) file: String,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum RankMethod {
    /// The cheapest that is certain: exact where the geometry is, singular values where it was measured.
    Auto,
    /// Modulo two primes near 2^61, every digit taken at its word.
    Modular,
    /// Exact elimination in fractions (rational coordinates only).
    Rational,
    /// Singular values in double precision, with the gap.
    Svd,
    /// Column-pivoted QR in double precision.
    Qr,
    /// Column-pivoted QR in single precision.
    Qr32,
    /// LU with full pivoting in double precision.
    Lu,
    /// LU with full pivoting in single precision.
    Lu32,
    /// Counting formula in space, 6(n-1) less the constraints.
    Count,
    /// Counting formula in the plane, 3(n-1) less the constraints.
    CountPlanar,
    /// Freedoms less the sum of the contours' own ranks.
    Loops,
    /// The same structure in general position, by a pebble game.
    Generic,
    /// Exact rank, and the mobility that is really there.
    Finite,
}

#[derive(Debug, ClapArgs)]
pub(super) struct Analyze {
    #[command(flatten)]
    pub(super) file: File,
    /// A state named in the file, such as free or clamped, or all.
    #[arg(long, default_value = "all")]
    pub(super) state: String,
    /// How the rank is found.
    #[arg(long, value_enum, default_value = "auto")]
    pub(super) method: RankMethod,
    /// Relative tolerance of the floating-point methods, and of snapping measured geometry; by default what suits the
    /// method and the digits.
    #[arg(long, visible_alias = "snap", value_name = "T")]
    pub(super) tolerance: Option<f64>,
    /// Model the mechanism in its plane (normal z) with 3 rows per contour, whatever the file says.
    #[arg(long)]
    pub(super) planar: bool,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    pub(super) format: AnalyzeFormat,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// Also write a proof of each state's rank to a JSON file, for `ozols verify`.
    #[arg(long, value_name = "FILE")]
    pub(super) certificate: Option<PathBuf>,
    /// Also look at the poses over a range of the drive, in steps: 0:360deg:72. Counted from the pose of the file; radians
    /// where no unit stands, the file's length unit for drives that slide. In the first state unless --state names one.
    #[arg(long, value_name = "FROM:TO:STEPS", allow_hyphen_values = true)]
    pub(super) stroke: Option<String>,
    /// The joint that moves over the stroke, JOINT:FREEDOM where it has several; by default the file's first drive. The
    /// file's other drives are held, unless this is none of them.
    #[arg(long, value_name = "JOINT", requires = "stroke")]
    pub(super) drive: Option<String>,
    /// Write a chart of the conditioning over the stroke to a file.
    #[arg(long, value_name = "FILE", requires = "stroke")]
    pub(super) svg: Option<PathBuf>,
}

#[derive(Debug, ClapArgs)]
pub(super) struct Verify {
    #[command(flatten)]
    pub(super) file: File,
    /// The certificates, as written by `ozols analyze FILE --certificate CERTIFICATES`.
    #[arg(value_name = "CERTIFICATES")]
    pub(super) certificates: PathBuf,
    /// The certificates were made with `analyze --planar`.
    #[arg(long)]
    pub(super) planar: bool,
}

#[derive(Debug, ClapArgs)]
pub(super) struct Accuracy {
    /// Write charts and tables to this folder, index.html first among them; without it only the table is printed.
    #[arg(long, short, value_name = "DIR")]
    pub(super) output: Option<PathBuf>,
    /// Fewer repeats and coarser stability charts: some seconds instead of a minute or two.
    #[arg(long)]
    pub(super) quick: bool,
    /// Times each answer is timed; the median counts. 5 by default, 1 with --quick.
    #[arg(long, value_name = "N")]
    pub(super) repeat: Option<usize>,
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
pub(super) enum SearchFormat {
    Text,
    Json,
    /// One variant a line.
    Jsonl,
    /// One variant a line.
    Csv,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum SearchMethod {
    /// The span diagram.
    Diagram,
    /// Look at every variant; counts only. For checking and comparison.
    Brute,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Check {
    /// One prime, no second opinion.
    None,
    /// The whole search over two primes, which must agree.
    Prime,
    /// That, and each variant given, up to 1000, analysed again by singular values.
    Full,
}

/// How many of the cheapest variants a ranking scores, unless told otherwise.
pub(super) const POOL: usize = 1000;

/// What is asked of a search: all that the list of variants depends on, but for the state.
#[derive(Debug, ClapArgs)]
#[allow(clippy::struct_excessive_bools, reason = "switches of a command line")]
#[command(next_help_heading = "Which variants")]
pub(super) struct Question {
    /// Redundant constraints allowed within the mechanism.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(super) max_redundant: u32,
    /// Redundant constraints allowed from the clamped object; takes the joints of `--state` (and their unloading
    /// places) into the search.
    #[arg(long, value_name = "N")]
    pub(super) max_external: Option<u32>,
    /// Largest mobility W allowed.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(super) max_mobility: Option<i64>,
    /// Most changes allowed.
    #[arg(long, value_name = "N")]
    pub(super) max_changes: Option<u32>,
    /// Rank under the workload by these terms, in place of the file's [ranking] terms: peak-force=1,cost=0.5. Terms:
    /// peak-force, peak-moment, conditioning, output-error, changes, cost, idle; weight 1 where none stands.
    #[arg(long, value_name = "TERM[=WEIGHT],...", value_delimiter = ',')]
    pub(super) rank: Vec<String>,
    /// How many of the cheapest variants a ranking scores.
    #[arg(long, value_name = "K", default_value_t = POOL)]
    pub(super) pool: usize,
    /// Also give variants whose outputs move in other ways than now.
    #[arg(long)]
    pub(super) allow_output_change: bool,
    /// Another link that must not gain a motion (repeatable).
    #[arg(long, value_name = "LINK")]
    pub(super) hold: Vec<String>,
    /// Use these of the file's options everywhere, by name: revolute,spherical.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(super) options: Vec<String>,
    /// Options allowed at a joint: 2-3=revolute,spherical (repeatable). The present joint always is.
    #[arg(long, value_name = "JOINT=NAMES")]
    pub(super) allow: Vec<String>,
    /// Options forbidden at a joint: 2-3=spherical; all changes with 2-3 alone (repeatable).
    #[arg(long, value_name = "JOINT[=NAMES]")]
    pub(super) forbid: Vec<String>,
    /// Only variants that are their own mirror image.
    #[arg(long)]
    pub(super) symmetric: bool,
    /// Of a variant and its mirror image, only one.
    #[arg(long, conflicts_with = "symmetric")]
    pub(super) one_per_orbit: bool,
    /// Search a file whose coordinates look measured exactly as it is written, though rounding errors in it change the
    /// figures.
    #[arg(long)]
    pub(super) as_written: bool,
    /// Make axes exactly parallel, square, coaxial or concurrent that are so to within T (radians, and fractions of the
    /// largest coordinate), for files whose coordinates were measured or rounded; lists what was moved.
    #[arg(long, value_name = "T")]
    pub(super) snap: Option<f64>,
    /// Node budget of each diagram, about 1 KB of memory a node (twice that with a check).
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    pub(super) nodes: usize,
}

/// A question, the state it is about, and how its answer is checked.
#[derive(Debug, ClapArgs)]
pub(super) struct Asked {
    #[command(flatten)]
    pub(super) question: Question,
    /// The state meant by --max-external; the file's first besides free by default.
    #[arg(long, value_name = "STATE")]
    pub(super) state: Option<String>,
    /// Look at each variant given, up to 1000, in N further poses of the present motion, and mark those whose W, σ or
    /// output motion is not right there.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(super) poses: usize,
    /// Leave out the variants that further poses (3 unless --poses says otherwise) show to be lucky.
    #[arg(long)]
    pub(super) generic_only: bool,
    /// How the search is checked.
    #[arg(long, value_enum, default_value = "full")]
    pub(super) check: Check,
}

#[derive(Debug, ClapArgs)]
#[allow(clippy::struct_excessive_bools, reason = "switches of a command line")]
pub(super) struct Search {
    #[command(flatten)]
    pub(super) file: File,
    /// How many of the best variants to give.
    #[arg(long, value_name = "K", default_value_t = 10)]
    pub(super) top: usize,
    /// Give every admissible variant, cheapest first.
    #[arg(long, conflicts_with_all = ["top", "sample", "count", "rank"])]
    pub(super) all: bool,
    /// Give N admissible variants drawn at random, each with the same chance, instead of the best.
    #[arg(long, value_name = "N", conflicts_with_all = ["top", "count", "rank"])]
    pub(super) sample: Option<usize>,
    /// Counts only.
    #[arg(long, conflicts_with = "rank")]
    pub(super) count: bool,
    #[command(flatten)]
    pub(super) asked: Asked,
    /// Diagram, or brute force for checking.
    #[arg(long, value_enum, default_value = "diagram")]
    pub(super) method: SearchMethod,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    pub(super) format: SearchFormat,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
}

#[derive(Debug, ClapArgs)]
pub(super) struct Report {
    #[command(flatten)]
    pub(super) file: File,
    /// How many of the best variants the page holds, 10000 at most.
    #[arg(long, value_name = "K", default_value_t = 200)]
    pub(super) top: usize,
    #[command(flatten)]
    pub(super) asked: Asked,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
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
