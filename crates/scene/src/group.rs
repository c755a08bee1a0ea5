use crate::{OutOfRange, Shape};
use lancer_math::Placement;
use std::sync::Arc;

/// Shapes, and groups of shapes, that are placed as one.
#[derive(Debug, Clone)]
pub struct Group {
    name: Option<String>,
    shapes: Vec<Shape>,
    groups: Vec<Placed>,
    shape_count: u64,
    depth: usize,
}

/// A group where it stands. Several may share one group in memory.
#[derive(Debug, Clone)]
pub struct Placed {
    /// From the group's own space to that of what holds it.
    pub placement: Placement,
    /// What is placed.
    pub group: Arc<Group>,
}

impl Group {
    /// How many groups may be nested in one another.
    pub const DEEPEST: usize = 64;

    /// How many shapes a scene may show, those of groups counted as often as
    /// they are placed (a mesh is one shape). Only what is described takes memory;
    /// each that is shown has a number of 32 bits.
    pub const MOST_SHAPES: u64 = 1_000_000_000;

    /// Shapes and groups as one; `name` is for those that are used several
    /// times.
    ///
    /// # Errors
    /// Where groups are nested too deeply, or show too many shapes.
    pub fn new(
        name: Option<String>,
        shapes: Vec<Shape>,
        groups: Vec<Placed>,
    ) -> Result<Self, OutOfRange> {
        let (shape_count, depth) = Self::measure(shapes.len(), &groups)?;
        Ok(Self { name, shapes, groups, shape_count, depth })
    }

    /// How many shapes so many and some groups show together, and how deeply they
    /// are nested.
    pub(crate) fn measure(shapes: usize, groups: &[Placed]) -> Result<(u64, usize), OutOfRange> {
        let inside = groups.iter().map(|placed| placed.group.shape_count);
        let shape_count = inside.fold(shapes as u64, u64::saturating_add);
        let depth = 1 + groups.iter().map(|placed| placed.group.depth).max().unwrap_or(0);
        if depth > Self::DEEPEST {
            return Err(OutOfRange::new(
                format!("nested {depth} levels deep"),
                "groups nested at most 64 levels deep",
            ));
        }
        if shape_count > Self::MOST_SHAPES {
            return Err(OutOfRange::new(
                format!("{shape_count} shapes"),
                "at most 1000000000 shapes, counted as often as they are placed",
            ));
        }
        Ok((shape_count, depth))
    }

    /// Its name, where it was defined to be used several times.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// The shapes in it.
    #[must_use]
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    /// The groups in it.
    #[must_use]
    pub fn groups(&self) -> &[Placed] {
        &self.groups
    }

    /// How many shapes it shows, those of groups inside counted as often as
    /// they are placed.
    #[must_use]
    pub const fn shape_count(&self) -> u64 {
        self.shape_count
    }
}
