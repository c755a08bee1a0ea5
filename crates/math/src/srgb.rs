//! The curve of sRGB (IEC 61966-2-1:1999), between linear light and what a
//! display is sent.
//!
//! Both have display black at 0 and display white at 1. The curve is a line
//! near black and a shifted power above; with the standard's rounded constants
//! these do not quite meet: where they change, [`encode`] falls by 2.85e-8 and
//! [`decode`] rises by 2.3e-9. That is 1/500 of a code of 16 bits, and the
//! standard's own constants are what other programs use.

/// Linear light of an encoded value. Numbers from 0 to 1; what is below or NaN
/// gives 0, what is above 1.
#[must_use]
pub fn decode(v: f64) -> f64 {
    if v >= 1.0 {
        1.0
    } else if v > 0.04045 {
        libm::pow((v + 0.055) / 1.055, 2.4)
    } else if v > 0.0 {
        v / 12.92
    } else {
        0.0
    }
}

/// Linear light of a code of 8 bits, where 255 is display white.
#[must_use]
pub fn decode8(code: u8) -> f64 {
    decode(f64::from(code) / 255.0)
}

/// The encoded value of linear light. Numbers from 0 to 1; what is below or
/// NaN gives 0, what is above 1.
#[must_use]
pub fn encode(v: f64) -> f64 {
    if v >= 1.0 {
        1.0
    } else if v > 0.003_130_8 {
        1.055 * libm::pow(v, 1.0 / 2.4) - 0.055
    } else if v > 0.0 {
        v * 12.92
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The number after `v`.
    fn above(v: f64) -> f64 {
        libm::nextafter(v, f64::INFINITY)
    }

    #[test]
    fn every_code_comes_back() {
        let lost = (0..=255_u8)
            .filter(|code| (255.0 * encode(decode8(*code))).round() != f64::from(*code))
            .count();
        assert_eq!(lost, 0, "of 256");
    }

    #[test]
    fn codes_of_16_bits_come_back() {
        let lost = (0..=65_535_u16)
            .filter(|code| {
                let v = decode(f64::from(*code) / 65_535.0);
                (65_535.0 * encode(v)).round() != f64::from(*code)
            })
            .count();
        assert_eq!(lost, 0, "of 65536");
    }

    /// The formula as another language's library computes it.
    #[test]
    fn known_values() {
        for (linear, encoded) in [
            (0.5, 0.735_356_983_052_449_4),
            (0.214_041_140_482_232_55, 0.5),
            (0.18, 0.461_356_129_500_441_64),
            (0.001, 0.012_92),
        ] {
            assert!((encode(linear) - encoded).abs() < 1e-12, "{linear}");
            assert!((decode(encoded) - linear).abs() < 1e-12, "{encoded}");
        }
        let half = 255.0 * encode(0.5);
        assert!((half - 187.516).abs() < 5e-4, "{half}");
        assert_eq!(half.round(), 188.0);
    }

    /// A power by roots and products alone: 2.4 = 2 + 2/5, and the fifth root
    /// by Newton's method.
    #[test]
    fn the_power_agrees_with_roots_and_products() {
        for i in 41..=1000 {
            let v = f64::from(i) / 1000.0;
            let base = (v + 0.055) / 1.055;
            let mut root = 1.0;
            for _ in 0..60 {
                root = (4.0 * root + base / (root * root * root * root)) / 5.0;
            }
            let power = base * base * root * root;
            assert!((decode(v) - power).abs() < 1e-15, "at {v}");
            assert!((encode(power) - v).abs() < 1e-14, "at {v}");
        }
    }

    #[test]
    fn both_rise_but_for_the_knee() {
        for (curve, knee) in [(encode as fn(f64) -> f64, 0.003_130_8), (decode, 0.04045)] {
            let mut last = 0.0;
            for i in 0..=100_000 {
                let v = f64::from(i) / 100_000.0;
                assert!(curve(v) > last || i == 0, "at {v}");
                last = curve(v);
            }
            // Number by number on both sides of it.
            let mut v = knee * (1.0 - 1e-13);
            for _ in 0..1000 {
                assert!(curve(above(v)) >= curve(v) || v == knee, "at {v}");
                v = above(v);
            }
            assert!(v > knee, "otherwise the knee was not passed");
        }
    }

    #[test]
    fn the_knee_is_as_wide_as_the_standard_makes_it() {
        let fall = encode(0.003_130_8) - encode(above(0.003_130_8));
        assert!((fall - 2.8517e-8).abs() < 1e-12, "{fall}");
        let rise = decode(above(0.04045)) - decode(0.04045);
        assert!((rise - 2.3295e-9).abs() < 1e-13, "{rise}");
    }

    #[test]
    fn ends() {
        for curve in [encode as fn(f64) -> f64, decode] {
            for v in [0.0, -0.0, -1e-300, -7.0, f64::NEG_INFINITY, f64::NAN, -f64::NAN] {
                assert_eq!(curve(v).to_bits(), 0, "{v}");
            }
            for v in [1.0, above(1.0), 1e300, f64::INFINITY] {
                assert_eq!(curve(v), 1.0, "{v}");
            }
            assert!(curve(1.0 - f64::EPSILON) <= 1.0);
            assert!(curve(f64::MIN_POSITIVE) > 0.0);
        }
        assert_eq!((decode8(0), decode8(255)), (0.0, 1.0));
    }

    /// The bits themselves, so that a change of library or compiler is seen.
    #[test]
    fn bits_are_pinned() {
        let hash = (0..10_000).fold(0xcbf2_9ce4_8422_2325_u64, |hash, i| {
            let v = f64::from(i) / 10_000.0;
            [decode(v), encode(v)]
                .iter()
                .fold(hash, |hash, value| (hash ^ value.to_bits()).wrapping_mul(0x0100_0000_01b3))
        });
        assert_eq!(hash, HASH, "0x{hash:016x}");
    }

    const HASH: u64 = 0xe989_b6a4_af78_a6a0;
}
