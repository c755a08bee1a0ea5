//! Spheres: |p - centre|^2 = radius^2.

use crate::crossing::{Found, Local, ratio};
use crate::quadratic::{Quadratic, Root, Side};
use crate::{Line, Passage, Place, Space, Triple};
use lancer_scene::Sphere;

pub(super) fn meet(sphere: &Sphere, space: &Space, line: &Line, bits: usize) -> Found {
    let origin = &line.origin - &space.point(sphere.centre.get());
    let radius_squared = space.length(sphere.radius.get()).squared();
    let equation = Quadratic {
        a: line.direction.norm_squared(),
        b: origin.dot(&line.direction),
        c: origin.norm_squared() - &radius_squared,
    };
    let from_centre = Line { origin, direction: line.direction.clone() };
    let list = equation.roots().into_iter().map(|root| {
        let t = equation.place(&root, bits);
        let normal = from_centre.at(&t);
        let passage = match root {
            Root::OneOfTwo(Side::First) => Passage::Enters,
            Root::OneOfTwo(Side::Second) => Passage::Leaves,
            Root::Double | Root::Only => Passage::Touches,
        };
        Local { t, normal, shading_normal: None, passage, face: 0, seam: f64::INFINITY }
    });
    // a r^2 - a h^2, where h is the line's distance from the centre.
    let gap = equation.discriminant();
    let size = &equation.a * &radius_squared;
    let largest = if gap.signum() < 0 { &size - &gap } else { size };
    Found { list: list.collect(), margin: ratio(&gap, &largest) / 2.0 }
}

pub(super) fn place(sphere: &Sphere, space: &Space, p: &Triple) -> Place {
    let from_centre = p - &space.point(sphere.centre.get());
    let radius_squared = space.length(sphere.radius.get()).squared();
    Place::of_sign(&(from_centre.norm_squared() - radius_squared))
}
