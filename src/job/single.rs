//! Work that sends nothing on the way: torque over speed, a rotor by itself, a scene to be compared with others, a motor from its data
//! sheet, and a measured face.

use super::SolvedScene;
use super::work::{Posed, Work};
use crate::analysis::compare::{ComparedRun, runs};
use crate::analysis::data_sheet::agreeing;
use crate::analysis::rotor::RotorCurves;
use crate::analysis::torque::TorqueCurves;
use crate::control::Cancel;
use crate::fidelity::Fidelity;
use crate::input::{read_bytes, text};
use crate::platform::handed_over;
use crate::problem::Scenario;
use crate::scene::Scene;
use crate::scene::heights::LARGEST;
use crate::scene::new_motor::Answers;
use crate::solve::Settings;
use crate::surface::height_map::HeightMap;
use crate::surface::texture::{Texture, measured};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::sync::Arc;

/// Torque over speed of this run.
#[derive(Debug, Serialize, Deserialize)]
pub struct TorqueWork(pub Arc<SolvedScene>);

impl Work for TorqueWork {
    const NAME: &'static str = "torque";
    type Message = ();
    type Output = TorqueCurves;

    fn run(self, cancel: &Cancel, _: &(dyn Fn(()) + Sync)) -> Result<Option<Self::Output>, String> {
        let SolvedScene { problem, fidelity, solution, .. } = &*self.0;
        TorqueCurves::of(problem, *fidelity, solution, cancel).map_err(|error| format!("without film, {error}"))
    }
}

/// The rotor of this motor.
#[derive(Debug, Serialize, Deserialize)]
pub struct RotorWork(pub Posed);

impl Work for RotorWork {
    const NAME: &'static str = "rotor";
    type Message = ();
    type Output = RotorCurves;

    fn run(self, cancel: &Cancel, _: &(dyn Fn(()) + Sync)) -> Result<Option<Self::Output>, String> {
        let Scenario::Motor(motor) = &self.0.problem.scenario else { return Ok(None) };
        RotorCurves::of(motor, cancel).map_err(|error| error.to_string())
    }
}

/// A scene to be compared with others, and the fidelity that it is solved at.
#[derive(Debug, Serialize, Deserialize)]
pub struct PinWork(pub Scene, pub Fidelity);

impl Work for PinWork {
    const NAME: &'static str = "pin";
    type Message = ();
    type Output = ComparedRun;

    fn run(self, cancel: &Cancel, _: &(dyn Fn(()) + Sync)) -> Result<Option<Self::Output>, String> {
        let settings = Settings { fidelity: self.1, ..Settings::default() };
        // Every scene is solved by this method, and a run that was cancelled has nobody who waits for it.
        let solved = runs(&[self.0], &settings, cancel, &|_| ()).ok().filter(|_| !cancel.is_cancelled());
        Ok(solved.and_then(|runs| runs.into_iter().next()))
    }
}

/// A motor from the answers about its data sheet: a few solves find its friction and its amplitude.
#[derive(Debug, Serialize, Deserialize)]
pub struct NewMotorWork(pub Answers);

impl Work for NewMotorWork {
    const NAME: &'static str = "new-motor";
    type Message = ();
    type Output = Scene;

    fn run(self, cancel: &Cancel, _: &(dyn Fn(()) + Sync)) -> Result<Option<Self::Output>, String> {
        agreeing(&self.0, cancel).map(|motor| Some(motor.scene))
    }
}

/// A measured face: a file of heights, which is read, and its roughness. In a page its content goes with it, because a worker has no files.
#[derive(Debug, Serialize, Deserialize)]
pub struct FaceWork {
    path: PathBuf,
    bytes: Option<Vec<u8>>,
}

impl FaceWork {
    /// The file at this path.
    pub fn new(path: PathBuf) -> Self {
        Self { bytes: handed_over(&path), path }
    }
}

impl Work for FaceWork {
    const NAME: &'static str = "face";
    type Message = ();
    /// The heights after levelling, with roughness and summits.
    type Output = (HeightMap, Texture);

    fn run(self, _: &Cancel, _: &(dyn Fn(()) + Sync)) -> Result<Option<Self::Output>, String> {
        let Self { path, bytes } = self;
        let bytes = bytes.map_or_else(|| read_bytes(&path, LARGEST), Ok);
        let found = bytes.and_then(text).map_err(|error| error.to_string());
        let found = found.and_then(|text| measured(&text, 1).map_err(|error| error.to_string()));
        found.map(Some).map_err(|reason| format!("{}: {reason}", path.display()))
    }
}
