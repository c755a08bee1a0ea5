//! Elementary functions with the same bits on every machine.
//!
//! The functions of the system's mathematical library (which `f64::exp` and
//! its like call) differ in their last bits between systems and versions.
//! These use additions, multiplications and divisions alone, in a written
//! order and without fused multiply-add.

/// e to the power `x`; within one unit in the last place.
///
/// Underflows gradually to 0 below -708 and gives infinity above 709.78.
///
/// Range reduction after Cody and Waite (*Software Manual for the Elementary
/// Functions*, 1980): x = k ln 2 + r with |r| <= ln 2 / 2; then the Taylor sum of
/// e^r to the 13th power, whose remainder is below 2^-57, times 2^k.
#[inline]
#[must_use]
pub fn exp(x: f64) -> f64 {
    /// Adding and subtracting it rounds to a whole number, which is then in the
    /// lowest bits.
    const ROUND: f64 = 6_755_399_441_055_744.0; // 1.5 * 2^52
    /// ln 2 in two parts; the first has so few bits that its product with any
    /// k is exact.
    const LN_2_HIGH: f64 = 6.931_471_803_691_238e-1;
    const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;

    // Not for NaN either.
    if !(x > -708.0 && x < 709.0) {
        return libm::exp(x);
    }
    let rounded = x * std::f64::consts::LOG2_E + ROUND;
    let k = rounded - ROUND;
    let r = (x - k * LN_2_HIGH) - k * LN_2_LOW;
    // Estrin's order: pairs, pairs of pairs, and so on.
    let r2 = r * r;
    let r4 = r2 * r2;
    let p23 = 1.0 / 2.0 + r * (1.0 / 6.0);
    let p45 = 1.0 / 24.0 + r * (1.0 / 120.0);
    let p67 = 1.0 / 720.0 + r * (1.0 / 5040.0);
    let p89 = 1.0 / 40_320.0 + r * (1.0 / 362_880.0);
    let pab = 1.0 / 3_628_800.0 + r * (1.0 / 39_916_800.0);
    let pcd = 1.0 / 479_001_600.0 + r * (1.0 / 6_227_020_800.0);
    let low = p23 + r2 * p45;
    let middle = p67 + r2 * p89;
    let high = pab + r2 * pcd;
    let tail = low + r4 * (middle + r4 * high);
    let power = 1.0 + (r + r2 * tail);
    // 2^k, from the lowest bits of `rounded`.
    let two_to_k = f64::from_bits((rounded.to_bits().wrapping_add(1023)) << 52);
    power * two_to_k
}

#[cfg(test)]
mod tests {
    use super::*;

    /// e^x as the sum of its series in an exact-enough arithmetic of another
    /// kind: e^x = (e^(x/2^k))^(2^k) in double-double numbers.
    fn exp_double_double(x: f64) -> f64 {
        type Dd = (f64, f64);
        fn add(a: Dd, b: Dd) -> Dd {
            let s = a.0 + b.0;
            let t = s - a.0;
            let e = (a.0 - (s - t)) + (b.0 - t) + a.1 + b.1;
            (s + e, e - ((s + e) - s))
        }
        fn mul(a: Dd, b: Dd) -> Dd {
            let p = a.0 * b.0;
            let e = a.0.mul_add(b.0, -p) + (a.0 * b.1 + a.1 * b.0);
            (p + e, e - ((p + e) - p))
        }
        fn div(a: Dd, n: f64) -> Dd {
            let q = a.0 / n;
            let r = (-q).mul_add(n, a.0) + a.1;
            (q + r / n, (r / n) - ((q + r / n) - q))
        }
        let halvings = 12;
        let small = (libm::scalbn(x, -halvings), 0.0);
        // e^small - 1, so that the squarings below lose no digits.
        let (mut sum, mut term) = ((0.0, 0.0), (1.0, 0.0));
        for n in 1..30 {
            term = div(mul(term, small), f64::from(n));
            sum = add(sum, term);
        }
        for _ in 0..halvings {
            // (1 + s)^2 - 1 = 2 s + s^2
            sum = add((2.0 * sum.0, 2.0 * sum.1), mul(sum, sum));
        }
        let result = add((1.0, 0.0), sum);
        result.0 + result.1
    }

    #[test]
    fn exp_is_within_one_ulp_of_an_independent_sum() {
        let mut worst = 0.0_f64;
        for i in 0..=20_000 {
            // The domain that shading uses. The independent sum itself is good
            // to about 1e-27 absolutely, so relatively it serves down to -20.
            let x = -20.0 * f64::from(i) / 20_000.0;
            let truth = exp_double_double(x);
            let ulp = libm::nextafter(truth, f64::INFINITY) - truth;
            worst = worst.max((exp(x) - truth).abs() / ulp);
        }
        assert!(worst <= 1.0, "worst error {worst} ulp");
    }

    #[test]
    fn exp_of_a_sum_is_the_product() {
        for i in 0..1000 {
            let (a, b) = (-0.1 * f64::from(i), -50.0);
            let ratio = exp(a + b) / (exp(a) * exp(b));
            assert!((ratio - 1.0).abs() < 1e-13, "at {a}");
        }
    }

    #[test]
    fn exp_at_its_ends() {
        assert_eq!(exp(0.0), 1.0);
        assert_eq!(exp(f64::NEG_INFINITY), 0.0);
        assert_eq!(exp(f64::INFINITY), f64::INFINITY);
        assert_eq!(exp(710.0), f64::INFINITY);
        assert_eq!(exp(-746.0), 0.0);
        assert!(exp(f64::NAN).is_nan());
    }

    /// The bits themselves, so that a change of library or compiler is seen.
    #[test]
    fn exp_bits_are_pinned() {
        let hash = (0..10_000).fold(0xcbf2_9ce4_8422_2325_u64, |hash, i| {
            let bits = exp(-0.01 * f64::from(i)).to_bits();
            (hash ^ bits).wrapping_mul(0x0100_0000_01b3)
        });
        assert_eq!(hash, EXP_HASH, "0x{hash:016x}");
    }

    const EXP_HASH: u64 = 0xb631_228c_8225_e88a;
}
