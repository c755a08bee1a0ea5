//! What a line meets.

use crate::{Number, Triple};

/// Which way a line passes a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Passage {
    /// Against the normal: into a solid, or from a sheet's front to its back.
    Enters,
    /// Along the normal.
    Leaves,
    /// Neither: it is on the same side before and after.
    Touches,
}

/// A place where a line meets the boundary of a shape.
#[derive(Clone, Debug)]
pub struct Crossing {
    /// Which place of the line: origin + t direction. Of either sign.
    pub t: Number,
    /// Where that is in the world.
    pub point: Triple,
    /// The normal there, of length 1, pointing out of a solid, and of a sheet the
    /// way its description says.
    pub normal: Triple,
    /// The normal that light is computed with, of length 1; another one on
    /// meshes with normals alone.
    pub shading_normal: Triple,
    /// Which way the line goes on.
    pub passage: Passage,
    /// Which face (of a polyhedron; a cone's side is 0, the lids at base and top
    /// are 1 and 2) or triangle of a mesh.
    pub face: usize,
    /// How far from a place where the normal is another, as a fraction of the
    /// shape's size; infinite where there is none.
    pub seam: f64,
}

/// All that a line meets of a shape.
#[derive(Clone, Debug)]
pub struct Crossings {
    /// In the order of t; without those that are at infinity.
    pub list: Vec<Crossing>,
    /// About how far the line would have to be moved, as a fraction of the size of
    /// what it nearly meets or misses, for the list to have another length or
    /// another face in it. Decisions are exact, so it is 0 only on the border
    /// itself; a shape counts as closed there. Never more than the truth by much:
    /// where it cannot be had simply, it is less.
    pub margin: f64,
}

/// A crossing in a shape's own stretched space.
pub(crate) struct Local {
    pub(crate) t: Number,
    pub(crate) normal: Triple,
    pub(crate) shading_normal: Option<Triple>,
    pub(crate) passage: Passage,
    pub(crate) face: usize,
    pub(crate) seam: f64,
}

/// What a shape says, before it is brought into the world.
pub(crate) struct Found {
    pub(crate) list: Vec<Local>,
    pub(crate) margin: f64,
}

impl Found {
    pub(crate) fn nothing(margin: f64) -> Self {
        Self { list: vec![], margin }
    }
}

impl Passage {
    /// That of a line along `direction` where a surface has that normal.
    pub(crate) fn through(normal: &Triple, direction: &Triple) -> Self {
        match normal.dot(direction).signum() {
            -1 => Self::Enters,
            1 => Self::Leaves,
            _ => Self::Touches,
        }
    }
}

/// A quotient for margins, which need no more than a double's precision.
pub(crate) fn ratio(a: &Number, b: &Number) -> f64 {
    if b.is_zero() { 0.0 } else { a.abs().over(&b.abs(), 60).to_f64() }
}

/// The sine of the angle between a direction and a plane, at least 0.
pub(crate) fn sine(normal: &Triple, direction: &Triple) -> f64 {
    let product = normal.norm_squared() * direction.norm_squared();
    ratio(&normal.dot(direction).squared(), &product).sqrt()
}
