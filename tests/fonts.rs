//! The fonts with fewer glyphs have every glyph that a text of the program uses and that the whole fonts have.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use epaint_default_fonts::{HACK_REGULAR, UBUNTU_LIGHT};
use squeezefilm::platform::{dejavu, liberation};
use std::collections::BTreeSet;
use std::path::Path;
use ttf_parser::Face;

fn letters(folder: &Path, found: &mut BTreeSet<char>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let is_text = path.extension().is_some_and(|kind| ["rs", "toml", "md", "csv"].iter().any(|text| kind == *text));
        if path.is_dir() {
            letters(&path, found);
        } else if is_text {
            found.extend(std::fs::read_to_string(path).unwrap().chars());
        }
    }
}

#[test]
fn reduced_fonts_have_what_texts_use() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut used: BTreeSet<char> = (' '..='~').collect();
    for folder in ["src", "solver/src", "assets", "presets"] {
        letters(&root.join(folder), &mut used);
    }
    assert!(used.contains(&'∇') && used.len() > 200, "{} letters were found", used.len());
    let fonts = [
        ("Ubuntu-Light", UBUNTU_LIGHT),
        ("Hack-Regular", HACK_REGULAR),
        ("DejaVuSans", dejavu()),
        ("LiberationSans-Regular", liberation()),
    ];
    for (name, whole) in fonts {
        let part = std::fs::read(root.join(format!("assets/fonts/reduced/{name}.ttf"))).unwrap();
        let (whole, part) = (Face::parse(whole, 0).unwrap(), Face::parse(&part, 0).unwrap());
        let has = |face: &Face, letter| face.glyph_index(letter).is_some();
        let lost: String = used.iter().filter(|&&letter| has(&whole, letter) && !has(&part, letter)).collect();
        assert_eq!(lost, "", "assets/fonts/reduced/{name}.ttf lacks these: run assets/fonts/reduced/reduce");
    }
}
