//! One cube in every format, and what each format allows besides.

use lancer_math::Point;
use lancer_mesh::{MeshFormat, load};
use lancer_scene::Mesh;

/// The corners of [-1, 1]^3; corner i has bit k of i along axis k.
fn corners() -> Vec<[f32; 3]> {
    (0..8).map(|i| [0, 1, 2].map(|k| if i >> k & 1 == 1 { 1.0 } else { -1.0 })).collect()
}

/// Its faces, anticlockwise from outside.
const QUADS: [[usize; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

fn triangles() -> Vec<[usize; 3]> {
    QUADS.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect()
}

fn obj() -> Vec<u8> {
    let mut text = String::from("# a cube\r\nmtllib none.mtl\r\n");
    for [x, y, z] in corners() {
        text += &format!("v {x} {y} {z}\r\n");
    }
    for quad in QUADS {
        let [a, b, c, d] = quad.map(|i| i + 1);
        text += &format!("f {a} {b}/1 \\\r\n {c} {d}/9 # a face\r\n");
    }
    text.into_bytes()
}

fn ply_text() -> Vec<u8> {
    let mut text = String::from(
        "ply\nformat ascii 1.0\ncomment a cube\nelement vertex 8\nproperty float x\n\
         property uchar red\nproperty float y\nproperty float z\nelement face 6\n\
         property list uchar int vertex_indices\nelement edge 1\nproperty int a\nend_header\n",
    );
    for [x, y, z] in corners() {
        text += &format!("{x} 255 {y} {z} \n");
    }
    for [a, b, c, d] in QUADS {
        text += &format!("4 {a} {b} {c} {d}\n");
    }
    text.push_str("1\n");
    text.into_bytes()
}

/// `big` says which of the two byte orders.
fn ply_binary(big: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let mut bytes = format!(
        "ply\r\nformat binary_{order}_endian 1.0\r\nelement material 1\r\nproperty short shine\r\n\
         property list uchar double extra\r\nelement vertex 8\r\nproperty double x\r\n\
         property float y\r\nproperty short z\r\nelement face 6\r\nproperty uchar red\r\n\
         property list ushort uchar vertex_index\r\nend_header\r\n"
    )
    .into_bytes();
    let mut put = |little: &[u8]| {
        let mut value = little.to_vec();
        if big {
            value.reverse();
        }
        bytes.extend(value);
    };
    put(&7_i16.to_le_bytes());
    put(&[2]);
    put(&0.5_f64.to_le_bytes());
    put(&0.25_f64.to_le_bytes());
    for [x, y, z] in corners() {
        put(&f64::from(x).to_le_bytes());
        put(&y.to_le_bytes());
        put(&(z as i16).to_le_bytes());
    }
    for quad in QUADS {
        put(&[200]);
        put(&4_u16.to_le_bytes());
        for corner in quad {
            put(&[corner as u8]);
        }
    }
    bytes
}

fn stl_text() -> Vec<u8> {
    let corners = corners();
    let mut text = String::from("solid a cube facet\n");
    for triangle in triangles() {
        text.push_str("facet normal nan 0 0\n  OUTER loop\n");
        for [x, y, z] in triangle.map(|i| corners[i]) {
            text += &format!("    vertex {x:e} {y} {z}\n");
        }
        text.push_str("  endloop\nendfacet\n");
    }
    text.push_str("endsolid a cube\n");
    text.into_bytes()
}

/// Begins like a text file, as some programs write it.
fn stl_binary() -> Vec<u8> {
    let corners = corners();
    let mut bytes = b"solid but binary".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(12_u32.to_le_bytes());
    for triangle in triangles() {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flat_map(|i| corners[*i]).flat_map(f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
    bytes
}

/// The cube in every kind of file.
fn cubes() -> Vec<(&'static str, MeshFormat, Vec<u8>)> {
    vec![
        ("OBJ", MeshFormat::Obj, obj()),
        ("PLY, text", MeshFormat::Ply, ply_text()),
        ("PLY, little endian", MeshFormat::Ply, ply_binary(false)),
        ("PLY, big endian", MeshFormat::Ply, ply_binary(true)),
        ("STL, text", MeshFormat::Stl, stl_text()),
        ("STL, binary", MeshFormat::Stl, stl_binary()),
    ]
}

fn good(bytes: &[u8], format: MeshFormat) -> Mesh {
    load(bytes, format, None).unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(bytes)))
}

#[test]
fn a_cube_is_the_same_in_every_format() {
    for (name, format, bytes) in cubes() {
        let mesh = good(&bytes, format);
        assert_eq!(mesh.triangle_count(), 12, "{name}");
        assert_eq!(mesh.signed_volume(), 8.0, "{name}");
        assert!(mesh.is_closed(), "{name}");
        assert!(mesh.is_single_precision(), "{name}");
        assert_eq!(
            mesh.bounds(),
            (Point::new(-1.0, -1.0, -1.0), Point::new(1.0, 1.0, 1.0)),
            "{name}"
        );
        // Eight shared vertices: so one at a time they smooth to the diagonals.
        let mesh = mesh.with_smooth_normals();
        let (p, n) = (mesh.corners(5)[1], mesh.corner_normals(5).unwrap()[1]);
        assert!((n * 3.0_f64.sqrt() - p.coords).norm() < 1e-6, "{name}");
    }
}

#[test]
fn a_binary_stl_may_begin_in_any_way_and_have_something_behind_it() {
    let mut bytes = stl_binary();
    bytes[..80].fill(b'x');
    assert_eq!(good(&bytes, MeshFormat::Stl).signed_volume(), 8.0);
    bytes[..80].fill(0);
    bytes[..5].copy_from_slice(b"solid");
    bytes.extend(b"behind");
    assert_eq!(good(&bytes, MeshFormat::Stl).signed_volume(), 8.0);
}

#[test]
fn a_text_stl_may_have_several_solids() {
    let bytes = [stl_text(), stl_text().to_ascii_uppercase()].concat();
    let mesh = good(&bytes, MeshFormat::Stl);
    assert_eq!((mesh.triangle_count(), mesh.signed_volume()), (24, 16.0));
}

#[test]
fn text_is_read_in_double_precision() {
    let digits = "0.1000000000000000055 3.333333333333333e-1 -7e-300";
    let exact = Point::new(0.1, 1.0 / 3.0, -7e-300);
    let files = [
        (MeshFormat::Obj, format!("v {digits}\nv 1 0 0\nv 0 1 0\nf 1 2 3")),
        (
            MeshFormat::Ply,
            format!(
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                 property double z\nelement face 1\nproperty list uchar int vertex_index\n\
                 end_header\n{digits}\n\n1. 0 0\n+.0 1 .0\n3 0 1 2"
            ),
        ),
        (
            MeshFormat::Stl,
            format!(
                "solid\nfacet normal 0 0 1 outer loop vertex {digits}\nvertex 1 0 0 vertex 0 1 0 \
                 endloop endfacet\nendsolid"
            ),
        ),
    ];
    for (format, text) in files {
        let mesh = good(text.as_bytes(), format);
        assert_eq!(mesh.corner(0, 0), exact, "{format:?}");
        assert_eq!(mesh.corner(0, 2), Point::new(0.0, 1.0, 0.0), "{format:?}");
        assert!(!mesh.is_single_precision());
    }
}

#[test]
fn obj_indices_count_from_both_ends() {
    let text = b"f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nv 2 0 0\nf -5 -1 -3\n";
    let mesh = good(text, MeshFormat::Obj);
    assert_eq!(mesh.corners(0)[1], Point::new(1.0, 0.0, 0.0));
    assert_eq!(mesh.corners(1)[1], Point::new(2.0, 0.0, 0.0));
    assert_eq!(mesh.corners(1)[2], mesh.corners(0)[2]);
}

#[test]
fn normals_are_kept_where_a_file_has_them() {
    let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 2\nvn 0 1 0\n\
                 f 1 2 3\nf 2//1 4//-1 3//1\n";
    let mesh = good(text, MeshFormat::Obj);
    assert_eq!(mesh.corner_normals(0).unwrap().map(|n| n.norm()), [0.0; 3]);
    assert_eq!(mesh.corner_normals(1).unwrap().map(|n| n.z), [2.0, 0.0, 2.0]);

    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\nproperty float ny\n\
                property float nz\nproperty float x\nproperty float y\nproperty float z\n\
                element face 1\nproperty list uchar int vertex_index\nend_header\n\
                0 0 1 0 0 0\n0 1 0 1 0 0\n1 0 0 0 1 0\n3 0 1 2\n";
    let mesh = good(text.as_bytes(), MeshFormat::Ply);
    assert_eq!(mesh.corner_normals(0).unwrap().map(|n| n.y), [0.0, 1.0, 0.0]);
}

#[test]
fn an_obj_part_is_a_group_or_an_object() {
    let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 7 0 0\nvn 0 0 1\n\
                 f 1 2 3\n\
                 g left wall\nf 1 2 3\nf 1 2 3\n\
                 o my chair\nf 1 2 3\n\
                 g\nf 1 2 3\n\
                 o left\ng other\nf 1 4 3\nf 1//1 2//1 3//1\n";
    for (part, triangles) in
        [("left", 5), ("wall", 3), ("left wall", 3), ("my chair", 2), ("other", 2)]
    {
        let mesh = load(text, MeshFormat::Obj, Some(part)).unwrap();
        assert_eq!(mesh.triangle_count(), triangles, "{part}");
        assert_eq!(mesh.has_normals(), ["left", "other"].contains(&part), "{part}");
        let right = if ["left", "other"].contains(&part) { 7.0 } else { 1.0 };
        assert_eq!(mesh.bounds().1.x, right, "{part}");
    }
    assert_eq!(good(text, MeshFormat::Obj).triangle_count(), 7);
}

#[test]
fn an_obj_part_is_a_material_before_all_else() {
    let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\n\
                 g wall\nusemtl red paint\nf 1 2 3\nusemtl glass\nf 1 2 3\nf 1 2 3\n\
                 g glass\nusemtl red paint\nf 1 2 3\n";
    for (part, triangles) in [("red paint", 2), ("glass", 2), ("wall", 3)] {
        let mesh = load(text, MeshFormat::Obj, Some(part)).unwrap();
        assert_eq!(mesh.triangle_count(), triangles, "{part}");
    }
}

#[test]
fn whatever_is_done_to_a_file_is_answered() {
    use std::time::{Duration, Instant};
    let files = cubes();
    for case in 0..6000 {
        let mut random = fastrand::Rng::with_seed(case);
        let (name, format, bytes) = &files[random.usize(..files.len())];
        let mut bytes = bytes.clone();
        for _ in 0..random.usize(1..6) {
            let at = random.usize(..bytes.len().max(1));
            match random.u8(..6) {
                0 if !bytes.is_empty() => bytes[at] = random.u8(..),
                1 if !bytes.is_empty() => bytes[at] ^= 1 << random.u8(..8),
                2 => bytes.truncate(at),
                3 => {
                    let piece: Vec<u8> = bytes.iter().copied().skip(at).take(30).collect();
                    let to = random.usize(..=bytes.len());
                    bytes.splice(to..to, piece);
                }
                4 => {
                    let end = (at + random.usize(..20)).min(bytes.len());
                    bytes.drain(at.min(end)..end);
                }
                _ => {
                    let words: [&[u8]; 9] = [
                        b" -1 ",
                        b"99999999999999999999",
                        b" nan ",
                        b"1e999",
                        b"\n",
                        b" 6148914691236517206 ",
                        b"/",
                        b"\xff\xfe",
                        b"element x 1152921504606846976\n",
                    ];
                    let to = random.usize(..=bytes.len());
                    bytes.splice(to..to, words[random.usize(..words.len())].iter().copied());
                }
            }
        }
        let start = Instant::now();
        if let Ok(mesh) = load(&bytes, *format, None) {
            // What is there can be used.
            assert!(mesh.triangle_count() > 0, "case {case}, {name}");
            let mesh = mesh.with_smooth_normals();
            for triangle in 0..mesh.triangle_count() {
                let finite = |p: &Point| p.iter().all(|c| c.is_finite());
                assert!(mesh.corners(triangle).iter().all(finite), "case {case}, {name}");
                assert!(mesh.corner_normals(triangle).is_some(), "case {case}, {name}");
            }
            let _ = mesh.is_closed();
        }
        assert!(start.elapsed() < Duration::from_secs(1), "case {case}, {name}");
    }
}
