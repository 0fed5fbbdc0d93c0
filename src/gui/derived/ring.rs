//! The whole ring: the waves of the unrolled view, rolled up and drawn as faces seen from one side.
//!
//! Lengths are in contact radii. The angle θ of a place is 2π x/(waves · λ), x from the middle of the first wave; heights are exaggerated as in
//! the unrolled view, and the rotor is lifted off. Seen from the angle `azimuth` round the axis and `elevation` above the ring's plane, a place at (r, θ, z) is
//!
//! ```text
//! right  r sin(θ − azimuth)
//! up     z cos elevation − r cos(θ − azimuth) sin elevation
//! near   z sin elevation + r cos(θ − azimuth) cos elevation
//! ```
//!
//! Faces that are turned away are left out. The others are painted from back to front. A plane separates stator and rotor, so all faces of
//! one come before all faces of the other.

use crate::problem::Motor;
use crate::recording::Recording;
use crate::recording::sample::{self, Lines};
use std::f64::consts::TAU;

/// Strips of a tooth top, along the ring, at most.
const STRIPS: usize = 4;
/// Teeth on the whole ring up to which each is drawn with its grooves and flanks.
const MOST_TEETH: usize = 280;
/// Stations round the ring if there are more.
const STATIONS: usize = 740;
/// Radii between which the ring is drawn, in contact radii: the width of the ring is not known, and the contact is too narrow to be seen.
const INNER: f64 = 0.89;
const OUTER: f64 = 1.11;
/// The rotor is lifted off by this many contact radii.
const LIFT: f64 = 0.42;
/// Marks on a rotor that turns.
const MARKS: u32 = 12;
/// Angle that a mark takes, and its height.
const MARK: f64 = 0.035;
const MARK_HEIGHT: f64 = 0.06;

/// Direction that the ring is seen from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// Angle round the axis \[rad\].
    pub azimuth: f64,
    /// Angle above the ring's plane, −π/2 to π/2 \[rad\].
    pub elevation: f64,
}

impl Default for Orbit {
    fn default() -> Self {
        Self { azimuth: 0.0, elevation: 0.65 }
    }
}

impl Orbit {
    /// Turned by these angles \[rad\], no further than straight from above or below.
    pub fn turned(self, azimuth: f64, elevation: f64) -> Self {
        let limit = 0.25 * TAU;
        Self {
            azimuth: (self.azimuth + azimuth).rem_euclid(TAU),
            elevation: (self.elevation + elevation).clamp(-limit, limit),
        }
    }
}

/// The part of the drawing that a face belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DrawnPart {
    /// The top of a tooth, with the film pressure at its two ends \[Pa\].
    Film([f64; 2]),
    /// The rest of the stator.
    Stator,
    /// A side of the tooth that is followed.
    Followed,
    /// The rotor.
    Rotor,
    /// A mark on the rotor.
    Mark,
}

/// A visible face.
#[derive(Clone, Copy, Debug)]
pub struct DrawnFace {
    /// Its corners, counter-clockwise, as (right, up) in contact radii: the first and the last are at one end of it along the ring, the other two
    /// at the other end.
    pub corners: [[f64; 2]; 4],
    /// The part that it belongs to.
    pub part: DrawnPart,
    /// Brightness, 0 to 1.
    pub light: f64,
    near: f64,
}

/// A cross-section of the ring at one place along a wavelength.
#[derive(Clone, Copy, Debug)]
struct Station {
    /// x \[m\].
    x: f64,
    /// Height of the face that meets the film \[m\].
    height: f64,
    /// Film pressure, on a tooth top \[Pa\].
    pressure: Option<f64>,
    tooth: usize,
}

/// The ring at one instant.
#[derive(Debug)]
pub struct Ring<'a> {
    /// The motor.
    pub motor: &'a Motor,
    /// Its fields.
    pub recording: &'a Recording,
    /// The instant, in frames.
    pub place: f64,
    /// Whole cycles completed before this one.
    pub cycles: f64,
    /// The lines at that instant.
    pub lines: &'a Lines,
    /// The rotor's underside, as in [`Lines::underside`] \[m\].
    pub underside: &'a [[f64; 2]],
    /// Lowest and highest height of the unrolled view \[m\].
    pub heights: [f64; 2],
    /// Height of a tooth above the body between the teeth, on that scale \[m\].
    pub tooth_height: f64,
    /// Factor by which heights are exaggerated.
    pub exaggeration: f64,
    /// Tooth of the first wave that is followed.
    pub followed: usize,
}

impl Ring<'_> {
    /// Greatest distance of any point from the middle, in contact radii: the space needed from any direction of view.
    pub fn reach(&self) -> f64 {
        OUTER.hypot(0.5 * self.tall())
    }

    /// Contact radii per metre of height.
    fn scale(&self) -> f64 {
        self.exaggeration / self.motor.contact_radius
    }

    /// Height from the bottom of the stator to the top of the rotor, in contact radii.
    fn tall(&self) -> f64 {
        (self.heights[1] - self.heights[0]) * self.scale() + LIFT
    }

    fn phase(&self) -> f64 {
        self.place / self.recording.frames.max(1) as f64
    }

    /// Whether every tooth is drawn with its grooves.
    fn with_grooves(&self) -> bool {
        self.recording.teeth * self.motor.waves as usize <= MOST_TEETH
    }

    fn stator(&self) -> Vec<Station> {
        let recording = self.recording;
        let Some(reach) = recording.x.last().copied() else { return Vec::new() };
        let waves = self.motor.waves.max(1) as usize;
        let phase = self.phase();
        if !self.with_grooves() {
            let count = (STATIONS / waves).max(7);
            let x = |i: usize| (i as f64 / count as f64) * recording.length - 0.5 * recording.pitch;
            return (0..=count).filter_map(|i| self.on_a_tooth(x(i))).collect();
        }
        let strips = (MOST_TEETH / (recording.teeth * waves).max(1)).clamp(1, STRIPS);
        let mut stations = Vec::with_capacity(recording.teeth * (strips + 3) + 1);
        for tooth in 0..recording.teeth {
            let middle = tooth as f64 * recording.pitch;
            let foot = |x: f64| {
                let height = self.motor.stator_displacement(x, 0.0, phase) - self.tooth_height;
                Station { x, height, pressure: None, tooth }
            };
            stations.push(foot(middle - reach));
            for i in 0..=strips {
                let xi = reach * (2.0 * i as f64 / strips as f64 - 1.0);
                stations.extend(self.top(tooth, xi));
            }
            stations.push(foot(middle + reach));
        }
        // Half a groove at the end and half a groove at the start make one groove, because the wave repeats.
        if let Some(first) = stations.first().copied() {
            stations.push(Station { x: first.x + recording.length, ..first });
        }
        stations
    }

    /// Stations of the rotor: at those of the stator's tops, and half-way over each groove.
    fn rotor(&self, stator: &[Station]) -> Vec<Station> {
        let mut places: Vec<f64> = stator.iter().filter(|top| top.pressure.is_some()).map(|top| top.x).collect();
        if self.with_grooves() {
            places.extend((0..=self.recording.teeth).map(|tooth| (tooth as f64 - 0.5) * self.recording.pitch));
            places.sort_by(f64::total_cmp);
        }
        let nodes: Vec<f64> = self.underside.iter().map(|[x, _]| *x).collect();
        let heights: Vec<f64> = self.underside.iter().map(|[_, height]| *height).collect();
        let station = |x: f64| {
            let height = sample::between(&heights, sample::locate(&nodes, x)?);
            Some(Station { x, height, pressure: None, tooth: 0 })
        };
        places.into_iter().filter_map(station).collect()
    }

    /// The top of `tooth` at the distance `xi` from its middle.
    fn top(&self, tooth: usize, xi: f64) -> Option<Station> {
        let recording = self.recording;
        let at = sample::locate(&recording.x, xi)?;
        let height = sample::between(&self.lines.stator[self.lines.of(tooth)], at);
        let pressure = sample::middle_pressure(recording, tooth, xi, self.place)?;
        Some(Station { x: tooth as f64 * recording.pitch + xi, height, pressure: Some(pressure), tooth })
    }

    /// The nearest tooth top, drawn at `x`.
    fn on_a_tooth(&self, x: f64) -> Option<Station> {
        let (tooth, xi) = sample::tooth_at(x, self.recording.pitch, self.recording.teeth);
        let reach = self.recording.x.last().copied()?;
        self.top(tooth, xi.clamp(-reach, reach)).map(|top| Station { x, ..top })
    }

    /// All faces that are seen, in the order in which they are painted.
    pub fn faces(&self, seen: Orbit) -> Vec<DrawnFace> {
        let (scale, tall) = (self.scale(), self.tall());
        let z = |height: f64| (height - self.heights[0]) * scale - 0.5 * tall;
        let top = 0.5 * tall;
        let stations = self.stator();
        let mut stator = Slab::new(self, seen);
        stator.add(&stations, |station| [z(self.heights[0]), z(station.height)], DrawnPart::Stator);
        let mut rotor = Slab::new(self, seen);
        rotor.add(&self.rotor(&stations), |station| [z(station.height) + LIFT, top], DrawnPart::Rotor);
        let (stator, mut rotor) = (stator.painted(), rotor.painted());
        let motor = self.motor;
        if motor.rotor_speed != 0.0 {
            let along = motor.rotor_speed / motor.frequency * (self.cycles + self.phase());
            let mut marks = Slab::new(self, seen);
            marks.marks(along * self.scale(), top);
            rotor.append(&mut marks.faces);
        }
        if seen.elevation >= 0.0 { [stator, rotor].concat() } else { [rotor, stator].concat() }
    }
}

/// A cut across a body.
#[derive(Clone, Copy)]
struct Cut {
    /// Corners as seen, (right, up, near): the inner and the outer one below, then those above.
    corners: [[f64; 3]; 4],
    /// Light on the outer wall there.
    light: f64,
}

/// Faces of one body round the ring.
struct Slab<'a> {
    ring: &'a Ring<'a>,
    seen: Orbit,
    faces: Vec<DrawnFace>,
}

impl<'a> Slab<'a> {
    fn new(ring: &'a Ring<'a>, seen: Orbit) -> Self {
        Self { ring, seen, faces: Vec::new() }
    }

    /// Far faces first.
    fn painted(mut self) -> Vec<DrawnFace> {
        self.faces.sort_by(|a, b| a.near.total_cmp(&b.near));
        self.faces
    }

    /// A body from `of(station)[0]` up to `of(station)[1]`, all round the ring.
    fn add(&mut self, stations: &[Station], of: impl Fn(&Station) -> [f64; 2], part: DrawnPart) {
        let recording = self.ring.recording;
        let waves = self.ring.motor.waves.max(1);
        let angle = TAU / (f64::from(waves) * recording.length);
        let middle = 0.5 * (recording.length - recording.pitch);
        for wave in 0..waves {
            let turn = TAU * f64::from(wave) / f64::from(waves);
            let cut = |station: &Station| self.cut(turn + angle * (station.x - middle), of(station));
            let cuts: Vec<Cut> = stations.iter().map(cut).collect();
            for (ends, cuts) in stations.windows(2).zip(cuts.windows(2)) {
                let film = ends[0].pressure.zip(ends[1].pressure).map(|(a, b)| DrawnPart::Film([a, b]));
                let followed = wave == 0 && ends.iter().all(|station| station.tooth == self.ring.followed);
                let side = if followed && part == DrawnPart::Stator { DrawnPart::Followed } else { part };
                self.block([cuts[0], cuts[1]], film.unwrap_or(side), if film.is_some() { side } else { part });
            }
        }
    }

    /// The cut at an angle, from one height to another.
    fn cut(&self, angle: f64, [low, high]: [f64; 2]) -> Cut {
        let (side, front) = (angle - self.seen.azimuth).sin_cos();
        let (sin, cos) = self.seen.elevation.sin_cos();
        let seen = |(r, z): (f64, f64)| [r * side, z * cos - r * front * sin, z * sin + r * front * cos];
        // Light falls from above, over the left shoulder; the brightness of a wall depends on its angle to the light.
        let light = 0.62 + 0.22 * (0.825 * front - 0.565 * side);
        Cut { corners: [(INNER, low), (OUTER, low), (INNER, high), (OUTER, high)].map(seen), light }
    }

    /// One piece of a body between two cuts; the top is of `top`, the sides of `side`.
    fn block(&mut self, cuts: [Cut; 2], top: DrawnPart, side: DrawnPart) {
        let outside = cuts[0].light;
        self.push(top, cuts, [3, 2], 1.0);
        self.push(side, cuts, [0, 1], 0.45);
        self.push(side, cuts, [1, 3], outside);
        self.push(side, cuts, [2, 0], 1.24 - outside);
    }

    /// Marks on the rotor, whose top is at `top`, which has turned by `turned` \[rad\].
    fn marks(&mut self, turned: f64, top: f64) {
        for mark in 0..MARKS {
            let from = turned + TAU * f64::from(mark) / f64::from(MARKS);
            let cuts = [from, from + MARK].map(|angle| self.cut(angle, [top - MARK_HEIGHT, top]));
            self.push(DrawnPart::Mark, cuts, [3, 2], 1.0);
            self.push(DrawnPart::Mark, cuts, [1, 3], 1.0);
        }
    }

    /// Adds the face between two cuts from one of their corners to the other, counter-clockwise from outside, if it is seen.
    fn push(&mut self, part: DrawnPart, [from, to]: [Cut; 2], [one, other]: [usize; 2], light: f64) {
        let corners = [from.corners[one], to.corners[one], to.corners[other], from.corners[other]];
        let near = corners.iter().map(|corner| corner[2]).sum();
        let corners = corners.map(|[right, up, _]| [right, up]);
        let [a, b, c, d] = corners;
        let area = (c[0] - a[0]) * (d[1] - b[1]) - (d[0] - b[0]) * (c[1] - a[1]);
        if area > 1e-9 {
            self.faces.push(DrawnFace { corners, part, light, near });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::{Problem, Scenario};
    use crate::recording::{LineLoads, Touching};
    use crate::scene::presets;
    use std::f64::consts::{FRAC_PI_2, PI};

    /// A ring with a sine of height and pressure on it, and a rotor 1 µm above the crests.
    fn with_ring<T>(waves: u32, teeth: usize, look: impl FnOnce(&Ring<'_>) -> T) -> T {
        let Scenario::Motor(mut motor) = Problem::try_from(&presets::find("fundamental").unwrap()).unwrap().scenario
        else {
            panic!("a motor");
        };
        (motor.waves, motor.teeth) = (waves, teeth);
        let (pitch, frames) = (motor.pitch(), 2 * teeth);
        let x: Vec<f64> = (-2..=2).map(|i| 0.15 * f64::from(i) * pitch).collect();
        let of_frame = |frame: usize, xi: f64| (frame as f64 / frames as f64, xi);
        let nodes = || (0..frames).flat_map(|frame| x.iter().map(move |xi| of_frame(frame, *xi)));
        let stator: Vec<f64> = nodes().map(|(phase, xi)| motor.stator_displacement(xi, 0.0, phase)).collect();
        let lines = LineLoads {
            frames,
            length: motor.wavelength(),
            teeth,
            stored_teeth: 1,
            pitch,
            node_length: vec![0.15 * pitch; x.len()],
            contact: vec![0.0; stator.len()],
            film: vec![0.0; stator.len()],
            film_thickness: stator.iter().map(|height| 2.3e-6 - height + motor.spacing()).collect(),
            x: x.clone(),
            ..LineLoads::default()
        };
        let pressure = stator.iter().map(|height| 1e5 * (2.0 + height / motor.normal_amplitude)).collect();
        let touching = Touching { min_spacing: motor.spacing(), compliance: 0.0 };
        let (map_x, map_y) = (x.clone(), vec![0.0]);
        let recording = Recording { lines, touching, stator, map_x, map_y, pressure, ..Recording::default() };
        let lines = Lines::at(&recording, 0.0);
        let ring = Ring {
            motor: &motor,
            recording: &recording,
            place: 0.0,
            cycles: 0.0,
            underside: &lines.underside(&recording),
            lines: &lines,
            heights: [-4e-6, 4e-6],
            tooth_height: 1e-6,
            exaggeration: 1000.0,
            followed: 1,
        };
        look(&ring)
    }

    fn from(azimuth: f64, elevation: f64) -> Orbit {
        Orbit { azimuth, elevation }
    }

    fn films(faces: &[DrawnFace]) -> impl Iterator<Item = (&DrawnFace, [f64; 2])> {
        faces.iter().filter_map(|face| if let DrawnPart::Film(ends) = face.part { Some((face, ends)) } else { None })
    }

    #[test]
    fn every_wave_is_there_and_tops_are_seen_from_above_only() {
        with_ring(7, 9, |ring| {
            let faces = ring.faces(from(0.0, FRAC_PI_2));
            // Four strips on each tooth, and one crest of pressure on each wave.
            assert_eq!(films(&faces).count(), 7 * 9 * 4);
            let crests = films(&faces).filter(|(_, ends)| ends.iter().any(|p| (p - 3e5).abs() < 1.0));
            let mut angles: Vec<f64> = crests.map(|(face, _)| face.corners[0][1].atan2(face.corners[0][0])).collect();
            angles.sort_by(f64::total_cmp);
            angles.dedup_by(|a, b| (*a - *b).abs() < 0.2);
            assert_eq!(angles.len(), 7, "{angles:?}");
            assert!(angles.windows(2).all(|pair| (pair[1] - pair[0] - TAU / 7.0).abs() < 0.06), "{angles:?}");
            assert_eq!(films(&ring.faces(from(0.3, -0.4))).count(), 0);
        });
    }

    #[test]
    fn heights_have_the_factor_of_the_unrolled_view() {
        with_ring(7, 9, |ring| {
            // Seen from the side, only heights show, and the rotor is lifted off the stator.
            let faces = ring.faces(from(0.0, 1e-6));
            let ends = |part: fn(&DrawnPart) -> bool| {
                let up = faces.iter().filter(|face| part(&face.part)).flat_map(|face| face.corners.map(|at| at[1]));
                up.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)])
            };
            let metre = 1000.0 / ring.motor.contact_radius;
            let [bottom, stator] = ends(|part| matches!(part, DrawnPart::Stator | DrawnPart::Followed));
            assert!((stator - bottom - (4e-6 + ring.motor.normal_amplitude) * metre).abs() < 1e-4);
            let [underside, top] = ends(|part| *part == DrawnPart::Rotor);
            assert!((underside - stator - LIFT - (2.3e-6 - ring.motor.normal_amplitude) * metre).abs() < 1e-4);
            assert!((top - bottom - LIFT - 8e-6 * metre).abs() < 1e-4);
            for elevation in [-1.0, 0.0, 0.5, 1.5] {
                let faces = ring.faces(from(1.0, elevation));
                let furthest = faces.iter().flat_map(|face| face.corners).map(|[x, y]| x.hypot(y)).fold(0.0, f64::max);
                assert!(furthest <= ring.reach() + 1e-9, "{furthest} {}", ring.reach());
            }
        });
    }

    #[test]
    fn what_is_near_is_painted_last() {
        with_ring(7, 9, |ring| {
            for (elevation, last) in [(0.5, DrawnPart::Rotor), (-0.5, DrawnPart::Stator)] {
                let faces = ring.faces(from(0.4, elevation));
                let rotor = |face: &DrawnFace| face.part == DrawnPart::Rotor;
                let changes = faces.windows(2).filter(|pair| rotor(&pair[0]) != rotor(&pair[1])).count();
                assert_eq!((changes, rotor(faces.last().unwrap())), (1, last == DrawnPart::Rotor));
                let ordered = faces.windows(2).filter(|pair| pair[0].near > pair[1].near).count();
                assert!(ordered <= 1, "only where one body begins");
            }
            // The middle of the first wave is in front, where a tooth that is followed has its walls.
            let faces = ring.faces(from(0.0, 0.5));
            let mut followed = faces.iter().filter(|face| face.part == DrawnPart::Followed).peekable();
            assert!(followed.peek().is_some() && followed.all(|face| face.corners[0][0].abs() < (PI / 7.0).sin()));
        });
    }

    /// The ring is drawn sixty times a second without a graphics card, so the number of faces is limited.
    #[test]
    fn work_is_bounded_for_any_number_of_teeth() {
        for (waves, teeth, most) in
            [(7, 9, 1600), (1, 1, 60), (1, 64, 1700), (31, 9, 3300), (33, 9, 3300), (100, 64, 3300)]
        {
            for seen in [Orbit::default(), from(1.0, -0.7), from(2.0, FRAC_PI_2)] {
                let faces = with_ring(waves, teeth, |ring| ring.faces(seen).len());
                assert!((10..=most).contains(&faces), "{waves} × {teeth}: {faces} faces");
            }
        }
    }
}
