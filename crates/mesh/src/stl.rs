//! STL: triangles without shared vertices.
//!
//! Binary files go through `stl_io`. It reads text in single precision and tells
//! no line, so text is read here. Facet normals are ignored: the order of the
//! corners says the same.

use crate::words::Words;
use crate::{MeshFileError, Place, whole};
use lancer_scene::Mesh;
use std::collections::HashMap;
use std::io::Cursor;

/// A comment of 80 bytes and the number of triangles.
const HEADER: usize = 84;
/// A normal and three corners in single precision, and two bytes more.
const TRIANGLE: usize = 50;

pub(crate) fn load(bytes: &[u8]) -> Result<Mesh, MeshFileError> {
    if is_text(bytes) { text(bytes) } else { binary(bytes) }
}

/// How many triangles a binary file claims to have.
fn claimed(bytes: &[u8]) -> Option<u32> {
    bytes.first_chunk::<HEADER>().map(|h| u32::from_le_bytes([h[80], h[81], h[82], h[83]]))
}

/// Whether the file is text. A binary one may begin with `solid` too; so one whose
/// size is that of a binary file is binary, and so is one with zeros early on.
fn is_text(bytes: &[u8]) -> bool {
    let has_binary_size = claimed(bytes)
        .is_some_and(|count| bytes.len() as u64 == (HEADER as u64) + 50 * u64::from(count));
    let begins =
        bytes.trim_ascii_start().get(..5).is_some_and(|w| w.eq_ignore_ascii_case(b"solid"));
    !has_binary_size && begins && !bytes.iter().take(1024).any(|b| *b == 0)
}

fn binary(bytes: &[u8]) -> Result<Mesh, MeshFileError> {
    let end = Place::Byte(bytes.len() as u64);
    let Some(count) = claimed(bytes) else {
        return Err(MeshFileError::new(end, "the file ends within its header of 84 bytes")
            .help("a text STL file begins with the word `solid`"));
    };
    let there = (bytes.len() - HEADER) / TRIANGLE;
    if count as usize > there {
        let message = format!("the file ends after {there} of the {count} triangles it announces");
        return Err(MeshFileError::new(end, message));
    }
    // stl_io takes files that begin with `solid` for text.
    let mut copy;
    let bytes = if bytes.starts_with(b"solid") {
        copy = bytes.to_vec();
        copy[0] = b' ';
        &copy
    } else {
        bytes
    };
    let mut cursor = Cursor::new(bytes);
    let unreadable = |e: std::io::Error| MeshFileError::new(Place::File, e.to_string());
    let mut welder = Welder::default();
    for (i, triangle) in stl_io::create_stl_reader(&mut cursor).map_err(unreadable)?.enumerate() {
        let corners = triangle.map_err(unreadable)?.vertices;
        for (k, corner) in corners.iter().enumerate() {
            if let Some(axis) = corner.0.iter().position(|c| !c.is_finite()) {
                let byte = HEADER + TRIANGLE * i + 12 * (k + 1) + 4 * axis;
                let message = format!("expected a finite number, found {}", corner.0[axis]);
                return Err(MeshFileError::new(Place::Byte(byte as u64), message));
            }
        }
        welder.triangle(corners.map(|corner| corner.0.map(f64::from)));
    }
    welder.mesh()
}

fn text(bytes: &[u8]) -> Result<Mesh, MeshFileError> {
    let mut words = Words::new(bytes, false);
    let mut welder = Welder::default();
    // The name behind `solid` may be anything, up to the end of the line.
    expect(&mut words, &["solid"])?;
    words.next_line();
    loop {
        let Some(word) = words.next_word() else {
            return Err(words.error("the file ends before `endsolid`"));
        };
        if word.bytes.eq_ignore_ascii_case(b"facet") {
            expect(&mut words, &["normal"])?;
            for _ in 0..3 {
                // Whatever they are: some programs write `nan`.
                words.next_word();
            }
            expect(&mut words, &["outer", "loop"])?;
            let mut corners = [[0.0; 3]; 3];
            for corner in &mut corners {
                expect(&mut words, &["vertex"])?;
                for coordinate in corner {
                    *coordinate = words.expect_in_line("three coordinates")?.number()?;
                }
            }
            expect(&mut words, &["endloop", "endfacet"])?;
            welder.triangle(corners);
        } else if word.bytes.eq_ignore_ascii_case(b"endsolid") {
            // Several solids may follow one another.
            words.next_line();
            match words.next_word() {
                None => return welder.mesh(),
                Some(word) if word.bytes.eq_ignore_ascii_case(b"solid") => {
                    words.next_line();
                }
                Some(word) => return Err(word.error("`solid` or the end of the file")),
            }
        } else {
            return Err(word.error("`facet` or `endsolid`"));
        }
    }
}

fn expect(words: &mut Words<'_>, keywords: &[&str]) -> Result<(), MeshFileError> {
    for keyword in keywords {
        match words.next_word() {
            Some(word) if word.bytes.eq_ignore_ascii_case(keyword.as_bytes()) => {}
            Some(word) => return Err(word.error(&format!("`{keyword}`"))),
            None => return Err(words.error(format!("the file ends before `{keyword}`"))),
        }
    }
    Ok(())
}

/// Makes corners at the same place one vertex.
#[derive(Default)]
struct Welder {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    index_of: HashMap<[u64; 3], u32>,
}

impl Welder {
    fn triangle(&mut self, corners: [[f64; 3]; 3]) {
        let triangle = corners.map(|corner| {
            // -0 is at the place of 0.
            let place = corner.map(|c| (c + 0.0).to_bits());
            *self.index_of.entry(place).or_insert_with(|| {
                self.positions.push(corner);
                // A file of 2^32 vertices would have 70 GB or more.
                (self.positions.len() - 1) as u32
            })
        });
        self.triangles.push(triangle);
    }

    fn mesh(self) -> Result<Mesh, MeshFileError> {
        drop(self.index_of);
        Mesh::new(self.positions, self.triangles).map_err(|e| whole(&e))
    }
}
