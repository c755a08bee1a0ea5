//! `cargo xtask stability --chart`: where methods fail, drawn: the textbook's forms in single
//! and double precision beside Lancer's, judged by exact arithmetic.

mod distance;
mod draw;
mod float;
mod grazing;
mod judge;
mod offset;
mod stable;
mod textbook;

use crate::Failure;
use crate::bench::page::Table;
use draw::Line;
use lancer_tests::paths;

/// Where the charts are.
const FOLDER: &str = "docs/stability";

/// Draws the charts: the section of the page that shows them.
pub(super) fn run() -> Result<String, Failure> {
    let folder = paths::top().join(FOLDER);
    std::fs::create_dir_all(&folder).map_err(crate::fail)?;
    let lines = &Line::ALL[..4];
    let head: Vec<&str> = ["chart"].into_iter().chain(lines.iter().map(|l| l.name())).collect();
    let mut table = Table::new(&head);
    for (name, panels) in [
        ("distance", distance::panels()),
        ("offset", offset::panels()),
        ("grazing", grazing::panels()),
    ] {
        let path = folder.join(format!("{name}.svg"));
        draw::draw(&path, &panels)?;
        println!("wrote {FOLDER}/{name}.svg");
        for panel in &panels {
            let cells = lines.iter().map(|line| match panel.holds_to(*line) {
                None => String::new(),
                Some(None) => "all".to_owned(),
                Some(Some(x)) if x.is_nan() => "none".to_owned(),
                Some(Some(x)) => format!("{x:.0e}"),
            });
            table.row([format!("{}: {}", panel.title, panel.x)].into_iter().chain(cells).collect());
        }
    }
    let text = format!(
        "Up to where the worst error (or the share of wrong answers) stays below a thousandth:\n\n{table}"
    );
    println!("{text}");
    Ok(text)
}

/// Powers of ten in half steps.
fn xs(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let (from, to) = (libm::rint(2.0 * from) as i32, libm::rint(2.0 * to) as i32);
    (from..=to).map(|half| libm::exp10(0.5 * f64::from(half)))
}
