//! The report on the paper: its tables and figures as one page.

use super::figures::figures;
use super::statements::{share, statements};
use crate::analysis::decision::{effort, sentences};
use crate::analysis::reproduce::{Both, FIELDS, ReproducedRow, Reproduction};
use crate::analysis::validity::outside;
use crate::digits::change;
use crate::export::compare::{again, limits};
use crate::export::html::{CellKind, Page, Table};
use crate::solution::{Solution, Status};

const KICKER: &str = "squeezefilm · the paper, reproduced";
const TITLE: &str = "Effect of the Hydrodynamic Bearing on Rotor/Stator Contact in a Ring-Type Ultrasonic Motor";
const LEAD: &str = "T. Maeno and D. B. Bogy, IEEE Transactions on Ultrasonics, Ferroelectrics, and Frequency Control 39 (1992): every \
    table and figure that the text defines, computed anew. What was published stands beside the same algorithm on the same \
    meshes, and beside the converged solution of the same equations.";

/// Parts of the paper that are not reproduced, and why.
const LEFT_OUT: [&str; 3] = [
    "Fig. 1 is the flow chart of the algorithm. It is not a result; the program follows it literally as method paper.",
    "Fig. 2 is a sketch of rotor and stator with the values of the calculation. The text does not repeat them all: amplitude, spacing, number \
     of teeth and contact width were inferred by fitting Table I (docs/theory.md, section 11), so agreement with the table \
     verifies little by itself. The film and the contact are verified against exact results instead (docs/validation.md).",
    "Fig. 5 shows surfaces measured with an optical profiler after hours of driving. They cannot be computed.",
];

/// The report: one self-contained HTML file. `animation` is a cycle of the fundamental case as GIF, if there is one.
pub fn report(all: &Reproduction, animation: Option<&[u8]>, command: &[String]) -> String {
    let mut page = Page::new(KICKER, TITLE, LEAD);
    let fundamental = all.row("fundamental");
    if let Some(row) = fundamental {
        let short =
            Both::result(&row.both.paper).map_or("–".to_owned(), |result| format!("{:.3}", result.alpha.value));
        page.highlights([
            (row.published.published_alpha.to_string(), "α of the fundamental case as published".to_owned()),
            (short, "the paper's algorithm on the paper's meshes, computed here".to_owned()),
            (share(Both::result(&row.both.ours)), "converged, with the estimated numerical error".to_owned()),
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
    let heads = ["the paper says", "published", "paper's algorithm", "converged", ""];
    let mut table = Table::default().heads(heads.map(|head| (CellKind::Words, head)));
    for statement in statements(all) {
        table.row([
            (CellKind::Words, statement.says.to_owned()),
            (CellKind::Words, statement.published),
            (CellKind::Words, glued(&statement.paper)),
            (CellKind::Words, glued(&statement.converged)),
            (CellKind::Quiet, statement.verdict.to_owned()),
        ]);
    }
    page.table(&table);

    page.section("The figures");
    if let Some(gif) = animation {
        page.picture(
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
        let shown = figures.iter().filter(|(number, _)| numbers.contains(number));
        page.figures(shown.map(|(number, figure)| (format!("Fig. {number}."), figure)));
    }
    page.heading("What is not here, and why");
    page.list(LEFT_OUT);

    page.section("How it was computed");
    if let Some(row) = fundamental {
        for (name, solved) in [("The paper's algorithm", &row.both.paper), ("Converged", &row.both.ours)] {
            if let Ok(solution) = solved {
                page.heading(name);
                page.list(sentences(&solution.model));
            }
        }
        if let Ok(solution) = &row.both.ours {
            limits(&mut page, &outside(&row.both.problem, solution));
        }
        page.folded("the fundamental case as a preset", &row.both.scene.to_toml());
    }
    again(&mut page, command);
    page.finish(&format!("squeezefilm {} · {}", env!("CARGO_PKG_VERSION"), effort(&all.settings, None)))
}

/// Text with a number and its error that is kept on one line.
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

/// `Share α: published 0.238, paper's algorithm 0.238 ± 0.011, converged 0.24586 ± 0.00023. `; empty for other figures.
fn shares(all: &Reproduction, number: u32) -> String {
    let found = FIELDS.iter().find(|(figure, _, _)| *figure == number).and_then(|(_, preset, _)| all.row(preset));
    let Some(row) = found else { return String::new() };
    let with = |solved: &Result<Solution, String>| {
        Both::result(solved).map_or("not solved".to_owned(), |result| result.alpha.to_string())
    };
    format!(
        "Share α: published {:.3}, paper's algorithm {}, converged {}. ",
        row.published.published_alpha,
        glued(&with(&row.both.paper)),
        glued(&with(&row.both.ours))
    )
}

/// `tooth width 1.16 mm`, as the paper names the rows.
fn row_name(row: &ReproducedRow) -> String {
    match row.published.preset.as_str() {
        "fundamental" => "Fundamental case".to_owned(),
        "doubled-mesh" => "p = 101, q = 21, N = 361".to_owned(),
        "min-spacing-100nm" => "Hm = 100 nm".to_owned(),
        preset => {
            let names = [
                ("rotor-width-", "mm", "Rotor width", "mm"),
                ("tooth-width-", "mm", "Teeth width", "mm"),
                ("frequency-", "khz", "Stator frequency", "kHz"),
                ("tooth-radius-", "m", "Teeth radius", "m"),
            ];
            let found = names.iter().find_map(|(begins, ends, words, unit)| {
                let value = preset.strip_prefix(begins)?.strip_suffix(ends)?;
                Some(format!("{words} = {value} {unit}"))
            });
            found.unwrap_or_else(|| preset.to_owned())
        }
    }
}

fn table1(all: &Reproduction) -> Table {
    let of_each = ["load, N", "α", "difference"].map(|head| (CellKind::Number, head));
    let mut table = Table::default()
        .groups([(1, ""), (2, "published"), (3, "paper's algorithm, paper's meshes"), (3, "converged")])
        .heads([&[(CellKind::Words, "changed")][..], &of_each[..2], &of_each, &of_each].concat());
    for row in &all.rows {
        let mut cells = vec![
            (CellKind::Words, row_name(row)),
            (CellKind::Number, format!("{:.3}", row.published.published_load_n)),
            (CellKind::Number, format!("{:.3}", row.published.published_alpha)),
        ];
        for (solved, places, kind) in [(&row.both.paper, 3, CellKind::Number), (&row.both.ours, 4, CellKind::Strong)] {
            match Both::result(solved).filter(|result| result.film_load.value.is_finite()) {
                Some(result) => {
                    let sound = solved.as_ref().is_ok_and(|s| s.status == Status::Converged);
                    cells.push((CellKind::Number, format!("{:.places$}", result.film_load.value)));
                    cells.push((if sound { kind } else { CellKind::Alarm }, result.alpha.to_string()));
                    cells.push((CellKind::Number, change(row.published.difference_percent(result.film_load), 1)));
                }
                _ => cells.extend(["failed", "", ""].map(|words| (CellKind::Alarm, words.to_owned()))),
            }
        }
        table.row(cells);
    }
    table
}
