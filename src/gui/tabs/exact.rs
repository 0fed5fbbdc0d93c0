//! A solved plate beside what is known exactly: spring and damping over the squeeze number, the limits over the cycle, the
//! invariant.

use super::chart::{SOLID, axes, chart, legend, place, powers, title};
use crate::analysis::exact::{Comparison, Harmonic, aspect, linear};
use crate::estimate::Estimate;
use crate::export::digits::significant;
use crate::export::exact::units;
use crate::export::json::force_unit;
use crate::fidelity::Fidelity;
use crate::gui::lessons::glossary;
use crate::gui::lessons::rich::{self, Look};
use crate::gui::panels::convergence::power_of_ten;
use crate::gui::panels::results::uncertain;
use crate::gui::theme::Palette;
use crate::job::Run;
use crate::problem::{Plate, Scenario};
use crate::solution::Outcome;
use eframe::egui::{self, Color32, Id, RichText, TextStyle, Ui};
use egui_plot::{HLine, Line, LineStyle, PlotPoints, Points, VLine};
use std::sync::Arc;

/// Heights of the charts: shares of the tab, and at least this many lines of text.
const SHARES: [f32; 2] = [0.33, 0.27];
const LEAST_LINES: [f32; 2] = [10.0, 9.0];
/// Points of a curve over the squeeze number.
const SAMPLES: usize = 81;
/// Decades to either side of the crossover, and beyond the present point.
const AROUND: f64 = 2.5;
const BEYOND: f64 = 0.6;
/// A limit whose range is at most this many times that of the load is shown whole.
const WHOLE: f64 = 2.0;
/// A tab wider than this, in heights of the text, has room for a column of remarks.
const WIDE: f32 = 28.0;
const WIDTH: f32 = 2.0;
const RADIUS: f32 = 5.0;

/// All that this tab explains below its table, as in lessons: text, and formulae that are set.
mod notes {
    use crate::lessons::text::{Block, blocks};
    use std::sync::LazyLock;

    const LOAD: &str = r"
Over a cycle, with $\tau = 2\pi t/T\,$ and the amplitude $\varepsilon$ in mean gaps, the load is its mean, a **spring** $S\,$ in step
with the approach, a **damping** $D\,$ in step with its speed, and smaller harmonics:

$$ F = F_0 + p_a A \, \varepsilon \left( -S\,\cos\tau + D\,\sin\tau \right) + \dots $$";

    const STRIP: &str = r"
Small amplitudes, $\varepsilon \to 0$, with the factor $Q\,$ by which slip eases the flow:

$$ S + iD = 1 - \frac{2}{\kappa} \tanh\frac{\kappa}{2} \qquad \kappa^2 = \frac{i\sigma}{Q} $$";

    const RECTANGLE: &str = r"
Small amplitudes, $\varepsilon \to 0$, with the factor $Q\,$ by which slip eases the flow and $a$, width over length:

$$ S + iD = \sum_{n\text{ odd}} \frac{8}{(n\pi)^2} \, \frac{i\sigma'}{q^2} \, \left( 1 - \frac{2}{qa} \tanh\frac{qa}{2} \right) $$

$$ q^2 = (n\pi)^2 + i\sigma' \qquad \sigma' = \frac{\sigma}{Q} $$";

    const TRAPPED: &str = r"
Gas without time to leave, $\sigma \to \infty$: the mean pressure saturates (Langlois 1962, Salbu 1964), with slip a little lower:

$$ \langle P \rangle = \sqrt{\frac{1 + \frac{3}{2}\varepsilon^2}{1 - \varepsilon^2}} $$";

    const INVARIANT: &str = r"
The invariant, the same at every point of the film, for every $\sigma$ and $\varepsilon$, with $Z = PH\,$ and $m = \lambda_a/h_0$:

$$ \left\langle H\,\left( \frac{Z^2}{2} + 6mZ \right) \right\rangle = \left\langle \frac{H^3}{2} + 6mH^2 \right\rangle $$";

    fn read(linear: &str) -> Vec<Block> {
        // They are built in; a test reads them.
        [LOAD, linear, TRAPPED, INVARIANT].into_iter().flat_map(|text| blocks(text).unwrap_or_default()).collect()
    }

    /// Of a strip, or of a plate of finite width.
    pub(super) fn of(strip: bool) -> &'static [Block] {
        static NOTES: LazyLock<[Vec<Block>; 2]> = LazyLock::new(|| [RECTANGLE, STRIP].map(read));
        &NOTES[usize::from(strip)]
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        #[test]
        fn every_note_is_read() {
            for text in [LOAD, STRIP, RECTANGLE, TRAPPED, INVARIANT] {
                assert!(blocks(text).unwrap().iter().any(|block| matches!(block, Block::Formula(_))), "{text}");
            }
        }
    }
}

/// What is computed once for a run.
struct Known {
    key: (u64, Fidelity),
    comparison: Comparison,
    /// log₁₀ σ/Q from, to.
    window: [f64; 2],
    spring: Vec<[f64; 2]>,
    damping: Vec<[f64; 2]>,
    load: Vec<[f64; 2]>,
    boyle: Vec<[f64; 2]>,
    viscous: Vec<[f64; 2]>,
    /// Of the load: its name and its size.
    unit: (String, f64),
    bounds: [f64; 2],
}

/// Curves for ε → 0, kept as long as width over length and the window stay.
#[derive(Clone)]
struct Curves {
    key: [u64; 3],
    spring: Vec<[f64; 2]>,
    damping: Vec<[f64; 2]>,
}

impl Known {
    fn of(ui: &Ui, run: &Run, plate: &Plate) -> Arc<Self> {
        let (id, key) = (Id::unique("squeezefilm exact"), (run.number, run.fidelity));
        if let Some(known) = ui.data(|data| data.get_temp::<Arc<Self>>(id)).filter(|known| known.key == key) {
            return known;
        }
        let fresh = Arc::new(Self::new(ui, run, plate));
        ui.data_mut(|data| data.insert_temp(id, Arc::clone(&fresh)));
        fresh
    }

    fn new(ui: &Ui, run: &Run, plate: &Plate) -> Self {
        let recording = &run.solution.recording;
        let film_load = match run.solution.outcome {
            Outcome::Plate(result) => Estimate { value: result.film_load, error: result.film_load_error },
            Outcome::Motor(_) => Estimate::default(),
        };
        let comparison = Comparison::of(plate, film_load, recording);
        let window = window(comparison.effective_squeeze_number, aspect(plate));
        let curves = curves(ui, aspect(plate), window);
        let frames = recording.frames.max(1);
        let greatest = recording.film_load.iter().fold(0.0f64, |most, load| most.max(load.abs()));
        let (prefix, size) = if greatest < 0.5 { ("m", 1e-3) } else { ("", 1.0) };
        let over = |series: &[f64]| -> Vec<[f64; 2]> {
            let count = series.len();
            (0..=count).filter(|_| count > 0).map(|m| [m as f64 / frames as f64, series[m % count] / size]).collect()
        };
        let range = |series: &[[f64; 2]]| {
            series.iter().fold([0.0f64, 0.0f64], |[low, high], [_, y]| [low.min(*y), high.max(*y)])
        };
        let load = over(&recording.film_load);
        let (boyle, viscous) = (over(&comparison.limits.boyle), over(&comparison.limits.viscous));
        let mut bounds = range(&load);
        let most = WHOLE * (bounds[1] - bounds[0]);
        for limit in [&boyle, &viscous] {
            let [low, high] = range(limit);
            if high - low <= most {
                bounds = [bounds[0].min(low), bounds[1].max(high)];
            }
        }
        let margin = 0.08 * (bounds[1] - bounds[0]).max(f64::MIN_POSITIVE);
        Self {
            key: (run.number, run.fidelity),
            comparison,
            window,
            spring: curves.spring,
            damping: curves.damping,
            load,
            boyle,
            viscous,
            unit: (format!("{prefix}{}", force_unit(&run.problem)), size),
            bounds: [bounds[0] - margin, bounds[1] + margin],
        }
    }
}

/// Decades of σ/Q that are shown: around the crossover of spring and damping, and the present.
fn window(present: f64, aspect: Option<f64>) -> [f64; 2] {
    let crossover = (10.0 * (1.0 + aspect.map_or(0.0, |a| 1.0 / (a * a)))).log10();
    let present = if present > 0.0 { present.log10() } else { crossover };
    [(crossover - AROUND).min(present - BEYOND), (crossover + AROUND).max(present + BEYOND)]
}

fn curves(ui: &Ui, aspect: Option<f64>, window: [f64; 2]) -> Curves {
    let id = Id::unique("squeezefilm linear film");
    let key = [aspect.unwrap_or(f64::INFINITY).to_bits(), window[0].to_bits(), window[1].to_bits()];
    if let Some(known) = ui.data(|data| data.get_temp::<Curves>(id)).filter(|known| known.key == key) {
        return known;
    }
    let at = |i: usize| {
        let x = window[0] + (window[1] - window[0]) * i as f64 / (SAMPLES - 1) as f64;
        let Harmonic { spring, damping } = linear(10f64.powf(x), aspect);
        ([x, spring], [x, damping])
    };
    let (spring, damping) = (0..SAMPLES).map(at).unzip();
    let fresh = Curves { key, spring, damping };
    ui.data_mut(|data| data.insert_temp(id, fresh.clone()));
    fresh
}

/// Shows the tab.
pub fn show(ui: &mut Ui, run: &Run, colours: &Palette) {
    let Scenario::Plate(plate) = &run.problem.scenario else { return };
    let height = ui.available_height();
    let known = Known::of(ui, run, plate);
    egui::ScrollArea::vertical().id_salt("exact").auto_shrink(false).show(ui, |ui| {
        // Room for the scroll bar, which floats, and for half a number at the end of an axis.
        ui.set_max_width(ui.available_width() - 14.0);
        let em = ui.text_style_height(&TextStyle::Body);
        let tall = |i: usize| (SHARES[i] * height).max(LEAST_LINES[i] * em);
        title(ui, "Spring and damping against the squeeze number", "Squeeze number");
        coefficients(ui, &known, tall(0), colours);
        ui.add_space(4.0);
        title(ui, &format!("Load over the cycle, {}", known.unit.0), "Film load");
        cycle(ui, &known, tall(1), colours);
        ui.add_space(4.0);
        table(ui, &known, units(plate), colours);
        ui.add_space(12.0);
        let look = Look::usual(ui);
        rich::blocks(ui, notes::of(plate.width.is_none()), look);
        ui.add_space(8.0);
    });
}

/// Where spring and damping are drawn in.
fn pair(colours: &Palette) -> [(&'static str, Color32); 2] {
    [("spring S", colours.film), ("damping D", colours.contact)]
}

fn coefficients(ui: &mut Ui, known: &Known, height: f32, colours: &Palette) {
    let [spring, damping] = pair(colours);
    legend(
        ui,
        &[
            (spring.0, spring.1, SOLID),
            (damping.0, damping.1, SOLID),
            ("present σ/Q, points as computed", colours.accent, SOLID),
        ],
    );
    let em = ui.text_style_height(&TextStyle::Body);
    let most = f64::from((ui.available_width() / (4.0 * em)).max(2.0));
    let name = "Spring and damping against the squeeze number";
    let computed = known.comparison.solved.map(|found| [found.spring.value, found.damping.value]);
    let top = computed.into_iter().flatten().fold(1.0, f64::max);
    let whole = place(ui, height);
    let plot = chart(ui, name, height)
        .x_axis_label("σ/Q")
        .x_grid_spacer(move |input| powers(&input, most))
        .x_axis_formatter(|mark, _| power_of_ten(mark.value.round()));
    let shown = plot.show(ui, |plot| {
        plot.set_plot_bounds_x(known.window[0]..=known.window[1]);
        plot.set_plot_bounds_y(0.0..=1.12 * top);
        let present = known.comparison.effective_squeeze_number.log10();
        plot.vline(VLine::new("", present).color(colours.accent).width(1.5).allow_hover(false));
        for (points, (_, colour)) in [(&known.spring, spring), (&known.damping, damping)] {
            plot.line(
                Line::new("", PlotPoints::from(points.clone()))
                    .color(colour)
                    .width(WIDTH)
                    .style(SOLID)
                    .allow_hover(false),
            );
        }
        for (value, (_, colour)) in computed.into_iter().flatten().zip([spring, damping]) {
            plot.points(Points::new("", vec![[present, value]]).color(colour).radius(RADIUS).allow_hover(false));
        }
    });
    shown.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, name));
    axes(ui, whole, *shown.transform.frame(), Some("σ/Q"), "Spring and damping");
}

fn cycle(ui: &mut Ui, known: &Known, height: f32, colours: &Palette) {
    let (boyle, viscous) = (colours.contact, colours.rotor);
    let dash = LineStyle::dashed_loose();
    legend(
        ui,
        &[
            ("computed", colours.film, SOLID),
            ("gas trapped, Boyle (σ → ∞)", boyle, dash),
            ("incompressible (σ → 0)", viscous, LineStyle::dashed_dense()),
        ],
    );
    let name = "Load over the cycle and its limits";
    let whole = place(ui, height);
    let shown = chart(ui, name, height).x_axis_label("t/T").show(ui, |plot| {
        plot.set_plot_bounds_x(0.0..=1.0);
        plot.set_plot_bounds_y(known.bounds[0]..=known.bounds[1]);
        plot.hline(HLine::new("", 0.0).color(colours.quiet).width(1.0).allow_hover(false));
        let lines = [
            (&known.boyle, boyle, dash),
            (&known.viscous, viscous, LineStyle::dashed_dense()),
            (&known.load, colours.film, SOLID),
        ];
        for (points, colour, style) in lines {
            let line = Line::new("", PlotPoints::from(points.clone())).color(colour).width(WIDTH);
            plot.line(line.style(style).allow_hover(false));
        }
    });
    shown.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, name));
    axes(ui, whole, *shown.transform.frame(), Some("t/T"), "Film load");
}

/// Computed beside exact.
fn table(ui: &mut Ui, known: &Known, units: [&str; 2], colours: &Palette) {
    let found = &known.comparison;
    let both = |solved: Option<Harmonic<Estimate>>| match solved {
        Some(solved) => [solved.spring, solved.damping].map(stated),
        None => ["nothing vibrates"; 2].map(str::to_owned),
    };
    let ([spring, damping], [stiffness, loss]) = (both(found.solved), both(found.stiffness_and_damping()));
    let names = [format!("Stiffness, {}", units[0]), format!("Damping, {}", units[1])];
    let linear = [found.linear.spring * found.unit.spring, found.linear.damping * found.unit.damping].map(number);
    let invariant = found.invariant_deviation.map_or_else(|| "no map".to_owned(), percent);
    // What it is called, computed, exact, and when that holds.
    let rows = [
        ["Spring S", &spring, &number(found.linear.spring), "for ε → 0"],
        ["Damping D", &damping, &number(found.linear.damping), "for ε → 0"],
        [&names[0], &stiffness, &linear[0], "for ε → 0"],
        [&names[1], &loss, &linear[1], "for ε → 0"],
        ["Mean pressure", &stated(found.mean_pressure), &number(found.trapped_mean_pressure), "for σ → ∞"],
        ["Invariant, off by", &invariant, "0 %", "at every σ and ε"],
    ];
    // In a narrow tab when the exact value holds is said on hover, and below, alone.
    let wide = ui.available_width() > WIDE * ui.text_style_height(&TextStyle::Body);
    let grid = egui::Grid::new("exact").num_columns(if wide { 4 } else { 3 }).striped(true).spacing([14.0, 4.0]);
    egui::ScrollArea::horizontal().id_salt("exact table").auto_shrink(true).show(ui, |ui| {
        grid.show(ui, |ui| {
            for head in ["", "Computed", "Exact"] {
                let label = ui.label(RichText::new(head).color(colours.quiet));
                if !head.is_empty() {
                    glossary::here(ui, label, head);
                }
            }
            ui.end_row();
            for [name, computed, exact, when] in rows {
                let label = ui.label(RichText::new(name).color(colours.quiet));
                glossary::here(ui, label, name);
                for value in [computed, exact] {
                    let value = ui.label(RichText::new(value).color(ui.visuals().strong_text_color()));
                    glossary::here(ui, value, name);
                }
                if wide {
                    ui.label(RichText::new(when).color(colours.quiet));
                }
                ui.end_row();
            }
        });
    });
}

fn stated(found: Estimate) -> String {
    uncertain(found.value, found.error)
}

fn number(value: f64) -> String {
    significant(value, 4).replace('-', "−")
}

/// A share in per cent, two digits, written out.
fn percent(share: f64) -> String {
    let value = 100.0 * share;
    let decimals = if value > 0.0 { (1.0 - value.log10().floor()).clamp(0.0, 12.0) as usize } else { 0 };
    format!("{value:.decimals$} %")
}
