//! Closed solids are left as often as they are entered, by rays through their
//! edges, corners, rims and outermost points, too.

use crate::help::{glass, rendered, scene};
use lancer_integrator::{Trouble, Whitted};
use lancer_scene::{Camera, InvalidField, Mesh, Shape, Surface};
use std::sync::Arc;

/// Parallel rays that meet the planes through the origin at all multiples of 1/8:
/// all coordinates are exact.
fn grid(from: [f64; 3]) -> Result<Camera, InvalidField> {
    let mut camera =
        Camera::new(from, [0.0; 3], 1.0, [41, 41]).and_then(|c| c.orthographic(41.0 / 8.0))?;
    if from[0] == 0.0 && from[1] == 0.0 {
        camera.up = lancer_scene::Direction::new([0.0, 1.0, 0.0]).expect("not zero");
    }
    Ok(camera)
}

fn octahedron() -> Arc<Mesh> {
    let mut corners = Vec::new();
    for axis in 0..3 {
        for side in [-2.0, 2.0] {
            let mut corner = [0.0; 3];
            corner[axis] = side;
            corners.push(corner);
        }
    }
    let mut triangles = Vec::new();
    for x in [0, 1] {
        for y in [2, 3] {
            for z in [4, 5] {
                let outward = (x + y + z) % 2 == 1;
                triangles.push(if outward { [x, y, z] } else { [x, z, y] });
            }
        }
    }
    Arc::new(Mesh::new(corners, triangles).expect("valid"))
}

fn solids(surface: Surface) -> Vec<Result<Shape, InvalidField>> {
    let cube = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
    vec![
        Shape::sphere([0.0; 3], 2.0, surface),
        Shape::cuboid([-1.0, -2.0, -0.5], [1.0, 1.0, 2.0], surface),
        Shape::tetrahedron(cube, surface),
        Shape::cylinder([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], 2.0, surface),
        Shape::cone([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], 2.0, surface),
        Shape::frustum(([0.0, 0.0, -1.0], 2.0), ([0.0, 0.0, 1.0], 1.0), surface),
        Shape::torus([0.0; 3], [0.0, 0.0, 1.0], [1.5, 0.5], surface),
        Shape::mesh(octahedron(), surface),
        Shape::plane([0.0; 3], [1.0, 2.0, 2.0], surface),
    ]
}

/// Of the medium around it nothing is to be seen of a solid, and all media make
/// sense.
#[test]
fn rays_through_edges_and_corners_make_sense() {
    let mut found = Vec::new();
    for shape in solids(glass(1.0)) {
        let kind = shape.as_ref().expect("valid").geometry.kind().to_owned();
        for from in [[0.0, -8.0, 0.0], [8.0, 0.0, 0.0], [0.0, 0.0, 8.0], [8.0, -8.0, 0.0]] {
            let result = rendered(scene(grid(from), 1.0).shape(shape.clone()), Whitted::CUTOFF);
            let troubles = result.counts.troubles.media;
            if troubles != Trouble::default() {
                found.push(format!("{kind} from {from:?}: {troubles:?}"));
            }
            assert!(result.film.pixels().iter().all(|pixel| *pixel == [1.0; 3]), "{kind} {from:?}");
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Two of each, side by side with a face, an edge or a point together, or the one
/// in the other.
#[test]
fn solids_that_share_faces_make_sense() {
    let mut found = Vec::new();
    for (first, second) in solids(glass(1.0)).into_iter().zip(solids(glass(1.0).priority(1))) {
        let kind = first.as_ref().expect("valid").geometry.kind().to_owned();
        for from in [[0.0, -8.0, 0.0], [8.0, 0.0, 0.0], [0.0, 0.0, 8.0]] {
            let both = scene(grid(from), 1.0).shape(first.clone()).shape(second.clone());
            let ball = Shape::sphere([0.0; 3], 0.75, glass(1.0));
            let result = rendered(both.shape(ball), Whitted::CUTOFF);
            let troubles = result.counts.troubles.media;
            if troubles != Trouble::default() {
                found.push(format!("{kind} from {from:?}: {troubles:?}"));
            }
            assert!(result.film.pixels().iter().all(|pixel| *pixel == [1.0; 3]), "{kind} {from:?}");
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Each ray goes in once and out once, however far from the origin: no face is
/// met again by the ray that leaves it.
#[test]
fn no_face_is_met_twice() {
    for far in [0.0, 1e3, 1e6, 1e8] {
        let camera = Camera::new([far - 3.0, far - 4.0, far + 2.0], [far; 3], 4.0, [40, 40]);
        for shape in [
            Shape::sphere([far; 3], 1.0, glass(1.0)),
            Shape::cube([far; 3], 1.5, glass(1.0)),
            Shape::cylinder([far, far, far - 0.5], [far, far, far + 0.5], 1.0, glass(1.0)),
        ] {
            let kind = shape.as_ref().expect("valid").geometry.kind().to_owned();
            let result = rendered(scene(camera.clone(), 1.0).shape(shape), Whitted::CUTOFF);
            let layers = result.layers.expect("asked for");
            let hit = layers.pixels().iter().filter(|layer| layer.shape == 1).count();
            assert!(hit > 200);
            assert_eq!(result.counts.transmitted, 2 * hit as u64, "{kind} at {far}");
            assert_eq!(result.counts.troubles.media, Trouble::default(), "{kind} at {far}");
        }
    }
}
