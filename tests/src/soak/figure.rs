//! What a shape is to the test: all its crossings with a line, each with how
//! sure it is.

use super::dd::Dd;
use super::space::{Line, Long};

/// A crossing, or a place where there nearly is one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Crossing {
    pub(crate) t: Dd,
    /// Which of the smooth surfaces of the shape.
    pub(crate) part: usize,
    /// Whether there is one.
    pub(crate) is_there: bool,
    /// How far the ray would have to be moved aside for that to change, to within
    /// a factor of two or so, as a share of [`Line::scale`].
    pub(crate) margin: f64,
    /// By how much more than usual `t` may be off: where the ray runs so near to
    /// an edge that either side of it may be found.
    pub(crate) slack: f64,
}

impl Crossing {
    pub(crate) fn new(t: Dd, part: usize, is_there: bool, margin: f64) -> Self {
        Self { t, part, is_there, margin, slack: 0.0 }
    }
}

/// Whether a crossing is there may be found either way where moving the ray by
/// this share of the size of the scene seen from it changes the answer: at a
/// silhouette, at the edge of a sheet, at the tip of a cone.
///
/// The roundings of a double come to 1.1e-16 of a coordinate each; a product of
/// three with sums has about ten, and those of a shape's own preparation (axes
/// and normals of unit length) come on top, more where a triangle is thin. Each
/// soak prints the widest margin at which it saw the other answer, and
/// [`Kind::widest`](super::Kind::widest) says how wide it may be for each kind: hardly more
/// than roundings for most, nearly all of this for rings, open tubes and meshes.
pub(crate) const BAND: f64 = 3e-14;

/// What would change by so little is reported by [`Figure::crossings`]: sixteen times
/// the band.
pub(crate) const NEAR: f64 = 16.0 * BAND;

/// By this share of the size of the scene seen from a ray its own roundings may move
/// it; the crossing moves by 1 / |cos| of that.
pub(crate) const WAVER: f64 = 4e-15;

/// A shape, described anew.
pub(crate) trait Figure: std::fmt::Debug {
    /// All crossings of the whole line, those behind its origin too, in any
    /// order, and those that are not there by less than [`NEAR`].
    fn crossings(&self, line: &Line, found: &mut Vec<Crossing>);

    /// The distance from a part (continued beyond its edges), positive on the
    /// side to which its normal points.
    fn side(&self, part: usize, point: Long) -> Dd;

    /// No less than how far a point is from the whole surface, edges included, where
    /// it is near.
    fn off(&self, point: Long) -> f64;

    /// The unit normal of a part at the point of it that is nearest: outward where
    /// the shape is closed, else as it was described.
    fn normal(&self, part: usize, point: Long) -> Long;

    /// The parts that come so near to a point, where more than one may.
    fn parts_near(&self, _point: Long, _within: f64) -> Vec<usize> {
        Vec::new()
    }

    /// Whether every line crosses it an even number of times.
    fn is_closed(&self) -> bool;
}
