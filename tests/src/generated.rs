//! Scenes of any size, the same on every machine.

use fastrand::Rng;
use lancer_math::{Placement, Vector};
use lancer_scene::{
    Camera, Colour, Group, InvalidScene, Mesh, Scene, SceneBuilder, Shape, Surface,
};
use std::sync::Arc;

/// So many spheres at random in the cube from -1 to 1, so large that a ray
/// among them goes about eight times the distance between neighbours.
///
/// # Errors
/// Where there are too many.
pub fn spheres(count: usize) -> Result<Scene, InvalidScene> {
    let mut rng = Rng::with_seed(1);
    let usual = 0.4 / libm::cbrt(count.max(1) as f64);
    let spheres = (0..count).map(|_| {
        let centre = std::array::from_fn(|_| 2.0 * rng.f64() - 1.0);
        Shape::sphere(centre, usual * (0.5 + rng.f64()), Surface::new(Colour::GREY))
    });
    spheres.fold(builder(), SceneBuilder::shape).build()
}

/// A mesh by itself.
///
/// # Errors
/// Never: a mesh is valid.
pub fn of_mesh(mesh: Mesh) -> Result<Scene, InvalidScene> {
    builder().shape(Shape::mesh(Arc::new(mesh), Surface::new(Colour::GREY))).build()
}

/// Hills over the square from -1 to 1, of about so many triangles; z is up.
///
/// # Panics
/// Where the vertices cannot be counted in 32 bits.
#[must_use]
pub fn terrain(triangles: usize) -> Mesh {
    let side = (triangles as f64 / 2.0).sqrt().round().max(1.0) as u32;
    let place = |i: u32| 2.0 * f64::from(i) / f64::from(side) - 1.0;
    let mut positions = Vec::with_capacity((side as usize + 1).pow(2));
    for j in 0..=side {
        for i in 0..=side {
            let (x, y) = (place(i), place(j));
            // As a mesh file would have it.
            positions.push([x, y, height(x, y)].map(|c| f64::from(c as f32)));
        }
    }
    let at = |i: u32, j: u32| j * (side + 1) + i;
    let squares = (0..side).flat_map(|j| (0..side).map(move |i| (i, j)));
    let halves = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    Mesh::new(positions, halves.collect()).expect("its triangles lie side by side")
}

/// Twelve octaves of noise, each half as high as the one before.
fn height(x: f64, y: f64) -> f64 {
    (0..12).map(|octave| noise(x, y, octave) / f64::from(4 << octave)).sum()
}

/// Smooth noise from -1 to 1, with a random number at each point of a grid.
fn noise(x: f64, y: f64, octave: u8) -> f64 {
    let scale = f64::from(1 << octave);
    let (x, y) = (2.0 * x * scale, 2.0 * y * scale);
    let (i, j) = (x.floor(), y.floor());
    let value = |i: f64, j: f64| {
        let seed =
            (i as i64 as u64) << 32 ^ (j as i64 as u64 & 0xffff_ffff) ^ u64::from(octave) << 58;
        2.0 * Rng::with_seed(seed).f64() - 1.0
    };
    let ease = |t: f64| t * t * (3.0 - 2.0 * t);
    let (u, v) = (ease(x - i), ease(y - j));
    let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
    let below = mix(value(i, j), value(i + 1.0, j), u);
    mix(below, mix(value(i, j + 1.0), value(i + 1.0, j + 1.0), u), v)
}

/// Ten places on a ring for each of the ten places of a ring, and so on for
/// `levels` levels, and in each of the last a terrain of about 100,000
/// triangles.
///
/// # Errors
/// Where there are too many levels.
pub fn nested(levels: u32) -> Result<Scene, InvalidScene> {
    let mesh = Shape::mesh(Arc::new(terrain(100_000)), Surface::new(Colour::GREY));
    let mut group = Group::new(None, vec![mesh.expect("a mesh is valid")], Vec::new());
    for _ in 0..levels {
        let inside = Arc::new(group.expect("there are few levels"));
        let places = (0..10)
            .map(|i| lancer_scene::Placed { placement: place(i), group: Arc::clone(&inside) });
        group = Group::new(None, Vec::new(), places.collect());
    }
    builder().group(Placement::IDENTITY, group.expect("there are few levels")).build()
}

fn place(i: u32) -> Placement {
    let smaller = Placement::scale(Vector::repeat(0.35)).expect("it is not flat");
    let tilted = Placement::rotate(Vector::x(), 50.0).expect("an axis has a direction");
    let around =
        Placement::rotate(Vector::z(), 36.0 * f64::from(i)).expect("an axis has a direction");
    smaller.then(&tilted).then(&Placement::translate(Vector::new(0.7, 0.0, 0.0))).then(&around)
}

fn builder() -> SceneBuilder {
    Scene::builder().camera(Camera::new([3.0, -4.0, 2.5], [0.0; 3], 2.6, [1024, 1024]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_as_asked_for() {
        assert_eq!(spheres(1000).expect("valid").shapes.len(), 1000);
        assert_eq!(terrain(5000).triangle_count(), 5000);
        assert_eq!(nested(3).expect("valid").groups[0].group.shape_count(), 1000);
    }

    #[test]
    fn terrains_have_hills() {
        let (min, max) = terrain(10_000).bounds();
        assert!((min.x, min.y, max.x, max.y) == (-1.0, -1.0, 1.0, 1.0));
        assert!(max.z - min.z > 0.2 && max.z < 0.6 && min.z > -0.6, "{min} {max}");
    }
}
