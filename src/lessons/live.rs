//! Numbers that are not of the run itself but read off a tab: of a plate in the hand, of a start-up, of a motor's curves over
//! speed, of a plate beside its exact results. Whoever shows the tab hands them in.

use crate::problem::Scenario;
use crate::scene::Belongs;

/// One number read off a tab.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Live {
    /// Where the plate is held now.
    HeldGap,
    /// Mean absolute pressure under it now.
    HeldPressure,
    /// Cycles of the start-up so far.
    Cycles,
    /// By how much trapped gas may still change until the cycle repeats, a share.
    Remaining,
    /// The film's share of the load in the newest cycle.
    StartAlpha,
    /// Mean load ratio of the newest cycle.
    StartLoadRatio,
    /// Torque on the rotor at rest.
    Stall,
    /// The same without film.
    DryStall,
    /// Speed at which the torque is zero.
    NoLoad,
    /// Greatest mechanical power.
    Output,
    /// The same without film.
    DryOutput,
    /// Part of the load in phase with the approach.
    Spring,
    /// Part of it in phase with the speed of the approach.
    Damping,
}

use Live::{
    Cycles, Damping, DryOutput, DryStall, HeldGap, HeldPressure, NoLoad, Output, Remaining, Spring, Stall, StartAlpha,
    StartLoadRatio,
};

/// How many there are.
const COUNT: usize = 13;

/// In the order of the enum: name, what it is, its unit, scenes that have it, the tab it is read off.
const TABLE: [(Live, &str, &str, &str, Belongs, &str); COUNT] = [
    (HeldGap, "hold.gap_um", "held gap", "µm", Belongs::Plate, "Hold"),
    (HeldPressure, "hold.pressure_kpa", "mean pressure", "kPa", Belongs::Plate, "Hold"),
    (Cycles, "startup.cycles", "cycles since rest", "", Belongs::Any, "Start-up"),
    (Remaining, "startup.remaining", "change to come", "", Belongs::Any, "Start-up"),
    (StartAlpha, "startup.alpha", "film share of the load α", "", Belongs::Motor, "Start-up"),
    (StartLoadRatio, "startup.mean_load_ratio", "mean load ratio", "", Belongs::Plate, "Start-up"),
    (Stall, "torque.stall_nm", "stall torque", "N·m", Belongs::Motor, "Torque"),
    (DryStall, "torque.dry_stall_nm", "stall torque, no film", "N·m", Belongs::Motor, "Torque"),
    (NoLoad, "torque.no_load_rpm", "no-load speed", "rpm", Belongs::Motor, "Torque"),
    (Output, "torque.output_w", "greatest power", "W", Belongs::Motor, "Torque"),
    (DryOutput, "torque.dry_output_w", "greatest power, no film", "W", Belongs::Motor, "Torque"),
    (Spring, "exact.spring", "spring S", "", Belongs::Plate, "Exact"),
    (Damping, "exact.damping", "damping D", "", Belongs::Plate, "Exact"),
];

impl Live {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        TABLE.iter().map(|row| row.0)
    }

    /// The name in a lesson: `hold.gap_um`.
    pub fn name(self) -> &'static str {
        TABLE[self as usize].1
    }

    /// What it is, in words.
    pub fn words(self) -> &'static str {
        TABLE[self as usize].2
    }

    /// Its unit; empty for a pure number.
    pub fn unit(self) -> &'static str {
        TABLE[self as usize].3
    }

    /// The tab it is read off.
    pub fn tab(self) -> &'static str {
        TABLE[self as usize].5
    }

    /// Whether a scene of this kind has it.
    pub fn belongs(self, scenario: &Scenario) -> bool {
        match TABLE[self as usize].4 {
            Belongs::Any | Belongs::IdleOnPlate => true,
            Belongs::Plate => matches!(scenario, Scenario::Plate(_)),
            Belongs::Motor => matches!(scenario, Scenario::Motor(_)),
        }
    }

    /// Whether the student makes it by doing something that leaves the scene as it is.
    pub fn is_done_by_hand(self) -> bool {
        matches!(self.tab(), "Hold" | "Start-up")
    }
}

/// Those that are known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Readings([Option<f64>; COUNT]);

impl Readings {
    /// One of them.
    pub fn get(&self, live: Live) -> Option<f64> {
        self.0[live as usize]
    }

    /// Sets one of them; a value that is not finite is not known.
    pub fn set(&mut self, live: Live, value: f64) {
        self.0[live as usize] = value.is_finite().then_some(value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_in_the_order_of_the_enum() {
        assert!(Live::all().enumerate().all(|(i, live)| live as usize == i));
    }
}
