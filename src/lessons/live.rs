//! Numbers of tabs, which a run itself does not have: those of a plate held by hand, of a start-up, of a motor's curves over speed, and of a
//! plate compared with exact results. The window, or [`super::trial`], fills them in.

use crate::analysis::quantity::{Quantity, numbers};
use crate::analysis::torque::TorqueCurves;
use crate::export::startup::CycleRow;
use crate::plate::harmonic;
use crate::problem::{Plate, Scenario};
use crate::recording::Recording;
use crate::scene::Belongs;
use crate::solution::{Harmonic, PlateResult};

numbers! {
    /// One number of a tab. In the table below, the last entry is the name of the tab.
    Live,
    /// The numbers of tabs that are known.
    Readings: &str;
    HeldGap "hold.gap_um" "held gap" "µm" Plate "Hold";
    HeldPressure "hold.pressure_kpa" "mean pressure" "kPa" Plate "Hold";
    HeldPeak "hold.highest_kpa" "highest mean pressure" "kPa" Plate "Hold";
    Cycles "startup.cycles" "cycles since rest" "" Any "Start-up";
    Remaining "startup.remaining" "change to come" "" Any "Start-up";
    StartAlpha "startup.alpha" "film share of the load α" "" Motor "Start-up";
    StartLoadRatio "startup.mean_load_ratio" "mean load ratio" "" Plate "Start-up";
    Stall "torque.stall_nm" "stall torque" "N·m" Motor "Torque";
    DryStall "torque.dry_stall_nm" "stall torque, no film" "N·m" Motor "Torque";
    PresentTorque "torque.present_nm" "torque at this speed" "N·m" Motor "Torque";
    NoLoad "torque.no_load_rpm" "no-load speed" "rpm" Motor "Torque";
    Output "torque.output_w" "greatest power" "W" Motor "Torque";
    DryOutput "torque.dry_output_w" "greatest power, no film" "W" Motor "Torque";
    Spring "exact.spring" "spring S" "" Plate "Exact";
    Damping "exact.damping" "damping D" "" Plate "Exact";
    Stiffness "exact.stiffness_n_per_m" "stiffness of the film" "N/m" Plate "Exact";
    DampingForce "exact.damping_n_s_per_m" "damping coefficient of the film" "N·s/m" Plate "Exact";
}

impl Live {
    /// Its unit; empty for a pure number.
    pub fn unit(self) -> &'static str {
        TABLE[self as usize].3
    }

    /// The tab that shows it.
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

    /// Whether the student gets it by an action that does not change the scene.
    pub fn is_done_by_hand(self) -> bool {
        matches!(self.tab(), "Hold" | "Start-up")
    }
}

impl Readings {
    /// Takes the numbers of a plate held by hand: its gap \[m\], and the mean absolute pressure \[Pa\] below it; the
    /// highest so far is kept.
    pub fn read_held(&mut self, gap: f64, mean_pressure: f64) {
        self.set(Live::HeldGap, gap * 1e6);
        self.set(Live::HeldPressure, mean_pressure * 1e-3);
        let peak = self.get(Live::HeldPeak).unwrap_or(0.0);
        self.set(Live::HeldPeak, peak.max(mean_pressure * 1e-3));
    }

    /// Takes the numbers of a cycle of a start-up.
    pub fn read_cycle(&mut self, row: &CycleRow) {
        self.set(Live::Cycles, row.cycle as f64);
        self.set(Live::Remaining, row.remaining.unwrap_or(f64::INFINITY));
        for (live, number) in [(Live::StartAlpha, Quantity::Alpha), (Live::StartLoadRatio, Quantity::LoadRatio)] {
            self.set(live, row.numbers.get(number).unwrap_or(f64::NAN));
        }
    }

    /// Takes the numbers of a motor's curves over speed.
    pub fn read_torque(&mut self, curves: &TorqueCurves) {
        let (with, without) = (&curves.with_film, &curves.without_film);
        self.set(Live::Stall, with.stall_torque.value);
        self.set(Live::PresentTorque, with.present.torque.value);
        self.set(Live::DryStall, without.stall_torque.value);
        self.set(Live::Output, with.max_power.value);
        self.set(Live::DryOutput, without.max_power.value);
        if let Some(speed) = with.no_load_speed {
            self.set(Live::NoLoad, curves.rpm(speed.value));
        }
    }

    /// Takes the numbers of a plate that are compared with exact results.
    pub fn read_exact(&mut self, plate: &Plate, recording: &Recording) {
        if let Some(found) = harmonic::solved(plate, &PlateResult::default(), recording) {
            self.set(Live::Spring, found.spring.value);
            self.set(Live::Damping, found.damping.value);
            let absolute = found.times(Harmonic::unit(plate));
            self.set(Live::Stiffness, absolute.spring.value);
            self.set(Live::DampingForce, absolute.damping.value);
        }
    }
}
