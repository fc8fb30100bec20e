//! Counts and lists in sentences.

/// "1 redundant constraint", "2 redundant constraints".
pub fn plural(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

/// The same of a number that is written already: "1 variant", "25,761,436 variants".
pub fn plural_of(n: &str, what: &str) -> String {
    format!("{n} {what}{}", if n == "1" { "" } else { "s" })
}

/// "a, b or c".
pub fn disjunction<'a>(of: impl IntoIterator<Item = &'a str>) -> String {
    let mut all: Vec<&str> = of.into_iter().collect();
    match (all.pop(), all.is_empty()) {
        (Some(last), false) => format!("{} or {last}", all.join(", ")),
        (last, _) => last.unwrap_or_default().to_owned(),
    }
}

/// "a", "a and b", "a, b and c".
pub fn list<T: AsRef<str>>(of: &[T]) -> String {
    match of {
        [] => String::new(),
        [one] => one.as_ref().to_owned(),
        [most @ .., last] => {
            let most: Vec<&str> = most.iter().map(AsRef::as_ref).collect();
            format!("{} and {}", most.join(", "), last.as_ref())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{list, plural};

    #[test]
    fn lists_end_with_and() {
        assert_eq!(list(&["a", "b", "c"]), "a, b and c");
        assert_eq!(list(&["a"]), "a");
        assert_eq!(plural(1, "way") + ", " + &plural(2, "way"), "1 way, 2 ways");
    }
}
