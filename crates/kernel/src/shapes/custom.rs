//! Shapes of the user's own, of which only the nearest hit can be asked.

use crate::Crossing;
use crate::crossing::Crossings;
use crate::primitive::{Cell, Contact, Primitive, Square};
use lancer_math::{Bounds, Ray, unit};
use lancer_scene::{Checker, CustomShape};
use std::sync::Arc;

#[derive(Debug)]
pub(crate) struct Own {
    shape: Arc<dyn CustomShape>,
}

impl Own {
    pub(crate) fn new(shape: &Arc<dyn CustomShape>) -> Self {
        Self { shape: Arc::clone(shape) }
    }
}

impl Primitive for Own {
    /// None: they cannot be asked for.
    fn crossings(&self, _ray: &Ray) -> Crossings {
        Crossings::NONE
    }

    fn nearest(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        let squared = ray.direction.norm_squared();
        let t = if (squared - 1.0).abs() <= 8.0 * f64::EPSILON {
            // As it is, up to the last bit.
            self.shape.nearest(ray)?
        } else {
            let direction = unit(ray.direction)?;
            let length = direction.dot(&ray.direction);
            self.shape.nearest(&Ray::new(ray.origin, direction))? / length
        };
        (t > 0.0 && t < t_max).then_some(Crossing { t, part: 0 })
    }

    /// The nearest one, if it is on that stretch.
    fn each(&self, ray: &Ray, from: f64, to: f64, found: &mut dyn FnMut(Crossing)) {
        self.nearest(ray, to).filter(|crossing| crossing.t > from).into_iter().for_each(found);
    }

    /// Nothing is known of the surface, so the point is that of the ray, and
    /// the error a generous multiple of what computing it loses.
    fn contact(&self, ray: &Ray, crossing: &Crossing) -> Contact {
        let point = ray.at(crossing.t);
        let normal = self.shape.normal(&point);
        let size = point.coords.amax() + crossing.t * ray.direction.amax();
        Contact { point, error: 64.0 * f64::EPSILON * size, normal, shading: normal }
    }

    fn square(&self, contact: &Contact, _part: u32, _checker: &Checker) -> Square {
        let (cell, index) = match self.shape.shows_second_colour(&contact.point) {
            true => (Cell::Second, 1.0),
            false => (Cell::First, 0.0),
        };
        Square { cell, index: [index, 0.0] }
    }

    fn bounds(&self) -> Option<Bounds> {
        None
    }

    /// Not known.
    fn volume(&self) -> f64 {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{assert_sound, ray, ts};
    use super::*;
    use lancer_math::{Point, Vector};

    /// The plane z = 1, seen from both sides.
    #[derive(Debug)]
    struct Pane;

    impl CustomShape for Pane {
        fn name(&self) -> &str {
            "pane"
        }

        fn nearest(&self, ray: &Ray) -> Option<f64> {
            assert!((ray.direction.norm() - 1.0).abs() < 1e-15);
            Some((1.0 - ray.origin.z) / ray.direction.z).filter(|t| *t > 0.0)
        }

        fn normal(&self, _point: &Point) -> Vector {
            Vector::z()
        }

        fn shows_second_colour(&self, point: &Point) -> bool {
            point.x > 0.0
        }
    }

    #[test]
    fn directions_of_any_length_and_limits() {
        let shape = Own::new(&(Arc::new(Pane) as Arc<dyn CustomShape>));
        let checker = Checker::new(lancer_scene::Colour::RED);
        for k in [1e-200, 0.1, 1.0, 3.0, 1e200] {
            let up = ray([0.5, 0.0, -3.0], [0.0, 0.0, k]);
            let crossing = shape.nearest(&up, f64::INFINITY).unwrap();
            assert!((crossing.t * k - 4.0).abs() < 1e-14, "{k}");
            assert!(shape.nearest(&up, 3.9 / k).is_none());
            assert_eq!(ts(&shape, &up).len(), 1);
            let contact = shape.contact(&up, &crossing);
            assert_sound(&contact);
            assert_eq!(shape.square(&contact, 0, &checker).cell, Cell::Second);
        }
        assert!(shape.nearest(&ray([0.0; 3], [0.0; 3]), f64::INFINITY).is_none());
        assert!(shape.nearest(&ray([0.0; 3], [1.0, 0.0, 0.0]), f64::INFINITY).is_none());
    }
}
