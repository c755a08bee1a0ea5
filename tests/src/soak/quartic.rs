//! Zeros of polynomials by bisection between their turning points, which are
//! zeros of a polynomial of a lower degree.

use super::dd::Dd;

/// The value and the slope of the polynomial with these coefficients, constant
/// first.
fn value(polynomial: &[Dd], x: Dd) -> (Dd, Dd) {
    polynomial.iter().rev().fold((Dd::ZERO, Dd::ZERO), |(value, slope), &coefficient| {
        (value * x + coefficient, slope * x + value)
    })
}

fn derivative(polynomial: &[Dd]) -> Vec<Dd> {
    let terms = polynomial.iter().enumerate().skip(1);
    terms.map(|(power, &coefficient)| coefficient * Dd::from(power as f64)).collect()
}

/// Where the polynomial turns between two places, in order, these included; on
/// each stretch between two neighbours it has one zero at most.
pub(crate) fn turning_points(polynomial: &[Dd], (from, to): (Dd, Dd)) -> Vec<Dd> {
    let mut points = vec![from];
    if polynomial.len() > 2 {
        points.extend(zeros(&derivative(polynomial), (from, to)));
    }
    points.push(to);
    points
}

fn zeros(polynomial: &[Dd], range: (Dd, Dd)) -> Vec<Dd> {
    let points = turning_points(polynomial, range);
    points.windows(2).filter_map(|ends| zero_between(polynomial, (ends[0], ends[1]))).collect()
}

/// The zero on a stretch without turning points: by Newton's method as long as
/// that stays in the bracket and the bracket shrinks, else by bisection.
pub(crate) fn zero_between(polynomial: &[Dd], (from, to): (Dd, Dd)) -> Option<Dd> {
    let (mut low, mut high) = (from, to);
    let is_below = |v: Dd| v.is_negative();
    let starts_below = is_below(value(polynomial, low).0);
    if starts_below == is_below(value(polynomial, high).0) {
        return None;
    }
    let mut x = (low + high).half();
    let mut step = high - low;
    for _ in 0..300 {
        let (at, slope) = value(polynomial, x);
        if at.is_zero() {
            return Some(x);
        }
        if is_below(at) == starts_below {
            low = x;
        } else {
            high = x;
        }
        let newton = at / slope;
        let goes = !slope.is_zero() && newton.abs() < step.abs().half();
        let next = x - newton;
        let (next, by) = if goes && low < next && next < high {
            (next, newton)
        } else {
            let half = (low + high).half();
            (half, half - x)
        };
        (x, step) = (next, by);
        if step.abs().round() <= 1e-31 * x.abs().round() || low >= high {
            break;
        }
    }
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastrand::Rng;

    /// (x - a) (x - b) (x - c) (x - d) for integers, some of them the same.
    #[test]
    fn zeros_are_those_of_the_factors() {
        for case in 0..2000 {
            let mut rng = Rng::with_seed(case);
            let mut factors: Vec<i32> = (0..4).map(|_| rng.i32(-9..=9)).collect();
            let mut polynomial = vec![Dd::ONE];
            for &root in &factors {
                let by_x = [&[Dd::ZERO], &polynomial[..]].concat();
                polynomial.push(Dd::ZERO);
                for (term, higher) in polynomial.iter_mut().zip(by_x) {
                    *term = higher - *term * Dd::from(f64::from(root));
                }
            }
            factors.sort_unstable();
            // Where two of them agree it only touches, or nearly so, and that may
            // be seen or not; odd ones are crossed.
            let crossed: Vec<f64> = factors
                .chunk_by(|a, b| a == b)
                .filter(|same| same.len() % 2 == 1)
                .map(|same| f64::from(same[0]))
                .collect();
            let found = zeros(&polynomial, (Dd::from(-20.0), Dd::from(20.0)));
            for root in crossed {
                let near = |x: &&Dd| (x.round() - root).abs() < 1e-9;
                assert!(found.iter().any(|x| near(&x)), "case {case}: {factors:?} {found:?}");
            }
            for x in found {
                let off = factors.iter().map(|root| (x.round() - f64::from(*root)).abs());
                assert!(off.fold(9.0, f64::min) < 1e-7, "case {case}: {factors:?} {x:?}");
            }
        }
    }
}
