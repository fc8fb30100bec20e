//! What a search costs does not depend on how the file lists its links and joints.

use crate::common::*;
use toml_edit::{DocumentMut, Table};

/// The same mechanism with its tables of links and of joints in another order.
fn shuffled(text: &str, random: &mut ChaCha8Rng) -> String {
    let mut file: DocumentMut = text.parse().unwrap();
    for key in ["link", "joint"] {
        let tables = file[key].as_array_of_tables_mut().unwrap();
        let mut all: Vec<Table> = tables.iter().cloned().collect();
        let places: Vec<_> = all.iter().map(Table::position).collect();
        for i in (1..all.len()).rev() {
            all.swap(i, random.next_u32() as usize % (i + 1));
        }
        tables.clear();
        for (mut table, place) in all.into_iter().zip(places) {
            if let Some(place) = place {
                table.set_position(place);
            }
            tables.push(table);
        }
    }
    file.to_string()
}

/// Determinate and admissible variants, and the nodes of both diagrams; nothing where the search has no field.
fn searched(text: &str) -> Option<([String; 2], [usize; 2])> {
    let m = read(text);
    let search = Search::new(exact_field(&m, 0).ok()?, m, Conditions::default()).ok()?;
    let d = search.build_diagrams(Control::NONE);
    let counts = [
        search.count_variants(&d.determinate, false),
        search.count_variants(&d.admissible, true),
    ];
    let nodes = [d.determinate.nodes, d.admissible.nodes];
    Some((counts.map(|c| c.to_string()), nodes))
}

#[test]
fn nodes_do_not_depend_on_ten_other_orders() {
    for name in builtin::names() {
        let text = builtin::text(name).unwrap();
        let Some((counts, nodes)) = searched(text) else {
            continue;
        };
        for seed in 1..=10 {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let other = shuffled(text, &mut random);
            let (found, cost) = searched(&other).unwrap();
            assert_eq!(found, counts, "{name}, order {seed}");
            for (a, b) in cost.into_iter().zip(nodes) {
                let apart = 2 * a.max(b) <= 3 * a.min(b);
                assert!(
                    apart,
                    "{name}, order {seed}: {cost:?} nodes, {nodes:?} as listed"
                );
            }
        }
    }
}

/// Orders of the file's making needed up to 128,123 nodes.
#[test]
fn the_ten_link_gripper_needs_two_thousand_nodes() {
    let (_, nodes) = searched(builtin::text("gripper-10").unwrap()).unwrap();
    assert!(nodes.iter().sum::<usize>() < 2_000, "{nodes:?}");
}
