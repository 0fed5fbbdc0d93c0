//! A plate that floats: the mean gap at which the film carries the plate's load in the mean over the cycle.
//!
//! The plate is too heavy to shake, so that its gap stays harmonic. The load F that a film carries falls with the mean gap h at a given
//! amplitude a, from arbitrarily large values where the plate nearly touches, down to zero. In x = ln(h − a) its logarithm is nearly straight:
//! of slope −1/2 near touching, where a peak as narrow as √(h − a) carries all, −2 of trapped gas far away (F ≈ 1.25 p_a A (a/h)²), and up
//! to −6 of a viscous film. So ln F(x) is followed by the secant, within a bracket: below, the gap at which the plate rests on its
//! roughness; above, that at which no film could carry as much, since P is nowhere more than the greatest gap leaves in the least. First
//! on coarse grids, then on those that the accuracy asks for, each solve started from the last. The gap is as accurate as the load is:
//! its error is that of the load over |dF/dh|, with what is left of the bracket, or as far as to a gap at which the film carries too much or
//! too little beyond its error. A budget that is spent ends no search, since a gap that is half found is none: it leaves the first grids of
//! each solve, which take little time.

use super::level::PlateLevel;
use super::result::{add_errors, first_harmonic, numbers};
use super::slow::slow_motion;
use super::{Periodic, PlateSolver, finish, stated, turned};
use crate::control::{Cancel, Observer};
use crate::digits::brief;
use crate::estimate::Estimate;
use crate::film::cycle::Interrupted;
use crate::ladder::{SolvedGrids, climb};
use crate::memory::{self, MemoryExcess};
use crate::plan::Plan;
use crate::problem::{GRAVITY, HIGHEST, Plate};
use crate::solution::{Floating, Stats, Status};
use std::f64::consts::TAU;

/// Error of ln F to which the gap is found on coarse grids.
const ROUGHLY: f64 = 0.02;
/// Allowed difference between film load and load, as a fraction of the error asked for, or of the error of the load.
const SHARE: f64 = 0.1;
/// Allowed relative difference, where the scene prescribes its grids.
const ON_GIVEN_GRIDS: f64 = 1e-5;
/// Solves after which the gap is taken as it is.
const MOST_SOLVES: usize = 60;
/// Difference of x on either side for dF/dh, and the tolerance of a repeating cycle for it.
const STEP: f64 = 0.03;
const REPEATING: f64 = 1e-6;
/// Value used for ln(F/load) where the film load F is close to zero or negative.
const NOTHING: f64 = -30.0;
/// Relative accuracy of the least amplitude with which the plate floats.
const NEEDED: f64 = 0.02;
/// Smallest factor from one tried amplitude to the next.
const LEAST_GROWTH: f64 = 1.2;
/// Largest amplitude that is tried \[m\].
const LARGEST_AMPLITUDE: f64 = 1e-3;

/// Why a plate does not float.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FloatError {
    /// A film step failed, or it was cancelled.
    #[error("film, {0}")]
    Film(#[from] Interrupted),
    /// It needs more memory than is allowed.
    #[error(transparent)]
    Memory(#[from] MemoryExcess),
    /// It rests on its roughness.
    #[error("plate.amplitude_um = {}: the plate does not float: {}; at the smallest gap that film.min_spacing_nm = {} allows, the film carries only {} % of the load",
        brief(amplitude * 1e6),
        match needed {
            Some(needed) => format!("it would with an amplitude of about {} µm", brief(needed * 1e6)),
            None => format!("no amplitude up to {} µm is enough, as it is too heavy or too small", brief(LARGEST_AMPLITUDE * 1e6)),
        },
        brief(min_spacing * 1e9), brief(100.0 * share.clamp(0.0, 0.999)))]
    Rests {
        /// Amplitude \[m\].
        amplitude: f64,
        /// Least gap \[m\].
        min_spacing: f64,
        /// Film load at that gap, as a share of the plate's load.
        share: f64,
        /// The least amplitude with which it floats \[m\]; `None` if none does.
        needed: Option<f64>,
    },
    /// It is so light that it floats higher than any film.
    #[error("the plate is so light that it floats higher than {} µm, where there is no film to speak of: a greater load or a smaller plate.amplitude_um is needed", brief(HIGHEST * 1e6))]
    High,
}

/// Finds the mean gap at which the film under `plate` carries its `load` \[N or N/m\]. Returns the periodic state there, which includes the
/// gap, and the plan by which it was solved. `rough` makes a coarse plan for a plate at a given gap, `asked` one as accurate as is asked
/// for.
///
/// # Errors
/// [`FloatError`]; among them that it was cancelled.
pub fn float(
    plate: &Plate,
    load: f64,
    rough: &dyn Fn(&Plate) -> Plan,
    asked: &dyn Fn(&Plate) -> Plan,
    observer: &mut dyn Observer,
    cancel: &Cancel,
) -> Result<(Periodic, Plan), FloatError> {
    let mut nobody = ();
    let mut search = GapSearch {
        plate: plate.clone(),
        load,
        warm: None,
        certain: [plate.min_spacing, f64::INFINITY],
        stats: Stats::default(),
        observer,
        cancel,
    };
    if plate.amplitude == 0.0 {
        return Err(search.rests(0.0, rough));
    }
    let away = plate.trapped_gap(load).min(HIGHEST) - plate.amplitude;
    // What trapped gas would have, and about the slope of a film between touching and far away.
    let slope = -0.5 - 1.5 * away / (away + plate.amplitude);
    let roughly = search.seek(away.ln(), slope, rough, ROUGHLY)?;
    let sought = search.seek(roughly.x, roughly.slope, asked, 0.0)?;
    let Sought { x, left, found, plan, .. } = sought;
    let at = search.at(x);
    let mut periodic = finish(&turned(&at, &plan), &plan, &found, search.stats);
    let pinned = found.pinned(&plan);
    drop((found, search.warm.take()));
    // The progress of these auxiliary solves is not that of the result.
    search.observer = &mut nobody;
    let (mut stiffness, beside) = search.stiffness(x, &pinned)?;
    periodic.stats = Stats { film_nodes: periodic.stats.film_nodes, ..search.stats };
    periodic.stats.steps_per_cycle = pinned.grids.last().map_or(0, |grid| grid.steps);
    let result = &mut periodic.result;
    let off = result.film_load.error + (result.film_load.value - load).abs();
    result.film_load.error = off;
    let error = off / (stiffness.value.abs() - stiffness.error).max(0.0) + left;
    let mean_gap = Estimate { value: at.mean_gap, error: error.min(search.farthest(x)) };
    // F is about proportional to exp(−p x).
    let power = stiffness.value.abs() * x.exp() / load;
    stiffness.error += (power + 1.0) * stiffness.value.abs() * mean_gap.error / x.exp();
    beside.add(&mut periodic, mean_gap);
    let natural = (stiffness.value.max(0.0) * GRAVITY / load).sqrt() / TAU;
    let natural_frequency = Estimate { value: natural, error: 0.5 * natural * stiffness.error / stiffness.value.abs() };
    let floating = Floating { mean_gap, stiffness, natural_frequency, slow: None };
    let slow = slow_motion(&at, load, &floating);
    let result = &mut periodic.result;
    result.floating = Some(Floating { slow, ..floating });
    result.min_film_thickness.error = mean_gap.error;
    periodic.recording.min_film_thickness_error.fill(mean_gap.error);
    if periodic.status == Status::Converged && mean_gap.error > mean_gap.value {
        periodic.status = Status::NotResolved { error: mean_gap.error / mean_gap.value };
    }
    Ok((periodic, plan))
}

/// Sensitivity of a cycle to the gap: its states at a smaller and at a greater gap, `apart` \[m\] from each other.
struct Beside {
    sides: Vec<Periodic>,
    apart: f64,
}

impl Beside {
    /// Adds the effect of the gap's error to the errors of the state.
    fn add(&self, state: &mut Periodic, gap: Estimate) {
        let [below, above] = &self.sides[..] else { return };
        let share = gap.error / self.apart;
        let of = |side: &Periodic| numbers(&side.recording.film_load, &side.recording.max_pressure);
        let (less, more) = (of(below), of(above));
        // In addition, S and D are scaled with the amplitude over the gap.
        let scale = first_harmonic(&state.recording.film_load).map(|part| part.abs() * gap.error / gap.value);
        let scale = [0.0, 0.0, 0.0, scale[0], scale[1]];
        let errors = std::array::from_fn(|k| (more[k] - less[k]).abs() * share + scale[k]);
        add_errors(&mut state.result, errors);
        let (below, above, state) = (&below.recording, &above.recording, &mut state.recording);
        let add = |errors: &mut [f64], below: &[f64], above: &[f64]| {
            for (error, (below, above)) in errors.iter_mut().zip(below.iter().zip(above)) {
                *error += (above - below).abs() * share;
            }
        };
        add(&mut state.film_load_error, &below.film_load, &above.film_load);
        add(&mut state.max_pressure_error, &below.max_pressure, &above.max_pressure);
    }
}

/// The search for the gap at which the film carries the load.
struct GapSearch<'a> {
    plate: Plate,
    load: f64,
    /// The last solve, to start the next from.
    warm: Option<SolvedGrids<PlateLevel>>,
    /// Range of h − a \[m\] outside which the film certainly carries too much or too little, whatever its errors.
    certain: [f64; 2],
    stats: Stats,
    observer: &'a mut dyn Observer,
    cancel: &'a Cancel,
}

/// A gap at which the film carries the load, as x = ln(h − a), with the slope of ln F and the solve there. If the search ended before that,
/// also the remaining width of the bracket \[m\].
struct Sought {
    x: f64,
    slope: f64,
    left: f64,
    found: SolvedGrids<PlateLevel>,
    plan: Plan,
}

impl GapSearch<'_> {
    fn at(&self, x: f64) -> Plate {
        Plate { mean_gap: self.plate.amplitude + x.exp(), ..self.plate.clone() }
    }

    /// Distance from the gap of `x` to the farther end of the certain range \[m\].
    fn farthest(&self, x: f64) -> f64 {
        let [least, greatest] = self.certain;
        (greatest - x.exp()).max(x.exp() - least)
    }

    fn solve(&mut self, plate: &Plate, plan: &Plan) -> Result<(Estimate, SolvedGrids<PlateLevel>), FloatError> {
        // The last solve is kept in memory during this one.
        let need = memory::plate(plate, plan);
        let _taken = memory::take(memory::Need { bytes: 2 * need.bytes, ..need }, self.cancel)?;
        let plate = &turned(plate, plan);
        let warm = self.warm.take().filter(|warm| warm.spectral == plan.spectral && !plan.turned);
        let mut solver =
            PlateSolver { plate, observer: &mut *self.observer, cancel: self.cancel, stats: &mut self.stats };
        let found = climb(&mut solver, plan, warm.as_ref(), self.cancel)?;
        if found.status == Status::Cancelled {
            return Err(Interrupted::Cancelled.into());
        }
        Ok((stated(plate, plan, &found), found))
    }

    /// The gap, from `x` and the `slope` of ln F there on, until the film carries the load to `within`, or to the error that it has: also after
    /// the budget is spent, on the first grids.
    fn seek(
        &mut self,
        mut x: f64,
        mut slope: f64,
        planned: &dyn Fn(&Plate) -> Plan,
        within: f64,
    ) -> Result<Sought, FloatError> {
        let amplitude = self.plate.amplitude;
        let ratio = 1.0 + self.load / (self.plate.gas.ambient_pressure * self.plate.area());
        // The gap at which the largest possible mean pressure ratio, √((1 + ε)/(1 − ε)), just carries the load.
        let cap = amplitude * (ratio * ratio + 1.0) / (ratio * ratio - 1.0);
        let floor = self.plate.min_spacing.ln();
        let ceiling = (cap.min(HIGHEST.max(amplitude + self.plate.min_spacing)) - amplitude).ln();
        let (mut low, mut high) = (floor, ceiling.max(floor));
        self.certain[1] = self.certain[1].min(high.exp());
        let mut last: Option<(f64, f64)> = None;
        let mut solves = 0;
        loop {
            let had_time = !self.cancel.is_spent();
            x = x.clamp(low, high);
            let plate = self.at(x);
            let plan = planned(&plate);
            let (carried, found) = self.solve(&plate, &plan)?;
            solves += 1;
            if carried.value - carried.error > self.load {
                self.certain[0] = self.certain[0].max(x.exp());
            } else if carried.value + carried.error < self.load {
                self.certain[1] = self.certain[1].min(x.exp());
            }
            let y = (carried.value / self.load).max(NOTHING.exp()).ln();
            if let Some((x_before, y_before)) = last {
                let secant = (y - y_before) / (x - x_before);
                slope = if secant < -0.1 { secant.max(-12.0) } else { slope };
            }
            let target = if plan.accuracy > 0.0 { SHARE * plan.accuracy } else { ON_GIVEN_GRIDS };
            // A large error of the load does not justify a large difference.
            let known = SHARE * (carried.error / self.load).min(ROUGHLY);
            let close = (carried.value / self.load - 1.0).abs() <= known.max(within.max(target));
            let enough = solves == MOST_SOLVES || solves > 1 && high - low < 1e-12;
            // The first grids alone do not show whether the plate rests.
            let may_rest = x <= floor && self.cancel.is_spent() && carried.value + carried.error >= self.load;
            if close || enough || y < 0.0 && may_rest {
                let end = if y > 0.0 { high } else { low };
                let left = if close { 0.0 } else { (end.exp() - x.exp()).abs() };
                return Ok(Sought { x, slope, left, found, plan });
            }
            self.warm = (!plan.turned).then_some(found);
            if y < 0.0 && x <= floor {
                return Err(self.rests(carried.value / self.load, planned));
            }
            if y > 0.0 && x >= ceiling && cap > HIGHEST {
                return Err(FloatError::High);
            }
            if y > 0.0 {
                low = x
            } else {
                high = x
            }
            last = Some((x, y));
            if had_time && self.cancel.is_spent() {
                // The budget is spent and only the first grids are solved from now on: a bracket found on finer grids does not hold for
                // them.
                (low, high, last) = (floor, ceiling.max(floor), None);
            }
            let next = x - y / slope;
            let untried = next <= low && low == floor || next >= high && high == ceiling;
            x = if next > low && next < high || untried { next } else { 0.5 * (low + high) };
        }
    }

    /// −dF/dh \[N/m\] about the gap of `x`, by two solves on the grids of `plan`, whose errors cancel; and these.
    fn stiffness(&mut self, x: f64, plan: &Plan) -> Result<(Estimate, Beside), FloatError> {
        let plan = Plan { tolerance: plan.tolerance.min(REPEATING), accuracy: REPEATING, maps: false, ..plan.clone() };
        let (mut loads, mut sides) = ([[0.0; 2]; 2], Vec::new());
        let gaps = [x - STEP, x + STEP].map(|x| self.at(x));
        for (plate, load) in gaps.iter().zip(&mut loads) {
            let (_, mut found) = self.solve(plate, &plan)?;
            let plate = turned(plate, &plan);
            let carried = found.nested(|found| stated(&plate, &plan, found).value);
            *load = [carried.fine, carried.coarse.unwrap_or(f64::NAN)];
            sides.push(finish(&plate, &plan, &found, Stats::default()));
        }
        let step = gaps[1].mean_gap - gaps[0].mean_gap;
        let [fine, coarse] = [0, 1].map(|grids| (loads[0][grids] - loads[1][grids]) / step);
        // F ~ exp(−p x): the difference over 2 STEP is off by (p² − 1) STEP²/6.
        let power = fine * x.exp() / self.load;
        let error = (fine - coarse).abs() + (power * power + 1.0) / 6.0 * STEP * STEP * fine.abs();
        let error = if error.is_finite() { error } else { f64::INFINITY };
        Ok((Estimate { value: fine, error }, Beside { sides, apart: step }))
    }

    /// The error that the plate rests on its roughness, where the film carries this `share` of the load, and the amplitude that it would
    /// need.
    fn rests(&mut self, share: f64, plan: &dyn Fn(&Plate) -> Plan) -> FloatError {
        let (amplitude, min_spacing) = (self.plate.amplitude, self.plate.min_spacing);
        match self.needed(plan) {
            Ok(needed) => FloatError::Rests { amplitude, min_spacing, share, needed },
            Err(error) => error,
        }
    }

    /// The least amplitude \[m\] with which the film carries the load while the least gap is that of the roughness. At first the load grows
    /// with the amplitude, because gas is trapped, until the gap is so wide that gas leaves.
    fn needed(&mut self, plan: &dyn Fn(&Plate) -> Plan) -> Result<Option<f64>, FloatError> {
        let (plate, spacing) = (self.plate.clone(), self.plate.min_spacing);
        self.warm = None;
        let most = LARGEST_AMPLITUDE - spacing;
        let carried = |search: &mut Self, amplitude: f64| -> Result<f64, FloatError> {
            let plate = Plate { amplitude, ..plate.clone() }.resting();
            let (load, _) = search.solve(&plate, &plan(&plate))?;
            Ok(load.value / search.load)
        };
        let ratio = self.load / (self.plate.gas.ambient_pressure * self.plate.area());
        // With a smaller amplitude no film could carry the load.
        let mut low = 0.5 * spacing * ratio * (2.0 + ratio);
        if low > most {
            return Ok(None);
        }
        let (mut before, mut of_low, mut high) = (low, carried(self, low)?, low);
        while of_low < 1.0 {
            if low == most {
                return Ok(None);
            }
            // Near touching the load grows with the square root of the amplitude, and nowhere faster than with its square.
            let growth = of_low.max(1e-3).powi(-2).clamp(LEAST_GROWTH, 4.0);
            high = most.min(low * growth.max(of_low.max(NOTHING.exp()).powf(-0.5)));
            let of_high = carried(self, high)?;
            if of_high >= 1.0 {
                break;
            }
            if of_high < of_low {
                // The film carries most at an amplitude in between.
                low = before;
                loop {
                    if high / low < 1.0 + NEEDED {
                        return Ok(None);
                    }
                    let inner = [1.0, 2.0].map(|third| low * (high / low).powf(third / 3.0));
                    let [left, right] = [carried(self, inner[0])?, carried(self, inner[1])?];
                    if left.max(right) >= 1.0 {
                        (low, high) = (before, if left >= 1.0 { inner[0] } else { inner[1] });
                        break;
                    }
                    // Beyond its greatest value it falls at most with the sixth power.
                    if left.max(right) * (high / low).powi(6) < 1.0 {
                        return Ok(None);
                    }
                    if left < right {
                        low = inner[0];
                    } else {
                        high = inner[1];
                    }
                }
                break;
            }
            (before, low, of_low) = (low, high, of_high);
        }
        while high / low > 1.0 + NEEDED {
            let middle = (low * high).sqrt();
            if carried(self, middle)? < 1.0 { low = middle } else { high = middle }
        }
        Ok(Some(high))
    }
}
