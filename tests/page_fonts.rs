//! The fonts of the page in a browser have every glyph that a text of the program uses and that the fonts of the desktop have.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use eframe::egui::FontDefinitions;
use squeezefilm::platform::{DEJAVU, LIBERATION};
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
fn the_fonts_of_the_page_have_what_texts_use() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut used: BTreeSet<char> = (' '..='~').collect();
    for folder in ["src", "assets", "presets"] {
        letters(&root.join(folder), &mut used);
    }
    assert!(used.contains(&'∇') && used.len() > 200, "{} letters were found", used.len());
    let egui = FontDefinitions::default();
    let egui = |name: &str| egui.font_data[name].bytes().to_vec();
    let fonts = [
        ("Ubuntu-Light", egui("Ubuntu-Light")),
        ("Hack-Regular", egui("Hack")),
        ("DejaVuSans", DEJAVU.to_vec()),
        ("LiberationSans-Regular", LIBERATION.to_vec()),
    ];
    for (name, whole) in fonts {
        let part = std::fs::read(root.join(format!("assets/fonts/page/{name}.ttf"))).unwrap();
        let (whole, part) = (Face::parse(&whole, 0).unwrap(), Face::parse(&part, 0).unwrap());
        let has = |face: &Face, letter| face.glyph_index(letter).is_some();
        let lost: String = used.iter().filter(|&&letter| has(&whole, letter) && !has(&part, letter)).collect();
        assert_eq!(lost, "", "assets/fonts/page/{name}.ttf lacks these: run assets/fonts/page/subset");
    }
}
