//! Charts of time against error.

use super::*;

/// A scene that is soon charted.
const QUICK: [&str; 8] =
    ["--size", "24x18", "--finest", "0.008", "--exposure", "-2", "--strategies", "edges,sobol"];

fn chart(folder: &Folder, more: &[&str]) -> Run {
    folder.run(&[&["chart", "scene.xml"], QUICK.as_slice(), more].concat())
}

#[test]
fn a_chart_in_each_format_and_its_figures() {
    let folder = Folder::new();
    let run = chart(&folder, &["-o", "a.svg", "--csv", "a.csv", "--threads", "1"]);
    assert_eq!((run.code(), run.err()), (Some(0), String::new()));
    assert!(run.out().starts_with("At the knee: --"), "{}", run.out());
    let svg = String::from_utf8(bytes(&folder.path("a.svg"))).expect("text");
    for text in [
        "scene.xml, 24x18, 1 thread",
        "wall time of the rendering",
        "true error",
        "edges",
        "sobol",
        "Errors are held against 512 stratified",
        // Where it is broken into lines depends on how long it is.
        "lancer chart scene.xml --size 24x18",
    ] {
        assert!(svg.contains(text), "{text} is not in the chart");
    }
    let table = String::from_utf8(bytes(&folder.path("a.csv"))).expect("text");
    let rows: Vec<_> = table.lines().collect();
    assert!(rows[0].starts_with("series,peer,setting,seconds,error,"), "{}", rows[0]);
    assert!(rows[1].starts_with("edges,false,--error 0.016,"), "{}", rows[1]);
    // Points that are not ten times as far off as the reference are left out.
    assert!(rows.iter().any(|row| row.starts_with("sobol,false,--samples ")), "{table}");
    assert!(rows.iter().all(|row| row.split(',').count() == 9), "{table}");
    assert_eq!(rows.iter().filter(|row| row.ends_with(",true,true")).count(), 1, "{table}");

    let run = chart(&folder, &["-o", "a.png"]);
    assert_eq!((run.code(), run.err()), (Some(0), String::new()));
    assert!(bytes(&folder.path("a.png")).starts_with(b"\x89PNG"));
    let run = chart(&folder, &["-o", "a.html"]);
    assert_eq!((run.code(), run.err()), (Some(0), String::new()));
    let page = String::from_utf8(bytes(&folder.path("a.html"))).expect("text");
    assert!(page.starts_with("<!doctype html>") && page.contains("<td>--error 0.008</td>"));
    assert_eq!(folder.files(), ["a.csv", "a.html", "a.png", "a.svg", "scene.xml"]);
}

/// What is recommended is not mixed with figures.
#[test]
fn figures_go_to_standard_output() {
    let folder = Folder::new();
    let run = chart(&folder, &["--csv", "-"]);
    assert_eq!((run.code(), run.err()), (Some(0), String::new()));
    assert!(run.out().starts_with("series,peer,") && !run.out().contains("knee:"), "{}", run.out());
}

#[test]
fn what_cannot_be_charted_is_refused_before_the_work() {
    let folder = Folder::new();
    chart(&folder, &[]).fails(2, "required");
    chart(&folder, &["-o", "a.jpg"]).fails(2, "charts end in .svg, .png or .html");
    chart(&folder, &["-o", "-"]).fails(2, "charts end in");
    chart(&folder, &["-o", "a.svg", "--csv", "./a.svg"]).fails(2, "two different files");
    chart(&folder, &["--csv", "scene.xml"]).fails(2, "overwrite the scene");
    chart(&folder, &["-o", "a.svg", "--engines", "classic"]).fails(2, "pixels' centres");
    chart(&folder, &["-o", "a.svg", "--max-pixels", "10"]).fails(2, "more than --max-pixels");
    chart(&folder, &["-o", "none/a.svg"]).fails(1, "there is no folder none");
    let run = folder.run(&["chart", "none.xml", "-o", "a.svg"]);
    run.fails(1, "cannot read none.xml");
    assert_eq!(folder.files(), ["scene.xml"]);
}
