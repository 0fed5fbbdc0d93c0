//! The citation of the program.

/// The version.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The licence, as an SPDX expression.
pub const LICENCE: &str = env!("CARGO_PKG_LICENSE");

/// The citation as an entry of BibTeX. `CITATION.cff` has the same content.
pub fn bibtex() -> String {
    format!(
        "@software{{squeezefilm,\n  title   = {{squeezefilm: {TITLE}}},\n  author  = {{{{The squeezefilm developers}}}},\n  \
         version = {{{VERSION}}},\n  year    = {{{}}}\n}}\n",
        &RELEASED[..4]
    )
}

/// The subtitle of the program in a citation.
const TITLE: &str = "the squeezed air film of ultrasonic motors";
/// The release date of the version, ISO 8601.
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
