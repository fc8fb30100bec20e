//! Where the time goes: one candidate, the diagram against brute force, big spaces, and the k best.
//!
//! `cargo bench --bench search`; node counts are printed beside the times.

#![allow(
    clippy::print_stdout,
    missing_docs,
    reason = "a bench reports node counts beside its times"
)]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use ozols::builtin;
use ozols::closure::Closure;
use ozols::file::text::mechanism_from_str;
use ozols::geom::Reals;
use ozols::model::joint_type::{Freedom, JointType};
use ozols::model::mechanism::{JointOption, Mechanism, StateId};
use ozols::rank::exact::modular;
use ozols::rank::numeric::{DEFAULT_TOLERANCE, Elimination};
use ozols::redundancy::analysis::exact_field;
use ozols::search::Search;
use ozols::search::check::brute::every_variant;
use ozols::search::diagram::Control;
use ozols::search::question::conditions::Conditions;
use std::hint::black_box;
use std::time::Duration;

fn gripper() -> Mechanism {
    let text = builtin::text("gripper-10").expect("built in");
    mechanism_from_str("gripper-10.toml", text).expect("valid")
}

/// The gripper with these options only, at the first `joints` joints that have any.
fn with_options(names: &[&str], joints: usize) -> Mechanism {
    let mut m = gripper();
    let mut parts = m.edit();
    let changeable = parts.joints.iter_mut().filter(|j| j.options.len() > 1);
    for (i, j) in changeable.enumerate() {
        let mut place = 0;
        j.options.retain(|o| {
            place += 1;
            place == 1 || i < joints && names.contains(&o.name.as_str())
        });
    }
    drop(parts);
    m
}

fn search(m: &Mechanism) -> Search {
    Search::new(exact_field(m, 0).expect("exact"), m, Conditions::default()).expect("valid")
}

/// Both counts and the `top` best; returns nodes and the largest layer.
fn whole(m: &Mechanism, top: usize) -> (usize, usize) {
    counted(&search(m), top)
}

/// The same of a search.
fn counted(s: &Search, top: usize) -> (usize, usize) {
    let d = s.build_diagrams(Control::NONE);
    black_box((
        s.count_variants(&d.determinate, false),
        s.count_variants(&d.admissible, true),
    ));
    s.cheapest_variants(&d, top).for_each(|v| {
        black_box(v);
    });
    let largest = d.determinate.largest_layer.max(d.admissible.largest_layer);
    (d.determinate.nodes + d.admissible.nodes, largest)
}

fn rank(c: &mut Criterion) {
    let m = gripper();
    let exact = exact_field(&m, 0).expect("exact");
    let closure = Closure::new(&exact, &m, StateId::FREE).expect("exact");
    let real = Closure::new(&Reals, &m, StateId::FREE).expect("real");
    let mut group = c.benchmark_group("rank of one candidate, 24 x 14");
    group.bench_function("modulo a prime", |b| {
        b.iter(|| modular::rank_modulo(&exact, black_box(&closure)))
    });
    group.bench_function("singular values", |b| {
        b.iter(|| Elimination::Svd.rank_of_closure(black_box(&real), DEFAULT_TOLERANCE))
    });
    group.finish();
}

fn twins(c: &mut Criterion) {
    let rs = with_options(&["spherical"], 12);
    let rcus = with_options(&["cylindrical", "universal", "spherical"], 12);
    // The same four options at 6 of the 12 joints: 1 / 4096 of the space, so brute force of the whole takes 4096 times
    // as long.
    let part = with_options(&["cylindrical", "universal", "spherical"], 6);
    let mut group = c.benchmark_group("diagram against brute force");
    group.bench_function("R S, 4096 variants, diagram", |b| b.iter(|| whole(&rs, 0)));
    group.bench_function("R S, 4096 variants, brute force", |b| {
        b.iter(|| every_variant(&search(&rs)))
    });
    group.bench_function("R C U S, 16777216 variants, diagram", |b| {
        b.iter(|| whole(&rcus, 0))
    });
    group.bench_function("R C U S, 4096 of 16777216 variants, brute force", |b| {
        b.iter(|| every_variant(&search(&part)))
    });
    group.finish();
}

fn spaces(c: &mut Criterion) {
    let seven = gripper();
    let mut thirteen = with_options(&[], 0);
    // Every way of adding up to two of five freedoms to the revolute joint, less the four commonest triples.
    let more = [
        Freedom::Rx,
        Freedom::Ry,
        Freedom::Tx,
        Freedom::Ty,
        Freedom::Tz,
    ];
    let mut sets: Vec<Vec<Freedom>> = more.iter().map(|&f| vec![Freedom::Rz, f]).collect();
    for i in 0..more.len() {
        sets.extend(more[i + 1..].iter().map(|&g| vec![Freedom::Rz, more[i], g]));
    }
    sets.truncate(12);
    for j in thirteen
        .edit()
        .joints
        .iter_mut()
        .filter(|j| j.joint_type == JointType::Revolute)
    {
        for set in &sets {
            let name: Vec<&str> = set.iter().map(|f| f.name()).collect();
            let (name, joint_type) = (name.join("+"), JointType::Custom(set.clone()));
            j.options.push(JointOption {
                name,
                joint_type,
                frame: j.frame.clone(),
                cost_milli: None,
                state: None,
            });
        }
    }
    let mut group = c.benchmark_group("gripper-10");
    for (name, m) in [("7 options", &seven), ("13 options", &thirteen)] {
        println!(
            "{name}: {} variants, (nodes, largest layer) = {:?}",
            search(m).size(),
            whole(m, 100)
        );
        group.bench_function(BenchmarkId::new("counts and 100 best", name), |b| {
            b.iter(|| whole(m, 100))
        });
        // The diagrams alone.
        let s = search(m);
        let orders = s.variable_orders();
        group.bench_function(BenchmarkId::new("diagrams", name), |b| {
            b.iter(|| s.build_in(&orders, Control::NONE))
        });
    }
    group.finish();
    let mut group = c.benchmark_group("k best of 7 options");
    for k in [100, 10_000, 1_000_000] {
        group.bench_function(BenchmarkId::from_parameter(k), |b| {
            b.iter(|| whole(&seven, k))
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1500));
    targets = rank, twins, spaces
}
criterion_main!(benches);
