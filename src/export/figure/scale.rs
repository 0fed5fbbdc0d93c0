//! Converts values to positions along an axis, and computes the ticks of an axis: steps of 1, 2 and 5 on a linear axis, decades on a
//! logarithmic one.

use super::axis::{Range, Scale, extent};
use crate::digits::{power_of_ten, short, signed};
use crate::ticks::{Decimal, Steps, decades};

/// Share of the data's span that is added at both ends of an axis for curves.
const MARGIN: f64 = 0.05;
/// From this value on, and below its inverse, ticks share a power of ten.
const PLAIN: f64 = 1e4;
/// Greatest distance of values from zero, so that their span is finite.
const FARTHEST: f64 = 1e300;

/// A range of values, mapped to 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Scaled {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) scale: Scale,
}

impl Scaled {
    /// The range for `values`; with a margin at both ends if the axis may choose its range.
    pub(super) fn new(range: &Range, scale: Scale, values: impl Iterator<Item = f64>, margin: bool) -> Self {
        let shown = |value: &f64| value.is_finite() && (scale == Scale::Linear || *value > 0.0);
        if let Range::Fixed(a, b) = range
            && shown(a)
            && shown(b)
        {
            return Self::widened(a.min(*b), a.max(*b), scale);
        }
        let extra = if let Range::Including(extra) = range { extra.as_slice() } else { &[] };
        let [low, high] = extent(values.chain(extra.iter().copied()).filter(shown));
        if low > high {
            return if scale == Scale::Log { Self::widened(0.1, 10.0, scale) } else { Self::widened(0.0, 1.0, scale) };
        }
        let range = Self::widened(low, high, scale);
        if !margin || low >= high {
            return range;
        }
        // If zero was requested and is an end, the axis has no margin there.
        let extra = extent(extra.iter().copied().filter(shown));
        let stops = |end: f64| end == 0.0 && extra.contains(&0.0);
        let room = |end: f64, outwards: f64| if stops(end) { 0.0 } else { outwards * MARGIN };
        let (from, to) = (range.value(-room(low, 1.0)), range.value(1.0 + room(high, 1.0)));
        if from.is_finite() && to.is_finite() && (scale == Scale::Linear || from > 0.0) {
            Self { from, to, scale }
        } else {
            range
        }
    }

    /// From `from` to `to`; if they are equal, a range round them.
    fn widened(from: f64, to: f64, scale: Scale) -> Self {
        let clamp = |value: f64| value.clamp(-FARTHEST, FARTHEST);
        let (from, to) = (clamp(from), clamp(to));
        match scale {
            Scale::Log if to / from < 1.0 + 1e-9 => {
                Self { from: (from / 2.0).max(f64::MIN_POSITIVE), to: (to * 2.0).max(4.0 * f64::MIN_POSITIVE), scale }
            }
            // Ticks closer than this could not be distinguished in double precision.
            Scale::Linear if to - from <= 1e-9 * from.abs().max(to.abs()) || to - from < 1e-290 => {
                let size = from.abs().max(to.abs());
                let half = if size < 1e-280 { 1.0 } else { 0.1 * size };
                Self { from: clamp(from - half), to: clamp(to + half), scale }
            }
            _ => Self { from, to, scale },
        }
    }

    /// Position of a value: 0 at the beginning, 1 at the end. NaN for a value that a logarithmic axis cannot show.
    pub(super) fn fraction(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => (value - self.from) / (self.to - self.from),
            Scale::Log if value <= 0.0 => f64::NAN,
            Scale::Log => (value.ln() - self.from.ln()) / (self.to.ln() - self.from.ln()),
        }
    }

    /// The value at a fraction.
    pub(super) fn value(&self, fraction: f64) -> f64 {
        match self.scale {
            Scale::Linear => self.from + fraction * (self.to - self.from),
            Scale::Log => (self.from.ln() + fraction * (self.to.ln() - self.from.ln())).exp(),
        }
    }

    /// Whether the value is on the axis, its ends included.
    pub(super) fn holds(&self, value: f64) -> bool {
        let fraction = self.fraction(value);
        (-1e-9..=1.0 + 1e-9).contains(&fraction)
    }
}

/// A tick; a major one has a label.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub(super) at: f64,
    pub(super) label: Option<String>,
}

/// Ticks, and the power of ten by which their labels have to be multiplied.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Ticks {
    pub(super) ticks: Vec<Tick>,
    pub(super) power: i32,
}

impl Ticks {
    /// About `most` labelled ticks, never many more, but at least two. `whole`: only at whole numbers.
    pub(super) fn new(range: &Scaled, most: usize, whole: bool) -> Self {
        let most = most.max(2);
        match range.scale {
            Scale::Linear => (most..most + 6)
                .map(|most| linear(range, most, whole))
                .find(|ticks| ticks.ticks.iter().filter(|tick| tick.label.is_some()).count() > 1)
                .unwrap_or_else(|| linear(range, most, whole)),
            Scale::Log => logarithmic(range, most),
        }
    }
}

fn linear(range: &Scaled, most: usize, whole: bool) -> Ticks {
    let ends = [range.from, range.to];
    let steps = Steps::new(ends, most);
    let ones = whole && steps.step() <= 1.0;
    let steps = if ones { Steps::of(ends, 1.0) } else { steps };
    let size = range.from.abs().max(range.to.abs());
    let power = if (1.0 / PLAIN..PLAIN).contains(&size) && steps.step() >= 1e-4 { 0 } else { thousands(size) };
    let places = steps.decimals(power);
    let (minor, every) = if ones { (steps, 1) } else { steps.divided(ends) };
    let ticks = minor
        .numbers()
        .map(|number| {
            let at = number as f64 * minor.step();
            Tick { at, label: (number % every == 0).then(|| fixed(without(at, power), places)) }
        })
        .filter(|tick| range.holds(tick.at))
        .collect();
    Ticks { ticks, power }
}

/// The value divided by a power of ten, which itself may be too large or too small for a number.
fn without(value: f64, power: i32) -> f64 {
    value / 10f64.powi(power / 2) / 10f64.powi(power - power / 2)
}

/// The greatest power of a thousand that does not exceed `size`.
fn thousands(size: f64) -> i32 {
    if size > 0.0 { (size.log10() / 3.0 + 1e-9).floor() as i32 * 3 } else { 0 }
}

/// Digits with a minus sign, but no minus sign before zero.
fn fixed(value: f64, places: usize) -> String {
    signed(format!("{value:.places$}"))
}

fn logarithmic(range: &Scaled, most: usize) -> Ticks {
    // The axis is too short for labels at decades, so it has round values as on a linear axis.
    let Some(numbers) = decades([range.from.log10(), range.to.log10()], most) else {
        let plain = Scaled { scale: Scale::Linear, ..*range };
        return Ticks::new(&plain, most.min(4), false);
    };
    let plain = range.from >= 0.999e-3 && range.to <= 1.001e4;
    let tick = |number: Decimal| Tick { at: number.value(), label: number.major.then(|| decade(number, plain)) };
    Ticks { ticks: numbers.into_iter().map(tick).collect(), power: 0 }
}

fn decade(number: Decimal, plain: bool) -> String {
    if plain {
        return fixed(number.value(), usize::try_from(-number.exponent).unwrap_or(0));
    }
    let raised = power_of_ten(f64::from(number.exponent));
    if number.digit == 1 { raised } else { format!("{}×{raised}", number.digit) }
}

/// A value in a few digits, as on a contour: `0.245`, `1.5×10⁻⁹`.
pub(super) fn on_contour(value: f64, step: f64) -> String {
    let size = value.abs();
    if size == 0.0 {
        return "0".to_owned();
    }
    if !(1e-3..1e5).contains(&size) {
        let exponent = size.log10().floor();
        let (mantissa, power) = (short(without(value, exponent as i32), 3), power_of_ten(exponent));
        return if mantissa == "1" { power } else { format!("{mantissa}×{power}") };
    }
    let places = if step > 0.0 { (-step.log10() - 1e-9).ceil().clamp(0.0, 8.0) as usize } else { 3 };
    fixed(value, places)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(from: f64, to: f64, scale: Scale, most: usize) -> (Vec<String>, i32) {
        let ticks = Ticks::new(&Scaled { from, to, scale }, most, false);
        (ticks.ticks.into_iter().filter_map(|tick| tick.label).collect(), ticks.power)
    }

    #[test]
    fn linear_ticks_are_round_and_few() {
        assert_eq!(labels(0.0, 1.0, Scale::Linear, 5).0, ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(-0.31, 0.32, Scale::Linear, 4).0, ["−0.2", "0.0", "0.2"]);
        assert_eq!(labels(-100.0, 512.0, Scale::Linear, 4).0, ["0", "200", "400"]);
        assert_eq!(labels(0.0, 3.0e-9, Scale::Linear, 3), (vec!["0".into(), "1".into(), "2".into(), "3".into()], -9));
        assert_eq!(labels(0.0, 2.0e7, Scale::Linear, 2), (vec!["0".into(), "10".into(), "20".into()], 6));
    }

    #[test]
    fn decades_are_labelled_and_divided() {
        assert_eq!(labels(1e-6, 1e2, Scale::Log, 8).0.len(), 9);
        assert_eq!(labels(1e-2, 1e3, Scale::Log, 6).0, ["0.01", "0.1", "1", "10", "100", "1000"]);
        assert_eq!(labels(3e3, 1e5, Scale::Log, 5).0, ["5×10³", "10⁴", "2×10⁴", "5×10⁴", "10⁵"]);
        assert_eq!(labels(1e3, 1e9, Scale::Log, 3).0, ["10⁴", "10⁶", "10⁸"]);
        assert_eq!(labels(1.0, 1.5, Scale::Log, 5).0, ["1.0", "1.2", "1.4"]);
        let ticks = Ticks::new(&Scaled { from: 1.0, to: 100.0, scale: Scale::Log }, 4, false).ticks;
        let minor: Vec<f64> = ticks.iter().filter(|tick| tick.label.is_none()).map(|tick| tick.at).collect();
        assert_eq!(minor.len(), 16);
        assert!(minor.contains(&30.0) && !minor.contains(&10.0));
    }

    #[test]
    fn any_range_has_a_handful_of_ticks() {
        let values = [-1e300, -1e12, -1.0, -1e-12, 0.0, 1e-300, 1e-12, 1.0, 1.0 + 1e-15, 1e12, 1e300, f64::MAX];
        for from in values {
            for to in values {
                for scale in [Scale::Linear, Scale::Log] {
                    for range in [Range::Auto, Range::Fixed(from, to), Range::Including(vec![0.0])] {
                        let scaled = Scaled::new(&range, scale, [from, f64::NAN, to].into_iter(), true);
                        assert!(scaled.to > scaled.from, "{from} {to} {scaled:?}");
                        let ticks = Ticks::new(&scaled, 5, false);
                        let labelled = ticks.ticks.iter().filter(|tick| tick.label.is_some()).count();
                        assert!((1..=8).contains(&labelled), "{from} {to} {scaled:?}: {ticks:?}");
                        assert!(ticks.ticks.len() < 60, "{scaled:?}: {} ticks, {labelled} labelled", ticks.ticks.len());
                    }
                }
            }
        }
    }

    #[test]
    fn places_and_values_agree() {
        for scale in [Scale::Linear, Scale::Log] {
            let range = Scaled { from: 0.2, to: 7.0, scale };
            for fraction in [0.0, 0.3, 1.0] {
                assert!((range.fraction(range.value(fraction)) - fraction).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn values_on_contours() {
        assert_eq!(on_contour(0.25, 0.05), "0.25");
        assert_eq!(on_contour(-400.0, 100.0), "−400");
        assert_eq!(on_contour(1e-9, 1e-9), "10⁻⁹");
        assert_eq!(on_contour(1.5e-9, 1e-9), "1.5×10⁻⁹");
    }
}
