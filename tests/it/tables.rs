//! Tables say what they leave out, and one name stands for one thing.

use crate::common::out;

/// The rows of a table after a head that begins with `first`.
fn rows<'a>(text: &'a str, first: &str) -> (Vec<&'a str>, Vec<Vec<&'a str>>) {
    let mut lines = text
        .lines()
        .skip_while(|l| !l.trim_start().starts_with(first));
    let cells = |l: &'a str| {
        l.split("  ")
            .map(str::trim)
            .filter(|c| !c.is_empty())
            .collect::<Vec<_>>()
    };
    let head = cells(lines.next().unwrap());
    let body = lines.skip(1).take_while(|l| !l.trim().is_empty());
    (head, body.map(cells).collect())
}

fn count(cell: &str) -> u64 {
    cell.replace(',', "").parse().unwrap()
}

/// The mobilities that no admissible variant has are one row, so that both columns add up to what the first lines say.
#[test]
fn variants_by_mobility_add_up() {
    let text = out(&["search", "gripper-10", "--count"]);
    let (_, body) = rows(&text, "W ");
    assert!(
        body.last().unwrap()[0].starts_with("rest, 12 to "),
        "{text}"
    );
    let column = |i: usize| body.iter().map(|r| count(r[i])).sum::<u64>();
    assert_eq!(column(1), 6_340_592_477);
    assert_eq!(column(2), 25_761_436);
}

/// The conditioning of a variant and that with its drives held are two numbers with two names, and a note tells them apart.
#[test]
fn conditionings_have_their_own_names() {
    let text = out(&["search", "gripper-10-loaded", "--top", "2", "--pool", "50"]);
    let (head, _) = rows(&text, "cost ");
    assert!(
        head.contains(&"cond.") && head.contains(&"cond. held"),
        "{head:?}"
    );
    assert!(!text.contains("condit."), "{text}");
    assert!(text.contains("cond. held: as cond."), "{text}");
}
