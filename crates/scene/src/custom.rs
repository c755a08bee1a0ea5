use lancer_math::{Point, Ray, Vector};
use std::fmt;

/// A shape of the user's own, for [`Geometry::Custom`](crate::Geometry::Custom).
///
/// The surface may be open or closed. It is seen from both sides, unless
/// [`nearest`](Self::nearest) leaves hits out, and lit on the side that is seen.
pub trait CustomShape: fmt::Debug + Send + Sync {
    /// Its name in dumps.
    fn name(&self) -> &str;

    /// The distance along the ray to the nearest hit in front of its origin.
    ///
    /// The direction is a unit vector up to rounding. A ray that starts on the
    /// surface, as a shadow or a reflected ray does, must not find the point it
    /// starts from: the origin is exactly the point that an earlier hit's
    /// distance gave, with no offset.
    fn nearest(&self, ray: &Ray) -> Option<f64>;

    /// The unit normal at `point` of the surface, on either side.
    fn normal(&self, point: &Point) -> Vector;

    /// Whether `point` shows the second colour of a checker.
    fn shows_second_colour(&self, point: &Point) -> bool {
        let _ = point;
        false
    }
}
