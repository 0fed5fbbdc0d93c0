//! Fields of one cycle: plain data for views and exports.

mod extrapolated;
pub mod sample;

pub use extrapolated::Balance;

use crate::estimate::{Estimate, judged};
use crate::rotor::Compliances;
use serde::{Deserialize, Serialize};
use std::ops::{Deref, DerefMut};

/// Error of a greatest pressure, over that of a mean with the same changes from grid to grid: the maximum is where contact begins, or
/// between nodes, and converges with first order only.
const PEAK: f64 = 8.0;
/// The same for a least film thickness: on asperities faces are closest at the edge of a tooth, where the load is steepest.
const ROUGH: f64 = 16.0;
/// How far a parabola goes beyond its values at nodes or frames, in units of its departure from the chord of the two beside.
const BETWEEN: f64 = 0.25;
/// Least error of a series at any instant, as a fraction of the mean of its errors.
const SHARE_OF_MEAN: f64 = 0.3;

/// Fields of one cycle of the periodic state, every array flat and in SI units: its [`LineLoads`], to which it dereferences, and
/// what belongs to them.
///
/// Frame `m` is at t = m T/frames. Lines are stored `[tooth][frame][node]` for `stored_teeth` teeth: with lag
/// symmetry one tooth is stored, and tooth k at frame m is tooth 0 at frame m + k·frames/teeth (the wave travels
/// towards −x). The pressure map is tooth 0's, `[frame][ix][iy]`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Recording {
    /// Grid, contact, film and film thickness, without `peak` and `ambient`.
    pub lines: LineLoads,
    /// How contact and gap exclude each other.
    pub touching: Touching,
    /// The rotor; a plate has none.
    pub rotor: Compliances,
    /// Period \[s\].
    pub period: f64,
    /// Whether this is a cycle of a transient: it is followed by a different cycle, and a tooth is not another tooth at another time.
    pub transient: bool,
    /// Bound, relative to the film's mean load, of the terms that the scene's switches leave out; no grid shows it.
    pub forced: f64,
    /// Relative error of the film's mean load due to missing nodes across; no grid shows it.
    pub across: f64,
    /// Stator's normal displacement W_S \[m\], `[tooth][frame][node]` as the lines (zero for a plate).
    pub stator: Vec<f64>,
    /// x of the pressure map, from the middle of tooth or plate \[m\]; of a round plate the radius \[m\].
    pub map_x: Vec<f64>,
    /// y of the pressure map, from the middle of the width \[m\]; only y ≥ 0 when `half_width`; `[0]` for a strip and a round plate.
    pub map_y: Vec<f64>,
    /// The map covers y ≥ 0 only.
    pub half_width: bool,
    /// The map covers x ≥ 0 only (a plate).
    pub half_length: bool,
    /// Absolute pressure \[Pa\], `[frame][ix][iy]`.
    pub pressure: Vec<f64>,
    /// Of a transient: the same of the other teeth, `[tooth − 1][frame][ix][iy]`.
    pub other_pressure: Vec<f64>,
    /// Per frame: film load on one wavelength or the plate \[N; of a strip N/m\].
    pub film_load: Vec<f64>,
    /// Per frame: contact load \[N\].
    pub contact_load: Vec<f64>,
    /// Per frame: teeth that touch.
    pub teeth_in_contact: Vec<usize>,
    /// Per frame: least film thickness \[m\].
    pub min_film_thickness: Vec<f64>,
    /// Per frame: greatest pressure on any tooth \[Pa\].
    pub max_pressure: Vec<f64>,
    /// Estimated numerical error of `film_load`, absolute \[N; of a strip N/m\], a value each frame. This and the two below are empty where
    /// not known.
    pub film_load_error: Vec<f64>,
    /// Of `min_film_thickness` \[m\].
    pub min_film_thickness_error: Vec<f64>,
    /// Of `max_pressure` \[Pa\].
    pub max_pressure_error: Vec<f64>,
    /// References for the error of the lines of this recording ([`Recording::estimate`]): those extrapolated from the two coarser grids, and
    /// those of the finest grid as it was solved. Empty if there were not three grids.
    pub yardsticks: Vec<LineLoads>,
}

/// How contact and gap exclude each other between two frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Touching {
    /// Film thickness where the gap is closed \[m\].
    pub min_spacing: f64,
    /// Local compliance of the rotor \[m²/N\].
    pub compliance: f64,
}

/// Film, contact and gap of one cycle on one grid, in the conventions of [`Recording`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LineLoads {
    /// Frames in the cycle.
    pub frames: usize,
    /// Length along x of one period of the scene: the wavelength, or the plate's length \[m\].
    pub length: f64,
    /// Teeth in a wavelength (1 for a plate).
    pub teeth: usize,
    /// Teeth stored: 1 (lag symmetry) or `teeth`.
    pub stored_teeth: usize,
    /// Pitch of the teeth \[m\].
    pub pitch: f64,
    /// Node positions from the tooth's middle \[m\], ascending, `nodes`.
    pub x: Vec<f64>,
    /// Length of tooth that each node stands for \[m\], `nodes`: forces are line load × length. Of a round plate, area \[m²\].
    pub node_length: Vec<f64>,
    /// Nodes are along the radius of a round plate, and its film is gauge pressure \[Pa\], as that of a strip.
    pub radial: bool,
    /// Contact line load \[N/m\] above which a node counts as touching: 0 where contact and gap exclude each other.
    pub touching_from: f64,
    /// Contact line load \[N/m\], `[tooth][frame][node]` over the stored teeth.
    pub contact: Vec<f64>,
    /// Film's net gauge line load \[N/m\], likewise (of a strip: gauge pressure × 1 m of width); zero without film.
    pub film: Vec<f64>,
    /// Film thickness h \[m\], likewise: gap + H_m, or over asperities the mean gap; empty without film.
    pub film_thickness: Vec<f64>,
    /// Greatest pressure across the width \[Pa\], likewise; empty without film.
    pub peak: Vec<f64>,
    /// Ambient pressure × width of the film whose pressure is unknown \[N/m\], `nodes`; empty without film.
    pub ambient: Vec<f64>,
}

impl Deref for Recording {
    type Target = LineLoads;

    fn deref(&self) -> &LineLoads {
        &self.lines
    }
}

impl DerefMut for Recording {
    fn deref_mut(&mut self) -> &mut LineLoads {
        &mut self.lines
    }
}

impl Recording {
    /// `value` of the lines, with an error from the same value of the `yardsticks`; infinite if there are none.
    pub fn estimate(&self, value: impl Fn(&LineLoads) -> f64) -> Estimate {
        let found = value(&self.lines);
        match &self.yardsticks[..] {
            [before, finest] => judged(found, value(before), value(finest)),
            _ => Estimate { value: found, error: f64::INFINITY },
        }
    }

    /// Errors of the series, frame by frame: that of the fields there, from what they are judged by, and what no grid shows, the relative errors
    /// `of_gas`, the gas's force, and `of_pressure`, the highest one. `uneven`: error of the load at an instant over that of a mean which differs
    /// as much from grid to grid, and has more to even out.
    pub fn judge_series(&mut self, of_gas: f64, of_pressure: f64, uneven: f64) {
        let [before, finest] = &self.yardsticks[..] else { return };
        type Series = fn(&LineLoads) -> Vec<f64>;
        let errors = |found: &[f64], series: Series, factor: f64, everywhere: &dyn Fn(f64) -> f64| {
            let (coarse, fine) = (series(before), series(finest));
            let frames = found.len();
            let at = |frame: usize| factor * judged(found[frame], coarse[frame / 2], fine[frame]).error;
            let whole: Vec<f64> = (0..frames).map(|frame| at(frame / 2 * 2)).collect();
            let mean = whole.iter().sum::<f64>() / frames.max(1) as f64;
            // Between two instants with an error estimate the greater of their errors counts, and everywhere at least a fraction of the
            // mean.
            let near = |frame: usize| whole[frame].max(whole[(frame + 1) % frames]).max(SHARE_OF_MEAN * mean);
            (0..frames).map(|frame| near(frame) + everywhere(found[frame])).collect::<Vec<f64>>()
        };
        let ambient: f64 = finest.ambient.iter().zip(&finest.node_length).map(|(force, length)| force * length).sum();
        let gas = ambient * self.teeth as f64;
        self.film_load_error = errors(&self.film_load, LineLoads::film_loads, uneven, &|load| of_gas * (gas + load));
        self.max_pressure_error = errors(&self.max_pressure, LineLoads::max_pressures, PEAK, &|p| of_pressure * p);
        let factor = if self.touching_from > 0.0 { ROUGH } else { 1.0 };
        let forced = self.forced.min(1.0);
        let judged = errors(&self.min_film_thickness, LineLoads::min_film_thicknesses, factor, &|h| forced * h);
        let between = self.lines.thinner_between_nodes(self.touching.min_spacing);
        self.min_film_thickness_error =
            judged.into_iter().zip(between).map(|(error, between)| error.max(between)).collect();
    }

    /// An extreme of a series, limited by `bound`. Its error is the largest of its differences to the yardsticks, and of the amounts by
    /// which any instant, with the error of the series there, may exceed it.
    pub fn extreme(
        &self,
        series: impl Fn(&LineLoads) -> Vec<f64>,
        found: &[f64],
        errors: &[f64],
        greater: fn(f64, f64) -> f64,
        bound: f64,
    ) -> Estimate {
        let extreme = |values: &[f64]| values.iter().copied().reduce(greater).unwrap_or(0.0);
        let value = extreme(found);
        // Of a parabola, what a frame beside its vertex misses is at most a quarter of the departure from the chord of its neighbours.
        let frames = found.len();
        let missed = found.iter().position(|at| *at == value).map_or(0.0, |frame| {
            let chord = 0.5 * (found[(frame + 1) % frames] + found[(frame + frames - 1) % frames]);
            BETWEEN * (chord - value).abs()
        });
        let [before, finest] = &self.yardsticks[..] else { return Estimate { value, error: f64::INFINITY } };
        let beyond = found.iter().zip(errors).map(|(found, error)| error - (value - found).abs()).fold(0.0, f64::max);
        // Extremes between two frames: the change from twice the steps counts in full.
        let off = |grid| (value - extreme(&series(grid))).abs();
        Estimate { value, error: beyond.max(missed).min((bound - value).abs()).max(off(before)).max(off(finest)) }
    }

    /// By how many the teeth in contact may be wrong, a value each frame: as many as the lines differ by from their yardsticks, then and a
    /// frame before and after, since when a tooth begins to touch is known to a frame; or those whose film would be at most `touching` thick
    /// \[m\] if it were thinner by its error. Empty without yardsticks.
    pub fn touching_errors(&self, touching: f64) -> Vec<f64> {
        let counts: Vec<_> = self.yardsticks.iter().map(LineLoads::touching_teeth).collect();
        let frames = if counts.is_empty() { 0 } else { self.frames };
        let off = |frame: usize| {
            let teeth = self.teeth_in_contact[frame];
            let near = [frame + frames - 1, frame, frame + 1].map(|frame| frame % frames);
            let own = near.into_iter().map(|frame| self.teeth_in_contact[frame]);
            let others = counts.iter().flat_map(|counts| near.map(|frame| counts[frame * counts.len() / frames]));
            let differs = own.chain(others).map(|other| other.abs_diff(teeth)).max().unwrap_or(0);
            let error = self.min_film_thickness_error.get(frame).copied().unwrap_or(0.0);
            let nearly = self.thinnest(frame).filter(|thickness| thickness - error <= touching).count();
            differs.max(nearly.saturating_sub(teeth)) as f64
        };
        (0..frames).map(off).collect()
    }

    /// Time of a frame \[s\].
    pub fn time(&self, frame: usize) -> f64 {
        self.period * frame as f64 / self.frames as f64
    }
}
