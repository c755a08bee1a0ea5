//! Lamps that are balls: what a surface gets of their light, in closed form, and points
//! of them to look at where something may hide them.
//!
//! A ball of radius r shines with the same radiance from all of its surface, inward and
//! outward. As long as it is wholly above the horizon of a surface at a distance of D,
//! what arrives there is what would arrive from its centre: its solid angle, projected, is
//! pi (r/D)^2 cos theta (Lambert, *Photometria*, 1760). Where the horizon cuts it, the
//! projected solid angle is that of Snyder (*Area Light Sources for Real-Time Graphics*,
//! Microsoft Research, 1996). Both are the sum of what the parts of the ball send, so each
//! part that is hidden takes its share away.

mod part;
mod points;

use lancer_math::Vector;
use lancer_scene::Falloff;
use std::f64::consts::PI;

/// A ball lamp as a point of a surface sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ball {
    /// From the point to the ball's centre.
    way: Vector,
    /// The normals of length 1 on the side that is seen, to shade with and of the facet.
    normal: Vector,
    facet: Vector,
    radius: f64,
    /// The length of `way`, and its square.
    distance: f64,
    squared: f64,
    /// How far the centre is above the horizon.
    along: f64,
}

impl Ball {
    pub(super) fn new(way: Vector, radius: f64, [normal, facet]: [Vector; 2]) -> Self {
        let (squared, along) = (way.norm_squared(), way.dot(&normal));
        Self { way, normal, facet, radius, distance: squared.sqrt(), squared, along }
    }

    /// The radiance of a white matte surface that nothing hides the lamp from; but for the
    /// facet itself, where that is turned otherwise.
    ///
    /// Where light does not fall off, it is so many times more as the square of the
    /// distance is; within the ball, as the square of its radius is.
    pub(super) fn strength(&self, brightness: f64, falloff: Falloff) -> f64 {
        let Self { radius, distance, squared, along, .. } = *self;
        if self.is_inside() {
            return match falloff {
                Falloff::Square => brightness / (radius * radius),
                Falloff::None => brightness,
            };
        }
        if along >= radius {
            // With the bits of a lamp that is a point.
            return match falloff {
                Falloff::Square => brightness * along / (squared * distance),
                Falloff::None => brightness * along / distance,
            };
        }
        if along <= -radius || along.is_nan() {
            return 0.0;
        }
        let cosine = mean_cosine(along / radius, radius / distance, self.tangent());
        match falloff {
            Falloff::Square => brightness * cosine / squared,
            Falloff::None => brightness * cosine,
        }
    }

    /// Whether the facet hides nothing of what is above the horizon.
    pub(super) fn is_before_facet(&self) -> bool {
        self.facet == self.normal || !self.is_inside() && self.way.dot(&self.facet) >= self.radius
    }

    fn is_inside(&self) -> bool {
        self.distance <= self.radius
    }

    /// How long a tangent from the point to the ball is, of `distance`: the cosine of half
    /// the angle that the ball fills. The point is outside.
    fn tangent(&self) -> f64 {
        ((self.distance - self.radius) * (self.distance + self.radius)).sqrt() / self.distance
    }
}

/// What takes the place of the cosine of a lamp that is a point where the horizon cuts the
/// ball: the projected solid angle of what is above, over pi `sine`^2, where `sine` and
/// `tangent` are those of half the angle that the ball fills (sine^2 + tangent^2 = 1), and
/// `height` says how far its centre is above the horizon, over its radius.
///
/// Snyder's formula is a difference of nearly equal numbers where the ball is small. Here
/// it is arranged so that what is lost is a few units in the last place of `sine`, which
/// is the size of the result:
///
/// pi F / sine^2 = sine (height a + w / tangent) - (u - atan u) / sine^2
///
/// with w^2 = 1 - height^2, u = w sine / tangent and a the angle whose sine and
/// cosine are as w and -height tangent.
fn mean_cosine(height: f64, sine: f64, tangent: f64) -> f64 {
    let w = ((1.0 - height) * (1.0 + height)).sqrt();
    let u = w * sine / tangent;
    let angle = libm::atan2(w, -height * tangent);
    let sum = if u < 0.25 {
        let v = w / tangent;
        sine * (height * angle + v) - v * v * u * behind_atan(u * u)
    } else {
        sine * height * angle + (libm::atan(u) - w * sine * tangent) / (sine * sine)
    };
    // Where nearly nothing is above, rounding may take more than there is.
    (sum / PI).max(0.0)
}

/// (u - atan u) / u^3 for a square of u below 1/16: 1/3 - u^2/5 + u^4/7 ...
fn behind_atan(square: f64) -> f64 {
    (0..14).rev().fold(0.0, |sum, n| 1.0 / f64::from(2 * n + 3) - square * sum)
}

#[cfg(test)]
mod tests;
