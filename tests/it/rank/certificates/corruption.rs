//! Certificates made false, each in a way that has to be noticed.

use super::{certified, field, sparse};
use crate::common::*;
use num_rational::BigRational;
use ozols::linalg::number_ring::{Element, NumberRing};
use ozols::rank::exact::certificate::{Budget, Certificate, certify_matrix};
use ozols::verify::Flaw;
use ozols::verify::matrix::MatrixOverRing;

/// The kinds of corruption that make a certificate false, or say something other than it did, whatever the matrix:
/// - a kernel entry changed (the column of a pivot is not zero, so the product with J changes), dropped, doubled, or
///   given more coordinates than the field has; a vector dropped, doubled, or said to have another free column;
/// - pivots doubled, dropped or out of range; a pivot column that is a free one;
/// - a modulus that is no prime; an image that is no root of its relation;
/// - another rank, another size; another relation, order or number of witnesses, a witness that shows nothing.
///
/// Not among them, for they leave a true proof: another order of vectors or pivots, another prime, a conjugate image.
pub(super) fn corruptions(m: &MatrixOverRing, good: &Certificate) -> Vec<(String, Certificate)> {
    let mut out = Vec::new();
    let mut put = |what: String, change: &dyn Fn(&mut Certificate)| {
        let mut c = good.clone();
        change(&mut c);
        assert!(c != *good, "{what} changes nothing");
        out.push((what, c));
    };
    let ring = m.ring();
    for (i, v) in good.kernel.iter().enumerate() {
        for j in 0..v.entries.len() {
            for g in 0..ring.dimension() {
                put(format!("coordinate {g} of entry {j} of vector {i}"), &|c| {
                    let x = &mut c.kernel[i].entries[j].1;
                    let mut unit = vec![BigRational::default(); g];
                    unit.push(BigRational::new(1.into(), 7.into()));
                    *x = ring.add(x, &Element::new(unit));
                });
            }
            put(format!("entry {j} of vector {i} dropped"), &|c| {
                c.kernel[i].entries.remove(j);
            });
            put(format!("entry {j} of vector {i} twice"), &|c| {
                let entry = c.kernel[i].entries[j].clone();
                c.kernel[i].entries.push(entry);
            });
            put(format!("entry {j} of vector {i} beyond the field"), &|c| {
                let long = vec![BigRational::from_integer(1.into()); ring.dimension() + 1];
                c.kernel[i].entries[j].1 = Element::new(long);
            });
            put(format!("entry {j} of vector {i} out of range"), &|c| {
                c.kernel[i].entries[j].0 = m.columns();
            });
        }
        put(format!("vector {i} dropped"), &|c| {
            c.kernel.remove(i);
        });
        put(format!("vector {i} twice"), &|c| {
            let v = c.kernel[i].clone();
            c.kernel.push(v);
        });
        for free in (0..=m.columns()).filter(|&f| f != v.free) {
            put(format!("free column {free} for vector {i}"), &|c| {
                c.kernel[i].free = free;
            });
        }
        if good.kernel.len() > 1 {
            put(format!("vector {i} in place of another"), &|c| {
                let v = c.kernel[i].clone();
                let other = (i + 1) % c.kernel.len();
                c.kernel[other] = v;
            });
        }
        for p in 0..good.rank {
            put(format!("free column of {i} as pivot {p}"), &|c| {
                c.minor.columns[p] = c.kernel[i].free;
            });
        }
    }
    for p in 0..good.rank {
        for q in (0..good.rank).filter(|&q| q != p) {
            put(format!("pivot rows {p} and {q} the same"), &|c| {
                c.minor.rows[p] = c.minor.rows[q];
            });
            put(format!("pivot columns {p} and {q} the same"), &|c| {
                c.minor.columns[p] = c.minor.columns[q];
            });
        }
        put(format!("pivot row {p} dropped"), &|c| {
            c.minor.rows.remove(p);
        });
        put(format!("pivot column {p} dropped"), &|c| {
            c.minor.columns.remove(p);
        });
        put(format!("pivot row {p} out of range"), &|c| {
            c.minor.rows[p] = m.rows();
        });
        put(format!("pivot column {p} out of range"), &|c| {
            c.minor.columns[p] = m.columns();
        });
    }
    let p = good.minor.prime;
    let composite = (1u64 << 31) - 1;
    for modulus in [0, 1, 2, p - 1, p + 1, composite * composite, u64::MAX] {
        put(format!("modulus {modulus}"), &|c| c.minor.prime = modulus);
    }
    for i in 0..good.minor.images.len() {
        for by in [1, 2, p / 2] {
            put(format!("image {i} off by {by}"), &|c| {
                c.minor.images[i] = (c.minor.images[i] + by) % p;
            });
        }
        put(format!("image {i} is no residue"), &|c| {
            c.minor.images[i] += p
        });
        put(format!("image {i} dropped"), &|c| {
            c.minor.images.remove(i);
        });
    }
    put("one more image".to_owned(), &|c| c.minor.images.push(0));
    put("one more in rank".to_owned(), &|c| c.rank += 1);
    put("a huge rank".to_owned(), &|c| c.rank = usize::MAX);
    if good.rank > 0 {
        put("one less in rank".to_owned(), &|c| c.rank -= 1);
        put("a smaller minor to fit".to_owned(), &|c| {
            c.rank -= 1;
            c.minor.rows.pop();
            c.minor.columns.pop();
        });
    }
    put("a row more".to_owned(), &|c| c.rows += 1);
    put("a column more".to_owned(), &|c| c.columns += 1);
    put("another cosine".to_owned(), &|c| {
        c.field.cosine_order = Some(c.field.cosine_order.unwrap_or(0) + 4);
    });
    put("one more relation".to_owned(), &|c| {
        c.field.relations.push(vec![Element::from_integer(1)]);
    });
    for g in 0..good.field.relations.len() {
        put(format!("relation {g} altered"), &|c| {
            let x = &mut c.field.relations[g][0];
            *x = ring.add(x, &Element::from_integer(1));
        });
        put(format!("relation {g} dropped"), &|c| {
            c.field.relations.remove(g);
        });
    }
    for w in 0..good.field.witnesses.len() {
        put(format!("witness {w} dropped"), &|c| {
            c.field.witnesses.remove(w);
        });
        put(format!("witness {w} without a prime"), &|c| {
            c.field.witnesses[w].prime += 1;
        });
        put(
            format!("witness {w} where the radicand is a square"),
            &|c| {
                c.field.witnesses[w].prime = p;
                let first = c.minor.images.len() - c.field.witnesses.len();
                c.field.witnesses[w].images = c.minor.images[..first + w].to_vec();
            },
        );
    }
    out
}

#[test]
fn corrupted_certificates_of_mechanisms_are_rejected() {
    let mut flaws = Vec::new();
    for name in ["gripper-10", "3-rps", "bennett", "stewart-gough", "tongs"] {
        let (m, good) = certified(name);
        for (what, c) in corruptions(&m, &good) {
            let flaw = verify::check_certificate(&m, &c).expect_err(&format!("{name}: {what}"));
            flaws.push(flaw.to_string());
        }
    }
    // Each kind of flaw was met, but for those that only a small prime or another matrix brings about.
    for part in [
        "it is for a",
        "exceeds the size of the matrix",
        "its number field is not that of the matrix",
        "is not shown to give a field",
        "is not a prime between 3 and 2^63",
        "do not fit the",
        "does not satisfy its relation",
        "do not show rank",
        "pivot rows or columns repeat",
        "kernel vectors are given",
        "the free columns of the kernel",
        "has entries that repeat",
        "has a number outside the field",
        "is not 1 in its own free column",
        "times kernel vector",
    ] {
        assert!(flaws.iter().any(|flaw| flaw.contains(part)), "{part}");
    }
}

/// A matrix of one 1 with its certificate, over the field of a number.
fn one(text: &str) -> (MatrixOverRing, Certificate) {
    let f = field(&[text]);
    let m = sparse(&f, &[vec![Element::from_integer(1)]], 1);
    let c = certify_matrix(&f, &m, "free", Budget::default()).unwrap();
    assert_eq!(verify::check_certificate(&m, &c), Ok(1));
    (m, c)
}

/// The same matrix over another ring, and its certificate with the relation and the order of the cosine of that.
fn over(
    c: &Certificate,
    relation: &[i64],
    cosine_order: Option<u64>,
) -> (MatrixOverRing, Certificate) {
    let relation: Vec<Element> = relation.iter().map(|&x| Element::from_integer(x)).collect();
    let ring = NumberRing::rationals().adjoin(relation.clone()).unwrap();
    let m = MatrixOverRing::new(
        ring,
        cosine_order,
        [1, 1],
        [(0, 0, Element::from_integer(1))],
    );
    let mut c = c.clone();
    c.field.relations = vec![relation];
    c.field.cosine_order = cosine_order;
    (m.unwrap(), c)
}

/// x² + 4x - 5 = (x + 5)(x - 1) has the constant of the root of 5 and is reducible; the root of 3, 2 cos 30°, is no 2 cos 45°.
#[test]
fn rings_that_are_not_the_field_they_are_said_to_be_are_refused() {
    let refused = |m: &MatrixOverRing, c: &Certificate| {
        let found = verify::check_certificate(m, c);
        assert!(matches!(found, Err(Flaw::NotAField { .. })), "{found:?}");
    };
    let (_, root) = one("sqrt(5)");
    let (m, mut c) = over(&root, &[-5, 4], None);
    c.minor.images = vec![1];
    refused(&m, &c);
    let (_, cosine) = one("cos(30deg)");
    let (m, c) = over(&cosine, &[-3, 0], Some(12));
    assert_eq!(verify::check_certificate(&m, &c), Ok(1));
    let (m, c) = over(&cosine, &[-3, 0], Some(8));
    refused(&m, &c);
}
