//! Values between nodes and between frames; no drawing here.
//!
//! An instant is a *place*, counted in frames: 3.25 is a quarter of the way from frame 3 to frame 4, and after the last
//! frame comes the first. By lag symmetry tooth k at a place is tooth 0 at place + k·frames/teeth, so that another tooth
//! may lie between two frames where tooth 0 does not.

use super::{LineLoads, Recording, Touching};
use std::f64::consts::TAU;
use std::ops::Range;

/// Harmonics of the rotor between the teeth: those of a pitch and shorter are small.
const HARMONICS: usize = 32;

/// Points of the rotor over a groove; an odd number, so that one is half-way.
const GROOVE: usize = 7;

/// Interval of ascending `nodes` around `x` and the weight of its right end; `None` outside. Rounding at either end
/// is forgiven.
pub fn locate(nodes: &[f64], x: f64) -> Option<(usize, f64)> {
    let (first, last) = (*nodes.first()?, *nodes.last()?);
    let slack = 1e-9 * (last - first).abs();
    if !(x >= first - slack && x <= last + slack) {
        return None;
    }
    if nodes.len() == 1 {
        return Some((0, 0.0));
    }
    let right = nodes.partition_point(|node| *node <= x).clamp(1, nodes.len() - 1);
    let span = nodes[right] - nodes[right - 1];
    let weight = if span > 0.0 { ((x - nodes[right - 1]) / span).clamp(0.0, 1.0) } else { 0.0 };
    Some((right - 1, weight))
}

/// The value between `values[left]` and its right neighbour.
pub fn between(values: &[f64], (left, weight): (usize, f64)) -> f64 {
    let value = values[left];
    if weight > 0.0 { value + weight * (values[left + 1] - value) } else { value }
}

/// Tooth whose pitch holds `x`, and `x` from that tooth's middle. Tooth 0 is centred at 0; beyond either end the outermost.
pub fn tooth_at(x: f64, pitch: f64, teeth: usize) -> (usize, f64) {
    if pitch <= 0.0 || teeth == 0 {
        return (0, x);
    }
    let tooth = (x / pitch).round().clamp(0.0, (teeth - 1) as f64) as usize;
    (tooth, x - tooth as f64 * pitch)
}

/// One plane of pressure as stored, with its mirror planes.
pub struct Plane<'a> {
    recording: &'a Recording,
    /// Absolute pressure \[Pa\], `[ix][iy]`.
    values: &'a [f64],
}

impl<'a> Plane<'a> {
    /// The map of `frame`, that of tooth 0 or in a transient of `tooth`; `None` if the recording has none.
    pub fn of(recording: &'a Recording, tooth: usize, frame: usize) -> Option<Self> {
        let size = recording.map_x.len() * recording.map_y.len();
        let (maps, number) = match tooth.checked_sub(1) {
            Some(other) if recording.transient => (&recording.other_pressure, other * recording.frames + frame),
            _ => (&recording.pressure, frame),
        };
        let values = maps.get(number * size..(number + 1) * size)?;
        (size > 0).then_some(Self { recording, values })
    }

    /// Adds `share` times the values along y at `x` to `out` (one for each stored y); false outside.
    fn column(&self, x: f64, share: f64, out: &mut [f64]) -> bool {
        let x = if self.recording.half_length { x.abs() } else { x };
        let Some((left, weight)) = locate(&self.recording.map_x, x) else { return false };
        let ny = self.recording.map_y.len();
        let near = &self.values[left * ny..(left + 1) * ny];
        let far = if weight > 0.0 { &self.values[(left + 1) * ny..(left + 2) * ny] } else { near };
        for ((out, near), far) in out.iter_mut().zip(near).zip(far) {
            *out += share * (near + weight * (far - near));
        }
        true
    }

    /// Where `y` lies in a column.
    pub fn row(&self, y: f64) -> Option<(usize, f64)> {
        locate(&self.recording.map_y, if self.recording.half_width { y.abs() } else { y })
    }
}

/// Greatest y of the full map \[m\]; 0 for a strip.
pub fn half_width(recording: &Recording) -> f64 {
    recording.map_y.last().copied().unwrap_or(0.0)
}

/// Two neighbouring frames and the weight of the second.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pair {
    first: usize,
    second: usize,
    weight: f64,
}

impl Pair {
    /// The frames around `place`; of a transient the last stands until the cycle ends, because another cycle follows.
    fn at(recording: &Recording, place: f64) -> Self {
        let frames = recording.frames.max(1);
        let place = place.rem_euclid(frames as f64);
        let first = (place as usize).min(frames - 1);
        if recording.transient && first + 1 == frames {
            return Self { first, second: first, weight: 0.0 };
        }
        Self { first, second: (first + 1) % frames, weight: (place - first as f64).clamp(0.0, 1.0) }
    }

    /// That of tooth 0 which shows `tooth`.
    fn lagged(recording: &Recording, tooth: usize, place: f64) -> Self {
        let (frames, teeth) = (recording.frames.max(1), recording.teeth.max(1));
        // Whole frames apart, so that a tooth a whole number of frames ahead is as accurate as tooth 0.
        let shift = tooth * frames;
        Self::at(recording, place + (shift / teeth) as f64 + (shift % teeth) as f64 / teeth as f64)
    }
}

impl Touching {
    /// Gap \[m\] and contact line load \[N/m\] between (gap, load) of two frames, `weight` of the second.
    ///
    /// Where a node opens or closes, −compliance·load and the gap are two sides of one number, which passes 0 once: until
    /// then there is contact, from then on a gap, never both.
    fn between(self, [gap_0, load_0]: [f64; 2], [gap_1, load_1]: [f64; 2], weight: f64) -> [f64; 2] {
        let mix = |a: f64, b: f64, share: f64| a + share.clamp(0.0, 1.0) * (b - a);
        let (closed_0, closed_1) = (load_0 > 0.0, load_1 > 0.0);
        if closed_0 == closed_1 {
            return [mix(gap_0, gap_1, weight), mix(load_0, load_1, weight)];
        }
        // Part of the way at which the node opens, or closes.
        let passes = |pressed: f64, open: f64| {
            let sum = self.compliance * pressed + open;
            if sum > 0.0 { self.compliance * pressed / sum } else { 1.0 }
        };
        let part = |from: f64, to: f64| if to > from { (weight - from) / (to - from) } else { f64::from(weight >= to) };
        if closed_0 {
            let opens = passes(load_0, gap_1);
            [mix(gap_0, gap_1, part(opens, 1.0)), mix(load_0, load_1, part(0.0, opens))]
        } else {
            let closes = 1.0 - passes(load_1, gap_0);
            [mix(gap_0, gap_1, part(0.0, closes)), mix(load_0, load_1, part(closes, 1.0))]
        }
    }
}

/// The lines of all teeth at one instant, `[tooth][node]`, in the units of the recording.
#[derive(Debug, Default)]
pub struct Lines {
    nodes: usize,
    /// Stator's displacement \[m\].
    pub stator: Vec<f64>,
    /// Film thickness \[m\].
    pub film_thickness: Vec<f64>,
    /// Contact line load \[N/m\].
    pub contact: Vec<f64>,
    /// Film's gauge line load \[N/m\].
    pub film: Vec<f64>,
}

impl Lines {
    /// Reads two frames of each tooth at most; a recorded frame as it is.
    pub fn at(recording: &Recording, place: f64) -> Self {
        let nodes = recording.x.len();
        let mut lines = Self { nodes, ..Self::default() };
        let all_stored = recording.stored_teeth == recording.teeth;
        for tooth in 0..recording.teeth {
            let (stored, pair) = if all_stored {
                (tooth, Pair::at(recording, place))
            } else {
                (0, Pair::lagged(recording, tooth, place))
            };
            let line = |frame: usize| {
                let start = (stored * recording.frames + frame) * nodes;
                start..start + nodes
            };
            lines.read(recording, line(pair.first), line(pair.second), pair.weight);
        }
        lines
    }

    fn read(&mut self, recording: &Recording, first: Range<usize>, second: Range<usize>, weight: f64) {
        if weight == 0.0 {
            self.stator.extend_from_slice(&recording.stator[first.clone()]);
            self.film_thickness.extend_from_slice(&recording.film_thickness[first.clone()]);
            self.contact.extend_from_slice(&recording.contact[first.clone()]);
            self.film.extend_from_slice(&recording.film[first]);
            return;
        }
        let how = recording.touching;
        for (i, j) in first.zip(second) {
            let mix = |field: &[f64]| field[i] + weight * (field[j] - field[i]);
            let state = |index: usize| [recording.film_thickness[index] - how.min_spacing, recording.contact[index]];
            let [gap, contact] = how.between(state(i), state(j), weight);
            self.stator.push(mix(&recording.stator));
            self.film_thickness.push(how.min_spacing + gap);
            self.contact.push(contact);
            self.film.push(mix(&recording.film));
        }
    }

    /// Where the nodes of `tooth` are.
    pub fn of(&self, tooth: usize) -> Range<usize> {
        tooth * self.nodes..(tooth + 1) * self.nodes
    }

    /// The rotor's underside, (x, height) \[m\], over one wavelength from half a groove before tooth 0 on.
    pub fn underside(&self, recording: &Recording) -> Vec<[f64; 2]> {
        let grooves = self.grooves(recording, GROOVE);
        let mut points = Vec::with_capacity(recording.teeth * (self.nodes + GROOVE) + 1);
        // The wave repeats.
        let before = grooves.last().into_iter().flatten().skip(GROOVE / 2);
        points.extend(before.map(|[x, height]| [x - recording.length, *height]));
        for (tooth, groove) in grooves.iter().enumerate() {
            let middle = tooth as f64 * recording.pitch;
            let height = |k: usize| self.stator[k] + self.film_thickness[k] - recording.touching.min_spacing;
            points.extend(recording.x.iter().zip(self.of(tooth)).map(|(xi, k)| [middle + xi, height(k)]));
            points.extend(groove.iter().take(if tooth + 1 == recording.teeth { GROOVE / 2 + 1 } else { GROOVE }));
        }
        points
    }

    /// The rotor's underside over the groove behind each tooth: `points` of (x, height) \[m\], evenly spaced from one
    /// tooth's edge to the next one's, the last ones beyond the wavelength.
    ///
    /// No load acts over the groove and there is no local deflection, so the height is z₀ + Σ (C_n − C_∞) q_n cos(k_n x − φ_n), with q_n
    /// the harmonics of contact and film. z₀ is fitted at the edges of the two teeth, where the height is known.
    pub fn grooves(&self, recording: &Recording, points: usize) -> Vec<Vec<[f64; 2]>> {
        let (teeth, length) = (recording.teeth, recording.length);
        let Some(reach) = recording.x.last().copied().filter(|_| length > 0.0) else { return vec![Vec::new(); teeth] };
        let wave = TAU / length;
        let rotor = &recording.rotor;
        let local = rotor.beyond(HARMONICS);
        let load = |k: usize| self.contact[k] + self.film[k];
        let at = |tooth: usize, i: usize| tooth as f64 * recording.pitch + recording.x[i];
        let mut harmonics = recording.harmonics(HARMONICS, |tooth, i| load(self.of(tooth).start + i));
        for (n, amplitude) in harmonics.iter_mut().enumerate() {
            let smooth = rotor.harmonic(n + 1) - local;
            *amplitude = amplitude.map(|q| smooth * q);
        }
        let mut smooth = |x: f64| {
            let mut sum = 0.0;
            turned(wave * x, &mut harmonics, |[a, b], cos, sin| sum += *a * cos + *b * sin);
            sum
        };
        let mut rest = |tooth: usize, i: usize| {
            let k = self.of(tooth).start + i;
            self.stator[k] + self.film_thickness[k]
                - recording.touching.min_spacing
                - local * load(k)
                - smooth(at(tooth, i))
        };
        let last = self.nodes - 1;
        let edges: Vec<[f64; 2]> = (0..teeth).map(|tooth| [rest(tooth, 0), rest(tooth, last)]).collect();
        let groove = |tooth: usize| {
            let [from, to] = [edges[tooth][1], edges[(tooth + 1) % teeth][0]];
            let share = |j: usize| j as f64 / (points.max(2) - 1) as f64;
            let x = |share: f64| tooth as f64 * recording.pitch + reach + share * (recording.pitch - 2.0 * reach);
            (0..points).map(share).map(|share| [x(share), smooth(x(share)) + from + share * (to - from)]).collect()
        };
        (0..teeth).map(groove).collect()
    }
}

/// Calls `each` with every harmonic, n = 1, 2, …, and cosine and sine of n times `angle`.
fn turned(angle: f64, harmonics: &mut [[f64; 2]], mut each: impl FnMut(&mut [f64; 2], f64, f64)) {
    let (sin, cos) = angle.sin_cos();
    let (mut c, mut s) = (1.0, 0.0);
    for harmonic in harmonics {
        (c, s) = (c * cos - s * sin, s * cos + c * sin);
        each(harmonic, c, s);
    }
}

impl Recording {
    /// Amplitudes of cosine and sine of the first `count` harmonics of a line load, in its unit, given at each node of each tooth.
    fn harmonics(&self, count: usize, load: impl Fn(usize, usize) -> f64) -> Vec<[f64; 2]> {
        let mut harmonics = vec![[0.0; 2]; count];
        for (tooth, i) in (0..self.teeth).flat_map(|tooth| (0..self.x.len()).map(move |i| (tooth, i))) {
            let force = load(tooth, i) * self.node_length[i] * 2.0 / self.length;
            turned(TAU / self.length * (tooth as f64 * self.pitch + self.x[i]), &mut harmonics, |[a, b], cos, sin| {
                *a += force * cos;
                *b += force * sin;
            });
        }
        harmonics
    }

    /// Adds to the errors of the least film thickness the rotor's deflection by the harmonics of the load that were left out, from number
    /// `first` up to twice that, or up to half a pitch if that is shorter.
    pub fn judge_short_waves(&mut self, first: usize) {
        let last = 2 * first.max(self.teeth);
        let limit = self.rotor.beyond(last);
        let smooth = |n: usize| if n < first { 0.0 } else { self.rotor.harmonic(n) - limit };
        let smooth: Vec<f64> = (1..=last).map(smooth).collect();
        for frame in 0..self.frames.min(self.min_film_thickness_error.len()) {
            let harmonics = self.harmonics(last, |tooth, i| {
                let k = self.line_offset(tooth, frame) + i;
                self.contact[k] + self.film[k]
            });
            let deflections = harmonics.iter().zip(&smooth).map(|([a, b], smooth)| smooth.abs() * a.hypot(*b));
            self.min_film_thickness_error[frame] += deflections.sum::<f64>();
        }
    }

    /// The same cycle at `frames` instants, evenly spaced from its first frame; between recorded frames read as [`Lines`] are. All teeth
    /// are stored, and no errors.
    pub fn resampled(&self, frames: usize) -> Self {
        let place = |frame: usize| (frame * self.frames) as f64 / frames.max(1) as f64;
        let lines: Vec<Lines> = (0..frames).map(|frame| Lines::at(self, place(frame))).collect();
        let field = |of: fn(&Lines) -> &[f64]| -> Vec<f64> {
            let teeth = 0..self.teeth;
            teeth
                .flat_map(|tooth| lines.iter().flat_map(move |lines| of(lines)[lines.of(tooth)].iter().copied()))
                .collect()
        };
        let mix = |values: &[f64], size: usize| -> Vec<f64> {
            if values.len() < self.frames * size {
                return Vec::new();
            }
            let at = |frame: usize, i: usize| {
                let Pair { first, second, weight } = Pair::at(self, place(frame));
                let [a, b] = [first, second].map(|frame| values[frame * size + i]);
                a + weight * (b - a)
            };
            (0..frames).flat_map(|frame| (0..size).map(move |i| (frame, i))).map(|(frame, i)| at(frame, i)).collect()
        };
        let touch = (0..frames).filter_map(|frame| self.teeth_in_contact.get(place(frame) as usize).copied());
        Self {
            lines: LineLoads {
                frames,
                length: self.length,
                teeth: self.teeth,
                stored_teeth: self.teeth,
                pitch: self.pitch,
                x: self.x.clone(),
                node_length: self.node_length.clone(),
                radial: self.radial,
                touching_from: self.touching_from,
                contact: field(|lines| &lines.contact),
                film: field(|lines| &lines.film),
                film_thickness: field(|lines| &lines.film_thickness),
                ..LineLoads::default()
            },
            stator: field(|lines| &lines.stator),
            pressure: mix(&self.pressure, self.map_x.len() * self.map_y.len()),
            film_load: mix(&self.film_load, 1),
            contact_load: mix(&self.contact_load, 1),
            min_film_thickness: mix(&self.min_film_thickness, 1),
            max_pressure: mix(&self.max_pressure, 1),
            teeth_in_contact: touch.collect(),
            touching: self.touching,
            rotor: self.rotor.clone(),
            period: self.period,
            transient: self.transient,
            map_x: self.map_x.clone(),
            map_y: self.map_y.clone(),
            half_width: self.half_width,
            half_length: self.half_length,
            ..Self::default()
        }
    }
}

/// Adds the pressures along y at `xi` from the middle of `tooth` to `out`, cleared first; false beside the tooth.
pub fn column(recording: &Recording, tooth: usize, xi: f64, place: f64, out: &mut [f64]) -> bool {
    out.fill(0.0);
    let Pair { first, second, weight } =
        if recording.transient { Pair::at(recording, place) } else { Pair::lagged(recording, tooth, place) };
    let Some(plane) = Plane::of(recording, tooth, first) else { return false };
    if !plane.column(xi, 1.0 - weight, out) {
        return false;
    }
    if weight > 0.0
        && let Some(next) = Plane::of(recording, tooth, second)
    {
        next.column(xi, weight, out);
    }
    true
}

/// Pressure \[Pa\] at y = 0.
pub fn middle_pressure(recording: &Recording, tooth: usize, xi: f64, place: f64) -> Option<f64> {
    let row = Plane::of(recording, 0, 0)?.row(0.0)?;
    let mut values = vec![0.0; recording.map_y.len()];
    column(recording, tooth, xi, place, &mut values).then(|| between(&values, row))
}

/// How pressure grows along x at y = 0 \[Pa/m\], of second order between nodes.
pub fn middle_gradient(recording: &Recording, tooth: usize, xi: f64, place: f64) -> Option<f64> {
    let nodes = &recording.map_x;
    let at = |i: usize| Some([*nodes.get(i)?, middle_pressure(recording, tooth, nodes[i], place)?]);
    // At a node: the slopes on both sides, each weighed by the length of the other; at an end the one that there is.
    let slope = |i: usize| {
        let [x, p] = at(i)?;
        let before = i.checked_sub(1).and_then(at);
        let side = |end: [f64; 2]| (end[0] - x, (end[1] - p) / (end[0] - x));
        match (before.map(side), at(i + 1).map(side)) {
            // In the middle of a plate of which half is stored; the rim of a ring's hole is an end.
            (None, Some(_)) if recording.half_length && x == 0.0 => Some(0.0),
            (Some((back, a)), Some((ahead, b))) => Some((ahead * a - back * b) / (ahead - back)),
            (one, other) => one.or(other).map(|(_, slope)| slope),
        }
    };
    let mirrored = recording.half_length && xi < 0.0;
    let (left, weight) = locate(nodes, if mirrored { -xi } else { xi })?;
    let from = slope(left)?;
    let found = if weight > 0.0 { from + weight * (slope(left + 1)? - from) } else { from };
    Some(if mirrored { -found } else { found })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_function_is_read_exactly_on_a_graded_grid() {
        let nodes = [-1.0, -0.9, -0.2, 0.5, 0.95, 1.0];
        let values: Vec<f64> = nodes.iter().map(|x| 3.0 - 2.0 * x).collect();
        for i in 0..=40 {
            let x = -1.0 + 0.05 * f64::from(i);
            let place = locate(&nodes, x).unwrap();
            assert!((between(&values, place) - (3.0 - 2.0 * x)).abs() < 1e-12, "{x}");
        }
        assert_eq!(locate(&nodes, 1.01), None);
        assert_eq!(locate(&nodes, -1.01), None);
        assert_eq!(locate(&nodes, f64::NAN), None);
        assert_eq!(locate(&[], 0.0), None);
        assert_eq!(locate(&[0.0], 0.0), Some((0, 0.0)));
    }

    #[test]
    fn a_tooth_is_hit_within_its_pitch() {
        assert_eq!(tooth_at(0.4, 1.0, 9).0, 0);
        assert_eq!(tooth_at(-0.5, 1.0, 9).0, 0);
        let (tooth, xi) = tooth_at(3.25, 1.0, 9);
        assert_eq!(tooth, 3);
        assert!((xi - 0.25).abs() < 1e-12);
        assert_eq!(tooth_at(8.6, 1.0, 9).0, 8);
        assert_eq!(tooth_at(5.0, 10.0, 1), (0, 5.0));
        assert_eq!(tooth_at(1.0, 0.0, 0), (0, 1.0));
    }

    fn recording(frames: usize, teeth: usize, half: bool) -> Recording {
        let map_x = if half { vec![0.0, 0.3, 1.0] } else { vec![-1.0, 0.0, 1.0] };
        let map_y = vec![0.0, 0.7, 1.0];
        let mut pressure = Vec::new();
        for frame in 0..frames {
            for x in &map_x {
                pressure.extend(map_y.iter().map(|y| frame as f64 + 10.0 * x + 100.0 * y));
            }
        }
        let lines = LineLoads { frames, teeth, ..LineLoads::default() };
        Recording { lines, map_x, map_y, pressure, half_width: true, half_length: half, ..Recording::default() }
    }

    #[test]
    fn a_parabola_has_its_slope_at_every_node_and_between_them() {
        let of = |x: f64| 2.0 + 3.0 * x - 4.0 * x * x;
        let map = |map_x: Vec<f64>, half_length: bool| Recording {
            lines: LineLoads { frames: 1, teeth: 1, ..LineLoads::default() },
            pressure: map_x.iter().map(|x| if half_length { of(*x) - 3.0 * x } else { of(*x) }).collect(),
            map_x,
            map_y: vec![0.0],
            half_length,
            ..Recording::default()
        };
        let whole = map(vec![-1.0, -0.7, 0.1, 0.6, 1.0], false);
        for x in [-0.7, -0.3, 0.1, 0.33, 0.6] {
            let found = middle_gradient(&whole, 0, x, 0.0).unwrap();
            assert!((found - (3.0 - 8.0 * x)).abs() < 1e-12, "{x}: {found}");
        }
        assert_eq!(middle_gradient(&whole, 0, 1.1, 0.0), None);
        let half = map(vec![0.0, 0.2, 0.6, 1.0], true);
        for x in [-0.6, -0.1, 0.0, 0.1, 0.4] {
            let found = middle_gradient(&half, 0, x, 0.0).unwrap();
            assert!((found + 8.0 * x).abs() < 1e-12, "{x}: {found}");
        }
        // Half of a ring begins at the rim of its hole, where pressure falls as it does beside it.
        let ring = map(vec![0.5, 0.6, 0.8, 1.0], true);
        let [rim, beside] = [0.5, 0.55].map(|x| middle_gradient(&ring, 0, x, 0.0).unwrap());
        assert!((rim + 4.4).abs() < 1e-12 && beside < -4.4, "{rim} {beside}");
    }

    #[test]
    fn half_maps_are_mirrored() {
        let plate = recording(1, 1, true);
        let plane = Plane::of(&plate, 0, 0).unwrap();
        let (mut left, mut right) = (vec![0.0; 3], vec![0.0; 3]);
        assert!(plane.column(-0.6, 1.0, &mut left) && plane.column(0.6, 1.0, &mut right));
        assert_eq!(left, right);
        assert!((between(&left, plane.row(-0.5).unwrap()) - 56.0).abs() < 1e-9);
        assert_eq!(plane.row(-0.5), plane.row(0.5));
    }

    #[test]
    fn other_teeth_are_read_with_their_lag() {
        let motor = recording(8, 4, false);
        assert_eq!(Pair::lagged(&motor, 3, 4.0), Pair { first: 2, second: 3, weight: 0.0 });
        assert_eq!(middle_pressure(&motor, 3, 0.5, 4.0), Some(7.0));
        assert_eq!(middle_pressure(&motor, 3, 1.5, 4.0), None);
        // 6 frames, 4 teeth: tooth 1 is a frame and a half ahead.
        let uneven = recording(6, 4, false);
        assert_eq!(Pair::lagged(&uneven, 1, 0.0), Pair { first: 1, second: 2, weight: 0.5 });
        assert_eq!(middle_pressure(&uneven, 1, 0.0, 0.0), Some(1.5));
        assert_eq!(middle_pressure(&uneven, 1, 0.0, 0.25), Some(1.75));
        // Between the last frame, 5, and the first.
        assert_eq!(middle_pressure(&uneven, 0, 0.0, 5.25), Some(3.75));
        assert_eq!(middle_pressure(&Recording::default(), 0, 0.0, 0.0), None);
    }

    /// A wave that passes three teeth in six frames: all teeth stored, or one and its lag.
    fn passing(stored_teeth: usize, frames: usize) -> Recording {
        let teeth = 3;
        let line = |tooth: usize, frame: usize| {
            let phase = (frame as f64 / frames as f64 + tooth as f64 / 3.0).rem_euclid(1.0);
            let wave = (std::f64::consts::TAU * phase).sin();
            [(wave, 10.0 * wave), (2.0 * wave, 20.0 * wave)]
        };
        let lines = || (0..stored_teeth).flat_map(|t| (0..frames).flat_map(move |m| line(t, m)));
        let stator = lines().map(|(wave, _)| -wave).collect();
        let lines = LineLoads {
            frames,
            teeth,
            stored_teeth,
            x: vec![-1.0, 1.0],
            film_thickness: lines().map(|(wave, _)| 0.5 + wave.max(0.0)).collect(),
            contact: lines().map(|(_, load)| (-load).max(0.0)).collect(),
            film: lines().map(|(_, load)| load).collect(),
            ..LineLoads::default()
        };
        let touching = Touching { min_spacing: 0.5, compliance: 0.1 };
        Recording { lines, stator, touching, ..Recording::default() }
    }

    #[test]
    fn a_recorded_frame_is_read_as_it_is() {
        let recording = passing(1, 6);
        let lines = Lines::at(&recording, 2.0);
        for tooth in 0..3 {
            let offset = recording.line_offset(tooth, 2);
            assert_eq!(lines.film_thickness[lines.of(tooth)], recording.film_thickness[offset..offset + 2]);
            assert_eq!(lines.contact[lines.of(tooth)], recording.contact[offset..offset + 2]);
        }
    }

    #[test]
    fn between_frames_one_tooth_and_its_lag_are_what_all_teeth_stored_are() {
        let (one, all) = (passing(1, 6), passing(3, 6));
        for place in [0.0, 0.3, 2.5, 5.9] {
            let (a, b) = (Lines::at(&one, place), Lines::at(&all, place));
            for (left, right) in [(&a.film_thickness, &b.film_thickness), (&a.contact, &b.contact), (&a.film, &b.film)]
            {
                assert_eq!(left.len(), 6);
                assert!(left.iter().zip(right).all(|(x, y)| (x - y).abs() < 1e-12), "{place}: {left:?} {right:?}");
            }
        }
        // Frames that the teeth do not divide: tooth 1 lies between two frames where tooth 0 lies on one.
        let uneven = passing(1, 7);
        let (place, lag) = (2.0, 7.0 / 3.0);
        let (here, ahead) = (Lines::at(&uneven, place), Lines::at(&uneven, place + lag));
        assert!(here.film[here.of(1)].iter().zip(&ahead.film[ahead.of(0)]).all(|(x, y)| (x - y).abs() < 1e-12));
    }

    #[test]
    fn a_cycle_is_read_at_other_instants_with_every_recorded_one_as_it_was() {
        let mut recording = passing(1, 6);
        (recording.lines.radial, recording.lines.touching_from) = (true, 0.25);
        let finer = recording.resampled(24);
        assert_eq!((finer.frames, finer.stored_teeth, finer.film.len()), (24, 3, 3 * 24 * 2));
        assert_eq!((finer.radial, finer.touching_from), (true, 0.25));
        for (tooth, frame) in [(0, 0), (1, 2), (2, 5)] {
            let (a, b) = (recording.line_offset(tooth, frame), finer.line_offset(tooth, 4 * frame));
            assert_eq!(recording.film[a..a + 2], finer.film[b..b + 2]);
            assert_eq!(recording.contact[a..a + 2], finer.contact[b..b + 2]);
        }
        let between = Lines::at(&recording, 2.25);
        let at = finer.line_offset(1, 9);
        assert_eq!(finer.film_thickness[at..at + 2], between.film_thickness[between.of(1)]);
        let map = self::recording(4, 1, true);
        let finer = map.resampled(8);
        let middle = |map: &Recording, frame: usize| Plane::of(map, 0, frame).unwrap().values[4];
        assert_eq!(middle(&finer, 4), middle(&map, 2));
        assert_eq!(middle(&finer, 3), 0.5 * (middle(&map, 1) + middle(&map, 2)));
    }

    #[test]
    fn a_transient_does_not_run_back_into_its_beginning() {
        let repeating = passing(3, 6);
        let once = Recording { transient: true, ..repeating.clone() };
        let film = |recording: &Recording, place: f64| Lines::at(recording, place).film;
        assert_eq!(film(&once, 5.7), film(&once, 5.0));
        assert_ne!(film(&repeating, 5.7), film(&repeating, 5.0));
        assert_eq!(film(&once, 2.5), film(&repeating, 2.5));
        // Other teeth are not tooth 0 at another time: they have maps of their own.
        let map = recording(8, 4, false);
        let others = (1..4).flat_map(|tooth| map.pressure.iter().map(move |p| p + 1000.0 * f64::from(tooth))).collect();
        let map = Recording { transient: true, other_pressure: others, ..map.clone() };
        assert_eq!(middle_pressure(&map, 0, 0.5, 4.0), Some(9.0));
        assert_eq!(middle_pressure(&map, 3, 0.5, 4.5), Some(3009.5));
        assert_eq!(middle_pressure(&map, 3, 0.5, 7.5), Some(3012.0));
    }

    #[test]
    fn contact_and_gap_exclude_each_other_between_frames_too() {
        let recording = passing(1, 6);
        let (mut opened, mut before) = (0, Lines::at(&recording, 0.0));
        for step in 0..=600 {
            let lines = Lines::at(&recording, f64::from(step) / 100.0);
            for (i, (thickness, contact)) in lines.film_thickness.iter().zip(&lines.contact).enumerate() {
                let gap = thickness - 0.5;
                assert!(gap >= -1e-12 && *contact >= 0.0);
                assert!(gap.abs() < 1e-12 || *contact == 0.0, "step {step}, node {i}: gap {gap}, contact {contact}");
                opened += usize::from(*contact > 0.0) ^ usize::from(before.contact[i] > 0.0);
                // Nothing jumps: over a hundredth of a frame, at most what the steepest frame changes.
                assert!((gap - (before.film_thickness[i] - 0.5)).abs() < 0.05, "step {step}");
                assert!((contact - before.contact[i]).abs() < 0.5, "step {step}");
            }
            before = lines;
        }
        // Every node of every tooth opens once and closes once.
        assert_eq!(opened, 12);
        // Nodes that pass on which side they are at the second frame exactly, and values that exclude nothing.
        assert_eq!(recording.touching.between([0.0, 2.0], [0.0, 0.0], 1.0), [0.0, 0.0]);
        assert_eq!(Touching::default().between([0.1, 0.0], [0.3, 0.0], 0.5), [0.2, 0.0]);
    }
}
