//! Starts a finer grid from the state of a coarser one.

use super::MotorLevel;
use crate::film::grid::Between;

impl MotorLevel {
    /// Starts from the state on another grid, interpolated between its nodes and steps.
    pub(in crate::motor) fn start_from(&mut self, coarse: &Self) {
        for (s, shape) in self.shapes.iter_mut().enumerate() {
            *shape = coarse.shapes[s * coarse.instants() / (self.stator.len() / (self.teeth * self.nx))]
                .resized(self.contact.modes());
        }
        let (nx, ny) = (self.nx, self.grid().y.len());
        let (cnx, cny) = (coarse.nx, coarse.grid().y.len());
        let (ux, uy) = (self.grid().x.unknown(), self.grid().y.unknown());
        let along: Vec<_> = (0..nx).map(|ix| Between::of(ix, nx - 1, cnx - 1)).collect();
        let (y, there) = (&self.grid().y.nodes, &coarse.grid().y.nodes);
        let across: Vec<_> = (0..ny).map(|iy| Between::at(y[iy] / y[ny - 1], there)).collect();
        let widths = coarse.interior_width;
        for tooth in 0..self.stored {
            let mut pressure = vec![1.0; cnx * cny];
            let mut later = vec![1.0; cnx * cny];
            let mut carried = vec![1.0; cnx * cny];
            coarse.with_edges(&mut carried, |k| coarse.states[tooth].carried[k] / coarse.states[tooth].trapped[k]);
            for step in 0..self.steps {
                let when = Between::of(step, self.steps, coarse.steps);
                let lines = [when.low, (when.low + 1) % coarse.steps].map(|m| (tooth * coarse.steps + m) * cnx);
                let sources = [when.low, (when.low + 1) % coarse.steps].map(|m| coarse.films[tooth].pressure(m));
                coarse.with_edges(&mut pressure, |k| sources[0][k]);
                coarse.with_edges(&mut later, |k| sources[1][k]);
                for (p, q) in pressure.iter_mut().zip(&later) {
                    *p = when.mix(*p, *q);
                }
                let gap = |i: usize| when.mix(coarse.film_thickness[lines[0] + i], coarse.film_thickness[lines[1] + i]);
                // The trapped gas varies less in time than gap and pressure.
                let trapped = |i: usize| {
                    let open = i == 0 || i == cnx - 1;
                    let at = |k: usize| if open { widths * coarse.film_thickness[k] } else { coarse.trapped[k] };
                    when.mix(at(lines[0] + i), at(lines[1] + i))
                };
                let to = (tooth * self.steps + step) * nx;
                for ix in 0..nx {
                    let at = &along[ix];
                    self.film_thickness[to + ix] = at.mix(gap(at.low), gap(at.high()));
                }
                for (row, ix) in ux.clone().enumerate() {
                    let at = &along[ix];
                    let h = self.film_thickness[to + ix];
                    self.trapped[to + ix] = self.interior_width / widths * at.curve(cnx, trapped);
                    for (column, iy) in uy.clone().enumerate() {
                        let there = &across[iy];
                        let at_node = |field: &[f64]| {
                            let row_mix = |i: usize| {
                                there.mix(field[i * cny + there.low], field[i * cny + there.high().min(cny - 1)])
                            };
                            at.curve(cnx, row_mix)
                        };
                        let k = row * uy.len() + column;
                        let p = at_node(&pressure);
                        self.films[tooth].guess_mut(step)[k] = p;
                        if step == 0 {
                            self.states[tooth].trapped[k] = h * p;
                            let finer = coarse.steps as f64 / self.steps as f64;
                            self.states[tooth].carried[k] = h * p * (1.0 + finer * (at_node(&carried) - 1.0));
                        }
                    }
                }
            }
        }
        if coarse.is_soft() {
            self.soften();
        }
    }

    /// Copies a field of unknown nodes into one with edges, `[ix][iy]`; the edges keep their values.
    fn with_edges(&self, out: &mut [f64], value: impl Fn(usize) -> f64) {
        for (k, node) in self.grid().rows().flat_map(|(_, row)| row).enumerate() {
            out[node] = value(k);
        }
    }
}
