//! Options that several commands share.

use super::exit::CliError;
use super::terminal;
use crate::atomic::{INPUT, WriteError, check_for_results};
use crate::control::Cancel;
use crate::digits::{duration, parse_duration};
use crate::export::figure::Format;
use crate::export::files::Folder;
use crate::export::html::shell;
use crate::fidelity::{Fidelity, parse_accuracy};
use crate::input::{self, ReadError};
use crate::job::export::BESIDE_DATA;
use crate::memory;
use crate::platform::{on_interrupt, timed};
use crate::scene::{Parameter, Scene, Value, presets};
use crate::solve::{Method, Settings};
use clap::Args;
use clap::builder::{PathBufValueParser, PossibleValuesParser, TypedValueParser, ValueParser};
use std::io;
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::Duration;

/// Changes to a scene.
#[derive(Clone, Debug, Default, Args)]
pub(super) struct SceneOptions {
    /// Changes a key of the scene, written as TABLE.KEY; may be repeated
    ///
    /// Keys carry their unit: --set film.min_spacing_nm=100 --set stator.tooth_radius_m=3. A number may use another unit of its
    /// kind: --set film.min_spacing_nm=0.1um. `none` removes an optional key. All changes are applied together, in any order.
    /// A length of a part of the rotor is set by the part's name: --set rotor.part.flange.r_inner_mm=26.5; where its edge touches
    /// another part, the edge of that part moves with it.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = pair)]
    pub(super) changes: Vec<(String, String)>,
}

impl SceneOptions {
    /// The scene of a PRESET argument with the changes of `--set`, and a name that says so. A note lists the values that are assumed.
    pub(super) fn scene(&self, preset: &str) -> Result<Scene, CliError> {
        self.scene_varied(preset, &[])
    }

    /// Likewise, for a command that itself varies these keys.
    pub(super) fn scene_varied(&self, preset: &str, varied: &[&str]) -> Result<Scene, CliError> {
        let (original, text) = original(preset)?;
        let scene = self.changed(&original)?;
        let named = |parameter: &&'static Parameter| {
            self.changes.iter().any(|(key, _)| key == parameter.key)
                || varied.contains(&parameter.key)
                || parameter.alternatives().any(|other| varied.contains(&other.key))
                || parameter.when.iter().any(|(selector, _)| varied.contains(selector))
        };
        let assumed =
            presets::assumed(text.as_deref(), &original, &scene).into_iter().filter(|parameter| !named(parameter));
        let assumed = assumed.filter_map(|parameter| {
            let value = scene.get(parameter.key).filter(|value| value.as_number() != Some(0.0))?;
            Some(format!("{} = {}", parameter.key, parameter.with_unit(value)))
        });
        let assumed: Vec<String> = assumed.collect();
        if !assumed.is_empty() {
            terminal::note(&format!("{preset}: assumed, since they are not given: {}", assumed.join(", ")));
        }
        Ok(scene)
    }

    /// The scenes of several PRESET arguments, likewise.
    pub(super) fn scenes(&self, presets: &[String]) -> Result<Vec<Scene>, CliError> {
        presets.iter().map(|preset| self.scene(preset)).collect()
    }

    /// The scene of the PRESET argument, and the same scene with the changes of `--set`.
    #[cfg(feature = "gui")]
    pub(super) fn original_and_changed(&self, preset: &str) -> Result<(Scene, Scene), CliError> {
        let (original, _) = original(preset)?;
        let scene = self.changed(&original)?;
        Ok((original, scene))
    }

    fn changed(&self, original: &Scene) -> Result<Scene, CliError> {
        let mut scene = original.with(&self.changes)?;
        let changed = |key| scene.get(key) != original.get(key);
        if changed(PRESSURE) && !changed("film.mean_free_path_nm") {
            warn_of_given_path(&scene);
        }
        // The preset's name and description do not describe a changed scene.
        scene.retitle(original);
        Ok(scene)
    }

    /// The command that solves this scene alone, to be copied into a shell and added to.
    pub(super) fn command(&self, preset: &str) -> String {
        let mut words = ["squeezefilm", "solve", preset].map(str::to_owned).to_vec();
        words.extend(self.changes.iter().flat_map(|(key, value)| ["--set".to_owned(), format!("{key}={value}")]));
        shell(&words)
    }
}

pub(super) const PRESSURE: &str = "film.ambient_pressure_kpa";

/// Warns if the mean free path is given and so does not follow a change of the pressure.
pub(super) fn warn_of_given_path(scene: &Scene) {
    if let Some(path) = scene.given_mean_free_path() {
        terminal::warning(&format!(
            "the mean free path stays at {path} nm at another pressure; for a named gas it follows the pressure: --set film.gas=air"
        ));
    }
}

/// Help of a PRESET argument.
pub(super) const PRESET: &str =
    "A built-in preset (see: squeezefilm presets), the path of a TOML file, or - for standard input";

/// The argument that stands for standard input.
pub(super) const STANDARD_INPUT: &str = "-";
/// The largest preset on standard input \[MB\].
const LARGEST: u64 = 16;

/// The fault of what was read from standard input.
pub(super) fn from_input(fault: ReadError) -> CliError {
    CliError::Input(format!("standard input: {fault}"))
}

/// The text on standard input, of up to `limit` \[MB\].
pub(super) fn standard_input(limit: u64) -> Result<String, CliError> {
    let text = input::read_stream(io::stdin().lock(), limit).map_err(from_input)?;
    if text.trim().is_empty() {
        return Err(CliError::usage("standard input: it is empty, or has been read: - can be given once"));
    }
    Ok(text)
}

/// The scene of a PRESET argument, and the text that it was read from (`None` for a built-in preset).
fn original(preset: &str) -> Result<(Scene, Option<String>), CliError> {
    if preset != STANDARD_INPUT {
        return Ok(presets::read(preset)?);
    }
    let text = standard_input(LARGEST)?;
    Ok((presets::disclaimed(Scene::from_toml(&text, "standard input")?), Some(text)))
}

/// Refuses a folder in which one of these files is an input of this command, because the command would overwrite it.
pub(super) fn spare_inputs(folder: &Folder<'_>, names: &[&str]) -> Result<(), CliError> {
    let same = |path: &PathBuf, name: &&str| same_file::is_same_file(path, folder.path.join(name)).unwrap_or(false);
    match input::read_so_far().into_iter().find(|path| names.iter().any(|name| same(path, name))) {
        Some(path) => Err(WriteError { path, source: io::Error::new(io::ErrorKind::AlreadyExists, INPUT) }.into()),
        None => Ok(()),
    }
}

/// Reads a path that is written to, or that cannot be standard input: `-` is refused.
pub(super) fn named_path() -> ValueParser {
    let why = "- is no path: only a preset, fit --data and surface may be standard input, and no file goes to standard output";
    let named = move |path: PathBuf| if path.as_os_str() == STANDARD_INPUT { Err(why) } else { Ok(path) };
    PathBufValueParser::new().try_map(named).into()
}

/// How accurate a result should be, and how long the solve may take.
#[derive(Clone, Copy, Debug, Default, Args)]
pub(super) struct AccuracyOptions {
    /// Accuracy of the result, by name
    #[arg(long, value_name = "LEVEL", value_parser = fidelity(), conflicts_with = "accuracy", long_help = fidelity_help())]
    fidelity: Option<Fidelity>,

    /// Accuracy of the result, as a number: 0.1% or 0.001
    ///
    /// Grids are refined until the stated error is that small, or until the work reaches a limit. The result states its error.
    #[arg(long, value_name = "ERROR", value_parser = accuracy, allow_hyphen_values = true)]
    accuracy: Option<Fidelity>,

    /// Time limit per solve: 20ms, 1.5s or 2min; the best result by then is kept
    ///
    /// Without an accuracy, the aim is that of `reference`. The first grids are always completed, however short the time.
    #[arg(long, value_name = "TIME", value_parser = parse_duration, allow_hyphen_values = true)]
    pub(super) budget: Option<Duration>,
}

impl AccuracyOptions {
    /// The accuracy asked for, by name or by number.
    fn named(&self) -> Option<Fidelity> {
        self.accuracy.or(self.fidelity)
    }

    /// The fidelity asked for, if one was: a budget alone aims at `reference`.
    pub(super) fn fidelity(&self) -> Option<Fidelity> {
        self.named().or(self.budget.map(|_| Fidelity::Reference))
    }
}

/// How to solve.
#[derive(Clone, Debug, Args)]
pub(super) struct SolveOptions {
    #[command(flatten)]
    pub(super) accuracy: AccuracyOptions,

    /// The algorithm
    ///
    /// auto solves only what the scene needs; paper is the algorithm of Maeno and Bogy (1992) on its own meshes, kept for
    /// comparison.
    #[arg(long, value_name = "METHOD", value_parser = method())]
    pub(super) method: Option<Method>,

    /// Number of threads [default: one per core]
    #[arg(long, value_name = "N", value_parser = whole::<u16>(1..=1024), allow_negative_numbers = true)]
    pub(super) threads: Option<u16>,

    #[command(flatten)]
    memory: MemoryOptions,
}

/// A solve that takes longer than this many times its budget gives a warning.
const OVER: f64 = 1.5;

impl SolveOptions {
    /// The settings, and the flag that cancels: the command on Ctrl-C, and each solve after its budget.
    pub(super) fn begin(&self) -> Result<(Settings, Cancel), CliError> {
        self.begin_with(Fidelity::default(), Method::default())
    }

    /// As `begin`, with these defaults for options that were not given. Starts the threads and sets the memory limit.
    pub(super) fn begin_with(&self, fidelity: Fidelity, method: Method) -> Result<(Settings, Cancel), CliError> {
        if let Some(threads) = self.threads {
            rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads)).build_global().map_err(|fault| {
                CliError::System(format!("--threads {threads}: the threads cannot be started: {fault}"))
            })?;
        }
        self.memory.apply();
        let method = self.method.unwrap_or(method);
        if let (Method::Paper, Some(time)) = (method, self.accuracy.budget) {
            terminal::warning(&format!("--budget {time:?} has no effect: method paper has its own meshes"));
        }
        if let (Method::Paper, Some(level)) = (method, self.accuracy.named()) {
            terminal::warning(&format!("{} has no effect: method paper has its own meshes", level.option()));
        }
        let fidelity = self.accuracy.fidelity().unwrap_or(fidelity);
        let interrupted = cancel_on_interrupt();
        let cancel = self.accuracy.budget.map_or(interrupted.clone(), |budget| timed(&interrupted, budget));
        Ok((Settings { fidelity, method, ..Settings::default() }, cancel))
    }

    /// Warns that `work` took longer than its budget, in `wall_s` seconds.
    pub(super) fn tell_if_late(&self, work: &str, wall_s: f64) {
        let over = |budget: &Duration| self.method != Some(Method::Paper) && wall_s > OVER * budget.as_secs_f64();
        if let Some(budget) = self.accuracy.budget.filter(over) {
            terminal::warning(&format!(
                "--budget {budget:?}: {work} took {}; the first grids are always completed, and later ones end after the present round",
                duration(wall_s)
            ));
        }
    }
}

/// Exit status that a shell reports for a program ended by Ctrl-C.
const KILLED: i32 = 130;

/// A flag that the first Ctrl-C (or a request to terminate) raises; the second ends the program.
pub(super) fn cancel_on_interrupt() -> Cancel {
    let cancel = Cancel::new();
    let raised = cancel.clone();
    on_interrupt(move || {
        if raised.is_cancelled() {
            std::process::exit(KILLED);
        }
        raised.cancel();
    });
    cancel
}

/// How much memory solving may take.
#[derive(Clone, Debug, Default, Args)]
pub(super) struct MemoryOptions {
    /// Memory limit for solving, as in 4GB or 500MB [default: a quarter of this machine's]
    ///
    /// What a scene needs follows from its grid and steps, and is checked against this before anything is solved. Simultaneous
    /// solves share the limit.
    #[arg(long, value_name = "SIZE", value_parser = memory_size)]
    memory: Option<u64>,
}

impl MemoryOptions {
    /// Sets the limit for all solves from now on.
    pub(super) fn apply(&self) {
        if let Some(bytes) = self.memory {
            memory::allow(bytes);
        }
    }

    /// The option again, after a space, for a command to be copied; empty if it was not given.
    pub(super) fn option(&self) -> String {
        self.memory.map_or_else(String::new, |bytes| format!(" --memory {}KB", bytes as f64 / 1e3))
    }
}

fn memory_size(text: &str) -> Result<u64, String> {
    let text = text.trim();
    let units = [("KB", 1e3), ("MB", 1e6), ("GB", 1e9), ("TB", 1e12)];
    let upper = text.to_ascii_uppercase();
    let split = units.iter().find_map(|(name, unit)| Some((upper.strip_suffix(name)?, *unit)));
    split
        .and_then(|(number, unit)| Some(number.trim().parse::<f64>().ok()? * unit))
        .filter(|bytes| (1.0..1e18).contains(bytes))
        .map(|bytes| bytes as u64)
        .ok_or_else(|| "expected a size above 0 with its unit, as in 4GB or 500MB".to_owned())
}

/// What to print, and where to write.
#[derive(Clone, Debug, Args)]
pub(super) struct OutputOptions {
    /// Prints JSON, and nothing else, to standard output
    #[arg(long)]
    pub(super) json: bool,

    /// Writes files into this folder, made if needed; files of the same name are replaced
    #[arg(long, value_name = "DIR", value_parser = named_path())]
    pub(super) out: Option<PathBuf>,

    /// Formats of the figures in --out: svg, png, pdf; none for no figures; for solve also vtk, the film at each instant for ParaView
    #[arg(long, value_name = "FORMATS", value_delimiter = ',', requires = "out", default_values = BESIDE_DATA.iter().map(|format| format.name()), value_parser = figure_names())]
    figures: Vec<String>,
}

impl OutputOptions {
    /// The folder of `--out` for results of this command line. Checks before anything is solved that it can be written into, and that
    /// the formats of the figures go together. For a command that does not write fields.
    pub(super) fn folder<'a>(&'a self, command: &'a [String]) -> Result<Option<Folder<'a>>, CliError> {
        if self.has("vtk") {
            return Err(CliError::usage("--figures vtk: only solve has the film at every instant"));
        }
        self.folder_of_fields(command)
    }

    /// As `folder`, for a command that writes fields.
    pub(super) fn folder_of_fields<'a>(&'a self, command: &'a [String]) -> Result<Option<Folder<'a>>, CliError> {
        if self.has("none") && self.figures.len() > 1 {
            return Err(CliError::usage("--figures none means no figures: give it alone, or leave it out"));
        }
        let Some(path) = &self.out else { return Ok(None) };
        check_for_results(path)?;
        let formats = Format::ALL.into_iter().filter(|format| self.has(format.name())).collect();
        let folder = Folder { path, command, formats, vtk: self.has("vtk") };
        // A changed preset must not overwrite the file that it was read from.
        if command.iter().any(|word| word == "--set" || word.starts_with("--set=")) {
            spare_inputs(&folder, &["scene.toml"])?;
        }
        Ok(Some(folder))
    }

    fn has(&self, format: &str) -> bool {
        self.figures.iter().any(|figure| figure == format)
    }
}

/// The options of a command that solves presets and writes files and figures.
#[derive(Clone, Debug, Args)]
pub(super) struct CommonOptions {
    #[command(flatten)]
    pub(super) scene: SceneOptions,

    #[command(flatten)]
    pub(super) solve: SolveOptions,

    #[command(flatten)]
    pub(super) output: OutputOptions,
}

impl CommonOptions {
    /// The folder of `--out`, and what [`SolveOptions::begin`] returns.
    pub(super) fn begin<'a>(
        &'a self,
        command: &'a [String],
    ) -> Result<(Option<Folder<'a>>, Settings, Cancel), CliError> {
        // A command that is interrupted from here on leaves nothing behind.
        let (settings, cancel) = self.solve.begin()?;
        Ok((self.output.folder(command)?, settings, cancel))
    }
}

fn figure_names() -> PossibleValuesParser {
    PossibleValuesParser::new(Format::WRITTEN.iter().map(|format| format.name()).chain(["none", "vtk"]))
}

/// Reads a number within limits; `kind`: what it is, in words.
pub(super) fn within<T: Copy + PartialOrd + FromStr + Into<f64>>(
    allowed: RangeInclusive<T>,
    kind: &'static str,
) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| {
        let [from, to] = [allowed.start(), allowed.end()].map(|end| Value::Number((*end).into()));
        let number = text.parse().ok().filter(|number| allowed.contains(number));
        number.ok_or_else(|| format!("expected {kind} from {from} to {to}"))
    }
}

/// Reads a whole number within limits.
pub(super) fn whole<T: Copy + PartialOrd + FromStr + Into<f64>>(
    allowed: RangeInclusive<T>,
) -> impl Fn(&str) -> Result<T, String> + Clone {
    within(allowed, "a whole number")
}

/// `key=value`, as text.
pub(super) fn pair(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => Ok((key.trim().to_owned(), value.trim().to_owned())),
        _ => Err("expected key=value, as in film.min_spacing_nm=100".to_owned()),
    }
}

fn accuracy(text: &str) -> Result<Fidelity, String> {
    parse_accuracy(text).map(Fidelity::to)
}

fn fidelity() -> ValueParser {
    PossibleValuesParser::new(Fidelity::ALL.map(Fidelity::name)).try_map(|name| name.parse::<Fidelity>()).into()
}

fn fidelity_help() -> String {
    let named = Fidelity::ALL.map(|level| format!("{} % ({level})", 100.0 * level.accuracy()));
    format!(
        "Accuracy level\n\n\
         Grids are refined until the stated error of α, or of a plate's mean load, is at most {} of its value, or \
         until the work reaches a limit; the finite elements of a ring allow about 0.3 %. The result states its error. Where the film carries less than a hundredth of the \
         load, the error is compared with that hundredth instead.\n\n\
         [default: {}; fine for table1 and reproduce; for gui, the level last chosen in the window]",
        named.join(", "),
        Fidelity::default()
    )
}

fn method() -> ValueParser {
    PossibleValuesParser::new([Method::Auto, Method::Paper].map(Method::name))
        .map(|name| if name == Method::Paper.name() { Method::Paper } else { Method::Auto })
        .into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_changed_scene_does_not_claim_to_be_the_preset() {
        let scene = |changes: &[(&str, &str)]| {
            let changes = changes.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
            SceneOptions { changes }.scene("fundamental").unwrap()
        };
        let published = presets::find("fundamental").unwrap();
        assert_eq!(scene(&[("film.min_spacing_nm", "200")]), published);
        let one = scene(&[("film.min_spacing_nm", "100")]);
        assert_eq!(one.name, "Fundamental case, changed: 1 key");
        assert_eq!(one.about, "Fundamental case with film.min_spacing_nm = 100 nm, was 200 nm.");
        assert_eq!(one.headline(), "Fundamental case, minimum spacing H_m 100 nm");
        assert_eq!(published.headline(), published.name);
        let three = [("film.min_spacing_nm", "100"), ("stator.tooth_radius_m", "3"), ("film.slip", "none")];
        assert_eq!(scene(&three).name, "Fundamental case, changed: 3 keys");
        assert_eq!(scene(&three[1..]).headline(), "Fundamental case, tooth radius 3 m, slip at the walls none");
        // Too long to be read above a figure.
        assert_eq!(scene(&three).headline(), scene(&three).name);
        // What a figure varies is not one of the changes.
        let over = |changes: &[(&str, &str)], keys: &[&str]| {
            let varied: Vec<_> = keys.iter().map(|key| crate::scene::Parameter::find(key).unwrap()).collect();
            scene(changes).headline_over(&varied)
        };
        let without_spacing = "Fundamental case, tooth radius 3 m, slip at the walls none";
        assert_eq!(over(&three, &["film.min_spacing_nm"]), without_spacing);
        assert_eq!(over(&three[..1], &["film.min_spacing_nm"]), "Fundamental case");
        assert_eq!(over(&three, &["motor.dry_friction"]), "Fundamental case, changed: 3 keys");
        let four = [&three[..], &[("stator.frequency_khz", "45.123")]].concat();
        assert_eq!(over(&four, &["film.min_spacing_nm"]), "Fundamental case, changed: 3 keys");
        assert!(scene(&three).about.contains("stator.tooth_radius_m = 3 m, was none;"), "{}", scene(&three).about);
        let long = scene(&[("film.min_spacing_nm", "123.456789012")]);
        assert!(long.about.contains("film.min_spacing_nm = 123.457 nm, was 200 nm."), "{}", long.about);
        assert_eq!(long.get("film.min_spacing_nm").unwrap().as_number(), Some(123.456789012));
        let named = scene(&[("film.min_spacing_nm", "100"), ("name", "Mine"), ("about", "My own.")]);
        assert_eq!((named.name.as_str(), named.about.as_str(), &*named.headline()), ("Mine", "My own.", "Mine"));
    }

    #[test]
    fn a_command_can_be_copied() {
        let memory = MemoryOptions { memory: Some(1_500_000) };
        assert_eq!((memory.option(), memory_size("1500KB")), (" --memory 1500KB".to_owned(), Ok(1_500_000)));
        let changes = vec![("motor.waves".to_owned(), "8".to_owned()), ("name".to_owned(), "my motor's".to_owned())];
        assert_eq!(
            SceneOptions { changes }.command("my file.toml"),
            r"squeezefilm solve 'my file.toml' --set motor.waves=8 --set 'name=my motor'\''s'"
        );
    }
}
