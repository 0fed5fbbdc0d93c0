//! The checked, SI form of a scene: the only thing a solver accepts.
//!
//! A `Scene` of the crate `squeezefilm` is what a person edits, in the units of the field; a [`Problem`] is what it means.
//! Every number in here is finite and inside its documented range, so no solver re-checks it.
//! Symbols follow `docs/theory.md`.

use crate::gas::species::IdealGas;
use crate::rotor::ring::Section;
use crate::surface::Surface;
use serde::{Deserialize, Serialize};

/// A key whose value is one of a few names.
macro_rules! named {
    ($(#[$about:meta])* $Type:ident { $($(#[$meaning:meta])* $Value:ident = $name:literal),* $(,)? }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
        pub enum $Type { $($(#[$meaning])* #[serde(rename = $name)] $Value),* }

        impl $Type {
            /// The names of all values.
            pub const NAMES: &[&str] = &[$($name),*];

            /// The name of the value in presets.
            pub fn name(&self) -> &'static str {
                match self { $(Self::$Value => $name),* }
            }
        }
    };
}

named! {
    /// How gas slips at the walls: the ratio Q of the Poiseuille flow to that of the continuum.
    Slip {
        /// Q = 1: no slip.
        #[default]
        None = "none",
        /// Q = 1 + 6 Kn (Burgdorfer 1959), the paper's.
        FirstOrder = "first-order",
        /// Q = 1 + 6 Kn + 6 Kn² (Hsia and Domoto 1983).
        SecondOrder = "second-order",
        /// The flow-rate fit to the linearised Boltzmann equation by Fukui and Kaneko (1988, 1990).
        FukuiKaneko = "fukui-kaneko",
    }
}

/// The gas between the faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gas {
    /// Ambient pressure p_a \[Pa\].
    pub ambient_pressure: f64,
    /// Dynamic viscosity μ \[Pa s\].
    pub viscosity: f64,
    /// Mean free path λ_a at the ambient pressure \[m\].
    pub mean_free_path: f64,
    /// Slip law.
    pub slip: Slip,
    /// Share of the molecules that the walls reflect diffusely, in the law of Fukui and Kaneko; the others are reflected specularly.
    pub accommodation: f64,
    /// Ideal gas from which density, heat capacity and speed of sound follow.
    pub ideal: IdealGas,
}

impl Default for Gas {
    /// The air of the fundamental case.
    fn default() -> Self {
        Self {
            ambient_pressure: 101_325.0,
            viscosity: 18.1 / 1e6,
            mean_free_path: 64.0 / 1e9,
            slip: Slip::FirstOrder,
            accommodation: 1.0,
            ideal: IdealGas::UNNAMED,
        }
    }
}

/// Model of the rotor's normal compliance, displacement amplitude = C(k) × line-load amplitude. Solvers use the compliances that
/// [`crate::rotor`] computes from it.
#[derive(Clone, Debug, PartialEq)]
pub enum RotorCompliance {
    /// A beam on an elastic foundation in series with a local (Winkler) compliance,
    /// C(k) = 1/(EI k⁴ + K) + c with K = 1/(2 ℓ C_p), EI = K ℓ⁴/4.
    Beam {
        /// Decay length ℓ \[m\].
        decay_length: f64,
        /// Point compliance C_p of the infinite beam \[m/N\].
        point_compliance: f64,
        /// Local compliance c \[m²/N\].
        local_compliance: f64,
    },
    /// Measured or computed elsewhere: `(wavenumber [rad/m], compliance [m²/N])`, wavenumbers ascending, at least
    /// one row, compliances positive. Linear between rows in (ln k, ln C); constant beyond either end.
    Table(Vec<(f64, f64)>),
    /// The Green's function: `(x [m], deflection at x under a unit force at 0 [m/N])`, from x = 0 on, ascending, two rows or more; the same
    /// on the other side.
    Green(Vec<(f64, f64)>),
    /// A ring of this cross-section, computed by finite elements.
    Ring(Section),
}

/// A ring-type travelling-wave motor; every quantity is for one wavelength unless said otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Motor {
    /// Contact radius r \[m\].
    pub contact_radius: f64,
    /// Wavelengths round the ring.
    pub waves: u32,
    /// Axial load L on one wavelength \[N\].
    pub load: f64,
    /// Dry friction coefficient μ_d.
    pub dry_friction: f64,
    /// Surface speed of the rotor V_R at the contact radius, towards +x \[m/s\].
    pub rotor_speed: f64,
    /// Frequency f \[Hz\].
    pub frequency: f64,
    /// Normal amplitude of the stator A_S, zero to peak \[m\].
    pub normal_amplitude: f64,
    /// Tangential amplitude of the stator B_S, zero to peak \[m\].
    pub tangential_amplitude: f64,
    /// Teeth in one wavelength n_t.
    pub teeth: usize,
    /// Tooth width b along x \[m\], at most the pitch.
    pub tooth_width: f64,
    /// Radius of a crowned tooth top \[m\]; `None` is flat.
    pub tooth_radius: Option<f64>,
    /// Radial contact width w \[m\].
    pub contact_width: f64,
    /// The rotor's compliance.
    pub rotor: RotorCompliance,
    /// Minimum spacing H_m left by roughness \[m\]; the film thickness is gap + H_m. Of faces that meet on asperities, the mean gap when the
    /// load presses all tooth tops evenly: what stands for H_m where a closed film is estimated.
    pub min_spacing: f64,
    /// How the faces meet.
    pub surface: Surface,
    /// The gas.
    pub gas: Gas,
    /// Whether the scene asks for the wedge (sliding) term.
    pub shear: bool,
}

impl Motor {
    /// Wavelength λ = 2πr/waves \[m\].
    pub fn wavelength(&self) -> f64 {
        std::f64::consts::TAU * self.contact_radius / f64::from(self.waves)
    }

    /// Tooth pitch λ/n_t \[m\].
    pub fn pitch(&self) -> f64 {
        self.wavelength() / self.teeth as f64
    }

    /// Period of the vibration T = 1/f \[s\].
    pub fn period(&self) -> f64 {
        1.0 / self.frequency
    }

    /// Torque μ_d waves N r \[N m\] on the whole ring for a contact load N of `load` \[N\] on one wavelength, if all of it pulls one way.
    /// With N = L it is that of the motor without air, with N = (1 − α) L the paper's maximum operating torque.
    pub fn friction_torque(&self, load: f64) -> f64 {
        self.dry_friction * f64::from(self.waves) * load * self.contact_radius
    }

    /// Difference between film thickness and displayed gap \[m\]: H_m, or 0 over asperities, where the gap shown is the mean one.
    pub fn spacing(&self) -> f64 {
        if self.surface.asperities.is_some() { 0.0 } else { self.min_spacing }
    }

    /// Least film thickness that there can be \[m\].
    pub fn least_thickness(&self) -> f64 {
        self.surface.asperities.map_or(self.min_spacing, |asperities| asperities.least_gap())
    }

    /// Contact line load above which a node counts as touching \[N/m\]: 0 with a hard stop. Asperities always carry something, so there
    /// it is a thousandth of the load spread evenly over the tooth tops.
    pub fn touching_from(&self) -> f64 {
        if self.surface.asperities.is_some() { 1e-3 * self.load / (self.teeth as f64 * self.tooth_width) } else { 0.0 }
    }

    /// Film thickness at which a node begins to touch \[m\].
    pub fn touching_thickness(&self) -> f64 {
        self.surface.asperities.map_or(self.min_spacing, |asperities| {
            asperities.mean_gap(asperities.separation_under(self.touching_from() / self.contact_width)).0
        })
    }

    /// Greatest tangential speed of the stator's surface V₀ = 2πf B_S \[m/s\].
    pub fn stator_speed(&self) -> f64 {
        std::f64::consts::TAU * self.frequency * self.tangential_amplitude
    }

    /// Normal displacement of the stator W_S \[m\] at `x` \[m\] along the wave, on a tooth whose middle is `xi` \[m\]
    /// away, at phase `t_over_period` of the cycle: A_S cos 2π(t/T + x/λ) − ξ²/(2R).
    pub fn stator_displacement(&self, x: f64, xi: f64, t_over_period: f64) -> f64 {
        let wave = self.normal_amplitude * (std::f64::consts::TAU * (t_over_period + x / self.wavelength())).cos();
        wave - self.tooth_radius.map_or(0.0, |r| xi * xi / (2.0 * r))
    }

    /// Sliding speed U = V_R − V_St of the rotor seen from the tooth \[m/s\] (docs/theory.md), at `x` \[m\] and phase
    /// `t_over_period`; V_St = 2πf B_S cos 2π(t/T + x/λ).
    pub fn sliding_speed(&self, x: f64, t_over_period: f64) -> f64 {
        let tau = std::f64::consts::TAU;
        self.rotor_speed - self.stator_speed() * (tau * (t_over_period + x / self.wavelength())).cos()
    }
}

/// Converts a surface speed \[m/s\] at `radius` \[m\] to revolutions per minute.
pub fn rpm(speed: f64, radius: f64) -> f64 {
    60.0 * speed / (std::f64::consts::TAU * radius)
}

/// Standard acceleration of gravity \[m/s²\].
pub const GRAVITY: f64 = 9.80665;
/// Highest mean gap at which a plate may float \[m\]: no film is that thick.
pub const HIGHEST: f64 = 1e-3;

/// The shape of a plate, whatever its size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outline {
    /// Infinitely wide.
    Strip,
    /// A rectangle.
    Rectangle {
        /// Width over length.
        aspect: f64,
    },
    /// A disc.
    Disc,
    /// A ring.
    Ring {
        /// Inner radius over outer radius.
        hole: f64,
    },
}

/// A flat plate vibrating rigidly above a flat wall: the gap is h = mean_gap + amplitude·cos ωt everywhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    /// Length along x \[m\]; of a round plate its diameter.
    pub length: f64,
    /// Width along y \[m\]; `None` is a round plate or an infinitely wide strip, whose forces are per metre of width.
    pub width: Option<f64>,
    /// Radius of the hole of a round plate \[m\], open to the surrounding gas; 0 for a disc, `None` for a plate that is not round.
    pub hole: Option<f64>,
    /// Mean gap \[m\]. Under a load it is a first guess, [`Plate::trapped_gap`], until a solve has found it (`solution::settled`).
    pub mean_gap: f64,
    /// Load that the film carries in the mean over the cycle \[N; of a strip N/m\], on a plate too heavy to shake; `None` if the mean gap
    /// is given.
    pub load: Option<f64>,
    /// Least gap that the roughness leaves \[m\]: a plate under a load that would come closer rests on it. Unused without a load.
    pub min_spacing: f64,
    /// Amplitude of the vibration, zero to peak \[m\], smaller than the mean gap.
    pub amplitude: f64,
    /// Frequency f \[Hz\].
    pub frequency: f64,
    /// The gas.
    pub gas: Gas,
}

impl Plate {
    /// Area \[m²\] of the plate; of a strip, its length \[m\] (area per metre of width).
    pub fn area(&self) -> f64 {
        match self.hole {
            Some(hole) => std::f64::consts::PI * (self.radius() - hole) * (self.radius() + hole),
            None => self.length * self.width.unwrap_or(1.0),
        }
    }

    /// Whether it is an infinitely wide strip, whose forces are per metre of width.
    pub fn is_strip(&self) -> bool {
        self.outline() == Outline::Strip
    }

    /// Radius of a round plate \[m\].
    pub fn radius(&self) -> f64 {
        0.5 * self.length
    }

    /// From where to where the plate is along x, through its middle \[m\]: a ring is on either side of its hole.
    pub fn spans(&self) -> Vec<[f64; 2]> {
        let half = self.radius();
        match self.hole.filter(|hole| *hole > 0.0) {
            Some(hole) => vec![[-half, -hole], [hole, half]],
            None => vec![[-half, half]],
        }
    }

    /// Length \[m\] from one edge to the opposite one, along which the film is solved: a diameter of a disc, a radial section of a ring.
    pub fn section(&self) -> f64 {
        self.hole.filter(|hole| *hole > 0.0).map_or(self.length, |hole| self.radius() - hole)
    }

    /// Length b of its squeeze number \[m\]: the length along x, the radius of a disc, the difference of the radii of a ring.
    pub fn squeezed_length(&self) -> f64 {
        if self.outline() == Outline::Disc { self.radius() } else { self.section() }
    }

    /// Its shape, whatever its size.
    pub fn outline(&self) -> Outline {
        match (self.hole, self.width) {
            (Some(0.0), _) => Outline::Disc,
            (Some(hole), _) => Outline::Ring { hole: hole / self.radius() },
            (None, Some(width)) => Outline::Rectangle { aspect: width / self.length },
            (None, None) => Outline::Strip,
        }
    }

    /// Mean gap \[m\] at which gas that is trapped, and does not slip, carries `load` \[N or N/m\] in the mean of the cycle:
    /// (1 + F/(p_a A))² = (1 + 3ε²/2)/(1 − ε²), ε = amplitude/gap. The film carries less at the same gap.
    pub fn trapped_gap(&self, load: f64) -> f64 {
        let ratio = load / (self.gas.ambient_pressure * self.area());
        let excess = ratio * (2.0 + ratio);
        (self.amplitude * ((excess + 2.5) / excess).sqrt()).max(f64::MIN_POSITIVE)
    }

    /// The same plate turned by a quarter: its width along x. A strip stays as it is.
    pub fn turned(&self) -> Self {
        let length = self.width.unwrap_or(self.length);
        Self { length, width: self.width.map(|_| self.length), ..self.clone() }
    }

    /// The plate where its vibration just does not lift it off its roughness: it comes down to the least gap in every cycle.
    pub fn resting(&self) -> Self {
        Self { mean_gap: self.amplitude + self.min_spacing, ..self.clone() }
    }

    /// Film thickness h \[m\] at phase `t_over_period` of the cycle.
    pub fn gap(&self, t_over_period: f64) -> f64 {
        self.mean_gap + self.amplitude * (std::f64::consts::TAU * t_over_period).cos()
    }
}

named! {
    /// The wedge term.
    Wedge {
        /// As the scene needs.
        #[default]
        Auto = "auto",
        /// Solved.
        On = "on",
        /// Left out.
        Off = "off",
    }
}

named! {
    /// Teeth whose film is solved.
    Teeth {
        /// As the scene needs.
        #[default]
        Auto = "auto",
        /// One, by lag symmetry.
        One = "one",
        /// Every one.
        All = "all",
    }
}

named! {
    /// Width of the film that is solved.
    Width {
        /// As the scene needs.
        #[default]
        Auto = "auto",
        /// Half of it, by symmetry.
        Half = "half",
        /// All of it.
        Full = "full",
    }
}

named! {
    /// Directions in which the film flows.
    Flow {
        /// As the scene needs.
        #[default]
        Auto = "auto",
        /// Both.
        Plane = "plane",
        /// Across the width only: long teeth.
        Across = "across",
        /// Along the teeth only: a wide rotor.
        Along = "along",
    }
}

named! {
    /// The film in time.
    Time {
        /// As the scene needs.
        #[default]
        Auto = "auto",
        /// Step by step.
        March = "march",
        /// The limit of high frequency: gas that has no time to move.
        Trapped = "trapped",
    }
}

/// Explicit numerics of a preset's optional `[numerics]` table; each `None` or `Auto` is left to the fidelity or the plan. The fields have
/// the names of the keys and are serialised under them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Numerics {
    /// Film nodes along a tooth (or plate), both ends counted.
    pub film_nodes_along: Option<usize>,
    /// Film nodes across the full width, both ends counted.
    pub film_nodes_across: Option<usize>,
    /// Nodes of one wavelength for the contact problem of `--method paper`, both ends counted (181 means λ/180).
    pub contact_nodes: Option<usize>,
    /// Time steps in a cycle.
    pub steps_per_cycle: Option<usize>,
    /// Relative change from round to round at which the cycle repeats.
    pub tolerance: Option<f64>,
    /// The wedge term.
    pub wedge: Wedge,
    /// Teeth whose film is solved.
    pub teeth: Teeth,
    /// Width of the film that is solved.
    pub width: Width,
    /// Directions in which the film flows.
    pub flow: Flow,
    /// The film in time.
    pub time: Time,
}

/// The scene to solve.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "there is one for each scene, not one for each node")]
pub enum Scenario {
    /// The travelling-wave motor.
    Motor(Motor),
    /// The vibrating plate.
    Plate(Plate),
}

impl Scenario {
    /// The motor; `None` of a plate.
    pub fn motor(&self) -> Option<&Motor> {
        if let Self::Motor(motor) = self { Some(motor) } else { None }
    }

    /// The plate; `None` of a motor.
    pub fn plate(&self) -> Option<&Plate> {
        if let Self::Plate(plate) = self { Some(plate) } else { None }
    }
}

/// A scene, checked and in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// The preset's name, carried into every result.
    pub name: String,
    /// The scene to solve.
    pub scenario: Scenario,
    /// Explicit numerics, if the preset gives any.
    pub numerics: Numerics,
}
