//! Other programs that only Python reaches: a script that is asked line by
//! line, so that its work and ours can take turns.

use crate::{Failure, fail};
use lancer_tests::paths;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// A running script of xtask/peers. It ends with its input.
pub(super) struct Script {
    process: Child,
    /// Taken away to end it.
    asked: Option<ChildStdin>,
    said: BufReader<ChildStdout>,
    name: &'static str,
}

impl Script {
    /// Starts it, or tells why that cannot be and how to install what it needs:
    /// it says `ready` where all of that is there.
    pub(super) fn start(name: &'static str, folder: &Path, install: &str) -> Result<Self, String> {
        let python = std::env::var_os("LANCER_PYTHON").unwrap_or_else(|| "python3".into());
        let mut process = Command::new(&python)
            .arg(paths::top().join("xtask/peers").join(name))
            .arg(folder)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|e| format!("`{}` does not start: {e}", python.display()))?;
        let (Some(asked), Some(said)) = (process.stdin.take(), process.stdout.take()) else {
            return Err(format!("{name} cannot be talked to"));
        };
        let mut script = Self { process, asked: Some(asked), said: BufReader::new(said), name };
        match script.line() {
            Ok(line) if line == "ready" => Ok(script),
            Ok(line) => Err(format!("{line}; {install}")),
            Err(failure) => Err(format!("{failure}; {install}")),
        }
    }

    /// Asks something and waits for a line.
    pub(super) fn ask(&mut self, line: &str) -> Result<String, Failure> {
        let asked = self.asked.as_mut().ok_or_else(|| fail("it has ended"))?;
        writeln!(asked, "{line}").and_then(|()| asked.flush()).map_err(fail)?;
        self.line()
    }

    /// Asks for something that takes so many seconds.
    pub(super) fn seconds(&mut self, line: &str) -> Result<f64, Failure> {
        let answer = self.ask(line)?;
        answer.parse().map_err(|_| fail(format_args!("{}: {line}: {answer}", self.name)))
    }

    fn line(&mut self) -> Result<String, Failure> {
        let mut line = String::new();
        match self.said.read_line(&mut line).map_err(fail)? {
            0 => Err(fail(format_args!("{} ended early", self.name))),
            _ => Ok(line.trim().to_owned()),
        }
    }
}

impl Drop for Script {
    fn drop(&mut self) {
        self.asked = None;
        // Whether it ended well does not matter any more.
        let _ = self.process.wait();
    }
}
