//! Figures and animations read back by readers that did not write them: XML, PNG, GIF, MP4 and AV1.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use roxmltree::{Document, Node};
use squeezefilm::control::Cancel;
use squeezefilm::export::animation::{self, Format, Movie};
use squeezefilm::export::figure::{
    self, Axis, Band, Categories, Colour, Figure, FigureError, Grid, Layer, Line, Map, Mark, Marker, Panel, Points,
    Provenance, Range, Shading, Shape, Style, Text, Width,
};
use squeezefilm::export::figures;
use squeezefilm::export::files::ExportError;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::problem::Problem;
use squeezefilm::scene::presets;
use squeezefilm::solution::Solution;
use squeezefilm::solve::{Method, Settings, solve};
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

fn solved(preset: &str, changes: &[(&str, &str)]) -> (Problem, Solution) {
    let scene = presets::find(preset).unwrap().with(changes).unwrap();
    let problem = Problem::try_from(&scene).unwrap();
    let settings = Settings { fidelity: Fidelity::Draft, method: Method::Auto, ..Settings::default() };
    let solution = solve(&problem, &settings, &mut (), &Cancel::new()).unwrap();
    (problem, solution)
}

/// An axis as the file tells it.
struct Scaled {
    from: f64,
    to: f64,
    log: bool,
}

impl Scaled {
    fn of(panel: Node<'_, '_>, name: &str) -> Self {
        let words: Vec<&str> = panel.attribute(name).unwrap().split(' ').collect();
        Self { from: words[0].parse().unwrap(), to: words[1].parse().unwrap(), log: words[2] == "log" }
    }

    fn value(&self, fraction: f64) -> f64 {
        if self.log {
            self.from * (self.to / self.from).powf(fraction)
        } else {
            self.from + fraction * (self.to - self.from)
        }
    }
}

fn numbers(text: &str) -> Vec<f64> {
    text.split([' ', ',']).map(|number| number.parse().unwrap()).collect()
}

fn panels<'a>(document: &'a Document<'a>) -> Vec<Node<'a, 'a>> {
    document.descendants().filter(|node| node.attribute("class") == Some("panel")).collect()
}

/// The vertices of a named layer, in its values.
fn vertices(panel: Node<'_, '_>, name: &str, y: &str) -> Vec<[f64; 2]> {
    let area = numbers(panel.attribute("data-area").unwrap());
    let (x_axis, y_axis) = (Scaled::of(panel, "data-x"), Scaled::of(panel, y));
    let layer = panel.children().find(|node| node.attribute("data-name") == Some(name)).unwrap();
    let lines = layer.children().filter(|node| node.has_tag_name("polyline"));
    let points = lines.flat_map(|line| {
        let flat = numbers(line.attribute("points").unwrap());
        flat.chunks(2).map(|p| [p[0], p[1]]).collect::<Vec<_>>()
    });
    points
        .map(|[px, py]| [x_axis.value((px - area[0]) / area[2]), y_axis.value((area[1] + area[3] - py) / area[3])])
        .collect()
}

#[test]
fn the_numbers_are_in_the_svg() {
    let points: Vec<[f64; 2]> = (0..40).map(|i| 3e3 * 1.1f64.powi(i)).map(|f| [f, 0.26 * f / (f + 1e4)]).collect();
    let gap = points.iter().map(|[f, a]| [*f, 1e-9 / a]);
    let right = Line { right: true, ..Line::new("gap", gap, Style::nth(1)) };
    let mut panel =
        Panel::new("(a) share & gap", Axis::new("frequency", "Hz").log(), Axis::new("α", "").including([0.0]))
            .layer(Line::new("share < 1", points.clone(), Style::nth(0)))
            .layer(right)
            .layer(Text::new([1e4, 0.1], "a note"))
            .layer(Text::new([1e7, 0.1], "beyond the axes"));
    panel.right = Some(Axis::new("gap", "m").log());
    let provenance = Provenance { preset: "My <motor>".into(), version: "0.1.0".into(), ..Provenance::default() };
    let figure = Figure { provenance, ..Figure::new("Share \"and\" gap").panel(panel).caption("What it shows") };
    let svg = figure::to_svg(&figure);
    let document = Document::parse(&svg).unwrap();
    let panel = panels(&document)[0];
    assert_eq!(panel.attribute("data-title"), Some("(a) share & gap"));
    // A line is thinned only where points fall together, and a coordinate is a thousandth of a point.
    let back = vertices(panel, "share < 1", "data-y");
    assert_eq!(back.len(), points.len());
    for (there, back) in points.iter().zip(&back) {
        assert!((there[0] / back[0] - 1.0).abs() < 1e-4 && (there[1] - back[1]).abs() < 1e-5, "{there:?} {back:?}");
    }
    for (there, back) in points.iter().zip(&vertices(panel, "gap", "data-right")) {
        assert!((1e-9 / there[1] / back[1] - 1.0).abs() < 1e-4, "{there:?} {back:?}");
    }
    let text = |tag: &str| document.descendants().find(|n| n.has_tag_name(tag)).and_then(|n| n.text()).unwrap();
    assert_eq!((text("title"), text("desc")), ("Share \"and\" gap", "What it shows"));
    let provenance: Provenance = serde_json::from_str(text("metadata")).unwrap();
    assert_eq!(provenance, figure.provenance);
    let words: Vec<String> = document
        .descendants()
        .filter(|node| node.has_tag_name("text"))
        .map(|node| node.descendants().filter(Node::is_text).filter_map(|n| n.text()).collect())
        .collect();
    for expected in ["frequency (Hz)", "α", "gap (m)", "My <motor> · squeezefilm 0.1.0", "0.05", "105"] {
        assert!(words.iter().any(|word| word == expected), "{expected}: {words:?}");
    }
    assert!(
        words.iter().any(|word| word == "a note") && words.iter().all(|word| word != "beyond the axes"),
        "{words:?}"
    );
}

#[test]
fn names_of_places_close_together_stand_apart() {
    let places =
        [[1.0, 1.0], [1.02, 1.01], [1.01, 0.98], [1.0, 1.01], [1.01, 1.0], [1.0, 0.99], [0.0, 0.0], [2.0, 2.0]];
    let mut panel = Panel::new("", Axis::new("x", ""), Axis::new("y", "")).layer(Line::new("", places, Style::quiet()));
    for (i, at) in places.into_iter().enumerate() {
        panel = panel.layer(Text::new(at, format!("number {i}")));
    }
    let svg = figure::to_svg(&Figure::new("").panel(panel));
    let document = Document::parse(&svg).unwrap();
    let names = document
        .descendants()
        .filter(|node| node.has_tag_name("text") && node.text().is_some_and(|text| text.starts_with("number ")));
    let at: Vec<[f64; 2]> =
        names.map(|node| ["x", "y"].map(|name| node.attribute(name).unwrap().parse().unwrap())).collect();
    assert_eq!(at.len(), places.len());
    // Eight letters of about half their size of 7.5 points.
    for (i, a) in at.iter().enumerate() {
        for b in &at[..i] {
            assert!((a[0] - b[0]).abs() > 26.0 || (a[1] - b[1]).abs() > 6.0, "{at:?}");
        }
    }
    // More of one place than there is room for right beside it: the others have lines to it.
    let line = Line::new("", [[0.0, 0.0], [2.0, 2.0]], Style::quiet());
    let names = (0..12).map(|i| Text::new([1.0, 1.0], format!("number {i}")));
    let crowded = Panel::new("", Axis::new("x", ""), Axis::new("y", "")).layer(line).layers(names);
    let svg = figure::to_svg(&Figure::new("").panel(crowded));
    assert!(svg.contains(r#"class="leaders""#), "{svg}");
}

#[test]
fn panels_of_a_column_line_up() {
    let line = |scale: f64| Line::new("", [[0.0, 0.0], [1.0, scale]], Style::default());
    let panel = |scale: f64| Panel::new("", Axis::new("x", ""), Axis::new("y", "")).layer(line(scale));
    let all = [1.0, 12_345.0, 1e-6, -1.0].map(panel).into();
    let svg = figure::to_svg(&Figure { panels: all, columns: 2, share_x: true, ..Figure::default() });
    let document = Document::parse(&svg).unwrap();
    let areas: Vec<Vec<f64>> = panels(&document).iter().map(|p| numbers(p.attribute("data-area").unwrap())).collect();
    for [a, b] in [[0, 2], [1, 3]] {
        assert_eq!((areas[a][0], areas[a][2]), (areas[b][0], areas[b][2]));
    }
    assert_eq!((areas[0][1], areas[2][1]), (areas[1][1], areas[3][1]));
    let page = numbers(document.root_element().attribute("viewBox").unwrap());
    assert!(areas.iter().all(|area| area[0] > 0.0 && area[0] + area[2] < page[2] && area[1] + area[3] < page[3]));
}

fn decoded(bytes: &[u8]) -> (png::OutputInfo, Vec<u8>, Vec<(String, String)>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    reader.finish().unwrap();
    let text = &reader.info().utf8_text;
    let facts = text.iter().map(|chunk| (chunk.keyword.clone(), chunk.get_text().unwrap())).collect();
    (info, pixels, facts)
}

fn a_map() -> Figure {
    let nodes = [0.0, 0.125, 0.5, 1.0];
    let values: Vec<f64> = nodes.iter().flat_map(|x| nodes.map(|y| 100.0 * (x + y))).collect();
    let grid = Grid { x: nodes.to_vec(), y: nodes.to_vec(), values };
    let map = Map { label: "pressure".into(), unit: "kPa".into(), grid, contours: Some(0.0), ..Map::default() };
    let panel = Panel::new("", Axis::new("x", "mm"), Axis::new("y", "mm")).layer(map);
    let provenance = Provenance { preset: "plate".into(), error: "± 1 %".into(), ..Provenance::default() };
    Figure { provenance, ..Figure::new("A map of p").panel(panel) }
}

#[test]
fn a_png_has_its_size_its_colours_and_its_origin() {
    let figure = a_map();
    let (info, pixels, facts) = decoded(&figure::to_png(&figure, 2.0).unwrap());
    assert_eq!(info.width, (85.0 * 2.0 * 72.0 / 25.4_f64).round() as u32);
    let colours: std::collections::BTreeSet<&[u8]> = pixels.chunks_exact(3).collect();
    assert!(colours.len() > 200, "the map has {} colours", colours.len());
    assert!(facts.contains(&("Title".into(), "A map of p".into())));
    assert!(facts.contains(&("Source".into(), "plate · ± 1 %".into())), "{facts:?}");
    assert!(matches!(figure::to_png(&figure, 1e6), Err(FigureError::Size { .. })));
    assert!(matches!(figure::to_png(&figure, f64::NAN), Err(FigureError::Size { .. })));
}

#[test]
fn a_map_is_a_picture_in_every_format() {
    let figure = a_map();
    let svg = figure::to_svg(&figure);
    let document = Document::parse(&svg).unwrap();
    let images: Vec<_> = document.descendants().filter(|node| node.has_tag_name("image")).collect();
    assert_eq!(images.len(), 2, "map and colour bar");
    assert!(images.iter().all(|image| image.attribute("href").unwrap().starts_with("data:image/png;base64,")));
    let pdf = figure::to_pdf(&figure).unwrap();
    let words = String::from_utf8_lossy(&pdf);
    assert!(words.starts_with("%PDF-") && words.trim_end().ends_with("%%EOF"));
    assert_eq!(words.matches("/Type /Page\n").count() + words.matches("/Type /Page ").count(), 1);
    assert_eq!(words.matches("/Subtype /Image").count(), 2);
    assert!(words.contains("/Title") && words.contains("/FontFile"));
}

#[test]
fn files_are_written_by_extension_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let names = |folder: &Path| fs::read_dir(folder).unwrap().count();
    let figure = a_map();
    for (name, begins) in [("a.svg", b"<svg".as_slice()), ("b.PNG", b"\x89PNG"), ("c.pdf", b"%PDF")] {
        figure::write(&figure, &folder.path().join(name)).unwrap();
        assert!(fs::read(folder.path().join(name)).unwrap().starts_with(begins));
    }
    assert_eq!(names(folder.path()), 3);
    for name in ["a.jpg", "a", "svg"] {
        let error = figure::write(&figure, &folder.path().join(name)).unwrap_err();
        assert!(error.to_string().contains(".svg, .png or .pdf"), "{error}");
    }
    let error = figure::write(&figure, &folder.path().join("nowhere/a.svg")).unwrap_err();
    assert!(error.to_string().contains("a.svg: cannot be written"), "{error}");
    fs::create_dir(folder.path().join("d.svg")).unwrap();
    assert!(figure::write(&figure, &folder.path().join("d.svg")).is_err());
    assert_eq!(names(folder.path()), 4);
}

/// Lists of values that nobody means to draw.
fn awkward() -> Vec<Vec<f64>> {
    vec![
        vec![],
        vec![1.0],
        vec![0.0; 3],
        vec![-1e-12, 1e12],
        vec![1e-12, 1.0, 1e12],
        vec![f64::NAN; 4],
        vec![1.0, f64::NAN, 2.0, f64::INFINITY, -3.0, f64::NEG_INFINITY],
        vec![f64::MAX, -f64::MAX, f64::MIN_POSITIVE],
        vec![1.0, 1.0 + f64::EPSILON],
        vec![-5.0, -2.0, -1e-300],
    ]
}

fn with_all_layers(x: &[f64], y: &[f64], log: bool) -> Figure {
    let points = || x.iter().zip(y).map(|(x, y)| [*x, *y]);
    let mut axes = [Axis::new("x", "m"), Axis::new("y", ""), Axis::new("z", "N")];
    if log {
        axes = axes.map(Axis::log);
    }
    let values: Vec<f64> = x.iter().flat_map(|x| y.iter().map(move |y| x * y)).collect();
    let kinds = values.iter().map(|value| (value.abs() as usize) % 4).collect();
    let grid = Grid { x: x.to_vec(), y: y.to_vec(), values };
    let cloud = Points::new("points", points(), Colour::FILM, Marker::hollow(Shape::Diamond));
    let cloud = Points { errors: y.to_vec(), ..cloud };
    let other = Line { right: true, ..Line::new("right", points(), Style::nth(3)) };
    let [ax, ay, az] = axes;
    let mut panel = Panel::new("p_{a}", ax.clone(), ay.clone())
        .layer(Map { grid: grid.clone(), ..Map::default() })
        .layer(Map { grid: grid.clone(), shading: Shading::Cells, range: Range::Fixed(2.0, 2.0), ..Map::default() })
        .layer(Map { grid, contours: Some(0.0), ..Map::default() })
        .layer(Categories { x: x.to_vec(), y: y.to_vec(), values: kinds, kinds: vec![("k".into(), Colour::BLACK)] })
        .layer(Line::new("line", points(), Style::nth(0)))
        .layer(other)
        .layer(Band::new("band", points().map(|[x, y]| [x, y, -y]), Colour::CONTACT))
        .layer(cloud);
    for value in y.iter().copied().chain([f64::NAN]) {
        panel = panel
            .layer(Mark::vertical(value, "mark"))
            .layer(Mark::horizontal(value, "mark"))
            .layer(Text::new([value, value], "text\u{0}"));
    }
    panel.right = Some(az);
    let lines = Panel {
        layers: panel.layers.iter().filter(|l| matches!(l, Layer::Line(_))).cloned().collect(),
        ..Panel::new("", ax, ay)
    };
    let panels = vec![panel, lines];
    Figure { panels, columns: 2, width: Width::Page, share_x: log, ..Figure::new("awkward & <odd>") }
}

#[test]
fn awkward_data_is_drawn_or_left_out_and_never_a_panic() {
    for (i, x) in awkward().iter().enumerate() {
        for (j, y) in awkward().iter().enumerate() {
            for log in [false, true] {
                let figure = with_all_layers(x, y, log);
                let svg = figure::to_svg(&figure);
                // Pixels are spelt in letters, and may spell anything.
                let mut drawn = svg.lines().filter(|line| !line.starts_with("<image"));
                let odd = drawn.find(|line| ["NaN", ">inf<", "\"inf"].iter().any(|word| line.contains(word)));
                assert_eq!(odd, None, "{x:?} {y:?} {log}");
                Document::parse(&svg).unwrap();
                if (i + j) % 5 == 0 {
                    figure::to_png(&figure, 0.5).unwrap();
                    figure::to_pdf(&figure).unwrap();
                }
            }
        }
    }
    for width in [f64::NAN, -3.0, 1e9] {
        let figure = Figure { width: Width::Millimetres(width), ..with_all_layers(&[1.0], &[2.0, 3.0], false) };
        Document::parse(&figure::to_svg(&figure)).unwrap();
    }
    let mut empty = Figure::default();
    figure::to_png(&empty, 1.0).unwrap();
    empty.panels = vec![Panel { height: f64::NAN, ..Panel::default() }; 3];
    empty.columns = usize::MAX;
    figure::to_pdf(&empty).unwrap();
}

#[test]
fn a_long_curve_is_thinned() {
    let wave = (0..300_000).map(|i| f64::from(i) / 3e5).map(|x| [x, (40.0 * x).sin()]);
    let line = Line::new("wave", wave, Style::default());
    let figure = Figure::new("").panel(Panel::new("", Axis::default(), Axis::default()).layer(line));
    assert!(figure::to_svg(&figure).len() < 2_000_000);
}

#[test]
fn every_scene_has_its_figures() {
    let motor = ["wave", "loads", "map"];
    let plate = ["profile", "loads", "loop", "map", "exact"];
    for (preset, changes, expected) in [
        ("fundamental", vec![], motor.as_slice()),
        ("levitating", vec![], &motor),
        ("plate-crossover", vec![], &plate),
        ("plate-crossover", vec![("plate.width_mm", "1")], &plate),
    ] {
        let (problem, solution) = solved(preset, &changes);
        let figures = figures::of(&problem, &solution, &[], None);
        let names: Vec<&str> = figures.iter().map(|(name, _)| *name).collect();
        assert_eq!(names, expected);
        for (name, figure) in &figures {
            assert!(figure.title.starts_with(&problem.name) && !figure.caption.is_empty(), "{preset} {name}");
            let svg = figure::to_svg(figure);
            Document::parse(&svg).unwrap();
            assert!(svg.contains("squeezefilm 0.1.0") && svg.contains("draft"), "{preset} {name}");
        }
    }
    let (problem, mut solution) = solved("plate-viscous", &[]);
    solution.recording = Default::default();
    assert!(figures::of(&problem, &solution, &[], None).is_empty());
}

#[test]
fn the_wave_shows_the_recording() {
    let (problem, solution) = solved("fundamental", &[]);
    let recording = &solution.recording;
    let frame = figures::motor::crest_in_the_middle(recording);
    let figures = figures::of(&problem, &solution, &[], None);
    let svg = figure::to_svg(&figures[0].1);
    let document = Document::parse(&svg).unwrap();
    let stator = vertices(panels(&document)[0], "stator", "data-y");
    let highest = stator.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
    let middle = (recording.teeth / 2) as f64 * recording.pitch * 1e3;
    assert!((highest[0] - middle).abs() < 0.5 * recording.pitch * 1e3, "the crest is on the tooth in the middle");
    let line = recording.line_offset(2, frame);
    let (x, top) = ((2.0 * recording.pitch + recording.x[5]) * 1e3, recording.stator[line + 5] * 1e6);
    assert!(stator.iter().any(|p| (p[0] - x).abs() < 1e-3 && (p[1] - top).abs() < 1e-3), "{x} {top}");
}

#[test]
fn a_gif_has_all_frames_and_they_move() {
    let (problem, solution) = solved("fundamental", &[]);
    let options = animation::Options { width: 300, seconds: 2.0, frames: 12 };
    let drawn = AtomicUsize::new(0);
    let done = || {
        drawn.fetch_add(1, Ordering::Relaxed);
    };
    let movie = animation::cycle(&problem, &solution, &options, &done, &Cancel::new()).unwrap();
    let count = animation::count(&solution.recording, &options, Format::Gif);
    assert_eq!(drawn.into_inner(), count);
    assert!((6..=12).contains(&count) && solution.recording.frames.is_multiple_of(count), "{count}");
    let mut bytes = Vec::new();
    movie.gif(&mut bytes, &Cancel::new()).unwrap();
    let mut reader = gif::DecodeOptions::new();
    reader.set_color_output(gif::ColorOutput::RGBA);
    let mut reader = reader.read_info(bytes.as_slice()).unwrap();
    assert_eq!((reader.width(), reader.repeat()), (300, gif::Repeat::Infinite));
    let mut frames = Vec::new();
    let mut delay = 0;
    while let Some(frame) = reader.read_next_frame().unwrap() {
        delay += u32::from(frame.delay);
        let inked = frame.buffer.chunks_exact(4).filter(|pixel| pixel[3] > 0).count();
        assert!(inked > 50, "frame {} has changed {inked} pixels", frames.len());
        frames.push(frame.buffer.to_vec());
    }
    assert_eq!((frames.len(), delay), (count, 200));
    // 255 colours for all frames are near those of the first, wherever in it.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frames");
    let exact = animation::write(&path, &problem, &solution, &options, &|| (), &Cancel::new()).unwrap();
    let exact = decoded(&fs::read(&exact[0]).unwrap()).1;
    let pixels = frames[0].chunks_exact(4).zip(exact.chunks_exact(exact.len() / (frames[0].len() / 4)));
    let mut away: Vec<u8> =
        pixels.map(|(drawn, exact)| (0..3).map(|k| drawn[k].abs_diff(exact[k])).max().unwrap()).collect();
    away.sort_unstable();
    let most = away[away.len() - away.len() / 1000];
    assert!(most <= 24, "{most}");
    frames.dedup();
    assert_eq!(frames.len(), count, "no two frames in turn are equal");
    assert!(has(&bytes, Provenance::of(&problem, &solution).line().as_bytes()), "the file says where it comes from");
}

fn has(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|window| window == part)
}

#[test]
fn an_mp4_has_the_cycle_twice_in_the_colours_of_its_frames() {
    use re_rav1d::dav1d::{Decoder, Error, PlanarImageComponent, pixel};
    let (problem, solution) = solved("fundamental", &[]);
    let options = animation::Options { width: 301, seconds: 6.0, frames: 6 };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mp4");
    let encoded = AtomicUsize::new(0);
    let done = || {
        encoded.fetch_add(1, Ordering::Relaxed);
    };
    animation::write(&path, &problem, &solution, &options, &done, &Cancel::new()).unwrap();
    let frames = folder.path().join("frames");
    let frames = animation::write(&frames, &problem, &solution, &options, &|| (), &Cancel::new()).unwrap();
    let count = frames.len();
    assert_eq!(encoded.into_inner(), count);
    let frames: Vec<_> = frames.iter().map(|path| decoded(&fs::read(path).unwrap())).collect();
    let (across, down) = (frames[0].0.width as usize, frames[0].0.height as usize);
    let (width, height) = (across.next_multiple_of(2), down.next_multiple_of(2));
    assert_eq!((across, width), (301, 302));

    let bytes = fs::read(&path).unwrap();
    assert!(has(&bytes, Provenance::of(&problem, &solution).line().as_bytes()), "the file says where it comes from");
    let file = re_mp4::Mp4::read_bytes(&bytes).unwrap();
    let track = file.tracks().values().next().unwrap();
    assert_eq!((file.tracks().len(), track.width as usize, track.height as usize), (1, width, height));
    assert_eq!(track.duration, 12 * track.timescale, "twice six seconds");
    assert_eq!(track.codec_string(&file).unwrap(), "av01.0.00M.08", "main profile, level 2.0, 8 bits");
    assert_eq!(track.samples.len(), 2 * count);
    for (i, sample) in track.samples.iter().enumerate() {
        assert_eq!(sample.is_sync, i % count == 0, "sample {i}");
        assert_eq!(sample.duration * count as u64, 6 * track.timescale);
        assert_eq!(sample.composition_timestamp, i as i64 * sample.duration as i64);
    }

    let mut decoder = Decoder::new().unwrap();
    let mut shown: Vec<[Vec<u8>; 3]> = Vec::new();
    let mut take = |decoder: &mut Decoder| {
        while let Ok(picture) = decoder.get_picture() {
            assert_eq!((picture.width() as usize, picture.height() as usize), (width, height));
            assert_eq!(picture.color_primaries(), pixel::ColorPrimaries::BT709);
            assert_eq!(picture.transfer_characteristic(), pixel::TransferCharacteristic::SRGB);
            assert_eq!(picture.matrix_coefficients(), pixel::MatrixCoefficients::BT709);
            assert_eq!(picture.color_range(), pixel::YUVRange::Limited);
            assert_eq!(picture.chroma_location(), pixel::ChromaLocation::Left);
            let plane = |component, [width, height]: [usize; 2]| {
                let rows = picture
                    .plane(component)
                    .chunks(picture.stride(component) as usize)
                    .take(height)
                    .flat_map(|row| row[..width].to_vec())
                    .collect::<Vec<u8>>();
                assert_eq!(rows.len(), width * height);
                rows
            };
            shown.push([
                plane(PlanarImageComponent::Y, [width, height]),
                plane(PlanarImageComponent::U, [width / 2, height / 2]),
                plane(PlanarImageComponent::V, [width / 2, height / 2]),
            ]);
        }
    };
    for sample in &track.samples {
        let mut sent = decoder.send_data(bytes[sample.byte_range()].to_vec(), None, None, None);
        while matches!(sent, Err(Error::Again)) {
            take(&mut decoder);
            sent = decoder.send_pending_data();
        }
        sent.unwrap();
    }
    take(&mut decoder);
    assert_eq!(shown.len(), 2 * count);
    assert!(shown[..count] == shown[count..], "the second cycle is the first");

    let mean = |values: &mut dyn Iterator<Item = f64>| {
        let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
        sum / count
    };
    for (i, ((_, rgb, _), [y, u, v])) in frames.iter().zip(&shown).enumerate() {
        let colour = |x: usize, y: usize| -> [f64; 3] {
            let inside = x < across && y < down;
            [0, 1, 2].map(|k| if inside { f64::from(rgb[3 * (y * across + x) + k]) } else { 255.0 })
        };
        let luma = |[r, g, b]: [f64; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let places = || (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let off = places().zip(y).map(|((x, y), found)| {
            let expected = 16.0 + 219.0 / 255.0 * luma(colour(x, y));
            (f64::from(*found) - expected).powi(2)
        });
        let psnr = 10.0 * (255f64.powi(2) / mean(&mut { off })).log10();
        assert!(psnr > 40.0, "frame {i}: {psnr:.1} dB");
        // Chroma on the whole: neither exchanged nor stretched.
        for (plane, channel, scale) in [(u, 2, 1.8556), (v, 0, 1.5748)] {
            let difference = |(x, y)| colour(x, y)[channel] - luma(colour(x, y));
            let expected = 128.0 + 224.0 / 255.0 / scale * mean(&mut places().map(difference));
            let found = mean(&mut plane.iter().map(|sample| f64::from(*sample)));
            assert!((found - expected).abs() < 0.5, "frame {i}, channel {channel}: {found} for {expected}");
        }
    }
}

#[test]
fn an_mp4_of_one_frame_lasts_as_long_and_one_cancelled_half_way_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let (problem, solution) = solved("fundamental", &[]);
    let path = folder.path().join("a.mp4");
    let options = |frames: usize| animation::Options { width: 200, seconds: 1.0, frames };
    animation::write(&path, &problem, &solution, &options(1), &|| (), &Cancel::new()).unwrap();
    let file = re_mp4::Mp4::read_bytes(&fs::read(&path).unwrap()).unwrap();
    let track = file.tracks().values().next().unwrap();
    assert_eq!((track.samples.len(), track.duration), (12, 12 * track.timescale));
    assert!(track.samples.iter().all(|sample| sample.is_sync));
    let cancel = Cancel::new();
    let again = animation::write(&path, &problem, &solution, &options(3), &|| cancel.cancel(), &cancel);
    assert!(matches!(again, Err(ExportError::Cancelled)));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    assert_eq!(re_mp4::Mp4::read_bytes(&fs::read(&path).unwrap()).unwrap().tracks().len(), 1, "the older one is left");
}

#[test]
fn an_apng_and_a_folder_have_all_frames() {
    let folder = tempfile::tempdir().unwrap();
    let (problem, solution) = solved("fundamental", &[]);
    let options = animation::Options { width: 200, seconds: 1.0, frames: 4 };
    let write = |name: &str| {
        let path = folder.path().join(name);
        animation::write(&path, &problem, &solution, &options, &|| (), &Cancel::new()).unwrap()
    };
    let count = animation::count(&solution.recording, &options, Format::Apng);
    assert!(count > 1, "{count}");
    let apng = fs::File::open(&write("a.png")[0]).unwrap();
    let mut reader = png::Decoder::new(std::io::BufReader::new(apng)).read_info().unwrap();
    let control = *reader.info().animation_control().unwrap();
    assert_eq!((control.num_frames as usize, control.num_plays), (count, 0));
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    for _ in 0..count {
        reader.next_frame(&mut pixels).unwrap();
    }
    let written = write("frames");
    assert_eq!(written.len(), count);
    let all: Vec<Vec<u8>> = written.iter().map(|path| decoded(&fs::read(path).unwrap()).1).collect();
    assert!(all.windows(2).all(|pair| pair[0] != pair[1]));
}

#[test]
fn a_cancelled_animation_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let (problem, solution) = solved("fundamental", &[]);
    let options = animation::Options { width: 200, seconds: 1.0, frames: 3 };
    let count = animation::count(&solution.recording, &options, Format::Gif);
    for name in ["a.gif", "a.png", "a.mp4", "frames"] {
        // Before it begins, and when all frames are drawn.
        for enough in [0, count] {
            let (cancel, drawn) = (Cancel::new(), AtomicUsize::new(0));
            if enough == 0 {
                cancel.cancel();
            }
            let done = || {
                if drawn.fetch_add(1, Ordering::Relaxed) + 1 == enough {
                    cancel.cancel();
                }
            };
            let path = folder.path().join(name);
            let error = animation::write(&path, &problem, &solution, &options, &done, &cancel).unwrap_err();
            assert!(matches!(error, ExportError::Cancelled), "{name}: {error}");
        }
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    let path = Path::new("a.avi");
    let refused = animation::write(path, &problem, &solution, &options, &|| (), &Cancel::new());
    assert!(matches!(refused, Err(ExportError::Extension { .. })));
    let empty = Movie::of(0, &options, &|_| Figure::default(), &|| (), &Cancel::new());
    assert!(matches!(empty, Err(ExportError::NoCycle)));
}
