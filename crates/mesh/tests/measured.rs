//! Real files, where the environment variable `LANCER_MESHES` names their folder.

use lancer_mesh::{MeshFormat, load};
use lancer_scene::Mesh;

/// The mesh of that file; `None` where there is no folder of meshes.
fn file(name: &str, part: Option<&str>) -> Option<Mesh> {
    let Some(folder) = std::env::var_os("LANCER_MESHES") else {
        println!("skipped: LANCER_MESHES is not set");
        return None;
    };
    let bytes = std::fs::read(std::path::Path::new(&folder).join(name)).expect(name);
    let mesh = load(&bytes, MeshFormat::from_name(name).expect(name), part);
    Some(mesh.unwrap_or_else(|e| panic!("{name}: {e}")))
}

#[test]
fn have_as_many_triangles_as_they_should() {
    for (name, triangles, closed) in [
        ("teapot.obj", 6320, false),
        ("spot.obj", 5856, true),
        ("suzanne.obj", 968, false),
        ("stanford-bunny.obj", 69_451, false),
        ("bunny-binary.stl", 69_451, false),
        ("dragon_vrip.ply", 871_414, true),
        ("dragon_vrip_res3.ply", 47_794, true),
    ] {
        let Some(mesh) = file(name, None) else { return };
        assert_eq!(mesh.triangle_count() + mesh.dropped(), triangles, "{name}");
        assert_eq!(mesh.is_closed(), closed, "{name}");
        println!("{name}: {mesh:?}, {} dropped, {} bytes", mesh.dropped(), mesh.bytes());
    }
}

#[test]
fn of_one_body_in_two_formats_have_one_volume() {
    let Some(obj) = file("stanford-bunny.obj", None) else { return };
    let Some(stl) = file("bunny-binary.stl", None) else { return };
    // The binary file has y and z swapped, and its triangles turned with them or not.
    let (obj, stl) = (obj.signed_volume().abs(), stl.signed_volume().abs());
    assert!((obj / stl - 1.0).abs() < 1e-3, "{obj} {stl}");
}

#[test]
fn have_the_parts_that_they_name() {
    let name = "CornellBox-Original.obj";
    for (part, triangles) in [("floor", 2), ("rightWall", 2), ("light", 2), ("shortBox", 12)] {
        let Some(mesh) = file(name, Some(part)) else { return };
        assert_eq!(mesh.triangle_count(), triangles, "{part}");
    }
    // The file names its boxes behind their faces, so that by its groups the
    // short box would belong to the wall before it; its materials are right.
    for (part, triangles) in [("leftWall", 2), ("tallBox", 12)] {
        let Some(mesh) = file(name, Some(part)) else { return };
        assert_eq!(mesh.triangle_count(), triangles, "{part}");
    }
}
