//! What a clear surface does to a ray.

use lancer_math::{Vector, unit};

/// The mirrored direction at a unit normal, of length 1.
///
/// `facet` is the normal of the surface itself on the ray's side; a mirrored
/// ray never goes below it, as it might where another normal is shaded with.
pub(super) fn reflect(direction: Vector, normal: Vector, facet: Vector) -> Vector {
    keep_above(direction - normal * (2.0 * direction.dot(&normal)), facet)
}

/// The direction of length 1 that is not below the surface with that normal.
fn keep_above(direction: Vector, facet: Vector) -> Vector {
    let height = direction.dot(&facet);
    let direction = if height < 0.0 { direction - facet * (2.0 * height) } else { direction };
    unit(direction).unwrap_or(facet)
}

/// What becomes of light at the border of two media.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Refraction {
    /// All of it is mirrored.
    Total,
    /// A part goes on.
    Part {
        /// The fraction that is mirrored.
        mirrored: f64,
        /// The direction in which the rest goes on, of length 1.
        direction: Vector,
    },
}

/// Refraction from a medium with index `n1` into one with index `n2`, for
/// light without polarisation (Born and Wolf, *Principles of Optics*, 1.5.2).
///
/// `normal` is the unit normal on the side of the first medium. Whether all is
/// mirrored and how the rest is bent are decided by the same number, so that no
/// ray falls between the two.
pub(super) fn refract(direction: Vector, normal: Vector, n1: f64, n2: f64) -> Refraction {
    if n1 == n2 {
        return Refraction::Part { mirrored: 0.0, direction };
    }
    let cosine = -direction.dot(&normal);
    let ratio = n1 / n2;
    let Some(bent) = bent_cosine(cosine, ratio) else { return Refraction::Total };
    let onward = direction * ratio + normal * (ratio * cosine - bent);
    let direction = unit(onward).unwrap_or(direction);
    Refraction::Part { mirrored: fresnel(n1, cosine, n2, bent), direction }
}

/// The cosine of the angle in the second medium; `None` where there is none.
fn bent_cosine(cosine: f64, ratio: f64) -> Option<f64> {
    // 1 - sine squared, without squaring what is nearly 1.
    let square = 1.0 - ratio * ratio * ((1.0 - cosine) * (1.0 + cosine));
    (square > 0.0).then(|| square.sqrt())
}

/// The fraction of unpolarised light that is mirrored, from the indices and
/// the cosines of the angles on both sides.
fn fresnel(n1: f64, c1: f64, n2: f64, c2: f64) -> f64 {
    let across = (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2);
    let along = (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2);
    (across * across + along * along) / 2.0
}

/// The fraction of light that a thin sheet of index `n2` in a medium of index
/// `n1` mirrors: of both faces, summed over all that goes to and fro between
/// them; the rest goes straight on.
///
/// F + (1-F)^2 F (1 + F^2 + F^4 + ...) = 2 F / (1 + F).
pub(super) fn mirrored_by_sheet(cosine: f64, n1: f64, n2: f64) -> f64 {
    match bent_cosine(cosine, n1 / n2) {
        Some(bent) => {
            let f = fresnel(n1, cosine, n2, bent);
            2.0 * f / (1.0 + f)
        }
        None => 1.0,
    }
}

/// The fraction that the border of two media mirrors of light that goes on
/// unbent, as on its way to a shadow: the angle is taken to be that in the
/// thinner medium, so that both faces of a pane mirror the same.
pub(super) fn mirrored_of_unbent(cosine: f64, n1: f64, n2: f64) -> f64 {
    let (thin, dense) = if n1 < n2 { (n1, n2) } else { (n2, n1) };
    bent_cosine(cosine, thin / dense).map_or(1.0, |bent| fresnel(thin, cosine, dense, bent))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lancer_math::sin_cos_degrees;

    fn at(degrees: f64) -> (Vector, f64) {
        let (sine, cosine) = sin_cos_degrees(degrees);
        (Vector::new(sine, 0.0, -cosine), cosine)
    }

    fn mirrored(degrees: f64, n1: f64, n2: f64) -> f64 {
        match refract(at(degrees).0, Vector::z(), n1, n2) {
            Refraction::Total => 1.0,
            Refraction::Part { mirrored, .. } => mirrored,
        }
    }

    /// Half of the last place of 1.
    const U: f64 = f64::EPSILON / 2.0;

    /// Worked out elsewhere with 60 digits, by sines and tangents of both angles:
    /// Rs = (sin(a-b)/sin(a+b))^2, Rp = (tan(a-b)/tan(a+b))^2.
    #[test]
    fn d2_fresnel_at_five_angles_into_glass_and_two_out_of_it() {
        for (degrees, expected) in [
            (0.0, 0.04),
            (30.0, 0.041_522_625_975_821_54),
            (45.0, 0.050_239_911_012_235_94),
            (60.0, 0.089_186_712_802_212_78),
            (80.0, 0.387_704_354_691_472_7),
        ] {
            let found = mirrored(degrees, 1.0, 1.5);
            assert!((found - expected).abs() < 1e-14, "{degrees}: {found} {expected}");
        }
        for (degrees, expected) in [(40.0, 0.245_291_204_286_910_35), (41.0, 0.379_751_265_962_44)]
        {
            let found = mirrored(degrees, 1.5, 1.0);
            assert!((found - expected).abs() < 1e-14, "{degrees}: {found} {expected}");
        }
    }

    /// As much is mirrored of light that goes in as of light that comes out the same way,
    /// to 4 u; and what is not mirrored goes on, to 4 u.
    #[test]
    fn d2_both_ways_are_alike_and_nothing_is_lost() {
        for n in [1.31, 1.333, 1.5, 1.52, 2.0, 2.42] {
            for i in 1..=1000 {
                let c1 = f64::from(i) / 1000.0;
                let c2 = bent_cosine(c1, 1.0 / n).expect("into the denser medium all angles go");
                let (into, out) = (fresnel(1.0, c1, n, c2), fresnel(n, c2, 1.0, c1));
                assert!((into - out).abs() <= 4.0 * U, "{n} {c1}: {into} {out}");
                // Of each polarisation 4 n1 c1 n2 c2 over the square of a sum.
                let passed = |sum: f64| 4.0 * c1 * n * c2 / (sum * sum);
                let through = (passed(c1 + n * c2) + passed(n * c1 + c2)) / 2.0;
                assert!((into + through - 1.0).abs() <= 4.0 * U, "{n} {c1}: {into} {through}");
            }
        }
    }

    /// Step by step of doubles across the critical angle: one number decides whether
    /// light goes on and how, so it is never NaN, and what is mirrored rises all the way.
    #[test]
    fn d1_what_is_mirrored_rises_up_to_the_critical_angle() {
        for n in [1.31_f64, 1.333, 1.5, 1.52, 2.0, 2.42] {
            let mut cosine: f64 = (1.0 - 1.0 / (n * n)).sqrt();
            for _ in 0..60 {
                cosine = cosine.next_up();
            }
            let mut last = 0.0;
            for _ in 0..120 {
                let f = match bent_cosine(cosine, n) {
                    None => 1.0,
                    Some(bent) => {
                        assert!(bent > 0.0);
                        fresnel(n, cosine, 1.0, bent)
                    }
                };
                assert!(f >= last - 4.0 * U && f <= 1.0, "{n}: {f} after {last}");
                (last, cosine) = (f, cosine.next_down());
            }
            assert_eq!(last, 1.0);
        }
        // Where n sine rounds to 1 and its square is beyond 1.
        assert_eq!(bent_cosine(0.645_974_748_031_756_6, 1.31), None);
    }

    #[test]
    fn d2_at_the_angle_of_brewster_one_polarisation_is_not_mirrored() {
        let degrees = libm::atan(1.5).to_degrees();
        let rs = (5.0_f64 / 13.0) * (5.0 / 13.0);
        assert!((mirrored(degrees, 1.0, 1.5) - rs / 2.0).abs() < 1e-14);
    }

    #[test]
    fn light_is_neither_made_nor_lost_and_goes_both_ways_alike() {
        for i in 1..900 {
            let degrees = 0.1 * f64::from(i);
            let (d, cosine) = at(degrees);
            let Refraction::Part { mirrored: f, direction } = refract(d, Vector::z(), 1.0, 1.5)
            else {
                panic!("into the denser medium all angles go");
            };
            // Snell: n sine is the same on both sides.
            assert!((1.5 * direction.x - d.x).abs() < 4e-16, "{degrees}");
            assert!((direction.norm() - 1.0).abs() < 4e-16);
            let back = -direction;
            let Refraction::Part { mirrored: g, direction: out } =
                refract(back, -Vector::z(), 1.5, 1.0)
            else {
                panic!("what came in goes out");
            };
            assert!((f - g).abs() < 1e-12, "{degrees}");
            // The way back is the way in reversed, but for what the bend near
            // the critical angle magnifies.
            assert!((out + d).norm() < 1e-15 / cosine.max(1e-3), "{degrees}");
            // Amplitudes: T = n2 c2 / (n1 c1) t^2 for each polarisation.
            let (c1, c2) = (cosine, -direction.z);
            let ts = 2.0 * c1 / (c1 + 1.5 * c2);
            let tp = 2.0 * c1 / (1.5 * c1 + c2);
            let t = 1.5 * c2 / c1 * (ts * ts + tp * tp) / 2.0;
            assert!((f + t - 1.0).abs() < 1e-13, "{degrees}: {f} + {t}");
        }
    }

    #[test]
    fn total_reflection_begins_at_the_critical_angle() {
        let critical = libm::asin(1.0 / 1.5).to_degrees();
        let (mut low, mut high) = (0.0, 90.0);
        while high - low > 1e-10 {
            let middle = (low + high) / 2.0;
            match refract(at(middle).0, Vector::z(), 1.5, 1.0) {
                Refraction::Total => high = middle,
                Refraction::Part { .. } => low = middle,
            }
        }
        assert!((low - critical).to_radians().abs() < 1e-9);
    }

    #[test]
    fn d3_a_sheet_sums_its_bounces() {
        for (degrees, transmitted) in [(60.0, 0.836_232_462_710_168_3), (0.0, 12.0 / 13.0)] {
            let r = mirrored_by_sheet(at(degrees).1, 1.0, 1.5);
            assert!((1.0 - r - transmitted).abs() < 1e-12);
            // The series itself.
            let f = mirrored(degrees, 1.0, 1.5);
            let (mut sum, mut inside) = (f, 1.0 - f);
            for _ in 0..40 {
                inside *= f;
                sum += inside * (1.0 - f);
                inside *= f;
            }
            assert!((sum - r).abs() < 1e-14);
        }
    }

    #[test]
    fn a_mirrored_ray_stays_above_the_surface() {
        let facet = Vector::z();
        let tilted = unit(Vector::new(0.8, 0.0, 0.6)).expect("not zero");
        let d = unit(Vector::new(0.9, 0.1, -0.1)).expect("not zero");
        assert!((d - tilted * (2.0 * d.dot(&tilted))).z < 0.0, "else it shows nothing");
        assert!(reflect(d, tilted, facet).z >= 0.0);
    }
}
