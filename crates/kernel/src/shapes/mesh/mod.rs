//! Triangle meshes, with a hierarchy of their own.
//!
//! A triangle is met as `edges.rs` decides, so a ray finds no gap between
//! neighbours. Nothing is kept for a triangle besides the mesh and the boxes.
//! A mesh that is closed but faces inwards is turned: its normals point outward.

mod batch;
mod leaves;

use super::edges::Shear;
use super::triangle::{normal_of, point_of};
use crate::checker;
use crate::crossing::Crossings;
use crate::hierarchy::{Hierarchy, Stack};
use crate::lanes::{Eight, Lanes, Work, dispatch};
use crate::primitive::{Contact, Primitive, Square};
use crate::{Crossing, KernelSettings};
use lancer_math::{Bounds, Point, Ray, Vector, unit};
use lancer_scene::{Checker, Mesh};
use leaves::{Filter, Leaves};
use std::ops::{ControlFlow, Range};
use std::sync::Arc;

#[derive(Debug)]
pub(crate) struct Facets {
    mesh: Arc<Mesh>,
    hierarchy: Hierarchy,
    leaves: Leaves,
    settings: KernelSettings,
    /// Whether its faces look inwards.
    inside_out: bool,
    volume: f64,
}

/// Along no axis, edge or diagonal of anything: where a point's rays are counted.
const OBLIQUE: Vector = Vector::new(0.531_441_7, 0.271_828_1, 0.802_199_3);

impl Facets {
    pub(crate) fn new(mesh: &Arc<Mesh>, settings: &KernelSettings) -> Self {
        let bounds_of = |triangle| Bounds::around(mesh.corners(triangle));
        let (hierarchy, order) = Hierarchy::over(mesh.triangle_count(), bounds_of);
        let leaves = Leaves::new(mesh, &hierarchy, order);
        let volume = mesh.signed_volume();
        Self {
            mesh: Arc::clone(mesh),
            hierarchy,
            leaves,
            settings: *settings,
            // Whether it is closed takes a look at all edges: only where it matters.
            inside_out: volume < 0.0 && mesh.is_closed(),
            volume: volume.abs(),
        }
    }

    /// Whether normals to shade with are others than those of its facets.
    pub(crate) fn is_smooth(&self) -> bool {
        self.mesh.has_normals()
    }

    /// How much memory it takes, apart from the mesh.
    pub(crate) fn bytes(&self) -> usize {
        size_of::<Self>() + self.hierarchy.bytes() + self.leaves.bytes()
    }

    /// The normal to shade with where the corners have these weights: on the
    /// side of the facet's own, whichever way the mesh's normals point.
    fn shading(&self, triangle: usize, weights: [f64; 3], facet: &Vector) -> Vector {
        let Some(normals) = self.mesh.corner_normals(triangle) else { return *facet };
        // Zero stands for the normal of the triangle's plane.
        let own = if self.inside_out { -facet } else { *facet };
        let [a, b, c] = normals.map(|normal| unit(normal).unwrap_or(own));
        let sum = a * weights[0] + b * weights[1] + c * weights[2];
        match unit(sum) {
            Some(normal) if normal.dot(facet) > 0.0 => normal,
            Some(normal) if normal.dot(facet) < 0.0 => -normal,
            _ => *facet,
        }
    }
}

impl Primitive for Facets {
    /// None: there may be any number; see `nearest` and `each`.
    fn crossings(&self, _ray: &Ray) -> Crossings {
        Crossings::NONE
    }

    fn nearest(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        dispatch(self.settings.lanes, Nearest { facets: self, ray, t_max })
    }

    fn nearest_each(&self, rays: &[Ray], t_max: f64, nearest: &mut [Option<Crossing>]) {
        self.nearest_each_of(rays, t_max, nearest);
    }

    fn any_each(&self, rays: &[Ray], t_max: f64, any: &mut [bool]) {
        self.any_each_of(rays, t_max, any);
    }

    fn any(&self, ray: &Ray, t_max: f64) -> bool {
        dispatch(self.settings.lanes, Any { facets: self, ray, t_max })
    }

    fn each(&self, ray: &Ray, from: f64, to: f64, found: &mut dyn FnMut(Crossing)) {
        dispatch(self.settings.lanes, Each { facets: self, ray, from, to, found });
    }

    fn contact(&self, ray: &Ray, crossing: &Crossing) -> Contact {
        let triangle = crossing.part as usize;
        let corners = self.mesh.corners(triangle);
        let third = 1.0 / 3.0;
        let met = Shear::new(ray).meet(&corners);
        let weights = met.map_or([third; 3], |met| met.weights);
        let (point, error) = point_of(&corners, weights);
        let normal = normal_of(&corners);
        let normal = if self.inside_out { -normal } else { normal };
        Contact { point, error, normal, shading: self.shading(triangle, weights, &normal) }
    }

    /// Squares from the origin, by the two coordinates that the facet's normal
    /// has least of.
    fn square(&self, contact: &Contact, _part: u32, checker: &Checker) -> Square {
        let axis = contact.normal.iamax();
        let length = checker.length.get();
        let at = contact.point.coords / length;
        let slack = checker::slack(contact.error, length);
        checker::square([at[(axis + 1) % 3], at[(axis + 2) % 3]], [slack; 2])
    }

    fn bounds(&self) -> Option<Bounds> {
        let (min, max) = self.mesh.bounds();
        Some(Bounds { min, max })
    }

    /// By how often a ray from the point comes through.
    fn contains(&self, point: &Point) -> bool {
        let mut inside = false;
        if self.bounds().is_some_and(|bounds| bounds.contains(point)) && self.mesh.is_closed() {
            let ray = Ray::new(*point, OBLIQUE);
            self.each(&ray, 0.0, f64::INFINITY, &mut |_| inside = !inside);
        }
        inside
    }

    fn volume(&self) -> f64 {
        self.volume
    }
}

/// The nearest triangle on a ray.
struct Nearest<'a> {
    facets: &'a Facets,
    ray: &'a Ray,
    t_max: f64,
}

impl Work for Nearest<'_> {
    type Output = Option<Crossing>;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Option<Crossing> {
        self.facets.nearest_of(lanes, &mut Stack::new(), self.ray, self.t_max)
    }
}

/// Whether there is a triangle on a ray.
struct Any<'a> {
    facets: &'a Facets,
    ray: &'a Ray,
    t_max: f64,
}

impl Work for Any<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> bool {
        self.facets.any_of(lanes, &mut Stack::new(), self.ray, self.t_max)
    }
}

/// All triangles on a stretch of a ray.
struct Each<'a> {
    facets: &'a Facets,
    ray: &'a Ray,
    from: f64,
    to: f64,
    found: &'a mut dyn FnMut(Crossing),
}

impl Work for Each<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self { facets, ray, from, to, found } = self;
        let shear = Shear::new(ray);
        let filter = facets.leaves.filter(lanes, &shear);
        facets.hierarchy.visit_any(
            lanes,
            &mut Stack::new(),
            ray,
            0.0,
            (from, to),
            #[inline(always)]
            |places, to| {
                facets.leaves.each(
                    &filter,
                    &shear,
                    places,
                    (from, to),
                    #[inline(always)]
                    |triangle, t| {
                        if t < to {
                            found(Crossing { t, part: triangle });
                        }
                    },
                );
                ControlFlow::Continue(to)
            },
        );
    }
}

impl Facets {
    /// The nearest of what is known and of a leaf's triangles on the ray, of those at the
    /// same t the first one.
    #[inline(always)]
    fn nearer<E: Eight>(
        &self,
        filter: &Filter<E>,
        shear: &Shear,
        places: Range<usize>,
        mut nearest: Crossing,
    ) -> Crossing {
        self.leaves.each(
            filter,
            shear,
            places,
            (0.0, nearest.t),
            #[inline(always)]
            |triangle, t| {
                if t < nearest.t || t == nearest.t && triangle < nearest.part {
                    nearest = Crossing { t, part: triangle };
                }
            },
        );
        nearest
    }

    #[inline(always)]
    pub(crate) fn nearest_of<L: Lanes>(
        &self,
        lanes: L,
        stack: &mut Stack,
        ray: &Ray,
        t_max: f64,
    ) -> Option<Crossing> {
        let shear = Shear::new(ray);
        let filter = self.leaves.filter(lanes, &shear);
        let mut nearest = Crossing { t: t_max, part: 0 };
        self.hierarchy.visit(
            lanes,
            stack,
            ray,
            0.0,
            (0.0, t_max),
            #[inline(always)]
            |places, _| {
                nearest = self.nearer(&filter, &shear, places, nearest);
                ControlFlow::Continue(nearest.t)
            },
        );
        (nearest.t < t_max).then_some(nearest)
    }

    #[inline(always)]
    pub(crate) fn any_of<L: Lanes>(
        &self,
        lanes: L,
        stack: &mut Stack,
        ray: &Ray,
        t_max: f64,
    ) -> bool {
        let shear = Shear::new(ray);
        let filter = self.leaves.filter(lanes, &shear);
        let beyond = Crossing { t: t_max, part: 0 };
        let mut found = false;
        self.hierarchy.visit_any(
            lanes,
            stack,
            ray,
            0.0,
            (0.0, t_max),
            #[inline(always)]
            |places, to| {
                found = self.nearer(&filter, &shear, places, beyond).t < t_max;
                if found { ControlFlow::Break(()) } else { ControlFlow::Continue(to) }
            },
        );
        found
    }
}

#[cfg(test)]
mod tests;
