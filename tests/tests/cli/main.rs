//! The program itself, run as a user runs it.

mod chart;
mod explain;
mod export;
mod lints;
mod sampling;
#[cfg(unix)]
mod unix;

use lancer_integrator::Width;
use lancer_tests::paths::scenes;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

const SCENE: &str = r#"<world>
  <camera pxwidth="40" pxheight="30" width="3.3"><origin x="1" y="0" z="3"/><target x="4" y="5" z="2"/></camera>
  <lights><lamp brightness="4"><point x="5" y="5" z="4"/></lamp></lights>
  <shapes>
    <sphere color="grey" gloss="0.5" size="1"><point x="6" y="11" z="1"/></sphere>
    <plane color="blue" gloss="0.1" chess="white"><origin x="0" y="0" z="0"/><normal x="0" y="0" z="1"/></plane>
  </shapes>
</world>"#;

/// A folder of its own, with a scene in it.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        let folder = Self(tempfile::tempdir().expect("a temporary folder"));
        fs::write(folder.path("scene.xml"), SCENE).expect("it can be written");
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// The names of all files in it, also hidden ones.
    fn files(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).expect("it can be read");
        let name = |e: fs::DirEntry| e.file_name().to_string_lossy().into_owned();
        let mut names: Vec<_> = entries.filter_map(Result::ok).map(name).collect();
        names.sort();
        names
    }

    /// Writes a file; its path.
    fn write(&self, name: &str, text: &str) -> String {
        fs::write(self.path(name), text).expect("it can be written");
        self.path(name).to_str().expect("plain letters").to_owned()
    }

    /// What `--stats s.json` wrote.
    fn stats(&self) -> serde_json::Value {
        serde_json::from_slice(&bytes(&self.path("s.json"))).expect("it is JSON")
    }

    fn run(&self, arguments: &[&str]) -> Run {
        self.run_with(arguments, b"")
    }

    fn run_with(&self, arguments: &[&str], input: &[u8]) -> Run {
        self.run_in(&[], arguments, input)
    }

    /// With these variables in its environment.
    fn run_in(&self, environment: &[(&str, &str)], arguments: &[&str], input: &[u8]) -> Run {
        let mut child = Command::new(env!("CARGO_BIN_EXE_lancer-under-test"))
            .args(arguments)
            .current_dir(self.0.path())
            .env_remove("LANCER_LANES")
            .envs(environment.iter().copied())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("it starts");
        // It may end before it has read everything.
        let _ = child.stdin.take().expect("it is piped").write_all(input);
        Run(child.wait_with_output().expect("it ends"))
    }
}

struct Run(Output);

impl Run {
    fn code(&self) -> Option<i32> {
        self.0.status.code()
    }

    fn out(&self) -> String {
        String::from_utf8_lossy(&self.0.stdout).into_owned()
    }

    fn err(&self) -> String {
        String::from_utf8_lossy(&self.0.stderr).into_owned()
    }

    /// It did what was asked and said nothing.
    #[track_caller]
    fn silent(self) -> Self {
        assert_eq!((self.code(), self.err(), self.out()), (Some(0), String::new(), String::new()));
        self
    }

    /// It rendered what was asked, and said nothing but its last line.
    #[track_caller]
    fn told(self) -> Self {
        assert_eq!((self.code(), self.out()), (Some(0), String::new()), "{}", self.err());
        self.last_line();
        self
    }

    /// The only line on standard error, about a picture that was rendered, but for the forecast
    /// that a slow machine may have seen reason for.
    #[track_caller]
    fn last_line(&self) -> String {
        let mut err = self.err();
        if err.starts_with("this will take about ") {
            err.drain(..=err.find('\n').expect("lines end"));
        }
        assert_eq!(err.lines().count(), 1, "{err}");
        assert!(err.contains(" pixels by ") && err.ends_with(" million rays a second\n"), "{err}");
        err
    }

    /// It did not, said so, and printed nothing else.
    #[track_caller]
    fn fails(self, code: i32, with: &str) -> Self {
        assert_eq!(self.code(), Some(code), "{}", self.err());
        assert!(self.err().contains(with), "{:?} not in: {}", with, self.err());
        assert_eq!(self.out(), "");
        self
    }
}

fn bytes(path: &Path) -> Vec<u8> {
    fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

#[test]
fn a_picture_in_every_format_takes_one_line_to_tell() {
    let folder = Folder::new();
    for (name, magic) in [
        ("a.ppm", b"P6\n40 30\n255\n".as_slice()),
        ("a.png", b"\x89PNG"),
        ("a.exr", b"\x76\x2f\x31\x01"),
        ("a.bmp", b"BM"),
        ("a.jpg", b"\xff\xd8\xff"),
        ("a.qoi", b"qoif"),
        ("a.tif", b"II*\0"),
        ("a.webp", b"RIFF"),
        ("a.tga", b""),
    ] {
        folder.run(&["render", "scene.xml", "-o", name]).told();
        assert!(bytes(&folder.path(name)).starts_with(magic), "{name}");
    }
    folder.run(&["render", "scene.xml", "-o", "b", "--format", "JPG"]).told();
    assert!(bytes(&folder.path("b")).starts_with(b"\xff\xd8\xff"));
    folder.run(&["render", "scene.xml", "-o", "b", "--format", "png", "--bits", "16"]).told();
    assert_eq!(bytes(&folder.path("b"))[24], 16, "the bit depth in the PNG header");
}

#[test]
fn standard_input_and_output_carry_the_same_picture() {
    let folder = Folder::new();
    folder.run(&["render", "scene.xml", "-o", "a.ppm"]).told();
    let run = folder.run_with(&["render", "-", "-o", "-"], SCENE.as_bytes());
    assert_eq!(run.code(), Some(0));
    run.last_line();
    assert!(run.0.stdout == bytes(&folder.path("a.ppm")));
    let run = folder.run_with(&["render", "-", "-o", "-", "--format", "png"], SCENE.as_bytes());
    folder.run(&["render", "scene.xml", "-o", "a.png"]).told();
    assert!(run.0.stdout == bytes(&folder.path("a.png")));
}

#[test]
fn threads_and_crops_agree_with_the_whole() {
    let folder = Folder::new();
    folder.run(&["render", "scene.xml", "-o", "a.ppm", "--threads", "1"]).told();
    folder.run(&["render", "scene.xml", "-o", "b.ppm", "--threads", "7"]).told();
    assert!(bytes(&folder.path("a.ppm")) == bytes(&folder.path("b.ppm")));

    for samples in ["1", "5"] {
        let whole = ["render", "scene.xml", "-o", "a.ppm", "--samples", samples];
        folder.run(&whole).told();
        let crop = ["-o", "c.ppm", "--crop", "10,20,5,4", "--samples", samples];
        folder.run(&[&["render", "scene.xml"][..], &crop].concat()).told();
        let (whole, crop) = (bytes(&folder.path("a.ppm")), bytes(&folder.path("c.ppm")));
        let crop = crop.strip_prefix(b"P6\n5 4\n255\n").expect("its header");
        let whole = whole.strip_prefix(b"P6\n40 30\n255\n").expect("its header");
        for (row, y) in crop.chunks(15).zip(20..) {
            assert_eq!(row, &whole[(y * 40 + 10) * 3..][..15]);
        }
    }
}

#[test]
fn any_lanes_and_threads_make_the_same_file() {
    let folder = Folder::new();
    let lanes = Width::available();
    for engine in ["whitted", "classic", "direct"] {
        let mut files = Vec::new();
        for (lanes, threads) in lanes.iter().zip(["1", "2", "3", "7"].iter().cycle()) {
            let environment = [("LANCER_LANES", lanes.name())];
            let arguments = ["render", "scene.xml", "-o", "a.ppm", "--stats", "s.json"];
            // Enough components for several threads to make codes of.
            let size = ["--size", "230x110", "--threads", threads, "--engine", engine];
            folder.run_in(&environment, &[&arguments[..], &size].concat(), b"").told();
            let stats = folder.stats();
            assert_eq!(stats["lanes"], lanes.name());
            assert_eq!(stats["threads"].to_string(), **threads);
            files.push(bytes(&folder.path("a.ppm")));
        }
        assert!(files.iter().all(|file| *file == files[0]), "{engine}");
    }
    folder.run(&["render", "scene.xml", "-o", "a.ppm", "--stats", "s.json"]).told();
    assert_eq!(folder.stats()["lanes"], Width::best().name(), "the widest by default");
}

#[test]
fn lanes_that_are_not_there_are_wrong_usage() {
    let folder = Folder::new();
    for wrong in ["avx1024", "", "SCALAR"] {
        let environment = [("LANCER_LANES", wrong)];
        // Known before anything is read: there is no such scene.
        let run = folder.run_in(&environment, &["render", "gone.xml", "-o", "a.png"], b"");
        let run = run.fails(2, &format!("LANCER_LANES: there are no lanes `{wrong}`"));
        for width in Width::available() {
            assert!(run.err().contains(width.name()), "{}", run.err());
        }
    }
    assert_eq!(folder.files(), ["scene.xml"]);
    let help = folder.run(&["render", "--help"]).out();
    assert!(help.contains("Environment:") && help.contains("LANCER_LANES"), "{help}");
}

#[test]
fn sizes_are_as_asked_for() {
    let folder = Folder::new();
    folder.run(&["render", "scene.xml", "-o", "a.ppm", "--size", "13x7"]).told();
    assert!(bytes(&folder.path("a.ppm")).starts_with(b"P6\n13 7\n"));
    // The file's own size does not matter then, only the one asked for.
    fs::write(folder.path("huge.xml"), SCENE.replace("\"40\"", "\"400000000\"")).expect("written");
    folder
        .run(&["render", "huge.xml", "-o", "a.ppm"])
        .fails(1, "the picture has 12000000000 pixels");
    folder.run(&["render", "huge.xml", "-o", "a.ppm", "--size", "13x7"]).told();
    folder
        .run(&["render", "scene.xml", "-o", "a.ppm", "--size", "20x20", "--max-pixels", "399"])
        .fails(2, "--max-pixels");
    folder.run(&["render", "scene.xml", "-o", "a.ppm", "--max-pixels", "1200"]).told();
    folder
        .run(&["render", "scene.xml", "-o", "a.ppm", "--max-pixels", "1199"])
        .fails(1, "1200 pixels");
}

#[test]
fn statistics_add_up() {
    let folder = Folder::new();
    folder
        .run(&["render", "scene.xml", "-o", "a.png", "--stats", "s.json", "--threads", "2"])
        .told();
    let stats = folder.stats();
    assert_eq!(stats["engine"], "whitted");
    assert!(stats["exposure"].as_f64().is_some_and(|stops| (stops * 64.0).fract() == 0.0));
    assert_eq!((&stats["cutoff"], &stats["troubles"]["media"]["count"]), (&1e-4.into(), &0.into()));
    assert_eq!((&stats["width"], &stats["height"]), (&40.into(), &30.into()));
    assert_eq!(stats["threads"], 2);
    assert_eq!(stats["version"], env!("CARGO_PKG_VERSION"));
    let rays = |kind: &str| stats["rays"][kind].as_u64().expect("a count");
    // One sample in each pixel finds the exposure.
    let samples = stats["sampling"]["samples"].as_u64().expect("a count");
    assert_eq!(rays("primary"), samples + 1200);
    assert!(rays("reflected") > 0 && rays("shadow") > 0);
    let parts = ["primary", "reflected", "transmitted", "shadow"].map(rays);
    assert_eq!(rays("total"), parts.iter().sum::<u64>());
    let seconds = |stage: &str| stats["seconds"][stage].as_f64().expect("a time");
    let stages = ["read", "parse", "render", "encode", "write"].map(seconds);
    assert!(stages.iter().all(|s| *s >= 0.0) && stages.iter().sum::<f64>() <= seconds("total"));
}

#[test]
fn wrong_usage_is_code_2_and_writes_nothing() {
    let folder = Folder::new();
    for (arguments, with) in [
        (&["render", "scene.xml"][..], "--output"),
        (&["render", "scene.xml", "-o", "a.gif"], "cannot tell the format"),
        (&["render", "scene.xml", "-o", "a"], "give --format"),
        (&["render", "scene.xml", "-o", "a.png", "--engine", "clasic"], "classic"),
        (&["render", "scene.xml", "-o", "a.png", "--size", "40"], "400x300"),
        (&["render", "scene.xml", "-o", "a.png", "--crop", "30,0,11,5"], "40x30"),
        (&["render", "scene.xml", "-o", "a.png", "--threads", "0"], "from 1 to"),
        (&["render", "scene.xml", "-o", "a.png", "--threads", "-1"], "from 1 to"),
        (&["render", "scene.xml", "-o", "a.png", "--size", "-1x5"], "400x300"),
        (&["render", "scene.xml", "-o", "a.png", "--crop", "-1,0,4,4"], "100,50,64,48"),
        (&["render", "scene.xml", "-o", "a.jpg", "--bits", "16"], "ppm, png and tiff"),
        (&["render", "scene.xml", "-o", "a.png", "--stats", "./a.png"], "two different files"),
        (&["render", "scene.xml", "-o", "-", "--stats", "-"], "two different files"),
        (&["render", "scene.xml", "-o", "scene.xml", "--format", "png"], "overwrite the scene"),
        (&["render", "scene.xml", "-o", "a.png", "--stats", "scene.xml"], "overwrite the scene"),
        (&["render", "scene.xml", "--preview"], "needs a terminal"),
        (&["render", "scene.xml", "-o", "a.png", "--exposure", "bright"], "number of stops"),
        (&["render", "scene.xml", "-o", "a.png", "--cutoff", "-1"], "from 0 to 1"),
        (&["render", "scene.xml", "-o", "a.png", "--error", "0"], "above 0, up to 1"),
        (&["render", "scene.xml", "-o", "a.png", "--error", "-0.1"], "above 0, up to 1"),
        (&["render", "scene.xml", "-o", "a.png", "--time", "0ms"], "500ms"),
        (&["render", "scene.xml", "-o", "a.png", "--time", "-1"], "500ms"),
        (&["render", "scene.xml", "-o", "a.png", "--samples", "0"], "from 1 to 1048576"),
        (&["render", "scene.xml", "-o", "a.png", "--seed", "x"], "whole number from 0"),
        (&["render", "scene.xml", "-o", "a.png", "--strategy", "edge"], "'edges'"),
        (&["render", "scene.xml", "-o", "a.png", "--stop-at", "3"], "such as 3:120"),
        (
            &["render", "scene.xml", "-o", "a.png", "--stop-at", "3:1@0.1", "--error", "0.2"],
            "leave --error out",
        ),
        (&["render", "scene.xml", "-o", "a.png", "--layers", "depth"], "write an EXR"),
        (&["render", "scene.xml", "-o", "a.exr", "--layers", "colour"], "is none of depth"),
        (
            &["render", "scene.xml", "-o", "a.png", "--engine", "classic", "--exposure", "1"],
            "means nothing",
        ),
        (
            &["render", "scene.xml", "-o", "a.png", "--engine", "direct", "--cutoff", "0"],
            "means nothing",
        ),
        (
            &["render", "scene.xml", "-o", "a.exr", "--engine", "classic", "--layers", "all"],
            "means nothing",
        ),
        (
            &["render", "scene.xml", "-o", "a.png", "--engine", "classic", "--samples", "1"],
            "--samples means nothing to the engine classic, only to whitted",
        ),
        (
            &["render", "scene.xml", "-o", "a.png", "--engine", "direct", "--time", "1"],
            "--time means nothing",
        ),
        (&["compare", "a.png"], "Usage"),
        (&["compare", "a.png", "b.png", "--max-diff", "-1"], "max-diff"),
        (&["check"], "Usage"),
        (&["rendre", "scene.xml"], "render"),
    ] {
        folder.run(arguments).fails(2, with);
    }
    assert_eq!(folder.files(), ["scene.xml"]);
    assert_eq!(bytes(&folder.path("scene.xml")), SCENE.as_bytes());
}

#[test]
fn help_and_version_are_on_standard_output() {
    let folder = Folder::new();
    for arguments in [&["--help"][..], &["render", "--help"], &["help", "compare"]] {
        let run = folder.run(arguments);
        assert_eq!((run.code(), run.err()), (Some(0), String::new()));
        assert!(run.out().contains("Exit codes:"), "{}", run.out());
    }
    assert_eq!(folder.run(&["--version"]).out(), format!("lancer {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn failures_leave_the_old_picture_and_no_rubbish() {
    let folder = Folder::new();
    fs::write(folder.path("a.png"), "the old picture").expect("written");
    fs::write(folder.path("bad.xml"), SCENE.replace("gloss", "glos")).expect("written");
    folder.run(&["render", "bad.xml", "-o", "a.png"]).fails(1, "did you mean `gloss`?");
    folder.run(&["render", "gone.xml", "-o", "a.png"]).fails(1, "cannot read gone.xml");
    folder.run(&["render", "scene.xml", "-o", "no/a.png"]).fails(1, "there is no folder no");
    folder.run(&["render", "scene.xml", "-o", ".", "--format", "png"]).fails(1, "it is a folder");
    folder
        .run(&["render", "scene.xml", "-o", "w.webp", "--size", "16385x1"])
        .fails(1, "at most 16384 pixels along a side");
    assert_eq!(bytes(&folder.path("a.png")), b"the old picture");
    assert_eq!(folder.files(), ["a.png", "bad.xml", "scene.xml"]);
}

#[test]
fn check_reports_all_files_and_all_mistakes() {
    let folder = Folder::new();
    let bad =
        SCENE.replace("gloss=\"0.5\"", "gloss=\"5\"").replace("color=\"blue\"", "color=\"bleu\"");
    fs::write(folder.path("bad.xml"), bad).expect("written");
    let run = folder.run(&["check", "gone.xml", "bad.xml", "scene.xml"]);
    assert_eq!(run.code(), Some(1));
    assert!(run.err().contains("cannot read gone.xml"), "{}", run.err());
    assert!(
        run.err().contains("bad.xml:5:33") && run.err().contains("bad.xml:6:19"),
        "{}",
        run.err()
    );
    assert!(run.err().contains("bad.xml: 2 errors"), "{}", run.err());
    assert_eq!(run.out(), "scene.xml: valid, 40x30 pixels, 1 light, 2 shapes\n");
    folder.run(&["check", "--quiet", "scene.xml"]).silent();
    let run = folder.run_with(&["check", "-"], b"<world>");
    run.fails(1, "<stdin>:1:");
}

#[test]
fn warnings_do_not_stop_a_render_and_quiet_hides_them() {
    let folder = Folder::new();
    let down = SCENE.replace("x=\"4\" y=\"5\" z=\"2\"", "x=\"1\" y=\"0\" z=\"0\"");
    fs::write(folder.path("down.xml"), down).expect("written");
    let down = ["render", "down.xml", "-o", "a.png", "--engine", "classic"];
    let run = folder.run(&down);
    assert_eq!(run.code(), Some(0));
    assert!(run.err().contains("the camera looks straight"), "{}", run.err());
    assert!(run.err().contains("down.xml:2:") && run.err().contains("help: move the target"));
    folder.run(&[&down[..], &["--quiet"]].concat()).silent();
    folder.run(&["render", "down.xml", "-o", "a.png"]).told();
    let empty = scenes().join("invalid/empty_shapes.xml");
    let empty = empty.to_str().expect("it is UTF-8");
    assert!(folder.run(&["render", empty, "-o", "a.png"]).err().contains("<shapes> is empty"));
    folder.run(&["render", empty, "-o", "a.png", "--quiet"]).silent();
}

#[test]
fn compare_tells_by_its_exit_code() {
    let folder = Folder::new();
    folder.run(&["render", "scene.xml", "-o", "a.png"]).told();
    folder.run(&["render", "scene.xml", "-o", "a.ppm"]).told();
    let run = folder.run(&["compare", "a.png", "a.ppm"]);
    assert_eq!((run.code(), run.err()), (Some(0), String::new()));
    assert_eq!(run.out(), "identical: all 1200 pixels are the same\n");

    // Three levels in one component of pixel 7,5.
    let mut ppm = bytes(&folder.path("a.ppm"));
    let place = b"P6\n40 30\n255\n".len() + (5 * 40 + 7) * 3 + 2;
    ppm[place] = if ppm[place] > 100 { ppm[place] - 3 } else { ppm[place] + 3 };
    fs::write(folder.path("b.ppm"), ppm).expect("written");
    let run = folder.run(&["compare", "a.png", "b.ppm", "--json", "--diff", "d.png"]);
    assert_eq!(run.code(), Some(1));
    let verdict: serde_json::Value = serde_json::from_str(&run.out()).expect("it is JSON");
    assert_eq!(verdict["same"], false);
    assert_eq!((&verdict["differing"], &verdict["largest"]), (&1.into(), &3.0.into()));
    assert_eq!(verdict["largest_at"], serde_json::json!([7, 5]));
    let expected = (9.0_f64 / 3600.0).sqrt();
    assert!((verdict["rmse"].as_f64().expect("a number") - expected).abs() < 1e-12);
    let difference = image::open(folder.path("d.png")).expect("a picture").into_rgb8();
    assert_eq!(difference.get_pixel(7, 5).0, [255, 0, 0]);

    assert_eq!(folder.run(&["compare", "a.png", "b.ppm", "--max-diff", "3"]).code(), Some(0));
    assert_eq!(folder.run(&["compare", "a.png", "b.ppm", "--max-diff", "2.9"]).code(), Some(1));
    folder.run(&["compare", "a.png", "scene.xml"]).fails(1, "not a picture in any format");
    folder.run(&["compare", "a.png", "a.ppm", "--diff", "a.png"]).fails(2, "a file of its own");
}

#[test]
fn the_exposure_that_was_found_can_be_given_back() {
    let folder = Folder::new();
    folder.run(&["render", "scene.xml", "-o", "a.png", "--stats", "s.json"]).told();
    let stats = folder.stats();
    let stops = stats["exposure"].to_string();
    folder.run(&["render", "scene.xml", "-o", "b.png", "--exposure", &stops]).told();
    assert!(bytes(&folder.path("a.png")) == bytes(&folder.path("b.png")));
    // A crop is as bright as the whole, and knows the same number.
    let crop = ["render", "scene.xml", "-o", "c.png", "--crop", "3,4,5,6", "--stats", "s.json"];
    folder.run(&crop).told();
    let stats = folder.stats();
    assert_eq!(stats["exposure"].to_string(), stops);
    folder.run(&["render", "scene.xml", "-o", "d.png", "--exposure", "-6"]).told();
    assert!(bytes(&folder.path("a.png")) != bytes(&folder.path("d.png")));
}

#[test]
fn layers_are_channels_of_the_picture() {
    let folder = Folder::new();
    folder.run(&["render", "scene.xml", "-o", "a.exr", "--layers", "all"]).told();
    folder.run(&["render", "scene.xml", "-o", "b.exr"]).told();
    let (layered, plain) = (bytes(&folder.path("a.exr")), bytes(&folder.path("b.exr")));
    for channel in [
        "depth.axis",
        "depth.ray",
        "normal.X",
        "albedo.B",
        "shape.id",
        "instance.id",
        "error.rms",
        "samples.count",
    ] {
        let name: Vec<u8> = channel.bytes().chain([0]).collect();
        assert!(layered.windows(name.len()).any(|part| part == name), "{channel}");
        assert!(!plain.windows(name.len()).any(|part| part == name), "{channel}");
    }
    assert_eq!(folder.run(&["compare", "a.exr", "b.exr"]).code(), Some(0), "the same colours");
}

#[test]
fn scenes_find_their_meshes_and_old_engines_refuse_new_scenes() {
    let folder = Folder::new();
    fs::create_dir(folder.path("inner")).expect("made");
    let triangle = "v 0 0 0\nv 4 0 0\nv 0 0 4\nf 1 2 3\n";
    fs::write(folder.path("inner/mesh.obj"), triangle).expect("written");
    let scene = SCENE.replace("<shapes>", "<shapes><mesh color=\"red\" file=\"mesh.obj\"/>");
    fs::write(folder.path("inner/scene.xml"), &scene).expect("written");
    folder.run(&["render", "inner/scene.xml", "-o", "a.png"]).told();
    fs::write(folder.path("lost.xml"), &scene).expect("written");
    folder.run(&["render", "lost.xml", "-o", "a.png"]).fails(1, "mesh.obj");
    fs::write(folder.path("inner/mesh.obj"), triangle.replace("f 1 2 3", "f 1 2 x"))
        .expect("written");
    let run = folder.run(&["check", "inner/scene.xml"]);
    assert!(run.err().contains("line 4, column 7"), "{}", run.err());
    fs::write(folder.path("inner/mesh.obj"), triangle).expect("written");
    let classic = ["render", "inner/scene.xml", "-o", "b.png", "--engine", "classic"];
    folder.run(&classic).fails(1, "shape 1 is a mesh");
    folder.run(&classic).fails(1, "use --engine whitted");
    assert!(!folder.path("b.png").exists());
    let run = folder.run(&["check", "inner/scene.xml", "--engine", "classic"]);
    assert!(run.code() == Some(1) && run.err().contains("shape 1 is a mesh"), "{}", run.err());
}

/// A tube of glass without lids lets rays into a medium that they never leave:
/// a warning before, and one afterwards that counts.
#[test]
fn media_that_make_no_sense_are_told() {
    let folder = Folder::new();
    let tube = "<cylinder transparency=\"1\" ior=\"1.5\" size=\"1\" open=\"true\">\
                <base x=\"5\" y=\"6\" z=\"0\"/><top x=\"5\" y=\"6\" z=\"2\"/></cylinder>";
    let scene = SCENE.replace("<shapes>", &format!("<shapes>{tube}"));
    fs::write(folder.path("tube.xml"), scene).expect("written");
    let run = folder.run(&["render", "tube.xml", "-o", "a.png"]);
    assert_eq!(run.code(), Some(0));
    assert!(run.err().contains("not closed"), "{}", run.err());
    assert!(
        run.err().contains("left a medium") && run.err().contains("first in pixel"),
        "{}",
        run.err()
    );
}

/// What has no end, or nobody who writes to it, is not waited for.
#[cfg(unix)]
#[test]
fn a_device_is_no_mesh() {
    let folder = Folder::new();
    std::os::unix::fs::symlink("/dev/zero", folder.path("mesh.obj")).expect("linked");
    let scene = SCENE.replace("<shapes>", "<shapes><mesh color=\"red\" file=\"mesh.obj\"/>");
    fs::write(folder.path("mesh.xml"), scene).expect("written");
    folder.run(&["check", "mesh.xml"]).fails(1, "no ordinary file");
}
