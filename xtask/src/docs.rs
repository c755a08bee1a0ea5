//! `cargo xtask docs`: the reference of the scene language from its tables.

use crate::{Failure, fail};
use lancer_scene::Colour;
use lancer_tests::paths;
use lancer_xml::schema::{ELEMENTS, Element, Times};
use lancer_xml::{DEEPEST, MAX_PIXELS, MOST_ATTRIBUTES, MOST_NODES};
use std::fmt::Write;
use std::fs;

const HEAD: &str = "\
# The scene language

<!-- Written by `cargo xtask docs` from the tables in crates/xml/src/schema.rs. -->

A scene is an XML file in UTF-8. Its root is `<world>`, which holds one `<camera>`, one `<lights>`
and one `<shapes>`. Lengths are all in the same unit, whichever that is; z is up. Numbers are
decimal (`1`, `-0.5`, `2e3`) and finite. What is not listed here is an error, and `lancer check`
reports the errors of a file at once, up to the first that leaves the XML without form.
";

/// Writes the reference, or says whether it is up to date.
pub(crate) fn format_reference(check: bool) -> Result<(), Failure> {
    let path = paths::top().join("docs/format.md");
    let text = reference();
    if check {
        let written = fs::read_to_string(&path).map_err(fail)?;
        return if written == text {
            Ok(())
        } else {
            Err(fail("docs/format.md is not up to date: cargo xtask docs"))
        };
    }
    fs::write(path, text).map_err(fail)
}

fn reference() -> String {
    let mut page = HEAD.to_owned();
    for element in ELEMENTS {
        section(&mut page, element);
    }
    page.push_str("\n## Colours\n\n| name | red, green, blue (0 to 255) |\n|---|---|\n");
    for (name, c) in Colour::NAMED {
        let _ = writeln!(page, "| `{name}` | {} {} {} |", c.r, c.g, c.b);
    }
    let _ = write!(
        page,
        "\n## Limits\n\n\
         - A picture may have up to {MAX_PIXELS} pixels; `--max-pixels` sets another limit.\n\
         - Document type declarations and entities other than XML's own five are refused.\n\
         - Elements may be nested {DEEPEST} levels deep, and one may have {MOST_ATTRIBUTES} attributes.\n\
         - A file may have {MOST_NODES} elements, texts and comments.\n"
    );
    page
}

fn section(page: &mut String, element: &Element) {
    let _ = writeln!(page, "\n## `<{}>`\n\n{}", element.name, element.summary);
    if !element.attributes.is_empty() {
        page.push_str("\n| attribute | values | meaning |\n|---|---|---|\n");
        for attribute in element.attributes {
            let optional = if attribute.required { "" } else { " (optional)" };
            let _ = writeln!(
                page,
                "| `{}`{optional} | {} | {} |",
                attribute.name, attribute.values, attribute.meaning
            );
        }
    }
    if !element.children.is_empty() {
        page.push_str("\n| holds | how often | meaning |\n|---|---|---|\n");
        for child in element.children {
            let times = match child.times {
                Times::Once => "once",
                Times::Any => "any number",
            };
            let _ = writeln!(page, "| `<{}>` | {times} | {} |", child.element.name, child.meaning);
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_reference_is_up_to_date() {
        super::format_reference(true).unwrap_or_else(|failure| panic!("{failure}"));
    }
}
