//! What each exact shortcut gains: without it against with all, in turn.

use super::clock::{in_turn, number};
use super::page::{Section, Table};
use super::{BenchArgs, WHITTED, picture, same_bits, scene, sized};
use crate::{Failure, fail};
use lancer_film::Film;
use lancer_integrator::{Classic, Culling, Engine, KernelSettings};
use lancer_scene::Scene;
use std::cell::OnceCell;

pub(super) const TITLE: &str = "What each shortcut gains";

pub(super) fn measure(args: &BenchArgs) -> Result<Section, Failure> {
    let mut section = Section::new(TITLE);
    let pictures: [(&str, &str, [u32; 2], &dyn Engine); 4] = [
        ("README, classic", "readme.xml", [2000, 1500], &Classic),
        ("README, whitted", "readme.xml", [2000, 1500], &WHITTED),
        ("glass, whitted", "glass.xml", [800, 600], &WHITTED),
        ("meshes, whitted", "meshes.xml", [720, 480], &WHITTED),
    ];
    section.add(
        "Milliseconds of rendering on one thread with the widest lanes and every shortcut, and how many times longer it takes without one \
         of them, and without any. The films were the same to the last bit.",
    );
    let mut ways = vec![("with all, ms", Culling::ALL)];
    ways.extend(Culling::without_each());
    ways.push(("without any", Culling::NONE));

    let mut head = vec!["without"];
    head.extend(pictures.iter().map(|(name, ..)| name));
    let mut rows: Vec<Vec<String>> =
        ways.iter().map(|(name, _)| vec![(*name).to_owned()]).collect();
    for (name, file, [width, height], engine) in pictures {
        let scene = sized(&scene(file)?, width, height)?;
        let column = column(&scene, engine, &ways, args.runs())
            .map_err(|failure| fail(format_args!("{name}: {failure}")))?;
        for (row, cell) in rows.iter_mut().zip(column) {
            row.push(cell);
        }
    }
    let mut table = Table::new(&head);
    rows.into_iter().for_each(|row| table.row(row));
    section.add(table);
    Ok(section)
}

/// A cell for each of `ways`, the first of which is what the others are
/// compared with.
fn column(
    scene: &Scene,
    engine: &dyn Engine,
    ways: &[(&str, Culling)],
    runs: usize,
) -> Result<Vec<String>, Failure> {
    let first: OnceCell<Film> = OnceCell::new();
    let samples = in_turn(runs, ways, |(name, culling)| {
        let kernel = KernelSettings { culling: *culling, ..KernelSettings::default() };
        let (seconds, film) = picture(scene, engine, kernel, 1)?;
        if !same_bits(first.get_or_init(|| film.clone()), &film) {
            return Err(fail(format_args!("the film differs in the row {name}")));
        }
        Ok(seconds)
    })?;
    let with_all = &samples[0];
    let ratios = samples[1..].iter().map(|without| number(without.times(with_all)));
    Ok(std::iter::once(with_all.milliseconds()).chain(ratios).collect())
}
