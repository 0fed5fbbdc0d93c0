//! The curve of error against time from the runs, and the choice of a setting that meets a target.

use super::measure::MeasuredSetting;
use crate::analysis::attempt::RunStatus;
use crate::analysis::quantity::Quantity;
use crate::solve::Method;
use serde::{Deserialize, Serialize};

/// A setting on the curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TradeoffPoint {
    /// The setting, with its measured solves.
    pub run: MeasuredSetting,
    /// Median time \[s\]; NaN before the first run.
    pub median: f64,
    /// Lower and upper quartile of the time \[s\].
    pub quartiles: (f64, f64),
    /// Its distance from the reference plus the reference's own error, a share of the value that is judged; `None` unless
    /// it converged and there is a reference.
    pub measured: Option<f64>,
    /// Its stated error, as a share of the value that is judged.
    pub stated: Option<f64>,
    /// The greater of the two, by which it is judged.
    pub error: Option<f64>,
    /// Whether no other setting is both faster and more accurate.
    pub best: bool,
}

/// The user's target: an accuracy or a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// An error of at most this share of the value that is judged.
    Accuracy(f64),
    /// A time of at most this \[s\].
    Budget(f64),
}

/// Error against time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tradeoff {
    /// All settings, in the order they were measured.
    pub points: Vec<TradeoffPoint>,
    /// The setting that the others are judged by: the one with the least stated error.
    pub reference: Option<usize>,
    /// The number that is judged: α, a plate's film load, or the mean gap of a plate that floats.
    pub judged: Quantity,
}

impl Tradeoff {
    /// The curve from these runs, finished or not.
    pub fn of(runs: &[MeasuredSetting]) -> Self {
        let known = |quantity| runs.iter().any(|run| run.numbers.get(quantity).is_some());
        let judged = match () {
            () if known(Quantity::MeanGap) => Quantity::MeanGap,
            () if known(Quantity::LoadRatio) => Quantity::FilmLoad,
            () => Quantity::Alpha,
        };
        let value =
            |run: &MeasuredSetting| (run.status == RunStatus::Converged).then(|| run.numbers.get(judged)).flatten();
        let stated = |run: &MeasuredSetting| run.numbers.get(judged.error()?);
        let reference = runs
            .iter()
            .enumerate()
            .filter(|(_, run)| run.candidate.settings.method == Method::Auto && value(run).is_some())
            .filter_map(|(i, run)| Some((i, stated(run)?)))
            .min_by(|a, b| a.1.total_cmp(&b.1));
        let truth = reference.and_then(|(i, error)| Some((value(&runs[i])?, error)));
        let share = |error: f64| truth.map(|(truth, _)| error / truth.abs().max(f64::MIN_POSITIVE));
        let mut points: Vec<TradeoffPoint> = runs
            .iter()
            .map(|run| {
                let mut times = run.times.clone();
                times.sort_by(f64::total_cmp);
                let distance = truth.zip(value(run)).map(|((truth, error), value)| (value - truth).abs() + error);
                let measured = distance.and_then(share);
                let stated = stated(run).and_then(share);
                TradeoffPoint {
                    run: run.clone(),
                    median: quantile(&times, 0.5),
                    quartiles: (quantile(&times, 0.25), quantile(&times, 0.75)),
                    measured,
                    stated,
                    error: measured.zip(stated).map(|(measured, stated)| measured.max(stated)),
                    best: false,
                }
            })
            .collect();
        let costs: Vec<Option<(f64, f64)>> = points.iter().map(|point| Some((point.median, point.error?))).collect();
        for (point, best) in points.iter_mut().zip(front(&costs)) {
            point.best = best;
        }
        Self { points, reference: reference.map(|(i, _)| i), judged }
    }

    /// Name of the number whose errors the curve shows, in a word or two.
    pub fn of_what(&self) -> &'static str {
        match self.judged {
            Quantity::Alpha => "α",
            Quantity::MeanGap => "the mean gap",
            _ => "the film load",
        }
    }

    /// The cheapest setting that meets an accuracy, or the most accurate within a budget; `None` if there is none.
    pub fn choose(&self, target: Target) -> Option<usize> {
        let known = self.points.iter().enumerate().filter_map(|(i, point)| Some((i, point.median, point.error?)));
        let best = match target {
            Target::Accuracy(most) => known.filter(|(.., error)| *error <= most).min_by(|a, b| a.1.total_cmp(&b.1)),
            Target::Budget(most) => known.filter(|(_, time, _)| *time <= most).min_by(|a, b| a.2.total_cmp(&b.2)),
        };
        best.map(|(i, ..)| i)
    }
}

/// Which of these (time, error) belong to the front: no other is at least as good in both and better in one. Unknown ones do not belong to
/// it.
fn front(costs: &[Option<(f64, f64)>]) -> Vec<bool> {
    let beaten = |(time, error): (f64, f64)| {
        costs.iter().flatten().any(|(t, e)| *t <= time && *e <= error && (*t < time || *e < error))
    };
    costs.iter().map(|cost| cost.is_some_and(|cost| !beaten(cost))).collect()
}

/// A quantile of ascending values, with linear interpolation; NaN if there are none.
pub(crate) fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * sorted.len().saturating_sub(1) as f64;
    let (low, high) = (place.floor() as usize, place.ceil() as usize);
    match (sorted.get(low), sorted.get(high)) {
        (Some(a), Some(b)) => a + (b - a) * (place - place.floor()),
        _ => f64::NAN,
    }
}
