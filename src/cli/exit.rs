//! Exit status, and what ends a command early.

use crate::analysis::attempt::RunStatus;
use crate::analysis::error::AnalysisError;
use crate::atomic::WriteError;
use crate::export::files::ExportError;
use crate::scene::SceneError;
use crate::solution::Status;
use crate::solve::SolveError;
use std::fmt::Display;
use std::io;
use std::path::Path;
use std::process::ExitCode;

/// How a command ended, from best to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Exit {
    Solved,
    NotConverged,
    BadInput,
    /// Anything else.
    Other,
    /// The reader of standard output has closed it.
    Unread,
}

impl Exit {
    /// Exit status after a solve that ended with this status.
    pub(super) fn of(status: &Status) -> Self {
        Self::from(&RunStatus::from(*status))
    }

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

    /// The worst of several.
    pub(super) fn worst(all: impl IntoIterator<Item = Self>) -> Self {
        all.into_iter().max().unwrap_or(Self::Solved)
    }
}

/// Error that ends a command early.
#[derive(Debug, thiserror::Error)]
pub(super) enum CliError {
    /// A preset or a `--set`.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The solver.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// A sweep, comparison, fit or sensitivity that cannot be made.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// Any other input: options that do not go together, answers, files. The message says why it cannot be used.
    #[error("{0}")]
    Input(String),
    /// A file or folder of `--out`.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A file that `--out` cannot make.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// The system refuses threads or a window.
    #[error("{0}")]
    System(String),
    /// Standard output.
    #[error("standard output: cannot be written: {0}")]
    Output(io::Error),
}

impl From<&RunStatus> for Exit {
    fn from(status: &RunStatus) -> Self {
        match status {
            RunStatus::Converged => Self::Solved,
            RunStatus::NotConverged | RunStatus::NotResolved => Self::NotConverged,
            RunStatus::Waiting | RunStatus::GivenUp | RunStatus::Failed(_) => Self::Other,
        }
    }
}

impl CliError {
    /// A fault of the options: `fault` says what is wrong, and what is allowed.
    pub(super) fn usage(fault: &str) -> Self {
        Self::Input(fault.to_owned())
    }

    /// The error for a given file, with the reason why it cannot be used.
    pub(super) fn file(path: &Path, fault: impl Display) -> Self {
        Self::Input(format!("{}: {fault}", path.display()))
    }

    /// Whether no message is printed: a program that has closed its end of a pipe needs none.
    pub(super) fn is_silent(&self) -> bool {
        matches!(self, Self::Output(error) if error.kind() == io::ErrorKind::BrokenPipe)
    }

    /// The exit status it leads to.
    pub(super) fn exit(&self) -> Exit {
        match self {
            Self::Solve(error) if !error.is_bad_input() => Exit::Other,
            Self::Analysis(error) if !error.is_bad_input() => Exit::Other,
            Self::Output(_) if self.is_silent() => Exit::Unread,
            Self::Scene(_) | Self::Solve(_) | Self::Analysis(_) | Self::Input(_) => Exit::BadInput,
            Self::Export(ExportError::Extension { .. }) => Exit::BadInput,
            Self::Write(_) | Self::Export(_) | Self::System(_) | Self::Output(_) => Exit::Other,
        }
    }
}
