//! `cargo xtask docs`: the page that shows the scenes, from what stands beside
//! them.

use crate::{Failure, fail};
use lancer_tests::golden::{self, Golden};
use lancer_tests::paths;
use std::fmt::Write;
use std::fs;

const HEAD: &str = "\
# Scenes

<!-- Written by `cargo xtask docs` from the settings beside the scenes. -->

Each shows one thing. The pictures are the goldens of the tests, so they are what the present program makes; scenes render larger by
themselves. [invalid](invalid) holds scenes with mistakes; the messages for them are in tests/snapshots/diagnostics. [stability](stability)
holds scenes that are hard to get right, with the right values, and [bench](bench) scenes that time and accuracy are measured on.
";

/// Writes the page, or says whether it is up to date.
pub(crate) fn scenes_page(check: bool) -> Result<(), Failure> {
    let path = paths::scenes().join("README.md");
    let text = page()?;
    if !check {
        return fs::write(path, text).map_err(fail);
    }
    if fs::read_to_string(&path).map_err(fail)? == text {
        return Ok(());
    }
    Err(fail("scenes/README.md is not up to date: cargo xtask docs"))
}

/// The page as it should be.
fn page() -> Result<String, Failure> {
    let goldens = golden::all().map_err(|problems| {
        let list: Vec<_> = problems.iter().map(ToString::to_string).collect();
        fail(list.join("\n"))
    })?;
    // The first golden of each scene is the one to show.
    let mut shown: Vec<&Golden> = Vec::new();
    for golden in &goldens {
        if shown.last().is_none_or(|last| last.scene_name() != golden.scene_name()) {
            shown.push(golden);
        }
    }
    let (in_folders, at_top): (Vec<&Golden>, Vec<&Golden>) =
        shown.into_iter().partition(|golden| golden.scene_name().contains('/'));
    let mut page = HEAD.to_owned();
    section(&mut page, "The gallery", &at_top);
    section(&mut page, "Each shape and its checker", &in_folders);
    Ok(page)
}

fn section(page: &mut String, title: &str, goldens: &[&Golden]) {
    let _ = writeln!(page, "\n## {title}\n\n| picture | scene |\n|---|---|");
    for golden in goldens {
        let (scene, name, about) = (golden.scene_name(), &golden.name, &golden.about);
        let _ = writeln!(
            page,
            "| ![{scene}](../tests/goldens/{name}.png) | [{scene}]({scene}.xml): {about} |"
        );
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_page_is_up_to_date() {
        super::scenes_page(true).unwrap_or_else(|failure| panic!("{failure}"));
    }
}
