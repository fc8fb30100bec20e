//! Conversion of an expression to text that reads back as the same number.

use super::Expr;
use super::node::{Function, NodeKind};
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed};
use std::fmt;

/// Number of leaves above which trees are displayed as decimals. Shared nodes make the full text exponentially long.
const MAX_SHOWN: u64 = 4096;

// Binding strengths in the written form.
const SUM: u8 = 1;
const PRODUCT: u8 = 2;
const UNARY: u8 = 3;
const ATOM: u8 = 5;

/// Returns a rational as text with its binding strength. A short terminating decimal is preferred.
fn show_rational(r: &BigRational) -> (String, u8) {
    let sign = if r.is_negative() { "-" } else { "" };
    let strength = if r.is_negative() { UNARY } else { ATOM };
    let (n, d) = (r.numer().abs(), r.denom());
    if d.is_one() {
        return (format!("{sign}{n}"), strength);
    }
    let (twos, mut rest) = (
        d.trailing_zeros().unwrap_or(0),
        d >> d.trailing_zeros().unwrap_or(0),
    );
    let mut fives = 0u64;
    let five = BigInt::from(5);
    while fives <= 20 && rest.is_multiple_of(&five) {
        rest /= &five;
        fives += 1;
    }
    let places = twos.max(fives) as usize;
    if !rest.is_one() || places > 20 {
        return (format!("{sign}{n}/{d}"), PRODUCT);
    }
    let scaled = n * BigInt::from(10).pow(places as u32) / d;
    let digits = format!(
        "{scaled:0>width$}",
        scaled = scaled.to_string(),
        width = places + 1
    );
    let (whole, fraction) = digits.split_at(digits.len() - places);
    (format!("{sign}{whole}.{fraction}"), strength)
}

/// The remaining parts to write.
enum Task<'a> {
    Text(&'static str),
    Power(i64),
    /// A tree, in parentheses if it binds less than this.
    Tree(&'a Expr, u8),
}

/// A node in pieces.
enum Pieces<'a> {
    /// A piece without parts.
    Whole(String),
    /// A piece with parts, in reverse order because the stack of tasks is processed from its end.
    Parts(Vec<Task<'a>>),
}

/// Returns the pieces of a node, with its binding strength.
fn split_node(kind: &NodeKind) -> (u8, Pieces<'_>) {
    use Task::{Power, Text, Tree};
    let (strength, parts) = match kind {
        NodeKind::Rational(r) => {
            let (text, strength) = show_rational(r);
            return (strength, Pieces::Whole(text));
        }
        NodeKind::Trig(function, k, n) => {
            let name = match function {
                Function::Cos => "cos",
                Function::Sin => "sin",
                Function::Tan => "tan",
            };
            let (angle, strength) =
                show_rational(&BigRational::new(BigInt::from(*k) * 360, (*n).into()));
            let text = if strength == ATOM {
                format!("{name}({angle}deg)")
            } else {
                format!("{name}(({angle})deg)")
            };
            return (ATOM, Pieces::Whole(text));
        }
        NodeKind::Pi => return (ATOM, Pieces::Whole("pi".to_owned())),
        NodeKind::Add(a, b) => (SUM, vec![Tree(b, PRODUCT), Text("+"), Tree(a, SUM)]),
        NodeKind::Sub(a, b) => (SUM, vec![Tree(b, PRODUCT), Text("-"), Tree(a, SUM)]),
        NodeKind::Mul(a, b) => (PRODUCT, vec![Tree(b, UNARY), Text("*"), Tree(a, PRODUCT)]),
        NodeKind::Div(a, b) => (PRODUCT, vec![Tree(b, UNARY), Text("/"), Tree(a, PRODUCT)]),
        NodeKind::Neg(a) => (UNARY, vec![Tree(a, UNARY), Text("-")]),
        NodeKind::Pow(a, n) => (UNARY + 1, vec![Power(*n), Tree(a, ATOM)]),
        NodeKind::Sqrt(a) => (ATOM, vec![Text(")"), Tree(a, 0), Text("sqrt(")]),
    };
    (strength, Pieces::Parts(parts))
}

/// Writes a text that [`FromStr`](std::str::FromStr) reads back as the same number (as long as it stays within the limits on texts).
/// Trees of several thousand leaves are written as a decimal approximation instead.
impl fmt::Display for Expr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.size > MAX_SHOWN {
            return write!(f, "{:?}", self.to_f64());
        }
        let mut tasks = vec![Task::Tree(self, 0)];
        while let Some(task) = tasks.pop() {
            let (e, least) = match task {
                Task::Text(t) => {
                    f.write_str(t)?;
                    continue;
                }
                Task::Power(n) => {
                    write!(f, "^{n}")?;
                    continue;
                }
                Task::Tree(e, least) => (e, least),
            };
            let (strength, pieces) = split_node(&e.0.kind);
            let bracketed = strength < least;
            match pieces {
                Pieces::Whole(text) if bracketed => write!(f, "({text})")?,
                Pieces::Whole(text) => f.write_str(&text)?,
                Pieces::Parts(mut parts) => {
                    if bracketed {
                        tasks.push(Task::Text(")"));
                    }
                    tasks.append(&mut parts);
                    if bracketed {
                        tasks.push(Task::Text("("));
                    }
                }
            }
        }
        Ok(())
    }
}

impl fmt::Debug for Expr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Expr({self})")
    }
}
