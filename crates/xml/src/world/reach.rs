//! Whether the placements of groups in groups multiply to finite numbers.

use lancer_math::{Point, Vector};
use lancer_scene::Placed;

/// Bounds on the numbers of all placements between a group and the shapes
/// in it, at any depth.
///
/// Each is of a norm (the largest sum of a row) for which that of a product is at
/// most the product of both. So while these are finite, so are all placements,
/// and one that is not is found without looking at each path through groups that
/// hold others several times, of which there may be millions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Reach {
    matrix: f64,
    offset: f64,
    inverse: f64,
}

impl Reach {
    /// That of a shape.
    pub(super) const SHAPE: Self = Self { matrix: 1.0, offset: 0.0, inverse: 1.0 };

    /// The bounds seen from outside of a placement of what has these bounds.
    pub(super) fn placed(self, placed: &Placed) -> Self {
        let axes = [Vector::x(), Vector::y(), Vector::z()];
        let matrix = norm(axes.map(|axis| placed.placement.vector(&axis)));
        let inverse = norm(axes.map(|axis| placed.placement.local_vector(&axis)));
        let offset = placed.placement.point(&Point::origin()).coords.amax();
        Self {
            matrix: matrix * self.matrix,
            offset: matrix * self.offset + offset,
            inverse: self.inverse * inverse,
        }
    }

    /// The bounds of both together.
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            matrix: self.matrix.max(other.matrix),
            offset: self.offset.max(other.offset),
            inverse: self.inverse.max(other.inverse),
        }
    }

    pub(super) fn is_finite(self) -> bool {
        self.matrix.is_finite() && self.offset.is_finite() && self.inverse.is_finite()
    }
}

/// The largest sum of a row of the matrix with these columns.
fn norm(columns: [Vector; 3]) -> f64 {
    columns.iter().fold(Vector::zeros(), |sum, column| sum + column.abs()).amax()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lancer_math::Placement;
    use lancer_scene::Group;
    use std::sync::Arc;

    fn placed(placement: Placement) -> Placed {
        let group = Group::new(None, Vec::new(), Vec::new()).expect("small");
        Placed { placement, group: Arc::new(group) }
    }

    #[test]
    fn bounds_hold_for_products() {
        let turn = Placement::rotate(Vector::new(1.0, 2.0, 3.0), 40.0).expect("an axis");
        let grow = Placement::scale(Vector::new(3.0, -0.5, 2.0)).expect("not flat");
        let step = Placement::translate(Vector::new(1.0, -7.0, 2.0));
        let first = turn.then(&step);
        let second = grow.then(&turn).then(&step);
        let reach = Reach::SHAPE.placed(&placed(first)).placed(&placed(second));
        let both = first.then(&second);
        assert!(both.point(&Point::origin()).coords.amax() <= reach.offset);
        for axis in [Vector::x(), Vector::y(), Vector::z()] {
            assert!(both.vector(&axis).amax() <= reach.matrix);
            assert!(both.local_vector(&axis).amax() <= reach.inverse);
        }
        assert!(reach.matrix < 30.0 && reach.inverse < 20.0, "no bounds to speak of: {reach:?}");
    }

    #[test]
    fn what_grows_out_of_all_numbers_is_seen() {
        for factor in [1e200, 1e-200] {
            let scale = Placement::scale(Vector::repeat(factor)).expect("not flat");
            let once = Reach::SHAPE.placed(&placed(scale));
            assert!(once.is_finite());
            assert!(!once.placed(&placed(scale)).is_finite(), "{factor}");
        }
    }
}
