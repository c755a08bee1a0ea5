//! Quadratic equations: how many roots they have is decided exactly.

use crate::Number;
use std::cmp::Ordering;

/// a t^2 + 2 b t + c.
#[derive(Clone, Debug)]
pub(crate) struct Quadratic {
    /// The factor of t^2.
    pub(crate) a: Number,
    /// Half the factor of t.
    pub(crate) b: Number,
    /// What is there at t = 0.
    pub(crate) c: Number,
}

/// A place where a quadratic is zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Root {
    /// The smaller or the larger of two.
    OneOfTwo(Side),
    /// Both at once: where the parabola touches zero.
    Double,
    /// That of an equation that is linear after all.
    Only,
}

/// Which of two roots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    /// The smaller one.
    First,
    /// The larger one.
    Second,
}

impl Quadratic {
    /// b^2 - a c: its sign says how many roots there are.
    pub(crate) fn discriminant(&self) -> Number {
        self.b.squared() - &self.a * &self.c
    }

    /// Its roots, in order. None where it is constant, even if it is always 0.
    pub(crate) fn roots(&self) -> Vec<Root> {
        if self.a.is_zero() {
            return if self.b.is_zero() { vec![] } else { vec![Root::Only] };
        }
        match self.discriminant().signum() {
            -1 => vec![],
            0 => vec![Root::Double],
            _ => vec![Root::OneOfTwo(Side::First), Root::OneOfTwo(Side::Second)],
        }
    }

    /// Where a root is.
    pub(crate) fn place(&self, root: &Root, bits: usize) -> Number {
        match root {
            Root::Only => (-&self.c).over(&(&self.b + &self.b), bits),
            Root::Double => (-&self.b).over(&self.a, bits),
            Root::OneOfTwo(side) => {
                // Of b and the root, those of equal sign are added, so nothing
                // cancels; the other root is c over a over this one.
                let spread = self.discriminant().root(bits + 8);
                let positive = self.b.signum() >= 0;
                let sum = if positive { -(&self.b + &spread) } else { &spread - &self.b };
                let far = sum.over(&self.a, bits + 8);
                let near = self.c.over(&sum, bits + 8);
                let (first, second) = if far < near { (far, near) } else { (near, far) };
                match side {
                    Side::First => first.rounded(bits),
                    Side::Second => second.rounded(bits),
                }
            }
        }
    }

    /// d^2 times its value at n / d.
    pub(crate) fn value(&self, n: &Number, d: &Number) -> Number {
        let nd = n * d;
        &self.a * n.squared() + (&nd + &nd) * &self.b + &self.c * d.squared()
    }

    /// How a root compares with n / d, exactly; d is above 0.
    pub(crate) fn compare(&self, root: &Root, n: &Number, d: &Number) -> Ordering {
        // Signs as if a were above 0: at n / d, of the value and of the slope.
        let turn = if self.a.signum() < 0 { -1 } else { 1 };
        let value = self.value(n, d).signum() * turn;
        let slope = (&self.a * n + &self.b * d).signum() * turn;
        match root {
            Root::Only => (-&self.c * d).cmp(&(&self.b * n + &self.b * n)).turned(self.b.signum()),
            Root::Double => 0.cmp(&slope),
            Root::OneOfTwo(side) => match (value, slope, side) {
                (1, -1, _) => Ordering::Greater,
                (1, _, _) => Ordering::Less,
                (0, -1, Side::First) | (0, 1, Side::Second) => Ordering::Equal,
                (_, _, Side::First) => Ordering::Less,
                (_, _, Side::Second) => Ordering::Greater,
            },
        }
    }
}

trait Turned {
    fn turned(self, sign: i32) -> Self;
}

impl Turned for Ordering {
    /// What it becomes where both sides are divided by something of that sign.
    fn turned(self, sign: i32) -> Self {
        if sign < 0 { self.reverse() } else { self }
    }
}
