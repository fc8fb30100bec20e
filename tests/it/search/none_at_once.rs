//! Where a count of freedoms in a plane leaves too few, nothing is built, and what easing would leave is not sought for long.

use crate::common::*;
use num_traits::Zero;
use ozols::score::request::Method;
use ozols::score::run::run;
use ozols::search::answer::why_none::{Relaxation, find_obstacles, find_relaxations};

/// Plates in a plane, in rows and columns, each on hinges with its neighbours at places drawn from a seed; and how many
/// hinges there are.
fn mesh(rows: usize, columns: usize, seed: u64) -> (String, usize) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut joints = Vec::new();
    for (r, c) in (0..rows).flat_map(|r| (0..columns).map(move |c| (r, c))) {
        let here = r * columns + c;
        let right = (c + 1 < columns).then_some(here + 1);
        let below = (r + 1 < rows).then_some(here + columns);
        for there in [right, below].into_iter().flatten() {
            let [x, y] = [(); 2].map(|()| random.next_u64() % 997);
            let j = joints.len();
            joints.push(format!(
                "j{j} | {here} {there} | revolute | {x}, {y}, 0 | 0, 0, 1"
            ));
        }
    }
    let head = "name = \"mesh\"\n[search]\noptions = [\"revolute\", \"cylindrical\", \"universal\", \"spherical\"]";
    let links = (0..rows * columns).join(" ") + "*";
    (
        write_mechanism(head, &links, &joints.join("\n")),
        joints.len(),
    )
}

/// Tilts and slides along the hinges do nothing in the plane, where 2·joints constraints meet 3 freedoms a moving plate.
#[test]
fn what_the_plane_decides_takes_no_step() {
    for (rows, columns) in [(3, 4), (4, 4), (4, 5)] {
        let (text, joints) = mesh(rows, columns, fresh_seed());
        let short = 2 * joints - 3 * (rows * columns - 1);
        let m = read(&text);
        let search = Search::new(exact_field(&m, 0).unwrap(), m, Conditions::default()).unwrap();
        let asked = AtomicUsize::new(0);
        let count = || {
            asked.fetch_add(1, Ordering::Relaxed);
            false
        };
        let control = Control {
            cancelled: &count,
            progress: &|p| panic!("built {p:?}"),
        };
        let found = search.build_diagrams(control);
        assert_eq!(found.stop_reason(), Stop::Exhausted);
        for d in [&found.determinate, &found.admissible] {
            assert!(search.count_variants(d, false).total.is_zero());
        }
        assert_eq!(asked.load(Ordering::Relaxed), 0, "{text}");
        assert_eq!(
            find_obstacles(&search).unwrap().least_redundant,
            Some(short),
            "{text}"
        );
        let eased = find_relaxations(&search, 0, &count).unwrap();
        // What takes too many nodes with few redundant constraints takes more with many: it is tried once.
        assert!(asked.load(Ordering::Relaxed) < 12 * joints, "{text}");
        let few = |r: &Relaxation| matches!(r, Relaxation::Redundant(n) if *n as usize >= short);
        assert!(eased.iter().all(|(r, _)| few(r)), "{eased:?}");
    }
}

/// What would help is found on the diagram, also if the search itself looks at every variant.
#[test]
fn brute_force_does_not_look_at_every_wider_variant() {
    let of = |method| {
        let request = Request {
            method,
            options: vec!["revolute".to_owned()],
            ..Request::default()
        };
        let lift = ozols::built_in("scissor-lift-3").unwrap();
        let outcome = run(lift, &request, &|| false, &mut |_| {}).unwrap();
        assert!(outcome.listed_counts().total.is_zero());
        let wider = outcome.would_help().expect("more types help");
        (wider.options, format!("{:?}", wider.allow))
    };
    assert_eq!(of(Method::Brute), of(Method::Diagram));
}
