//! The rays of a pixel as JSON. The fields are described in the manual.

use super::Explained;
use lancer_integrator::{InMedium, LightAnswer, LightFate, MetSurface, NamedShape, TracedRay};
use serde::Serialize;

type Triple = [f64; 3];

#[derive(Serialize)]
struct Tree<'a> {
    version: &'static str,
    scene: &'a str,
    width: u32,
    height: u32,
    pixel: [u32; 2],
    cutoff: f64,
    radiance: [f32; 3],
    sum: Triple,
    exposure: Option<f64>,
    shown: Option<[u8; 3]>,
    rays: Vec<Ray<'a>>,
}

#[derive(Serialize)]
struct Ray<'a> {
    parent: Option<usize>,
    children: &'a [usize],
    kind: &'static str,
    fate: &'static str,
    depth: u32,
    origin: Triple,
    direction: Triple,
    share: Triple,
    left: Triple,
    medium: Medium<'a>,
    distance: Option<f64>,
    contribution: Triple,
    background: Option<Triple>,
    surfaces: Vec<Surface<'a>>,
}

#[derive(Serialize)]
struct Medium<'a> {
    shape: Option<Shape<'a>>,
    ior: f64,
}

#[derive(Serialize)]
struct Shape<'a> {
    number: u32,
    item: u32,
    kind: &'a str,
}

#[derive(Serialize)]
struct Surface<'a> {
    shape: Shape<'a>,
    point: Triple,
    normal: Triple,
    from_behind: bool,
    albedo: Triple,
    cell: Option<[f64; 2]>,
    glow: Triple,
    lights: Vec<Light<'a>>,
}

#[derive(Serialize)]
struct Light<'a> {
    light: usize,
    fate: &'static str,
    arrives: Triple,
    hidden_by: Option<Shape<'a>>,
    contribution: Triple,
    shadow: Option<Shadow>,
}

#[derive(Serialize)]
struct Shadow {
    origin: Triple,
    direction: Triple,
    length: Option<f64>,
}

/// All rays. What is no finite number is null.
pub(super) fn json(explained: &Explained) -> String {
    let Explained { name, frame, cutoff, tree, shown, .. } = explained;
    let tree = Tree {
        version: env!("CARGO_PKG_VERSION"),
        scene: name,
        width: frame.width,
        height: frame.height,
        pixel: tree.pixel,
        cutoff: *cutoff,
        radiance: tree.radiance,
        sum: tree.sum(),
        exposure: shown.as_ref().map(|shown| shown.stops),
        shown: shown.as_ref().map(|shown| shown.codes),
        rays: tree.rays.iter().map(ray).collect(),
    };
    // Names and numbers can always be written.
    let mut text = serde_json::to_string_pretty(&tree).unwrap_or_default();
    text.push('\n');
    text
}

fn ray(ray: &TracedRay) -> Ray<'_> {
    let InMedium { shape: solid, ior } = &ray.medium;
    Ray {
        parent: ray.parent,
        children: &ray.children,
        kind: ray.kind.name(),
        fate: ray.fate.name(),
        depth: ray.depth,
        origin: ray.origin,
        direction: ray.direction,
        share: ray.share,
        left: ray.left,
        medium: Medium { shape: solid.as_ref().map(shape), ior: *ior },
        distance: ray.distance,
        contribution: ray.contribution(),
        background: ray.background,
        surfaces: ray.surfaces.iter().map(surface).collect(),
    }
}

fn shape(named: &NamedShape) -> Shape<'_> {
    Shape { number: named.number, item: named.item, kind: &named.kind }
}

fn surface(met: &MetSurface) -> Surface<'_> {
    Surface {
        shape: shape(&met.shape),
        point: met.point,
        normal: met.normal,
        from_behind: met.from_behind,
        albedo: met.albedo,
        cell: met.cell,
        glow: met.glow,
        lights: met.lights.iter().map(light).collect(),
    }
}

fn light(answer: &LightAnswer) -> Light<'_> {
    let (arrives, hidden_by) = match &answer.fate {
        LightFate::Arrives(shares) => (*shares, None),
        LightFate::Hidden(named) => ([0.0; 3], Some(shape(named))),
        _ => ([0.0; 3], None),
    };
    Light {
        light: answer.light,
        fate: answer.fate.name(),
        arrives,
        hidden_by,
        contribution: answer.contribution,
        shadow: answer.shadow.map(|shadow| Shadow {
            origin: shadow.origin,
            direction: shadow.direction,
            length: shadow.length,
        }),
    }
}
