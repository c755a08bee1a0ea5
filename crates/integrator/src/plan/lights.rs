//! Which lights need not be asked.

use super::beams;
use super::sight::Sight;
use super::{Asked, Dropped, Reason};
use lancer_kernel::figure;
use lancer_math::{Placement, Point, Vector, unit};
use lancer_scene::{Falloff, Geometry, Length, Light, Placed, Plane, Projection, Scene, Shape};

/// What part of the error that is asked for may be due to lights that are left out.
const DIM_SHARE: f64 = 0.1;

/// How far from a plane, in roundings of coordinates, the eye and a light stand that are
/// taken to be on either side of it.
const CLEARANCE: f64 = 64.0 * f64::EPSILON;

/// The lights that change no picture, and those that change none by more than a share of the error
/// that is asked for.
///
/// *Without light.* A brightness of 0 lights nothing.
///
/// *Behind a plane.* An opaque plane cuts space in two, and neither rays nor light cross it. What
/// an eye sees, also in mirrors and through glass, is on its side, and no way from there to a light on
/// the other side does not meet the plane. A sun whose light comes from behind such a plane is on the
/// other side wherever one looks from.
///
/// *Aside.* A spot gives no light outside of its beam, so one whose beam meets no shape that may be
/// seen lights nothing that is ([`beams`]).
///
/// *Dim.* A white surface at the distance d from a lamp shows a radiance of at most its brightness
/// over d^2 (its brightness, without falloff), for a ball too if it is outside. Of a pixel's rays the
/// shares add up to 1 at most, so that is also the most that the lamp adds to a pixel, where d is
/// the distance of the nearest surface. The dimmest are left out for which all that, exposed, is
/// together within a tenth of the error.
pub(super) fn dropped(scene: &Scene, asked: &Asked, sight: &Sight<'_>) -> Vec<Dropped> {
    let mut dropped = Vec::new();
    let mut others = Vec::new();
    for (number, light) in scene.lights.iter().enumerate() {
        let why = if light.brightness().get() == 0.0 {
            Some(Reason::NoLight)
        } else {
            let wall = sight.planes.iter().find(|(_, plane)| hides(plane, scene, light));
            let behind = wall.map(|(shape, _)| Reason::Behind(*shape));
            behind.or_else(|| beams::is_aside(scene, light, sight).then_some(Reason::Aside))
        };
        match why {
            Some(why) => dropped.push(Dropped { light: number, why, most: 0.0 }),
            None => others.push((number, light)),
        }
    }
    if let (Some(error), Some(factor)) = (asked.error, asked.factor) {
        let mut left = DIM_SHARE * error;
        let most = |(number, light): &(usize, &Light)| {
            Some((factor * most(scene, light, left / factor)?, *number))
        };
        let mut dim: Vec<_> = others.iter().filter_map(most).collect();
        dim.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (most, light) in dim {
            // NaN is sorted last, and is more.
            if most > left || most.is_nan() {
                break;
            }
            left -= most;
            dropped.push(Dropped { light, why: Reason::Dim, most });
        }
    }
    dropped.sort_by_key(|dropped| dropped.light);
    dropped
}

/// Whether a plane stands between the eye and a light.
fn hides(plane: &Plane, scene: &Scene, light: &Light) -> bool {
    // Parallel rays start anywhere on a plane of their own.
    if matches!(scene.camera.projection, Projection::Orthographic(_)) {
        return false;
    }
    let Some(normal) = unit(plane.normal.get()) else { return false };
    let lens = scene.camera.aperture.map_or(0.0, Length::get);
    let eye = side(plane, &normal, &scene.camera.origin().get(), lens);
    let light = match light {
        Light::Sun { direction, .. } => match unit(direction.get()) {
            // Nearly along it, a ray may pass by rounding.
            Some(direction) if direction.dot(&normal).abs() > CLEARANCE => -direction.dot(&normal),
            _ => return false,
        },
        Light::Lamp { point, radius, .. } | Light::Spot { point, radius, .. } => {
            let radius = radius.map_or(0.0, Length::get);
            side(plane, &normal, &point.get(), radius)
        }
    };
    eye * light < 0.0
}

/// How far from a plane a ball is, with the sign of the side on which all of it is; 0 where that is
/// not sure.
fn side(plane: &Plane, normal: &Vector, centre: &Point, radius: f64) -> f64 {
    let origin = plane.origin.get();
    let distance = (centre - origin).dot(normal);
    let rounding = CLEARANCE * (centre.coords.amax() + origin.coords.amax());
    if distance.abs() > radius + rounding { distance } else { 0.0 }
}

/// The most that a light adds to a pixel's radiance, if it may be no more than `bound`.
fn most(scene: &Scene, light: &Light, bound: f64) -> Option<f64> {
    let brightness = light.brightness().get();
    match light {
        Light::Lamp { point, radius, falloff: Falloff::Square, .. }
        | Light::Spot { point, radius, falloff: Falloff::Square, .. } => {
            let near = (brightness / bound).sqrt().max(radius.map_or(0.0, Length::get));
            let distance = nearest((&scene.shapes, &scene.groups), &[], &point.get(), near)?;
            Some(brightness / (distance * distance))
        }
        _ => (brightness <= bound).then_some(brightness),
    }
}

/// How far a point is from the nearest shape, at least, each taken for the box around it; `None`
/// as soon as that is within `near`.
fn nearest(
    (shapes, groups): (&[Shape], &[Placed]),
    around: &[&Placement],
    point: &Point,
    near: f64,
) -> Option<f64> {
    let of_shape = |shape: &Shape| match (figure::bounds(shape), &shape.geometry) {
        (Some(bounds), _) => {
            let outside = around.iter().rev().fold(bounds, |b, placement| placement.bounds(&b));
            let off = (outside.min - point).sup(&(point - outside.max)).sup(&Vector::zeros());
            off.norm()
        }
        (None, Geometry::Plane(plane)) if around.is_empty() => {
            let normal = unit(plane.normal.get()).unwrap_or_else(Vector::zeros);
            (point - plane.origin.get()).dot(&normal).abs()
        }
        _ => 0.0,
    };
    let is_far = |distance: f64| (distance > near).then_some(distance);
    let own = shapes
        .iter()
        .try_fold(f64::INFINITY, |least, shape| Some(least.min(is_far(of_shape(shape))?)))?;
    // A million places are not looked at.
    if !groups.is_empty() && (around.len() >= MOST_LEVELS || groups.len() > MOST_GROUPS) {
        return None;
    }
    groups.iter().try_fold(own, |least, placed| {
        let around = [around, &[&placed.placement]].concat();
        let inside = (placed.group.shapes(), placed.group.groups());
        Some(least.min(nearest(inside, &around, point, near)?))
    })
}

/// Groups are looked into so many levels deep,
const MOST_LEVELS: usize = 2;
/// and where there are no more on one level.
const MOST_GROUPS: usize = 100;
