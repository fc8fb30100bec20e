//! The rank of J by every method: on the ten-link gripper, on chains and grids up to 200 contours, and next to FLINT.
//!
//! `cargo bench --bench rank`; first come ratios, each of best times of one run in which the methods take turns, then
//! criterion's times. FLINT's part needs python-flint: `python3 -m venv V; V/bin/pip install python-flint`, then
//! `OZOLS_PYTHON=V/bin/python cargo bench --bench rank`. `cargo bench --bench rank -- NONE` prints the ratios only.

#![allow(
    clippy::print_stdout,
    missing_docs,
    reason = "a bench prints its ratios"
)]

#[path = "rank/flint.rs"]
mod flint;
#[path = "../tests/it/common/lattice.rs"]
mod lattice;

use self::flint::against_flint;
use self::lattice::LatticeKind;
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use itertools::Itertools;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{ToPrimitive, Zero};
use ozols::builtin;
use ozols::closure::Closure;
use ozols::file::text::mechanism_from_str;
use ozols::geom::exact::{ExactError, ExactField};
use ozols::geom::expr::Expr;
use ozols::geom::{Reals, Scalars};
use ozols::linalg::echelon;
use ozols::linalg::modp::Residue;
use ozols::model::mechanism::{Mechanism, StateId};
use ozols::rank::exact::modular;
use ozols::rank::numeric::{DEFAULT_TOLERANCE, Elimination};
use ozols::rank::reduce::sufficient_rows::{LeastRows, Motions};
use ozols::redundancy::analysis::{Method, analyse_states, exact_field};
use ozols_dense::{Format, Matrix, singular_values};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// A method, which finds a rank.
type Function<'a> = Box<dyn FnMut() -> usize + 'a>;
/// A method by name.
type Timed<'a> = (&'static str, Function<'a>);

/// Twice the geometry, in whole numbers: the mechanisms here have halves at most.
struct Doubled;

impl Scalars for Doubled {
    type Number = i128;

    fn eval(&self, expr: &Expr) -> Result<i128, ExactError> {
        let twice = expr.as_rational().expect("rational") * BigInt::from(2);
        assert!(twice.is_integer(), "a multiple of a half");
        Ok(twice.to_integer().to_i128().expect("small"))
    }
    fn add(&self, a: i128, b: i128) -> i128 {
        a + b
    }
    fn sub(&self, a: i128, b: i128) -> i128 {
        a - b
    }
    fn mul(&self, a: i128, b: i128) -> i128 {
        a * b
    }
}

/// J of a mechanism, in every form that a method starts from.
struct Case {
    name: String,
    exact: ExactField,
    closure: Closure<Residue>,
    dense: Vec<Vec<Residue>>,
    real: Closure<f64>,
    matrix: Matrix,
    whole: Vec<Vec<i128>>,
}

impl Case {
    fn new(name: String, m: &Mechanism) -> Case {
        let exact = exact_field(m, 0).expect("exact");
        let closure = Closure::new(&exact, m, StateId::FREE).expect("exact");
        let real = Closure::new(&Reals, m, StateId::FREE).expect("real");
        let columns = real.dense_columns(&Reals);
        let matrix = Matrix::from_fn(real.rows(), columns.len(), |r, c| columns[c][r]);
        let whole = Closure::new(&Doubled, m, StateId::FREE)
            .expect("whole")
            .dense_columns(&Doubled);
        Case {
            name: format!("{name}, {} x {}", real.rows(), columns.len()),
            dense: closure.dense_columns(&exact),
            exact,
            closure,
            real,
            matrix,
            whole,
        }
    }

    fn gripper() -> Case {
        let text = builtin::text("gripper-10").expect("built in");
        Case::new(
            "gripper-10".into(),
            &mechanism_from_str("gripper-10.toml", text).expect("valid"),
        )
    }

    /// The methods, by name, with the rank each finds. The last is too slow for large matrices.
    fn methods(&self) -> Vec<Timed<'_>> {
        let field = self.exact.field();
        let mut all: Vec<Timed<'_>> = vec![
            (
                "modular",
                Box::new(|| modular::rank_modulo(&self.exact, &self.closure)),
            ),
            (
                "modular, elimination alone",
                Box::new(move || echelon::rank_of(field, self.dense.iter().map(Vec::as_slice))),
            ),
            (
                "f64 singular values, scaled",
                Box::new(|| {
                    let found = Elimination::Svd.rank_of_closure(&self.real, DEFAULT_TOLERANCE);
                    found.map_or(0, |r| r.rank)
                }),
            ),
            (
                "f64 singular values",
                Box::new(|| above(&singular_values(&self.matrix).unwrap_or_default(), 1e-9)),
            ),
            (
                "f64 QR, pivoted",
                Box::new(|| above(&Format::Double.qr_diagonal(&self.matrix), 1e-9)),
            ),
            (
                "f64 LU, full pivots",
                Box::new(|| above(&Format::Double.lu_pivots(&self.matrix), 1e-9)),
            ),
            (
                "f32 QR, pivoted",
                Box::new(|| above(&Format::Single.qr_diagonal(&self.matrix), 1e-4)),
            ),
            (
                "f32 LU, full pivots",
                Box::new(|| above(&Format::Single.lu_pivots(&self.matrix), 1e-4)),
            ),
        ];
        if self.whole.len() <= 200 {
            all.push(("exact, Bareiss", Box::new(|| bareiss(&self.whole))));
        }
        all
    }
}

fn cases(sizes: &[usize]) -> impl Iterator<Item = Case> + '_ {
    let of = |k: usize| {
        LatticeKind::ALL.map(|kind| {
            Case::new(
                format!("{kind:?} {k}"),
                &lattice::lattice_mechanism(kind, k),
            )
        })
    };
    sizes.iter().flat_map(move |&k| of(k))
}

fn above(sizes: &[f64], tolerance: f64) -> usize {
    let least = sizes.iter().fold(0.0, |a: f64, &b| a.max(b)) * tolerance;
    sizes.iter().filter(|v| **v > least).count()
}

/// Elimination without fractions, Bareiss 1968.
fn bareiss(columns: &[Vec<i128>]) -> usize {
    let mut m: Vec<Vec<BigInt>> = columns
        .iter()
        .map(|c| c.iter().map(|&x| BigInt::from(x)).collect())
        .collect();
    let (mut rank, mut last) = (0, BigInt::from(1));
    for c in 0..m.first().map_or(0, Vec::len) {
        let Some(p) = (rank..m.len()).find(|&r| !m[r][c].is_zero()) else {
            continue;
        };
        m.swap(rank, p);
        let (above, below) = m.split_at_mut(rank + 1);
        let u = &above[rank];
        for v in below {
            let a = v[c].clone();
            for (x, y) in v.iter_mut().zip(u).skip(c) {
                *x = (&*x * &u[c] - &a * y).div_floor(&last);
            }
        }
        last = u[c].clone();
        rank += 1;
    }
    rank
}

/// Best time of one call in seconds, of several functions that take turns.
fn best<N>(methods: &mut [(N, Function<'_>)], rounds: usize) -> Vec<(f64, usize)> {
    let mut out = vec![(f64::INFINITY, 0); methods.len()];
    let calls: Vec<u32> = methods
        .iter_mut()
        .map(|(_, f)| {
            let start = Instant::now();
            black_box(f());
            (2e-4 / start.elapsed().as_secs_f64().max(1e-8)).ceil() as u32
        })
        .collect();
    for _ in 0..rounds {
        for (((_, f), out), &calls) in methods.iter_mut().zip(&mut out).zip(&calls) {
            let start = Instant::now();
            for _ in 0..calls {
                out.1 = black_box(f());
            }
            out.0 = out.0.min(start.elapsed().as_secs_f64() / f64::from(calls));
        }
    }
    out
}

fn micro(seconds: f64) -> String {
    format!("{:.2} µs", seconds * 1e6)
}

fn ratios() {
    println!("\n== time per rank, and against the modular rank; best of one run ==");
    for case in std::iter::once(Case::gripper()).chain(cases(&[10, 50])) {
        let rounds = if case.dense.len() > 60 { 3 } else { 200 };
        let mut methods = case.methods();
        let found = best(&mut methods, rounds);
        println!("{}", case.name);
        for ((name, _), (t, rank)) in methods.iter().zip(&found) {
            let ratio = t / found[0].0;
            println!("  {name:<30} {:>14}  {ratio:>10.1}  rank {rank}", micro(*t));
        }
    }
    println!("\n== growth: time of the modular rank, for each contour ==");
    for kind in LatticeKind::ALL {
        print!("{kind:?}");
        for k in [10, 25, 50, 100, 200, 400] {
            let m = lattice::lattice_mechanism(kind, k);
            let exact = exact_field(&m, 0).expect("exact");
            let closure = Closure::new(&exact, &m, StateId::FREE).expect("exact");
            let mut only: Vec<Timed<'_>> =
                vec![("", Box::new(|| modular::rank_modulo(&exact, &closure)))];
            let t = best(&mut only, 30)[0].0;
            let k = closure.contours.len();
            print!("  k = {k}: {}", micro(t / k as f64));
        }
        println!();
    }
}

/// The rows that are enough, over all states of the built-in mechanisms: how many, whether ranks are the same, and the time
/// with looking for them.
fn least_rows() {
    println!("\n== the rows that are enough, of the built-in mechanisms in all their states ==");
    let kinds = [
        "all rows",
        "those of a group",
        "those in a plane and out of it",
    ];
    let mut sums = kinds.map(|kind| (kind, 0, 0, 0, [0.0; 2], true));
    for name in builtin::names() {
        let text = builtin::text(name).expect("it is built in");
        let m = mechanism_from_str(name, text).expect("it is well");
        for state in m.state_ids() {
            let exact = exact_field(&m, 0).expect("exact");
            let closure = Closure::new(&exact, &m, state).expect("exact");
            let find = || LeastRows::new(&exact, &m, &closure).expect("exact");
            let found = find();
            let mut parts = found.blocks.iter().flat_map(|b| &b.parts);
            let apart = parts
                .clone()
                .any(|p| matches!(p.motions, Motions::InPlane(_)));
            let grouped = parts.any(|p| matches!(p.motions, Motions::Group(_)));
            let mut ways: [Timed<'_>; 2] = [
                ("all", Box::new(|| modular::rank_modulo(&exact, &closure))),
                ("least", Box::new(|| find().rank())),
            ];
            let times = best(&mut ways, 20);
            let sum = &mut sums[if apart { 2 } else { usize::from(grouped) }];
            (sum.1, sum.2, sum.3) = (sum.1 + 1, sum.2 + found.rows(), sum.3 + found.of);
            sum.4
                .iter_mut()
                .zip(&times)
                .for_each(|(sum, t)| *sum += t.0);
            sum.5 &= times[0].1 == times[1].1;
        }
    }
    for (kind, states, rows, of, [all, least], alike) in sums {
        let same = if alike { "same ranks" } else { "RANKS DIFFER" };
        let (all, least) = (micro(all), micro(least));
        println!(
            "{kind:<32} {states:>4} states, {rows:>5} of {of:>5} rows: {all} with all, {least} with finding them, {same}"
        );
    }
}

fn methods(c: &mut Criterion) {
    ratios();
    least_rows();
    against_flint();
    for case in std::iter::once(Case::gripper()).chain(cases(&[10, 50, 200])) {
        let mut group = c.benchmark_group(&case.name);
        for (name, mut f) in case.methods() {
            group.bench_function(BenchmarkId::from_parameter(name), |b| b.iter(&mut f));
        }
        group.finish();
    }
}

fn analysis(c: &mut Criterion) {
    let mut group = c.benchmark_group("whole analysis");
    for (kind, k) in LatticeKind::ALL.into_iter().cartesian_product([50, 200]) {
        let m = lattice::lattice_mechanism(kind, k);
        group.bench_function(format!("{kind:?} {k}"), |b| {
            b.iter(|| analyse_states(&m, &[StateId::FREE], Method::Modular))
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(700));
    targets = methods, analysis
}
criterion_main!(benches);
