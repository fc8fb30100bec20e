//! Terms of the output and the help with their meanings, for `ozols explain`.

use serde::Deserialize;
use std::collections::BTreeMap;

/// A term of the field.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GlossaryTerm {
    /// The word.
    pub name: String,
    /// Other words and signs for it.
    pub also: Vec<String>,
    /// Three sentences, the first of which says what it is.
    pub text: String,
    /// Keys of [`Terms::sources`], or modules of this program such as `ozols::search`.
    pub source: Vec<String>,
    /// Names of other terms.
    pub related: Vec<String>,
    /// A command that shows it on a built-in mechanism.
    pub see: String,
}

impl GlossaryTerm {
    /// The sentence that says what it is.
    ///
    /// # Examples
    /// ```
    /// let terms = ozols::terms::Terms::builtin();
    /// assert!(terms.find("σ").is_some_and(|t| t.first_sentence().ends_with('.')));
    /// ```
    #[must_use]
    pub fn first_sentence(&self) -> &str {
        let end = self.text.find(". ").map_or(self.text.len(), |i| i + 1);
        &self.text[..end]
    }
}

/// The terms and what they are taken from.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Terms {
    /// Publications by key.
    pub sources: BTreeMap<String, String>,
    /// The terms, by subject.
    pub term: Vec<GlossaryTerm>,
}

impl Terms {
    /// Those built into the program.
    ///
    /// # Panics
    /// Never: a test reads the file.
    #[must_use]
    pub fn builtin() -> Terms {
        toml::from_str(include_str!("terms.toml")).expect("a test reads the file")
    }

    /// The term that a word or sign stands for; case, hyphens and apostrophes do not matter.
    ///
    /// # Examples
    /// ```
    /// let terms = ozols::terms::Terms::builtin();
    /// assert!(terms.find("mobility").is_some());
    /// ```
    #[must_use]
    pub fn find(&self, word: &str) -> Option<&GlossaryTerm> {
        let word = fold_word(word);
        let by_name = self.term.iter().find(|t| fold_word(&t.name) == word);
        by_name.or_else(|| {
            self.term
                .iter()
                .find(|t| t.also.iter().any(|a| fold_word(a) == word))
        })
    }

    /// Every word and sign that [`Terms::find`] knows.
    ///
    /// # Examples
    /// ```
    /// let terms = ozols::terms::Terms::builtin();
    /// assert!(terms.known_words().all(|word| terms.find(word).is_some()));
    /// ```
    pub fn known_words(&self) -> impl Iterator<Item = &str> {
        self.term
            .iter()
            .flat_map(|t| std::iter::once(&t.name).chain(&t.also))
            .map(String::as_str)
    }
}

/// Facts about a joint type in addition to its freedoms.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PairWords {
    /// Definition in a sentence.
    pub about: String,
    /// What its `axis` stands for.
    pub axis: String,
    /// What its `reference` stands for.
    pub reference: String,
    /// Parts that are such a joint.
    pub hardware: Vec<String>,
}

impl PairWords {
    /// The words of each joint type, by its name in files.
    ///
    /// # Panics
    /// Never: a test reads the file.
    ///
    /// # Examples
    /// ```
    /// use ozols::{model::joint_type::JointType, terms::PairWords};
    /// let words = PairWords::builtin();
    /// assert!(JointType::NAMED.iter().all(|t| words.contains_key(t.name())));
    /// ```
    #[must_use]
    pub fn builtin() -> BTreeMap<String, PairWords> {
        toml::from_str(include_str!("terms/joint_types.toml")).expect("a test reads the file")
    }
}

/// A word as it is compared.
fn fold_word(word: &str) -> String {
    let plain: String = word
        .to_lowercase()
        .chars()
        .filter(|c| !matches!(c, '\'' | '’' | '.'))
        .map(|c| if matches!(c, '-' | '_') { ' ' } else { c })
        .collect();
    plain.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::{Terms, fold_word};
    use std::collections::BTreeSet;
    use std::path::Path;

    #[test]
    fn every_term_has_three_short_sentences() {
        for t in Terms::builtin().term {
            let sentences: Vec<&str> = t
                .text
                .split_inclusive(['.', '?', '!'])
                .flat_map(|s| s.split(". "))
                .filter(|s| s.trim().chars().any(char::is_alphabetic))
                .collect();
            assert_eq!(sentences.len(), 3, "{}: {sentences:?}", t.name);
            assert!(t.text.ends_with('.'), "{}", t.name);
            for s in t.text.split(". ") {
                assert!(s.chars().count() <= 190, "{}: {s}", t.name);
                assert!(!s.starts_with(char::is_lowercase), "{}: {s}", t.name);
            }
        }
    }

    #[test]
    fn every_term_has_sources_that_exist_and_every_source_is_used() {
        let terms = Terms::builtin();
        let mut used = BTreeSet::new();
        for t in &terms.term {
            assert!(!t.source.is_empty(), "{}", t.name);
            for s in &t.source {
                if let Some(module) = s.strip_prefix("ozols::") {
                    let file = format!("{}.rs", module.replace("::", "/"));
                    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
                    let mut crates = std::fs::read_dir(crates).expect("it is there");
                    let there = crates.any(|c| c.expect("it is read").path().join(&file).is_file());
                    assert!(there, "{}: {s}", t.name);
                } else {
                    assert!(terms.sources.contains_key(s), "{}: {s}", t.name);
                    used.insert(s.clone());
                }
            }
        }
        assert!(terms.sources.keys().eq(used.iter()));
    }

    #[test]
    fn related_terms_are_others_by_their_names() {
        let terms = Terms::builtin();
        for t in &terms.term {
            assert!(!t.related.is_empty(), "{}", t.name);
            for r in &t.related {
                assert!(terms.term.iter().any(|o| o.name == *r), "{}: {r}", t.name);
                assert_ne!(*r, t.name);
            }
        }
    }

    #[test]
    fn a_word_stands_for_one_term() {
        let terms = Terms::builtin();
        let mut seen = BTreeSet::new();
        for word in terms.known_words() {
            assert!(seen.insert(fold_word(word)), "{word} stands twice");
        }
        for (word, name) in [
            ("σ", "sigma"),
            ("W", "mobility"),
            ("dof", "freedom"),
            ("n", "link"),
            ("p", "joint"),
            ("k", "contour"),
            ("f", "freedom"),
            ("Delta point", "delta-point"),
            ("ozols formula", "Ozols' formula"),
            ("Δφ", "missing angle"),
            ("REDUNDANT-CONSTRAINT", "redundant constraint"),
        ] {
            assert_eq!(terms.find(word).map(|t| t.name.as_str()), Some(name));
        }
        assert!(terms.find("nonsense").is_none());
    }
}
