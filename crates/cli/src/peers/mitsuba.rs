//! Mitsuba 3, by a Python that has it.

use super::child::Folder;
use super::{Peer, PeerError, PeerPicture, Setting};
use lancer_export::{Exported, Format};
use lancer_film::Size;
use std::fs;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::Duration;

const REMEDY: &str =
    "pip install mitsuba numpy, and name that Python by LANCER_PYTHON where it is not python3";

/// Renders once unseen, which compiles, and once more.
const RUNNER: &str = include_str!("mitsuba.py");

pub(super) fn find() -> Result<Peer, PeerError> {
    let command: PathBuf =
        std::env::var_os("LANCER_PYTHON").map_or_else(|| "python3".into(), PathBuf::from);
    let missing = |why: String| PeerError::Missing { program: "Mitsuba", why, remedy: REMEDY };
    let output = Command::new(&command)
        .args(["-c", "import mitsuba, numpy; print('Mitsuba', mitsuba.__version__)"])
        .stdin(Stdio::null())
        .output()
        .map_err(|e| missing(format!("{}: {e}", command.display())))?;
    let said = String::from_utf8_lossy(&output.stdout);
    let version = said.lines().find(|line| line.starts_with("Mitsuba "));
    let Some(version) = version else {
        let err = String::from_utf8_lossy(&output.stderr);
        return Err(missing(err.lines().next_back().unwrap_or("it says nothing").to_owned()));
    };
    Ok(Peer { format: Format::Mitsuba, version: version.trim().to_owned(), command })
}

pub(super) fn render(
    peer: &Peer,
    exported: &Exported,
    size: Size,
    threads: NonZeroUsize,
    setting: Setting,
    timeout: Duration,
) -> Result<PeerPicture, PeerError> {
    let (count, seed) = match setting {
        Setting::Samples { count, seed } => (count, seed),
        Setting::Centres | Setting::Antialiased { .. } => (1, 0),
    };
    let folder = Folder::with(peer, exported, "scene.xml")?;
    let numbers = [size.width, size.height, count, seed].map(|number| number.to_string());
    let mut command = Command::new(&peer.command);
    command.args(["-c", RUNNER, "scene.xml", "picture"]).args(numbers).arg(threads.to_string());
    let (process_seconds, said) = folder.run(peer, &mut command, timeout)?;
    let line = said.lines().find_map(|line| line.strip_prefix("seconds "));
    let seconds = line.and_then(|seconds| seconds.trim().parse().ok());
    let seconds = seconds.ok_or_else(|| peer.failed("it says no time"))?;
    let bytes = fs::read(folder.path("picture")).map_err(|e| peer.failed(e))?;
    if bytes.len() as u64 != size.pixels() * 12 {
        return Err(peer.failed("its picture has another size"));
    }
    let value = |bytes: &[u8]| bytes.try_into().map_or(0.0, f32::from_le_bytes);
    let pixel = |bytes: &[u8]| [0, 4, 8].map(|at| value(&bytes[at..at + 4]));
    Ok(PeerPicture {
        seconds,
        process_seconds,
        width: size.width,
        height: size.height,
        linear: bytes.chunks_exact(12).map(pixel).collect(),
    })
}
