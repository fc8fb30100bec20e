//! `ozols catalog build`, `query`, `show`, `export`, `merge` and `page` as commands.

use crate::common::*;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;

pub(super) fn path_in(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).display().to_string()
}

/// Returns the rows of a query to a catalogue.
pub(super) fn query_rows(file: &str, sql: &str) -> Vec<Value> {
    run_json(&["catalog", "query", file, sql, "--format", "json"])
        .list()
        .clone()
}

/// Returns the lines of a query as CSV, without the header.
pub(super) fn query_lines(file: &str, sql: &str) -> Vec<String> {
    let csv = stdout_of(&["catalog", "query", file, sql, "--format", "csv"]);
    csv.lines().skip(1).map(str::to_owned).collect()
}

/// Returns the analysis of the free state of a file.
pub(super) fn free_state(file: &str) -> Value {
    run_json(&["analyze", file, "--format", "json"])["states"][0].clone()
}

/// Returns the data of the script of a page.
pub(super) fn script_data(html: &str) -> Value {
    let (_, after) = html
        .split_once("<script id=\"data\" type=\"application/json\">")
        .unwrap();
    serde_json::from_str(after.split_once("</script>").unwrap().0).unwrap()
}

/// Returns a list that a page holds as deflated data in base64.
pub(super) fn unpack_list(list: &Value) -> Vec<Value> {
    let bytes = STANDARD.decode(list.as_str().unwrap()).unwrap();
    serde_json::from_reader(ZlibDecoder::new(&bytes[..])).unwrap()
}

/// Returns the cards of a page.
pub(super) fn cards_of(html: &str) -> Vec<Value> {
    unpack_list(&script_data(html)["cards"])
}

/// Returns the contents of a catalogue, table by table.
pub(super) fn dump_catalogue(file: &str) -> String {
    [
        "structures ORDER BY id",
        "layouts ORDER BY structure",
        "strokes ORDER BY structure",
        "pairs ORDER BY structure",
        "classics ORDER BY structure, id",
        "counts ORDER BY structure, mobility, changes",
        "ideas ORDER BY structure, place",
    ]
    .map(|t| {
        // A table without rows is nothing found.
        let sql = format!("SELECT * FROM {t}");
        utf8_text(&run(&["catalog", "query", file, &sql, "--format", "csv"]).stdout)
    })
    .join("\n")
}

/// Small enough for a test without optimisation: structures of six links that are symmetric, and their ideas.
pub(super) fn small_build(file: &str, more: &str) -> String {
    format!(
        "catalog build --links 4..6 --symmetry mirror,half-turn --ideas 3 --quiet -o {file} {more}"
    )
}

#[test]
fn it_is_queried_shown_exported_and_drawn() {
    let folder = Folder::new();
    let done = |line: &str| folder.succeed(&format!("catalog {line}")).0;
    let free = || folder.json("analyze g.toml")["states"][0].clone();
    let ask = |sql: &str| folder.run(&["catalog", "query", "g.db", sql, "--format", "csv"]);
    let built = folder.succeed(&small_build("g.db", "")).0;
    has(&built, "ozols catalog query");
    let list = done("query g.db");
    let line = list.lines().find(|l| l.contains("mirror")).unwrap();
    let id = split_words(line)[0];
    let shown = done(&format!("show g.db {}", &id[..6]));
    has(&shown, "W = 1, σ = 6; finite mobility 1, proven");
    let told: Value = serde_json::from_str(&done(&format!("show g.db {id} --json"))).unwrap();
    assert_eq!(told["ideas"].list().len(), 3);
    assert_eq!(told["layout"]["mobility"], 1);
    done(&format!("show g.db {id} --svg g.svg"));
    has_all(&folder.text("g.svg"), &["<svg", "tip-a", "tip-b"]);
    done(&format!("export g.db {id} -o g.toml"));
    assert_eq!(free()["redundant"], told["layout"]["redundant"]);
    // Every idea carried out is determinate, and of mobility 1.
    for k in 1..=3 {
        done(&format!("export g.db {id} --idea {k} -o g.toml"));
        assert_eq!([&free()["mobility"], &free()["redundant"]], [1, 0], "{k}");
    }
    done("page g.db -o g.html");
    let html = folder.text("g.html");
    has(&html, "Content-Security-Policy");
    lacks(&html, "http://localhost");
    let cards = cards_of(&html);
    let place = cards.iter().position(|c| c["id"] == *id).unwrap();
    let card = &cards[place];
    assert!(card["drawing"]["pins"].is_array() && card.get("ideas").is_none());
    // Files and ideas stand apart, in the order of the cards.
    let chosen = &unpack_list(&script_data(&html)["chosen"][0])[place];
    assert_eq!(chosen["ideas"].list().len(), 3);
    has(chosen["mechanism"].word(), "[[joint]]");
    let (_, csv, _) = ask("SELECT links, count(*) AS n FROM structures GROUP BY links");
    assert!(csv.starts_with("links,n\n6,"), "{csv}");
    let (code, ..) = ask("SELECT id FROM structures WHERE links = 5");
    assert_eq!(code, Some(1));
}

#[test]
fn what_cannot_be_done_is_said() {
    let text = "This is no database, though it is long enough to be looked at as one.".repeat(20);
    let folder = Folder::with("other.txt", &text);
    folder.put("spec.toml", "links = \"4\"\ncolour = \"red\"\n");
    folder.succeed("catalog build --links 4 --quiet -o g.db");
    for [line, says] in read_cases::<2>(
        "
        build --links 4 --ideas 2 -o g.db | ideas differs
        build --links 5 -o g.db | even number
        build --links 4..14 -o g.db | 4 to 12
        build --links 8..4 -o g.db | not a range of even numbers
        build --input push -o g.db | none of slide, turn
        build --input turn --symmetry mirror -o g.db | a mirror image needs a slide
        build --options glue -o g.db | cylindrical
        build --shard 3/2 -o g.db | write a part as
        build --aim strong -o g.db | none of balanced, force
        build --pulled-out 0.5 -o g.db | pulled_out
        build --efficiency 1.5 -o g.db | efficiency
        build --transmission 91 -o g.db | transmission
        build --pin-distance=-1 -o g.db | pin_distance
        build --least-force=-1 -o g.db | least_force
        build --widths 50 -o g.db | such as 0..50
        build --grip above -o g.db | none of outside, inside
        build --room 9 -o g.db | such as 180x120
        build --symmetry threefold --jaws 4 -o g.db | jaws must be from 2 to 3
        build --links 8 --symmetry threefold --jaws 2 -o g.db | no layout is asked for
        build --spec spec.toml -o s.db | colour
        build --links 4 -o other.txt | is not a catalogue
        show g.db nothing | no structure nothing
        show g.db 4- | the beginning of 2 structures
        merge g.db -o g.db | one of the parts and the whole
        query other.txt | is not a catalogue
        query missing.db | makes a catalogue
        count --links 4..x | \"x\" is not a number of links
        count --links 8..4 | give the smaller number first
        count --links 9..6 | smaller number
        count --links many | 4..10
        count --mobility 0 | --mobility
        chains --links 16 | catalog count --links 16
        chains --links 7 | mobility 1
        count --pairs hinge | slide, gear, slot
        count --pairs slide --mobility 2 | one motion
        count --pairs slide --links 4..12 | 10 links
        count --links 3 | --pairs
        count --at-most 2 | --pairs
        ",
    ) {
        folder.assert_fails(&format!("catalog {line}"), says);
    }
    for (sql, says) in [
        ("SELECT nonsense", "no such column"),
        ("DELETE FROM ideas", "readonly"),
    ] {
        folder.assert_fails(&["catalog", "query", "g.db", sql], says);
    }
    assert_eq!(folder.text("other.txt"), text);
    assert!(!folder.path("missing.db").exists());
    let spec = "links = \"4\"\nideas = 2\ninputs = [\"slide\"]\n";
    folder.put("spec.toml", spec);
    let (told, _) = folder.succeed("catalog build --spec spec.toml -o s.db --quiet");
    has(&told, "1 structures added");
}

/// Balls alone make no four-bar determinate, which needs a slide along its hinges: one in series with a hinge, on a link of its
/// own.
#[test]
fn unloading_joints_are_on_the_menu() {
    let folder = tempdir().unwrap();
    let count = |name: &str, more: &str| -> (String, u64) {
        let file = path_in(&folder, name);
        let words = "catalog build --links 4 --input turn --options spherical --quiet --ideas 9 -o";
        stdout_of(&format!("{words} {file} {more}"));
        let count = query_lines(&file, "SELECT determinate_w1 FROM layouts")[0].parse();
        (file, count.unwrap())
    };
    assert_eq!(count("plain.db", "").1, 0);
    let (file, more) = count("more.db", "--unloading prismatic");
    assert!(more > 0);
    let with = &query_lines(&file, "SELECT structure, place FROM ideas")[0];
    let (id, place) = with.split_once(',').unwrap();
    let toml = path_in(&folder, "v.toml");
    stdout_of(&format!(
        "catalog export {file} {id} --idea {place} -o {toml}"
    ));
    let free = free_state(&toml);
    let found = ["mobility", "redundant", "links"].map(|key| &free[key]);
    assert_eq!(found, [1, 0, 5]);
}

/// The specification that comes with the program has what it says: mirror images of up to eight links, and seven that move as grippers.
#[test]
fn the_specification_of_mirror_images_is_built() {
    let folder = tempdir().unwrap();
    let db = path_in(&folder, "mirror.db");
    let spec = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/catalogs/specifications/mirror.toml"
    );
    stdout_of(&["catalog", "build", "--spec", spec, "-o", &db, "--quiet"]);
    let counts = "SELECT count(*), sum(no_layout IS NULL), max(links) FROM structures";
    assert_eq!(query_lines(&db, counts), ["60,7,8"]);
}
