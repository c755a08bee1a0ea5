//! A short soak of each kind of shape; `cargo xtask stability` asks for longer ones.

use lancer_tests::soak::{Kind, closed, leaks, replay, soak};

macro_rules! checks {
    ($($name:ident: $kind:ident,)*) => {
        $(#[test]
        fn $name() {
            let problems = soak(Kind::$kind, 0, 0..10_000, |_| ()).problems();
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

#[test]
fn closed_meshes_do_not_leak() {
    for mesh in [closed::ball(9), closed::block(5), closed::ring(40)] {
        let seen = leaks(&mesh, 0, 65_536);
        assert_eq!((seen.leaks, seen.disagreements), (0, 0), "{}", seen.told.join("\n"));
    }
}

/// Found by long soaks: cones from a dozen sizes away, rims of flat ones, a sharp corner beside
/// its box, a plane in groups within groups, a ray that leaves a box at its edge.
#[test]
fn rays_that_were_answered_wrongly_once() {
    for id in [
        "mixed:2:222:170",
        "open-frustum:2:102:621",
        "open-frustum:2:362:46",
        "open-frustum:3:18:335",
        "tetrahedron:3:458:478",
        "mixed:3:495:332",
        "cube:1:2245:18:left",
    ] {
        let story = replay(id.parse().expect("an id"));
        assert!(story.ends_with("nothing is wrong with it"), "{id}: {story}");
    }
}

#[test]
fn what_is_found_in_parts_is_what_is_found_at_once() {
    let part = |rays| soak(Kind::Cone, 6, rays, |_| ());
    assert_eq!(part(0..1000).and(part(1000..2500)).rows(true), part(0..2500).rows(true));
}

#[test]
fn what_is_found_does_not_depend_on_threads() {
    let found = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| soak(Kind::Mixed, 5, 0..2000, |_| ()).rows(true))
    });
    assert_eq!(found[0], found[1]);
}
