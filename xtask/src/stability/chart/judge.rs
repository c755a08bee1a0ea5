//! How far from the truth answers are.

use super::float::{Float, Triple, triple};
use lancer_integrator::KernelSettings;
use lancer_kernel::{Prepared, SurfacePoint};
use lancer_math::{Point, Ray, Vector};
use lancer_oracle::{Crossing, Line, Space, crossings};
use lancer_scene::{Camera, Colour, InvalidField, Scene, Shape, Surface};

/// Bits of the truth.
const BITS: usize = 200;

/// A miss, or a hit that is none: all digits are lost.
pub(super) const LOST: f64 = 1.0;

/// A shape by itself, with what Lancer and the truth say of rays.
pub(super) struct Subject {
    scene: Scene,
    prepared: Prepared,
}

/// The same ray in both precisions: each is right about its own.
pub(super) fn rounded(ray: &Ray) -> Ray {
    let single = |c: f64| f64::from(c as f32);
    Ray::new(ray.origin.map(single), ray.direction.map(single))
}

/// A ray as the forms take it.
pub(super) fn parts<F: Float>(ray: &Ray) -> (Triple<F>, Triple<F>) {
    (triple(ray.origin.coords.into()), triple(ray.direction.into()))
}

pub(super) fn matte() -> Surface {
    Surface::new(Colour::GREY)
}

impl Subject {
    pub(super) fn new(shape: Result<Shape, InvalidField>) -> Self {
        let camera = Camera::new([0.0; 3], [0.0, 0.0, 1.0], 1.0, [1, 1]);
        let scene = Scene::builder().camera(camera).shape(shape).build();
        let scene = scene.expect("the shapes of charts are valid");
        let prepared = Prepared::with(&scene, &KernelSettings::default());
        Self { scene, prepared }
    }

    /// Where the ray really meets it first.
    pub(super) fn truth(&self, ray: &Ray) -> Option<Crossing> {
        let geometry = &self.scene.shapes[0].geometry;
        let found = crossings(geometry, &Space::world(), &Line::from(ray), BITS);
        found.list.into_iter().find(|crossing| crossing.t.signum() > 0)
    }

    /// Where Lancer says so.
    pub(super) fn ours(&self, ray: &Ray) -> Option<f64> {
        self.prepared.nearest(ray, f64::INFINITY).map(|hit| hit.t)
    }

    /// The point of that, with its normal.
    pub(super) fn point(&self, ray: &Ray) -> Option<SurfacePoint<'_>> {
        let hit = self.prepared.nearest(ray, f64::INFINITY)?;
        Some(self.prepared.expand(ray, &hit))
    }

    /// Whether a ray meets it.
    pub(super) fn is_met(&self, ray: &Ray) -> bool {
        self.prepared.nearest(ray, f64::INFINITY).is_some()
    }
}

/// The larger of what was known and what is found out, if anything is.
pub(super) fn worse(known: Option<f64>, found: Option<f64>) -> Option<f64> {
    found.map_or(known, |found| Some(known.map_or(found, |known| known.max(found))))
}

/// How far a place is from the true one, along a ray; nothing where both know that it misses.
pub(super) fn distance(found: Option<f64>, truth: Option<&Crossing>, ray: &Ray) -> Option<f64> {
    Some(match (found, truth) {
        (Some(t), Some(crossing)) if t.is_finite() => {
            let off = &lancer_oracle::Number::from(t) - &crossing.t;
            off.abs().to_f64() * ray.direction.norm()
        }
        (None, None) => return None,
        _ => LOST,
    })
}

/// The distance between a normal and the true one.
pub(super) fn normal(found: [f64; 3], truth: &Crossing) -> f64 {
    if !found.iter().all(|c| c.is_finite()) {
        return LOST;
    }
    let off = &lancer_oracle::Triple::from(found) - &truth.normal;
    off.norm(60).to_f64()
}

/// A direction of length 1, all equally likely.
pub(super) fn direction(rng: &mut fastrand::Rng) -> Vector {
    loop {
        let v = Vector::from_fn(|_, _| 2.0 * rng.f64() - 1.0);
        let length = v.norm();
        if length > 0.1 && length < 1.0 {
            return v / length;
        }
    }
}

/// The ray that comes from so far away to a point.
pub(super) fn from_afar(target: Point, direction: Vector, distance: f64) -> Ray {
    Ray::new(target - direction * distance, direction)
}
