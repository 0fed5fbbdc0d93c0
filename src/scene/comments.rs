//! Comments that people wrote into a preset file, kept when the scene is written again.

use super::keys::PARAMETERS;
use super::parameter::{Parameter, ParameterKind};
use toml_edit::{Decor, DocumentMut, Item, RawString, Table};

/// `fresh`, the text of a scene, with the comments of `old`, the text of a file that it replaces. Those of a key that is gone come before the next one.
/// Comments that this program writes itself are not carried over. If `old` cannot be read, it has none.
pub(super) fn carried(fresh: &str, old: &str) -> String {
    let (Ok(mut to), Ok(from)) = (fresh.parse::<DocumentMut>(), old.parse::<DocumentMut>()) else {
        return fresh.to_owned();
    };
    let mut homeless = String::new();
    carry(to.as_table_mut(), from.as_table(), &mut homeless);
    homeless.push_str(&foreign("", from.trailing().as_str()));
    let trailing = joined(to.trailing().as_str(), &homeless);
    to.set_trailing(trailing);
    to.to_string()
}

/// Carries the comments of a table over. `homeless`: those of keys that `to` does not have, until a key comes that it has.
fn carry(to: &mut Table, from: &Table, homeless: &mut String) {
    for (name, item) in from {
        let key = from.key(name);
        let header = item.as_table().filter(|table| !table.is_dotted()).map(Table::decor);
        let before = header.or(key.map(|key| key.leaf_decor())).and_then(Decor::prefix);
        homeless.push_str(&foreign(name, before.and_then(RawString::as_str)));
        if let Some(array) = item.as_array() {
            let inside = array.iter().filter_map(|row| row.decor().prefix()).chain([array.trailing()]);
            inside.for_each(|row| homeless.push_str(&foreign(name, row.as_str())));
        }
        let behind = item.as_value().and_then(|value| value.decor().suffix()?.as_str()).unwrap_or_default().trim();
        let own_words = !behind.is_empty() && !is_ours(name, behind);
        match (to.get_mut(name), item) {
            (Some(Item::Table(to)), Item::Table(from)) => {
                if !homeless.is_empty() {
                    put(to.decor_mut(), homeless);
                }
                carry(to, from, homeless);
            }
            (Some(Item::Value(value)), _) => {
                if own_words {
                    value.decor_mut().set_suffix(format!("  {behind}"));
                }
                if let Some(mut key) = to.key_mut(name).filter(|_| !homeless.is_empty()) {
                    put(key.leaf_decor_mut(), homeless);
                }
            }
            (_, Item::Table(from)) => carry(&mut Table::new(), from, homeless),
            _ if own_words => *homeless += &format!("{behind}\n"),
            _ => {}
        }
    }
}

/// Puts comments before a key or the head of a table.
fn put(decor: &mut Decor, homeless: &mut String) {
    let before = joined(decor.prefix().and_then(RawString::as_str), homeless);
    decor.set_prefix(before);
    homeless.clear();
}

/// What stands there, and comments behind it, on lines of their own.
fn joined(there: Option<&str>, comments: &str) -> String {
    let there = there.unwrap_or_default();
    let comments = if there.is_empty() || there == "\n" || there.ends_with("\n\n") {
        comments.trim_start_matches('\n')
    } else {
        comments
    };
    format!("{there}{comments}")
}

/// The lines of `decor`, at the key `leaf`, without those that this program writes; nothing if no comment is left.
fn foreign(leaf: &str, decor: Option<&str>) -> String {
    // What is behind the last line break indents what follows.
    let decor = decor.unwrap_or_default();
    let lines = decor.rsplit_once('\n').map_or(decor, |(lines, _)| lines).split('\n').map(str::trim);
    let lines: Vec<&str> = lines.filter(|line| !is_absent(line) && !is_ours(leaf, line)).collect();
    let comment = lines.iter().any(|line| line.starts_with('#'));
    if comment { lines.join("\n") + "\n" } else { String::new() }
}

/// Whether a line tells of an absent key, as [`Scene::to_toml`](super::Scene::to_toml) writes it.
fn is_absent(line: &str) -> bool {
    let leaf = line.strip_prefix("# ").and_then(|line| line.split_whitespace().next());
    leaf.is_some_and(|leaf| line.contains("; absent: ") && PARAMETERS.iter().any(|parameter| parameter.leaf() == leaf))
}

/// Whether a comment is what this program writes behind a key.
fn is_ours(leaf: &str, comment: &str) -> bool {
    let words = comment.trim_start_matches(['#', ' ']);
    let written = |parameter: &Parameter| match parameter.kind {
        ParameterKind::Rows { columns: [first, second] } => words == format!("[{}, {}]", first.key, second.key),
        _ => words == parameter.about,
    };
    PARAMETERS.iter().any(|parameter| parameter.leaf() == leaf && written(parameter))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    const BY_HAND: &str = "# Bench 3, with the worn rotor.

schema = 1
scene = \"motor\"
name = \"Ours\" # not the paper's

[motor]
# by the makers
waves = 7
load_per_wave_n = 2.45  # spring 4

# what the profilometer says
[film]
min_spacing_nm = 180 # three runs
[rotor]
model = \"table\"
compliance = [
  [1, 1e-9], # guessed
  [7, 1e-10],
]
# end
";

    #[test]
    fn comments_of_a_file_outlive_a_change_of_its_scene() {
        let mut scene = Scene::from_toml(BY_HAND, "by hand").unwrap();
        scene.set("film.min_spacing_nm", "150").unwrap();
        scene.set("motor.load_n", "20").unwrap();
        let written = carried(&scene.to_toml(), BY_HAND);
        assert_eq!(Scene::from_toml(&written, "written").unwrap(), scene);
        let comments = [
            "# Bench 3, with the worn rotor.\n\nschema = 1\n",
            "name = \"Ours\"  # not the paper's\n",
            "# by the makers\nwaves = 7",
            "# spring 4\n",
            "# what the profilometer says\n[film]\n",
            "min_spacing_nm = 150.0  # three runs\n",
            "# guessed\n",
            "# end\n",
        ];
        for comment in comments {
            assert_eq!(written.matches(comment).count(), 1, "{comment}\n{written}");
        }
        // Once more: nothing is written twice, and none of this program's own comments is carried over.
        assert_eq!(carried(&scene.to_toml(), &written), written);
        let fresh = scene.to_toml();
        scene.unset("motor.load_n").unwrap();
        assert_eq!(carried(&scene.to_toml(), &fresh), scene.to_toml());
        assert_eq!(carried(&fresh, "no TOML ["), fresh);
    }
}
