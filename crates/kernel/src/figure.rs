//! What can be told of a shape by itself, without rays.

use crate::KernelSettings;
use crate::primitive::Primitive;
use crate::shapes::primitive;
use crate::shapes::sphere::Ball;
use lancer_math::{Bounds, Point};
use lancer_scene::{Geometry, Shape};

/// A box around a shape, rounded outward, in the space that it is described in; `None` where it has
/// no end.
#[must_use]
pub fn bounds(shape: &Shape) -> Option<Bounds> {
    match &shape.geometry {
        // Without making its triangles ready.
        Geometry::Mesh(mesh) => {
            let (min, max) = mesh.bounds();
            Some(Bounds { min, max })
        }
        // Often many: without memory of its own.
        Geometry::Sphere(sphere) => Ball::new(sphere).bounds(),
        geometry => primitive(geometry, &KernelSettings::default()).bounds(),
    }
}

/// Whether a point is inside of a shape; never where that has no inside.
#[must_use]
pub fn encloses(shape: &Shape, point: &Point) -> bool {
    let may = |bounds: Bounds| bounds.contains(point);
    // A mesh finds out by looking at all its edges: only where it matters.
    bounds(shape).is_none_or(may)
        && shape.geometry.is_closed()
        && primitive(&shape.geometry, &KernelSettings::default()).contains(point)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lancer_scene::{Colour, Surface};

    #[test]
    fn shapes_have_bounds_and_insides() {
        let grey = Surface::new(Colour::WHITE);
        let ball = Shape::sphere([1.0, 2.0, 3.0], 0.5, grey).expect("valid");
        let plane = Shape::plane([0.0; 3], [0.0, 0.0, 1.0], grey).expect("valid");
        let sheet = Shape::disc([0.0; 3], [0.0, 0.0, 1.0], 1.0, grey).expect("valid");
        let around = bounds(&ball).expect("it has an end");
        assert!(around.contains(&Point::new(1.5, 2.0, 3.0)));
        assert!((around.sides().amax() - 1.0).abs() < 1e-12);
        assert!(bounds(&plane).is_none());
        let at = |x, y, z| Point::new(x, y, z);
        assert!(encloses(&ball, &at(1.3, 2.0, 3.0)) && !encloses(&ball, &at(1.4, 2.4, 3.0)));
        assert!(encloses(&plane, &at(5.0, 5.0, -1.0)) && !encloses(&plane, &at(5.0, 5.0, 1.0)));
        assert!(!encloses(&sheet, &at(0.0, 0.0, 0.0)));
    }
}
