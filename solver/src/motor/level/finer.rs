//! Starts a finer grid from the state of a coarser one.

use super::MotorLevel;
use crate::film::grid::Between;

/// How far off the start from a similar motor is taken to be, in ln ζ.
const SIMILAR: f64 = 0.01;

impl MotorLevel {
    /// Starts from the state on another grid, interpolated between its nodes and steps.
    pub(in crate::motor) fn start_from(&mut self, other: &Self) {
        self.start_with(other, &other.trapped);
    }

    /// The same with the lines `gas` of ζ on the other grid.
    fn start_with(&mut self, other: &Self, gas: &[f64]) {
        for (s, shape) in self.shapes.iter_mut().enumerate() {
            *shape = other.shapes[s * other.instants() / (self.stator.len() / (self.teeth * self.nx))]
                .resized(self.contact.modes());
        }
        self.film_thickness.fill(1.0);
        let unknown = self.grid().x.unknown();
        for line in self.trapped.chunks_exact_mut(self.nx) {
            line[unknown.clone()].fill(self.interior_width / other.interior_width);
        }
        for (film, state) in self.films.iter_mut().zip(&mut self.states) {
            (0..self.steps).for_each(|step| film.guess_mut(step).fill(1.0));
            state.trapped.fill(1.0);
            state.carried.fill(1.0);
        }
        let nodes = |level: &Self| (level.nx, level.grid().y.len(), level.steps);
        if nodes(self) == nodes(other) {
            self.film_thickness.copy_from_slice(&other.film_thickness);
            self.trapped.iter_mut().zip(gas).for_each(|(here, there)| *here *= there);
            for (film, from) in self.films.iter_mut().zip(&other.films) {
                (0..self.steps).for_each(|step| film.guess_mut(step).copy_from_slice(from.pressure(step)));
            }
            self.states.clone_from(&other.states);
        } else {
            self.multiply(&GridFields::of(other, gas));
        }
        if other.is_soft() {
            self.soften();
        }
    }

    /// Starts from the state of a similar motor on the same grid, and changes it as the state on the grid before changed from `then`, of the
    /// similar motor, to `now`.
    pub(in crate::motor) fn start_from_similar(&mut self, other: &Self, change: Option<[&Self; 2]>) {
        self.start_with(other, &other.next);
        self.residual = SIMILAR;
        // Where a rotor only just floats, or only just does not, it may do so on some grids and not on others.
        let change = change.filter(|[then, now]| !self.is_soft() && then.floats() == now.floats());
        let ratio = change.and_then(|change| {
            let [then, now] = change.map(|level| GridFields::of(level, &level.next));
            now.over(&then)
        });
        if let Some(ratio) = ratio {
            self.multiply(&ratio);
        }
    }

    /// Multiplies the state by fields on another grid, interpolated between its nodes and steps.
    fn multiply(&mut self, other: &GridFields<'_>) {
        let (nx, ny) = (self.nx, self.grid().y.len());
        let (steps, cnx, cny) = (other.steps, other.nx, other.y.len());
        let (ux, uy) = (self.grid().x.unknown(), self.grid().y.unknown());
        let along: Vec<_> = (0..nx).map(|ix| Between::of(ix, nx - 1, cnx - 1)).collect();
        let y = &self.grid().y.nodes;
        let across: Vec<_> = uy.map(|iy| Between::at(y[iy] / y[ny - 1], other.y)).collect();
        let columns = across.len();
        // A field of all nodes, at the nodes across of this grid, `[ix][column]`.
        let narrow = |field: &[f64], out: &mut [f64]| {
            for (row, out) in field.chunks_exact(cny).zip(out.chunks_exact_mut(columns)) {
                for (out, there) in out.iter_mut().zip(&across) {
                    *out = there.mix(row[there.low], row[there.high().min(cny - 1)]);
                }
            }
        };
        let (mut pressure, mut narrowed) = (vec![1.0; cnx * cny], vec![1.0; cnx * columns]);
        let mut gap = vec![1.0; cnx];
        let mut trapped = vec![1.0; cnx];
        let mut carried = narrowed.clone();
        for tooth in 0..self.stored {
            narrow(&other.carried[tooth * cnx * cny..(tooth + 1) * cnx * cny], &mut carried);
            for step in 0..self.steps {
                let when = Between::of(step, self.steps, steps);
                let whens = [when.low, (when.low + 1) % steps].map(|m| tooth * steps + m);
                let mix = |fields: &[f64], out: &mut [f64]| {
                    let size = out.len();
                    let [low, high] = whens.map(|m| &fields[m * size..(m + 1) * size]);
                    for ((out, low), high) in out.iter_mut().zip(low).zip(high) {
                        *out = when.mix(*low, *high);
                    }
                };
                mix(&other.pressure, &mut pressure);
                narrow(&pressure, &mut narrowed);
                mix(&other.gap, &mut gap);
                // The trapped gas varies less in time than gap and pressure.
                mix(&other.trapped, &mut trapped);
                let to = (tooth * self.steps + step) * nx;
                for (ix, at) in along.iter().enumerate() {
                    self.film_thickness[to + ix] *= at.mix(gap[at.low], gap[at.high()]);
                }
                let guess = self.films[tooth].guess_mut(step);
                for (row, ix) in ux.clone().enumerate() {
                    let at = &along[ix];
                    self.trapped[to + ix] *= at.curve(cnx, |i| trapped[i]);
                    for column in 0..columns {
                        let at_node = |field: &[f64]| at.curve(cnx, |i| field[i * columns + column]);
                        let k = row * columns + column;
                        let p = at_node(&narrowed);
                        guess[k] *= p;
                        if step == 0 {
                            let trapped = at.mix(gap[at.low], gap[at.high()]) * p;
                            let finer = steps as f64 / self.steps as f64;
                            self.states[tooth].trapped[k] *= trapped;
                            self.states[tooth].carried[k] *= trapped * (1.0 + finer * (at_node(&carried) - 1.0));
                        }
                    }
                }
            }
        }
    }
}

/// What another grid starts from.
struct GridFields<'a> {
    steps: usize,
    nx: usize,
    /// Nodes across.
    y: &'a [f64],
    /// [`MotorLevel::interior_width`].
    width: f64,
    /// P at every node, `[tooth][step][ix][iy]`.
    pressure: Vec<f64>,
    /// h, `[tooth][step][ix]`.
    gap: Vec<f64>,
    /// ζ, `[tooth][step][ix]`.
    trapped: Vec<f64>,
    /// W(0)/Z(0) at every node, `[tooth][ix][iy]`.
    carried: Vec<f64>,
}

impl<'a> GridFields<'a> {
    fn of(level: &'a MotorLevel, gas: &[f64]) -> Self {
        let (nx, y, gap) = (level.nx, &level.grid().y.nodes, level.film_thickness.clone());
        let size = nx * y.len();
        let mut pressure = vec![1.0; level.stored * level.steps * size];
        for (line, field) in pressure.chunks_exact_mut(size).enumerate() {
            let (tooth, step) = (line / level.steps, line % level.steps);
            let pressure = level.films[tooth].pressure(step);
            level.with_edges(field, |k| pressure[k]);
        }
        let mut carried = vec![1.0; level.stored * size];
        for (field, state) in carried.chunks_exact_mut(size).zip(&level.states) {
            level.with_edges(field, |k| state.carried[k] / state.trapped[k]);
        }
        let mut trapped = gas.to_vec();
        for (line, gap) in trapped.chunks_exact_mut(nx).zip(gap.chunks_exact(nx)) {
            for open in [0, nx - 1] {
                line[open] = level.interior_width * gap[open];
            }
        }
        Self { steps: level.steps, nx, y, width: level.interior_width, pressure, gap, trapped, carried }
    }

    /// The ratio to the fields `below`, if their grid is the same.
    fn over(mut self, below: &Self) -> Option<Self> {
        if self.steps != below.steps || self.nx != below.nx || self.y.len() != below.y.len() {
            return None;
        }
        let fields = [
            (&mut self.pressure, &below.pressure),
            (&mut self.gap, &below.gap),
            (&mut self.trapped, &below.trapped),
            (&mut self.carried, &below.carried),
        ];
        for (above, below) in fields {
            above.iter_mut().zip(below).for_each(|(above, below)| *above /= below);
        }
        self.trapped.iter_mut().for_each(|trapped| *trapped *= below.width / self.width);
        Some(self)
    }
}

impl MotorLevel {
    /// Copies a field of unknown nodes into one with edges, `[ix][iy]`; the edges keep their values.
    fn with_edges(&self, out: &mut [f64], value: impl Fn(usize) -> f64) {
        for (k, node) in self.grid().rows().flat_map(|(_, row)| row).enumerate() {
            out[node] = value(k);
        }
    }
}
