//! The rank modulo a prime next to FLINT, through python-flint.

use super::{Case, Function, best, cases, micro};
use ozols::linalg::echelon;
use ozols::linalg::modp::{Field, Residue};
use ozols::rank::exact::modular;
use std::fmt::Write as _;
use std::io::Write as _;
use std::process::{Command, Stdio};

/// Ranks by python-flint in a child process: (best seconds, rank) of each matrix, or why there are none.
fn flint(matrices: &[(u64, Vec<Vec<u64>>)]) -> Result<Vec<(f64, usize)>, String> {
    const SCRIPT: &str = "
import sys, time
import flint
for line in sys.stdin:
    p, r, c, *x = map(int, line.split())
    m = flint.nmod_mat(r, c, x, p)
    best = 1e9
    for _ in range(100):
        t = time.perf_counter()
        for _ in range(50):
            m.rank()
        best = min(best, (time.perf_counter() - t) / 50)
    print(best, m.rank())
";
    let python = std::env::var("OZOLS_PYTHON").unwrap_or_else(|_| "python3".into());
    let mut text = String::new();
    for (p, rows) in matrices {
        let _ = write!(
            text,
            "{p} {} {}",
            rows.len(),
            rows.first().map_or(0, Vec::len)
        );
        for x in rows.iter().flatten() {
            let _ = write!(text, " {x}");
        }
        text.push('\n');
    }
    let mut child = Command::new(&python)
        .args(["-c", SCRIPT])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .map_err(|e| format!("{python}: {e}"))?;
    // The pipe may close early where flint is missing; the exit status tells.
    let _ = child
        .stdin
        .take()
        .map(|mut pipe| pipe.write_all(text.as_bytes()));
    let out = child.wait_with_output().map_err(|e| e.to_string())?;
    if !out.status.success() {
        return Err(format!("{python} has no module flint"));
    }
    let parse = |line: &str| {
        let (t, rank) = line.split_once(' ')?;
        Some((t.parse().ok()?, rank.parse().ok()?))
    };
    let lines = String::from_utf8_lossy(&out.stdout).into_owned();
    lines
        .lines()
        .map(|l| parse(l).ok_or(format!("{python} said {l:?}")))
        .collect()
}

/// Numbers below `p`, always the same.
fn random(p: u64, rows: usize, columns: usize) -> Vec<Vec<u64>> {
    let mut state = 0x9e37_79b9_7f4a_7c15u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state % p
    };
    (0..rows)
        .map(|_| (0..columns).map(|_| next()).collect())
        .collect()
}

pub(super) fn against_flint() {
    println!(
        "\n== against FLINT's nmod_mat_rank: best times of one run, construction excluded on both sides =="
    );
    const MERSENNE_61: u64 = (1 << 61) - 1;
    const MERSENNE_31: u64 = (1 << 31) - 1;
    let case = Case::gripper();
    let big = Field::new(MERSENNE_61);
    let small = |x: &i128| x.rem_euclid(i128::from(MERSENNE_31)) as u64;
    let image = |c: &Vec<i128>| c.iter().map(small).collect();
    let written_out = |of: &Case| {
        let field = of.exact.field();
        let plain = |c: &Vec<Residue>| c.iter().map(|&x| field.to_u64(x)).collect();
        (field.modulus(), of.dense.iter().map(plain).collect())
    };
    let larger: Vec<Case> = cases(&[10, 50]).collect();
    let mut matrices: Vec<(u64, Vec<Vec<u64>>)> = vec![
        (MERSENNE_61, random(MERSENNE_61, 24, 30)),
        written_out(&case),
        (MERSENNE_31, case.whole.iter().map(image).collect()),
    ];
    matrices.extend(larger.iter().map(written_out));
    let to_field = |x: &u64| big.mul(big.from_i64(*x as i64), big.one());
    let dense: Vec<Vec<Residue>> = matrices[0]
        .1
        .iter()
        .map(|r| r.iter().map(to_field).collect())
        .collect();
    fn modular_rank(of: &Case) -> Function<'_> {
        Box::new(|| modular::rank_modulo(&of.exact, &of.closure))
    }
    // Each stands against FLINT's of the same place.
    let mut ours: Vec<(String, Function<'_>)> = vec![
        (
            "24 x 30 dense, 2^61 - 1: elimination".into(),
            Box::new(|| echelon::rank_of(big, dense.iter().map(Vec::as_slice))),
        ),
        (
            "gripper 24 x 14, same prime: modular".into(),
            modular_rank(&case),
        ),
        (
            "gripper 24 x 14, FLINT's 2^31 - 1: modular".into(),
            modular_rank(&case),
        ),
    ];
    ours.extend(larger.iter().map(|of| {
        let name = format!("{}: modular", of.name);
        (name, modular_rank(of))
    }));
    let before = flint(&matrices);
    let mine = best(&mut ours, 300);
    match (before, flint(&matrices)) {
        (Ok(a), Ok(b)) => {
            for (i, ((name, _), (t, rank))) in ours.iter().zip(mine).enumerate() {
                let theirs = a[i].0.min(b[i].0);
                let same = if rank == a[i].1 {
                    "same rank"
                } else {
                    "RANKS DIFFER"
                };
                println!(
                    "  {name:<58} {:>10}  FLINT {:>10}  ratio {:>5.1}  {same}",
                    micro(t),
                    micro(theirs),
                    theirs / t
                );
            }
        }
        (Err(e), _) | (_, Err(e)) => {
            println!(
                "  skipped: {e}; pip install python-flint, and name its python in OZOLS_PYTHON"
            );
            for ((name, _), (t, _)) in ours.iter().zip(mine) {
                println!("  {name:<58} {:>10}", micro(t));
            }
        }
    }
}
