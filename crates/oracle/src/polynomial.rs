//! Polynomials with exact coefficients, and their real roots by Sturm's theorem
//! (*Mémoire sur la résolution des équations numériques*, 1829): how many there are
//! in an interval is a count of changes of sign, which is exact here.

use crate::Number;
use std::cmp::Ordering;

/// A polynomial: the coefficient of t^k at place k; the last is not 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Polynomial(Vec<Number>);

/// A real root.
#[derive(Clone, Debug)]
pub struct RealRoot {
    /// Where it is, to the bits that were asked for.
    pub place: Number,
    /// The polynomial's sign a little below and a little above.
    pub signs: [i32; 2],
    /// Whether it is one of several that coincide exactly.
    pub multiple: bool,
}

impl Polynomial {
    /// The polynomial with these coefficients, the constant one first.
    #[must_use]
    pub fn new(mut coefficients: Vec<Number>) -> Self {
        while coefficients.last().is_some_and(Number::is_zero) {
            coefficients.pop();
        }
        Self(coefficients)
    }

    fn degree(&self) -> usize {
        self.0.len().saturating_sub(1)
    }

    fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The factor of the highest power; 0 where there is none.
    #[must_use]
    pub fn leading(&self) -> Number {
        self.0.last().cloned().unwrap_or_else(Number::zero)
    }

    /// Its value (Horner's scheme).
    #[must_use]
    pub fn value(&self, t: &Number) -> Number {
        self.0.iter().rev().fold(Number::zero(), |sum, c| sum * t + c)
    }

    /// Its derivative.
    #[must_use]
    pub fn derivative(&self) -> Self {
        let terms = self.0.iter().enumerate().skip(1);
        Self::new(terms.map(|(k, c)| c * Number::from(k as f64)).collect())
    }

    /// The sum with another one.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let count = self.0.len().max(other.0.len());
        let at = |p: &Self, k| p.0.get(k).cloned().unwrap_or_else(Number::zero);
        Self::new((0..count).map(|k| at(self, k) + at(other, k)).collect())
    }

    /// The product with another one.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::new(vec![]);
        }
        let mut product = vec![Number::zero(); self.0.len() + other.0.len() - 1];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] = &product[i + j] + a * b;
            }
        }
        Self::new(product)
    }

    /// The product with a number.
    #[must_use]
    pub fn scaled(&self, factor: &Number) -> Self {
        Self::new(self.0.iter().map(|c| c * factor).collect())
    }

    /// What division by `divisor` leaves of it, times a positive number; and the
    /// quotient, times the same.
    fn divided(&self, divisor: &Self) -> (Self, Self) {
        let lead = divisor.leading();
        let (size, turn) = (lead.abs(), Number::from(lead.signum()));
        let mut rest = self.clone();
        let mut quotient = vec![Number::zero(); self.0.len()];
        while rest.0.len() >= divisor.0.len() && !rest.is_zero() {
            let shift = rest.0.len() - divisor.0.len();
            let factor = rest.leading() * &turn;
            for c in &mut quotient {
                *c = &*c * &size;
            }
            quotient[shift] = &quotient[shift] + &factor;
            let mut next: Vec<Number> = rest.0.iter().map(|c| c * &size).collect();
            for (k, c) in divisor.0.iter().enumerate() {
                next[shift + k] = &next[shift + k] - c * &factor;
            }
            // Its highest power is gone by construction.
            next.pop();
            rest = Self::new(next);
        }
        (Self::new(quotient), rest)
    }

    /// It, its derivative, and then always minus what the division of the last two
    /// but one by the last leaves.
    fn chain(&self) -> Vec<Self> {
        let mut chain = vec![self.clone(), self.derivative()];
        while let [.., a, b] = &chain[..] {
            if b.is_zero() {
                chain.pop();
                break;
            }
            let rest = a.divided(b).1;
            chain.push(rest.scaled(&Number::from(-1)));
        }
        chain
    }

    /// A power of two that all its roots are smaller than, in size (Cauchy).
    fn bound(&self) -> Number {
        let lead = self.leading();
        let rest = &self.0[..self.0.len() - 1];
        let largest = rest.iter().map(Number::abs).max().unwrap_or_else(Number::zero);
        let ratio = largest.over(&lead.abs(), 16) + Number::one();
        let exponent = ratio.magnitude().unwrap_or(0) + 1;
        Number::power_of_two(i32::try_from(exponent).unwrap_or(i32::MAX))
    }

    /// All its real roots in order, each once, to within one unit of the last of
    /// so many bits.
    #[must_use]
    pub fn roots(&self, bits: usize) -> Vec<RealRoot> {
        if self.degree() == 0 {
            return vec![];
        }
        let chain = self.chain();
        // The greatest common divisor with the derivative has the multiple roots.
        let common = chain.last().cloned().unwrap_or_else(|| self.clone());
        let simple = if common.degree() > 0 { self.divided(&common).0 } else { self.clone() };
        let simple_chain = if common.degree() > 0 { simple.chain() } else { chain };
        let bound = simple.bound();
        let mut found = vec![];
        isolate(&simple_chain, -&bound, bound, &mut found);
        found.sort_by(|a, b| a.0.cmp(&b.0));
        let common_roots = if common.degree() > 0 { common.roots(bits) } else { vec![] };
        found
            .into_iter()
            .map(|(low, high)| {
                let signs = [self.value(&low).signum(), self.value(&high).signum()];
                let multiple = common_roots.iter().any(|r| low < r.place && r.place <= high);
                RealRoot { place: refine(&simple, low, high, bits), signs, multiple }
            })
            .collect()
    }
}

/// How many times the signs change along a chain; zeros do not count.
fn changes(chain: &[Polynomial], t: &Number) -> usize {
    let signs: Vec<i32> =
        chain.iter().map(|p| p.value(t).signum()).filter(|sign| *sign != 0).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// Halves an interval, whose ends are no roots, until each part holds one root
/// in its inside.
fn isolate(chain: &[Polynomial], low: Number, high: Number, found: &mut Vec<(Number, Number)>) {
    match changes(chain, &low) - changes(chain, &high) {
        0 => {}
        1 => found.push((low, high)),
        _ => {
            let middle = between(&chain[0], &low, &high);
            isolate(chain, low, middle.clone(), found);
            isolate(chain, middle, high, found);
        }
    }
}

/// A number between two that is no root: the middle, or something beside it.
fn between(p: &Polynomial, low: &Number, high: &Number) -> Number {
    let half = Number::power_of_two(-1);
    let mut middle = (low + high) * &half;
    while p.value(&middle).is_zero() {
        middle = (low + &middle) * &half;
    }
    middle
}

/// The root in an interval where there is one and the ends differ in sign.
///
/// Newton's steps suggest where to cut, and a cut counts only where the signs
/// at both of its sides show that the root is between them; else the interval is
/// halved.
fn refine(p: &Polynomial, mut low: Number, mut high: Number, bits: usize) -> Number {
    let slope = p.derivative();
    let below = p.value(&low).signum();
    let half = Number::power_of_two(-1);
    loop {
        let width = (&high - &low).magnitude().unwrap_or(isize::MIN);
        let middle = (&low + &high) * &half;
        let size = low.magnitude().max(high.magnitude()).unwrap_or(width);
        let same_sign = low.signum() * high.signum() > 0;
        let digits = size - width;
        if same_sign && digits > bits as isize + 1 {
            return middle.rounded(bits);
        }
        let value = p.value(&middle);
        let side = value.signum();
        if side == 0 {
            return middle.rounded(bits);
        }
        let steep = slope.value(&middle);
        if digits >= 2 && !steep.is_zero() {
            // As many digits again as there are.
            let want = (2 * digits.unsigned_abs()).min(bits + 8) + 4;
            let place = &middle - value.over(&steep, want);
            let place = place.rounded(want);
            let reach = place.magnitude().unwrap_or(0) - want as isize + 4;
            let reach = Number::power_of_two(i32::try_from(reach).unwrap_or(0));
            let (near, far) = (&place - &reach, &place + &reach);
            if low < near && far < high {
                let (a, b) = (p.value(&near).signum(), p.value(&far).signum());
                if a == 0 {
                    return near.rounded(bits);
                }
                if b == 0 {
                    return far.rounded(bits);
                }
                if a != b {
                    (low, high) = (near, far);
                    continue;
                }
            }
        }
        match side.cmp(&below) {
            Ordering::Equal => low = middle,
            _ => high = middle,
        }
        // A root at 0 has no first digit to count from.
        if low.signum() * high.signum() < 0 && p.value(&Number::zero()).is_zero() {
            return Number::zero();
        }
    }
}
