//! Smooth meshes: lit, mirroring and bending by another normal than that of their
//! triangles, but never through them.

use crate::help::{FILM, assert_near, at_height, eye, glass, grey, mirror, rays, scene, shining};
use crate::help::{sin_cos, white};
use lancer_scene::{InvalidField, Light, Mesh, Shape, Surface};
use std::sync::Arc;

/// A triangle in the plane z = 0 with the normal (3, 0, 4)/5 at all corners, so
/// everywhere.
fn tilted(surface: Surface) -> Result<Shape, InvalidField> {
    let corners = vec![[-2.0, -2.0, 0.0], [2.0, -2.0, 0.0], [0.0, 3.0, 0.0]];
    let mesh = Mesh::new(corners, vec![[0, 1, 2]]).expect("valid");
    let mesh = mesh.with_normals(vec![[3.0, 0.0, 4.0]; 3], None).expect("one for each corner");
    Shape::mesh(Arc::new(mesh), surface)
}

/// The facet decides whether there is light, the other normal how much.
#[test]
fn light_falls_by_the_smooth_normal_on_the_side_of_the_facet() {
    for degrees in [0.0, 30.0, 60.0, 89.0, 91.0, 120.0, -30.0, -53.0, -54.0, -80.0] {
        let [sine, cosine] = sin_cos(degrees);
        let by_normal = 0.6 * sine + 0.8 * cosine;
        let expected = if cosine > 0.0 { by_normal.max(0.0) } else { 0.0 };
        for from in [1.0, -1.0] {
            // From below all is turned over.
            let sun = Light::sun([-from * sine, 0.0, -from * cosine], 1.0);
            let lit = scene(eye([0.1, 0.2, from], [0.0; 3]), 0.0).shape(tilted(white())).light(sun);
            assert_near(grey(lit), expected, 2e-7, &format!("{degrees} degrees from {from}"));
        }
    }
}

#[test]
fn a_smooth_mirror_mirrors_by_its_normal() {
    // d - 2 (d . n) n of (0, 0, -1) is (0.96, 0, 0.28).
    let seen = scene(eye([0.0, 0.0, 3.0], [0.0; 3]), 0.0)
        .shape(tilted(mirror(1.0)))
        .shape(Shape::sphere([4.8, 0.0, 1.4], 1e-5, shining([1.0; 3])));
    assert_near(grey(seen), 1.0, FILM, "a small ball where it is mirrored to");
    // From the other side the direction would be below the facet, and is turned
    // up again: nothing that is above is seen through it.
    let along = rays(scene(eye([-3.0, 0.0, 1.0], [0.0; 3]), 0.0).shape(tilted(mirror(1.0))));
    assert!(along.len() == 2 && along[1].direction.z >= 0.0, "{along:?}");
    let grazing = rays(scene(eye([3.0, 0.0, 0.1], [0.0; 3]), 0.0).shape(tilted(mirror(1.0))));
    assert!(grazing.len() == 2 && grazing[1].direction.z >= 0.0, "{grazing:?}");
}

/// Snell's law about the normal: its sine to the ray is 0.6 outside, so 0.4 inside,
/// measured from it.
#[test]
fn smooth_glass_bends_by_its_normal() {
    let corners = vec![[-2.0, -2.0, 0.0], [2.0, -2.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, -9.0]];
    let mesh = Mesh::new(corners, vec![[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]);
    let mesh = mesh.expect("valid").with_normals(vec![[3.0, 0.0, 4.0]; 4], None);
    let solid = Shape::mesh(Arc::new(mesh.expect("one for each corner")), glass(1.5));
    let paths = rays(scene(eye([0.0, 0.0, 3.0], [0.0; 3]), 1.0).shape(solid));
    let (normal, bent) = (libm::asin(0.6), libm::asin(0.6 / 1.5));
    // The angle from the vertical, towards -x.
    let expected = -libm::tan(normal - bent) * 0.5;
    let inside = paths.iter().filter(|ray| ray.direction.z < 0.0 && ray.origin.z < 0.5);
    let misses = inside.map(|ray| (at_height(ray, -0.5)[0] - expected).abs());
    let least = misses.fold(f64::INFINITY, f64::min);
    assert!(least < 1e-13, "{least}");
}
