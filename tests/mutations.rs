//! Preset files and `--set` strings with bytes changed at random: a fault or a scene, never a panic. `fuzz/` looks longer.

mod fuzzed;

use squeezefilm::scene::{PARAMETERS, presets};

/// Numbers that repeat: splitmix64.
struct Random(u64);

impl Random {
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % count as u64) as usize
    }
}

/// Bytes that mean something in a preset.
const PIECES: [&str; 24] = [
    "=",
    "\n",
    "\"",
    "[",
    "]",
    "{",
    "}",
    ".",
    "-",
    "e",
    "0",
    "9",
    "1e308",
    "1e-308",
    "nan",
    "inf",
    "-inf",
    "#",
    "none",
    "true",
    "\u{feff}",
    "µ",
    "numerics.",
    "schema",
];

fn mutate(bytes: &mut Vec<u8>, random: &mut Random) {
    for _ in 0..=random.below(3) {
        let at = random.below(bytes.len() + 1);
        match random.below(6) {
            0 if at < bytes.len() => bytes[at] = random.below(256) as u8,
            1 if at < bytes.len() => bytes[at] = b'0' + random.below(10) as u8,
            2 if at < bytes.len() => drop(bytes.remove(at)),
            3 => {
                let end = (at + random.below(40)).min(bytes.len());
                let copy = bytes[at..end].to_vec();
                let to = random.below(bytes.len() + 1);
                bytes.splice(to..to, copy);
            }
            4 => drop(bytes.drain(at..(at + random.below(20)).min(bytes.len()))),
            _ => drop(bytes.splice(at..at, PIECES[random.below(PIECES.len())].bytes())),
        }
    }
}

#[test]
fn a_mutated_preset_is_a_scene_or_a_fault() {
    let mut random = Random(1992);
    let mut scenes = 0;
    for round in 0..3000 {
        let mut bytes = presets::BUILT_IN[random.below(presets::BUILT_IN.len())].toml.as_bytes().to_vec();
        mutate(&mut bytes, &mut random);
        scenes += usize::from(fuzzed::preset(&bytes, round % 30 == 0));
    }
    // Both happen: changes are small, and most of a preset is what it has to be.
    println!("{scenes} of 3000 are scenes");
    assert!((300..2700).contains(&scenes), "{scenes}");
}

#[test]
fn a_mutated_set_is_a_change_or_a_fault() {
    let mut random = Random(41);
    let mut scenes = 0;
    for round in 0..3000 {
        let mut lines = String::new();
        for _ in 0..=random.below(3) {
            let key = &PARAMETERS[random.below(PARAMETERS.len())];
            let value = match (key.range(), random.below(3)) {
                (Some(range), 0) => range.min.to_string(),
                (Some(range), 1) => range.max.to_string(),
                (Some(range), _) => (range.min + (range.max - range.min) * random.below(1000) as f64 / 1e3).to_string(),
                (None, _) => PIECES[random.below(PIECES.len())].to_owned(),
            };
            lines += &format!("{}={value}\n", key.key);
        }
        let mut bytes = lines.into_bytes();
        if random.below(2) == 0 {
            mutate(&mut bytes, &mut random);
        }
        scenes += usize::from(fuzzed::set(&bytes, round % 30 == 0));
    }
    println!("{scenes} of 3000 are scenes");
    assert!((300..2970).contains(&scenes), "{scenes}");
}
