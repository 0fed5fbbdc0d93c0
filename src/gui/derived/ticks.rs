//! Round numbers on axes.

use super::format::signed;

/// Round numbers on an axis.
#[derive(Clone, Copy, Debug)]
pub struct Ticks {
    step: f64,
    first: i64,
    last: i64,
    decimals: usize,
}

impl Ticks {
    /// About `about` steps of 1, 2 or 5 times a power of ten over `range`.
    pub fn new(range: [f64; 2], about: usize) -> Self {
        let step = round_up((range[1] - range[0]) / about.max(1) as f64);
        let decimals = (-step.log10() - 1e-9).ceil().clamp(0.0, 9.0) as usize;
        Self {
            step,
            first: (range[0] / step - 1e-6).ceil() as i64,
            last: (range[1] / step + 1e-6).floor() as i64,
            decimals,
        }
    }

    /// The round numbers, ascending.
    pub fn values(self) -> impl Iterator<Item = f64> {
        (self.first..=self.last.min(self.first.saturating_add(50))).map(move |k| k as f64 * self.step)
    }

    /// `value` with as many decimals as the step needs.
    pub fn format(&self, value: f64) -> String {
        signed(format!("{value:.*}", self.decimals))
    }
}

/// The least of 1, 2, 5 × 10ⁿ that is not below `value`.
pub fn round_up(value: f64) -> f64 {
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let power = 10f64.powf(value.log10().floor());
    let lead = value / power;
    let lead = [1.0, 2.0, 5.0].into_iter().find(|round| lead <= round * (1.0 + 1e-9)).unwrap_or(10.0);
    lead * power
}

/// The greatest of 1, 2, 5 × 10ⁿ that is not above `value`.
pub fn round_down(value: f64) -> f64 {
    1.0 / round_up(1.0 / value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let ticks = Ticks::new([-1.4, 24.6], 6);
        assert_eq!(ticks.values().collect::<Vec<_>>(), [0.0, 5.0, 10.0, 15.0, 20.0]);
        let ticks = Ticks::new([0.0, 0.031], 4);
        let texts: Vec<String> = ticks.values().map(|value| ticks.format(value)).collect();
        assert_eq!(texts, ["0.00", "0.01", "0.02", "0.03"]);
        assert!(Ticks::new([0.0, 0.0], 3).values().count() < 60);
        assert!(Ticks::new([1e300, -1e300], 0).values().count() < 60);
    }

    #[test]
    fn steps_are_round() {
        assert!((round_down(3.9) - 2.0).abs() < 1e-12);
        assert!((round_up(3.9) - 5.0).abs() < 1e-12);
    }
}
