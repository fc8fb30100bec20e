//! The first line of a table: what it is of.

use crate::file::read::value::parameters::Domain;
use crate::shard::Shard;
use crate::sweep::Sweep;
use crate::sweep::redesigns::as_searched;
use crate::sweep::space::{Sampling, VaryingParameter};
use itertools::Itertools;
use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};
use std::collections::BTreeMap;

/// Version of the lines.
const VERSION: u32 = 1;

/// What a table is of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Head {
    /// Name of the mechanism.
    pub sweep: String,
    /// Version of the lines.
    pub version: u32,
    /// Version of the program.
    pub ozols: String,
    /// SHA-256 of the mechanism file.
    pub file: String,
    /// What each parameter may be, the ends of its range or its values.
    pub parameters: BTreeMap<String, Vec<String>>,
    /// Numbers of the grid along each parameter, or of the sequence.
    pub sampling: String,
    /// What is found out beside mobility and redundant constraints.
    pub asked: String,
    /// Samples of all parts.
    pub samples: usize,
    /// Which part, such as `1/1`.
    pub shard: String,
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|b| format!("{b:02x}")).collect()
}

impl Head {
    /// What the table of a part of a sweep is of.
    #[must_use]
    pub fn new(sweep: &Sweep, shard: Shard) -> Head {
        let spec = &sweep.spec;
        let domain = |a: &VaryingParameter| match &a.domain {
            Domain::Range([from, to]) => vec![format!("from {from}"), format!("to {to}")],
            Domain::Values(_) | Domain::Constant => {
                a.grid.iter().map(ToString::to_string).collect()
            }
        };
        let sizes = || sweep.space.axes.iter().map(|a| a.grid.len()).join(" x ");
        let asked = &spec.asked;
        let search = asked.search.as_ref().map(|r| {
            let all = format!("{:?}", as_searched(r, 0));
            format!("search {}", &hex(&Sha256::digest(all))[..16])
        });
        let stroke = asked
            .stroke
            .as_ref()
            .map(|(text, _)| format!("stroke {text}"));
        let methods = asked.methods.then(|| "methods".to_owned());
        let top = format!("top {}", asked.top);
        let written = asked.as_written.then(|| "as written".to_owned());
        let asked = [
            search.map(|s| format!("{s}, {top}")),
            stroke,
            methods,
            written,
        ];
        Head {
            sweep: sweep.mechanism.clone(),
            version: VERSION,
            ozols: env!("CARGO_PKG_VERSION").to_owned(),
            file: hex(&Sha256::digest(&spec.text)),
            parameters: sweep
                .space
                .axes
                .iter()
                .map(|a| (a.name.clone(), domain(a)))
                .collect(),
            sampling: match spec.sampling {
                Sampling::Grid { .. } => format!("grid {}", sizes()),
                Sampling::Sobol { count, seed } => format!("sobol {count}, seed {seed}"),
            },
            asked: asked.into_iter().flatten().join("; "),
            samples: sweep.space.len(),
            shard: shard.to_string(),
        }
    }

    /// Where it differs from another, but for the part.
    pub(super) fn differs(&self, asked: &Head) -> Option<(&'static str, String, String)> {
        let words = |h: &Head| {
            [
                ("the mechanism", h.sweep.clone()),
                ("the file", h.file[..h.file.len().min(12)].to_owned()),
                ("the sampling", h.sampling.clone()),
                ("the parameters", format!("{:?}", h.parameters)),
                ("what is asked", h.asked.clone()),
                ("the version", format!("{} of ozols {}", h.version, h.ozols)),
            ]
        };
        let mut both = words(self).into_iter().zip(words(asked));
        both.find(|(a, b)| a != b)
            .map(|((what, there), (_, asked))| (what, there, asked))
    }
}
