//! How the program is cited.

/// The version, and the commit it stands for in a citation.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// What the program may be used under.
pub const LICENCE: &str = env!("CARGO_PKG_LICENSE");

/// The program as an entry of BibTeX. `CITATION.cff` says the same.
pub fn bibtex() -> String {
    format!(
        "@software{{squeezefilm,\n  title   = {{squeezefilm: {TITLE}}},\n  author  = {{{{The squeezefilm developers}}}},\n  \
         version = {{{VERSION}}},\n  year    = {{{YEAR}}}\n}}\n"
    )
}

/// What it is, in a citation.
const TITLE: &str = "the squeezed air film of ultrasonic motors";
/// Year of the version.
const YEAR: u16 = 2026;

#[cfg(test)]
mod tests {
    use super::{LICENCE, TITLE, VERSION, YEAR};

    #[test]
    fn the_citation_file_says_the_same() {
        let file = include_str!("../CITATION.cff");
        for line in [
            format!("title: \"squeezefilm: {TITLE}\""),
            format!("version: {VERSION}"),
            format!("date-released: \"{YEAR}-"),
        ] {
            assert!(file.contains(&line), "{line}");
        }
        for licence in LICENCE.split(" OR ") {
            assert!(file.contains(&format!("  - {licence}")), "{licence}");
        }
    }
}
