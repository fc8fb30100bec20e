use super::{Tally, layer_tables, terminal_tables, totals_by_key};
use crate::search::answer::keys::{Key, Steps};
use crate::search::diagram::redundancy_so_far::Redundancy;
use crate::search::diagram::{DEAD, Diagram, Layer};

/// Each layer has two nodes. One takes any choice within a cost of 1; the other takes only the dearest choice, without a
/// limit. The two have three keys, and no layer keeps others.
#[test]
fn under_bounds_only_the_keys_of_tables_are_carried_on() {
    let keys: Vec<Key> = (0..4).map(|k| Key::new(k.into(), k * k, k)).collect();
    let variables = 40;
    let two = |variable| Layer {
        variable,
        nodes: 2,
        choices: keys.len(),
        edges: vec![0, 0, 0, 0, DEAD, DEAD, DEAD, 1],
    };
    let layers = (0..variables).map(two).collect();
    let diagram = Diagram::from_layers(layers, vec![Redundancy::default(); 2]);
    let steps = Steps::of_keys(vec![keys.clone(); variables]);
    let (mut tables, mut numbers) = terminal_tables::<u128>(&diagram, &steps);
    for l in (0..variables).rev() {
        let bound = Some(&[1, u64::MAX][..]);
        let room = 1 << 20;
        (tables, numbers, _) =
            layer_tables(&diagram, &steps, l, bound, (&tables, &numbers), room).unwrap();
        let dearest = Key(keys[3].0 * (variables - l) as u128);
        assert_eq!(numbers.keys, [Key::default(), keys[1], dearest]);
        assert_eq!(numbers.places, [vec![0, 1], vec![2]]);
    }
    let counts: Vec<u128> = tables[0].iter().map(|(_, n)| *n).collect();
    assert_eq!(counts, [1, variables as u128]);
}

/// Three parts in a row, of two layers each, between which there is one node: their counts multiplied are those of the whole.
#[test]
fn parts_are_counted_as_the_whole_is() {
    let keys: Vec<Key> = (0..3).map(|k| Key::new(0, 2 * k, k)).collect();
    let variables = 6;
    let of = |variable: usize| match variable % 2 {
        0 => (1, vec![0, 1, 1]),
        _ => (2, vec![DEAD, 0, 0, 0, 0, DEAD]),
    };
    let layers = (0..variables).map(|variable| Layer {
        variable,
        nodes: of(variable).0,
        choices: keys.len(),
        edges: of(variable).1,
    });
    let end = Redundancy {
        internal: 3,
        ..Redundancy::default()
    };
    let diagram = Diagram::from_layers(layers.collect(), vec![end]);
    let steps = Steps::of_keys(vec![keys; variables]);
    let room = 1 << 20;
    let whole = Tally::<u128>::new(&diagram, &steps, None, room).unwrap();
    let parts = totals_by_key::<u128>(&diagram, &steps, room).unwrap();
    assert_eq!(parts, whole.total_counts());
    assert_eq!(parts.iter().map(|(_, n)| n).sum::<u128>(), 6u128.pow(3));
}
