//! The product's forms for spheres, planes and triangles once more, for any precision: to see
//! what they would be worth in single.

use super::float::{Float, Triple, dot, minus};

fn two_sum<F: Float>(a: F, b: F) -> (F, F) {
    let sum = a + b;
    let back = sum - a;
    (sum, (a - (sum - back)) + (b - back))
}

fn two_product<F: Float>(a: F, b: F) -> (F, F) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

/// origin - centre + t direction.
pub(super) fn stepped<F: Float>(
    (o, d): (Triple<F>, Triple<F>),
    centre: Triple<F>,
    t: F,
) -> Triple<F> {
    std::array::from_fn(|i| {
        let (difference, lost) = two_sum(o[i], -centre[i]);
        let (step, step_lost) = two_product(t, d[i]);
        let (sum, sum_lost) = two_sum(difference, step);
        sum + (sum_lost + (lost + step_lost))
    })
}

/// The nearer crossing from outside.
pub(super) fn sphere<F: Float>(
    ray: (Triple<F>, Triple<F>),
    centre: Triple<F>,
    radius: F,
) -> Option<F> {
    let (o, d) = ray;
    let squared = dot(d, d);
    let shift = -(dot(minus(o, centre), d) / squared);
    let near = stepped(ray, centre, shift);
    let along = dot(near, d) / squared;
    let p: Triple<F> = std::array::from_fn(|i| d[i].mul_add(-along, near[i]));
    let p = dot(p, p).sqrt();
    let under_root = (radius - p) * (radius + p);
    let t = shift - along - (under_root / squared).sqrt();
    (under_root >= F::ZERO && t > F::ZERO).then_some(t)
}

pub(super) fn plane<F: Float>(
    (o, d): (Triple<F>, Triple<F>),
    normal: Triple<F>,
    origin: Triple<F>,
) -> Option<F> {
    let t = dot(normal, minus(origin, o)) / dot(normal, d);
    (t > F::ZERO).then_some(t)
}

/// Whether the ray goes through a triangle, with signs that are exact.
pub(super) fn meets<F: Float>((o, d): (Triple<F>, Triple<F>), corners: [Triple<F>; 3]) -> bool {
    let longest = (0..3).fold(0, |k, i| if d[i].abs() > d[k].abs() { i } else { k });
    let (i, j) = ((longest + 1) % 3, (longest + 2) % 3);
    let [a, b, c] = corners.map(|corner| {
        let at = minus(corner, o);
        let z = at[longest];
        [at[i] - d[i] / d[longest] * z, at[j] - d[j] / d[longest] * z]
    });
    let sides = [side(b, c), side(c, a), side(a, b)];
    sides.iter().all(|s| *s > F::ZERO) || sides.iter().all(|s| *s < F::ZERO)
}

fn side<F: Float>(p: [F; 2], q: [F; 2]) -> F {
    let (first, second) = (p[0] * q[1], p[1] * q[0]);
    let sign = if first == second {
        p[0].mul_add(q[1], -first) - p[1].mul_add(q[0], -second)
    } else {
        first - second
    };
    if sign != F::ZERO {
        sign
    } else if p[1] == q[1] {
        q[0] - p[0]
    } else {
        p[1] - q[1]
    }
}
