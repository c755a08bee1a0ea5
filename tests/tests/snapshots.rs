//! The parsed form of every scene and the text of every diagnostic.

use lancer_tests::paths::{Beside, files_with_extension, scenes, stem, top};
use lancer_xml::{Options, Parsed};
use std::collections::BTreeSet;
use std::path::Path;

fn parse(path: &Path) -> Parsed {
    let bytes = std::fs::read(path).expect("the file is there");
    let beside = Beside(path.parent().expect("it is in a folder"));
    lancer_xml::parse_with(&bytes, &Options::default(), &beside)
}

/// Compares one text for each file with its snapshot, all of them before
/// failing, and finds snapshots of files that are gone.
fn check(folder: &Path, kind: &str, text: impl Fn(&str, &Parsed) -> String) -> usize {
    let snapshots = top().join("tests/snapshots").join(kind);
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(&snapshots);
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    let files = files_with_extension(folder, "xml");
    let mut names = BTreeSet::new();
    let mut failed = Vec::new();
    for file in &files {
        let name = stem(file);
        let text = text(&name, &parse(file));
        let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            settings.bind(|| insta::assert_snapshot!(name.clone(), text));
        }));
        if result.is_err() {
            failed.push(name.clone());
        }
        names.insert(format!("{name}.snap"));
    }
    for snapshot in files_with_extension(&snapshots, "snap") {
        let name = snapshot.file_name().unwrap_or_default().to_string_lossy().into_owned();
        assert!(names.contains(&name), "{} has no scene: delete it", snapshot.display());
    }
    assert!(failed.is_empty(), "these differ from their snapshots: {failed:?}");
    files.len()
}

#[test]
fn dumps_of_all_scenes() {
    let count = check(&scenes(), "dumps", |name, parsed| match &parsed.scene {
        Some(scene) => scene.to_string(),
        None => panic!("{name} is invalid: {}", lancer::report::to_text(name, parsed)),
    });
    assert!(count >= 4);
}

#[test]
fn diagnostics_of_all_invalid_scenes() {
    let count = check(&scenes().join("invalid"), "diagnostics", |name, parsed| {
        assert!(!parsed.diagnostics.is_empty(), "nothing is wrong with {name}");
        lancer::report::to_text(&format!("{name}.xml"), parsed)
    });
    assert!(count >= 40);
}

/// What the issue tracker of many tools asks for first: all errors at once.
#[test]
fn all_mistakes_of_a_file_are_reported_at_once() {
    let parsed = parse(&scenes().join("invalid/many_mistakes.xml"));
    assert_eq!(parsed.diagnostics.len(), 7);
    let lines: Vec<_> =
        parsed.diagnostics.iter().map(|d| parsed.source.location(d.span.start).0).collect();
    assert!(lines.is_sorted(), "in the order of the file: {lines:?}");
}
