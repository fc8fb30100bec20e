//! Mechanisms as a CAD system writes them, turned in space and rounded: the same redesigns as of the exact ones.

use super::digits::door;
use super::search_numeric::{small_request, turned_bare, without_options};
use crate::common::*;

fn read(text: &str) -> Mechanism {
    without_options(mechanism_from_str("it.toml", text).unwrap_or_else(|e| panic!("{text}: {e}")))
}

/// A wedge chuck: a draw bar along z, three jaws that slide out at 120°, each on a wedge of the bar; `number` writes so much of
/// an expression with its value.
fn wedge_chuck(number: &dyn Fn(&str, f64) -> String) -> String {
    let s = 0.75f64.sqrt();
    let radial = [
        [("1", 1.0), ("0", 0.0)],
        [("-1/2", -0.5), ("sqrt(3)/2", s)],
        [("-1/2", -0.5), ("-sqrt(3)/2", -s)],
    ];
    let mut joints = "bar | 0 bar | prismatic | 0, 0, 0 | 0, 0, 1\n".to_owned();
    for (i, way) in (1..).zip(radial) {
        let [x, y] = way.map(|(e, v)| number(e, v));
        let [px, py] = way.map(|(e, v)| number(&format!("40*({e})"), 40.0 * v));
        // Four up for one out.
        for (of, link, up) in [("g", "0", 0), ("w", "bar", 4)] {
            joints += &format!(
                "{of}{i} | {link} jaw{i} | prismatic | \"{px}\", \"{py}\", 10 | \"{x}\", \"{y}\", {up}\n"
            );
        }
    }
    write_mechanism("name = \"it\"", "0 bar jaw1 jaw2 jaw3*", &joints)
}

/// A tailgate: a lid on two hinges across the car, and a strut of two tubes on either side.
fn tailgate() -> String {
    write_mechanism(
        "name = \"it\"",
        "0 tube-l rod-l tube-r rod-r lid*",
        "
        hinge-l | 0 lid | revolute | 0, 480, 1400 | 0, 1, 0
        hinge-r | 0 lid | revolute | 0, -480, 1400 | 0, 1, 0
        foot-l | 0 tube-l | spherical | 180, 610, 1010 | 0, 0, 1
        strut-l | tube-l rod-l | cylindrical | 290, 600, 1130 | 110, -10, 120
        head-l | rod-l lid | spherical | 400, 590, 1250 | 0, 0, 1
        foot-r | 0 tube-r | spherical | 180, -610, 1010 | 0, 0, 1
        strut-r | tube-r rod-r | cylindrical | 290, -600, 1130 | 110, 10, 120
        head-r | rod-r lid | spherical | 400, -590, 1250 | 0, 0, 1
        ",
    )
}

fn search(m: &Mechanism, options: &[&str]) -> Outcome {
    let all = Request {
        list: List::All,
        options: options.iter().map(|&o| o.to_owned()).collect(),
        ..small_request()
    };
    ozols::search(m, &all).unwrap()
}

/// What each variant changes, and what it has then.
fn redesigns(o: &Outcome) -> BTreeSet<String> {
    let words = |v: ozols::Variant<'_>| {
        let text = v.to_string();
        let (_, changes) = text.split_once(": ").unwrap();
        format!("{changes}: W {}, sigma {}", v.mobility(), v.redundant())
    };
    o.variants().map(words).collect()
}

const HINGES: [&str; 3] = ["revolute", "cylindrical", "spherical"];
const SLIDES: [&str; 2] = ["prismatic", "cylindrical"];

/// Whether a file has the redesigns of the exact one; if not, it must have said that it is not exact.
fn same(exact: &Mechanism, file: &Mechanism, options: &[&str], what: &str) -> bool {
    let of = |m: &Mechanism| decide_state(m, StateId::FREE).unwrap();
    let (truth, is) = (of(exact), of(file));
    let w = truth.verdict.figures_at(truth.verdict.rank()).0;
    let [least, most] =
        [is.verdict.rank(), is.verdict.at_least()].map(|r| is.verdict.figures_at(r).0);
    assert!((least..=most).contains(&w), "{what}: {}", is.line);
    let finite = i64::try_from(truth.finite.mobility).unwrap();
    assert!(is.finite.could_be(finite), "{what}: {}", is.line);
    let (truth, found) = (search(exact, options), search(file, options));
    assert!(truth.is_exact(), "{what}");
    let counts = |o: &Outcome| (o.determinate.clone(), o.admissible.clone());
    let same = counts(&truth) == counts(&found) && redesigns(&truth) == redesigns(&found);
    assert!(same || !found.is_exact(), "{what}");
    same && found.is_exact()
}

/// How many of twice so many turned files have the redesigns of the exact one.
fn turned_at(exact: &Mechanism, options: &[&str], decimals: &[usize], what: &str) -> usize {
    let all = decimals
        .iter()
        .flat_map(|&d| (0..2).map(move |seed| (d, seed)));
    all.filter(|&(d, seed)| {
        let m = turned_bare(exact, d, &mut Noise::new(seed, d));
        same(
            exact,
            &m,
            options,
            &format!("{what}, {d} decimals, seed {seed}"),
        )
    })
    .count()
}

#[test]
fn a_wedge_chuck_with_slides_at_120_degrees_in_decimals_has_the_redesigns_of_the_exact_one() {
    let exact = read(&wedge_chuck(&|exact, _| exact.to_owned()));
    let w = decide_state(&exact, StateId::FREE).unwrap();
    // Seven slides, two directions a contour.
    assert_eq!(w.verdict.figures_at(w.verdict.rank()), (1, 12));
    for d in [3, 4, 6, 9, 12] {
        let m = read(&wedge_chuck(&|_, x| format!("{x:.d$}")));
        assert!(same(&exact, &m, &SLIDES, "chuck"), "{d} decimals");
    }
    assert!(turned_at(&exact, &SLIDES, &[4, 6, 9, 12, 15], "chuck") >= 9);
}

#[test]
fn a_double_wishbone_and_a_tailgate_have_the_redesigns_of_the_exact_ones() {
    let [wishbone, tailgate] = [double_wishbone(), tailgate()].map(|t| read(&t));
    assert!(turned_at(&wishbone, &HINGES, &[4, 6, 9], "wishbone") >= 5);
    assert!(turned_at(&tailgate, &HINGES, &[4, 6, 9], "tailgate") >= 5);
}

#[test]
fn a_turned_toggle_gripper_of_twelve_decimals_has_all_redesigns_at_rod_ends() {
    let text = builtin::text("gripper-slider-two-fingers").unwrap();
    assert_eq!(
        turned_at(&read(text), &HINGES, &[6, 12, 15], "toggle gripper"),
        6
    );
}

#[test]
fn one_oblique_axis_or_option_turns_no_file() {
    // Metres without decimals: half a unit would let points a metre apart be one.
    let oblique = "[0.7071067811865475, 0, -0.7071067811865475]";
    let hinges = |z| door(["[-3, 0, 0]", "[-2, 0, -1]"], ["[0, 0, 1]", z], "");
    let option = "[[joint.options]]\ntype = \"custom\"\nfreedoms = [\"rx\", \"ry\", \"rz\", \"tz\"]\naxis = OBLIQUE\n";
    for file in [
        hinges(oblique),
        hinges("[0, 0, 1]") + &option.replace("OBLIQUE", oblique),
    ] {
        let m = mechanism_from_str("door.toml", &file).unwrap();
        let half = uncertainties(&m).unwrap();
        assert!(half.frames.iter().all(|f| f.point == [0.0; 3]));
    }
}
