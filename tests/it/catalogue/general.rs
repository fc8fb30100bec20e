//! Layouts that are called generic are in general position: none has fewer determinate variants than its chain and input have.

use super::{Drawn, each_structure, form_of, layout, out_of_plane, plain_spec, structure_row};
use crate::common::*;
use ozols::chains::Symmetry;

/// Every so many generic structures of eight links, laid out from a seed: the row counts what the twin counts at places of its own, and
/// what a search of the row's own file counts, which knows nothing of other layouts. Gives how many are off the whole millimetres.
fn are_in_general_position(every: usize, seed: u64) -> usize {
    let forms = [Input::Slide, Input::Turn].map(|input| form_of(input, Symmetry::Generic, false));
    let spec = Spec {
        seed,
        ..plain_spec(1)
    };
    let (mut n, mut seen, mut moved, mut twins) = (0, 0, 0, BTreeMap::new());
    each_structure(8, &forms, |_, s| {
        n += 1;
        if n % every != 0 {
            return;
        }
        let Ok(laid) = structure_row(&s, &spec).unwrap().laid else {
            return;
        };
        seen += 1;
        let said = (laid.variant_count(None), laid.variant_count(Some(1)));
        let told = format!("{}, seed {seed}", s.name());
        let own = ozols::from_toml(&laid.file).unwrap();
        let request = default_with(|r: &mut Request| r.list = List::Nothing);
        let alone = ozols::search(&own, &request).unwrap();
        assert_eq!(alone.determinate.total, said.0, "{told}");
        let [u, v] = s.structure.roles.input;
        let input = (u, v);
        let twin = twins
            .entry((s.structure.chain.clone(), input))
            .or_insert_with(|| BigUint::from(out_of_plane::determinate(&s.structure.chain, input)));
        assert_eq!(said.1, *twin, "{told}");
        // Where the search for places put them, but for less than half a millimetre.
        let found = layout(&s, &spec.layout_limits(), seed).unwrap();
        let own = Drawn::new(&s, laid.layout.clone());
        for (here, there) in own.at.iter().zip(&found.at) {
            assert_eq!((here.whole, there.fine), (there.whole, [0; 2]), "{told}");
            assert!(here.fine.iter().all(|x| x.abs() < 500), "{told}");
        }
        moved += usize::from(own.at != found.at);
    });
    assert!(seen > 0);
    moved
}

/// Of 2,712 layouts on whole millimetres 1,022 have fewer, so that all are moved off them.
#[test]
fn generic_layouts_have_all_variants_of_their_chain_and_input() {
    assert!(are_in_general_position(250, 1) > 0);
    are_in_general_position(500, fresh_seed());
}

/// `cargo test --release --test integration all_generic_layouts -- --ignored`
#[test]
#[ignore = "every layout of eight links, ten minutes"]
fn all_generic_layouts_have_all_variants_of_their_chain_and_input() {
    assert!(are_in_general_position(1, 1) > 0);
}
