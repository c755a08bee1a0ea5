//! From linear light to codes of sRGB, rounded to the nearest.

use lancer_math::srgb;
use std::sync::LazyLock;

/// The code of 16 bits for linear light, 1 being display white; what is not a
/// number is black.
pub(crate) fn code16(v: f64) -> u16 {
    (65535.0 * srgb::encode(v)).round() as u16
}

/// Codes of 8 bits for linear light. They are read off a list of the 255
/// thresholds between them: 9 million components take 6 ms, where the power of
/// the formula takes nearly 300 ms.
///
/// Where to look is told by the bits of the number: its exponent and the first
/// `FRACTION` bits of its fraction are the number of an interval so narrow that
/// there is at most one threshold in it.
pub(crate) struct Codes8 {
    /// Of each interval, the code at its lower end; and that of 1.
    lowest: [u8; INTERVALS + 1],
    /// The linear light from which on a code is the nearest: that which halves
    /// the way from the one before. It is nothing for the first code, and there
    /// is none after the last.
    thresholds: [f64; 257],
}

/// How many bits of a number's fraction choose its interval.
const FRACTION: u32 = 7;
/// The intervals go from 2^-13, where all codes are 0, to 1.
const INTERVALS: usize = 13 << FRACTION;
/// The number of the first interval in the bits of a number.
const FIRST: u64 = (1023 - 13) << FRACTION;

impl Codes8 {
    /// The table. It is made when it is first asked for.
    pub(crate) fn table() -> &'static Self {
        static TABLE: LazyLock<Codes8> = LazyLock::new(Codes8::new);
        &TABLE
    }

    fn new() -> Self {
        let thresholds = std::array::from_fn(|code| match code {
            0 => f64::NEG_INFINITY,
            256 => f64::INFINITY,
            _ => srgb::decode((code as f64 - 0.5) / 255.0),
        });
        let lowest = std::array::from_fn(|interval| {
            let start = f64::from_bits((FIRST + interval as u64) << (52 - FRACTION));
            // At most 255: nothing reaches the last threshold.
            (thresholds.partition_point(|threshold| *threshold <= start) - 1) as u8
        });
        Self { lowest, thresholds }
    }

    /// The code for linear light, 1 being display white; what is not a number
    /// is black.
    #[inline]
    pub(crate) fn code(&self, v: f64) -> u8 {
        // Without jumps, which noisy pictures would make hard to foretell; NaN
        // is not above 0.
        let v = if v > 0.0 { v } else { 0.0 };
        let v = if v < 1.0 { v } else { 1.0 };
        // All that is below the first interval goes to it, and gets its code 0.
        let interval = (v.to_bits() >> (52 - FRACTION)).saturating_sub(FIRST);
        let lowest = self.lowest[interval as usize];
        lowest + u8::from(v >= self.thresholds[usize::from(lowest) + 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn above(v: f64) -> f64 {
        step(v, 1)
    }

    fn below(v: f64) -> f64 {
        step(v, -1)
    }

    /// The number `steps` further on; for positive numbers.
    fn step(v: f64, steps: i64) -> f64 {
        f64::from_bits(v.to_bits().wrapping_add_signed(steps))
    }

    #[test]
    fn no_interval_has_two_thresholds() {
        let codes = Codes8::table();
        assert!(codes.lowest.windows(2).all(|pair| pair[1] - pair[0] <= 1));
        assert_eq!((codes.lowest[0], codes.lowest[INTERVALS]), (0, 255));
        assert!(codes.thresholds.windows(2).all(|pair| pair[0] < pair[1]));
    }

    #[test]
    fn codes_change_exactly_at_their_thresholds() {
        let codes = Codes8::table();
        for code in 1..=255_u8 {
            let threshold = srgb::decode((f64::from(code) - 0.5) / 255.0);
            assert_eq!(codes.code(threshold), code);
            assert_eq!(codes.code(above(threshold)), code);
            assert_eq!(codes.code(below(threshold)), code - 1);
            assert_eq!(codes.code(srgb::decode8(code)), code, "a code comes back");
        }
    }

    /// The definition itself, by looking through the whole list.
    #[test]
    fn the_short_cut_finds_what_the_list_says() {
        let codes = Codes8::table();
        for i in 0..200_000_u64 {
            let v = f64::from_bits((1008_u64 << 52) + i * ((16_u64 << 52) / 200_000));
            let slowly = codes.thresholds[1..256].iter().filter(|t| v >= **t).count();
            assert_eq!(usize::from(codes.code(v)), slowly, "{v}");
        }
    }

    /// Numbers of all binades, with the formula for each. None of them is so
    /// close to a threshold that the rounding of the formula shows.
    #[test]
    fn codes_are_those_of_the_formula() {
        let codes = Codes8::table();
        let mut seen = [0_u32; 256];
        let mut check = |v: f32| {
            let v = f64::from(v);
            let code = codes.code(v);
            assert_eq!(code, (255.0 * srgb::encode(v)).round() as u8, "{v:e}");
            seen[usize::from(code)] += 1;
        };
        // A step without a common factor with 2^32: positive and negative
        // numbers of all exponents, infinities and NaN.
        for i in 0..1_000_000_u32 {
            check(f32::from_bits(i.wrapping_mul(2_654_435_761)));
        }
        // And as many where the codes are.
        let (low, high) = (1e-5_f32.to_bits(), 2_f32.to_bits());
        for i in 0..1_000_000_u64 {
            check(f32::from_bits(low + (u64::from(high - low) * i / 1_000_000) as u32));
        }
        assert!(seen.iter().all(|count| *count > 50), "{seen:?}");
    }

    #[test]
    fn ends() {
        let codes = Codes8::table();
        for v in [0.0, -0.0, 1e-310, 5e-7, -0.5, -1.0, -1e300, f64::NEG_INFINITY] {
            assert_eq!((codes.code(v), code16(v)), (0, 0), "{v}");
        }
        assert_eq!((codes.code(1.5e-4), code16(1.5e-4)), (0, 127));
        assert_eq!((codes.code(1.6e-4), code16(1.6e-4)), (1, 135));
        for v in [f64::NAN, -f64::NAN, f64::from_bits(u64::MAX)] {
            assert_eq!((codes.code(v), code16(v)), (0, 0));
        }
        for v in [below(1.0), 1.0, above(1.0), 1e300, f64::INFINITY] {
            assert_eq!((codes.code(v), code16(v)), (255, 65535), "{v}");
        }
    }

    #[test]
    fn codes_of_16_bits_are_the_nearest_and_rise() {
        let mut last = 0;
        for i in 0..=1_000_000_u32 {
            let v = f64::from(i) / 1e6;
            let code = code16(v);
            assert!(code >= last, "{v}");
            last = code;
            let middle = |code: f64| srgb::decode(code / 65535.0);
            assert!(v >= middle(f64::from(code) - 0.5) * (1.0 - 1e-6), "{v}");
            assert!(v <= middle(f64::from(code) + 0.5) * (1.0 + 1e-6) || code == 65535, "{v}");
        }
        assert_eq!(last, 65535);
    }
}
