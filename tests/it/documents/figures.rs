//! Figures in the README and the guide that stand in no example, against what the program finds.

use crate::accuracy::SURVEY;
use crate::common::*;

/// Asserts that a document has these words, wherever its lines are broken.
pub(crate) fn says(document: &str, words: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(document);
    let in_one_line = |text: &str| text.split_whitespace().collect_vec().join(" ");
    let text = in_one_line(&fs::read_to_string(path).unwrap());
    assert!(
        text.contains(&in_one_line(words)),
        "{document} does not say: {words}"
    );
}

/// Returns what stands in a document between a comment and the next `end`.
pub(crate) fn between(document: &str, comment: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(document);
    let text = fs::read_to_string(path).unwrap();
    let (_, after) = text.split_once(&format!("<!-- {comment} -->")).unwrap();
    after.split_once("<!-- end -->").unwrap().0.to_owned()
}

/// Returns a whole number with groups of three digits.
fn grouped(digits: &str) -> String {
    let groups = digits.as_bytes().rchunks(3).rev();
    let groups = groups.map(|g| std::str::from_utf8(g).unwrap());
    groups.collect_vec().join(",")
}

const MOBILITY: &str = "src/guide/mobility.md";
const CATALOG: &str = "src/guide/catalog.md";

/// How often each method is right, in the table of the guide and in the README.
#[test]
fn records_of_the_methods_are_those_of_the_survey() {
    let all = SURVEY.cases.len();
    let cell = |n: usize| if n > 0 { n.to_string() } else { String::new() };
    let row = |of: &str, right: usize, pose: usize, wrong: usize, silent: usize| {
        let cells = [right, pose, wrong, silent].map(cell).join(" | ");
        says(MOBILITY, &format!("| {of} | {cells} |"));
    };
    says(MOBILITY, &format!("any of {} methods", registry::ALL.len()));
    says(MOBILITY, &format!("Results for {all} cases:"));
    for (m, method) in registry::ALL.iter().enumerate() {
        let (about, record) = (method, SURVEY.record_of(m));
        let of = format!("`{}`: {}", about.name, about.title);
        let silent = all - record.applies;
        row(&of, record.right, record.pose, record.count_wrong(), silent);
    }
    let right = |name: &str| {
        let m = registry::ALL.iter().position(|m| m.name() == name).unwrap();
        SURVEY.record_of(m).right
    };
    assert_eq!(right("auto"), all);
    says(
        "README.md",
        &format!(
            "Counting formulas get {} of {all} published cases right, double precision {}, and the default method all",
            right("count"),
            right("lu")
        ),
    );
}

/// Sizes of the searches of the gripper.
#[test]
fn sizes_of_searches_are_those_of_the_searches() {
    let search = |more: &[&str]| {
        let args = [
            &["search", "gripper-10", "--count", "--format", "json"],
            more,
        ];
        run_json(&args.concat())
    };
    let size = |found: &Value| {
        let space = format!("{:.1e}", parse_count(&found["space"]) as f64);
        (space.replace('e', "·10^"), found["nodes"].to_string())
    };
    let (space, nodes) = size(&search(&[]));
    says(
        "README.md",
        &format!("{space} of them fold into diagrams of {nodes} nodes"),
    );
    let four = "revolute,cylindrical,universal,spherical";
    let (few, fewer) = size(&search(&["--options", four]));
    let with_four = format!("`search gripper-10 --count --options {four}`");
    for (document, what, space, nodes) in [
        (
            "src/guide/speed.md",
            "`search gripper-10 --count`",
            &space,
            &nodes,
        ),
        ("src/guide/speed.md", &*with_four, &few, &fewer),
    ] {
        says(document, &format!("| {what} | {space} | {nodes} |"));
    }
    let names = ["four-bar", "watt-six-bar", "scissor-lift-3", "gripper-10"];
    let of = |name: &&str| {
        let options = "revolute,cylindrical,spherical";
        run_json(&format!(
            "search {name} --count --options {options} --format json"
        ))
    };
    let found = names.each_ref().map(of);
    for (row, key) in [
        ("variants", "space"),
        ("without redundant constraints", "determinate"),
    ] {
        let counts = found.each_ref().map(|f| grouped(f[key].word()));
        says(
            "src/guide/beside.md",
            &format!("| {row} | {} |", counts.join(" | ")),
        );
    }
}

/// The gripper as built, redesigned by the paper, and redesigned here.
#[test]
fn redesigns_of_the_gripper_are_those_that_are_found() {
    let analysed =
        |name: &str| run_json(&["analyze", name, "--format", "json"])["states"][0].clone();
    let (built, paper) = (analysed("gripper-10"), analysed("gripper-10-redesign"));
    let figures = |state: &Value| format!("{} | {}", state["redundant"], state["mobility"]);
    says(
        "README.md",
        &format!("| as built | none | 0 | {} | none | yes |", figures(&built)),
    );
    let idle = paper["idle"].list().iter();
    let idle: Vec<&str> = idle.map(|x| x["links"][0].word()).collect();
    says(
        "README.md",
        &format!(
            "-> spherical | 12 | {} | {} | yes |",
            figures(&paper),
            idle.join(", ")
        ),
    );
    let found = run_json("search gripper-10 --distinct --top 1 --format json");
    let row = |found: &Value, sure: &str, same: &str| {
        let changes = found["changes"].list();
        let to = |kind: &str| {
            let those = changes.iter().filter(|c| c["to"] == kind);
            let joints: Vec<&str> = those.map(|c| c["joint"].word()).collect();
            format!("{} -> {kind}", joints.join(", "))
        };
        let changes = ["spherical", "cylindrical"].map(to).join("; ");
        let [cost, sigma, w] = ["cost", "redundant", "mobility"].map(|key| &found[key]);
        format!("| {changes} | {cost} | {sure}{sigma}{sure} | {sure}{w}{sure} | none | {same} |")
    };
    let symmetric = found["symmetric"].list().iter();
    let equal = symmetric.into_iter().find(|s| s["redundant"] == 1).unwrap();
    says("README.md", &row(equal, "", "yes"));
    says("README.md", &row(&found["variants"][0], "**", "no"));
}

/// How many schemes are known.
#[test]
fn as_many_schemes_are_known_as_the_documents_say() {
    let known = known_classics().len();
    says("README.md", &format!("{known} well-known schemes"));
    says(CATALOG, &format!("among {known} well-known schemes"));
    says(
        CATALOG,
        &format!("builds the {known} well-known schemes alone"),
    );
}

/// What friction takes of a swing, and that it does not do to feed just that.
#[test]
fn the_guide_has_the_energies_of_the_built_in_drive() {
    let found = run_json("drive torsion-module --format json");
    let energy = found["design"]["friction_energy"].real();
    says(
        "src/guide/drive.md",
        &format!("With the {energy:.4} J of (12)"),
    );
}
