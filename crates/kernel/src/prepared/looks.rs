//! What surfaces look like, each kept once however many shapes have it.

use crate::primitive::{Cell, Contact, Primitive, Square};
use lancer_scene::{Colour, Pattern, Surface};
use std::collections::HashMap;

/// A surface with its colours as shares of light.
#[derive(Debug, Clone, Copy)]
pub(super) struct Look {
    pub(super) surface: Surface,
    albedo: [f64; 3],
    /// That of a checker.
    second: [f64; 3],
}

impl Look {
    fn new(surface: &Surface) -> Self {
        let albedo = surface.colour.shares();
        let second = match surface.pattern {
            Pattern::Solid => albedo,
            Pattern::Checker(checker) => checker.second.shares(),
        };
        Self { surface: *surface, albedo, second }
    }

    /// The two colours of its checker; the same where it has none.
    pub(super) const fn albedos(&self) -> [[f64; 3]; 2] {
        [self.albedo, self.second]
    }

    /// The shares of light that are thrown back at a contact, and in which cell of a
    /// checker that is.
    pub(super) fn albedo(
        &self,
        primitive: &dyn Primitive,
        contact: &Contact,
        part: u32,
    ) -> ([f64; 3], [f64; 2]) {
        let Pattern::Checker(checker) = self.surface.pattern else {
            return (self.albedo, [0.0; 2]);
        };
        let Square { cell, index } = primitive.square(contact, part, &checker);
        let albedo = match cell {
            Cell::First => self.albedo,
            Cell::Second => self.second,
            Cell::Mixed => [0, 1, 2].map(|i| (self.albedo[i] + self.second[i]) / 2.0),
        };
        (albedo, index)
    }
}

/// All looks of a scene while they are collected.
#[derive(Default)]
pub(super) struct Looks {
    list: Vec<Look>,
    /// Only looked up, never walked.
    known: HashMap<Key, u32>,
    last: Option<(Surface, u32)>,
}

/// All numbers of a surface, bit by bit.
type Key = [u64; 20];

impl Looks {
    /// The number of a surface's look.
    pub(super) fn number(&mut self, surface: &Surface) -> u32 {
        // Most often that of the shape before.
        if let Some((last, number)) = &self.last
            && last == surface
        {
            return *number;
        }
        let next = self.list.len() as u32;
        let number = *self.known.entry(key(surface)).or_insert(next);
        if number == next {
            self.list.push(Look::new(surface));
        }
        self.last = Some((*surface, number));
        number
    }

    pub(super) fn finish(self) -> Vec<Look> {
        self.list
    }
}

fn key(surface: &Surface) -> Key {
    let (has_checker, second, length, angle) = match surface.pattern {
        Pattern::Solid => (0, [0; 4], 0.0, 0.0),
        Pattern::Checker(checker) => {
            (1, colour(checker.second), checker.length.get(), checker.angle.get())
        }
    };
    let [first, second] = [colour(surface.colour), second];
    let absorption = surface.medium.absorption.get().map(f64::to_bits);
    let emission = surface.emission.get().map(f64::to_bits);
    let whole = (surface.priority as u32 as u64) << 2 | u64::from(surface.thin) << 1 | has_checker;
    [
        first[0],
        first[1],
        first[2],
        first[3],
        second[0],
        second[1],
        second[2],
        second[3],
        length.to_bits(),
        angle.to_bits(),
        surface.gloss.get().to_bits(),
        surface.transparency.get().to_bits(),
        surface.medium.ior.get().to_bits(),
        absorption[0],
        absorption[1],
        absorption[2],
        emission[0],
        emission[1],
        emission[2],
        whole,
    ]
}

fn colour(colour: Colour) -> [u64; 4] {
    match colour {
        Colour::Codes(codes) => {
            let [r, g, b] = codes.map(u64::from);
            [0, r, g, b]
        }
        Colour::Linear(_) => {
            let [r, g, b] = colour.shares().map(f64::to_bits);
            [1, r, g, b]
        }
    }
}
