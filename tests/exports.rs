//! What leaves the program, read back by readers that are not ours.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod program;

use npyz::NpyFile;
use program::{done, err, json, out, squeezefilm};
use roxmltree::{Document, Node, ParsingOptions};
use serde_json::Value;
use squeezefilm::analysis::compare::runs;
use squeezefilm::analysis::quantity::Quantity;
use squeezefilm::control::Cancel;
use squeezefilm::export::compare::all_figures;
use squeezefilm::export::figure::Layer;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::scene::presets;
use squeezefilm::solve::Settings;
use std::collections::BTreeMap;
use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// A report as XML. Nothing in it comes from elsewhere.
fn page(html: &str) -> Document<'_> {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let page = Document::parse_with_options(html, options).unwrap();
    for node in page.descendants().filter(|node| node.is_element()) {
        let name = node.tag_name().name();
        assert!(!["script", "link", "iframe", "object", "embed"].contains(&name), "{name}");
        for attribute in node.attributes().filter(|attribute| ["src", "href"].contains(&attribute.name())) {
            assert!(attribute.value().starts_with("data:") || attribute.value().starts_with('#'), "{name}");
        }
    }
    page
}

fn named<'a, 'i>(node: Node<'a, 'i>, name: &'static str) -> impl Iterator<Item = Node<'a, 'i>> {
    node.descendants().filter(move |node| node.tag_name().name() == name)
}

fn count(page: &Document<'_>, name: &'static str) -> usize {
    named(page.root(), name).count()
}

/// The words of an element.
fn words(node: Node<'_, '_>) -> String {
    node.descendants().filter_map(|node| if node.is_text() { node.text() } else { None }).collect()
}

fn tables(page: &Document<'_>) -> Vec<Vec<Vec<String>>> {
    let row = |row: Node<'_, '_>| row.children().filter(Node::is_element).map(words).collect();
    named(page.root(), "table").map(|table| named(table, "tr").map(row).collect()).collect()
}

/// Arrays of the archive in a folder, numbers alone, with their shapes: the zip by the zip crate, the arrays by npyz.
fn arrays(folder: &Path) -> BTreeMap<String, (Vec<u64>, Vec<f64>)> {
    let mut archive = zip::ZipArchive::new(fs::File::open(folder.join("fields.npz")).unwrap()).unwrap();
    let mut arrays = BTreeMap::new();
    for i in 0..archive.len() {
        let mut file = archive.by_index(i).unwrap();
        assert_eq!(file.compression(), zip::CompressionMethod::Stored);
        let name = file.name().unwrap().strip_suffix(".npy").unwrap().to_owned();
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).unwrap();
        let array = NpyFile::new(&bytes[..]).unwrap();
        if array.dtype().descr().contains("f8") {
            let shape = array.shape().to_vec();
            arrays.insert(name, (shape, array.into_vec::<f64>().unwrap()));
        }
    }
    arrays
}

#[test]
fn an_npz_reads_back_to_what_was_solved() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let arguments = ["solve", "fundamental", "--fidelity", "draft", "--figures", "none", "--json", "--out", path];
    let summary = json(&done(&arguments));
    let first = fs::read(folder.path().join("fields.npz")).unwrap();
    let arrays = arrays(folder.path());
    let (shape, film) = &arrays["film_n_per_m"];
    let [frames, teeth, nodes] = shape[..] else { panic!("{shape:?}") };
    assert_eq!((frames, teeth), (summary["stats"]["steps_per_cycle"].as_u64().unwrap(), 9));
    let lengths = &arrays["node_length_m"].1;
    assert_eq!(lengths.len() as u64, nodes);
    let line = lengths.len();
    for (frame, load) in arrays["film_load_n"].1.iter().enumerate() {
        let all = &film[frame * 9 * line..(frame + 1) * 9 * line];
        let sum: f64 = all.iter().zip(lengths.iter().cycle()).map(|(load, length)| load * length).sum();
        assert!((sum - load).abs() < 1e-12, "frame {frame}: {sum} is not {load}");
    }
    let greatest = arrays["pressure_kpa"].1.iter().copied().fold(0.0, f64::max);
    assert_eq!(greatest, summary["max_pressure_kpa"].as_f64().unwrap());
    let gap = &arrays["gap_nm"].1;
    assert!(gap.iter().zip(&arrays["contact_n_per_m"].1).all(|(gap, contact)| gap.abs() < 1e-9 || *contact == 0.0));
    // The same run, the same bytes.
    done(&arguments);
    assert_eq!(fs::read(folder.path().join("fields.npz")).unwrap(), first);
}

#[test]
fn an_npz_of_a_strip_has_no_teeth_and_one_of_one_mesh_no_errors() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    done(&["solve", "plate-crossover", "--fidelity", "draft", "--figures", "none", "--out", path]);
    let strip = arrays(folder.path());
    assert_eq!(strip["film_n_per_m2"].0.len(), 2);
    assert!(strip.contains_key("film_load_n_per_m") && !strip.contains_key("contact_n_per_m"));

    let numerics = ["--set", "numerics.contact_nodes=60", "--set", "numerics.steps_per_cycle=60"];
    done(&[&["solve", "fundamental", "--method", "paper", "--figures", "none", "--out", path][..], &numerics].concat());
    let arrays = arrays(folder.path());
    let errors: Vec<_> = arrays.iter().filter(|(name, _)| name.contains("_error")).collect();
    assert!(
        errors.len() == 4
            && errors.iter().all(|(_, (shape, values))| *shape == [60] && values.iter().all(|value| value.is_nan())),
        "{errors:?}"
    );
}

#[test]
fn python_reads_the_npz_with_the_example_of_the_docs() {
    let ready = Command::new("python3").args(["-c", "import numpy"]).stderr(Stdio::null()).status();
    if !ready.is_ok_and(|status| status.success()) {
        eprintln!("skipped: there is no python3 with numpy here");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let results = folder.path().join("results");
    let arguments = ["solve", "fundamental", "--fidelity", "draft", "--figures", "none", "--out"];
    done(&[&arguments[..], &[results.to_str().unwrap()]].concat());
    let docs = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/python.md")).unwrap();
    let blocks = docs.split("```python\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    let example = blocks.into_iter().find(|block| block.contains("np.load")).unwrap();
    let ran = Command::new("python3").args(["-c", example]).current_dir(&folder).output().unwrap();
    let (said, faults) = (out(&ran), err(&ran));
    assert!(ran.status.success() && said.starts_with("Fundamental case: film load 0.60"), "{said}{faults}");
}

#[test]
fn a_comparison_has_the_numbers_of_the_single_solves() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let presets = ["fundamental", "min-spacing-100nm", "levitating"];
    let draft = ["--fidelity", "draft", "--json"];
    let output = done(&[&["compare"], &presets[..], &draft, &["--out", path, "--figures", "svg"]].concat());
    let compared = json(&output);
    assert_eq!(
        compared,
        serde_json::from_slice::<Value>(&fs::read(folder.path().join("compare.json")).unwrap()).unwrap()
    );
    // Numbers as they are written, which is with the fewest digits that read back to the same bits: JSON's own reader rounds.
    let texts = |json: &str, name: &str| -> Vec<String> {
        let key = format!("\"{name}\": ");
        let after = json.split(&key).skip(1);
        after.map(|rest| rest.split([',', '\n']).next().unwrap().to_owned()).collect()
    };
    let ours: Vec<&str> = out(&output).split("\"label\"").skip(1).collect();
    let single = |preset: &&str| out(&done(&[&["solve", preset], &draft[..]].concat())).to_owned();
    let singles: Vec<String> = presets.iter().map(single).collect();
    for (single, run) in singles.iter().zip(&ours) {
        for name in [
            "alpha",
            "alpha_error",
            "film_load_n",
            "stall_torque_nm",
            "stall_torque_error_nm",
            "max_torque_nm",
            "min_gap_nm",
            "max_pressure_kpa",
            "preset",
        ] {
            assert_eq!(texts(run, name)[0], texts(single, name)[0], "{name}");
        }
    }
    let alpha = |run: usize| texts(&singles[run], "alpha")[0].parse::<f64>().unwrap();
    let difference = compared["runs"][1]["difference_percent"]["alpha"].as_f64().unwrap();
    assert!((difference - 100.0 * (alpha(1) / alpha(0) - 1.0)).abs() < 1e-9);
    let off = compared["runs"][1]["difference_error_percent"]["alpha"].as_f64().unwrap();
    assert!(off > 0.0 && off < 5.0, "{off}");
    assert_eq!(compared["differing"].as_array().unwrap().len(), 2);

    let mut reader = csv::Reader::from_path(folder.path().join("compare.csv")).unwrap();
    let rows: Vec<BTreeMap<String, String>> = reader.deserialize().map(Result::unwrap).collect();
    let row = rows.iter().find(|row| row["quantity"] == "alpha" && row["run"] == "2").unwrap();
    assert_eq!(row["value"].parse::<f64>().unwrap(), alpha(1));
    let limits = |run: usize| texts(&singles[run], "name").join(";").replace('"', "");
    assert_eq!((row["validity"].as_str(), limits(1).as_str()), ("slip-law", "slip-law"));
    let floats = rows.iter().find(|row| row["run"] == "3").unwrap();
    assert_eq!((floats["validity"].as_str(), limits(2).as_str()), ("", ""));
    let report = fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(report.contains(squeezefilm::export::compare::LIMITS), "names of limits in the report's results");
    assert!(report.contains("slip law") && !report.contains("slip-law"), "in words");

    assert_eq!(
        names(folder.path()),
        [
            "compare.csv",
            "compare.json",
            "cycle.gif",
            "loads.svg",
            "maps.svg",
            "parameters.csv",
            "report.html",
            "teeth.svg",
            "torque.svg",
            "waves.svg"
        ]
    );
    let html = fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(!html.contains(">difference<"), "the differences of three runs are below the values");
    let page = page(&html);
    assert_eq!((count(&page, "svg"), count(&page, "img")), (5, 1));
    // Each curve of each run is in the figure of the waves: tops, rotor, and one in either panel of pressures.
    let figure = named(page.root(), "svg").next().unwrap();
    let areas = figure.descendants().filter(|node| node.attribute("data-area").is_some()).count();
    assert_eq!(areas, 3);
    let tables = tables(&page);
    let [parameters, results] = &tables[..] else { panic!("{} tables", tables.len()) };
    let spacing = ["Minimum spacing H_m, nm", "film.min_spacing_nm", "200", "100", "200"];
    assert!(parameters.iter().any(|row| row[..] == spacing), "{parameters:?}");
    let film = results.iter().find(|row| row[0].starts_with("film load")).unwrap();
    assert!(film[1].contains(" ± ") && film[3].ends_with(" %"), "{film:?}");
    // The animation in the page is the file beside it.
    let gif = named(page.root(), "img").next().unwrap().attribute("src").unwrap();
    use base64::Engine as _;
    let bytes = base64::engine::general_purpose::STANDARD.decode(gif.split_once(',').unwrap().1).unwrap();
    assert_eq!(bytes, fs::read(folder.path().join("cycle.gif")).unwrap());
    let options = gif::DecodeOptions::new();
    let mut movie = options.read_info(&bytes[..]).unwrap();
    let mut frames = 0;
    while movie.read_next_frame().unwrap().is_some() {
        frames += 1;
    }
    assert!(frames >= 12, "{frames}");
    assert!(words(page.root_element()).contains("squeezefilm compare fundamental min-spacing-100nm levitating"));
}

#[test]
fn motors_and_plates_are_compared_as_far_as_they_go() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let all = ["compare", "fundamental", "plate-crossover", "--all", "--fidelity", "draft", "--figures", "none"];
    let output = done(&[&all[..], &["--out", path]].concat());
    let said = out(&output);
    assert!(said.contains("plate.length_mm") && said.contains("film.slip"), "{said}");
    let html = fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert_eq!((count(&page(&html), "svg"), count(&page(&html), "img")), (9, 2));
    assert!(html.contains(">difference<"), "a column of the differences between two runs");
}

#[test]
fn curves_of_torque_and_power_begin_and_end_where_the_numbers_say() {
    let scenes = ["fundamental", "min-spacing-100nm"].map(|name| presets::find(name).unwrap());
    let settings = Settings { fidelity: Fidelity::Draft, ..Settings::default() };
    let compared = runs(&scenes, &settings, &Cancel::new(), &|_| ()).unwrap();
    let (_, figure) = all_figures(&compared).into_iter().find(|(name, _)| name == "torque").unwrap();
    let curves: Vec<Vec<[f64; 2]>> = figure
        .panels
        .iter()
        .flat_map(|panel| &panel.layers)
        .filter_map(|layer| match layer {
            Layer::Line(line) if !line.name.is_empty() => Some(line.points.clone()),
            _ => None,
        })
        .collect();
    let [first, second, power, other_power] = &curves[..] else { panic!("{} curves", curves.len()) };
    let number = |run: usize, quantity| compared[run].numbers().get(quantity).unwrap();
    for (run, torque) in [first, second].into_iter().enumerate() {
        // In the unit of the window.
        assert!((torque[0][1] - number(run, Quantity::StallTorque)).abs() < 1e-9, "{:?}", torque[0]);
        assert!((torque.last().unwrap()[0] - number(run, Quantity::NoLoadSpeed)).abs() < 0.02, "{:?}", torque.last());
        assert!(torque.iter().all(|[_, torque]| *torque >= 0.0));
    }
    for (run, power) in [power, other_power].into_iter().enumerate() {
        let most = power.iter().map(|[_, power]| *power).fold(0.0, f64::max);
        let told = number(run, Quantity::MaxPower);
        assert!((most / told - 1.0).abs() < 2e-3, "{most} and {told}");
    }
}

#[test]
fn one_preset_alone_has_a_report_without_differences() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let said = done(&["compare", "plate-crossover", "--fidelity", "draft", "--out", path]);
    assert!(out(&said).starts_with("one preset, fidelity draft"));
    let html = fs::read_to_string(folder.path().join("report.html")).unwrap();
    let text: String = page(&html).descendants().filter_map(|node| node.text()).collect();
    assert!(text.contains("Plate, crossover") && !text.contains("difference"), "{text}");
    let parameters = fs::read_to_string(folder.path().join("parameters.csv")).unwrap();
    assert!(parameters.lines().count() > 5, "all of its parameters: {parameters}");
}

/// Runs in a shell that lets no file grow beyond a few kilobytes, as a disk that is nearly full.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_and_leaves_nothing_half_written() {
    for arguments in [
        "solve fundamental",
        "compare fundamental levitating",
        "sweep fundamental --vary film.min_spacing_nm=100:200:40",
    ] {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("report.html"), "older").unwrap();
        let script = format!(
            "trap '' XFSZ; ulimit -f 4; exec \"$0\" {arguments} --fidelity draft --figures svg --out \"$1\" >/dev/null"
        );
        let output = Command::new("sh")
            .args(["-c", &script, env!("CARGO_BIN_EXE_squeezefilm")])
            .arg(folder.path())
            .output()
            .unwrap();
        let said = err(&output);
        assert_eq!(output.status.code(), Some(1), "{arguments}: {said}");
        assert!(said.contains(": cannot be written: ") && said.contains("too large"), "{arguments}: {said}");
        assert_eq!(names(folder.path()), ["report.html"], "{arguments}");
        assert_eq!(fs::read_to_string(folder.path().join("report.html")).unwrap(), "older");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_cannot_be_written_is_told_before_anything_is_solved() {
    // Nobody may write there, root neither.
    for command in [&["compare", "fundamental", "levitating"][..], &["reproduce"], &["solve", "fundamental"]] {
        let arguments = [command, &["--out", "/proc/squeezefilm"]].concat();
        program::refused(&arguments, 1, &["/proc/squeezefilm: cannot be written: "]);
    }
    // A reader that has no room for the data.
    for arguments in [&["compare", "fundamental", "levitating", "--fidelity", "draft"][..], &["--help"], &["-V"]] {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = squeezefilm(arguments).stdout(full).output().unwrap();
        let said = err(&output);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(said.contains("standard output: cannot be written: "), "{said}");
    }
}

/// One run serves all that is to be seen of it: it is the paper's algorithm that takes the time.
#[test]
fn the_paper_is_reproduced_and_a_run_cut_short_leaves_nothing() {
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("paper");
    let path = folder.to_str().unwrap();
    let mut child = squeezefilm(&["reproduce", "--out", path]);
    let child = child.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(700));
    let interrupted = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    let output = child.wait_with_output().unwrap();
    if interrupted.is_ok_and(|status| status.success()) {
        // 1, or none if it was so early that the signal itself ended it.
        assert!(matches!(output.status.code(), Some(1) | None), "{:?}", output.status);
        assert!(!folder.exists());
    }

    let object = json(&done(&["reproduce", "--out", path, "--fidelity", "draft", "--json", "--figures", "svg"]));
    assert_eq!((object["unsolved"].as_u64(), object["table1"].as_array().unwrap().len()), (Some(0), 14));
    let published: Vec<f64> =
        object["table1"].as_array().unwrap().iter().map(|row| row["published_alpha"].as_f64().unwrap()).collect();
    for row in object["table1"].as_array().unwrap() {
        let difference = row["paper_difference_percent"].as_f64().unwrap();
        let allowed = if row["preset"] == "rotor-width-0.6mm" { 8.0 } else { 2.0 };
        assert!(difference.abs() < allowed, "{row}");
    }
    let figures = [3, 4, 6, 7, 8, 9, 10, 11, 12].map(|number| format!("fig{number}.svg"));
    for name in figures.iter().map(String::as_str).chain(["report.html", "table1.csv", "figures.json", "cycle.gif"]) {
        assert!(folder.join(name).is_file(), "{name}");
    }
    let html = fs::read_to_string(folder.join("report.html")).unwrap();
    let page = page(&html);
    assert_eq!((count(&page, "svg"), count(&page, "img")), (9, 1));
    let tables = tables(&page);
    let rows = &tables[0][2..];
    assert_eq!(rows.iter().map(|row| row[2].parse::<f64>().unwrap()).collect::<Vec<_>>(), published);
    assert!(rows.iter().all(|row| row[4].contains(" ± ") && row[7].contains(" ± ")));
    assert_eq!(tables[1].len(), 1 + object["statements"].as_array().unwrap().len());
    let text = words(page.root_element());
    for said in ["Fig. 12.", "Fig. 5 shows surfaces measured", "squeezefilm reproduce"] {
        assert!(text.contains(said), "{said}");
    }
    assert!(!text.contains("did not converge"));
}
