//! Search options, the same for every command that searches.

use crate::api;
use crate::cli::terminal::machine;
use crate::file::text::{MAX_BYTES, text_of};
use crate::model::ranking::Term;
use crate::score::request::words::weighted_term;
use crate::score::request::{CostFile, Inserts, JointOptions, Request};
use crate::search::question::conditions::Symmetry;
use clap::{Args as ClapArgs, ValueEnum};
use serde::Serialize;
use serde_json::json;
use std::path::{Path, PathBuf};

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Check {
    /// One prime, no cross-check.
    None,
    /// The whole search modulo two primes, which must agree.
    Prime,
    /// Two primes, and singular values for each listed variant, up to 1000.
    Full,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Drives {
    /// Outputs and drives keep moving together as in the original.
    Kept,
    /// Only the outputs must keep their motion; a drive may lose its effect.
    Free,
    /// W equals the number of drives, and the drives determine the outputs: no two drives work against each other.
    Independent,
}

/// All options that select variants, except the state.
#[derive(Debug, ClapArgs, Serialize)]
#[allow(clippy::struct_excessive_bools, reason = "switches of a command line")]
#[command(next_help_heading = "Selecting variants")]
pub(crate) struct Which {
    /// Maximum number of redundant constraints left within the mechanism.
    #[arg(long, value_name = "N", default_value_t = 0)]
    max_redundant: u32,
    /// Maximum number of redundant constraints added by the state of --state; includes its joints and unloading joints in the
    /// search.
    #[arg(long, value_name = "N")]
    max_external: Option<u32>,
    /// Maximum number of harmful ones among these (that load clamping faces with more than friction); includes the state in the
    /// search.
    #[arg(long, value_name = "N")]
    max_harmful: Option<u32>,
    /// Also list variants that do not hold the clamped part.
    #[arg(long)]
    allow_loose_object: bool,
    /// Maximum mobility W.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    max_mobility: Option<i64>,
    /// Maximum number of changes.
    #[arg(long, value_name = "N")]
    max_changes: Option<u32>,
    #[arg(long, value_name = "TERM[=WEIGHT],...", value_delimiter = ',', help = rank_help())]
    #[serde(skip)]
    rank: Vec<String>,
    /// Number of cheapest variants to score in a ranking [default: 20000, then all others that could still win]. It stops early
    /// once the best are proven.
    #[arg(long, value_name = "K")]
    pool: Option<usize>,
    /// Also list variants that change the output motion.
    #[arg(long)]
    allow_output_change: bool,
    /// Condition on the drives [default: that of FILE, or kept].
    #[arg(long, value_enum, value_name = "WHAT")]
    drives: Option<Drives>,
    /// Link that must not gain a motion, or part that must be held (repeatable).
    #[arg(long, value_name = "LINK")]
    hold: Vec<String>,
    /// Joint types to allow at every joint, for example revolute,spherical. Types that the file does not list use the joint's
    /// frame; `any` allows every set of freedoms in this frame.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    options: Vec<String>,
    /// Joint types to allow at one joint, for example 2-3=revolute,spherical (repeatable). Its original type is always allowed.
    #[arg(long, value_name = "JOINT=NAMES")]
    #[serde(skip)]
    allow: Vec<String>,
    /// Joint types to forbid at a joint, for example 2-3=spherical; 2-3 forbids all changes (repeatable).
    #[arg(long, value_name = "JOINT[=NAMES]")]
    #[serde(skip)]
    forbid: Vec<String>,
    /// Joint types to allow in series with joints, in addition to those of the file: spherical,planar=4-a,a-8, or only spherical
    /// for all joints that the searched state adds (repeatable).
    #[arg(long, value_name = "NAMES[=JOINTS]")]
    #[serde(skip)]
    unloading: Vec<String>,
    /// TOML file with costs of joint types and changes, as `ozols show costs` prints them. It replaces the defaults and
    /// [search.costs] of FILE.
    #[arg(long, value_name = "COSTS", value_hint = clap::ValueHint::FilePath)]
    #[serde(skip)]
    costs: Option<PathBuf>,
    /// Only mirror-symmetric variants.
    #[arg(long)]
    #[serde(skip)]
    symmetric: bool,
    /// List only one of each pair of mirror images.
    #[arg(long, conflicts_with = "symmetric")]
    #[serde(skip)]
    one_per_orbit: bool,
    /// List only the first variant of each idea (same freedoms added to the same chain of joints).
    #[arg(long)]
    distinct: bool,
    /// Count and list variants that keep the motion in the drawn pose, without checking the rest of the motion.
    #[arg(long)]
    pose_only: bool,
    /// Use rounded coordinates exactly as written instead of the idealised geometry.
    #[arg(long)]
    as_written: bool,
    /// Node budget of each diagram; a node takes about 1 KB of memory (twice that with a check).
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    nodes: usize,
    /// Memory limit of the search, for example 500M or 2G [default: a quarter of the machine's memory on Linux, 4G
    /// elsewhere]. If it is reached, counts are lower bounds, as with --nodes.
    #[arg(long, value_name = "BYTES", value_parser = machine::parse_bytes)]
    #[serde(skip)]
    pub(crate) memory: Option<usize>,
}

/// Options that select variants, the state, and the checks.
#[derive(Debug, ClapArgs)]
pub(crate) struct Checked {
    #[command(flatten)]
    which: Which,
    /// State to include in the search, in addition to the free one [default with --max-external or --max-harmful: the first of
    /// the file].
    #[arg(long, value_name = "STATE")]
    state: Option<String>,
    /// Check each listed variant (up to 1000) in N further poses of the original motion, and mark those with a different W, σ or
    /// output motion.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) poses: usize,
    /// Check of the search.
    #[arg(long, value_enum, default_value = "full")]
    check: Check,
}

impl Which {
    /// Builds the request, about a state if one is named.
    pub(crate) fn request(&self, state: Option<&str>) -> anyhow::Result<Request> {
        let joint_options = |rule: &String| match rule.split_once('=') {
            Some((joint, names)) => JointOptions {
                joint: joint.to_owned(),
                names: names.split(',').map(str::to_owned).collect(),
            },
            None => JointOptions {
                joint: rule.clone(),
                names: Vec::new(),
            },
        };
        let inserts = |rule: &String| {
            let (names, joints) = rule.split_once('=').unwrap_or((rule, ""));
            let list = |words: &str| {
                let words = words.split(',').map(str::trim).filter(|w| !w.is_empty());
                words.map(str::to_owned).collect()
            };
            Inserts {
                names: list(names),
                joints: list(joints),
            }
        };
        let symmetry = match (self.symmetric, self.one_per_orbit) {
            (true, _) => Symmetry::SymmetricOnly,
            (_, true) => Symmetry::OnePerOrbit,
            _ => Symmetry::All,
        };
        let rank = self.rank.iter().map(|w| weighted_term(w));
        let rank = rank.collect::<Result<_, _>>();
        Ok(Request {
            state: state.map(str::to_owned),
            unloading: self.unloading.iter().map(inserts).collect(),
            allow: self.allow.iter().map(joint_options).collect(),
            forbid: self.forbid.iter().map(joint_options).collect(),
            costs: self.costs.as_deref().map(cost_file).transpose()?,
            symmetry,
            memory: self.memory.unwrap_or_else(machine::quarter_of_memory),
            rank: rank.map_err(|e| anyhow::anyhow!("--rank: {e}"))?,
            // All other options are fields of a request.
            ..serde_json::from_value(json!(self))?
        })
    }
}

/// Reads a file of costs.
fn cost_file(path: &Path) -> anyhow::Result<CostFile> {
    let name = path.display().to_string();
    let bytes = api::bytes(path, MAX_BYTES).map_err(|e| {
        anyhow::anyhow!("--costs: {e}; `ozols show costs > {name}` writes one to start from")
    })?;
    let text = text_of(&name, &bytes)?.to_owned();
    Ok(CostFile { name, text })
}

impl Checked {
    /// Builds the request, with the seed of its samples and poses.
    pub(crate) fn request(&self, seed: u64) -> anyhow::Result<Request> {
        Ok(Request {
            check: serde_json::from_value(json!(self.check))?,
            poses: self.poses,
            seed,
            ..self.which.request(self.state.as_deref())?
        })
    }
}

/// Returns the help of `--rank`.
fn rank_help() -> String {
    format!(
        "Rank under the workload by these terms instead of the file's [ranking] terms, for \
        example {}=1,{}=0.5. Terms: {}; weight 1 if omitted",
        Term::PeakForce.name(),
        Term::Cost.name(),
        Term::ALL.map(Term::name).join(", ")
    )
}
