//! Searches of a clamped state: what is held, what harms, what relieves, and what is said where nothing is found.

use crate::common::*;
mod mirrored;
mod relieved;

/// The ten-link gripper that offers nothing but a ball pivot at each pad and four options of its hinges.
pub(crate) fn gripper_with_pads() -> String {
    let text = builtin::text("gripper-10").unwrap();
    let lines = text.lines().filter(|l| !l.contains("name = \"cross\""));
    let text = lines.collect_vec().join("\n");
    let text = replace_once(&text, "    \"universal\",\n", "");
    let text = replace_once(
        &text,
        "    { type = \"universal\", reference = [0, 1, 0], name = \"universal-y\" },\n",
        "",
    );
    replace_once(&text, "    \"cylindrical-universal\",\n", "")
}

/// Output, as data, of a search that may find nothing.
pub(crate) fn run_search<L: Line + ?Sized>(path: &str, more: &L) -> Value {
    Folder::new().json(&[&["search", path, "-q"][..], &more.words()].concat())
}

/// Returns what a command says that is refused.
fn refused(args: &[&str]) -> String {
    let (code, told, said) = run_full(args);
    assert_eq!((code, &*told), (Some(2), ""), "{args:?}");
    said
}

/// Between two ball pivots the part turns about the line through their centres: no redundant constraint, and no grip.
#[test]
fn a_part_that_spins_between_two_pads_is_not_held() {
    let (_folder, path) = write_temporary("m.toml", gripper_with_pads());
    let zero = ["--max-external", "0", "--count"];
    assert_eq!(parse_count(&run_search(path, &zero)["admissible"]), 0);
    let loose = [&zero[..], &["--allow-loose-object"]].concat();
    assert!(parse_count(&run_search(path, &loose)["admissible"]) > 0);
    // Every one of them has both pads, and none with one pad is lost.
    let list = run_search(path, "--max-external 0 --allow-loose-object --top 20");
    for v in list["variants"].list() {
        let changes = v["changes"].list();
        for pad in ["4-a", "a-8"] {
            assert!(changes.iter().any(|c| c["joint"] == pad), "{v}");
        }
    }
    let one = ["--max-external", "2", "--forbid", "4-a", "--count"];
    let without = [&one[..], &["--allow-loose-object"]].concat();
    assert!(parse_count(&run_search(path, "--max-external 2 --count")["admissible"]) > 0);
    assert!(
        parse_count(&run_search(path, &without)["admissible"])
            > parse_count(&run_search(path, &one)["admissible"])
    );
}

/// The part is no link of the free mechanism; with one pad it is held all the same.
#[test]
fn an_object_is_held_by_name() {
    let (_folder, path) = write_temporary("m.toml", gripper_with_pads());
    let count_of = |more: &[&str]| {
        let args = [&["--max-external", "2", "--count"][..], more].concat();
        parse_count(&run_search(path, &args)["admissible"])
    };
    let held = count_of(&[]);
    assert!(held > 0);
    assert_eq!(count_of(&["--hold", "a"]), held);
    assert_eq!(count_of(&["--hold", "a", "--allow-loose-object"]), held);
    assert!(count_of(&["--allow-loose-object"]) > held);
    let hold = ["search", path, "--hold", "a"];
    assert_fails(&hold, "link a");
    assert_fails(&hold, "exists in state clamped only; search state clamped");
}

/// [Pogrebnyak 2018]: of the five external constraints three are friction that both jaws supply and two demand parallel
/// faces; with the pad two are left, and they only share the load.
#[test]
fn harmful_constraints_are_counted() {
    let present = split_words("--max-redundant 11 --max-changes 1 --state clamped");
    let allowed = ["--options", "revolute", "--top", "20"];
    let v = run_search("gripper-10", &[&present[..], &allowed].concat());
    let list = v["variants"].list();
    let of = |joint: Option<&str>| {
        list.iter()
            .find(|v| match (v["changes"].list().as_slice(), joint) {
                ([], None) => true,
                ([one], Some(j)) => one["joint"] == j,
                _ => false,
            })
            .unwrap()
    };
    let own = of(None);
    assert_eq!(
        [&own["external_redundant"], &own["external_harmful"]],
        [5, 2]
    );
    for pad in ["4-a", "a-8"] {
        let v = of(Some(pad));
        assert_eq!(v["external_redundant"], 2, "{v}");
        assert_eq!(v["external_harmful"], 0, "{v}");
    }
    // The same count as that of the analysis of the variant.
    let few = ["--max-harmful", "0", "--top", "3"];
    let found = run_json(&[&["search", "gripper-10", "--format", "json"][..], &few].concat());
    for v in found["variants"].list() {
        assert_eq!(v["external_harmful"], 0);
    }
    let without = parse_count(&run_search("gripper-10", "--state clamped --count")["admissible"]);
    assert!(parse_count(&found["admissible"]) < without);
}

/// A price on harm puts variants with a pad first, and a ranking may count it.
#[test]
fn harm_has_a_price_and_a_term() {
    let question = "--state clamped --top 1";
    let first = |path: &str| run_search(path, question)["variants"][0].clone();
    let (_folder, path) = write_temporary("m.toml", gripper_with_pads());
    assert_eq!(first(path)["external_harmful"], 2);
    let priced = replace_once(
        &gripper_with_pads(),
        "[search]\n",
        "[search]\ncosts = { harmful = 3 }\n",
    );
    let (_priced, priced) = write_temporary("m.toml", &priced);
    let v = first(priced);
    assert_eq!(v["external_harmful"], 0, "{v}");
    // Two harmful ones at 3 each cost more than a pad at 4.
    assert_eq!(v["cost"].real() - 4.0, first(path)["cost"].real());
    let ranked = "--rank harmful,cost=0.01 --options revolute,sphere-in-cylinder";
    let v = run_search("gripper-10-loaded", &format!("{question} {ranked}"));
    assert_eq!(v["variants"][0]["scores"]["harmful"], 0, "{v}");
    let rank = "search gripper-10-loaded --rank harmful";
    assert_fails(rank, "search a state, such as clamped");
}
