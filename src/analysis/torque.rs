//! What a designer wants of a motor: torque, power and efficiency over the rotor's speed, with the film and without it.
//!
//! Coulomb friction at every point of contact and every instant. The stator's surface moves with
//! V_St = V₀ cos 2πφ, V₀ = 2πf B_S, φ = t/T + x/λ, and a rotor at V_R = v V₀ is dragged along where cos 2πφ > v and held back
//! elsewhere, so that all of it follows from where in the wave the contact load is:
//!
//! ```text
//! torque          T = μ_d · waves · r · N s₀(v),          N s₀ = ∫ c sign(cos 2πφ − v)
//! stator's power      μ_d · waves · V₀ · N s₁(v),         N s₁ = ∫ c sign(cos 2πφ − v) cos 2πφ
//! output          T V_R / r
//! friction heat       the difference, μ_d · waves · ∫ c |V_St − V_R| ≥ 0
//! ```
//!
//! ∫ is over one wavelength and averaged over a cycle, and N = ∫ c = (1 − α) L. No sign is smoothed: c is linear in time between
//! frames, so that the integrals up to the two instants at which a node's sign changes are closed forms; over x the nodes
//! are summed with their lengths, of second order as everywhere.
//!
//! N is the extrapolated contact load of the solve. The shapes s₀ and s₁ are the finest grid's; their error is taken as the
//! difference to the next coarser grid, three times what an error of second order would be.
//!
//! The pressures are those of the scene's rotor speed; what another speed changes is bounded ([`Merit::speed_effect`]).

use crate::control::Cancel;
use crate::estimate::Estimate;
use crate::fidelity::Fidelity;
use crate::motor::{MotorError, without_film};
use crate::plan::{Plan, wedge_bound};
use crate::problem::{Motor, Numerics, Problem, Scenario};
use crate::recording::{LineLoads, Recording};
use crate::solution::{MotorResult, Outcome, Solution};
use std::f64::consts::TAU;

/// Speeds of a curve, equally spaced from rest to the stator's greatest speed; the distinguished ones come in addition.
const SPEEDS: usize = 121;

/// Where in the wave the contact load is: its integrals up to any phase, on one grid.
#[derive(Clone, Debug)]
pub struct Drive {
    /// Time steps in a cycle.
    frames: usize,
    lines: Vec<Line>,
    /// Cycle mean of the contact load on one wavelength \[N\].
    load: f64,
    /// The same of c cos 2πφ \[N\].
    forward: f64,
}

/// One node of one stored tooth over the cycle.
#[derive(Clone, Debug)]
struct Line {
    /// φ at t = 0.
    offset: f64,
    /// c Δx, times how many teeth it stands for \[N\], one value a frame.
    load: Vec<f64>,
    /// ∫ c Δx dt/T up to each frame \[N\], `frames + 1`.
    sum: Vec<f64>,
    /// ∫ c Δx cos 2πφ dt/T up to each frame \[N\], `frames + 1`.
    forward: Vec<f64>,
}

impl Drive {
    /// Of the contact of one cycle.
    pub fn new(cycle: &LineLoads) -> Self {
        let (nodes, frames) = (cycle.x.len(), cycle.frames);
        let copies = cycle.teeth as f64 / cycle.stored_teeth.max(1) as f64;
        let mut lines = Vec::new();
        for tooth in 0..cycle.stored_teeth {
            for (i, (x, length)) in cycle.x.iter().zip(&cycle.node_length).enumerate() {
                let at = |frame: usize| cycle.contact[(tooth * frames + frame) * nodes + i] * length * copies;
                let load: Vec<f64> = (0..frames).map(at).collect();
                if load.iter().any(|load| *load > 0.0) {
                    lines.push(Line::new((tooth as f64 * cycle.pitch + x) / cycle.length, load));
                }
            }
        }
        let all = |part: fn(&Line) -> &Vec<f64>| lines.iter().filter_map(|line| part(line).last()).sum();
        Self { frames, load: all(|line| &line.sum), forward: all(|line| &line.forward), lines }
    }

    /// Cycle mean of the contact load on one wavelength \[N\].
    pub fn load(&self) -> f64 {
        self.load
    }

    /// (s₀, s₁) at the speed ratio `v` = V_R/V₀: force on the rotor and power from the stator, as shares of μ_d N and
    /// μ_d N V₀. Both are 0 without contact.
    pub fn at(&self, v: f64) -> (f64, f64) {
        if self.load <= 0.0 {
            return (0.0, 0.0);
        }
        // The rotor is dragged along while |φ| < half.
        let half = v.clamp(-1.0, 1.0).acos() / TAU;
        let (mut sum, mut forward) = (0.0, 0.0);
        for line in &self.lines {
            let (to, from) =
                (line.until(half - line.offset, self.frames), line.until(-half - line.offset, self.frames));
            sum += to.0 - from.0;
            forward += to.1 - from.1;
        }
        ((2.0 * sum - self.load) / self.load, (2.0 * forward - self.forward) / self.load)
    }

    /// Speed ratio at which the force vanishes, which falls from +1 to −1; `None` without contact.
    pub fn no_load(&self) -> Option<f64> {
        if self.load <= 0.0 {
            return None;
        }
        let (mut low, mut high) = (-1.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.at(middle).0 > 0.0 { low = middle } else { high = middle }
        }
        Some(0.5 * (low + high))
    }

    /// The speed ratio between 0 and 1 at which `value` of (v, s₀, s₁) is greatest, and that value.
    fn greatest(&self, value: impl Fn(f64, f64, f64) -> f64) -> (f64, f64) {
        let at = |v: f64| {
            let (s0, s1) = self.at(v);
            value(v, s0, s1)
        };
        let step = 1.0 / (SPEEDS - 1) as f64;
        let best = (0..SPEEDS).map(|i| i as f64 * step).max_by(|a, b| at(*a).total_cmp(&at(*b))).unwrap_or(0.0);
        // Golden section between its neighbours.
        let ratio = 0.5 * (5f64.sqrt() - 1.0);
        let (mut low, mut high) = ((best - step).max(0.0), (best + step).min(1.0));
        for _ in 0..40 {
            let (a, b) = (high - ratio * (high - low), low + ratio * (high - low));
            if at(a) < at(b) { low = a } else { high = b }
        }
        let found = 0.5 * (low + high);
        if at(found) > at(best) { (found, at(found)) } else { (best, at(best)) }
    }
}

impl Line {
    fn new(offset: f64, load: Vec<f64>) -> Self {
        let frames = load.len();
        let mut line =
            Self { offset, load, sum: Vec::with_capacity(frames + 1), forward: Vec::with_capacity(frames + 1) };
        let (mut sum, mut forward) = (0.0, 0.0);
        line.sum.push(sum);
        line.forward.push(forward);
        for frame in 0..frames {
            let part = line.part(frame, 1.0);
            sum += part.0;
            forward += part.1;
            line.sum.push(sum);
            line.forward.push(forward);
        }
        line
    }

    /// ∫ c and ∫ c cos 2πφ from a frame on, over a share of the step, c linear in between.
    fn part(&self, frame: usize, share: f64) -> (f64, f64) {
        let frames = self.load.len();
        let (a, b) = (self.load[frame], self.load[(frame + 1) % frames]);
        if a == 0.0 && b == 0.0 {
            return (0.0, 0.0);
        }
        let step = 1.0 / frames as f64;
        let (rise, turn) = (b - a, TAU * step);
        let start = TAU * (frame as f64 * step + self.offset);
        let end = start + turn * share;
        let primitive = ((a + rise * share) * end.sin() - a * start.sin()) / turn
            + rise * (end.cos() - start.cos()) / (turn * turn);
        (step * share * (a + 0.5 * rise * share), step * primitive)
    }

    /// ∫ c and ∫ c cos 2πφ from t = 0 to `time` periods, before or after it.
    fn until(&self, time: f64, frames: usize) -> (f64, f64) {
        let cycles = time.floor();
        let place = (time - cycles) * frames as f64;
        let frame = (place as usize).min(frames - 1);
        let part = self.part(frame, place - frame as f64);
        (
            cycles * self.sum[frames] + self.sum[frame] + part.0,
            cycles * self.forward[frames] + self.forward[frame] + part.1,
        )
    }
}

/// The motor at one speed of its rotor; the whole ring.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// Surface speed of the rotor \[m/s\].
    pub speed: f64,
    /// Torque on the rotor \[N m\].
    pub torque: Estimate,
    /// Power given to the rotor \[W\].
    pub output: f64,
    /// Heat of friction \[W\].
    pub friction: f64,
    /// Output over what the stator gives to friction, rotor and film; `None` where the rotor is not driven.
    pub efficiency: Option<f64>,
}

/// Torque, power and efficiency with the film, or without it; the whole ring.
#[derive(Clone, Debug, PartialEq)]
pub struct Performance {
    /// μ_d N waves r \[N m\]: the torque at which all of the contact pulls one way.
    pub max_torque: Estimate,
    /// Torque at rest \[N m\].
    pub stall_torque: Estimate,
    /// Speed at which the torque vanishes \[m/s\]; `None` without contact.
    pub no_load_speed: Option<Estimate>,
    /// Greatest output \[W\].
    pub max_power: Estimate,
    /// Speed of the greatest output \[m/s\]; `None` without contact.
    pub max_power_speed: Option<Estimate>,
    /// Greatest efficiency; `None` without contact.
    pub max_efficiency: Option<Estimate>,
    /// Its speed \[m/s\].
    pub max_efficiency_speed: Option<Estimate>,
    /// At the rotor speed of the scene.
    pub present: Point,
    /// From rest to the stator's greatest speed, ascending.
    pub curve: Vec<Point>,
}

/// What a designer wants of a motor; the whole ring.
#[derive(Clone, Debug, PartialEq)]
pub struct Merit {
    /// With the film.
    pub with_film: Performance,
    /// The same motor in a vacuum: contact solved without gas.
    pub without_film: Performance,
    /// Contact radius \[m\]: what turns surface speeds into rotations.
    pub radius: f64,
    /// Greatest tangential speed of the stator's surface V₀ = 2πf B_S \[m/s\].
    pub surface_speed: f64,
    /// The friction coefficient that a model without film needs for the same greatest torque, μ_d(1 − α).
    pub dry_equivalent: Estimate,
    /// Mean power that the stator spends on squeezing the film \[W\].
    pub film_power: Estimate,
    /// Greatest torque of the film's own drag from rest to the stator's greatest speed \[N m\], signed. Without slip:
    /// a bound of its size.
    pub viscous_drag: f64,
    /// Bound of what the film's answer to another rotor speed changes, relative to the torque.
    pub speed_effect: f64,
}

/// A finest and the next coarser grid, and what turns shares into newtons and watts.
struct Scaled<'a> {
    motor: &'a Motor,
    fine: &'a Drive,
    coarse: Option<&'a Drive>,
    /// N \[N\].
    load: Estimate,
    /// The film's share of the stator's power, in μ_d waves N V₀.
    loss: f64,
}

impl Scaled<'_> {
    fn v0(&self) -> f64 {
        surface_speed(self.motor)
    }

    /// μ_d waves N r \[N m\].
    fn torque(&self) -> Estimate {
        let scale = self.motor.dry_friction * f64::from(self.motor.waves) * self.motor.contact_radius;
        Estimate { value: scale * self.load.value, error: scale * self.load.error }
    }

    /// A share of μ_d waves N r (or N V₀) times `unit`, from that of the finest grid and of the next coarser one.
    fn scaled(&self, unit: Estimate, share: impl Fn(&Drive) -> f64) -> Estimate {
        let fine = share(self.fine);
        let spread = self.coarse.map_or(f64::INFINITY, |coarse| (fine - share(coarse)).abs());
        let shape = if unit.value == 0.0 { 0.0 } else { unit.value.abs() * spread };
        Estimate { value: unit.value * fine, error: shape + fine.abs() * unit.error }
    }

    fn efficiency(&self, v: f64, (s0, s1): (f64, f64)) -> Option<f64> {
        (v * s0 > 0.0 && self.load.value > 0.0).then(|| v * s0 / (s1 + self.loss))
    }

    fn point(&self, speed: f64) -> Point {
        let v0 = self.v0();
        if v0 == 0.0 && speed == 0.0 {
            // Nothing slides.
            return Point::default();
        }
        // A stator that does not move along the ring holds the rotor, whichever way it turns.
        let v = if v0 > 0.0 { speed / v0 } else { speed.signum() * 2.0 };
        let torque = self.scaled(self.torque(), |drive| drive.at(v).0);
        let (s0, s1) = self.fine.at(v);
        let force = self.torque().value / self.motor.contact_radius;
        let output = force * s0 * speed;
        Point { speed, torque, output, friction: force * s1 * v0 - output, efficiency: self.efficiency(v, (s0, s1)) }
    }

    fn performance(&self, speeds: &[f64]) -> Performance {
        let exactly = |value: f64| Estimate { value, error: 0.0 };
        let v0 = exactly(self.v0());
        let unit = self.torque();
        let per_radius = self.v0() / self.motor.contact_radius;
        let power = Estimate { value: unit.value * per_radius, error: unit.error * per_radius };
        let output = |drive: &Drive| drive.greatest(|v, s0, _| v * s0);
        let efficient =
            |drive: &Drive| drive.greatest(|v, s0, s1| if v * s0 > 0.0 { v * s0 / (s1 + self.loss) } else { 0.0 });
        let driven = self.load.value > 0.0 && self.fine.load > 0.0 && v0.value > 0.0;
        // The film's loss is a share of N, whose error moves the efficiency by at most its own relative size.
        let relative =
            Estimate { value: 1.0, error: if self.loss > 0.0 { self.load.error / self.load.value } else { 0.0 } };
        Performance {
            max_torque: unit,
            stall_torque: if driven { self.scaled(unit, |drive| drive.at(0.0).0) } else { Estimate::default() },
            no_load_speed: driven.then(|| self.scaled(v0, |drive| drive.no_load().unwrap_or(0.0))),
            max_power: self.scaled(power, |drive| output(drive).1),
            max_power_speed: driven.then(|| self.scaled(v0, |drive| output(drive).0)),
            max_efficiency: driven.then(|| self.scaled(relative, |drive| efficient(drive).1)),
            max_efficiency_speed: driven.then(|| self.scaled(v0, |drive| efficient(drive).0)),
            present: self.point(self.motor.rotor_speed),
            curve: speeds.iter().map(|speed| self.point(*speed)).collect(),
        }
    }
}

/// V₀ = 2πf B_S \[m/s\].
pub fn surface_speed(motor: &Motor) -> f64 {
    TAU * motor.frequency * motor.tangential_amplitude
}

impl Merit {
    /// From a solve of `motor`, and the contact without film, which is solved here on the grids that `fidelity` and
    /// `numerics` ask for. `None` if cancelled.
    ///
    /// # Errors
    /// [`MotorError`] if a contact problem without film has no solution to working precision.
    pub fn of(
        motor: &Motor,
        numerics: &Numerics,
        fidelity: Fidelity,
        result: &MotorResult,
        recording: &Recording,
        cancel: &Cancel,
    ) -> Result<Option<Self>, MotorError> {
        let plan = Plan::motor(motor, fidelity, numerics);
        let Some(dry) = without_film(motor, &plan, cancel)? else { return Ok(None) };
        Ok(Some(Self::from_contacts(motor, result, recording, &dry)))
    }

    /// Of a solve at `fidelity`; `None` of a plate, and if cancelled.
    ///
    /// # Errors
    /// As [`Self::of`].
    pub fn of_solve(
        problem: &Problem,
        fidelity: Fidelity,
        solution: &Solution,
        cancel: &Cancel,
    ) -> Result<Option<Self>, MotorError> {
        match (&problem.scenario, &solution.outcome) {
            (Scenario::Motor(motor), Outcome::Motor(result)) => {
                Self::of(motor, &problem.numerics, fidelity, result, &solution.recording, cancel)
            }
            _ => Ok(None),
        }
    }

    /// From the contact with the film, in `recording`, and without it, coarse to fine.
    pub fn from_contacts(motor: &Motor, result: &MotorResult, recording: &Recording, dry: &[LineLoads]) -> Self {
        let wet_fine = Drive::new(&recording.line_loads());
        let wet_coarse = recording.yardsticks.first().map(Drive::new);
        let dry: Vec<Drive> = dry.iter().rev().take(2).map(Drive::new).collect();
        let nothing = Drive { frames: 1, lines: Vec::new(), load: 0.0, forward: 0.0 };
        let share = (1.0 - result.alpha).max(0.0);
        let film_power = film_power(motor, recording);
        let v0 = surface_speed(motor);
        let contact = share * motor.load;
        let spent = motor.dry_friction * f64::from(motor.waves) * contact * v0;
        let with_film = Scaled {
            motor,
            fine: &wet_fine,
            coarse: wet_coarse.as_ref(),
            load: Estimate { value: contact, error: result.alpha_error * motor.load },
            loss: if spent > 0.0 { film_power.value.max(0.0) / spent } else { 0.0 },
        };
        let without_film = Scaled {
            motor,
            fine: dry.first().unwrap_or(&nothing),
            coarse: dry.get(1),
            load: Estimate { value: motor.load, error: 0.0 },
            loss: 0.0,
        };
        let mut speeds: Vec<f64> = if v0 > 0.0 {
            let marked = [
                wet_fine.no_load().map(|v| v * v0),
                without_film.fine.no_load().map(|v| v * v0),
                Some(motor.rotor_speed),
            ];
            let even = (0..SPEEDS).map(|i| v0 * i as f64 / (SPEEDS - 1) as f64);
            even.chain(marked.into_iter().flatten().filter(|speed| (0.0..=v0).contains(speed))).collect()
        } else {
            Vec::new()
        };
        speeds.sort_by(f64::total_cmp);
        speeds.dedup();
        let away = (v0 - motor.rotor_speed).abs().max(motor.rotor_speed.abs());
        Self {
            with_film: with_film.performance(&speeds),
            without_film: without_film.performance(&speeds),
            radius: motor.contact_radius,
            surface_speed: v0,
            dry_equivalent: Estimate {
                value: motor.dry_friction * share,
                error: motor.dry_friction * result.alpha_error,
            },
            film_power,
            viscous_drag: viscous_drag(motor, recording),
            speed_effect: if share > 0.0 { wedge_bound(motor, away) * result.alpha.abs() / share } else { 0.0 },
        }
    }

    /// A surface speed \[m/s\] as rotations in a minute.
    pub fn rpm(&self, speed: f64) -> f64 {
        60.0 * speed / (TAU * self.radius)
    }
}

/// The stored lines, tooth by tooth and frame by frame: φ of the tooth's middle, and where the line begins.
fn lines(loads: &LineLoads) -> impl Iterator<Item = (f64, usize)> {
    let (frames, nodes) = (loads.frames, loads.x.len());
    let place = loads.pitch / loads.length;
    (0..loads.stored_teeth * frames)
        .map(move |line| ((line % frames) as f64 / frames as f64 + (line / frames) as f64 * place, line * nodes))
}

/// Mean power that the stator of the whole ring spends on the film \[W\]: ⟨∫ q ∂W_S/∂t⟩, q being film and contact. Rotor and
/// contact take none of it: the rotor is elastic, and where there is contact the gap does not change. The gas takes
/// ⟨−∫ film ∂h/∂t⟩. The stated error is the difference of the two and that to the next coarser grid.
pub fn film_power(motor: &Motor, recording: &Recording) -> Estimate {
    let loads = recording.line_loads();
    let given = given(motor, &loads);
    let coarse = recording.yardsticks.first().map_or(f64::INFINITY, |coarse| self::given(motor, coarse));
    let (frames, nodes) = (loads.frames, loads.x.len());
    let mut taken = 0.0;
    for (line, (_, at)) in lines(&loads).enumerate() {
        let next = (line / frames * frames + (line + 1) % frames) * nodes;
        for (i, length) in loads.node_length.iter().enumerate() {
            let closing = recording.film_thickness[at + i] - recording.film_thickness[next + i];
            taken += 0.5 * (loads.film[at + i] + loads.film[next + i]) * length * closing;
        }
    }
    let taken = taken * motor.frequency * ring(motor, &loads);
    Estimate { value: given, error: (given - taken).abs() + (given - coarse).abs() }
}

/// How often the stored teeth are on the ring.
fn ring(motor: &Motor, loads: &LineLoads) -> f64 {
    f64::from(motor.waves) * loads.teeth as f64 / loads.stored_teeth.max(1) as f64
}

/// ⟨∫ q ∂W_S/∂t⟩ of the whole ring \[W\].
fn given(motor: &Motor, loads: &LineLoads) -> f64 {
    let mut sum = 0.0;
    for (phase, line) in lines(loads) {
        for (i, (x, length)) in loads.x.iter().zip(&loads.node_length).enumerate() {
            let rise = -(TAU * (phase + x / loads.length)).sin();
            sum += (loads.film[line + i] + loads.contact[line + i]) * length * rise;
        }
    }
    let fastest = TAU * motor.frequency * motor.normal_amplitude;
    sum * fastest / loads.frames.max(1) as f64 * ring(motor, loads)
}

/// Torque of the shear in the film, μU/h on the teeth, of the whole ring \[N m\]: the greatest from rest to the stator's
/// greatest speed. Slip lowers it; it is left out here.
fn viscous_drag(motor: &Motor, recording: &Recording) -> f64 {
    let loads = recording.line_loads();
    let v0 = surface_speed(motor);
    let (mut still, mut slope) = (0.0, 0.0);
    for (phase, line) in lines(&loads) {
        for (i, (x, length)) in loads.x.iter().zip(&loads.node_length).enumerate() {
            let per_speed = motor.gas.viscosity * motor.contact_width * length / recording.film_thickness[line + i];
            still += per_speed * v0 * (TAU * (phase + x / loads.length)).cos();
            slope += per_speed;
        }
    }
    let scale = ring(motor, &loads) * motor.contact_radius / loads.frames.max(1) as f64;
    let [at_rest, at_speed] = [scale * still, scale * (still - slope * v0)];
    if at_rest.abs() > at_speed.abs() { at_rest } else { at_speed }
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
        // As much of it pulls one way as the other.
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
            // Friction heats, whatever the rotor does.
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
