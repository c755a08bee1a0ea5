//! A short soak of each kind of shape; `cargo xtask stability` asks for longer ones.

use lancer_tests::soak::{Kind, check};

macro_rules! checks {
    ($($name:ident: $kind:ident,)*) => {
        $(#[test]
        fn $name() {
            check(Kind::$kind, 100, 1000);
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
