//! The view of the results: nothing in here changes a result.

use crate::gui::derived::ring::Orbit;
use crate::recording::Recording;

/// A tab of the middle of the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tab {
    /// The cycle of the present run, animated.
    #[default]
    Motion,
    /// Pinned runs beside each other.
    Compare,
    /// One parameter varied, or two.
    Sweep,
    /// For a motor, torque and power over speed; for a plate, exact beside computed results.
    Torque,
    /// The transient from rest.
    Startup,
    /// A plate held with the mouse.
    Hold,
    /// Error against solve time.
    Tradeoff,
    /// A motor's rotor by itself.
    Rotor,
    /// Sensitivities of the results, and their uncertainty.
    Sensitivity,
    /// Keys chosen to agree with measurements.
    Fit,
}

impl Tab {
    /// All, in the order of their labels.
    pub const ALL: &[(Self, &str)] = &[
        (Self::Motion, "Motion"),
        (Self::Compare, "Compare"),
        (Self::Sweep, "Sweep"),
        (Self::Torque, "Torque"),
        (Self::Tradeoff, "Trade-off"),
        (Self::Startup, "Start-up"),
        (Self::Hold, "Hold"),
        (Self::Rotor, "Rotor"),
        (Self::Sensitivity, "Sensitivity"),
        (Self::Fit, "Fit"),
    ];

    /// Its label, of a scene that is a plate or a motor.
    pub fn label(self, plate: bool) -> &'static str {
        let name = Self::ALL.iter().find(|(tab, _)| *tab == self).map_or("", |(_, name)| *name);
        if self == Self::Torque && plate { "Exact" } else { name }
    }

    /// The tab of this name, as lessons and links write it: its label, in upper or lower case.
    pub fn named(name: &str) -> Option<Self> {
        let is = |tab: &Self| [true, false].iter().any(|plate| tab.label(*plate).eq_ignore_ascii_case(name));
        Self::ALL.iter().map(|(tab, _)| *tab).find(is)
    }

    /// Whether the tab has content for this kind of scene: only a plate can be held, and only a motor has a rotor.
    pub fn is_of(self, plate: bool) -> bool {
        self != if plate { Self::Rotor } else { Self::Hold }
    }

    /// Whether the tab is listed: for a plate there is no rotor tab, but for a motor the tab Hold offers to open a plate.
    pub fn is_listed(self, plate: bool) -> bool {
        self != Self::Rotor || !plate
    }

    /// Whether the tab has an animation.
    pub fn moves(self) -> bool {
        matches!(self, Self::Motion | Self::Compare | Self::Startup | Self::Hold)
    }
}

/// View of the present run.
#[derive(Clone, Debug)]
pub struct View {
    /// The tab that is shown.
    pub tab: Tab,
    /// Accuracy target of the trade-off, as a share of the value.
    pub accuracy: f64,
    /// Time target of the trade-off \[s\].
    pub budget: f64,
    /// Phase of the cycle shown, 0 ≤ phase < 1.
    pub phase: f64,
    /// Whole cycles played so far, from which the rotation of the rotor follows.
    pub cycles: f64,
    /// Whether the animation runs.
    pub playing: bool,
    /// Seconds on screen for one cycle.
    pub seconds_per_cycle: f64,
    /// Tooth that is followed.
    pub tooth: usize,
    /// Whether the parameters are shown.
    pub parameters: bool,
    /// Whether the results are shown.
    pub results: bool,
    /// x under the pointer in any view \[m\]; all views show their values there.
    pub cursor_x: Option<f64>,
    /// Direction that the ring is seen from.
    pub orbit: Orbit,
    /// Number of scenes opened so far; the panels scroll to the top when it changes.
    pub opened: u64,
}

impl Default for View {
    fn default() -> Self {
        Self {
            tab: Tab::default(),
            accuracy: 1e-2,
            budget: 16e-3,
            phase: 0.0,
            cycles: 0.0,
            playing: true,
            seconds_per_cycle: 6.0,
            tooth: 0,
            parameters: true,
            results: true,
            cursor_x: None,
            orbit: Orbit::default(),
            opened: 0,
        }
    }
}

/// Share of a frame that counts as rounding error.
const ROUNDING: f64 = 1e-6;

impl View {
    /// The present instant in frames, 0 ≤ place < frames: whole at a recorded frame, otherwise between two frames.
    pub fn place(&self, recording: &Recording) -> f64 {
        let frames = recording.frames.max(1) as f64;
        let place = self.phase.rem_euclid(1.0) * frames;
        let whole = place.round();
        (if (place - whole).abs() < ROUNDING { whole } else { place }).rem_euclid(frames)
    }

    /// The phase of the recorded frame `by` frames from here: from between two frames, the first step goes to the nearer
    /// one in its direction.
    pub fn stepped(&self, recording: &Recording, by: i64) -> f64 {
        let frames = recording.frames.max(1) as i64;
        let place = self.place(recording);
        let here = if by < 0 { place.ceil() } else { place.floor() };
        (here as i64 + by).rem_euclid(frames) as f64 / frames as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::LineLoads;

    #[test]
    fn steps_land_on_frames() {
        for frames in [1, 7, 72, 180, 49] {
            let recording = Recording { lines: LineLoads { frames, ..LineLoads::default() }, ..Recording::default() };
            let mut view = View::default();
            for by in [1, 1, -3, 5, -1] {
                let before = view.place(&recording);
                assert_eq!(before.fract(), 0.0, "{frames}");
                view.phase = view.stepped(&recording, by);
                let expected = (before as i64 + by).rem_euclid(frames as i64);
                assert_eq!(view.place(&recording), expected as f64, "{frames}");
            }
        }
        let recording = Recording { lines: LineLoads { frames: 10, ..LineLoads::default() }, ..Recording::default() };
        let between = View { phase: 0.34, ..View::default() };
        assert!((between.place(&recording) - 3.4).abs() < 1e-12);
        assert_eq!([between.stepped(&recording, -1), between.stepped(&recording, 1)], [0.3, 0.4]);
        // A phase that rounding has carried to the end of the cycle is its start.
        assert_eq!(View { phase: 1.0 - 1e-12, ..View::default() }.place(&recording), 0.0);
    }
}
