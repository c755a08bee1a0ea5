use super::tile::units;
use crate::Stream;
use crate::disc::in_disc;
use lancer_kernel::lanes::{Lanes, Vectors};
use lancer_kernel::{LEAN, not_lean};
use lancer_math::{Point, Ray, Vector, sin_cos_degrees, unit};
use lancer_scene::{Camera, Projection};

/// Which ray belongs to which place of the picture.
///
/// Pixel (x, y) covers the places from x to x + 1 and from y to y + 1; row 0 is
/// at the top. Places left and right of the middle have rays that are mirror
/// images to the last bit, and so have those above and below.
#[derive(Debug, Clone)]
pub(super) struct View {
    origin: Point,
    /// To the middle of the image plane, or of length 1 for parallel rays.
    ahead: Vector,
    /// Of length 1.
    axis: Vector,
    right: Vector,
    up: Vector,
    is_parallel: bool,
    lens: Option<Lens>,
    /// Half the side of a pixel on the image plane.
    half_pixel: f64,
    px_width: f64,
    px_height: f64,
}

/// A thin lens across the view, around the eye, or around the start of each parallel ray. All
/// rays of a place of the picture meet in the plane in focus.
#[derive(Debug, Clone, Copy)]
struct Lens {
    radius: f64,
    /// How far the plane in focus is, as a multiple of `ahead`.
    focus: f64,
}

/// Below this the view is along the camera's upward direction: 2^-50.
const ALONG: f64 = 8.881_784_197_001_252e-16;

impl View {
    pub(super) fn new(camera: &Camera) -> Self {
        let origin = camera.origin().get();
        let to_target = camera.target().get() - origin;
        // The target is another point, so there is a direction.
        let axis = unit(to_target).unwrap_or_else(Vector::y);
        let (right, up) = frame(axis, camera.up.get(), camera.roll.get());
        let is_parallel = matches!(camera.projection, Projection::Orthographic(_));
        let ahead = if is_parallel { axis } else { to_target };
        let lens = camera.aperture.map(|aperture| Lens {
            radius: 0.5 * aperture.get(),
            focus: match camera.focus {
                Some(focus) => focus.get() / ahead.norm(),
                None if is_parallel => to_target.norm(),
                None => 1.0,
            },
        });
        let (px_width, px_height) = (camera.px_width.get(), camera.px_height.get());
        if is_parallel || lens.is_some() {
            not_lean();
        }
        Self {
            origin,
            ahead,
            axis,
            right,
            up,
            is_parallel,
            lens,
            half_pixel: camera.plane_width() / (2.0 * f64::from(px_width)),
            px_width: f64::from(px_width),
            px_height: f64::from(px_height),
        }
    }

    /// The ray of a place of the picture, in pixels from its top left corner;
    /// its direction is of length 1.
    pub(super) fn ray(&self, x: f64, y: f64) -> Ray {
        let sideward = self.right * ((2.0 * x - self.px_width) * self.half_pixel);
        let upward = self.up * ((self.px_height - 2.0 * y) * self.half_pixel);
        if self.is_parallel() {
            return Ray::new(self.origin + (sideward + upward), self.ahead);
        }
        let direction = self.ahead + (sideward + upward);
        Ray::new(self.origin, unit(direction).unwrap_or(self.axis))
    }

    /// The ray of a place of the picture through the point of the lens, if there is one, that
    /// a sample's numbers draw.
    pub(super) fn ray_of_sample(&self, [x, y]: [f64; 2], stream: Stream) -> Ray {
        let Some(lens) = self.lens.as_ref().filter(|_| !LEAN) else { return self.ray(x, y) };
        let [a, b] = in_disc(stream.pair(1)).map(|c| c * lens.radius);
        let off = self.right * a + self.up * b;
        let sideward = self.right * ((2.0 * x - self.px_width) * self.half_pixel);
        let upward = self.up * ((self.px_height - 2.0 * y) * self.half_pixel);
        let aside = sideward + upward;
        let (start, to_sharp) = if self.is_parallel() {
            (self.origin + aside, self.ahead * lens.focus)
        } else {
            (self.origin, (self.ahead + aside) * lens.focus)
        };
        Ray::new(start + off, unit(to_sharp - off).unwrap_or(self.axis))
    }

    /// Rays of which all others are made: each starts between the points where these do, and its
    /// direction is a sum of theirs with weights that are not negative. They are of the corners of
    /// the frame, a pixel off, and of a square around the lens.
    pub(super) fn outermost(&self) -> Vec<Ray> {
        let radius = self.lens.map_or(0.0, |lens| lens.radius);
        let offsets: &[(f64, f64)] = match self.lens {
            None => &[(0.0, 0.0)],
            Some(_) => &[(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)],
        };
        let focus = self.lens.map_or(1.0, |lens| lens.focus);
        let mut rays = Vec::new();
        for (x, y) in [-1.0, self.px_width + 1.0]
            .into_iter()
            .flat_map(|x| [-1.0, self.px_height + 1.0].map(|y| (x, y)))
        {
            let sideward = self.right * ((2.0 * x - self.px_width) * self.half_pixel);
            let upward = self.up * ((self.px_height - 2.0 * y) * self.half_pixel);
            let aside = sideward + upward;
            for (a, b) in offsets {
                let off = self.right * (a * radius) + self.up * (b * radius);
                rays.push(if self.is_parallel() {
                    let direction = self.ahead * focus - off;
                    Ray::new(self.origin + aside + off, direction)
                } else {
                    Ray::new(self.origin + off, (self.ahead + aside) * focus - off)
                });
            }
        }
        rays
    }

    /// Whether there is a lens.
    pub(super) const fn has_lens(&self) -> bool {
        !LEAN && self.lens.is_some()
    }

    const fn is_parallel(&self) -> bool {
        !LEAN && self.is_parallel
    }

    /// Rays without a lens for several places: a lane has the bits of [`ray`](Self::ray).
    #[inline(always)]
    pub(super) fn rays<L: Lanes>(
        &self,
        lanes: L,
        x: L::Real,
        y: L::Real,
    ) -> (Vectors<L::Real>, Vectors<L::Real>) {
        let [right, up, ahead, axis] = [&self.right, &self.up, &self.ahead, &self.axis].map(
            #[inline(always)]
            |v| Vectors::splat(lanes, v),
        );
        let origin = Vectors::splat_point(lanes, &self.origin);
        let half = lanes.splat(self.half_pixel);
        let sideward = right * ((x * 2.0 - self.px_width) * half);
        let upward = up * ((lanes.splat(self.px_height) - y * 2.0) * half);
        if self.is_parallel() {
            return (origin + (sideward + upward), ahead);
        }
        (origin, units(lanes, &(ahead + (sideward + upward)), &axis))
    }

    /// Where all rays start; `None` for parallel ones and for those of a lens.
    pub(super) fn eye(&self) -> Option<Point> {
        (!self.is_parallel() && !self.has_lens()).then_some(self.origin)
    }

    /// The direction of the middle of the picture, of length 1.
    pub(super) const fn axis(&self) -> Vector {
        self.axis
    }
}

/// The directions to the right and upward in the picture, both of length 1.
///
/// Where the view is along `up` (its sine is at most 2^-50), the coordinate
/// axis that is least along the view takes its place, y before x before z where
/// they are equally so: a camera that looks straight down has y upward, as on a
/// map.
fn frame(axis: Vector, up: Vector, roll: f64) -> (Vector, Vector) {
    // Never zero in a camera.
    let up = unit(up).unwrap_or_else(Vector::z);
    let mut right = axis.cross(&up);
    if right.amax() <= ALONG {
        let mut least = Vector::y();
        for other in [Vector::x(), Vector::z()] {
            // By more than what counts as along.
            if axis.dot(&other).abs() + ALONG < axis.dot(&least).abs() {
                least = other;
            }
        }
        right = axis.cross(&least);
    }
    let right = unit(right).unwrap_or_else(Vector::x);
    let up = right.cross(&axis);
    if roll == 0.0 {
        return (right, up);
    }
    // Clockwise as seen from behind: the right side goes down.
    let (sine, cosine) = sin_cos_degrees(roll);
    (right * cosine - up * sine, up * cosine + right * sine)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(target: [f64; 3]) -> Camera {
        Camera::new([0.0; 3], target, 2.0, [64, 48]).expect("valid")
    }

    #[test]
    fn the_middle_is_ahead_and_the_edges_are_where_they_should_be() {
        let view = View::new(&camera([0.0, 4.0, 0.0]));
        assert_eq!(view.ray(32.0, 24.0).direction, Vector::y());
        let left = view.ray(0.0, 24.0).direction;
        assert!((left.x / left.y - -0.25).abs() < 1e-16 && left.z == 0.0);
        let top = view.ray(32.0, 0.0).direction;
        assert!((top.z / top.y - 0.1875).abs() < 1e-16 && top.x == 0.0);
    }

    #[test]
    fn pictures_are_symmetric_to_the_bit() {
        let view = View::new(&camera([0.0, 4.0, 0.0]));
        for (x, y) in [(0.5, 0.5), (13.5, 7.5), (31.5, 23.5)] {
            let d = view.ray(x, y).direction;
            assert_eq!(view.ray(64.0 - x, y).direction, Vector::new(-d.x, d.y, d.z));
            assert_eq!(view.ray(x, 48.0 - y).direction, Vector::new(d.x, d.y, -d.z));
        }
    }

    #[test]
    fn a_field_of_view_is_from_edge_to_edge() {
        let camera = camera([3.0, 4.0, 12.0]).field_of_view(70.0).expect("in range");
        let view = View::new(&camera);
        let (left, right) = (view.ray(0.0, 24.0), view.ray(64.0, 24.0));
        let angle = libm::acos(left.direction.dot(&right.direction)).to_degrees();
        assert!((angle - 70.0).abs() < 1e-12, "{angle}");
    }

    #[test]
    fn straight_down_y_is_up_and_so_it_is_nearly_down() {
        for tilt in [0.0, 1e-17, 1e-12, 1e-6, 1e-3] {
            let view = View::new(&camera([0.0, tilt, -5.0]));
            assert!((view.right - Vector::x()).amax() < 1e-15, "{tilt}");
            assert!((view.up - Vector::y()).amax() < 2e-3 && view.up.y > 0.99, "{tilt}");
        }
        let up = View::new(&camera([0.0, 0.0, 5.0]));
        assert_eq!((up.right, up.up), (-Vector::x(), Vector::y()));
        for target in [[1.0, 2.0, 3.0], [0.0, 0.0, -1.0], [1e-200, 0.0, 3e-200], [1e200; 3]] {
            let view = View::new(&camera(target));
            for (a, b) in [(view.right, view.up), (view.up, view.axis), (view.axis, view.right)] {
                assert!(a.dot(&b).abs() < 1e-15 && (a.norm() - 1.0).abs() < 1e-15, "{target:?}");
            }
        }
    }

    #[test]
    fn a_rolled_camera_leans_to_its_right() {
        let camera = camera([0.0, 1.0, 0.0]).roll(90.0).expect("finite");
        let view = View::new(&camera);
        assert_eq!((view.right, view.up), (-Vector::z(), Vector::x()));
    }

    #[test]
    fn parallel_rays_start_side_by_side() {
        let camera = camera([0.0, 4.0, 0.0]).orthographic(8.0).expect("in range");
        let view = View::new(&camera);
        let ray = view.ray(0.0, 24.0);
        assert_eq!((ray.origin, ray.direction), (Point::new(-4.0, 0.0, 0.0), Vector::y()));
        assert_eq!(view.eye(), None);
    }
}
