//! POV-Ray 3.7.

use super::child::Folder;
use super::{Peer, PeerError, PeerPicture, Setting};
use lancer_export::{Exported, Format};
use lancer_film::Size;
use std::fs;
use std::num::NonZeroUsize;
use std::process::{Command, Stdio};
use std::time::Duration;

const REMEDY: &str = "on Debian: apt-get install povray";

pub(super) fn find() -> Result<Peer, PeerError> {
    let missing = |why: String| PeerError::Missing { program: "povray", why, remedy: REMEDY };
    let output = Command::new("povray").arg("--version").stdin(Stdio::null()).output();
    let output = output.map_err(|e| missing(e.to_string()))?;
    let said = [output.stdout, output.stderr].concat();
    let said = String::from_utf8_lossy(&said);
    let version = said.lines().find(|line| line.starts_with("POV-Ray "));
    let version = version.ok_or_else(|| missing("it does not say its version".to_owned()))?;
    Ok(Peer {
        format: Format::PovRay,
        command: "povray".into(),
        version: version.trim().to_owned(),
    })
}

pub(super) fn render(
    peer: &Peer,
    exported: &Exported,
    size: Size,
    threads: NonZeroUsize,
    setting: Setting,
    timeout: Duration,
) -> Result<PeerPicture, PeerError> {
    let folder = Folder::with(peer, exported, "scene.pov")?;
    let mut command = Command::new(&peer.command);
    command.args(["+Iscene.pov", "+Opicture.png", "-D", "+FN16", "File_Gamma=1.0"]).args([
        format!("+W{}", size.width),
        format!("+H{}", size.height),
        format!("+WT{threads}"),
    ]);
    match setting {
        Setting::Antialiased { threshold, method, depth } => {
            command.args([
                format!("+A{threshold:?}"),
                format!("+AM{method}"),
                format!("+R{depth}"),
            ]);
            command.arg("-J");
        }
        Setting::Centres | Setting::Samples { .. } => {
            command.arg("-A");
        }
    }
    let (process_seconds, said) = folder.run(peer, &mut command, timeout)?;
    let seconds = trace_seconds(&said).ok_or_else(|| peer.failed("it says no trace time"))?;
    let bytes = fs::read(folder.path("picture.png")).map_err(|e| peer.failed(e))?;
    let picture = lancer_output::decode(&bytes).map_err(|e| peer.failed(e))?;
    if (picture.width, picture.height) != (size.width, size.height) {
        return Err(peer.failed("its picture has another size"));
    }
    let pixel = |index| {
        let [r, g, b, _] = picture.levels(index).map(|level| (level / 255.0) as f32);
        [r, g, b]
    };
    Ok(PeerPicture {
        seconds,
        process_seconds,
        width: size.width,
        height: size.height,
        linear: (0..size.pixels() as usize).map(pixel).collect(),
    })
}

/// The last trace time that it says.
fn trace_seconds(said: &str) -> Option<f64> {
    let line = said.lines().rfind(|line| line.trim_start().starts_with("Trace Time:"))?;
    line.split_once('(')?.1.split_once(" seconds")?.0.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trace_times_are_read() {
        let said = "  Photon Time:      No photons\n\
            \x20 Trace Time:       0 hours  0 minutes  3 seconds (3.046 seconds)\n\
            \x20             using 2 thread(s) with 5.990 CPU-seconds total\n";
        assert_eq!(trace_seconds(said), Some(3.046));
        assert_eq!(trace_seconds("Fatal error"), None);
    }
}
