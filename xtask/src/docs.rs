//! `cargo xtask docs`: the reference of the scene language from its tables.

use crate::{Failure, fail};
use lancer_scene::{Colour, Group};
use lancer_tests::paths;
use lancer_xml::schema::{
    Attribute, Cells, Child, ELEMENTS, Element, Need, ORIGIN, SURFACE, TRANSFORMS, Times,
};
use lancer_xml::{DEEPEST, MAX_PIXELS, MOST_ATTRIBUTES, MOST_NODES};
use std::fmt::Write;
use std::fs;

const HEAD: &str = "\
# The scene language

<!-- Written by `cargo xtask docs` from the tables in crates/xml/src/schema. -->

A scene is an XML file in UTF-8. Its root is `<world>`, which holds one `<camera>`, one `<lights>`
and one `<shapes>`. Lengths are all in the same unit, whichever that is; z is up. Numbers are
decimal (`1`, `-0.5`, `2e3`) and finite; several in one value have spaces between them. What is not
listed here is an error, and `lancer check` reports the errors of a file at once, up to the first
that leaves the XML without form.

Further down: [surfaces](#surfaces), [checkers](#checkers), [transforms](#transforms),
[points and directions](#points-and-directions), [colours](#colours), [limits](#limits).
";

const SURFACES: &str = "
## Surfaces

Each shape has these attributes, and each `<material>`. With g the gloss, t the transparency and F the fraction
that Fresnel's equations let a clear surface mirror, a surface shows

    emission + g mirror + (1 - g) (t (F mirror + (1 - F) refracted) + (1 - t) matte)
";

const MATERIALS: &str = "
Where a shape names a material, the material's attributes hold where the shape does not give its own; so `chess=\"none\"` on the shape
switches a material's checker off. `chess-size` is given on shapes alone.

```xml
<material name=\"glass\" transparency=\"1\" ior=\"1.5\" absorption=\"0.1 0 0.1\"/>
<shapes>
  <sphere material=\"glass\" size=\"1\"><point x=\"0\" y=\"0\" z=\"1\"/></sphere>
</shapes>
```
";

const CHECKERS: &str = "
## Checkers

The attribute `chess` lays a checker of two colours on a shape. Cells are counted along two coordinates of the shape's own, and both sides of
zero differ; the second colour is where one count is odd and the other is not. The attribute `chess-size` is the side of a cell: a length, or degrees along a
coordinate that is an angle. An angle must divide 180, so that the colours alternate all around. What is below a border by no more than rounding
belongs to the cell above it; beyond 2^52 cells, where numbers do not tell them apart, the mean of both colours is shown.

The two axes across a normal or an axis n are n × x (n × y where n is along x), made a unit vector, and n times that one, × being the cross product; angles around n are
counted from the first towards the second.

The engines `classic` and `direct` have the original's cells: half a radian on spheres, 1 on planes.

";

const GROUPS: &str = "
## Transforms

A `<group>` and a `<use>` hold any number of these. What is inside is moved by the first, then by the second, and so on, in the order written. None of them may flatten space,
so that a factor of 0 is an error.

```xml
<define name=\"pillar\">
  <cylinder color=\"white\" size=\"0.3\"><base x=\"0\" y=\"0\" z=\"0\"/><top x=\"0\" y=\"0\" z=\"3\"/></cylinder>
</define>
<shapes>
  <use name=\"pillar\"/>
  <use name=\"pillar\"><scale by=\"0.5\"/><translate x=\"2\" y=\"0\" z=\"0\"/></use>
</shapes>
```
";

const COLOURS: &str = "
## Colours

| form | example | meaning |
|---|---|---|
| a name | `dark green` | one of the names below; exactly as they are written |
| `#rrggbb` | `#076900` | red, green and blue in hexadecimal codes of sRGB, from `00` to `ff` |
| `rgb(r, g, b)` | `rgb(7, 105, 0)` | the same in decimal, from 0 to 255 |
| `linear(r, g, b)` | `linear(0.002, 0.14, 0)` | shares of the light itself, from 0 to 1; for a `<background>` the radiance, from 0 on |

Codes are sRGB, as on a screen. The engines `classic` and `direct` take them as they are.
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
    let is_transform =
        |element: &Element| TRANSFORMS.iter().any(|child| child.element.name == element.name);
    for element in ELEMENTS {
        if !is_transform(element) && !is_xyz(element) {
            section(&mut page, 2, element);
        }
    }
    page.push_str(SURFACES);
    attributes(&mut page, SURFACE);
    page.push_str(MATERIALS);
    checkers(&mut page);
    page.push_str(GROUPS);
    for element in ELEMENTS.iter().filter(|element| is_transform(element)) {
        section(&mut page, 3, element);
    }
    points(&mut page);
    colours(&mut page);
    let _ = write!(
        page,
        "\n## Limits\n\n\
         - A picture may have up to {MAX_PIXELS} pixels; `--max-pixels` sets another limit.\n\
         - Groups and uses may be nested {} levels deep, and show {} shapes, each counted as often as it is\n  \
         shown and a mesh as one.\n\
         - Document type declarations and entities other than XML's own five are refused.\n\
         - Elements may be nested {DEEPEST} levels deep, and one may have {MOST_ATTRIBUTES} attributes.\n\
         - A file may have {MOST_NODES} elements, texts and comments.\n",
        Group::DEEPEST - 1,
        Group::MOST_SHAPES,
    );
    page
}

/// Whether an element is a point or a direction and nothing else.
fn is_xyz(element: &Element) -> bool {
    let meanings = |element: &'static [Attribute]| element.iter().map(|a| a.meaning);
    meanings(element.attributes).eq(meanings(ORIGIN.attributes))
}

fn section(page: &mut String, level: usize, element: &Element) {
    let summary = marked(element.summary);
    let _ = writeln!(page, "\n{:#<level$} `<{}>`\n\n{summary}", "", element.name);
    if !element.attributes.is_empty() {
        attributes(page, element.attributes);
    }
    let one_of: Vec<_> = element.one_of.iter().map(|set| quoted(set)).collect();
    if !one_of.is_empty() {
        let _ = writeln!(page, "\nEither {} must be given.", one_of.join(" or "));
    }
    if !element.surface.is_empty() {
        page.push_str("\nAnd the attributes of a [surface](#surfaces).\n");
    }
    let is_plain = |child: &Child| child.times == Times::Any && child.meaning.is_empty();
    if !element.children.is_empty() && element.children.iter().all(is_plain) {
        let names: Vec<_> =
            element.children.iter().map(|child| format!("`<{}>`", child.element.name)).collect();
        let _ = writeln!(page, "\nIt holds any number of {}.", names.join(", "));
    } else if !element.children.is_empty() {
        page.push_str("\n| holds | how often | meaning |\n|---|---|---|\n");
        for child in element.children {
            let times = match child.times {
                Times::Once => "once",
                Times::Optional => "at most once",
                Times::Any => "any number",
            };
            let meaning = marked(child.meaning);
            let _ = writeln!(page, "| `<{}>` | {times} | {meaning} |", child.element.name);
        }
    }
    if !element.transforms.is_empty() {
        let and = if element.children.is_empty() { "It holds" } else { "And" };
        let _ = writeln!(page, "\n{and} any number of [transforms](#transforms).");
    }
}

fn attributes(page: &mut String, attributes: &[Attribute]) {
    page.push_str("\n| attribute | values | meaning |\n|---|---|---|\n");
    for attribute in attributes {
        let need = match attribute.need {
            Need::Required => "",
            Need::Optional => " (optional)",
            Need::OneOf => " (see below)",
        };
        let (values, meaning) = (marked(attribute.values), marked(attribute.meaning));
        let _ = writeln!(page, "| `{}`{need} | {values} | {meaning} |", attribute.name);
    }
}

fn checkers(page: &mut String) {
    page.push_str(CHECKERS);
    page.push_str("| shape | `chess-size` | cells are counted along |\n|---|---|---|\n");
    for element in ELEMENTS {
        let size = match element.cells {
            None => continue,
            Some(Cells::Length) => "a length",
            Some(Cells::Angle) => "an angle",
            Some(Cells::LengthAndAngle) => "a length and an angle",
        };
        let _ = writeln!(page, "| `<{}>` | {size} | {} |", element.name, marked(element.checker));
    }
}

/// What differs in nothing but its name is listed by what it is.
fn points(page: &mut String) {
    page.push_str("\n## Points and directions\n\n| element | what it is |\n|---|---|\n");
    let all: Vec<_> = ELEMENTS.iter().filter(|element| is_xyz(element)).collect();
    for (i, first) in all.iter().enumerate() {
        let is_same = |element: &&&&Element| element.summary == first.summary;
        if all[..i].iter().any(|element| is_same(&element)) {
            continue;
        }
        let names: Vec<_> =
            all.iter().filter(is_same).map(|element| format!("`<{}>`", element.name)).collect();
        let _ = writeln!(page, "| {} | {} |", names.join(" "), marked(first.summary));
    }
    page.push_str("\nEach has three attributes:\n");
    attributes(page, ORIGIN.attributes);
}

fn colours(page: &mut String) {
    page.push_str(COLOURS);
    let css = Colour::names().count();
    let first: Vec<_> = Colour::NAMED.iter().map(|(name, _)| *name).collect();
    page.push_str("\nThe names of the language itself:\n\n| name | red, green, blue (0 to 255) |\n|---|---|\n");
    for (name, colour) in Colour::NAMED {
        let [r, g, b] = colour.codes();
        let _ = writeln!(page, "| `{name}` | {r} {g} {b} |");
    }
    let more: Vec<_> = Colour::names().skip(first.len()).map(|name| format!("`{name}`")).collect();
    let _ = writeln!(
        page,
        "\nThen the 148 names of CSS (Color Module Level 4), of which {} are not among those above: {}.",
        css - first.len(),
        more.join(", ")
    );
}

fn quoted(names: &[&str]) -> String {
    let names: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
    match &names[..] {
        [most @ .., last] if !most.is_empty() => format!("{} and {last}", most.join(", ")),
        _ => names.concat(),
    }
}

/// A text in which the tags of elements are code, so that Markdown shows them.
fn marked(text: &str) -> String {
    let mut marked = String::new();
    for (i, piece) in text.split('`').enumerate() {
        if i % 2 == 1 {
            let _ = write!(marked, "`{piece}`");
        } else {
            marked.push_str(&piece.replace('<', "`<").replace('>', ">`"));
        }
    }
    marked
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_reference_is_up_to_date() {
        super::format_reference(true).unwrap_or_else(|failure| panic!("{failure}"));
    }

    #[test]
    fn tags_are_marked_as_code() {
        let text = "put <a> on `x` or `<b>`";
        assert_eq!(super::marked(text), "put `<a>` on `x` or `<b>`");
    }
}
