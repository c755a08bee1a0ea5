//! Triangle meshes: plain data that has been checked, and what follows from it
//! alone (bounds, volume, whether it is closed, smooth normals).

use lancer_math::{Point, Vector, unit};
use std::fmt;
use std::sync::OnceLock;

/// Why a mesh was refused. Vertices, triangles and normals count from 0.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// A coordinate of a position or a normal is NaN or infinite.
    #[error("{what} {index} is {found}, expected finite coordinates")]
    NotFinite {
        /// "vertex" or "normal".
        what: &'static str,
        /// Which one.
        index: usize,
        /// Its coordinates, as text.
        found: String,
    },
    /// A corner of a triangle is a vertex, or has a normal, that is not there.
    #[error("triangle {triangle} has {what} {found}, but there are only {count}")]
    NoSuchIndex {
        /// The triangle, counted as it was given.
        triangle: usize,
        /// "vertex" or "normal".
        what: &'static str,
        /// The index.
        found: u32,
        /// How many there are.
        count: usize,
    },
    /// A list that must have one entry for each of something has another length.
    #[error("there are {found} {what}, expected {expected}")]
    WrongCount {
        /// What is listed.
        what: &'static str,
        /// How many are given.
        found: usize,
        /// How many there must be.
        expected: usize,
    },
    /// No triangle was given.
    #[error("the mesh has no triangle")]
    Empty,
    /// All triangles that were given have zero area.
    #[error("none of the {given} triangles has an area")]
    NoArea {
        /// How many were given.
        given: usize,
    },
}

/// Positions in the smaller precision that holds all of them exactly.
#[derive(Clone)]
enum Positions {
    Single(Vec<[f32; 3]>),
    Double(Vec<[f64; 3]>),
}

impl Positions {
    fn new(mut positions: Vec<[f64; 3]>) -> Self {
        let exact = |c: &f64| f64::from(*c as f32).to_bits() == c.to_bits();
        if positions.iter().flatten().all(exact) {
            Self::Single(positions.iter().map(|p| p.map(|c| c as f32)).collect())
        } else {
            positions.shrink_to_fit();
            Self::Double(positions)
        }
    }

    fn count(&self) -> usize {
        match self {
            Self::Single(positions) => positions.len(),
            Self::Double(positions) => positions.len(),
        }
    }

    #[inline]
    fn get(&self, vertex: u32) -> [f64; 3] {
        match self {
            Self::Single(positions) => positions[vertex as usize].map(f64::from),
            Self::Double(positions) => positions[vertex as usize],
        }
    }
}

#[derive(Clone)]
struct Normals {
    vectors: Vec<[f32; 3]>,
    /// Which one each corner has; `None` where it is that of the corner's vertex.
    corners: Option<Vec<[u32; 3]>>,
}

/// A triangle without area that was left out.
#[derive(Clone)]
struct Dropped {
    /// Which one it was of those given.
    index: usize,
    corners: [u32; 3],
}

/// Triangles with shared vertices: at least one, all with an area, all finite.
///
/// A triangle faces the side from which its corners go anticlockwise. Lengths
/// are those of the scene. It does not change once it is made, and is large:
/// share it with an [`Arc`](std::sync::Arc).
///
/// ```
/// use lancer_scene::Mesh;
///
/// let tetrahedron = Mesh::new(
///     vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
///     vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
/// )?;
/// assert!(tetrahedron.is_closed());
/// assert!((tetrahedron.signed_volume() - 1.0 / 6.0).abs() < 1e-15);
/// # Ok::<(), lancer_scene::MeshError>(())
/// ```
#[derive(Clone)]
pub struct Mesh {
    positions: Positions,
    triangles: Vec<[u32; 3]>,
    normals: Option<Normals>,
    bounds: (Point, Point),
    dropped: Vec<Dropped>,
    closed: OnceLock<bool>,
}

impl Mesh {
    /// The mesh of these triangles, whose corners are indices into `positions`.
    ///
    /// Positions are kept in single precision where that holds every one of them
    /// exactly, else in double precision. Triangles without area are left out and
    /// counted: those with coinciding corners, and those whose edges have no
    /// cross product (up to the rounding of the edges, but not its underflow).
    ///
    /// # Errors
    /// Where a coordinate is NaN or infinite, an index has no position, or no
    /// triangle is left.
    pub fn new(positions: Vec<[f64; 3]>, mut triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        all_finite(&positions, "vertex")?;
        all_there(&triangles, positions.len(), "vertex")?;
        if triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        let given = triangles.len();
        let mut dropped = Vec::new();
        let mut index = 0;
        triangles.retain(|&corners| {
            let [a, b, c] = corners.map(|vertex| Point::from(positions[vertex as usize]));
            let has_area = facing(a, b, c).is_some();
            if !has_area {
                dropped.push(Dropped { index, corners });
            }
            index += 1;
            has_area
        });
        if triangles.is_empty() {
            return Err(MeshError::NoArea { given });
        }
        triangles.shrink_to_fit();
        dropped.shrink_to_fit();

        let (mut min, mut max) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for vertex in triangles.iter().flatten() {
            let p = positions[*vertex as usize];
            for axis in 0..3 {
                min[axis] = min[axis].min(p[axis]);
                max[axis] = max[axis].max(p[axis]);
            }
        }
        Ok(Self {
            positions: Positions::new(positions),
            triangles,
            normals: None,
            bounds: (Point::from(min), Point::from(max)),
            dropped,
            closed: OnceLock::new(),
        })
    }

    /// The mesh with these normals, of any length, instead of those it has.
    ///
    /// `corners` says which normal each corner has, for all the triangles that
    /// [`Mesh::new`] was given, the dropped ones too; without it, each vertex
    /// has the normal of its own index. A normal of length zero stands for that
    /// of the triangle's plane.
    ///
    /// # Errors
    /// Where a normal is NaN or infinite, an index has no normal, or there are
    /// not as many as there must be.
    pub fn with_normals(
        self,
        mut normals: Vec<[f32; 3]>,
        corners: Option<Vec<[u32; 3]>>,
    ) -> Result<Self, MeshError> {
        for (index, n) in normals.iter().enumerate() {
            finite(n.map(f64::from), index, "normal")?;
        }
        let (found, expected, what) = match &corners {
            None => (normals.len(), self.positions.count(), "normals"),
            Some(c) => (c.len(), self.triangles.len() + self.dropped.len(), "triples of normals"),
        };
        if found != expected {
            return Err(MeshError::WrongCount { what, found, expected });
        }
        let corners = match corners {
            None => None,
            Some(mut corners) => {
                all_there(&corners, normals.len(), "normal")?;
                let mut dropped = self.dropped.iter().map(|d| d.index).peekable();
                let mut index = 0;
                corners.retain(|_| {
                    let kept = dropped.next_if_eq(&index).is_none();
                    index += 1;
                    kept
                });
                corners.shrink_to_fit();
                Some(corners)
            }
        };
        normals.shrink_to_fit();
        Ok(Self { normals: Some(Normals { vectors: normals, corners }), ..self })
    }

    /// The mesh with a normal at each vertex that is the mean of the normals of
    /// the triangles there, weighted by their angles (Thürmer and Wüthrich,
    /// *Computing Vertex Normals from Polygonal Facets*, 1998).
    ///
    /// Vertices at the same place get the same normal. Where the mean is zero,
    /// as where a sheet is folded onto itself, so is the normal. A mesh that has
    /// normals keeps them.
    #[must_use]
    pub fn with_smooth_normals(self) -> Self {
        if self.normals.is_some() {
            return self;
        }
        let same = self.first_at_same_place();
        let mut sums = vec![Vector::zeros(); same.len()];
        for triangle in &self.triangles {
            let corners = triangle.map(|vertex| Point::from(self.positions.get(vertex)));
            for k in 0..3 {
                let (a, b, c) = (corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]);
                if let Some((normal, angle)) = facing(a, b, c) {
                    sums[same[triangle[k] as usize] as usize] += normal * angle;
                }
            }
        }
        let normal = |first: &u32| {
            let normal = unit(sums[*first as usize]).unwrap_or_else(Vector::zeros);
            [normal.x as f32, normal.y as f32, normal.z as f32]
        };
        let vectors = same.iter().map(normal).collect();
        Self { normals: Some(Normals { vectors, corners: None }), ..self }
    }

    /// The mesh with flat triangles, whatever normals it has.
    #[must_use]
    pub fn without_normals(self) -> Self {
        Self { normals: None, ..self }
    }

    /// How many triangles it has; at least 1.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// How many triangles were left out because they have no area.
    #[must_use]
    pub fn dropped(&self) -> usize {
        self.dropped.len()
    }

    /// Corner `k`, from 0 to 2, of a triangle.
    ///
    /// # Panics
    /// Where there is no such triangle or corner.
    #[inline]
    #[must_use]
    pub fn corner(&self, triangle: usize, k: usize) -> Point {
        Point::from(self.positions.get(self.triangles[triangle][k]))
    }

    /// The corners of a triangle.
    ///
    /// # Panics
    /// Where there is no such triangle.
    #[inline]
    #[must_use]
    pub fn corners(&self, triangle: usize) -> [Point; 3] {
        self.triangles[triangle].map(|vertex| Point::from(self.positions.get(vertex)))
    }

    /// The normals at the corners of a triangle, where the mesh has normals:
    /// finite, of any length; zero stands for that of the triangle's plane.
    ///
    /// # Panics
    /// Where there is no such triangle.
    #[inline]
    #[must_use]
    pub fn corner_normals(&self, triangle: usize) -> Option<[Vector; 3]> {
        let normals = self.normals.as_ref()?;
        let indices = normals.corners.as_ref().unwrap_or(&self.triangles)[triangle];
        Some(indices.map(|index| Vector::from(normals.vectors[index as usize].map(f64::from))))
    }

    /// Whether it has normals at its corners.
    #[must_use]
    pub fn has_normals(&self) -> bool {
        self.normals.is_some()
    }

    /// The least and the greatest coordinates of its corners.
    #[must_use]
    pub fn bounds(&self) -> (Point, Point) {
        self.bounds
    }

    /// Whether the positions are kept in single precision.
    #[must_use]
    pub fn is_single_precision(&self) -> bool {
        matches!(self.positions, Positions::Single(_))
    }

    /// How much memory it takes, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let positions = match &self.positions {
            Positions::Single(positions) => size_of_val(positions.as_slice()),
            Positions::Double(positions) => size_of_val(positions.as_slice()),
        };
        let normals = self.normals.as_ref().map_or(0, |normals| {
            size_of_val(normals.vectors.as_slice())
                + normals.corners.as_ref().map_or(0, |c| size_of_val(c.as_slice()))
        });
        size_of::<Self>()
            + positions
            + normals
            + size_of_val(self.triangles.as_slice())
            + size_of_val(self.dropped.as_slice())
    }

    /// Whether it bounds a solid without holes: each edge is passed as often in
    /// one direction as in the other, where vertices at the same place are one.
    ///
    /// Dropped triangles count, since a triangle whose corners lie on a line closes
    /// the seam between a long edge and two short ones. Whether the faces pass
    /// through each other, or all look inwards, is not asked. Computed at the
    /// first call and kept.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        *self.closed.get_or_init(|| self.edges_are_matched())
    }

    /// Eight bytes an edge, and four a vertex: edges are sorted, not hashed.
    fn edges_are_matched(&self) -> bool {
        let same = self.first_at_same_place();
        let mut upwards = Vec::with_capacity(self.triangles.len() * 3 / 2);
        let mut downwards = Vec::with_capacity(self.triangles.len() * 3 / 2);
        let dropped = self.dropped.iter().map(|d| &d.corners);
        for triangle in self.triangles.iter().chain(dropped) {
            let ends = triangle.map(|vertex| u64::from(same[vertex as usize]));
            for (from, to) in [(ends[0], ends[1]), (ends[1], ends[2]), (ends[2], ends[0])] {
                if from < to {
                    upwards.push(from << 32 | to);
                } else if to < from {
                    downwards.push(to << 32 | from);
                }
            }
        }
        if upwards.len() != downwards.len() {
            return false;
        }
        upwards.sort_unstable();
        downwards.sort_unstable();
        upwards == downwards
    }

    /// For each vertex, one and the same of those at its place (-0 is 0).
    fn first_at_same_place(&self) -> Vec<u32> {
        let place = |vertex: u32| self.positions.get(vertex).map(|c| (c + 0.0).to_bits());
        // An index is a u32, so further vertices have no triangle.
        let count = u32::try_from(self.positions.count()).unwrap_or(u32::MAX);
        let mut order: Vec<u32> = (0..count).collect();
        order.sort_unstable_by_key(|&vertex| place(vertex));
        let mut same = vec![0; order.len()];
        for group in order.chunk_by(|&a, &b| place(a) == place(b)) {
            let first = group.iter().min().copied().unwrap_or(0);
            for &vertex in group {
                same[vertex as usize] = first;
            }
        }
        same
    }

    /// The volume it encloses, positive where the faces look outwards; without
    /// meaning where it is not [closed](Self::is_closed).
    ///
    /// By the divergence theorem, as a sum of tetrahedra with their tips in the
    /// middle of the bounds, to lose few digits far from the origin.
    #[must_use]
    pub fn signed_volume(&self) -> f64 {
        let middle = self.bounds.0.coords * 0.5 + self.bounds.1.coords * 0.5;
        let six_times: f64 = (0..self.triangle_count())
            .map(|triangle| {
                let [a, b, c] = self.corners(triangle).map(|p| p.coords - middle);
                a.dot(&b.cross(&c))
            })
            .sum();
        six_times / 6.0
    }
}

/// A line about it, not its millions of numbers.
impl fmt::Debug for Mesh {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Mesh")
            .field("triangles", &self.triangles.len())
            .field("vertices", &self.positions.count())
            .field("has_normals", &self.has_normals())
            .field("bounds", &self.bounds)
            .finish_non_exhaustive()
    }
}

/// The unit normal of a triangle and its angle at `a` in radians; `None` where
/// it has no area.
///
/// Each edge is scaled by a power of two that brings its largest component into
/// [1, 2), so that no product of theirs that matters underflows or overflows.
fn facing(a: Point, b: Point, c: Point) -> Option<(Vector, f64)> {
    let edge = |to: Point| {
        let mut edge = to - a;
        if !edge.iter().all(|c| c.is_finite()) {
            edge = to * 0.5 - a * 0.5;
        }
        let largest = edge.amax();
        (largest > 0.0).then(|| {
            let exponent = libm::ilogb(largest);
            edge.map(|c| libm::scalbn(c, -exponent))
        })
    };
    let (to_b, to_c) = (edge(b)?, edge(c)?);
    let across = to_b.cross(&to_c);
    let normal = unit(across)?;
    Some((normal, libm::atan2(across.norm(), to_b.dot(&to_c))))
}

fn finite(xyz: [f64; 3], index: usize, what: &'static str) -> Result<(), MeshError> {
    if xyz.iter().all(|c| c.is_finite()) {
        return Ok(());
    }
    let found = format!("({}, {}, {})", xyz[0], xyz[1], xyz[2]);
    Err(MeshError::NotFinite { what, index, found })
}

fn all_finite(positions: &[[f64; 3]], what: &'static str) -> Result<(), MeshError> {
    positions.iter().enumerate().try_for_each(|(index, p)| finite(*p, index, what))
}

fn all_there(triangles: &[[u32; 3]], count: usize, what: &'static str) -> Result<(), MeshError> {
    for (triangle, indices) in triangles.iter().enumerate() {
        if let Some(&found) = indices.iter().find(|&&index| index as usize >= count) {
            return Err(MeshError::NoSuchIndex { triangle, what, found, count });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
