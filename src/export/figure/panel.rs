//! One panel drawn at its place: layers, axes, legend, colour bar.

#[cfg(feature = "gui")]
use super::axis::Axis;
use super::axis::{Range, Scale};
use super::colour::Colour;
#[cfg(feature = "gui")]
use super::description::Panel;
use super::geometry::{along, clipped_area, clipped_line, contour, distance, is_contour};
use super::isoline::{self, Isoline};
use super::layers::{Band, Direction, Grid, Layer, Line, MARKED, Map, Mark, Points, Text};
use super::legend::{covered, drawn};
use super::placed::{
    Bar, GAP, HEAD, LABEL, MAJOR, MINOR, NOTE, Placed, Ruler, SPACE, Sign, TICK, fills, first_map, map_range,
};
use super::plane;
use super::scale::{Scaled, Ticks, on_contour};
use super::style::Style;
use super::svg::{Raster, Rect, Svg, Type, escaped};
use super::text;
use crate::ticks::Steps;

/// Width of axes and ticks \[pt\].
const THIN: f64 = 0.6;
/// Number of markers on a line with many points.
const MARKERS: usize = 7;
/// A name farther than this from its point is joined to it by a line \[pt\].
const FAR: f64 = 8.0;
/// Distance of the end of that line from the point \[pt\].
const RIM: f64 = 4.0;
/// Distance from the baseline to half the height of a digit, relative to the size.
const HALF_HEIGHT: f64 = 0.35;

/// A name, its position, and the line to what it names if that is not beside it.
#[cfg(feature = "gui")]
pub(crate) type PlacedName = (String, [f64; 2], Option<[[f64; 2]; 2]>);

/// The names of places, with the upper left corner of each, and a line from the place to a name that is farther away. They are placed as in
/// a figure, for another drawing of the panel: with an area of this width and height \[pt\], axes between these ends, and text sizes given
/// by `words`.
#[cfg(feature = "gui")]
pub(crate) fn names(
    panel: &Panel,
    ends: [[f64; 2]; 2],
    [width, height]: [f64; 2],
    words: impl Fn(&str) -> [f64; 2],
) -> Vec<PlacedName> {
    let ruler =
        |axis: &Axis, [from, to]: [f64; 2]| Ruler::new(axis, Scaled { from, to, scale: axis.scale }, Ticks::default());
    let rect = Rect { x: 0.0, y: 0.0, width, height };
    let placed = Placed::new(panel, rect, ruler(&panel.x, ends[0]), ruler(&panel.y, ends[1]));
    let names = placed.named_places(words).into_iter();
    names.map(|(name, at, place)| (name.text.clone(), [place.x, place.y], leader(at, &place))).collect()
}

/// The line from the rim of a point to its name, if the name is not right beside it.
fn leader([x, y]: [f64; 2], name: &Rect) -> Option<[[f64; 2]; 2]> {
    let near = [x.max(name.x).min(name.right()), y.max(name.y).min(name.bottom())];
    let share = RIM / distance([x, y], near);
    (share < RIM / FAR).then(|| [[x + share * (near[0] - x), y + share * (near[1] - y)], near])
}

impl Placed<'_> {
    /// Draws the panel's pictures, which are below everything else.
    pub(super) fn pictures(&self) -> Vec<Raster> {
        let Self { panel, rect, x, y, .. } = self;
        let of = |layer: &Layer| match layer {
            Layer::Map(map) => plane::map(map, rect, &x.range, &y.range, &map_range(map)),
            Layer::Categories(kinds) => plane::categories(kinds, rect, &x.range, &y.range),
            _ => None,
        };
        let mut pictures: Vec<Raster> = panel.layers.iter().filter_map(of).collect();
        if let (Some(bar), Some(map)) = (&self.bar, first_map(panel)) {
            pictures.push(plane::bar(map.colours, &bar.rect, bar.upright));
        }
        pictures
    }

    /// Draws everything except the pictures.
    pub(super) fn draw(&self, svg: &mut Svg) {
        svg.open(&self.attributes());
        let mut curve = 0;
        for layer in &self.panel.layers {
            match layer {
                Layer::Line(line) => {
                    self.line(svg, line, curve);
                    curve += 1;
                }
                Layer::Band(band) => self.band(svg, band),
                Layer::Points(points) => self.points(svg, points),
                Layer::Mark(mark) => self.mark(svg, mark),
                Layer::Map(map) => self.contours(svg, map),
                Layer::Categories(_) | Layer::Text(_) => {}
            }
        }
        self.names(svg);
        self.axes(svg);
        if let Some(bar) = &self.bar {
            colour_bar(svg, bar);
        }
        self.legend(svg);
        svg.text(self.title, &self.panel.title, &Type::new(HEAD, "start"));
        svg.close();
    }

    /// Attributes of the SVG group from which a reader of the file can convert positions to values.
    fn attributes(&self) -> String {
        let Rect { x, y, width, height } = self.rect;
        let axis = |Ruler { range, .. }: &Ruler| {
            let scale = if range.scale == Scale::Log { "log" } else { "linear" };
            format!("{:e} {:e} {scale}", range.from, range.to)
        };
        let right = self.right.as_ref().map_or(String::new(), |it| format!(r#" data-right="{}""#, axis(it)));
        format!(
            r#"class="panel" data-title="{}" data-area="{x:.4} {y:.4} {width:.4} {height:.4}" data-x="{}" data-y="{}"{right}"#,
            escaped(&text::plain(&self.panel.title)),
            axis(&self.x),
            axis(&self.y),
        )
    }

    fn line(&self, svg: &mut Svg, line: &Line, curve: usize) {
        let style = &line.style;
        svg.open(&named("line", &line.name));
        let mut places: Vec<[f64; 2]> = line.points.iter().map(|point| self.at(*point, line.right)).collect();
        for part in clipped_line(places.iter().copied(), &self.rect) {
            svg.polyline(&part, style);
        }
        if let Some(marker) = &style.marker {
            places.retain(|point| self.rect.holds(*point));
            for point in sparse(&places, curve) {
                svg.marker(point, marker, style.colour);
            }
        }
        svg.close();
    }

    fn band(&self, svg: &mut Svg, band: &Band) {
        svg.open(&named("band", &band.name));
        let at = |p: &[f64; 3]| [self.at([p[0], p[1]], false), self.at([p[0], p[2]], false)];
        let known = |p: &[f64; 3]| at(p).iter().flatten().all(|c| !c.is_nan());
        for run in band.points.split(|p| !known(p)) {
            let there = run.iter().map(|p| at(p)[0]);
            let back = run.iter().rev().map(|p| at(p)[1]);
            let outline: Vec<[f64; 2]> = there.chain(back).collect();
            svg.polygon(&clipped_area(&outline, &self.rect), band.colour, band.opacity);
        }
        svg.close();
    }

    fn points(&self, svg: &mut Svg, points: &Points) {
        svg.open(&named("points", &points.name));
        let rect = &self.rect;
        let mut bars = Vec::new();
        for (i, [x, y]) in points.points.iter().enumerate() {
            let error = points.error(i);
            if error == 0.0 {
                continue;
            }
            // The part of an error bar that a logarithmic axis cannot show ends at the lower edge.
            let ends = [y + error, y - error].map(|y| {
                let [px, py] = self.at([*x, y], false);
                [px, if py.is_nan() { rect.bottom() + 10.0 } else { py }]
            });
            for part in clipped_line(ends.into_iter(), rect) {
                let (a, b) = (part[0], part[part.len() - 1]);
                bars.push([a[0], a[1], b[0], b[1]]);
                // There are caps only where the bar ends inside the axes.
                for (cap, end) in [(a, ends[0]), (b, ends[1])] {
                    if (cap[1] - end[1]).abs() < 1e-6 {
                        bars.push([cap[0] - 1.6, cap[1], cap[0] + 1.6, cap[1]]);
                    }
                }
            }
        }
        svg.segments(&bars, &Style::solid(points.colour).width(0.7));
        let places = points.points.iter().map(|point| self.at(*point, false));
        for at in places.filter(|at| rect.holds(*at)) {
            svg.marker(at, &points.marker, points.colour);
        }
        svg.close();
    }

    fn mark(&self, svg: &mut Svg, mark: &Mark) {
        let rect = &self.rect;
        let [from, to] = self.mark_ends(mark);
        if !(rect.holds(from) && rect.holds(to)) {
            return;
        }
        svg.open(&named("mark", &mark.label));
        svg.polyline(&[from, to], &mark.style);
        if !mark.label.trim().is_empty() {
            let words = self.place_of_words(mark, from);
            let style = Type { colour: mark.style.colour, ..Type::new(NOTE, "start") };
            svg.text([words.x, words.y + 0.8 * NOTE], &mark.label, &style);
        }
        svg.close();
    }

    /// The place of a mark's text: along the line, on the first side and at the first end where nothing else is drawn.
    fn place_of_words(&self, mark: &Mark, from: [f64; 2]) -> Rect {
        let area = &self.rect;
        let (width, height) = (text::width(&mark.label, NOTE), NOTE);
        let place = |x: f64, y: f64| Rect { x, y, width, height };
        let places: Vec<Rect> = match mark.direction {
            Direction::Vertical => {
                let sides = [from[0] + 2.5, from[0] - 2.5 - width];
                let heights = [area.y + 1.0, area.bottom() - height - 3.0, area.y + 0.5 * area.height];
                heights.into_iter().flat_map(|y| sides.map(|x| place(x, y))).collect()
            }
            Direction::Horizontal => {
                let ends = [area.right() - width - 2.0, area.x + 4.0, area.x + 0.5 * (area.width - width)];
                let sides = [from[1] - height - 2.2, from[1] + 2.6];
                ends.into_iter().flat_map(|x| sides.map(|y| place(x, y))).collect()
            }
        };
        let taken = self.taken(false);
        self.freest(&places, |rect| covered(rect, &taken))
    }

    /// The place inside the axes with the fewest obstacles; of several, the first.
    fn freest(&self, places: &[Rect], in_the_way: impl Fn(&Rect) -> usize) -> Rect {
        let area = &self.rect;
        let inside = |rect: &&Rect| area.holds([rect.x, rect.y]) && area.holds([rect.right(), rect.bottom()]);
        let freest = places.iter().filter(inside).min_by_key(|&rect| in_the_way(rect));
        freest.or(places.first()).copied().unwrap_or_default()
    }

    /// Points of everything that is drawn, including the legend; with those of marks if `marks`.
    fn taken(&self, marks: bool) -> Vec<[f64; 2]> {
        let mut taken = drawn(self, marks);
        taken.extend(self.legend_box.iter().flat_map(Rect::points));
        taken
    }

    fn names(&self, svg: &mut Svg) {
        let names = self.named_places(|words| [text::width(words, NOTE), 0.8 * NOTE]);
        let leaders = names.iter().filter_map(|(_, at, place)| leader(*at, place));
        let leaders: Vec<[f64; 4]> = leaders.map(|[[x, y], [to_x, to_y]]| [x, y, to_x, to_y]).collect();
        if !leaders.is_empty() {
            svg.open(r#"class="leaders""#);
            svg.segments(&leaders, &Style::solid(Colour::QUIET).width(0.4));
            svg.close();
        }
        for (words, _, place) in names {
            svg.text([place.x, place.bottom()], &words.text, &Type::new(NOTE, "start"));
        }
    }

    /// The names of places, each with its place and its position beside that. Positions at the right and left are tried first, then above
    /// and below, then at the corners, then the same farther away. No line to a name crosses another name if that can be avoided. `size`
    /// gives width and height of a text.
    fn named_places(&self, size: impl Fn(&str) -> [f64; 2]) -> Vec<(&Text, [f64; 2], Rect)> {
        let area = &self.rect;
        let names = self.panel.layers.iter().filter_map(|layer| match layer {
            Layer::Text(words) => Some((words, self.at(words.at, false))).filter(|(_, at)| area.holds(*at)),
            _ => None,
        });
        let names: Vec<(&Text, [f64; 2])> = names.collect();
        let mut taken = if names.is_empty() { Vec::new() } else { self.taken(true) };
        let mut written: Vec<Rect> = Vec::new();
        let mut place = |words: &str, [x, y]: [f64; 2]| {
            let [width, height] = size(words);
            let places = [5.0, 10.0, 16.0].map(|apart| {
                let [right, left, centre] = [x + apart, x - apart - width, x - 0.5 * width];
                let [above, below, middle] = [y - apart - height, y + apart, y - 0.5 * height];
                let beside = [[right, middle], [left, middle], [centre, above], [centre, below]];
                let corners = [[right, above], [left, below], [right, below], [left, above]];
                [beside, corners].concat()
            });
            let places: Vec<Rect> = places.concat().into_iter().map(|[x, y]| Rect { x, y, width, height }).collect();
            let line =
                |rect: &Rect| leader([x, y], rect).map_or_else(Vec::new, |[from, to]| along(from, to, 1.0).collect());
            let crossed = |line: &[[f64; 2]]| written.iter().map(|name| covered(name, line)).sum::<usize>();
            let place = self.freest(&places, |rect| covered(rect, &taken) + crossed(&line(rect)));
            taken.extend(place.points().chain(line(&place)));
            written.push(place);
            place
        };
        names.into_iter().map(|(words, at)| (words, at, place(&words.text, at))).collect()
    }

    fn contours(&self, svg: &mut Svg, map: &Map) {
        let Grid { x, y, values } = &map.grid;
        let Some(error) = map.contours.filter(|_| plane::fits(x, y, values.len())) else { return };
        let (levels, step) = levels(values, error);
        // Values are first converted to positions, so that lines are straight on paper on both kinds of axes.
        let px: Vec<f64> = x.iter().map(|x| self.px(*x)).collect();
        let py: Vec<f64> = y.iter().map(|y| self.py(*y, false)).collect();
        svg.open(r#"class="contours""#);
        let mut lines = Vec::new();
        for level in levels {
            let style = Style::solid(contrast(map, level)).width(0.7);
            let label = on_contour(level, step);
            for line in contour(&px, &py, values, level) {
                for part in clipped_line(line.into_iter(), &self.rect) {
                    lines.push(Isoline::new(part, &label, style));
                }
            }
        }
        isoline::draw(svg, &lines);
        svg.close();
    }

    fn axes(&self, svg: &mut Svg) {
        let Placed { rect, x, y, right, .. } = self;
        let style = Style::solid(Colour::BLACK).width(THIN);
        if fills(self.panel) {
            svg.rect(rect, &style, None);
        } else {
            let mut spines =
                vec![[rect.x, rect.bottom(), rect.x, rect.y], [rect.x, rect.bottom(), rect.right(), rect.bottom()]];
            if right.is_some() {
                spines.push([rect.right(), rect.bottom(), rect.right(), rect.y]);
            }
            svg.segments(&spines, &style);
        }
        let mut strokes = Vec::new();
        let length = |major: bool| if major { MAJOR } else { MINOR };
        for tick in &x.ticks.ticks {
            let at = self.px(tick.at);
            strokes.push([at, rect.bottom(), at, rect.bottom() + length(tick.label.is_some())]);
            if let Some(label) = tick.label.as_ref().filter(|_| self.x_labels) {
                let baseline = rect.bottom() + MAJOR + GAP + 0.74 * TICK;
                svg.text([at, baseline], label, &Type::new(TICK, "middle"));
            }
        }
        strokes.extend(upright_ticks(svg, y, rect, -1.0));
        if let Some(right) = right {
            strokes.extend(upright_ticks(svg, right, rect, 1.0));
        }
        svg.segments(&strokes, &style);
        if self.x_labels {
            let baseline = rect.bottom() + MAJOR + GAP + TICK + GAP + 0.76 * LABEL;
            svg.text([rect.x + 0.5 * rect.width, baseline], &x.label, &Type::new(LABEL, "middle"));
        }
        upright_label(svg, y, rect, -1.0);
        if let Some(right) = right {
            upright_label(svg, right, rect, 1.0);
        }
    }

    fn legend(&self, svg: &mut Svg) {
        if self.legend.is_empty() {
            return;
        }
        svg.open(r#"class="legend""#);
        for (entry, [x, y]) in &self.legend {
            let sample = entry.sample();
            match &entry.sign {
                Sign::Line(style) => {
                    svg.polyline(&[[*x, *y], [x + sample, *y]], style);
                    if let Some(marker) = &style.marker {
                        svg.marker([x + 0.5 * sample, *y], marker, style.colour);
                    }
                }
                Sign::Patch(colour, opacity) => {
                    let patch = Rect { x: *x, y: y - 2.7, width: sample, height: 5.4 };
                    svg.rect(&patch, &Style::solid(*colour).width(0.4), Some((*colour, *opacity)));
                }
                Sign::Point(marker, colour) => svg.marker([x + 0.5 * sample, *y], marker, *colour),
            }
            let at = [x + sample + SPACE, y + HALF_HEIGHT * NOTE];
            svg.text(at, &entry.name, &Type::new(NOTE, "start"));
        }
        svg.close();
    }
}

/// `class="line" data-name="film"`
fn named(class: &str, name: &str) -> String {
    format!(r#"class="{class}" data-name="{}""#, escaped(&text::plain(name)))
}

/// All points, if there are few; of many, some at equal distances along the line, at different places on each curve.
fn sparse(points: &[[f64; 2]], curve: usize) -> Vec<[f64; 2]> {
    if points.len() <= MARKED {
        return points.to_vec();
    }
    let length: Vec<f64> = points
        .iter()
        .scan((points[0], 0.0), |(last, sum), point| {
            *sum += distance(*point, *last);
            *last = *point;
            Some(*sum)
        })
        .collect();
    let all = length[length.len() - 1];
    let offset = 0.2 + 0.25 * (curve % 4) as f64;
    (0..MARKERS)
        .map(|i| length.partition_point(|l| *l < (i as f64 + offset) / MARKERS as f64 * all).min(points.len() - 1))
        .map(|i| points[i])
        .collect()
}

/// Labels the ticks of an upright axis left (−1) or right (1) of `rect`, and gives their strokes.
fn upright_ticks(svg: &mut Svg, axis: &Ruler, rect: &Rect, side: f64) -> Vec<[f64; 4]> {
    let (x, anchor) = if side < 0.0 { (rect.x, "end") } else { (rect.right(), "start") };
    let mut strokes = Vec::new();
    for tick in &axis.ticks.ticks {
        let y = rect.bottom() - axis.range.fraction(tick.at) * rect.height;
        let length = if tick.label.is_some() { MAJOR } else { MINOR };
        strokes.push([x, y, x + side * length, y]);
        if let Some(label) = &tick.label {
            svg.text([x + side * (MAJOR + GAP), y + HALF_HEIGHT * TICK], label, &Type::new(TICK, anchor));
        }
    }
    strokes
}

/// The label of a vertical axis, turned.
fn upright_label(svg: &mut Svg, axis: &Ruler, rect: &Rect, side: f64) {
    let beyond = axis.reach() + GAP;
    let x = if side < 0.0 { rect.x - beyond - 0.2 * LABEL } else { rect.right() + beyond + 0.8 * LABEL };
    let turned = Type { angle: -90.0, ..Type::new(LABEL, "middle") };
    svg.text([x, rect.y + 0.5 * rect.height], &axis.label, &turned);
}

fn colour_bar(svg: &mut Svg, Bar { rect, upright, ruler }: &Bar) {
    let style = Style::solid(Colour::BLACK).width(THIN);
    svg.open(r#"class="bar""#);
    svg.rect(rect, &style, None);
    let mut strokes = Vec::new();
    if *upright {
        strokes = upright_ticks(svg, ruler, rect, 1.0);
        upright_label(svg, ruler, rect, 1.0);
    } else {
        for tick in &ruler.ticks.ticks {
            let x = rect.x + ruler.range.fraction(tick.at) * rect.width;
            strokes.push([x, rect.bottom(), x, rect.bottom() + if tick.label.is_some() { 2.0 } else { 1.2 }]);
            if let Some(label) = &tick.label {
                svg.text([x, rect.bottom() + 2.5 + 0.76 * NOTE], label, &Type::new(NOTE, "middle"));
            }
        }
        svg.text([rect.x - 5.0, rect.bottom()], &ruler.label, &Type::new(NOTE, "end"));
    }
    svg.segments(&strokes, &style);
    svg.close();
}

/// Values of contours and the step between them.
fn levels(values: &[f64], error: f64) -> (Vec<f64>, f64) {
    let range = Scaled::new(&Range::Auto, Scale::Linear, values.iter().copied(), false);
    let step = Steps::new([range.from, range.to], 10).step();
    if step <= error {
        return (Vec::new(), step);
    }
    let ticks = Ticks::new(&range, 10, false).ticks;
    let labelled = ticks.into_iter().filter(|tick| tick.label.is_some()).map(|tick| tick.at);
    let labelled = labelled.filter(|at| is_contour(range.fraction(*at))).collect();
    (labelled, step)
}

/// Black or white, whichever is visible on the map's colour of a value.
fn contrast(map: &Map, value: f64) -> Colour {
    let under = map.colours.at(map_range(map).fraction(value));
    if under.lightness() < 0.55 { Colour::WHITE } else { Colour::BLACK }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markers_of_a_long_line_are_few_and_spread() {
        let points: Vec<[f64; 2]> = (0..1000).map(|i| [f64::from(i), 0.0]).collect();
        let shown = sparse(&points, 1);
        assert_eq!(shown.len(), MARKERS);
        assert_ne!(shown, sparse(&points, 0));
        assert_eq!(sparse(&points[..5], 3).len(), 5);
    }

    #[cfg(feature = "gui")]
    #[test]
    fn a_line_to_a_name_goes_round_other_names() {
        use crate::export::figure::{Marker, Shape};
        let front = [[8.0, 140.0], [20.0, 90.0], [23.0, 88.0], [45.0, 85.0], [55.0, 60.0]];
        let places = [[20.0, 90.0], [23.0, 88.0], [24.0, 92.0]];
        let words = ["draft", "standard", "accuracy 1%"];
        let panel = Panel::new("", Axis::new("x", ""), Axis::new("y", ""))
            .layer(Line::new("", front, Style::quiet()))
            .layer(Points::new("", places, Colour::FILM, Marker::solid(Shape::Circle)))
            .layers(places.into_iter().zip(words).map(|(at, words)| Text::new(at, words)));
        let size = |words: &str| [4.0 * words.len() as f64, 6.0];
        let names = names(&panel, [[0.0, 200.0], [0.0, 150.0]], [200.0, 150.0], size);
        assert!(names.iter().any(|(.., line)| line.is_some()), "{names:?}");
        for (name, _, line) in &names {
            let line = line.map_or_else(Vec::new, |[from, to]| along(from, to, 1.0).collect());
            for (other, [x, y], _) in names.iter().filter(|(other, ..)| other != name) {
                let [width, height] = size(other);
                assert_eq!(covered(&Rect { x: *x, y: *y, width, height }, &line), 0, "{name}, {other}: {names:?}");
            }
        }
    }

    #[test]
    fn no_contour_follows_what_is_error_alone() {
        // α of a map in which half of the points carry nothing, up to the solver's error.
        let (values, _) = levels(&[-1.1e-6, 2e-7, -3e-7, 0.98], 0.0);
        assert!(values.len() >= 4 && values.iter().all(|value| *value > 0.05), "{values:?}");
        // A map in which no point carries anything.
        let noise = [-6.7e-9, 2.2e-9, 1e-9, -3e-9];
        assert!(levels(&noise, 1.25e-5).0.is_empty() && levels(&noise, 0.0).0.len() >= 4);
    }

    #[test]
    fn contours_choose_round_values() {
        let (values, step) = levels(&[0.0, 1.03], 0.0);
        assert!(values.len() >= 5 && (step - 0.2).abs() < 1e-12, "{values:?} {step}");
    }
}
