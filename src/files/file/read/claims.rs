//! What publications say of a mechanism.

use crate::file::findings::Findings;
use crate::file::locate::DocumentStep;
use crate::file::problem::ProblemKind;
use crate::file::schema::MechanismFile;
use crate::format::disjunction;
use crate::model::claim::{Claim, Topic};

/// The claims of a file; one of an unknown topic is a problem.
pub(crate) fn claims(file: &MechanismFile, out: &mut Findings) -> Vec<Claim> {
    let mut list = Vec::new();
    for (i, c) in file.claim.iter().enumerate() {
        let Some(topic) = Topic::ALL.into_iter().find(|t| t.word() == c.topic) else {
            let key = |k: &str| DocumentStep::Key(k.to_owned());
            let path = [key("claim"), DocumentStep::Index(i), key("topic")];
            let known = disjunction(Topic::ALL.map(Topic::word));
            let (what, word) = ("topic", c.topic.clone());
            out.add(&path, ProblemKind::UnknownWord { what, word, known });
            continue;
        };
        list.push(Claim {
            topic,
            source: c.source.clone(),
            says: c.says.clone(),
            right: c.right.clone(),
            scan: c.scan.clone(),
            evidence: c.evidence.clone(),
        });
    }
    list
}
