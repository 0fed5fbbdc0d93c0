//! Purposes of file dialogs, their answers, and the kinds of export.

use super::document::Next;
use crate::job::export::Picture;
use std::path::PathBuf;

/// A kind of export to a file or a folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Export {
    /// All results of the run on screen, as `solve --out` writes them.
    Data,
    /// The figures of the run on screen, in every format.
    Figures,
    /// The fields of the run on screen as a NumPy archive.
    Fields,
    /// The cycle of the run on screen as moving pictures.
    Animation,
    /// A report of the run on screen.
    Report,
    /// All files of the pinned runs that `compare --out` writes.
    Comparison,
    /// A report of the pinned runs.
    ComparisonReport,
    /// The points of the sweep as a table.
    SweepTable,
    /// The sweep as a figure.
    SweepFigure,
    /// All files that `sweep --out` writes.
    Sweep,
    /// The measured trade-off as a table.
    TradeoffTable,
    /// The measured trade-off as a figure.
    TradeoffFigure,
    /// All files that `sensitivity --out` writes.
    Sensitivity,
    /// All files that `fit --out` writes.
    Fit,
    /// All files that `startup --out` writes.
    Startup,
    /// The answers given in lessons.
    Answers,
}

/// A kind of file and its extensions; `None` for a folder.
pub type Filter = Option<(&'static str, &'static [&'static str])>;

const TABLE: Filter = Some(("Table", &["csv"]));
const REPORT: Filter = Some(("Report", &["html"]));
const FIGURE: Filter = Some(("Figure", if cfg!(feature = "render") { &["svg", "png", "pdf"] } else { &["svg"] }));

/// Description of an export, for menus and dialogs.
#[derive(Clone, Copy, Debug)]
pub struct Described {
    /// Its entry in menus.
    pub entry: &'static str,
    /// Suggested name of the file or folder.
    pub file_name: &'static str,
    /// Kind of file and its extensions; `None` for a folder.
    pub filter: Filter,
    /// One sentence on the contents, shown on hover.
    pub about: &'static str,
}

impl Export {
    /// Its description.
    #[rustfmt::skip]
    pub fn described(self) -> Described {
        let (entry, file_name, filter, about): (_, _, Filter, _) = match self {
            Self::Data => ("All results, into a folder…", "results", None,
                "Everything about the run on screen: the scene, the numbers as JSON, loads and fields as CSV and NumPy arrays, and all figures"),
            Self::Figures => ("Figures, into a folder…", "figures", None,
                "The figures of the run on screen as SVG, PNG and PDF, ready to print"),
            Self::Fields => ("Fields as NumPy archive…", "fields.npz", Some(("NumPy archive", &["npz"])),
                "All fields over one cycle as NumPy arrays in one file, .npz"),
            Self::Animation => ("Animation…", "cycle.gif", Some(("Animation", &["gif", "mp4", "png", "apng"])),
                "One cycle as moving pictures: a GIF, an animated PNG with all colours, or an MP4 video"),
            Self::Report => ("Report as HTML…", "report.html", REPORT,
                "One HTML file with the numbers and figures of this run, which can be opened offline"),
            Self::Comparison => ("Comparison, into a folder…", "comparison", None,
                "The report, tables, overlaid figures and the animated cycle of the pinned runs"),
            Self::ComparisonReport => ("Comparison as HTML…", "report.html", REPORT,
                "One HTML file with the differences between the pinned runs, which can be opened offline"),
            Self::SweepTable => ("Sweep as table…", "sweep.csv", TABLE, "A row for each point, with every result and its error"),
            Self::SweepFigure => ("Sweep as figure…", "sweep.svg", FIGURE, "The sweep as it is drawn here, with the published points"),
            Self::Sweep => ("Sweep, into a folder…", "sweep", None, "The scene, the table as CSV and JSON, and the figure of the sweep"),
            Self::TradeoffTable => ("Trade-off as table…", "tradeoff.csv", TABLE, "A row for each setting, with its time and its error"),
            Self::TradeoffFigure => ("Trade-off as figure…", "tradeoff.svg", FIGURE,
                "Error against solve time of all settings, as it is drawn here"),
            Self::Sensitivity => ("Sensitivities, into a folder…", "sensitivity", None,
                "Derivatives and uncertainties as CSV and JSON, charts of each result, the random scenes, the scene"),
            Self::Fit => ("Fit, into a folder…", "fit", None,
                "The values found as a preset, measured and computed values as CSV and JSON, and figures; for an optimum, the lines through it"),
            Self::Startup => ("Start-up, into a folder…", "startup", None,
                "Every cycle of the start-up as CSV and JSON, a figure, and the scene"),
            Self::Answers => ("Save my answers…", "answers.csv", Some(("Record", &["csv", "jsonl"])),
                "Your answers and tasks in the lessons, to hand in; the program itself sends nothing"),
        };
        Described { entry, file_name, filter, about }
    }

    /// Title of its file dialog.
    pub fn title(self) -> &'static str {
        self.described().entry.trim_end_matches('…')
    }
}

/// Completes `path`, a file of this `kind`: if it has no extension, it gets the first of `extensions`.
///
/// # Errors
/// If the folder does not exist, if the extension belongs to another kind of file, or if a file with the completed name exists, which the
/// user has not agreed to replace.
pub fn complete(path: PathBuf, kind: &str, extensions: &[&str]) -> Result<PathBuf, String> {
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir()) {
        return Err(format!("{}: there is no folder {}", path.display(), folder.display()));
    }
    let Some(extension) = path.extension().map(|extension| extension.to_string_lossy().to_lowercase()) else {
        let mut named = path.into_os_string();
        named.push(format!(".{}", extensions[0]));
        let named = PathBuf::from(named);
        return if named.exists() {
            Err(format!("{}: there is such a file already; give its whole name to replace it", named.display()))
        } else {
            Ok(named)
        };
    };
    if extensions.contains(&extension.as_str()) {
        return Ok(path);
    }
    let allowed = extensions.iter().map(|extension| format!(".{extension}")).collect::<Vec<_>>().join(", ");
    let kind = kind.to_lowercase();
    let article = if kind.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    Err(format!("{}: “.{extension}” is none of the formats of {article} {kind}: allowed {allowed}", path.display()))
}

/// Suggested file name of a picture of the window.
pub(super) const PICTURE: &str = "squeezefilm.png";

/// Purpose of a file dialog, with the data that its answer needs.
#[derive(Clone, Debug, PartialEq)]
pub enum Purpose {
    /// Open a preset.
    Open,
    /// Save the preset, then do this.
    Save(Option<Next>),
    /// Save this picture of the window.
    Picture(Picture),
    /// Export results.
    Export(Export),
    /// Open a folder of lessons.
    Lessons,
    /// Open a table of measurements.
    Measurements,
    /// Open a file of heights.
    Heights,
    /// Open the CSV file that this key of the scene names.
    Csv(&'static str),
}

impl Purpose {
    /// Title of the dialog.
    pub fn title(&self) -> &'static str {
        match self {
            Self::Open => "Open a preset",
            Self::Save(_) => "Save the preset",
            Self::Picture(_) => "Save a picture of the window",
            Self::Export(export) => export.title(),
            Self::Lessons => "Open a folder of lessons",
            Self::Measurements => "Open a table of measurements",
            Self::Heights => "Open measured heights",
            Self::Csv(_) => "Open a CSV file",
        }
    }

    /// Kind of file and its extensions; `None` for a folder.
    pub fn filter(&self) -> Filter {
        match self {
            Self::Open | Self::Save(_) => Some(("Preset", &["toml"])),
            Self::Picture(_) => Some(("Picture", &["png"])),
            Self::Export(export) => export.described().filter,
            Self::Lessons => None,
            Self::Measurements | Self::Csv(_) => TABLE,
            Self::Heights => Some(("Heights", &["csv", "txt"])),
        }
    }

    /// Whether a file is written rather than read.
    pub fn writes(&self) -> bool {
        matches!(self, Self::Save(_) | Self::Picture(_) | Self::Export(_))
    }

    /// Whether both dialogs ask for the same kind of thing; at most one of these is open at a time.
    pub fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Export(one), Self::Export(other)) => one == other,
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }
}

/// Answer of a file dialog.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// A file was chosen.
    Path(PathBuf),
    /// The dialog was closed.
    Cancelled,
    /// No dialog could be shown: the path has to be typed.
    NoDialog,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_extension_is_told_with_the_right_article() {
        let refused = |kind| complete("cycle.txt".into(), kind, &["gif", "mp4"]).unwrap_err();
        let told = "cycle.txt: “.txt” is none of the formats of an animation: allowed .gif, .mp4";
        assert_eq!(refused("Animation"), told);
        assert!(refused("Table").contains("the formats of a table"));
    }
}
