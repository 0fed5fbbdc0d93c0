//! What this scene needs.
pub struct Grid {
    pub along: usize,
    pub across: usize,
    pub steps: usize,
    pub most_harmonics: usize,
}
pub struct Plan {
    pub grids: Vec<Grid>,
    pub clustering_along: f64,
    pub clustering_across: f64,
    pub half_width: bool,
    pub every_tooth: bool,
    pub shear: bool,
    pub harmonic_fraction: f64,
    pub tolerance: f64,
    pub round_limit: usize,
}
impl Plan {
    pub fn error_estimate(&self, alphas: &[f64]) -> f64 {
        match alphas {
            [.., a, b] => (a - b).abs(),
            _ => f64::NAN,
        }
    }
}
