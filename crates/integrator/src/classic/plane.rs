use super::checker;
use super::naive_unit;
use super::vectors::dot;
use crate::classic::sphere::Ways;
use lancer_kernel::lanes::{Lanes, Real, Vectors};
use lancer_math::{Point, Vector};

/// A plane made ready for rays: it is met only by those that go against its
/// normal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Half {
    pub(super) origin: Point,
    pub(super) normal: Vector,
    /// `origin . normal`
    pub(super) offset: f64,
    /// The axes of its checker.
    axes: [Vector; 2],
}

impl Half {
    pub(super) fn new(plane: &lancer_scene::Plane) -> Self {
        let origin = plane.origin.get();
        let normal = naive_unit(plane.normal.get());
        Self {
            origin,
            normal,
            offset: dot(&origin.coords.into(), &normal.into()),
            axes: checker::axes_on_plane(normal),
        }
    }

    /// The distances to the intersections and where there are any, as the
    /// original has them: only for rays that go against the normal, and then even
    /// where they are behind the ray's origin.
    #[inline(always)]
    pub(super) fn meet<L: Lanes>(
        &self,
        lanes: L,
        origins: &Vectors<L::Real>,
        directions: &Vectors<L::Real>,
    ) -> (L::Mask, L::Real) {
        let normal = Vectors::splat(lanes, &self.normal);
        let slope = dot(directions, &normal);
        let to_plane = lanes.splat(self.offset) - dot(origins, &normal);
        (slope.lt(lanes.splat(0.0)), to_plane / slope)
    }

    /// Whether it is met before a lamp, without dividing.
    #[inline(always)]
    pub(super) fn hides_lamp<L: Lanes>(&self, lanes: L, ways: &Ways<L::Real>) -> L::Mask {
        let normal = Vectors::splat(lanes, &self.normal);
        let slope = dot(&ways.vectors, &normal);
        (dot(&ways.origins, &normal) - self.offset).abs().lt(-slope)
    }

    /// Whether it hides a sun in that direction. The ray to a sun has the same
    /// direction everywhere, and by the original's rule a hit may lie behind the
    /// origin: so a plane hides a sun from everywhere or from nowhere.
    pub(super) fn hides_sun(&self, towards: &Vector) -> bool {
        dot(&(*towards).into(), &self.normal.into()) < 0.0
    }

    /// Which points show the second colour of a checker.
    #[inline(always)]
    pub(super) fn shows_second_colour<L: Lanes>(
        &self,
        lanes: L,
        points: &Vectors<L::Real>,
    ) -> L::Mask {
        let offsets = *points - Vectors::splat(lanes, &self.origin.coords);
        checker::on_plane(lanes, &offsets, &self.axes)
    }
}
