//! Certificates of rank: every built-in mechanism has one, random matrices do, and none that is false is accepted.

use crate::common::*;
mod command_line;
mod corruption;

use corruption::corruptions;
use num_rational::BigRational;
use ozols::geom::number_field::NumberField;
use ozols::linalg::number_ring::{Element, NumberRing};
use ozols::rank::exact::certificate::{Budget, Certificate, NoCertificate, certify_matrix};
use ozols::rank::exact::rational;
use ozols::verify::Flaw;
use ozols::verify::matrix::MatrixOverRing;

fn certified(name: &str) -> (MatrixOverRing, Certificate) {
    let m = built_in(name);
    let field = number_field(&m, StateId::FREE).unwrap();
    (
        closure_matrix(&field, &m, StateId::FREE).unwrap(),
        certify_state(&m, StateId::FREE).unwrap(),
    )
}

#[test]
fn every_built_in_mechanism_is_certified_in_every_state() {
    let mut without = Vec::new();
    for name in builtin::names() {
        let m = built_in(name);
        for state in m.state_ids() {
            let rank = analysed_in(&m, state).rank;
            let certificate = match certify_state(&m, state) {
                Ok(certificate) => certificate,
                Err(reason) => {
                    without.push(format!("{name} {}: {reason}", m.states[state]));
                    continue;
                }
            };
            let field = number_field(&m, state).unwrap();
            let j = closure_matrix(&field, &m, state).unwrap();
            assert_eq!(
                verify::check_certificate(&j, &certificate),
                Ok(rank),
                "{name}"
            );
            if let Some(plain) = rational::rational_rank(&j) {
                assert_eq!(plain, rank, "{name}");
            }
            // Through JSON and back.
            let text = serde_json::to_string(&certificate).unwrap();
            assert_eq!(
                serde_json::from_str::<Certificate>(&text).unwrap(),
                certificate
            );
        }
    }
    assert!(without.is_empty(), "{without:#?}");
}

/// Fields to draw random matrices over: the rationals, two roots, a cosine that is a root, a cubic cosine, a cosine with
/// a root, a nested root.
const FIELDS: [&[&str]; 6] = [
    &[],
    &["sqrt(2)", "sqrt(3)"],
    &["cos(36deg)"],
    &["cos(40deg)"],
    &["cos(pi/8)", "sqrt(3)"],
    &["sqrt(1+sqrt(3))"],
];

fn field(texts: &[&str]) -> NumberField {
    let exprs: Vec<Expr> = texts.iter().map(|t| t.parse().unwrap()).collect();
    NumberField::for_expressions(&exprs).unwrap()
}

/// Rank by plain elimination over the field, dividing as it goes.
fn slow_rank(ring: &NumberRing, mut rows: Vec<Vec<Element>>) -> usize {
    let (width, mut rank) = (rows.first().map_or(0, Vec::len), 0);
    for c in 0..width {
        let Some(r) = (rank..rows.len()).find(|&r| !rows[r][c].is_zero()) else {
            continue;
        };
        rows.swap(rank, r);
        let pivot = rows[rank].clone();
        let inverse = ring.inverse(&pivot[c]).unwrap();
        for row in &mut rows[rank + 1..] {
            let factor = ring.mul(&row[c], &inverse);
            for (x, y) in row.iter_mut().zip(&pivot) {
                *x = ring.sub(x, &ring.mul(&factor, y));
            }
        }
        rank += 1;
    }
    rank
}

/// A number of a field from a few small integers.
fn number(ring: &NumberRing, digits: &[i64]) -> Element {
    let coordinates = digits[1..]
        .iter()
        .take(ring.dimension())
        .map(|&n| BigRational::new(n.into(), digits[0].into()))
        .collect();
    Element::new(coordinates)
}

#[derive(Debug, Clone)]
struct Random {
    field: usize,
    /// Rows, columns, and the length of the products that give the matrix its low rank.
    size: [usize; 3],
    numbers: Vec<Vec<i64>>,
}

fn random() -> impl Strategy<Value = Random> {
    let number = (1i64..7, prop::collection::vec(-3i64..4, 0..=8), 0..3u8);
    let number = number.prop_map(|(d, mut v, sparse)| {
        if sparse == 0 {
            v.clear();
        }
        v.insert(0, d);
        v
    });
    (
        0..FIELDS.len(),
        [1usize..6, 1usize..6, 0usize..4],
        prop::collection::vec(number, 60),
    )
        .prop_map(|(field, size, numbers)| Random {
            field,
            size,
            numbers,
        })
}

impl Random {
    fn dense(&self, ring: &NumberRing) -> Vec<Vec<Element>> {
        let [rows, columns, inner] = self.size;
        let at = |i: usize| number(ring, &self.numbers[i % self.numbers.len()]);
        let mut out = vec![vec![Element::default(); columns]; rows];
        for (r, row) in out.iter_mut().enumerate() {
            for (c, x) in row.iter_mut().enumerate() {
                for k in 0..inner {
                    let product = ring.mul(&at(r * inner + k), &at(30 + k * columns + c));
                    *x = ring.add(x, &product);
                }
            }
        }
        out
    }
}

fn sparse(field: &NumberField, dense: &[Vec<Element>], columns: usize) -> MatrixOverRing {
    let entries = dense
        .iter()
        .enumerate()
        .flat_map(|(r, row)| row.iter().enumerate().map(move |(c, x)| (r, c, x.clone())));
    MatrixOverRing::new(
        field.ring().clone(),
        field.cosine_order(),
        [dense.len(), columns],
        entries,
    )
    .unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, max_shrink_iters: 200, ..ProptestConfig::default() })]
    #[test]
    fn random_matrices_have_the_rank_of_brute_force(random in random()) {
        let f = field(FIELDS[random.field]);
        let dense = random.dense(f.ring());
        let m = sparse(&f, &dense, random.size[1]);
        let certificate = certify_matrix(&f, &m, "free", Budget::default()).unwrap();
        let rank = slow_rank(f.ring(), dense);
        prop_assert_eq!(verify::check_certificate(&m, &certificate), Ok(rank));
        match rational::rational_rank(&m) {
            Some(plain) => prop_assert_eq!(plain, rank),
            None => prop_assert!(random.field > 0),
        }
        for (what, false_one) in corruptions(&m, &certificate) {
            prop_assert!(verify::check_certificate(&m, &false_one).is_err(), "{}", what);
        }
    }

}

/// A true certificate of one matrix, held against another.
#[test]
fn a_certificate_does_not_serve_another_matrix() {
    let rationals = field(&[]);
    let int = |rows: &[&[i64]]| {
        let dense: Vec<Vec<Element>> = rows
            .iter()
            .map(|r| r.iter().map(|&x| Element::from_integer(x)).collect())
            .collect();
        sparse(&rationals, &dense, rows[0].len())
    };
    let m = int(&[&[1, 2, 3], &[2, 4, 6], &[1, 0, 1]]);
    let c = certify_matrix(&rationals, &m, "free", Budget::default()).unwrap();
    assert_eq!(verify::check_certificate(&m, &c), Ok(2));
    // of rank 3: the kernel vector is none
    let higher = int(&[&[1, 2, 3], &[2, 4, 7], &[1, 0, 1]]);
    assert!(matches!(
        verify::check_certificate(&higher, &c),
        Err(Flaw::NotInKernel { vector: 0, row: 1 })
    ));
    // of rank 1: the minor vanishes
    let lower = int(&[&[1, 2, 3], &[2, 4, 6], &[1, 2, 3]]);
    assert!(matches!(
        verify::check_certificate(&lower, &c),
        Err(Flaw::MinorVanishes { .. })
    ));
    // over a number that has no image
    let p = i64::try_from(c.minor.prime).unwrap();
    let odd = MatrixOverRing::new(
        NumberRing::rationals(),
        None,
        [3, 3],
        [(
            0,
            0,
            Element::from_rational(BigRational::new(1.into(), p.into())),
        )],
    );
    assert!(matches!(
        verify::check_certificate(&odd.unwrap(), &c),
        Err(Flaw::Denominator { .. })
    ));
}

/// y² = 3 and z² = 5 with a witness at 3, which divides the discriminant of y: no proof, though 5 is no square modulo 3.
#[test]
fn witnesses_at_a_discriminant_are_refused() {
    let f = field(&["sqrt(3)", "sqrt(5)"]);
    let m = sparse(&f, &[vec![f.ring().generator(1)]], 1);
    let mut c = certify_matrix(&f, &m, "free", Budget::default()).unwrap();
    assert_eq!(verify::check_certificate(&m, &c), Ok(1));
    (c.field.witnesses[1].prime, c.field.witnesses[1].images) = (3, vec![0]);
    assert!(matches!(
        verify::check_certificate(&m, &c),
        Err(Flaw::NotAField { generator: 1, why }) if why.contains("discriminant")
    ));
}

#[test]
fn long_numbers_take_more_primes_and_budgets_hold() {
    let rationals = field(&[]);
    let ring = rationals.ring();
    // A Vandermonde matrix with one column to spare: its kernel has entries of some hundred digits.
    let dense: Vec<Vec<Element>> = (0..12i64)
        .map(|i| {
            let x = Element::from_integer(i * 37 + 1000);
            let mut power = Element::from_integer(1);
            (0..13)
                .map(|_| {
                    let now = power.clone();
                    power = ring.mul(&power, &x);
                    now
                })
                .collect()
        })
        .collect();
    let m = sparse(&rationals, &dense, 13);
    let c = certify_matrix(&rationals, &m, "free", Budget::default()).unwrap();
    assert_eq!(verify::check_certificate(&m, &c), Ok(12));
    let few = default_with(|b: &mut Budget| b.primes = 3);
    assert!(matches!(
        certify_matrix(&rationals, &m, "free", few),
        Err(NoCertificate::TooManyPrimes { primes: 3 })
    ));
    let small = default_with(|b: &mut Budget| b.coordinates = 12);
    assert_eq!(
        certify_matrix(&rationals, &m, "free", small),
        Err(NoCertificate::TooLarge { coordinates: 13 })
    );
    let short = default_with(|b: &mut Budget| b.operations = 10);
    assert!(matches!(
        certify_matrix(&rationals, &m, "free", short),
        Err(NoCertificate::TooMuchWork { .. })
    ));
}
