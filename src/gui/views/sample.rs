//! Reading values between nodes: no drawing in here.

use crate::recording::Recording;

/// Interval of ascending `nodes` around `x` and the weight of its right end; `None` outside. Rounding at either end
/// is forgiven.
pub(super) fn locate(nodes: &[f64], x: f64) -> Option<(usize, f64)> {
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
pub(super) fn between(values: &[f64], (left, weight): (usize, f64)) -> f64 {
    let value = values[left];
    if weight > 0.0 { value + weight * (values[left + 1] - value) } else { value }
}

/// Tooth whose pitch holds `x`, and `x` from that tooth's middle. Tooth 0 is centred at 0; beyond either end the outermost.
pub(super) fn tooth_at(x: f64, pitch: f64, teeth: usize) -> (usize, f64) {
    if pitch <= 0.0 || teeth == 0 {
        return (0, x);
    }
    let tooth = (x / pitch).round().clamp(0.0, (teeth - 1) as f64) as usize;
    (tooth, x - tooth as f64 * pitch)
}

/// One plane of pressure as stored, with its mirror planes.
pub(super) struct Plane<'a> {
    pub(super) x: &'a [f64],
    pub(super) y: &'a [f64],
    /// `[ix][iy]`.
    pub(super) values: &'a [f64],
    pub(super) mirror_x: bool,
    pub(super) mirror_y: bool,
}

impl<'a> Plane<'a> {
    /// The map of `frame`; `None` if the recording has none.
    pub(super) fn of(recording: &'a Recording, frame: usize) -> Option<Self> {
        let size = recording.map_x.len() * recording.map_y.len();
        let values = recording.pressure.get(frame * size..(frame + 1) * size)?;
        (size > 0).then_some(Self {
            x: &recording.map_x,
            y: &recording.map_y,
            values,
            mirror_x: recording.half_length,
            mirror_y: recording.half_width,
        })
    }

    /// Adds `share` times the values along y at `x` to `out` (one for each stored y); false outside.
    pub(super) fn column(&self, x: f64, share: f64, out: &mut [f64]) -> bool {
        let x = if self.mirror_x { x.abs() } else { x };
        let Some((left, weight)) = locate(self.x, x) else { return false };
        let ny = self.y.len();
        let near = &self.values[left * ny..(left + 1) * ny];
        let far = if weight > 0.0 { &self.values[(left + 1) * ny..(left + 2) * ny] } else { near };
        for ((out, near), far) in out.iter_mut().zip(near).zip(far) {
            *out += share * (near + weight * (far - near));
        }
        true
    }

    /// Where `y` lies in a column.
    pub(super) fn row(&self, y: f64) -> Option<(usize, f64)> {
        locate(self.y, if self.mirror_y { y.abs() } else { y })
    }
}

/// Greatest y of the full map \[m\]; 0 for a strip.
pub(super) fn half_width(recording: &Recording) -> f64 {
    recording.map_y.last().copied().unwrap_or(0.0)
}

/// The frame that shows tooth `tooth` in tooth 0's map, and the weight of the frame after it.
pub(super) fn lagged(recording: &Recording, tooth: usize, frame: usize) -> (usize, f64) {
    let (frames, teeth) = (recording.frames.max(1), recording.teeth.max(1));
    let shift = tooth * frames;
    ((frame + shift / teeth) % frames, (shift % teeth) as f64 / teeth as f64)
}

/// Adds the pressures along y at `xi` from the middle of `tooth` to `out`, cleared first; false beside the tooth.
pub(super) fn column(recording: &Recording, tooth: usize, xi: f64, frame: usize, out: &mut [f64]) -> bool {
    out.fill(0.0);
    let (frame, weight) = lagged(recording, tooth, frame);
    let Some(plane) = Plane::of(recording, frame) else { return false };
    if !plane.column(xi, 1.0 - weight, out) {
        return false;
    }
    if weight > 0.0
        && let Some(next) = Plane::of(recording, (frame + 1) % recording.frames)
    {
        next.column(xi, weight, out);
    }
    true
}

/// Pressure \[Pa\] at y = 0.
pub(super) fn middle_pressure(recording: &Recording, tooth: usize, xi: f64, frame: usize) -> Option<f64> {
    let row = Plane::of(recording, 0)?.row(0.0)?;
    let mut values = vec![0.0; recording.map_y.len()];
    column(recording, tooth, xi, frame, &mut values).then(|| between(&values, row))
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
        Recording { frames, teeth, map_x, map_y, pressure, half_width: true, half_length: half, ..Recording::default() }
    }

    #[test]
    fn half_maps_are_mirrored() {
        let plate = recording(1, 1, true);
        let plane = Plane::of(&plate, 0).unwrap();
        let (mut left, mut right) = (vec![0.0; 3], vec![0.0; 3]);
        assert!(plane.column(-0.6, 1.0, &mut left) && plane.column(0.6, 1.0, &mut right));
        assert_eq!(left, right);
        assert!((between(&left, plane.row(-0.5).unwrap()) - 56.0).abs() < 1e-9);
        assert_eq!(plane.row(-0.5), plane.row(0.5));
    }

    #[test]
    fn other_teeth_are_read_with_their_lag() {
        let motor = recording(8, 4, false);
        assert_eq!(lagged(&motor, 3, 4), (2, 0.0));
        assert_eq!(middle_pressure(&motor, 3, 0.5, 4), Some(7.0));
        assert_eq!(middle_pressure(&motor, 3, 1.5, 4), None);
        // 6 frames, 4 teeth: tooth 1 is a frame and a half ahead.
        let uneven = recording(6, 4, false);
        assert_eq!(lagged(&uneven, 1, 0), (1, 0.5));
        assert_eq!(middle_pressure(&uneven, 1, 0.0, 0), Some(1.5));
        assert_eq!(middle_pressure(&Recording::default(), 0, 0.0, 0), None);
    }
}
