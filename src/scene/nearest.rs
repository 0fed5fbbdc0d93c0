//! The known name nearest to a mistyped one.

/// Least similarity (Jaro–Winkler, 0 to 1) of a name that is offered in place of another one.
const ALIKE: f64 = 0.76;

/// Longest name that is compared with others \[bytes\], because the time of a comparison is proportional to both lengths.
const LONGEST: usize = 100;

/// The candidate that is most similar to `name`, if one is similar enough.
pub(crate) fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if name.len() > LONGEST {
        return None;
    }
    let scored = candidates.into_iter().map(|candidate| (strsim::jaro_winkler(name, candidate), candidate));
    // On a tie the first candidate wins, the order of the table.
    let best = scored.reduce(|best, next| if next.0 > best.0 { next } else { best })?;
    (best.0 >= ALIKE).then_some(best.1)
}

/// The dotted key nearest to `key`: one with the same last part in another table, or else the most similar one in the same table, or else
/// the most similar one anywhere.
pub(super) fn nearest_key<'a>(key: &str, candidates: &[&'a str]) -> Option<&'a str> {
    fn split(key: &str) -> (&str, &str) {
        key.rsplit_once('.').unwrap_or(("", key))
    }
    let (table, leaf) = split(key);
    if let Some(elsewhere) = candidates.iter().find(|candidate| split(candidate).1 == leaf) {
        return Some(elsewhere);
    }
    let alike = |same_table: bool| {
        let candidates = || candidates.iter().filter(|candidate| !same_table || split(candidate).0 == table);
        let found = nearest(leaf, candidates().map(|candidate| split(candidate).1))?;
        candidates().find(|candidate| split(candidate).1 == found).copied()
    };
    alike(true).or_else(|| alike(false))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::PARAMETERS;

    #[test]
    fn a_mistyped_key_finds_its_neighbour() {
        let keys: Vec<_> = PARAMETERS.iter().map(|p| p.key).collect();
        for (mistyped, meant) in [
            ("film.min_spacing", "film.min_spacing_nm"),
            ("film.min_spacing_um", "film.min_spacing_nm"),
            ("motor.wave", "motor.waves"),
            ("stator.freq_khz", "stator.frequency_khz"),
            ("motor.tooth_radius_m", "stator.tooth_radius_m"),
            ("waves", "motor.waves"),
            ("film.visocsity_upa_s", "film.viscosity_upa_s"),
            ("nmae", "name"),
        ] {
            assert_eq!(nearest_key(mistyped, &keys), Some(meant), "{mistyped}");
        }
        assert_eq!(nearest_key("film.qqq", &keys), None);
    }
}
