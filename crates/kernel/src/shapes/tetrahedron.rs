//! Tetrahedra: the line of a ray is cut by the four half-spaces (Cyrus and
//! Beck, *Generalized Two- and Three-Dimensional Clipping*, 1978), so that entry
//! and exit exist together. Along a face that the ray is parallel to, it is
//! inside of that half-space everywhere or nowhere; in the face itself, inside.

use super::clip::{Cut, Stretch};
use super::flat::Patch;
use crate::Crossing;
use crate::crossing::Crossings;
use crate::near::stepped;
use crate::primitive::{Contact, Primitive, Square};
use lancer_math::{Bounds, Point, Ray};
use lancer_scene::{Checker, Tetrahedron};

/// The parts are the faces, in the order of [`FACES`].
#[derive(Debug)]
pub(crate) struct Faces {
    bounds: Bounds,
    faces: [Patch; 4],
    /// The largest absolute value of a coordinate, plus the longest sides.
    size: f64,
    volume: f64,
}

/// The corners of each face, anticlockwise from outside.
const FACES: [[usize; 3]; 4] = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]];

impl Faces {
    pub(crate) fn new(tetrahedron: &Tetrahedron) -> Self {
        let corners = tetrahedron.corners();
        let faces = FACES.map(|[a, b, c]| {
            let [a, b, c] = [a, b, c].map(|i| corners[i]);
            Patch::new(a, [b - a, c - a])
        });
        let [a, b, c, d] = corners;
        let bounds = Bounds::around(corners);
        Self {
            bounds,
            faces,
            size: bounds.reach() + 2.0 * bounds.sides().amax(),
            volume: (b - a).dot(&(c - a).cross(&(d - a))).abs() / 6.0,
        }
    }
}

impl Primitive for Faces {
    #[inline]
    fn crossings(&self, ray: &Ray) -> Crossings {
        let Some(mut inside) = Stretch::of(ray) else { return Crossings::NONE };
        for (part, face) in (0..).zip(&self.faces) {
            let ahead = face.normal.dot(&(face.corner - ray.origin));
            let outward = face.normal.dot(&ray.direction);
            if outward < 0.0 {
                inside.enter(Cut::new(ahead, outward, part));
            } else if outward > 0.0 {
                inside.leave(Cut::new(ahead, outward, part));
            } else if ahead < 0.0 {
                return Crossings::NONE;
            }
        }
        inside.ends_in(&self.bounds, ray)
    }

    /// On the face, and if it lies beyond an edge by the rounding of a large t,
    /// on that edge.
    fn contact(&self, ray: &Ray, crossing: &Crossing) -> Contact {
        let face = &self.faces[crossing.part as usize % 4];
        let at = stepped(&ray.origin, &face.corner, crossing.t, &ray.direction);
        let [u, v] = face.shares(&at).map(|share| share.max(0.0));
        let sum = (u + v).max(1.0);
        face.contact([u / sum, v / sum], self.size)
    }

    fn square(&self, contact: &Contact, part: u32, checker: &Checker) -> Square {
        self.faces[part as usize % 4].square(contact, checker)
    }

    fn bounds(&self) -> Option<Bounds> {
        Some(self.bounds)
    }

    fn contains(&self, point: &Point) -> bool {
        self.faces.iter().all(|face| face.normal.dot(&(point - face.corner)) < 0.0)
    }

    fn volume(&self) -> f64 {
        self.volume
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{
        between, check_kept_in_box, check_leaving, check_pairs, check_scaling, direction, dot, ray,
        ray_to, ts, worst_error,
    };
    use super::*;
    use fastrand::Rng;
    use lancer_math::Vector;
    use lancer_scene::Position;

    fn tetrahedron(corners: [[f64; 3]; 4]) -> Faces {
        let corners = corners.map(|c| Position::new(c).unwrap());
        Faces::new(&Tetrahedron::new(corners).unwrap())
    }

    fn corners_of(shape: &Faces) -> [Point; 4] {
        let corner = |face: usize| shape.faces[face].corner;
        [corner(0), corner(2), corner(3), shape.faces[1].corner + shape.faces[1].sides[0]]
    }

    #[test]
    fn faces_look_outward_and_the_volume_is_right() {
        let corner = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
        for turned in [corner, [corner[1], corner[0], corner[2], corner[3]]] {
            let shape = tetrahedron(turned);
            assert_eq!(shape.volume(), 1.0);
            assert!(shape.contains(&Point::new(0.1, 0.1, 0.1)));
            for face in &shape.faces {
                assert!(face.unit_normal.dot(&(Point::new(0.1, 0.1, 0.1) - face.corner)) < 0.0);
            }
            assert_eq!(ts(&shape, &ray([-1.0, 0.25, 0.25], [1.0, 0.0, 0.0])).len(), 2);
            // Along an edge and in a face.
            assert_eq!(ts(&shape, &ray([-1.0, 0.0, 0.0], [1.0, 0.0, -0.0])), [1.0, 2.0]);
            assert_eq!(ts(&shape, &ray([0.5, -1.0, 0.0], [0.0, 2.0, 0.0])), [0.5, 1.0]);
            assert!(ts(&shape, &ray([0.5, -1.0, 0.0], [0.0, 0.0, 2.0])).is_empty());
            assert!(ts(&shape, &ray([0.1; 3], [0.0; 3])).is_empty());
            assert!(ts(&shape, &ray([0.1; 3], [f64::NAN, 1.0, 0.0])).is_empty());
        }
    }

    /// Atlas B3: rays of whole numbers at edges and corners and just past them,
    /// decided by fractions of whole numbers.
    #[test]
    fn decisions_are_those_of_rational_arithmetic() {
        let mut rng = Rng::with_seed(6);
        let mut met = 0;
        for case in 0..200_000 {
            let mut whole = |n: i32| i128::from(rng.i32(-n..=n));
            let mut vertices: [[i128; 3]; 4] = [[0; 3]; 4];
            for vertex in &mut vertices {
                *vertex = [whole(50), whole(50), whole(50)];
            }
            let minus =
                |a: [i128; 3], b: [i128; 3]| -> [i128; 3] { std::array::from_fn(|i| a[i] - b[i]) };
            let cross = |a: [i128; 3], b: [i128; 3]| -> [i128; 3] {
                std::array::from_fn(|i| {
                    a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]
                })
            };
            let dot = |a: [i128; 3], b: [i128; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let d = [whole(200), whole(200), whole(200)];
            let steps = whole(100);
            // A vertex, or the middle of an edge, and perhaps a bit past it.
            let pair = [whole(1) + 1, whole(1) + 1].map(|i| vertices[i as usize]);
            let o: [i128; 3] = std::array::from_fn(|i| {
                let middle = (pair[0][i] + pair[1][i]) / 2;
                middle - steps * d[i] + if whole(9) == 0 { whole(1) } else { 0 }
            });
            let [a, b, c, e] = vertices;
            let volume = dot(minus(b, a), cross(minus(c, a), minus(e, a)));
            if volume == 0 {
                continue;
            }
            let (mut from, mut to) = ((-1_i128, 0_i128), (1_i128, 0_i128));
            let mut expected = d != [0; 3];
            for [p, q, r] in [[a, b, c], [a, e, b], [b, e, c], [c, e, a]] {
                let mut normal = cross(minus(q, p), minus(r, p));
                if volume > 0 {
                    normal = normal.map(|c| -c);
                }
                let (ahead, outward) = (dot(normal, minus(p, o)), dot(normal, d));
                match outward.cmp(&0) {
                    std::cmp::Ordering::Equal => expected &= ahead >= 0,
                    std::cmp::Ordering::Less if -ahead * from.1 > from.0 * -outward => {
                        from = (-ahead, -outward);
                    }
                    std::cmp::Ordering::Greater if ahead * to.1 < to.0 * outward => {
                        to = (ahead, outward);
                    }
                    _ => {}
                }
            }
            expected &= from.0 * to.1 <= to.0 * from.1;
            // The other order is what the scene makes of the corners.
            let shape = tetrahedron(vertices.map(|p| p.map(|c| c as f64)));
            let found = ts(&shape, &ray(o.map(|c| c as f64), d.map(|c| c as f64)));
            assert_eq!(found.len(), if expected { 2 } else { 0 }, "case {case}: {o:?} {d:?}");
            met += found.len();
        }
        assert!(met > 100_000, "{met}");
    }

    fn shapes() -> [Faces; 3] {
        let regular = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        [
            tetrahedron(regular),
            tetrahedron(regular.map(|p| [p[0] * 7.0 + 1e4, p[1] * 1e-3, p[2] - 30.0])),
            tetrahedron([[0.1, 0.7, 0.3], [3.0, 0.2, 0.1], [0.4, 5.0, 0.2], [1.0, 2.0, 0.31]]),
        ]
    }

    /// Rays at points inside, on faces, edges and corners.
    fn rays(shape: &Faces, seed: u64, count: usize) -> Vec<Ray> {
        let mut rng = Rng::with_seed(seed);
        let corners = corners_of(shape);
        let size = shape.bounds.sides().amax();
        let mut rays = Vec::new();
        for _ in 0..count {
            let weights = [0; 4].map(|_| if rng.bool() { 0.0 } else { rng.f64() });
            let sum: f64 = weights.iter().sum();
            let mut target = corners[0];
            if sum > 0.0 {
                let shares = corners.iter().zip(weights).map(|(c, w)| c.coords * (w / sum));
                target = Point::from(shares.sum::<Vector>());
            }
            rays.push(ray_to(&mut rng, &target, size));
        }
        rays
    }

    #[test]
    fn crossings_come_in_pairs_and_contacts_are_on_the_surface() {
        for shape in shapes() {
            let met = check_pairs(&shape, rays(&shape, 1, 300_000).into_iter());
            assert!(met > 100_000, "{met}");
            let corners = corners_of(&shape);
            let (worst, count) =
                worst_error(&shape, rays(&shape, 2, 50_000).into_iter(), |p, part| {
                    let [a, b, c] = FACES[part as usize].map(|i| {
                        // The order of `corners_of` is that of the scene.
                        [0, 1, 2, 3].map(|k| corners[k])[i]
                    });
                    let (u, v) = (between(&b, &a), between(&c, &a));
                    let n = std::array::from_fn(|i| {
                        u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]
                    });
                    (dot(between(p, &a), n) / dot(n, n).sqrt()).0
                });
            assert!(worst <= 1.0 && count > 30_000, "{worst} of {count}");
        }
    }

    #[test]
    fn rays_leave_the_surface_they_start_from() {
        for shape in shapes() {
            let mut rng = Rng::with_seed(11);
            let mut aim = Rng::with_seed(12);
            let corners = corners_of(&shape);
            let inside = (0..50_000).map(|_| {
                let weights = [0; 4].map(|_| 0.01 + aim.f64());
                let sum: f64 = weights.iter().sum();
                let shares = corners.iter().zip(weights).map(|(c, w)| c.coords * (w / sum));
                Ray::new(Point::from(shares.sum::<Vector>()), direction(&mut aim))
            });
            assert_eq!(check_leaving(&shape, true, &mut rng, inside), 0, "{shape:?}");
        }
    }

    #[test]
    fn scaled_by_powers_of_two_the_bits_are_the_same() {
        let rays = rays(&shapes()[0], 3, 2000);
        check_scaling(
            |k| {
                let corners = [[1.0, 0.9, 1.1], [1.0, -1.0, -0.7], [-0.8, 1.0, -1.0], [-1.0; 3]];
                Box::new(tetrahedron(corners.map(|p| p.map(|c| c * k))))
            },
            &rays,
        );
    }

    /// Where two faces are met at a small angle, rounding decides where they cross.
    #[test]
    fn sharp_corners_are_met_in_the_box() {
        let mut rng = Rng::with_seed(23);
        let mut met = 0;
        for _ in 0..2000 {
            let thin = libm::exp10(-9.0 * rng.f64());
            let base = Point::from(direction(&mut rng));
            let aside = [0, 1, 2].map(|_| base + direction(&mut rng) * thin);
            let far = Point::from(direction(&mut rng) * -3.0);
            let corners = [aside[0], aside[1], aside[2], far].map(|p| [p.x, p.y, p.z]);
            let position = corners.map(|c| Position::new(c).unwrap());
            let Ok(given) = Tetrahedron::new(position) else { continue };
            let shape = Faces::new(&given);
            let rays = (0..30).map(|_| {
                let beside = direction(&mut rng) * (thin * libm::exp10(-14.0 * rng.f64()));
                ray_to(&mut rng, &(far + beside), 3.0)
            });
            met += check_kept_in_box(&shape, rays);
        }
        assert!(met > 2000, "{met}");
    }
}
