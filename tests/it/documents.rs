//! The README and the guide say what the program says.
//!
//! Every line `$ ozols ...` in a block marked `console` is run in a fresh folder per document, in order; what it prints
//! on standard output, or on standard error where it prints nothing else, must be what follows it there, `...` standing for
//! lines left out and `[..]` for part of a line. A block marked with a name, as `xml NAME`, is a file in that folder.
//! Figures that stand elsewhere are held against the program by [`figures`].

use crate::common::*;
pub(crate) mod figures;

use crate::robots::assemblies::make;
use assert_cmd::Command;
use snapbox::Assert;
use snapbox::assert::Action;

/// A command and the output written beneath it.
struct Example {
    line: usize,
    command: String,
    output: String,
}

fn examples(text: &str) -> Vec<Example> {
    let (mut found, mut inside): (Vec<Example>, bool) = (Vec::new(), false);
    for (n, line) in text.lines().enumerate() {
        if let Some(fence) = line.strip_prefix("```") {
            inside = fence == "console";
        } else if let (true, Some(command)) = (inside, line.strip_prefix("$ ")) {
            found.push(Example {
                line: n + 1,
                command: command.to_owned(),
                output: String::new(),
            });
        } else if let (true, Some(example)) = (inside, found.last_mut()) {
            example.output += line;
            example.output.push('\n');
        }
    }
    found
}

/// Names and texts of the files that a document shows.
fn files(text: &str) -> Vec<(&str, &str)> {
    let blocks = text.split("\n```").skip(1).step_by(2);
    let named = blocks.filter_map(|b| {
        let (fence, body) = b.split_once('\n')?;
        Some((fence.split_once(' ')?.1, body))
    });
    named.collect()
}

/// Runs the examples of a document; how many there are, and what went otherwise than written.
fn run(document: &str) -> (usize, Vec<String>) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(root.join(document)).unwrap();
    let folder = tempdir().unwrap();
    for (name, body) in files(&text) {
        fs::write(folder.path().join(name), body).unwrap();
    }
    // FreeCAD's documents are archives, which no block can show.
    if text.contains("four-bar.FCStd") {
        let made = make::fcstd(&make::four_bar(make::HINGES));
        fs::write(folder.path().join("four-bar.FCStd"), made).unwrap();
    }
    let found = examples(&text);
    let mut wrong = Vec::new();
    for example in &found {
        let mut words = example.command.split_whitespace();
        assert_eq!(words.next(), Some("ozols"), "{document}:{}", example.line);
        let output = Command::cargo_bin("ozols")
            .unwrap()
            .current_dir(folder.path())
            .args(words)
            .output()
            .unwrap();
        let place = format!("{document}:{}: {}", example.line, example.command);
        // 1 says that lint found something.
        if !matches!(output.status.code(), Some(0 | 1)) {
            let complaints = String::from_utf8_lossy(&output.stderr);
            wrong.push(format!("{place}\n{complaints}"));
            continue;
        }
        let said = if output.stdout.is_empty() {
            output.stderr
        } else {
            output.stdout
        };
        let compared = Assert::new().action(Action::Verify).try_eq(
            Some(&place),
            String::from_utf8(said).unwrap().into(),
            example.output.clone().into(),
        );
        wrong.extend(compared.err().map(|e| format!("{place}\n{e}")));
    }
    (found.len(), wrong)
}

fn check(documents: &[String]) {
    let (mut ran, mut wrong) = (0, Vec::new());
    for document in documents {
        let (count, otherwise) = run(document);
        ran += count;
        wrong.extend(otherwise);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
    assert!(ran > 0, "no examples in {documents:?}");
}

#[test]
fn the_readme_says_what_the_program_says() {
    check(&["README.md".to_owned()]);
}

/// The lines of the blocks without a word at their fence.
fn plain_commands(text: &str) -> Vec<&str> {
    let blocks = text.split("```").skip(1).step_by(2);
    let plain = blocks.filter(|block| block.starts_with('\n'));
    plain.flat_map(|block| block.trim().lines()).collect()
}

/// Every command of the README but those that install it, in their order, in a folder with nothing but a robot.
#[test]
fn the_commands_of_the_readme_run() {
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let text = fs::read_to_string(readme).unwrap();
    let folder = tempdir().unwrap();
    let robot = crate::common::run("export four-bar --to urdf").stdout;
    fs::write(folder.path().join("robot.urdf"), robot).unwrap();
    let mut ran = Vec::new();
    for line in plain_commands(&text) {
        let command = line.split('#').next().unwrap().trim();
        let words = command.strip_prefix("cargo run --release -- ");
        let words = words.or(command.strip_prefix("ozols ")).expect(line);
        let mut program = std::process::Command::new(env!("CARGO_BIN_EXE_ozols"));
        program.args(split_words(words)).current_dir(folder.path());
        if words.starts_with("studio") {
            let studio = program.arg("--no-open").stdout(Stdio::piped()).spawn();
            let mut studio = studio.unwrap();
            let mut address = String::new();
            let mut said = BufReader::new(studio.stdout.take().unwrap());
            said.read_line(&mut address).unwrap();
            assert!(address.starts_with("http://127.0.0.1:"), "{address}");
            studio.kill().unwrap();
            studio.wait().unwrap();
        } else {
            let done = program.output().unwrap();
            // 1 says that lint found something.
            let code = done.status.code();
            let found = i32::from(words.starts_with("lint"));
            assert_eq!(code, Some(found), "{line}: {}", utf8_text(&done.stderr));
        }
        ran.push(words);
    }
    assert_eq!(ran.len(), 11, "{ran:?}");
    for file in ["gripper.toml", "report.html", "fixed.urdf", "known.html"] {
        assert!(folder.path().join(file).is_file(), "{file}");
    }
}

#[test]
fn the_guide_says_what_the_program_says() {
    let guide = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/guide");
    let mut chapters: Vec<String> = fs::read_dir(guide)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".md"))
        .map(|name| format!("src/guide/{name}"))
        .collect();
    chapters.sort();
    check(&chapters);
}

#[test]
fn the_pictures_are_what_the_program_draws() {
    let pictures: [(&str, &[&str]); 2] = [
        (
            "gripper-10.svg",
            &[
                "draw",
                "gripper-10",
                "--motion",
                "--stroke=-1:1:20",
                "--self-stress",
                "1",
            ],
        ),
        (
            "gripper-10-moving.svg",
            &[
                "draw",
                "gripper-10",
                "--idea",
                "1",
                "--motion",
                "--stroke=-1:1:20",
            ],
        ),
    ];
    for (name, command) in pictures {
        let path = Path::new("src/guide").join(name);
        let output = Command::cargo_bin("ozols")
            .unwrap()
            .args(command)
            .output()
            .unwrap();
        let committed = fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join(&path)).unwrap();
        assert!(
            output.stdout == committed,
            "{name} is out of date: .ci/pictures makes it"
        );
    }
}

/// The chapter on the search names six files with their main functions. They exist, and are short enough to be read.
#[test]
fn the_search_is_explained_in_six_files() {
    let guide = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/guide");
    let chapter = fs::read_to_string(guide.join("structure.md")).unwrap();
    let (_, section) = chapter.split_once("\n## How the search works").unwrap();
    let section = section.split("\n## ").next().unwrap();
    let files = section.split("](../kernel/search/").skip(1);
    let (mut lines, mut named) = (0, 0);
    for (n, after) in files.enumerate() {
        assert!(n < 6);
        let (file, words) = after.split_once(')').unwrap();
        let path = guide.join("../kernel/search").join(file);
        let code = fs::read_to_string(&path).unwrap();
        lines += code.lines().count();
        // Up to the next entry, or to the end of the list.
        let words = words.split("\n\n").next().unwrap();
        let words = words.split("[`").next().unwrap();
        for name in words.split('`').skip(1).step_by(2) {
            let name = name.rsplit("::").next().unwrap();
            assert!(code.contains(&format!("fn {name}")), "{file}: {name}");
            named += 1;
        }
    }
    assert!(lines <= 1_500, "{lines}");
    assert!(named >= 12, "{named}");
}
