//! The commands, one file each; this is the list of them.

pub(crate) mod accuracy;
pub(crate) mod analyze;
pub(crate) mod bench;
pub(crate) mod catalog;
pub(crate) mod check;
pub(crate) mod clamped;
pub(crate) mod draw;
pub(crate) mod drive;
pub(crate) mod explain;
pub(crate) mod export;
pub(crate) mod fix;
pub(crate) mod grip;
pub(crate) mod lint;
pub(crate) mod list;
pub(crate) mod new;
pub(crate) mod report;
pub(crate) mod search;
pub(crate) mod statics;
pub(crate) mod studio;
pub(crate) mod types;
pub(crate) mod verify;

use crate::cli::examples;
use crate::cli::option::named::File;
use clap::Subcommand;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Analyse mobility and redundant constraints, state by state.
    #[command(after_help = examples::ANALYZE)]
    Analyze(analyze::Analyze),
    /// Find every redesign without redundant constraints: exact counts, best ones first.
    #[command(after_help = examples::SEARCH)]
    Search(search::Search),
    /// Compute Assur groups of a planar mechanism, and joint reactions over the cycle.
    #[command(after_help = examples::STATICS)]
    Statics(statics::args::Statics),
    /// Compute what a lever gripper can hold.
    #[command(after_help = examples::GRIP)]
    Grip(grip::Grip),
    /// Size a torsional drive of two discs and run its programme.
    #[command(after_help = examples::DRIVE)]
    Drive(drive::Drive),
    /// Check the certificates of rank that `ozols analyze --certificate` wrote.
    #[command(after_help = examples::VERIFY)]
    Verify(verify::Verify),
    /// Report redundant constraints in robot descriptions and CAD assemblies, with line and fix.
    #[command(after_help = examples::LINT)]
    Lint(lint::Lint),
    /// Remove the redundant constraints of a robot description or CAD assembly and write the edited file.
    #[command(after_help = examples::FIX)]
    Fix(fix::Fix),
    /// Draw the structural or the kinematic scheme as SVG.
    #[command(after_help = examples::DRAW)]
    Draw(draw::Draw),
    /// Write one HTML page: verdict, drawings, loops, and the redesigns to sort and filter.
    #[command(after_help = examples::REPORT)]
    Report(report::Report),
    /// Draw and edit a mechanism in the browser; verdict and ideas update with every change.
    #[command(after_help = examples::STUDIO)]
    Studio(studio::StudioArgs),
    /// Write a mechanism, robot description or CAD assembly in another format: TOML, JSON, URDF, MJCF, SDF, DOT.
    #[command(after_help = examples::EXPORT)]
    Export(export::Export),
    /// Measure accuracy and speed of every rank method on the built-in mechanisms.
    #[command(after_help = examples::ACCURACY)]
    Accuracy(accuracy::Accuracy),
    /// Benchmark the search methods: diagram, brute force, floating point, budgets, pools.
    #[command(after_help = examples::BENCH)]
    Bench(bench::Bench),
    /// Enumerate kinematic chains and gripper structures, and build catalogues of them.
    #[command(after_help = examples::CATALOG)]
    Catalog(catalog::Catalog),
    /// Write a commented mechanism file to start from.
    #[command(after_help = examples::NEW)]
    New(new::New),
    /// Check a mechanism file: summary, errors and warnings.
    #[command(after_help = examples::CHECK)]
    Check(File),
    /// List the built-in mechanisms.
    #[command(after_help = examples::LIST)]
    List(list::List),
    /// Print the file of a built-in mechanism, or the table of costs.
    #[command(after_help = examples::SHOW)]
    Show(check::Show),
    /// Print the JSON Schema of the mechanism file.
    #[command(after_help = examples::SCHEMA)]
    Schema,
    /// Explain a term or joint type.
    #[command(after_help = examples::EXPLAIN)]
    Explain(explain::Explain),
    /// Print a script that completes commands and options in a shell.
    #[command(after_help = examples::COMPLETIONS)]
    Completions(check::Completions),
}
