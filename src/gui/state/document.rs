//! The scene being edited: its file, its history of edits, and whether anything is unsaved.

use crate::fidelity::Fidelity;
use crate::scene::{Scene, SceneError, presets, show_text};
use std::path::{Path, PathBuf};

/// Number of edits that can be undone.
const HISTORY: usize = 500;
/// Edits are solved up to this fidelity, unless the user chooses another.
const TARGET: Fidelity = Fidelity::Fine;

/// The scene to open next, or the end of the window; unsaved changes to the present scene would be lost.
#[derive(Clone, Debug, PartialEq)]
pub enum Next {
    /// A built-in preset.
    Preset(&'static str),
    /// A scene that is already loaded: from a file or a link, a motor made from answers, or the scene that the window is to open.
    Given(Box<Document>),
    /// The window closes.
    Quit,
}

/// Whether both scenes give the same solve: the same motor or plate, with the same numerics.
pub fn solved_alike(one: &Scene, other: &Scene) -> bool {
    one.same_model(other) && one.numerics() == other.numerics()
}

/// The absolute form of `path`, which means the same in any working folder.
pub fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

/// A scene and where it came from.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    scene: Scene,
    target: Fidelity,
    saved: Scene,
    path: Option<PathBuf>,
    /// Whether the scene is in no file and no preset: then it counts as unsaved even without edits.
    new: bool,
    undo: Vec<(Scene, Fidelity)>,
    redo: Vec<(Scene, Fidelity)>,
    /// The parameter that the pointer is dragging; its edits count as one.
    dragging: Option<&'static str>,
    /// Whether a lesson has set the scene up for the student to experiment with: it is never saved, and nothing is lost with it.
    pub practice: bool,
}

impl Default for Document {
    /// A motor with the default of every key.
    fn default() -> Self {
        Self::opened(Scene::motor(), None)
    }
}

impl Document {
    /// A scene as it was opened, from a file or built in.
    pub fn opened(scene: Scene, path: Option<PathBuf>) -> Self {
        let (saved, path) = (scene.clone(), path.as_deref().map(absolute));
        let (undo, redo) = (Vec::new(), Vec::new());
        Self { saved, scene, target: TARGET, path, new: false, undo, redo, dragging: None, practice: false }
    }

    /// A scene to experiment with: it never counts as unsaved.
    pub fn practice(scene: Scene) -> Self {
        Self { practice: true, ..Self::opened(scene, None) }
    }

    /// The same document, solved up to this fidelity.
    pub fn with_target(self, target: Fidelity) -> Self {
        Self { target, ..self }
    }

    /// A scene of the last window. It is unsaved if it differs from its file or preset, or if it is `new` and has neither.
    pub fn restored(scene: Scene, saved: Scene, path: Option<PathBuf>, new: bool) -> Self {
        Self { saved, new, ..Self::opened(scene, path) }
    }

    /// A scene that is in no file and no preset, so that it counts as unsaved.
    pub fn made(scene: Scene) -> Self {
        Self { new: true, ..Self::opened(scene, None) }
    }

    /// The document without its unsaved changes; a motor with defaults if it is in no file and no preset.
    pub fn discarded(&self) -> Self {
        let saved = if self.new { Scene::motor() } else { self.saved.clone() };
        Self::opened(saved, self.path.clone()).with_target(self.target)
    }

    /// The fundamental case.
    ///
    /// # Errors
    /// Never: the preset is built in and tested.
    pub fn fundamental() -> Result<Self, SceneError> {
        Ok(Self::opened(presets::find("fundamental")?, None))
    }

    /// The scene as edited.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The highest fidelity that edits are solved at. It is part of the history, not of the file.
    pub fn target(&self) -> Fidelity {
        self.target
    }

    /// The scene as it was opened, made or last saved.
    pub fn saved(&self) -> &Scene {
        &self.saved
    }

    /// The file, if it has one.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Whether the content of the file has changed since it was last read or saved here.
    pub fn is_changed_elsewhere(&self) -> bool {
        let other = |path: &Path| Scene::load(path).map_or(true, |scene| presets::disclaimed(scene) != self.saved);
        self.path().filter(|path| path.exists()).is_some_and(other)
    }

    /// Whether the scene is in no file and no preset.
    pub fn is_new(&self) -> bool {
        self.new
    }

    /// Whether there are unsaved changes.
    pub fn is_dirty(&self) -> bool {
        !self.practice && (self.new || self.scene != self.saved)
    }

    /// The name of the scene, and a dot if there are unsaved changes.
    pub fn title(&self) -> String {
        let mark = if self.is_dirty() { " •" } else { "" };
        format!("{}{mark}", show_text(&self.scene.title(&self.saved)))
    }

    /// The scene with a title and a description that name the changes since it was saved.
    pub fn titled(&self) -> Scene {
        let mut scene = self.scene.clone();
        scene.retitle(&self.saved);
        scene
    }

    /// Replaces the scene by an edited one. Edits of one `dragging` parameter are undone together.
    pub fn edit(&mut self, next: Scene, key: &'static str, dragging: bool) {
        if next != self.scene {
            if self.dragging != Some(key) {
                self.remember();
            }
            self.scene = next;
            self.redo.clear();
            self.dragging = dragging.then_some(key);
        } else if !dragging {
            self.dragging = None;
        }
    }

    /// Replaces the scene by that of a lesson's step; resetting a parameter gives its value in that scene.
    pub fn practise(&mut self, scene: Scene) {
        self.change(scene.clone(), self.target);
        self.saved = scene;
    }

    /// Whether a pointer holds a parameter.
    pub fn is_dragging(&self) -> bool {
        self.dragging.is_some()
    }

    /// The pointer has released the parameter that it dragged: the next edit is a new one.
    pub fn end_drag(&mut self) {
        self.dragging = None;
    }

    /// Replaces the scene and its highest fidelity, as one edit. Returns whether anything has changed.
    pub fn change(&mut self, next: Scene, target: Fidelity) -> bool {
        let changed = next != self.scene || target != self.target;
        if changed {
            self.remember();
            (self.scene, self.target) = (next, target);
            self.redo.clear();
        }
        self.dragging = None;
        changed
    }

    fn remember(&mut self) {
        self.undo.push((self.scene.clone(), self.target));
        if self.undo.len() > HISTORY {
            self.undo.remove(0);
        }
    }

    /// Undoes the last edit. Returns whether there was one.
    pub fn undo(&mut self) -> bool {
        self.dragging = None;
        let Some((scene, target)) = self.undo.pop() else { return false };
        // If the document has been saved under another name since, it is no longer the preset that it was made from. The older scene then
        // must not claim to be that preset either.
        let scene = if scene.about == self.saved.about { scene } else { presets::disclaimed(scene) };
        self.redo.push((std::mem::replace(&mut self.scene, scene), std::mem::replace(&mut self.target, target)));
        true
    }

    /// Redoes the edit that was undone last. Returns whether there was one.
    pub fn redo(&mut self) -> bool {
        std::mem::swap(&mut self.undo, &mut self.redo);
        let made = self.undo();
        std::mem::swap(&mut self.undo, &mut self.redo);
        made
    }

    /// Whether there is anything to undo.
    pub fn can_undo(&self) -> bool {
        !self.undo.is_empty()
    }

    /// Whether there is anything to redo.
    pub fn can_redo(&self) -> bool {
        !self.redo.is_empty()
    }

    /// Saves to `path`, by way of a temporary file that is renamed. A preset that was changed no longer keeps its name and description, and
    /// the new ones stay true when it is changed again.
    ///
    /// # Errors
    /// If the file cannot be written; nothing changes then.
    pub fn save(&mut self, path: &Path) -> Result<(), SceneError> {
        let mut scene = self.scene.clone();
        if self.path.is_none() && !self.new && scene.changed(&self.saved).next().is_some() {
            scene.made_from(&self.saved);
        }
        let scene = presets::disclaimed(scene);
        scene.save_instead_of(path, self.path())?;
        self.saved = scene.clone();
        self.scene = scene;
        self.path = Some(absolute(path));
        self.new = false;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_spacing(document: &Document, nanometres: &str) -> Scene {
        let mut scene = document.scene().clone();
        scene.set("film.min_spacing_nm", nanometres).unwrap();
        scene
    }

    #[test]
    fn a_file_is_known_to_hold_what_was_saved_until_something_else_is_there() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.toml");
        let table = folder.path().join("rotor.csv");
        std::fs::write(&table, "wavenumber_per_m,compliance_m2_per_n\n10,1e-9\n10000,1e-10\n").unwrap();
        let table = [("rotor.compliance_csv", table.to_str().unwrap())];
        let with_table = Document::fundamental().unwrap().scene().with(table).unwrap();
        let scenes = presets::BUILT_IN.iter().map(|built_in| built_in.scene().unwrap());
        for scene in scenes.chain([with_table]) {
            let mut document = Document::opened(scene, None);
            document.save(&path).unwrap();
            assert!(!document.is_changed_elsewhere(), "{}", document.scene().name);
            let read = Document::opened(presets::disclaimed(Scene::load(&path).unwrap()), Some(path.clone()));
            assert!(!read.is_changed_elsewhere(), "{}", document.scene().name);
        }
        let mut document = Document::fundamental().unwrap();
        document.save(&path).unwrap();
        std::fs::write(&path, "not a preset").unwrap();
        assert!(document.is_changed_elsewhere());
        with_spacing(&document, "300").save(&path).unwrap();
        assert!(document.is_changed_elsewhere());
        std::fs::remove_file(&path).unwrap();
        assert!(!document.is_changed_elsewhere());
    }

    #[test]
    fn one_drag_is_one_edit() {
        let mut document = Document::fundamental().unwrap();
        let original = document.scene().clone();
        for spacing in ["190", "180", "170"] {
            document.edit(with_spacing(&document, spacing), "film.min_spacing_nm", true);
        }
        document.edit(with_spacing(&document, "170"), "film.min_spacing_nm", false);
        document.edit(with_spacing(&document, "100"), "film.min_spacing_nm", false);
        assert!(document.is_dirty() && document.can_undo());
        assert!(document.undo());
        assert_eq!(document.scene(), &with_spacing(&document, "170"));
        assert!(document.undo());
        assert_eq!(document.scene(), &original);
        assert!(!document.undo() && !document.is_dirty());
        assert!(document.redo() && document.redo() && !document.redo());
        assert_eq!(document.scene(), &with_spacing(&document, "100"));
    }

    #[test]
    fn a_drag_that_ends_on_a_refused_value_is_ended() {
        let mut document = Document::fundamental().unwrap();
        document.edit(with_spacing(&document, "190"), "film.min_spacing_nm", true);
        document.end_drag();
        document.edit(with_spacing(&document, "150"), "film.min_spacing_nm", true);
        assert!(document.undo());
        assert_eq!(document.scene(), &with_spacing(&document, "190"));
    }

    #[test]
    fn what_it_is_solved_up_to_is_an_edit_but_not_saved() {
        let mut document = Document::fundamental().unwrap();
        assert!(document.change(document.scene().clone(), Fidelity::Draft));
        assert!(!document.change(document.scene().clone(), Fidelity::Draft));
        assert!(!document.is_dirty() && document.target() == Fidelity::Draft);
        assert!(document.undo() && document.target() == TARGET);
        assert!(document.redo() && document.target() == Fidelity::Draft);
    }

    #[test]
    fn saving_clears_the_mark_and_a_failed_save_changes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let mut document = Document::fundamental().unwrap();
        document.edit(with_spacing(&document, "90"), "film.min_spacing_nm", false);
        assert!(document.save(&folder.path().join("no/such/folder/a.toml")).is_err());
        assert!(document.is_dirty() && document.path().is_none());
        let path = folder.path().join("a.toml");
        document.save(&path).unwrap();
        assert!(!document.is_dirty());
        assert_eq!(&Scene::load(&path).unwrap(), document.scene());
    }

    #[test]
    fn comments_of_its_file_go_with_a_document_and_not_with_the_file_it_replaces() {
        let folder = tempfile::tempdir().unwrap();
        let [ours, theirs] = ["ours.toml", "theirs.toml"].map(|name| folder.path().join(name));
        for path in [&ours, &theirs] {
            let text = format!("# {}\n{}", path.display(), Scene::motor().to_toml());
            std::fs::write(path, text).unwrap();
        }
        let mut document = Document::opened(Scene::load(&ours).unwrap(), Some(ours.clone()));
        for (spacing, to) in [("90", &ours), ("80", &theirs)] {
            document.edit(with_spacing(&document, spacing), "film.min_spacing_nm", false);
            document.save(to).unwrap();
            let written = std::fs::read_to_string(to).unwrap();
            assert!(written.starts_with(&format!("# {}\nschema", ours.display())), "{written}");
            assert_eq!(&Scene::load(to).unwrap(), document.scene());
        }
    }

    #[test]
    fn what_was_made_is_unsaved_until_it_is_saved_and_reset_to_what_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let scene = with_spacing(&Document::fundamental().unwrap(), "90");
        let mut document = Document::made(scene.clone());
        assert!(document.is_dirty() && document.is_new() && document.saved() == &scene);
        document.edit(with_spacing(&document, "80"), "film.min_spacing_nm", false);
        assert!(document.undo() && document.is_dirty());
        let discarded = document.discarded();
        assert!(!discarded.is_dirty() && discarded.scene() == &Scene::motor());
        document.save(&folder.path().join("a.toml")).unwrap();
        assert!(!document.is_dirty() && !document.is_new());
        assert_eq!(document.discarded().scene(), document.scene());
    }

    #[test]
    fn a_changed_preset_is_saved_under_a_name_that_says_so() {
        let says_so = |scene: &Scene| {
            assert_eq!(scene.name, "Fundamental case, changed");
            assert_eq!(scene.about, "Made from Fundamental case.");
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.toml");
        let mut document = Document::fundamental().unwrap();
        for spacing in ["150", "140"] {
            document.edit(with_spacing(&document, spacing), "film.min_spacing_nm", false);
            document.save(&path).unwrap();
            says_so(document.scene());
            assert!(!document.is_dirty() && Scene::load(&path).unwrap() == *document.scene());
        }
        // A scene that was edited before it was saved is not the preset either; an unedited scene is.
        let mut document = Document::fundamental().unwrap();
        for spacing in ["150", "140"] {
            document.edit(with_spacing(&document, spacing), "film.min_spacing_nm", false);
        }
        document.save(&path).unwrap();
        assert!(document.undo());
        says_so(document.scene());
        assert!(document.undo());
        assert_eq!(document.scene(), &presets::find("fundamental").unwrap());
        // A copy of a preset, changed in its file or by hand, is no longer what its description claims.
        let copy = presets::find("fundamental").unwrap();
        let mut document = Document::opened(copy, Some(path.clone()));
        document.edit(with_spacing(&document, "150"), "film.min_spacing_nm", false);
        document.save(&path).unwrap();
        assert_eq!(document.scene().about, "Made from Fundamental case.");
        let text =
            presets::find("fundamental").unwrap().to_toml().replace("min_spacing_nm = 200", "min_spacing_nm = 100");
        std::fs::write(&path, text).unwrap();
        says_so(&presets::find(path.to_str().unwrap()).unwrap());
        // A changed preset that is changed once more is not "changed: 1 key, changed: 1 key".
        let mut again = with_spacing(&document, "130");
        again.retitle(document.scene());
        assert_eq!(again.name, "Fundamental case, changed again: 1 key");
        let mut third = with_spacing(&document, "120");
        third.name.clone_from(&again.name);
        third.retitle(&again);
        assert_eq!(third.name, "Fundamental case, changed again: 1 key");
        // A name of its own is kept.
        let mut document = Document::fundamental().unwrap();
        let mut named = with_spacing(&document, "150");
        named.name = "Mine".to_owned();
        document.edit(named, "name", false);
        document.save(&path).unwrap();
        assert_eq!(document.scene().name, "Mine");
    }

    #[test]
    fn a_title_tells_what_was_changed() {
        let mut document = Document::fundamental().unwrap();
        document.edit(with_spacing(&document, "80"), "film.min_spacing_nm", false);
        assert_eq!(document.titled().headline(), "Fundamental case, minimum spacing H_m 80 nm");
        assert!(document.undo());
        assert_eq!(&document.titled(), document.scene());
    }
}
