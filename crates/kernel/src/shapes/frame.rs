use lancer_math::{Vector, unit};

/// Three perpendicular unit vectors: an axis, and two across it from which
/// angles and the squares of checkers are measured.
///
/// The first one across is that of axis x X, or of axis x Y where the axis is
/// along X. Axis x X has components of the axis as they are, so that it has all
/// its digits however near to X the axis is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame {
    pub(crate) first: Vector,
    /// axis x first.
    pub(crate) second: Vector,
    pub(crate) axis: Vector,
}

impl Frame {
    /// The frame of a unit vector.
    pub(crate) fn new(axis: Vector) -> Self {
        let first = unit(axis.cross(&Vector::x()))
            .or_else(|| unit(axis.cross(&Vector::y())))
            // Not of a unit vector.
            .unwrap_or_else(Vector::y);
        Self { first, second: axis.cross(&first), axis }
    }

    /// How far `v` reaches along each of the three.
    #[inline]
    pub(crate) fn local(&self, v: &Vector) -> Vector {
        Vector::new(self.first.dot(v), self.second.dot(v), self.axis.dot(v))
    }
}

/// Half the sides of the box around a circle of radius 1 across a unit vector:
/// along a coordinate axis, the root of 1 minus the squared component.
pub(crate) fn across(axis: &Vector) -> Vector {
    let squares = axis.component_mul(axis);
    Vector::new(squares.y + squares.z, squares.z + squares.x, squares.x + squares.y).map(f64::sqrt)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_perpendicular() {
        for (x, y, z) in [
            (1.0, 0.0, 0.0),
            (-1.0, 0.0, 0.0),
            (0.0, 1.0, 0.0),
            (0.0, 0.0, -1.0),
            (1.0, 1e-200, 0.0),
            (1.0, 1e-9, -2e-9),
            (0.3, -0.5, 0.9),
        ] {
            let axis = unit(Vector::new(x, y, z)).unwrap();
            let frame = Frame::new(axis);
            let size = frame.local(&frame.first) - Vector::x();
            assert!(size.amax() < 4e-16, "{axis}");
            assert!((frame.local(&frame.second) - Vector::y()).amax() < 4e-16, "{axis}");
            assert!((frame.first.cross(&frame.second) - axis).amax() < 4e-16, "{axis}");
        }
        // Neither is lost where the axis is nearly X.
        let frame = Frame::new(unit(Vector::new(1.0, 1e-200, 0.0)).unwrap());
        assert_eq!((frame.first, frame.second), (-Vector::z(), Vector::new(-1e-200, 1.0, 0.0)));
    }
}
