//! What the tests of the language share.
#![allow(dead_code, reason = "each test uses some of it")]

use lancer_scene::Scene;
use lancer_xml::{Files, Options, Parsed, Severity};
use std::cell::RefCell;
use std::collections::HashMap;

pub(crate) const CAMERA: &str = r#"<camera pxwidth="4" pxheight="3" width="1">
  <origin x="0" y="0" z="0"/><target x="1" y="0" z="0"/>
</camera>"#;
pub(crate) const LIGHTS: &str =
    r#"<lights><sun brightness="1"><point x="0" y="0" z="-1"/></sun></lights>"#;
pub(crate) const BALL: &str = r#"<sphere color="red" size="1"><point x="1" y="2" z="3"/></sphere>"#;

/// A scene of these shapes, with `before` among the children of `<world>`.
pub(crate) fn text(before: &str, shapes: &str) -> String {
    format!("<world>{CAMERA}{LIGHTS}{before}<shapes>{shapes}</shapes></world>")
}

/// Files in memory, and how often each was read.
#[derive(Default)]
pub(crate) struct Memory {
    pub(crate) files: HashMap<&'static str, &'static [u8]>,
    pub(crate) reads: RefCell<Vec<String>>,
}

impl Files for Memory {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        self.reads.borrow_mut().push(path.to_owned());
        let file = self.files.get(path).map(|bytes| bytes.to_vec());
        file.ok_or_else(|| "there is no such file".to_owned())
    }
}

pub(crate) fn parse(text: &str) -> Parsed {
    lancer_xml::parse(text.as_bytes(), &Options::default())
}

/// The scene of a text in which nothing at all is wrong.
pub(crate) fn scene(text: &str) -> Scene {
    let parsed = parse(text);
    assert!(parsed.diagnostics.is_empty(), "{text}: {:?}", parsed.diagnostics);
    parsed.scene.expect("there is a scene where no diagnostic is an error")
}

/// The lines of the dump of a valid scene behind those of camera and sun.
pub(crate) fn dump(before: &str, shapes: &str) -> String {
    let dump = scene(&text(before, shapes)).to_string();
    let lines: Vec<_> = dump.lines().skip(2).collect();
    lines.join("\n")
}

/// All messages about a text, warnings with a mark.
pub(crate) fn messages(text: &str) -> Vec<String> {
    messages_of(&parse(text))
}

pub(crate) fn messages_of(parsed: &Parsed) -> Vec<String> {
    let mark = |severity| if severity == Severity::Warning { "warning: " } else { "" };
    parsed.diagnostics.iter().map(|d| format!("{}{}", mark(d.severity), d.message)).collect()
}
