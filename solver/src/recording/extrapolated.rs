//! The lines of a cycle extrapolated to zero spacing, point by point, from two grids one of which has half the intervals and steps.
//!
//! Every coarse step coincides with a fine one. Loads are compared cell by cell: a coarse cell consists of the fine cell of the same node
//! and half of its two neighbours. A third of the difference is the error of the fine cells, at second order. It is spread over them
//! evenly; at the instants between two coarse steps, the mean of the two corrections is used. The total load is extrapolated in the same
//! way, so film and contact together keep the load balance of the grids at every instant. Physical constraints are kept: contact never
//! pulls and acts only where it does on the fine grid; there the gap is closed, and it is nowhere less than closed; absolute pressure stays
//! positive. The balance that this disturbs is restored at the end, by the contact load or, where there is none, by the film's.

use super::{BETWEEN, LineLoads, Recording};
use std::ops::{Add, Range};

/// Constraints that the lines of a scene obey: balance of load, and contact only where the gap is closed.
#[derive(Clone, Copy, Debug)]
pub struct Balance {
    /// Load L that film and contact carry at each instant \[N\]; `None` for a plate, which is held.
    pub load: Option<f64>,
    /// Least film thickness \[m\].
    pub min_spacing: f64,
    /// Whether there is no contact load where the gap is open. (On asperities there is.)
    pub exclusive: bool,
}

/// Least share of the load on asperities for them to take what extrapolation leaves of the balance.
const LEAST_HELD: f64 = 1e-3;
/// How much thinner than at any node a film may be, in units of its departure there from the chord of its neighbours, at the edge of a tooth:
/// where faces on asperities come closest, it changes faster than nodes follow.
const AT_EDGE: f64 = 0.6;
/// Largest factor by which extrapolation changes an absolute pressure.
const LARGEST_FACTOR: f64 = 2.0;

impl LineLoads {
    /// Offset of tooth `tooth`, frame `frame`; `nodes` = `x.len()` values follow it.
    pub fn line_offset(&self, tooth: usize, frame: usize) -> usize {
        self.line(tooth, frame) * self.x.len()
    }

    /// Which of the lines it is.
    fn line(&self, tooth: usize, frame: usize) -> usize {
        if self.stored_teeth == self.teeth {
            tooth * self.frames + frame
        } else {
            (frame + tooth * self.frames / self.teeth) % self.frames
        }
    }

    /// This grid's lines less what the `coarse` one shows to be missing still.
    pub fn extrapolated(&self, coarse: &LineLoads, balance: &Balance) -> LineLoads {
        let (nodes, few) = (self.x.len(), coarse.x.len());
        let mut out = self.clone();
        let mut missing = Missing::new(self, coarse);
        for tooth in 0..self.stored_teeth {
            for frame in 0..self.frames {
                let line = (tooth * self.frames + frame) * nodes;
                missing.at(tooth, frame);
                for i in 0..nodes {
                    let (low, high) = (i / 2, (i.div_ceil(2)).min(few - 1));
                    let between = |values: &[f64]| 0.5 * (values[low] + values[high]);
                    let k = line + i;
                    out.film[k] = self.film[k] + between(&missing.film);
                    let (thick, touching) = (self.film_thickness[k], self.contact[k] > 0.0);
                    if touching {
                        out.contact[k] = (self.contact[k] + between(&missing.contact)).max(0.0);
                    }
                    if !touching || !balance.exclusive {
                        let thicker = (thick + between(&missing.thickness)).max(0.5 * thick);
                        out.film_thickness[k] = thicker.max(balance.min_spacing);
                    }
                    if self.ambient[i] > 0.0 {
                        let absolute = self.film[k] + self.ambient[i];
                        let factor = (out.film[k] + self.ambient[i]) / absolute;
                        let factor = factor.clamp(1.0 / LARGEST_FACTOR, LARGEST_FACTOR);
                        out.film[k] = factor * absolute - self.ambient[i];
                    }
                }
            }
        }
        if let Some(load) = balance.load {
            out.restore(load, balance);
        }
        for (line, peak) in out.peak.chunks_exact_mut(nodes).enumerate() {
            for (i, peak) in peak.iter_mut().enumerate().filter(|(i, _)| self.ambient[*i] > 0.0) {
                let k = line * nodes + i;
                *peak *= (out.film[k] + self.ambient[i]) / (self.film[k] + self.ambient[i]);
            }
        }
        out
    }

    /// Makes film and contact carry `load` at every instant.
    fn restore(&mut self, load: f64, balance: &Balance) {
        // Asperities out of reach still carry something, and not what the balance lacks.
        let (least, kept) = if balance.exclusive { (0.0, 0.0) } else { (LEAST_HELD * load, 1.0) };
        let nodes = self.x.len();
        let instants = self.frames * self.stored_teeth / self.teeth;
        for frame in 0..instants {
            let lines: Vec<usize> = (0..self.teeth).map(|tooth| self.line_offset(tooth, frame)).collect();
            let (mut film, mut contact, mut ambient) = (0.0, 0.0, 0.0);
            for line in &lines {
                for i in 0..nodes {
                    film += self.film[line + i] * self.node_length[i];
                    contact += self.contact[line + i] * self.node_length[i];
                    ambient += self.ambient[i] * self.node_length[i];
                }
            }
            let held = contact > least && film < load;
            let contact_factor = if held { (load - film) / contact } else { kept };
            let lacking = load - kept * contact;
            let film_factor = if held || film + ambient <= 0.0 { 1.0 } else { (lacking + ambient) / (film + ambient) };
            for line in &lines {
                for i in 0..nodes {
                    self.contact[line + i] *= contact_factor;
                    self.film[line + i] = film_factor * (self.film[line + i] + self.ambient[i]) - self.ambient[i];
                }
            }
        }
    }

    /// Film load of each frame \[N\].
    pub fn film_loads(&self) -> Vec<f64> {
        self.series(|nodes| self.load(&self.film[nodes]), Add::add)
    }

    /// Contact load of each frame \[N\].
    fn contact_loads(&self) -> Vec<f64> {
        self.series(|nodes| self.load(&self.contact[nodes]), Add::add)
    }

    /// Greatest pressure of each frame \[Pa\].
    pub fn max_pressures(&self) -> Vec<f64> {
        self.series(|nodes| self.peak[nodes].iter().copied().fold(0.0, f64::max), f64::max)
    }

    /// Least film thickness of each frame \[m\].
    pub fn min_film_thicknesses(&self) -> Vec<f64> {
        self.series(|nodes| self.film_thickness[nodes].iter().copied().fold(f64::INFINITY, f64::min), f64::min)
    }

    /// Least film thickness of each tooth in one frame \[m\].
    pub fn thinnest(&self, frame: usize) -> impl Iterator<Item = f64> {
        (0..self.teeth).map(move |tooth| {
            let line = self.line_offset(tooth, frame);
            self.film_thickness[line..line + self.x.len()].iter().copied().fold(f64::INFINITY, f64::min)
        })
    }

    /// By how much the film of each frame may be thinner than it is at any node \[m\], by how far the thickness departs from the chord of
    /// its neighbours where it is least; 0 where the gap is closed, so that the thickness is `closed`.
    pub fn thinner_between_nodes(&self, closed: f64) -> Vec<f64> {
        let thinner = |a: usize, b: usize| if self.film_thickness[b] < self.film_thickness[a] { b } else { a };
        let least = self.series(|nodes| nodes.clone().fold(nodes.start, thinner), thinner);
        least.into_iter().map(|node| self.thinner_beside(node, closed)).collect()
    }

    /// The same for a frame that is thinnest at `node` of all lines.
    fn thinner_beside(&self, node: usize, closed: f64) -> f64 {
        let nodes = self.x.len();
        let (line, i) = (node - node % nodes, node % nodes);
        if nodes <= 2 || self.film_thickness[node] <= closed {
            return 0.0;
        }
        let factor = if i == 0 || i == nodes - 1 { AT_EDGE } else { BETWEEN };
        let i = i.clamp(1, nodes - 2);
        let [before, here, behind] = [i - 1, i, i + 1].map(|i| (self.x[i], self.film_thickness[line + i]));
        let share = (here.0 - before.0) / (behind.0 - before.0);
        factor * (here.1 - before.1 - share * (behind.1 - before.1)).abs()
    }

    /// Teeth that touch in each frame.
    pub fn touching_teeth(&self) -> Vec<usize> {
        self.series(|nodes| usize::from(self.contact[nodes].iter().any(|c| *c > self.touching_from)), Add::add)
    }

    /// Of line loads on one line \[N\].
    fn load(&self, line: &[f64]) -> f64 {
        line.iter().zip(&self.node_length).map(|(force, length)| force * length).sum()
    }

    /// Teeth that touch, mean over the cycle.
    pub fn teeth_in_contact(&self) -> f64 {
        self.touching_teeth().iter().sum::<usize>() as f64 / self.frames as f64
    }

    /// A value of each frame: those of its teeth's lines, joined.
    fn series<T: Copy>(&self, of_line: impl Fn(Range<usize>) -> T, join: impl Fn(T, T) -> T) -> Vec<T> {
        let nodes = self.x.len();
        let lines: Vec<T> = (0..self.stored_teeth * self.frames).map(|k| of_line(k * nodes..(k + 1) * nodes)).collect();
        let joined = |frame: usize| {
            (1..self.teeth).map(|tooth| lines[self.line(tooth, frame)]).fold(lines[self.line(0, frame)], &join)
        };
        (0..self.frames).map(joined).collect()
    }
}

impl Recording {
    /// This recording with the lines of the `finest` grid, extrapolated with those of the `coarser` ones, coarse to fine, and as
    /// they are without them. `pressure` is that of the finest grid, tooth after tooth, and `y` its unknown nodes across: there it
    /// follows the line loads.
    pub fn of_lines(
        self,
        finest: LineLoads,
        coarser: &[LineLoads],
        balance: &Balance,
        mut pressure: Vec<f64>,
        y: Range<usize>,
    ) -> Self {
        let (mut lines, yardsticks) = match coarser {
            [.., first, second] => {
                (finest.extrapolated(second, balance), vec![second.extrapolated(first, balance), finest.clone()])
            }
            [only] => (finest.extrapolated(only, balance), Vec::new()),
            [] => (finest.clone(), Vec::new()),
        };
        let (nodes, size) = (lines.x.len(), self.map_x.len() * self.map_y.len() * lines.frames);
        for (k, column) in pressure.chunks_exact_mut(self.map_y.len()).enumerate() {
            let known = finest.ambient[k % nodes];
            if known > 0.0 {
                let factor = (lines.film[k] + known) / (finest.film[k] + known);
                column[y.clone()].iter_mut().for_each(|p| *p *= factor);
            }
        }
        let other_pressure = pressure.split_off(size.min(pressure.len()));
        let max_pressure = lines.max_pressures();
        (lines.peak, lines.ambient) = (Vec::new(), Vec::new());
        Self {
            film_load: lines.film_loads(),
            contact_load: lines.contact_loads(),
            teeth_in_contact: lines.touching_teeth(),
            min_film_thickness: lines.min_film_thicknesses(),
            max_pressure,
            lines,
            pressure,
            other_pressure,
            yardsticks,
            ..self
        }
    }
}

/// Corrections of the fine grid at the coarse nodes of one frame: line loads \[N/m\] and thickness \[m\].
struct Missing<'a> {
    fine: &'a LineLoads,
    coarse: &'a LineLoads,
    film: Vec<f64>,
    contact: Vec<f64>,
    thickness: Vec<f64>,
    /// Of the fine node behind each coarse one, the share that belongs to its cell.
    shares: Vec<f64>,
}

impl<'a> Missing<'a> {
    fn new(fine: &'a LineLoads, coarse: &'a LineLoads) -> Self {
        let zero = vec![0.0; coarse.x.len()];
        let mut shares = vec![0.5; coarse.x.len()];
        if fine.radial {
            // What makes each cell the coarse one: the circumference grows along it.
            let mut before = 0.0;
            for (i, share) in shares.iter_mut().enumerate() {
                let behind = fine.node_length.get(2 * i + 1).copied().unwrap_or(f64::INFINITY);
                *share = (coarse.node_length[i] - before - fine.node_length[2 * i]) / behind;
                before = (1.0 - *share) * behind;
            }
        }
        Self { fine, coarse, film: zero.clone(), contact: zero.clone(), thickness: zero, shares }
    }

    /// Of a fine frame.
    fn at(&mut self, tooth: usize, frame: usize) {
        for values in [&mut self.film, &mut self.contact, &mut self.thickness] {
            values.fill(0.0);
        }
        if frame.is_multiple_of(2) {
            self.add(tooth, frame / 2, 1.0);
        } else {
            self.add(tooth, frame / 2, 0.5);
            self.add(tooth, (frame / 2 + 1) % self.coarse.frames, 0.5);
        }
        // On an ambient edge the film is known: what its cell misses is its neighbour's.
        let (last, nodes) = (self.film.len() - 1, self.fine.x.len());
        for (edge, beside, node) in [(0, 1, 0), (last, last - 1, nodes - 1)] {
            if self.fine.ambient[node] == 0.0 && last > 1 {
                self.film[beside] += self.film[edge] * self.cell(edge) / self.cell(beside);
                self.film[edge] = 0.0;
            }
        }
    }

    /// Length of the fine cells that make a coarse one \[m\].
    fn cell(&self, i: usize) -> f64 {
        cell(&self.shares, |k| self.fine.node_length[k], i)
    }

    fn add(&mut self, tooth: usize, step: usize, share: f64) {
        let (fine, coarse) = (self.fine, self.coarse);
        let from = (tooth * fine.frames + 2 * step) * fine.x.len();
        let to = (tooth * coarse.frames + step) * coarse.x.len();
        let third = share / 3.0;
        for i in 0..coarse.x.len() {
            let length = self.cell(i);
            let shares = &self.shares;
            let missing = |all: &[f64], few: &[f64]| {
                let load = cell(shares, |k| all[from + k] * fine.node_length[k], i);
                third * (load - few[to + i] * coarse.node_length[i]) / length
            };
            self.film[i] += missing(&fine.film, &coarse.film);
            self.contact[i] += missing(&fine.contact, &coarse.contact);
            self.thickness[i] += third * (fine.film_thickness[from + 2 * i] - coarse.film_thickness[to + i]);
        }
    }
}

/// Sum of the fine cells that make coarse cell `i`, by the `shares` of those between.
fn cell(shares: &[f64], value: impl Fn(usize) -> f64, i: usize) -> f64 {
    let before = if i > 0 { (1.0 - shares[i - 1]) * value(2 * i - 1) } else { 0.0 };
    let behind = if i + 1 < shares.len() { shares[i] * value(2 * i + 1) } else { 0.0 };
    before + value(2 * i) + behind
}
