//! The commands, one a file; this is the list of them.

pub(in crate::cli) mod accuracy;
pub(in crate::cli) mod analyze;
pub(in crate::cli) mod bench;
pub(in crate::cli) mod catalog;
pub(in crate::cli) mod check;
pub(in crate::cli) mod clamped;
pub(in crate::cli) mod completions;
pub(in crate::cli) mod draw;
pub(in crate::cli) mod drive;
pub(in crate::cli) mod explain;
pub(in crate::cli) mod export;
pub(in crate::cli) mod fix;
pub(in crate::cli) mod grip;
pub(in crate::cli) mod lint;
pub(in crate::cli) mod list;
pub(in crate::cli) mod new;
pub(in crate::cli) mod report;
pub(in crate::cli) mod search;
pub(in crate::cli) mod statics;
pub(in crate::cli) mod studio;
pub(in crate::cli) mod types;
pub(in crate::cli) mod verify;

use crate::cli::examples;
use crate::cli::option::named::File;
use clap::Subcommand;

#[derive(Debug, Subcommand)]
pub(in crate::cli) enum Command {
    /// Mobility and redundant constraints in each state.
    #[command(after_help = examples::ANALYZE)]
    Analyze(analyze::Analyze),
    /// Every redesign that removes the redundant constraints: exact counts and the best ones.
    #[command(after_help = examples::SEARCH)]
    Search(search::Search),
    /// Assur groups of a planar mechanism, and its joint reactions over the cycle.
    #[command(after_help = examples::STATICS)]
    Statics(statics::args::Statics),
    /// What a lever gripper can hold, and the drive moment it takes; force closure of any clamped mechanism.
    #[command(after_help = examples::GRIP)]
    Grip(grip::Grip),
    /// Size a torsional drive of two discs and run its programme.
    #[command(after_help = examples::DRIVE)]
    Drive(drive::Drive),
    /// Confirm the certificates of rank that `ozols analyze --certificate` wrote.
    #[command(after_help = examples::VERIFY)]
    Verify(verify::Verify),
    /// Name each redundant constraint of robot descriptions and CAD assemblies, with its line and what removes it.
    #[command(after_help = examples::LINT)]
    Lint(lint::Lint),
    /// Let the redundant constraints of a robot description or a CAD assembly go, in its own file.
    #[command(after_help = examples::FIX)]
    Fix(fix::Fix),
    /// Draw the structural or the kinematic scheme as SVG.
    #[command(after_help = examples::DRAW)]
    Draw(draw::Draw),
    /// One HTML page: the verdict, drawings, contours, and the variants to sort, filter and look at.
    #[command(after_help = examples::REPORT)]
    Report(report::Report),
    /// Draw and change a mechanism in the browser, with the verdict and the ideas at every change.
    #[command(after_help = examples::STUDIO)]
    Studio(studio::StudioArgs),
    /// Write a mechanism, robot description or CAD assembly in another format: TOML, JSON, URDF, MJCF, SDF, DOT, GraphML.
    #[command(after_help = examples::EXPORT)]
    Export(export::Export),
    /// How right and how fast each method is on every built-in mechanism, and where its numbers fail.
    #[command(after_help = examples::ACCURACY)]
    Accuracy(accuracy::Accuracy),
    /// How right and how fast each way of searching is: diagram, brute force, floating point, budgets, pools.
    #[command(after_help = examples::BENCH)]
    Bench(bench::Bench),
    /// The structures that a mechanism can have, before it is drawn: chains, and grippers made of them.
    #[command(after_help = examples::CATALOG)]
    Catalog(catalog::Catalog),
    /// Write a commented mechanism file to start from.
    #[command(after_help = examples::NEW)]
    New(new::New),
    /// What a file describes, and what is wrong or doubtful in it.
    #[command(after_help = examples::CHECK)]
    Check(File),
    /// The built-in mechanisms.
    #[command(after_help = examples::LIST)]
    List(list::List),
    /// Print the file of a built-in mechanism, or the table of costs.
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
}
