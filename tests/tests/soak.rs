//! A short soak of each kind of shape; `cargo xtask stability` asks for longer ones.

use lancer_tests::soak::{Kind, soak};

macro_rules! checks {
    ($($name:ident: $kind:ident,)*) => {
        $(#[test]
        fn $name() {
            let problems = soak(Kind::$kind, 0, 40_000).problems();
            assert!(problems.is_empty(), "{}", problems.join("\n\n"));
        })*

        #[test]
        fn no_kind_is_left_out() {
            let names: Vec<_> = Kind::all().map(Kind::name).collect();
            assert_eq!([$(Kind::$kind.name()),*], names[..]);
        }
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
    mixed_shapes: Mixed,
}
