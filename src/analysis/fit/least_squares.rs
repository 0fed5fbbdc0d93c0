//! Least-squares fit: the values of the unknowns that agree best with the measurements, and their standard errors.

use super::measured::Measured;
use super::model::{Computed, Curve, FitModel};
use super::starts::{best, distance, spread};
use super::statistics::Certainty;
use super::unknown::{Bound, Bounds, Unknown};
use super::{Report, Stopped, searched};
use crate::analysis::error::AnalysisError;
use crate::control::Cancel;
use crate::digits::{short, significant, with_error};
use crate::scene::Scene;
use crate::solve::Settings;
use basin::{
    BoxBounds, ConstraintDescription, ConstraintSet, Constraints, DenseMatrix, Executor, Jacobian, Residual,
    TerminationCode, TrustRegionReflective,
};
use serde::{Deserialize, Serialize};
use std::sync::Mutex;

/// The search ends when a step reduces χ² by less than this share …
const LEAST_GAIN: f64 = 1e-4;
/// … or after so many steps.
const MOST_STEPS: u64 = 60;
/// Attempts at one step that may fail to reduce χ² before the search ends.
const MOST_ATTEMPTS: usize = 8;
/// An unknown this close in x to a bound towards which χ² decreases is taken to be at the bound.
const AT_BOUND: f64 = 5e-3;
/// Correlation above which a warning says that two unknowns can hardly be distinguished.
const ALIKE: f64 = 0.98;
/// Minima whose unknowns differ by less than this in x are the same.
const SAME: f64 = 0.02;

/// The best agreement found.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Fitted {
    /// The unknowns, in the order in which they were given.
    pub unknowns: Vec<FittedUnknown>,
    /// The measurements beside what is computed.
    pub rows: Vec<FittedRow>,
    /// For each condition under which torques were measured, the computed torque over the rotor's speed, `[rpm, N m]`; empty for the
    /// others.
    pub curves: Vec<Vec<[f64; 2]>>,
    /// Σ ((computed − measured)/error)².
    pub chi_squared: f64,
    /// Number of measurements minus number of unknowns that are not at a bound.
    pub degrees_of_freedom: usize,
    /// Factor on the given or assumed errors that makes χ² equal to the degrees of freedom; 1 if the errors are known; `None` without
    /// degrees of freedom.
    pub error_scale: Option<f64>,
    /// Whether the errors of the measurements were given.
    pub errors_known: bool,
    /// Greatest numerical error of a computed value, in standard errors of its measurement; `None` if none is known.
    pub numerical_error: Option<f64>,
    /// Covariance of the unknowns in their units, row by row; NaN for an unknown at a bound.
    pub covariance: Vec<Vec<f64>>,
    /// Correlation of the unknowns, in the same form.
    pub correlation: Vec<Vec<f64>>,
    /// Whether the search ended at a minimum.
    pub converged: bool,
    /// The minima that the different starts led to, the best first.
    pub minima: Vec<Minimum>,
    /// How many solves it took.
    pub solves: usize,
    /// Warnings for the user.
    pub warnings: Vec<String>,
    /// The scene with these values.
    pub scene: Scene,
}

/// An unknown and what was found for it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct FittedUnknown {
    /// The key and its bounds.
    pub unknown: Unknown,
    /// The value, in the unit of the key.
    pub value: f64,
    /// Its standard error, from the measurements and from the computed values; `None` at a bound, or if the measurements do not determine
    /// it.
    pub error: Option<f64>,
    /// The bound it is at.
    pub at: Option<Bound>,
}

impl FittedUnknown {
    /// Its value with the standard error, for people: `2.263 ± 0.012 µm`. If the error is wider than the bounds, the value is not
    /// determined: `2.26 µm, not determined`.
    pub fn in_words(&self) -> String {
        let Unknown { parameter, from, to, .. } = self.unknown;
        match self.error {
            Some(error) if error > to - from => {
                format!("{}, not determined", parameter.with_unit(significant(self.value, 3)))
            }
            Some(error) => parameter.with_unit(with_error(self.value, error)),
            None => parameter.with_unit(significant(self.value, 5)),
        }
    }
}

/// A measurement beside the computed value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FittedRow {
    /// The computed value with its numerical error; or the reason why there is none, in which case the measurement was left out.
    pub computed: Computed,
    /// (computed − measured)/error, with the errors scaled by [`Fitted::error_scale`].
    pub residual: Option<f64>,
    /// The standard error of the measurement, scaled likewise.
    pub error: f64,
}

/// A minimum that some starts led to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Minimum {
    /// χ² there.
    pub chi_squared: f64,
    /// The values of the unknowns.
    pub values: Vec<f64>,
    /// How many starts led there.
    pub starts: usize,
}

/// The problem in the form that the library needs.
struct LeastSquares<'a> {
    model: &'a FitModel<'a>,
    measured: &'a Measured,
    /// The measurements that are used.
    used: &'a [usize],
    lower: Vec<f64>,
    upper: Vec<f64>,
    cancel: &'a Cancel,
    report: Report<'a>,
    /// Points tried, and the least χ² among them.
    tried: &'a Mutex<(usize, f64)>,
}

impl LeastSquares<'_> {
    /// (computed − measured)/error of the measurements that are used, at `x`; NaN if nothing can be computed.
    fn residuals(&self, x: &[f64]) -> Result<Vec<f64>, Stopped> {
        let solved = self.model.at_one(x, self.cancel).ok_or(Stopped)?;
        Ok(residuals(self.measured, &in_order(self.measured, &solved), self.used))
    }

    /// ∂residual/∂x for each unknown; zeros for an unknown that is fixed. If the neighbours of a condition cannot be solved, its
    /// derivatives are zeros as well, so that it does not influence the search direction.
    fn derivatives(&self, x: &[f64]) -> Result<Vec<Vec<f64>>, Stopped> {
        let free: Vec<bool> = self.lower.iter().zip(&self.upper).map(|(lower, upper)| lower < upper).collect();
        let slopes = self.model.slopes(x, &free, self.cancel).ok_or(Stopped)?;
        let rows = in_order(self.measured, &slopes);
        let column = |k: usize| {
            let entry = |i: &usize| rows[*i].get(k).copied().unwrap_or(0.0) / self.measured.measurements[*i].error;
            self.used.iter().map(entry).collect()
        };
        Ok((0..x.len()).map(column).collect())
    }
}

impl Constraints for LeastSquares<'_> {
    type Set = ConstraintSet<BoxBounds<Vec<f64>>>;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new().with_bounds(BoxBounds::new(Some(&self.lower), Some(&self.upper)))
    }
}

impl Residual for LeastSquares<'_> {
    type Param = Vec<f64>;
    type Output = Vec<f64>;
    type Error = Stopped;

    fn residual(&self, x: &Vec<f64>) -> Result<Vec<f64>, Stopped> {
        let found = self.residuals(x)?;
        let chi_squared = sum_of_squares(&found);
        let mut tried = self.tried.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        tried.0 += 1;
        tried.1 = tried.1.min(chi_squared);
        (self.report)(tried.0, tried.1);
        Ok(found)
    }
}

impl Jacobian for LeastSquares<'_> {
    type Jacobian = DenseMatrix;

    fn jacobian(&self, x: &Vec<f64>) -> Result<DenseMatrix, Stopped> {
        let columns = self.derivatives(x)?;
        let rows = self.used.len();
        let flat: Vec<f64> = (0..rows).flat_map(|row| columns.iter().map(move |column| column[row])).collect();
        Ok(DenseMatrix::from_row_slice(rows, columns.len(), &flat))
    }
}

fn sum_of_squares(residuals: &[f64]) -> f64 {
    residuals.iter().map(|residual| residual * residual).sum()
}

/// Puts the values of each condition into the order of the measurements.
fn in_order<T: Clone>(measured: &Measured, solved: &[Vec<T>]) -> Vec<T> {
    let mut next = vec![0; solved.len()];
    let computed = measured.measurements.iter().map(|one| {
        next[one.condition] += 1;
        solved[one.condition][next[one.condition] - 1].clone()
    });
    computed.collect()
}

fn residuals(measured: &Measured, computed: &[Computed], used: &[usize]) -> Vec<f64> {
    let residual = |i: &usize| {
        let one = &measured.measurements[*i];
        computed[*i].as_ref().map_or(f64::NAN, |found| (found.value - one.value) / one.error)
    };
    used.iter().map(residual).collect()
}

/// Chooses the unknowns of `bounds` so that `scene` agrees with `measured`. The search begins at the scene's own values; with `starts` above 1
/// also at the best of as many points, spread over the bounds and solved as drafts. A measurement that cannot be computed at the start is
/// left out, and reported. `None` if cancelled.
///
/// # Errors
/// If a key cannot be chosen, or the table sets all its values; if the scene does not accept a condition; if fewer measurements can be computed
/// than there are unknowns; or if the search library fails.
pub fn fit(
    scene: &Scene,
    bounds: &[Bounds],
    measured: &Measured,
    settings: &Settings,
    (starts, cancel, report): (usize, &Cancel, Report<'_>),
) -> Result<Option<Fitted>, AnalysisError> {
    let model = &FitModel::new(scene, bounds, settings)?.under(measured)?;
    let own = model.start();
    let Some(first) = model.at_one(&own, cancel) else { return Ok(None) };
    let first = in_order(measured, &first);
    let used: Vec<usize> = (0..first.len()).filter(|i| first[*i].is_ok()).collect();
    let unknowns = model.unknowns.len();
    if used.len() < unknowns {
        let fault = first.iter().find_map(|found| found.as_ref().err());
        let left_out = fault.map_or_else(String::new, |why| {
            format!(" ({} of {} could not be computed at the start: {why})", first.len() - used.len(), first.len())
        });
        return Err(AnalysisError::Input(format!(
            "measurements: {}, keys varied: {unknowns}; give at least as many measurements as keys, or vary fewer{left_out}",
            used.len()
        )));
    }
    let tried = Mutex::new((0, f64::INFINITY));
    let search = |fixed: &[Option<Bound>]| LeastSquares {
        model,
        measured,
        used: &used,
        lower: fixed.iter().map(|at| at.map_or(0.0, Bound::place)).collect(),
        upper: fixed.iter().map(|at| at.map_or(1.0, Bound::place)).collect(),
        cancel,
        report,
        tried: &tried,
    };
    let free = vec![None; unknowns];
    let Some(mut places) = coarse(model, measured, &used, starts, cancel) else { return Ok(None) };
    places.insert(0, own);
    let mut found: Vec<(f64, Vec<f64>, bool)> = Vec::new();
    for place in places {
        let Some(end) = descend(search(&free), place)? else { return Ok(None) };
        found.push(end);
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let minima = distinct(model, &found);
    let (_, mut x, mut converged) = found.swap_remove(0);
    // An unknown is fixed at a bound if χ² decreases towards it, and the search for the others is repeated.
    let mut at = free.clone();
    let columns = loop {
        let Ok(columns) = search(&at).derivatives(&x) else { return Ok(None) };
        let Ok(now) = search(&at).residuals(&x) else { return Ok(None) };
        let mut more = false;
        for k in (0..unknowns).filter(|k| at[*k].is_none()).collect::<Vec<_>>() {
            let slope: f64 = columns[k].iter().zip(&now).map(|(derivative, residual)| derivative * residual).sum();
            at[k] =
                Bound::near(x[k], AT_BOUND).filter(|at| if *at == Bound::Lower { slope > 0.0 } else { slope < 0.0 });
            x[k] = at[k].map_or(x[k], Bound::place);
            more |= at[k].is_some();
        }
        if !more {
            break columns;
        }
        if at.iter().any(Option::is_none) {
            let Some(end) = descend(search(&at), x)? else { return Ok(None) };
            (_, x, converged) = end;
        }
    };
    let Some((last, curves)) = model.with_curves(&x, cancel) else { return Ok(None) };
    let computed = in_order(measured, &last);
    Ok(Some(judge(model, measured, &used, Reached { x, at, columns, computed, curves, minima, converged })?))
}

/// The best few of the points spread over the bounds, evaluated at draft fidelity.
fn coarse(
    model: &FitModel<'_>,
    measured: &Measured,
    used: &[usize],
    starts: usize,
    cancel: &Cancel,
) -> Option<Vec<Vec<f64>>> {
    let points = spread(model.unknowns.len(), starts.saturating_sub(1));
    let solved = model.drafts(&points, cancel)?;
    let judged = solved
        .iter()
        .zip(points)
        .map(|(solved, point)| (sum_of_squares(&residuals(measured, &in_order(measured, solved), used)), point))
        .filter(|(chi_squared, _)| chi_squared.is_finite());
    Some(best(judged.collect()))
}

/// Searches from a point for a minimum. Returns χ² there, the point, and whether it is a minimum. `None` if cancelled.
fn descend(search: LeastSquares<'_>, start: Vec<f64>) -> Result<Option<(f64, Vec<f64>, bool)>, AnalysisError> {
    let solver = TrustRegionReflective::new()
        .with_max_inner_attempts(MOST_ATTEMPTS)
        .with_initial_radius(0.5)
        .with_relative_cost_change_tolerance(LEAST_GAIN);
    let ended = searched(|| Executor::from_start(search, solver, start).max_iter(MOST_STEPS).run())?;
    Ok(ended.map(|ended| {
        // Where the differences of solves are only noise, no step reduces χ²; this counts as a minimum as well.
        let converged = ended.report.termination.code() != TerminationCode::MaxIter;
        (2.0 * ended.cost(), ended.param().clone(), converged)
    }))
}

/// The distinct minima, best first.
fn distinct(model: &FitModel<'_>, found: &[(f64, Vec<f64>, bool)]) -> Vec<Minimum> {
    let mut minima: Vec<(&[f64], Minimum)> = Vec::new();
    for (chi_squared, x, _) in found.iter().filter(|found| found.0.is_finite()) {
        let same = |other: &&mut (&[f64], Minimum)| distance(other.0, x) < SAME;
        match minima.iter_mut().find(same) {
            Some((_, minimum)) => minimum.starts += 1,
            None => {
                let values = model.unknowns.iter().zip(x).map(|(unknown, x)| unknown.value(*x)).collect();
                minima.push((x, Minimum { chi_squared: *chi_squared, values, starts: 1 }));
            }
        }
    }
    minima.into_iter().map(|(_, minimum)| minimum).collect()
}

/// Where the search ended.
struct Reached {
    x: Vec<f64>,
    at: Vec<Option<Bound>>,
    /// ∂residual/∂x for each unknown; zeros for an unknown at a bound.
    columns: Vec<Vec<f64>>,
    computed: Vec<Computed>,
    curves: Vec<Curve>,
    minima: Vec<Minimum>,
    converged: bool,
}

/// Statistics at the minimum.
fn judge(model: &FitModel<'_>, measured: &Measured, used: &[usize], reached: Reached) -> Result<Fitted, AnalysisError> {
    let Reached { x, at, columns, computed, curves, minima, converged } = reached;
    let count = x.len();
    let free: Vec<usize> = (0..count).filter(|k| at[*k].is_none()).collect();
    let certainty = Certainty::of(&free.iter().map(|k| columns[*k].clone()).collect::<Vec<_>>());
    let raw = residuals(measured, &computed, used);
    let chi_squared = sum_of_squares(&raw);
    let degrees_of_freedom = used.len() - free.len();
    let scatter = (degrees_of_freedom > 0).then(|| (chi_squared / degrees_of_freedom as f64).sqrt());
    let error_scale = if measured.errors_known { Some(1.0) } else { scatter };
    let scale = error_scale.unwrap_or(1.0);
    let slope: Vec<f64> = model.unknowns.iter().zip(&x).map(|(unknown, x)| unknown.slope(*x)).collect();
    let mut covariance = vec![vec![f64::NAN; count]; count];
    let mut correlation = covariance.clone();
    let lost = |k: usize| certainty.undetermined.iter().any(|direction| direction[k].abs() > 0.3);
    for (i, row) in free.iter().enumerate() {
        for (j, column) in free.iter().enumerate() {
            let of = |i: usize, j: usize| certainty.covariance[(i, j)];
            if let (Some(scale), false) = (error_scale, lost(i) || lost(j)) {
                covariance[*row][*column] = of(i, j) * scale * scale * slope[*row] * slope[*column];
            }
            let size = (of(i, i) * of(j, j)).sqrt();
            correlation[*row][*column] = if size > 0.0 { of(i, j) / size } else { f64::NAN };
        }
    }
    // The grid errors have nearly all the same sign: they shift an unknown by up to the sum over all measurements.
    let grids = |k: usize| -> f64 {
        let Some(i) = free.iter().position(|one| *one == k) else { return 0.0 };
        let moved = |(row, measurement): (usize, &usize)| {
            let by_each =
                free.iter().enumerate().map(|(j, column)| certainty.covariance[(i, j)] * columns[*column][row]);
            let numerical = computed[*measurement].as_ref().map_or(0.0, |found| found.error);
            let known = Some(numerical / measured.measurements[*measurement].error).filter(|off| off.is_finite());
            (by_each.sum::<f64>() * known.unwrap_or(0.0)).abs()
        };
        slope[k].abs() * used.iter().enumerate().map(moved).sum::<f64>()
    };
    let unknowns: Vec<FittedUnknown> = (0..count)
        .map(|k| {
            let unknown = model.unknowns[k].clone();
            let error = covariance[k][k].sqrt().hypot(grids(k));
            FittedUnknown {
                value: unknown.value(x[k]),
                error: Some(error).filter(|error| error.is_finite()),
                at: at[k],
                unknown,
            }
        })
        .collect();
    let rows: Vec<FittedRow> = measured
        .measurements
        .iter()
        .zip(&computed)
        .enumerate()
        .map(|(i, (one, computed))| {
            let error = one.error * scale;
            let counts = used.contains(&i);
            let residual = computed.as_ref().ok().filter(|_| counts).map(|found| (found.value - one.value) / error);
            FittedRow { computed: computed.clone(), residual, error }
        })
        .collect();
    let off = rows.iter().filter(|row| row.residual.is_some()).filter_map(|row| {
        let computed = row.computed.as_ref().ok()?;
        Some(computed.error / row.error).filter(|off| off.is_finite())
    });
    let mut fitted = Fitted {
        warnings: Vec::new(),
        numerical_error: off.reduce(f64::max),
        scene: model.fitted(&x, "fitted")?,
        solves: model.solves(),
        errors_known: measured.errors_known,
        unknowns,
        rows,
        curves,
        chi_squared,
        degrees_of_freedom,
        error_scale,
        covariance,
        correlation,
        converged,
        minima,
    };
    fitted.warnings = warnings(&fitted, measured, &free, &certainty, scatter);
    Ok(fitted)
}

/// Warnings about a fit for the user.
fn warnings(
    fitted: &Fitted,
    measured: &Measured,
    free: &[usize],
    certainty: &Certainty,
    scatter: Option<f64>,
) -> Vec<String> {
    let key = |k: usize| fitted.unknowns[k].unknown.parameter.key;
    let mut warnings = Vec::new();
    if !fitted.converged {
        warnings.push(format!("the search was ended after {MOST_STEPS} steps, before χ² stopped falling"));
    }
    let left_out = fitted.rows.iter().filter(|row| row.residual.is_none()).count();
    if left_out > 0 {
        warnings.push(format!(
            "{left_out} of {} measurements were left out: they could not be computed",
            fitted.rows.len()
        ));
    }
    for found in &fitted.unknowns {
        if let Some(at) = found.at {
            let parameter = found.unknown.parameter;
            warnings.push(format!(
                "{} is at its {} bound, {} {}: χ² would fall further beyond it; the errors of the others assume that it is known",
                parameter.key,
                at.name(),
                short(found.value, 6),
                parameter.unit
            ));
        }
    }
    for direction in &certainty.undetermined {
        let keys: Vec<&str> =
            direction.iter().zip(free).filter(|(part, _)| part.abs() > 0.3).map(|(_, k)| key(*k)).collect();
        warnings.push(format!(
            "the measurements do not determine {}: leave out one, or measure something else",
            keys.join(" and ")
        ));
    }
    for (i, a) in free.iter().enumerate() {
        for b in &free[i + 1..] {
            let correlation = fitted.correlation[*a][*b];
            if correlation.abs() > ALIKE {
                warnings.push(format!(
                    "{} and {} can hardly be told apart: their correlation is {correlation:.3}",
                    key(*a),
                    key(*b)
                ));
            }
        }
    }
    for found in &fitted.unknowns {
        let width = found.unknown.to - found.unknown.from;
        if let Some(error) = found.error.filter(|error| *error > 0.5 * width) {
            let parameter = found.unknown.parameter;
            warnings.push(format!(
                "{} is hardly determined: its standard error, {} {}, is more than half of the range between its bounds",
                parameter.key,
                significant(error, 2),
                parameter.unit
            ));
        }
    }
    match scatter {
        Some(scatter) if measured.errors_known && scatter > 2.0 => warnings.push(format!(
            "the residuals are {} times as large as the errors of the measurements allow: the stated errors are too small, or the model does \
             not describe the measurements",
            significant(scatter, 2)
        )),
        None if !measured.errors_known => warnings.push(
            "as many unknowns as measurements: without errors of the measurements the standard errors cannot be estimated".to_owned(),
        ),
        _ => {}
    }
    if let Some(worst) = fitted.numerical_error.filter(|worst| *worst > 0.5 && fitted.degrees_of_freedom > 0) {
        warnings.push(format!(
            "the numerical error of what is computed is up to {} standard errors of a measurement: ask for more accuracy",
            significant(worst, 2)
        ));
    }
    if fitted.minima.len() > 1 {
        warnings.push(format!(
            "{} starts led to {} different minima; the next best has χ² {} times as large",
            fitted.minima.iter().map(|minimum| minimum.starts).sum::<usize>(),
            fitted.minima.len(),
            significant(fitted.minima[1].chi_squared / fitted.minima[0].chi_squared, 3)
        ));
    }
    warnings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_less_sure_than_its_bounds_is_not_determined() {
        let bounds: Bounds = "stator.normal_amplitude_um=0.5:3".parse().unwrap();
        let unknown = Unknown::new(&Scene::motor(), &bounds).unwrap();
        let told = |error| FittedUnknown { unknown: unknown.clone(), value: 2.263, error, at: None }.in_words();
        assert_eq!(told(Some(500.0)), "2.26 µm, not determined");
        assert_eq!(told(Some(0.012)), "2.263 ± 0.012 µm");
        assert_eq!(told(None), "2.2630 µm");
    }
}
