//! What is asked of a search, in arguments: the same for every command that searches.

use crate::api;
use crate::cli::terminal::memory;
use crate::file::text::{MAX_BYTES, text_of};
use crate::model::ranking::Term;
use crate::score::request::words::weighted_term;
use crate::score::request::{self, CostFile, Inserts, JointOptions, Request};
use crate::search::question::conditions::Symmetry;
use crate::search::question::kept as what;
use clap::{Args as ClapArgs, ValueEnum};
use std::path::{Path, PathBuf};

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Check {
    /// One prime, no second opinion.
    None,
    /// The whole search over two primes, which must agree.
    Prime,
    /// That, and each variant given, up to 1000, analysed again by singular values.
    Full,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Drives {
    /// Outputs and drives move together as they do now.
    Kept,
    /// Only the outputs must keep their motion; a drive may let go.
    Free,
    /// There are as many motions as drives, and the drives decide the outputs: no two drives work against each other.
    Independent,
}

/// All that the list of variants depends on, but for the state.
#[derive(Debug, ClapArgs)]
#[allow(clippy::struct_excessive_bools, reason = "switches of a command line")]
#[command(next_help_heading = "Which variants")]
pub(in crate::cli) struct Which {
    /// Redundant constraints allowed within the mechanism.
    #[arg(long, value_name = "N", default_value_t = 0)]
    max_redundant: u32,
    /// Redundant constraints that the state of --state may add; takes its joints (and their unloading places) into the
    /// search.
    #[arg(long, value_name = "N")]
    max_external: Option<u32>,
    /// Harmful ones among them: those that load clamping faces with more than friction; takes the state into the search.
    #[arg(long, value_name = "N")]
    max_harmful: Option<u32>,
    /// Also give variants in which the clamped object can move against all its jaws.
    #[arg(long)]
    allow_loose_object: bool,
    /// Largest mobility W allowed.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    max_mobility: Option<i64>,
    /// Most changes allowed.
    #[arg(long, value_name = "N")]
    max_changes: Option<u32>,
    #[arg(long, value_name = "TERM[=WEIGHT],...", value_delimiter = ',', help = rank_help())]
    rank: Vec<String>,
    /// Score only so many of the cheapest variants in a ranking, fewer where the best are proven before; without it 20,000, and
    /// then all others that could be among the best.
    #[arg(long, value_name = "K")]
    pool: Option<usize>,
    /// Also give variants whose outputs move in other ways than now.
    #[arg(long)]
    allow_output_change: bool,
    /// What is asked of the drives.
    #[arg(long, value_enum, value_name = "WHAT", default_value_t = Drives::Kept)]
    drives: Drives,
    /// Another link that must not gain a motion, or an object that must be held (repeatable).
    #[arg(long, value_name = "LINK")]
    hold: Vec<String>,
    /// Use these of the file's options everywhere, by name: revolute,spherical. Joint types that the file does not list are
    /// offered in the joints' own frames; `any` offers every set of freedoms there.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    options: Vec<String>,
    /// Options allowed at a joint: 2-3=revolute,spherical (repeatable). The present joint always is.
    #[arg(long, value_name = "JOINT=NAMES")]
    allow: Vec<String>,
    /// Options forbidden at a joint: 2-3=spherical; all changes with 2-3 alone (repeatable).
    #[arg(long, value_name = "JOINT[=NAMES]")]
    forbid: Vec<String>,
    /// Joints to offer in series, beside those of the file: spherical,planar=4-a,a-8, or spherical alone for all joints that
    /// the searched state adds (repeatable).
    #[arg(long, value_name = "NAMES[=JOINTS]")]
    unloading: Vec<String>,
    /// Costs of joint types and changes, in place of the defaults and of [search.costs] in FILE: a TOML file such as
    /// `ozols show costs` prints.
    #[arg(long, value_name = "COSTS", value_hint = clap::ValueHint::FilePath)]
    costs: Option<PathBuf>,
    /// Only variants that are their own mirror image.
    #[arg(long)]
    symmetric: bool,
    /// Of a variant and its mirror image, only one.
    #[arg(long, conflicts_with = "symmetric")]
    one_per_orbit: bool,
    /// Of the variants that give the same freedoms to the same joints in series, only the first.
    #[arg(long)]
    distinct: bool,
    /// Count and list the variants that keep the motion in the drawn pose, without following them along the motion.
    #[arg(long)]
    pose_only: bool,
    /// Search a file whose coordinates are rounded exactly as it is written, though something else is meant.
    #[arg(long)]
    as_written: bool,
    /// Node budget of each diagram, about 1 KB of memory a node (twice that with a check).
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    nodes: usize,
    /// Memory that a search may hold, in bytes or such as 500M or 2G; by default a quarter of the machine's. Where it does not
    /// suffice, counts are lower bounds, as with --nodes.
    #[arg(long, value_name = "BYTES", value_parser = memory::bytes)]
    pub(in crate::cli) memory: Option<usize>,
}

/// Which variants, the state meant, and how they are checked.
#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Checked {
    #[command(flatten)]
    which: Which,
    /// The state that takes part besides the free one, its joints among what is searched; the file's first where only
    /// --max-external or --max-harmful is given.
    #[arg(long, value_name = "STATE")]
    state: Option<String>,
    /// Look at each variant given, up to 1000, in N further poses of the present motion, and mark those whose W, σ or
    /// output motion is not right there.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(in crate::cli) poses: usize,
    /// How the search is checked.
    #[arg(long, value_enum, default_value = "full")]
    check: Check,
}

impl Which {
    /// The request, about a state where one is named.
    pub(in crate::cli) fn request(&self, state: Option<&str>) -> anyhow::Result<Request> {
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
        Ok(Request {
            max_redundant: self.max_redundant,
            max_external: self.max_external,
            max_harmful: self.max_harmful,
            allow_loose_object: self.allow_loose_object,
            state: state.map(str::to_owned),
            max_mobility: self.max_mobility,
            max_changes: self.max_changes,
            allow_output_change: self.allow_output_change,
            drives: match self.drives {
                Drives::Kept => what::Drives::Kept,
                Drives::Free => what::Drives::Free,
                Drives::Independent => what::Drives::Independent,
            },
            hold: self.hold.clone(),
            unloading: self.unloading.iter().map(inserts).collect(),
            options: self.options.clone(),
            allow: self.allow.iter().map(joint_options).collect(),
            forbid: self.forbid.iter().map(joint_options).collect(),
            costs: self.costs.as_deref().map(cost_file).transpose()?,
            symmetry: match (self.symmetric, self.one_per_orbit) {
                (true, _) => Symmetry::SymmetricOnly,
                (_, true) => Symmetry::OnePerOrbit,
                _ => Symmetry::All,
            },
            as_written: self.as_written,
            pose_only: self.pose_only,
            nodes: self.nodes,
            memory: self.memory.unwrap_or_else(memory::quarter),
            rank: self
                .rank
                .iter()
                .map(|w| weighted_term(w))
                .collect::<Result<_, _>>()
                .map_err(|e| anyhow::anyhow!("--rank: {e}"))?,
            pool: self.pool,
            distinct: self.distinct,
            ..Request::default()
        })
    }
}

/// A file of costs.
fn cost_file(path: &Path) -> anyhow::Result<CostFile> {
    let name = path.display().to_string();
    let bytes = api::bytes(path, MAX_BYTES).map_err(|e| {
        anyhow::anyhow!("--costs: {e}; `ozols show costs > {name}` writes one to start from")
    })?;
    let text = text_of(&name, &bytes)?.to_owned();
    Ok(CostFile { name, text })
}

impl Checked {
    /// The request, with the seed of its samples and poses.
    pub(in crate::cli) fn request(&self, seed: u64) -> anyhow::Result<Request> {
        Ok(Request {
            check: match self.check {
                Check::None => request::Check::None,
                Check::Prime => request::Check::Prime,
                Check::Full => request::Check::Full,
            },
            poses: self.poses,
            seed,
            ..self.which.request(self.state.as_deref())?
        })
    }
}

/// The help of `--rank`.
fn rank_help() -> String {
    format!(
        "Rank under the workload by these terms, in place of the file's [ranking] terms: {}=1,{}=0.5. Terms: {}; weight 1 where \
         none stands",
        Term::PeakForce.name(),
        Term::Cost.name(),
        Term::ALL.map(Term::name).join(", ")
    )
}
