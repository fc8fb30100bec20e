//! The rank modulo a prime next to FLINT, through python-flint.

use super::{Case, Timed, best, micro};
use ozols::linalg::echelon;
use ozols::linalg::lanes::{LaneMatrix, SmallField};
use ozols::linalg::modp::{Field, Residue};
use ozols::rank::modular;
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
    let small = [SmallField::GREATEST, SmallField::MERSENNE];
    let large = (1u64 << 61) - 1;
    let case = Case::gripper();
    let (field, big) = (case.exact.field(), Field::new(large));
    let small_image = |p: u32| -> Vec<Vec<u64>> {
        let modulus = i128::from(p);
        case.whole
            .iter()
            .map(|c| c.iter().map(|x| x.rem_euclid(modulus) as u64).collect())
            .collect()
    };
    let plain: Vec<Vec<u64>> = case
        .dense
        .iter()
        .map(|c| c.iter().map(|&x| field.to_u64(x)).collect())
        .collect();
    let dense = |p: u64| random(p, 24, 30);
    let matrices = [
        (u64::from(small[0]), dense(small[0].into())),
        (u64::from(small[1]), dense(small[1].into())),
        (large, dense(large)),
        (u64::from(small[0]), small_image(small[0])),
        (u64::from(small[1]), small_image(small[1])),
        (field.modulus(), plain),
    ];
    let lanes: Vec<LaneMatrix> = [0, 1, 3, 4]
        .map(|i| {
            let (p, m) = &matrices[i];
            LaneMatrix::from_fn(SmallField::new(*p as u32), m.len(), m[0].len(), |r, c| {
                m[r][c]
            })
        })
        .into();
    // Both small primes together are nearly as sure as one of 61 bits.
    let both = small.map(|p| {
        let (m, field) = (&matrices[2].1, SmallField::new(p));
        LaneMatrix::from_fn(field, 24, 30, |r, c| m[r][c] % field.modulus())
    });
    let to_field = |x: &u64| big.mul(big.from_i64(*x as i64), big.one());
    let dense_61: Vec<Vec<Residue>> = matrices[2]
        .1
        .iter()
        .map(|r| r.iter().map(to_field).collect())
        .collect();
    let lane = |i: usize| {
        let (m, mut scratch) = (&lanes[i], Vec::new());
        Box::new(move || m.rank_with(&mut scratch))
    };
    let two = |m: [&'_ LaneMatrix; 2]| {
        let (m, mut scratch) = (m.map(Clone::clone), Vec::new());
        Box::new(move || {
            m[0].rank_with(&mut scratch)
                .max(m[1].rank_with(&mut scratch))
        })
    };
    // (what ours is, which of FLINT's it stands against)
    let mut ours: Vec<Timed<'_>> = vec![
        ("24 x 30 dense, 28 bits: lanes", lane(0)),
        ("24 x 30 dense, 2^31 - 1: lanes", lane(1)),
        (
            "24 x 30 dense, 2^61 - 1: 28 and 31 bits in lanes",
            two([&both[0], &both[1]]),
        ),
        ("24 x 30 dense, 2^61 - 1: elimination by 61 bits", {
            Box::new(|| echelon::rank(big, dense_61.iter().map(Vec::as_slice)))
        }),
        ("gripper 24 x 14, 28 bits: lanes", lane(2)),
        ("gripper 24 x 14, 2^31 - 1: lanes", lane(3)),
        (
            "gripper 24 x 14, 61 bits: 28 and 31 bits in lanes",
            two([&lanes[2], &lanes[3]]),
        ),
        (
            "gripper 24 x 14, 61 bits: contour by contour, same prime",
            { Box::new(|| modular::rank(&case.exact, &case.closure)) },
        ),
        ("gripper 24 x 14, 2^31 - 1: contour by contour, 61 bits", {
            Box::new(|| modular::rank(&case.exact, &case.closure))
        }),
    ];
    let against = [0, 1, 2, 2, 3, 4, 5, 5, 4];
    let before = flint(&matrices);
    let mine = best(&mut ours, 300);
    match (before, flint(&matrices)) {
        (Ok(a), Ok(b)) => {
            for (((name, _), (t, rank)), i) in ours.iter().zip(mine).zip(against) {
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
