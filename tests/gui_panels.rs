//! The panels of the window and the views in its middle, as a user meets them, without a window.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used)] // helpers of tests are not tests to clippy

mod scenes;

use eframe::egui::accesskit::Role;
use eframe::egui::{self, Key};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use squeezefilm::analysis::decision::{term, words};
use squeezefilm::analysis::validity::outside;
use squeezefilm::control::{Cancel, Progress};
use squeezefilm::digits::capitalised;
use squeezefilm::fidelity::Fidelity;
use squeezefilm::gui::command::Command;
use squeezefilm::gui::derived::words as labels;
use squeezefilm::gui::state::dialogs::Purpose;
use squeezefilm::gui::state::document::Document;
use squeezefilm::gui::state::edits::Change;
use squeezefilm::gui::state::view::View;
use squeezefilm::gui::state::window::State;
use squeezefilm::gui::ui::context::DrawContext;
use squeezefilm::gui::ui::panels::{parameters, results};
use squeezefilm::gui::ui::{theme, views};
use squeezefilm::job::SolvedScene;
use squeezefilm::problem::Problem;
use squeezefilm::recording::Recording;
use squeezefilm::scene::{Parameter, ParameterKind, Scene, Value, presets};
use squeezefilm::solution::{Outcome, Status};
use squeezefilm::solve::{Method, Settings, solve};
use std::sync::Arc;
use std::time::Instant;

/// A scene that is edited in the panel, with the commands that came of it.
struct Edited {
    state: State,
    pushed: Vec<Command>,
    size: f32,
}

impl Edited {
    fn of(scene: Scene) -> Self {
        Self { state: State::new(Document::opened(scene, None)), pushed: Vec::new(), size: 1.0 }
    }

    fn scene(&self) -> &Scene {
        self.state.document.scene()
    }

    fn apply(&mut self, command: &Command) {
        let (key, change) = match command.clone() {
            Command::Set { key, value, .. } => (key, Change::Value(value)),
            Command::SetText(key, text) => (key, Change::Text(text)),
            Command::Reset(key) => (key, Change::Unset),
            Command::Ask(_) => return,
            other => panic!("{other:?} does not come from this panel"),
        };
        let rejected = &mut self.state.rejected;
        match change.applied(self.state.document.scene(), key) {
            Ok(next) => {
                rejected.accept(key);
                rejected.review(&next);
                self.state.document.edit(next, key, false);
            }
            Err(error) => rejected.reject(key, change, error),
        }
    }

    fn ui(&mut self, ui: &mut egui::Ui) {
        let cx = DrawContext::new(&self.state, Instant::now());
        parameters::show(ui, &cx);
        let commands = cx.into_commands();
        commands.iter().for_each(|command| self.apply(command));
        self.pushed.extend(commands);
    }
}

/// A panel of this width, with text that is `size` times as large.
fn harness<S>(width: f32, size: f32, ui: impl FnMut(&mut egui::Ui, &mut S) + 'static, of: S) -> Harness<'static, S> {
    let mut harness = Harness::builder()
        .with_size(egui::vec2(width, 3000.0))
        .with_context_setup(move |ctx| {
            theme::install_fonts(ctx);
            ctx.all_styles_mut(|style| style.text_styles.values_mut().for_each(|font| font.size *= size));
        })
        .build_ui_state(ui, of);
    harness.run();
    harness
}

fn panel(edited: Edited) -> Harness<'static, Edited> {
    harness(300.0, edited.size, |ui, edited: &mut Edited| edited.ui(ui), edited)
}

fn open_all(harness: &mut Harness<'_, Edited>) {
    for title in ["Rotor", "Film", "Surface", "Numerics"] {
        if let Some(header) = harness.query_by_label(title) {
            header.click();
            harness.run();
        }
    }
}

/// The panel with every group of it open.
fn opened(scene: Scene) -> Harness<'static, Edited> {
    let mut harness = panel(Edited::of(scene));
    open_all(&mut harness);
    harness
}

fn scenes() -> Vec<Scene> {
    let with = |mut scene: Scene, changes: &[(&str, &str)]| {
        changes.iter().for_each(|(key, text)| scene.set(key, text).unwrap());
        scene
    };
    let motor = |changes: &[(&str, &str)]| with(Scene::motor(), changes);
    let nodes = ["numerics.film_nodes_along", "numerics.film_nodes_across", "numerics.steps_per_cycle"];
    let wide = [&[("plate.width_mm", "2")][..], &nodes.map(|key| (key, "41"))].concat();
    let all = "[{r_inner_mm = 0, r_outer_mm = 60, z_bottom_mm = 0, z_top_mm = 9, fixed = \"radial\"}]";
    vec![
        Scene::motor(),
        Scene::plate(),
        motor(&[("stator.tooth_radius_m", "6.5")]),
        motor(&[("rotor.compliance", "[[100, 1e-9], [200, 5e-10]]")]),
        with(Scene::plate(), &wide),
        motor(&[("film.gas", "helium"), ("film.altitude_m", "2000"), ("film.slip", "fukui-kaneko")]),
        motor(&[
            ("rotor.model", "section"),
            ("motor.load_n", "20"),
            ("stator.tooth_share", "0.5"),
            ("motor.rotor_speed_mm_per_s", "9"),
        ]),
        motor(&[("rotor.green", "[[0, 0.6], [1, 0.5]]")]),
        motor(&[("rotor.model", "ring"), ("rotor.support", all)]),
        motor(&[("surface.model", "asperities"), ("surface.flow_factors", "patir-cheng")]),
    ]
}

#[test]
fn a_ring_has_an_outer_radius() {
    for (shape, outer) in [("disc", false), ("ring", true)] {
        let mut plate = Scene::plate();
        plate.set("plate.shape", shape).unwrap();
        let harness = opened(plate);
        let shown = |label: &str| harness.query_all_by_label(label).next().is_some();
        assert_eq!([shown("Outer radius"), shown("Radius"), shown("Radius of the hole")], [outer, !outer, outer]);
    }
}

#[test]
fn every_parameter_has_a_named_widget() {
    for scene in scenes() {
        let harness = opened(scene.clone());
        for parameter in scene.parameters() {
            let name = labels::label(parameter);
            let has = |role, label: &str| harness.query_all_by_role_and_label(role, label).count() == 1;
            let present = scene.get(parameter.key).is_some();
            let found = match parameter.kind {
                ParameterKind::Number { .. } | ParameterKind::Whole { .. } => {
                    let switched = parameter.absent.is_none() || has(Role::CheckBox, parameter.switch);
                    let edited = has(Role::Slider, name) && has(Role::TextInput, &labels::field_name(parameter));
                    switched && edited == present
                }
                ParameterKind::Flag { .. } => has(Role::CheckBox, name),
                ParameterKind::Choice { .. } => has(Role::ComboBox, name),
                ParameterKind::Text { .. } => has(Role::MultilineTextInput, name),
                ParameterKind::CsvPath { .. } => has(Role::TextInput, name),
                ParameterKind::Records { columns, .. } => {
                    let Some(Value::Records(records)) = scene.get(parameter.key) else { panic!("{}", parameter.key) };
                    records.iter().enumerate().all(|(i, record)| {
                        let of = match &record[0] {
                            Value::Text(part) => part.clone(),
                            _ => format!("{} {}", name.trim_end_matches('s').to_lowercase(), i + 1),
                        };
                        let named = |column: &Parameter| format!("{}, {of}", labels::field_name(column));
                        let numbers = columns.iter().filter(|column| column.range().is_some());
                        numbers.into_iter().all(|column| has(Role::SpinButton, &named(column)))
                    })
                }
                ParameterKind::Rows { .. } => harness.query_by_label("2 rows").is_some(),
            };
            assert!(found, "{} in {}", parameter.key, scene.scene());
        }
        assert_eq!(harness.state().pushed, [], "looking changes nothing");
    }
}

fn click(harness: &mut Harness<'_, Edited>, label: &str) {
    harness.get_by_label(label).click();
    harness.run();
}

fn click_a(harness: &mut Harness<'_, Edited>, role: Role, name: &str) {
    harness.get_by_role_and_label(role, name).click();
    harness.run();
}

fn press(harness: &mut Harness<'_, Edited>, key: Key) {
    harness.key_press(key);
    harness.run();
}

fn type_into(harness: &mut Harness<'_, Edited>, name: &str, text: &str) {
    click_a(harness, Role::TextInput, name);
    // The old text is selected, so typing replaces it.
    harness.get_by_role_and_label(Role::TextInput, name).type_text(text);
    harness.run();
}

fn enter(harness: &mut Harness<'_, Edited>, name: &str, text: &str) {
    type_into(harness, name, text);
    press(harness, Key::Enter);
}

fn typed(harness: &Harness<'_, Edited>, name: &str) -> Option<String> {
    harness.get_by_role_and_label(Role::TextInput, name).value()
}

#[test]
fn a_typed_number_is_set_once_by_enter_and_by_leaving_the_field() {
    for (name, key, text, done) in [
        ("Minimum spacing H_m in nm", "film.min_spacing_nm", "120", Key::Enter),
        ("Tooth width in mm", "stator.tooth_width_mm", "1.5", Key::Tab),
    ] {
        let mut harness = panel(Edited::of(Scene::motor()));
        type_into(&mut harness, name, text);
        assert_eq!(harness.state().pushed, [], "nothing happens while it is typed");
        press(&mut harness, done);
        harness.run_steps(5);
        assert_eq!(harness.state().pushed, [Command::SetText(key, text.into())]);
        assert_eq!(typed(&harness, name).as_deref(), Some(text));
    }
}

#[test]
fn a_slider_moves_by_keys_and_by_the_pointer() {
    let mut harness = panel(Edited::of(Scene::motor()));
    harness.get_by_role_and_label(Role::Slider, "Waves round the ring").focus();
    harness.run();
    press(&mut harness, Key::ArrowRight);
    let set = |value, dragging| Command::Set { key: "motor.waves", value: Value::Whole(value), dragging };
    assert_eq!(harness.state().pushed, [set(8, false)]);

    harness.state_mut().pushed.clear();
    let rail = harness.get_by_role_and_label(Role::Slider, "Frequency").rect();
    harness.drag_at(rail.center());
    harness.step();
    harness.hover_at(rail.center() + egui::vec2(60.0, 0.0));
    harness.step();
    harness.drop_at(rail.center() + egui::vec2(60.0, 0.0));
    harness.run();
    let flags: Vec<bool> = harness
        .state()
        .pushed
        .iter()
        .map(|command| match command {
            Command::Set { key: "stator.frequency_khz", dragging, .. } => *dragging,
            other => panic!("{other:?}"),
        })
        .collect();
    let (last, before) = flags.split_last().unwrap();
    assert!(!last && !before.is_empty() && before.iter().all(|dragging| *dragging), "{flags:?}");
    assert!(harness.state().scene().get("stator.frequency_khz").unwrap().as_number().unwrap() > 30.0);
}

#[test]
fn what_is_refused_stays_until_it_is_corrected_or_escaped() {
    let mut harness = panel(Edited::of(Scene::motor()));
    let name = "Minimum spacing H_m in nm";
    let shown = |harness: &Harness<'_, Edited>| typed(harness, name);
    enter(&mut harness, name, "3");
    harness.get_by_label("3 is out of range: allowed 5 to 10000 nm");
    harness.get_by_label_contains("Still 200 nm");
    assert_eq!(shown(&harness).as_deref(), Some("3"));
    assert!(harness.get_by_role_and_label(Role::TextInput, name).is_focused(), "the next key corrects");

    press(&mut harness, Key::Escape);
    assert_eq!(shown(&harness).as_deref(), Some("200"));
    assert!(harness.query_by_label_contains("out of range").is_none());
    assert_eq!(harness.state().scene(), &Scene::motor());

    type_into(&mut harness, name, "thick");
    press(&mut harness, Key::Tab);
    harness.get_by_label_contains("expected a number from 5 to 10000 nm, in nm, µm, mm, cm, m");
    assert_eq!(shown(&harness).as_deref(), Some("thick"));
    enter(&mut harness, name, "150");
    assert_eq!(shown(&harness).as_deref(), Some("150"));
    assert!(harness.query_by_label_contains("expected a number").is_none());
    // Units, decimal commas and sums.
    for (text, nanometres) in [("0,25 µm", "250"), ("(0.1 + 0.02) um", "120")] {
        enter(&mut harness, name, text);
        assert_eq!(shown(&harness).as_deref(), Some(nanometres));
    }
    // More digits than anyone reads are there when the cursor is, and stay in the scene when it leaves.
    enter(&mut harness, name, "500/3");
    assert_eq!(shown(&harness).as_deref(), Some("166.667"));
    click_a(&mut harness, Role::TextInput, name);
    let spacing = harness.state().scene().get("film.min_spacing_nm").unwrap();
    assert!((spacing.as_number().unwrap() - 500.0 / 3.0).abs() < 1e-6);
    assert_eq!(shown(&harness), Some(spacing.to_string()));
    press(&mut harness, Key::Tab);
    assert_eq!(
        (shown(&harness).as_deref(), harness.state().scene().get("film.min_spacing_nm")),
        (Some("166.667"), Some(spacing))
    );
}

#[test]
fn a_number_has_as_many_digits_as_fit_its_field() {
    let scene = Scene::motor().with([("motor.dry_friction", "0.286212")]).unwrap();
    let mut harness = panel(Edited::of(scene));
    let name = "Dry friction coefficient as a number";
    let shown = |harness: &Harness<'_, Edited>| typed(harness, name);
    assert_eq!(shown(&harness).as_deref(), Some("0.28621"));
    click_a(&mut harness, Role::TextInput, name);
    assert_eq!(shown(&harness).as_deref(), Some("0.286212"));
}

#[test]
fn a_refused_slider_says_why_and_escape_takes_the_message_away() {
    let mut edited = Edited::of(Scene::motor());
    edited.apply(&Command::Set { key: "motor.contact_radius_mm", value: Value::Number(5.0), dragging: false });
    let mut harness = panel(edited);
    harness.get_by_label_contains("of the tooth pitch");
    harness.get_by_label("Still 29 mm");
    click_a(&mut harness, Role::TextInput, "Contact radius in mm");
    press(&mut harness, Key::Escape);
    assert!(harness.query_by_label_contains("of the tooth pitch").is_none());
}

#[test]
fn a_refusal_opens_the_group_it_is_in() {
    let mut edited = Edited::of(Scene::motor());
    let (key, change) = ("film.viscosity_upa_s", Change::Text("0".into()));
    edited.state.rejected.reject(key, change, "film.viscosity_upa_s = 0 is out of range".into());
    panel(edited).get_by_label("0 is out of range");
}

#[test]
fn one_click_brings_back_what_was_opened() {
    let [opened, next] = ["1", "2"].map(|load| Scene::motor().with(&[("motor.load_per_wave_n", load)]).unwrap());
    let mut edited = Edited::of(opened.clone());
    edited.state.document.edit(next, "motor.load_per_wave_n", false);
    let mut harness = panel(edited);
    assert!(harness.query_by_label("Reset tooth width").is_none(), "it is as it was");
    click(&mut harness, "Reset load on one wave");
    let (key, value) = ("motor.load_per_wave_n", Value::Number(1.0));
    assert_eq!(harness.state().pushed, [Command::Set { key, value, dragging: false }]);
    assert_eq!(harness.state().scene(), &opened);
    assert!(harness.query_by_label("Reset load on one wave").is_none());
}

#[test]
fn an_optional_parameter_is_switched() {
    let mut harness = panel(Edited::of(Scene::plate()));
    for on in [true, false] {
        click(&mut harness, "Finite width");
        assert_eq!(harness.state().scene().get("plate.width_mm").is_some(), on);
        assert_eq!(harness.query_by_role_and_label(Role::Slider, "Width").is_some(), on);
    }
    assert_eq!(harness.state().pushed[1], Command::Reset("plate.width_mm"));
}

#[test]
fn choices_and_flags_are_set() {
    let mut harness = opened(Scene::motor());
    click_a(&mut harness, Role::CheckBox, "Sliding drags gas along");
    click_a(&mut harness, Role::ComboBox, "Slip at the walls");
    click(&mut harness, "Fukui and Kaneko");
    let set = |key, value| Command::Set { key, value, dragging: false };
    let expected = [set("film.shear", Value::Flag(false)), set("film.slip", Value::Text("fukui-kaneko".into()))];
    assert_eq!(harness.state().pushed, expected);
}

#[test]
fn a_list_closes_when_enter_takes_an_entry() {
    let mut harness = opened(Scene::motor());
    let slip = "Slip at the walls";
    harness.get_by_role_and_label(Role::ComboBox, slip).focus();
    harness.run();
    press(&mut harness, Key::Enter);
    // It is the box that the key was pressed on: the list is open.
    assert!(harness.query_by_label("Second-order").is_some());
    harness.get_by_label("Fukui and Kaneko").focus();
    harness.run();
    press(&mut harness, Key::Enter);
    assert_eq!(harness.state().scene().get("film.slip"), Some(Value::Text("fukui-kaneko".into())));
    assert!(harness.query_by_label("Second-order").is_none(), "it is closed");
    assert!(harness.get_by_role_and_label(Role::ComboBox, slip).is_focused());
}

#[test]
fn what_follows_from_the_gas_is_shown_and_not_edited() {
    let mut harness = opened(Scene::motor());
    click_a(&mut harness, Role::ComboBox, "Gas");
    click(&mut harness, "Helium");
    for (name, value) in [("Viscosity", "19.61 µPa·s"), ("Mean free path", "189.3 nm")] {
        assert!(harness.query_by_role_and_label(Role::Slider, name).is_none(), "{name}");
        harness.get_by_label(value);
    }
    click(&mut harness, "Pressure of an altitude");
    enter(&mut harness, "Altitude in m", "2000");
    assert!(harness.query_by_role_and_label(Role::Slider, "Ambient pressure").is_none());
    harness.get_by_label("79.50 kPa");
    harness.get_by_label("241.3 nm");
    // Custom again: what was given before it had a name is gone, and the defaults are back.
    click_a(&mut harness, Role::ComboBox, "Gas");
    click(&mut harness, "Custom");
    assert_eq!(*harness.state().scene(), Scene::motor());
}

#[test]
fn one_of_two_ways_to_say_a_thing_is_edited_and_shows_the_other() {
    let mut harness = panel(Edited::of(Scene::motor()));
    harness.get_by_label("Now 17.15 N");
    click(&mut harness, "Load on the whole ring");
    enter(&mut harness, "Load on the ring in N", "70");
    harness.get_by_label("10.00 N");
    assert!(harness.query_by_role_and_label(Role::Slider, "Load on one wave").is_none());
    click(&mut harness, "Tooth width as a share of the pitch");
    // 0.6 of 2π · 29 mm/63.
    harness.get_by_label("1.735 mm");
    assert_eq!(harness.state().scene().get("stator.tooth_width_mm"), None);
}

#[test]
fn a_tick_changes_the_form_and_not_the_value() {
    for (key, value, switch, form) in [
        ("motor.load_per_wave_n", "5", "Load on the whole ring", "motor.load_n"),
        ("motor.rotor_speed_rpm", "20", "Speed in mm/s", "motor.rotor_speed_mm_per_s"),
        ("stator.tooth_width_mm", "1.767", "Tooth width as a share of the pitch", "stator.tooth_share"),
    ] {
        let scene = Scene::motor().with([(key, value)]).unwrap();
        let now = scene.alternative(Parameter::find(form).unwrap()).unwrap();
        let mut harness = panel(Edited::of(scene.clone()));
        click_a(&mut harness, Role::CheckBox, switch);
        let ticked = harness.state().scene().get(form).and_then(|value| value.as_number()).unwrap();
        assert!((ticked / now - 1.0).abs() < 1e-6, "{form} = {ticked}");
        click_a(&mut harness, Role::CheckBox, switch);
        assert_eq!(*harness.state().scene(), scene);
    }
    // The mean gap was not on screen, and the default is no more than the amplitude.
    let floating = Scene::plate().with([("plate.mass_g", "100"), ("plate.amplitude_um", "1")]).unwrap();
    let mut harness = panel(Edited::of(floating));
    click_a(&mut harness, Role::CheckBox, "Floats under its weight");
    assert_eq!(harness.state().scene().get("plate.mean_gap_um"), Some(Value::Number(2.0)));
    // What was refused of one form is forgotten with it.
    let mut harness = panel(Edited::of(Scene::motor()));
    enter(&mut harness, "Load on one wave in N", "200");
    assert!(harness.state().state.rejected.of("motor.load_per_wave_n").is_some());
    click_a(&mut harness, Role::CheckBox, "Load on the whole ring");
    assert_eq!(harness.state().state.rejected.of("motor.load_per_wave_n"), None);
}

#[test]
fn a_table_comes_from_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rotor.csv");
    std::fs::write(&path, "wavenumber_per_m,compliance_m2_per_n\n100,1e-9\n200,5e-10\n").unwrap();
    let mut harness = opened(Scene::motor());
    enter(&mut harness, "Compliance from a CSV file", path.to_str().unwrap());
    let (model, rejected) = (harness.state().scene().get("rotor.model"), &harness.state().state.rejected);
    assert_eq!(model, Some(Value::Text("table".into())), "{rejected:?}");
    harness.get_by_label("2 rows");
}

#[test]
fn a_table_can_be_asked_for() {
    for (name, key) in [
        ("Open: Compliance from a CSV file", "rotor.compliance_csv"),
        ("Open: Deflection from a CSV file", "rotor.green_csv"),
    ] {
        let mut harness = opened(Scene::motor());
        click(&mut harness, name);
        assert_eq!(harness.state().pushed, [Command::Ask(Purpose::Csv(key))]);
    }
}

#[test]
fn a_first_support_holds_the_inner_edge_of_the_ring_and_a_second_is_like_it() {
    let mut harness = opened(presets::find("ring-rotor").unwrap());
    let supports = |harness: &Harness<'_, Edited>| match harness.state().scene().get("rotor.support") {
        Some(Value::Records(supports)) => supports,
        _ => panic!("no supports"),
    };
    click(&mut harness, "Add support");
    let lengths = [24.9, 24.9, 0.75, 5.75].map(Value::Number);
    let first = [&lengths[..], &[Value::Text("axial".into())]].concat();
    assert_eq!(supports(&harness), std::slice::from_ref(&first));
    assert_eq!(harness.state().state.rejected.of("rotor.support"), None);
    harness.get_by_role_and_label(Role::SpinButton, "Inner radius in mm, support 1");
    click(&mut harness, "Add support");
    assert_eq!(supports(&harness), [first.clone(), first]);
}

#[test]
fn a_ring_that_is_chosen_suits_the_motor() {
    let mut harness = opened(presets::find("motor-60mm-helium").unwrap());
    click_a(&mut harness, Role::ComboBox, "Compliance model");
    click(&mut harness, "Ring, by its cross-section");
    let inner = harness.state().scene().get("rotor.part.lining.r_inner_mm");
    assert_eq!(inner, Some(Value::Number(26.0)));
    assert!(harness.query_by_label("Reset parts").is_none(), "there is nothing else to go back to");
}

#[test]
fn a_refused_length_stays_in_its_field_with_the_reason_below_its_part() {
    let ring = presets::find("ring-rotor").unwrap();
    let mut harness = opened(ring.clone());
    let field = "Outer radius in mm, rim";
    let shown = |harness: &Harness<'_, Edited>| {
        harness.get_by_role_and_label(Role::SpinButton, field).value().unwrap_or_default()
    };
    let enter = |harness: &mut Harness<'_, Edited>, text: &str| {
        click_a(harness, Role::SpinButton, field);
        harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
        harness.get_by_role_and_label(Role::SpinButton, field).type_text(text);
        harness.run();
        press(harness, Key::Enter);
    };
    for (text, reason) in [("27", "outer radius = 27 mm: allowed above its inner radius"), ("wide", "wide: expected")] {
        enter(&mut harness, text);
        assert_eq!(shown(&harness), text);
        let below = harness.get_by_label_contains(reason).rect().top();
        let top = |name: &str| harness.get_by_role_and_label(Role::SpinButton, name).rect().top();
        assert!(top(field) < below && below < top("Inner radius in mm, flange"), "{text}: it is told at the part");
    }
    click_a(&mut harness, Role::SpinButton, field);
    press(&mut harness, Key::Escape);
    assert!(shown(&harness).starts_with("29.7"), "{}", shown(&harness));
    assert!(harness.query_by_label_contains("expected a number").is_none());
    assert_eq!(harness.state().scene(), &ring);
    // A correction is taken, and what it was before is too.
    for (text, radius) in [("27", 29.7), ("30", 30.0), ("27", 30.0), ("30", 30.0)] {
        enter(&mut harness, text);
        let length = harness.state().scene().get("rotor.part.rim.r_outer_mm");
        assert_eq!(length, Some(Value::Number(radius)), "{text}");
        assert_eq!(harness.query_by_label_contains("outer radius = 27 mm").is_some(), text == "27");
    }
}

#[test]
fn what_an_array_was_refused_for_goes_with_the_next_edit() {
    let mut edited = Edited::of(presets::find("ring-rotor").unwrap());
    let nowhere = [1.0, 1.0, 1.0, 1.0].map(Value::Number);
    let support = [&nowhere[..], &[Value::Text("axial".into())]].concat();
    edited.apply(&Command::Set { key: "rotor.support", value: Value::Records(vec![support]), dragging: false });
    let mut harness = panel(edited);
    harness.get_by_label_contains("no part is within");
    enter(&mut harness, "Minimum spacing H_m in nm", "150");
    assert!(harness.query_by_label_contains("no part is within").is_none());
}

#[test]
fn names_are_kept_on_one_line() {
    let mut harness = panel(Edited::of(Scene::motor()));
    click_a(&mut harness, Role::MultilineTextInput, "Name");
    harness.get_by_role_and_label(Role::MultilineTextInput, "Name").type_text("Mine, 2nd");
    press(&mut harness, Key::Enter);
    assert_eq!(harness.state().scene().name, "Mine, 2nd");
}

#[test]
fn nothing_is_cut_in_a_narrow_panel_with_large_text() {
    for (width, size) in [(260.0, 1.0), (260.0, 1.5), (340.0, 1.5)] {
        for scene in scenes() {
            let mut harness = panel(Edited { size, ..Edited::of(scene) });
            harness.set_size(egui::vec2(width, 4000.0));
            open_all(&mut harness);
            for role in [Role::Slider, Role::TextInput, Role::CheckBox, Role::ComboBox, Role::Label] {
                for node in harness.query_all_by_role(role) {
                    let (right, name) = (node.rect().right(), node.accesskit_node().label());
                    assert!(right <= width + 0.5, "{name:?} at {width} × {size}");
                }
            }
        }
    }
}

fn run(preset: &str) -> SolvedScene {
    run_with(preset, &[])
}

fn run_with(preset: &str, set: &[(&str, &str)]) -> SolvedScene {
    run_by(Method::Auto, preset, set)
}

fn run_by(method: Method, preset: &str, set: &[(&str, &str)]) -> SolvedScene {
    let scene = scenes::scene(preset, set);
    let problem = Problem::try_from(&scene).unwrap();
    let settings = Settings { fidelity: Fidelity::Draft, method, ..Settings::default() };
    let mut history = Vec::new();
    let mut listen = |progress: &Progress| history.push(*progress);
    let solution = Arc::new(solve(&problem, &settings, &mut listen, &Cancel::new()).unwrap());
    let validity = outside(&problem, &solution);
    SolvedScene { number: 1, scene, problem, fidelity: Fidelity::Draft, solution, validity, wall_s: 0.0123, history }
}

fn shown(run: SolvedScene, width: f32, size: f32) -> Harness<'static, SolvedScene> {
    let state = State::new(Document::opened(run.scene.clone(), None));
    let ui = move |ui: &mut egui::Ui, run: &mut SolvedScene| {
        results::show(ui, run, &DrawContext::new(&state, Instant::now()));
    };
    harness(width, size, ui, run)
}

#[test]
fn the_results_show_alpha_and_what_goes_with_it() {
    let run = run("fundamental");
    let Outcome::Motor(result) = run.solution.outcome else { panic!("a motor") };
    let harness = shown(run, 300.0, 1.0);
    let alpha = result.alpha.to_string();
    harness.get_by_label_contains(&alpha);
    for name in [
        "share of the load carried by air",
        "Film load",
        "Contact load",
        "Stall torque",
        "Maximum operating torque",
        "Maximum without film",
        "Least film thickness",
        "Highest pressure",
        "Squeeze number σ",
        "12.3 ms",
        "draft",
    ] {
        harness.get_by_label(name);
    }
    assert!(harness.query_by_label("Levitated").is_none() && harness.query_by_label("Not converged").is_none());
    // Every decision is there: those with a switch as a combo box, the others in words.
    let decisions = harness.state().solution.model.decisions.clone();
    for decision in decisions {
        match decision.key() {
            Some(_) => drop(harness.get_by_role_and_label(Role::ComboBox, &capitalised(term(&decision)))),
            None => drop(harness.get_by_label_contains(&words(&decision)[1..])),
        }
    }
}

#[test]
fn levitation_missing_convergence_and_warnings_are_said_plainly() {
    let mut run = run("levitating");
    let solution = Arc::make_mut(&mut run.solution);
    solution.status = Status::NotConverged { residual: 2e-3, tolerance: 1e-6 };
    solution.warnings = vec!["the film is thinner than a mean free path".into()];
    let harness = shown(run, 300.0, 1.0);
    harness.get_by_label("Levitated");
    harness.get_by_label("Not converged");
    harness.get_by_label_contains("still change it by 0.20\u{a0}%, allowed 0.00010\u{a0}%");
    harness.get_by_label("The film is thinner than a mean free path");
}

#[test]
fn what_the_model_leaves_out_is_shown_only_where_it_matters() {
    // First-order slip at Kn = 0.32; inside all limits.
    for (preset, seen) in [("fundamental", true), ("floating-disc", false)] {
        let harness = shown(run(preset), 300.0, 1.0);
        assert_eq!(harness.query_by_label("Outside the limits of the model").is_some(), seen, "{preset}");
        assert_eq!(harness.query_by_label("0.320, limit 0.1").is_some(), seen, "{preset}");
        assert_eq!(
            harness
                .query_by_label_contains("At Kn = 0.32, in a film of 200 nm, first-order slip predicts 20 % less")
                .is_some(),
            seen
        );
    }
}

#[test]
fn the_words_of_the_regime_say_what_the_film_carries_here() {
    let mut run = run("fundamental");
    let Outcome::Motor(result) = &mut Arc::make_mut(&mut run.solution).outcome else { panic!("a motor") };
    result.alpha.value = -0.05;
    let harness = shown(run, 300.0, 1.0);
    harness.get_by_label_contains("is a spring");
    harness.get_by_label("here its mean pressure is below ambient: it pulls the faces together with 5 % of the load");
    harness.get_by_label("the air sucks: contact carries more than the load");
}

#[test]
fn a_plate_shows_its_load_and_ratio() {
    let run = run("plate-crossover");
    let Outcome::Plate(result) = run.solution.outcome else { panic!("a plate") };
    let harness = shown(run, 300.0, 1.0);
    let load = result.film_load.to_string();
    harness.get_by_label_contains(&format!("{load} N/m"));
    harness.get_by_label("Load / (p_a · length)");
    assert!(harness.query_by_label("Contact load").is_none());
}

#[test]
fn results_fit_a_narrow_panel_with_large_text() {
    for preset in ["fundamental", "levitating", "plate-viscous"] {
        let harness = shown(run(preset), 260.0, 1.5);
        for node in harness.query_all_by_role(Role::Label) {
            let rect = node.rect();
            assert!(rect.left() >= 0.0 && rect.right() <= 260.5, "{:?} in {preset}", node.accesskit_node().value());
        }
    }
}

/// Draws a few frames at several phases and cursors; returns the state of the view and what was asked.
fn look(run: &SolvedScene, size: egui::Vec2, click: bool) -> (View, Vec<Command>) {
    let state = State::new(Document::fundamental().unwrap());
    let mut harness = Harness::builder().with_size(size).build_ui_state(
        |ui, (state, commands): &mut (State, Vec<Command>)| {
            theme::install_fonts(ui.ctx());
            let cx = DrawContext::new(state, Instant::now());
            views::run::show(ui, run, None, None, &cx);
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
        let at = egui::pos2(0.4 * size.x, 0.2 * size.y);
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
        run("fundamental"),
        run_by(Method::Paper, "fundamental", &[]),
        run("levitating"),
        run("tooth-radius-3m"),
        run("plate-crossover"),
        run_with("plate-trapped", &[("plate.width_mm", "0.3")]),
    ];
    for run in &runs {
        for size in
            [egui::vec2(20.0, 20.0), egui::vec2(200.0, 180.0), egui::vec2(430.0, 560.0), egui::vec2(1200.0, 800.0)]
        {
            look(run, size, false);
        }
    }
}

#[test]
fn pointing_reads_x_and_clicking_follows_a_tooth() {
    let (view, commands) = look(&run("fundamental"), egui::vec2(800.0, 700.0), true);
    assert!(view.cursor_x.is_some_and(|x| x > 8e-3 && x < 16e-3), "{:?}", view.cursor_x);
    assert!(matches!(commands[..], [Command::FollowTooth(3..=5)]), "{commands:?}");
}

#[test]
fn extremes_do_not_disturb_it() {
    let mut still = run("levitating");
    let nothing = &mut Arc::make_mut(&mut still.solution).recording;
    let lines = &mut nothing.lines;
    for field in [&mut nothing.stator, &mut lines.contact, &mut lines.film, &mut lines.film_thickness] {
        field.fill(0.0);
    }
    nothing.pressure.fill(101_325.0);
    let draw = |run: &SolvedScene| look(run, egui::vec2(600.0, 600.0), false);
    draw(&still);
    still.number = 2;
    Arc::make_mut(&mut still.solution).recording = Recording::default();
    draw(&still);
    for teeth in ["1", "64"] {
        draw(&run_with("fundamental", &[("stator.teeth_per_wave", teeth), ("stator.tooth_width_mm", "0.3")]));
    }
    draw(&run_with("fundamental", &[("stator.normal_amplitude_um", "0")]));
}
