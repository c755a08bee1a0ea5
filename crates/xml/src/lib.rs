//! The scene language: XML text to a [`Scene`](lancer_scene::Scene) or a list
//! of diagnostics, each with its place, what was expected and what to do.
//!
//! All mistakes of a file are found in one go, up to the first that leaves the
//! XML without form (a tag that is not closed, say), because nothing after that
//! could be trusted. This crate opens no file and prints nothing: meshes come
//! from whoever implements [`Files`].
//!
//! ```
//! let text = r#"<world>
//!   <camera pxwidth="40" pxheight="30" width="3.3">
//!     <origin x="1" y="0" z="3"/> <target x="4" y="5" z="2"/>
//!   </camera>
//!   <lights><lamp brightness="1.5"><point x="5" y="5" z="4"/></lamp></lights>
//!   <shapes>
//!     <sphere color="grey" glos="1" size="-1"><point x="6" y="11" z="1"/></sphere>
//!   </shapes>
//! </world>"#;
//! let parsed = lancer_xml::parse(text.as_bytes(), &lancer_xml::Options::default());
//! let messages: Vec<_> = parsed.diagnostics.iter().map(|d| d.message.as_str()).collect();
//! assert_eq!(
//!     messages,
//!     [
//!         "unknown attribute `glos` of <sphere>",
//!         "`size` of <sphere> is -1",
//!     ]
//! );
//! assert_eq!(parsed.diagnostics[0].help.as_deref(), Some("did you mean `gloss`?"));
//! assert_eq!(parsed.source.location(parsed.diagnostics[1].span.start), (7, 41));
//! assert!(parsed.scene.is_none());
//!
//! let mended = text.replace("glos=", "gloss=").replace("-1", "1");
//! let scene = lancer_xml::parse(mended.as_bytes(), &lancer_xml::Options::default())
//!     .into_result()?;
//! assert_eq!(scene.shapes.len(), 1);
//! # Ok::<(), lancer_xml::InvalidFile>(())
//! ```
#![forbid(unsafe_code)]

mod colour;
mod diagnostic;
mod document;
mod element;
mod files;
mod number;
mod parse;
mod places;
pub mod schema;
mod source;
mod suggest;
mod values;
mod world;

pub use diagnostic::{Diagnostic, Severity};
pub use document::{DEEPEST, MOST_ATTRIBUTES, MOST_NODES};
pub use files::{Files, NoFiles};
pub use parse::{InvalidFile, MAX_PIXELS, Options, Parsed, parse, parse_with};
pub use places::Places;
pub use source::Source;
