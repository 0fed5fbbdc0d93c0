//! The rules between the keys of a scene. The values that a key accepts by itself are in [`super::PARAMETERS`], and are checked when it is
//! set.

use super::error::{FaultKind, SceneError};
use super::parameter::{Parameter, Range};
use super::value::{Value, show_number};
use super::values::{Kind, Scene};

/// Narrowest tooth, as a share of the pitch; the widest is the pitch itself.
const NARROWEST_TOOTH: f64 = 0.01;

/// Widest hole of a plate, as a share of its radius.
const WIDEST_HOLE: f64 = 0.99;

/// A rule between keys.
struct Rule {
    /// The keys that the rule is about. It is checked if the first of them can change the results of the scene.
    keys: &'static [&'static str],
    /// Returns the fault, if the rule is broken.
    check: fn(&Scene) -> Result<(), FaultKind>,
}

static RULES: &[Rule] = &[
    Rule {
        keys: &["rotor.model", "rotor.compliance", "rotor.compliance_csv", "rotor.green", "rotor.green_csv"],
        check: table_is_given,
    },
    Rule { keys: &["rotor.part", "rotor.support"], check: |scene| scene.section().map(drop) },
    Rule { keys: &["numerics.wedge", "film.shear", "numerics.flow"], check: wedge_is_there },
    Rule { keys: &["numerics.time", "surface.flow_factors"], check: gas_has_time },
    Rule {
        keys: &["stator.tooth_width_mm", "motor.contact_radius_mm", "motor.waves", "stator.teeth_per_wave"],
        check: tooth_fits_the_pitch,
    },
    Rule { keys: &["plate.inner_radius_mm", "plate.radius_mm"], check: hole_is_inside },
    Rule { keys: &["plate.amplitude_um", "plate.mean_gap_um"], check: plate_stays_clear },
];

impl Scene {
    /// Checks the rules between keys; each key's own range is checked when it is set.
    pub fn check(&self) -> Result<(), SceneError> {
        let mut faults = SceneError::none();
        self.broken_rules().for_each(|(_, what)| faults.push(what));
        faults.or(())
    }

    /// The rules that are broken, each with the keys it is about.
    pub(super) fn broken_rules(&self) -> impl Iterator<Item = (&'static [&'static str], FaultKind)> + '_ {
        let has = |parameter: &'static Parameter| self.has(parameter) && self.heeds(parameter.key);
        let matters = move |rule: &&Rule| Parameter::find(rule.keys[0]).is_some_and(has);
        let broken = RULES.iter().filter(matters).filter_map(|rule| Some((rule.keys, (rule.check)(self).err()?)));
        broken.chain(self.following_out_of_range())
    }

    /// A value outside its key's own range also breaks a rule between keys, if the rule allows less. The fault is then that of the rule,
    /// with the narrower range.
    pub(super) fn narrowed(&self, fault: FaultKind) -> FaultKind {
        let FaultKind::OutOfRange { parameter, value, .. } = &fault else { return fault };
        let parameter = *parameter;
        let (Some(number), true) = (value.as_number(), self.heeds(parameter.key)) else { return fault };
        let mut tried = self.clone();
        tried.put(parameter, Some(Value::Number(number)));
        let mut of_key = RULES.iter().filter(|rule| rule.keys[0] == parameter.key);
        of_key.find_map(|rule| (rule.check)(&tried).err()).unwrap_or(fault)
    }

    /// The range of a key in this scene: its own, narrowed to what the other keys allow. `None` for a key that is not a
    /// number or does not apply. The upper end of the range of `plate.amplitude_um` is itself not allowed.
    pub fn range(&self, key: &str) -> Option<Range> {
        let parameter = Parameter::find(key).filter(|parameter| self.has(parameter))?;
        let own = parameter.range()?;
        let narrower = match key {
            "stator.tooth_width_mm" => self.tooth_widths_mm().ok()?,
            "plate.inner_radius_mm" => Range::new(0.0, WIDEST_HOLE * self.number("plate.radius_mm").ok()?),
            "plate.amplitude_um" if !self.floats() => Range::new(0.0, self.number("plate.mean_gap_um").ok()?),
            _ => match (parameter.instead_of, self.factor(key)) {
                (Some(replaced), Some([factor, divisor])) => {
                    let Range { min, max } = Parameter::find(replaced)?.range()?;
                    Range::new(min * (factor / divisor), max * (factor / divisor))
                }
                _ => own,
            },
        };
        Some(Range::new(narrower.min.max(own.min), narrower.max.min(own.max)))
    }

    /// Tooth widths the pitch allows \[mm\].
    fn tooth_widths_mm(&self) -> Result<Range, FaultKind> {
        let pitch = self.pitch_mm()?;
        Ok(Range::new(NARROWEST_TOOTH * pitch, pitch))
    }
}

fn table_is_given(scene: &Scene) -> Result<(), FaultKind> {
    let (model, rows) = match scene.text("rotor.model")? {
        "table" => ("table", "rotor.compliance"),
        "green" => ("green", "rotor.green"),
        _ => return Ok(()),
    };
    unless(scene.rows(rows).is_empty(), "rotor.model", || {
        format!("rotor.model = \"{model}\" needs {rows}_csv or {rows}")
    })
}

fn wedge_is_there(scene: &Scene) -> Result<(), FaultKind> {
    let asked = scene.text("numerics.wedge")? == "on";
    unless(asked && !scene.flag("film.shear")?, "numerics.wedge", || {
        "numerics.wedge = \"on\" solves the wedge term, and film.shear = false says that there is none: change one of the two"
            .to_owned()
    })?;
    unless(asked && scene.text("numerics.flow")? == "across", "numerics.wedge", || {
        "numerics.wedge = \"on\" lets sliding carry gas through the ends of a tooth, and numerics.flow = \"across\" closes them: \
         change one of the two"
            .to_owned()
    })
}

fn gas_has_time(scene: &Scene) -> Result<(), FaultKind> {
    if scene.kind() != Kind::Motor {
        return Ok(());
    }
    let flows = scene.text("numerics.time")? == "trapped" && scene.text("surface.flow_factors")? != "none";
    unless(flows, "numerics.time", || {
        "numerics.time = \"trapped\" is known for smooth faces only, and surface.flow_factors are those of rough ones: change one of the \
         two"
            .to_owned()
    })
}

fn tooth_fits_the_pitch(scene: &Scene) -> Result<(), FaultKind> {
    let (range, width) = (scene.tooth_widths_mm()?, scene.number("stator.tooth_width_mm")?);
    let (radius, waves) = (scene.number("motor.contact_radius_mm")?, scene.number("motor.waves")?);
    let teeth = scene.number("stator.teeth_per_wave")?;
    unless(!range.contains(width), "stator.tooth_width_mm", || {
        let [width, radius] = [width, radius].map(show_number);
        format!(
            "stator.tooth_width_mm = {width} is out of range: allowed {} mm, 1 % to 100 % of the tooth pitch \
             2π × {radius} mm / {waves} waves / {teeth} teeth",
            rounded_inwards(range)
        )
    })
}

fn hole_is_inside(scene: &Scene) -> Result<(), FaultKind> {
    let (hole, radius) = (scene.number("plate.inner_radius_mm")?, scene.number("plate.radius_mm")?);
    unless(hole > WIDEST_HOLE * radius, "plate.inner_radius_mm", || {
        let [hole, radius] = [hole, radius].map(show_number);
        format!(
            "plate.inner_radius_mm = {hole} is out of range: allowed up to {WIDEST_HOLE} of plate.radius_mm = {radius} mm"
        )
    })
}

fn plate_stays_clear(scene: &Scene) -> Result<(), FaultKind> {
    if scene.floats() {
        return Ok(());
    }
    let (amplitude, gap) = (scene.number("plate.amplitude_um")?, scene.number("plate.mean_gap_um")?);
    unless(amplitude >= gap, "plate.amplitude_um", || {
        let [amplitude, gap] = [amplitude, gap].map(show_number);
        format!(
            "plate.amplitude_um = {amplitude} is out of range: allowed 0 to below plate.mean_gap_um = {gap} µm, or the plate \
             touches"
        )
    })
}

fn unless(broken: bool, key: &'static str, message: impl FnOnce() -> String) -> Result<(), FaultKind> {
    if broken { Err(FaultKind::Rule { key, message: message() }) } else { Ok(()) }
}

/// The range to six digits, rounded inwards, so that both ends as they are shown are allowed.
fn rounded_inwards(range: Range) -> Range {
    let digits = |value: f64| 10f64.powi(5 - value.log10().floor() as i32);
    let (low, high) = (digits(range.min), digits(range.max));
    Range::new((range.min * low).ceil() / low, (range.max * high).floor() / high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shown_range_is_inside_the_real_one() {
        let range = Range::new(0.028_921_741_3, 2.892_174_13);
        assert_eq!(rounded_inwards(range), Range::new(0.028_921_8, 2.892_17));
    }

    #[test]
    fn the_range_of_a_key_follows_the_other_keys() {
        let mut scene = Scene::motor();
        let pitch = std::f64::consts::TAU * 29.0 / 63.0;
        let range = scene.range("stator.tooth_width_mm").unwrap();
        assert!((range.max / pitch - 1.0).abs() < 1e-14 && (range.min / pitch - 0.01).abs() < 1e-14);
        scene.set("stator.teeth_per_wave", "18").unwrap();
        assert!((scene.range("stator.tooth_width_mm").unwrap().max / pitch - 0.5).abs() < 1e-14);
        assert_eq!(scene.range("plate.amplitude_um"), None);
        assert_eq!(Scene::plate().range("plate.amplitude_um"), Some(Range::new(0.0, 1.0)));
        assert_eq!(scene.range("film.min_spacing_nm"), Some(Range::new(5.0, 10000.0)));
    }

    #[test]
    fn one_range_is_told_however_far_out_a_value_is() {
        let scene = Scene::motor();
        for value in [-3.0, 4.0, 1e99] {
            let mut tried = scene.clone();
            let set = tried.set_value("stator.tooth_width_mm", Value::Number(value));
            let one = set.and_then(|()| tried.check()).unwrap_err().to_string();
            let pair = ("stator.tooth_width_mm", value.to_string());
            let all = scene.with([pair]).unwrap_err().to_string();
            assert!(one.contains("allowed 0.0289226 to 2.89225 mm, 1 % to 100 %") && one == all, "{one}\n{all}");
        }
        // The other keys that are set along with it count.
        let pairs = [("stator.tooth_width_mm", "1e99"), ("stator.teeth_per_wave", "18")];
        let all = scene.with(pairs).unwrap_err().to_string();
        assert!(all.contains("7 waves / 18 teeth"), "{all}");
    }

    #[test]
    fn a_rule_is_about_keys_that_exist() {
        for rule in RULES {
            assert!(rule.keys.iter().all(|key| Parameter::find(key).is_some()), "{:?}", rule.keys);
        }
    }
}
