//! `ozols catalog build`, `query`, `show`, `export`, `merge` and `page` as commands.

use crate::common::*;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;

pub(super) fn at(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).display().to_string()
}

/// The rows of a question to a catalogue.
pub(super) fn rows(file: &str, sql: &str) -> Vec<Value> {
    json(&["catalog", "query", file, sql, "--format", "json"])
        .list()
        .clone()
}

/// The same as CSV, without the head.
pub(super) fn lines(file: &str, sql: &str) -> Vec<String> {
    let csv = ok(&["catalog", "query", file, sql, "--format", "csv"]);
    csv.lines().skip(1).map(str::to_owned).collect()
}

/// The free state of a file as it is analysed.
pub(super) fn free_state(file: &str) -> Value {
    json(&["analyze", file, "--format", "json"])["states"][0].clone()
}

/// What the script of a page is given.
pub(super) fn script_data(html: &str) -> Value {
    let (_, after) = html
        .split_once("<script id=\"data\" type=\"application/json\">")
        .unwrap();
    serde_json::from_str(after.split_once("</script>").unwrap().0).unwrap()
}

/// A list that stands in a page deflated, in base64.
pub(super) fn unpacked(list: &Value) -> Vec<Value> {
    let bytes = STANDARD.decode(list.as_str().unwrap()).unwrap();
    serde_json::from_reader(ZlibDecoder::new(&bytes[..])).unwrap()
}

/// The cards of a page.
pub(super) fn cards_of(html: &str) -> Vec<Value> {
    unpacked(&script_data(html)["cards"])
}

/// All that a catalogue holds, table by table, in order.
pub(super) fn whole(file: &str) -> String {
    [
        "structures ORDER BY id",
        "layouts ORDER BY structure",
        "strokes ORDER BY structure",
        "pairs ORDER BY structure",
        "classics ORDER BY structure, id",
        "drawn ORDER BY id",
        "counts ORDER BY structure, mobility, changes",
        "ideas ORDER BY structure, place",
    ]
    .map(|t| {
        let o = run(&[
            "catalog",
            "query",
            file,
            &format!("SELECT * FROM {t}"),
            "--format",
            "csv",
        ]);
        text(&o.stdout)
    })
    .join("\n")
}

/// Small enough for a test without optimisation: structures of six links that are symmetric, and their ideas.
const SMALL: [&str; 10] = [
    "catalog",
    "build",
    "--links",
    "4..6",
    "--symmetry",
    "mirror,half-turn",
    "--ideas",
    "3",
    "--quiet",
    "-o",
];

pub(super) fn small<'a>(file: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    SMALL
        .iter()
        .copied()
        .chain([file])
        .chain(more.iter().copied())
        .collect()
}

#[test]
fn it_is_queried_shown_exported_and_drawn() {
    let folder = tempdir().unwrap();
    let db = at(&folder, "g.db");
    let built = ok(&small(&db, &[]));
    assert!(built.contains("ozols catalog query"), "{built}");
    let list = ok(&["catalog", "query", &db]);
    let id = list
        .lines()
        .find(|l| l.contains("mirror"))
        .unwrap()
        .split_whitespace()
        .next()
        .unwrap();
    let shown = ok(&["catalog", "show", &db, &id[..6]]);
    assert!(
        shown.contains("W = 1, σ = 6; finite mobility 1, proven"),
        "{shown}"
    );
    let json: Value = serde_json::from_str(&ok(&["catalog", "show", &db, id, "--json"])).unwrap();
    assert_eq!(json["ideas"].as_array().unwrap().len(), 3);
    assert_eq!(json["layout"]["mobility"], 1);
    let svg = at(&folder, "g.svg");
    ok(&["catalog", "show", &db, id, "--svg", &svg]);
    let drawn = fs::read_to_string(&svg).unwrap();
    assert!(drawn.starts_with("<svg") && drawn.contains("tip-a") && drawn.contains("tip-b"));
    let toml = at(&folder, "g.toml");
    ok(&["catalog", "export", &db, id, "-o", &toml]);
    let analysed: Value =
        serde_json::from_str(&ok(&["analyze", &toml, "--format", "json"])).unwrap();
    assert_eq!(
        analysed["states"][0]["redundant"],
        json["layout"]["redundant"]
    );
    // Every idea carried out is determinate, and of mobility 1.
    for k in ["1", "2", "3"] {
        ok(&["catalog", "export", &db, id, "--idea", k, "-o", &toml]);
        let v: Value = serde_json::from_str(&ok(&["analyze", &toml, "--format", "json"])).unwrap();
        let free = &v["states"][0];
        assert_eq!(
            (free["mobility"].as_u64(), free["redundant"].as_u64()),
            (Some(1), Some(0)),
            "{k}"
        );
    }
    let page = at(&folder, "g.html");
    ok(&["catalog", "page", &db, "-o", &page]);
    let html = fs::read_to_string(&page).unwrap();
    assert!(html.contains("Content-Security-Policy") && !html.contains("http://localhost"));
    let cards = cards_of(&html);
    let card = cards.iter().find(|c| c["id"] == *id).unwrap();
    assert!(
        card["drawing"]["pins"].is_array() && card.get("ideas").is_none(),
        "{card}"
    );
    // Files and ideas stand apart, in the order of the cards.
    let data = script_data(&html);
    let chosen = unpacked(&data["chosen"][0]);
    let place = cards.iter().position(|c| c["id"] == *id).unwrap();
    assert_eq!(chosen[place]["ideas"].as_array().unwrap().len(), 3);
    assert!(
        chosen[place]["mechanism"]
            .as_str()
            .unwrap()
            .contains("[[joint]]")
    );
    let csv = ok(&[
        "catalog",
        "query",
        &db,
        "SELECT links, count(*) AS n FROM structures GROUP BY links",
        "--format",
        "csv",
    ]);
    assert!(csv.starts_with("links,n\n6,"), "{csv}");
    let nothing = run(&[
        "catalog",
        "query",
        &db,
        "SELECT id FROM structures WHERE links = 5",
    ]);
    assert_eq!(nothing.status.code(), Some(1));
}

#[test]
fn what_cannot_be_done_is_said() {
    let folder = tempdir().unwrap();
    let db = at(&folder, "g.db");
    ok(&["catalog", "build", "--links", "4", "--quiet", "-o", &db]);
    for (line, says) in [
        ("build --links 4 --ideas 2 -o DB", "ideas differs"),
        ("build --links 5 -o DB", "even number"),
        ("build --links 4..14 -o DB", "4 to 12"),
        ("build --links 8..4 -o DB", "not a range of even numbers"),
        ("build --input push -o DB", "none of slide, turn"),
        (
            "build --input turn --symmetry mirror -o DB",
            "a mirror image needs a slide",
        ),
        ("build --options glue -o DB", "cylindrical"),
        ("build --shard 3/2 -o DB", "write a part as"),
        ("show DB nothing", "no structure nothing"),
        ("show DB 4-", "the beginning of 2 structures"),
        ("merge DB -o DB", "one of the parts and the whole"),
        ("count --links 4..x", "\"x\" is not a number of links"),
        ("count --links 8..4", "give the smaller number first"),
    ] {
        let words = line
            .split(' ')
            .map(|w| if w == "DB" { db.as_str() } else { w });
        fails(
            &["catalog"].into_iter().chain(words).collect::<Vec<_>>(),
            says,
        );
    }
    fails(
        &["catalog", "query", &db, "SELECT nonsense"],
        "no such column",
    );
    fails(&["catalog", "query", &db, "DELETE FROM ideas"], "readonly");
    let other = at(&folder, "other.txt");
    fs::write(
        &other,
        "This is no database, though it is long enough to be looked at as one.".repeat(20),
    )
    .unwrap();
    fails(&["catalog", "query", &other], "is not a catalogue");
    fails(
        &format!("catalog build --links 4 -o {other}"),
        "is not a catalogue",
    );
    assert!(
        fs::read_to_string(&other)
            .unwrap()
            .starts_with("This is no database")
    );
    fails(
        &format!("catalog query {}", at(&folder, "missing.db")),
        "missing.db",
    );
    assert!(!Path::new(&at(&folder, "missing.db")).exists());
    let spec = at(&folder, "spec.toml");
    fs::write(&spec, "links = \"4\"\ncolour = \"red\"\n").unwrap();
    fails(
        &format!("catalog build --spec {spec} -o {}", at(&folder, "s.db")),
        "colour",
    );
    fs::write(&spec, "links = \"4\"\nideas = 2\ninputs = [\"slide\"]\n").unwrap();
    let told = ozols(&format!(
        "catalog build --spec {spec} -o {} --quiet",
        at(&folder, "s.db")
    ))
    .output()
    .unwrap();
    assert!(
        text(&told.stdout).contains("1 structures added"),
        "{}",
        text(&told.stdout)
    );
}

#[test]
fn drawn_mechanisms_stand_beside_the_structures() {
    let folder = tempdir().unwrap();
    let file = at(&folder, "all.db");
    // Wrong names alone: nothing is begun.
    fails(
        &format!("catalog search tong gripper-11 -o {file}"),
        "gripper-1",
    );
    assert!(!Path::new(&file).exists());
    fails(&["catalog", "search", "-o", &file], "--grippers");
    let drawn = [
        "catalog",
        "search",
        "gripper-10",
        "tongs",
        "--ideas",
        "2",
        "-o",
    ];
    let drawn = |to| -> Vec<&str> { drawn.into_iter().chain([to]).collect() };
    assert!(ok(&drawn(&file)).contains("2 mechanisms added"));
    assert!(ok(&drawn(&file)).contains("0 mechanisms added"));
    // The counts are those of `ozols search`.
    let sql = "SELECT links, joints, contours, input, mobility, redundant, finite, determinate, admissible, certainty, best_cost \
               FROM drawn WHERE name = 'gripper-10'";
    let row = ok(&["catalog", "query", &file, sql, "--format", "csv"]);
    let found = row.lines().nth(1).unwrap();
    assert_eq!(
        found,
        "10,13,4,,1,11,\"1, proven\",6340592477,7150020,exact,11.5"
    );
    // It takes in structures, and is taken in.
    let parts = at(&folder, "parts.db");
    ok(&small(&parts, &[]));
    let merged = at(&folder, "merged.db");
    assert!(ok(&["catalog", "merge", &file, &parts, "-o", &merged]).contains("drawn"));
    ok(&small(&file, &[]));
    for table in ["drawn", "structures", "ideas"] {
        let sql = format!("SELECT * FROM {table}");
        let of = |db: &str| ok(&["catalog", "query", db, &sql, "--format", "csv"]);
        assert_eq!(of(&merged), of(&file), "{table}");
    }
    let best = ok(&["catalog", "query", &merged]);
    assert!(best.contains("tongs") && best.contains("mirror"), "{best}");
    let told = ok(&["catalog", "show", &merged, "gripper-10"]);
    assert!(
        told.contains("6,340,592,477") && told.contains("--idea 1"),
        "{told}"
    );
    let redesign = at(&folder, "redesign.toml");
    ok(&format!(
        "catalog export {merged} gripper-10 --idea 1 -o {redesign}"
    ));
    let analysed = ok(&["analyze", &redesign, "--format", "json"]);
    let analysed: Value = serde_json::from_str(&analysed).unwrap();
    assert_eq!(analysed["states"][0]["redundant"], 0, "{analysed}");
    let page = at(&folder, "page.html");
    ok(&["catalog", "page", &merged, "-o", &page]);
    let cards = cards_of(&fs::read_to_string(&page).unwrap());
    assert!(cards.iter().any(|c| c["name"] == "tongs"));
}

/// Balls alone make no four-bar determinate, which needs a slide along its hinges: one in series with a hinge, on a link of its
/// own.
#[test]
fn unloading_joints_are_on_the_menu() {
    let folder = tempdir().unwrap();
    let count = |name: &str, more: &[&str]| -> (String, u64) {
        let file = at(&folder, name);
        let line = "catalog build --links 4 --input turn --options spherical --quiet --ideas 9 -o";
        let words: Vec<&str> = line.split(' ').chain([file.as_str()]).collect();
        ok(&[&words[..], more].concat());
        let sql = "SELECT determinate_w1 FROM layouts";
        let csv = ok(&["catalog", "query", &file, sql, "--format", "csv"]);
        (file, csv.lines().nth(1).unwrap().parse().unwrap())
    };
    assert_eq!(count("plain.db", &[]).1, 0);
    let (file, more) = count("more.db", &["--unloading", "prismatic"]);
    assert!(more > 0);
    let sql = "SELECT structure, place FROM ideas";
    let with = ok(&["catalog", "query", &file, sql, "--format", "csv"]);
    let (id, place) = with.lines().nth(1).unwrap().split_once(',').unwrap();
    let toml = at(&folder, "v.toml");
    ok(&["catalog", "export", &file, id, "--idea", place, "-o", &toml]);
    let said: Value = serde_json::from_str(&ok(&["analyze", &toml, "--format", "json"])).unwrap();
    let free = &said["states"][0];
    assert_eq!(
        (&free["mobility"], &free["redundant"]),
        (&1.into(), &0.into())
    );
    assert_eq!(free["links"], 5);
}

/// The specification that comes with the program has what it says: mirror images of up to eight links, and seven that move as grippers.
#[test]
fn the_specification_of_mirror_images_is_built() {
    let folder = tempdir().unwrap();
    let db = at(&folder, "mirror.db");
    let spec = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/catalogs/specifications/mirror.toml"
    );
    ok(&["catalog", "build", "--spec", spec, "-o", &db, "--quiet"]);
    let counts = "SELECT count(*), sum(no_layout IS NULL), max(links) FROM structures";
    let counts = ok(&["catalog", "query", &db, counts, "--format", "csv"]);
    assert_eq!(counts.lines().nth(1), Some("60,7,8"));
}
