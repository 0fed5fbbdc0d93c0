//! Torque, power and efficiency of a motor over the speed of its rotor, from the position of its contact load in the wave.
//!
//! The model is Coulomb friction at every point of contact and every instant. The stator's surface moves with V_St = V₀ cos 2πφ, V₀ = 2πf
//! B_S, φ = t/T + x/λ. It drives a rotor at V_R = v V₀ forward where cos 2πφ > v and brakes it elsewhere, so everything follows from the
//! distribution of the contact load over the wave:
//!
//! ```text
//! torque          T = μ_d · waves · r · N s₀(v),          N s₀ = ∫ c sign(cos 2πφ − v)
//! stator's power      μ_d · waves · V₀ · N s₁(v),         N s₁ = ∫ c sign(cos 2πφ − v) cos 2πφ
//! output          T V_R / r
//! friction heat      the difference, μ_d · waves · ∫ c |V_St − V_R| ≥ 0
//! ```
//!
//! ∫ is over one wavelength and averaged over a cycle, and N = ∫ c = (1 − α) L. The sign function is not smoothed: c is linear in time
//! between frames, so that the integrals up to the two instants at which a node's sign changes are closed forms. Over x the nodal values
//! are summed times their lengths, which is of second order. The curvature of c between frames is the largest part of the error. The same
//! integrals over every other frame show how large it is, and s₀ and s₁ are extrapolated from both.
//!
//! N is the extrapolated contact load of the solve. The shapes s₀ and s₁ are those of the recorded contact, which is extrapolated, too.
//! Their errors are estimated from the shapes of the coarser contact among the recording's yardsticks ([`Recording::estimate`]), obtained
//! in the same way, and from those of the finest grid without extrapolation, over all frames.
//!
//! s₀ ≤ 1, so the torque has an upper bound, the paper's maximum operating torque μ_d N waves r. A motor pressed so heavily that teeth also
//! touch in the troughs of the wave stays far below it, because parts of the contact always brake.

use crate::estimate::Estimate;
use crate::plan::ROTOR_EFFECT;
use crate::problem::Motor;
use crate::recording::{LineLoads, Recording};
use crate::solution::{MotorResult, OperatingPoint, Performance};
use std::f64::consts::TAU;

/// Number of speeds, equally spaced from rest to the stator's greatest speed, at which the greatest power is first sought.
const SPEEDS: usize = 11;
/// Steps of the golden-section search that follows; each narrows the interval by a factor of 0.62. A parabola through the last three points
/// is the final step.
const NARROWED: usize = 10;
/// Difference of speed ratio on either side at which the error of a point is also evaluated.
const NEAR: f64 = 0.02;
/// The error is at least this fraction of the change from the first of three grids to the second.
const EARLIER: f64 = 0.5;
/// Safety factor where every tooth touches at all times: driving and braking parts nearly cancel, and the differences between grids show
/// only half of the error (calibrated: docs/validation.md).
const CLOSED: f64 = 2.0;
/// Largest relative change of a shape over the relative change of the contact load that causes it, and of a speed over that of a shape
/// (measured between no film and the whole film).
const OF_SHAPE: f64 = 0.5;
const OF_SPEED: f64 = 0.5;
/// Relative error of the film's power over that of its mean load, due to too few nodes across (measured: 1.7 for the fundamental case with
/// two nodes).
const OF_WIDTH: f64 = 2.0;
/// Safety factor on the error of the film's power that the grids give (calibrated: docs/validation.md).
const OF_POWER: f64 = 2.0;
/// Least share of the load on the contact that a change of the contact load is divided by.
const LEAST_SHARE: f64 = 1e-6;
/// Safety factor on the error that the grids give for contact without film (calibrated: docs/validation.md).
const DRY: f64 = 1.3;
/// Difference of speed ratio over which the error of a curve may change by its own size, from which the error of the slope follows.
const VARIES: f64 = 0.05;

/// Distribution of the contact load over the wave, on one grid.
#[derive(Clone, Debug, Default)]
pub struct Drive {
    frames: ContactIntegrals,
    /// The integrals over every other frame, if c is to be extrapolated from both.
    coarse: Option<ContactIntegrals>,
}

/// Integrals of the contact load up to any phase, over the frames of a cycle or some of them.
#[derive(Clone, Debug, Default)]
struct ContactIntegrals {
    lines: Vec<Line>,
    /// Cycle mean of the contact load on one wavelength \[N\].
    load: f64,
    /// The same for c cos 2πφ \[N\].
    forward: f64,
}

/// One node of one stored tooth over the cycle.
#[derive(Clone, Debug)]
struct Line {
    /// φ at t = 0.
    offset: f64,
    steps: Vec<FrameInterval>,
    /// ∫ c Δx dt/T over the cycle \[N\].
    sum: f64,
    /// The same for c cos 2πφ \[N\].
    forward: f64,
}

/// From one frame to the next, c Δx being linear in between.
#[derive(Clone, Copy, Debug)]
struct FrameInterval {
    /// c Δx at the frame, times how many teeth it stands for \[N\].
    load: f64,
    /// Increase of `load` to the next frame \[N\].
    rise: f64,
    /// ∫ c Δx dt/T from the first frame to this one \[N\].
    sum: f64,
    /// The same for c cos 2πφ, less [`FrameInterval::primitive`] at the frame \[N\].
    forward: f64,
}

/// Characteristic points of the curves of one grid, dimensionless. Speeds are ratios to V₀.
struct Marks {
    /// s₀ at rest.
    stall: f64,
    /// Speed ratio at which s₀ vanishes; 0 without contact.
    no_load: f64,
    /// Speed ratio at which v s₀ is greatest, and v s₀ there.
    output: (f64, f64),
    /// Speed ratio at which the efficiency is greatest, and the efficiency there.
    efficiency: (f64, f64),
}

impl ContactIntegrals {
    /// The integrals over every `every`-th frame of a cycle.
    fn new(cycle: &LineLoads, every: usize) -> Self {
        let (nodes, frames) = (cycle.x.len(), cycle.frames / every);
        let copies = cycle.teeth as f64 / cycle.stored_teeth.max(1) as f64;
        let turns: Vec<(f64, f64)> = (0..=frames).map(|m| (TAU * m as f64 / frames as f64).sin_cos()).collect();
        let mut lines = Vec::new();
        let mut load = vec![0.0; frames];
        for tooth in 0..cycle.stored_teeth {
            for (i, (x, length)) in cycle.x.iter().zip(&cycle.node_length).enumerate() {
                for (frame, load) in load.iter_mut().enumerate() {
                    *load = cycle.contact[(tooth * cycle.frames + frame * every) * nodes + i] * length * copies;
                }
                if load.iter().any(|load| *load > 0.0) {
                    lines.push(Line::new((tooth as f64 * cycle.pitch + x) / cycle.length, &load, &turns));
                }
            }
        }
        let load = lines.iter().map(|line| line.sum).sum();
        let forward = lines.iter().map(|line| line.forward).sum();
        Self { lines, load, forward }
    }

    /// (s₀, s₁), where the rotor is driven forward while |φ| < `half`, given the sine and cosine of 2π·`half`; `None` without contact.
    fn at(&self, half: f64, (sin, cos): (f64, f64)) -> Option<(f64, f64)> {
        let (mut sum, mut forward) = (0.0, 0.0);
        for line in &self.lines {
            let (to, from) = (line.until(half, (sin, cos)), line.until(-half, (-sin, cos)));
            sum += to.0 - from.0;
            forward += to.1 - from.1;
        }
        let share = |dragged: f64, all: f64| (2.0 * dragged - all) / self.load;
        (self.load > 0.0).then(|| (share(sum, self.load), share(forward, self.forward)))
    }
}

impl Drive {
    /// The distribution for the contact of one cycle.
    pub fn new(cycle: &LineLoads) -> Self {
        let coarse = cycle.frames.is_multiple_of(2).then(|| ContactIntegrals::new(cycle, 2));
        Self { coarse, ..Self::as_solved(cycle) }
    }

    /// The same without the extrapolation from every other frame.
    fn as_solved(cycle: &LineLoads) -> Self {
        Self { frames: ContactIntegrals::new(cycle, 1), coarse: None }
    }

    /// Cycle mean of the contact load on one wavelength \[N\].
    pub fn load(&self) -> f64 {
        self.frames.load
    }

    /// (s₀, s₁) at the speed ratio `v` = V_R/V₀: force on the rotor and power from the stator, as shares of μ_d N and
    /// μ_d N V₀. Both are 0 without contact.
    pub fn at(&self, v: f64) -> (f64, f64) {
        let cos = v.clamp(-1.0, 1.0);
        let (half, sin) = (cos.acos() / TAU, (1.0 - cos * cos).sqrt());
        let at = |frames: &ContactIntegrals| frames.at(half, (sin, cos));
        let Some((s0, s1)) = at(&self.frames) else { return (0.0, 0.0) };
        let Some((coarse_0, coarse_1)) = self.coarse.as_ref().and_then(at) else { return (s0, s1) };
        // Second order: a third of the difference is still missing. The limits are that all of the contact pulls one way, and that friction
        // only dissipates.
        let missing = |fine: f64, coarse: f64| fine + (fine - coarse) / 3.0;
        let force = missing(s0, coarse_0).clamp(-1.0, 1.0);
        (force, missing(s1, coarse_1).max(v * force))
    }

    /// Speed ratio at which the force vanishes, which falls from +1 to −1; `None` without contact.
    pub fn no_load(&self) -> Option<f64> {
        if self.load() <= 0.0 {
            return None;
        }
        // Regula falsi; the value at an end that is kept twice is halved (Illinois).
        let (mut low, mut high) = ((-1.0, 1.0), (1.0, -1.0));
        let (mut middle, mut last) = (0.0, 0.0);
        for _ in 0..60 {
            middle = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
            let found = self.at(middle).0;
            if found.abs() < 1e-14 || high.0 - low.0 < 1e-13 {
                break;
            }
            let again = if last * found > 0.0 { 0.5 } else { 1.0 };
            if found > 0.0 {
                low = (middle, found);
                high.1 *= again;
            } else {
                high = (middle, found);
                low.1 *= again;
            }
            last = found;
        }
        Some(middle)
    }

    /// `loss`: the film's share of the stator's power, in μ_d N V₀.
    fn marks(&self, loss: f64) -> Marks {
        // Above this speed the rotor is braked.
        let no_load = self.no_load().unwrap_or(0.0);
        let step = no_load.max(0.0) / (SPEEDS - 1) as f64;
        let curve: Vec<(f64, f64)> = (0..SPEEDS).map(|i| self.at(i as f64 * step)).collect();
        Marks {
            stall: curve[0].0,
            no_load,
            output: self.greatest(&curve, step, |v, (s0, _)| v * s0),
            efficiency: self.greatest(&curve, step, |v, at| efficiency(v, at, loss).unwrap_or(0.0)),
        }
    }

    /// The speed ratio at which `value` of v and (s₀, s₁) is greatest, and that value. `curve`: (s₀, s₁) at ratios from 0 on, a `step` apart.
    fn greatest(&self, curve: &[(f64, f64)], step: f64, value: impl Fn(f64, (f64, f64)) -> f64) -> (f64, f64) {
        let at = |v: f64| (v, value(v, self.at(v)));
        let known = |i: usize| (i as f64 * step, value(i as f64 * step, curve[i]));
        let best = (0..curve.len()).max_by(|a, b| known(*a).1.total_cmp(&known(*b).1)).unwrap_or(0);
        // Golden section between its neighbours.
        let ratio = 0.5 * (5f64.sqrt() - 1.0);
        let (mut low, mut high) = (known(best.saturating_sub(1)), known((best + 1).min(curve.len() - 1)));
        let (mut left, mut right) = (at(high.0 - ratio * (high.0 - low.0)), at(low.0 + ratio * (high.0 - low.0)));
        for _ in 0..NARROWED {
            if left.1 < right.1 {
                (low, left) = (left, right);
                right = at(low.0 + ratio * (high.0 - low.0));
            } else {
                (high, right) = (right, left);
                left = at(high.0 - ratio * (high.0 - low.0));
            }
        }
        let last = if left.1 < right.1 { vertex([left, right, high]) } else { vertex([low, left, right]) };
        let found = [known(best), left, right].into_iter().chain(last.map(at));
        found.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default()
    }
}

/// Position of the maximum of the parabola through three points, given from left to right; `None` if it has no maximum.
fn vertex([before, here, behind]: [(f64, f64); 3]) -> Option<f64> {
    let slope = |from: (f64, f64), to: (f64, f64)| (to.1 - from.1) / (to.0 - from.0);
    let (rise, fall) = (slope(before, here), slope(here, behind));
    let place = 0.5 * (before.0 + here.0) + 0.5 * (behind.0 - before.0) * rise / (rise - fall);
    (rise > fall && place.is_finite()).then(|| place.clamp(before.0, behind.0))
}

/// Round-off of s₀ and s₁.
const ROUNDING: f64 = 1e-9;

/// Output over the power that the stator delivers, at a speed ratio and its (s₀, s₁); `None` where the rotor is not driven. It is 0 at the
/// no-load speed, where s₀ is only round-off.
fn efficiency(v: f64, (s0, s1): (f64, f64), loss: f64) -> Option<f64> {
    let idle = v > 0.0 && s0.abs() < ROUNDING;
    (v * s0 > 0.0 || idle).then(|| if idle { 0.0 } else { v * s0 / (s1 + loss) })
}

impl Line {
    /// `turns`: sine and cosine of 2πt/T at the frames, and once more at the end of the cycle.
    fn new(offset: f64, load: &[f64], turns: &[(f64, f64)]) -> Self {
        let frames = load.len();
        let step = 1.0 / frames as f64;
        let (sin, cos) = (TAU * offset).sin_cos();
        let phase = |(s, c): (f64, f64)| (s * cos + c * sin, c * cos - s * sin);
        let (mut sum, mut forward) = (0.0, 0.0);
        let mut steps = Vec::with_capacity(frames);
        for (frame, (from, to)) in load.iter().zip(load.iter().cycle().skip(1)).enumerate() {
            let mut next = FrameInterval { load: *from, rise: to - from, sum, forward };
            if *from != 0.0 || *to != 0.0 {
                next.forward -= next.primitive(frames, 0.0, phase(turns[frame]));
                forward = next.forward + next.primitive(frames, 1.0, phase(turns[frame + 1]));
                sum += 0.5 * step * (from + to);
            }
            steps.push(next);
        }
        Self { offset, steps, sum, forward }
    }

    /// ∫ c and ∫ c cos 2πφ from t = 0 to the time, before or after it, at which φ is `phase`, of this sine and cosine.
    fn until(&self, phase: f64, at: (f64, f64)) -> (f64, f64) {
        let frames = self.steps.len();
        let mut place = (phase - self.offset) * frames as f64;
        let (mut sum, mut forward) = (0.0, 0.0);
        // |φ| ≤ ½ is at most a cycle or two away.
        while place < 0.0 {
            place += frames as f64;
            sum -= self.sum;
            forward -= self.forward;
        }
        let frame = (place as usize).min(frames - 1);
        let step = self.steps[frame];
        let share = place - frame as f64;
        sum += step.sum + share * (step.load + 0.5 * share * step.rise) / frames as f64;
        (sum, forward + step.forward + step.primitive(frames, share, at))
    }
}

impl FrameInterval {
    /// A primitive of c cos 2πφ over t/T, at the fraction `share` of the step after the frame, where 2πφ has this sine and cosine.
    fn primitive(&self, frames: usize, share: f64, (sin, cos): (f64, f64)) -> f64 {
        let turn = 1.0 / TAU;
        turn * ((self.load + share * self.rise) * sin + turn * frames as f64 * self.rise * cos)
    }
}

/// The contact, the data that its errors are estimated from, and the scale factors to newtons and watts.
#[derive(Debug)]
pub struct Scaled<'a> {
    motor: &'a Motor,
    drive: Lossy,
    /// The same from the recording's yardsticks, by which its error is estimated ([`judged`]).
    others: Vec<Lossy>,
    /// N \[N\].
    load: Estimate,
    /// Safety factor on the differences of shapes.
    doubt: f64,
    /// Relative error of shapes that no grid shows: that of the terms left out of the film, and that of the rotor's compliance.
    unseen: f64,
    /// The same, as an absolute error of fractions and of speed ratios: the unknown position of a contact between nodes.
    misplaced: f64,
}

/// The contact of one grid, and the power that the film takes from the stator, in units of μ_d N V₀.
type Lossy = (Drive, f64);

/// A speed ratio V_R/V₀, and for each [`Lossy`] of a motor (s₀, s₁) at that ratio and the film's loss. The first [`Lossy`] is the result;
/// the others show its error.
type Place = (f64, Vec<((f64, f64), f64)>);

/// A dimensionless result, as a function of a speed ratio, (s₀, s₁) there, and the film's loss.
type Share<'a> = &'a dyn Fn(f64, (f64, f64), f64) -> f64;

impl<'a> Scaled<'a> {
    /// The contact of a solve with its film.
    pub fn with_film(motor: &'a Motor, result: &MotorResult, recording: &Recording) -> Self {
        let load = Estimate { value: (1.0 - result.alpha.value).max(0.0), ..result.alpha } * motor.load;
        let spent = motor.friction_torque(load.value) * motor.stator_speed() / motor.contact_radius;
        let lossy = |drive: Drive, loads| (drive, if spent > 0.0 { taken(motor, loads).max(0.0) / spent } else { 0.0 });
        let extrapolated = |loads| lossy(Drive::new(loads), loads);
        let others = match &recording.yardsticks[..] {
            [before, finest] => vec![extrapolated(before), lossy(Drive::as_solved(finest), finest)],
            _ => Vec::new(),
        };
        let closed = recording.teeth_in_contact.iter().all(|touching| *touching >= motor.teeth);
        let doubt = if closed { CLOSED } else { 1.0 };
        let of_contact = result.alpha.value.abs() / (1.0 - result.alpha.value).max(LEAST_SHARE);
        let unseen = (OF_SHAPE * recording.forced * of_contact).min(1.0) + recording.rotor.relative_error;
        Self { motor, drive: extrapolated(&recording.lines), others, load, doubt, unseen, misplaced: 0.0 }
    }

    /// The contact in a vacuum, without film, on nested grids, coarse to fine; the finest gives the result. `rotor_error` is the relative
    /// error of the rotor's compliance.
    pub fn without_film(motor: &'a Motor, dry: &[LineLoads], rotor_error: f64) -> Self {
        let lossless = |drive: Drive| (drive, 0.0);
        let others = match dry {
            [.., before, finest] => {
                let grids = [Drive::new(before), Drive::as_solved(finest)].into_iter();
                let first = dry.len().checked_sub(3).map(|first| Drive::new(&dry[first]));
                grids.chain(first).map(lossless).collect()
            }
            _ => Vec::new(),
        };
        let drive = lossless(dry.last().map(Drive::new).unwrap_or_default());
        let misplaced = dry.last().map_or(0.0, |finest| TAU * between_nodes(finest));
        Self { motor, drive, others, load: Estimate::exact(motor.load), doubt: DRY, unseen: rotor_error, misplaced }
    }

    /// Speed at which the torque vanishes \[m/s\].
    pub fn no_load_speed(&self) -> Option<f64> {
        Some(self.drive.0.no_load()? * self.motor.stator_speed())
    }

    /// μ_d waves N r \[N m\].
    fn torque(&self) -> Estimate {
        self.load * self.motor.friction_torque(1.0)
    }

    /// Unit of efficiencies, with its error: the film's loss is a fraction of N, so a relative error of N changes an efficiency by at most
    /// that relative error.
    fn loss_scale(&self) -> Estimate {
        Estimate { value: 1.0, error: if self.drive.1 > 0.0 { self.load.error / self.load.value } else { 0.0 } }
    }

    /// A fraction of `unit`. Contact that was missed may be anywhere; all of it together changes the fraction by at most `most`.
    fn scaled(&self, unit: Estimate, share: Estimate, most: f64) -> Estimate {
        // Where all contact pulls one way on every grid, there is none near a change of sign.
        let one_way = 1.0 - share.value.abs() + share.error < ROUNDING;
        let size = share.value.abs();
        let unseen = if one_way { 0.0 } else { self.unseen * size + self.misplaced * size.max(1.0 - size) };
        let shape = share.error * self.doubt + unseen;
        let shape = if unit.value == 0.0 { 0.0 } else { unit.value.abs() * shape };
        Estimate { value: unit.value * share.value, error: shape + most * unit.error }
    }

    /// Error of a speed ratio that no grid shows.
    fn of_speed(&self, v: f64) -> f64 {
        OF_SPEED * self.unseen * v.abs() + self.misplaced
    }

    /// The contact at a speed ratio and at its two neighbours. Where the differences that estimate an error change their sign, they are
    /// small by chance, so the neighbours count as well.
    fn near(&self, v: f64) -> [Place; 3] {
        let all = || std::iter::once(&self.drive).chain(&self.others);
        [v - NEAR, v, v + NEAR].map(|v| (v, all().map(|(drive, loss)| (drive.at(v), *loss)).collect()))
    }

    /// A fraction at three speed ratios, each with its error.
    fn shares(&self, near: &[Place; 3], share: Share<'_>) -> [Estimate; 3] {
        near.each_ref().map(|(v, all)| {
            let shares: Vec<f64> = all.iter().map(|(at, loss)| share(*v, *at, *loss)).collect();
            judged(shares[0], &shares[1..])
        })
    }

    fn point(&self, speed: f64) -> OperatingPoint {
        let v0 = self.motor.stator_speed();
        if v0 == 0.0 && speed == 0.0 {
            // Nothing slides.
            return OperatingPoint::default();
        }
        // A stator that does not move along the ring holds the rotor, whatever its direction of rotation.
        let (v, per_ratio) = if v0 > 0.0 { (speed / v0, v0) } else { (speed.signum() * 2.0, 0.5 * speed.abs()) };
        let near = self.near(v);
        let scaled = |unit: Estimate, most: f64, share: Share<'_>| {
            let shares = self.shares(&near, share);
            self.scaled(unit, Estimate { value: shares[1].value, error: greatest_error(&shares) }, most)
        };
        let (unit, per_radius) = (self.torque(), 1.0 / self.motor.contact_radius);
        let force = unit * per_radius;
        let (at, loss) = near[1].1[0];
        let driven = efficiency(v, at, loss).filter(|_| unit.value > 0.0);
        let known = |s0: f64| if s0.abs() < ROUNDING { 0.0 } else { s0 };
        let output = scaled(force, speed.abs(), &|v, (s0, _), _| v * known(s0) * per_ratio);
        let given = force.value * v0 * (at.1 + loss);
        OperatingPoint {
            speed,
            torque: scaled(unit, 1.0, &|_, (s0, _), _| known(s0)),
            output,
            friction: scaled(force, v0 + speed.abs(), &|v, (s0, s1), _| s1 * v0 - v * s0 * per_ratio),
            efficiency: driven.map(|found| {
                let share = scaled(self.loss_scale(), found, &|v, at, loss| efficiency(v, at, loss).unwrap_or(0.0));
                // Where the efficiency vanishes, grids on which the rotor is not driven give no error for it: it is as uncertain as the
                // output.
                let least = if found == 0.0 && given > 0.0 { output.error / given } else { 0.0 };
                Estimate { error: share.error.max(least), ..share }
            }),
        }
    }

    /// All results, with a curve at these speeds \[m/s\].
    pub fn performance(&self, speeds: &[f64]) -> Performance {
        let speed = self.motor.stator_speed();
        let unit = self.torque();
        let per_radius = speed / self.motor.contact_radius;
        let power = unit * per_radius;
        let driven = unit.value > 0.0 && self.drive.0.load() > 0.0 && speed > 0.0;
        let marks = driven.then(|| {
            let marks = |(drive, loss): &Lossy| drive.marks(*loss);
            (marks(&self.drive), self.others.iter().map(marks).collect::<Vec<_>>())
        });
        let judged = |mark: fn(&Marks) -> f64| {
            let (found, others) = marks.as_ref()?;
            Some(judged(mark(found), &others.iter().map(mark).collect::<Vec<_>>()))
        };
        let marked = |unit: Estimate, mark: fn(&Marks) -> f64, most: fn(&Marks) -> f64| {
            Some(self.scaled(unit, judged(mark)?, most(&marks.as_ref()?.0)))
        };
        // Grids that agree by chance at one speed do not agree at its neighbours.
        let no_load = || {
            let v = judged(|marks| marks.no_load)?;
            let force = self.shares(&self.near(v.value), &|_, (s0, _), _| s0);
            let slope = ((force[0].value - force[2].value) / (2.0 * NEAR)).max(f64::MIN_POSITIVE);
            let error = self.doubt * v.error.hypot(greatest_error(&force) / slope) + self.of_speed(v.value);
            Some(Estimate { error, ..v } * speed)
        };
        // The position of a maximum is as uncertain as the slope of the curve, and the more so the flatter the curve is.
        let place = |mark: fn(&Marks) -> f64, share: Share<'_>| {
            let v = judged(mark)?;
            let curve = self.shares(&self.near(v.value), share);
            let bent = (curve[0].value - 2.0 * curve[1].value + curve[2].value).abs() / (NEAR * NEAR);
            let slope = greatest_error(&curve) / VARIES;
            let known = v.error.is_finite() && slope.is_finite();
            let error = if known { v.error.max(slope / bent.max(f64::MIN_POSITIVE)).min(1.0) } else { f64::INFINITY };
            Some(Estimate { error: error + self.of_speed(v.value), ..v } * speed)
        };
        // A motor that is not driven here may in fact be driven, by no more than the contact load that was missed.
        let nothing = |unit: Estimate| Estimate { value: 0.0, error: if speed > 0.0 { unit.error } else { 0.0 } };
        Performance {
            max_torque: unit,
            stall_torque: marked(unit, |marks| marks.stall, |_| 1.0).unwrap_or_else(|| nothing(unit)),
            no_load_speed: no_load(),
            max_power: marked(power, |marks| marks.output.1, |marks| marks.output.0).unwrap_or_else(|| nothing(power)),
            max_power_speed: place(|marks| marks.output.0, &|v, (s0, _), _| v * s0),
            max_efficiency: marked(self.loss_scale(), |marks| marks.efficiency.1, |marks| marks.efficiency.1),
            max_efficiency_speed: place(|marks| marks.efficiency.0, &|v, at, loss| {
                efficiency(v, at, loss).unwrap_or(0.0)
            }),
            present: self.point(self.motor.rotor_speed),
            curve: speeds.iter().map(|speed| self.point(*speed)).collect(),
        }
    }
}

/// Mean length, as a fraction of the wavelength, of the nodes that touch while neither neighbour does, weighted by the load of all contact.
/// A contact narrower than that may be anywhere within the length of its node, and grids that all place it at the same node do not show
/// this error. The end of a tooth has a known position and does not count.
fn between_nodes(loads: &LineLoads) -> f64 {
    let (mut alone, mut all) = (0.0, 0.0);
    for line in loads.contact.chunks_exact(loads.x.len()) {
        for (i, (contact, length)) in line.iter().zip(&loads.node_length).enumerate() {
            all += contact * length;
            if i > 0 && i + 1 < line.len() && line[i - 1] <= 0.0 && line[i + 1] <= 0.0 {
                alone += contact * length * length;
            }
        }
    }
    if all > 0.0 { alone / (all * loads.length) } else { 0.0 }
}

fn greatest_error(shares: &[Estimate]) -> f64 {
    shares.iter().map(|share| share.error).fold(0.0, f64::max)
}

/// Warnings for a motor whose teeth touch all round the wave, so that it gives less torque than the bound, and for one whose torque is not
/// resolved.
pub fn warnings(motor: &Motor, result: &MotorResult, found: &Performance) -> Vec<String> {
    let (stall, all_touch) = (found.stall_torque, result.teeth_in_contact.value >= motor.teeth as f64);
    let unresolved =
        !result.levitated && stall.error > 0.0 && stall.error >= stall.value.abs() && stall.error.is_finite();
    let unresolved = unresolved.then(|| {
        format!(
            "the stall torque, {stall} N·m, is not resolved at this fidelity: its error is as large as itself, so the speed without load, \
             the greatest power and the efficiency are not resolved either"
        )
    });
    let braking = all_touch.then(|| {
        format!(
            "every tooth of each wave touches the rotor at all times, so parts of the contact always brake: held at rest the motor \
             gives {} N·m, not the maximum operating torque μ_d (1 − α) waves L r = {} N·m, which is a bound",
            stall, found.max_torque,
        )
    });
    unresolved.into_iter().chain(braking).collect()
}

/// The stored lines, tooth by tooth and frame by frame: φ at the tooth's middle, and the offset at which the line begins.
pub fn lines(loads: &LineLoads) -> impl Iterator<Item = (f64, usize)> {
    let (frames, nodes) = (loads.frames, loads.x.len());
    let place = loads.pitch / loads.length;
    (0..loads.stored_teeth * frames)
        .map(move |line| ((line % frames) as f64 / frames as f64 + (line / frames) as f64 * place, line * nodes))
}

/// Number of teeth on the whole ring that each stored tooth stands for.
pub fn ring(motor: &Motor, loads: &LineLoads) -> f64 {
    f64::from(motor.waves) * loads.teeth as f64 / loads.stored_teeth.max(1) as f64
}

/// A number with an error estimated from the same number of the recording's yardsticks. Contact edges converge irregularly, so the error is
/// the whole of the larger difference, not the fraction of it that is calibrated for α.
fn judged(found: f64, yardsticks: &[f64]) -> Estimate {
    let error = match *yardsticks {
        [before, finest] => (found - before).abs().max((found - finest).abs()),
        // The last two of three grids may agree by chance.
        [before, finest, first] => {
            (found - before).abs().max((found - finest).abs()).max(EARLIER * (before - first).abs())
        }
        _ => f64::INFINITY,
    };
    Estimate { value: found, error }
}

/// Mean power that the film of the whole ring takes from the stator \[W\]. Rotor and contact dissipate none of it: the rotor is elastic,
/// and the gap does not change where there is contact.
pub fn film_power(motor: &Motor, recording: &Recording) -> Estimate {
    let others: Vec<f64> = recording.yardsticks.iter().map(|loads| taken(motor, loads)).collect();
    let found = judged(taken(motor, &recording.lines), &others);
    // The terms that are left out may account for all of the film's power, at most its load times the stator's greatest normal speed.
    let load = recording.film_load.iter().sum::<f64>() / recording.frames.max(1) as f64;
    let most = load.abs() * f64::from(motor.waves) * TAU * motor.frequency * motor.normal_amplitude;
    let relative = ROTOR_EFFECT * recording.rotor.relative_error + OF_WIDTH * recording.across.min(1.0);
    let unseen = recording.forced.min(1.0) * most + relative * found.value.abs();
    Estimate { value: found.value, error: OF_POWER * found.error + unseen }
}

/// ⟨−∫ film ∂h/∂t⟩ of the whole ring \[W\], of second order in the time step.
fn taken(motor: &Motor, loads: &LineLoads) -> f64 {
    let (frames, nodes) = (loads.frames, loads.x.len());
    let mut work = 0.0;
    for (line, (_, at)) in lines(loads).enumerate() {
        let next = (line / frames * frames + (line + 1) % frames) * nodes;
        for (i, length) in loads.node_length.iter().enumerate() {
            let closing = loads.film_thickness[at + i] - loads.film_thickness[next + i];
            work += 0.5 * (loads.film[at + i] + loads.film[next + i]) * length * closing;
        }
    }
    work * motor.frequency * ring(motor, loads)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// One tooth as wide as the wave, on uniform nodes; `load(x/λ, t/T)` in N/m.
    fn cycle(nodes: usize, frames: usize, load: impl Fn(f64, f64) -> f64) -> LineLoads {
        let x: Vec<f64> = (0..nodes).map(|i| (i as f64 + 0.5) / nodes as f64 - 0.5).collect();
        let contact =
            (0..frames).flat_map(|m| x.iter().map(move |x| (*x, m as f64 / frames as f64))).map(|(x, t)| load(x, t));
        LineLoads {
            frames,
            length: 1.0,
            teeth: 1,
            stored_teeth: 1,
            pitch: 1.0,
            node_length: vec![1.0 / nodes as f64; nodes],
            film: vec![0.0; nodes * frames],
            contact: contact.collect(),
            x,
            ..LineLoads::default()
        }
    }

    /// A load that depends on φ alone.
    fn travelling(nodes: usize, frames: usize, load: impl Fn(f64) -> f64) -> Drive {
        let centred = |phase: f64| phase - phase.round();
        Drive::new(&cycle(nodes, frames, |x, t| load(centred(x + t))))
    }

    #[test]
    fn a_uniform_pressure_is_exact_at_every_speed() {
        let drive = Drive::new(&cycle(7, 12, |_, _| 3.0));
        assert!((drive.load() - 3.0).abs() < 1e-12);
        for i in -10..=10 {
            let v = f64::from(i) / 10.0;
            let (s0, s1) = drive.at(v);
            assert!((s0 - (2.0 * v.acos() / PI - 1.0)).abs() < 1e-12, "{v}: {s0}");
            assert!((s1 - 2.0 / PI * (1.0 - v * v).sqrt()).abs() < 1e-12, "{v}: {s1}");
        }
        // As much of the load pulls one way as the other.
        assert!(drive.no_load().unwrap().abs() < 1e-12 && drive.at(0.0).0.abs() < 1e-12);
    }

    #[test]
    fn a_point_at_the_crest_runs_with_the_stator() {
        let narrow = 0.02;
        let drive = travelling(400, 400, |phase| (1.0 - phase.abs() / narrow).max(0.0));
        let v = drive.no_load().unwrap();
        // Half of the load is within 1 − 1/√2 of the width.
        let exact = (TAU * narrow * (1.0 - 0.5f64.sqrt())).cos();
        assert!((v - exact).abs() < 2e-5, "{v} {exact}");
        assert!((drive.at(0.0).0 - 1.0).abs() < 1e-12 && drive.at(1.0).0 == -1.0);
        assert!((drive.at(0.9).1 - 1.0).abs() < 2e-3);
    }

    #[test]
    fn a_parabola_converges_with_the_second_order() {
        // c = 1 − (φ/a)²: N = 4a/3, and N s₀ = 2 ∫ over |φ| < half − N.
        let a = 0.15;
        let v: f64 = 0.8;
        let half = v.acos() / TAU;
        let exact = 2.0 * (2.0 * half - 2.0 * half.powi(3) / (3.0 * a * a)) / (4.0 * a / 3.0) - 1.0;
        let error = |n: usize| (travelling(n, n, |phase| (1.0 - (phase / a).powi(2)).max(0.0)).at(v).0 - exact).abs();
        let (coarse, fine) = (error(36), error(144));
        assert!(fine < 1e-3 && fine < 0.15 * coarse, "{coarse} {fine}");
    }

    #[test]
    fn the_torque_is_odd_in_the_velocity() {
        let load = |phase: f64| (0.3 - (phase - 0.02).abs()).max(0.0).powi(2);
        let drive = travelling(60, 60, load);
        let opposite = travelling(60, 60, |phase| load(phase + if phase < 0.0 { 0.5 } else { -0.5 }));
        for i in 0..=20 {
            let v = 0.1 * f64::from(i) - 1.0;
            let ((s0, s1), (o0, o1)) = (drive.at(v), opposite.at(-v));
            assert!((s0 + o0).abs() < 1e-9 && (s1 - o1).abs() < 1e-9, "{v}: {s0} {o0}, {s1} {o1}");
            // Friction only dissipates, whatever the speed of the rotor.
            assert!(s1 - v * s0 >= -1e-12);
        }
    }

    #[test]
    fn all_teeth_stored_are_one_and_its_lag() {
        let load = |phase: f64| (0.2 - phase.abs()).max(0.0);
        let centred = |phase: f64| phase - phase.round();
        let (frames, x, pitch) = (24, [-0.1, 0.0, 0.1], 1.0 / 3.0);
        let store = |teeth: usize| LineLoads {
            frames,
            length: 1.0,
            teeth: 3,
            stored_teeth: teeth,
            pitch,
            x: x.to_vec(),
            node_length: vec![0.1; 3],
            film: vec![0.0; teeth * frames * 3],
            contact: (0..teeth * frames * 3)
                .map(|i| {
                    let (tooth, frame, node) = (i / (frames * 3), i / 3 % frames, i % 3);
                    load(centred(frame as f64 / frames as f64 + tooth as f64 * pitch + x[node]))
                })
                .collect(),
            ..LineLoads::default()
        };
        let (one, all) = (Drive::new(&store(1)), Drive::new(&store(3)));
        for v in [-0.5, 0.0, 0.7, 0.95] {
            let (a, b) = (one.at(v), all.at(v));
            assert!((a.0 - b.0).abs() < 1e-12 && (a.1 - b.1).abs() < 1e-12, "{v}: {a:?} {b:?}");
        }
    }

    #[test]
    fn without_contact_there_is_no_torque() {
        let drive = Drive::new(&cycle(5, 8, |_, _| 0.0));
        assert_eq!((drive.at(0.3), drive.no_load(), drive.load()), ((0.0, 0.0), None, 0.0));
    }
}
