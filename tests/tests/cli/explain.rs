//! The rays of a pixel: what they say they bring is what is rendered, and they go where the laws of
//! optics send them.

use super::*;
use lancer_integrator::{
    KernelSettings, LightFate, RayFate, RayKind, RayTree, RenderSettings, Sampling, TracedRay,
    Whitted, render,
};
use lancer_scene::Scene;
use lancer_tests::paths::{Beside, top};
use serde_json::Value;

/// One of the project's scenes, so many pixels large.
fn scene(name: &str, width: u32, height: u32) -> Scene {
    let bytes = bytes(&scenes().join(name));
    let options = lancer_xml::Options::default();
    let parsed = lancer_xml::parse_with(&bytes, &options, &Beside(&scenes()));
    let mut scene = parsed.scene.expect("it is valid");
    let side = |side| lancer_scene::PixelCount::new(side).expect("in range");
    (scene.camera.px_width, scene.camera.px_height) = (side(width), side(height));
    scene
}

fn tree(scene: &Scene, pixel: (u32, u32)) -> RayTree {
    Whitted::new().explain_pixel(scene, &KernelSettings::default(), pixel)
}

/// Trees of pixels all over one of the scenes.
fn trees(name: &str) -> Vec<RayTree> {
    trees_of(&scene(name, 40, 30))
}

fn trees_of(scene: &Scene) -> Vec<RayTree> {
    let pixels = (0..30).step_by(4).flat_map(|y| (0..40).step_by(7).map(move |x| (x, y)));
    pixels.map(|pixel| tree(scene, pixel)).collect()
}

const SCENES: [&str; 12] = [
    "readme.xml",
    "first.xml",
    "water_glass.xml",
    "cornell.xml",
    "facing_mirrors.xml",
    "soft_shadow.xml",
    "underwater.xml",
    "depth_of_field.xml",
    "emission.xml",
    "instances.xml",
    "sheets.xml",
    "spots.xml",
];

#[test]
fn what_rays_bring_is_what_is_rendered() {
    for name in SCENES {
        let scene = scene(name, 40, 30);
        let sampling = Sampling { samples: Some(1), error: None, ..Sampling::default() };
        let settings = RenderSettings { sampling: Some(sampling), ..RenderSettings::default() };
        let film = render(&scene, &Whitted::new(), &settings).expect("it renders").film;
        let mut rays = 0;
        for tree in trees(name) {
            let [x, y] = tree.pixel;
            assert_eq!(tree.radiance, film.pixel(x, y), "{name} {x},{y}");
            for (sum, radiance) in tree.sum().into_iter().zip(tree.radiance.map(f64::from)) {
                let off = (sum - radiance).abs();
                assert!(off <= 1e-6 * radiance, "{name} {x},{y}: {sum} is not {radiance}");
            }
            rays += tree.rays.len();
        }
        assert!(rays >= 48, "{name}");
    }
}

/// What belongs together, and the cutoff of those that were not followed.
#[test]
fn trees_are_trees() {
    for tree in SCENES.into_iter().flat_map(trees) {
        let mut cut_off = 0.0;
        for (place, ray) in tree.rays.iter().enumerate() {
            assert_eq!(ray.parent.is_none(), place == 0);
            assert_eq!(ray.kind == RayKind::Primary, place == 0);
            if let Some(parent) = ray.parent {
                let above = &tree.rays[parent];
                assert!(parent < place && above.children.contains(&place));
                assert_eq!(ray.depth, above.depth + 1);
                assert!(ray.size() <= above.size());
                // It starts where the other ends, but for what rounding needs.
                let end = above.end().expect("it met something");
                let off = |i: usize| (ray.origin[i] - end[i]).abs() / (1.0 + end[i].abs());
                assert!((0..3).all(|i| off(i) < 1e-6), "{end:?}");
            }
            match ray.fate {
                RayFate::Followed => {
                    assert_ne!(ray.distance.is_some(), ray.background.is_some());
                }
                RayFate::CutOff => {
                    assert!(ray.children.is_empty() && ray.contribution() == [0.0; 3]);
                    cut_off += ray.size();
                }
                other => panic!("{}", other.name()),
            }
        }
        assert!(cut_off <= 1.0001 * Whitted::CUTOFF, "{cut_off}");
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// The length of the part of a direction that is across a normal.
fn across(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let along = dot(direction, normal);
    [0, 1, 2].map(|i| direction[i] - along * normal[i])
}

fn near(a: [f64; 3], b: [f64; 3]) -> bool {
    (0..3).all(|i| (a[i] - b[i]).abs() < 1e-9)
}

/// Mirrored rays have what is across the normal as it was and what is along it turned round.
/// Refracted ones have n times what is across, on both sides (Snell), and go on to the other side.
#[test]
fn rays_obey_the_mirror_law_and_snells() {
    let (mut mirrored, mut bent) = (0, 0);
    for tree in SCENES.into_iter().flat_map(trees) {
        for ray in tree.rays.iter().filter(|ray| ray.surfaces.len() == 1) {
            let normal = ray.surfaces[0].normal;
            assert!((dot(normal, normal) - 1.0).abs() < 1e-12);
            assert!(dot(ray.direction, normal) <= 0.0, "the normal is on the ray's side");
            let before = across(ray.direction, normal);
            for child in ray.children.iter().map(|child| &tree.rays[*child]) {
                let after = across(child.direction, normal);
                let along = dot(child.direction, normal);
                match child.kind {
                    RayKind::Reflected => {
                        assert!(near(after, before));
                        assert!((along + dot(ray.direction, normal)).abs() < 1e-9);
                        mirrored += 1;
                    }
                    _ => {
                        let (n1, n2) = (ray.medium.ior, child.medium.ior);
                        assert!(near(before.map(|c| n1 * c), after.map(|c| n2 * c)));
                        assert!(along < 0.0);
                        bent += u32::from(n1 != n2);
                    }
                }
            }
        }
    }
    assert!(mirrored > 500 && bent > 300, "{mirrored} {bent}");
}

/// What hides a light is between it and the surface; what does not arrive adds nothing.
#[test]
fn lights_arrive_or_it_is_said_why_not() {
    let mut scene = scene("first.xml", 40, 30);
    // Of it the shadows are more than pixels here and there.
    scene.camera = lancer_scene::Camera::new([5.0, 8.0, 12.0], [5.0, 8.0, 0.0], 10.0, [40, 30])
        .expect("it is valid");
    let (mut hidden, mut arrived, mut behind) = (0, 0, 0);
    for ray in trees_of(&scene).iter().flat_map(|tree| &tree.rays) {
        for met in &ray.surfaces {
            assert!(met.lights.is_empty() || met.lights.len() == scene.lights.len());
            for (light, number) in met.lights.iter().zip(1..) {
                assert_eq!(light.light, number);
                match &light.fate {
                    LightFate::Hidden(shape) => {
                        let is_other = *shape != met.shape;
                        assert!(is_other && light.shadow.is_some_and(|s| s.length.is_some()));
                        hidden += 1;
                    }
                    LightFate::Arrives(left) => {
                        assert!(left.iter().all(|left| *left > 0.0 && *left <= 1.0));
                        let lamp = light.shadow.expect("it was looked for").length.is_some();
                        assert_eq!(lamp, number == 1, "the second one is a sun");
                        arrived += 1;
                    }
                    LightFate::Behind => behind += 1,
                    other => panic!("{other:?}"),
                }
                let adds = matches!(light.fate, LightFate::Arrives(_));
                assert_eq!(light.contribution != [0.0; 3], adds);
            }
        }
    }
    assert!(hidden > 5 && arrived > 50 && behind > 0, "{hidden} {arrived} {behind}");
}

/// Between perfect mirrors, trees are as deep as rays are followed; none of it is recursive.
#[test]
fn the_deepest_tree_is_told_whole() {
    let folder = Folder::new();
    let mirror = r#"<plane color="black" gloss="1"><origin x="0" y="0" z="AT"/><normal x="0" y="0" z="1"/></plane>"#;
    let shapes = ["-1", "1"].map(|at| mirror.replace("AT", at)).join("");
    let start = SCENE.find("<shapes>").expect("it has shapes");
    let camera = r#"<origin x="0" y="0" z="0"/><target x="0" y="0" z="1"/>"#;
    let text = format!("{}<shapes>{shapes}</shapes></world>", &SCENE[..start])
        .replace(r#"<origin x="1" y="0" z="3"/><target x="4" y="5" z="2"/>"#, camera);
    fs::write(folder.path("deep.xml"), text).expect("written");
    let run = folder.run(&["explain", "deep.xml", "--pixel", "20,15", "--all"]);
    assert_eq!((run.code(), run.err()), (Some(0), String::new()));
    assert_eq!(run.out().lines().count(), 10_003);
    assert!(run.out().contains("given up, although it matters"));
    let run = folder.run(&["explain", "deep.xml", "--pixel", "20,15"]);
    assert_eq!(run.out().lines().count(), 202);
    assert!(run.out().ends_with(
        "and 9802 more rays with smaller shares, which together add (0, 0, 0): --all shows them\n"
    ));
    let run = folder.run(&["explain", "deep.xml", "--pixel", "20,15", "--json"]);
    let tree: Value = serde_json::from_str(&run.out()).expect("it is JSON");
    assert_eq!(tree["rays"].as_array().map(Vec::len), Some(10_002));
}

#[track_caller]
fn told(folder: &Folder, arguments: &[&str]) -> String {
    let run = folder.run(arguments);
    assert_eq!((run.code(), run.err()), (Some(0), String::new()));
    run.out()
}

#[test]
fn a_student_can_read_it() {
    let folder = Folder::new();
    for name in ["first", "water_glass"] {
        let file = format!("{name}.xml");
        fs::copy(scenes().join(&file), folder.path(&file)).expect("copied");
        // Through the glass ball, and through glass and water.
        let pixel = if name == "first" { "188,193" } else { "200,200" };
        let arguments =
            ["explain", &file, "--pixel", pixel, "--size", "400x300", "--cutoff", "0.01"];
        let text = told(&folder, &[&arguments[..], &["--exposure", "0"]].concat());
        if name == "first" {
            let manual = fs::read_to_string(top().join("docs/manual.md")).expect("it is there");
            let (_, rays) = text.split_once('\n').expect("it has lines");
            assert!(manual.contains(rays), "the manual shows it");
        }
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path(top().join("tests/snapshots/rays"));
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.bind(|| insta::assert_snapshot!(name, text));
    }
}

#[test]
fn json_has_all_that_the_engine_tells() {
    let folder = Folder::new();
    let arguments = ["explain", "scene.xml", "--pixel", "30,12", "--json"];
    let text = told(&folder, &[&arguments[..], &["--exposure", "auto"]].concat());
    let json: Value = serde_json::from_str(&text).expect("it is JSON");
    let bytes = bytes(&folder.path("scene.xml"));
    let scene =
        lancer_xml::parse(&bytes, &lancer_xml::Options::default()).scene.expect("it is valid");
    let expected = tree(&scene, (30, 12));
    assert_eq!(json["pixel"], serde_json::json!([30, 12]));
    assert_eq!(json["scene"], "scene.xml");
    assert_eq!((json["width"].as_u64(), json["height"].as_u64()), (Some(40), Some(30)));
    assert_eq!(json["cutoff"].as_f64(), Some(Whitted::CUTOFF));
    let triple = |value: &Value| [0, 1, 2].map(|i| value[i].as_f64().expect("a number"));
    // Readers of JSON may be off by the last bit.
    #[track_caller]
    fn same(found: [f64; 3], expected: [f64; 3], field: &str) {
        let is_near = |i: usize| (found[i] - expected[i]).abs() <= 1e-15 * expected[i].abs();
        assert!((0..3).all(is_near), "{field}: {found:?} is not {expected:?}");
    }
    same(triple(&json["sum"]), expected.sum(), "sum");
    let rays = json["rays"].as_array().expect("a list");
    assert_eq!(rays.len(), expected.rays.len());
    for (found, ray) in rays.iter().zip(&expected.rays) {
        let TracedRay { kind, fate, depth, origin, direction, share, left, .. } = ray;
        assert_eq!((&found["kind"], &found["fate"]), (&kind.name().into(), &fate.name().into()));
        assert_eq!(found["depth"].as_u64(), Some(u64::from(*depth)));
        for (field, value) in
            [("origin", origin), ("direction", direction), ("share", share), ("left", left)]
        {
            same(triple(&found[field]), *value, field);
        }
        same(triple(&found["contribution"]), ray.contribution(), "contribution");
        let distance = |d: Option<f64>| [d.unwrap_or_default(); 3];
        same(distance(found["distance"].as_f64()), distance(ray.distance), "distance");
        assert_eq!(found["medium"]["ior"].as_f64(), Some(1.0));
        let surfaces = found["surfaces"].as_array().expect("a list");
        assert_eq!(surfaces.len(), ray.surfaces.len());
        for (found, met) in surfaces.iter().zip(&ray.surfaces) {
            assert_eq!(found["shape"]["number"].as_u64(), Some(u64::from(met.shape.number)));
            assert_eq!(found["shape"]["kind"], met.shape.kind);
            assert_eq!(found["cell"].is_null(), met.cell.is_none());
            for (field, value) in [
                ("point", met.point),
                ("normal", met.normal),
                ("albedo", met.albedo),
                ("glow", met.glow),
            ] {
                same(triple(&found[field]), value, field);
            }
            assert_eq!(found["lights"].as_array().map(Vec::len), Some(met.lights.len()));
            assert_eq!(found["lights"][0]["fate"], met.lights[0].fate.name());
        }
    }
    // It is shown as in the picture.
    folder.run(&["render", "scene.xml", "-o", "a.png", "--samples", "1", "-q"]).silent();
    let picture = image::open(folder.path("a.png")).expect("a picture").to_rgb8();
    assert_eq!(json["shown"], serde_json::json!(picture.get_pixel(30, 12).0));
}

#[test]
fn lines_can_be_read_by_others() {
    let folder = Folder::new();
    fs::copy(scenes().join("first.xml"), folder.path("first.xml")).expect("copied");
    let arguments = ["explain", "first.xml", "--pixel", "188,193", "--obj", "a.obj"];
    told(&folder, &[&arguments[..], &["--svg", "a.svg"]].concat());
    let text = String::from_utf8(bytes(&folder.path("a.obj"))).expect("text");
    let (mut places, mut lines, mut objects) = (Vec::new(), Vec::new(), Vec::new());
    for line in text.lines() {
        let words: Vec<&str> = line.split(' ').collect();
        match words[..] {
            ["v", x, y, z] => {
                places.push([x, y, z].map(|c| c.parse::<f64>().expect("a number")));
            }
            ["l", from, to] => {
                let ends = [from, to].map(|i| i.parse::<usize>().expect("a number"));
                assert!(ends.iter().all(|end| (1..=places.len()).contains(end)), "{line}");
                lines.push(ends);
            }
            ["o", name] => objects.push(name),
            ["#", ..] => {}
            _ => panic!("{line}"),
        }
    }
    assert_eq!(objects, ["primary", "reflected", "transmitted", "shadow"]);
    assert_eq!(2 * lines.len(), places.len());
    let first = tree(&scene("first.xml", 400, 300), (188, 193));
    let [from, to] = lines[0].map(|end| places[end - 1]);
    assert_eq!((from, Some(to)), ([1.0, 0.0, 3.0], first.rays[0].end()), "from the eye");
    // Each ray once, and each ray to a light.
    let followed = first.rays.iter().filter(|ray| ray.fate == RayFate::Followed);
    let shadows = followed.clone().flat_map(|ray| &ray.surfaces).flat_map(|met| &met.lights);
    let shadows = shadows.filter(|light| light.shadow.is_some());
    assert_eq!(lines.len(), followed.count() + shadows.count());

    let drawing = String::from_utf8(bytes(&folder.path("a.svg"))).expect("text");
    assert!(drawing.starts_with("<svg ") && drawing.ends_with("</svg>\n"));
    for words in ["pixel 188,193 of first.xml", ">eye<", ">lamp 1<", ">sphere 2<", "seen along"] {
        assert!(drawing.contains(words), "{words}");
    }
    assert!(!drawing.contains("NaN") && !drawing.contains("inf"));
}

#[test]
fn what_is_no_finite_number_is_said_to_be_black() {
    let folder = Folder::new();
    fs::write(folder.path("bright.xml"), SCENE.replace("brightness=\"4\"", "brightness=\"1e300\""))
        .expect("written");
    let text = told(&folder, &["explain", "bright.xml", "--pixel", "20,29", "--quiet"]);
    let words = "radiance (0, 0, 0), since what is seen there is no finite number\n";
    assert!(text.contains(words), "{text}");
}

#[test]
fn a_scene_may_come_from_standard_input() {
    let folder = Folder::new();
    let run = folder.run_with(&["explain", "-", "--pixel", "0,0"], SCENE.as_bytes());
    assert_eq!((run.code(), run.err()), (Some(0), String::new()));
    assert!(run.out().starts_with("pixel 0,0 of <stdin> (40x30 pixels): radiance ("));
    assert_eq!(folder.files(), ["scene.xml"]);
}

#[test]
fn what_cannot_be_explained_leaves_nothing() {
    let folder = Folder::new();
    fs::write(folder.path("bad.xml"), "<world/>").expect("written");
    let pixel = ["--pixel", "1,2"];
    for (arguments, code, with) in [
        (&["scene.xml", "--pixel", "1"][..], 2, "a column and a row"),
        (&["scene.xml", "--pixel", "-1,2"], 2, "a column and a row"),
        (&["scene.xml", "--pixel", "40,0"], 2, "40x30 pixels: columns 0 to 39, rows 0 to 29"),
        (&["scene.xml", "--pixel", "0,30"], 2, "is not in the picture"),
        (&["scene.xml", "--pixel", "9,9", "--size", "9x9"], 2, "which has 9x9 pixels"),
        (&["scene.xml", "--size", "9x9", "--max-pixels", "80", "--pixel", "1,1"], 2, "81 pixels"),
        (&["scene.xml", "--cutoff", "2", "--pixel", "1,1"], 2, "from 0 to 1"),
        (&["scene.xml", "--json", "--all", "--pixel", "1,1"], 2, "cannot be used with"),
        (&["none.xml", "--pixel", "1,2"], 1, "cannot read none.xml"),
        (&["bad.xml", "--pixel", "1,2", "--obj", "a.obj"], 1, "bad.xml"),
    ] {
        folder.run(&[&["explain"], arguments].concat()).fails(code, with);
    }
    for (arguments, code, with) in [
        (["--obj", "a", "--svg", "a"], 2, "two different files"),
        (["--obj", "-", "--svg", "a"], 2, "write --obj and --svg to files"),
        (["--obj", "a", "--svg", "scene.xml"], 2, "overwrite the scene"),
        (["--obj", "no/a.obj", "--svg", "a"], 1, "there is no folder no"),
    ] {
        let arguments = [&["explain", "scene.xml"], &pixel[..], &arguments].concat();
        folder.run(&arguments).fails(code, with);
    }
    assert_eq!(folder.files(), ["bad.xml", "scene.xml"]);
}
