//! Mirrors and clear surfaces: the laws of reflection, of Snell and of Fresnel.

use crate::crossing::ratio;
use crate::{Number, Triple};

/// What becomes of light at the border of two media.
#[derive(Clone, Debug)]
pub enum Refraction {
    /// All of it is mirrored.
    Total,
    /// A part goes on.
    Part {
        /// The fraction that is mirrored, of light without polarisation.
        mirrored: Number,
        /// The direction in which the rest goes on, of length 1.
        direction: Triple,
    },
}

/// The direction that a mirror with that normal (of any length) throws a ray into;
/// of length 1.
#[must_use]
pub fn reflect(direction: &Triple, normal: &Triple, bits: usize) -> Triple {
    // What is along the normal is turned round: d n.n - 2 (d.n) n.
    let along = normal.dot(direction);
    let turned = normal.times(&(&along + &along));
    (&direction.times(&normal.norm_squared()) - &turned).rounded(2 * bits).unit(bits)
}

/// Refraction of a ray along `direction`, of length 1, from a medium with index
/// `n1` into one with index `n2`, at a surface with a unit normal on the side that
/// the ray comes from; and how far from total reflection it is decided: the square
/// of the cosine behind the surface, or what is missing for one.
#[must_use]
pub fn refract(
    direction: &Triple,
    normal: &Triple,
    n1: f64,
    n2: f64,
    bits: usize,
) -> (Refraction, f64) {
    if n1 == n2 {
        let direction = direction.clone();
        return (Refraction::Part { mirrored: Number::zero(), direction }, 1.0);
    }
    let (n1, n2) = (Number::from(n1), Number::from(n2));
    let cosine = -direction.dot(normal);
    // Snell: the part along the surface is n1 / n2 times what it was.
    let along = (direction + &normal.times(&cosine)).times(&n1);
    // n2^2 times the square of the cosine behind.
    let behind = n2.squared() - along.norm_squared();
    let gap = ratio(&behind, &n2.squared());
    if behind.signum() <= 0 {
        return (Refraction::Total, gap);
    }
    let deep = behind.rounded(2 * bits).root(bits + 8);
    let mirrored = reflectance(&(&n1 * &n1), &(&n1 * &cosine), &(&n2 * &n2), &deep, bits);
    let direction = (&along - &normal.times(&deep)).rounded(2 * bits).unit(bits);
    (Refraction::Part { mirrored, direction }, gap)
}

/// Fresnel's reflectance from the squares of the indices and the products of
/// indices and cosines: across the plane of incidence (p1 - p2) / (p1 + p2), squared;
/// in it the same with each product over its index's square.
fn reflectance(q1: &Number, p1: &Number, q2: &Number, p2: &Number, bits: usize) -> Number {
    let share = |a: &Number, b: &Number| {
        let r = (a - b).rounded(bits + 16).over(&(a + b).rounded(bits + 16), bits + 8);
        r.squared()
    };
    let (a, b) = (p1 * q2, p2 * q1);
    ((share(p1, p2) + share(&a, &b)) * Number::power_of_two(-1)).rounded(bits)
}

/// The fraction that a clear border mirrors of a ray that meets it at that cosine,
/// coming from index `n1`; 1 beyond the critical angle.
#[must_use]
pub fn fresnel(cosine: &Number, n1: f64, n2: f64, bits: usize) -> Number {
    if n1 == n2 {
        return Number::zero();
    }
    let (n1, n2) = (Number::from(n1), Number::from(n2));
    let behind = n2.squared() - n1.squared() * (Number::one() - cosine.squared());
    if behind.signum() <= 0 {
        return Number::one();
    }
    let deep = behind.rounded(2 * bits).root(bits + 8);
    reflectance(&n1.squared(), &(&n1 * cosine), &n2.squared(), &deep, bits)
}

/// The fraction that a sheet mirrors: of both its faces, with all that goes to and
/// fro between them, F + (1-F) F (1-F) + (1-F) F^3 (1-F) + ...
#[must_use]
pub fn sheet(cosine: &Number, n1: f64, n2: f64, bits: usize) -> Number {
    let f = fresnel(cosine, n1, n2, bits);
    let passes = Number::one() - &f;
    // A geometric series of ratio F^2.
    let ends = Number::one() - f.squared();
    if ends.is_zero() {
        return Number::one();
    }
    (&f + (&passes * &passes * &f).over(&ends, bits)).rounded(bits)
}
