//! How right and how fast methods are.

use crate::accuracy::study::Study;
use crate::accuracy::survey::Survey;
use crate::accuracy::timing::Machine;
use crate::format::format_duration;
use crate::rank::method::{MobilityMethod, registry};
use crate::view::prelude::*;

/// Returns a table of the methods on built-in mechanisms and on those from the seed, the machine it was made on, and a paragraph
/// for each study.
pub fn accuracy_text(
    [survey, generated]: [&Survey; 2],
    studies: &[Study],
    machine: &Machine,
    width: Option<u16>,
) -> String {
    let cases = survey.cases.len();
    let heads = format!(
        "method | right of {cases} | at the pose only | wrong | n/a | right of {} from the seed | median time | what it promises",
        generated.cases.len()
    );
    let standing = |name: &str| {
        let m = registry::ALL.iter().position(|x| x.name() == name)?;
        Some(survey.record_of(m).right)
    };
    let mut out = format!("{cases} cases of known mobility");
    if let (Some(auto), Some(count)) = (standing("auto"), standing("count")) {
        out +=
            &format!(": the automatic choice is right on {auto}, the counting formula on {count}");
    }
    let table = text_table(&heads, method_rows(survey, generated), width);
    out += &format!(
        "\n\n{table}\n\n{}. On {machine}.\n",
        survey.describe_repeats()
    );
    for study in studies {
        out += &format!("\n{}: {}\n", study.texts.title, study.conclusion());
    }
    fit_lines(&out, width)
}

/// Returns a row for each method.
fn method_rows(survey: &Survey, generated: &Survey) -> Vec<Vec<String>> {
    let cases = survey.cases.len();
    let count = |n: usize| if n == 0 { String::new() } else { n.to_string() };
    let row = |(m, method): (usize, &&MobilityMethod)| {
        let s = survey.record_of(m);
        vec![
            method.name().to_owned(),
            s.right.to_string(),
            count(s.pose),
            count(s.count_wrong()),
            count(cases - s.applies),
            generated.record_of(m).right.to_string(),
            format_duration(s.seconds),
            method.guarantee.to_owned(),
        ]
    };
    registry::ALL.iter().enumerate().map(row).collect()
}
