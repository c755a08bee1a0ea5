use crate::{Point, Vector};

/// A box with sides along the axes, faces included.
///
/// One without points has a smallest corner that is not below the largest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// The corner with the smallest coordinates.
    pub min: Point,
    /// The corner with the largest coordinates.
    pub max: Point,
}

impl Bounds {
    /// A box without points.
    pub const EMPTY: Self = Self {
        min: Point::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        max: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// The smallest box around some points.
    #[must_use]
    pub fn around(points: impl IntoIterator<Item = Point>) -> Self {
        points.into_iter().fold(Self::EMPTY, Self::with)
    }

    /// The smallest box that also holds `point`.
    #[must_use]
    pub fn with(self, point: Point) -> Self {
        Self {
            min: Point::from(self.min.coords.inf(&point.coords)),
            max: Point::from(self.max.coords.sup(&point.coords)),
        }
    }

    /// The smallest box around both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self {
            min: Point::from(self.min.coords.inf(&other.min.coords)),
            max: Point::from(self.max.coords.sup(&other.max.coords)),
        }
    }

    /// The box with each face moved outward.
    #[must_use]
    pub fn grown(self, by: Vector) -> Self {
        Self { min: self.min - by, max: self.max + by }
    }

    /// The middle, without overflow.
    #[must_use]
    pub fn centre(&self) -> Point {
        Point::from(self.min.coords * 0.5 + self.max.coords * 0.5)
    }

    /// Its eight corners.
    #[must_use]
    pub fn corners(&self) -> [Point; 8] {
        std::array::from_fn(|i| {
            let pick = |axis: usize| {
                if i >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] }
            };
            Point::new(pick(0), pick(1), pick(2))
        })
    }

    /// The lengths of its sides; negative for one without points.
    #[must_use]
    pub fn sides(&self) -> Vector {
        self.max - self.min
    }

    /// The largest absolute value of a coordinate of its points.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.min.coords.amax().max(self.max.coords.amax())
    }

    /// Whether `point` is in it.
    #[must_use]
    pub fn contains(&self, point: &Point) -> bool {
        (0..3).all(|i| self.min[i] <= point[i] && point[i] <= self.max[i])
    }
}
