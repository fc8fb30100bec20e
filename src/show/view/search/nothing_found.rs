//! If nothing is found: the reasons in words, and the requests that find something.

use crate::score::outcome::remarks::{Remarks, ease_request};
use crate::search::answer::why_none::{Hopeless, Relaxation};
use crate::view::prelude::*;
use crate::view::terminal::next_commands::request_flags;

/// Returns why no variant can be found, a sentence for each reason; empty if some may be.
pub fn hopeless_reasons(m: &Mechanism, why: &Hopeless) -> Vec<String> {
    let named = |joints: &[JointId]| {
        let ids = joints.iter().map(|&j| m.joints[j].id.as_str());
        join_and(&ids.collect_vec())
    };
    let mut out = Vec::new();
    if let Some(least) = why.least_redundant {
        out.push(format!(
            "Even with the freest option at every joint, σ = {least} remains, so no choice of these options is enough"
        ));
        let (driven, others): (Vec<_>, Vec<_>) =
            why.unchanged.iter().partition(|&&j| m.joints[j].drive);
        for (joints, reason) in [(driven, "driven"), (others, "not offered any option")] {
            if !joints.is_empty() {
                let (stays, it) = match joints.len() {
                    1 => ("stays unchanged, because it is", "it"),
                    _ => ("stay unchanged, because they are", "them"),
                };
                out.push(format!(
                    "{} {stays} {reason}; list joint types as options of {it} to let the search change {it}",
                    named(&joints)
                ));
            }
        }
    }
    if !why.frozen.is_empty() {
        out.push(format!(
            "Nothing moves the drive {} in the original mechanism: it is locked, and so it is in every variant that keeps the output motion",
            named(&why.frozen)
        ));
    }
    out
}

/// Returns the requests that find something if one found nothing, each with its result in words that name no option.
pub fn wider_requests(outcome: &Outcome, remarks: &Remarks) -> Vec<(Request, String)> {
    let gives = |how, n: &_| {
        let n = plural_of(&group_thousands(n), "variant");
        let constraints = |k: u32| count_noun(k as usize, "redundant constraint");
        match how {
            Relaxation::Redundant(k) => format!("{n} with at most {} left", constraints(k)),
            Relaxation::External(k) => {
                format!("{n} with at most {} added by the state", constraints(k))
            }
            Relaxation::Harmful(k) => {
                format!("{n} with at most {k} harmful constraints added by the state")
            }
            Relaxation::Mobility(w) => format!("{n} with a mobility of at most {w}"),
            Relaxation::Changes(c) => {
                format!(
                    "{n} with at most {}",
                    count_noun(c as usize, "changed joint")
                )
            }
            Relaxation::OutputChange => format!("{n} whose outputs move differently from now"),
            Relaxation::FreeDrives => format!("{n} in which a drive no longer holds"),
            Relaxation::LooseObject => format!("{n} that do not hold the clamped part"),
            Relaxation::PoseOnly => {
                "the variants that keep the motion in the drawn pose".to_owned()
            }
        }
    };
    let steps = remarks.eased.iter();
    let steps = steps.map(|(how, n)| (ease_request(&outcome.request, *how), gives(*how, n)));
    let offered = remarks.offered.iter().map(|wider| {
        let all = remarks.offered_options(&outcome.request).iter();
        let each = all.map(|o| format!("{} at {}", o.names.join(" or "), o.joint));
        let nuts = remarks.offered_unloading(&outcome.request).iter();
        let nuts = nuts.map(|i| {
            let (names, joints) = (i.names.join(" or "), i.joints.join(" and "));
            format!("{names} in series with {joints}")
        });
        let asked = &outcome.request.options;
        let everywhere = wider.options.iter().filter(|o| !asked.contains(o)).cloned();
        let words = format!(
            "Allow more joint types: there are redesigns with {}",
            everywhere.chain(each).chain(nuts).join(", ")
        );
        (wider.clone(), words)
    });
    // `--idea` says that ideas are meant.
    let plain = |request| Request {
        distinct: false,
        ..request
    };
    let all = steps.chain(offered);
    all.map(|(request, gives)| (plain(request), gives))
        .collect()
}

/// Returns the same as commands, with a hint at more options if no joint types are named.
pub fn wider_commands(
    outcome: &Outcome,
    remarks: &Remarks,
    command: &str,
    file: &str,
) -> Vec<NextCommand> {
    let m = &outcome.search.mechanism;
    let steps = wider_requests(outcome, remarks)
        .into_iter()
        .map(|(request, gives)| {
            NextCommand::new(command, file, &request_flags(m, &request), &gives)
        });
    let in_pose = remarks
        .eased
        .iter()
        .any(|(how, _)| *how == Relaxation::PoseOnly);
    let hint = (!in_pose && remarks.offered.is_none()).then(|| NextCommand {
        command: "List more joint types under [search] or at a joint".to_owned(),
        gives: format!(
            "the search chooses from those in the file, and from joint types named in {} and {}",
            typed_option("options", ""),
            typed_option("allow", "")
        ),
    });
    steps.chain(hint).collect()
}
