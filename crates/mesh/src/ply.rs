//! PLY: a header that says what follows, then rows of numbers, as text or binary.
//!
//! Header and rows go through `ply-rs-bw`, a row at a time, so that the place of
//! each is known. What it does not see to is seen to here: elements and
//! properties that are declared twice, sizes that the file cannot have, and
//! text of type `float`, which is to be read in double precision too.

use crate::words::{Words, quoted};
use crate::{MeshFileError, Place, single, whole};
use lancer_scene::Mesh;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType,
    ScalarType,
};
use std::collections::HashSet;
use std::io::ErrorKind;

/// The names that the list of a face's vertices goes by.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];
/// The most elements and properties, together. Files have a few dozen.
const DECLARATIONS: usize = 1000;
const POSITION: [&str; 3] = ["x", "y", "z"];
const NORMAL: [&str; 3] = ["nx", "ny", "nz"];

pub(crate) fn load(bytes: &[u8]) -> Result<Mesh, MeshFileError> {
    let (header, mut rows) = header(bytes)?;
    let mut positions: Vec<[f64; 3]> = Vec::new();
    let mut normals: Vec<[f32; 3]> = Vec::new();
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    let (vertices, has_normals) = wanted(&header)?;

    for element in header.elements.values() {
        rows.check_size(element)?;
        match element.name.as_str() {
            "vertex" => {
                for _ in 0..element.count {
                    let place = rows.place();
                    let vertex: Vertex = rows.next(element)?;
                    let all = vertex.position.iter().chain(&vertex.normal);
                    if let Some(found) = all.into_iter().find(|c| !c.is_finite()) {
                        let message = format!("expected finite numbers, found {found}");
                        return Err(MeshFileError::new(place, message));
                    }
                    positions.push(vertex.position);
                    if has_normals {
                        normals.push(single(vertex.normal));
                    }
                }
            }
            "face" => {
                for _ in 0..element.count {
                    let place = rows.place();
                    let face: Face = rows.next(element)?;
                    let corners = face
                        .corners(vertices)
                        .map_err(|message| MeshFileError::new(place, message))?;
                    for pair in corners[1..].windows(2) {
                        triangles.push([corners[0], pair[0], pair[1]]);
                    }
                }
            }
            _ => rows.skip(element)?,
        }
    }
    Mesh::new(positions, triangles)
        .and_then(|mesh| if has_normals { mesh.with_normals(normals, None) } else { Ok(mesh) })
        .map_err(|e| whole(&e))
}

/// The number of vertices, and whether they have normals.
fn wanted(header: &Header) -> Result<(usize, bool), MeshFileError> {
    let refuse = |message: &str| Err(MeshFileError::new(Place::File, message));
    let Some(vertex) = header.elements.get("vertex") else {
        return refuse("the header has no element `vertex`");
    };
    let has = |names: [&str; 3]| {
        names.iter().all(|name| {
            vertex
                .properties
                .get(*name)
                .is_some_and(|p| matches!(p.data_type, PropertyType::Scalar(_)))
        })
    };
    if !has(POSITION) {
        return refuse("the element `vertex` needs the properties `x`, `y` and `z`");
    }
    let Some(face) = header.elements.get("face") else {
        return refuse("the header has no element `face`").map_err(|e: MeshFileError| {
            e.help("points and triangle strips are not read: export triangles or polygons")
        });
    };
    let list = face.properties.values().find(|p| CORNERS.contains(&p.name.as_str()));
    match list.map(|list| &list.data_type) {
        Some(PropertyType::List(_, scalar))
            if !matches!(scalar, ScalarType::Float | ScalarType::Double) => {}
        _ => return refuse("the element `face` needs `vertex_indices`, a list of whole numbers"),
    }
    Ok((vertex.count, has(NORMAL)))
}

/// Reads the header; rows follow.
fn header(bytes: &[u8]) -> Result<(Header, Rows<'_>), MeshFileError> {
    if !bytes.starts_with(b"ply") {
        let place = Place::Line { line: 1, column: Some(1) };
        let found = quoted(&bytes[..bytes.len().min(3)]);
        return Err(MeshFileError::new(place, format!("expected `ply`, found {found}")));
    }
    check_declarations(bytes)?;
    let mut reader = Reader::new(bytes);
    let mut header = Parser::<Skipped>::new()
        .read_header(&mut reader)
        .map_err(|error| in_header(&error, bytes))?;
    let rest = reader.into_inner();
    let text = &bytes[..bytes.len() - rest.len()];
    if header.encoding == Encoding::Ascii {
        for property in header.elements.values_mut().flat_map(|e| e.properties.values_mut()) {
            if property.data_type == PropertyType::Scalar(ScalarType::Float) {
                property.data_type = PropertyType::Scalar(ScalarType::Double);
            }
        }
    }
    let line = text.iter().filter(|b| **b == b'\n').count() + 1;
    let rows = Rows { rest, total: bytes.len(), line, encoding: header.encoding };
    Ok((header, rows))
}

/// The parser's own messages show how it is made, over several lines.
fn in_header(error: &ParseError, bytes: &[u8]) -> MeshFileError {
    let place = error.line().map_or(Place::File, |line| Place::Line { line, column: None });
    let line = error.line().and_then(|line| bytes.split(|b| *b == b'\n').nth(line - 1));
    let message = match (error.kind(), line) {
        (ErrorKind::UnexpectedEof, _) => "the header has no line `end_header`".to_owned(),
        (ErrorKind::InvalidData, _) => "the header is not text".to_owned(),
        (_, Some(line)) => format!("no line of a PLY header: {}", quoted(line.trim_ascii())),
        (_, None) => "the header has no line like `format ascii 1.0`".to_owned(),
    };
    MeshFileError::new(place, message)
}

/// That no two elements, and no two properties of one, have the same name: the
/// parser would forget the first and read the rows wrongly. And that there are not
/// so many that it would take long over them.
fn check_declarations(bytes: &[u8]) -> Result<(), MeshFileError> {
    let mut elements = HashSet::new();
    let mut properties = HashSet::new();
    let mut count = 0;
    for (i, line) in bytes.split(|b| *b == b'\n').enumerate() {
        let error = |message: String| {
            Err(MeshFileError::new(Place::Line { line: i + 1, column: None }, message))
        };
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let (name, is_new) = match words.next() {
            Some(b"end_header") => break,
            Some(b"element") => {
                properties.clear();
                let name = words.next().unwrap_or_default();
                (name, elements.insert(name))
            }
            Some(b"property") => {
                let name = words.next_back().unwrap_or_default();
                (name, properties.insert(name))
            }
            _ => continue,
        };
        if !is_new {
            return error(format!("{} is declared twice", quoted(name)));
        }
        count += 1;
        if count > DECLARATIONS {
            return error(format!("more than {DECLARATIONS} elements and properties"));
        }
    }
    Ok(())
}

/// What follows the header.
struct Rows<'a> {
    rest: &'a [u8],
    total: usize,
    line: usize,
    encoding: Encoding,
}

impl Rows<'_> {
    fn place(&self) -> Place {
        match self.encoding {
            Encoding::Ascii => Place::Line { line: self.line, column: None },
            _ => Place::Byte((self.total - self.rest.len()) as u64),
        }
    }

    /// That what is left can hold the rows that the header announces.
    fn check_size(&self, element: &ElementDef) -> Result<(), MeshFileError> {
        let size = |scalar: &ScalarType| match (self.encoding, scalar) {
            // A digit and what separates it from the next.
            (Encoding::Ascii, _) => 2,
            (_, ScalarType::Char | ScalarType::UChar) => 1,
            (_, ScalarType::Short | ScalarType::UShort) => 2,
            (_, ScalarType::Int | ScalarType::UInt | ScalarType::Float) => 4,
            (_, ScalarType::Double) => 8,
        };
        let row: usize = element
            .properties
            .values()
            .map(|property| match &property.data_type {
                PropertyType::Scalar(scalar) | PropertyType::List(scalar, _) => size(scalar),
            })
            .sum();
        // The last line need not end.
        if element.count.saturating_mul(row) <= self.rest.len() + 1 {
            return Ok(());
        }
        let message = format!(
            "{} rows of `{}` are announced, but only {} bytes follow",
            element.count,
            element.name,
            self.rest.len()
        );
        Err(MeshFileError::new(self.place(), message))
    }

    /// Goes over the rows of an element that is not wanted.
    fn skip(&mut self, element: &ElementDef) -> Result<(), MeshFileError> {
        // Rows of nothing take no space, however many there are.
        if !element.properties.is_empty() {
            for _ in 0..element.count {
                self.next::<Skipped>(element)?;
            }
        }
        Ok(())
    }

    fn next<E: PropertyAccess>(&mut self, element: &ElementDef) -> Result<E, MeshFileError> {
        let parser = Parser::<E>::new();
        let start = self.place();
        let result = match self.encoding {
            Encoding::Ascii => return self.next_line(element),
            Encoding::BinaryLittleEndian => {
                parser.read_little_endian_element(&mut self.rest, element)
            }
            Encoding::BinaryBigEndian => parser.read_big_endian_element(&mut self.rest, element),
        };
        result.map_err(|error| match error.kind() {
            ErrorKind::UnexpectedEof => MeshFileError::new(
                start,
                format!("the file ends within a row of `{}`", element.name),
            ),
            _ => unreadable(start, element),
        })
    }

    fn next_line<E: PropertyAccess>(&mut self, element: &ElementDef) -> Result<E, MeshFileError> {
        loop {
            if self.rest.is_empty() {
                let message = format!("the file ends before the last row of `{}`", element.name);
                return Err(MeshFileError::new(self.place(), message));
            }
            let place = self.place();
            let end = self.rest.iter().position(|b| *b == b'\n').unwrap_or(self.rest.len());
            let row = self.rest[..end].trim_ascii();
            self.rest = self.rest.get(end + 1..).unwrap_or_default();
            self.line += 1;
            if row.is_empty() {
                continue;
            }
            let text = String::from_utf8_lossy(row);
            return match Parser::<E>::new().read_ascii_element(&text, element) {
                Ok(row) => Ok(row),
                Err(_) => {
                    let plain = plain_numbers(row, self.line - 1)?;
                    let again = Parser::<E>::new().read_ascii_element(&plain, element);
                    again.map_err(|_| unreadable(place, element))
                }
            };
        }
    }
}

/// The numbers of a row as the parser knows them: it takes no `.5` and no `1.`.
fn plain_numbers(row: &[u8], line: usize) -> Result<String, MeshFileError> {
    let mut words = Words::new(row, false);
    let mut plain = Vec::new();
    while let Some(word) = words.next_in_line() {
        // Digits alone, with no exponent, and as many as it takes to read it back.
        let number = word.number().map_err(|error| match error.place {
            Place::Line { column, .. } => {
                MeshFileError { place: Place::Line { line, column }, ..error }
            }
            _ => error,
        })?;
        plain.push(number.to_string());
    }
    Ok(plain.join(" "))
}

/// The parser's own messages show how it is made, over several lines.
fn unreadable(place: Place, element: &ElementDef) -> MeshFileError {
    let message = format!("the row is no row of `{}` as the header declares it", element.name);
    MeshFileError::new(place, message)
}

/// A row of an element that is not wanted.
struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}

/// A row of `vertex`.
struct Vertex {
    position: [f64; 3],
    normal: [f64; 3],
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self { position: [0.0; 3], normal: [0.0; 3] }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let slot = |names: [&str; 3]| names.iter().position(|n| *n == name);
        let target = match (slot(POSITION), slot(NORMAL)) {
            (Some(axis), _) => &mut self.position[axis],
            (_, Some(axis)) => &mut self.normal[axis],
            _ => return PropertyAccessResult::Ignored,
        };
        *target = match property {
            Property::Char(value) => value.into(),
            Property::UChar(value) => value.into(),
            Property::Short(value) => value.into(),
            Property::UShort(value) => value.into(),
            Property::Int(value) => value.into(),
            Property::UInt(value) => value.into(),
            Property::Float(value) => value.into(),
            Property::Double(value) => value,
            _ => return PropertyAccessResult::Ignored,
        };
        PropertyAccessResult::Set
    }
}

/// A row of `face`.
struct Face {
    corners: Vec<i64>,
}

impl Face {
    /// The vertices, of which there are `count`, at its corners.
    fn corners(&self, count: usize) -> Result<Vec<u32>, String> {
        if self.corners.len() < 3 {
            return Err(format!(
                "expected a face with at least 3 corners, found {}",
                self.corners.len()
            ));
        }
        let there = |index: &i64| {
            u32::try_from(*index).ok().filter(|index| (*index as usize) < count).ok_or_else(|| {
                format!("there is no vertex {index}: there are {count}, counted from 0")
            })
        };
        self.corners.iter().map(there).collect()
    }
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self { corners: Vec::new() }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !CORNERS.contains(&name) {
            return PropertyAccessResult::Ignored;
        }
        self.corners = match property {
            Property::ListChar(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUChar(list) => list.into_iter().map(i64::from).collect(),
            Property::ListShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListInt(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUInt(list) => list.into_iter().map(i64::from).collect(),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}
