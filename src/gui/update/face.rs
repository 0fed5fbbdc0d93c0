//! Carries out the commands of measured faces.

use super::updater::Updater;
use crate::gui::state::view::Tab;
use crate::job::face::FaceWork;
use crate::scene::Kind;
use std::path::PathBuf;
use std::time::Duration;

impl Updater {
    pub(super) fn load_face(&mut self, path: PathBuf) {
        if self.state.document.scene().kind() == Kind::Plate {
            return self
                .state
                .fail("These are measured heights, and only a motor has rough faces: open a motor first.");
        }
        self.state.view.tab = Tab::Rotor;
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if let Some(task) = self.start_work("The heights cannot be read", FaceWork::new(path), Duration::ZERO) {
            self.state.face.begin(name, task);
        }
    }

    /// Gives the scene the roughness of two faces like this one: those of its keys that follow from it.
    pub(super) fn take_roughness(&mut self) {
        let Some(face) = self.state.face.found.as_ref() else { return };
        let values = face.roughness(self.state.document.scene());
        self.take_values(values);
    }
}
