//! Figures of a motor. Axes cover the whole cycle, so that figures of several instants can be laid side by side.

use super::series::{
    along, along_where_not_zero, mirrored, over_cycle, phase, pressure_map, rest, span, tooth_map, whole_plane,
    with_margin,
};
use super::unit::{prefixed, pressure_unit};
use crate::digits::significant;
use crate::export::figure::{
    Axis, Band, Colour, Dash, Figure, Grid, Legend, Line, Map, Mark, Panel, Range, Style, Width,
};
use crate::problem::Motor;
use crate::recording::Recording;
use crate::recording::sample::Lines;

/// A groove narrower than this share of the pitch counts as none.
const NO_GROOVE: f64 = 1e-9;

/// The frame at which the crest of the wave is on the middle tooth, as in the paper's figures.
pub fn crest_in_the_middle(recording: &Recording) -> usize {
    let (frames, teeth) = (recording.frames.max(1), recording.teeth.max(1));
    // The crest is on tooth k when t/T + k/teeth is whole.
    ((teeth - teeth / 2) * frames).div_ceil(teeth) % frames
}

/// Surfaces, contact pressure and film pressure along one wavelength at a frame, as the paper's Fig. 4.
pub fn wave(motor: &Motor, recording: &Recording, frame: usize) -> Figure {
    let pressure = |title: &str, loads: &[f64], colour: Colour| {
        let (y, scale) = pressure_axis(motor, loads.iter());
        let (area, curve) = area_and_curve(recording, frame, (loads, scale), "", Style::solid(colour));
        Panel::new(title, x_axis(recording), y).layer(area).layer(rest(0.0, "")).layer(curve).height(26.0)
    };
    let panels = vec![
        surfaces(motor, recording, frame).height(38.0),
        pressure("(b) contact pressure", &recording.contact, Colour::CONTACT),
        pressure("(c) film pressure, gauge", &recording.film, Colour::FILM),
    ];
    let phase = phase(recording, frame);
    let caption = format!(
        "Normal displacement of stator teeth and rotor (a), contact pressure (b) and gauge pressure of the air film (c), both \
         averaged over the contact width, along one wavelength at t/T = {phase:.3}. The wave travels towards −x, the rotor is \
         driven towards +x."
    );
    Figure { panels, share_x: true, caption, ..Figure::new(format!("t/T = {phase:.3}")) }
}

fn x_axis(recording: &Recording) -> Axis {
    let half = 0.5 * recording.pitch;
    Axis::new("x", "mm").fixed(-half * 1e3, (recording.length - half) * 1e3)
}

/// Teeth of the stator, underside of the rotor, and where they touch.
pub fn surfaces(motor: &Motor, recording: &Recording, frame: usize) -> Panel {
    let underside = |i: usize| recording.stator[i] + recording.film_thickness[i] - motor.spacing();
    let all = || 0..recording.stator.len().min(recording.film_thickness.len());
    // If the stator does not move, the scale is that of the roughness.
    let heights = all().flat_map(|i| [recording.stator[i], underside(i)]).chain([motor.spacing()]);
    let [low, high] = with_margin(span(heights, 0.0), 0.08);
    let (unit, scale) = prefixed(high.max(-low), "m");
    let y = Axis::new("displacement", &unit)
        .fixed((low - 0.06 * (high - low)) * scale, (high + 0.06 * (high - low)) * scale);
    let touches = |load: f64| load > motor.touching_from();
    let top = |i: usize| recording.stator[i] * scale;
    let outline = along(recording, frame, 1e3, top);
    let touching = along(recording, frame, 1e3, |i| if touches(recording.contact[i]) { top(i) } else { f64::NAN });
    let teeth: Vec<[f64; 3]> = outline.iter().map(|[x, top]| [*x, f64::NEG_INFINITY, *top]).collect();
    let rotor = Lines::at(recording, frame as f64).underside(recording);
    let rotor: Vec<[f64; 2]> = rotor.iter().map(|[x, height]| [x * 1e3, height * scale]).collect();
    let above = rotor.iter().map(|[x, y]| [*x, *y, f64::INFINITY]);
    let above = Band { opacity: 0.3, ..Band::new("", above, Colour::ROTOR) };
    let body = Band { opacity: 0.35, ..Band::new("", teeth, Colour::STATOR) };
    let thick = Style::solid(Colour::CONTACT).width(2.4);
    // The legend includes contact if there is any during the cycle, so that it is the same at every instant.
    let touched = recording.contact.iter().any(|load| touches(*load));
    Panel::new("(a) surfaces", x_axis(recording), y)
        .layer(above)
        .layer(body)
        .layer(Line::new("stator", outline, Style::solid(Colour::STATOR).width(0.8)))
        .layer(Line::new("rotor", rotor, Style::solid(Colour::BLACK).width(1.2)))
        .layers(touched.then(|| Line::new("in contact", touching, thick)))
        .legend(Legend::Above)
}

/// An axis for line loads as pressures, and the factor from a line load to a value on it.
fn pressure_axis<'a>(motor: &Motor, loads: impl Iterator<Item = &'a f64> + Clone) -> (Axis, f64) {
    let greatest = span(loads.clone().map(|load| (load / motor.contact_width).abs()), 0.0)[1];
    let (unit, scale) = pressure_unit(greatest);
    let scale = scale / motor.contact_width;
    let [low, high] = with_margin(span(loads.map(|load| load * scale), 0.0), 0.06);
    (Axis::new("pressure", unit).fixed(low, high), scale)
}

/// A line load, scaled by `scale`, as a curve with a pale area below for each tooth.
fn area_and_curve(
    recording: &Recording,
    frame: usize,
    (loads, scale): (&[f64], f64),
    name: &str,
    style: Style,
) -> (Band, Line) {
    let curve = along_where_not_zero(recording, frame, 1e3, |i| loads[i] * scale);
    let area = curve.iter().map(|[x, pressure]| [*x, 0.0, *pressure]);
    (Band::new("", area, style.colour), Line::new(name, curve, style))
}

/// Contact pressure and film pressure in one panel.
pub fn pressures(motor: &Motor, recording: &Recording, frame: usize) -> Panel {
    let (y, scale) = pressure_axis(motor, recording.contact.iter().chain(&recording.film));
    let of = |loads: &[f64], name: &str, style: Style| area_and_curve(recording, frame, (loads, scale), name, style);
    let dashed = Style::solid(Colour::CONTACT).dash(Dash::Dashed);
    let (contact_area, contact_line) = of(&recording.contact, "contact", dashed);
    let (film_area, film_line) = of(&recording.film, "air film, gauge", Style::solid(Colour::FILM));
    Panel::new("(b) pressure on the teeth", x_axis(recording), y)
        .layer(contact_area)
        .layer(film_area)
        .layer(rest(0.0, ""))
        .layer(contact_line)
        .layer(film_line)
        .legend(Legend::Above)
}

/// Film load, contact load and teeth in contact over the cycle.
pub fn loads(motor: &Motor, recording: &Recording) -> Figure {
    let (unit, scale) = prefixed(motor.load, "N");
    let curve = |name: &str, series: &[f64], style: Style| Line::new(name, over_cycle(series, scale), style);
    let load = Panel::new(
        "(a) load on one wavelength",
        Axis::new("", "").fixed(0.0, 1.0),
        Axis::new("load", &unit).including([0.0, motor.load * scale]),
    )
    .layer(Mark::horizontal(motor.load * scale, "axial load"))
    .layer(curve("contact", &recording.contact_load, Style::solid(Colour::CONTACT).dash(Dash::Dashed)))
    .layer(curve("air film", &recording.film_load, Style::solid(Colour::FILM)));
    let touching: Vec<f64> = recording.teeth_in_contact.iter().map(|teeth| *teeth as f64).collect();
    let steps = over_cycle(&touching, 1.0).zip(over_cycle(&touching, 1.0).skip(1));
    let steps = steps.flat_map(|(a, b)| [a, [b[0], a[1]]]);
    let most = touching.iter().copied().fold(1.0, f64::max);
    let teeth = Panel::new(
        "(b) teeth that touch the rotor",
        Axis::new("t/T", "").fixed(0.0, 1.0),
        Axis::new("touching", "").fixed(0.0, most + 0.5).whole(),
    )
    .layer(Line::new("", steps, Style::solid(Colour::BLACK)));
    let panels = vec![load.height(38.0), teeth.height(16.0)];
    let (unit, seconds) = prefixed(recording.period, "s");
    let caption = format!(
        "Contact load and load of the air film on one wavelength over one cycle of {} {unit}; together they carry the axial load, the thin \
         line. Below, how many of the {} teeth touch the rotor.",
        significant(recording.period * seconds, 4),
        recording.teeth
    );
    Figure { panels, share_x: true, caption, ..Figure::new("loads over the cycle") }
}

/// The film's pressure under all teeth, absolute, with colours that cover `span` \[Pa\].
pub(super) fn all_teeth(title: &str, recording: &Recording, frame: usize, span: [f64; 2]) -> Panel {
    let (unit, scale) = pressure_unit(span[1]);
    let y: Vec<(f64, usize)> = mirrored(&recording.map_y, recording.half_width);
    let (mut x, mut values) = (Vec::new(), Vec::new());
    // Without grooves, each tooth ends where the next begins.
    let beyond = |x: &[f64], place: f64| x.last().is_none_or(|last| place > last + NO_GROOVE * recording.pitch * 1e3);
    for tooth in 0..recording.teeth {
        let plane = tooth_map(recording, tooth, frame);
        let middle = tooth as f64 * recording.pitch;
        let groove = (middle - 0.5 * recording.pitch) * 1e3;
        if tooth > 0 && beyond(&x, groove) {
            x.push(groove);
            values.extend(y.iter().map(|_| f64::NAN));
        }
        for (i, xi) in recording.map_x.iter().enumerate() {
            let place = (middle + xi) * 1e3;
            if beyond(&x, place) {
                x.push(place);
                values.extend(y.iter().map(|(_, j)| plane[i * recording.map_y.len() + j] * scale));
            }
        }
    }
    let grid = Grid { x, y: y.iter().map(|(y, _)| y * 1e3).collect(), values };
    let map = pressure_map(grid, &unit, Range::Fixed(span[0] * scale, span[1] * scale));
    Panel::new(title, x_axis(recording), Axis::new("y", "mm")).layer(map)
}

pub(super) fn pressure_span(recording: &Recording) -> [f64; 2] {
    span(recording.pressure.iter().copied(), recording.pressure.first().copied().unwrap_or(0.0))
}

/// Surfaces, pressures and the film's map at a frame, for animations.
pub fn moving(motor: &Motor, recording: &Recording, frame: usize) -> Figure {
    let panels = vec![
        surfaces(motor, recording, frame).height(30.0),
        pressures(motor, recording, frame).height(24.0),
        all_teeth("(c) air film from above", recording, frame, pressure_span(recording)).height(9.0),
    ];
    Figure { panels, width: Width::Millimetres(130.0), share_x: true, ..Figure::default() }
}

/// The film's pressure under the middle tooth, with contours. The unit comes with the factor from pascal.
pub(super) fn one_tooth(recording: &Recording, frame: usize, range: Range, (unit, scale): (String, f64)) -> Panel {
    let grid = whole_plane(recording, &tooth_map(recording, recording.teeth / 2, frame), scale);
    let error = recording.max_pressure_error.get(frame).copied().unwrap_or(0.0);
    let map = Map { contours: Some(error * scale), ..pressure_map(grid, &unit, range) };
    Panel::new("", Axis::new("x from the tooth's middle", "mm"), Axis::new("y", "mm")).layer(map).height(38.0)
}

/// The film's pressure under all teeth, and a larger map with contours of the middle tooth.
pub fn map(motor: &Motor, recording: &Recording, frame: usize) -> Figure {
    let span = pressure_span(recording);
    let all = all_teeth("(a) all teeth", recording, frame, span).height(14.0);
    let one = one_tooth(recording, frame, Range::Auto, pressure_unit(span[1]));
    let one = Panel { title: "(b) the tooth in the middle".to_owned(), ..one };
    let phase = phase(recording, frame);
    let caption = format!(
        "Absolute pressure of the air film at t/T = {phase:.3}, under all {} teeth of one wavelength (a) and under the tooth on which the \
         crest is (b); colours of (a) cover the whole cycle. Teeth are {} mm wide along x.",
        recording.teeth,
        significant(motor.tooth_width * 1e3, 4)
    );
    let title = format!("pressure of the air film, t/T = {phase:.3}");
    Figure { panels: vec![all, one], width: Width::Page, caption, ..Figure::new(title) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::figure::Layer;
    use crate::recording::LineLoads;

    /// Two teeth, of which one is stored; two nodes along it and two across half the width; the pressure counts in kPa.
    fn two_teeth(pitch: f64) -> Recording {
        Recording {
            lines: LineLoads { frames: 4, teeth: 2, stored_teeth: 1, pitch, ..LineLoads::default() },
            map_x: vec![-0.5e-3, 0.5e-3],
            map_y: vec![0.0, 1e-4],
            half_width: true,
            pressure: (0..16).map(|count| f64::from(count) * 1e3).collect(),
            ..Recording::default()
        }
    }

    #[test]
    fn teeth_without_grooves_are_one_map() {
        let panel = all_teeth("", &two_teeth(1e-3), 1, [0.0, 20e3]);
        let Layer::Map(map) = &panel.layers[0] else { panic!("{panel:?}") };
        assert_eq!((map.grid.x.as_slice(), map.grid.values.len()), ([-0.5, 0.5, 1.5].as_slice(), 9));
        assert!(map.grid.values.iter().all(|value| value.is_finite()));
    }

    #[test]
    fn under_each_tooth_stands_its_own_pressure_and_nothing_in_the_groove() {
        let panel = all_teeth("", &two_teeth(2e-3), 1, [0.0, 20e3]);
        let Layer::Map(map) = &panel.layers[0] else { panic!("{panel:?}") };
        let near = |found: &[f64], expected: &[f64]| found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(
            near(&map.grid.x, &[-0.5, 0.5, 1.0, 1.5, 2.5]) && near(&map.grid.y, &[-0.1, 0.0, 0.1]),
            "{:?}",
            map.grid
        );
        let values = &map.grid.values;
        assert!(near(&values[..6], &[5.0, 4.0, 5.0, 7.0, 6.0, 7.0]) && values[6..9].iter().all(|v| v.is_nan()));
        assert!(values.len() == 15 && near(&values[9..], &[13.0, 12.0, 13.0, 15.0, 14.0, 15.0]), "{values:?}");
        assert_eq!((map.unit.as_str(), &map.range), ("kPa", &Range::Fixed(0.0, 20.0)));
    }
}
