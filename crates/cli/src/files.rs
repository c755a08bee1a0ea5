//! Reading and writing files so that nothing is lost.

use crate::Failure;
use crate::args::is_standard;
use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// The bytes of a file, or of standard input for `-`, and what to call it.
pub(crate) fn read(path: &Path) -> Result<(String, Vec<u8>), Failure> {
    if is_standard(path) {
        let mut bytes = Vec::new();
        io::stdin()
            .read_to_end(&mut bytes)
            .map_err(|e| Failure::work(format_args!("cannot read standard input: {e}")))?;
        return Ok(("<stdin>".to_owned(), bytes));
    }
    let name = path.display().to_string();
    let bytes =
        fs::read(path).map_err(|e| Failure::work(format_args!("cannot read {name}: {e}")))?;
    Ok((name, bytes))
}

/// The files that a scene speaks of: their names are relative to its own folder,
/// or for standard input to the present one.
pub(crate) struct BesideScene<'a>(pub(crate) &'a Path);

impl lancer_xml::Files for BesideScene<'_> {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        let folder = if is_standard(self.0) { Path::new(".") } else { folder_of(self.0) };
        let path = folder.join(path);
        let about = fs::metadata(&path).map_err(|e| bare(&e).to_string())?;
        if about.is_dir() {
            return Err("it is a folder".to_owned());
        }
        // A device or a pipe may have no end, or not begin.
        if !about.is_file() {
            return Err("it is no ordinary file".to_owned());
        }
        if about.len() > MOST_MESH_BYTES {
            return Err(format!("it has more than {MOST_MESH_BYTES} bytes"));
        }
        fs::read(&path).map_err(|e| bare(&e).to_string())
    }
}

/// A mesh file may have so many bytes.
const MOST_MESH_BYTES: u64 = 4 << 30;

/// Where a file will be written to, looked at before the work begins.
#[derive(Debug)]
pub(crate) struct Target {
    /// As the user wrote it.
    name: PathBuf,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    StandardOutput,
    /// Something that cannot be replaced: a device or a pipe.
    Special,
    /// A file, or the place for one, behind all links.
    File(PathBuf),
}

impl Target {
    /// Finds what can be known to be wrong now rather than after the work.
    pub(crate) fn new(path: &Path) -> Result<Self, Failure> {
        let name = path.to_owned();
        let kind = if is_standard(path) || path == Path::new("/dev/stdout") {
            Kind::StandardOutput
        } else {
            Self::look_at(path).map_err(|reason| {
                Failure::work(format_args!("cannot write {}: {reason}", path.display()))
            })?
        };
        Ok(Self { name, kind })
    }

    fn look_at(path: &Path) -> Result<Kind, String> {
        if path.as_os_str().as_encoded_bytes().ends_with(b"/") {
            return Err("that names a folder".to_owned());
        }
        // What these lead to may be a file, but is not ours to replace.
        if path.starts_with("/dev") || path.starts_with("/proc") {
            return Ok(Kind::Special);
        }
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => return Err("it is a folder".to_owned()),
            Ok(found) if !found.is_file() => return Ok(Kind::Special),
            Ok(found) if found.permissions().readonly() => {
                return Err("it is read-only".to_owned());
            }
            Ok(_) => {
                let real = fs::canonicalize(path).map_err(|e| e.to_string())?;
                return Self::try_out(real);
            }
            Err(e) if e.kind() != io::ErrorKind::NotFound => return Err(e.to_string()),
            Err(_) => {}
        }
        // A link to a file that is not there yet; chains of them end somewhere,
        // or `metadata` would have failed in another way.
        if let Ok(link) = fs::read_link(path) {
            return Self::look_at(&folder_of(path).join(link));
        }
        match fs::metadata(folder_of(path)) {
            Ok(folder) if folder.is_dir() => Self::try_out(path.to_owned()),
            _ => Err(format!("there is no folder {}", folder_of(path).display())),
        }
    }

    /// Whether the folder takes a temporary file.
    fn try_out(path: PathBuf) -> Result<Kind, String> {
        match tempfile::tempfile_in(folder_of(&path)) {
            Ok(_) => Ok(Kind::File(path)),
            Err(e) => Err(format!(
                "its folder {} takes no file: {}",
                folder_of(&path).display(),
                bare(&e)
            )),
        }
    }

    pub(crate) fn is_standard_output(&self) -> bool {
        matches!(self.kind, Kind::StandardOutput)
    }

    /// Whether writing would replace that file.
    pub(crate) fn replaces(&self, file: &Path) -> bool {
        match &self.kind {
            Kind::File(own) => {
                let real = |path: &Path| fs::canonicalize(path).ok();
                real(own).is_some_and(|own| real(file) == Some(own))
            }
            _ => false,
        }
    }

    /// Whether both are the same file, be it there already or not.
    pub(crate) fn same_as(&self, other: &Self) -> bool {
        match (&self.kind, &other.kind) {
            (Kind::StandardOutput, Kind::StandardOutput) => true,
            (Kind::File(a), Kind::File(b)) => {
                let place = |path: &Path| {
                    Some((fs::canonicalize(folder_of(path)).ok()?, path.file_name()?.to_owned()))
                };
                place(a).is_some_and(|a| place(b) == Some(a))
            }
            _ => false,
        }
    }

    /// Writes all of `bytes` or leaves what was there: to a temporary file in
    /// the same folder, which then takes the other's place.
    pub(crate) fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        self.try_write(bytes).map_err(|e| {
            let name = match self.kind {
                Kind::StandardOutput => "to standard output".to_owned(),
                _ => self.name.display().to_string(),
            };
            Failure::work(format_args!("cannot write {name}: {}", bare(&e)))
        })
    }

    fn try_write(&self, bytes: &[u8]) -> io::Result<()> {
        let path = match &self.kind {
            Kind::StandardOutput => {
                let mut out = io::stdout().lock();
                out.write_all(bytes)?;
                return out.flush();
            }
            Kind::Special => {
                return fs::OpenOptions::new().append(true).open(&self.name)?.write_all(bytes);
            }
            Kind::File(path) => path,
        };
        let mut builder = tempfile::Builder::new();
        builder.prefix(".lancer-").suffix(".tmp");
        // As an ordinary new file has them; the temporary one would be private.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut file = builder.tempfile_in(folder_of(path))?;
        file.write_all(bytes)?;
        if let Ok(old) = fs::metadata(path) {
            file.as_file().set_permissions(old.permissions())?;
        }
        file.persist(path)?;
        Ok(())
    }
}

/// The system's own words, without the name of a temporary file.
fn bare(error: &io::Error) -> io::Error {
    let system = error.raw_os_error().or_else(|| {
        let inner = error.get_ref()?.source()?.downcast_ref::<io::Error>()?;
        inner.raw_os_error()
    });
    system.map_or_else(
        || io::Error::new(error.kind(), error.to_string()),
        io::Error::from_raw_os_error,
    )
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}
