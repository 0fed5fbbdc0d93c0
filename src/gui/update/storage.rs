//! The file in which a window keeps what the next one begins with. Each window that is open at the same time has its own, so
//! that none replaces what another one wrote; and what cannot be read is kept before it is replaced.

use std::cmp::Reverse;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// So many windows at once have files of their own.
const MOST: usize = 64;
/// What a window says of itself under this key: whether it holds unsaved work, `true` or `false`.
pub const UNSAVED: &str = "unsaved";

/// The file of this window: no other has it until this is dropped.
#[derive(Debug)]
pub struct StorageFile {
    /// Where it is.
    pub path: PathBuf,
    /// Locked. The system unlocks it at the end of the process, however that comes.
    _lock: File,
}

impl StorageFile {
    /// Of the files in `folder` that no window has, the one that was written last: there is what a window left that crashed or was closed last.
    /// Those with unsaved work come before the others, so that it is not hidden by a window that was closed after a crash. If all are taken, a
    /// new one, which begins as a copy of the one that was written last.
    ///
    /// # Errors
    /// If the folder cannot be made, or no file can be locked.
    pub fn claim(folder: &Path) -> io::Result<Self> {
        fs::create_dir_all(folder)?;
        let name = |number| if number == 1 { "app.ron".to_owned() } else { format!("app-{number}.ron") };
        let mut paths: Vec<PathBuf> = (1..=MOST).map(|number| folder.join(name(number))).collect();
        paths.sort_by_key(|path| Reverse(path.metadata().and_then(|of| of.modified()).ok()));
        let last = paths.iter().find(|path| path.is_file()).cloned();
        paths.sort_by_cached_key(|path| !holds_unsaved(path));
        for path in paths {
            // What is no file, such as a pipe, would block.
            if [&path, &path.with_extension("lock")].iter().any(|path| path.exists() && !path.is_file()) {
                continue;
            }
            let lock = File::options().create(true).append(true).open(path.with_extension("lock"))?;
            match lock.try_lock() {
                Ok(()) => {
                    if let (false, Some(last)) = (path.exists(), last) {
                        fs::copy(last, &path)?;
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

/// Whether the file at `path` says that it holds unsaved work. Quotes within its texts are escaped: none of them looks like an entry.
fn holds_unsaved(path: &Path) -> bool {
    let text = if path.is_file() { fs::read_to_string(path).unwrap_or_default() } else { String::new() };
    let said = text.split_once(&format!("\"{UNSAVED}\":"));
    said.is_some_and(|(_, said)| said.trim_start().starts_with("\"true\""))
}

/// Copies the file at `path` beside it, under a name that is free, and returns that; nothing if there is no such file.
///
/// # Errors
/// If it cannot be copied.
pub fn keep(path: &Path) -> io::Result<Option<PathBuf>> {
    if !path.is_file() {
        return Ok(None);
    }
    let free = (1..).map(|number| path.with_extension(format!("unreadable-{number}.ron"))).find(|copy| !copy.exists());
    if let Some(copy) = &free {
        fs::copy(path, copy)?;
    }
    Ok(free)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_window_has_its_own_file_and_a_new_one_begins_with_that_of_the_first() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("app.ron"), "first").unwrap();
        let one = StorageFile::claim(folder.path()).unwrap();
        let other = StorageFile::claim(folder.path()).unwrap();
        assert_eq!(one.path, folder.path().join("app.ron"));
        assert_ne!(one.path, other.path);
        assert_eq!(fs::read_to_string(&other.path).unwrap(), "first");
        drop(one);
        assert_eq!(StorageFile::claim(folder.path()).unwrap().path, folder.path().join("app.ron"));
        // What the second one left last is there first, though its window is gone.
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
        let entry = |unsaved: bool| format!("{{\n    \"theme\": \"dark\",\n    \"{UNSAVED}\": \"{unsaved}\",\n}}");
        let write = |name: &str, text: &str, age: u64| {
            fs::write(place(name), text).unwrap();
            let at = std::time::SystemTime::now() - std::time::Duration::from_secs(age);
            File::options().append(true).open(place(name)).unwrap().set_modified(at).unwrap();
        };
        write("app.ron", &entry(true), 30);
        write("app-2.ron", &entry(true), 20);
        write("app-3.ron", &entry(false), 10);
        write("app-4.ron", "{\"scene\": \"# \\\"unsaved\\\": \\\"true\\\"\"}", 0);
        let claimed: Vec<StorageFile> = (0..5).map(|_| StorageFile::claim(folder.path()).unwrap()).collect();
        let names = ["app-2.ron", "app.ron", "app-4.ron", "app-3.ron", "app-5.ron"];
        assert_eq!(claimed.iter().map(|file| file.path.clone()).collect::<Vec<_>>(), names.map(place));
        // A new one begins with what was written last.
        assert_eq!(fs::read(place("app-5.ron")).unwrap(), fs::read(place("app-4.ron")).unwrap());
    }

    #[test]
    fn what_is_no_file_is_passed_over() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("app.ron")).unwrap();
        fs::create_dir(folder.path().join("app-2.lock")).unwrap();
        assert_eq!(StorageFile::claim(folder.path()).unwrap().path, folder.path().join("app-3.ron"));
    }

    #[test]
    fn what_is_kept_replaces_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("app.ron");
        assert_eq!(keep(&path).unwrap(), None);
        fs::write(&path, "one").unwrap();
        let first = keep(&path).unwrap().unwrap();
        fs::write(&path, "two").unwrap();
        let second = keep(&path).unwrap().unwrap();
        assert_eq!([first, second].map(|copy| fs::read_to_string(copy).unwrap()), ["one", "two"]);
    }
}
