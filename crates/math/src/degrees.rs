//! Angles in degrees, with the values that people expect.

/// Sine and cosine of an angle in degrees: exact at multiples of 90, with the
/// symmetries of the circle exact to the bit, and the same bits on every
/// machine.
///
/// The angle is first brought into [0, 45] by exact steps; only then is it
/// turned into radians, for the `libm` crate's functions.
#[must_use]
pub fn sin_cos_degrees(angle: f64) -> (f64, f64) {
    // Exact: the remainder of a division of doubles is a double.
    let turn = angle % 360.0;
    let size = turn.abs();
    // The nearest multiple of 90, and what is left, exactly: |rest| <= 45.
    let quarters = libm::rint(size / 90.0);
    let rest = size - 90.0 * quarters;
    let radians = rest * (std::f64::consts::PI / 180.0);
    let (s, c) = (libm::sin(radians), libm::cos(radians));
    let (sine, cosine) = match quarters as u8 {
        0 | 4 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    };
    // `+ 0.0` turns -0 into 0.
    (if turn < 0.0 { -sine } else { sine } + 0.0, cosine + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarters_are_exact() {
        for turns in -3..4 {
            for (angle, expected) in
                [(0.0, (0.0, 1.0)), (90.0, (1.0, 0.0)), (180.0, (0.0, -1.0)), (270.0, (-1.0, 0.0))]
            {
                assert_eq!(sin_cos_degrees(f64::from(turns) * 360.0 + angle), expected);
            }
        }
        assert_eq!(sin_cos_degrees(-90.0), (-1.0, 0.0));
    }

    #[test]
    fn symmetries_are_exact_and_values_right() {
        for i in 0..=3600 {
            let angle = f64::from(i) * 0.1;
            let (s, c) = sin_cos_degrees(angle);
            assert_eq!(sin_cos_degrees(-angle), (-s + 0.0, c), "{angle}");
            assert!((s * s + c * c - 1.0).abs() < 4.0 * f64::EPSILON, "{angle}");
            // Independent of the reduction: the addition theorem, one degree on.
            let (s1, c1) = sin_cos_degrees(angle + 1.0);
            let (s_1, c_1) = sin_cos_degrees(1.0);
            assert!((s1 - (s * c_1 + c * s_1)).abs() < 4e-15, "{angle}");
            assert!((c1 - (c * c_1 - s * s_1)).abs() < 4e-15, "{angle}");
        }
        let (s, c) = sin_cos_degrees(30.0);
        assert!((s - 0.5).abs() < 1e-16 && (c - 0.75_f64.sqrt()).abs() < 2e-16);
    }
}
