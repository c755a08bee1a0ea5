//! Scenes of which this engine promises less than it does of others (docs/stability.md has the ranges).

use crate::plan::TOGETHER;
use crate::{About, Lint};
use lancer_kernel::{LEAST_RADIUS, figure};
use lancer_scene::{Geometry, Group, Placed, Scene, Shape};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Of a camera whose coordinates are up to so many times its distance to the target, 2^30,
/// steps are too small for most pictures to show: of one scene, moved nearly so far, no more
/// than a pixel in a thousand is another by a level of 255.
const FARTHEST: f64 = 1_073_741_824.0;

/// Coordinates up to this can be squared, and the result multiplied with
/// another one, in double precision.
const LARGEST: f64 = 1e75;

pub(super) fn of(scene: &Scene) -> Vec<Lint> {
    let mut warnings = Vec::new();
    let camera = &scene.camera;
    let reach = camera.origin().get().coords.amax().max(camera.target().get().coords.amax());
    let mut of_camera = |message: String, label: &str, remedy: &str| {
        warnings.push(Lint::new(About::Camera, message, label, remedy));
    };
    if reach > LARGEST {
        of_camera(
            format!(
                "the camera is farther than {LARGEST:e} from the origin, where squares leave the \
                 range of numbers"
            ),
            "too far away",
            "scale the scene",
        );
    }
    let to_target = (camera.target().get() - camera.origin().get()).amax();
    if reach > FARTHEST * to_target && reach <= LARGEST {
        let apart = reach.next_up() - reach;
        of_camera(
            format!(
                "the camera is {reach:.1e} from the origin, where coordinates are {apart:.1e} apart, \
                 and {to_target:.1e} from its target: what is near it may look stepped"
            ),
            "far from the origin, for what it sees",
            "move the scene to the origin",
        );
    }
    let mut groups = BTreeSet::new();
    of_shapes(&scene.shapes, None, &mut warnings);
    in_groups(&scene.groups, &mut groups, &mut warnings);
    warnings
}

fn in_groups(groups: &[Placed], seen: &mut BTreeSet<*const Group>, warnings: &mut Vec<Lint>) {
    for placed in groups {
        if seen.insert(Arc::as_ptr(&placed.group)) {
            of_shapes(placed.group.shapes(), Some(&placed.group), warnings);
            in_groups(placed.group.groups(), seen, warnings);
        }
    }
}

/// Spheres that are too small or too large to be met; shapes that are too small for where they stand;
/// and transparent ones that enclose nothing, so that light enters their medium and never leaves it.
fn of_shapes(shapes: &[Shape], group: Option<&Group>, warnings: &mut Vec<Lint>) {
    let of = group.map_or_else(String::new, |group| match group.name() {
        Some(name) => format!(" of `{name}`"),
        None => " of a group".to_owned(),
    });
    for (i, shape) in shapes.iter().enumerate() {
        let about = if group.is_some() { About::Scene } else { About::Shape(i) };
        let (number, kind) = (i + 1, shape.geometry.kind());
        let mut warn = |what: &str, label: &str, remedy: &str| {
            let message = format!("shape {number}{of}, a {kind}, {what}");
            warnings.push(Lint::new(about, message, label, remedy));
        };
        if let Geometry::Sphere(sphere) = &shape.geometry
            && let radius = sphere.radius.get()
            && (radius < LEAST_RADIUS || radius * radius == f64::INFINITY)
        {
            warn(
                "is not seen, since the square of its radius leaves the range of numbers",
                "not seen",
                "scale the scene",
            );
        } else if let Some(bounds) = figure::bounds(shape)
            && let (size, reach) = (bounds.sides().amax(), bounds.reach())
            && let least = TOGETHER * reach
            && size < least
        {
            warn(
                &format!(
                    "stands {reach:.1e} from the origin, where surfaces nearer to one another than \
                     {least:.1e} are not told apart, and is smaller than that"
                ),
                "too small for where it stands",
                "move the scene to the origin",
            );
        }
        if !shape.surface.has_medium() || shape.geometry.is_closed() {
            continue;
        }
        let why = match shape.geometry {
            Geometry::Mesh(_) => "not each of its edges has a triangle on either side",
            _ => "it has no inside",
        };
        warn(
            &format!(
                "is transparent but not closed ({why}): what enters its medium there never leaves it"
            ),
            "not closed",
            "make it thin=\"true\", or close it",
        );
    }
}
