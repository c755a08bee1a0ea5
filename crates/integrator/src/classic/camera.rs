use super::lanes::{Vectors, each};
use super::naive_unit;
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
    target: Point,
    /// Horizontal, to the right.
    right: Vector,
    /// Upwards in the picture.
    up: Vector,
    /// The size of the image plane in scene lengths.
    plane_width: f64,
    plane_height: f64,
    px_width: f64,
    px_height: f64,
    /// The column whose rays go straight ahead.
    middle_column: f64,
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
        Self {
            origin,
            target,
            right,
            up: right.cross(&ahead),
            plane_width,
            plane_height: f64::from(px_height) * plane_width / f64::from(px_width),
            px_width: f64::from(px_width),
            px_height: f64::from(px_height),
            middle_column: f64::from(px_width / 2),
        }
    }

    /// The ray of the pixel at column `x` and row `y`; row 0 is at the top.
    #[must_use]
    pub fn ray(&self, x: u32, y: u32) -> Ray {
        let latitude = self.latitude(y);
        let longitude = (f64::from(x) - self.middle_column) * self.plane_width / self.px_width;
        let through = self.target + self.up * latitude + self.right * longitude;
        Ray::new(self.origin, naive_unit(through - self.origin))
    }

    /// The directions of the rays of as many pixels as there are lanes, from
    /// column `x` on; those of columns that the picture has not mean nothing.
    #[inline(always)]
    pub(super) fn directions(&self, x: u32, y: u32) -> Vectors {
        let latitude = self.latitude(y);
        let column = each(|k| f64::from(x) + k as f64);
        let longitude = (column - self.middle_column) * self.plane_width / self.px_width;
        let middle = self.target + self.up * latitude;
        let right = &self.right;
        let through = Vectors {
            x: longitude * right.x + middle.x,
            y: longitude * right.y + middle.y,
            z: longitude * right.z + middle.z,
        };
        through.minus(&self.origin).naive_unit()
    }

    fn latitude(&self, y: u32) -> f64 {
        (self.px_height / 2.0 - f64::from(y)) * self.plane_height / self.px_height
    }

    /// Where all rays start.
    #[must_use]
    pub const fn origin(&self) -> Point {
        self.origin
    }
}
