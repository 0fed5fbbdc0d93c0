//! Exit status, and what ends a command early.

use crate::analysis::attempt::RunStatus;
use crate::analysis::compare::CompareError;
use crate::analysis::fit::FitError;
use crate::analysis::sensitivity::SensitivityError;
use crate::analysis::sweep::SweepError;
use crate::atomic::WriteError;
use crate::export::figure::FigureError;
use crate::export::files::ExportError;
use crate::export::saved::{self, JoinError};
use crate::input::ReadError;
use crate::lessons::record::RecordError;
use crate::scene::SceneError;
use crate::solution::Status;
use crate::solve::SolveError;
use std::io;
use std::path::PathBuf;
use std::process::ExitCode;

/// How a command ended, the worse the later.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Exit {
    /// Solved.
    Solved,
    /// Not converged.
    NotConverged,
    /// Bad input.
    BadInput,
    /// Anything else.
    Other,
    /// Nobody reads standard output any more.
    Unread,
}

impl Exit {
    /// What a solve that ended so leads to.
    pub(super) fn of(status: &Status) -> Self {
        Self::from(&RunStatus::from(*status))
    }

    /// The status.
    pub(super) fn code(self) -> ExitCode {
        ExitCode::from(match self {
            Self::Solved => 0,
            Self::Other => 1,
            Self::BadInput => 2,
            Self::NotConverged => 3,
            // As a shell reports a program that is ended by the signal of a closed pipe.
            Self::Unread => 141,
        })
    }

    /// What several lead to: the worst of them.
    pub(super) fn worst(all: impl IntoIterator<Item = Self>) -> Self {
        all.into_iter().max().unwrap_or(Self::Solved)
    }
}

/// What ends a command early.
#[derive(Debug, thiserror::Error)]
pub(super) enum CliError {
    /// A preset or a `--set`.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The solver.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// A sweep that cannot be made.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// A sensitivity that cannot be told.
    #[error(transparent)]
    Sensitivity(#[from] SensitivityError),
    /// A fit that cannot be made.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A comparison that cannot be made.
    #[error(transparent)]
    Compare(#[from] CompareError),
    /// What a cancelled sweep left cannot be continued.
    #[error("{}: cannot be continued: {source}; give another folder, or --restart to begin anew", path.display())]
    Resume { path: PathBuf, source: saved::ReadError },
    /// Parts of a sweep that are not joined.
    #[error(transparent)]
    Join(#[from] JoinError),
    /// A file that was given.
    #[error("{}: {source}", path.display())]
    File { path: PathBuf, source: ReadError },
    /// Another sweep has the folder.
    #[error("{}: another sweep is being saved into this folder; give another folder, or wait for it", folder.display())]
    Busy { folder: PathBuf },
    /// Answers, measured faces, lessons: why they are of no use.
    #[error("{0}")]
    Answers(String),
    /// A record of answers.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// Options that do not go together.
    #[error("{0}")]
    Usage(&'static str),
    /// A file or folder of `--out`.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A figure of `--out`.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// What `--out` writes.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// `--threads`.
    #[error("--threads {threads}: the threads cannot be started: {source}")]
    Threads { threads: u16, source: rayon::ThreadPoolBuildError },
    /// The thread that a command runs on.
    #[error("no thread can be started: {0}")]
    Thread(io::Error),
    /// A link in place of a preset.
    #[cfg(feature = "gui")]
    #[error(transparent)]
    Link(#[from] crate::gui::state::link::LinkError),
    /// The window.
    #[cfg(feature = "gui")]
    #[error(
        "no window can be opened here: {reason}\nwithout one: squeezefilm solve fundamental, or squeezefilm --help{advice}"
    )]
    Window { reason: String, advice: &'static str },
    /// A preset on standard input.
    #[error("standard input: {0}")]
    Input(ReadError),
    /// Standard output.
    #[error("standard output: cannot be written: {0}")]
    Output(io::Error),
}

impl From<&RunStatus> for Exit {
    fn from(status: &RunStatus) -> Self {
        match status {
            RunStatus::Converged => Self::Solved,
            RunStatus::NotConverged => Self::NotConverged,
            RunStatus::Waiting | RunStatus::GivenUp | RunStatus::Failed(_) => Self::Other,
        }
    }
}

impl CliError {
    /// Whether nothing is to be said of it: whoever left a pipe knows.
    pub(super) fn is_silent(&self) -> bool {
        matches!(self, Self::Output(error) if error.kind() == io::ErrorKind::BrokenPipe)
    }

    /// The exit status it leads to.
    pub(super) fn exit(&self) -> Exit {
        match self {
            Self::Solve(error) | Self::Sensitivity(SensitivityError::Solve(error)) if !error.is_bad_input() => {
                Exit::Other
            }
            Self::Fit(error) if !error.is_bad_input() => Exit::Other,
            Self::Output(_) if self.is_silent() => Exit::Unread,
            Self::Export(ExportError::Extension { .. }) => Exit::BadInput,
            Self::Write(_) | Self::Figure(_) | Self::Export(_) | Self::Output(_) => Exit::Other,
            Self::Threads { .. } | Self::Thread(_) => Exit::Other,
            #[cfg(feature = "gui")]
            Self::Window { .. } => Exit::Other,
            // All others are about what was given.
            _ => Exit::BadInput,
        }
    }
}
