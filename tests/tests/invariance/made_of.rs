//! The same surface described in another way.

use crate::{PIXELS, bits, differing, picture, scene};
use lancer_math::{Placement, Vector};
use lancer_scene::{
    Camera, Colour, Geometry, Group, InvalidField, Light, Mesh, Placed, Scene, Shape, Surface,
};
use std::sync::Arc;

/// What two descriptions may differ by: one unit in the last place of the film, 2^-23 of
/// a value, twice that through glass.
const ROUNDING: f64 = 3e-7;

fn grey() -> Surface {
    Surface::new(Colour::GREY)
}

/// Two balls that stand on the floor and a pane that cuts through it, seen from above.
fn on_a_floor(floor: Vec<Result<Shape, InvalidField>>) -> Scene {
    // The columns of the picture's middle, of odd number, look at x = 0 exactly.
    let camera = Camera::new([0.0, -2.0, 6.0], [0.0, 0.5, 0.0], 6.0, [PIXELS[0] + 1, PIXELS[1]]);
    let builder = Scene::builder()
        .camera(camera)
        .light(Light::lamp([0.0, -3.0, 4.0], 12.0))
        .light(Light::lamp([-3.0, 2.0, 5.0], 12.0))
        .shape(Shape::sphere([0.0, 0.0, 0.5], 0.5, Surface::new(Colour::RED).gloss(0.4)))
        .shape(Shape::sphere([1.5, 1.0, 0.25], 0.25, grey()))
        .shape(Shape::rectangle(
            [-2.0, 1.5, -0.5],
            [[1.0, 0.25, 0.0], [0.0, 0.0, 1.0]],
            Surface::new(Colour::GREEN),
        ));
    floor.into_iter().fold(builder, lancer_scene::SceneBuilder::shape).build().expect("it is valid")
}

fn slab(x: f64, width: f64, surface: Surface) -> Result<Shape, InvalidField> {
    Shape::rectangle([x, -16.0, 0.0], [[width, 0.0, 0.0], [0.0, 32.0, 0.0]], surface)
}

/// No ray goes through where they meet, none sees it.
#[test]
fn a_plane_and_its_halves() {
    for surface in [grey(), grey().gloss(0.5).expect("it is a share")] {
        let plane = Shape::plane([0.0; 3], [0.0, 0.0, 1.0], surface);
        let whole = on_a_floor(vec![plane]);
        let halves = on_a_floor(vec![slab(-1024.0, 1024.0, surface), slab(0.0, 1024.0, surface)]);
        // The horizon is not in the picture, but in the ball.
        let (whole, halves) = (picture(&whole), picture(&halves));
        let n = differing(whole.film.pixels(), halves.film.pixels(), ROUNDING);
        assert_eq!(n, 0);
    }
    let checker = grey().checker(Colour::WHITE);
    let whole = on_a_floor(vec![slab(-16.0, 32.0, checker)]);
    let halves = on_a_floor(vec![slab(-16.0, 16.0, checker), slab(0.0, 16.0, checker)]);
    let (whole, halves) = (picture(&whole), picture(&halves));
    assert_eq!(differing(whole.film.pixels(), halves.film.pixels(), ROUNDING), 0);
    assert_ne!(
        bits(&whole.film),
        bits(&picture(&on_a_floor(vec![slab(-16.0, 32.0, grey())])).film)
    );
}

/// The same faces as triangles; nothing of shapes that have others.
fn as_mesh(geometry: &Geometry) -> Option<Mesh> {
    let (positions, triangles): (Vec<[f64; 3]>, Vec<[u32; 3]>) = match geometry {
        Geometry::Cuboid(cuboid) => {
            let (min, max) = (cuboid.min(), cuboid.max());
            let corner = |i: usize| {
                std::array::from_fn(|axis| if i >> axis & 1 == 0 { min[axis] } else { max[axis] })
            };
            let faces = [
                [0, 2, 3, 1],
                [4, 5, 7, 6],
                [0, 1, 5, 4],
                [2, 6, 7, 3],
                [0, 4, 6, 2],
                [1, 3, 7, 5],
            ];
            let halves = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
            ((0..8).map(corner).collect(), halves.collect())
        }
        Geometry::Tetrahedron(solid) => (
            solid.corners().map(|p| p.coords.into()).to_vec(),
            vec![[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]],
        ),
        Geometry::Rectangle(rectangle) => {
            let corner = rectangle.corner().coords;
            let [a, b] = rectangle.sides().map(|side| side.get());
            let corners = [corner, corner + a, corner + a + b, corner + b];
            (corners.map(Into::into).to_vec(), vec![[0, 1, 2], [0, 2, 3]])
        }
        Geometry::Triangle(triangle) => {
            (triangle.corners().map(|p| p.coords.into()).to_vec(), vec![[0, 1, 2]])
        }
        _ => return None,
    };
    Some(Mesh::new(positions, triangles).expect("each has an area"))
}

/// How many of the shapes were replaced.
fn replace(shapes: &mut [Shape]) -> usize {
    let mut replaced = 0;
    for shape in shapes {
        if let Some(mesh) = as_mesh(&shape.geometry) {
            replaced += 1;
            shape.geometry = Geometry::Mesh(Arc::new(mesh));
        }
    }
    replaced
}

#[test]
fn flat_solids_and_their_meshes() {
    // Cells begin elsewhere on triangles, so none of these has any.
    for (name, count) in [("all_shapes", 5), ("sheets", 3), ("facing_mirrors", 2)] {
        let scene = scene(name);
        let mut other = scene.clone();
        assert_eq!(replace(&mut other.shapes), count, "{name}");
        let (found, expected) = (picture(&other), picture(&scene));
        let n = differing(found.film.pixels(), expected.film.pixels(), ROUNDING);
        assert_eq!(n, 0, "{name}");
    }
}

/// Glass over a checker, with something in it and half in the floor.
#[test]
fn glass_and_its_mesh() {
    let glass = |absorption| Surface::glass(1.5).expect("valid").absorption([absorption, 0.2, 0.1]);
    let floor = grey().checker(Colour::WHITE);
    let scene = Scene::builder()
        .camera(Camera::new([1.0, -6.0, 3.0], [0.2, 0.0, 0.7], 5.0, PIXELS))
        .light(Light::lamp([-3.0, -3.0, 5.0], 30.0))
        .light(Light::sun([0.3, 0.6, -1.0], 0.4))
        .shape(Shape::plane([0.25, 0.25, 0.0], [0.0, 0.0, 1.0], floor))
        .shape(Shape::cuboid([-1.5, -1.0, 0.0], [0.5, 1.0, 1.5], glass(0.3)))
        .shape(Shape::cuboid([-1.0, -0.5, 0.5], [0.0, 0.5, 1.0], Surface::glass(1.0)))
        .shape(Shape::sphere([-0.5, 0.0, 0.75], 0.25, Surface::new(Colour::RED)))
        .shape(Shape::tetrahedron(
            [[1.0, -1.0, -0.5], [2.0, -1.0, -0.5], [1.5, 0.0, -0.5], [1.5, -0.75, 1.0]],
            glass(0.1),
        ))
        .build()
        .expect("it is valid");
    let mut other = scene.clone();
    assert_eq!(replace(&mut other.shapes), 3);
    let (found, expected) = (picture(&other), picture(&scene));
    assert_eq!(differing(found.film.pixels(), expected.film.pixels(), ROUNDING), 0);
}

/// A group where it stands is what is in it, moved.
#[test]
fn a_group_and_its_shapes() {
    let scene = scene("water_glass");
    let offset = Vector::new(2.0, -1.0, 0.5);
    let inside = lancer_tests::moved::translated(&scene, -offset).expect("it is in range").shapes;
    let group = Group::new(None, inside, Vec::new()).expect("it is small");
    let placement = Placement::translate(offset);
    let groups = vec![Placed { placement, group: Arc::new(group) }];
    let other = Scene { shapes: Vec::new(), groups, ..scene.clone() };
    let (found, expected) = (picture(&other), picture(&scene));
    assert_eq!(differing(found.film.pixels(), expected.film.pixels(), ROUNDING), 0);
}
