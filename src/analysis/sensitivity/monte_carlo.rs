//! Results of random scenes, and how they are distributed.

use crate::analysis::tradeoff::quantile;
use crate::estimate::Estimate;
use serde::{Deserialize, Serialize};

/// One draw: the values of the uncertain keys in their order, and the results.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Draw {
    /// Values of the keys, in their units.
    pub values: Vec<f64>,
    /// Results in the order of the outputs, with their numerical errors; not finite where the draw has none.
    pub results: Vec<Estimate>,
}

/// Results of random scenes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MonteCarlo {
    /// The seed of the random numbers.
    pub seed: u64,
    /// The number of draws that were requested; there are fewer if it was cancelled.
    pub asked: usize,
    /// Those that were solved, in the order in which they were drawn.
    pub draws: Vec<Draw>,
    /// Why the others were not solved.
    pub failures: Vec<String>,
    /// The number of draws that were outside of the ranges of their keys, or broke a rule between keys, and were drawn again. Their results
    /// are missing from the distribution.
    pub redrawn: usize,
}

/// How the draws of one result are distributed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spread {
    /// How many there are.
    pub count: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub deviation: f64,
    /// Quantiles of 5, 50 and 95 %; their error is the standard deviation due to the limited number of draws.
    pub quantiles: [Estimate; 3],
    /// Bins of equal width from the least draw to the greatest: the start of the first, their width, and the number of draws in each.
    pub bins: (f64, f64, Vec<usize>),
}

impl Spread {
    /// Whether the mean differs from `value` by more than chance, a tenth of the spread and the numerical error of `value`.
    pub fn is_off(&self, value: Estimate) -> bool {
        (self.mean - value.value).abs() > (3.0 * self.mean_error()).max(0.1 * self.deviation).max(value.error)
    }

    /// The standard deviation of the mean due to the limited number of draws.
    pub fn mean_error(&self) -> f64 {
        self.deviation / (self.count as f64).sqrt()
    }
}

impl MonteCarlo {
    /// The spread of the output with this index; `None` with fewer than two draws.
    pub fn spread(&self, output: usize) -> Option<Spread> {
        let values = self.draws.iter().filter_map(|draw| Some(draw.results.get(output)?.value));
        let mut found: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        found.sort_by(f64::total_cmp);
        let (count, last) = (found.len(), found.len().checked_sub(1)?);
        if last == 0 {
            return None;
        }
        let mean = found.iter().sum::<f64>() / count as f64;
        let deviation = (found.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / last as f64).sqrt();
        // Twice the cube root: Rice's rule.
        let number = if found[last] > found[0] { (2.0 * (count as f64).cbrt()).ceil() as usize } else { 1 };
        let width = (found[last] - found[0]) / number as f64;
        let mut bins = vec![0; number];
        for value in &found {
            let bin = if width > 0.0 { ((value - found[0]) / width) as usize } else { 0 };
            bins[bin.min(number - 1)] += 1;
        }
        let quantiles = [0.05, 0.5, 0.95_f64].map(|share| {
            let chance = (share * (1.0 - share) / count as f64).sqrt();
            let [low, high] = [share - chance, share + chance].map(|share| quantile(&found, share.clamp(0.0, 1.0)));
            Estimate { value: quantile(&found, share), error: 0.5 * (high - low) }
        });
        Some(Spread { count, mean, deviation, quantiles, bins: (found[0], width, bins) })
    }
}
