use super::vectors::{dot, unit};
use lancer_kernel::lanes::{Lanes, Real, Vectors};
use lancer_math::{Point, Vector};

/// A sphere made ready for rays.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ball {
    centre: Vector,
    radius_squared: f64,
}

/// From points towards a lamp or a sun.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ways<R> {
    pub(super) origins: Vectors<R>,
    /// To the lamp itself, or unit vectors towards the sun.
    pub(super) vectors: Vectors<R>,
    /// The squares of the distances to the lamp; 1 for a sun.
    pub(super) lengths_squared: R,
}

impl Ball {
    pub(super) fn new(sphere: &lancer_scene::Sphere) -> Self {
        let radius = sphere.radius.get();
        Self { centre: sphere.centre.get().coords, radius_squared: radius * radius }
    }

    /// The vectors from points to the centre, and the squares of the lengths of
    /// the tangents.
    #[inline(always)]
    fn from<L: Lanes>(&self, lanes: L, origins: &Vectors<L::Real>) -> (Vectors<L::Real>, L::Real) {
        let v = Vectors::splat(lanes, &self.centre) - *origins;
        let x = v.x.mul_add(v.x, lanes.splat(-self.radius_squared));
        (v, v.z.mul_add(v.z, v.y.mul_add(v.y, x)))
    }

    /// The distances to the nearer intersections and where there are any, as the
    /// original has them: never where the centre is behind the ray's origin, and
    /// otherwise even where the intersection is behind it (an origin inside the
    /// sphere).
    #[inline(always)]
    pub(super) fn meet<L: Lanes>(
        &self,
        lanes: L,
        origins: &Vectors<L::Real>,
        directions: &Vectors<L::Real>,
    ) -> (L::Mask, L::Real) {
        let (to_centre, tangent_squared) = self.from(lanes, origins);
        let along = dot(&to_centre, directions);
        let under_root = along.mul_add(along, -tangent_squared);
        let zero = lanes.splat(0.0);
        // Not for NaN either.
        let hits = along.ge(zero) & under_root.ge(zero);
        (hits, along - under_root.sqrt())
    }

    /// Whether it is met before the sun.
    #[inline(always)]
    pub(super) fn hides_sun<L: Lanes>(&self, lanes: L, ways: &Ways<L::Real>) -> L::Mask {
        let (to_centre, tangent_squared) = self.from(lanes, &ways.origins);
        let along = dot(&ways.vectors, &to_centre);
        let zero = lanes.splat(0.0);
        along.ge(zero) & along.mul_add(along, -tangent_squared).ge(zero)
    }

    /// Whether it is met before a lamp, of which is known whether it is inside.
    ///
    /// From the same quadratic as [`meet`](Self::meet), but without a unit
    /// direction, a root or a quotient. In units of the way, whose square is L,
    /// the intersection is at b - root(k) with b >= 0 and k >= 0. That is below L
    /// if b is, or if the lamp is inside; and above -L if k < (b + L)^2, where
    /// k = b^2 - L tangent^2.
    #[inline(always)]
    pub(super) fn hides_lamp<L: Lanes>(
        &self,
        lanes: L,
        ways: &Ways<L::Real>,
        lamp_is_inside: bool,
    ) -> L::Mask {
        let (to_centre, tangent_squared) = self.from(lanes, &ways.origins);
        let along = dot(&ways.vectors, &to_centre);
        let lengths_squared = ways.lengths_squared;
        let zero = lanes.splat(0.0);
        let under_root = along.mul_add(along, -(lengths_squared * tangent_squared));
        let meets = along.ge(zero) & under_root.ge(zero);
        let not_behind = along.mul_add(lanes.splat(2.0), lengths_squared).gt(-tangent_squared);
        if lamp_is_inside {
            meets & not_behind
        } else {
            meets & not_behind & along.lt(lengths_squared)
        }
    }

    /// Whether a lamp is inside.
    pub(super) fn holds(&self, lamp: &Vector) -> bool {
        let v = lamp - self.centre;
        dot(&v.into(), &v.into()) < self.radius_squared
    }

    #[inline(always)]
    pub(super) fn normals<L: Lanes>(
        &self,
        lanes: L,
        points: &Vectors<L::Real>,
    ) -> Vectors<L::Real> {
        unit(lanes, &(*points - Vectors::splat(lanes, &self.centre)))
    }
}

/// Where spheres are, by coordinate, to look through them in lanes.
#[derive(Debug, Clone)]
pub(super) struct Places {
    pub(super) count: usize,
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
    pub(super) z: Vec<f64>,
    pub(super) radius: Vec<f64>,
}

impl Places {
    /// As many lanes as there may be behind the last one hold spheres in which
    /// nothing is.
    pub(super) fn new(spheres: &[lancer_scene::Sphere]) -> Self {
        let behind = [0.0; lancer_kernel::lanes::MOST];
        let each = |f: fn(&Point) -> f64| {
            spheres.iter().map(|sphere| f(&sphere.centre.get())).chain(behind).collect()
        };
        let nothing = behind.map(|_| f64::NEG_INFINITY);
        Self {
            count: spheres.len(),
            x: each(|centre| centre.x),
            y: each(|centre| centre.y),
            z: each(|centre| centre.z),
            radius: spheres.iter().map(|sphere| sphere.radius.get()).chain(nothing).collect(),
        }
    }
}
