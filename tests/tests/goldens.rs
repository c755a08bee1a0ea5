//! Every golden picture is exactly what it was.

use lancer_tests::golden::{self, Verdict};
use lancer_tests::{html, paths};

#[test]
fn goldens() {
    let goldens = golden::all().unwrap_or_else(|problems| {
        let list: Vec<_> = problems.iter().map(ToString::to_string).collect();
        panic!("{}", list.join("\n"));
    });
    assert!(!goldens.is_empty());
    let folder = paths::top().join("target/goldens");
    // What an earlier run left is not to be taken for this one's.
    let _ = std::fs::remove_dir_all(&folder);
    let mut results = Vec::new();
    for golden in goldens {
        let actual = golden.render().unwrap_or_else(|e| panic!("{}: {e}", golden.name));
        let verdict = golden.judge(&actual);
        if !matches!(verdict, Verdict::Same) {
            golden.leave_evidence(&actual, &folder).expect("target can be written to");
        }
        results.push((golden.name, verdict));
    }
    let failed: Vec<_> = results
        .iter()
        .filter(|(_, verdict)| !matches!(verdict, Verdict::Same))
        .map(|(name, verdict)| format!("{name}: {verdict:?}"))
        .collect();
    if !failed.is_empty() {
        let page = html::report(results.iter().map(|(name, verdict)| (name.as_str(), verdict)));
        let report = folder.join("report.html");
        std::fs::write(&report, page).expect("target can be written to");
        panic!(
            "{}\nLook at {}; if the new pictures are right: cargo xtask regen-goldens",
            failed.join("\n"),
            report.display()
        );
    }
}
