//! The values of the unknowns at which one number is greatest or least, within limits on others.

use super::measured::{Observable, named, names};
use super::model::{Computed, FitModel};
use super::starts::{best, distance, spread};
use super::unknown::{Bound, Bounds, Unknown};
use super::{Report, Stopped, searched};
use crate::analysis::attempt::attempt;
use crate::analysis::error::AnalysisError;
use crate::analysis::quantity::Quantity;
use crate::control::Cancel;
use crate::digits::{percent, short, significant};
use crate::estimate::Estimate;
use crate::problem::Problem;
use crate::scene::{Scene, quantity_text, show_text};
use crate::solve::Settings;
use basin::{
    BoxBounds, Cobyla, ConstraintDescription, ConstraintSet, ConstraintSolveError, Constraints, CostFunction, Executor,
    NoLinearConstraints, NoNonlinearBlock, NonlinearBlock, NonlinearBlocks, NonlinearInequalityValues, SelectedState,
};
use serde::{Deserialize, Serialize};
use std::str::FromStr;
use std::sync::{Mutex, PoisonError};

/// Trust radius in x at the beginning of the search, and the radius at which the search ends.
const RADIUS: (f64, f64) = (0.2, 5e-4);
/// Most points that are tried from one start.
const MOST_POINTS: u64 = 600;
/// An unknown this close in x to a bound is taken to be at the bound.
const AT_BOUND: f64 = 2e-3;
/// Optima whose unknowns differ by more than this share of the bounds are different optima.
const ANOTHER: f64 = 0.05;
/// Points of a line through the optimum.
const LINE: usize = 21;
/// Relative loss against the optimum that is still acceptable; it defines the range `Scan::flat`.
const FLAT: f64 = 0.01;
/// If the number changes little over this share of the bounds, there is a plateau.
const PLATEAU: f64 = 0.1;
/// Penalty for a number that could not be computed, in units of the sought number.
const NOTHING: f64 = 1e3;

/// A limit on another number: `alpha<0.3`, `stall_torque_nm>0.2`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Limit {
    /// The number's name.
    pub name: String,
    /// Whether it has to stay below the value; otherwise above.
    pub below: bool,
    /// The value.
    pub value: f64,
}

impl FromStr for Limit {
    type Err = AnalysisError;

    fn from_str(text: &str) -> Result<Self, AnalysisError> {
        let spelled = text.replace('≤', "<").replace('≥', ">");
        let below = spelled.contains('<');
        let (name, value) = spelled.split_once(if below { '<' } else { '>' }).unwrap_or_default();
        let (name, value) = (name.trim(), value.trim_start_matches('=').trim());
        let name = if name == "α" { Quantity::Alpha.name() } else { name };
        let known = Quantity::all().find(|quantity| quantity.name() == name);
        let unit = known.map_or("", Quantity::usual_unit);
        // An unknown name is accepted with any unit here; the goal, which knows the scene, then refuses it and lists the names.
        let any = Quantity::all().filter(|_| known.is_none()).map(Quantity::usual_unit);
        match std::iter::once(unit).chain(any).find_map(|unit| quantity_text::number(unit, value)) {
            Some(value) => Ok(Self { name: name.to_owned(), below, value }),
            None => {
                let unit = if unit.is_empty() { String::new() } else { format!(", in {unit}") };
                Err(AnalysisError::Input(format!(
                    "limit {}: expected name<value or name>value, as in alpha<0.3{unit}",
                    show_text(text)
                )))
            }
        }
    }
}

impl Limit {
    /// By how much `found` exceeds the limit, and the size up to which this is not significant.
    fn over(&self, found: &Estimate) -> (f64, f64) {
        let over = if self.below { found.value - self.value } else { self.value - found.value };
        (over, found.error.max(2e-3 * self.value.abs()))
    }

    /// Whether `found` keeps the limit within its error.
    fn is_kept(&self, found: &Estimate) -> bool {
        let (over, unclear) = self.over(found);
        over <= unclear
    }

    /// The limit, beside the number `found` of an optimum, in words.
    pub fn in_words(&self, found: &Estimate) -> String {
        format!("{}: {self}", if self.is_kept(found) { "allowed" } else { "NOT KEPT" })
    }
}

impl std::fmt::Display for Limit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {} {}", self.name, if self.below { '<' } else { '>' }, self.value)
    }
}

/// A number to be made as great or as small as possible, within limits on others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Goal {
    /// The number.
    pub quantity: Quantity,
    /// Whether the greatest value is sought; otherwise the least.
    pub greatest: bool,
    /// Limits on other numbers.
    pub limits: Vec<(Limit, Quantity)>,
}

impl Goal {
    /// The greatest (or least) value of the number of this name in results of `scene`, within limits on others.
    pub fn new(scene: &Scene, name: &str, greatest: bool, limits: &[Limit]) -> Result<Self, AnalysisError> {
        let problem = Problem::try_from(scene)?;
        let find = |option: &'static str, name: &str| {
            named(&problem, name).ok_or_else(|| AnalysisError::no_such_number(option, name, &names(&problem)))
        };
        let limits = limits.iter().map(|limit| Ok((limit.clone(), find("limit", &limit.name)?)));
        let limits = limits.collect::<Result<Vec<_>, AnalysisError>>()?;
        Ok(Self { quantity: find(if greatest { "maximise" } else { "minimise" }, name)?, greatest, limits })
    }

    /// Observables of the goal and of its limits.
    fn asked(&self) -> Vec<Observable> {
        std::iter::once(self.quantity)
            .chain(self.limits.iter().map(|(_, quantity)| *quantity))
            .map(Observable::Number)
            .collect()
    }

    /// The value to be minimised, and the values that have to be at most 0, from the computed numbers; in units of `size`.
    fn judge(&self, computed: &[Computed], size: f64) -> Option<(f64, Vec<f64>)> {
        let sought = computed[0].as_ref().ok()?.value / size;
        let mut beyond = Vec::new();
        for ((limit, _), found) in self.limits.iter().zip(&computed[1..]) {
            let over = (found.as_ref().ok()?.value - limit.value) / limit.value.abs().max(f64::MIN_POSITIVE);
            beyond.push(if limit.below { over } else { -over });
        }
        Some((if self.greatest { -sought } else { sought }, beyond))
    }
}

/// The optimum found.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Optimum {
    /// The goal of the search.
    pub goal: Goal,
    /// The number there, with its numerical error.
    pub value: Estimate,
    /// The number at the scene's own values; `None` if it cannot be solved there.
    pub before: Option<Estimate>,
    /// The numbers that are limited.
    pub limited: Vec<Estimate>,
    /// The unknowns there, with a line through the optimum along each.
    pub lines: Vec<Scan>,
    /// Whether the search ended by itself, with every limit kept.
    pub converged: bool,
    /// How many solves it took.
    pub solves: usize,
    /// Warnings for the user.
    pub warnings: Vec<String>,
    /// The scene with these values.
    pub scene: Scene,
}

impl Optimum {
    /// The relative change of the number within [`Scan::flat`]: a hundredth, or its own numerical error if that is greater.
    pub fn flatness(&self) -> f64 {
        flatness(&self.value)
    }
}

/// The sought number along one unknown, with the others at the optimum.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Scan {
    /// The unknown.
    pub unknown: Unknown,
    /// Its value at the optimum.
    pub value: f64,
    /// The bound it is at.
    pub at: Option<Bound>,
    /// Values of the unknown, ascending, with the number at each; `None` where it cannot be computed.
    pub points: Vec<(f64, Option<f64>)>,
    /// For each point, whether all limits are kept.
    pub kept: Vec<bool>,
    /// The range round the optimum in which all limits are kept, and the number stays within [`Optimum::flatness`] of it; `None` if they are
    /// not kept at the optimum itself.
    pub flat: Option<(f64, f64)>,
}

impl Scan {
    /// The value and the ends of [`Self::flat`], rounded to the same number of digits, so that they stay in order.
    pub fn in_digits(&self) -> (String, Option<[String; 2]>) {
        let digits = |value| significant(value, 4);
        (digits(self.value), self.flat.map(|(from, to)| [digits(from), digits(to)]))
    }
}

/// The problem in the form that the library needs.
struct Optimisation<'a> {
    model: &'a FitModel<'a>,
    goal: &'a Goal,
    size: f64,
    lower: Vec<f64>,
    upper: Vec<f64>,
    cancel: &'a Cancel,
    report: Report<'a>,
    /// Points tried, and the best number so far.
    tried: &'a Mutex<(usize, f64)>,
    /// The last point and its outcome: the library asks for the number and for its limits separately.
    last: Mutex<Option<(Vec<f64>, Option<Outcome>)>>,
}

/// The number at a point, and its limits.
type Outcome = (f64, Vec<f64>);

impl Optimisation<'_> {
    fn at(&self, x: &[f64]) -> Result<Option<Outcome>, Stopped> {
        // The library may try points beyond the bounds.
        let x: Vec<f64> = x.iter().map(|x| x.clamp(0.0, 1.0)).collect();
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((point, found)) = last.as_ref()
            && *point == x
        {
            return Ok(found.clone());
        }
        let solved = self.model.at_one(&x, self.cancel).ok_or(Stopped)?;
        let found = self.goal.judge(&solved[0], self.size);
        let mut tried = self.tried.lock().unwrap_or_else(PoisonError::into_inner);
        tried.0 += 1;
        if let Some((cost, beyond)) = &found
            && beyond.iter().all(|beyond| *beyond <= 0.0)
            && (tried.1.is_nan() || *cost < tried.1)
        {
            tried.1 = *cost;
        }
        (self.report)(tried.0, tried.1 * self.size * if self.goal.greatest { -1.0 } else { 1.0 });
        *last = Some((x, found.clone()));
        Ok(found)
    }
}

impl Constraints for Optimisation<'_> {
    type Set =
        ConstraintSet<BoxBounds<Vec<f64>>, NoLinearConstraints, NonlinearBlocks<NoNonlinearBlock, NonlinearBlock>>;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new()
            .with_bounds(BoxBounds::new(Some(&self.lower), Some(&self.upper)))
            .with_nonlinear_inequalities(self.goal.limits.len())
    }
}

impl CostFunction for Optimisation<'_> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Stopped;

    fn cost(&self, x: &Vec<f64>) -> Result<f64, Stopped> {
        Ok(self.at(x)?.map_or(NOTHING, |(cost, _)| cost))
    }
}

impl NonlinearInequalityValues for Optimisation<'_> {
    type Param = Vec<f64>;
    type Values = Vec<f64>;
    type Error = Stopped;

    fn nonlinear_inequalities(&self, x: &Vec<f64>) -> Result<Vec<f64>, ConstraintSolveError<Stopped>> {
        let found = self.at(x).map_err(ConstraintSolveError::Evaluation)?;
        Ok(found.map_or_else(|| vec![NOTHING; self.goal.limits.len()], |(_, beyond)| beyond))
    }
}

/// Searches for the optimum of `goal` over the unknowns of `bounds`: from the scene's own values and, with `starts` above 1, also from the
/// best of as many points spread over the bounds and solved at draft fidelity. `None` if cancelled.
pub fn optimise(
    scene: &Scene,
    bounds: &[Bounds],
    goal: &Goal,
    settings: &Settings,
    (starts, cancel, report): (usize, &Cancel, Report<'_>),
) -> Result<Option<Optimum>, AnalysisError> {
    let model = FitModel::new(scene, bounds, settings)?.asking(goal.asked());
    let own = model.start();
    let points: Vec<Vec<f64>> =
        std::iter::once(own.clone()).chain(spread(own.len(), starts.saturating_sub(1))).collect();
    let Some(solved) = model.drafts(&points, cancel) else { return Ok(None) };
    let found = |solved: &[Vec<Computed>]| solved[0][0].as_ref().ok().map(|found| found.value.abs());
    let Some(size) = solved.iter().find_map(|solved| found(solved)).map(|size| if size > 0.0 { size } else { 1.0 })
    else {
        return Err(no_start(solved[0][0][0].as_ref().err().map_or("", String::as_str)));
    };
    let judged = solved.iter().zip(points).skip(1).filter_map(|(solved, point)| {
        let (cost, beyond) = goal.judge(&solved[0], size)?;
        // A point that breaks a limit is no good start, unless all do.
        Some((cost + NOTHING * beyond.iter().fold(0.0, |most: f64, beyond| most.max(*beyond)), point))
    });
    let starts = best(judged.collect());
    let tried = Mutex::new((0, f64::NAN));
    let count = own.len();
    // The cost with the penalties for broken limits, the point, and whether the search ended by itself.
    let mut reached: Vec<([f64; 2], Vec<f64>, bool)> = Vec::new();
    for start in std::iter::once(own.clone()).chain(starts) {
        let search = Optimisation {
            model: &model,
            goal,
            size,
            lower: vec![0.0; count],
            upper: vec![1.0; count],
            cancel,
            report,
            tried: &tried,
            last: Mutex::new(None),
        };
        let solver = Cobyla::new().with_initial_radius(RADIUS.0).with_final_radius(RADIUS.1);
        let run = || Executor::new(search, solver, SelectedState::new(start)).max_cost_evals(MOST_POINTS).run();
        let Some(ended) = searched(run)? else { return Ok(None) };
        let x: Vec<f64> = ended.best_param().iter().map(|x| x.clamp(0.0, 1.0)).collect();
        // Limits count as kept within a thousandth of their value.
        let Some(solved) = model.at_one(&x, cancel) else { return Ok(None) };
        let Some((cost, beyond)) = goal.judge(&solved[0], size) else { continue };
        let broken = NOTHING * beyond.iter().fold(0.0, |most: f64, beyond| most.max(*beyond - 1e-3));
        reached.push(([cost, broken], x, ended.cost_evals() < MOST_POINTS));
    }
    reached.sort_by(|([a, a_broken], ..), ([b, b_broken], ..)| (a + a_broken).total_cmp(&(b + b_broken)));
    let mut reached = reached.into_iter();
    let Some((_, mut x, converged)) = reached.next() else {
        return Err(no_start("no point that was tried could be solved"));
    };
    // A point that breaks a limit is no optimum.
    let lesser = reached.find(|([_, broken], other, _)| *broken == 0.0 && distance(other, &x) > ANOTHER);
    let lesser = lesser.map(|([cost, _], other, _)| (cost * size * if goal.greatest { -1.0 } else { 1.0 }, other));
    let at: Vec<Option<Bound>> = x.iter().map(|x| Bound::near(*x, AT_BOUND)).collect();
    for (x, at) in x.iter_mut().zip(&at) {
        *x = at.map_or(*x, Bound::place);
    }
    let mut found = describe(&model, goal, (own, x, at, converged), cancel)?;
    if let (Some(found), Some((value, x))) = (&mut found, lesser) {
        let at = model.unknowns.iter().zip(x).map(|(unknown, x)| unknown.with_value(x));
        found.warnings.push(format!(
            "another start ended at {}, with {} = {}: more starts may find a better optimum (--starts)",
            at.collect::<Vec<_>>().join(", "),
            goal.quantity.name(),
            short(value, 6)
        ));
    }
    Ok(found)
}

/// The fault of a scene that cannot be solved.
fn no_start(reason: &str) -> AnalysisError {
    AnalysisError::Search(format!("no start can be solved: {reason}"))
}

/// Describes the optimum at `x`, with lines through it along each unknown.
fn describe(
    model: &FitModel<'_>,
    goal: &Goal,
    (own, x, at, converged): (Vec<f64>, Vec<f64>, Vec<Option<Bound>>, bool),
    cancel: &Cancel,
) -> Result<Option<Optimum>, AnalysisError> {
    let mut points = vec![x.clone(), own];
    let mut places = Vec::new();
    for k in 0..x.len() {
        let mut along: Vec<f64> = (0..LINE).map(|i| i as f64 / (LINE - 1) as f64).chain([x[k]]).collect();
        along.sort_by(f64::total_cmp);
        along.dedup();
        points.extend(along.iter().map(|place| {
            let mut point = x.clone();
            point[k] = *place;
            point
        }));
        places.push(along);
    }
    let Some(solved) = model.at(&points, &model.settings, cancel) else { return Ok(None) };
    let mut found = solved.into_iter().map(|mut solved| solved.swap_remove(0));
    let (here, before) = (found.next().unwrap_or_default(), found.next().unwrap_or_default());
    let value = |computed: &[Computed]| computed.first().and_then(|found| found.as_ref().ok()).copied();
    let Some(best) = value(&here) else {
        return Err(no_start("the optimum could not be solved again"));
    };
    let limited: Vec<Estimate> = here.iter().skip(1).filter_map(|found| found.as_ref().ok()).copied().collect();
    let within = goal.limits.iter().zip(&limited).all(|((limit, _), found)| limit.is_kept(found));
    let sign = if goal.greatest { 1.0 } else { -1.0 };
    let little = flatness(&best);
    let (mut lines, mut warnings) = (Vec::new(), Vec::new());
    let mut better: Option<(String, f64)> = None;
    for (k, places) in places.iter().enumerate() {
        let unknown = model.unknowns[k].clone();
        let numbers: Vec<(f64, Vec<Computed>)> =
            places.iter().zip(&mut found).map(|(place, found)| (*place, found)).collect();
        let mut kept = Vec::new();
        for (place, computed) in &numbers {
            let allowed =
                goal.judge(computed, 1.0).is_some_and(|(_, beyond)| beyond.iter().all(|beyond| *beyond <= 1e-3));
            kept.push(allowed);
            if let Some(there) = value(computed)
                && allowed
                && sign * (there.value - best.value) > (there.error + best.error).max(0.0)
                && better.as_ref().is_none_or(|(_, other)| sign * (there.value - other) > 0.0)
            {
                better = Some((unknown.with_value(*place), there.value));
            }
        }
        let points: Vec<(f64, Option<f64>)> = numbers
            .iter()
            .map(|(place, computed)| (unknown.value(*place), value(computed).map(|found| found.value)))
            .collect();
        let middle = places.iter().position(|place| *place == x[k]).unwrap_or(0);
        for beside in [middle.checked_sub(1), Some(middle + 1)].into_iter().flatten() {
            let Some((place, Some(Err(reason)))) = numbers.get(beside).map(|(at, found)| (at, found.first())) else {
                continue;
            };
            warnings.push(format!("{} cannot be computed: {reason}", unknown.with_value(*place)));
        }
        let end = |upwards| edge((&points, &kept), (middle, best.value, little), upwards);
        let flat = within.then(|| (end(false), end(true)));
        lines.push(Scan { value: unknown.value(x[k]), unknown, at: at[k], points, kept, flat });
    }
    for line in &lines {
        let Some(bound) = line.at else { continue };
        let name = goal.quantity.name();
        let (parameter, lower) = (line.unknown.parameter, bound == Bound::Lower);
        let range = line.unknown.to - line.unknown.from;
        let flat_to = line.flat.map(|(from, to)| if lower { to } else { from });
        let plateau = flat_to.filter(|to| (line.value - to).abs() > PLATEAU * range);
        let beyond = match plateau.map(|to| parameter.with_unit(short(to, 3))) {
            Some(flat) if lower => format!("up to {flat} {name} changes by less than {}", percent(little)),
            Some(flat) => format!("from {flat} on {name} changes by less than {}", percent(little)),
            None => "a better value, if there is one, lies beyond it".to_owned(),
        };
        let (side, value) = (bound.name(), parameter.with_unit(short(line.value, 6)));
        warnings.push(format!("{} is at its {side} bound, {value}: {beyond}", parameter.key));
    }
    for ((limit, _), found) in goal.limits.iter().zip(&limited) {
        let (over, unclear) = limit.over(found);
        if over > unclear {
            warnings.push(format!("the limit {limit} cannot be kept: {} is reached", found));
        } else if over.abs() <= unclear {
            warnings.push(format!("the limit {limit} is what stops it"));
        }
    }
    if !converged {
        warnings.push(format!("the search was ended after {MOST_POINTS} points"));
    }
    if let Some((at, there)) = better {
        warnings.push(format!(
            "{} is better, {}, at {at}, the others unchanged: this is not the optimum within the bounds; more starts may find it (--starts)",
            goal.quantity.name(),
            short(there, 6)
        ));
    }
    let scene = model.fitted(&x, "optimised")?;
    // Warnings that are given wherever this scene is solved.
    if let Ok(solution) = attempt(&Problem::try_from(&scene)?, &model.settings, &mut (), cancel) {
        warnings.extend(solution.warnings);
    }
    Ok(Some(Optimum {
        goal: goal.clone(),
        value: best,
        before: value(&before),
        limited,
        lines,
        converged: converged && within,
        solves: model.solves(),
        warnings,
        scene,
    }))
}

/// The relative change of the number that is allowed within [`Scan::flat`]: a hundredth, or its own numerical error if that is greater.
fn flatness(best: &Estimate) -> f64 {
    let own = best.error / best.value.abs();
    if own.is_finite() { own.max(FLAT) } else { FLAT }
}

/// The place above or below the optimum where the number first differs from it by more than a share, by linear interpolation. If a limit is
/// broken before that, the last point at which all limits are kept; if there is neither, the end of the line.
fn edge(
    (points, kept): (&[(f64, Option<f64>)], &[bool]),
    (middle, best, little): (usize, f64, f64),
    upwards: bool,
) -> f64 {
    let order: Vec<usize> = if upwards { (middle..points.len()).collect() } else { (0..=middle).rev().collect() };
    let mut last = (points[middle].0, 0.0);
    for i in order {
        let (place, found) = points[i];
        let off = found.map_or(f64::INFINITY, |found| (found - best).abs() / best.abs().max(f64::MIN_POSITIVE));
        if i != middle && !kept[i] {
            return last.0;
        }
        if off > little {
            let share = if off.is_finite() { (little - last.1) / (off - last.1) } else { 0.0 };
            return last.0 + share * (place - last.0);
        }
        last = (place, off);
    }
    last.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_edge_is_where_a_share_is_lost_or_a_limit() {
        let parabola: Vec<(f64, Option<f64>)> =
            (0..=100).map(|i| f64::from(i) / 100.0).map(|x| (x, Some(2.0 * (1.0 - (x - 0.4) * (x - 0.4))))).collect();
        let mut kept = [true; 101];
        assert!((edge((&parabola, &kept), (40, 2.0, FLAT), true) - 0.5).abs() < 1e-3);
        assert!((edge((&parabola, &kept), (40, 2.0, FLAT), false) - 0.3).abs() < 1e-3);
        // The range does not extend to where a limit is broken, nor end before the difference exceeds the error of the number.
        kept[35] = false;
        assert_eq!(edge((&parabola, &kept), (40, 2.0, FLAT), false), 0.36);
        let known = Estimate { value: 2.0, error: 0.08 };
        assert!((edge((&parabola, &kept), (40, 2.0, flatness(&known)), true) - 0.6).abs() < 1e-3);
        assert_eq!([flatness(&Estimate::exact(2.0)), flatness(&Estimate { value: 0.0, error: 1.0 })], [FLAT; 2]);
        let broken = [(0.0, Some(1.0)), (1.0, None)];
        let found = [true, false].map(|upwards| edge((&broken, &[true; 2]), (0, 1.0, FLAT), upwards));
        assert_eq!(found, [0.0; 2]);
    }

    #[test]
    fn a_range_as_it_is_told_holds_its_optimum() {
        let unknown = Unknown::new(&Scene::motor(), &"film.min_spacing_nm=100:400".parse().unwrap()).unwrap();
        let (points, kept) = (Vec::new(), Vec::new());
        let scan = Scan { unknown, value: 166.84, at: None, points, kept, flat: Some((166.84, 168.0)) };
        assert_eq!(scan.in_digits(), ("166.8".to_owned(), Some(["166.8", "168.0"].map(str::to_owned))));
    }

    #[test]
    fn limits_are_read() {
        let limit: Limit = "alpha < 0.3".parse().unwrap();
        assert_eq!((limit.name.as_str(), limit.below, limit.value), ("alpha", true, 0.3));
        assert!(!"stall_torque_nm>=0.2".parse::<Limit>().unwrap().below);
        for (text, told) in [
            ("alpha < 20 %", "alpha < 0.2"),
            ("α<0.2", "alpha < 0.2"),
            ("alpha ≤ 0,3", "alpha < 0.3"),
            ("max_efficiency ≥ 5%", "max_efficiency > 0.05"),
            ("stall_torque_nm > 200 mN·m", "stall_torque_nm > 0.2"),
            ("stall_torque_nm > 0,2 N·m", "stall_torque_nm > 0.2"),
            ("min_gap_nm>0.05 µm", "min_gap_nm > 50"),
            ("max_power_w>0.3 W", "max_power_w > 0.3"),
        ] {
            assert_eq!(text.parse::<Limit>().unwrap().to_string(), told, "{text}");
        }
        for wrong in ["alpha", "alpha=0.3", "alpha<", "alpha<inf", "min_gap_nm<3 %", "min_gap_nm<3 kHz"] {
            assert!(wrong.parse::<Limit>().unwrap_err().to_string().contains("expected name<value"), "{wrong}");
        }
        let motor = crate::scene::presets::find("fundamental").unwrap();
        for (unknown, told) in [
            ("stall>0.2 N·m", "limit stall: no such number; did you mean stall_torque_nm? Allowed: alpha, "),
            (
                "stall_torque > 0.2",
                "limit stall_torque: no such number; did you mean stall_torque_nm? Allowed: alpha, ",
            ),
            ("qqq > 1 kPa", "limit qqq: no such number; allowed: alpha, "),
        ] {
            let error = Goal::new(&motor, "alpha", false, &[unknown.parse().unwrap()]).unwrap_err().to_string();
            // Only those of this scene.
            assert!(error.contains(told) && !error.contains("load_ratio"), "{error}");
        }
    }
}
