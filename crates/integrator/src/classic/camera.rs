use super::naive_unit;
use super::vectors::{after, unit};
use lancer_kernel::lanes::{Lanes, One, Vectors};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::Camera;

/// The original's camera: which ray belongs to which pixel.
///
/// The ray of pixel (x, y) goes through the pixel's top left corner, not its
/// centre; with an odd number of columns the picture is off its axis by half a
/// pixel.
#[derive(Debug, Clone)]
pub struct PinholeCamera {
    origin: Point,
    /// To the target, on the image plane.
    ahead: Vector,
    /// Horizontal, to the right.
    right: Vector,
    /// Upwards in the picture.
    up: Vector,
    /// The sides of a pixel on the image plane, in scene lengths.
    column_width: f64,
    row_height: f64,
    /// The column and the row whose rays go straight ahead.
    middle_column: f64,
    middle_row: f64,
}

/// The horizontal direction to the right of `ahead`; NaN where that is
/// vertical.
pub(super) fn horizontal(ahead: Vector) -> Vector {
    naive_unit(Vector::new(ahead.y, -ahead.x, 0.0))
}

impl PinholeCamera {
    /// The camera that the scene describes.
    #[must_use]
    pub fn new(camera: &Camera) -> Self {
        let (origin, target) = (camera.origin().get(), camera.target().get());
        let ahead = naive_unit(target - origin);
        let right = horizontal(ahead);
        let (px_width, px_height) = (camera.px_width.get(), camera.px_height.get());
        let plane_width = camera.plane_width();
        let plane_height = f64::from(px_height) * plane_width / f64::from(px_width);
        Self {
            origin,
            ahead: target - origin,
            right,
            up: right.cross(&ahead),
            column_width: plane_width / f64::from(px_width),
            row_height: plane_height / f64::from(px_height),
            middle_column: f64::from(px_width / 2),
            middle_row: f64::from(px_height) / 2.0,
        }
    }

    /// The ray of the pixel at column `x` and row `y`; row 0 is at the top.
    #[must_use]
    pub fn ray(&self, x: u32, y: u32) -> Ray {
        let direction = self.directions(One, f64::from(x), y);
        Ray::new(self.origin, direction.into())
    }

    /// The directions of the rays of the pixels at those columns of row `y`.
    #[inline(always)]
    pub(super) fn directions<L: Lanes>(
        &self,
        lanes: L,
        columns: L::Real,
        y: u32,
    ) -> Vectors<L::Real> {
        let latitude = (self.middle_row - f64::from(y)) * self.row_height;
        let middle: Vector = after(&self.ahead.into(), latitude, &self.up.into()).into();
        let longitude = (columns - self.middle_column) * self.column_width;
        let right = Vectors::splat(lanes, &self.right);
        unit(lanes, &after(&Vectors::splat(lanes, &middle), longitude, &right))
    }

    /// Where all rays start.
    #[must_use]
    pub const fn origin(&self) -> Point {
        self.origin
    }
}
