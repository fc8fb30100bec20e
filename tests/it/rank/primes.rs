//! Coordinates that hold large primes as factors are no zeros: a four-bar with one hinge tilted by such a number.

use crate::common::*;

/// The two smallest primes above 2^61 that are 1 modulo 4, which every search took once.
const FIRST: [u64; 2] = [2_305_843_009_213_693_973, 2_305_843_009_213_694_009];

fn tilted(by: &str) -> Mechanism {
    let options = "[\"revolute\", \"cylindrical\", \"universal\", \"spherical\"]";
    let joints = format!(
        "0-1 | 0 1 | revolute | 0, 0, 0 | 0, 0, 1 | drive = true
         1-2 | 1 2 | revolute | 0, 30, 0 | 0, 0, 1
         2-3 | 2 3 | revolute | 80, 90, 0 | 0, \"{by}\", 1
         3-0 | 3 0 | revolute | 120, 0, 0 | 0, 0, 1"
    );
    let head = format!("name = \"tilted\"\n[search]\noptions = {options}");
    read(&write_mechanism(&head, "0 1 2 3*", &joints))
}

/// By hand: three parallel hinges and one that is not lock each other, whatever the tilt is. The counts are those of a tilt of 1.
fn is_locked(m: &Mechanism) {
    let found = analyse_states(m, &[StateId::FREE], Method::Auto)
        .unwrap()
        .remove(0);
    assert_eq!((found.mobility, found.redundant, found.rank), (0, 2, 4));
    assert_eq!(certify_state(m, StateId::FREE).unwrap().rank, 4);
    let (search, built) = searched(m, Conditions::default());
    let counts = [(&built.determinate, false), (&built.admissible, true)]
        .map(|(diagram, filter)| search.count_variants(diagram, filter).total);
    assert_eq!(counts, [52u8.into(), 11u8.into()]);
}

#[test]
fn a_multiple_of_the_smallest_primes_is_not_zero() {
    let [p, q] = FIRST;
    for by in [
        "1".to_owned(),
        format!("{p}*{q}/({p}*{q}+1)"),
        format!("7*{p}*{q}/(5*{p}*{q}+2)"),
    ] {
        is_locked(&tilted(&by));
    }
}

proptest! {
    #![proptest_config(crate::fuzz::runs(4))]
    /// Also where the number holds the primes of another tilt: its own are others.
    #[test]
    fn a_multiple_of_the_primes_of_another_file_is_not_zero(a in 1u32..1000, b in 1u32..1000) {
        let other = tilted(&format!("{a}/{b}"));
        let [p, q] = [0, 1].map(|nth| exact_field(&other, nth).unwrap().field().modulus());
        is_locked(&tilted(&format!("{p}*{q}/({p}*{q}+{b})")));
    }

    #[test]
    fn the_same_numbers_have_the_same_primes(a in 1u32..1000, b in 1u32..1000, nth in 0usize..2) {
        let primes = |text: String| -> u64 {
            ExactField::for_expressions([&text.parse().unwrap()], nth).unwrap().field().modulus()
        };
        let one = primes(format!("sqrt({a})/{b}"));
        prop_assert_eq!(one, primes(format!("sqrt({a})/{b}")));
        prop_assert_ne!(one, primes(format!("sqrt({a})/{}", b + 1)));
    }
}
