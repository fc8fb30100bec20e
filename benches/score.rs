//! How fast variants of the ten-link gripper are scored under a workload: figures for the documentation of `score`.
#![allow(missing_docs, reason = "criterion's macros")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use ozols::builtin;
use ozols::file::text::mechanism_from_str;
use ozols::model::mechanism::Mechanism;
use ozols::model::ranking::ClearanceSum;
use ozols::redundancy::analysis::exact_field;
use ozols::score::evaluation::elimination::Scratch;
use ozols::score::evaluation::evaluate::Evaluator;
use ozols::search::Search;
use ozols::search::answer::k_best::Assignment;
use ozols::search::diagram::Control;
use ozols::search::question::conditions::Conditions;
use rayon::prelude::*;
use std::hint::black_box;

/// Variants scored a round.
const POOL: usize = 20_000;

fn gripper() -> Mechanism {
    let text = builtin::text("gripper-10-loaded").expect("built in");
    mechanism_from_str("gripper-10-loaded.toml", text).expect("valid")
}

fn pool(search: &Search, n: usize) -> Vec<Assignment> {
    let diagrams = search.build_diagrams(Control::NONE);
    let out: Vec<_> = search.cheapest_variants(&diagrams, n).collect();
    out
}

fn scoring(c: &mut Criterion) {
    let m = gripper();
    let exact = exact_field(&m, 0).expect("exact");
    let search = Search::new(exact, &m, Conditions::default()).expect("valid");
    let variants = pool(&search, POOL);
    let evaluator = Evaluator::new(&search, ClearanceSum::Worst).expect("solved");
    let mut group = c.benchmark_group("scores of gripper-10 variants under its workload");
    group.throughput(Throughput::Elements(variants.len() as u64));
    group.sample_size(10);
    for threads in [1, 2] {
        let workers = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let workers = workers.build().expect("threads");
        group.bench_function(format!("all terms, {threads} threads"), |b| {
            b.iter(|| {
                workers.install(|| {
                    variants
                        .par_iter()
                        .map_init(Scratch::default, |s, v| {
                            evaluator.score_variant(v, s).is_ok()
                        })
                        .filter(|ok| *ok)
                        .count()
                })
            })
        });
    }
    group.throughput(Throughput::Elements(100));
    group.bench_function("by realizing each and singular values, one thread", |b| {
        b.iter(|| {
            variants[..100]
                .iter()
                .filter(|v| black_box(evaluator.reference_scores(v)).is_ok())
                .count()
        })
    });
    group.finish();
}

criterion_group!(benches, scoring);
criterion_main!(benches);
