//! Each kind of mistake, with its message, place and help.

use lancer_mesh::{MeshFileError, MeshFormat, Place, load};
use std::time::{Duration, Instant};

fn error(bytes: impl AsRef<[u8]>, format: MeshFormat, part: Option<&str>) -> MeshFileError {
    let start = Instant::now();
    let result = load(bytes.as_ref(), format, part);
    assert!(start.elapsed() < Duration::from_secs(1));
    match result {
        Err(error) => error,
        Ok(mesh) => panic!("accepted: {mesh:?}"),
    }
}

fn obj(text: &str) -> String {
    error(text, MeshFormat::Obj, None).to_string()
}

fn ply(bytes: impl AsRef<[u8]>) -> String {
    error(bytes, MeshFormat::Ply, None).to_string()
}

fn stl(bytes: impl AsRef<[u8]>) -> String {
    error(bytes, MeshFormat::Stl, None).to_string()
}

#[test]
fn of_any_format() {
    for (format, _) in MeshFormat::ALL {
        assert_eq!(error("", *format, None).to_string(), "the file is empty");
        assert_eq!(error("", *format, Some("x")).place, Place::File);
    }
    for (format, name) in [(MeshFormat::Ply, "PLY"), (MeshFormat::Stl, "STL")] {
        let error = error("x", format, Some("roof"));
        assert_eq!(error.to_string(), format!("{name} files have no parts, so none called `roof`"));
        assert_eq!(
            error.help.as_deref(),
            Some("leave the part out, or keep it in a file of its own")
        );
    }
}

#[test]
fn of_obj() {
    for (text, expected) in [
        ("v 0 0", "line 1: expected three numbers, found the end of the line"),
        ("# \u{e9}\r\nv 0 x 0", "line 2, column 5: expected a finite number, found `x`"),
        ("v 0 NaN 0", "line 1, column 5: expected a finite number, found `NaN`"),
        ("v 0 0 \\\n 1e999", "line 2, column 2: expected a finite number, found `1e999`"),
        ("\rvn 0 -inf 0", "line 2, column 6: expected a finite number, found `-inf`"),
        ("vn 0 0 # 0", "line 1: expected three numbers, found the end of the line"),
        ("v 0 0 0\n\nf 1 1 2", "line 3, column 7: there is no vertex 2: there is 1 in the file"),
        ("f 0 1 2", "line 1, column 3: there is no vertex 0: they count from 1"),
        (
            "v 0 0 0\nv 0 0 0\nf -1 -2 -3\nv 0 0 0",
            "line 3, column 9: there is no vertex -3: there are 2 in the file before this line",
        ),
        (
            "v 0 0 0\nf 1 1 1//2\nvn 0 0 1",
            "line 2, column 10: there is no normal 2: there is 1 in the file",
        ),
        (
            "v 0 0 0\nvn 0 0 1\nf 1//6148914691236517206 1 1",
            "line 3, column 6: there is no normal 6148914691236517206: there is 1 in the file",
        ),
        (
            "v 0 0 0\nf 1 1 9223372036854775808",
            "line 2, column 7: expected the number of a vertex, found `9223372036854775808`",
        ),
        (
            "v 0 0 0\nf 1 1 -9223372036854775808",
            "line 2, column 7: there is no vertex -9223372036854775808: \
             there is 1 in the file before this line",
        ),
        ("v 0 0 0\nf 1 1 /1", "line 2, column 7: expected the number of a vertex, found ``"),
        ("v 0 0 0\nf 1 1 1/", "none of the 1 triangles has an area"),
        (
            "v 0 0 0\nf 1 1 1/1/1/1",
            "line 2, column 7: expected at most `vertex/texture/normal`, found `1/1/1/1`",
        ),
        ("v 0 0 0\nf 1 \\\n 1", "line 2: expected a face with at least 3 corners, found 2"),
        ("o nothing\n\0\0\0", "the file has no face"),
    ] {
        assert_eq!(obj(text), expected, "{text:?}");
    }
    let not_text = error(b"v 0 \xff\xff 0", MeshFormat::Obj, None);
    assert_eq!(not_text.place, Place::Line { line: 1, column: Some(5) });
    let long = obj(&format!("v {}", "x".repeat(1_000_000)));
    assert_eq!(
        long,
        format!("line 1, column 3: expected a finite number, found `{}...`", "x".repeat(40))
    );
}

#[test]
fn of_obj_parts() {
    let cube = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let unknown =
        |groups: &str, part: &str| error(format!("{cube}{groups}"), MeshFormat::Obj, Some(part));
    let error = unknown("f 1 2 3", "roof");
    assert_eq!(
        error.to_string(),
        "no face is in a group or object, or of a material, called `roof`"
    );
    assert_eq!(
        error.help.as_deref(),
        Some("the file has no groups, objects or materials: leave the part out")
    );
    let error = unknown("o my house\ng wall left\nf 1 2 3\ng empty\ng roofs\nf 1 2 3", "roof");
    assert_eq!(error.help.as_deref(), Some("its parts: `wall`, `left`, `my house`, `roofs`"));
    let groups: String = (0..5000).map(|i| format!("g group{i}\nf 1 2 3\n")).collect();
    let error = unknown(&groups, "gruop123");
    let help = error.help.unwrap();
    assert!(help.starts_with("the most similar of its parts: `group123`, "), "{help}");
    assert_eq!(help.matches('`').count(), 40);
}

const HEADER: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                      property float z\nelement face 1\nproperty list uchar int vertex_indices\n\
                      end_header\n";

#[test]
fn of_ply_headers() {
    let header = |from: &str, to: &str| {
        assert!(HEADER.contains(from));
        ply(HEADER.replace(from, to) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    };
    assert_eq!(ply("solid"), "line 1, column 1: expected `ply`, found `sol`");
    assert_eq!(ply("plywood\n"), "line 1: no line of a PLY header: `plywood`");
    assert_eq!(ply("ply\n"), "line 2: the header has no line `end_header`");
    assert_eq!(
        ply("ply\nformat ascii 1.0\ncomment x"),
        "line 4: the header has no line `end_header`"
    );
    let many: String = (0..2000).map(|i| format!("element e{i} 1\n")).collect();
    assert_eq!(ply(format!("ply\n{many}")), "line 1002: more than 1000 elements and properties");
    for (from, to, expected) in [
        ("ascii", "ebcdic", "line 2: no line of a PLY header: `format ebcdic 1.0`"),
        ("format ascii 1.0\n", "", "the header has no line like `format ascii 1.0`"),
        ("float y", "int64 y", "line 5: no line of a PLY header: `property int64 y`"),
        (
            "vertex 3",
            "vertex 99999999999999999999",
            "line 3: no line of a PLY header: `element vertex 99999999999999999999`",
        ),
        ("float y", "float x", "line 5: `x` is declared twice"),
        ("element face", "element vertex", "line 7: `vertex` is declared twice"),
        ("element vertex", "element point", "the header has no element `vertex`"),
        ("element face", "element tristrips", "the header has no element `face`"),
        ("float z", "float w", "the element `vertex` needs the properties `x`, `y` and `z`"),
        (
            "uchar int vertex_indices",
            "uchar float vertex_indices",
            "the element `face` needs `vertex_indices`, a list of whole numbers",
        ),
        (
            "list uchar int",
            "int",
            "the element `face` needs `vertex_indices`, a list of whole numbers",
        ),
    ] {
        assert_eq!(header(from, to), expected);
    }
    let mut bytes = b"ply\nformat ascii 1.0\ncomment ".to_vec();
    bytes.extend([0xff; 9]);
    assert_eq!(ply(bytes), "the header is not text");
}

#[test]
fn of_ply_text() {
    let rows = |rows: &str| ply(format!("{HEADER}{rows}"));
    for (text, expected) in [
        ("", "line 10: 3 rows of `vertex` are announced, but only 0 bytes follow"),
        (
            "0 0 0\n1 0 0\n0 1 0\n",
            "line 13: 1 rows of `face` are announced, but only 0 bytes follow",
        ),
        ("0 0 0 0 0 0 0 0 0 0\n1 0 0\n", "line 12: the file ends before the last row of `vertex`"),
        (
            "0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n",
            "line 11, column 1: expected a finite number, found `nan`",
        ),
        ("0 0 0\n1 1e999 0\n0 1 0\n3 0 1 2\n", "line 11: expected finite numbers, found inf"),
        (
            "0 0 0\n1 0\n0 1 0\n3 0 1 2\n",
            "line 11: the row is no row of `vertex` as the header declares it",
        ),
        (
            "0 0 0\n1 0 0\n\n0 1 0\n3 0 1 3",
            "line 14: there is no vertex 3: there are 3, counted from 0",
        ),
        (
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1",
            "line 13: there is no vertex -1: there are 3, counted from 0",
        ),
        ("0 0 0\n1 0 0\n0 1 0\n2 0 1", "line 13: expected a face with at least 3 corners, found 2"),
        (
            "0 0 0\n1 0 0\n0 1 0\n1000000000 0 1 2",
            "line 13: the row is no row of `face` as the header declares it",
        ),
        (
            "0 0 0\n1 0 0\n0 1 0\n3 0 1.5 2",
            "line 13: the row is no row of `face` as the header declares it",
        ),
        ("0 0 0\n1 0 0\n2 0 0\n3 0 1 2", "none of the 1 triangles has an area"),
    ] {
        assert_eq!(rows(text), expected, "{text:?}");
    }
    let mut bytes = HEADER.as_bytes().to_vec();
    bytes.extend(b"0 0 0\n\xff\xfe 0 0\n0 1 0\n3 0 1 2\n");
    assert!(ply(bytes).starts_with("line 11, column 1: expected a finite number, found `"));
}

#[test]
fn of_binary_ply() {
    let header = HEADER.replace("ascii", "binary_little_endian").replace("uchar", "int");
    let start = header.len();
    let file = |rows: &[&[u8]]| [header.as_bytes(), &rows.concat()].concat();
    let vertices: Vec<u8> = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]
        .iter()
        .flat_map(|c| c.to_le_bytes())
        .collect();
    let list = |count: i32| count.to_le_bytes();

    let huge = String::from_utf8(file(&[&[0; 36]])).unwrap();
    let huge = huge.replace("vertex 3", "vertex 1152921504606846976");
    assert_eq!(
        ply(&huge),
        format!(
            "byte {}: 1152921504606846976 rows of `vertex` are announced, but only 36 bytes follow",
            huge.len() - 36
        )
    );
    let at_faces = start + 36;
    for (rows, expected) in [
        (list(1_000_000_000).to_vec(), "the file ends within a row of `face`"),
        (list(-1).to_vec(), "the row is no row of `face` as the header declares it"),
        (
            [list(3), list(0), list(1), list(7)].concat(),
            "there is no vertex 7: there are 3, counted from 0",
        ),
        ([list(0)].concat(), "expected a face with at least 3 corners, found 0"),
    ] {
        assert_eq!(ply(file(&[&vertices, &rows])), format!("byte {at_faces}: {expected}"));
    }
    let mut bad = vertices.clone();
    bad[12..16].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(
        ply(file(&[&bad, &[0; 4]])),
        format!("byte {}: expected finite numbers, found NaN", start + 12)
    );
    // Rows without properties take no space, and no time either.
    let nothing =
        header.replace("element face", "element nothing 1152921504606846976\nelement face");
    let nothing = [nothing.as_bytes(), &vertices, &list(0)].concat();
    assert!(ply(nothing).ends_with("expected a face with at least 3 corners, found 0"));
}

#[test]
fn of_text_stl() {
    let facet = |inner: &str| stl(format!("solid x\nfacet normal 0 0 1\nouter loop\n{inner}"));
    for (text, expected) in [
        ("", "line 4: the file ends before `vertex`"),
        ("vertex 0 0\n", "line 4: expected three coordinates, found the end of the line"),
        ("vertex 0 0 x", "line 4, column 12: expected a finite number, found `x`"),
        ("vertex 0 1e999 0", "line 4, column 10: expected a finite number, found `1e999`"),
        (
            "vertex 0 0 0\nvertex 0 0 0\nendloop",
            "line 6, column 1: expected `vertex`, found `endloop`",
        ),
        (
            "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 2 2 2",
            "line 7, column 1: expected `endloop`, found `vertex`",
        ),
        (
            "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop endfacet\n",
            "line 8: the file ends before `endsolid`",
        ),
        (
            "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop endfacet\nfact",
            "line 8, column 1: expected `facet` or `endsolid`, found `fact`",
        ),
    ] {
        assert_eq!(facet(text), expected, "{text:?}");
    }
    assert_eq!(stl("solid x\nendsolid x\n"), "the file has no face");
    assert_eq!(
        stl("solid x\nendsolid x\nmore"),
        "line 3, column 1: expected `solid` or the end of the file, found `more`"
    );
    assert_eq!(stl("solidx"), "line 1, column 1: expected `solid`, found `solidx`");
}

#[test]
fn of_binary_stl() {
    let short = error("not an STL", MeshFormat::Stl, None);
    assert_eq!(short.to_string(), "byte 10: the file ends within its header of 84 bytes");
    assert_eq!(short.help.as_deref(), Some("a text STL file begins with the word `solid`"));
    let mut bytes = b"solid".to_vec();
    bytes.resize(80, 0);
    bytes.extend(u32::MAX.to_le_bytes());
    bytes.extend([0; 70]);
    assert_eq!(
        stl(&bytes),
        "byte 154: the file ends after 1 of the 4294967295 triangles it announces"
    );
    bytes[80..84].copy_from_slice(&1_u32.to_le_bytes());
    assert_eq!(stl(&bytes), "none of the 1 triangles has an area");
    bytes[84 + 12 + 12 + 4..][..4].copy_from_slice(&f32::NEG_INFINITY.to_le_bytes());
    assert_eq!(stl(&bytes), "byte 112: expected a finite number, found -inf");
    bytes[80..84].fill(0);
    assert_eq!(stl(&bytes), "the file has no face");
}
