//! Views: each draws one run at one phase of the cycle.
//!
//! A redraw reads the two frames around the present instant only (`sample`); what needs the whole recording is computed once for a run (`scales`).
//! Everything is drawn with the painter, on axes of our own (`paint`): one x axis is shared by all parts of a view.

mod field;
mod history;
mod hold;
mod loads;
mod map;
mod motor;
pub mod overlay;
mod paint;
mod plate;
mod sample;
mod scales;
mod series;
pub mod swept;
mod tooth;
mod wave;

use crate::gui::command::Command;
use crate::gui::holding::Holding;
use crate::gui::starting::Starting;
use crate::gui::state::View;
use crate::job::Run;
use crate::problem::Scenario;
use eframe::egui::Ui;

pub use history::words;
pub use scales::Ranges;

/// Draws `run` in the middle of the window.
pub fn show(ui: &mut Ui, run: &Run, view: &mut View, commands: &mut Vec<Command>) {
    show_within(ui, run, None, view, commands);
}

/// As [`show`]; the axes have the ranges `within`, if `run` is one cycle of several.
pub fn show_within(ui: &mut Ui, run: &Run, within: Option<&Ranges>, view: &mut View, commands: &mut Vec<Command>) {
    match run.problem.scenario {
        Scenario::Motor(_) => motor::show(ui, run, within, view, commands),
        Scenario::Plate(_) => plate::show(ui, run, within, view, commands),
    }
}

/// Draws a held plate into what is left of `ui`; dragging moves it.
pub fn hold(ui: &mut Ui, holding: &Holding, commands: &mut Vec<Command>) {
    hold::show(ui, holding, commands);
}

/// Draws the numbers of a start-up against the cycle into the next `height` points of `ui`, and what they converge to.
pub fn history(ui: &mut Ui, starting: &Starting, periodic: Option<&Run>, height: f32, commands: &mut Vec<Command>) {
    history::show(ui, starting, periodic, height, commands);
}

#[cfg(test)]
mod tests {
    use crate::control::{Cancel, Progress};
    use crate::fidelity::Fidelity;
    use crate::gui::command::Command;
    use crate::gui::state::View;
    use crate::gui::theme;
    use crate::job::Run;
    use crate::problem::Problem;
    use crate::recording::Recording;
    use crate::scene::presets;
    use crate::solve::{Method, Settings, solve};
    use eframe::egui::{Vec2, pos2, vec2};
    use egui_kittest::Harness;

    fn run(preset: &str, set: &[(&str, &str)], method: Method) -> Run {
        let mut scene = presets::find(preset).unwrap();
        scene.set_all(set.iter().copied()).unwrap();
        let problem = Problem::new(&scene).unwrap();
        let settings = Settings { fidelity: Fidelity::Draft, method, ..Settings::default() };
        let solution = solve(&problem, &settings, &mut |_: &Progress| (), &Cancel::new()).unwrap();
        let (validity, history) = (Vec::new(), Vec::new());
        Run { number: 1, scene, problem, fidelity: Fidelity::Draft, solution, validity, wall_s: 0.0, history }
    }

    /// Draws a few frames at several phases and cursors; returns the state of the view and what was asked.
    fn look(run: &Run, size: Vec2, click: bool) -> (View, Vec<Command>) {
        let mut harness = Harness::builder().with_size(size).build_ui_state(
            |ui, (view, commands): &mut (View, Vec<Command>)| {
                theme::install_fonts(ui.ctx());
                super::show(ui, run, view, commands);
            },
            (View::default(), Vec::new()),
        );
        for (phase, cursor, tooth) in [(0.0, None, 0), (0.37, Some(0.0), 1), (0.999, Some(2.1e-3), 1000)] {
            let view = &mut harness.state_mut().0;
            (view.phase, view.cursor_x, view.tooth) = (phase, cursor, tooth);
            harness.run_steps(2);
        }
        if click {
            let at = pos2(0.5 * size.x, 0.2 * size.y);
            harness.hover_at(at);
            harness.run_steps(1);
            harness.drag_at(at);
            harness.drop_at(at);
            harness.run_steps(1);
        }
        harness.state().clone()
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
        assert!(view.hover_x.is_some_and(|x| x > 8e-3 && x < 16e-3), "{:?}", view.hover_x);
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
