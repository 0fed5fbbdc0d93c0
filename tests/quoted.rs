//! What README.md and docs/*.md quote is what the program prints today.
//!
//! Two kinds of text are quotations. In a fence ```` ```console ```` the lines after `$ COMMAND` are what the command prints, errors
//! included. Markdown between `<!-- output of: COMMAND -->` and `<!-- end -->` is the command's output. A command is for a shell, in
//! an empty folder, where `squeezefilm` is the program just built, or the one that the variable `SQUEEZEFILM` names;
//! `cargo run --release --example NAME …` is called in this process. Quotations that take longer, ```` ```console slow ```` and
//! `<!-- slow output of: … -->`, are left to `cargo test --test quoted -- --ignored`. Times depend on the machine and are not compared.
//!
//! tests/results.md quotes what is computed in many cases, digit by digit, so that no change moves a number unnoticed. [`NUMBERS`] makes
//! its lines.
//!
//! So are the figures of the gallery ([`PICTURES`]) what the program draws, to a hundredth of a point.
//!
//! `docs/renew` writes what is printed and drawn today into the documents.
#![cfg(unix)]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on fails")]

#[allow(dead_code, reason = "its main is not called")]
#[path = "../examples/error_coverage.rs"]
mod error_coverage;
#[allow(dead_code, reason = "its main is not called")]
#[path = "../examples/schemes.rs"]
mod schemes;
#[allow(dead_code, reason = "its main is not called")]
#[path = "../examples/validation.rs"]
mod validation;

mod scenes;

use squeezefilm::atomic::write_file;
use squeezefilm::control::Cancel;
use squeezefilm::export::figure::{
    self, Axis, Band, Categories, Colour, Figure, Grid, Legend, Line, Map, Mark, Marker, Panel, Points, Shading, Shape,
    Style, Text, Width,
};
use squeezefilm::export::figures;
use squeezefilm::export::figures::compare::DrawnRun;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::recording::Recording;
use squeezefilm::solve::{Settings, solve};
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const EXAMPLE: &str = "cargo run --release --example ";

/// Commands that end with a folder, and which of the figures there are which of docs/gallery, or of another folder.
const PICTURES: [(&str, &[(&str, &str)]); 18] = [
    (
        "solve fundamental --fidelity fine",
        &[("wave", "wave"), ("loads", "loads"), ("map", "map"), ("torque", "torque")],
    ),
    ("solve plate-crossover --fidelity fine", &[("loop", "plate-loop"), ("exact", "plate-exact")]),
    ("sweep fundamental --vary stator.frequency_khz=3:300:25:log", &[("sweep", "sweep")]),
    (
        "sweep fundamental --vary stator.frequency_khz=3:300:16:log --vary film.min_spacing_nm=20:500:16:log",
        &[("sweep", "sweep-map")],
    ),
    (
        "sweep fundamental --set film.gas=air --set film.slip=fukui-kaneko --vary film.ambient_pressure_kpa=0.1:101.325:25:log",
        &[("sweep", "vacuum")],
    ),
    ("sensitivity fundamental --fidelity fine", &[("sensitivity", "sensitivity")]),
    ("startup frequency-100khz", &[("startup", "startup")]),
    ("compare fundamental min-spacing-100nm tooth-radius-3m", &[("loads", "compare-loads")]),
    (
        "compare fundamental levitating --fidelity draft",
        &[
            ("waves", "../../tests/figures/compare-waves"),
            ("torque", "../../tests/figures/compare-torque"),
            ("maps", "../../tests/figures/compare-maps"),
        ],
    ),
    (
        "compare plate-crossover plate-trapped --fidelity draft",
        &[
            ("loads", "../../tests/figures/plates-loads"),
            ("loops", "../../tests/figures/plates-loops"),
            ("profiles", "../../tests/figures/plates-profiles"),
        ],
    ),
    (
        "sweep fundamental --fidelity draft --vary film.slip=none,first-order --vary film.min_spacing_nm=100:300:3",
        &[("sweep", "../../tests/figures/sweep-words")],
    ),
    (
        "solve levitating --fidelity draft",
        &[("convergence", "../../tests/figures/convergence"), ("wave", "../../tests/figures/floating-wave")],
    ),
    ("startup floating-disc --fidelity draft --cycles 40", &[("startup", "../../tests/figures/drop")]),
    (
        "solve floating-disc --fidelity draft",
        &[("exact", "../../tests/figures/disc-exact"), ("profile", "../../tests/figures/disc-profile")],
    ),
    (
        "stability --map load-amplitude --cells 4 --method auto --fidelity draft",
        &[("stability", "../../tests/figures/stability")],
    ),
    (
        "sensitivity fundamental --fidelity draft --keys film.min_spacing_nm --uncertainty film.min_spacing_nm=20% --monte-carlo 60",
        &[("monte-carlo", "../../tests/figures/monte-carlo")],
    ),
    (
        "fit fundamental --data table1 --skip rotor_width_0.6mm --vary film.min_spacing_nm=150:250 --vary rotor.decay_length_mm=2:8 --fidelity draft",
        &[
            ("fit", "../../tests/figures/fit"),
            ("residuals", "../../tests/figures/residuals"),
            ("correlation", "../../tests/figures/correlation"),
        ],
    ),
    (
        "fit fundamental --maximise film_load_n --vary stator.frequency_khz=20:60 --vary film.min_spacing_nm=100:400 --fidelity draft",
        &[("optimum", "../../tests/figures/optimum")],
    ),
];

/// A command, and the lines of a document that are its output.
#[derive(Debug, PartialEq)]
struct Quotation {
    command: String,
    slow: bool,
    lines: Range<usize>,
}

fn quotations(lines: &[&str]) -> Vec<Quotation> {
    let mut found = Vec::new();
    let until = |from: usize, ends: &dyn Fn(&str) -> bool| {
        from + lines[from..].iter().position(|line| ends(line)).expect("a quotation has an end")
    };
    for (number, line) in lines.iter().enumerate() {
        let after = number + 1;
        if matches!(*line, "```console" | "```console slow") {
            let end = until(after, &|line| line == "```");
            let mut at = after;
            while at < end {
                let command = lines[at].strip_prefix("$ ").expect("a console begins with a command").to_owned();
                let next = until(at + 1, &|line| line == "```" || line.starts_with("$ "));
                found.push(Quotation { command, slow: line.ends_with("slow"), lines: at + 1..next });
                at = next;
            }
        } else if let Some((kind, command)) = line.strip_suffix(" -->").and_then(|line| line.split_once("output of: "))
        {
            let slow = kind == "<!-- slow ";
            assert!(slow || kind == "<!-- ", "{line}");
            let end = until(after, &|line| line == "<!-- end -->");
            found.push(Quotation { command: command.to_owned(), slow, lines: after..end });
        }
    }
    found
}

fn program() -> PathBuf {
    std::env::var_os("SQUEEZEFILM").map_or_else(|| env!("CARGO_BIN_EXE_squeezefilm").into(), PathBuf::from)
}

/// For the shell: `numbers ARGUMENTS` are the numbers that `squeezefilm ARGUMENTS` prints as JSON, with their keys; `sums FILE` are, of each
/// column of a CSV file, the sum and the sum weighted by the number of the line. Words count for nothing, and times are left out.
const NUMBERS: &str = r#"
filled() { paste -sd ' ' - | fold -sw 150; }
numbers() {
    squeezefilm "$@" --json 2>/dev/null |
        sed -nE 's/^ *"([a-z_0-9]*)": (-?[0-9][^,]*|true|false),?$/\1 \2/p' |
        awk '$1 != "wall_s" && $1 != "schema" { print $1, $2 ~ /[0-9]/ ? sprintf("%.8g", $2) : $2 }' | filled
}
sums() {
    awk -F, '
        NR == 1 { for (i = 1; i <= NF; i++) name[i] = $i; next }
        { for (i = 1; i <= NF; i++) { sum[i] += $i; weighted[i] += NR * $i } }
        END { for (i = 1; i in name; i++) printf "%s %.8g %.8g\n", name[i], sum[i], weighted[i] }
    ' "$1" | filled
}
"#;

/// What a command prints.
fn output(command: &str) -> String {
    if let Some(example) = command.strip_prefix(EXAMPLE) {
        let words: Vec<String> = example.split_whitespace().map(str::to_owned).collect();
        return match words[0].as_str() {
            "schemes" => schemes::report().unwrap(),
            "error_coverage" => error_coverage::report(&words[1..]).unwrap().0,
            "validation" => validation::report(&words[1..]).unwrap(),
            other => panic!("{other} is no example that can be quoted"),
        };
    }
    let folder = tempfile::tempdir().unwrap();
    let program = fs::canonicalize(program()).unwrap();
    let shell = Command::new("sh")
        .args(["-c", &format!("squeezefilm() {{ \"$SQUEEZEFILM\" \"$@\"; }}\n{NUMBERS}exec 2>&1\n{command}")])
        .env("SQUEEZEFILM", program)
        .current_dir(&folder)
        .stdin(Stdio::null())
        .output()
        .unwrap();
    String::from_utf8(shell.stdout).unwrap()
}

/// The words of a text without what depends on the machine: times, `12.3 ms`, and which setting is `best` for its time.
fn compared(text: &[&str]) -> Vec<String> {
    let unit =
        |word: &str| matches!(word.trim_end_matches([':', ',', ';', '.', '|']), "ns" | "µs" | "ms" | "s" | "min");
    // How long a time is moves the ends of lines that are filled.
    let words: Vec<&str> =
        text.iter().flat_map(|line| line.split_whitespace()).filter(|word| *word != "best").collect();
    let masked = |number: usize| {
        let time = words.get(number + 1).is_some_and(|next| unit(next)) && words[number].parse::<f64>().is_ok();
        let after = number > 0 && unit(words[number]) && words[number - 1].parse::<f64>().is_ok();
        if time || after { "time".to_owned() } else { words[number].to_owned() }
    };
    (0..words.len()).map(masked).collect()
}

/// Compares the quotations of every document, or writes what is printed now if `UPDATE_QUOTED` is set.
fn check(slow: bool) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let docs = fs::read_dir(root.join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let mut documents: Vec<PathBuf> = docs.filter(|path| path.extension().is_some_and(|end| end == "md")).collect();
    documents.extend(["README.md", "tests/results.md"].map(|path| root.join(path)));
    documents.sort();
    let update = std::env::var_os("UPDATE_QUOTED").is_some();
    let (mut count, mut stale) = (0, String::new());
    for path in documents {
        let text = fs::read_to_string(&path).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        let mut renewed: Vec<String> = lines.iter().map(|line| (*line).to_owned()).collect();
        for quotation in quotations(&lines).iter().rev().filter(|quotation| quotation.slow == slow) {
            count += 1;
            let printed = output(&quotation.command);
            let now: Vec<&str> = printed.trim_matches('\n').lines().map(str::trim_end).collect();
            let quoted = &lines[quotation.lines.clone()];
            let same = compared(quoted) == compared(&now);
            if !same {
                stale.push_str(&format!("{}:{}: {}\n", path.display(), quotation.lines.start, quotation.command));
                stale.push_str(&format!("quoted:\n{}\nprinted:\n{}\n\n", quoted.join("\n"), now.join("\n")));
            }
            // Times are renewed together with the slow quotations, which are measured in a release build.
            if !same || slow {
                let blank = if lines[quotation.lines.end] == "<!-- end -->" { &[""][..] } else { &[] };
                let content = [blank, &now, blank].concat();
                renewed.splice(quotation.lines.clone(), content.iter().map(|line| (*line).to_owned()));
            }
        }
        let renewed = renewed.join("\n") + "\n";
        if update && renewed != text {
            write_file(&path, |out| out.write_all(renewed.as_bytes())).unwrap();
        }
    }
    assert!(count > 0, "nothing is quoted");
    assert!(update || stale.is_empty(), "{stale}docs/renew writes what is printed today");
}

#[test]
fn what_the_documents_quote_is_what_is_printed() {
    check(false);
}

/// `cargo test --test quoted -- --ignored`
#[test]
#[ignore = "minutes, most of them for the paper's method"]
fn what_the_documents_quote_is_what_is_printed_slow() {
    check(true);
}

/// The words and numbers of a figure, without the pixels of its maps.
fn drawn(svg: &str) -> Vec<&str> {
    let apart = |c: char| c.is_whitespace() || matches!(c, ',' | '"' | '<' | '>' | '&' | ';');
    svg.split(apart).filter(|word| !word.is_empty() && !word.starts_with("data:") && word.len() < 200).collect()
}

/// A stored picture, by its path from docs/gallery without extension, is what is drawn now, to a hundredth of a point.
fn same_picture(picture: &str, now: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/gallery").join(picture).with_extension("svg");
    if std::env::var_os("UPDATE_QUOTED").is_some() {
        write_file(&path, |out| out.write_all(now.as_bytes())).unwrap();
        return;
    }
    let stored = fs::read_to_string(path).unwrap();
    let (now, stored) = (drawn(now), drawn(&stored));
    // Places are above 1, stated errors and most ends of axes below.
    let near = |a: &str, b: &str| match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => (a - b).abs() <= if a.abs() < 1.0 { 1e-6 * a.abs() } else { 0.01 },
        _ => a == b,
    };
    let other = now.iter().zip(&stored).find(|(now, stored)| !near(now, stored));
    assert_eq!((other, now.len()), (None, stored.len()), "{picture}.svg; docs/renew pictures draws it anew");
}

/// Panels with every kind of layer and scale: curves that leave the axes, contours of a field with a hole, legends inside and above the axes.
fn panels_of_every_kind() -> Vec<Panel> {
    let wave = |x: f64, k: f64| (k * x).sin() * (1.0 + 0.1 * x);
    let along = |count: i32, step: f64| (0..=count).map(move |i| step * f64::from(i));
    let line =
        |name: &str, k: f64, nth: usize| Line::new(name, along(40, 0.25).map(|x| [x, wave(x, k)]), Style::nth(nth));
    let curves = Panel::new("(a) H_m and σ²", Axis::new("x", "mm"), Axis::new("load", "N").fixed(-1.2, 1.0))
        .layers([line("film", 1.3, 0), line("contact", 0.7, 1)])
        .layer(Line { right: true, ..line("on the right", 2.1, 3) })
        .layer(Mark::vertical(3.3, "begins"))
        .layer(Mark::horizontal(0.25, "limit"))
        .layer(Text::new([7.0, -0.9], "a place"));
    let curves = Panel { right: Some(Axis::new("torque", "N·m")), ..curves };
    let powers = |power: i32| (-4..=6).map(move |i| [10f64.powi(i), 3.0 * 10f64.powi(-i * power)]);
    let decades = Panel::new("(b)", Axis::new("σ", "").log(), Axis::new("error", "").log())
        .layers([
            Line::new("first order", powers(1), Style::unmarked(0)),
            Line::new("second", powers(2), Style::quiet()),
        ])
        .layer(Points::new("measured", powers(1), Colour::CONTACT, Marker::hollow(Shape::Diamond)))
        .height(30.0);
    let (xs, ys): (Vec<f64>, Vec<f64>) = (along(9, 0.4).map(|x| x.powf(1.4)).collect(), along(7, 0.2).collect());
    let hill = |x: f64, y: f64| if x > 4.0 && y > 1.2 { f64::NAN } else { 40.0 * wave(x, 1.7) * (2.0 * y).cos() };
    let values = xs.iter().flat_map(|x| ys.iter().map(move |y| hill(*x, *y))).collect();
    let grid = Grid { x: xs.clone(), y: ys.clone(), values };
    let field = Map { label: "pressure".into(), unit: "kPa".into(), grid, contours: Some(1e-3), ..Map::default() };
    let cells = Map { shading: Shading::Cells, contours: None, ..field.clone() };
    let kinds = xs.iter().flat_map(|x| ys.iter().map(move |y| (3.0 * x + 5.0 * y) as usize % 3)).collect();
    let kinds = Categories {
        x: xs,
        y: ys,
        values: kinds,
        kinds: vec![
            ("solved".into(), Colour::FILM),
            ("refused".into(), Colour::CONTACT),
            ("other".into(), Colour::BLACK),
        ],
    };
    let plane = |title: &str| Panel::new(title, Axis::new("x", "mm"), Axis::new("y", "mm")).height(24.0);
    let scattered = || along(12, 1.0).map(|x| [x, 250.0 + 90.0 * wave(x, 1.9)]);
    let mut dots = Points::new("computed", scattered(), Colour::BLACK, Marker::solid(Shape::Circle));
    dots.errors = along(12, 4.0).collect();
    let band = Band::new(
        "a band whose name is too long for the axes of a column",
        scattered().map(|[x, y]| [x, y - 60.0, y + 45.0]),
        Colour::FILM,
    );
    let counted =
        Panel::new("(f)", Axis::new("harmonic", "").whole(), Axis::new("compliance", "nm/N")).layer(band).layer(dots);
    vec![
        curves,
        decades,
        plane("(c)").layer(field),
        plane("(d) cells").layer(cells),
        plane("(e)").layer(kinds),
        counted.legend(Legend::Auto),
    ]
}

#[test]
fn every_kind_of_layer_is_drawn_as_it_was() {
    for (name, columns, width) in [
        ("layers-column", 1, Width::Millimetres(85.0)),
        ("layers-page", 2, Width::Page),
        ("layers-narrow", 2, Width::Millimetres(100.0)),
    ] {
        let panels = panels_of_every_kind();
        let figure = Figure { columns, width, panels, ..Figure::new("Every kind of layer") };
        same_picture(&format!("../../tests/figures/{name}"), &figure::to_svg(&figure));
    }
}

#[test]
fn figures_of_the_gallery_are_what_is_drawn() {
    for (command, pictures) in PICTURES {
        let folder = tempfile::tempdir().unwrap();
        let words = command.split(' ').chain(["--figures", "svg", "--out"]);
        let done = Command::new(program()).args(words).arg(folder.path()).output().unwrap();
        // A start-up that is still moving ends with 3.
        let well = done.status.success() || command.starts_with("startup") && done.status.code() == Some(3);
        assert!(well, "{command}: {}", String::from_utf8_lossy(&done.stderr));
        for (file, picture) in pictures {
            same_picture(picture, &fs::read_to_string(folder.path().join(file).with_extension("svg")).unwrap());
        }
    }
}

#[test]
fn frames_of_animations_are_what_is_drawn() {
    let solved = |preset: &str| {
        let problem = scenes::problem(preset, &[]);
        let settings = Settings { fidelity: Fidelity::Draft, ..Settings::default() };
        let solution = solve(&problem, &settings, &mut (), &Cancel::new()).unwrap();
        (problem, solution.recording)
    };
    let motors = ["fundamental", "levitating"].map(solved);
    let plates = ["plate-crossover", "plate-trapped"].map(solved);
    let motors: Vec<_> = motors.iter().map(|(problem, fields)| (problem.scenario.motor().unwrap(), fields)).collect();
    let plates: Vec<_> = plates.iter().map(|(problem, fields)| (problem.scenario.plate().unwrap(), fields)).collect();
    let frames = [
        ("motor", figures::motor::moving(motors[0].0, motors[0].1, 7)),
        ("plate", figures::plate::moving(plates[0].0, plates[0].1, 7)),
        ("motors", figures::compare::moving_motors(&runs(&motors), 0.3)),
        ("plates", figures::compare::moving_plates(&runs(&plates), 0.3)),
    ];
    for (name, figure) in frames {
        same_picture(&format!("../../tests/figures/frame-{name}"), &figure::to_svg(&figure));
    }
}

/// Scenes and their fields, each with the style of its place in a comparison.
fn runs<'a, S>(solved: &[(&'a S, &'a Recording)]) -> Vec<DrawnRun<'a, S>> {
    let run = |(index, (scene, recording))| DrawnRun { name: "run", scene, recording, style: Style::unmarked(index) };
    solved.iter().copied().enumerate().map(run).collect()
}

#[test]
fn accuracies_are_those_of_the_fidelities() {
    let readme = include_str!("../README.md");
    let percent = Fidelity::ALL.map(|level| (100.0 * level.accuracy()).to_string()).join(", ");
    let names = Fidelity::ALL.map(Fidelity::name).join(", ");
    assert!(readme.contains(&format!("{names}: {percent} %")), "{names}: {percent} %");
}

#[test]
fn a_quotation_is_found_and_only_its_times_are_free() {
    let text = "a\n```console\n$ one\n1\n2\n$ two\n```\n<!-- slow output of: cargo run -->\n\n| 3 |\n\n<!-- end -->";
    let found = quotations(&text.lines().collect::<Vec<_>>());
    let quotation = |command: &str, slow, lines| Quotation { command: command.to_owned(), slow, lines };
    assert_eq!(
        found,
        [quotation("one", false, 3..5), quotation("two", false, 6..6), quotation("cargo run", true, 8..11)]
    );

    let words = "Cost:   2.69 ms: 306 steps of 36 s each, α 0.2461";
    assert_eq!(compared(&["", words]), compared(&["Cost: 1.1 s: 306 steps of 5 min each, α 0.2461  best"]));
    for other in [words.replace("0.2461", "0.2462"), words.replace("306", "307"), words.replace("2.69 ms", "2.69 mm")] {
        assert_ne!(compared(&[words]), compared(&[&other]), "{other}");
    }
    assert_eq!(output("squeezefilm --version | tr a-z A-Z").trim(), concat!("SQUEEZEFILM ", env!("CARGO_PKG_VERSION")));
    assert_eq!(output("squeezefilm solve nowhere --json | head -n 1").matches("error: ").count(), 1);
}
