use crate::lanes::{One, Real, Vectors};
use crate::shapes::exact::{two_products, two_sums};
use lancer_math::{Point, Ray, Vector};

/// A ray seen from a point near what it may meet: its origin moved along it to
/// where it is nearest to that point, and relative to it.
///
/// The coordinates of far origins are large, and what the quadratic or quartic
/// of a small shape needs of them is lost in their rounding. Moving the origin
/// first keeps the error at the size of the shape (Haines, Günther and
/// Akenine-Möller, *Ray Tracing Gems*, 2019, chapter 7, for the sphere; here for
/// all shapes): the difference of two far points and the step along the ray are
/// added up with the rounding error of each, by Knuth's two-sum and the
/// exact product of a fused multiply-add.
///
/// A direction so long or so short that its square leaves the range of a double
/// is taken times a power of two.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Near {
    /// The nearest point of the ray's line to the centre, minus the centre.
    pub(crate) origin: Vector,
    /// The ray's direction, times `unit`.
    pub(crate) direction: Vector,
    /// How many of these directions the origin was moved.
    pub(crate) shift: f64,
    /// A power of two, nearly always 1.
    pub(crate) unit: f64,
}

impl Near {
    #[inline]
    pub(crate) fn new(ray: &Ray, centre: &Point) -> Self {
        let (d, unit) = ordinary(&ray.direction);
        let from_centre = ray.origin - centre;
        let shift = -(from_centre.dot(&d) / d.norm_squared());
        Self { origin: stepped(&ray.origin, centre, shift, &d), direction: d, shift, unit }
    }

    /// The same, but with the origin where it is if it is within a few times
    /// `size` of the centre: then its rounding is small already.
    #[inline]
    pub(crate) fn around(ray: &Ray, centre: &Point, size: f64) -> Self {
        let from_centre = ray.origin - centre;
        if from_centre.amax() <= 4.0 * size {
            let (direction, unit) = ordinary(&ray.direction);
            Self { origin: from_centre, direction, shift: 0.0, unit }
        } else {
            Self::new(ray, centre)
        }
    }

    /// What t of the ray is at so many of these directions from this origin.
    #[inline]
    pub(crate) fn t(&self, along: f64) -> f64 {
        (self.shift + along) * self.unit
    }
}

/// The direction, times a power of two where its square would be out of range,
/// and that power.
#[inline]
pub(crate) fn ordinary(direction: &Vector) -> (Vector, f64) {
    const LEAST: f64 = 1e-100;
    const GREATEST: f64 = 1e100;
    let largest = direction.amax();
    if (LEAST..=GREATEST).contains(&largest) || !(largest > 0.0 && largest < f64::INFINITY) {
        return (*direction, 1.0);
    }
    // Within the exponents of powers of two whose inverses are numbers, too.
    let unit = libm::scalbn(1.0, (-libm::ilogb(largest)).clamp(-1000, 1000));
    (direction * unit, unit)
}

/// origin - centre + t direction, with an error of a few units in the last
/// place of the result and not of the terms.
#[inline]
pub(crate) fn stepped(origin: &Point, centre: &Point, t: f64, direction: &Vector) -> Vector {
    let [origin, centre] = [origin, centre].map(|p| Vectors::splat_point(One, p));
    steps(&origin, &centre, t, &Vectors::splat(One, direction)).lane(0)
}

/// The same in lanes.
#[inline(always)]
pub(crate) fn steps<R: Real>(
    origin: &Vectors<R>,
    centre: &Vectors<R>,
    t: R,
    direction: &Vectors<R>,
) -> Vectors<R> {
    Vectors {
        x: moved(origin.x, centre.x, t, direction.x),
        y: moved(origin.y, centre.y, t, direction.y),
        z: moved(origin.z, centre.z, t, direction.z),
    }
}

/// o - c + t d for one coordinate.
#[inline(always)]
fn moved<R: Real>(o: R, c: R, t: R, d: R) -> R {
    let (difference, lost) = two_sums(o, -c);
    let (step, step_lost) = two_products(t, d);
    // The sum of both may cancel; what it loses is small against what is left.
    let (sum, sum_lost) = two_sums(difference, step);
    sum + (sum_lost + (lost + step_lost))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_origins_come_near_with_all_their_digits() {
        // Small whole numbers away from a point that is far in both senses.
        let centre = Point::new(3.0, -5.0, 1.0);
        let direction = Vector::new(3.0, 4.0, 0.0);
        for steps in [0.0, 1e3, 1e8, 1e15] {
            let offset = Vector::new(-4.0, 3.0, 2.0);
            let ray = Ray::new(centre + offset - direction * steps, direction);
            let near = Near::new(&ray, &centre);
            assert_eq!((near.origin, near.shift, near.unit), (offset, steps, 1.0));
            assert_eq!(near.t(0.5), steps + 0.5);
            assert_eq!(stepped(&ray.origin, &centre, steps, &direction), offset);
        }
    }

    #[test]
    fn directions_of_any_length_give_the_same_points() {
        let ray = |k| Ray::new(Point::new(0.0, 1.0, -10.0), Vector::new(0.0, 0.0, k));
        let plain = Near::new(&ray(1.0), &Point::origin());
        for exponent in [-1070, -1030, -600, -100, 100, 600, 1023] {
            let k = libm::scalbn(1.0, exponent);
            let near = Near::new(&ray(k), &Point::origin());
            assert_eq!(near.origin, plain.origin, "2^{exponent}");
            if exponent > -1020 {
                assert_eq!(near.t(0.0) * k, 10.0, "2^{exponent}");
            }
        }
        let none = Near::new(&ray(0.0), &Point::origin());
        assert!(none.origin.z.is_nan());
    }
}
