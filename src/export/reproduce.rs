//! The paper's tables and figures as one report: published numbers beside those of its own algorithm and the converged ones.

use super::compare::{again, limits};
use super::figure::{
    Axis, Band, Colour, Dash, Figure, Legend, Line, Marker, Panel, Points, Provenance, Shape, Style, Width,
};
use super::figures::compare::{MotorRun, contact_pressures, film_pressures};
use super::figures::motor::{crest_in_the_middle, surfaces};
use super::html::{Kind, Page, Table};
use crate::analysis::decision::sentences;
use crate::analysis::reproduce::{Both, FIELDS, Reproduction, Row};
use crate::analysis::validity::outside;
use crate::digits::{significant, with_error};
use crate::problem::{Motor, RotorCompliance, Scenario};
use crate::recording::Recording;
use crate::solution::{MotorResult, Solution, Status};
use serde::Serialize;
use std::io::{self, Write};

/// The version of the object and of the columns.
pub const SCHEMA: u32 = 1;

const KICKER: &str = "squeezefilm · the paper, reproduced";
const TITLE: &str = "Effect of the Hydrodynamic Bearing on Rotor/Stator Contact in a Ring-Type Ultrasonic Motor";
const LEAD: &str = "T. Maeno and D. B. Bogy, IEEE Transactions on Ultrasonics, Ferroelectrics, and Frequency Control 39 (1992): every \
    table and figure that the text defines, computed anew. What was published stands beside the same algorithm on the same \
    meshes, and beside the converged solution of the same equations.";

/// A row of Table I. What was not computed is null.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RowObject {
    /// Name of the row.
    pub row: String,
    /// The built-in preset.
    pub preset: String,
    /// Film load as published \[N\].
    pub published_load_n: f64,
    /// α as published.
    pub published_alpha: f64,
    /// Film load by the paper's algorithm on its own meshes \[N\].
    pub paper_load_n: Option<f64>,
    /// α by it.
    pub paper_alpha: Option<f64>,
    /// Its estimated error, absolute.
    pub paper_alpha_error: Option<f64>,
    /// By how much that load exceeds the published one \[%\].
    pub paper_difference_percent: Option<f64>,
    /// Film load, converged \[N\].
    pub film_load_n: Option<f64>,
    /// α, converged.
    pub alpha: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub alpha_error: Option<f64>,
    /// By how much that load exceeds the published one \[%\].
    pub difference_percent: Option<f64>,
}

impl RowObject {
    /// The object of a row.
    pub fn new(row: &Row) -> Self {
        let (paper, ours) = (Both::result(&row.both.paper), Both::result(&row.both.ours));
        let finite = |value: Option<f64>| value.filter(|value| value.is_finite());
        let published = &row.published;
        let difference = |load: f64| 100.0 * (load / published.published_load_n - 1.0);
        Self {
            row: published.row.clone(),
            preset: published.preset.clone(),
            published_load_n: published.published_load_n,
            published_alpha: published.published_alpha,
            paper_load_n: finite(paper.map(|r| r.film_load)),
            paper_alpha: finite(paper.map(|r| r.alpha)),
            paper_alpha_error: finite(paper.map(|r| r.alpha_error)),
            paper_difference_percent: finite(paper.map(|r| difference(r.film_load))),
            film_load_n: finite(ours.map(|r| r.film_load)),
            alpha: finite(ours.map(|r| r.alpha)),
            alpha_error: finite(ours.map(|r| r.alpha_error)),
            difference_percent: finite(ours.map(|r| difference(r.film_load))),
        }
    }
}

/// A point of Fig. 10. What was not computed is null.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PointObject {
    /// Frequency \[kHz\].
    pub frequency_khz: f64,
    /// α, converged.
    pub alpha: Option<f64>,
    /// Its estimated numerical error, absolute.
    pub alpha_error: Option<f64>,
}

/// The object of `--json`.
#[derive(Clone, Debug, Serialize)]
pub struct Object<'a> {
    /// [`SCHEMA`].
    pub schema: u32,
    /// Of the converged values: `draft`, `standard`, ….
    pub fidelity: String,
    /// Table I.
    pub table1: Vec<RowObject>,
    /// Fig. 10.
    pub fig10: Vec<PointObject>,
    /// What the text says, and what came of it.
    pub statements: Vec<Statement>,
    /// Solves that did not converge.
    pub unsolved: usize,
    /// Version of this program.
    pub version: &'static str,
    /// The command line, word by word; empty if there was none.
    pub command: &'a [String],
}

impl<'a> Object<'a> {
    /// The object of a reproduction.
    pub fn new(all: &Reproduction, command: &'a [String]) -> Self {
        let point = |point: &crate::analysis::reproduce::Point| PointObject {
            frequency_khz: point.frequency_khz,
            alpha: point.solved.as_ref().ok().map(|result| result.alpha),
            alpha_error: point.solved.as_ref().ok().map(|result| result.alpha_error),
        };
        Self {
            schema: SCHEMA,
            fidelity: all.settings.fidelity.to_string(),
            table1: all.rows.iter().map(RowObject::new).collect(),
            fig10: all.frequencies.iter().map(point).collect(),
            statements: statements(all),
            unsolved: all.unsolved(),
            version: env!("CARGO_PKG_VERSION"),
            command,
        }
    }
}

/// Writes Table I as CSV, the header first; what was not computed is empty.
///
/// # Errors
/// Those of the writer.
pub fn write_table1_csv(all: &Reproduction, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    for row in &all.rows {
        writer.serialize(RowObject::new(row))?;
    }
    writer.flush()
}

/// One statement of the paper's text, with the numbers it stands on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Statement {
    /// The statement, in the paper's words or nearly.
    pub says: &'static str,
    /// What the paper gives for it.
    pub published: String,
    /// By its algorithm on its own meshes.
    pub paper: String,
    /// Converged.
    pub converged: String,
    /// What to make of it.
    pub verdict: &'static str,
}

/// The statements of the text that have numbers.
pub fn statements(all: &Reproduction) -> Vec<Statement> {
    let both = |preset: &str| all.row(preset).map(|row| &row.both);
    let load = |preset: &str, paper: bool| {
        let both = both(preset)?;
        Both::result(if paper { &both.paper } else { &both.ours }).map(|result| result.film_load)
    };
    let published = |preset: &str| all.row(preset).map_or(f64::NAN, |row| row.published.published_load_n);
    let alpha = |both: &Both, paper: bool| {
        Both::result(if paper { &both.paper } else { &both.ours }).map(|result| (result.alpha, result.alpha_error))
    };
    let words = |value: Option<f64>, unit: &str| {
        value.map_or("–".to_owned(), |value| format!("{}{unit}", significant(value, 3)))
    };
    let with = |value: Option<(f64, f64)>| value.map_or("–".to_owned(), |(value, error)| with_error(value, error));
    let fundamental = |paper| both("fundamental").and_then(|both| alpha(both, paper));
    let mut list = Vec::new();

    let doubled = |paper: bool| Some(1e3 * (load("doubled-mesh", paper)? - load("fundamental", paper)?));
    let remaining = load("fundamental", false).zip(load("fundamental", true)).map(|(ours, paper)| 1e3 * (ours - paper));
    list.push(Statement {
        says: "Doubling the mesh changes the film load by only 12\u{a0}mN, so the division number is large enough.",
        published: "12 mN".to_owned(),
        paper: words(doubled(true), " mN"),
        converged: format!("{} more without the mesh", words(remaining, " mN")),
        verdict: "The 12 mN are confirmed, the conclusion is not: the mesh leaves about 3 % of the film load out.",
    });
    list.push(Statement {
        says: "α of the fundamental case is 0.24.",
        published: "0.238".to_owned(),
        paper: with(fundamental(true)),
        converged: with(fundamental(false)),
        verdict: "Confirmed; 0.246 without the error of the mesh.",
    });
    let of = |both: &Both| (alpha(both, true), alpha(both, false));
    let (paper, ours) = of(&all.no_sliding);
    list.push(Statement {
        says: "Neglecting the shear velocity, α is almost the same: squeeze is very much larger than wedge.",
        published: "almost the same".to_owned(),
        paper: with(paper),
        converged: with(ours),
        verdict: "Confirmed: the difference is smaller than the error.",
    });
    list.push(Statement {
        says: "With a minimum spacing of 100\u{a0}nm, α is up to 0.48.",
        published: "0.481".to_owned(),
        paper: with(both("min-spacing-100nm").and_then(|both| alpha(both, true))),
        converged: with(both("min-spacing-100nm").and_then(|both| alpha(both, false))),
        verdict: "Confirmed: half the spacing, twice the share.",
    });
    let ratio = |of: &dyn Fn(&str) -> Option<f64>| {
        let (narrow, wide) = (of("tooth-width-1.16mm")?, of("tooth-width-2.31mm")?);
        Some((wide / narrow, of("rotor-width-0.6mm")? / of("fundamental")?))
    };
    let pair = |ratio: Option<(f64, f64)>| {
        ratio.map_or("–".to_owned(), |(teeth, rotor)| format!("×\u{a0}{teeth:.2} teeth, ×\u{a0}{rotor:.2} rotor"))
    };
    list.push(Statement {
        says: "The film load is proportional to the interface area (teeth or rotor twice as wide).",
        published: pair(ratio(&|preset| Some(published(preset)))),
        paper: pair(ratio(&|preset| load(preset, true))),
        converged: pair(ratio(&|preset| load(preset, false))),
        verdict: "Confirmed for the teeth. For the rotor a little more than that: gas escapes from a wide face more slowly.",
    });
    let (soft_paper, soft) = (Both::result(&all.softer.paper), Both::result(&all.softer.ours));
    let stiff = both("fundamental").and_then(|both| Both::result(&both.ours));
    let touching = |result: Option<&MotorResult>| {
        result.map_or("–".to_owned(), |result| {
            format!("{} on {:.2} teeth", with_error(result.alpha, result.alpha_error), result.teeth_in_contact)
        })
    };
    list.push(Statement {
        says: "A low rotor stiffness leads to a large contact area and large α (here: 1.2\u{a0}times as soft).",
        published: "larger".to_owned(),
        paper: touching(soft_paper),
        converged: touching(soft),
        verdict: match (soft, stiff) {
            (Some(soft), Some(stiff)) if soft.teeth_in_contact <= stiff.teeth_in_contact => "Not confirmed.",
            (Some(soft), Some(stiff)) if soft.alpha > stiff.alpha => "Confirmed.",
            (Some(_), Some(_)) => {
                "The larger contact area is confirmed. α falls: the fitted rotor follows the wave better, so its gaps change less. The \
                 paper gives no number, and its rotor is not known in full."
            }
            _ => "",
        },
    });
    let ends = |paper| {
        let at = |preset: &str| both(preset).and_then(|both| alpha(both, paper)).map(|(alpha, _)| alpha);
        at("frequency-3khz").zip(at("frequency-100khz"))
    };
    let range = |ends: Option<(f64, f64)>| ends.map_or("–".to_owned(), |(a, b)| format!("{a:.3} to {b:.3}"));
    list.push(Statement {
        says: "When the frequency is higher, α is larger (3 to 100\u{a0}kHz).",
        published: "0.078 to 0.257".to_owned(),
        paper: range(ends(true)),
        converged: range(ends(false)),
        verdict: "Confirmed. The uniform mesh loses more at high frequency, where the boundary layer is thinner.",
    });
    let radii = |paper| {
        let at = |preset: &str| both(preset).and_then(|both| alpha(both, paper)).map(|(alpha, _)| alpha);
        at("tooth-radius-3m").zip(at("tooth-radius-10m"))
    };
    list.push(Statement {
        says: "With crowned teeth (3 to 10\u{a0}m) the film's pressure and α scarcely change.",
        published: "0.235 to 0.239".to_owned(),
        paper: range(radii(true)),
        converged: range(radii(false)),
        verdict: "Confirmed.",
    });
    let torque = |paper: bool| fundamental(paper).map(|(alpha, _)| 0.7 * (1.0 - alpha) * 14.7 * 0.029);
    list.push(Statement {
        says: "Eq. (12): T\u{a0}=\u{a0}μ\u{a0}(1\u{a0}−\u{a0}α)\u{a0}L\u{a0}r with μ\u{a0}=\u{a0}0.7, L\u{a0}=\u{a0}14.7\u{a0}N, r\u{a0}=\u{a0}29\u{a0}mm; measured 0.17\u{a0}N·m, which needs α\u{a0}≈\u{a0}0.43.",
        published: format!("{:.3} N·m", 0.7 * (1.0 - 0.238) * 14.7 * 0.029),
        paper: words(torque(true), " N·m"),
        converged: words(torque(false), " N·m"),
        verdict: "As the paper says: the film explains a part of the gap to the measured torque, not all of it.",
    });
    list
}

/// What of the paper is not in here, and why.
const LEFT_OUT: [&str; 3] = [
    "Fig. 1 is the flow chart of the algorithm. It is not a result; the program follows it literally as method paper.",
    "Fig. 2 is a sketch of rotor and stator with the values of the calculation. The text does not repeat them all: amplitude, spacing, number \
     of teeth and contact width were inferred by fitting Table I (docs/theory.md, section 11), so agreement with the table \
     verifies little by itself. The film and the contact are verified against exact results instead (docs/validation.md).",
    "Fig. 5 shows surfaces measured with an optical profiler after hours of driving. They cannot be computed.",
];

/// The number of a figure, and the figure; those that could not be solved are left out.
pub fn figures(all: &Reproduction) -> Vec<(u32, Figure)> {
    let mut figures = Vec::new();
    if let Some(figure) = all.row("fundamental").and_then(|row| green(&row.both)) {
        figures.push((3, figure));
    }
    figures.extend(FIELDS.iter().filter_map(|(number, preset, name)| {
        let row = all.row(preset)?;
        Some((*number, fields(&row.both, &format!("Fig. {number}: {name}"))?))
    }));
    figures.push((10, frequencies(all)));
    figures.sort_by_key(|(number, _)| *number);
    for (_, figure) in &mut figures {
        figure.provenance.version = env!("CARGO_PKG_VERSION").to_owned();
    }
    figures
}

/// Deflection of the rotor under a point load.
fn green(both: &Both) -> Option<Figure> {
    let Scenario::Motor(motor) = &both.problem.scenario else { return None };
    let RotorCompliance::Beam { decay_length, point_compliance, local_compliance } = motor.rotor else { return None };
    let half = 0.5 * motor.wavelength();
    let beam = |x: f64| {
        let s = x.abs() / decay_length;
        point_compliance * (-s).exp() * (s.cos() + s.sin())
    };
    let points = (-200..=200).map(|i| f64::from(i) / 200.0 * half).map(|x| [x * 1e3, beam(x) * 1e6]);
    let spacing = motor.wavelength() / 180.0;
    let nodes = (-90..=90).map(|j| (f64::from(j) * spacing, if j == 0 { local_compliance / spacing } else { 0.0 }));
    let nodes = nodes.map(|(x, local)| [x * 1e3, (beam(x) + local) * 1e6]);
    let marker = Marker { size: 2.4, ..Marker::solid(Shape::Circle) };
    let panel = Panel::new(
        "",
        Axis::new("x from the load", "mm").fixed(-half * 1e3, half * 1e3),
        Axis::new("deflection", "µm/N").including([0.0]),
    )
    .layer(Points::new("on the 181 nodes, with the local compliance", nodes, Colour::BLACK, marker))
    .layer(Line::new("beam on an elastic foundation", points, Style::solid(Colour::FILM)))
    .height(44.0);
    let mut figure = Figure::new("Fig. 3: deflection of the rotor under a unit point load").panel(panel);
    figure.panels[0].legend = Legend::Above;
    figure.width = Width::Millimetres(110.0);
    figure.caption = "The paper took this Green's function from a finite element model of the rotor (2162 elements) and shows it as a curve, \
                      which is not known to us. Here it is the beam that was fitted to Table I; the point at the load carries the local \
                      compliance, spread over one contact spacing."
        .to_owned();
    figure.provenance.preset = both.problem.name.clone();
    Some(figure)
}

const PAPER: &str = "paper's algorithm";
const OURS: &str = "converged";

fn recording(solved: &Result<Solution, String>) -> Option<&Recording> {
    let recording = &solved.as_ref().ok()?.recording;
    (recording.frames > 0).then_some(recording)
}

/// Surfaces, contact pressure and film pressure at the crest in the middle, as the paper's figures, by both methods.
fn fields(both: &Both, title: &str) -> Option<Figure> {
    let Scenario::Motor(motor) = &both.problem.scenario else { return None };
    let motor: &Motor = motor;
    let ours = recording(&both.ours)?;
    let frame = crest_in_the_middle(ours);
    let phase = frame as f64 / ours.frames as f64;
    let run = |name, recording, style| MotorRun { name, motor, recording, style };
    let mut contact = vec![run(OURS, ours, Style::solid(Colour::CONTACT))];
    let mut film = vec![run(OURS, ours, Style::solid(Colour::FILM))];
    if let Some(paper) = recording(&both.paper) {
        let style = Style { width: 0.8, ..Style::solid(Colour::BLACK).dash(Dash::Dotted) };
        contact.push(run(PAPER, paper, style));
        film.push(run(PAPER, paper, style));
    }
    let legend = |panel: Panel| Panel { legend: Legend::Above, ..panel };
    let mut figure = Figure::new(title)
        .panel(surfaces(motor, ours, frame).height(36.0))
        .panel(legend(contact_pressures(&contact, phase, "(b) contact pressure").height(28.0)))
        .panel(legend(film_pressures(&film, phase, "(c) film pressure, gauge").height(28.0)));
    figure.share_x = true;
    figure.width = Width::Millimetres(115.0);
    figure.provenance = match &both.ours {
        Ok(solution) => Provenance::of(&both.problem, solution),
        Err(_) => Provenance::default(),
    };
    Some(figure)
}

/// α over the frequency, with the published points.
fn frequencies(all: &Reproduction) -> Figure {
    let value = |point: &crate::analysis::reproduce::Point| {
        point.solved.as_ref().map_or((f64::NAN, f64::NAN), |result| (result.alpha, result.alpha_error))
    };
    let band = all.frequencies.iter().map(|point| {
        let (alpha, error) = value(point);
        [point.frequency_khz, alpha - error, alpha + error]
    });
    let curve = all.frequencies.iter().map(|point| [point.frequency_khz, value(point).0]);
    let (mut published, mut paper) = (Vec::new(), Vec::new());
    for row in &all.rows {
        let name = row.published.preset.as_str();
        if name != "fundamental" && !name.starts_with("frequency-") {
            continue;
        }
        let Scenario::Motor(motor) = &row.both.problem.scenario else { continue };
        published.push([motor.frequency * 1e-3, row.published.published_alpha]);
        if let Some(result) = Both::result(&row.both.paper) {
            paper.push([motor.frequency * 1e-3, result.alpha]);
        }
    }
    let panel = Panel::new("", Axis::new("frequency of the stator", "kHz").log(), Axis::new("α", "").including([0.0]))
        .layer(Band::new("stated error", band, Colour::FILM))
        .layer(Line::new(OURS, curve, Style::solid(Colour::FILM)))
        .layer(Points::new(
            "published",
            published,
            Colour::CONTACT,
            Marker { size: 6.0, ..Marker::hollow(Shape::Square) },
        ))
        .layer(Points::new(PAPER, paper, Colour::BLACK, Marker { size: 2.6, ..Marker::solid(Shape::Circle) }))
        .height(52.0);
    let mut figure = Figure::new("Fig. 10: effect of the stator vibrating frequency").panel(panel);
    figure.width = Width::Millimetres(110.0);
    figure.caption = "The ratio α over the frequency, all else as in the fundamental case. Published: the rows of Table I, whose points \
                      Fig. 10 shows. The stated error is narrower than the line nearly everywhere."
        .to_owned();
    figure.provenance.preset = "Fundamental case".to_owned();
    figure
}

/// The report: one HTML file that needs nothing else. `animation`: a cycle of the fundamental case as GIF, if there is one.
pub fn report(all: &Reproduction, animation: Option<&[u8]>, command: &[String]) -> String {
    let mut page = Page::new(KICKER, TITLE, LEAD);
    let fundamental = all.row("fundamental");
    let alpha = |solved: &Result<Solution, String>| {
        Both::result(solved).map_or("–".to_owned(), |result| with_error(result.alpha, result.alpha_error))
    };
    if let Some(row) = fundamental {
        let short = Both::result(&row.both.paper).map_or("–".to_owned(), |result| format!("{:.3}", result.alpha));
        page.highlights([
            (row.published.published_alpha.to_string(), "α of the fundamental case as published".to_owned()),
            (short, "the paper's algorithm on the paper's meshes, computed here".to_owned()),
            (alpha(&row.both.ours), "converged, with the estimated numerical error".to_owned()),
        ]);
    }
    if all.unsolved() > 0 {
        page.warning(&format!("{} solves did not converge; they are marked.", all.unsolved()));
    }

    page.section("Table I: load of the air film, and its share α");
    page.table(&table1(all));
    page.note(
        "Difference: film load against the published one. The ± of the paper's algorithm is what its mesh costs, scaled from doubling it; that \
         of the converged values is estimated from three nested grids. Rotor width 0.6 mm comes out high in both: the paper's wider \
         rotor was probably stiffer as well, and here only its width differs.",
    );

    page.section("What the text says, checked");
    let mut table = Table::new("").heads([
        (Kind::Words, "the paper says"),
        (Kind::Words, "published"),
        (Kind::Words, "paper's algorithm"),
        (Kind::Words, "converged"),
        (Kind::Words, ""),
    ]);
    for statement in statements(all) {
        table.row([
            (Kind::Words, statement.says.to_owned()),
            (Kind::Words, statement.published),
            (Kind::Words, glued(&statement.paper)),
            (Kind::Words, glued(&statement.converged)),
            (Kind::Quiet, statement.verdict.to_owned()),
        ]);
    }
    page.table(&table);

    page.section("The figures");
    if let Some(gif) = animation {
        page.picture(
            "image/gif",
            gif,
            "One cycle of the fundamental case, animated",
            "The fundamental case, moving.",
            "Surfaces, pressure of contact and film on the teeth, and the film from above. The paper shows one instant of this.",
        );
    }
    page.text(
        "Figs. 4, 6–9, 11 and 12 all show one instant: the crest of the wave on the middle tooth, above the displacements of stator and rotor, \
         below the pressures. The wave travels to the left, the rotor is driven to the right. Here the surfaces and the coloured lines \
         are converged; dots are the paper's algorithm on its own meshes.",
    );
    let mut figures = figures(all);
    for (number, figure) in &mut figures {
        figure.caption = format!("{}{}", shares(all, *number), figure.caption);
    }
    for (heading, numbers) in SECTIONS {
        page.heading(heading);
        let of = |(number, figure): &'_ (u32, Figure)| {
            numbers.contains(number).then(|| (format!("Fig. {number}."), figure.clone()))
        };
        let shown: Vec<(String, Figure)> = figures.iter().filter_map(of).collect();
        page.figures(shown.iter().map(|(name, figure)| (name.as_str(), figure)));
    }
    page.heading("What is not here, and why");
    page.list(LEFT_OUT);

    page.section("How it was computed");
    if let Some(row) = fundamental {
        for (name, solved) in [("The paper's algorithm", &row.both.paper), ("Converged", &row.both.ours)] {
            if let Ok(solution) = solved {
                page.heading(name);
                page.list(&sentences(&solution.model));
            }
        }
        if let Ok(solution) = &row.both.ours {
            limits(&mut page, &outside(&row.both.problem, Some(solution)));
        }
        page.folded("the fundamental case as a preset", &row.both.scene.to_toml());
    }
    again(&mut page, command);
    page.finish(&format!("squeezefilm {} · fidelity {}", env!("CARGO_PKG_VERSION"), all.settings.fidelity))
}

/// A number and its error on one line.
fn glued(words: &str) -> String {
    words.replace(" ± ", "\u{a0}±\u{a0}")
}

/// The sections of the paper, and their figures.
const SECTIONS: [(&str, &[u32]); 5] = [
    ("A. Fundamental case", &[3, 4]),
    ("B. Effect of surface roughness", &[6]),
    ("C. Effect of contact area", &[7, 8]),
    ("D. Effect of vibrating frequency", &[9, 10]),
    ("E. Effect of teeth geometry", &[11, 12]),
];

/// `Share α: published 0.238, paper's algorithm 0.238 ± 0.011, converged 0.24586 ± 0.00023. `; of other figures nothing.
fn shares(all: &Reproduction, number: u32) -> String {
    let found = FIELDS.iter().find(|(figure, _, _)| *figure == number).and_then(|(_, preset, _)| all.row(preset));
    let Some(row) = found else { return String::new() };
    let with = |solved: &Result<Solution, String>| {
        Both::result(solved).map_or("not solved".to_owned(), |result| with_error(result.alpha, result.alpha_error))
    };
    format!(
        "Share α: published {:.3}, paper's algorithm {}, converged {}. ",
        row.published.published_alpha,
        glued(&with(&row.both.paper)),
        glued(&with(&row.both.ours))
    )
}

/// `tooth width 1.16 mm`, as the paper names the rows.
fn row_name(row: &Row) -> String {
    match row.published.preset.as_str() {
        "fundamental" => "Fundamental case".to_owned(),
        "doubled-mesh" => "p = 101, q = 21, N = 361".to_owned(),
        "min-spacing-100nm" => "Hm = 100 nm".to_owned(),
        preset => {
            let names = [
                ("rotor-width-", "Rotor width = ", "mm"),
                ("tooth-width-", "Teeth width = ", "mm"),
                ("frequency-", "Stator frequency = ", "khz"),
                ("tooth-radius-", "Teeth radius = ", "m"),
            ];
            let unit = |unit: &str| if unit == "khz" { "kHz".to_owned() } else { unit.to_owned() };
            let found = names.iter().find_map(|(begins, words, ends)| {
                let value = preset.strip_prefix(begins)?.strip_suffix(ends)?;
                Some(format!("{words}{value} {}", unit(ends)))
            });
            found.unwrap_or_else(|| preset.to_owned())
        }
    }
}

fn table1(all: &Reproduction) -> Table {
    let mut table = Table::new("")
        .groups([(1, ""), (2, "published"), (3, "paper's algorithm, paper's meshes"), (3, "converged")])
        .heads([
            (Kind::Words, "changed"),
            (Kind::Number, "load, N"),
            (Kind::Number, "α"),
            (Kind::Number, "load, N"),
            (Kind::Number, "α"),
            (Kind::Number, "difference"),
            (Kind::Number, "load, N"),
            (Kind::Number, "α"),
            (Kind::Number, "difference"),
        ]);
    for row in &all.rows {
        let object = RowObject::new(row);
        let mut cells = vec![
            (Kind::Words, row_name(row)),
            (Kind::Number, format!("{:.3}", object.published_load_n)),
            (Kind::Number, format!("{:.3}", object.published_alpha)),
        ];
        let both = [
            (&row.both.paper, object.paper_load_n, object.paper_difference_percent, 3, Kind::Number),
            (&row.both.ours, object.film_load_n, object.difference_percent, 4, Kind::Strong),
        ];
        for (solved, load, difference, places, kind) in both {
            match (Both::result(solved), load, difference) {
                (Some(result), Some(load), Some(difference)) => {
                    let sound = solved.as_ref().is_ok_and(|s| s.status == Status::Converged);
                    cells.push((Kind::Number, format!("{load:.places$}")));
                    cells.push((if sound { kind } else { Kind::Alarm }, with_error(result.alpha, result.alpha_error)));
                    cells.push((Kind::Number, format!("{difference:+.1} %").replace('-', "−")));
                }
                _ => cells.extend(["failed", "", ""].map(|words| (Kind::Alarm, words.to_owned()))),
            }
        }
        table.row(cells);
    }
    table
}
