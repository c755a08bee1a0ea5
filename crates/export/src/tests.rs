use super::*;
use lancer_math::{Placement, Point, Ray, Vector};
use lancer_scene::{
    Camera, Colour, CustomShape, Group, InvalidField, Light, SceneBuilder, Shadows, Shape, Surface,
};
use std::sync::Arc;

fn scene() -> SceneBuilder {
    let camera = Camera::new([0.0, -5.0, 1.0], [0.0, 0.0, 1.0], 4.0, [400, 300]);
    Scene::builder().camera(camera.and_then(|camera| camera.stops(1.0)))
}

fn text(builder: SceneBuilder, format: Format) -> (String, Vec<String>) {
    let scene = builder.build().expect("valid");
    let exported = export(&scene, format, "scene");
    (exported.text, exported.omissions.iter().map(ToString::to_string).collect())
}

fn ball() -> Result<Shape, InvalidField> {
    Shape::sphere([0.0, 0.0, 1.0], 1.0, Surface::new(Colour::RED))
}

#[test]
fn light_is_exposed() {
    let builder = || {
        let lamp = Light::lamp([0.0, 0.0, 4.0], 0.5).map(Light::without_falloff);
        let glowing = Surface::new(Colour::WHITE).emission([0.25; 3]);
        scene().light(lamp).shape(Shape::sphere([0.0; 3], 1.0, glowing))
    };
    let (pov, omissions) = text(builder(), Format::PovRay);
    assert!(pov.contains("light_source { <0, 0, 4>, rgb <1, 1, 1> }"), "{pov}");
    assert!(pov.contains("emission rgb <0.5, 0.5, 0.5>"), "{pov}");
    assert!(omissions.is_empty() && pov.contains("Nothing is left out"));
    let (mitsuba, _) = text(builder(), Format::Mitsuba);
    assert!(mitsuba.contains("<rgb name=\"radiance\" value=\"0.5, 0.5, 0.5\"/>"), "{mitsuba}");
    // Pi times the square of the distance of the target, which is 3.
    assert!(mitsuba.contains("<rgb name=\"intensity\" value=\"28.27"), "{mitsuba}");
}

#[test]
fn groups_are_declared_once_and_empty_ones_left_out() {
    let inner = Group::new(Some("a -- b".to_owned()), vec![ball().expect("valid")], Vec::new());
    let inner = Arc::new(inner.expect("small"));
    let empty = Arc::new(Group::new(None, Vec::new(), Vec::new()).expect("small"));
    let step = |x| Placement::translate(Vector::new(x, 0.0, 0.0));
    let builder = scene().group(step(1.0), inner.clone()).group(step(2.0), inner);
    let (pov, _) = text(builder.group(step(3.0), empty), Format::PovRay);
    assert_eq!(pov.matches("#declare Group1 =").count(), 1);
    assert_eq!(pov.matches("object { Group1 matrix").count(), 2);
    assert!(!pov.contains("union") && !pov.contains("Group2"), "{pov}");
}

#[derive(Debug)]
struct Blob;

impl CustomShape for Blob {
    fn name(&self) -> &str {
        "blob"
    }
    fn nearest(&self, _: &Ray) -> Option<f64> {
        None
    }
    fn normal(&self, _: &Point) -> Vector {
        Vector::z()
    }
}

#[test]
fn what_is_left_out_is_told_once_with_its_place() {
    let red = Surface::new(Colour::RED);
    for format in Format::ALL {
        let builder = scene().shape(ball()).shape(Shape::custom(Blob, red));
        let (text, omissions) = text(builder.shape(Shape::custom(Blob, red)), *format);
        let expected = "shape 2, a blob (and 1 more): a shape of your own, which is left out";
        assert_eq!(omissions, [expected]);
        assert!(text.contains(expected), "{text}");
    }
    let glass = || Surface::glass(1.5);
    let builder = scene().shape(Shape::sphere([0.0; 3], 1.0, glass()));
    let (_, omissions) = text(builder.clone(), Format::PovRay);
    assert!(omissions[0].contains("say shadows=\"opaque\""), "{omissions:?}");
    let (pov, omissions) = text(builder.shadows(Shadows::Opaque), Format::PovRay);
    assert!(omissions.is_empty() && pov.contains("no_image no_reflection"), "{pov}");
}

#[test]
fn names_of_files_are_plain() {
    let cone = Shape::cone([0.0; 3], [0.0, 0.0, 1.0], 1.0, Surface::new(Colour::RED));
    let scene = scene().shape(cone).build().expect("valid");
    for (stem, name) in [("a $\"b&", "a __b_-1.ply"), ("", "scene-1.ply")] {
        let exported = export(&scene, Format::Mitsuba, stem);
        assert_eq!(exported.files[0].name, name);
        assert!(exported.text.contains(&format!("value=\"{name}\"")), "{}", exported.text);
    }
}
