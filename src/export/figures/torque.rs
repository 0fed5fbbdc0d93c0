//! Torque, power and efficiency of a motor over the speed of its rotor.

use super::series::rest;
use crate::analysis::torque::TorqueCurves;
use crate::export::figure::{Axis, Band, Colour, Dash, Figure, Legend, Line, Mark, Panel, Style};
use crate::solution::{OperatingPoint, Performance};

/// Torque–speed curves with the film and without, power and heat, efficiency; the rotor speed of the scene is marked.
pub fn torque(curves: &TorqueCurves) -> Figure {
    let (wet, dry) = (&curves.with_film, &curves.without_film);
    let most = |value: fn(&OperatingPoint) -> f64| {
        wet.curve.iter().chain(&dry.curve).map(value).filter(|value| value.is_finite()).fold(0.0, f64::max)
    };
    let greatest = wet.max_torque.value.max(dry.max_torque.value);
    let fastest = curves.rpm(curves.stator_speed).max(f64::MIN_POSITIVE);
    let x = || Axis::new("speed of the rotor", "rpm").fixed(0.0, fastest);
    // What brakes the rotor is below the axes.
    let curve = |of: &Performance, value: &dyn Fn(&OperatingPoint) -> f64| -> Vec<[f64; 2]> {
        of.curve.iter().map(|point| [curves.rpm(point.speed), value(point)]).collect()
    };
    let wet_style = Style::solid(Colour::FILM);
    let dry_style = Style::solid(Colour::CONTACT).dash(Dash::Dashed);
    let errors = wet.curve.iter().filter(|point| point.torque.error.is_finite()).map(|point| {
        let OperatingPoint { torque, speed, .. } = point;
        [curves.rpm(*speed), torque.value - torque.error, torque.value + torque.error]
    });
    let top = |value: f64| if value > 0.0 { 1.08 * value } else { 1.0 };
    let mut first = Panel::new("(a) torque", x(), Axis::new("torque", "N·m").fixed(0.0, top(greatest)))
        .layer(Band::new("", errors, Colour::FILM))
        .layer(Line::new("without film", curve(dry, &|point| point.torque.value), dry_style))
        .layer(Line::new("with film", curve(wet, &|point| point.torque.value), wet_style));
    let highest = most(|point| point.output.value.max(point.friction.value));
    let mut second = Panel::new("(b) power", x(), Axis::new("power", "W").fixed(0.0, top(highest)))
        .layer(Line::new("output, without film", curve(dry, &|point| point.output.value), dry_style))
        .layer(Line::new("output", curve(wet, &|point| point.output.value), wet_style))
        .layer(Line::new(
            "friction heat",
            curve(wet, &|point| point.friction.value),
            Style::solid(Colour::STATOR).dash(Dash::DashDot),
        ));
    let percent = |point: &OperatingPoint| point.efficiency.map_or(f64::NAN, |share| 100.0 * share.value);
    let mut third = Panel::new("(c) efficiency", x(), Axis::new("efficiency", "%").fixed(0.0, 100.0))
        .layer(Line::new("without film", curve(dry, &percent), dry_style))
        .layer(Line::new("with film", curve(wet, &percent), wet_style));
    let present = curves.rpm(wet.present.speed);
    for panel in [&mut first, &mut second, &mut third] {
        panel.legend = Legend::Above;
        panel.layers.insert(0, rest(0.0, "").into());
        if (0.0..=fastest).contains(&present) {
            panel.layers.push(Mark::vertical(present, "").into());
        }
    }
    let mut figure = Figure::new("torque and power over speed")
        .panel(first.height(34.0))
        .panel(second.height(34.0))
        .panel(third.height(26.0));
    figure.share_x = true;
    figure.caption = format!(
        "Torque (a), power given to the rotor and heat of friction (b), and efficiency (c) of the whole ring over the speed of the \
         rotor, with the air film and without it, for Coulomb friction at every point of contact. The stator's surface reaches \
         {} rpm. The pressures are those of the scene's rotor speed, {} rpm, marked by the thin line; what another speed changes \
         of the torque is below {} %.",
        crate::digits::significant(fastest, 4),
        crate::digits::significant(present, 4),
        crate::digits::significant(100.0 * curves.speed_effect, 2)
    );
    figure
}
