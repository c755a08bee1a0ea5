//! Which spots light something.

use super::sight::{Sight, around_placed};
use lancer_kernel::figure;
use lancer_math::{Bounds, Point, Vector, unit};
use lancer_scene::{Geometry, Light, Scene, Shape};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

/// With more shapes than these, beams are not held against each.
const MOST_SHAPES: usize = 1000;
/// Of lengths: far more than rounding.
const MARGIN: f64 = 1e-9;
/// Of angles in radians: one near 0 or half a turn is known to the root of the precision.
const ANGLE_MARGIN: f64 = 1e-7;

/// In radians: planes that touch wider beams are not looked for. They would be less certain, and a beam
/// without such a plane is taken to meet what it may meet.
const WIDEST: f64 = 1.5;
/// As a sine: what is nearer to the axis has no side of it.
const LEAST_ASIDE: f64 = 1e-3;

/// The light of a spot: the directions from a point within an angle of an axis.
struct Cone {
    apex: Point,
    axis: Vector,
    angle: f64,
}

/// Whether no shape that may be seen is met by the beam of a spot. Never of other lights.
pub(super) fn is_aside(scene: &Scene, light: &Light, sight: &Sight<'_>) -> bool {
    let Light::Spot { point, axis, beam, .. } = light else { return false };
    let Some(axis) = unit(axis.get()) else { return false };
    if scene.shapes.len() + scene.groups.len() > MOST_SHAPES {
        return false;
    }
    let cone = Cone { apex: point.get(), axis, angle: beam.outer().get().to_radians() };
    let is_lit = |bounds: Option<Bounds>| {
        sight.may_see(bounds) && bounds.is_none_or(|bounds| cone.meets_box(&bounds))
    };
    let shape = |shape: &Shape| match &shape.geometry {
        Geometry::Plane(plane) => cone.meets_plane(&plane.origin.get(), &plane.normal.get()),
        _ => is_lit(figure::bounds(shape)),
    };
    let mut known = BTreeMap::new();
    !scene.shapes.iter().any(shape)
        && !scene.groups.iter().any(|placed| is_lit(around_placed(placed, &mut known)))
}

impl Cone {
    /// Whether some point of a box may be in it: if neither the ball around the box is outside of
    /// it, nor the box beyond one of the planes that touch it.
    fn meets_box(&self, bounds: &Bounds) -> bool {
        !self.misses_ball(&bounds.centre(), 0.5 * bounds.sides().norm())
            && !self.has_plane_to(bounds)
    }

    /// Whether the angle between the axis and a ball's middle is larger than its own and that under which
    /// the ball's radius is seen.
    fn misses_ball(&self, centre: &Point, radius: f64) -> bool {
        let way = centre - self.apex;
        let distance = way.norm();
        if distance <= radius * (1.0 + MARGIN) || !distance.is_finite() {
            return false;
        }
        let apart = libm::acos((way.dot(&self.axis) / distance).clamp(-1.0, 1.0));
        apart > self.angle + libm::asin(radius / distance) + ANGLE_MARGIN
    }

    /// Whether a plane through the apex, which it does not cross, has a box on its other side. Those
    /// are tried that touch it on the sides of the box's corners and middle.
    fn has_plane_to(&self, bounds: &Bounds) -> bool {
        let angle = self.angle + ANGLE_MARGIN;
        if angle > WIDEST {
            return false;
        }
        let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
        let corners = bounds.corners();
        let rounding = MARGIN * (bounds.reach() + self.apex.coords.amax());
        let is_beyond = |normal: Vector| {
            corners.iter().all(|corner| normal.dot(&(corner - self.apex)) > rounding)
        };
        let touching = |point: &Point| {
            let way = point - self.apex;
            let aside = way - self.axis * way.dot(&self.axis);
            // Of what is along the axis, rounding would say on which side of it that is.
            let is_known = aside.norm() > LEAST_ASIDE * way.norm();
            let aside = unit(aside).filter(|_| is_known)?;
            Some(aside * cosine - self.axis * sine)
        };
        let middle = [bounds.centre()];
        let mut towards = corners.iter().chain(&middle).filter_map(touching);
        is_beyond(-self.axis) || towards.any(is_beyond)
    }

    /// Whether some direction of it leads to a plane.
    fn meets_plane(&self, origin: &Point, normal: &Vector) -> bool {
        let Some(normal) = unit(*normal) else { return true };
        let off = (self.apex - origin).dot(&normal);
        let rounding = MARGIN * (self.apex.coords.amax() + origin.coords.amax());
        if off.abs() <= rounding || !off.is_finite() {
            return true;
        }
        // The angle between the axis and the shortest way to the plane.
        let apart = libm::acos((-off.signum() * normal.dot(&self.axis)).clamp(-1.0, 1.0));
        apart <= self.angle + FRAC_PI_2 + ANGLE_MARGIN
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastrand::Rng;

    /// Against points of boxes, and against directions.
    #[test]
    fn what_a_beam_meets_is_never_missed_and_most_else_is() {
        let mut rng = Rng::with_seed(8);
        let (mut missed, mut wrongly_met) = (0, 0);
        for case in 0..4000 {
            let mut vector = || Vector::from_fn(|_, _| 2.0 * rng.f64() - 1.0);
            let apex = Point::from(vector());
            let (from, size) = (Point::from(vector() * 3.0), vector().abs());
            let origin = Point::from(vector());
            let bounds = Bounds { min: from, max: from + size };
            // Anywhere, or straight to the middle or to a corner, or nearly so.
            let near = vector() * [0.0, 0.0, 1e-15, 1e-9, 1e-4][case % 5];
            let axis = match case % 3 {
                0 => vector(),
                1 => bounds.centre() - apex + near,
                _ => bounds.corners()[case % 8] - apex + near,
            };
            let axis = unit(axis).expect("not zero");
            let cone = Cone { apex, axis, angle: rng.f64() * [2.5, 0.3][case % 2] };
            let is_in = |point: &Point| {
                let way = point - cone.apex;
                way.dot(&cone.axis) >= way.norm() * libm::cos(cone.angle)
            };
            let mut some = (0..300).map(|_| from + size.map(|side| side * rng.f64()));
            let is_met = some.any(|point| is_in(&point));
            assert!(cone.meets_box(&bounds) || !is_met);
            missed += usize::from(!cone.meets_box(&bounds));
            wrongly_met += usize::from(cone.meets_box(&bounds) && !is_met);
            // A plane across the third axis is met by a ray that goes to it.
            let normal = Vector::new(0.0, 0.0, 1.5);
            let mut rays = (0..300).map(|_| Vector::from_fn(|_, _| 2.0 * rng.f64() - 1.0));
            let off = origin.z - apex.z;
            let is_met = rays.any(|ray| is_in(&(cone.apex + ray)) && ray.z * off > 0.0);
            assert!(cone.meets_plane(&origin, &normal) || !is_met);
        }
        assert!(missed > 700 && wrongly_met < 100, "{missed} {wrongly_met}");
    }
}
