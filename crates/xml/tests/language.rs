//! What each element of the language becomes.

mod common;

use common::{BALL, CAMERA, LIGHTS, dump, messages, scene, text};
use lancer_xml::schema;

fn camera(attributes: &str, up: &str) -> String {
    let camera = format!(
        "<camera pxwidth=\"4\" pxheight=\"3\" {attributes}>\
         <origin x=\"0\" y=\"0\" z=\"0\"/><target x=\"1\" y=\"0\" z=\"0\"/>{up}</camera>"
    );
    let text = format!("<world>{camera}{LIGHTS}<shapes>{BALL}</shapes></world>");
    let dump = scene(&text).to_string();
    let line = dump.lines().next().unwrap_or_default();
    line.strip_prefix("camera origin 0 0 0 target 1 0 0 ").unwrap_or(line).to_owned()
}

#[test]
fn cameras() {
    let up = "<up x=\"0\" y=\"1\" z=\"0\"/>";
    for (attributes, up, expected) in [
        ("width=\"2\"", "", "width 2 pixels 4 x 3"),
        ("width=\"2\" projection=\"perspective\"", "", "width 2 pixels 4 x 3"),
        ("fov=\"50\"", "", "fov 50 pixels 4 x 3"),
        ("width=\"2\" projection=\"orthographic\"", "", "orthographic width 2 pixels 4 x 3"),
        (
            "width=\"2\" roll=\"-10\" exposure=\"-1.5\"",
            up,
            "width 2 up 0 1 0 roll -10 exposure -1.5 pixels 4 x 3",
        ),
        ("width=\"2\" exposure=\"auto\"", "", "width 2 pixels 4 x 3"),
        // Along the view: allowed, and what is up then is for the engine.
        ("width=\"2\"", "<up x=\"2\" y=\"0\" z=\"0\"/>", "width 2 up 2 0 0 pixels 4 x 3"),
    ] {
        assert_eq!(camera(attributes, up), expected, "{attributes}");
    }
}

#[test]
fn lights() {
    let lights = r#"<lights shadows="opaque">
      <lamp brightness="2"><point x="1" y="2" z="3"/></lamp>
      <lamp brightness="2" falloff="none"><point x="1" y="2" z="3"/></lamp>
      <lamp brightness="2" falloff="square"><point x="1" y="2" z="3"/></lamp>
      <sun brightness="0"><point x="0" y="0" z="-5"/></sun>
      <spot brightness="3" inner="10" outer="20">
        <point x="1" y="2" z="3"/><axis x="0" y="0" z="-1"/>
      </spot>
      <spot brightness="3" inner="0" outer="180" falloff="none">
        <axis x="0" y="0" z="-1"/><point x="1" y="2" z="3"/>
      </spot>
    </lights>"#;
    let scene = scene(&format!("<world>{CAMERA}{lights}<shapes>{BALL}</shapes></world>"));
    let dump = scene.to_string();
    let lines: Vec<_> = dump.lines().skip(1).take(7).collect();
    assert_eq!(
        lines,
        [
            "shadows opaque",
            "lamp point 1 2 3 brightness 2",
            "lamp point 1 2 3 brightness 2 falloff none",
            "lamp point 1 2 3 brightness 2",
            "sun direction 0 0 -5 brightness 0",
            "spot point 1 2 3 axis 0 0 -1 inner 10 outer 20 brightness 3",
            "spot point 1 2 3 axis 0 0 -1 inner 0 outer 180 brightness 3 falloff none",
        ]
    );
}

#[test]
fn backgrounds() {
    for (color, expected) in [
        ("white", "background 1 1 1"),
        ("#ff0000", "background 1 0 0"),
        ("linear(2.5, 0, 40)", "background 2.5 0 40"),
    ] {
        let before = format!("<background color=\"{color}\"/>");
        let dump = scene(&text(&before, BALL)).to_string();
        assert_eq!(dump.lines().nth(1), Some(expected));
    }
}

/// Each shape, with what is behind its `size` and the like.
const SHAPES: &[(&str, &str)] = &[
    (
        r#"<sphere color="red" size="2"><point x="1" y="2" z="3"/></sphere>"#,
        "sphere centre 1 2 3 radius 2",
    ),
    (
        r#"<plane color="red"><origin x="1" y="2" z="3"/><normal x="0" y="0" z="2"/></plane>"#,
        "plane origin 1 2 3 normal 0 0 2",
    ),
    (
        r#"<disc color="red" size="2"><point x="1" y="2" z="3"/><normal x="0" y="0" z="2"/></disc>"#,
        "disc centre 1 2 3 radius 2 normal 0 0 2",
    ),
    (
        r#"<rectangle color="red"><point x="1" y="2" z="3"/><across x="2" y="0" z="0"/>
           <upward x="0" y="1" z="3"/></rectangle>"#,
        "rectangle corner 1 2 3 sides 2 0 0 and 0 1 3",
    ),
    (
        r#"<triangle color="red"><a x="1" y="2" z="3"/><b x="0" y="0" z="1"/><c x="5" y="5" z="5"/>
           </triangle>"#,
        "triangle 1 2 3 0 0 1 5 5 5",
    ),
    (
        r#"<box color="red"><from x="1" y="2" z="3"/><to x="0" y="5" z="4"/></box>"#,
        "box from 0 2 3 to 1 5 4",
    ),
    (r#"<cube color="red" size="2"><point x="1" y="2" z="3"/></cube>"#, "box from 0 1 2 to 2 3 4"),
    (
        r#"<tetrahedron color="red"><a x="0" y="0" z="0"/><b x="1" y="0" z="0"/><c x="0" y="1" z="0"/>
           <d x="0" y="0" z="-1"/></tetrahedron>"#,
        "tetrahedron 0 0 0 1 0 0 0 1 0 0 0 -1",
    ),
    (
        r#"<cylinder color="red" size="2"><base x="1" y="2" z="3"/><top x="1" y="2" z="5"/></cylinder>"#,
        "cylinder base 1 2 3 radius 2 top 1 2 5 radius 2",
    ),
    (
        r#"<cone color="red" size="2" open="true"><base x="1" y="2" z="3"/><top x="1" y="2" z="5"/>
           </cone>"#,
        "cone base 1 2 3 radius 2 top 1 2 5 radius 0 open",
    ),
    (
        r#"<frustum color="red" size="0" top-size="2" open="false"><base x="1" y="2" z="3"/>
           <top x="1" y="2" z="5"/></frustum>"#,
        "cone base 1 2 3 radius 0 top 1 2 5 radius 2",
    ),
    (
        r#"<torus color="red" size="2" tube="0.5"><point x="1" y="2" z="3"/><axis x="0" y="0" z="4"/>
           </torus>"#,
        "torus centre 1 2 3 axis 0 0 4 ring 2 tube 0.5",
    ),
];

#[test]
fn shapes() {
    for (shape, expected) in SHAPES {
        assert_eq!(dump("", shape), format!("{expected} colour #ff0000 gloss 0"), "{shape}");
    }
}

/// Meshes have tests of their own; all others must be above.
#[test]
fn every_shape_of_the_tables_is_tested() {
    for shape in schema::ELEMENTS.iter().filter(|e| e.cells.is_some() && e.name != "mesh") {
        let begin = format!("<{} ", shape.name);
        assert!(SHAPES.iter().any(|(text, _)| text.starts_with(&begin)), "{}", shape.name);
    }
}

fn surface(attributes: &str) -> String {
    surface_of("", attributes)
}

fn surface_of(materials: &str, attributes: &str) -> String {
    let shape =
        format!("<sphere size=\"1\" {attributes}><point x=\"0\" y=\"0\" z=\"0\"/></sphere>");
    let dump = dump(materials, &shape);
    dump.strip_prefix("sphere centre 0 0 0 radius 1 colour ").unwrap_or(&dump).to_owned()
}

#[test]
fn surfaces() {
    for (attributes, expected) in [
        ("color='teal' gloss='0.25'", "#008080 gloss 0.25"),
        ("color='rgb(1, 2, 255)'", "#0102ff gloss 0"),
        ("color='linear(0, 0.5, 1)'", "linear(0, 0.5, 1) gloss 0"),
        ("color='red' chess='default'", "#ff0000 gloss 0 checker #00ffff"),
        ("color='red' chess='none'", "#ff0000 gloss 0"),
        ("color='red' chess='#0a0b0c'", "#ff0000 gloss 0 checker #0a0b0c"),
        (
            "color='red' chess='white' chess-size='45'",
            "#ff0000 gloss 0 checker #ffffff of 1 and 45 degrees",
        ),
        ("gloss='1'", "#ffffff gloss 1"),
        ("transparency='1'", "#ffffff gloss 0 transparency 1 ior 1.5"),
        (
            "color='blue' transparency='0.5' ior='1.33' absorption='0 1.5 2' priority='-3'",
            "#0000ff gloss 0 transparency 0.5 ior 1.33 absorption 0 1.5 2 priority -3",
        ),
        ("transparency='1' thin='true'", "#ffffff gloss 0 transparency 1 ior 1.5 thin"),
        ("transparency='1' thin='false'", "#ffffff gloss 0 transparency 1 ior 1.5"),
        ("color='black' emission='2 0 0.5'", "#000000 gloss 0 emission 2 0 0.5"),
    ] {
        assert_eq!(surface(attributes), expected, "{attributes}");
    }
}

#[test]
fn sizes_of_checkers_are_lengths_or_angles_or_both() {
    let ends = r#"<base x="0" y="0" z="0"/><top x="0" y="0" z="1"/>"#;
    let flat = r#"<origin x="0" y="0" z="0"/><normal x="0" y="0" z="1"/>"#;
    for (shape, expected) in [
        (
            format!(
                "<cylinder size='1' color='red' chess='blue' chess-size='2 20'>{ends}</cylinder>"
            ),
            "of 2 and 20 degrees",
        ),
        (
            format!("<plane color='red' chess='blue' chess-size='0.5'>{flat}</plane>"),
            "of 0.5 and 30 degrees",
        ),
    ] {
        assert!(dump("", &shape).ends_with(expected), "{shape}");
    }
}

#[test]
fn materials_give_what_shapes_leave_out() {
    let materials = r#"<material name="tiles" color="red" gloss="0.5" chess="default"/>
        <material name="glass" transparency="1" ior="1.4" absorption="1 0 0"/>"#;
    let both = |attributes| {
        let glass =
            "<sphere size=\"2\" material=\"glass\"><point x=\"0\" y=\"0\" z=\"0\"/></sphere>";
        let tiles =
            "<sphere size=\"2\" material=\"tiles\"><point x=\"0\" y=\"0\" z=\"0\"/></sphere>";
        let shape = format!("<sphere size='1' {attributes}><point x='0' y='0' z='0'/></sphere>");
        let dump = dump(materials, &format!("{shape}{glass}{tiles}"));
        let line = dump.lines().next().unwrap_or_default();
        line.strip_prefix("sphere centre 0 0 0 radius 1 colour ").unwrap_or(line).to_owned()
    };
    for (attributes, expected) in [
        ("material='tiles'", "#ff0000 gloss 0.5 checker #00ffff"),
        // The complement is that of the shape's own colour.
        ("material='tiles' color='blue' gloss='0'", "#0000ff gloss 0 checker #ffff00"),
        ("material='tiles' chess='none'", "#ff0000 gloss 0.5"),
        (
            "material='tiles' chess-size='90'",
            "#ff0000 gloss 0.5 checker #00ffff of 1 and 90 degrees",
        ),
        ("material='glass'", "#ffffff gloss 0 transparency 1 ior 1.4 absorption 1 0 0"),
        (
            "material='glass' ior='2' color='red' transparency='0.5'",
            "#ff0000 gloss 0 transparency 0.5 ior 2 absorption 1 0 0",
        ),
    ] {
        assert_eq!(both(attributes), expected, "{attributes}");
    }
}

#[test]
fn a_colour_is_asked_for_where_something_is_matte() {
    let lacks = ["<sphere> lacks the attribute `color`".to_owned()];
    let ball = |attributes: &str| {
        messages(&text(
            "<material name='m' gloss='0.5'/>",
            &format!(
                "<sphere size='1' {attributes}><point x='0' y='0' z='0'/></sphere>\
                 <sphere size='1' material='m' color='red'><point x='0' y='0' z='0'/></sphere>"
            ),
        ))
    };
    for attributes in ["", "gloss='0.9'", "material='m'", "transparency='0.5' gloss='0.5'"] {
        assert_eq!(ball(attributes), lacks, "{attributes}");
    }
    for attributes in ["gloss='1'", "transparency='1'", "material='m' gloss='1'"] {
        assert!(ball(attributes).is_empty(), "{attributes}");
    }
    // What was meant to be one, or to make one needless, is reported as what it is.
    assert_eq!(ball("colr='red'"), ["unknown attribute `colr` of <sphere>"]);
    assert_eq!(ball("gloss='1.0.0'"), ["`gloss` of <sphere> has something behind its number"]);
}

#[test]
fn what_means_nothing_is_warned_of_once() {
    let shapes = |given: &str, uses: &str| {
        messages(&text(
            &format!("<material name='m' color='red' {given}/>"),
            &uses.replace("BALL", "<point x='0' y='0' z='0'/></sphere>"),
        ))
    };
    let opaque = "<sphere size='1' material='m'>BALL<sphere size='1' material='m'>BALL";
    assert_eq!(
        shapes("ior='2' priority='1'", opaque),
        [
            "warning: `ior` of <material> has no effect",
            "warning: `priority` of <material> has no effect"
        ]
    );
    // It means something for one of the two.
    let one = format!("{opaque}<sphere size='1' material='m' transparency='0.5'>BALL");
    assert!(shapes("ior='2' priority='1'", &one).is_empty());
    let clear = "<sphere size='1' material='m' thin='true'>BALL";
    assert_eq!(
        shapes("transparency='1' thin='true' absorption='1 1 1'", clear),
        ["warning: `absorption` of <material> has no effect"]
    );
    assert!(shapes("transparency='1' absorption='1 1 1'", clear).is_empty());
    assert!(shapes("thin='false'", opaque).is_empty(), "as where it is missing");
}

#[test]
fn children_of_the_world_stand_in_any_order() {
    let parts = [
        CAMERA,
        LIGHTS,
        "<background color='teal'/>",
        "<material name='m' color='red'/>",
        "<define name='d'><sphere material='m' size='1'><point x='0' y='0' z='0'/></sphere></define>",
        "<shapes><use name='d'/></shapes>",
    ];
    let forth = scene(&format!("<world>{}</world>", parts.concat())).to_string();
    let reversed: String = parts.iter().rev().copied().collect();
    assert_eq!(scene(&format!("<world>{reversed}</world>")).to_string(), forth);
}
