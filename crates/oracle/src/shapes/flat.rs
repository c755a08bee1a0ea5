//! Planes, discs, rectangles and triangles. Everything is decided by signs of
//! exact products.

use crate::crossing::{Found, Local, ratio, sine};
use crate::{Line, Number, Passage, Place, Space, Triple};
use lancer_scene::{Disc, Plane, Rectangle, Triangle};

/// Where a line passes a plane: at n / d, with d above 0.
struct Pierced {
    n: Number,
    d: Number,
    passage: Passage,
    sine: f64,
}

/// `None` for a line along the plane.
fn pierce(line: &Line, point: &Triple, normal: &Triple) -> Option<Pierced> {
    let d = normal.dot(&line.direction);
    let n = normal.dot(&(point - &line.origin));
    let passage = Passage::through(normal, &line.direction);
    let sine = sine(normal, &line.direction);
    match d.signum() {
        0 => None,
        1 => Some(Pierced { n, d, passage, sine }),
        _ => Some(Pierced { n: -n, d: -d, passage, sine }),
    }
}

impl Pierced {
    /// d times the place, seen from `from`.
    fn place(&self, line: &Line, from: &Triple) -> Triple {
        &(&line.origin - from).times(&self.d) + &line.direction.times(&self.n)
    }

    fn crossing(&self, normal: Triple, bits: usize) -> Local {
        Local {
            t: self.n.over(&self.d, bits),
            normal,
            shading_normal: None,
            passage: self.passage,
            face: 0,
            seam: f64::INFINITY,
        }
    }

    fn found(&self, within: bool, margin: f64, normal: Triple, bits: usize) -> Found {
        let list = if within { vec![self.crossing(normal, bits)] } else { vec![] };
        Found { list, margin: margin * self.sine }
    }
}

pub(super) fn meet_plane(plane: &Plane, space: &Space, line: &Line, bits: usize) -> Found {
    let normal = plane.normal.get().into();
    match pierce(line, &space.point(plane.origin.get()), &normal) {
        None => Found::nothing(0.0),
        Some(pierced) => pierced.found(true, 1.0, normal, bits),
    }
}

pub(super) fn place(plane: &Plane, space: &Space, p: &Triple) -> Place {
    let normal: Triple = plane.normal.get().into();
    Place::of_sign(&normal.dot(&(p - &space.point(plane.origin.get()))))
}

pub(super) fn meet_disc(disc: &Disc, space: &Space, line: &Line, bits: usize) -> Found {
    let centre = space.point(disc.centre.get());
    let normal = disc.normal.get().into();
    let Some(pierced) = pierce(line, &centre, &normal) else {
        return Found::nothing(0.0);
    };
    let radius = space.length(disc.radius.get()) * &pierced.d;
    let distance_squared = pierced.place(line, &centre).norm_squared();
    let radius_squared = radius.squared();
    let gap = &radius_squared - &distance_squared;
    let margin = ratio(&gap, &radius_squared.max(distance_squared)) / 2.0;
    pierced.found(gap.signum() >= 0, margin, normal, bits)
}

pub(super) fn meet_rectangle(
    rectangle: &Rectangle,
    space: &Space,
    line: &Line,
    bits: usize,
) -> Found {
    let corner = space.point(rectangle.corner());
    let [u, v] = rectangle.sides().map(|side| Triple::from(side.get()));
    let normal = u.cross(&v);
    let Some(pierced) = pierce(line, &corner, &normal) else {
        return Found::nothing(0.0);
    };
    let place = pierced.place(line, &corner);
    // How many sides along u and along v, times one and the same.
    let counts = [place.cross(&v).dot(&normal), u.cross(&place).dot(&normal)];
    let one = &pierced.d * normal.norm_squared() * space.stretch();
    let gaps = counts.iter().flat_map(|count| [count.clone(), &one - count]);
    let (mut within, mut margin) = (true, f64::INFINITY);
    for gap in gaps {
        within &= gap.signum() >= 0;
        margin = margin.min(ratio(&gap, &one));
    }
    pierced.found(within, margin, normal, bits)
}

pub(super) fn meet_triangle(triangle: &Triangle, space: &Space, line: &Line, bits: usize) -> Found {
    let corners = triangle.corners().map(|corner| space.point(corner));
    facet(&corners, line, bits).0
}

/// Where a line meets a triangle, and the parts of the corners there (of any
/// sum) if it does.
pub(super) fn facet(corners: &[Triple; 3], line: &Line, bits: usize) -> (Found, [Number; 3]) {
    let [a, b, c] = corners.each_ref().map(|corner| corner - &line.origin);
    let (ab, bc, ca) = (&b - &a, &c - &b, &a - &c);
    // Six times the volumes between the line and each side.
    let parts = [(&b, &c), (&c, &a), (&a, &b)].map(|(p, q)| line.direction.dot(&p.cross(q)));
    let signs = parts.each_ref().map(Number::signum);
    let within = signs.iter().all(|s| *s >= 0) || signs.iter().all(|s| *s <= 0);
    let longest = [ab.norm_squared(), bc.norm_squared(), ca.norm_squared()];
    let longest = longest.iter().max().cloned().unwrap_or_else(Number::zero);
    // A side's distance from the line is at least its volume over the product of
    // the lengths of both.
    let size_squared = line.direction.norm_squared() * longest.squared();
    let nearest = parts.iter().map(Number::abs).min().unwrap_or_else(Number::zero);
    let margin = ratio(&nearest.squared(), &size_squared).sqrt();
    let normal = ab.cross(&-&ca);
    let Some(pierced) = pierce(line, &corners[0], &normal) else {
        return (Found::nothing(0.0), parts);
    };
    let list = if within { vec![pierced.crossing(normal, bits)] } else { vec![] };
    (Found { list, margin }, parts)
}
