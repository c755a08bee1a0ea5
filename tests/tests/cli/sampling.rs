//! What is asked about samples, and what is told of them.

use super::*;
use std::time::{Duration, Instant};

/// Renders the scene with further arguments; the file and the statistics.
fn render(folder: &Folder, arguments: &str) -> (Vec<u8>, serde_json::Value) {
    let all = format!("render scene.xml -o a.ppm --stats s.json {arguments}");
    folder.run(&all.split_whitespace().collect::<Vec<_>>()).told();
    (bytes(&folder.path("a.ppm")), folder.stats())
}

fn float(stats: &serde_json::Value, name: &str) -> f64 {
    stats["sampling"][name].as_f64().unwrap_or_else(|| panic!("{name} in {stats}"))
}

#[test]
fn the_last_line_tells_error_reason_and_speed() {
    let folder = Folder::new();
    for (arguments, tells) in [
        ("--error 0.01", "40x30 pixels by whitted: error about 0.0"),
        ("--error 0.01", " (asked: 0.01), "),
        ("", " (asked: 0.0005), "),
        ("--samples 4", " (all samples asked for), 4 samples a pixel; "),
        ("--samples 1", " (all samples asked for), 1 sample a pixel; "),
        ("--crop 3,4,5,6", "5x6 pixels by whitted: "),
        ("--threads 1", " s on 1 thread, "),
        ("--engine classic", "40x30 pixels by classic: one sample at the centre of each pixel; "),
    ] {
        let all = format!("render scene.xml -o a.ppm {arguments}");
        let run = folder.run(&all.split_whitespace().collect::<Vec<_>>()).told();
        assert!(run.last_line().contains(tells), "{}", run.err());
        let quiet = format!("{all} --quiet");
        folder.run(&quiet.split_whitespace().collect::<Vec<_>>()).silent();
    }
}

#[test]
fn statistics_tell_what_was_asked_and_what_came_of_it() {
    let folder = Folder::new();
    let (_, stats) = render(&folder, "--error 0.004 --seed 7 --samples 2000");
    let sampling = &stats["sampling"];
    assert_eq!((&sampling["strategy"], &sampling["seed"]), (&"edges".into(), &7.into()));
    let asked = serde_json::json!({
        "samples": 2000, "error": 0.004, "seconds": null, "stop_at": null
    });
    assert_eq!(sampling["asked"], asked);
    assert!(float(&stats, "error") <= 0.004 && float(&stats, "error") > 0.0);
    assert_eq!(
        (&sampling["stopped"], &sampling["pixels_without_samples"]),
        (&"error".into(), &0.into())
    );
    let per_pixel = float(&stats, "samples") / 1200.0;
    assert_eq!(float(&stats, "samples_per_pixel"), per_pixel);
    assert!(per_pixel > 1.0 && per_pixel < 2000.0, "{per_pixel}");
    // The cutoff follows the error, unless it is given.
    assert_eq!(stats["cutoff"], 0.004 / 5.0);
    assert_eq!(render(&folder, "--error 0.004 --cutoff 0.25").1["cutoff"], 0.25);
    assert_eq!(render(&folder, "--samples 2").1["cutoff"], 1e-4);
    let classic = render(&folder, "--engine classic").1;
    assert!(classic["sampling"].is_null() && classic["cutoff"].is_null());
}

#[test]
fn one_sample_is_at_the_centre_whatever_the_seed_and_others_are_not() {
    let folder = Folder::new();
    let one = render(&folder, "--samples 1").0;
    assert!(one == render(&folder, "--samples 1 --seed 5").0);
    assert!(one == render(&folder, "--samples 1 --strategy random").0);
    assert!(one != render(&folder, "").0);
    for strategy in ["edges", "sobol", "stratified", "random"] {
        let draw = |seed: &str| {
            render(&folder, &format!("--samples 2 --strategy {strategy} --seed {seed}")).0
        };
        assert!(draw("1") != draw("2"), "{strategy}");
    }
}

#[test]
fn the_picture_does_not_depend_on_threads() {
    let folder = Folder::new();
    for asked in ["--error 0.003 --size 100x70", "--samples 3 --strategy sobol"] {
        let with = |threads| render(&folder, &format!("{asked} --threads {threads}")).0;
        let one = with(1);
        assert!(one == with(2) && one == with(3), "{asked}");
    }
}

/// Time only chooses where the sequence of samples ends, and that place makes the same file.
#[test]
fn a_picture_in_a_time_can_be_made_again() {
    let folder = Folder::new();
    for asked in ["--size 300x200", "--size 300x200 --strategy sobol --seed 3"] {
        let begun = Instant::now();
        let (picture, stats) = render(&folder, &format!("{asked} --time 150ms"));
        // Far more than it should be late: others may be at work on the machine.
        assert!(begun.elapsed() < Duration::from_secs(10), "{:?}", begun.elapsed());
        assert_eq!(stats["sampling"]["stopped"], "time");
        assert!(stats["seconds"]["render"].as_f64().is_some_and(|s| s >= 0.15));
        let stop_at = stats["sampling"]["stop_at"].as_str().expect("a place");
        let (again, same) = render(&folder, &format!("{asked} --threads 3 --stop-at {stop_at}"));
        assert!(again == picture, "{asked} {stop_at}");
        assert_eq!(same["sampling"]["stopped"], "stop-at");
        assert_eq!(float(&same, "error"), float(&stats, "error"));
        assert_eq!(same["sampling"]["stop_at"], stop_at);
    }
    // Where the error came first the place says so, too.
    let (picture, stats) = render(&folder, "");
    assert_eq!(stats["sampling"]["stopped"], "error");
    let stop_at = stats["sampling"]["stop_at"].as_str().expect("a place");
    assert!(stop_at.ends_with("@0.0005"), "{stop_at}");
    assert!(render(&folder, &format!("--stop-at {stop_at}")).0 == picture);
}

#[test]
fn whichever_comes_first_ends_it() {
    let folder = Folder::new();
    for (asked, stopped) in [
        ("--samples 2 --error 1e-6 --time 1h", "samples"),
        ("--samples 100000 --error 0.05 --time 1h", "error"),
        ("--samples 1000000 --error 1e-9 --time 20ms", "time"),
        ("--error 1e-6 --time 1h --stop-at 1:1@0.000001", "stop-at"),
    ] {
        let (_, stats) = render(&folder, asked);
        assert_eq!(stats["sampling"]["stopped"], stopped, "{asked}");
    }
}
