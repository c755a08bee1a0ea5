//! Where the points of shapes are.

use super::{Node, Out, Scope, direction, position, surface};
use crate::Diagnostic;
use crate::element::{Reader, listed};
use crate::schema::{self, Element};
use crate::values::at_least_0;
use lancer_scene::{
    Cone, Cuboid, Disc, Geometry, Length, OutOfRange, Plane, Position, Rectangle, Shape, Sphere,
    Tetrahedron, Torus, Triangle,
};

/// The shape that an element describes, if it is valid.
pub(super) fn shape<'a>(
    node: Node<'a, '_>,
    element: &'static Element,
    scope: &mut Scope<'a, '_>,
    out: Out<'_>,
) -> Option<Shape> {
    let reader = &Reader::new(node, element, out);
    let surface = surface::surface(reader, &mut scope.materials, out);
    let geometry = match element.name {
        "sphere" => sphere(reader, out),
        "plane" => plane(reader, out),
        "disc" => disc(reader, out),
        "rectangle" => rectangle(reader, out),
        "triangle" => triangle(reader, out),
        "box" => cuboid(reader, out),
        "cube" => cube(reader, out),
        "tetrahedron" => tetrahedron(reader, out),
        "cylinder" => cylinder(reader, out),
        "cone" => cone(reader, out),
        "frustum" => frustum(reader, out),
        "torus" => torus(reader, out),
        // A test sees to it that no other is in the table.
        _ => scope.meshes.mesh(reader, out).map(Geometry::Mesh),
    };
    Some(Shape { geometry: geometry?, surface: surface? })
}

fn sphere(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Geometry> {
    let radius = reader.number("size", Length::new, out);
    let centre = position(reader, &schema::POINT, out);
    Some(Geometry::Sphere(Sphere { centre: centre?, radius: radius? }))
}

fn plane(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Geometry> {
    let origin = position(reader, &schema::ORIGIN, out);
    let normal = direction(reader, &schema::NORMAL, out);
    Some(Geometry::Plane(Plane { origin: origin?, normal: normal? }))
}

fn disc(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Geometry> {
    let radius = reader.number("size", Length::new, out);
    let centre = position(reader, &schema::POINT, out);
    let normal = direction(reader, &schema::NORMAL, out);
    Some(Geometry::Disc(Disc { centre: centre?, normal: normal?, radius: radius? }))
}

fn rectangle(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Geometry> {
    let corner = position(reader, &schema::POINT, out);
    let across = direction(reader, &schema::ACROSS, out);
    let upward = direction(reader, &schema::UPWARD, out);
    let rectangle = Rectangle::new(corner?, [across?, upward?]).ok();
    if rectangle.is_none() {
        out.push(
            Diagnostic::error(
                reader.start_of(&schema::UPWARD),
                "the sides of <rectangle> are parallel",
                "expected another direction than that of <across>",
            )
            .related(reader.start_of(&schema::ACROSS), "the other side is here"),
        );
    }
    rectangle.map(Geometry::Rectangle)
}

fn triangle(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Geometry> {
    let elements = [&schema::A, &schema::B, &schema::C];
    let corners = elements.map(|element| position(reader, element, out));
    let [a, b, c] = corners;
    let corners = [a?, b?, c?];
    match Triangle::new(corners) {
        Ok(triangle) => Some(Geometry::Triangle(triangle)),
        Err(OutOfRange { found, expected }) => {
            degenerate(reader, &elements, &corners, &found, expected, out);
            None
        }
    }
}

fn tetrahedron(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Geometry> {
    let elements = [&schema::A, &schema::B, &schema::C, &schema::D];
    let corners = elements.map(|element| position(reader, element, out));
    let [a, b, c, d] = corners;
    let corners = [a?, b?, c?, d?];
    match Tetrahedron::new(corners) {
        Ok(tetrahedron) => Some(Geometry::Tetrahedron(tetrahedron)),
        Err(OutOfRange { found, expected }) => {
            degenerate(reader, &elements, &corners, &found, expected, out);
            None
        }
    }
}

/// Reports corners that span too little, and two that are the same point, if
/// that is why.
fn degenerate(
    reader: &Reader<'_, '_>,
    elements: &[&'static Element],
    corners: &[Position],
    found: &str,
    expected: &str,
    out: Out<'_>,
) {
    let name = reader.name();
    for (i, second) in corners.iter().enumerate() {
        if let Some(k) = corners[..i].iter().position(|first| first == second) {
            let (first, second) = (elements[k], elements[i]);
            out.push(
                Diagnostic::error(
                    reader.start_of(second),
                    format!("two corners of <{name}> are the same point"),
                    format!("expected a point other than <{}>", first.name),
                )
                .related(reader.start_of(first), "the same point is here"),
            );
            return;
        }
    }
    out.push(Diagnostic::error(
        reader.start(),
        format!("the corners of <{name}> are {found}"),
        format!("expected {expected}"),
    ));
}

fn cuboid(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Geometry> {
    let from = position(reader, &schema::FROM, out);
    let to = position(reader, &schema::TO, out);
    let (from, to) = (from?, to?);
    let cuboid = Cuboid::new(from, to);
    if cuboid.is_err() {
        let same = (0..3).filter(|axis| from.get()[*axis] == to.get()[*axis]);
        let axes: Vec<_> = same.map(|axis| ["x", "y", "z"][axis].to_owned()).collect();
        let flat = axes.len() == 1;
        out.push(
            Diagnostic::error(
                reader.start_of(&schema::TO),
                format!("the corners of <box> have the same {}", listed(&axes, "and")),
                "expected a corner that differs in all coordinates",
            )
            .related(reader.start_of(&schema::FROM), "the other corner is here")
            .help(flat.then(|| "a box without height is a <rectangle>".to_owned())),
        );
    }
    cuboid.ok().map(Geometry::Cuboid)
}

fn cube(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Geometry> {
    let side = reader.number("size", Length::new, out);
    let centre = position(reader, &schema::POINT, out);
    let (half, centre) = (side?.get() / 2.0, centre?.get());
    let from = Position::new([centre.x - half, centre.y - half, centre.z - half]);
    let to = Position::new([centre.x + half, centre.y + half, centre.z + half]);
    let problem = match (from, to) {
        (Ok(from), Ok(to)) => match Cuboid::new(from, to) {
            Ok(cuboid) => return Some(Geometry::Cuboid(cuboid)),
            Err(_) => "is lost in the rounding of its corners",
        },
        _ => "puts corners out of the range of numbers",
    };
    out.push(
        Diagnostic::error(
            reader.span_of("size"),
            format!("`size` of <cube> {problem}"),
            "expected a size nearer to the coordinates of its middle",
        )
        .related(reader.start_of(&schema::POINT), "its middle is here"),
    );
    None
}

fn cylinder(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Geometry> {
    let radius = reader.number("size", Length::new, out).map(Length::get);
    between_ends(reader, radius, radius, out)
}

fn cone(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Geometry> {
    let radius = reader.number("size", Length::new, out).map(Length::get);
    between_ends(reader, radius, Some(0.0), out)
}

fn frustum(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Geometry> {
    let radius = reader.number("size", at_least_0, out);
    let top_radius = reader.number("top-size", at_least_0, out);
    if (radius, top_radius) == (Some(0.0), Some(0.0)) {
        out.push(
            Diagnostic::error(
                reader.span_of("size"),
                "both radii of <frustum> are 0",
                "expected one of them to be greater than 0",
            )
            .related(reader.span_of("top-size"), "the other one is here"),
        );
        // Its ends may be wrong, too.
        between_ends(reader, None, None, out);
        return None;
    }
    between_ends(reader, radius, top_radius, out)
}

fn between_ends(
    reader: &Reader<'_, '_>,
    base_radius: Option<f64>,
    top_radius: Option<f64>,
    out: Out<'_>,
) -> Option<Geometry> {
    let open = reader.flag("open", out).unwrap_or(false);
    let base = position(reader, &schema::BASE, out);
    let top = position(reader, &schema::TOP, out);
    let (base, top) = (base?, top?);
    if base == top {
        let is_cylinder = std::ptr::eq(reader.element, &schema::CYLINDER);
        out.push(
            Diagnostic::error(
                reader.start_of(&schema::TOP),
                format!("the ends of <{}> are the same point", reader.name()),
                "expected a point other than the base",
            )
            .related(reader.start_of(&schema::BASE), "the base is here")
            .help(is_cylinder.then(|| "a cylinder without height is a <disc>".to_owned())),
        );
        return None;
    }
    Cone::new((base, base_radius?), (top, top_radius?), open).ok().map(Geometry::Cone)
}

fn torus(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Geometry> {
    let ring = reader.number("size", Length::new, out);
    let tube = reader.number("tube", Length::new, out);
    let centre = position(reader, &schema::POINT, out);
    let axis = direction(reader, &schema::AXIS, out);
    let (ring, tube) = (ring?, tube?);
    if tube > ring {
        out.push(
            Diagnostic::error(
                reader.span_of("tube"),
                format!("`tube` of <torus> is {}, and `size` {}", tube.get(), ring.get()),
                "expected at most the radius of the ring",
            )
            .related(reader.span_of("size"), "the radius of the ring")
            .help("a wider tube would run into itself in the middle".to_owned()),
        );
        return None;
    }
    Torus::new(centre?, axis?, ring, tube).ok().map(Geometry::Torus)
}
