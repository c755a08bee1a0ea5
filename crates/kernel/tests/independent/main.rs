//! The kernel against intersections that are written another way: in numbers
//! twice as long, from the implicit functions of the shapes, by brute force. No
//! formula is shared.
//!
//! A hundred random scenes for each shape; `LANCER_RAYS` says how many rays for
//! each of them, and `--nocapture` shows what was measured.

mod case;
mod cone;
mod convex;
mod dd;
mod facets;
mod figure;
mod judge;
mod mesh;
mod quartic;
mod sample;
mod sheets;
mod space;
mod subject;
mod tally;
mod torus;

use case::Case;
use fastrand::Rng;
use judge::{Asked, judge};
use subject::Kind;
use tally::Tally;

const CASES: u64 = 100;

fn check(kind: Kind) {
    let rays = std::env::var("LANCER_RAYS").map_or(1000, |n| n.parse().expect("a whole number"));
    let mut tally = Tally::default();
    for number in 0..CASES {
        let case = Case::new(kind, number);
        for ray in 0..rays {
            // Its own seed for each ray, whatever the ones before it have used.
            let mut rng = Rng::with_seed(number << 32 | ray);
            tally.at = format!("{kind:?}, case {number}, ray {ray}");
            let (ray, is_easy) = case.ray(&mut rng, ray);
            judge(&case, &Asked { ray, is_easy, left: None }, &mut rng, &mut tally);
        }
    }
    print!("{kind:?}: ");
    tally.finish();
}

macro_rules! checks {
    ($($name:ident: $kind:ident,)*) => {
        $(#[test]
        fn $name() {
            check(Kind::$kind);
        })*
    };
}

checks! {
    spheres: Sphere,
    planes: Plane,
    discs: Disc,
    rectangles: Rectangle,
    triangles: Triangle,
    boxes: Cuboid,
    cubes: Cube,
    tetrahedra: Tetrahedron,
    cylinders: Cylinder,
    open_cylinders: OpenCylinder,
    cones: Cone,
    open_cones: OpenCone,
    frustums: Frustum,
    open_frustums: OpenFrustum,
    tori: Torus,
    closed_meshes: ClosedMesh,
    open_meshes: OpenMesh,
}
