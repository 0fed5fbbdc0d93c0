//! Numbers that are not of the run itself but read off a tab: of a plate in the hand, of a start-up, of a motor's curves over
//! speed, of a plate beside its exact results. Whoever shows the tab hands them in.

use crate::analysis::quantity::numbers;
use crate::problem::Scenario;
use crate::scene::Belongs;

numbers! {
    /// One number read off a tab, whose name is the last.
    Live,
    /// Those that are known.
    Readings: &str;
    HeldGap "hold.gap_um" "held gap" "µm" Plate "Hold";
    HeldPressure "hold.pressure_kpa" "mean pressure" "kPa" Plate "Hold";
    Cycles "startup.cycles" "cycles since rest" "" Any "Start-up";
    Remaining "startup.remaining" "change to come" "" Any "Start-up";
    StartAlpha "startup.alpha" "film share of the load α" "" Motor "Start-up";
    StartLoadRatio "startup.mean_load_ratio" "mean load ratio" "" Plate "Start-up";
    Stall "torque.stall_nm" "stall torque" "N·m" Motor "Torque";
    DryStall "torque.dry_stall_nm" "stall torque, no film" "N·m" Motor "Torque";
    PresentTorque "torque.present_nm" "torque at the rotor's speed" "N·m" Motor "Torque";
    NoLoad "torque.no_load_rpm" "no-load speed" "rpm" Motor "Torque";
    Output "torque.output_w" "greatest power" "W" Motor "Torque";
    DryOutput "torque.dry_output_w" "greatest power, no film" "W" Motor "Torque";
    Spring "exact.spring" "spring S" "" Plate "Exact";
    Damping "exact.damping" "damping D" "" Plate "Exact";
}

impl Live {
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
