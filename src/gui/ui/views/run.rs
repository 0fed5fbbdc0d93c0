//! One run in the middle of the window.

use super::frame::Frame;
use super::{motor, plate};
use crate::gui::derived::scales::Ranges;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::paint::{has_fields, room};
use crate::job::SolvedScene;
use crate::problem::{Motor, Plate, Scenario};
use eframe::egui::Ui;

/// Draws `run` at the view's phase, and behind it `first`, a run that it is compared with, on one scale; the axes have the ranges `within`, if it
/// is one cycle of several.
pub fn show(
    ui: &mut Ui,
    run: &SolvedScene,
    within: Option<&Ranges>,
    first: Option<&SolvedScene>,
    cx: &DrawContext<'_>,
) {
    if !has_fields(&run.solution.recording) {
        return drop(ui.label("This run has no fields to show."));
    }
    let Some(area) = room(ui) else { return };
    let first = first.filter(|first| first.number != run.number);
    if let Some(shown) = frame(ui, run, within, first, motor_of, cx) {
        motor::show(ui, area, &shown, cx);
    } else if let Some(shown) = frame(ui, run, within, first, plate_of, cx) {
        plate::show(ui, area, &shown, cx);
    }
}

/// What the views draw of `run`, if it is of what `pick` picks.
fn frame<'a, T>(
    ui: &Ui,
    run: &'a SolvedScene,
    within: Option<&Ranges>,
    first: Option<&'a SolvedScene>,
    pick: fn(&Scenario) -> Option<&T>,
    cx: &DrawContext<'a>,
) -> Option<Frame<'a, T>> {
    let view = &cx.state.view;
    let first = first.and_then(|first| Frame::of(ui, "scales of the first run", first, pick, view));
    let shown = Frame::of(ui, "scales", run, pick, view)?;
    let both = first.as_ref().map_or(shown.ranges, |first| shown.ranges.and(first.ranges));
    Some(Frame { ranges: within.copied().unwrap_or(both), first: first.map(Box::new), ..shown })
}

fn motor_of(scenario: &Scenario) -> Option<&Motor> {
    if let Scenario::Motor(motor) = scenario { Some(motor) } else { None }
}

fn plate_of(scenario: &Scenario) -> Option<&Plate> {
    if let Scenario::Plate(plate) = scenario { Some(plate) } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::{Cancel, Progress};
    use crate::fidelity::Fidelity;
    use crate::gui::command::Command;
    use crate::gui::state::document::Document;
    use crate::gui::state::startup::as_solved;
    use crate::gui::state::view::View;
    use crate::gui::state::window::State;
    use crate::gui::ui::theme;
    use crate::platform::Instant;
    use crate::problem::Problem;
    use crate::recording::Recording;
    use crate::scene::presets;
    use crate::solve::{Method, Settings, solve};
    use eframe::egui::{Vec2, pos2, vec2};
    use egui_kittest::Harness;

    fn run(preset: &str, set: &[(&str, &str)], method: Method) -> SolvedScene {
        let mut scene = presets::find(preset).unwrap();
        scene.set_all(set.iter().copied()).unwrap();
        let problem = Problem::try_from(&scene).unwrap();
        let settings = Settings { fidelity: Fidelity::Draft, method, ..Settings::default() };
        let solution = solve(&problem, &settings, &mut |_: &Progress| (), &Cancel::new()).unwrap();
        as_solved(1, scene, problem, Fidelity::Draft, solution.outcome, solution.recording)
    }

    /// Draws a few frames at several phases and cursors; returns the state of the view and what was asked.
    fn look(run: &SolvedScene, size: Vec2, click: bool) -> (View, Vec<Command>) {
        let state = State::new(Document::fundamental().unwrap());
        let mut harness = Harness::builder().with_size(size).build_ui_state(
            |ui, (state, commands): &mut (State, Vec<Command>)| {
                theme::install_fonts(ui.ctx());
                let cx = DrawContext::new(state, Instant::now());
                show(ui, run, None, None, &cx);
                for command in cx.into_commands() {
                    match command {
                        Command::Hover(x) => state.view.cursor_x = x,
                        other => commands.push(other),
                    }
                }
            },
            (state, Vec::new()),
        );
        for (phase, cursor, tooth) in [(0.0, None, 0), (0.37, Some(0.0), 1), (0.999, Some(2.1e-3), 1000)] {
            let view = &mut harness.state_mut().0.view;
            (view.phase, view.cursor_x, view.tooth) = (phase, cursor, tooth);
            harness.run_steps(2);
        }
        if click {
            let at = pos2(0.4 * size.x, 0.2 * size.y);
            harness.hover_at(at);
            harness.run_steps(1);
            harness.drag_at(at);
            harness.drop_at(at);
            harness.run_steps(1);
            // The pointer is still there.
            harness.hover_at(at);
            harness.run_steps(2);
        }
        let (state, commands) = harness.state();
        (state.view.clone(), commands.clone())
    }

    #[test]
    fn every_kind_of_run_is_drawn_at_every_size() {
        let runs = [
            run("fundamental", &[], Method::Auto),
            run("fundamental", &[], Method::Paper),
            run("levitating", &[], Method::Auto),
            run("tooth-radius-3m", &[], Method::Auto),
            run("plate-crossover", &[], Method::Auto),
            run("plate-trapped", &[("plate.width_mm", "0.3")], Method::Auto),
        ];
        for run in &runs {
            for size in [vec2(20.0, 20.0), vec2(200.0, 180.0), vec2(430.0, 560.0), vec2(1200.0, 800.0)] {
                look(run, size, false);
            }
        }
    }

    #[test]
    fn pointing_reads_x_and_clicking_follows_a_tooth() {
        let (view, commands) = look(&run("fundamental", &[], Method::Auto), vec2(800.0, 700.0), true);
        assert!(view.cursor_x.is_some_and(|x| x > 8e-3 && x < 16e-3), "{:?}", view.cursor_x);
        assert!(matches!(commands[..], [Command::FollowTooth(3..=5)]), "{commands:?}");
    }

    #[test]
    fn extremes_do_not_disturb_it() {
        let mut still = run("levitating", &[], Method::Auto);
        let nothing = &mut still.solution.recording;
        let lines = &mut nothing.lines;
        for field in [&mut nothing.stator, &mut lines.contact, &mut lines.film, &mut lines.film_thickness] {
            field.fill(0.0);
        }
        nothing.pressure.fill(101_325.0);
        look(&still, vec2(600.0, 600.0), false);
        still.number = 2;
        still.solution.recording = Recording::default();
        look(&still, vec2(600.0, 600.0), false);
        for teeth in ["1", "64"] {
            let few =
                run("fundamental", &[("stator.teeth_per_wave", teeth), ("stator.tooth_width_mm", "0.3")], Method::Auto);
            look(&few, vec2(600.0, 600.0), false);
        }
        look(&run("fundamental", &[("stator.normal_amplitude_um", "0")], Method::Auto), vec2(600.0, 600.0), false);
    }
}
