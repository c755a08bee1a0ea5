//! Wavefront OBJ: a statement a line, with indices that count from 1, or from
//! the end where they are negative.
//!
//! Read here, since no crate gives all of this: coordinates in double precision,
//! the line of a mistake, continued lines, several groups for a face, and an
//! answer to any index. Statements other than `v`, `vn`, `f`, `g`, `o` and
//! `usemtl` are ignored.

use crate::words::{Word, Words};
use crate::{MeshFileError, Place, single, whole};
use lancer_scene::Mesh;
use std::collections::HashSet;

/// The most parts that an error lists, and the most that are looked through.
const LISTED: usize = 20;
const SEARCHED: usize = 2000;
/// The most names of groups that are kept of a line.
const LONGEST: usize = 100;

/// Stands for the normal of a corner that has none, until it is known how many
/// normals there are.
const NO_NORMAL: u32 = u32::MAX;

pub(crate) fn load(bytes: &[u8], part: Option<&str>) -> Result<Mesh, MeshFileError> {
    let mut reader = Reader::new(bytes, part);
    let mut words = Words::new(bytes, true);
    loop {
        if let Some(keyword) = words.next_in_line() {
            reader.statement(&keyword, &mut words)?;
        }
        if !words.next_line() {
            return reader.mesh();
        }
    }
}

/// How many there are of something in the file, and have been so far.
#[derive(Default)]
struct Count {
    total: usize,
    so_far: usize,
}

impl Count {
    /// The index that `word` names, from 0.
    fn index(&self, word: &Word<'_>, what: &str) -> Result<u32, MeshFileError> {
        let text = std::str::from_utf8(word.bytes).unwrap_or_default();
        let index: i64 =
            text.parse().map_err(|_| word.error(&format!("the number of a {what}")))?;
        let counted = match index {
            1.. => index - 1,
            0 => -1,
            ..0 => index.saturating_add_unsigned(self.so_far as u64),
        };
        let limit = if index < 0 { self.so_far } else { self.total };
        match u32::try_from(counted) {
            Ok(counted) if (counted as usize) < limit => Ok(counted),
            _ if index == 0 => Err(MeshFileError::new(
                word.place(),
                format!("there is no {what} 0: they count from 1"),
            )),
            _ => {
                let before = if index < 0 { " before this line" } else { "" };
                let are = if limit == 1 { "is" } else { "are" };
                let message =
                    format!("there is no {what} {index}: there {are} {limit} in the file{before}");
                Err(MeshFileError::new(word.place(), message))
            }
        }
    }
}

/// The rest of the line, with one space between words.
fn name(words: &mut Words<'_>) -> Vec<u8> {
    let mut name = Vec::new();
    while let Some(word) = words.next_in_line() {
        if !name.is_empty() {
            name.push(b' ');
        }
        name.extend_from_slice(word.bytes);
    }
    name
}

struct Reader<'a> {
    part: Option<&'a str>,
    /// Whether faces that follow are wanted.
    wanted: bool,
    object: Vec<u8>,
    material: Vec<u8>,
    /// Whether there is a material of the part's name: then it decides alone.
    is_material: bool,
    /// The first of the groups that faces are in.
    groups: Vec<&'a [u8]>,
    /// Whether the part is one of all the groups.
    in_group: bool,
    /// Whether the names of the object, groups and material are among `parts`.
    noted: bool,
    parts: Vec<Vec<u8>>,
    known: HashSet<Vec<u8>>,

    vertex_count: Count,
    normal_count: Count,
    positions: Vec<[f64; 3]>,
    normals: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    /// For each triangle; empty as long as no corner had a normal.
    normal_corners: Vec<[u32; 3]>,
    face: Vec<(u32, u32)>,
}

impl<'a> Reader<'a> {
    /// Counts the vertices and normals first: a face may name later ones.
    fn new(bytes: &'a [u8], part: Option<&'a str>) -> Self {
        let (mut vertex_count, mut normal_count) = (Count::default(), Count::default());
        let mut words = Words::new(bytes, true);
        let mut is_material = false;
        loop {
            match words.next_in_line().map(|word| word.bytes) {
                Some(b"v") => vertex_count.total += 1,
                Some(b"vn") => normal_count.total += 1,
                Some(b"usemtl") => {
                    is_material |= part.is_some_and(|part| name(&mut words) == part.as_bytes());
                }
                _ => {}
            }
            if !words.next_line() {
                break;
            }
        }
        Self {
            part,
            wanted: part.is_none(),
            object: Vec::new(),
            material: Vec::new(),
            is_material,
            groups: Vec::new(),
            in_group: false,
            noted: false,
            parts: Vec::new(),
            known: HashSet::new(),
            positions: Vec::with_capacity(vertex_count.total),
            normals: Vec::with_capacity(normal_count.total),
            vertex_count,
            normal_count,
            triangles: Vec::new(),
            normal_corners: Vec::new(),
            face: Vec::new(),
        }
    }

    fn statement(
        &mut self,
        keyword: &Word<'a>,
        words: &mut Words<'a>,
    ) -> Result<(), MeshFileError> {
        match keyword.bytes {
            b"v" => {
                // A weight or a colour may follow.
                self.positions.push(three(words)?);
                self.vertex_count.so_far += 1;
            }
            b"vn" => {
                self.normals.push(single(three(words)?));
                self.normal_count.so_far += 1;
            }
            b"f" => self.face(words)?,
            b"g" => {
                self.groups.clear();
                self.in_group = false;
                while let Some(word) = words.next_in_line() {
                    self.in_group |= self.part.is_some_and(|part| word.bytes == part.as_bytes());
                    if self.groups.len() < LONGEST {
                        self.groups.push(word.bytes);
                    }
                }
                self.enter();
            }
            b"o" => {
                self.object = name(words);
                self.enter();
            }
            b"usemtl" => {
                self.material = name(words);
                self.enter();
            }
            _ => {}
        }
        Ok(())
    }

    /// A group, an object or faces of a material begin.
    fn enter(&mut self) {
        self.noted = false;
        let Some(part) = self.part else { return };
        if self.is_material {
            self.wanted = self.material == part.as_bytes();
            return;
        }
        // Group names with spaces are several groups, but not to everyone.
        self.wanted = self.object == part.as_bytes()
            || self.in_group
            || self.groups.join(&b' ') == part.as_bytes();
    }

    fn face(&mut self, words: &mut Words<'_>) -> Result<(), MeshFileError> {
        if !self.noted {
            self.noted = true;
            if self.part.is_some() {
                let others = [self.object.as_slice(), self.material.as_slice()];
                for name in self.groups.iter().copied().chain(others) {
                    let is_new = !name.is_empty() && !self.known.contains(name);
                    if is_new && self.parts.len() < SEARCHED {
                        self.known.insert(name.to_vec());
                        self.parts.push(name.to_vec());
                    }
                }
            }
        }
        let line = words.line();
        self.face.clear();
        while let Some(word) = words.next_in_line() {
            let corner = self.corner(&word)?;
            self.face.push(corner);
        }
        if self.face.len() < 3 {
            let message =
                format!("expected a face with at least 3 corners, found {}", self.face.len());
            return Err(MeshFileError::new(Place::Line { line, column: None }, message));
        }
        if !self.wanted {
            return Ok(());
        }
        if self.normal_corners.is_empty() && self.face.iter().any(|(_, n)| *n != NO_NORMAL) {
            self.normal_corners = vec![[NO_NORMAL; 3]; self.triangles.len()];
        }
        let has_normals = !self.normal_corners.is_empty()
            || self.face.iter().any(|(_, normal)| *normal != NO_NORMAL);
        let first = self.face[0];
        for pair in self.face[1..].windows(2) {
            self.triangles.push([first.0, pair[0].0, pair[1].0]);
            if has_normals {
                self.normal_corners.push([first.1, pair[0].1, pair[1].1]);
            }
        }
        Ok(())
    }

    /// The vertex and the normal of `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&self, word: &Word<'_>) -> Result<(u32, u32), MeshFileError> {
        if word.bytes.iter().filter(|b| **b == b'/').count() > 2 {
            return Err(word.error("at most `vertex/texture/normal`"));
        }
        let mut start = 0;
        let mut corner = (0, NO_NORMAL);
        for (i, part) in word.bytes.split(|b| *b == b'/').enumerate() {
            let part = word.part(start, part.len());
            match i {
                0 => corner.0 = self.vertex_count.index(&part, "vertex")?,
                2 => corner.1 = self.normal_count.index(&part, "normal")?,
                // Texture coordinates are not looked at.
                _ => {}
            }
            start += part.bytes.len() + 1;
        }
        Ok(corner)
    }

    fn mesh(mut self) -> Result<Mesh, MeshFileError> {
        if let (Some(part), true) = (self.part, self.triangles.is_empty()) {
            return Err(no_such_part(part, &self.parts));
        }
        compact(&mut self.positions, &mut self.triangles);
        if self.normal_corners.is_empty() {
            return Mesh::new(self.positions, self.triangles).map_err(|e| whole(&e));
        }
        let none = self.normals.len() as u32;
        for normal in self.normal_corners.iter_mut().flatten() {
            *normal = (*normal).min(none);
        }
        self.normals.push([0.0; 3]);
        compact(&mut self.normals, &mut self.normal_corners);
        let same =
            self.normals.len() == self.positions.len() && self.normal_corners == self.triangles;
        let corners = (!same).then_some(self.normal_corners);
        Mesh::new(self.positions, self.triangles)
            .and_then(|mesh| mesh.with_normals(self.normals, corners))
            .map_err(|e| whole(&e))
    }
}

fn three(words: &mut Words<'_>) -> Result<[f64; 3], MeshFileError> {
    let mut numbers = [0.0; 3];
    for number in &mut numbers {
        *number = words.expect_in_line("three numbers")?.number()?;
    }
    Ok(numbers)
}

/// Drops the values that no triangle uses.
fn compact<T: Copy>(values: &mut Vec<T>, triangles: &mut [[u32; 3]]) {
    let mut new_index = vec![u32::MAX; values.len()];
    for index in triangles.iter().flatten() {
        new_index[*index as usize] = 0;
    }
    let mut kept = 0;
    for old in 0..values.len() {
        if new_index[old] == 0 {
            new_index[old] = kept;
            values[kept as usize] = values[old];
            kept += 1;
        }
    }
    values.truncate(kept as usize);
    for index in triangles.iter_mut().flatten() {
        *index = new_index[*index as usize];
    }
}

fn no_such_part(part: &str, parts: &[Vec<u8>]) -> MeshFileError {
    let short = |name: &str| name.chars().take(40).collect::<String>();
    let error = MeshFileError::new(
        Place::File,
        format!("no face is in a group or object, or of a material, called `{}`", short(part)),
    );
    if parts.is_empty() {
        return error.help("the file has no groups, objects or materials: leave the part out");
    }
    let mut names: Vec<_> = parts.iter().map(|n| short(&String::from_utf8_lossy(n))).collect();
    let all = names.len() <= LISTED;
    if !all {
        let wanted = short(part);
        names.sort_by_cached_key(|name| strsim::damerau_levenshtein(&wanted, name));
        names.truncate(LISTED);
    }
    let which = if all { "its parts" } else { "the most similar of its parts" };
    let names: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
    error.help(format!("{which}: {}", names.join(", ")))
}
