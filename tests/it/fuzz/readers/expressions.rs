//! Expressions for coordinates, such as `sqrt(3)/2` and `cos(36deg)`.

use ozols::geom::expr::Expr;

pub(crate) const TOKENS: [&str; 28] = [
    "0", "1", "2", "7", "360", "0.5", "1e3", "1e-9", ".", "+", "-", "*", "/", "^", "(", ")",
    "sqrt(", "cos(", "sin(", "tan(", "pi", "deg", "rad", " ", ",", "2^9", "1/0", "é",
];

/// A written expression reads as the same number. Returns what was said.
pub(crate) fn read(text: &str) -> String {
    match text.parse::<Expr>() {
        Ok(e) => {
            assert!(e.to_f64().is_finite(), "{text}");
            let written = e.to_string();
            let again: Expr = written.parse().unwrap();
            assert_eq!(again.to_f64(), e.to_f64(), "{text} is written {written}");
            written
        }
        Err(e) => e.to_string(),
    }
}

pub(crate) fn seeds() -> Vec<Vec<u8>> {
    let some = [
        "1",
        "sqrt(3)/2",
        "cos(36deg)",
        "2*(1 - 0.5)^3",
        "-tan(pi/8)",
    ];
    some.map(|text| text.as_bytes().to_vec()).to_vec()
}

pub(crate) fn look(bytes: &[u8]) -> String {
    read(&String::from_utf8_lossy(bytes))
}
