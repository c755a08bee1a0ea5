//! How shapes are put together: groups, definitions and their uses.

use super::names::Names;
use super::reach::Reach;
use super::shapes::shape;
use super::{Node, Out, Scope, coordinates, warn_empty};
use crate::Diagnostic;
use crate::document::start_of;
use crate::element::{Reader, shorten};
use crate::schema::{self, Element};
use crate::values::other_than_0;
use lancer_math::{Placement, Vector};
use lancer_scene::{Degrees, Group, Placed, Shape};
use std::ops::Range;
use std::sync::Arc;

/// A group that several elements may show, and the bounds of what is in it.
#[derive(Debug, Clone)]
struct Shared {
    group: Arc<Group>,
    reach: Reach,
}

/// The definitions of a scene. One with mistakes has its place, and no group.
pub(super) struct Defines<'a> {
    names: Names<'a>,
    groups: Vec<Option<Shared>>,
}

impl Default for Defines<'_> {
    fn default() -> Self {
        Self { names: Names::new("definition"), groups: Vec::new() }
    }
}

impl Defines<'_> {
    /// Reports what turned out to mean nothing.
    pub(super) fn finish(&self, out: Out<'_>) {
        self.names.report_unused(out);
    }
}

/// Reads all definitions, each after those that it uses.
pub(super) fn read_defines<'a>(world: &Reader<'a, '_>, scope: &mut Scope<'a, '_>, out: Out<'_>) {
    let mut readers = Vec::new();
    let mut nameless = Vec::new();
    for (node, element) in world.children() {
        if std::ptr::eq(element, &schema::DEFINE) {
            let reader = Reader::new(node, element, out);
            let named = scope.defines.names.add(&reader, out);
            if named { &mut readers } else { &mut nameless }.push(reader);
        }
    }
    scope.defines.groups = vec![None; readers.len()];
    let uses: Vec<_> = readers.iter().map(|reader| uses_in(reader, &scope.defines.names)).collect();
    for place in in_order(&uses, &scope.defines.names, out) {
        let name = scope.defines.names.name(place).to_owned();
        scope.defines.groups[place] = contents(&readers[place], scope, out)
            .and_then(|contents| contents.group(Some(name), &readers[place], out));
    }
    for reader in &nameless {
        // For what is wrong in them.
        contents(reader, scope, out);
    }
}

/// A use in a definition: the place of what it uses, and where it says so.
type Use = (usize, Range<usize>);

fn uses_in(define: &Reader<'_, '_>, names: &Names<'_>) -> Vec<Use> {
    let uses = define.node.descendants().filter(|node| node.has_tag_name(schema::USE.name));
    uses.filter_map(|node| {
        let name = node.attribute_node("name")?;
        Some((names.place(name.value())?, name.range_value()))
    })
    .collect()
}

/// The definitions in an order in which each comes after those that it uses.
/// Those that use themselves are reported; so are theirs in some order.
fn in_order(uses: &[Vec<Use>], names: &Names<'_>, out: Out<'_>) -> Vec<usize> {
    #[derive(Clone, Copy, PartialEq)]
    enum State {
        New,
        Open,
        Done,
    }
    let mut states = vec![State::New; uses.len()];
    let mut order = Vec::with_capacity(uses.len());
    // The way to where we are: definitions, and how many of the uses in each
    // have been followed. A list, since it may be longer than the stack is deep.
    let mut way: Vec<(usize, usize)> = Vec::new();
    for start in 0..uses.len() {
        if states[start] == State::New {
            states[start] = State::Open;
            way.push((start, 0));
        }
        while let Some((place, followed)) = way.last_mut() {
            let place = *place;
            let Some((next, span)) = uses[place].get(*followed) else {
                states[place] = State::Done;
                order.push(place);
                way.pop();
                continue;
            };
            *followed += 1;
            match states[*next] {
                State::New => {
                    states[*next] = State::Open;
                    way.push((*next, 0));
                }
                State::Open => {
                    let first = way.iter().position(|(open, _)| open == next).unwrap_or(0);
                    let round: Vec<_> =
                        way[first..].iter().map(|(p, n)| (*p, &uses[*p][n - 1].1)).collect();
                    out.push(cycle(&round, span, names));
                }
                State::Done => {}
            }
        }
    }
    order
}

/// What to say of definitions of which each uses the next one and the last one,
/// at `span`, the first.
fn cycle(round: &[(usize, &Range<usize>)], span: &Range<usize>, names: &Names<'_>) -> Diagnostic {
    const MOST_NAMED: usize = 4;
    let name = |place: usize| format!("`{}`", shorten(names.name(place)));
    let (first, first_use) = &round[0];
    let mut through: Vec<_> =
        round[1..].iter().take(MOST_NAMED).map(|(place, _)| name(*place)).collect();
    if round.len() - 1 > MOST_NAMED {
        through.push("...".to_owned());
    }
    let through = match through.is_empty() {
        true => String::new(),
        false => format!(" through {}", through.join(", ")),
    };
    let diagnostic = Diagnostic::error(
        span.clone(),
        format!("the definition {} uses itself{through}", name(*first)),
        format!("expected anything but {}", name(*first)),
    )
    .help("what is in a definition must come to an end".to_owned());
    match round.len() {
        1 => diagnostic,
        _ => diagnostic.related((*first_use).clone(), "this leads there"),
    }
}

/// What is in `<shapes>`.
pub(super) fn shapes<'a>(
    reader: &Reader<'a, '_>,
    scope: &mut Scope<'a, '_>,
    out: Out<'_>,
) -> (Vec<Shape>, Vec<Placed>) {
    let Some(contents) = contents(reader, scope, out) else { return Default::default() };
    let Contents { shapes, groups, .. } = contents;
    // As deep and as many as a scene may have: it counts as a group.
    let inside = groups.iter().map(|placed| placed.group.shape_count());
    let count = inside.fold(shapes.len() as u64, u64::saturating_add);
    if count > Group::MOST_SHAPES || Group::new(None, Vec::new(), groups.clone()).is_err() {
        out.push(too_much(reader, "<shapes>", count));
    }
    (shapes, groups)
}

/// What a group, a definition or a scene holds.
struct Contents {
    shapes: Vec<Shape>,
    groups: Vec<Placed>,
    reach: Reach,
    placement: Placement,
}

impl Contents {
    /// As one group, which `reader` describes.
    fn group(self, name: Option<String>, reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Shared> {
        let inside = self.groups.iter().map(|placed| placed.group.shape_count());
        let count = inside.fold(self.shapes.len() as u64, u64::saturating_add);
        let what = match &name {
            Some(name) => format!("the definition `{}`", shorten(name)),
            None => format!("<{}>", reader.name()),
        };
        match Group::new(name, self.shapes, self.groups) {
            Ok(group) => Some(Shared { group: Arc::new(group), reach: self.reach }),
            Err(_) => {
                out.push(too_much(reader, &what, count));
                None
            }
        }
    }
}

fn too_much(reader: &Reader<'_, '_>, what: &str, count: u64) -> Diagnostic {
    // The scene itself counts as a level.
    let (most, deepest) = (Group::MOST_SHAPES, Group::DEEPEST - 1);
    if count > most {
        Diagnostic::error(
            reader.start(),
            format!("{what} shows {count} shapes"),
            format!("expected at most {most}, counted as often as they are shown"),
        )
        .help("a mesh counts as one shape, however many triangles it has".to_owned())
    } else {
        Diagnostic::error(
            reader.start(),
            format!("groups are nested too deeply in {what}"),
            format!("expected groups and uses at most {deepest} levels deep"),
        )
    }
}

/// All that is in an element, as it is placed; `None` where the placement is
/// wrong. What has mistakes is left out.
fn contents<'a>(
    reader: &Reader<'a, '_>,
    scope: &mut Scope<'a, '_>,
    out: Out<'_>,
) -> Option<Contents> {
    let (mut shapes, mut groups) = (Vec::new(), Vec::new());
    let (mut reach, mut placement) = (Reach::SHAPE, Some(Placement::IDENTITY));
    let mut empty = true;
    for (node, element) in reader.children() {
        if is_transform(element) {
            let step = transform(&Reader::new(node, element, out), out);
            placement = then(placement, step, node, out);
            continue;
        }
        empty = false;
        let placed = match element.name {
            "group" => group(&Reader::new(node, element, out), scope, out),
            "use" => used(&Reader::new(node, element, out), scope, out),
            _ => {
                shapes.extend(shape(node, element, scope, out));
                continue;
            }
        };
        if let Some((placed, inside)) = placed {
            reach = reach.and(inside);
            groups.push(placed);
        }
    }
    if empty {
        warn_empty(reader, "there is nothing to be seen", out);
    }
    Some(Contents { shapes, groups, reach, placement: placement? })
}

fn group<'a>(
    reader: &Reader<'a, '_>,
    scope: &mut Scope<'a, '_>,
    out: Out<'_>,
) -> Option<(Placed, Reach)> {
    let contents = contents(reader, scope, out)?;
    let placement = contents.placement;
    let shared = contents.group(None, reader, out)?;
    place(placement, shared, reader, out)
}

fn used<'a>(
    reader: &Reader<'a, '_>,
    scope: &mut Scope<'a, '_>,
    out: Out<'_>,
) -> Option<(Placed, Reach)> {
    let mut placement = Some(Placement::IDENTITY);
    for (node, element) in reader.children() {
        let step = transform(&Reader::new(node, element, out), out);
        placement = then(placement, step, node, out);
    }
    let define = scope.defines.names.find(reader, "name", out)?;
    let shared = scope.defines.groups[define].clone()?;
    place(placement?, shared, reader, out)
}

fn place(
    placement: Placement,
    shared: Shared,
    reader: &Reader<'_, '_>,
    out: Out<'_>,
) -> Option<(Placed, Reach)> {
    // Groups of groups of nothing could be without end.
    if shared.group.shape_count() == 0 {
        return None;
    }
    let placed = Placed { placement, group: shared.group };
    let reach = shared.reach.placed(&placed);
    if reach.is_finite() {
        return Some((placed, reach));
    }
    out.push(Diagnostic::error(
        reader.start(),
        format!(
            "the transforms of <{}> and those in it multiply to numbers that are not finite",
            reader.name()
        ),
        "expected factors and distances that numbers can hold together",
    ));
    None
}

fn is_transform(element: &'static Element) -> bool {
    schema::TRANSFORMS.iter().any(|child| std::ptr::eq(child.element, element))
}

/// First one placement, then a step further; `None` where either is wrong.
fn then(
    placement: Option<Placement>,
    step: Option<Placement>,
    node: Node<'_, '_>,
    out: Out<'_>,
) -> Option<Placement> {
    let next = placement?.then(&step?);
    if next.is_finite() {
        return Some(next);
    }
    let name = node.tag_name().name();
    out.push(Diagnostic::error(
        start_of(&node),
        format!("<{name}> and the transforms before it multiply to numbers that are not finite"),
        "expected factors and distances that numbers can hold together",
    ));
    None
}

/// What one transform does.
fn transform(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Placement> {
    match reader.name() {
        "translate" => coordinates(reader, out).map(|xyz| Placement::translate(Vector::from(xyz))),
        "rotate" => rotate(reader, out),
        "scale" => scale(reader, out),
        _ => matrix(reader, out),
    }
}

fn rotate(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Placement> {
    let axis = coordinates(reader, out);
    let angle = reader.number("angle", Degrees::new, out);
    if axis == Some([0.0; 3]) {
        out.push(Diagnostic::error(
            reader.start(),
            "the axis of <rotate> is (0, 0, 0)",
            "expected a vector other than zero",
        ));
        return None;
    }
    Placement::rotate(Vector::from(axis?), angle?.get())
}

fn scale(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Placement> {
    let [by, x, y, z] = ["by", "x", "y", "z"].map(|name| reader.number(name, other_than_0, out));
    let factors = match reader.has("by") {
        true => Vector::repeat(by?),
        false => Vector::new(x?, y?, z?),
    };
    Placement::scale(factors)
}

fn matrix(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Placement> {
    let numbers: [f64; 12] = reader.numbers("rows", |_, value| Ok(value), out)?;
    let row = |at: usize| [numbers[at], numbers[at + 1], numbers[at + 2], numbers[at + 3]];
    let placement = Placement::from_rows([row(0), row(4), row(8)]);
    if placement.is_none() {
        out.push(
            Diagnostic::error(
                reader.span_of("rows"),
                "`rows` of <matrix> flatten space",
                "expected a matrix that has an inverse",
            )
            .help(
                "the first three numbers of each row are a matrix whose determinant is not 0"
                    .to_owned(),
            ),
        );
    }
    placement
}
