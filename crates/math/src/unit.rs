use crate::Vector;

/// The vector of length 1 in the direction of `v`; `None` where `v` is zero
/// or not finite.
///
/// The squares of components below about 1e-154 or above 1e154 leave the
/// range of a double. So `v` is first scaled by the power of two that brings
/// its largest component into [1, 2): exact, and without effect on the bits
/// of the result for vectors of ordinary size. Scaling `v` by any power of two
/// therefore gives the same unit vector, bit for bit.
#[must_use]
pub fn unit(v: Vector) -> Option<Vector> {
    let largest = v.x.abs().max(v.y.abs()).max(v.z.abs());
    if !(largest > 0.0 && v.iter().all(|c| c.is_finite())) {
        return None;
    }
    let exponent = libm::ilogb(largest);
    let scaled = v.map(|c| libm::scalbn(c, -exponent));
    Some(scaled / scaled.norm())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pythagorean_triple_is_exact_at_every_scale() {
        for exponent in (-1070..1020).step_by(7) {
            let k = libm::scalbn(1.0, exponent);
            let v = Vector::new(3.0 * k, 0.0, -4.0 * k);
            assert_eq!(unit(v), Some(Vector::new(0.6, 0.0, -0.8)), "2^{exponent}");
        }
    }

    #[test]
    fn refuses_what_has_no_direction() {
        for v in [
            Vector::zeros(),
            Vector::new(0.0, -0.0, 0.0),
            Vector::new(f64::NAN, 1.0, 0.0),
            Vector::new(1.0, f64::INFINITY, 0.0),
        ] {
            assert_eq!(unit(v), None, "{v:?}");
        }
    }

    #[test]
    fn length_is_one_within_rounding() {
        let mut state = 1_u64;
        for case in 0..10_000 {
            let mut next = || {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
            };
            let v = Vector::new(next(), next(), next());
            let u = unit(v).expect("not zero");
            assert!((u.norm() - 1.0).abs() <= 2.0 * f64::EPSILON, "case {case}");
            assert!(u.cross(&v).norm() <= 4.0 * f64::EPSILON * v.norm(), "case {case}");
        }
    }
}
