//! The forms that textbooks have, as they stand there.

use super::float::{Float, Triple, cross, dot, minus};

/// The smaller of those that are above `least`.
fn first<F: Float>(roots: &[F], least: F) -> Option<F> {
    let ahead = roots.iter().copied().filter(|t| *t > least);
    ahead.reduce(|a, b| if b < a { b } else { a })
}

/// a t^2 + b t + c by the school's formula.
fn quadratic<F: Float>(a: F, b: F, c: F, least: F) -> Option<F> {
    let discriminant = b * b - F::of(4.0) * a * c;
    if discriminant < F::ZERO {
        return None;
    }
    let root = discriminant.sqrt();
    let twice = F::of(2.0) * a;
    first(&[(-b - root) / twice, (-b + root) / twice], least)
}

pub(super) fn sphere<F: Float>(
    (o, d): (Triple<F>, Triple<F>),
    centre: Triple<F>,
    radius: F,
    least: F,
) -> Option<F> {
    let oc = minus(o, centre);
    quadratic(dot(d, d), F::of(2.0) * dot(oc, d), dot(oc, oc) - radius * radius, least)
}

/// The side of a cylinder of radius 1 around the z axis.
pub(super) fn cylinder<F: Float>((o, d): (Triple<F>, Triple<F>)) -> Option<F> {
    let a = d[0] * d[0] + d[1] * d[1];
    let b = F::of(2.0) * (o[0] * d[0] + o[1] * d[1]);
    let c = o[0] * o[0] + o[1] * o[1] - F::of(1.0);
    quadratic(a, b, c, F::ZERO)
}

/// n . p = k, and a ray whose slope is below `parallel` is parallel.
pub(super) fn plane<F: Float>(
    (o, d): (Triple<F>, Triple<F>),
    normal: Triple<F>,
    k: F,
    parallel: F,
) -> Option<F> {
    let slope = dot(normal, d);
    if slope.abs() < parallel {
        return None;
    }
    first(&[(k - dot(normal, o)) / slope], F::ZERO)
}

/// Möller and Trumbore, *Fast, Minimum Storage Ray/Triangle Intersection*, 1997.
pub(super) fn triangle<F: Float>(
    (o, d): (Triple<F>, Triple<F>),
    [a, b, c]: [Triple<F>; 3],
) -> Option<F> {
    let (e1, e2) = (minus(b, a), minus(c, a));
    let p = cross(d, e2);
    let determinant = dot(e1, p);
    if determinant == F::ZERO {
        return None;
    }
    let inverse = F::of(1.0) / determinant;
    let s = minus(o, a);
    let u = dot(s, p) * inverse;
    let q = cross(s, e1);
    let v = dot(d, q) * inverse;
    if u < F::ZERO || v < F::ZERO || u + v > F::of(1.0) {
        return None;
    }
    first(&[dot(e2, q) * inverse], F::ZERO)
}

/// A ring of radius 1 around the z axis: the quartic's coefficients from the ray as it is.
pub(super) fn torus<F: Float>((o, d): (Triple<F>, Triple<F>), tube: F) -> Option<F> {
    let two = F::of(2.0);
    let four = F::of(4.0);
    let (dd, od, oo) = (dot(d, d), dot(o, d), dot(o, o));
    let k = oo - F::of(1.0) - tube * tube;
    let c4 = dd * dd;
    let c3 = four * dd * od;
    let c2 = two * dd * k + four * od * od + four * d[2] * d[2];
    let c1 = four * k * od + F::of(8.0) * o[2] * d[2];
    let c0 = k * k - four * (tube * tube - o[2] * o[2]);
    quartic([c0 / c4, c1 / c4, c2 / c4, c3 / c4])
}

/// The least positive root of t^4 + d t^3 + c t^2 + b t + a, by Ferrari's way (Schwarze, *Cubic
/// and Quartic Roots*, Graphics Gems, 1990).
fn quartic<F: Float>([a, b, c, d]: [F; 4]) -> Option<F> {
    let of = F::of;
    let square = d * d;
    let p = of(-3.0 / 8.0) * square + c;
    let q = of(1.0 / 8.0) * square * d - of(0.5) * d * c + b;
    let r = of(-3.0 / 256.0) * square * square + of(1.0 / 16.0) * square * c - of(0.25) * d * b + a;
    let z = cubic([of(0.5) * r * p - of(1.0 / 8.0) * q * q, -r, of(-0.5) * p]);
    let (u, v) = (z * z - r, of(2.0) * z - p);
    if u < F::ZERO || v < F::ZERO {
        return None;
    }
    let (u, v) = (u.sqrt(), v.sqrt());
    let v = if q < F::ZERO { -v } else { v };
    let shift = of(0.25) * d;
    let roots = [(v, z - u), (-v, z + u)].into_iter().flat_map(|(b, c)| {
        let half = of(0.5) * b;
        let root = (half * half - c).sqrt();
        [-half - root - shift, -half + root - shift]
    });
    let roots: Vec<F> = roots.collect();
    first(&roots, F::ZERO)
}

/// A root of z^3 + c z^2 + b z + a.
fn cubic<F: Float>([a, b, c]: [F; 3]) -> F {
    let of = F::of;
    let square = c * c;
    let p = of(1.0 / 3.0) * (of(-1.0 / 3.0) * square + b);
    let q = of(0.5) * (of(2.0 / 27.0) * square * c - of(1.0 / 3.0) * c * b + a);
    let cube = p * p * p;
    let discriminant = q * q + cube;
    let z = if discriminant < F::ZERO {
        let angle = of(1.0 / 3.0) * (-q / (-cube).sqrt()).acos();
        of(2.0) * (-p).sqrt() * angle.cos()
    } else {
        let root = discriminant.sqrt();
        (root - q).cbrt() - (root + q).cbrt()
    };
    z - of(1.0 / 3.0) * c
}
