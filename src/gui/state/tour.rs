//! The tour at the first start: four stops, each a part of the window with a short text.

/// A stop.
#[derive(Clone, Copy, Debug)]
pub struct TourStop {
    /// The part that is highlighted.
    pub place: &'static str,
    /// Title of the part.
    pub title: &'static str,
    /// A few words on the part and its use.
    pub text: &'static str,
}

/// All stops.
pub const STOPS: &[TourStop] = &[
    TourStop {
        place: "wave",
        title: "A motor, and the air in it",
        text: "This program shows how much torque an ultrasonic motor loses to the air between its parts. The grey teeth of the stator push up against the rotor as a wave runs by, some 30 000 times a second, here slowed down. Blue is the trapped air, orange is where metal touches.",
    },
    TourStop {
        place: "parameters",
        title: "Change anything",
        text: "Every number of the motor has a slider. Drag one and the motor is solved again at once; Ctrl+Z takes it back. Point at a name to read what it means.",
    },
    TourStop {
        place: "headline",
        title: "The number that matters",
        text: "α is the share of the load that the air carries. What the air carries gives no friction: with α = 0.25 a quarter of the torque is lost.",
    },
    TourStop {
        place: "lessons",
        title: "Learn why",
        text: "Short lessons show step by step why air that is trapped for a few microseconds acts as a spring. The first begins with a plate in your hand. The glossary and this tour are under Help.",
    },
];
