//! The film on one tooth (or plate): White and Nigam's factored implicit scheme, as the paper uses it.
//!
//! # Equation
//!
//! Lengths are scaled by the tooth width b, film thickness by a reference H, pressure by p_a, time by 1/ω, and
//! Z = p h. The compressible Reynolds equation with first-order slip is then
//!
//! ```text
//! σ Z_τ = ∂x[(Z + 6m)(h Z_x − h_x Z)] + ∂y[(Z + 6m) h Z_y] − ∂x(Λ Z)
//!
//! σ = 12 μ ω b² / (p_a H²)    m = λ_a / H    Λ(x, τ) = 6 μ U b / (p_a H²)
//! ```
//!
//! with h a function of x and τ alone. The paper expands the derivatives, and so does this module:
//!
//! ```text
//! F(Z; h) = (Z + 6m)(h Z_xx − h_xx Z) + Z_x (h Z_x − h_x Z) + h (Z²/2 + 6mZ)_yy − Λ Z_x − Λ_x Z
//! ```
//!
//! so mass is not conserved across a kink of h; that error is part of what this method is kept to show. Across the
//! width, where h is uniform, (Z + 6m) Z_yy + Z_y² is differenced as the equal (Z²/2 + 6mZ)_yy. If it is differenced term by term, the mesh
//! of 11 nodes, whose spacing is that of the edge layer, gives 1.1 % less load in the fundamental case and 3.1 % more on doubling; the
//! paper reports 2.1 % more, this form gives 2.3 % (docs/validation.md). The paper as printed (its ξ after equation (4)) has `Z(Z +
//! 6m)(Z_xx + Z_yy)` where (Z + 6m)(Z_xx + Z_yy) is meant, a wedge term along y that does not exist, and no Λ_x, which is zero only for a U
//! uniform in x.
//!
//! # Step
//!
//! Crank–Nicolson about level n, linearised, with h the mean of levels n and n+1, a = Δτ/2σ, ΔZ = Zⁿ⁺¹ − Zⁿ:
//!
//! ```text
//! (1 − Lx)(1 − Ly) ΔZ = 2a F(Zⁿ; h)
//! Lx = a [ h (Z+6m) δxx + (2 h Z_x − h_x Z − Λ) δx + h Z_xx − h_x Z_x − h_xx (2Z+6m) − Λ_x ]
//! Ly = a h δyy [ (Z+6m) · ]
//! ```
//!
//! one tridiagonal (Thomas) sweep along x for each j, then one along y for each i; no iteration. All differences are
//! central on three points. Both the linearisation and the factoring cost O(Δτ³) in a step, so the scheme is second
//! order in time and, where h is smooth, in space.
//!
//! # Boundary
//!
//! p = 1 on all four edges: ΔZ = hⁿ⁺¹ − hⁿ there. The x sweep needs ΔZ* = (1 − Ly) ΔZ on the x-edges, where Z = h is
//! uniform in y, so that Ly ΔZ = 0 and ΔZ* = ΔZ.
//!
//! # Index order
//!
//! Fields are flat, `[ix][iy]`, `ix` from −b/2 to b/2 and `iy` from −w/2 to w/2, ends counted; h and Λ are `[ix]`.
//!
//! # Source
//!
//! J. W. White and A. Nigam, "A factored implicit scheme for the numerical solution of the Reynolds equation at very
//! low spacing", ASME J. Lubr. Technol. 102 (1980) 80–85; equations (2)–(4) of Maeno and Bogy (1992).

/// The factored scheme on one uniform mesh, with the buffers of its sweeps. A step allocates nothing.
#[derive(Clone, Debug)]
pub struct FactoredFilm {
    nx: usize,
    ny: usize,
    dx: f64,
    dy: f64,
    sigma: f64,
    six_m: f64,
    /// Reduced upper diagonal of the x sweep, `[ix][iy]`.
    upper_x: Vec<f64>,
    /// Right-hand side, then ΔZ*, `[ix][iy]`.
    delta: Vec<f64>,
    /// Z and ΔZ* with the indices exchanged, `[iy][ix]`, so that the y sweep too runs along memory.
    z_t: Vec<f64>,
    delta_t: Vec<f64>,
    /// Reduced upper diagonal of the y sweep, `[iy][ix]`.
    upper_y: Vec<f64>,
    /// h at the half step, `[ix]`.
    h: Vec<f64>,
}

impl FactoredFilm {
    /// A mesh of `nx` × `ny` nodes, ends counted, at least 3 × 3, on a face of length 1 and width `width` (radial width
    /// over b), with squeeze number `sigma` and Knudsen number `knudsen` m.
    pub fn new(nx: usize, ny: usize, width: f64, sigma: f64, knudsen: f64) -> Self {
        let (nx, ny) = (nx.max(3), ny.max(3));
        let nodes = nx * ny;
        Self {
            nx,
            ny,
            dx: 1.0 / (nx - 1) as f64,
            dy: width / (ny - 1) as f64,
            sigma,
            six_m: 6.0 * knudsen,
            upper_x: vec![0.0; nodes],
            delta: vec![0.0; nodes],
            z_t: vec![0.0; nodes],
            delta_t: vec![0.0; nodes],
            upper_y: vec![0.0; nodes],
            h: vec![0.0; nx],
        }
    }

    /// Nodes along x, ends counted.
    pub fn nx(&self) -> usize {
        self.nx
    }

    /// Nodes along y, ends counted.
    pub fn ny(&self) -> usize {
        self.ny
    }

    /// Nodes of the mesh.
    pub fn nodes(&self) -> usize {
        self.nx * self.ny
    }

    /// Advances `z` (`[ix][iy]`, at level n) by `dtau` into `z_new`, the film going from `h_old` to `h_new` (`[ix]`).
    /// `wedge` is Λ at the half step (`[ix]`); `None` leaves the sliding term out.
    ///
    /// Nothing is clamped: where the scheme fails, `z_new` is negative or not finite, and the caller has to check it.
    pub fn step(
        &mut self,
        z: &[f64],
        h_old: &[f64],
        h_new: &[f64],
        wedge: Option<&[f64]>,
        dtau: f64,
        z_new: &mut [f64],
    ) {
        for (h, (old, new)) in self.h.iter_mut().zip(h_old.iter().zip(h_new)) {
            *h = 0.5 * (old + new);
        }
        self.sweep_x(z, h_old, h_new, wedge, dtau);
        self.sweep_y(h_old, h_new, dtau);

        let (nx, ny) = (self.nx, self.ny);
        for i in 0..nx {
            let (row, out) = (&z[i * ny..(i + 1) * ny], &mut z_new[i * ny..(i + 1) * ny]);
            for j in 0..ny {
                out[j] = row[j] + self.delta_t[j * nx + i];
            }
            out[0] = h_new[i];
            out[ny - 1] = h_new[i];
        }
        z_new[..ny].fill(h_new[0]);
        z_new[(nx - 1) * ny..nx * ny].fill(h_new[nx - 1]);
    }

    /// (1 − Lx) ΔZ* = 2a F: leaves ΔZ* in `delta_t` and Z in `z_t`. The elimination runs over i for all j together.
    fn sweep_x(&mut self, z: &[f64], h_old: &[f64], h_new: &[f64], wedge: Option<&[f64]>, dtau: f64) {
        let (nx, ny) = (self.nx, self.ny);
        let a = dtau / (2.0 * self.sigma);
        let six_m = self.six_m;
        let (cx, cxx) = (0.5 / self.dx, 1.0 / (self.dx * self.dx));
        let cyy = 1.0 / (self.dy * self.dy);

        self.delta[..ny].fill(h_new[0] - h_old[0]);
        self.upper_x[..ny].fill(0.0);
        for i in 1..nx - 1 {
            let h = self.h[i];
            let hx = (self.h[i + 1] - self.h[i - 1]) * cx;
            let hxx = (self.h[i + 1] - 2.0 * h + self.h[i - 1]) * cxx;
            let (lambda, lambda_x) = wedge.map_or((0.0, 0.0), |w| (w[i], (w[i + 1] - w[i - 1]) * cx));

            let (west, rest) = z[(i - 1) * ny..(i + 2) * ny].split_at(ny);
            let (here, east) = rest.split_at(ny);
            let (delta_west, delta_here) = self.delta[(i - 1) * ny..(i + 1) * ny].split_at_mut(ny);
            let (upper_west, upper_here) = self.upper_x[(i - 1) * ny..(i + 1) * ny].split_at_mut(ny);
            for j in 1..ny - 1 {
                let zc = here[j];
                let zx = (east[j] - west[j]) * cx;
                let zxx = (east[j] - 2.0 * zc + west[j]) * cxx;
                let g = zc + six_m;
                let potential = |z: f64| z * (0.5 * z + six_m);
                let across = (potential(here[j + 1]) - 2.0 * potential(zc) + potential(here[j - 1])) * cyy;

                let f = g * (h * zxx - hxx * zc) + zx * (h * zx - hx * zc) + h * across - lambda * zx - lambda_x * zc;
                let second = a * h * g * cxx;
                let first = a * (2.0 * h * zx - hx * zc - lambda) * cx;
                let zeroth = a * (h * zxx - hx * zx - hxx * (zc + g) - lambda_x);

                let lower = first - second;
                let pivot = 1.0 / (1.0 + 2.0 * second - zeroth - lower * upper_west[j]);
                upper_here[j] = -(second + first) * pivot;
                delta_here[j] = (2.0 * a * f - lower * delta_west[j]) * pivot;
            }
        }
        self.delta[(nx - 1) * ny..].fill(h_new[nx - 1] - h_old[nx - 1]);
        for i in (1..nx - 1).rev() {
            let (here, east) = self.delta[i * ny..(i + 2) * ny].split_at_mut(ny);
            let upper = &self.upper_x[i * ny..(i + 1) * ny];
            for j in 1..ny - 1 {
                here[j] -= upper[j] * east[j];
            }
        }
        for i in 0..nx {
            for j in 0..ny {
                self.z_t[j * nx + i] = z[i * ny + j];
                self.delta_t[j * nx + i] = self.delta[i * ny + j];
            }
        }
    }

    /// (1 − Ly) ΔZ = ΔZ*, in place in `delta_t`. The elimination runs over j for all i together.
    fn sweep_y(&mut self, h_old: &[f64], h_new: &[f64], dtau: f64) {
        let (nx, ny) = (self.nx, self.ny);
        let a = dtau / (2.0 * self.sigma);
        let six_m = self.six_m;
        let cyy = 1.0 / (self.dy * self.dy);
        let h = &self.h;

        self.upper_y[..nx].fill(0.0);
        for i in 0..nx {
            self.delta_t[i] = h_new[i] - h_old[i];
            self.delta_t[(ny - 1) * nx + i] = h_new[i] - h_old[i];
        }
        for j in 1..ny - 1 {
            let (south, rest) = self.z_t[(j - 1) * nx..(j + 2) * nx].split_at(nx);
            let (here, north) = rest.split_at(nx);
            let (delta_south, delta_here) = self.delta_t[(j - 1) * nx..(j + 1) * nx].split_at_mut(nx);
            let (upper_south, upper_here) = self.upper_y[(j - 1) * nx..(j + 1) * nx].split_at_mut(nx);
            for i in 1..nx - 1 {
                let ah = a * h[i] * cyy;
                let lower = -ah * (south[i] + six_m);
                let pivot = 1.0 / (1.0 + 2.0 * ah * (here[i] + six_m) - lower * upper_south[i]);
                upper_here[i] = -ah * (north[i] + six_m) * pivot;
                delta_here[i] = (delta_here[i] - lower * delta_south[i]) * pivot;
            }
        }
        for j in (1..ny - 1).rev() {
            let (here, north) = self.delta_t[j * nx..(j + 2) * nx].split_at_mut(nx);
            let upper = &self.upper_y[j * nx..(j + 1) * nx];
            for i in 1..nx - 1 {
                here[i] -= upper[i] * north[i];
            }
        }
    }

    /// Line load of pressure `p` (`[ix][iy]`, in p_a) over the width, trapezoid of p − 1 across y: `line` (`[ix]`) is in
    /// p_a × b.
    pub fn line_load(&self, p: &[f64], line: &mut [f64]) {
        let ny = self.ny;
        for (i, load) in line.iter_mut().enumerate() {
            let row = &p[i * ny..(i + 1) * ny];
            let ends = 0.5 * (row[0] + row[ny - 1]);
            let sum: f64 = row[1..ny - 1].iter().sum::<f64>() + ends;
            *load = (sum - (ny - 1) as f64) * self.dy;
        }
    }

    /// Trapezoid of a line (`[ix]`) along x.
    pub fn integrate(&self, line: &[f64]) -> f64 {
        (line.iter().sum::<f64>() - 0.5 * (line[0] + line[self.nx - 1])) * self.dx
    }
}
