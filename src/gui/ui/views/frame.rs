//! A run at one instant, as its views draw it.

use crate::fidelity::Fidelity;
use crate::gui::derived::scales::{Ranges, Scales};
use crate::gui::state::view::View;
use crate::gui::ui::cache::once;
use crate::job::SolvedScene;
use crate::problem::Scenario;
use crate::recording::Recording;
use crate::recording::sample::Lines;
use eframe::egui::Ui;
use std::sync::Arc;

/// A motor or a plate at one instant.
pub(super) struct Frame<'a, T> {
    /// Number of the run, and its fidelity.
    pub(super) run: (u64, Fidelity),
    pub(super) recording: &'a Recording,
    /// The motor, or the plate.
    pub(super) of: &'a T,
    /// Curves over the whole cycle.
    pub(super) scales: Arc<Scales>,
    pub(super) ranges: Ranges,
    /// The instant, in frames.
    pub(super) place: f64,
    pub(super) lines: Lines,
    pub(super) view: &'a View,
    pub(super) tooth: usize,
    /// The run for comparison, at the same phase of its own cycle, drawn behind this one in grey.
    pub(super) first: Option<Box<Self>>,
}

impl<'a, T> Frame<'a, T> {
    /// `run` at the phase of `view`, and behind it `first`, with common ranges of the axes, or with the ranges `within`; `None` if its
    /// scenario is not the one that `pick` picks. `name` is the key under which its curves are cached.
    pub(super) fn of(
        ui: &Ui,
        name: &str,
        (run, first): (&'a SolvedScene, Option<&'a SolvedScene>),
        within: Option<Ranges>,
        pick: fn(&Scenario) -> Option<&T>,
        view: &'a View,
    ) -> Option<Self> {
        let first = first.and_then(|first| Self::of(ui, "scales of the first run", (first, None), None, pick, view));
        let (recording, number) = (&run.solution.recording, (run.number, run.fidelity));
        let of = pick(&run.problem.scenario)?;
        let scales = once(ui, name, number, || Scales::new(recording));
        let both = first.as_ref().map_or(scales.ranges, |first| scales.ranges.and(first.ranges));
        let (ranges, place) = (within.unwrap_or(both), view.place(recording));
        let (lines, tooth) = (Lines::at(recording, place), view.tooth.min(recording.teeth.saturating_sub(1)));
        let first = first.map(Box::new);
        Some(Self { run: number, recording, of, scales, ranges, place, lines, view, tooth, first })
    }

    /// x at the left and at the right end \[m\].
    pub(super) fn x_range(&self) -> [f64; 2] {
        let half = 0.5 * self.recording.pitch;
        [-half, self.recording.length - half]
    }

    /// The ends of the followed tooth \[m\].
    pub(super) fn followed(&self) -> [f64; 2] {
        let middle = self.tooth as f64 * self.recording.pitch;
        let reach = self.recording.x.last().copied().unwrap_or(0.0);
        [middle - reach, middle + reach]
    }

    pub(super) fn phase(&self) -> f64 {
        self.place / self.recording.frames.max(1) as f64
    }
}
