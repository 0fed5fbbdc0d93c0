//! The file in which a window keeps what the next one begins with. Each window that is open at the same time has its own, so
//! that none replaces what another one wrote; it is replaced as a whole; and what cannot be read is kept before it is replaced.

use crate::atomic::{WriteError, write_file};
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// Most windows that can have files of their own at the same time.
const MOST: usize = 64;
/// The key under which a window stores whether it holds unsaved work, `true` or `false`.
pub const UNSAVED: &str = "unsaved";

/// Begins the message that nothing is kept, before the reason.
pub const NOT_KEPT: &str = "What you change is not kept for the next start of the window";

/// Where a window keeps its state.
#[derive(Clone, Debug)]
pub enum StoragePlace {
    /// In the browser, by eframe.
    Browser,
    /// In this file.
    File(PathBuf),
    /// Nowhere, because that is impossible.
    Nowhere,
}

/// What a window keeps, by name.
pub type Entries = BTreeMap<String, String>;

/// The file of this window. No other window uses it until this value is dropped.
#[derive(Debug)]
pub struct StorageFile {
    /// Where it is.
    pub path: PathBuf,
    /// The lock. The system releases it when the process ends, in whatever way.
    _lock: File,
}

impl StorageFile {
    /// Of the files in `folder` that no window uses, chooses the one that was written last: it has the state of the window that was closed,
    /// or crashed, last. Files with unsaved work come first, so that work lost in a crash is not hidden by a window that was closed later.
    /// If all files are in use, creates a new one as a copy of the one that was written last, without its unsaved work: that is in the
    /// window that is open.
    ///
    /// # Errors
    /// If the folder cannot be made, or no file can be locked.
    pub fn claim(folder: &Path) -> io::Result<Self> {
        fs::create_dir_all(folder)?;
        let name = |number| if number == 1 { "app.json".to_owned() } else { format!("app-{number}.json") };
        let mut paths: Vec<PathBuf> = (1..=MOST).map(|number| folder.join(name(number))).collect();
        paths.sort_by_key(|path| Reverse(path.metadata().and_then(|of| of.modified()).ok()));
        let last = paths.iter().find(|path| path.is_file()).cloned();
        paths.sort_by_cached_key(|path| !holds_unsaved(path));
        for path in paths {
            // Anything other than a file, such as a pipe, would block.
            if [&path, &path.with_extension("lock")].iter().any(|path| path.exists() && !path.is_file()) {
                continue;
            }
            let lock = File::options().create(true).append(true).open(path.with_extension("lock"))?;
            match lock.try_lock() {
                Ok(()) => {
                    if let (false, Some(last)) = (path.exists(), last) {
                        copy_saved(&last, &path)?;
                    }
                    return Ok(Self { path, _lock: lock });
                }
                Err(fs::TryLockError::WouldBlock) => {}
                Err(fs::TryLockError::Error(error)) => return Err(error),
            }
        }
        Err(io::Error::other(format!("{MOST} windows are open")))
    }
}

/// Copies the file at `from` to `to`, without its unsaved work if it can be read.
fn copy_saved(from: &Path, to: &Path) -> io::Result<()> {
    let Ok(Some(mut entries)) = read(from) else { return fs::copy(from, to).map(drop) };
    if entries.get(UNSAVED).is_some_and(|unsaved| unsaved == "true") {
        // A new scene is nowhere else.
        let saved = entries.get("saved").filter(|_| entries.get("new").is_none_or(|new| new != "true")).cloned();
        entries.remove("scene");
        entries.extend(saved.map(|saved| ("scene".to_owned(), saved)));
        entries.extend([("new".to_owned(), "false".to_owned()), (UNSAVED.to_owned(), "false".to_owned())]);
    }
    write(to, &entries).map_err(io::Error::other)
}

/// Where eframe keeps the size and place of the window whose file is at `path`.
pub fn beside(path: &Path) -> PathBuf {
    path.with_extension("ron")
}

/// Whether the file at `path` says that it holds unsaved work.
fn holds_unsaved(path: &Path) -> bool {
    read(path).ok().flatten().is_some_and(|entries| entries.get(UNSAVED).is_some_and(|unsaved| unsaved == "true"))
}

/// Replaces the file at `path`, as a whole or not at all.
///
/// # Errors
/// If it cannot be written.
pub fn write(path: &Path, entries: &Entries) -> Result<(), WriteError> {
    write_file(path, |file| Ok(serde_json::to_writer_pretty(file, entries)?))
}

/// What [`write()`] wrote; `None` if there is no file.
///
/// # Errors
/// Why it cannot be read.
pub fn read(path: &Path) -> Result<Option<Entries>, String> {
    if !path.is_file() {
        return Ok(None);
    }
    let text = fs::read(path).map_err(|error| error.to_string())?;
    serde_json::from_slice(&text)
        .map(Some)
        .map_err(|_| "this file was not written by a window of this version".to_owned())
}

/// Copies the file at `path` to a free name beside it, and returns that name; `None` if there is no such file.
///
/// # Errors
/// If it cannot be copied.
pub fn keep(path: &Path) -> io::Result<Option<PathBuf>> {
    if !path.is_file() {
        return Ok(None);
    }
    let free = (1..).map(|number| path.with_extension(format!("unreadable-{number}.json"))).find(|copy| !copy.exists());
    if let Some(copy) = &free {
        let kept = fs::read(path)?;
        write_file(copy, |file| file.write_all(&kept)).map_err(io::Error::other)?;
    }
    Ok(free)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_window_has_its_own_file_and_a_new_one_begins_with_that_of_the_first() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("app.json"), "first").unwrap();
        let one = StorageFile::claim(folder.path()).unwrap();
        let other = StorageFile::claim(folder.path()).unwrap();
        assert_eq!(one.path, folder.path().join("app.json"));
        assert_ne!(one.path, other.path);
        assert_eq!(fs::read_to_string(&other.path).unwrap(), "first");
        drop(one);
        assert_eq!(StorageFile::claim(folder.path()).unwrap().path, folder.path().join("app.json"));
        // The state of the second window, which is closed by now, comes first.
        let left = File::options().append(true).open(&other.path).unwrap();
        left.set_modified(std::time::SystemTime::now() + std::time::Duration::from_secs(10)).unwrap();
        let second = other.path.clone();
        drop(other);
        assert_eq!(StorageFile::claim(folder.path()).unwrap().path, second);
    }

    #[test]
    fn unsaved_work_comes_before_what_was_written_later() {
        let folder = tempfile::tempdir().unwrap();
        let place = |name: &str| folder.path().join(name);
        let entry = |unsaved: bool| format!("{{\n    \"theme\": \"dark\",\n    \"{UNSAVED}\": \"{unsaved}\"\n}}");
        let write = |name: &str, text: &str, age: u64| {
            fs::write(place(name), text).unwrap();
            let at = std::time::SystemTime::now() - std::time::Duration::from_secs(age);
            File::options().append(true).open(place(name)).unwrap().set_modified(at).unwrap();
        };
        write("app.json", &entry(true), 30);
        write("app-2.json", &entry(true), 20);
        write("app-3.json", &entry(false), 10);
        write("app-4.json", "{\"scene\": \"# \\\"unsaved\\\": \\\"true\\\"\"}", 0);
        let claimed: Vec<StorageFile> = (0..5).map(|_| StorageFile::claim(folder.path()).unwrap()).collect();
        let names = ["app-2.json", "app.json", "app-4.json", "app-3.json", "app-5.json"];
        assert_eq!(claimed.iter().map(|file| file.path.clone()).collect::<Vec<_>>(), names.map(place));
        // A new file begins with the state that was written last.
        assert_eq!(read(&place("app-5.json")).unwrap(), read(&place("app-4.json")).unwrap());
    }

    #[test]
    fn a_second_window_begins_without_the_unsaved_work_of_the_first() {
        let of = |entries: &[(&str, &str)]| -> Entries {
            entries.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned())).collect()
        };
        for (new, second) in [
            ("false", of(&[("scene", "on disk"), ("saved", "on disk"), ("new", "false"), (UNSAVED, "false")])),
            ("true", of(&[("saved", "on disk"), ("new", "false"), (UNSAVED, "false")])),
        ] {
            let folder = tempfile::tempdir().unwrap();
            let one = StorageFile::claim(folder.path()).unwrap();
            let first = of(&[("scene", "edited"), ("saved", "on disk"), ("new", new), (UNSAVED, "true")]);
            write(&one.path, &first).unwrap();
            let other = StorageFile::claim(folder.path()).unwrap();
            assert_eq!(read(&other.path), Ok(Some(second)));
            assert_eq!(read(&one.path), Ok(Some(first)));
        }
    }

    #[test]
    fn what_is_no_file_is_passed_over() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("app.json")).unwrap();
        fs::create_dir(folder.path().join("app-2.lock")).unwrap();
        assert_eq!(StorageFile::claim(folder.path()).unwrap().path, folder.path().join("app-3.json"));
    }

    #[test]
    fn what_cannot_be_written_leaves_what_was_there() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("app.json");
        assert_eq!(read(&path), Ok(None));
        let entries: Entries = [("scene".to_owned(), "\"a\"\n".to_owned())].into();
        write(&path, &entries).unwrap();
        assert_eq!(read(&path), Ok(Some(entries)));
        fs::write(&path, "{\"scene\": \"cut sho").unwrap();
        assert!(read(&path).is_err());
        fs::remove_file(&path).unwrap();
        fs::create_dir_all(path.join("in the way")).unwrap();
        assert!(write(&path, &Entries::new()).is_err());
    }

    #[test]
    fn what_is_kept_replaces_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("app.json");
        assert_eq!(keep(&path).unwrap(), None);
        fs::write(&path, "one").unwrap();
        let first = keep(&path).unwrap().unwrap();
        fs::write(&path, "two").unwrap();
        let second = keep(&path).unwrap().unwrap();
        assert_eq!([first, second].map(|copy| fs::read_to_string(copy).unwrap()), ["one", "two"]);
    }
}
