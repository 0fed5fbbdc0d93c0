//! The glossary: every term of the window, each explained once, in `assets/glossary/glossary.toml`.

use super::text::{self, Block};
use serde::Deserialize;
use serde::de::{Deserializer, Error};
use std::sync::LazyLock;

const SOURCE: &str = include_str!("../../assets/glossary/glossary.toml");

/// A term and its explanation.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Term {
    /// Its name.
    pub name: String,
    /// Its symbol; empty if it has none.
    #[serde(default)]
    pub symbol: String,
    /// Other names that the window uses for it: in rows, headings and texts.
    #[serde(default)]
    pub also: Vec<String>,
    /// Explanation of the term.
    #[serde(deserialize_with = "blocks")]
    pub text: Vec<Block>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    term: Vec<Term>,
}

fn blocks<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Block>, D::Error> {
    text::blocks(&String::deserialize(from)?, None).map_err(|(_, error)| D::Error::custom(error))
}

/// All terms, in alphabetical order.
pub fn terms() -> &'static [Term] {
    static TERMS: LazyLock<Vec<Term>> = LazyLock::new(|| {
        // The file is built in, and a test reads it: there is no error here.
        let mut terms = read(SOURCE).unwrap_or_default();
        terms.sort_by_key(|term| term.name.to_lowercase());
        terms
    });
    &TERMS
}

fn read(source: &str) -> Result<Vec<Term>, toml::de::Error> {
    toml::from_str(source).map(|file: File| file.term)
}

/// The term that the window calls `word`: by its name, its symbol or another name of it.
pub fn find(word: &str) -> Option<&'static Term> {
    let word = word.trim();
    let by_name = terms().iter().find(|term| term.name.eq_ignore_ascii_case(word));
    by_name.or_else(|| {
        terms().iter().find(|term| {
            (!term.symbol.is_empty() && term.symbol == word)
                || term.also.iter().any(|also| also.eq_ignore_ascii_case(word))
        })
    })
}

impl Term {
    /// Whether all words of a query, in any case, are somewhere in the term or its explanation.
    pub fn matches(&self, query: &str) -> bool {
        let words = format!("{} {} {} {}", self.name, self.symbol, self.also.join(" "), text::plain_blocks(&self.text));
        let words = words.to_lowercase();
        query.to_lowercase().split_whitespace().all(|part| words.contains(part))
    }

    /// How well a query fits: the term itself before those that only mention it.
    pub fn rank(&self, query: &str) -> u8 {
        let (name, query) = (self.name.to_lowercase(), query.trim().to_lowercase());
        match () {
            () if name.starts_with(&query) || self.symbol.to_lowercase() == query => 0,
            () if name.contains(&query) || self.also.iter().any(|also| also.to_lowercase().contains(&query)) => 1,
            () => 2,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_glossary_is_read_and_no_word_has_two_meanings() {
        let read = read(SOURCE).unwrap();
        assert!(read.len() > 30, "{}", read.len());
        let mut words: Vec<&str> = Vec::new();
        for term in &read {
            assert!(!term.text.is_empty(), "{}", term.name);
            words.push(&term.name);
            words.extend(term.also.iter().map(String::as_str));
            assert!(std::ptr::eq(find(&term.name).unwrap(), terms().iter().find(|t| t.name == term.name).unwrap()));
        }
        let all = words.len();
        words.sort_unstable();
        words.dedup();
        assert_eq!(all, words.len(), "a word that stands for two terms");
    }

    #[test]
    fn a_term_is_found_by_name_symbol_and_words() {
        assert_eq!(find("α").unwrap().name, find("Film share of the load").unwrap().name);
        assert!(find("no such thing").is_none());
        let found: Vec<&str> =
            terms().iter().filter(|term| term.matches("SQUEEZE number")).map(|t| t.name.as_str()).collect();
        assert!(found.contains(&"Squeeze number"), "{found:?}");
        assert_eq!(find("Squeeze number").unwrap().rank("squeeze"), 0);
        assert!(terms().iter().all(|term| !term.matches("xyzzy")));
    }
}
