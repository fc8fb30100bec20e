//! The commands, one file each; this is the list of them.

pub(crate) mod accuracy;
pub(crate) mod analyze;
pub(crate) mod catalog;
pub(crate) mod draw;
pub(crate) mod export;
pub(crate) mod grip;
/// Reference: built-in mechanisms, terms, the schema of the file.
pub(crate) mod reference {
    pub(crate) mod check;
    pub(crate) mod explain;
    pub(crate) mod list;
}
pub(crate) mod report;
/// Redundant constraints of robot descriptions and CAD assemblies.
pub(crate) mod robot {
    pub(crate) mod fix;
    pub(crate) mod lint;
    pub(crate) mod types;
}
pub(crate) mod search;
pub(crate) mod statics;
pub(crate) mod studio;
pub(crate) mod verify;

use crate::cli::option::named::File;
use clap::Subcommand;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Analyse mobility and redundant constraints, state by state.
    Analyze(analyze::Analyze),
    /// Find every redesign without redundant constraints: exact counts, best ones first.
    Search(search::Search),
    /// Compute Assur groups of a planar mechanism, and joint reactions over the cycle.
    Statics(statics::Statics),
    /// Compute what a lever gripper can hold.
    Grip(grip::Grip),
    /// Size a torsional drive of two discs and run its programme.
    Drive(grip::Drive),
    /// Check the certificates of rank that `ozols analyze --certificate` wrote.
    Verify(verify::Verify),
    /// Report redundant constraints in robot descriptions and CAD assemblies, with line and fix.
    Lint(robot::lint::Lint),
    /// Remove the redundant constraints of a robot description or CAD assembly and write the edited file.
    Fix(robot::fix::Fix),
    /// Draw the structural or the kinematic scheme as SVG.
    Draw(draw::Draw),
    /// Write one HTML page: verdict, drawings, loops, and the redesigns to sort and filter.
    Report(report::Report),
    /// Draw and edit a mechanism in the browser; verdict and ideas update with every change.
    Studio(studio::StudioArgs),
    /// Write a mechanism, robot description or CAD assembly in another format: TOML, JSON, URDF, MJCF, SDF, DOT.
    Export(export::Export),
    /// Measure accuracy and speed of every rank method on the built-in mechanisms.
    Accuracy(accuracy::Accuracy),
    /// Enumerate kinematic chains and gripper structures, and build catalogues of them.
    Catalog(catalog::Catalog),
    /// Write a commented mechanism file to start from.
    New(reference::list::New),
    /// Check a mechanism file: summary, errors and warnings.
    Check(File),
    /// List the built-in mechanisms.
    List(reference::list::List),
    /// Print the file of a built-in mechanism, or the table of costs.
    Show(reference::check::Show),
    /// Print the JSON Schema of the mechanism file.
    Schema,
    /// Explain a term or joint type.
    Explain(reference::explain::Explain),
    /// Print a script that completes commands and options in a shell.
    Completions(reference::check::Completions),
}
