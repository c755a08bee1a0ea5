//! Shapes that no ray is held against.

/// Which of a scene's own shapes, and of the groups that stand in it, are not made ready: all keep
/// their numbers, but it is as if they were not there. Right where no ray can reach them.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Absent {
    /// A mark for each of the scene's own shapes; those after the last mark are there.
    pub shapes: Vec<bool>,
    /// A mark for each placed group of the scene, likewise.
    pub groups: Vec<bool>,
}

impl Absent {
    /// All are there.
    pub const NONE: Self = Self { shapes: Vec::new(), groups: Vec::new() };

    /// Whether the scene's own shape of that number, from 0, is not there.
    #[must_use]
    pub fn has_shape(&self, number: usize) -> bool {
        self.shapes.get(number) == Some(&true)
    }

    /// Whether the scene's own placed group of that number, from 0, is not there.
    #[must_use]
    pub fn has_group(&self, number: usize) -> bool {
        self.groups.get(number) == Some(&true)
    }
}
