//! Several files into one folder, all or nothing as far as a file system allows: every file is first written in full
//! under a temporary name in that folder, and only when all are there are they renamed.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// A folder or file that cannot be written.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be written: {source}", path.display())]
pub struct WriteError {
    /// The folder or file.
    pub path: PathBuf,
    /// The system's reason.
    pub source: io::Error,
}

/// Writes one file, first in full under a temporary name beside it. The folder has to be there.
///
/// # Errors
/// [`WriteError`]; then an older file of that name is as it was.
pub fn write_file(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), WriteError> {
    let failed = |source| WriteError { path: path.to_owned(), source };
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let file = stage(folder, write).map_err(failed)?;
    file.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
}

/// Files staged for a folder. Dropped without [`Staged::commit`], it leaves nothing behind.
#[derive(Debug)]
pub struct Staged {
    folder: PathBuf,
    /// The folder was made by us: it goes if nothing is committed into it.
    made: bool,
    files: Vec<(PathBuf, NamedTempFile)>,
}

impl Staged {
    /// Begins; makes the folder, and those above it, if they are not there.
    ///
    /// # Errors
    /// [`WriteError`] if it cannot be made, or is a file.
    pub fn new(folder: &Path) -> Result<Self, WriteError> {
        let made = !folder.exists();
        fs::create_dir_all(folder).map_err(|source| WriteError { path: folder.to_owned(), source })?;
        Ok(Self { folder: folder.to_owned(), made, files: Vec::new() })
    }

    /// Writes a file under a temporary name.
    ///
    /// # Errors
    /// [`WriteError`] with the file's final path.
    pub fn add(&mut self, name: &str, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), WriteError> {
        let path = self.folder.join(name);
        match stage(&self.folder, write) {
            Ok(file) => {
                self.files.push((path, file));
                Ok(())
            }
            Err(source) => Err(WriteError { path, source }),
        }
    }

    /// Gives every file its name, replacing older ones, and returns the paths.
    ///
    /// # Errors
    /// [`WriteError`] naming the file that could not be renamed; those before it are in place.
    pub fn commit(mut self) -> Result<Vec<PathBuf>, WriteError> {
        // Some disks tell only now that they are full: before any file has its name.
        for (path, file) in &self.files {
            file.as_file().sync_data().map_err(|source| WriteError { path: path.clone(), source })?;
        }
        let mut paths = Vec::new();
        for (path, file) in std::mem::take(&mut self.files) {
            file.persist(&path).map_err(|error| WriteError { path: path.clone(), source: error.error })?;
            self.made = false;
            paths.push(path);
        }
        Ok(paths)
    }
}

fn stage(folder: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".squeezefilm-").suffix(".tmp");
    // A temporary file is private by default; a result is as readable as the umask says.
    #[cfg(unix)]
    let builder = {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666))
    };
    let file = builder.tempfile_in(folder)?;
    let mut buffered = BufWriter::new(file);
    write(&mut buffered)?;
    buffered.into_inner().map_err(io::IntoInnerError::into_error)
}

impl Drop for Staged {
    fn drop(&mut self) {
        self.files.clear();
        if self.made {
            // Only an empty folder is removed: what others put there stays.
            let _ = fs::remove_dir(&self.folder);
        }
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
}
