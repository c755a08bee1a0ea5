//! What of the listed shapes a batch of rays may meet at all.

use super::{Listed, MOST_LISTED, next_bit};
use crate::Prepared;
use lancer_math::{Point, Vector};

/// What a batch of rays is held against; the rest is left out because no ray of
/// the batch can meet it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Candidates {
    pub(super) balls: u64,
    pub(super) planes: u64,
}

impl Candidates {
    /// Everything.
    pub const ALL: Self = Self { balls: u64::MAX, planes: u64::MAX };

    /// Without the planes that rays from `apex` within the pyramid of four directions
    /// meet only behind another one.
    ///
    /// One over the distance of a plane is a linear function of the direction: if that of
    /// one plane is above 0 and above that of another at the four edges, then
    /// everywhere between them. Of what is equal but for roundings both stay.
    #[must_use]
    pub fn in_front(mut self, prepared: &Prepared, apex: &Point, edges: &[Vector; 4]) -> Self {
        let listed = prepared.listed();
        let mut left = self.planes & listed.all().planes;
        let mut nearness = [[0.0; 4]; MOST_LISTED];
        let mut roundings = [0.0; MOST_LISTED];
        let mut rest = left;
        while let Some(k) = next_bit(&mut rest) {
            let plane = &listed.planes[k].1;
            let (normal, to_plane) = (plane.unit(), plane.origin - apex);
            let ahead = normal.dot(&to_plane);
            // What is this near may be anywhere.
            if ahead.abs() <= 1e-9 * (bound(&to_plane) + bound(&apex.coords)) {
                return self;
            }
            nearness[k] = edges.map(|edge| normal.dot(&edge) / ahead);
            let size = nearness[k].iter().fold(0.0_f64, |size, n| size.max(n.abs()));
            let reach = bound(&to_plane) + bound(&apex.coords);
            roundings[k] = (1e-9 + SLACK * reach / ahead.abs()) * size + SLACK / ahead.abs();
        }
        let mut rest = left;
        while let Some(k) = next_bit(&mut rest) {
            let mut others = left & !(1 << k);
            while let Some(other) = next_bit(&mut others) {
                let slack = roundings[k] + roundings[other];
                let mut pairs = nearness[other].iter().zip(&nearness[k]);
                if pairs.all(|(other, this)| *other > slack && other - this > slack) {
                    left &= !(1 << k);
                    break;
                }
            }
        }
        self.planes = left;
        self
    }
}

/// Where a batch of rays goes.
#[derive(Debug, Clone, Copy)]
pub enum Goal {
    /// Each to that point.
    Point(Point),
    /// Each in that direction, without end.
    Direction(Vector),
    /// Each to a point of the ball around that point with that radius.
    Ball(Point, f64),
}

/// Generous for all roundings of products of a few terms, relative to the largest.
const SLACK: f64 = 1e-12;

/// Generous for a sine that is found from a cosine.
const STEEP: f64 = 1e-7;

impl Listed {
    /// What rays of length 1 may meet that start in a ball and whose angle with an axis of
    /// length 1 has at least that cosine.
    ///
    /// They are all within the ball's radius of the cone at its centre. A ball is
    /// left out if it is so far beyond the tangent plane of the cone that is nearest to
    /// it, a plane if all start on one side of it and go away from it. So is what is
    /// farther away than any ray goes before it meets another plane, which all of them meet.
    pub(crate) fn in_cone(
        &self,
        centre: &Point,
        radius: f64,
        axis: &Vector,
        cosine: f64,
    ) -> Candidates {
        let mut among = self.all();
        if !(cosine > 0.0 && cosine <= 1.0) {
            return among;
        }
        // Wider by more than roundings.
        let cosine = cosine * (1.0 - SLACK);
        let sine = (1.0 - cosine * cosine).sqrt();
        // No ray goes farther, and how far each plane is at least.
        let mut farthest = f64::INFINITY;
        let mut distances = [0.0; MOST_LISTED];
        for (k, (_, plane)) in self.planes.iter().enumerate() {
            let normal = plane.unit();
            let height = normal.dot(&(centre - plane.origin));
            let size = bound(&centre.coords) + bound(&plane.origin.coords);
            let slack = SLACK * size + radius;
            let toward = if height > slack {
                -normal.dot(axis)
            } else if height < -slack {
                normal.dot(axis)
            } else {
                continue;
            };
            // How fast the fastest and the slowest of them approach it.
            let along = toward * cosine;
            let across = (1.0 - toward * toward).max(0.0).sqrt() * sine;
            if toward < cosine && along + across < -STEEP {
                among.planes &= !(1 << k);
                continue;
            }
            let fastest = if toward < cosine { along + across } else { 1.0 };
            distances[k] = (height.abs() - slack) / (fastest + STEEP);
            let slowest = along - across;
            if slowest > 2.0 * STEEP {
                farthest = farthest.min((height.abs() + slack) / (slowest - STEEP));
            }
        }
        farthest *= 1.0 + 1e-9;
        for (k, distance) in distances.iter().enumerate().take(self.planes.len()) {
            if *distance > farthest {
                among.planes &= !(1 << k);
            }
        }
        for (k, (_, ball)) in self.balls.iter().enumerate() {
            let v = ball.centre - centre;
            let along = v.dot(axis);
            let across = (v - axis * along).norm();
            let beyond = across * cosine - along * sine;
            let slack = 1e-9 * (bound(&v) + bound(&centre.coords) + bound(&ball.centre.coords));
            let reach = (ball.radius + radius) * (1.0 + SLACK) + slack;
            if beyond > reach || along - reach > farthest {
                among.balls &= !(1 << k);
            }
        }
        among
    }

    /// What may be met by rays that start in a ball and go to a goal. If they all
    /// leave the surface of a plane by its error bound, on the side that is given by
    /// a unit normal there, `leaving` is its number and that normal.
    ///
    /// The hull of the ball and the goal is within the ball's radius of the line
    /// from its centre. A plane with ball and goal on the same side is not between them; nor
    /// is the one that rays leave, if the goal is on that side by more than
    /// roundings: then they go away from it. Where the goal is a ball, the hull of both is
    /// the union of balls around the points between the centres, whose radius changes
    /// evenly.
    pub(crate) fn between(
        &self,
        centre: &Point,
        radius: f64,
        goal: &Goal,
        leaving: Option<(u32, Vector)>,
    ) -> Candidates {
        let mut among = self.all();
        let size = bound(&centre.coords) + radius;
        for (k, (_, ball)) in self.balls.iter().enumerate() {
            let from_centre = ball.centre - centre;
            if let Goal::Ball(point, goal_radius) = goal {
                let reach = (ball.radius, radius, *goal_radius);
                let slack = 1e-9 * (size + bound(&ball.centre.coords) + bound(&point.coords));
                let is_off =
                    gap(&from_centre, &(point - centre), reach) > slack + 1e-9 * goal_radius;
                among.balls &= !(u64::from(is_off) << k);
                continue;
            }
            let way = match goal {
                Goal::Point(point) | Goal::Ball(point, _) => point - centre,
                Goal::Direction(direction) => *direction,
            };
            let length_squared = way.norm_squared();
            let along = from_centre.dot(&way) / length_squared;
            let along = match goal {
                Goal::Point(_) | Goal::Ball(..) => along.clamp(0.0, 1.0),
                Goal::Direction(_) => along.max(0.0),
            };
            let off = (from_centre - way * along).norm_squared();
            let slack = 1e-9 * (size + bound(&ball.centre.coords) + bound(&from_centre) + radius);
            let reach = ball.radius + radius + slack;
            // Without a branch, which nobody could predict.
            among.balls &= !(u64::from(off > reach * reach) << k);
        }
        for (k, (item, plane)) in self.planes.iter().enumerate() {
            let normal = plane.unit();
            let height = normal.dot(&(centre - plane.origin));
            let size = size + bound(&plane.origin.coords);
            let (of_goal, slack) = match goal {
                Goal::Point(point) => {
                    (normal.dot(&(point - plane.origin)), SLACK * (size + bound(&point.coords)))
                }
                Goal::Direction(direction) => (normal.dot(direction), SLACK),
                Goal::Ball(point, goal_radius) => {
                    let slack = SLACK * (size + bound(&point.coords) + goal_radius);
                    (normal.dot(&(point - plane.origin)), goal_radius + slack)
                }
            };
            let near = SLACK * size + radius;
            let above = (height > near) & (of_goal > slack);
            let below = (height < -near) & (of_goal < -slack);
            let leaves = leaving.is_some_and(|(leaving, side)| {
                leaving == *item && of_goal * side.dot(&normal).signum() > slack
            });
            among.planes &= !(u64::from(above | below | leaves) << k);
        }
        among
    }
}

/// How far a ball at `at` is from the hull of one at the origin and one at `way`, at
/// least; the radii are in that order.
///
/// Along the way the distance from the ball's centre less the hull's radius there is convex. Its
/// least value is where the angle to the centre has the tangent that the hull's side has, or at
/// an end.
fn gap(at: &Vector, way: &Vector, (radius, here, there): (f64, f64, f64)) -> f64 {
    let length = way.norm();
    let along = at.dot(way) / length;
    let across = (at - way * (along / length)).norm();
    let slope = (there - here) / length;
    let least = along + across * slope / ((1.0 - slope) * (1.0 + slope)).sqrt();
    let ends = [0.0, length];
    // Where one ball is in the other, least is not a number.
    let places = if least > 0.0 && least < length { [least; 2] } else { ends };
    let gaps = places.map(|place| {
        let off = (across * across + (along - place) * (along - place)).sqrt();
        off - (here + slope * place)
    });
    gaps[0].min(gaps[1]) - radius
}

/// At least the length, and less than twice that.
#[inline(always)]
fn bound(v: &Vector) -> f64 {
    2.0 * v.amax()
}

#[cfg(test)]
mod tests {
    use crate::lanes::{Lanes, Mask, One};
    use crate::{Candidates, Goal, Prepared, Rays, Which};
    use fastrand::Rng;
    use lancer_math::{Point, Ray, Vector, unit};
    use lancer_scene::{Camera, Colour, Scene, Shape, Surface};

    /// Planes through nearly the same points, described by origins far along them.
    #[test]
    fn a_plane_behind_another_is_left_out_only_if_it_is() {
        let mut rng = Rng::with_seed(6);
        let mut left_out = 0;
        for case in 0..2000 {
            let mut next = || 2.0 * rng.f64() - 1.0;
            let normal = Vector::new(1.0 + 0.2 * next(), next(), next());
            let across = normal.cross(&Vector::new(next(), next(), 1.0));
            let far = across * [1e8, 1e3, 1.0, 0.0][case % 4];
            let near = normal * (1.0 + 0.3 * next());
            let gap = normal * ([0.0, 1e-12, 1e-3, 0.5][case / 4 % 4] * next());
            let plane = |at: Vector| {
                Shape::plane(
                    [at.x, at.y, at.z],
                    [normal.x, normal.y, normal.z],
                    Surface::new(Colour::RED),
                )
            };
            let scene = Scene::builder()
                .camera(Camera::new([0.0; 3], [1.0, 0.0, 0.0], 1.0, [1, 1]))
                .shape(plane(near))
                .shape(plane(near + gap + far))
                .build();
            let prepared = Prepared::new(&scene.expect("valid"));
            let edges = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                .map(|(y, z)| unit(Vector::new(1.0, 0.05 * y, 0.05 * z)).expect("not zero"));
            let eye = Point::origin();
            let among = Candidates::ALL.in_front(&prepared, &eye, &edges);
            left_out += usize::from(among != Candidates::ALL);
            for _ in 0..20 {
                let mut weight = || rng.f64();
                let way = edges.iter().map(|edge| edge * weight()).sum::<Vector>();
                let ray = Ray::new(eye, way);
                let rays = Rays::splat(One, &ray);
                let hit =
                    prepared.nearest_in_lanes(&rays, f64::INFINITY, One.mask(1), (&among, None));
                let expected = prepared.nearest(&ray, f64::INFINITY);
                let found = (hit.item >= 0.0).then_some((hit.t, hit.item as u32));
                assert_eq!(found, expected.map(|hit| (hit.t, hit.item)), "case {case}");
            }
        }
        assert!(left_out > 500, "{left_out}");
    }

    /// Rays from a ball of points and within a cone, among planes and balls.
    #[test]
    fn what_a_cone_leaves_out_is_never_the_nearest() {
        let mut rng = Rng::with_seed(31);
        let mut left_out = 0;
        for case in 0..3000 {
            let mut vector = || {
                let mut number = || 2.0 * rng.f64() - 1.0;
                Vector::new(number(), number(), number())
            };
            let mut scene =
                Scene::builder().camera(Camera::new([0.0; 3], [1.0, 0.0, 0.0], 1.0, [1, 1]));
            let surface = || Surface::new(Colour::RED);
            for _ in 0..4 {
                let normal = vector() + Vector::new(0.0, 0.0, 1e-9);
                let at = normal * 5.0 + vector() * [1e-12, 1.0, 5.0][case % 3];
                scene = scene.shape(Shape::plane(at.into(), normal.into(), surface()));
                let at: [f64; 3] = (vector() * 6.0).into();
                scene = scene.shape(Shape::sphere(at, 0.5, surface()));
            }
            let prepared = Prepared::new(&scene.build().expect("valid"));
            let centre = Point::from(vector());
            let radius = [0.0, 1e-6, 0.1, 1.0][case / 3 % 4];
            let axis = unit(vector()).expect("not zero");
            let cosine = 1.0 - [1e-12, 1e-6, 1e-3, 0.1, 0.6][case / 12 % 5];
            let among = prepared.candidates_in_cone(&centre, radius, &axis, cosine);
            left_out += usize::from(among != prepared.listed().all());
            let tangent = (1.0 - cosine * cosine).sqrt() / cosine;
            for _ in 0..20 {
                let across = axis.cross(&vector());
                let across = across / across.norm() * tangent * [1.0, vector().x.abs()][case % 2];
                let way = unit(axis + across).expect("not zero");
                let from = centre + vector() * (radius * 0.57);
                let rays = Rays::splat(One, &Ray::new(from, way));
                let nearest = |among: &Candidates| {
                    let far = f64::INFINITY;
                    let hit = prepared.nearest_in_lanes(&rays, far, One.mask(1), (among, None));
                    (hit.t, hit.item)
                };
                assert_eq!(nearest(&among), nearest(&Candidates::ALL), "case {case}");
            }
        }
        assert!(left_out > 1000, "{left_out}");
    }

    /// Rays from a ball of points to a ball, among planes and balls, some of which touch
    /// what is between the two.
    #[test]
    fn what_is_left_out_hides_nothing_of_a_ball() {
        let mut rng = Rng::with_seed(32);
        let (mut left_out, mut hidden) = (0, 0);
        for case in 0..4000 {
            let mut vector = || {
                let mut number = || 2.0 * rng.f64() - 1.0;
                Vector::new(number(), number(), number())
            };
            let mut scene =
                Scene::builder().camera(Camera::new([0.0; 3], [1.0, 0.0, 0.0], 1.0, [1, 1]));
            let surface = || Surface::new(Colour::RED);
            let centre = Point::from(vector());
            let goal = centre + vector() * [0.3, 3.0, 100.0][case % 3];
            let radius = [0.0, 1e-6, 0.1, 1.0][case / 3 % 4];
            let goal_radius = [1e-6, 0.05, 0.5, 2.0][case / 12 % 4];
            for _ in 0..4 {
                let normal = vector() + Vector::new(0.0, 0.0, 1e-9);
                let at = goal.coords + vector() * 2.0 * goal_radius;
                scene = scene.shape(Shape::plane(at.into(), normal.into(), surface()));
                let way = goal - centre;
                let at = centre + way * vector().x.abs() + way.cross(&vector());
                scene = scene.shape(Shape::sphere(at.into(), 0.3 * way.norm(), surface()));
            }
            let prepared = Prepared::new(&scene.build().expect("valid"));
            let to = Goal::Ball(goal, goal_radius);
            let among = prepared.candidates_between(&centre, radius, &to, None);
            left_out += usize::from(among != prepared.listed().all());
            for _ in 0..30 {
                let mut on = || unit(vector()).expect("not zero");
                let (from, end) = (centre + on() * radius, goal + on() * goal_radius);
                let rays = Rays::splat(One, &Ray::new(from, end - from));
                let is_hidden = |among: &Candidates| {
                    let (asked, which) = (One.mask(1), Which::Opaque);
                    prepared.any_in_lanes(&rays, 1.0, asked, which, (among, None)).any()
                };
                assert_eq!(is_hidden(&among), is_hidden(&Candidates::ALL), "case {case}");
                hidden += usize::from(is_hidden(&among));
            }
        }
        assert!(left_out > 2000 && hidden > 10_000, "{left_out} {hidden}");
    }
}
