//! Half-spaces that rays never leave.

use lancer_math::{Bounds, Point, Ray, Vector, unit};

/// One side of a plane: the points x of which normal . x is at least a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HalfSpace {
    /// Of length 1.
    normal: Vector,
    at: f64,
}

/// Of the sizes of coordinates: far more than rounding makes of a point, or of a hit along a ray.
const MARGIN: f64 = 1e-12;

impl HalfSpace {
    /// The side of a plane, through a point and with a normal of length 1, on which all of some
    /// balls are, if they all are.
    pub(super) fn with_balls(origin: &Point, normal: &Vector, balls: &[Ball]) -> Option<Self> {
        let far = balls.iter().map(|(centre, radius)| centre.coords.amax() + radius);
        let margin = MARGIN * far.fold(origin.coords.amax(), f64::max);
        let at = normal.dot(&origin.coords);
        let is_inside = |sign: f64| {
            let distance = |(centre, radius): &Ball| sign * (centre - origin).dot(normal) - radius;
            !balls.is_empty() && balls.iter().all(|ball| distance(ball) > margin)
        };
        let side = [1.0, -1.0].into_iter().find(|sign| is_inside(*sign))?;
        Some(Self { normal: normal * side, at: at * side - margin })
    }

    /// Whether a box is wholly on the other side.
    pub(super) fn excludes(&self, bounds: &Bounds) -> bool {
        let half = bounds.sides() * 0.5;
        let inmost = self.normal.dot(&bounds.centre().coords) + self.normal.abs().dot(&half);
        inmost + MARGIN * bounds.reach() < self.at
    }
}

/// A centre and a radius.
pub(super) type Ball = (Point, f64);

/// Ways that light takes: straight on from points of some balls, or of what is between them, by sums of
/// some directions with positive weights; and from any point of such a way to points of the balls.
#[derive(Debug, Clone, Default)]
pub(super) struct Ways {
    pub(super) balls: Vec<Ball>,
    /// Of any length.
    pub(super) directions: Vec<Vector>,
}

/// More directions than these, or corners than these, are not combined.
const MOST: usize = 64;
/// Normals of planes along directions that are nearer to each other would be too uncertain.
const LEAST_SINE: f64 = 1e-3;
/// By so much planes are tilted outward, so that all directions point clearly inward, whatever
/// rounding makes of them.
const TILT: f64 = 1e-6;
/// What counts as clearly, as a cosine.
const INWARD: f64 = 1e-9;

impl Ways {
    pub(super) fn of_rays(rays: &[Ray]) -> Self {
        let balls = rays.iter().map(|ray| (ray.origin, 0.0)).collect();
        Self { balls, directions: rays.iter().map(|ray| ray.direction).collect() }
    }

    /// Their image in a flat mirror that may be half as far as `slack` from where it is said to be.
    pub(super) fn image(&self, (origin, normal): &(Point, Vector), slack: f64) -> Self {
        let image = |v: &Vector| v - normal * (2.0 * normal.dot(v));
        let ball = |(centre, radius): &Ball| (origin + image(&(centre - origin)), radius + slack);
        Self {
            balls: self.balls.iter().map(ball).collect(),
            directions: self.directions.iter().map(image).collect(),
        }
    }

    /// Half-spaces in which all of them are. There may be none.
    ///
    /// A half-space is convex, so ways that start in it and have directions that do not lead
    /// out of it stay inside, and so does what is between two points of it. Planes that are tried are those
    /// along two directions, or along one and from one ball to another; a half-space is taken only if
    /// each direction is then found to lead inward.
    pub(super) fn half_spaces(&self) -> Vec<HalfSpace> {
        // Of one that is no direction, as it is too large to be a number, nothing is known.
        let directions: Option<Vec<Vector>> = self.directions.iter().map(|v| unit(*v)).collect();
        let (Some(directions), Some((first, _))) = (directions, self.balls.first()) else {
            return Vec::new();
        };
        if directions.is_empty() || directions.len() > MOST {
            return Vec::new();
        }
        let mut edges = directions.clone();
        let others = self.balls.iter().skip(1).filter_map(|(centre, _)| unit(centre - first));
        edges.extend(others.take(MOST));
        let lead_inward =
            |normal: &Vector, least: f64| directions.iter().all(|way| normal.dot(way) >= least);
        let mut normals: Vec<Vector> = Vec::new();
        let mut take = |normal: Vector| {
            let is_new = || normals.iter().all(|other| (other - normal).amax() > TILT);
            if lead_inward(&normal, -MARGIN) && is_new() {
                normals.push(normal);
            }
        };
        unit(directions.iter().sum()).into_iter().for_each(&mut take);
        for (i, a) in edges.iter().enumerate() {
            for b in &edges[i + 1..] {
                let across = a.cross(b);
                if across.norm() >= LEAST_SINE
                    && let Some(normal) = unit(across)
                {
                    take(normal);
                    take(-normal);
                }
            }
        }
        let Some(inward) = unit(normals.iter().sum()) else { return Vec::new() };
        let tilted = normals.iter().filter_map(|normal| unit(normal + inward * TILT));
        tilted
            .filter(|normal| lead_inward(normal, INWARD))
            .map(|normal| {
                let off = |(centre, radius): &Ball| {
                    let far = centre.coords.amax() + radius;
                    normal.dot(&centre.coords) - radius - MARGIN * far
                };
                let at = self.balls.iter().map(off).fold(f64::INFINITY, f64::min);
                HalfSpace { normal, at }
            })
            .filter(|half_space| half_space.at.is_finite())
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastrand::Rng;

    fn vector(rng: &mut Rng) -> Vector {
        Vector::from_fn(|_, _| 2.0 * rng.f64() - 1.0)
    }

    /// A pyramid of rays, some balls and some suns, anywhere and of any size.
    fn ways(rng: &mut Rng) -> Ways {
        let size = libm::pow(10.0, 8.0 * rng.f64() - 4.0);
        let eye = Point::from(vector(rng) * size * libm::pow(10.0, 4.0 * rng.f64()));
        let axis = vector(rng);
        let (right, up) = (axis.cross(&vector(rng)), axis.cross(&vector(rng)));
        let corners = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
        let rays = corners.map(|(x, y)| Ray::new(eye, axis + (right * x + up * y) * 0.7));
        let mut ways = Ways::of_rays(&rays);
        for _ in 0..rng.usize(0..4) {
            let centre = eye + vector(rng) * size * 3.0;
            ways.balls.push((centre, [0.0, 0.3 * size * rng.f64()][rng.usize(0..2)]));
        }
        for _ in 0..rng.usize(0..2) {
            ways.directions.push(vector(rng));
        }
        ways
    }

    /// A point that light comes by: of a ray of the pyramid, or beyond it by the other directions, or
    /// from there on the way to a ball.
    fn point(ways: &Ways, rng: &mut Rng) -> Point {
        let (eye, _) = ways.balls[0];
        let mut any = |range: std::ops::Range<usize>| {
            range.fold(Vector::zeros(), |sum, i| sum + ways.directions[i] * rng.f64())
        };
        let along = any(0..4) * 3.0;
        let sunward = any(4..ways.directions.len()) * 3.0;
        let far = libm::pow(10.0, 8.0 * rng.f64() - 4.0);
        let seen = eye + along * far;
        if rng.bool() {
            return seen + sunward * far;
        }
        let (centre, radius) = ways.balls[rng.usize(0..ways.balls.len())];
        let goal = centre + vector(rng) * (radius / 3.0_f64.sqrt());
        seen + (goal - seen) * rng.f64()
    }

    #[test]
    fn no_way_leads_out_of_a_half_space() {
        let mut rng = Rng::with_seed(3);
        let mut found = 0;
        for _ in 0..500 {
            let ways = ways(&mut rng);
            let spaces = ways.half_spaces();
            found += usize::from(!spaces.is_empty());
            for _ in 0..100 {
                let point = point(&ways, &mut rng);
                let bounds = Bounds { min: point, max: point };
                assert!(spaces.iter().all(|space| !space.excludes(&bounds)), "{ways:?} {point:?}");
            }
        }
        assert!(found > 300, "{found}");
    }

    /// What is behind the eye, or beside the view, by more than the light that comes from there.
    #[test]
    fn what_is_aside_is_outside() {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
        let mut ways =
            Ways::of_rays(&corners.map(|(x, z)| Ray::new(Point::origin(), Vector::new(x, 2.0, z))));
        let excludes = |ways: &Ways, at: [f64; 3]| {
            let point = Point::from(at);
            let reach = Vector::repeat(0.1);
            let bounds = Bounds { min: point - reach, max: point + reach };
            ways.half_spaces().iter().any(|space| space.excludes(&bounds))
        };
        assert!(excludes(&ways, [0.0, -0.2, 0.0]) && excludes(&ways, [1.3, 2.0, 0.0]));
        assert!(!excludes(&ways, [0.0, 9.0, 4.0]) && !excludes(&ways, [1.05, 2.0, 0.0]));
        // A lamp up and behind: what is between it and what is seen is inside now.
        ways.balls.push((Point::new(0.0, -3.0, 4.0), 0.2));
        assert!(!excludes(&ways, [0.0, -1.0, 1.0]) && !excludes(&ways, [0.0, 3.0, 4.0]));
        assert!(excludes(&ways, [0.0, -1.0, -1.0]) && excludes(&ways, [9.0, 2.0, 0.0]));
        assert!(excludes(&ways, [0.0, -3.4, 4.0]) && !excludes(&ways, [0.0, -3.25, 4.0]));
        // A sun that stands where the view goes: its light comes from there alone; one behind: from
        // behind as well, but not from below.
        ways.balls.pop();
        ways.directions.push(Vector::new(0.0, 1.0, 0.1));
        assert!(excludes(&ways, [0.0, -0.2, 0.0]));
        *ways.directions.last_mut().expect("there is one") = Vector::new(0.0, -1.0, 1.0);
        assert!(!excludes(&ways, [0.0, -3.0, 3.2]) && excludes(&ways, [0.0, -3.0, -3.0]));
        // All around: nothing is known.
        ways.directions.push(Vector::new(0.0, -1.0, -1.0));
        assert!(ways.half_spaces().is_empty());
    }
}
