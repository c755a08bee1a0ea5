//! Where things are in the repository.

use std::path::{Path, PathBuf};

/// The top of the repository.
#[must_use]
pub fn top() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// The scenes that people read.
#[must_use]
pub fn scenes() -> PathBuf {
    top().join("scenes")
}

/// The golden pictures.
#[must_use]
pub fn goldens() -> PathBuf {
    top().join("tests/goldens")
}

/// Files with that extension in a folder, sorted by name.
///
/// # Panics
/// Where the folder cannot be read.
#[must_use]
pub fn files_with_extension(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder)
        .unwrap_or_else(|e| panic!("cannot read the folder {}: {e}", folder.display()));
    let mut files: Vec<_> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.is_file() && path.extension().is_some_and(|e| e == extension))
        .collect();
    files.sort();
    files
}

/// Files with that extension in a folder and in those inside it, sorted.
///
/// # Panics
/// Where a folder cannot be read.
#[must_use]
pub fn all_with_extension(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut files = files_with_extension(folder, extension);
    let entries = std::fs::read_dir(folder)
        .unwrap_or_else(|e| panic!("cannot read the folder {}: {e}", folder.display()));
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())).filter(|path| path.is_dir()) {
        files.extend(all_with_extension(&path, extension));
    }
    files.sort();
    files
}

/// A file's path below `folder` without its extension.
#[must_use]
pub fn name_of(file: &Path, folder: &Path) -> String {
    let name = file.strip_prefix(folder).unwrap_or(file).with_extension("");
    name.to_string_lossy().replace('\\', "/")
}

/// A file's name without its extension.
#[must_use]
pub fn stem(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

/// The files in a folder, for the meshes of scenes there.
pub struct Beside<'a>(pub &'a Path);

impl lancer_xml::Files for Beside<'_> {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        // The system's words differ between systems.
        std::fs::read(self.0.join(path)).map_err(|e| match e.kind() {
            std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
            _ => "it cannot be read".to_owned(),
        })
    }
}
