//! Comments that people wrote into a preset file, kept when the scene is written again.

use super::keys::PARAMETERS;
use super::parameter::{Parameter, ParameterKind};
use toml_edit::{Decor, DocumentMut, Item, RawString, Table, Value};

/// `fresh`, the text of a scene, with the comments of `old`, the text of a file that it replaces. The comments of a key that is
/// gone come before the next key. Comments that this program writes itself are not carried over. If `old` cannot be read, none are.
pub(super) fn carried(fresh: &str, old: &str) -> String {
    let (Ok(mut to), Ok(from)) = (fresh.parse::<DocumentMut>(), old.parse::<DocumentMut>()) else {
        return fresh.to_owned();
    };
    let mut homeless = String::new();
    carry(to.as_table_mut(), from.as_table(), &mut homeless);
    homeless.push_str(&foreign("", from.trailing().as_str().unwrap_or_default().trim_end()));
    let trailing = joined(to.trailing().as_str(), &homeless);
    to.set_trailing(trailing);
    without_old_assumptions(&to.to_string(), &to)
}

/// Carries the comments of a table over. `homeless` holds the comments of keys that `to` does not have, until a key comes that `to` has.
fn carry(to: &mut Table, from: &Table, homeless: &mut String) {
    for (name, item) in from {
        let key = from.key(name);
        let header = item.as_table().filter(|table| !table.is_dotted()).map(Table::decor);
        let before = header.or(key.map(|key| key.leaf_decor())).and_then(Decor::prefix);
        homeless.push_str(&foreign(name, before.and_then(RawString::as_str).unwrap_or_default()));
        if let Some(array) = item.as_array() {
            let around = |row: &Value| [row.decor().prefix(), row.decor().suffix()].map(|decor| decor.cloned());
            let inside = array.iter().flat_map(around).flatten().chain([array.trailing().clone()]);
            for row in inside {
                homeless.push_str(&foreign(name, row.as_str().unwrap_or_default().trim_end()));
            }
        }
        let heads = item.as_array_of_tables().into_iter().flatten().chain(item.as_table());
        for table in heads {
            let [before, behind] = [table.decor().prefix(), table.decor().suffix()]
                .map(|decor| decor.and_then(RawString::as_str).unwrap_or_default());
            if item.is_array_of_tables() {
                homeless.push_str(&foreign(name, before));
            }
            homeless.push_str(&foreign(name, behind));
        }
        // Tables of an array are written as its rows.
        for table in item.as_array_of_tables().into_iter().flatten() {
            carry(&mut Table::new(), table, homeless);
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

/// `text` without the comments on assumptions of [`NewMotor`](super::new_motor::NewMotor) that this scene no longer makes.
fn without_old_assumptions(text: &str, scene: &DocumentMut) -> String {
    let held = |line: &str| {
        let pair = line.strip_prefix("# Assumed: ").and_then(|rest| rest.split_once(" = "));
        let Some(((table, leaf), value)) = pair.and_then(|(key, value)| Some((key.split_once('.')?, value))) else {
            return true;
        };
        let now = scene.get(table).and_then(|table| table.get(leaf)).and_then(Item::as_value);
        let now = now.map(|now| now.to_string().trim().trim_matches('"').to_owned()).unwrap_or_default();
        let value = value.split([' ', ':']).next().unwrap_or_default();
        match (value.parse::<f64>(), now.split(' ').next().unwrap_or_default().parse::<f64>()) {
            (Ok(value), Ok(now)) => value == now,
            _ => now.starts_with(value),
        }
    };
    text.split_inclusive('\n').filter(|line| held(line)).collect()
}

/// Puts comments before a key or the head of a table.
fn put(decor: &mut Decor, homeless: &mut String) {
    let before = joined(decor.prefix().and_then(RawString::as_str), homeless);
    decor.set_prefix(before);
    homeless.clear();
}

/// The text that is there already, followed by comments on lines of their own.
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
fn foreign(leaf: &str, decor: &str) -> String {
    // What is behind the last line break indents what follows.
    let lines = decor.trim_end_matches([' ', '\t']).lines().map(str::trim);
    let lines: Vec<&str> = lines.filter(|line| !is_absent(line) && !is_ours(leaf, line)).collect();
    let comment = lines.iter().any(|line| line.starts_with('#'));
    if comment { lines.join("\n") + "\n" } else { String::new() }
}

/// Whether a line tells of an absent key, as [`Scene::to_toml`](super::Scene::to_toml) writes it.
fn is_absent(line: &str) -> bool {
    let leaf = line.strip_prefix("# ").and_then(|line| line.split_whitespace().next());
    leaf.is_some_and(|leaf| line.contains("; absent: ") && PARAMETERS.iter().any(|parameter| parameter.leaf() == leaf))
}

/// Whether a comment is the one that this program writes behind a key.
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
[rotor] # worn
model = \"table\"
compliance = [
  [1, 1e-9], # guessed
  [7, 1e-10] # measured
]
# almost
# end";

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
            "# worn\n",
            "# guessed\n",
            "# measured\n",
            "# almost\n# end",
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

    #[test]
    fn comments_of_tables_of_an_array_stay_and_old_assumptions_go() {
        let ring = "schema = 1\nscene = \"motor\"\n[rotor]\nmodel = \"ring\"\n# the lip\n[[rotor.part]] # of steel\n# turned\nname = \"lip\" # narrow\n";
        let fresh = crate::scene::presets::find("ring-rotor").unwrap().to_toml();
        let written = carried(&fresh, ring);
        for comment in ["# the lip\n", "# of steel\n", "# turned\n", "# narrow\n"] {
            assert_eq!(written.matches(comment).count(), 1, "{comment}\n{written}");
        }
        assert_eq!(Scene::from_toml(&written, "written").unwrap(), crate::scene::presets::find("ring-rotor").unwrap());
        let new = "# Assumed: motor.dry_friction = 0.3: usual.\n# Assumed: film.min_spacing_nm = 200 nm: as there.\n\n";
        let mut scene = Scene::motor();
        let old = format!("{new}{}", scene.to_toml());
        scene.set("motor.dry_friction", "0.5").unwrap();
        let written = carried(&scene.to_toml(), &old);
        assert!(!written.contains("usual") && written.contains("# Assumed: film.min_spacing_nm"), "{written}");
    }
}
