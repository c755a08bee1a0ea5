//! Scenes in other languages.

use super::*;

#[test]
fn a_scene_is_written_by_its_extension_or_format() {
    let folder = Folder::new();
    let run = folder.run(&["export", "scene.xml", "-o", "a.pov"]);
    assert_eq!((run.code(), run.out()), (Some(0), String::new()));
    // It has automatic exposure.
    assert!(run.err().starts_with("note: scene.xml: camera: its exposure"), "{}", run.err());
    assert_eq!(run.err().lines().count(), 1);
    let text = String::from_utf8(bytes(&folder.path("a.pov"))).expect("text");
    assert!(text.contains("#version 3.7;") && text.contains("sphere { <6, 11, 1>, 1"), "{text}");
    assert!(text.contains("// - camera: its exposure"), "{text}");
    folder.run(&["export", "scene.xml", "-o", "b.pov", "--exposure", "1"]).silent();
    let text = String::from_utf8(bytes(&folder.path("b.pov"))).expect("text");
    assert!(text.contains("Nothing is left out"), "{text}");
    folder.run(&["export", "scene.xml", "-o", "c", "--format", "mitsuba", "--quiet"]).silent();
    let text = String::from_utf8(bytes(&folder.path("c"))).expect("text");
    assert!(text.contains("<scene version=\"3.0.0\">"), "{text}");
    assert_eq!(folder.files(), ["a.pov", "b.pov", "c", "scene.xml"]);
}

#[test]
fn standard_input_and_output_carry_scenes() {
    let folder = Folder::new();
    let run =
        folder.run_with(&["export", "-", "-o", "-", "--format", "pov", "-q"], SCENE.as_bytes());
    assert_eq!((run.code(), run.err()), (Some(0), String::new()));
    folder.run(&["export", "scene.xml", "-o", "a.pov", "-q"]).silent();
    assert_eq!(run.out().as_bytes(), bytes(&folder.path("a.pov")));
}

#[test]
fn shapes_that_need_files_have_them_beside() {
    let folder = Folder::new();
    let cone = r#"<cone color="red" size="1"><base x="0" y="9" z="0"/><top x="0" y="9" z="2"/></cone></shapes>"#;
    let scene = SCENE.replace("</shapes>", cone);
    fs::write(folder.path("cone.xml"), &scene).expect("written");
    let run = folder.run(&["export", "cone.xml", "-o", "m.xml"]);
    assert_eq!(run.code(), Some(0));
    assert!(run.err().contains("shape 3, a cone: what is round is a mesh"), "{}", run.err());
    assert_eq!(folder.files(), ["cone.xml", "m-1.ply", "m.xml", "scene.xml"]);
    assert!(bytes(&folder.path("m-1.ply")).starts_with(b"ply\nformat binary"));
    let standard = ["export", "cone.xml", "-o", "-", "--format", "mitsuba"];
    folder.run(&standard).fails(2, "needs 1 other file beside it");
}

#[test]
fn what_cannot_be_exported_leaves_nothing() {
    let folder = Folder::new();
    fs::write(folder.path("bad.xml"), "<world/>").expect("written");
    for (arguments, code, with) in [
        (&["export", "scene.xml"][..], 2, "--output"),
        (&["export", "scene.xml", "-o", "a.obj"], 2, "give --format pov or mitsuba"),
        (&["export", "scene.xml", "-o", "-"], 2, "give --format"),
        (&["export", "scene.xml", "-o", "a", "--format", "obj"], 2, "pov, mitsuba"),
        (&["export", "scene.xml", "-o", "scene.xml"], 2, "overwrite the scene"),
        (&["export", "scene.xml", "-o", "no/a.pov"], 1, "there is no folder no"),
        (&["export", "none.xml", "-o", "a.pov"], 1, "cannot read none.xml"),
        (&["export", "bad.xml", "-o", "a.pov"], 1, "bad.xml"),
        (&["export", "scene.xml", "-o", "a.pov", "--exposure", "x"], 2, "number of stops"),
    ] {
        folder.run(arguments).fails(code, with);
    }
    assert_eq!(folder.files(), ["bad.xml", "scene.xml"]);
    // What was there stays, where the new one cannot be.
    fs::write(folder.path("a.pov"), "old").expect("written");
    folder.run(&["export", "bad.xml", "-o", "a.pov"]).fails(1, "bad.xml");
    assert_eq!(bytes(&folder.path("a.pov")), b"old");
}
