//! The report page: its data are those of `ozols search`, its symbols those of `ozols draw`, its bytes always the same.

use crate::common::*;
/// What stands between two texts.
fn between<'a>(text: &'a str, from: &str, to: &str) -> &'a str {
    let (_, rest) = text.split_once(from).unwrap();
    rest.split_once(to).unwrap().0
}

/// The data of a page.
fn data(page: &str) -> Value {
    let block = between(
        page,
        "<script type=\"application/json\" id=\"data\">",
        "</script>",
    );
    assert!(!block.contains('<'));
    serde_json::from_str(block).unwrap()
}

#[test]
fn the_data_are_those_of_the_search() {
    for name in ["gripper-10", "gripper-10-loaded"] {
        let page = data(&run_quiet(&format!("report {name} --top 40 --pool 2000")));
        let found = &page["search"];
        let list = run_json(&format!("search {name} --top 40 --pool 2000 --format json"));
        for (own, key) in [
            ("space", "space"),
            ("determinate", "determinate"),
            ("admissible", "lasting"),
        ] {
            assert_eq!(found[own], list[key], "{name} {key}");
        }
        let variants = list["variants"].list();
        assert_eq!(found["cost"].list().len(), 40);
        for (i, v) in variants.iter().enumerate() {
            for key in ["cost", "mobility", "redundant"] {
                assert_eq!(found[key][i], v[key], "{name} {i} {key}");
            }
            let near = |a: &Value, b: &Value| {
                let (a, b) = (a.real(), b.real());
                assert!((a - b).abs() <= 1e-4 * b.abs(), "{name} {i}: {a} {b}");
            };
            near(&found["conditioning"][i], &v["conditioning"]);
            let chosen: Vec<usize> = found["choices"][i]
                .list()
                .iter()
                .map(|x| usize::try_from(x.whole()).unwrap())
                .collect();
            let mut changes: Vec<(String, String, String)> = Vec::new();
            for pair in chosen.chunks(2) {
                let variable = &found["variables"][pair[0]];
                let joint = variable["joints"][0].whole();
                let id = &page["joints"][usize::try_from(joint).unwrap()]["id"];
                let name = |c: usize| variable["choices"][c]["names"][0].word().to_owned();
                changes.push((id.word().to_owned(), name(0), name(pair[1])));
            }
            let text = |c: &Value, key: &str| c[key].word().to_owned();
            let wanted = v["changes"].list().iter();
            let wanted: Vec<_> = wanted
                .map(|c| (text(c, "joint"), text(c, "from"), text(c, "to")))
                .collect();
            assert_eq!(changes, wanted, "{name} {i}");
            if name == "gripper-10-loaded" {
                let work = &found["workload"];
                near(&work["peak_moment"][i], &v["scores"]["peak-moment"]);
                near(&work["peak_force"][i], &v["scores"]["peak-force"]);
                near(&work["ranked"]["total"][i], &v["scores"]["total"]);
                // the joints' own shares, whose greatest is the score
                let shares = work["force_share"][i].list();
                let most = shares.iter().filter_map(Value::as_f64).fold(0.0, f64::max);
                near(&Value::from(most), &v["scores"]["peak-force"]);
            }
        }
    }
}

#[test]
fn the_first_list_is_that_of_the_ideas() {
    let page = data(&run_quiet("report gripper-10 --top 12"));
    let list = run_json("search gripper-10 --top 12 --distinct --format json");
    let ideas = list["variants"].list();
    assert_eq!(page["ideas"]["cost"].list().len(), 12);
    for (i, v) in ideas.iter().enumerate() {
        assert_eq!(page["ideas"]["cost"][i], v["cost"], "{i}");
        assert_eq!(page["ideas"]["adds"][i], v["idea"]["adds"], "{i}");
        let stands_for = &page["ideas"]["stands_for"][i];
        assert_eq!(stands_for, &v["idea"]["variants"], "{i}");
    }
    assert_eq!(page["search"]["stands_for"][0], Value::Null);
    let distinct = data(&run_quiet("report gripper-10 --top 12 --distinct"));
    assert_eq!(distinct["ideas"], Value::Null, "it is one list already");
    assert_eq!(distinct["search"]["adds"], page["ideas"]["adds"]);
}

#[test]
fn figures_of_further_states_are_those_of_the_variant_analysed() {
    let page = data(&run_quiet("report gripper-10 --top 3 --max-external 5"));
    let found = &page["search"];
    for i in 0..3 {
        let free = found["redundant"][i].as_i64().unwrap();
        let clamped = found["states"][0]["redundant"][i].as_i64().unwrap();
        assert_eq!(clamped - free, found["external"][i].as_i64().unwrap());
    }
}

#[test]
fn each_change_has_a_symbol() {
    for name in ["gripper-10", "gripper-10-planar", "bennett"] {
        let page = data(&run_quiet(&format!("report {name} --top 12 --pool 2000")));
        let (rows, scene) = (page["swaps"][0].list(), &page["scenes"][0]);
        assert_eq!(rows.len(), scene["swaps"].list().len(), "{name}");
        for chosen in page["search"]["choices"].list() {
            for pair in chosen.list().chunks(2) {
                let swaps = rows.iter().zip(scene["swaps"].list());
                let swaps = swaps.filter(|(r, _)| r[0] == pair[0] && r[1] == pair[1]);
                let mut joints = 0;
                for (row, swap) in swaps {
                    joints += 1;
                    let joint = usize::try_from(row[2].whole()).unwrap();
                    let place = usize::try_from(swap["joint"].whole()).unwrap();
                    assert_eq!(scene["joints"][place]["id"], page["joints"][joint]["id"]);
                    let symbol = usize::try_from(swap["symbol"].whole()).unwrap();
                    let parts = scene["symbols"][symbol].list();
                    assert!(parts.iter().any(|p| p["class"].word().contains("changed")));
                }
                assert!(joints > 0, "{name}: {pair:?}");
            }
        }
    }
}

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    for name in ["gripper-10-loaded", "bennett"] {
        let one = run_quiet(&["report", name, "--pool", "2000", "--threads", "1"]);
        assert_eq!(
            one,
            run_quiet(&["report", name, "--pool", "2000", "--threads", "2"])
        );
    }
}

#[test]
fn a_file_is_written_and_needs_nothing_else() {
    let folder = Folder::new();
    assert_eq!(folder.succeed("report gripper-10 -o r.html").0, "");
    let page = folder.text("r.html");
    assert!(page.starts_with("<!doctype html>") && page.ends_with("</html>\n"));
    assert!(page.contains("default-src 'none'"));
    assert!(!page.contains("{{"), "every part is filled in");
    for words in [
        "11 redundant constraints",
        "21,817,629 of 13,841,287,201 variants have σ = 0 and keep the motion of outputs and drives throughout the motion; \
         the cheapest changes 6 joints at cost 11.5.",
        "rank proven by a checked certificate",
        "ozols export gripper-10 --to sdf",
    ] {
        assert!(page.contains(words), "{words}");
    }
    for outside in ["src=", "href=\"http", "url(", "@import"] {
        assert!(!page.contains(outside), "{outside}");
    }
}

#[test]
fn pages_say_what_is_not_there() {
    let page = run_quiet("report slider-crank-determinate");
    assert!(page.contains("Statically determinate") && page.contains("Nothing needs changing"));
    let page = run_quiet("report tongs");
    assert!(page.contains("No joint has an option with more freedoms"));
    let page = run_quiet("report gripper-10 --max-changes 1");
    // Where nothing is found it names what finds something, as the search does.
    let next = run("search gripper-10 --max-changes 1");
    let next = utf8_text(&next.stdout);
    let steps = next
        .lines()
        .filter_map(|l| l.trim().strip_prefix("ozols search "));
    let steps = steps.collect_vec();
    assert!(steps.len() > 1, "{next}");
    for step in steps {
        has(&page, &format!("ozols report {step}"));
    }
}

#[test]
fn bad_questions_are_refused_and_leave_no_file() {
    assert_all_fail(
        "
        report no-such-mechanism -o refused.html | neither a file nor a built-in mechanism
        report gripper-10 --top 0 -o refused.html | --top must be from 1
        report gripper-10 --top 10001 -o refused.html | --top must be from 1 to 10000
        report gripper-10 --options glue -o refused.html | no joint
        report gripper-10 --state folded -o refused.html | it has: free, clamped
        report gripper-10 --format json -o refused.html | unexpected argument
        ",
    );
    assert!(!Path::new("refused.html").exists());
}
