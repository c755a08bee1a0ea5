//! `cargo xtask stability`: asks many rays and compares the answers with what is
//! exactly so.

mod chart;
mod cost;
mod leaks;
mod page;
mod soak;

use crate::{Failure, fail};
use clap::Args;

/// What to ask.
#[derive(Debug, Args)]
pub(crate) struct StabilityArgs {
    /// Ask so many rays, ordinary ones and such as are made to be difficult, of all kinds of
    /// shapes, by every path through the kernel, and compare with longer numbers
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    rays: Option<u64>,

    /// Send so many rays from inside at closed meshes: some that are made, and spot.obj
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    leaks: Option<u64>,

    /// Draw where methods fail: docs/stability/*.svg
    #[arg(long)]
    chart: bool,

    /// Measure what the forms of the textbook would save (build with --release)
    #[arg(long)]
    cost: bool,

    /// Another seed gives other scenes and rays
    #[arg(long, default_value_t = 1)]
    seed: u64,

    /// Only shapes of this kind
    #[arg(long, value_name = "KIND", requires = "rays", conflicts_with = "write")]
    shape: Option<String>,

    /// Ask one ray again, by the id that its failure was printed with, and tell all about it
    #[arg(long, value_name = "ID", conflicts_with_all = ["rays", "leaks", "write"])]
    replay: Option<String>,

    /// Print a line for each class of rays of each kind, too
    #[arg(long, requires = "rays")]
    classes: bool,

    /// Put the tables into docs/stability.md, in place of those of the same parts
    #[arg(long)]
    write: bool,
}

pub(crate) fn run(args: &StabilityArgs) -> Result<(), Failure> {
    if let Some(id) = &args.replay {
        return soak::again(id);
    }
    if args.rays.is_none() && args.leaks.is_none() && !args.chart && !args.cost {
        return Err(fail(
            "nothing is asked for: --rays N, --leaks N, --chart, --cost or --replay ID",
        ));
    }
    if args.chart {
        let section = chart::run()?;
        if args.write {
            page::write("chart", &section)?;
        }
    }
    if args.cost {
        let section = cost::run()?;
        if args.write {
            page::write("cost", &section)?;
        }
    }
    let mut is_good = true;
    if let Some(rays) = args.rays {
        let write = |section: &str| if args.write { page::write("soak", section) } else { Ok(()) };
        is_good &= soak::run(args, rays, write)?;
    }
    if let Some(rays) = args.leaks {
        let (section, fine) = leaks::run(args, rays)?;
        is_good &= fine;
        if args.write {
            page::write("leaks", &section)?;
        }
    }
    if is_good { Ok(()) } else { Err(fail("not all is as it should be")) }
}
