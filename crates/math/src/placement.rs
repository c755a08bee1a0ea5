use crate::{Bounds, Point, Vector, sin_cos_degrees, unit};
use nalgebra::Matrix3;

/// An invertible affine map: where a thing that was described in its own
/// space stands in the world (or in the group around it).
///
/// A local point p is at `matrix * p + offset`. The inverse is carried along,
/// built from the inverses of the steps, so that it is exact where they are
/// (moves, mirrors, quarter turns, scales by powers of two).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    matrix: Matrix3<f64>,
    inverse: Matrix3<f64>,
    offset: Vector,
}

impl Placement {
    /// Leaves everything where it is.
    pub const IDENTITY: Self = Self {
        matrix: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        inverse: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        offset: Vector::new(0.0, 0.0, 0.0),
    };

    /// Moves by `offset`.
    #[must_use]
    pub fn translate(offset: Vector) -> Self {
        Self { offset, ..Self::IDENTITY }
    }

    /// Stretches along the axes; a negative factor mirrors. `None` where a
    /// factor is 0 or not finite, or so small that its inverse is not.
    #[must_use]
    pub fn scale(factors: Vector) -> Option<Self> {
        let inverses = factors.map(|f| 1.0 / f);
        let fine = factors.iter().chain(inverses.iter()).all(|f| f.is_finite() && *f != 0.0);
        fine.then(|| Self {
            matrix: Matrix3::from_diagonal(&factors),
            inverse: Matrix3::from_diagonal(&inverses),
            offset: Vector::zeros(),
        })
    }

    /// Turns about `axis` through the origin, by `degrees`, counterclockwise
    /// where the axis points at the viewer (Rodrigues' formula). Quarter turns
    /// about coordinate axes are exact. `None` where the axis is zero or not
    /// finite.
    #[must_use]
    pub fn rotate(axis: Vector, degrees: f64) -> Option<Self> {
        let axis = unit(axis)?;
        let (sine, cosine) = sin_cos_degrees(degrees);
        let cross = Matrix3::new(
            0.0, -axis.z, axis.y, //
            axis.z, 0.0, -axis.x, //
            -axis.y, axis.x, 0.0,
        );
        let outer = axis * axis.transpose();
        let matrix = Matrix3::identity() * cosine + cross * sine + outer * (1.0 - cosine);
        degrees.is_finite().then(|| Self {
            matrix,
            inverse: matrix.transpose(),
            offset: Vector::zeros(),
        })
    }

    /// The map with that matrix: three rows of four numbers, the fourth of
    /// which is the offset. `None` where a number is not finite or the map
    /// flattens space.
    #[must_use]
    pub fn from_rows(rows: [[f64; 4]; 3]) -> Option<Self> {
        let matrix = Matrix3::from_fn(|row, column| rows[row][column]);
        let offset = Vector::new(rows[0][3], rows[1][3], rows[2][3]);
        // Flat or not is a question of shape, not of size.
        let size = matrix.amax();
        if !(size > 0.0 && size.is_finite() && offset.iter().all(|c| c.is_finite())) {
            return None;
        }
        let shape = matrix / size;
        let inverse = shape.try_inverse()? / size;
        let columns = [0, 1, 2].map(|i| unit(shape.column(i).into_owned()));
        let [x, y, z] = [columns[0]?, columns[1]?, columns[2]?];
        let flat = x.dot(&y.cross(&z)).abs() < 1e-12;
        (!flat && inverse.iter().all(|c| c.is_finite())).then_some(Self { matrix, inverse, offset })
    }

    /// First this map, then `outer`.
    #[must_use]
    pub fn then(&self, outer: &Self) -> Self {
        Self {
            matrix: outer.matrix * self.matrix,
            inverse: self.inverse * outer.inverse,
            offset: outer.matrix * self.offset + outer.offset,
        }
    }

    /// Whether it leaves everything where it is.
    #[must_use]
    pub fn is_identity(&self) -> bool {
        *self == Self::IDENTITY
    }

    /// Whether all its numbers are finite; a product of large ones may not be.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.matrix
            .iter()
            .chain(self.inverse.iter())
            .chain(self.offset.iter())
            .all(|c| c.is_finite())
    }

    /// Where the local point `p` is outside.
    #[inline]
    #[must_use]
    pub fn point(&self, p: &Point) -> Point {
        Point::from(self.matrix * p.coords + self.offset)
    }

    /// Which local point is outside at `p`.
    ///
    /// The offset is subtracted first, so that far from the origin no digits
    /// are lost to it twice.
    #[inline]
    #[must_use]
    pub fn local_point(&self, p: &Point) -> Point {
        Point::from(self.inverse * (p.coords - self.offset))
    }

    /// The displacement outside of a local one.
    #[inline]
    #[must_use]
    pub fn vector(&self, v: &Vector) -> Vector {
        self.matrix * v
    }

    /// The local displacement of one outside.
    #[inline]
    #[must_use]
    pub fn local_vector(&self, v: &Vector) -> Vector {
        self.inverse * v
    }

    /// The direction outside, of any length, of a local normal: by the
    /// inverse's transpose, so that it stays perpendicular to its surface.
    #[inline]
    #[must_use]
    pub fn normal(&self, n: &Vector) -> Vector {
        self.inverse.tr_mul(n)
    }

    /// The factor by which volumes grow; never negative.
    #[must_use]
    pub fn volume_factor(&self) -> f64 {
        self.matrix.determinant().abs()
    }

    /// A bound on how far from the exact place [`point`](Self::point) puts a
    /// local point whose distance from its own exact place is at most `error`
    /// in each coordinate, plus as much as it takes to come back by
    /// [`local_point`](Self::local_point).
    #[must_use]
    pub fn error_of(&self, local: &Point, outside: &Point, error: f64) -> f64 {
        // Four roundings of sums of three products each way.
        const UNIT: f64 = 6.0 * f64::EPSILON;
        let rows = |m: &Matrix3<f64>| m.abs().column_sum().amax();
        let forth = self.matrix.abs() * local.coords.abs() + self.offset.abs();
        let back = self.inverse.abs() * (outside.coords.abs() + self.offset.abs());
        let stretch = rows(&self.matrix);
        stretch * error + UNIT * forth.amax() + stretch * UNIT * back.amax()
    }

    /// A box around where the points of a box are outside, rounded outward.
    #[must_use]
    pub fn bounds(&self, local: &Bounds) -> Bounds {
        let outside = Bounds::around(local.corners().iter().map(|corner| self.point(corner)));
        let slack = self.matrix.abs() * local.min.coords.abs().sup(&local.max.coords.abs())
            + self.offset.abs();
        outside.grown(slack * (8.0 * f64::EPSILON))
    }
}

impl Default for Placement {
    fn default() -> Self {
        Self::IDENTITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> [Placement; 5] {
        let rows = [[1.0, 0.5, 0.0, 3.0], [0.0, 2.0, -1.0, 0.25], [0.3, 0.0, 1.5, -7.0]];
        let tilted = Placement::rotate(Vector::new(1.0, 2.0, -0.5), 37.0).expect("an axis");
        let scaled = Placement::scale(Vector::new(2.0, -0.5, 3.0)).expect("not flat");
        [
            Placement::IDENTITY,
            Placement::translate(Vector::new(1e3, -2.0, 0.1)),
            tilted,
            tilted.then(&scaled).then(&Placement::translate(Vector::new(5.0, 6.0, 7.0))),
            Placement::from_rows(rows).expect("not flat"),
        ]
    }

    #[test]
    fn the_inverse_leads_back_within_the_bound() {
        let p = Point::new(0.3, -4.0, 2.5);
        for placement in all() {
            let outside = placement.point(&p);
            let back = placement.local_point(&outside);
            let bound = placement.error_of(&p, &outside, 0.0);
            assert!((placement.point(&back) - outside).amax() <= bound, "{placement:?}");
            assert!(bound < 1e-11, "{bound:e} is no bound to speak of");
        }
    }

    #[test]
    fn steps_are_made_in_the_order_written() {
        let turn = Placement::rotate(Vector::z(), 90.0).expect("an axis");
        let step = Placement::translate(Vector::x());
        let p = Point::new(1.0, 0.0, 0.0);
        assert_eq!(turn.then(&step).point(&p), Point::new(1.0, 1.0, 0.0));
        assert_eq!(step.then(&turn).point(&p), Point::new(0.0, 2.0, 0.0));
        assert_eq!(step.then(&turn).local_point(&Point::new(0.0, 2.0, 0.0)), p);
    }

    #[test]
    fn normals_stay_perpendicular_and_volumes_are_determinants() {
        for placement in all() {
            let (u, v) = (Vector::new(1.0, 2.0, 0.3), Vector::new(-0.7, 0.1, 2.0));
            let n = placement.normal(&u.cross(&v));
            assert!(n.dot(&placement.vector(&u)).abs() < 1e-12);
            assert!(n.dot(&placement.vector(&v)).abs() < 1e-12);
            let [a, b, c] = [Vector::x(), Vector::y(), Vector::z()].map(|e| placement.vector(&e));
            assert!((placement.volume_factor() - a.cross(&b).dot(&c).abs()).abs() < 1e-12);
        }
    }

    #[test]
    fn what_flattens_space_is_refused() {
        assert_eq!(Placement::scale(Vector::new(1.0, 0.0, 1.0)), None);
        assert_eq!(Placement::rotate(Vector::zeros(), 10.0), None);
        let flat = [[1.0, 2.0, 3.0, 0.0], [2.0, 4.0, 6.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
        assert_eq!(Placement::from_rows(flat), None);
        let tiny = flat.map(|row| row.map(|v| v * 1e-200));
        assert_eq!(Placement::from_rows(tiny), None);
        let thin = [[1.0, 0.0, 0.0, 0.0], [0.0, 1e-7, 0.0, 0.0], [0.0, 0.0, 1e-7, 0.0]];
        assert!(Placement::from_rows(thin).is_some());
        let small = [[1e-50, 0.0, 0.0, 0.0], [0.0, 1e-50, 0.0, 0.0], [0.0, 0.0, 1e-50, 0.0]];
        assert!(Placement::from_rows(small).is_some());
    }

    #[test]
    fn boxes_hold_where_their_points_go() {
        let local = Bounds::around([Point::new(-1.0, 0.0, 2.0), Point::new(3.0, 0.5, 2.5)]);
        for placement in all() {
            let outside = placement.bounds(&local);
            for i in 0..=10 {
                let p = local.min + local.sides() * (f64::from(i) / 10.0);
                assert!(outside.contains(&placement.point(&p)));
            }
        }
    }
}
