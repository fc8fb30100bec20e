//! Budgets of nodes, memory and threads, and files that are too large: an honest stop or a message, never an abort.

use super::run_shell;
use crate::common::*;
use std::process::Command;

/// A file of links `0` to `n`, the last the output, and these joints between links, hinges along z at odd places.
fn file(n: usize, joints: &[(usize, usize)]) -> String {
    let head =
        "name = \"many\"\n[search]\noptions = [\"revolute\", \"cylindrical\", \"spherical\"]";
    let line = |(i, (a, b)): (usize, &(usize, usize))| {
        let (x, y) = (i * 37 % 101, i * i * 17 % 89);
        format!("j{i} | {a} {b} | revolute | {x}, {y}, 0 | 0, 0, 1")
    };
    let joints = joints.iter().enumerate().map(line).join("\n");
    write_mechanism(head, &((0..=n).join(" ") + "*"), &joints)
}

/// A ladder of contours that each share two links with the one before.
fn ladder(contours: usize) -> String {
    let mut joints = Vec::new();
    let (mut left, mut right, mut next) = (0, 0, 1);
    for _ in 0..contours {
        let (a, b) = (next, next + 1);
        joints.extend([(left, a), (right, b), (a, b)]);
        (left, right, next) = (a, b, next + 2);
    }
    file(next - 1, &joints)
}

fn found(text: &str, more: &[&str]) -> Value {
    let args = [&["search", "-", "--count", "--format", "json"], more].concat();
    let (code, told, said) = run_with_input(&args, text);
    assert!(matches!(code, Some(0 | 1)), "{said}");
    serde_json::from_str(&told).unwrap()
}

fn number(v: &Value) -> BigUint {
    v.word().parse().unwrap()
}

/// Once wrong: 3.8e40 with 1,000 nodes, and 2.3e36 with 100,000.
#[test]
fn a_larger_budget_never_gives_a_worse_bound() {
    let ladder = ladder(12);
    for budgets in [
        "--nodes=100 --nodes=700 --nodes=1000 --nodes=20000",
        "--memory=1M --memory=2M --memory=8M --memory=40M",
    ] {
        let mut before = [BigUint::ZERO, BigUint::ZERO];
        let mut stopped = false;
        for budget in split_words(budgets) {
            let v = found(&ladder, &[budget]);
            let now = [number(&v["determinate"]), number(&v["admissible"])];
            assert!(
                now >= before && now[1] >= before[1],
                "{budget}: {now:?} after {before:?}"
            );
            stopped |= v["exact"] == false;
            before = now;
        }
        assert!(stopped, "{budgets:?}: nothing was bounded");
    }
}

#[test]
fn what_finished_within_the_memory_stays_exact() {
    let whole = found(&ladder(7), &[]);
    assert_eq!(whole["stop"], "exhausted");
    assert_eq!(whole["exact"], true);
    let mut words = Vec::new();
    for memory in ["1M", "2M", "4M", "8M", "16M", "32M"] {
        let v = found(&ladder(7), &["--memory", memory]);
        let (all, some) = (number(&whole["determinate"]), number(&v["determinate"]));
        assert!(some <= all, "{memory}");
        assert_eq!(v["determinate_exact"] == true, some == all, "{memory}");
        words.push(v["stop"].word().to_owned());
    }
    assert!(words.contains(&"memory".to_owned()), "{words:?}");
}

/// Once an abort at 3 GB with one node.
#[cfg(target_os = "linux")]
#[test]
fn tallies_stay_within_the_memory() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("x.toml"), ladder(20)).unwrap();
    let line =
        "ulimit -v 1000000; exec ozols search x.toml --nodes 1 --count --threads 2 --format json";
    let o = run_shell(folder.path(), line);
    assert!(matches!(o.status.code(), Some(0 | 1)), "{o:?}");
    let v: Value = serde_json::from_slice(&o.stdout).unwrap();
    assert_eq!(v["exact"], false);
}

/// Once an abort: each thread had 64 MiB of addresses set aside, and with 200 MB of them there was little left for the search.
#[cfg(target_os = "linux")]
#[test]
fn scarce_addresses_end_no_search() {
    let folder = tempdir().unwrap();
    for contours in [8, 20] {
        fs::write(folder.path().join("x.toml"), ladder(contours)).unwrap();
        let line = "ulimit -v 200000; exec ozols search x.toml --count --check none --threads 4 --format json";
        let o = run_shell(folder.path(), line);
        assert!(matches!(o.status.code(), Some(0 | 1)), "{contours}: {o:?}");
    }
}

/// `ulimit` bounds what a search may hold by default: a quarter.
#[cfg(target_os = "linux")]
#[test]
fn limits_of_the_process_count() {
    for limit in ["-v 400000", "-d 400000"] {
        let line = format!("ulimit {limit}; exec ozols search four-bar --count");
        let said = utf8_text(&run_shell(Path::new("."), &line).stderr);
        let (_, allowed) = said.split_once('(').unwrap();
        let allowed: u32 = allowed.split(' ').next().unwrap().parse().unwrap();
        assert!((20..=98).contains(&allowed), "{limit}: {said}");
    }
}

/// Once read to their ends, 1.5 GB of them, by everything but mechanism files and robots.
#[cfg(target_os = "linux")]
#[test]
fn no_reader_reads_without_a_bound() {
    let folder = tempdir().unwrap();
    let huge = fs::File::create(folder.path().join("huge")).unwrap();
    huge.set_len(1_500_000_000).unwrap();
    for line in [
        "check huge",
        "lint huge",
        "lint robot.xml",
        "export robot.xml --to toml",
        "verify four-bar huge",
        "catalog build --spec huge -o x.db",
        "catalog query huge",
        "grip lever-gripper --motion huge",
        "search four-bar --costs huge",
        "fix robot.urdf --loops huge",
    ] {
        let _ = fs::remove_file(folder.path().join("robot.xml"));
        fs::hard_link(folder.path().join("huge"), folder.path().join("robot.xml")).unwrap();
        let o = run_shell(
            folder.path(),
            &format!("ulimit -v 1000000; ulimit -t 10; exec ozols {line} --quiet"),
        );
        let said = utf8_text(&o.stderr);
        assert_eq!(o.status.code(), Some(2), "{line}: {said}");
        assert!(
            !said.is_empty() && said.len() < 2000,
            "{line}: {} bytes",
            said.len()
        );
    }
    assert_eq!(huge.metadata().unwrap().len(), 1_500_000_000);
}

#[cfg(target_os = "linux")]
#[test]
fn a_search_says_how_much_memory_it_took_of_what_it_may() {
    let o = run("search four-bar --memory 300M");
    let said = utf8_text(&o.stderr);
    has(&said, " MiB of memory (300 MiB allowed)");
}

/// Once an abort: all of the sample was drawn before any of it was given.
#[test]
fn a_sample_of_any_size_is_given_one_by_one() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_ozols"))
        .args(["search", "four-bar", "--format", "csv", "--check", "none"])
        .args(["--sample", "1000000000000"])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let lines = BufReader::new(child.stdout.take().unwrap()).lines();
    assert_eq!(lines.take(5000).filter(Result::is_ok).count(), 5000);
    assert!(child.wait().unwrap().success());
}

#[test]
fn budgets_may_be_said_in_several_units() {
    let count = |most: &str| run(&format!("search four-bar --count --memory {most}")).stdout;
    assert_eq!(count("1.5G"), count("1536MiB"));
}

/// Once an abort at 4 GB.
#[test]
fn a_mechanism_too_entangled_is_refused_at_once() {
    let joints = vec![(0, 1); 3999];
    let (code, _, said) = run_with_input("analyze -", &file(1, &joints));
    assert_eq!(code, Some(2), "{said}");
    has(&said, "23988 rows and 3999 columns");
}

/// Once two minutes.
#[test]
fn a_long_open_chain_is_analysed_and_its_search_refused() {
    let joints: Vec<_> = (0..300).map(|i| (i, i + 1)).collect();
    let chain = file(300, &joints);
    let o = ozols("analyze - --format json")
        .write_stdin(chain.clone())
        .timeout(std::time::Duration::from_secs(60))
        .output()
        .unwrap();
    let v: Value = serde_json::from_slice(&o.stdout).unwrap();
    assert_eq!(v["states"][0]["mobility"], 300);
    let (code, _, said) = run_with_input("search -", &chain);
    assert_eq!(code, Some(2), "{said}");
    has(&said, "300 joints are in no contour");
}
