//! Progress on standard error, only if that is a terminal.

use super::terminal;
use crate::control::{Observer, Progress};
use crate::digits::{duration, significant};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, stderr};
use std::time::{Duration, Instant};

const PARTS: u64 = 1000;
const REDRAW: Duration = Duration::from_millis(100);

/// A bar that goes away when it is dropped.
pub(super) struct Bar {
    bar: ProgressBar,
    unit: &'static str,
    history: Vec<Progress>,
    started: Instant,
    before: u64,
}

impl Bar {
    /// For one solve, with forces in `unit`, or for other work whose progress is a share of the whole.
    pub(super) fn solve(unit: &'static str) -> Self {
        Self::new(PARTS, "{spinner} {bar:20} {wide_msg}", unit)
    }

    /// For a number of points, of which `done` are done already; it shows the time left.
    pub(super) fn points(points: usize, done: usize) -> Self {
        let mut bar = Self::new(points as u64, "{spinner} {bar:20} {pos}/{len}  {wide_msg}", "");
        bar.before = done as u64;
        bar.bar.set_position(bar.before);
        bar
    }

    pub(super) fn point_done(&self, point: &str) {
        self.bar.inc(1);
        let (now, all) = (self.bar.position(), self.bar.length().unwrap_or(0));
        let share = now.saturating_sub(self.before) as f64 / all.saturating_sub(self.before).max(1) as f64;
        self.bar.set_message(format!("{}{point}", self.left(share)));
    }

    /// Shows the progress of work whose length is not known.
    pub(super) fn count(&self, reached: &str) {
        self.bar.set_message(reached.to_owned());
    }

    /// Shows the share of the work that is done, 0 to 1.
    pub(super) fn share_done(&self, share: f64, what: &str) {
        self.bar.set_position((PARTS as f64 * share) as u64);
        self.bar.set_message(format!("{}{what}", self.left(share)));
    }

    /// `2.10 min left, `, assuming that the rest goes as fast as what is done.
    fn left(&self, share: f64) -> String {
        let left = self.started.elapsed().as_secs_f64() * (1.0 - share) / share;
        if left.is_finite() { format!("{} left, ", duration(left)) } else { String::new() }
    }

    fn new(length: u64, template: &str, unit: &'static str) -> Self {
        let bar = if stderr().is_terminal() && !terminal::is_quiet() {
            let bar = ProgressBar::with_draw_target(Some(length), ProgressDrawTarget::stderr());
            if let Ok(style) = ProgressStyle::with_template(template) {
                bar.set_style(style.progress_chars("━╸─"));
            }
            bar.enable_steady_tick(REDRAW);
            bar
        } else {
            ProgressBar::hidden()
        };
        Self { bar, unit, history: Vec::new(), started: Instant::now(), before: 0 }
    }

    /// Runs `work`; returns its result and how long it took \[s\]. The bar ends with it.
    pub(super) fn timed<T>(self, work: impl FnOnce(&Self) -> T) -> (T, f64) {
        let done = work(&self);
        (done, self.started.elapsed().as_secs_f64())
    }

    /// The rounds so far.
    pub(super) fn history(&self) -> &[Progress] {
        &self.history
    }

    /// How far the solve came.
    pub(super) fn reached(&self) -> String {
        match self.history.last() {
            None => "before the first round was complete".to_owned(),
            Some(last) => format!("after {}", describe(last, self.unit)),
        }
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

impl Observer for Bar {
    fn progress(&mut self, progress: &Progress) {
        self.history.push(*progress);
        if !self.bar.is_hidden() {
            self.bar.set_position((PARTS as f64 * progress.fraction()) as u64);
            self.bar.set_message(describe(progress, self.unit));
        }
    }
}

fn describe(progress: &Progress, unit: &str) -> String {
    format!(
        "grid {}/{}, round {}: change {:.0e} → {:.0e}, film load {} {unit}",
        progress.level + 1,
        progress.levels,
        progress.iteration,
        progress.residual,
        progress.tolerance,
        significant(progress.film_load, 4),
    )
}
