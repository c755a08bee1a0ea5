//! Shapes that no ray is held against.

/// Which of a scene's own shapes, and of the groups that stand in it, are not made ready: all keep
/// their numbers, but it is as if they were not there. Right where no ray can reach them.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Absent {
    shapes: Vec<bool>,
    groups: Vec<bool>,
}

impl Absent {
    /// All are there.
    pub const NONE: Self = Self { shapes: Vec::new(), groups: Vec::new() };

    /// By a mark for each of the scene's own shapes, and for each of its own placed groups; those
    /// after the last mark are there.
    #[must_use]
    pub fn new(mut shapes: Vec<bool>, mut groups: Vec<bool>) -> Self {
        for marks in [&mut shapes, &mut groups] {
            let last = marks.iter().rposition(|mark| *mark);
            marks.truncate(last.map_or(0, |last| last + 1));
        }
        Self { shapes, groups }
    }

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

    /// The numbers of the shapes that are not there, from 0.
    pub fn shapes(&self) -> impl Iterator<Item = usize> {
        numbers(&self.shapes)
    }

    /// The numbers of the placed groups that are not there, from 0.
    pub fn groups(&self) -> impl Iterator<Item = usize> {
        numbers(&self.groups)
    }
}

fn numbers(marks: &[bool]) -> impl Iterator<Item = usize> {
    marks.iter().enumerate().filter(|(_, mark)| **mark).map(|(number, _)| number)
}
