//! Large files are read in a time that grows with their size.

mod common;

use common::{BALL, messages, scene, text};
use std::fmt::Write;
use std::time::Instant;

/// Seconds even here; what grows with the square of the size takes minutes.
fn soon<T>(what: &str, work: impl FnOnce() -> T) -> T {
    let begun = Instant::now();
    let result = work();
    let seconds = begun.elapsed().as_secs_f64();
    assert!(seconds < 60.0, "{what} took {seconds} s");
    result
}

#[test]
fn spheres() {
    let mut shapes = String::new();
    for i in 0..300_000 {
        let _ = writeln!(
            shapes,
            "<sphere color=\"yellowgreen\" gloss=\"0.5\" chess=\"default\" size=\"1\">\
             <point x=\"{i}\" y=\"0.25\" z=\"-1e3\"/></sphere>"
        );
    }
    let scene = soon("300,000 spheres", || scene(&text("", &shapes)));
    assert_eq!(scene.shapes.len(), 300_000);
}

#[test]
fn names() {
    let (mut before, mut shapes) = (String::new(), String::new());
    for i in 0..100_000 {
        let _ = write!(before, "<material name=\"m{i}\" color=\"red\"/>");
        let _ = write!(before, "<define name=\"d{i}\">{BALL}</define>");
        let _ = write!(
            shapes,
            "<use name=\"d{i}\"/><sphere material=\"m{i}\" size=\"1\">\
             <point x=\"0\" y=\"0\" z=\"0\"/></sphere>"
        );
    }
    let scene = soon("100,000 names of each kind", || scene(&text(&before, &shapes)));
    assert_eq!(scene.groups.len(), 100_000);
}

#[test]
fn mistakes() {
    let (mut before, mut shapes) = (String::new(), String::new());
    for i in 0..100_000 {
        let _ = write!(before, "<material name=\"m{i}\" color=\"read\"/>");
        let _ = write!(before, "<define name=\"d{i}\"><use name=\"e{i}\"/></define>");
        let _ = write!(shapes, "<use nam=\"d{i}\"/><sphere material=\"n{i}\" size=\"1\"/>");
    }
    let found = soon("100,000 mistakes of each kind", || messages(&text(&before, &shapes)));
    assert!(found.len() > 500_000);
}
