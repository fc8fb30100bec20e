//! Suggestions for a mistyped word.

/// Maximum number of words suggested.
const MOST: usize = 5;
/// Minimum similarity of two words, from 0 to 1.
const ALIKE: f64 = 0.75;

/// Returns the known words nearest to `word`, best first: those of similar spelling, then those that contain it or are contained in it.
#[must_use]
pub fn nearest_words<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let word = word.to_lowercase();
    if word.is_empty() {
        return Vec::new();
    }
    let mut found: Vec<(f64, &str)> = known
        .into_iter()
        .filter_map(|k| {
            let lower = k.to_lowercase();
            // The prefix counts for more, as people mistype ends.
            let alike = strsim::jaro_winkler(&word, &lower);
            let within = lower.contains(&word) || (lower.len() > 2 && word.contains(&lower));
            (alike >= ALIKE || within).then_some((alike, k))
        })
        .collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
    found.truncate(MOST);
    found.into_iter().map(|(_, k)| k).collect()
}

/// Returns "; did you mean this, that or the other?", or an empty text if no known word is near.
#[must_use]
pub fn suggest_words<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    ask_words(&nearest_words(word, known))
}

/// Returns the same for words that are chosen already.
#[must_use]
pub fn ask_words(near: &[&str]) -> String {
    match near {
        [] => String::new(),
        [one] => format!("; did you mean {one}?"),
        [head @ .., last] => format!("; did you mean {} or {last}?", head.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::{nearest_words, suggest_words};

    #[test]
    fn the_nearest_comes_first_and_what_is_far_does_not_come() {
        let known = ["gripper-10", "gripper-10-planar", "four-bar", "bennett"];
        assert_eq!(nearest_words("gripper10", known)[0], "gripper-10");
        assert_eq!(nearest_words("benett", known), ["bennett"]);
        assert_eq!(nearest_words("fourbar", known), ["four-bar"]);
        assert!(nearest_words("zzz", known).is_empty());
        assert!(nearest_words("", known).is_empty());
        assert_eq!(suggest_words("benett", known), "; did you mean bennett?");
    }
}
