//! Where to aim at: points on surfaces, with normals, and on edges. They are only
//! aimed at, so their roundings are of no matter.

use fastrand::Rng;
use lancer_math::{Point, Vector, sin_cos_degrees, unit};

/// A piece of a surface.
#[derive(Debug, Clone)]
pub(crate) enum Patch {
    Ball(Point, f64),
    Triangle([Point; 3]),
    Parallelogram(Point, [Vector; 2]),
    Disc(Point, Vector, f64),
    /// From circle to circle.
    Side([Point; 2], [f64; 2]),
    Ring(Point, Vector, [f64; 2]),
}

/// A piece of an edge.
#[derive(Debug, Clone)]
pub(crate) enum Curve {
    Segment([Point; 2]),
    Circle(Point, Vector, f64),
}

/// What to aim at.
#[derive(Debug, Clone)]
pub(crate) struct Sample {
    pub(crate) patches: Vec<Patch>,
    pub(crate) curves: Vec<Curve>,
    /// A ball around the shape, or around the part of a plane that is aimed at.
    pub(crate) centre: Point,
    pub(crate) size: f64,
}

/// 10^x for x between these.
pub(crate) fn power_of_ten(rng: &mut Rng, from: f64, to: f64) -> f64 {
    libm::exp10(between(rng, from, to))
}

pub(crate) fn between(rng: &mut Rng, from: f64, to: f64) -> f64 {
    from + (to - from) * rng.f64()
}

pub(crate) fn any_direction(rng: &mut Rng) -> Vector {
    loop {
        let v = Vector::from([(); 3].map(|()| between(rng, -1.0, 1.0)));
        if v.norm() <= 1.0 && v.norm() > 0.01 {
            return v / v.norm();
        }
    }
}

/// Two unit vectors across `axis` and each other.
pub(crate) fn across(axis: Vector) -> [Vector; 2] {
    let axis = unit(axis).expect("not zero");
    let other = if axis.x.abs() < 0.5 { Vector::x() } else { Vector::y() };
    let u = unit(axis.cross(&other)).expect("not parallel");
    [u, axis.cross(&u)]
}

/// A random direction across `axis`.
fn around(rng: &mut Rng, axis: Vector) -> Vector {
    let [u, v] = across(axis);
    // Quarters, too: they are where coordinates are 0.
    let degrees =
        if rng.u8(..8) == 0 { 90.0 * f64::from(rng.u8(..4)) } else { between(rng, 0.0, 360.0) };
    let (sine, cosine) = sin_cos_degrees(degrees);
    u * cosine + v * sine
}

impl Patch {
    pub(crate) fn point(&self, rng: &mut Rng) -> (Point, Vector) {
        match self {
            Self::Ball(centre, radius) => {
                let n = any_direction(rng);
                (centre + n * *radius, n)
            }
            Self::Triangle([a, b, c]) => {
                let (mut u, mut v) = (rng.f64(), rng.f64());
                if u + v > 1.0 {
                    (u, v) = (1.0 - u, 1.0 - v);
                }
                let n = unit((b - a).cross(&(c - a))).unwrap_or_else(Vector::z);
                (a + (b - a) * u + (c - a) * v, n)
            }
            Self::Parallelogram(corner, [u, v]) => {
                let n = unit(u.cross(v)).unwrap_or_else(Vector::z);
                (corner + u * rng.f64() + v * rng.f64(), n)
            }
            Self::Disc(centre, normal, radius) => {
                let away = around(rng, *normal) * (radius * rng.f64().sqrt());
                (centre + away, unit(*normal).expect("not zero"))
            }
            Self::Side([base, top], [from, to]) => {
                let (axis, s) = (top - base, rng.f64());
                let out = around(rng, axis);
                let n = out * axis.norm() - axis * ((to - from) / axis.norm());
                (base + axis * s + out * (from + (to - from) * s), unit(n).expect("not zero"))
            }
            Self::Ring(centre, axis, [ring, tube]) => {
                let out = around(rng, *axis);
                let n = around(rng, out.cross(axis));
                (centre + out * *ring + n * *tube, n)
            }
        }
    }
}

impl Sample {
    /// A point of the surface and the normal there.
    pub(crate) fn on_surface(&self, rng: &mut Rng) -> (Point, Vector) {
        self.patches[rng.usize(..self.patches.len())].point(rng)
    }

    /// A point of an edge; of the surface where it has no edge.
    pub(crate) fn on_edge(&self, rng: &mut Rng) -> Point {
        if self.curves.is_empty() {
            return self.on_surface(rng).0;
        }
        match &self.curves[rng.usize(..self.curves.len())] {
            Curve::Segment([from, to]) => match rng.u8(..4) {
                0 => from + (to - from) * 0.5,
                _ => from + (to - from) * rng.f64(),
            },
            Curve::Circle(centre, axis, radius) => centre + around(rng, *axis) * *radius,
        }
    }

    /// The end of an edge, if it has one.
    pub(crate) fn on_corner(&self, rng: &mut Rng) -> Point {
        if self.curves.is_empty() {
            return self.on_surface(rng).0;
        }
        match &self.curves[rng.usize(..self.curves.len())] {
            Curve::Segment(ends) => ends[usize::from(rng.bool())],
            Curve::Circle(centre, axis, radius) => centre + around(rng, *axis) * *radius,
        }
    }

    /// A point inside, where there is such a thing: all but the ring can be seen
    /// from their middle.
    pub(crate) fn inside(&self, rng: &mut Rng) -> Point {
        let (point, normal) = self.on_surface(rng);
        match self.patches[..] {
            [Patch::Ring(_, _, [_, tube])] => point - normal * (2.0 * tube * rng.f64()),
            _ => point + (self.centre - point) * rng.f64(),
        }
    }
}
