//! Judgement of answers against the true figures of a mechanism: right, undecided, wrong but reported as not exact, or wrong and sure.

use super::timing::quantile;
use super::{AnswerVerdict, Truth};
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::method::auto::{Decision, decide_state};
use crate::rank::method::{Certainty, MobilityMethod, NoAnswer};

/// A judgement of an answer against the truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Said {
    /// The true figures.
    Right,
    /// No figures, or a range.
    Open,
    /// Other figures, and that they are not exact.
    Hedged,
    /// Other figures as exact or proven ones.
    Wrong,
}

impl Said {
    /// All of them, the best first.
    pub(super) const ALL: [Said; 4] = [Said::Right, Said::Open, Said::Hedged, Said::Wrong];

    /// Judges an answer: whether it is given, whether it is called exact, and whether it is right.
    pub fn judge(given: bool, exact: bool, right: bool) -> Said {
        match (given, right, exact) {
            (false, ..) => Said::Open,
            (_, true, _) => Said::Right,
            (_, _, false) => Said::Hedged,
            _ => Said::Wrong,
        }
    }

    /// Judges the answer of a method by what the method promises. For the automatic choice this is the worse of W and finite
    /// mobility. Returns `None` if the method does not apply.
    fn of_method(method: &MobilityMethod, m: &Mechanism, s: StateId, t: Truth) -> Option<Said> {
        if method.name() == "auto" {
            let found = Said::of_decision(decide_state(m, s).ok().as_ref(), t);
            return found.into_iter().max();
        }
        let answer = method.answer(m, s);
        match &answer {
            Err(NoAnswer::Failed(_)) => Some(Said::Open),
            Err(_) => None,
            Ok(a) => {
                let open = matches!(a.certainty, Certainty::Undecided { .. });
                let numeric = matches!(a.certainty, Certainty::Numeric { .. } | Certainty::Traced);
                Some(Said::judge(
                    !open,
                    !numeric,
                    AnswerVerdict::keeps_promise(&answer, t),
                ))
            }
        }
    }

    /// Judges W at the pose and the finite mobility of a decision. The figures of a nearly special geometry are not exact, nor are
    /// those of a traced motion.
    pub fn of_decision(found: Option<&Decision>, truth: Truth) -> [Said; 2] {
        let Some(d) = found else {
            return [Said::Open; 2];
        };
        let is = |w: usize, truth: i64| i64::try_from(w) == Ok(truth);
        let (given, exact) = (d.verdict.is_decided(), d.verdict.as_word() != "near");
        let w = d.verdict.figures_at(d.verdict.rank()).0;
        [
            Said::judge(given, exact, is(w, truth.instantaneous)),
            Said::judge(
                given && !d.finite.is_undecided(),
                exact && d.finite.is_proven(),
                is(d.finite.mobility, truth.finite),
            ),
        ]
    }
}

/// The judgement of one case.
#[derive(Debug, Clone)]
pub(crate) struct Reply {
    /// The judgement.
    said: Said,
    /// The time of the answer in seconds; 0 if it was not measured.
    seconds: f64,
    /// The name of the case if the answer is wrong and sure; empty otherwise.
    case: String,
}

impl Reply {
    /// Returns a reply that was not timed.
    pub(crate) fn new(said: Said, case: impl FnOnce() -> String) -> Reply {
        Reply {
            said,
            seconds: 0.0,
            case: if said == Said::Wrong {
                case()
            } else {
                String::new()
            },
        }
    }

    /// Returns the reply with the time that it took, in seconds.
    pub(crate) fn with_time(self, seconds: f64) -> Reply {
        Reply { seconds, ..self }
    }

    /// Returns the worst reply of a method for mechanisms that belong together; `None` if it does not apply to one of them.
    pub(crate) fn of_method(
        method: &MobilityMethod,
        all: &[(&Mechanism, StateId, Truth)],
    ) -> Option<Reply> {
        let each = all
            .iter()
            .map(|(m, state, truth)| Said::of_method(method, m, *state, *truth));
        let worst = each.collect::<Option<Vec<_>>>()?.into_iter().max()?;
        Some(Reply::new(worst, || all[0].0.name.clone()))
    }

    /// Returns the replies of several methods.
    pub(crate) fn of_methods(
        methods: &[&MobilityMethod],
        all: &[(&Mechanism, StateId, Truth)],
    ) -> Vec<Option<Reply>> {
        methods.iter().map(|m| Reply::of_method(m, all)).collect()
    }
}

/// Replies counted.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tally {
    /// How many of each of [`Said`].
    pub of: [usize; 4],
    /// The cases that are wrong and sure.
    pub wrong: Vec<String>,
    /// How long each took.
    pub seconds: Vec<f64>,
    /// The figure that is drawn; `None` if it follows from the counts or the times.
    pub figure: Option<f64>,
}

impl Tally {
    /// Creates the tally of some replies.
    pub(crate) fn of<'a>(replies: impl IntoIterator<Item = &'a Reply>) -> Tally {
        let mut tally = Tally::default();
        for reply in replies {
            tally.of[reply.said as usize] += 1;
            tally.seconds.push(reply.seconds);
            tally
                .wrong
                .extend((reply.said == Said::Wrong).then(|| reply.case.clone()));
        }
        tally
    }

    /// Returns a tally of right and of wrong answers that took a time together.
    pub fn of_share(right: usize, of: usize, seconds: f64) -> Tally {
        Tally {
            of: [right, 0, 0, of - right],
            seconds: vec![seconds],
            ..Tally::default()
        }
    }

    /// Adds the counts of another tally.
    pub fn add(&mut self, other: &Tally) {
        for (sum, of) in self.of.iter_mut().zip(other.of) {
            *sum += of;
        }
    }

    /// Returns the number of replies.
    pub fn count_replies(&self) -> usize {
        self.of.iter().sum()
    }

    /// Returns the median time in seconds.
    pub fn median_time(&self) -> f64 {
        quantile(&self.seconds, 0.5)
    }

    /// Returns the share of one of [`Said`] in per cent; 0 if there are no replies.
    pub fn percent_of(&self, said: Said) -> f64 {
        100.0 * self.of[said as usize] as f64 / self.count_replies().max(1) as f64
    }
}
