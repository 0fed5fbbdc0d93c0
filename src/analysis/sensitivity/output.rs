//! The results whose sensitivity is computed.

use crate::analysis::exact::{Harmonic, solved, units};
use crate::analysis::quantity::{Numbers, Quantity, labelled};
use crate::estimate::Estimate;
use crate::problem::{Problem, Scenario};
use crate::solution::{Solution, settled};

/// A result whose sensitivity is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Output {
    /// One of the numbers of every solve.
    Number(Quantity),
    /// Stiffness of a plate's film.
    Stiffness,
    /// Damping of a plate's film.
    Damping,
}

impl Output {
    /// The outputs of a problem, the headline first.
    pub fn of(problem: &Problem) -> &'static [Self] {
        use Quantity::{Alpha, FilmLoad, MeanGap, NoLoadSpeed, StallTorque};
        match &problem.scenario {
            Scenario::Motor(_) => &[Self::Number(Alpha), Self::Number(StallTorque), Self::Number(NoLoadSpeed)],
            Scenario::Plate(plate) if plate.load.is_some() => &[Self::Number(MeanGap), Self::Stiffness, Self::Damping],
            Scenario::Plate(_) => &[Self::Number(FilmLoad), Self::Stiffness, Self::Damping],
        }
    }

    /// Its name in files, with its unit.
    pub fn name(self) -> &'static str {
        match self {
            Self::Number(quantity) => quantity.name(),
            Self::Stiffness => "stiffness_n_per_m",
            Self::Damping => "damping_n_s_per_m",
        }
    }

    /// The name of its numerical error.
    pub fn error_name(self) -> &'static str {
        match self {
            Self::Number(quantity) => quantity.error().map_or("", Quantity::name),
            Self::Stiffness => "stiffness_error_n_per_m",
            Self::Damping => "damping_error_n_s_per_m",
        }
    }

    /// Its description in words, without the unit.
    pub fn words(self) -> &'static str {
        match self {
            Self::Number(quantity) => quantity.words(),
            Self::Stiffness => "dynamic stiffness",
            Self::Damping => "dynamic damping",
        }
    }

    /// Its unit in the results of `problem`; empty for a pure number.
    pub fn unit(self, problem: &Problem) -> &'static str {
        match (self, &problem.scenario) {
            (Self::Number(quantity), _) => quantity.unit(problem),
            (Self::Stiffness, Scenario::Plate(plate)) => units(plate)[0],
            (Self::Damping, Scenario::Plate(plate)) => units(plate)[1],
            _ => "",
        }
    }

    /// Its description with its unit after a comma.
    pub fn label(self, problem: &Problem) -> String {
        labelled(self.words(), self.unit(problem))
    }

    /// Its value in a solution that has its line fields, with its stated numerical error; not finite if there is none.
    fn read(self, problem: &Problem, solution: &Solution, numbers: &Numbers) -> Estimate {
        let harmonic = || {
            let (plate, result) = problem.scenario.plate().zip(solution.outcome.plate())?;
            Some(solved(plate, result, &solution.recording)?.times(Harmonic::unit(plate)))
        };
        let found = match self {
            Self::Number(quantity) => numbers.estimate(quantity),
            Self::Stiffness => harmonic().map(|found| found.spring),
            Self::Damping => harmonic().map(|found| found.damping),
        };
        found.unwrap_or(Estimate { value: f64::NAN, error: f64::NAN })
    }
}

/// All outputs of a solution of `problem`.
pub(super) fn read(problem: &Problem, solution: &Solution) -> Vec<Estimate> {
    let problem = &*settled(problem, &solution.outcome);
    let numbers = Numbers::of(problem, solution);
    Output::of(problem).iter().map(|output| output.read(problem, solution, &numbers)).collect()
}
