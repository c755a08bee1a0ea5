//! Running a program that may hang, in a folder that is gone afterwards.

use super::{Peer, PeerError};
use crate::interrupt;
use lancer_export::Exported;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// How often a program is looked after.
const LOOK: Duration = Duration::from_millis(3);

/// The most that is kept of what a program says.
const MOST_SAID: usize = 2000;

/// A folder with an exported scene in it.
pub(super) struct Folder(tempfile::TempDir);

impl Folder {
    /// Writes the scene as `name`, and the files that it names.
    pub(super) fn with(peer: &Peer, exported: &Exported, name: &str) -> Result<Self, PeerError> {
        let prefix = tempfile::Builder::new().prefix("lancer-peer-").tempdir();
        let folder = Self(prefix.map_err(|e| peer.failed(e))?);
        let write = |name: &str, bytes: &[u8]| {
            fs::write(folder.path(name), bytes).map_err(|e| peer.failed(e))
        };
        write(name, exported.text.as_bytes())?;
        for file in &exported.files {
            write(&file.name, &file.bytes)?;
        }
        Ok(folder)
    }

    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Runs a command in it to its end, for so long at most. The seconds that it took, and what it
    /// said on both channels.
    pub(super) fn run(
        &self,
        peer: &Peer,
        command: &mut Command,
        timeout: Duration,
    ) -> Result<(f64, String), PeerError> {
        let said = self.path("said");
        let out = File::create(&said).map_err(|e| peer.failed(e))?;
        let err = out.try_clone().map_err(|e| peer.failed(e))?;
        command.current_dir(self.0.path()).stdin(Stdio::null()).stdout(out).stderr(err);
        let begun = Instant::now();
        let child =
            command.spawn().map_err(|e| peer.failed(format_args!("does not start: {e}")))?;
        let mut running = Running(child);
        let status = loop {
            if let Some(status) = running.0.try_wait().map_err(|e| peer.failed(e))? {
                break status;
            }
            if interrupt::happened() {
                return Err(PeerError::Interrupted);
            }
            if begun.elapsed() > timeout {
                let seconds = timeout.as_secs_f64();
                return Err(PeerError::TimedOut { name: peer.version().to_owned(), seconds });
            }
            std::thread::sleep(LOOK);
        };
        let seconds = begun.elapsed().as_secs_f64();
        let said = read(&said);
        if status.success() {
            return Ok((seconds, said));
        }
        let lines: Vec<&str> = said.lines().filter(|line| !line.trim().is_empty()).collect();
        let last = lines[lines.len().saturating_sub(5)..].join("; ");
        Err(peer.failed(format_args!("{status}: {last}")))
    }
}

/// A process that does not outlive this.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // Both fail where it has ended.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// The end of what a program has said.
fn read(path: &Path) -> String {
    let said = fs::read(path).unwrap_or_default();
    let start = said.len().saturating_sub(MOST_SAID);
    // It shows how far it is by carriage returns.
    String::from_utf8_lossy(&said[start..]).replace('\r', "\n")
}
