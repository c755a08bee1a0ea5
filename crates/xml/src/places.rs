//! Where in a file the parts of its scene are described.

use crate::Source;
use crate::document::{start_of, tree};
use crate::schema;
use std::ops::Range;

/// The start tags, in bytes of the [`Source`]'s text, of what a scene has in its own order.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Places {
    /// That of the root.
    pub world: Range<usize>,
    /// That of the camera.
    pub camera: Range<usize>,
    /// Those of [`Scene::lights`](lancer_scene::Scene::lights).
    pub lights: Vec<Range<usize>>,
    /// Those of [`Scene::shapes`](lancer_scene::Scene::shapes): no groups, and not what is in them.
    pub shapes: Vec<Range<usize>>,
}

impl Places {
    /// Those of a text that a scene was read from; `None` where it is no XML.
    #[must_use]
    pub fn of(source: &Source) -> Option<Self> {
        let document = tree(source.text(), source).ok()?;
        let root = document.root_element();
        let mut places = Self { world: start_of(&root), ..Self::default() };
        for part in root.children().filter(roxmltree::Node::is_element) {
            let inside = || part.children().filter(roxmltree::Node::is_element);
            let name = part.tag_name().name();
            if name == schema::CAMERA.name {
                places.camera = start_of(&part);
            } else if name == schema::LIGHTS.name {
                places.lights = inside().map(|light| start_of(&light)).collect();
            } else if name == schema::SHAPES.name {
                let others = [schema::GROUP.name, schema::USE.name];
                let own = inside().filter(|shape| !others.contains(&shape.tag_name().name()));
                places.shapes = own.map(|shape| start_of(&shape)).collect();
            }
        }
        Some(places)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Options, parse};

    #[test]
    fn parts_are_found_in_the_order_of_the_scene() {
        let text = r#"<world>
  <camera pxwidth="4" pxheight="3" width="1"><origin x="0" y="-9" z="0"/><target x="0" y="0" z="0"/></camera>
  <define name="two"><sphere color="red" size="1"><point x="0" y="0" z="0"/></sphere></define>
  <lights><sun brightness="1"><point x="1" y="1" z="-1"/></sun>
    <lamp brightness="2"><point x="1" y="1" z="9"/></lamp></lights>
  <shapes>
    <sphere color="red" size="1"><point x="1" y="0" z="0"/></sphere>
    <group><cube color="red" size="1"><point x="0" y="0" z="0"/></cube></group>
    <use name="two"/>
    <plane color="red"><origin x="0" y="0" z="0"/><normal x="0" y="0" z="1"/></plane>
  </shapes>
</world>"#;
        let parsed = parse(text.as_bytes(), &Options::default());
        let places = Places::of(&parsed.source).expect("it is XML");
        let scene = parsed.into_result().unwrap_or_else(|e| panic!("{e}"));
        let names = |spans: &[Range<usize>]| -> Vec<String> {
            let name = |span: &Range<usize>| text[span.clone()].split([' ', '>']).next();
            spans.iter().filter_map(name).map(|name| name[1..].to_owned()).collect()
        };
        assert_eq!(names(&places.lights), ["sun", "lamp"]);
        let kinds: Vec<_> = scene.shapes.iter().map(|s| s.geometry.kind().to_owned()).collect();
        assert_eq!(names(&places.shapes), kinds);
        assert_eq!(names(&[places.world, places.camera]), ["world", "camera"]);
    }
}
