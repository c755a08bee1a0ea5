//! Meshes from the files that a scene names.

use super::{Out, one_line};
use crate::Diagnostic;
use crate::element::{Reader, shorten};
use crate::files::Files;
use lancer_mesh::{MeshFormat, Place, load};
use lancer_scene::Mesh;
use std::collections::HashMap;
use std::sync::Arc;

/// The meshes that have been read; each is read once, and shared.
pub(super) struct Meshes<'a, 'f> {
    files: &'f dyn Files,
    read: HashMap<Key<'a>, Option<Arc<Mesh>>>,
}

#[derive(PartialEq, Eq, Hash)]
struct Key<'a> {
    file: &'a str,
    part: Option<&'a str>,
    smooth: bool,
}

impl<'a, 'f> Meshes<'a, 'f> {
    pub(super) fn new(files: &'f dyn Files) -> Self {
        Self { files, read: HashMap::new() }
    }

    /// The mesh that an element names. What is wrong with it is said at the
    /// first element that does so.
    pub(super) fn mesh(&mut self, reader: &Reader<'a, '_>, out: Out<'_>) -> Option<Arc<Mesh>> {
        let words = [("flat", false), ("smooth", true)];
        let smooth = reader.keyword("normals", &words, out);
        let file = reader.given_name("file", out)?;
        let part = reader.text("part");
        let key = Key { file, part, smooth: smooth.unwrap_or(false) };
        if let Some(mesh) = self.read.get(&key) {
            return mesh.clone();
        }
        let mesh = self.load(reader, &key, out).map(|mesh| {
            let mesh = if key.smooth { mesh.with_smooth_normals() } else { mesh.without_normals() };
            Arc::new(mesh)
        });
        self.read.insert(key, mesh.clone());
        mesh
    }

    fn load(&self, reader: &Reader<'_, '_>, key: &Key<'_>, out: Out<'_>) -> Option<Mesh> {
        let file = shorten(key.file);
        let Some(format) = MeshFormat::from_name(key.file) else {
            out.push(
                Diagnostic::error(
                    reader.span_of("file"),
                    format!("`{file}` is no kind of mesh that is known"),
                    "expected a name that ends in `.obj`, `.ply` or `.stl`",
                )
                .help("save the mesh as OBJ, PLY or STL".to_owned()),
            );
            return None;
        };
        let bytes = match self.files.read(key.file) {
            Ok(bytes) => bytes,
            Err(reason) => {
                out.push(
                    Diagnostic::error(
                        reader.span_of("file"),
                        format!("the mesh `{file}` cannot be read"),
                        one_line(&reason, 200),
                    )
                    .help("its name is relative to the folder of the scene's file".to_owned()),
                );
                return None;
            }
        };
        match load(&bytes, format, key.part) {
            Ok(mesh) => {
                let dropped = mesh.dropped();
                if dropped > 0 {
                    let (triangles, are, label) = match dropped {
                        1 => ("triangle", "is", "it has no area"),
                        _ => ("triangles", "are", "they have no area"),
                    };
                    out.push(Diagnostic::warning(
                        reader.span_of("file"),
                        format!("{dropped} {triangles} of `{file}` {are} left out"),
                        label,
                    ));
                }
                Some(mesh)
            }
            Err(error) => {
                let place = match error.place {
                    Place::File => String::new(),
                    place => format!(", {place}"),
                };
                // The file is fine without what is said of its parts.
                let about_part = key.part.is_some() && error.place == Place::File;
                let (attribute, label) = match about_part && !bytes.is_empty() {
                    true => ("part", "this part cannot be used"),
                    false => ("file", "this mesh cannot be used"),
                };
                out.push(
                    Diagnostic::error(
                        reader.span_of(attribute),
                        format!("{file}{place}: {}", one_line(&error.message, 200)),
                        label,
                    )
                    .help(error.help.as_deref().map(|help| one_line(help, 1000))),
                );
                None
            }
        }
    }
}
