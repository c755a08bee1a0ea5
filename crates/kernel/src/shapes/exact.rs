//! Sums and products of doubles together with what their rounding loses.
//!
//! Two-sum after Knuth (*The Art of Computer Programming*, volume 2, 4.2.2), the
//! product's loss by a fused multiply-add, and from it Kahan's difference of two
//! products, whose error is at most 1.5 units in the last place (Jeannerod,
//! Louvet and Muller, *Further Analysis of Kahan's Algorithm for the Accurate
//! Computation of 2 x 2 Determinants*, 2013). All hold as long as no product
//! leaves the range of a double, downwards with its last bits.

use crate::lanes::Real;
use lancer_math::Vector;

/// The rounded product, and the exact product minus it.
#[inline(always)]
pub(crate) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

/// The rounded sums, and the exact sums minus those.
#[inline(always)]
pub(crate) fn two_sums<R: Real>(a: R, b: R) -> (R, R) {
    let sum = a + b;
    let back = sum - a;
    (sum, (a - (sum - back)) + (b - back))
}

/// [`two_product`] in lanes.
#[inline(always)]
pub(crate) fn two_products<R: Real>(a: R, b: R) -> (R, R) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

/// a b - c d, of which cancellation takes no digits.
#[inline(always)]
pub(crate) fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let (product, lost) = two_product(c, d);
    a.mul_add(b, -product) - lost
}

/// A number with exactly the sign of a b - c d.
///
/// Rounding keeps the order of two products unless it makes them equal, so
/// what was lost is needed only then.
#[inline(always)]
pub(crate) fn compare_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let (first, second) = (a * b, c * d);
    if first == second { a.mul_add(b, -first) - c.mul_add(d, -second) } else { first - second }
}

/// The cross product, each component to within 1.5 units in its last place.
#[inline]
pub(crate) fn cross(a: &Vector, b: &Vector) -> Vector {
    Vector::new(
        difference_of_products(a.y, b.z, a.z, b.y),
        difference_of_products(a.z, b.x, a.x, b.z),
        difference_of_products(a.x, b.y, a.y, b.x),
    )
}

/// The vector times the power of two that brings its largest component into
/// [1, 2): the same direction to the last bit. It must be finite; zero stays.
pub(crate) fn tamed(v: &Vector) -> Vector {
    let largest = v.amax();
    if largest > 0.0 {
        let exponent = libm::ilogb(largest);
        v.map(|c| libm::scalbn(c, -exponent))
    } else {
        *v
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastrand::Rng;

    /// With whole numbers below 2^53 the exact values are whole numbers that
    /// 128 bits hold.
    #[test]
    fn nothing_is_lost() {
        let mut rng = Rng::with_seed(1);
        for case in 0..100_000 {
            let mut whole = || {
                let bits = rng.u32(1..53);
                rng.i64(-(1 << bits)..1 << bits)
            };
            let [a, b, c] = [whole(), whole(), whole()];
            // Every other time products that differ in their last bits alone.
            let d = if case % 2 == 0 || c == 0 {
                whole()
            } else {
                let near = i128::from(a) * i128::from(b) / i128::from(c);
                near.clamp(-(1 << 52), 1 << 52) as i64
            };
            let [x, y, z, w] = [a, b, c, d].map(|i| i as f64);
            let (sum, lost) = two_sums(x, y);
            assert_eq!(sum as i128 + lost as i128, i128::from(a) + i128::from(b), "case {case}");
            let (product, lost) = two_product(x, y);
            let exact = i128::from(a) * i128::from(b);
            assert_eq!(product as i128 + lost as i128, exact, "case {case}");
            let exact = exact - i128::from(c) * i128::from(d);
            let sign = compare_products(x, y, z, w);
            assert_eq!(sign.partial_cmp(&0.0), Some(exact.cmp(&0)), "case {case}");
            let difference = difference_of_products(x, y, z, w);
            let error = (difference as i128 - exact).unsigned_abs() as f64;
            assert!(error <= 1.5 * f64::EPSILON * (exact as f64).abs(), "case {case}");
        }
    }

    #[test]
    fn tamed_is_the_same_direction() {
        for k in [1e-320, 1e-200, 0.3, 1.0, 1e200] {
            let v = Vector::new(3.0 * k, -k, 0.0);
            let t = tamed(&v);
            assert!((1.0..2.0).contains(&t.x), "{k}");
            assert_eq!(t.x * v.y, t.y * v.x);
        }
        assert_eq!(tamed(&Vector::zeros()), Vector::zeros());
    }
}
