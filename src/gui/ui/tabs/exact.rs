//! A solved plate beside its exact results: spring and damping over the squeeze number, the limits over the cycle, and the invariant.

use crate::analysis::exact::{ExactComparison, units};
use crate::digits::{percent, raised, significant};
use crate::estimate::Estimate;
use crate::export::figures::exact::exact;
use crate::gui::derived::format::uncertain;
use crate::gui::ui::cache::once;
use crate::gui::ui::chart::{Chart, legend, title};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::glossary;
use crate::gui::ui::parts::{self, BESIDE_CHARTS, scrolled};
use crate::gui::ui::rich::{self, Look};
use crate::job::SolvedScene;
use crate::problem::Scenario;
use crate::solution::{Harmonic, Outcome, PlateResult};
use eframe::egui::{RichText, TextStyle, Ui};

/// Heights of the charts: shares of the tab, and at least this many lines of text.
const SHARES: [f32; 2] = [0.33, 0.27];
const LEAST_LINES: [f32; 2] = [10.0, 9.0];
/// Significant digits of numbers without an error.
const DIGITS: usize = 4;
/// The charts: the name of each, and the glossary terms of the chart and its axes.
const CHARTS: [[&str; 4]; 2] = [
    ["Spring and damping against the squeeze number", "Squeeze number", "σ/Q", "Spring and damping"],
    ["Load over the cycle and its limits", "Film load", "t/T", "Film load"],
];

/// The explanations below the table: text and typeset formulas, as in lessons.
mod notes {
    use crate::lessons::text::{Block, blocks};
    use crate::problem::Outline;
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

    const DISC: &str = r"
Small amplitudes, $\varepsilon \to 0$, with the factor $Q\,$ by which slip eases the flow, modified Bessel functions $I$, and the radius in
$\sigma$:

$$ S + iD = 1 - \frac{2\,I_1(\kappa)}{\kappa\,I_0(\kappa)} \qquad \kappa^2 = \frac{i\sigma}{Q} $$";

    const RING: &str = r"
Small amplitudes, $\varepsilon \to 0$, with the factor $Q\,$ by which slip eases the flow, modified Bessel functions $I$ and $K$ with $\alpha$
and $\beta$ such that the pressure is that of the gas around on both edges, and the difference of the radii in $\sigma$:

$$ S + iD = 1 - \left\langle \alpha\,I_0(\kappa r) + \beta\,K_0(\kappa r) \right\rangle \qquad \kappa^2 = \frac{i\sigma}{Q} $$";

    const TRAPPED: &str = r"
Gas without time to leave, $\sigma \to \infty$: the mean pressure saturates (Langlois 1962, Salbu 1964), with slip a little lower:

$$ \langle P \rangle = \sqrt{\frac{1 + \frac{3}{2}\varepsilon^2}{1 - \varepsilon^2}} $$";

    const INVARIANT: &str = r"
The invariant, the same at every point of the film, for every $\sigma$ and $\varepsilon$, with $Z = PH\,$ and $m = \lambda_a/h_0$:

$$ \left\langle H\,\left( \frac{Z^2}{2} + 6mZ \right) \right\rangle = \left\langle \frac{H^3}{2} + 6mH^2 \right\rangle $$";

    fn read(linear: &str) -> Vec<Block> {
        // The notes are built in, and a test reads them.
        [LOAD, linear, TRAPPED, INVARIANT].into_iter().flat_map(|text| blocks(text, None).unwrap_or_default()).collect()
    }

    /// The notes for a plate of this outline.
    pub(super) fn of(outline: Outline) -> &'static [Block] {
        static NOTES: LazyLock<[Vec<Block>; 4]> = LazyLock::new(|| [STRIP, RECTANGLE, DISC, RING].map(read));
        &NOTES[match outline {
            Outline::Strip => 0,
            Outline::Rectangle { .. } => 1,
            Outline::Disc => 2,
            Outline::Ring { .. } => 3,
        }]
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        #[test]
        fn every_note_is_read() {
            for text in [LOAD, STRIP, RECTANGLE, DISC, RING, TRAPPED, INVARIANT] {
                assert!(blocks(text, None).unwrap().iter().any(|block| matches!(block, Block::Formula(_))), "{text}");
            }
        }
    }
}

/// Shows the tab.
pub fn show(ui: &mut Ui, run: &SolvedScene, cx: &DrawContext<'_>) {
    let Scenario::Plate(plate) = &run.problem.scenario else { return };
    let height = ui.available_height();
    let known = once(ui, "exact", (run.number, run.fidelity), || {
        let result = if let Outcome::Plate(result) = run.solution.outcome { result } else { PlateResult::default() };
        let found = ExactComparison::of(plate, &result, &run.solution.recording);
        let panels = exact(plate, &found, &run.solution.recording).panels;
        (found, panels)
    });
    let (found, panels) = &*known;
    scrolled(ui, "exact", BESIDE_CHARTS, |ui| {
        let em = ui.text_style_height(&TextStyle::Body);
        cx.say_if_stale(ui, run);
        for (i, panel) in panels.iter().enumerate() {
            let [name, word, below, left] = CHARTS[i];
            let unit = if panel.y.unit.is_empty() { String::new() } else { format!(", {}", panel.y.unit) };
            title(ui, &format!("{name}{unit}"), word);
            legend(ui, &[panel]);
            Chart { name, height: (SHARES[i] * height).max(LEAST_LINES[i] * em), panel, words: (Some(below), left) }
                .show(ui);
            ui.add_space(4.0);
        }
        table(ui, found, units(plate), cx);
        ui.add_space(12.0);
        let look = Look::usual(ui);
        rich::blocks(ui, notes::of(plate.outline()), look);
        ui.add_space(8.0);
    });
}

/// Computed values beside exact ones.
fn table(ui: &mut Ui, found: &ExactComparison, units: [&str; 2], cx: &DrawContext<'_>) {
    let both = |solved: Option<Harmonic<Estimate>>| match solved {
        Some(solved) => [solved.spring, solved.damping].map(uncertain),
        None => ["nothing vibrates"; 2].map(str::to_owned),
    };
    let ([spring, damping], [stiffness, loss]) = (both(found.solved), both(found.stiffness_and_damping()));
    // These are at the frequency of the vibration: in slow motion, which the stiffness at this height is for, gas leaves.
    let names = [format!("Dynamic stiffness, {}", units[0]), format!("Dynamic damping, {}", units[1])];
    let exact = |value: f64| raised(&significant(value, DIGITS));
    let Harmonic { spring: stiff, damping: lossy } = found.linear;
    let invariant = found.invariant_deviation.map_or_else(|| "no map".to_owned(), percent);
    let small = "ε → 0";
    // The name, the computed value, the exact value, and when that holds.
    let rows = [
        ["Spring S", &spring, &exact(stiff), small],
        ["Damping D", &damping, &exact(lossy), small],
        [&names[0], &stiffness, &exact(stiff * found.unit.spring), small],
        [&names[1], &loss, &exact(lossy * found.unit.damping), small],
        ["Mean pressure / p_a", &uncertain(found.mean_pressure), &exact(found.trapped_mean_pressure), "σ → ∞"],
        ["Invariant, off by", &invariant, "0 %", "any σ, ε"],
    ];
    parts::table(ui, "exact", 4, 9.0, |ui| {
        let heads = [("", ""), ("Computed", "Computed"), ("Exact limit", "Exact"), ("for", "Exact")];
        parts::heads(ui, &heads, cx);
        for [name, computed, exact, when] in rows {
            let word = name.split(" / ").next().unwrap_or(name);
            glossary::term(ui, RichText::new(name).color(cx.colours.quiet), word);
            for value in [computed, exact] {
                glossary::term(ui, RichText::new(value).color(ui.visuals().strong_text_color()), word);
            }
            ui.label(RichText::new(when).color(cx.colours.quiet));
            ui.end_row();
        }
    });
}
