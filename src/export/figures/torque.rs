//! Torque, power and efficiency of a motor over the speed of its rotor.

use super::series::rest;
use crate::analysis::torque::TorqueCurves;
use crate::export::figure::{Axis, Band, Colour, Dash, Figure, Legend, Line, Mark, Panel, Style};
use crate::solution::{OperatingPoint, Performance};

/// If curves stay below this share of their axis, the axis is shortened to them.
const LOW: f64 = 0.4;

/// The end of an axis, a little above its highest value.
fn top(highest: f64) -> f64 {
    if highest > 0.0 { 1.08 * highest } else { 1.0 }
}

/// The end of an axis: `whole` or, if the curves reach only `highest`, a lower one.
fn whole_or(whole: f64, highest: f64) -> f64 {
    if highest > 0.0 && highest < LOW * whole { top(highest) } else { whole }
}

/// Torque–speed curves with the film and without, power and heat, efficiency; the rotor speed of the scene is marked.
pub fn torque(curves: &TorqueCurves) -> Figure {
    let (wet, dry) = (&curves.with_film, &curves.without_film);
    let most = |value: fn(&OperatingPoint) -> f64| {
        wet.curve.iter().chain(&dry.curve).map(value).filter(|value| value.is_finite()).fold(0.0, f64::max)
    };
    let greatest = wet.max_torque.value.max(dry.max_torque.value);
    let fastest = curves.rpm(curves.stator_speed).max(f64::MIN_POSITIVE);
    let present = curves.rpm(wet.present.speed);
    let driven = [wet, dry].into_iter().filter_map(|found| found.no_load_speed);
    let driven = driven.map(|speed| curves.rpm(speed.value)).fold(0.0, f64::max);
    // Where the rotor is braked, values are below the axes.
    let panel = |title: &str, y: Axis, highest: f64| {
        let x = Axis::new("speed of the rotor", "rpm").fixed(0.0, whole_or(fastest, driven.max(present)));
        Panel::new(title, x, y.fixed(0.0, highest)).legend(Legend::Above).layer(rest(0.0, ""))
    };
    let line = |name: &str, of: &Performance, style: Style, value: &dyn Fn(&OperatingPoint) -> f64| {
        Line::new(name, of.curve.iter().map(|point| [curves.rpm(point.speed), value(point)]), style)
    };
    let wet_style = Style::solid(Colour::FILM);
    let dry_style = Style::solid(Colour::CONTACT).dash(Dash::Dashed);
    let errors = wet.curve.iter().filter(|point| point.torque.error.is_finite()).map(|point| {
        let OperatingPoint { torque, speed, .. } = point;
        [curves.rpm(*speed), torque.value - torque.error, torque.value + torque.error]
    });
    let torque = whole_or(top(greatest), most(|point| point.torque.value));
    let torque = panel("(a) torque", Axis::new("torque", "N·m"), torque)
        .layer(Band::new("", errors, Colour::FILM))
        .layer(line("without film", dry, dry_style, &|point| point.torque.value))
        .layer(line("with film", wet, wet_style, &|point| point.torque.value));
    let highest = most(|point| point.output.value.max(point.friction.value));
    let heat_style = Style::solid(Colour::STATOR).dash(Dash::DashDot);
    let power = panel("(b) power", Axis::new("power", "W"), top(highest))
        .layer(line("output, without film", dry, dry_style, &|point| point.output.value))
        .layer(line("output", wet, wet_style, &|point| point.output.value))
        .layer(line("friction heat", wet, heat_style, &|point| point.friction.value));
    let percent = |point: &OperatingPoint| point.efficiency.map_or(f64::NAN, |share| 100.0 * share.value);
    let highest = most(|point| point.efficiency.map_or(0.0, |share| 100.0 * share.value));
    let efficiency = panel("(c) efficiency", Axis::new("efficiency", "%"), whole_or(100.0, highest))
        .layer(line("without film", dry, dry_style, &percent))
        .layer(line("with film", wet, wet_style, &percent));
    let mark = (0.0..=fastest).contains(&present).then(|| Mark::vertical(present, ""));
    let panels = [(torque, 34.0), (power, 34.0), (efficiency, 26.0)];
    let panels = panels.map(|(panel, height)| panel.height(height).layers(mark.clone())).into();
    let caption = format!(
        "Torque (a), power given to the rotor and heat of friction (b), and efficiency (c) of the whole ring over the speed of the \
         rotor, with the air film and without it, for Coulomb friction at every point of contact. The stator's surface reaches \
         {} rpm. The pressures are those of the scene's rotor speed, {} rpm, marked by the thin line; what another speed changes \
         of the torque is below {} %.",
        crate::digits::significant(fastest, 4),
        crate::digits::significant(present, 4),
        crate::digits::significant(100.0 * curves.speed_effect, 2)
    );
    Figure { panels, share_x: true, caption, ..Figure::new("torque and power over speed") }
}
