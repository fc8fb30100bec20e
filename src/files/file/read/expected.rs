//! Figures a published analysis gives.

use crate::file::findings::Findings;
use crate::file::locate::DocumentStep;
use crate::file::problem::ProblemKind;
use crate::file::schema::MechanismFile;
use crate::model::mechanism::{Expected, Mechanism};

pub(crate) fn expected(
    file: &MechanismFile,
    mechanism: &Mechanism,
    out: &mut Findings,
) -> Vec<Expected> {
    let mut list = Vec::new();
    for (i, e) in file.expected.iter().enumerate() {
        let state = e.state.clone().unwrap_or_else(|| "free".to_owned());
        if !mechanism.states.contains(&state) {
            let path = [
                DocumentStep::Key("expected".to_owned()),
                DocumentStep::Index(i),
                DocumentStep::Key("state".to_owned()),
            ];
            let known = mechanism.states.join(", ");
            out.add(
                &path,
                ProblemKind::UnknownWord {
                    what: "state",
                    word: state.clone(),
                    known,
                },
            );
        }
        list.push(Expected {
            state,
            mobility: e.mobility,
            finite_mobility: e.finite_mobility,
            working_mobility: e.working_mobility,
            local_mobility: e.local_mobility,
            redundant: e.redundant,
            external_redundant: e.external_redundant,
            source: e.source.clone(),
        });
    }
    list
}
