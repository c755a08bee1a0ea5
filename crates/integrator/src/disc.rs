//! Points of a disc, for lenses and lamps.

use lancer_math::sin_cos_degrees;

/// A point of the disc of radius 1 around the origin for a point of the square from 0 to 1:
/// equal areas stay equal, and what is near stays near, so that points that are spread
/// evenly over the square are so over the disc. Shirley and Chiu (*A Low Distortion Map
/// Between Disk and Square*, Journal of Graphics Tools 2(3), 1997).
pub(crate) fn in_disc([u, v]: [f64; 2]) -> [f64; 2] {
    let (a, b) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    if a == 0.0 && b == 0.0 {
        return [0.0; 2];
    }
    // The ring of the square that it is on, and where on it.
    let (radius, degrees) =
        if a.abs() > b.abs() { (a, 45.0 * (b / a)) } else { (b, 90.0 - 45.0 * (a / b)) };
    let (sine, cosine) = sin_cos_degrees(degrees);
    [radius * cosine, radius * sine]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The area that a small square is mapped to is the same everywhere, and all of it
    /// is inside.
    #[test]
    fn areas_stay_equal() {
        // None on a diagonal, where the map has a crease.
        let numbers = |first: f64| (0..37).map(move |i| (f64::from(i) + first) / 37.0);
        for (u, v) in numbers(0.3).flat_map(|u| numbers(0.55).map(move |v| (u, v))) {
            let step = 1e-6;
            let (at, right, up) = (in_disc([u, v]), in_disc([u + step, v]), in_disc([u, v + step]));
            let across = [right[0] - at[0], right[1] - at[1]];
            let along = [up[0] - at[0], up[1] - at[1]];
            let area = (across[0] * along[1] - across[1] * along[0]) / (step * step);
            assert!((area - std::f64::consts::PI).abs() < 1e-4, "{u} {v} {area}");
            assert!(at[0] * at[0] + at[1] * at[1] < 1.0);
        }
        assert_eq!(in_disc([0.5; 2]), [0.0; 2]);
        assert_eq!(in_disc([0.0, 0.5]), [-1.0, 0.0]);
        assert_eq!(in_disc([0.5, 0.0]), [0.0, -1.0]);
    }
}
