//! A plate that is dropped, as JSON and as CSV, with the same names, and as a figure.

use super::estimates;
use crate::analysis::validity::Excess;
use crate::estimate::Estimate;
use crate::export::figure::{Axis, Band, Colour, Dash, Figure, Line, Mark, Panel, Provenance, Style};
use crate::fall::{Cycle, Fall};
use crate::fidelity::Fidelity;
use crate::problem::Problem;
use crate::scene::Scene;
use crate::solution::Status;
use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

/// The plate at the end of a cycle of the vibration.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// From 1; 0 is the beginning.
    pub cycle: usize,
    /// Time.
    pub time_us: f64,
    /// Height: the gap without the vibration.
    pub height_um: f64,
    /// Its error.
    pub height_error_um: f64,
    /// Speed, upwards.
    pub speed_mm_per_s: f64,
    /// Whether it rested on its roughness in this cycle.
    pub rests: bool,
}

impl From<Cycle> for Row {
    fn from(cycle: Cycle) -> Self {
        Self {
            cycle: cycle.number,
            time_us: cycle.time * 1e6,
            height_um: cycle.height.value * 1e6,
            height_error_um: cycle.height.error * 1e6,
            speed_mm_per_s: cycle.speed * 1e3,
            rests: cycle.rests,
        }
    }
}

/// The object of `--json`: a fall that ended, and its cycles. What is not known is null.
#[derive(Clone, Copy, Debug)]
pub struct Object<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// How exactly it was solved.
    pub fidelity: Fidelity,
    /// How it ended.
    pub ended: &'a Fall,
    /// The limits of the model that it exceeds.
    pub validity: &'a [Excess],
    /// One for each cycle.
    pub rows: &'a [Row],
    /// Wall time \[s\] by the caller's clock, the periodic solve included.
    pub wall_s: f64,
}

impl Serialize for Object<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { scene, fidelity, ended, validity, rows, wall_s } = self;
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("preset", &scene.name)?;
        map.serialize_entry("scene", scene.scene())?;
        map.serialize_entry("fidelity", &fidelity.to_string())?;
        map.serialize_entry("converged", &(ended.status == Status::Converged))?;
        estimates::add(&mut map, "mean_gap", "_um", floats(ended))?;
        map.serialize_entry("wall_s", wall_s)?;
        map.serialize_entry("rows", rows)?;
        map.serialize_entry("validity", validity)?;
        map.serialize_entry("warnings", &ended.floats.as_ref().err().into_iter().collect::<Vec<_>>())?;
        map.end()
    }
}

/// The mean gap \[µm\] at which it floats; `None` if it does not.
pub fn floats(ended: &Fall) -> Option<Estimate> {
    ended.floats.as_ref().ok().map(|gap| *gap * 1e6)
}

/// Height over time, and where the periodic solve says that it ends, in µm.
pub fn figure(problem: &Problem, rows: &[Row], floats: Option<f64>) -> Figure {
    let band = rows
        .iter()
        .map(|row| [row.time_us * 1e-3, row.height_um - row.height_error_um, row.height_um + row.height_error_um]);
    let line = rows.iter().map(|row| [row.time_us * 1e-3, row.height_um]);
    let mut panel = Panel::new("", Axis::new("t", "ms"), Axis::new("height", "µm").including([0.0]))
        .layer(Band::new("error", band, Colour::FILM))
        .layer(Line::new("height", line, Style::solid(Colour::FILM)));
    if let Some(gap) = floats {
        let mut mark = Mark::horizontal(gap, "periodic solve");
        mark.style = Style::solid(Colour::ROTOR).dash(Dash::Dashed);
        panel = panel.layer(mark);
    }
    let mut figure = Figure::new("dropped on the vibration").panel(panel);
    figure.caption = "Height of the plate, the gap without the vibration, from where it is dropped.".to_owned();
    figure.provenance = Provenance::named(&problem.name);
    figure
}
