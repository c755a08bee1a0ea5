//! Mesh files to triangles: OBJ, PLY (as text and binary) and STL (as text and
//! binary), or an error with its place in the file.
//!
//! This crate is given bytes; it opens no file. What a file claims about its own
//! size is not believed: memory is taken for what has been read. Coordinates
//! that are text are rounded once, to double precision.
//!
//! ```
//! use lancer_mesh::{MeshFormat, load};
//!
//! let obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n\
//!             g base\nf 1 3 2\n\
//!             g sides\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
//! let format = MeshFormat::from_name("pyramid.OBJ").expect("a known extension");
//! let pyramid = load(obj, format, None)?;
//! assert!(pyramid.is_closed());
//! assert_eq!(load(obj, format, Some("sides"))?.triangle_count(), 3);
//!
//! let mistake = load(b"v 0 0 zero\n", format, None).unwrap_err();
//! assert_eq!(mistake.to_string(), "line 1, column 7: expected a finite number, found `zero`");
//! # Ok::<(), lancer_mesh::MeshFileError>(())
//! ```
#![forbid(unsafe_code)]

mod error;
mod obj;
mod ply;
mod stl;
mod words;

pub use error::{MeshFileError, Place};

use lancer_math::{Vector, unit};
use lancer_scene::{Mesh, MeshError};

/// A kind of mesh file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshFormat {
    /// Wavefront OBJ.
    Obj,
    /// Stanford polygons, as text or binary.
    Ply,
    /// Stereolithography, as text or binary.
    Stl,
}

impl MeshFormat {
    /// All formats, with their extensions.
    pub const ALL: &[(Self, &'static str)] =
        &[(Self::Obj, "obj"), (Self::Ply, "ply"), (Self::Stl, "stl")];

    /// The format that the extension of a file's name says, in capitals or not.
    #[must_use]
    pub fn from_name(file_name: &str) -> Option<Self> {
        let (stem, extension) = file_name.rsplit_once('.')?;
        let named = Self::ALL.iter().find(|(_, name)| extension.eq_ignore_ascii_case(name));
        // A file that is called ".obj" has no extension.
        named
            .filter(|_| !stem.is_empty() && !stem.ends_with(['/', '\\']))
            .map(|(format, _)| *format)
    }
}

/// The mesh in a file of that format, or of an OBJ file one part: the faces in
/// a material (`usemtl`) of that name if there is one, else in the groups (`g`) and
/// objects (`o`) of that name.
///
/// Faces with more than three corners are cut into triangles that share the
/// first corner, which suits convex ones. Normals of vertices are kept where the
/// file has them; an STL file has none, and its vertices at the same place
/// become one. Materials and texture coordinates are ignored.
///
/// # Errors
/// Where the file is not what the format asks for, has no triangle with an area,
/// or has no such part.
pub fn load(bytes: &[u8], format: MeshFormat, part: Option<&str>) -> Result<Mesh, MeshFileError> {
    if bytes.is_empty() {
        return Err(MeshFileError::new(Place::File, "the file is empty"));
    }
    match (format, part) {
        (MeshFormat::Obj, _) => obj::load(bytes, part),
        (MeshFormat::Ply, None) => ply::load(bytes),
        (MeshFormat::Stl, None) => stl::load(bytes),
        (MeshFormat::Ply | MeshFormat::Stl, Some(part)) => {
            let name = if format == MeshFormat::Ply { "PLY" } else { "STL" };
            let message = format!("{name} files have no parts, so none called `{part}`");
            Err(MeshFileError::new(Place::File, message)
                .help("leave the part out, or keep it in a file of its own"))
        }
    }
}

/// What is wrong with a mesh as a whole; the readers check the rest, for the place.
fn whole(error: &MeshError) -> MeshFileError {
    let message = match error {
        MeshError::Empty => "the file has no face".to_owned(),
        other => other.to_string(),
    };
    MeshFileError::new(Place::File, message)
}

/// A normal in single precision; a finite one stays finite.
fn single(normal: [f64; 3]) -> [f32; 3] {
    let single = normal.map(|c| c as f32);
    if single.iter().all(|c| c.is_finite()) {
        return single;
    }
    // Only the direction counts.
    let normal = unit(Vector::from(normal)).unwrap_or_else(Vector::zeros);
    [normal.x as f32, normal.y as f32, normal.z as f32]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extensions_are_recognised() {
        for (name, expected) in [
            ("a.obj", Some(MeshFormat::Obj)),
            ("dir.stl/b.PLY", Some(MeshFormat::Ply)),
            ("c.tar.Stl", Some(MeshFormat::Stl)),
            ("d.obj.bak", None),
            ("obj", None),
            (".obj", None),
            ("dir/.obj", None),
        ] {
            assert_eq!(MeshFormat::from_name(name), expected, "{name}");
        }
    }

    #[test]
    fn huge_normals_keep_their_direction() {
        assert_eq!(single([0.0, 3e300, 4e300]), [0.0, 0.6, 0.8]);
        assert_eq!(single([0.0, 0.0, 2.0]), [0.0, 0.0, 2.0]);
    }
}
