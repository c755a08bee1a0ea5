//! Meshes from files.

mod common;

use common::{Memory, messages, messages_of, text};
use lancer_scene::{Geometry, Mesh, Shape};
use lancer_xml::{Options, Parsed};
use std::sync::Arc;

const OBJ: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n\
                     g base\nf 1 3 2\ng sides\nf 1 2 4\nf 2 3 4\nf 3 1 4\n\
                     g line\nf 1 2 1\n";
const WITH_NORMALS: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 1\nf 1//1 2//2 3//2\n";

fn parse(files: &Memory, shapes: &str) -> Parsed {
    lancer_xml::parse_with(text("", shapes).as_bytes(), &Options::default(), files)
}

fn files() -> Memory {
    let files = [
        ("a.obj", OBJ),
        ("n.obj", WITH_NORMALS),
        ("broken.obj", b"v 0 0 0\nv 0 x 0\n"),
        ("empty.stl", b""),
    ];
    Memory { files: files.into(), ..Memory::default() }
}

fn mesh(shape: &Shape) -> &Arc<Mesh> {
    match &shape.geometry {
        Geometry::Mesh(mesh) => mesh,
        other => panic!("not a mesh: {other:?}"),
    }
}

#[test]
fn each_is_read_once_and_shared() {
    let files = files();
    let parsed = parse(
        &files,
        r#"<mesh file="a.obj" part="sides" color="red"/>
           <mesh file="a.obj" part="sides" color="blue" normals="flat"/>
           <group><mesh file="a.obj" part="sides" color="red"/></group>
           <mesh file="a.obj" part="sides" color="red" normals="smooth"/>
           <mesh file="a.obj" part="base" color="red"/>"#,
    );
    let scene = parsed.scene.as_ref().expect("valid");
    assert!(parsed.diagnostics.is_empty());
    let [first, second, smooth, base] = &scene.shapes[..] else { panic!("four") };
    assert!(Arc::ptr_eq(mesh(first), mesh(second)));
    assert!(Arc::ptr_eq(mesh(first), mesh(&scene.groups[0].group.shapes()[0])));
    assert_eq!((mesh(first).triangle_count(), mesh(first).has_normals()), (3, false));
    assert_eq!((mesh(smooth).triangle_count(), mesh(smooth).has_normals()), (3, true));
    assert_eq!(mesh(base).triangle_count(), 1);
    assert_eq!(*files.reads.borrow(), ["a.obj"; 3], "for what differs, again");
}

#[test]
fn normals_of_the_file_are_for_smooth_meshes() {
    let parsed = parse(
        &files(),
        r#"<mesh file="n.obj" color="red"/><mesh file="n.obj" color="red" normals="smooth"/>"#,
    );
    let scene = parsed.scene.expect("valid");
    assert_eq!(mesh(&scene.shapes[0]).corner_normals(0), None);
    let normals = mesh(&scene.shapes[1]).corner_normals(0).expect("smooth");
    assert_eq!(normals[1].as_slice(), [0.0, 1.0, 1.0], "not those around the corners");
}

#[test]
fn what_is_wrong_names_both_places() {
    for (shape, message, place) in [
        (
            r#"<mesh file="broken.obj" color="red"/>"#,
            "broken.obj, line 2, column 5: expected a finite number, found `x`",
            "broken.obj",
        ),
        (r#"<mesh file="empty.stl" color="red"/>"#, "empty.stl: the file is empty", "empty.stl"),
        (r#"<mesh file="no.ply" color="red"/>"#, "the mesh `no.ply` cannot be read", "no.ply"),
        (
            r#"<mesh file="a.fbx" color="red"/>"#,
            "`a.fbx` is no kind of mesh that is known",
            "a.fbx",
        ),
        (
            r#"<mesh file="a.obj" part="line" color="red"/>"#,
            "a.obj: none of the 1 triangles has an area",
            "line",
        ),
    ] {
        // Said once, not at each mention.
        let parsed = parse(&files(), &shape.repeat(3));
        assert_eq!(messages_of(&parsed), [message]);
        assert_eq!(&parsed.source.text()[parsed.diagnostics[0].span.clone()], place);
        assert!(parsed.scene.is_none());
    }
    let parsed = parse(&files(), r#"<mesh file="a.obj" color="red"/>"#);
    assert_eq!(messages_of(&parsed), ["warning: 1 triangle of `a.obj` is left out"]);
}

#[test]
fn without_files_every_mesh_is_wrong() {
    assert_eq!(
        messages(&text("", r#"<mesh file="a.obj" color="red"/>"#)),
        ["the mesh `a.obj` cannot be read"]
    );
}
