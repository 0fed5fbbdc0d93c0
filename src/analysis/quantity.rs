//! The numbers of one solve under their names in JSON and CSV, so that any of them can be put on an axis.

use crate::digits::significant;
use crate::dimensionless::Dimensionless;
use crate::estimate::Estimate;
use crate::problem::{Plate, Problem, Scenario, rpm};
use crate::scene::Belongs;
use crate::solution::{Harmonic, Outcome, PlateResult, Solution, Status, settled};

/// Defines an enum of numbers, and a struct of those that are known. Each number has its variant, name, description, unit, the scenes that
/// have it, and possibly more.
macro_rules! numbers {
    ($(#[$about:meta])* $Enum:ident, $(#[$all:meta])* $Known:ident: $More:ty;
     $($variant:ident $name:literal $words:literal $unit:literal $belongs:ident $($more:expr)?;)*) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Hash, serde::Serialize, serde::Deserialize)]
        pub enum $Enum {
            $(#[doc = $words] $variant,)*
        }

        const TABLE: &[($Enum, &str, &str, &str, Belongs, $More)] =
            &[$(($Enum::$variant, $name, $words, $unit, Belongs::$belongs, ($($more)?)),)*];

        impl $Enum {
            /// All, in order.
            pub fn all() -> impl Iterator<Item = Self> {
                TABLE.iter().map(|row| row.0)
            }

            /// The name in files, with its unit.
            pub fn name(self) -> &'static str {
                TABLE[self as usize].1
            }

            /// Its description in words, without the unit.
            pub fn words(self) -> &'static str {
                TABLE[self as usize].2
            }
        }

        $(#[$all])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $Known([Option<f64>; TABLE.len()]);

        /// Serialised as all numbers in order.
        impl serde::Serialize for $Known {
            fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                self.0[..].serialize(to)
            }
        }

        impl<'de> serde::Deserialize<'de> for $Known {
            fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                let all = <Vec<Option<f64>>>::deserialize(from)?;
                let count = all.len();
                all.try_into().map(Self).map_err(|_| serde::de::Error::invalid_length(count, &stringify!($Known)))
            }
        }

        impl Default for $Known {
            fn default() -> Self {
                Self([None; TABLE.len()])
            }
        }

        impl $Known {
            /// One of them.
            pub fn get(&self, number: $Enum) -> Option<f64> {
                self.0[number as usize]
            }

            /// Sets one of them; a non-finite value removes it.
            pub fn set(&mut self, number: $Enum, value: f64) {
                self.0[number as usize] = value.is_finite().then_some(value);
            }
        }
    };
}
pub(crate) use numbers;

numbers! {
    /// One number of a solve. Units are in the names; those of a strip's forces are per metre of width. Errors are estimated numerical
    /// errors, absolute.
    Quantity,
    /// All numbers of one solve. Numbers that the scene does not have, or that are not finite, are absent.
    Numbers: ();
    Alpha "alpha" "film share of the load α" "" Motor;
    AlphaError "alpha_error" "error of α" "" Motor;
    FilmLoad "film_load_n" "film load" "N" Any;
    FilmLoadError "film_load_error_n" "error of the film load" "N" Any;
    FilmLoadMin "film_load_min_n" "least film load" "N" Any;
    FilmLoadMinError "film_load_min_error_n" "error of the least film load" "N" Any;
    FilmLoadMax "film_load_max_n" "greatest film load" "N" Any;
    FilmLoadMaxError "film_load_max_error_n" "error of the greatest film load" "N" Any;
    ContactLoad "contact_load_n" "contact load" "N" Motor;
    StallTorque "stall_torque_nm" "stall torque" "N·m" Motor;
    StallTorqueError "stall_torque_error_nm" "error of the stall torque" "N·m" Motor;
    NoLoadSpeed "no_load_speed_rpm" "no-load speed" "rpm" Motor;
    NoLoadSpeedError "no_load_speed_error_rpm" "error of the no-load speed" "rpm" Motor;
    MaxPower "max_power_w" "greatest power" "W" Motor;
    MaxPowerError "max_power_error_w" "error of the greatest power" "W" Motor;
    MaxEfficiency "max_efficiency" "greatest efficiency" "" Motor;
    MaxEfficiencyError "max_efficiency_error" "error of the greatest efficiency" "" Motor;
    MaxTorque "max_torque_nm" "maximum operating torque (bound)" "N·m" Motor;
    MaxTorqueError "max_torque_error_nm" "error of the bound of the torque" "N·m" Motor;
    TeethInContact "teeth_in_contact" "teeth in contact" "" Motor;
    TeethInContactError "teeth_in_contact_error" "error of the teeth in contact" "" Motor;
    MeanGap "mean_gap_um" "floating mean gap" "µm" Plate;
    MeanGapError "mean_gap_error_um" "error of the mean gap" "µm" Plate;
    NaturalFrequency "natural_frequency_hz" "natural frequency" "Hz" Plate;
    NaturalFrequencyError "natural_frequency_error_hz" "error of the natural frequency" "Hz" Plate;
    FloatingStiffness "floating_stiffness_n_per_m" "stiffness at this height" "N/m" Plate;
    FloatingStiffnessError "floating_stiffness_error_n_per_m" "error of the stiffness at this height" "N/m" Plate;
    SlowDamping "slow_damping_n_s_per_m" "damping of slow motion" "N·s/m" Plate;
    SlowDampingError "slow_damping_error_n_s_per_m" "error of the damping of slow motion" "N·s/m" Plate;
    CreepTime "creep_time_ms" "time constant of creeping back" "ms" Plate;
    CreepTimeError "creep_time_error_ms" "error of the time constant of creeping back" "ms" Plate;
    SwingFrequency "swing_frequency_hz" "frequency at which it swings" "Hz" Plate;
    SwingFrequencyError "swing_frequency_error_hz" "error of the frequency at which it swings" "Hz" Plate;
    SwingDecay "swing_decay_ms" "time constant of the swing" "ms" Plate;
    SwingDecayError "swing_decay_error_ms" "error of the time constant of the swing" "ms" Plate;
    LoadRatio "mean_load_ratio" "mean load ratio" "" Plate;
    LoadRatioError "mean_load_ratio_error" "error of the load ratio" "" Plate;
    LoadRatioMin "load_ratio_min" "least load ratio" "" Plate;
    LoadRatioMinError "load_ratio_min_error" "error of the least load ratio" "" Plate;
    LoadRatioMax "load_ratio_max" "greatest load ratio" "" Plate;
    LoadRatioMaxError "load_ratio_max_error" "error of the greatest load ratio" "" Plate;
    Stiffness "stiffness_n_per_m" "dynamic stiffness" "N/m" Plate;
    StiffnessError "stiffness_error_n_per_m" "error of the dynamic stiffness" "N/m" Plate;
    Damping "damping_n_s_per_m" "dynamic damping" "N·s/m" Plate;
    DampingError "damping_error_n_s_per_m" "error of the dynamic damping" "N·s/m" Plate;
    MinGap "min_gap_nm" "least film thickness" "nm" Any;
    MinGapError "min_gap_error_nm" "error of the least film thickness" "nm" Any;
    MaxPressure "max_pressure_kpa" "highest pressure" "kPa" Any;
    MaxPressureError "max_pressure_error_kpa" "error of the highest pressure" "kPa" Any;
    SqueezeNumber "squeeze_number" "squeeze number σ" "" Any;
    BearingNumber "bearing_number" "bearing number Λ" "" Any;
    KnudsenNumber "knudsen_number" "Knudsen number Kn" "" Any;
    Residual "residual" "remaining change" "" Any;
    Tolerance "tolerance" "allowed remaining change" "" Any;
    FilmSteps "film_steps" "film steps" "" Any;
    Cycles "cycles" "cycles marched" "" Any;
    Rounds "coupling_iterations" "rounds of film and contact" "" Motor;
    ContactSolves "contact_solves" "contact problems solved" "" Motor;
}
use Quantity::*;

impl Quantity {
    /// The headline numbers; the headline of a result is the first of these that it has.
    pub const HEADLINES: [Self; 3] = [Alpha, MeanGap, LoadRatio];

    /// The quantities that a scene of this problem has.
    pub fn of(problem: &Problem) -> impl Iterator<Item = Self> {
        let belongs = match problem.scenario {
            Scenario::Motor(_) => Belongs::Motor,
            Scenario::Plate(_) => Belongs::Plate,
        };
        let floats = matches!(problem.scenario, Scenario::Plate(Plate { load: Some(_), .. }));
        let all = TABLE.iter().filter(move |row| row.4 == Belongs::Any || row.4 == belongs).map(|row| row.0);
        all.filter(move |quantity| floats || !(MeanGap as usize..LoadRatio as usize).contains(&(*quantity as usize)))
    }

    /// Its unit in the results of `problem`; empty for a pure number. Forces of a strip are per metre of width.
    pub fn unit(self, problem: &Problem) -> &'static str {
        match TABLE[self as usize].3 {
            "N" => force_unit(problem),
            "N/m" if force_unit(problem) == "N/m" => "N/m²",
            "N·s/m" if force_unit(problem) == "N/m" => "N·s/m²",
            unit => unit,
        }
    }

    /// Its unit in the results of scenes whose forces are not per metre of width.
    pub fn usual_unit(self) -> &'static str {
        TABLE[self as usize].3
    }

    /// The description with the unit after a comma, for the head of a table.
    pub fn label(self, problem: &Problem) -> String {
        labelled(self.words(), self.unit(problem))
    }

    /// The name of the column in a CSV file: [`Self::name`], except for the forces of a strip, `film_load_n_per_m`.
    pub fn column(self, problem: &Problem) -> String {
        match (self.name().strip_suffix("_n"), self.unit(problem)) {
            (Some(_), "N/m") => format!("{}_per_m", self.name()),
            _ => self.name().to_owned(),
        }
    }

    /// Text for people: the value with its error, if there is one; a count as a whole number; empty if unknown.
    pub fn text(self, found: Option<Estimate>) -> String {
        match found {
            None => String::new(),
            Some(Estimate { value, .. }) if self.is_count() => value.to_string(),
            Some(Estimate { value, .. }) if self.error().is_none() => significant(value, 4),
            Some(found) => found.to_string(),
        }
    }

    /// Whether it is a share of a whole.
    pub fn is_share(self) -> bool {
        matches!(self, Alpha | MaxEfficiency)
    }

    /// Whether it counts something: whole numbers.
    pub fn is_count(self) -> bool {
        matches!(self, FilmSteps | Cycles | Rounds | ContactSolves)
    }

    /// Whether it is the estimated numerical error of another quantity, which comes before it in the table.
    pub fn is_error(self) -> bool {
        self.name().contains("_error")
    }

    /// The quantity that is this one's estimated numerical error, if it has one.
    pub fn error(self) -> Option<Self> {
        match self {
            // Film and contact share the load: if one is too large, the other is too small by as much.
            ContactLoad => Some(FilmLoadError),
            _ if self.is_error() => None,
            _ => TABLE.get(self as usize + 1).map(|next| next.0).filter(|next| next.is_error()),
        }
    }
}

/// Unit of the forces of a problem: those of a strip are per metre of width.
pub fn force_unit(problem: &Problem) -> &'static str {
    match &problem.scenario {
        Scenario::Plate(plate) if plate.is_strip() => "N/m",
        Scenario::Plate(_) | Scenario::Motor(_) => "N",
    }
}

/// `film load, N`: words, and a unit if there is one.
pub fn labelled(words: &str, unit: &str) -> String {
    if unit.is_empty() { words.to_owned() } else { format!("{words}, {unit}") }
}

impl Numbers {
    /// One of them with its estimated numerical error, which is NaN if it is not known.
    pub fn estimate(&self, number: Quantity) -> Option<Estimate> {
        let error = number.error().and_then(|error| self.get(error)).unwrap_or(f64::NAN);
        self.get(number).map(|value| Estimate { value, error })
    }

    /// One of them for people, as [`Quantity::text`].
    pub fn text(&self, number: Quantity) -> String {
        number.text(self.estimate(number))
    }

    /// The numbers of a solution of `problem`.
    pub fn of(problem: &Problem, solution: &Solution) -> Self {
        let problem = &*settled(problem, &solution.outcome);
        let mut numbers = Self::of_outcome(problem, &solution.outcome);
        let groups = Dimensionless::of(problem);
        numbers.set(SqueezeNumber, groups.squeeze_number);
        numbers.set(BearingNumber, groups.bearing_number);
        numbers.set(KnudsenNumber, groups.knudsen_number);
        if let Status::NotConverged { residual, tolerance } = solution.status {
            numbers.set(Residual, residual);
            numbers.set(Tolerance, tolerance);
        }
        let stats = &solution.stats;
        let counts = [stats.film_steps, stats.cycles, stats.coupling_iterations, stats.contact_solves];
        for (quantity, count) in [FilmSteps, Cycles, Rounds, ContactSolves].into_iter().zip(counts) {
            numbers.set(quantity, count as f64);
        }
        if let (Scenario::Plate(plate), Some(found)) = (&problem.scenario, solution.harmonic) {
            let found = found.times(Harmonic::unit(plate));
            numbers.set_all([(Stiffness, found.spring), (Damping, found.damping)]);
        }
        if let (Scenario::Motor(motor), Some(found)) = (&problem.scenario, &solution.performance) {
            let rpm = rpm(1.0, motor.contact_radius);
            numbers.set_all([
                (StallTorque, Some(found.stall_torque)),
                (NoLoadSpeed, found.no_load_speed.map(|speed| speed * rpm)),
                (MaxPower, Some(found.max_power)),
                (MaxEfficiency, found.max_efficiency),
            ]);
        }
        numbers
    }

    /// The means and extremes over a cycle in a result of `problem`.
    pub fn of_outcome(problem: &Problem, outcome: &Outcome) -> Self {
        let mut numbers = Self::default();
        match (&problem.scenario, outcome) {
            (_, Outcome::Motor(result)) => numbers.set_all([
                (Alpha, result.alpha),
                (FilmLoad, result.film_load),
                (FilmLoadMin, result.film_load_min),
                (FilmLoadMax, result.film_load_max),
                (ContactLoad, result.contact_load),
                (MaxTorque, result.max_torque),
                (TeethInContact, result.teeth_in_contact),
                (MinGap, result.min_film_thickness * 1e9),
                (MaxPressure, result.max_pressure * 1e-3),
            ]),
            (Scenario::Plate(plate), Outcome::Plate(result)) => numbers.plate(result, plate),
            // A solver returns the kind of result that belongs to the scene.
            (Scenario::Motor(_), Outcome::Plate(_)) => {}
        }
        numbers
    }

    /// The main number of a result: α of a motor, the mean load ratio of a plate; NaN if neither is known.
    pub fn main(&self) -> Estimate {
        self.known(if self.get(Alpha).is_some() { Alpha } else { LoadRatio })
    }

    /// One of them with its error; NaN if it is not known.
    pub fn known(&self, number: Quantity) -> Estimate {
        self.estimate(number).unwrap_or(Estimate { value: f64::NAN, error: f64::NAN })
    }

    /// Sets those that are known, with their errors.
    fn set_all<T: Into<Option<Estimate>>>(&mut self, numbers: impl IntoIterator<Item = (Quantity, T)>) {
        for (number, found) in numbers {
            let Some(Estimate { value, error }) = found.into() else { continue };
            self.set(number, value);
            if let Some(number) = number.error() {
                self.set(number, error);
            }
        }
    }

    fn plate(&mut self, result: &PlateResult, plate: &Plate) {
        let ratio = PlateResult::ratio(1.0, plate);
        self.set_all([
            (FilmLoad, result.film_load),
            (FilmLoadMin, result.film_load_min),
            (FilmLoadMax, result.film_load_max),
            (LoadRatio, result.film_load * ratio),
            (LoadRatioMin, result.film_load_min * ratio),
            (LoadRatioMax, result.film_load_max * ratio),
            (MinGap, result.min_film_thickness * 1e9),
            (MaxPressure, result.max_pressure * 1e-3),
        ]);
        if let Some(floating) = result.floating {
            let slow = floating.slow;
            self.set_all([
                (MeanGap, Some(floating.mean_gap * 1e6)),
                (NaturalFrequency, floating.is_stable().then_some(floating.natural_frequency)),
                (FloatingStiffness, Some(floating.stiffness)),
                (SlowDamping, slow.map(|slow| slow.damping)),
                (CreepTime, slow.and_then(|slow| slow.creep_time).map(|time| time * 1e3)),
                (SwingFrequency, slow.and_then(|slow| slow.swing_frequency)),
                (SwingDecay, slow.and_then(|slow| slow.swing_decay).map(|time| time * 1e3)),
            ]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_in_the_order_of_the_enum() {
        for (i, quantity) in Quantity::all().enumerate() {
            assert_eq!(quantity as usize, i);
            // Every error belongs to the number before it; only the contact load shares an error.
            let of: Vec<Quantity> = Quantity::all().filter(|of| of.error() == Some(quantity)).collect();
            match quantity {
                FilmLoadError => assert_eq!(of, [FilmLoad, ContactLoad]),
                _ if quantity.is_error() => assert_eq!(of, [TABLE[i - 1].0]),
                _ => assert!(of.is_empty()),
            }
            assert_eq!(quantity.is_error(), quantity.words().starts_with("error of"));
        }
    }

    #[test]
    fn what_is_not_finite_is_not_there() {
        let mut numbers = Numbers::default();
        numbers.set(Alpha, 0.25);
        numbers.set(AlphaError, f64::INFINITY);
        assert_eq!((numbers.get(Alpha), numbers.get(AlphaError)), (Some(0.25), None));
    }
}
