//! Boxes with sides along the axes.
//!
//! Kay and Kajiya's slabs (*Ray Tracing Complex Scenes*, 1986), with divisions
//! and not with products of inverses, so that t has but two roundings. Which of
//! two faces is the near one is told by the bit of the direction's sign; along an
//! axis in which the ray does not move, the origin is between the faces or there
//! is no hit. The faces belong to the box: a ray in a face is inside. The normal
//! is that of the face by which the ray came in, not found from the point.

use super::clip::{Cut, Stretch};
use crate::Crossing;
use crate::checker;
use crate::crossing::Crossings;
use crate::primitive::{Contact, Primitive, Square};
use lancer_math::{Bounds, Point, Ray, Vector};
use lancer_scene::{Checker, Cuboid};

/// Part 2 k is the face with the smallest, part 2 k + 1 that with the largest
/// coordinate k.
#[derive(Debug)]
pub(crate) struct Slabs {
    bounds: Bounds,
}

impl Slabs {
    pub(crate) fn new(cuboid: &Cuboid) -> Self {
        Self { bounds: Bounds { min: cuboid.min(), max: cuboid.max() } }
    }
}

impl Slabs {
    /// The same, with quotients that are compared exactly where rounding makes
    /// them equal.
    #[cold]
    fn exact_crossings(&self, ray: &Ray) -> Crossings {
        let Some(mut inside) = Stretch::of(ray) else { return Crossings::NONE };
        for (axis, part) in [(0, 0), (1, 2), (2, 4)] {
            let (o, d) = (ray.origin[axis], ray.direction[axis]);
            let (min, max) = (self.bounds.min[axis], self.bounds.max[axis]);
            if d > 0.0 {
                inside.enter(Cut::new(min - o, d, part));
                inside.leave(Cut::new(max - o, d, part + 1));
            } else if d < 0.0 {
                inside.enter(Cut::new(max - o, d, part + 1));
                inside.leave(Cut::new(min - o, d, part));
            }
        }
        inside.ends()
    }
}

impl Primitive for Slabs {
    #[inline]
    fn crossings(&self, ray: &Ray) -> Crossings {
        let (mut enter, mut leave) = ([f64::NEG_INFINITY; 3], [f64::INFINITY; 3]);
        for axis in 0..3 {
            let (o, d) = (ray.origin[axis], ray.direction[axis]);
            let (min, max) = (self.bounds.min[axis], self.bounds.max[axis]);
            if d == 0.0 {
                if !(min..=max).contains(&o) {
                    return Crossings::NONE;
                }
            } else {
                let (near, far) = if d > 0.0 { (min, max) } else { (max, min) };
                enter[axis] = (near - o) / d;
                leave[axis] = (far - o) / d;
            }
        }
        let from = enter[0].max(enter[1]).max(enter[2]);
        let to = leave[0].min(leave[1]).min(leave[2]);
        if from == to {
            return self.exact_crossings(ray);
        }
        let mut crossings = Crossings::NONE;
        let sum = ray.origin.coords.sum() + ray.direction.sum();
        let finite = from > f64::NEG_INFINITY && to < f64::INFINITY && !sum.is_nan();
        if from < to && finite {
            let face = |list: &[f64; 3], t: f64, entering: bool| {
                let axis = if list[0] == t { 0 } else { 1 + usize::from(list[1] != t) };
                let at_max = entering == (ray.direction[axis] < 0.0);
                2 * axis as u32 + u32::from(at_max)
            };
            crossings.add(from, face(&enter, from, true));
            crossings.add(to, face(&leave, to, false));
        }
        crossings
    }

    /// The coordinate across the face is exact, the others are kept within it:
    /// the point is on the surface. An error of 0 would not say how far doubles
    /// can tell points apart there, so it is some units in the last place.
    fn contact(&self, ray: &Ray, crossing: &Crossing) -> Contact {
        let Bounds { min, max } = self.bounds;
        let inside = ray.at(crossing.t).coords.sup(&min.coords).inf(&max.coords);
        let mut point = Point::from(inside);
        let axis = crossing.part as usize / 2;
        let mut normal = Vector::zeros();
        (point[axis], normal[axis]) =
            if crossing.part.is_multiple_of(2) { (min[axis], -1.0) } else { (max[axis], 1.0) };
        let error = 2.0 * f64::EPSILON * self.bounds.reach();
        Contact { point, error, normal, shading: normal }
    }

    /// Squares on each face from the corner with the smallest coordinates.
    fn square(&self, contact: &Contact, part: u32, checker: &Checker) -> Square {
        let length = checker.length.get();
        let at = (contact.point - self.bounds.min) / length;
        let axis = part as usize / 2;
        let slack = checker::slack(contact.error, length);
        checker::square([at[(axis + 1) % 3], at[(axis + 2) % 3]], [slack; 2])
    }

    fn bounds(&self) -> Option<Bounds> {
        Some(self.bounds)
    }

    fn contains(&self, point: &Point) -> bool {
        let Bounds { min, max } = &self.bounds;
        (0..3).all(|axis| min[axis] < point[axis] && point[axis] < max[axis])
    }

    fn volume(&self) -> f64 {
        self.bounds.sides().product()
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{
        check_leaving, check_pairs, check_scaling, direction, ray, ray_to, ts, worst_error,
    };
    use super::*;
    use crate::primitive::Cell;
    use fastrand::Rng;
    use lancer_scene::{Colour, Position};

    fn cuboid(from: [f64; 3], to: [f64; 3]) -> Slabs {
        let [from, to] = [from, to].map(|p| Position::new(p).unwrap());
        Slabs::new(&Cuboid::new(from, to).unwrap())
    }

    fn signs(c: [f64; 3]) -> impl Iterator<Item = [f64; 3]> {
        (0..8).map(move |bits| {
            std::array::from_fn(|i| if bits >> i & 1 == 1 && c[i] == 0.0 { -c[i] } else { c[i] })
        })
    }

    /// Atlas B1 and B2.
    #[test]
    fn a_ray_in_a_face_is_inside() {
        let unit = cuboid([0.0; 3], [1.0; 3]);
        for origin in [[0.0, 0.5, -1.0], [1.0, 0.5, -1.0], [0.0, 0.0, -1.0], [0.5, 0.5, -1.0]] {
            for o in signs(origin) {
                for d in signs([0.0, 0.0, 1.0]) {
                    assert_eq!(ts(&unit, &ray(o, d)), [1.0, 2.0], "{o:?} {d:?}");
                }
            }
        }
        for d in signs([0.0, 0.0, 1.0]) {
            assert!(ts(&unit, &ray([2.0, 0.5, -1.0], d)).is_empty());
        }
        for d in [[0.0; 3], [0.0, f64::NAN, 1.0], [f64::NAN; 3]] {
            assert!(ts(&unit, &ray([0.5; 3], d)).is_empty());
        }
        assert!(ts(&unit, &ray([0.5, f64::NAN, 0.5], [0.0, 0.0, 1.0])).is_empty());
        assert_eq!(ts(&unit, &ray([0.5, 0.5, -1.0], [0.0, 0.0, 1e-310])).len(), 0);
    }

    /// Atlas B3: the normal is that of the face, also on thin boxes.
    #[test]
    fn normals_of_thin_boxes() {
        let thin = cuboid([-1.0, -1e-6, -1.0], [1.0, 1e-6, 1.0]);
        let from = ray([0.999_95, 3.0, 0.0], [0.0, -1.0, 0.0]);
        let crossing = thin.nearest(&from, 10.0).unwrap();
        let contact = thin.contact(&from, &crossing);
        assert_eq!((contact.normal, contact.point.y), (Vector::y(), 1e-6));
    }

    /// Whole numbers through edges, corners and past them, compared with the
    /// exact intervals: fractions of whole numbers, by cross-multiplication.
    #[test]
    fn decisions_are_those_of_rational_arithmetic() {
        let mut rng = Rng::with_seed(6);
        let (min, max) = ([-3_i128, 1, -10], [5_i128, 2, 7]);
        let shape = cuboid(min.map(|c| c as f64), max.map(|c| c as f64));
        let mut met = 0;
        for case in 0..200_000 {
            let mut whole = |n: i32| i128::from(rng.i32(-n..=n));
            let d = [whole(1000), whole(1000), whole(1000)];
            let steps = whole(1000);
            // At a corner, from whole numbers away, and perhaps a bit past it.
            let o: [i128; 3] = std::array::from_fn(|i| {
                let corner = if whole(1) > 0 { min[i] } else { max[i] };
                corner - steps * d[i] + if whole(9) == 0 { whole(1) } else { 0 }
            });
            let (mut from, mut to) = ((-1_i128, 0_i128), (1_i128, 0_i128));
            let mut expected = d != [0; 3];
            for i in 0..3 {
                if d[i] == 0 {
                    expected &= min[i] <= o[i] && o[i] <= max[i];
                    continue;
                }
                let (near, far) =
                    if d[i] > 0 { (min[i], max[i]) } else { (o[i] - max[i], o[i] - min[i]) };
                let (near, far, d) =
                    if d[i] > 0 { (near - o[i], far - o[i], d[i]) } else { (near, far, -d[i]) };
                if near * from.1 > from.0 * d {
                    from = (near, d);
                }
                if far * to.1 < to.0 * d {
                    to = (far, d);
                }
            }
            expected &= from.0 * to.1 <= to.0 * from.1;
            let found = ts(&shape, &ray(o.map(|c| c as f64), d.map(|c| c as f64)));
            assert_eq!(found.len(), if expected { 2 } else { 0 }, "case {case}: {o:?} {d:?}");
            met += found.len();
        }
        assert!(met > 100_000, "{met}");
    }

    fn shapes() -> [Slabs; 3] {
        [
            cuboid([0.0; 3], [1.0; 3]),
            cuboid([-1.0, -1e-6, -3.0], [1.0, 1e-6, 5.0]),
            cuboid([1e6, 2e6, -1e6], [1e6 + 1.0, 2e6 + 2.0, -1e6 + 0.1]),
        ]
    }

    /// Rays at points inside, on faces, edges and corners.
    fn rays(shape: &Slabs, seed: u64, count: usize) -> impl Iterator<Item = Ray> {
        let mut rng = Rng::with_seed(seed);
        let bounds = shape.bounds;
        (0..count).map(move |_| {
            let sides = bounds.sides();
            let share = Vector::zeros().map(|_: f64| match rng.u8(0..4) {
                0 => 0.0,
                1 => 1.0,
                _ => rng.f64(),
            });
            let target = bounds.min + sides.component_mul(&share);
            ray_to(&mut rng, &target, sides.amax())
        })
    }

    #[test]
    fn crossings_come_in_pairs_and_contacts_are_on_the_surface() {
        for shape in shapes() {
            let met = check_pairs(&shape, rays(&shape, 1, 300_000));
            assert!(met > 100_000, "{met}");
            let (worst, count) = worst_error(&shape, rays(&shape, 2, 50_000), |p, part| {
                let axis = part as usize / 2;
                let face = [shape.bounds.min, shape.bounds.max][part as usize % 2][axis];
                assert!(shape.bounds.contains(p));
                p[axis] - face
            });
            assert!(worst == 0.0 && count > 30_000, "{worst} of {count}");
        }
    }

    #[test]
    fn rays_leave_the_surface_they_start_from() {
        for shape in shapes() {
            let mut rng = Rng::with_seed(11);
            let bounds = shape.bounds;
            let mut aim = Rng::with_seed(12);
            let inside = (0..50_000).map(|_| {
                let share = Vector::zeros().map(|_: f64| 0.001 + 0.998 * aim.f64());
                let target = bounds.min + bounds.sides().component_mul(&share);
                Ray::new(target, direction(&mut aim))
            });
            assert_eq!(check_leaving(&shape, true, &mut rng, inside), 0, "{shape:?}");
        }
    }

    #[test]
    fn scaled_by_powers_of_two_the_bits_are_the_same() {
        let rays: Vec<Ray> = rays(&cuboid([0.0; 3], [1.0; 3]), 3, 2000).collect();
        let size = |k: f64| move |c: f64| c * k;
        check_scaling(
            |k| Box::new(cuboid([-0.1, 0.2, 0.0].map(size(k)), [0.9, 1.1, 0.7].map(size(k)))),
            &rays,
        );
    }

    #[test]
    fn squares_start_at_the_smallest_corner() {
        let shape = cuboid([-0.5, 2.0, 0.0], [2.5, 4.0, 3.0]);
        let checker = Checker::new(Colour::RED);
        for (x, y, expected) in [
            (-0.4, 2.1, Cell::First),
            (0.4, 2.9, Cell::First),
            (0.6, 2.9, Cell::Second),
            (0.6, 3.1, Cell::First),
        ] {
            let ray = ray([x, y, 9.0], [0.0, 0.0, -1.0]);
            let crossing = shape.nearest(&ray, 10.0).unwrap();
            let contact = shape.contact(&ray, &crossing);
            assert_eq!(shape.square(&contact, crossing.part, &checker).cell, expected, "{x} {y}");
        }
    }
}
