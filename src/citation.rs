//! How the program is cited.

/// The version, and the commit it stands for in a citation.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// What the program may be used under.
pub const LICENCE: &str = env!("CARGO_PKG_LICENSE");

/// The program as an entry of BibTeX. `CITATION.cff` says the same.
pub fn bibtex() -> String {
    format!(
        "@software{{squeezefilm,\n  title   = {{squeezefilm: {TITLE}}},\n  author  = {{{{The squeezefilm developers}}}},\n  \
         version = {{{VERSION}}},\n  year    = {{{}}}\n}}\n",
        &RELEASED[..4]
    )
}

/// What it is, in a citation.
const TITLE: &str = "the squeezed air film of ultrasonic motors";
/// Day of the version.
pub const RELEASED: &str = "2026-11-22";

#[cfg(test)]
mod tests {
    use super::{LICENCE, RELEASED, TITLE, VERSION};

    #[test]
    fn the_citation_file_says_the_same() {
        let file = include_str!("../CITATION.cff");
        for line in [
            format!("title: \"squeezefilm: {TITLE}\""),
            format!("version: {VERSION}"),
            format!("date-released: \"{RELEASED}\""),
        ] {
            assert!(file.contains(&line), "{line}");
        }
        for licence in LICENCE.split(" OR ") {
            assert!(file.contains(&format!("  - {licence}")), "{licence}");
        }
    }
}
