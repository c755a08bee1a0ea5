//! Meshes: rays per second, and Embree on the same rays.

use super::BenchArgs;
use super::clock::{Samples, in_turn, number, seconds};
use super::embree::Embree;
use super::judge::Judgement;
use super::page::{Section, Table};
use super::rays::{self, View};
use crate::{Failure, fail};
use lancer_kernel::{Hit, Prepared};
use lancer_math::{Bounds, Ray, Vector};
use lancer_mesh::MeshFormat;
use lancer_scene::Mesh;
use lancer_tests::{generated, room};
use std::path::Path;

pub(super) const TITLE: &str = "Triangles";

/// The pixels of primary rays.
const PIXELS: [u32; 2] = [1024, 1024];

/// A mesh and where it is looked at from.
struct Subject {
    name: String,
    mesh: Mesh,
    view: View,
}

/// Rays of a kind.
struct Class {
    name: &'static str,
    rays: Vec<Ray>,
}

/// Works that take turns.
struct Work<'a> {
    class: &'a Class,
    query: &'static str,
    /// Embree's mode; without one it is our turn.
    mode: Option<&'static str>,
}

pub(super) fn measure(args: &BenchArgs) -> Result<Section, Failure> {
    let mut section = Section::new(TITLE);
    section.add(
        "Millions of rays per second on one thread with the widest lanes. Primary rays are those of 1024x1024 pixels; bounce rays leave what \
         they met as a matte surface scatters light, and are shuffled. All coordinates are numbers of single precision, the same for \
         both programs; each answers ray by ray in the order given. Embree tests triangles in single precision, in its fast mode \
         without closing the gaps at edges.",
    );
    let mut embree = match Embree::start() {
        Ok(embree) => Some(embree),
        Err(missing) => {
            section.add(format_args!("Embree was not measured: {missing}."));
            None
        }
    };
    let mut head = vec!["mesh", "rays", "query", "Lancer"];
    let mut judged = Table::new(&[
        "mesh",
        "rays",
        "Embree",
        "differ",
        "only Lancer's",
        "only Embree's",
        "at edges",
        "at the same distance",
        "else",
        "the farthest from an edge",
    ]);
    if embree.is_some() {
        head.extend(["robust", "fast", "times robust", "times fast"]);
    }
    let (mut speeds, mut builds) = (
        Table::new(&head),
        Table::new(&[
            "mesh",
            "triangles",
            "Lancer, 1 thread",
            "2 threads",
            "bytes a triangle, in all",
            "Embree, robust, all threads",
        ]),
    );
    for subject in subjects(&mut section)? {
        one(&subject, args.runs(), embree.as_mut(), (&mut speeds, &mut builds, &mut judged))?;
    }
    section.add(speeds);
    section.add("Building, in millions of triangles per second:");
    section.add(builds);
    if embree.is_some() {
        section.add(
            "Rays whose nearest triangles are not the same ones: how many have a hit in one program alone; and why, in this order: the ray \
             passes an edge of one of the triangles within 16 roundings of single precision (relative to the farthest coordinate); both \
             hits are as near to one another; neither, and then how far from an edge, in roundings.",
        );
        section.add(judged);
    }
    Ok(section)
}

/// The room, and the meshes that `LANCER_MESHES` has.
fn subjects(section: &mut Section) -> Result<Vec<Subject>, Failure> {
    let mut subjects = Vec::new();
    match std::env::var_os("LANCER_MESHES") {
        None => section.add(
            "Bunny and dragon were not measured: LANCER_MESHES does not name a folder with stanford-bunny.obj and dragon_vrip.ply.",
        ),
        Some(folder) => {
            for (name, file) in [("bunny", "stanford-bunny.obj"), ("dragon", "dragon_vrip.ply")] {
                let mesh = in_single_precision(&read(&Path::new(&folder).join(file))?)?;
                let from = Vector::new(0.4, 0.3, 1.0);
                let view = View::outside(&bounds(&mesh), from, Vector::y());
                subjects.push(Subject { name: name.to_owned(), mesh, view });
            }
        }
    }
    let mesh = in_single_precision(&room::room())?;
    let view = inside(&bounds(&mesh));
    subjects.push(Subject { name: "room".to_owned(), mesh, view });
    Ok(subjects)
}

/// From one end of the room to the other.
fn inside(room: &Bounds) -> View {
    let at = |part: [f64; 3]| room.min + (room.max - room.min).component_mul(&Vector::from(part));
    View { eye: at([0.04, 0.5, 0.4]), target: at([0.9, 0.4, 0.45]), up: Vector::z(), width: 1.4 }
}

fn read(path: &Path) -> Result<Mesh, Failure> {
    let of = |e: &dyn std::fmt::Display| fail(format_args!("{}: {e}", path.display()));
    let bytes = std::fs::read(path).map_err(|e| of(&e))?;
    let format = MeshFormat::from_name(&path.to_string_lossy());
    let format = format.ok_or_else(|| of(&"not a name of a mesh"))?;
    lancer_mesh::load(&bytes, format, None).map_err(|e| of(&e))
}

/// The same triangles with corners that other programs can have, too.
fn in_single_precision(mesh: &Mesh) -> Result<Mesh, Failure> {
    let corners = (0..mesh.triangle_count()).flat_map(|triangle| mesh.corners(triangle));
    let mut positions: Vec<[f32; 3]> =
        corners.map(|corner| [corner.x as f32, corner.y as f32, corner.z as f32]).collect();
    let order = |a: &[f32; 3], b: &[f32; 3]| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal);
    let all = positions.clone();
    positions.sort_by(order);
    positions.dedup();
    let index = |p: &[f32; 3]| positions.partition_point(|q| order(q, p).is_lt()) as u32;
    let triangles = all.chunks_exact(3).map(|t| [index(&t[0]), index(&t[1]), index(&t[2])]);
    let triangles = triangles.collect();
    Mesh::new(positions.iter().map(|p| p.map(f64::from)).collect(), triangles).map_err(fail)
}

fn bounds(mesh: &Mesh) -> Bounds {
    let (min, max) = mesh.bounds();
    Bounds { min, max }
}

fn one(
    subject: &Subject,
    runs: usize,
    mut embree: Option<&mut Embree>,
    (speeds, builds, judged): (&mut Table, &mut Table, &mut Table),
) -> Result<(), Failure> {
    let Subject { name, mesh, view } = subject;
    let scene = generated::of_mesh(mesh.clone()).map_err(fail)?;
    let threads = [1, 2].map(|n| rayon::ThreadPoolBuilder::new().num_threads(n).build());
    let [one, two] = threads;
    let pools = [one.map_err(fail)?, two.map_err(fail)?];
    let built =
        in_turn(runs, &pools, |pool| Ok(pool.install(|| seconds(|| Prepared::new(&scene))).0))?;
    let prepared = Prepared::new(&scene);
    let count = mesh.triangle_count();
    let theirs = embree.as_mut().map(|embree| embree.mesh(mesh)).transpose()?;
    builds.row(vec![
        name.clone(),
        count.to_string(),
        built[0].millions(count),
        built[1].millions(count),
        ((prepared.bytes() + mesh.bytes()) / count.max(1)).to_string(),
        theirs.map_or_else(|| "-".to_owned(), |seconds| number(count as f64 / seconds / 1e6)),
    ]);

    let primary = view.rays(PIXELS);
    let bounds = bounds(mesh);
    // So far off that single precision keeps the side.
    let lift = (bounds.max - bounds.min).norm() / 16384.0;
    let bounces = rays::bounces(&prepared, &primary, lift);
    let classes =
        [Class { name: "primary", rays: primary }, Class { name: "bounce", rays: bounces }];
    if let Some(embree) = embree.as_mut() {
        for class in &classes {
            embree.rays(class.name, &class.rays)?;
        }
    }
    let modes: &[Option<&str>] =
        if embree.is_some() { &[None, Some("robust"), Some("fast")] } else { &[None] };
    for class in &classes {
        let mut hits: Vec<Option<Hit>> = vec![None; class.rays.len()];
        let mut answers = vec![false; class.rays.len()];
        for query in ["nearest", "any"] {
            let works: Vec<_> = modes.iter().map(|&mode| Work { class, query, mode }).collect();
            let samples = in_turn(runs, &works, |work| match (work.mode, embree.as_mut()) {
                (Some(mode), Some(embree)) => embree.seconds(mode, work.query, work.class.name),
                _ if work.query == "any" => {
                    Ok(seconds(|| rays::any(&prepared, &class.rays, &mut answers)).0)
                }
                _ => Ok(seconds(|| rays::nearest(&prepared, &class.rays, &mut hits)).0),
            })?;
            speeds.row(speeds_row(name, class, query, &samples));
        }
        if let Some((ray, _)) = class
            .rays
            .iter()
            .zip(&hits)
            .zip(&answers)
            .map(|((r, h), a)| (r, h.is_some() != *a))
            .find(|(_, differ)| *differ)
        {
            return Err(fail(format_args!(
                "{name}: {ray:?} has a nearest hit, but none, or the reverse"
            )));
        }
        if let Some(embree) = embree.as_mut() {
            for mode in ["robust", "fast"] {
                let theirs = embree.hits(mode, class.name)?;
                let judgement = Judgement::new(mesh, &class.rays, &hits, &theirs);
                judged.row(judged_row(name, class, mode, &judgement));
            }
        }
    }
    Ok(())
}

fn speeds_row(mesh: &str, class: &Class, query: &str, samples: &[Samples]) -> Vec<String> {
    let mut row = vec![mesh.to_owned(), class.name.to_owned(), query.to_owned()];
    row.extend(samples.iter().map(|samples| samples.millions(class.rays.len())));
    row.extend(samples[1..].iter().map(|theirs| number(theirs.times(&samples[0]))));
    row
}

fn judged_row(mesh: &str, class: &Class, mode: &str, found: &Judgement) -> Vec<String> {
    let counts = [
        found.differing,
        found.ours_alone,
        found.theirs_alone,
        found.at_edges,
        found.at_same_distance,
        found.unexplained(),
    ];
    let rays = format!("{} {}", found.rays, class.name);
    let mut row = vec![mesh.to_owned(), rays, mode.to_owned()];
    row.extend(counts.iter().map(ToString::to_string));
    row.push(if found.unexplained() == 0 { "-".to_owned() } else { number(found.farthest) });
    row
}
