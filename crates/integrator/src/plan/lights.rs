//! Which lights need not be asked.

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
/// *Dim.* A white surface at the distance d from a lamp shows a radiance of at most its brightness
/// over d^2 (its brightness, without falloff), for a ball too if it is outside. Of a pixel's rays the
/// shares add up to 1 at most, so that is also the most that the lamp adds to a pixel, where d is
/// the distance of the nearest surface. The dimmest are left out for which all that, exposed, is
/// together within a tenth of the error.
pub(super) fn dropped(scene: &Scene, asked: &Asked) -> Vec<Dropped> {
    let mut dropped = Vec::new();
    let mut others = Vec::new();
    for (number, light) in scene.lights.iter().enumerate() {
        let why = if light.brightness().get() == 0.0 {
            Some(Reason::NoLight)
        } else {
            scene.shapes.iter().position(|shape| hides(shape, scene, light)).map(Reason::Behind)
        };
        match why {
            Some(why) => dropped.push(Dropped { light: number, why, most: 0.0 }),
            None => others.push((number, light)),
        }
    }
    if let (Some(error), Some(factor)) = (asked.error, asked.factor) {
        let mut left = DIM_SHARE * error;
        let mut dim: Vec<_> =
            others.iter().map(|(number, light)| (factor * most(scene, light), *number)).collect();
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

/// Whether an opaque plane stands between the eye and a light.
fn hides(shape: &Shape, scene: &Scene, light: &Light) -> bool {
    let Geometry::Plane(plane) = &shape.geometry else { return false };
    // Parallel rays start anywhere on a plane of their own.
    if shape.surface.is_transparent()
        || matches!(scene.camera.projection, Projection::Orthographic(_))
    {
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

/// The most that a light adds to a pixel's radiance.
fn most(scene: &Scene, light: &Light) -> f64 {
    let brightness = light.brightness().get();
    match light {
        Light::Sun { .. } => brightness,
        Light::Lamp { point, radius, falloff, .. } | Light::Spot { point, radius, falloff, .. } => {
            if *falloff == Falloff::None {
                return brightness;
            }
            let distance = nearest(&scene.shapes, &scene.groups, &[], &point.get());
            let radius = radius.map_or(0.0, Length::get);
            if distance > radius { brightness / (distance * distance) } else { f64::INFINITY }
        }
    }
}

/// How far a point is from the nearest shape, at least, each taken for the box around it.
fn nearest(shapes: &[Shape], groups: &[Placed], around: &[&Placement], point: &Point) -> f64 {
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
    let own = shapes.iter().map(of_shape).fold(f64::INFINITY, f64::min);
    groups.iter().fold(own, |least, placed| {
        // Not through more groups than are described: a million places are not looked at.
        if least == 0.0 || around.len() >= MOST_LEVELS || groups.len() > MOST_GROUPS {
            return 0.0;
        }
        let around = [around, &[&placed.placement]].concat();
        least.min(nearest(placed.group.shapes(), placed.group.groups(), &around, point))
    })
}

/// Groups are looked into so many levels deep,
const MOST_LEVELS: usize = 2;
/// and where there are no more on one level.
const MOST_GROUPS: usize = 100;
