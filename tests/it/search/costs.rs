//! Costs in a file of their own: printed, changed, taken, and refused where they are none.

use crate::common::*;

/// A folder with the table of costs, changed.
fn table(from: &str, to: &str) -> Folder {
    Folder::with(
        "costs.toml",
        replace_once(&run_quiet("show costs"), from, to),
    )
}

#[test]
fn the_table_that_is_printed_changes_nothing() {
    let folder = table("change = 1\n", "change = 1.0\n");
    let line = "search gripper-10 --format csv";
    let (with, _) = folder.succeed(&format!("{line} --costs costs.toml"));
    assert_eq!(with, run_quiet(line));
    lacks(&run_quiet("list"), "\n costs ");
}

#[test]
fn a_type_that_is_dear_is_chosen_no_more() {
    let folder = table("\nspherical = 2\n", "\nspherical = 90\n");
    let first = |more: &str| {
        folder.json(&format!("search gripper-10 --top 1 {more}"))["variants"][0].clone()
    };
    let has_ball = |v: &Value| v["changes"].to_string().contains("spherical");
    let (before, after) = (first(""), first("--costs costs.toml"));
    assert!(has_ball(&before) && !has_ball(&after));
    assert_ne!(before["cost"], after["cost"]);
    // the page says how it was made
    let (page, _) = folder.succeed("report four-bar --costs costs.toml");
    has(&page, "--costs costs.toml");
}

#[test]
fn the_costs_of_a_file_stand_where_the_table_says_nothing() {
    let own = run_quiet("show gripper-10") + "\n[search.costs]\nlink = 7\nspherical = 3\n";
    let folder = Folder::with("own.toml", own);
    folder.put("costs.toml", "spherical = 2\n");
    let cost = |more: &str| {
        let line = format!("search own.toml --options spherical --top 1 {more}");
        folder.json(&line)["variants"][0]["cost"].real()
    };
    let (with, without) = (cost("--costs costs.toml"), cost(""));
    assert!(with < without, "{with} {without}");
}

#[test]
fn what_is_no_cost_is_refused_with_its_line_and_a_remedy() {
    for [from, to, said] in read_cases::<3>(
        r#"
        spherical = 2\n | sphericle = 2\n | unknown cost "sphericle"
        spherical = 2\n | spherical = -2\n | cost -2 must be a finite number from 0 to 1e6
        spherical = 2\n | spherical = nan\n | cost NaN must be
        spherical = 2\n | spherical = "2"\n | each line is a name and a number
        spherical = 2\n | spherical 2\n | each line is a name and a number
"#,
    ) {
        let folder = table(from, to);
        let (code, _, err) = folder.run("search gripper-10 --costs costs.toml");
        assert_eq!(code, Some(2), "{to}");
        has(&split_words(&err).join(" "), said);
        has(
            &err,
            &place_of("costs.toml", &folder.text("costs.toml"), to.trim_end()),
        );
    }
    assert_fails(
        "search gripper-10 --costs no/such.toml",
        "`ozols show costs > no/such.toml` writes one",
    );
}

/// A joint that the file describes by its freedoms is a hinge with more of them: what it costs above a hinge does not depend on
/// what a hinge costs.
#[test]
fn a_custom_joint_costs_a_hinge_at_the_files_price_and_more() {
    let list = |price: &str| {
        let text = run_quiet("show four-bar");
        let (before, _) = text.split_once("[search]").unwrap();
        let options = r#"["revolute", { freedoms = ["rz", "rx", "ry"], name = "loose" }]"#;
        let text =
            format!("{before}[search]\noptions = {options}\n[search.costs]\nrevolute = {price}\n");
        let v = json_on("search", "m.toml", &text, "");
        let all = v["variants"].list().iter();
        all.map(|v| v["cost"].real()).collect_vec()
    };
    let default = list("1");
    assert!(!default.is_empty() && default.iter().all(|c| *c > 1.0));
    for price in ["0", "0.5", "7.25"] {
        assert_eq!(list(price), default, "{price}");
    }
}

/// Costs are whole steps of what all of them have in common; the price of harm is one of them.
#[test]
fn harm_costs_what_the_file_says_to_the_thousandth() {
    for (name, price) in [("tongs", 1730), ("tongs-pad", 1), ("tongs", 333)] {
        let mut m = built_in(name);
        m.edit().search.costs.harmful_milli = Some(price);
        let conditions = default_with(|c: &mut Conditions| {
            (c.state, c.max_redundant) = (Some(InState::holding(StateId::new(1))), 9)
        });
        let (s, diagrams) = searched(&m, conditions);
        let mut harms = 0;
        for v in s.cheapest_variants(&diagrams, 300) {
            let choices = s.space.variables.iter().zip(&v.choices);
            let chosen: i64 = choices.map(|(x, &c)| x.choices[c].cost_milli).sum();
            let harmful = i64::from(v.key.harmful());
            assert_eq!(
                s.steps.cost_in_milli(v.key.cost()),
                chosen + price * harmful,
                "{name}"
            );
            harms += harmful;
        }
        assert!(harms > 0 || name == "tongs-pad", "{name}");
    }
}

/// A changed joint costs what the new one costs above the present one, and the change; one in series its own cost, its link and a
/// change. Prices are the file's where it states them.
#[test]
fn choices_cost_what_the_formula_says() {
    let prices = [("revolute", 1500), ("spherical", 2250), ("universal", 4000)];
    let mut m = built_in("gripper-10");
    let mut costs = m.search.costs.clone();
    (costs.change_milli, costs.link_milli) = (Some(1300), Some(700));
    costs.by_type_milli = prices.map(|(name, p)| (name.to_owned(), p)).to_vec();
    m.edit().search.costs = costs;
    let mut options = m.joints.iter().flat_map(|j| &j.options);
    let ball = options.find(|o| o.name == "spherical").unwrap().clone();
    for j in m.edit().joints.iter_mut().filter(|j| !j.drive) {
        j.unloading = vec![ball.clone()];
    }
    let conditions = Conditions::default();
    let s = Search::new(exact_field(&m, 0).unwrap(), &m, conditions).unwrap();
    let mut seen = 0;
    for variable in &s.space.variables {
        let joint = &m.joints[variable.joints[0]];
        for choice in &variable.choices {
            let price = |o: &ozols::model::mechanism::JointOption| {
                let stated = prices.iter().find(|(name, _)| *name == o.joint_type.name());
                stated.map_or(o.joint_type.default_cost_milli(), |p| p.1)
            };
            let mut wanted = 0;
            if choice.option != 0 {
                wanted += price(&joint.options[choice.option]) - price(&joint.options[0]) + 1300;
            }
            if let Some(u) = choice.unloading {
                wanted += price(&joint.unloading[u]) + 700 + 1300;
            }
            assert_eq!(choice.cost_milli, wanted, "{} {choice:?}", joint.id);
            seen += 1;
        }
    }
    assert!(seen > 100, "{seen}");
}

/// Where what a file asks for its own joints makes changes pay, the cheapest variant costs less than nothing; a bound in
/// thousandths is the last whole step that is within it.
#[test]
fn bounds_are_whole_steps_above_the_cheapest() {
    let mut m = built_in("gripper-10");
    m.edit().search.costs.by_type_milli = vec![("revolute".to_owned(), 2000)];
    let s = Search::new(exact_field(&m, 0).unwrap(), &m, Conditions::default()).unwrap();
    // No change costs less than nothing.
    assert!(s.steps.base_milli == 0 && s.steps.unit_milli > 1);
    for step in [0, 1, 2, 17, 400] {
        let milli = s.steps.base_milli + i64::from(step) * s.steps.unit_milli;
        for within in [0, 1, s.steps.unit_milli - 1] {
            assert_eq!(
                s.steps.steps_above(milli + within),
                u64::try_from(step).unwrap()
            );
        }
        assert_eq!(s.steps.cost_in_milli(u64::try_from(step).unwrap()), milli);
    }
}

/// A present joint that is listed has the name and the price of the list, wherever it stands in it.
#[test]
fn present_joints_cost_what_the_list_says() {
    let hinge = "{ type = \"revolute\", name = \"stock\", cost = 0.25 }";
    let before = ["\"prismatic\"", "\"spherical\"", "\"cylindrical\""];
    let cost = |options: &str| {
        let text = replace_once(
            &run_quiet("show four-bar"),
            "options = [\"revolute\", \"cylindrical\", \"universal\", \"spherical\"]",
            &format!("options = [{options}]"),
        );
        let m = read(&text);
        let joint = &m.joints[1];
        assert_eq!(joint.options[0].name, "stock", "{options}");
        joint.options[0].cost_milli
    };
    for other in before {
        assert_eq!(cost(&format!("{hinge}, {other}")), Some(250));
        assert_eq!(cost(&format!("{other}, {hinge}")), Some(250), "{other}");
        assert_eq!(cost(&format!("{other}, \"universal\", {hinge}")), Some(250));
    }
}
