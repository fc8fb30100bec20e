//! Putting text, data and parts into a page so that none can be taken for another.

use crate::svg::xml::escape;
use serde_json::{Number, Value};

/// Text as HTML character data, fit for attributes too.
pub(super) fn text(raw: &str) -> String {
    let mut out = String::new();
    escape(&mut out, raw);
    out
}

/// JSON inside a script element: no `<`, so that nothing can end the element or begin a comment, and none of the line
/// ends that JSON allows and scripts do not.
pub(super) fn script_json(value: &Value) -> String {
    let mut out = String::new();
    // These characters stand in strings only, where an escape means the same.
    for c in value.to_string().chars() {
        match c {
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => {
                out.push_str(&format!("\\u{:04x}", u32::from(c)));
            }
            _ => out.push(c),
        }
    }
    out
}

/// The template with `{{name}}` replaced by the part of that name, once through: what stands in a part stays as it is.
pub(super) fn fill(template: &str, parts: &[(&str, String)]) -> String {
    let mut out = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        out.push_str(before);
        let (name, after) = after.split_once("}}").unwrap_or((after, ""));
        if let Some((_, part)) = parts.iter().find(|(n, _)| *n == name) {
            out.push_str(part);
        }
        rest = after;
    }
    out.push_str(rest);
    out
}

/// A measured number to five significant digits; null where it is none.
pub(super) fn measured(x: f64) -> Value {
    let short = format!("{x:.4e}").parse::<f64>().ok();
    short
        .and_then(Number::from_f64)
        .map_or(Value::Null, |n| whole(n.as_f64().unwrap_or(x), n))
}

/// Whole numbers without their `.0`.
fn whole(x: f64, n: Number) -> Value {
    #[allow(clippy::cast_possible_truncation, reason = "whole and below 2^53")]
    if x.fract() == 0.0 && x.abs() < 1e15 {
        Value::from(x as i64)
    } else {
        Value::Number(n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn nothing_in_a_string_ends_the_script() {
        let hostile = json!({"name": "</script><!--\u{2028}&amp;", "n": 1});
        let written = script_json(&hostile);
        assert!(!written.contains(['<', '>', '&', '\u{2028}']), "{written}");
        assert_eq!(serde_json::from_str::<Value>(&written).unwrap(), hostile);
    }

    #[test]
    fn parts_are_not_filled_again() {
        let parts = [("a", "{{b}}".to_owned()), ("b", "x".to_owned())];
        assert_eq!(fill("<{{a}}|{{b}}|{{c}}>", &parts), "<{{b}}|x|>");
    }

    #[test]
    fn measured_numbers_are_short() {
        let of = |x| measured(x).to_string();
        assert_eq!(of(2.0), "2");
        assert_eq!(of(0.022_345_678), "0.022346");
        assert_eq!(of(f64::NAN), "null");
    }
}
