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

/// A file's name without its extension.
#[must_use]
pub fn stem(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}
