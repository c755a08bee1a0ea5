//! The frames that the language of scenes defines: a camera's, and those that checkers
//! are counted in.

use lancer_math::{Placement, Point, Vector, sin_cos_degrees, unit};
use lancer_scene::{Camera, Cone, Cuboid, Length, Projection};

/// Three vectors from a point: the images of the coordinate axes and of the origin.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame {
    pub(crate) axes: [Vector; 3],
    pub(crate) origin: Point,
}

impl Frame {
    /// Around an axis: n x X (n x Y where n is along X), n times that one, and n.
    pub(crate) fn around(axis: Vector, origin: Point) -> Self {
        // No axis of a shape is zero.
        let axis = unit(axis).unwrap_or_else(Vector::z);
        let across = unit(axis.cross(&Vector::x())).or_else(|| unit(axis.cross(&Vector::y())));
        let first = across.unwrap_or_else(Vector::y);
        Self { axes: [first, axis.cross(&first), axis], origin }
    }

    /// In the plane of two sides: along the first, across it towards the second, and the normal.
    pub(crate) fn of_sides(origin: Point, [first, second]: [Vector; 2]) -> Self {
        let along = unit(first).unwrap_or_else(Vector::x);
        let sideward = unit(second).unwrap_or_else(Vector::y);
        let normal = unit(along.cross(&sideward)).unwrap_or_else(Vector::z);
        Self { axes: [along, normal.cross(&along), normal], origin }
    }

    /// The coordinate axes at a point.
    pub(crate) fn at(origin: Point) -> Self {
        Self { axes: [Vector::x(), Vector::y(), Vector::z()], origin }
    }

    /// As a placement moves it.
    pub(crate) fn placed(&self, placement: &Placement) -> Self {
        Self {
            axes: self.axes.map(|axis| placement.vector(&axis)),
            origin: placement.point(&self.origin),
        }
    }

    /// The images of the coordinate axes under a placement.
    pub(crate) fn of(placement: &Placement) -> Self {
        Self::at(Point::origin()).placed(placement)
    }
}

/// What a camera sees: its axis, to the right and upward in the picture, of length 1.
pub(crate) struct View {
    pub(crate) origin: Point,
    pub(crate) axis: Vector,
    pub(crate) right: Vector,
    pub(crate) up: Vector,
    /// The diameter of the lens; 0 for a pinhole.
    pub(crate) aperture: f64,
    /// How far along the axis the plane is that is seen sharply.
    pub(crate) focus: f64,
    /// From the eye to the target.
    pub(crate) distance: f64,
    /// Of the plane through the target, or for parallel rays through the origin.
    pub(crate) width: f64,
    pub(crate) is_parallel: bool,
}

impl View {
    pub(crate) fn new(camera: &Camera) -> Self {
        let origin = camera.origin().get();
        let ahead = camera.target().get() - origin;
        // Neither is zero in a camera.
        let axis = unit(ahead).unwrap_or_else(Vector::y);
        let upward = unit(camera.up.get()).unwrap_or_else(Vector::z);
        let right = unit_beyond_rounding(axis.cross(&upward)).unwrap_or_else(|| {
            // The view is along `up`: the axis that is least along the view, y before x before z.
            let least = [Vector::y(), Vector::x(), Vector::z()]
                .into_iter()
                .min_by(|a, b| {
                    let along = |v: &Vector| (axis.dot(v).abs() / ALONG).floor();
                    along(a).total_cmp(&along(b))
                })
                .unwrap_or_else(Vector::y);
            unit(axis.cross(&least)).unwrap_or_else(Vector::x)
        });
        let up = right.cross(&axis);
        let (sine, cosine) = sin_cos_degrees(camera.roll.get());
        Self {
            origin,
            axis,
            right: right * cosine - up * sine,
            up: up * cosine + right * sine,
            aperture: camera.aperture.map_or(0.0, Length::get),
            focus: camera.focus.map_or_else(|| ahead.norm(), Length::get),
            distance: ahead.norm(),
            width: camera.plane_width(),
            is_parallel: matches!(camera.projection, Projection::Orthographic(_)),
        }
    }
}

/// What counts as along.
const ALONG: f64 = 8.881_784_197_001_252e-16; // 2^-50

fn unit_beyond_rounding(v: Vector) -> Option<Vector> {
    if v.amax() > ALONG { unit(v) } else { None }
}

/// How far a cone's radius grows for each unit of length along its axis, and that length.
pub(crate) fn slope(cone: &Cone) -> (f64, f64) {
    let length = (cone.top() - cone.base()).norm();
    ((cone.top_radius() - cone.base_radius()) / length, length)
}

/// The sides of a box.
pub(crate) fn sides(cuboid: &Cuboid) -> Vector {
    cuboid.max() - cuboid.min()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_as_the_manual_defines_them() {
        let frame = Frame::around(Vector::new(0.0, 0.0, 2.0), Point::origin());
        assert_eq!(frame.axes, [Vector::y(), -Vector::x(), Vector::z()]);
        let along_x = Frame::around(Vector::x(), Point::origin());
        assert_eq!(along_x.axes, [Vector::z(), -Vector::y(), Vector::x()]);
        let sides = [Vector::new(2.0, 0.0, 0.0), Vector::new(1.0, 3.0, 0.0)];
        let flat = Frame::of_sides(Point::origin(), sides);
        assert_eq!(flat.axes, [Vector::x(), Vector::y(), Vector::z()]);
    }

    #[test]
    fn cameras_that_look_along_their_upward_direction_have_y_up() {
        for (target, right, up) in [
            ([0.0, 0.0, -5.0], Vector::x(), Vector::y()),
            ([0.0, 0.0, 5.0], -Vector::x(), Vector::y()),
            ([0.0, 7.0, 0.0], Vector::x(), Vector::z()),
        ] {
            let camera = Camera::new([0.0; 3], target, 1.0, [4, 3]).expect("valid");
            let view = View::new(&camera);
            assert_eq!((view.right, view.up), (right, up));
        }
        let camera = Camera::new([0.0; 3], [0.0, 1.0, 0.0], 1.0, [4, 3]).expect("valid");
        let view = View::new(&camera.up([0.0, 1.0, 0.0]).expect("valid"));
        // Along y, x is least of the two others.
        assert_eq!(view.right, Vector::y().cross(&Vector::x()));
        let camera = Camera::new([0.0; 3], [0.0, 1.0, 0.0], 1.0, [4, 3]).expect("valid");
        let view = View::new(&camera.roll(90.0).expect("finite"));
        assert_eq!((view.right, view.up), (-Vector::z(), Vector::x()));
    }
}
