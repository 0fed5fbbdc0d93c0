//! Work that is sent to where it is done: to a thread as it is, to a worker of a page as bytes.

use crate::control::Cancel;
use crate::problem::Problem;
use crate::scene::{Scene, SceneError};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize, Serializer};

/// A background job with all its data, so that it can be sent to a thread or a web worker.
pub trait Work: Serialize + DeserializeOwned + Send + 'static {
    /// Its name, by which a worker knows it.
    const NAME: &'static str;
    /// Most messages that wait to be taken. A thread that is further ahead waits; a worker does not.
    const AHEAD: Option<usize> = None;
    /// A message on the way.
    type Message: Serialize + DeserializeOwned + Send + 'static;
    /// The result.
    type Output: Serialize + DeserializeOwned + Send + 'static;

    /// Does the work. It checks `cancel`, and sends messages through `tell`. `None` if it was cancelled before it found anything.
    fn run(self, cancel: &Cancel, tell: &(dyn Fn(Self::Message) + Sync)) -> Result<Option<Self::Output>, String>;
}

/// What comes from where a work is done.
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum Sent<M, R> {
    Message(M),
    /// After it nothing comes.
    End(Result<Option<R>, String>),
}

/// Called after every message of a task with `false`, and at its end with `true`; in a process, from the thread of the task.
pub trait Wake: Fn(bool) + Send + Sync + 'static {}

impl<F: Fn(bool) + Send + Sync + 'static> Wake for F {}

/// Messages and result of a task since the last call of `drain`.
#[derive(Debug)]
pub struct News<M, R> {
    /// Messages, in order.
    pub messages: Vec<M>,
    /// The result of the work, none if it was cancelled, or why it failed; `None` while more may come.
    pub end: Option<Result<Option<R>, String>>,
}

/// A scene and the problem that it poses. As bytes it is the scene's file.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "Scene")]
pub struct Posed {
    /// The scene, in the units of the field.
    pub scene: Scene,
    /// The problem that the scene poses, checked and in SI units.
    pub problem: Problem,
}

impl Serialize for Posed {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.scene.serialize(to)
    }
}

impl TryFrom<Scene> for Posed {
    type Error = SceneError;

    fn try_from(scene: Scene) -> Result<Self, SceneError> {
        Ok(Self { problem: Problem::try_from(&scene)?, scene })
    }
}

/// Does `work` on a thread pool of its own, one thread for each core, so that an export or another task need not wait until it is done.
pub fn pooled<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    match rayon::ThreadPoolBuilder::new().build() {
        Ok(pool) => pool.install(work),
        Err(_) => work(),
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::analysis::sensitivity::{Sensitivity, Uncertainties, Uncertainty};
    use crate::analysis::sweep::Sweep;
    use crate::analysis::tradeoff::candidates;
    use crate::fidelity::Fidelity;
    use crate::job::SolvedScene;
    use crate::job::single::{FaceWork, PinWork, TorqueWork};
    use crate::job::sweep::SweepWork;
    use crate::scene::presets;
    use crate::solution::Stats;
    use crate::solve::{Settings, solve};
    use std::sync::Arc;

    /// A value after a round trip through bytes.
    pub(in crate::job) fn carried<T: Serialize + DeserializeOwned>(what: &T) -> T {
        postcard::from_bytes(&postcard::to_stdvec(what).unwrap()).unwrap()
    }

    pub(in crate::job) fn draft() -> Settings {
        Settings { fidelity: Fidelity::Draft, ..Settings::default() }
    }

    pub(in crate::job) fn posed(preset: &str) -> Posed {
        Posed::try_from(presets::find(preset).unwrap()).unwrap()
    }

    /// NaN does not equal itself: therefore the printed forms are compared.
    fn same<T: std::fmt::Debug>(one: &T, other: &T) {
        assert_eq!(format!("{one:?}"), format!("{other:?}"));
    }

    #[test]
    fn scenes_and_solutions_are_carried_to_the_last_bit() {
        for preset in ["fundamental", "ring-rotor", "asperities", "levitating", "plate-crossover"] {
            let posed = posed(preset);
            same(&carried(&posed), &posed);
            let solution = solve(&posed.problem, &draft(), &mut (), &Cancel::new()).unwrap();
            same(&carried(&solution), &solution);
            same(&carried(&candidates(&posed.problem)), &candidates(&posed.problem));
        }
        let counted = Stats { unsettled_steps: 3, ..Stats::default() };
        assert_eq!(carried(&counted), counted);
    }

    #[test]
    fn what_is_done_elsewhere_comes_to_the_same() {
        fn both<W: Work>(work: W) {
            let there: W = carried(&work);
            let found = |work: W| work.run(&Cancel::new(), &|told| drop(carried(&told)));
            let (here, there) = (found(work), found(there));
            assert_eq!(
                postcard::to_stdvec(&carried(&here)).unwrap(),
                postcard::to_stdvec(&there).unwrap(),
                "{}",
                W::NAME
            );
        }
        let posed = posed("fundamental");
        let solution = solve(&posed.problem, &draft(), &mut (), &Cancel::new()).unwrap();
        let timed = (solution, 0.5);
        let run = SolvedScene::of(1, posed.clone(), Fidelity::Draft, timed, Vec::new());
        both(TorqueWork(Arc::new(run)));
        both(PinWork(posed.scene.clone(), Fidelity::Draft));
        let face = tempfile::NamedTempFile::new().unwrap();
        let row = |y: usize| (0..20).map(|x| format!("{}", (x * y + x * x) % 7)).collect::<Vec<_>>().join(",");
        let heights = (0..20).map(row).collect::<Vec<_>>().join("\n");
        std::fs::write(&face, format!("# dx_um = 0.5\n# dy_um = 0.5\n# height = nm\n{heights}\n")).unwrap();
        both(FaceWork::new(face.path().to_owned()));
        both(SweepWork::New(posed.scene.clone(), vec!["film.min_spacing_nm=100:300:3".parse().unwrap()], draft()));
    }

    #[test]
    fn random_scenes_of_sensitivities_that_were_carried_are_the_same() {
        let scene = presets::find("fundamental").unwrap();
        let none = |_: usize| ();
        let found =
            Sensitivity::of(&scene, &["film.min_spacing_nm"], &draft(), &Cancel::new(), &none).unwrap().unwrap();
        let uncertain: Uncertainty = "10%".parse().unwrap();
        let uncertainties = Uncertainties::new(&scene, &[("film.min_spacing_nm", uncertain)]).unwrap();
        let there = carried(&found);
        same(&there.columns, &found.columns);
        let draw = |of: &Sensitivity, by: &Uncertainties| of.monte_carlo(by, 5, 1, &Cancel::new(), &|| ()).unwrap();
        same(&draw(&there, &carried(&uncertainties)), &draw(&found, &uncertainties));
    }

    #[test]
    fn a_sweep_that_goes_on_elsewhere_is_the_same() {
        let scene = presets::find("plate-crossover").unwrap();
        let sweep = Sweep::new(&scene, &["plate.amplitude_um=0.1:0.5:5".parse().unwrap()], &draft()).unwrap();
        let there = carried(&sweep);
        assert_eq!(there.fingerprint(), sweep.fingerprint());
        let rows = sweep.run(&[], &Cancel::new(), &|_| ());
        assert_eq!(there.run(&carried(&rows[..2].to_vec()), &Cancel::new(), &|_| ()), rows);
    }
}
