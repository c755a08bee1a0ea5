//! Permissions, links, signals and terminals.

use super::*;
use std::os::unix::fs::PermissionsExt;
use std::time::{Duration, Instant};

#[test]
fn files_have_ordinary_permissions_and_keep_their_own() {
    let folder = Folder::new();
    fs::write(folder.path("ordinary"), "").expect("written");
    let mode = |name: &str| {
        fs::metadata(folder.path(name)).expect("it is there").permissions().mode() & 0o777
    };
    folder.run(&["render", "scene.xml", "-o", "a.png"]).told();
    assert_eq!(mode("a.png"), mode("ordinary"));
    let private = fs::Permissions::from_mode(0o600);
    fs::set_permissions(folder.path("a.png"), private).expect("it is ours");
    folder.run(&["render", "scene.xml", "-o", "a.png"]).told();
    assert_eq!(mode("a.png"), 0o600);
}

#[test]
fn links_are_followed_and_devices_written_to() {
    let folder = Folder::new();
    fs::create_dir(folder.path("real")).expect("created");
    fs::write(folder.path("real/a.png"), "old").expect("written");
    std::os::unix::fs::symlink("real/a.png", folder.path("link.png")).expect("created");
    folder.run(&["render", "scene.xml", "-o", "link.png"]).told();
    assert!(fs::symlink_metadata(folder.path("link.png")).expect("there").is_symlink());
    assert!(bytes(&folder.path("real/a.png")).starts_with(b"\x89PNG"));
    folder.run(&["render", "scene.xml", "-o", "/dev/null", "--format", "png"]).told();
    // Also to where there is nothing yet.
    std::os::unix::fs::symlink("real/new.png", folder.path("dangling.png")).expect("created");
    folder.run(&["render", "scene.xml", "-o", "dangling.png"]).told();
    assert!(fs::symlink_metadata(folder.path("dangling.png")).expect("there").is_symlink());
    assert!(bytes(&folder.path("real/new.png")).starts_with(b"\x89PNG"));
    let run = folder.run(&["render", "scene.xml", "-o", "/dev/stdout", "--format", "qoi"]);
    assert!(run.0.stdout.starts_with(b"qoif"));
}

#[test]
fn read_only_files_are_not_replaced() {
    let folder = Folder::new();
    fs::write(folder.path("a.png"), "precious").expect("written");
    let read_only = fs::Permissions::from_mode(0o444);
    fs::set_permissions(folder.path("a.png"), read_only).expect("it is ours");
    folder.run(&["render", "scene.xml", "-o", "a.png"]).fails(1, "it is read-only");
    folder.run(&["render", "scene.xml", "-o", "b.png/"]).fails(1, "that names a folder");
    assert_eq!(bytes(&folder.path("a.png")), b"precious");
}

/// `nohup`, and jobs in the background of a script, have signals ignored.
#[cfg(target_os = "linux")]
#[test]
fn signals_that_are_ignored_stay_ignored() {
    let folder = Folder::new();
    let script = format!(
        "trap '' HUP INT; {} render scene.xml -o a.ppm --size 1500x1500 --samples 1 & \
         sleep 0.3; kill -INT $!; kill -HUP $!; wait $!",
        env!("CARGO_BIN_EXE_lancer-under-test")
    );
    let mut shell = Command::new("sh");
    let status = shell.args(["-c", &script]).current_dir(folder.0.path()).status();
    assert_eq!(status.expect("there is a shell").code(), Some(0));
    assert!(bytes(&folder.path("a.ppm")).starts_with(b"P6\n1500 1500\n"));
}

/// A terminal that answers no question, as `script` gives one, must not keep
/// the preview waiting; where there is no `script` this shows nothing.
#[cfg(target_os = "linux")]
#[test]
fn a_preview_does_not_wait_for_a_dumb_terminal() {
    let folder = Folder::new();
    let command = format!(
        "{} render scene.xml --preview --size 8x8 --quiet",
        env!("CARGO_BIN_EXE_lancer-under-test")
    );
    let child = Command::new("script")
        .args(["--quiet", "--return", "--command", &command, "/dev/null"])
        .current_dir(folder.0.path())
        .env("TERM", "xterm-256color")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .spawn();
    let Ok(mut child) = child else {
        println!("skipped: there is no `script` on this machine");
        return;
    };
    let begun = Instant::now();
    while child.try_wait().expect("it can be waited for").is_none() {
        assert!(begun.elapsed() < Duration::from_secs(20), "it hangs");
        std::thread::sleep(Duration::from_millis(50));
    }
    let output = child.wait_with_output().expect("it has ended");
    assert!(output.status.success());
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("\u{1b}[48;") || text.contains("\u{1b}[38;"), "{text:?}");
}

/// A render that is asked to end when it has begun, long before it would.
fn interrupted(folder: &Folder, signal: &str, arguments: &str) -> Run {
    // The tests themselves may be run where signals are ignored, under
    // `nohup` say; then the program would rightly go on.
    let program = env!("CARGO_BIN_EXE_lancer-under-test");
    let mut command = if cfg!(target_os = "linux") {
        let mut command = Command::new("env");
        command.args(["--default-signal=HUP,INT,TERM", program]);
        command
    } else {
        Command::new(program)
    };
    let child = command
        .args(arguments.split(' '))
        .current_dir(folder.0.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    // Long enough for it to have begun, far too short for it to end.
    std::thread::sleep(Duration::from_millis(700));
    let killed = Command::new("kill")
        .args([&format!("-{signal}"), &child.id().to_string()])
        .status()
        .expect("there is a kill");
    assert!(killed.success(), "it was still at work");
    let begun = Instant::now();
    let run = Run(child.wait_with_output().expect("it ends"));
    assert!(begun.elapsed() < Duration::from_secs(5), "soon");
    assert_eq!(run.code(), Some(130), "SIG{signal}: {}", run.err());
    run
}

#[test]
fn an_interruption_before_any_sample_leaves_the_old_picture_and_no_rubbish() {
    for signal in ["INT", "TERM"] {
        let folder = Folder::new();
        fs::write(folder.path("a.png"), "the old picture").expect("written");
        // Automatic exposure looks at all of the frame first.
        let arguments = "render scene.xml -o a.png --size 20000x5000 --crop 0,0,9,9";
        let run = interrupted(&folder, signal, arguments);
        assert_eq!(run.err(), "error: interrupted; no picture was written\n");
        assert_eq!(bytes(&folder.path("a.png")), b"the old picture");
        assert_eq!(folder.files(), ["a.png", "scene.xml"]);
    }
}

/// What there is when it is interrupted is written, with its error, and can be made again.
#[test]
fn an_interruption_writes_the_picture_so_far() {
    let folder = Folder::new();
    let arguments =
        "render scene.xml -o a.exr --error 1e-7 --size 400x300 --layers samples --stats s.json";
    let run = interrupted(&folder, "INT", arguments);
    let err = run.err();
    let lines: Vec<_> = err.lines().collect();
    assert_eq!((lines.len(), lines[0]), (2, "interrupted: this is the picture so far"), "{err}");
    assert!(lines[1].contains("error about 0.") && lines[1].contains("interrupted"), "{err}");
    assert_eq!(folder.files(), ["a.exr", "s.json", "scene.xml"]);
    let stats = folder.stats();
    assert_eq!(stats["sampling"]["stopped"], "interrupted");
    let stop_at = stats["sampling"]["stop_at"].as_str().expect("a place").to_owned();
    let again = "render scene.xml -o b.exr --size 400x300 --layers samples --stop-at";
    let again: Vec<_> = again.split(' ').chain([&*stop_at]).collect();
    folder.run(&again).told();
    assert!(bytes(&folder.path("a.exr")) == bytes(&folder.path("b.exr")));
}

#[test]
fn nobody_listening_is_no_panic() {
    let folder = Folder::new();
    let script = format!(
        "{} render scene.xml -o - --size 900x900 --samples 1 2>err | head -c 3; \
         {} check scene.xml 2>>err | true; exit 0",
        env!("CARGO_BIN_EXE_lancer-under-test"),
        env!("CARGO_BIN_EXE_lancer-under-test"),
    );
    let status = Command::new("sh")
        .args(["-c", &script])
        .current_dir(folder.0.path())
        .stdout(Stdio::null())
        .status();
    assert!(status.expect("there is a shell").success());
    let err = fs::read_to_string(folder.path("err")).expect("it was written");
    assert!(!err.contains("panicked"), "{err}");
    assert!(err.contains("cannot write to standard output"), "{err}");
}
