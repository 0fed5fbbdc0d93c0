//! Files that appear complete or not at all, and locks between processes.
//!
//! Files are first written into a scratch folder beside their targets, `.squeezefilm-….tmp`. They get their names only when all of them are
//! on the disk. If one of them cannot have its name, those before it are put back as they were. The writer holds a lock on the scratch
//! folder. A scratch folder whose lock nobody holds was left by a run that was killed, and the next run that writes there removes it.

use crate::platform::{HAS_FILES, hand_out};
use same_file::Handle;
use std::ffi::OsStr;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// How the names of scratch folders and locks begin.
const PREFIX: &str = ".squeezefilm-";
/// How the name of a scratch folder ends.
const SCRATCH: &str = ".tmp";
/// How the name of a lock ends.
const LOCK: &str = ".lock";

/// A folder or file that cannot be written.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be written: {source}", path.display())]
pub struct WriteError {
    /// The folder or file.
    pub path: PathBuf,
    /// The system's reason.
    pub source: io::Error,
}

/// Writes one file into a folder that exists. It is as readable as the file it replaces, or as the umask says.
///
/// # Errors
/// [`WriteError`]; then an older file of that name is as it was.
pub fn write_file(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), WriteError> {
    let failed = |source| WriteError { path: path.to_owned(), source };
    if !HAS_FILES {
        let mut content = Vec::new();
        let handed = write(&mut content).and_then(|()| hand_out(path, vec![(path.to_owned(), content)]));
        return handed.map_err(failed);
    }
    // What a link points to is replaced, not the link.
    let linked = path.is_symlink().then(|| fs::canonicalize(path).ok()).flatten();
    let (folder, name) = place(linked.as_deref().unwrap_or(path)).map_err(failed)?;
    let mut staged = Staged::within(folder, false).map_err(failed)?;
    staged.add(name, write)?;
    staged.commit().map(|_| ())
}

/// The folder of a file, which has to exist, and the file's name in it.
fn place(path: &Path) -> io::Result<(&Path, &OsStr)> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let name = path.file_name().ok_or(ErrorKind::InvalidFilename)?;
    if folder.is_dir() {
        Ok((folder, name))
    } else {
        Err(io::Error::new(ErrorKind::NotFound, format!("there is no folder {}", folder.display())))
    }
}

/// Checks whether [`write_file`] can write a file, before any work is done for it.
pub fn check_file(path: &Path) -> Result<(), WriteError> {
    let failed = |source| WriteError { path: path.to_owned(), source };
    let (folder, _) = place(path).map_err(failed)?;
    check_writable(folder).map_err(|WriteError { source, .. }| failed(source))
}

/// Checks whether files can be written into a folder, or the folder created, before any work is done for them.
pub fn check_writable(folder: &Path) -> Result<(), WriteError> {
    Staged::new(folder)?.add("check", |_| Ok(()))
}

/// As [`check_writable`], of the folder for all files of results: none of its folders may be in the way, with a name such as they have.
pub fn check_for_results(folder: &Path) -> Result<(), WriteError> {
    const KINDS: [&str; 11] = ["csv", "json", "svg", "png", "pdf", "npz", "toml", "html", "gif", "vtk", "series"];
    let in_the_way =
        |path: &PathBuf| path.extension().is_some_and(|of| KINDS.iter().any(|kind| of == *kind)) && path.is_dir();
    let mut entries = folder.read_dir().into_iter().flatten().flatten().map(|entry| entry.path());
    if let Some(path) = entries.find(in_the_way) {
        let why = "it is a folder, and a file of results may have this name: move it away, or give another folder";
        return Err(WriteError { path, source: io::Error::new(ErrorKind::IsADirectory, why) });
    }
    check_writable(folder)
}

/// Why a file is spared.
pub const INPUT: &str = "it is an input of this command, and would be replaced: give another folder";

/// Files staged for a folder. Dropped without [`Staged::commit`], it leaves nothing behind.
#[derive(Debug)]
pub struct Staged {
    folder: PathBuf,
    /// Whether the folder was created for these files. It is then removed if nothing is committed into it.
    made: bool,
    /// The final path of each file; the nth is the file `n` of the scratch folder.
    targets: Vec<PathBuf>,
    /// Their contents, where they are offered as downloads.
    contents: Vec<Vec<u8>>,
    /// Files that are not replaced.
    spared: Vec<PathBuf>,
    /// The scratch folder and its lock; `None` where files are offered as downloads. On drop the lock is released first.
    scratch: Option<(Lock, TempDir)>,
}

impl Staged {
    /// Begins to stage files for a folder. Creates it, and the folders above it, if they do not exist.
    pub fn new(folder: &Path) -> Result<Self, WriteError> {
        let failed = |source| WriteError { path: folder.to_owned(), source };
        if HAS_FILES && folder.exists() && !folder.is_dir() {
            return Err(failed(io::Error::new(ErrorKind::NotADirectory, "it is a file, not a folder")));
        }
        let made = !folder.exists();
        if HAS_FILES {
            fs::create_dir_all(folder).map_err(failed)?;
        }
        Self::within(folder, made).map_err(failed)
    }

    fn within(folder: &Path, made: bool) -> io::Result<Self> {
        let (targets, contents) = (Vec::new(), Vec::new());
        let mut staged = Self { folder: folder.to_owned(), made, targets, contents, spared: Vec::new(), scratch: None };
        if !HAS_FILES {
            return Ok(staged);
        }
        remove_leftovers(folder);
        while staged.scratch.is_none() {
            let scratch = tempfile::Builder::new().prefix(PREFIX).suffix(SCRATCH).tempdir_in(folder);
            let scratch = scratch.map_err(|error| without_path(&error))?;
            // Until it is locked, another run may take the folder for one that was left, and remove it: then it is created again.
            match Lock::take(&scratch.path().join(LOCK)) {
                Ok(lock) => staged.scratch = lock.map(|lock| (lock, scratch)),
                Err(error) if error.kind() == ErrorKind::NotFound && folder.exists() => {}
                Err(error) => return Err(error),
            }
        }
        Ok(staged)
    }

    /// Replaces none of these files, unless by one of the same content.
    pub fn spare(&mut self, spared: Vec<PathBuf>) {
        self.spared = spared;
    }

    /// The path in the scratch folder of the new content of a target, or of its older file.
    fn scratch(&self, index: usize, what: &str) -> PathBuf {
        let folder = self.scratch.as_ref().map(|(_, folder)| folder.path());
        folder.unwrap_or(Path::new("")).join(format!("{index}{what}"))
    }

    /// Writes a file into the scratch folder. A fault names its final path.
    pub fn add(
        &mut self,
        name: impl AsRef<Path>,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        let path = self.folder.join(name);
        let failed = |source| WriteError { path: path.clone(), source };
        replaceable(&path).map_err(failed)?;
        let new = self.scratch(self.targets.len(), NEW);
        let written = (|| {
            if !HAS_FILES {
                let mut content = Vec::new();
                write(&mut content)?;
                self.contents.push(content);
                return Ok(());
            }
            let mut buffered = BufWriter::new(File::create_new(new)?);
            write(&mut buffered)?;
            let file = buffered.into_inner().map_err(io::IntoInnerError::into_error)?;
            if let Ok(older) = fs::metadata(&path) {
                // Some file systems have no permissions.
                let _ = file.set_permissions(older.permissions());
            }
            // Some file systems report only now that the disk is full.
            file.sync_data()
        })();
        written.map_err(failed)?;
        self.targets.push(path);
        Ok(())
    }

    /// Gives every file its name, replacing older ones, and returns the paths.
    ///
    /// # Errors
    /// [`WriteError`] naming the file that could not have its name; then older files are as they were.
    pub fn commit(mut self) -> Result<Vec<PathBuf>, WriteError> {
        if !HAS_FILES {
            let files = self.targets.iter().cloned().zip(std::mem::take(&mut self.contents)).collect();
            hand_out(&self.folder, files).map_err(|source| WriteError { path: self.folder.clone(), source })?;
            return Ok(std::mem::take(&mut self.targets));
        }
        // A target may have become impossible to replace since it was staged.
        for (i, path) in self.targets.iter().enumerate() {
            let spared = || if self.spares(i) { Err(io::Error::new(ErrorKind::AlreadyExists, INPUT)) } else { Ok(()) };
            replaceable(path).and_then(|()| spared()).map_err(|source| WriteError { path: path.clone(), source })?;
        }
        for (i, path) in self.targets.iter().enumerate() {
            let replaced = set_aside(path, &self.scratch(i, OLD)).and_then(|()| fs::rename(self.scratch(i, NEW), path));
            if let Err(source) = replaced {
                (0..=i).rev().for_each(|i| self.put_back(i));
                return Err(WriteError { path: path.clone(), source });
            }
        }
        self.made = false;
        Ok(std::mem::take(&mut self.targets))
    }

    /// Whether a target would replace a file that is spared by another content.
    fn spares(&self, index: usize) -> bool {
        let target = &self.targets[index];
        let same = |other: &PathBuf| same_file::is_same_file(other, target).unwrap_or(false);
        self.spared.iter().any(same) && fs::read(target).ok() != fs::read(self.scratch(index, NEW)).ok()
    }

    /// Undoes what a commit has done to a target.
    fn put_back(&self, index: usize) {
        let (target, old) = (&self.targets[index], self.scratch(index, OLD));
        // A fault here is not reported: the caller gets the first one.
        let _ = if old.symlink_metadata().is_ok() {
            fs::rename(old, target)
        } else if self.scratch(index, NEW).exists() {
            Ok(())
        } else {
            fs::remove_file(target)
        };
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        self.scratch.take();
        if self.made {
            // This removes only an empty folder: files of others stay.
            let _ = fs::remove_dir(&self.folder);
        }
    }
}

/// The fault of a scratch folder without its path, which tells the user nothing.
fn without_path(error: &io::Error) -> io::Error {
    let told = error.to_string();
    let why = told.split_once(" at path ").map_or(told.as_str(), |(why, _)| why);
    io::Error::new(error.kind(), why)
}

const NEW: &str = ".new";
const OLD: &str = ".old";

/// Checks whether a file can get this name: there is none of this name yet, or one that can be replaced. A read-only file is not replaced, on
/// any system.
fn replaceable(path: &Path) -> io::Result<()> {
    if regular(path)?.is_some_and(|older| older.permissions().readonly()) {
        return Err(io::Error::new(ErrorKind::PermissionDenied, "it is read-only"));
    }
    if path.exists() { not_held(path) } else { Ok(()) }
}

/// Metadata of a file; `None` if there is nothing of this name. Fails for a folder, a device or a pipe, which would wait for its other end.
fn regular(path: &Path) -> io::Result<Option<fs::Metadata>> {
    match fs::metadata(path).ok() {
        Some(found) if found.is_dir() => Err(io::Error::new(ErrorKind::IsADirectory, "it is a folder")),
        Some(found) if !found.is_file() => Err(io::Error::new(ErrorKind::InvalidInput, "it is a device or a pipe")),
        found => Ok(found),
    }
}

/// Checks that no other program holds the file open in such a way that it cannot be replaced, as spreadsheets do on Windows.
#[cfg(windows)]
fn not_held(path: &Path) -> io::Result<()> {
    use std::os::windows::fs::OpenOptionsExt;
    const DELETE: u32 = 0x0001_0000;
    OpenOptions::new().access_mode(DELETE).open(path).map(|_| ())
}

/// On other systems a file that is open can be replaced.
#[cfg(not(windows))]
fn not_held(_: &Path) -> io::Result<()> {
    Ok(())
}

/// Keeps the file that is to be replaced under another name: by a hard link, so that its name is never missing, or else by renaming.
fn set_aside(path: &Path, old: &Path) -> io::Result<()> {
    match fs::hard_link(path, old).or_else(|_| fs::rename(path, old)) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Removes a file, if there is one.
pub fn remove_file(path: &Path) -> Result<(), WriteError> {
    match fs::remove_file(path) {
        Err(source) if source.kind() != ErrorKind::NotFound => Err(WriteError { path: path.to_owned(), source }),
        _ => Ok(()),
    }
}

/// Removes scratch folders and locks of runs that were killed.
fn remove_leftovers(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name.starts_with(PREFIX) && (name.ends_with(SCRATCH) || name.ends_with(LOCK)) {
            let path = entry.path();
            let lock = if path.is_dir() { path.join(LOCK) } else { path.clone() };
            // If it cannot be removed, it does no harm. The file of a lock is removed when the lock is dropped.
            if let Ok(Some(lock)) = Lock::take(&lock)
                && lock.held
            {
                drop(lock);
                if path.is_dir() {
                    let _ = fs::remove_dir_all(path);
                }
            }
        }
    }
}

/// A lock that one process at a time can hold. The system releases it when its process ends, in whatever way. On drop its file is removed.
#[derive(Debug)]
pub struct Lock {
    /// Keeps the file open, and with it the lock.
    _file: Handle,
    path: PathBuf,
    /// False on a file system without locks.
    held: bool,
}

impl Lock {
    /// The lock `name` of a folder, which has to exist; `None` while another process holds it.
    pub fn of(folder: &Path, name: &str) -> io::Result<Option<Self>> {
        Self::take(&folder.join(format!("{PREFIX}{name}{LOCK}")))
    }

    fn take(path: &Path) -> io::Result<Option<Self>> {
        loop {
            regular(path)?;
            let file = OpenOptions::new().write(true).create(true).truncate(false).open(path)?;
            let held = match file.try_lock() {
                Ok(()) => true,
                Err(TryLockError::WouldBlock) => return Ok(None),
                Err(TryLockError::Error(_)) => false,
            };
            let file = Handle::from_file(file)?;
            // The process that held the lock may have removed its file after it was opened here.
            if Handle::from_path(path).is_ok_and(|named| named == file) {
                return Ok(Some(Self { _file: file, path: path.to_owned(), held }));
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> =
            fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn all_files_appear_together_and_replace_older_ones() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("a"), "old").unwrap();
        let mut staged = Staged::new(folder.path()).unwrap();
        staged.add("a", |w| w.write_all(b"new")).unwrap();
        staged.add("b", |w| w.write_all(b"b")).unwrap();
        assert_eq!(fs::read_to_string(folder.path().join("a")).unwrap(), "old");
        staged.commit().unwrap();
        assert_eq!(names(folder.path()), ["a", "b"]);
        assert_eq!(fs::read_to_string(folder.path().join("a")).unwrap(), "new");
    }

    // Elsewhere a folder with an open file cannot be removed.
    #[cfg(unix)]
    #[test]
    fn a_folder_that_vanished_is_told() {
        let parent = tempfile::tempdir().unwrap();
        let folder = parent.path().join("out");
        let mut staged = Staged::new(&folder).unwrap();
        staged.add("a", |w| w.write_all(b"a")).unwrap();
        fs::remove_dir_all(&folder).unwrap();
        let error = staged.add("b", |w| w.write_all(b"b")).unwrap_err();
        assert!(error.to_string().contains("b: cannot be written: "), "{error}");
        let error = staged.commit().unwrap_err();
        assert!(error.to_string().contains("a: cannot be written: "), "{error}");
    }

    // Nobody can write there, not even root.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_folder_that_cannot_be_written_into_is_named_without_the_scratch_folder() {
        let folder = Path::new("/proc");
        for (error, named) in [
            (check_writable(folder), "/proc: cannot be written: "),
            (check_file(&folder.join("a.csv")), "/proc/a.csv: cannot be written: "),
        ] {
            let error = error.unwrap_err().to_string();
            assert!(error.starts_with(named) && !error.contains(PREFIX), "{error}");
        }
    }

    #[test]
    fn a_failure_leaves_nothing() {
        let parent = tempfile::tempdir().unwrap();
        let folder = parent.path().join("out");
        let mut staged = Staged::new(&folder).unwrap();
        staged.add("a", |w| w.write_all(b"a")).unwrap();
        let error = staged.add("b", |_| Err(io::Error::other("no"))).unwrap_err();
        assert!(error.to_string().contains("b: cannot be written: no"), "{error}");
        drop(staged);
        assert!(names(parent.path()).is_empty());
    }

    #[test]
    fn a_target_that_cannot_be_replaced_leaves_the_others_as_they_were() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::write(path("a"), "old").unwrap();
        let stage = |names: &[&str]| {
            let mut staged = Staged::new(folder.path()).unwrap();
            names.iter().for_each(|name| staged.add(name, |w| w.write_all(b"new")).unwrap());
            staged
        };
        // A folder, or a file that is read-only, is seen before anything is done.
        let staged = stage(&["a", "b", "c"]);
        fs::create_dir(path("c")).unwrap();
        let error = Staged::new(folder.path()).unwrap().add("c", |_| Ok(())).unwrap_err();
        assert!(error.to_string().contains("c: cannot be written: it is a folder"), "{error}");
        let error = staged.commit().unwrap_err();
        assert!(error.to_string().contains("c: cannot be written: it is a folder"), "{error}");
        let staged = stage(&["a", "b", "e"]);
        fs::write(path("e"), "mine").unwrap();
        let read_only = |is: bool| {
            let mut permissions = fs::metadata(path("e")).unwrap().permissions();
            permissions.set_readonly(is);
            fs::set_permissions(path("e"), permissions).unwrap();
        };
        read_only(true);
        let error = staged.commit().unwrap_err();
        assert!(error.to_string().ends_with("e: cannot be written: it is read-only"), "{error}");
        assert_eq!(fs::read_to_string(path("e")).unwrap(), "mine");
        read_only(false);
        fs::remove_file(path("e")).unwrap();
        assert_eq!(
            (names(folder.path()), fs::read_to_string(path("a")).unwrap()),
            (vec!["a".into(), "c".into()], "old".into())
        );
        // What fails half-way is undone, with a file that was replaced and with one that is new.
        let staged = stage(&["a", "b", "d"]);
        fs::remove_file(staged.scratch(2, NEW)).unwrap();
        let error = staged.commit().unwrap_err();
        assert!(error.to_string().contains("d: cannot be written: "), "{error}");
        assert_eq!(
            (names(folder.path()), fs::read_to_string(path("a")).unwrap()),
            (vec!["a".into(), "c".into()], "old".into())
        );
    }

    #[test]
    fn what_a_killed_run_left_is_removed_and_what_a_living_one_stages_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let mut living = Staged::new(folder.path()).unwrap();
        living.add("a", |w| w.write_all(b"a")).unwrap();
        // A scratch folder as a killed run leaves it: nobody has its lock.
        let left = folder.path().join(".squeezefilm-killed.tmp");
        fs::create_dir(&left).unwrap();
        fs::write(left.join(LOCK), "").unwrap();
        fs::write(left.join("0.new"), "half").unwrap();
        fs::write(folder.path().join(".squeezefilm-sweep.lock"), "").unwrap();
        fs::write(folder.path().join(".squeezefilm-notes"), "mine").unwrap();
        check_writable(folder.path()).unwrap();
        fs::create_dir(folder.path().join("series.csv")).unwrap();
        let error = check_for_results(folder.path()).unwrap_err().to_string();
        assert!(error.contains("series.csv: cannot be written: it is a folder"), "{error}");
        // One file beside it is another matter.
        check_file(&folder.path().join("other.csv")).unwrap();
        fs::remove_dir(folder.path().join("series.csv")).unwrap();
        assert_eq!(names(folder.path()).len(), 2, "{:?}", names(folder.path()));
        living.commit().unwrap();
        assert_eq!(names(folder.path()), [".squeezefilm-notes", "a"]);
    }

    #[test]
    fn one_at_a_time_has_a_lock() {
        let folder = tempfile::tempdir().unwrap();
        let lock = Lock::of(folder.path(), "sweep").unwrap();
        assert!(lock.is_some() && Lock::of(folder.path(), "sweep").unwrap().is_none());
        drop(lock);
        assert!(names(folder.path()).is_empty());
        assert!(Lock::of(folder.path(), "sweep").unwrap().is_some());
    }

    #[cfg(unix)]
    #[test]
    fn a_file_is_as_readable_as_the_one_it_replaces() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let mode = || fs::metadata(&path).unwrap().permissions().mode() & 0o777;
        let plain = folder.path().join("plain");
        fs::write(&plain, "").unwrap();
        write_file(&path, |w| w.write_all(b"a")).unwrap();
        assert_eq!(mode(), fs::metadata(&plain).unwrap().permissions().mode() & 0o777);
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        write_file(&path, |w| w.write_all(b"b")).unwrap();
        assert_eq!((mode(), fs::read_to_string(&path).unwrap().as_str()), (0o640, "b"));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link_and_a_pipe_stays_a_pipe() {
        let folder = tempfile::tempdir().unwrap();
        let [file, link, pipe, lock] = ["a", "b", "c.csv", ".squeezefilm-x.lock"].map(|name| folder.path().join(name));
        fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write_file(&link, |w| w.write_all(b"new")).unwrap();
        assert!(link.is_symlink() && fs::read_to_string(&file).unwrap() == "new");
        // A left lock that is a pipe would wait for ever, as this would if it opened one.
        assert!(std::process::Command::new("mkfifo").args([&pipe, &lock]).status().unwrap().success());
        assert!(Lock::of(folder.path(), "x").is_err());
        let error = write_file(&pipe, |_| Ok(())).unwrap_err().to_string();
        assert!(error.ends_with("c.csv: cannot be written: it is a device or a pipe"), "{error}");
    }
}
