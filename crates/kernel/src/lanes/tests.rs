//! Each operation gives, in each lane and for each width that this processor has,
//! the very bits of the plain operation on one double.

use super::{
    Answers as EightAnswers, Doubles as _, Lanes, MOST, Mask, Real, Width, Work, dispatch, lanes_of,
};
use fastrand::Rng;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Numbers at which arithmetic may go wrong.
const SPECIAL: [f64; 30] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -0.5,
    0.499_999_999_999_999_94,
    -0.499_999_999_999_999_94,
    1.0 - f64::EPSILON / 2.0,
    1.0 + f64::EPSILON,
    -1.5,
    2.5,
    // Around 2^52, from where on all numbers are whole, and 2^53.
    4_503_599_627_370_495.5,
    4_503_599_627_370_496.0,
    -4_503_599_627_370_495.5,
    9_007_199_254_740_993.0,
    // Around the whole numbers of 32 and 64 bits.
    2_147_483_648.5,
    -2_147_483_649.5,
    9_223_372_036_854_775_808.0,
    1e300,
    -1e-300,
    f64::MIN_POSITIVE,
    -f64::MIN_POSITIVE / 2.0,
    5e-324,
    -5e-324,
    f64::MAX,
    f64::MIN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// Eight operands of each kind, for as many lanes as there may be.
type Operands = [[f64; MOST]; 3];

/// The answers of an operation, and its name.
type Answers = Vec<(&'static str, [f64; MOST])>;

/// All operations on these operands.
struct All<'a>(&'a Operands);

impl Work for All<'_> {
    type Output = Answers;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Answers {
        let mut all = Answers::new();
        for start in (0..MOST).step_by(L::WIDTH) {
            let [a, b, c] = self.0.each_ref().map(
                #[inline(always)]
                |operand| lanes.load(&operand[start..]),
            );
            // The operations with a double take that of the batch's first lane.
            let first = self.0[1][start];
            let yes_no = |mask: L::Mask| mask.select(lanes.splat(1.0), lanes.splat(0.0));
            let answers = [
                ("a + b", a + b),
                ("a - b", a - b),
                ("a * b", a * b),
                ("a / b", a / b),
                ("-a", -a),
                ("a + first b", a + first),
                ("a - first b", a - first),
                ("a * first b", a * first),
                ("a b + c", a.mul_add(b, c)),
                ("root a", a.sqrt()),
                ("|a|", a.abs()),
                ("floor a", a.floor()),
                ("a with the sign of b", a.copysign(b)),
                ("a < b", yes_no(a.lt(b))),
                ("a <= b", yes_no(a.le(b))),
                ("a > b", yes_no(a.gt(b))),
                ("a >= b", yes_no(a.ge(b))),
                ("a = b", yes_no(a.eq(b))),
                ("a < b and b < c", yes_no(a.lt(b) & b.lt(c))),
                ("a < b or b < c", yes_no(a.lt(b) | b.lt(c))),
                ("not a < b", yes_no(!a.lt(b))),
                ("b or c by a < b", a.lt(b).select(b, c)),
            ];
            for (index, (name, answer)) in answers.into_iter().enumerate() {
                if start == 0 {
                    all.push((name, [0.0; MOST]));
                }
                answer.store(&mut all[index].1[start..]);
                for k in 0..L::WIDTH {
                    assert_same(answer.lane(k), all[index].1[start + k], || name.to_owned());
                }
            }
        }
        all
    }
}

/// What the operation of that name gives on one double.
fn expected(name: &str, [a, b, c]: [f64; 3], first: f64) -> f64 {
    let yes_no = |yes: bool| f64::from(u8::from(yes));
    match name {
        "a + b" => a + b,
        "a - b" => a - b,
        "a * b" => a * b,
        "a / b" => a / b,
        "-a" => -a,
        "a + first b" => a + first,
        "a - first b" => a - first,
        "a * first b" => a * first,
        // The one that is computed with whole numbers, on every machine.
        "a b + c" => libm::fma(a, b, c),
        "root a" => a.sqrt(),
        "|a|" => a.abs(),
        "floor a" => libm::floor(a),
        "a with the sign of b" => a.copysign(b),
        "a < b" => yes_no(a < b),
        "a <= b" => yes_no(a <= b),
        "a > b" => yes_no(a > b),
        "a >= b" => yes_no(a >= b),
        "a = b" => yes_no(a == b),
        "a < b and b < c" => yes_no(a < b && b < c),
        "a < b or b < c" => yes_no(a < b || b < c),
        "not a < b" => yes_no(a >= b || a.is_nan() || b.is_nan()),
        "b or c by a < b" => {
            if a < b {
                b
            } else {
                c
            }
        }
        _ => panic!("{name} is not among the operations"),
    }
}

/// The same bits, or neither is a number.
#[track_caller]
fn assert_same(actual: f64, expected: f64, what: impl Fn() -> String) {
    let same = actual.to_bits() == expected.to_bits() || (actual.is_nan() && expected.is_nan());
    assert!(same, "{}: {actual:e} ({actual:?}) is not {expected:e} ({expected:?})", what());
}

/// Every operation for every width on eight triples.
fn check(operands: &Operands, case: u64) {
    for width in Width::available() {
        let answers = dispatch(width, All(operands));
        assert_eq!(answers.len(), 22);
        for (name, answer) in answers {
            for (lane, actual) in answer.into_iter().enumerate() {
                let [a, b, c] = operands.each_ref().map(|operand| operand[lane]);
                let batch = lane - lane % lanes(width);
                let expected = expected(name, [a, b, c], operands[1][batch]);
                assert_same(actual, expected, || {
                    let width = width.name();
                    format!("case {case}, {width}, lane {lane}: {name} of {a:e}, {b:e}, {c:e}")
                });
            }
        }
    }
}

/// How many lanes there are.
fn lanes(width: Width) -> usize {
    struct Count;
    impl Work for Count {
        type Output = usize;

        #[inline(always)]
        fn run<L: Lanes>(self, _: L) -> usize {
            L::WIDTH
        }
    }
    dispatch(width, Count)
}

#[test]
fn special_numbers_in_every_place() {
    let count = SPECIAL.len();
    let mut triples = (0..count.pow(3)).map(|index| {
        [index % count, index / count % count, index / count / count].map(|i| SPECIAL[i])
    });
    // Of eight lanes in a row, all hold other numbers.
    let mut case = 0;
    while let Some(first) = triples.next() {
        let mut operands = first.map(|x| [x; MOST]);
        for lane in 1..MOST {
            let next = triples.next().unwrap_or(first);
            for (operand, x) in operands.iter_mut().zip(next) {
                operand[lane] = x;
            }
        }
        check(&operands, case);
        case += 1;
    }
}

#[test]
fn random_numbers() {
    for case in 0..6000 {
        let mut rng = Rng::with_seed(case);
        let operands = std::array::from_fn(|_| std::array::from_fn(|_| number(&mut rng)));
        check(&operands, case);
    }
}

/// A number of any magnitude, or one that an ordinary scene has.
fn number(rng: &mut Rng) -> f64 {
    match rng.u8(0..4) {
        0 => f64::from_bits(rng.u64(..)),
        1 => SPECIAL[rng.usize(0..SPECIAL.len())],
        2 => (rng.f64() - 0.5) * 16.0,
        _ => f64::from(rng.i32(-40..40)) * 0.5,
    }
}

/// Where a product and what is added to it nearly cancel, a product that was
/// rounded before leaves nothing of the truth.
#[test]
fn fused_products_are_rounded_once() {
    for case in 0..4000 {
        let mut rng = Rng::with_seed(case);
        let mut operands: Operands = [[0.0; MOST]; 3];
        for lane in 0..MOST {
            // With products that do not overflow, some of them subnormal.
            let scale = f64::from_bits((1023 - rng.u64(0..1040).min(1022)) << 52);
            let a = (1.0 + rng.f64()) * scale;
            let b = 1.0 + rng.f64();
            let steps = rng.i64(-2..3);
            let c = f64::from_bits((a * b).to_bits().wrapping_add_signed(steps));
            for (operand, x) in operands.iter_mut().zip([a, b, -c]) {
                operand[lane] = x;
            }
        }
        check(&operands, case);
    }
    // (1 + 2^-30)^2 = 1 + 2^-29 + 2^-60.
    let root = 1.0 + f64::from_bits((1023 - 30) << 52);
    let rounded = 1.0 + f64::from_bits((1023 - 29) << 52);
    let left = f64::from_bits((1023 - 60) << 52);
    assert_eq!(expected("a b + c", [root, root, -rounded], 0.0), left);
    check(&[[root; MOST], [root; MOST], [-rounded; MOST]], 0);
}

#[test]
fn powers_of_two() {
    struct Powers<'a>(&'a [f64; MOST]);
    impl Work for Powers<'_> {
        type Output = [f64; MOST];

        #[inline(always)]
        fn run<L: Lanes>(self, lanes: L) -> [f64; MOST] {
            let mut powers = [0.0; MOST];
            for start in (0..MOST).step_by(L::WIDTH) {
                lanes.load(&self.0[start..]).exp2_of_whole().store(&mut powers[start..]);
            }
            powers
        }
    }
    for width in Width::available() {
        for start in (-1022..=1023_i32).step_by(MOST) {
            let exponents = std::array::from_fn(|k| (start + k as i32).min(1023));
            for (power, exponent) in
                dispatch(width, Powers(&exponents.map(f64::from))).into_iter().zip(exponents)
            {
                let exact = f64::from_bits(((1023 + exponent) as u64) << 52);
                assert_eq!(power.to_bits(), exact.to_bits(), "{}: 2^{exponent}", width.name());
            }
        }
    }
    // Both zeros are the whole number 0.
    for width in Width::available() {
        assert_eq!(dispatch(width, Powers(&[-0.0; MOST])), [1.0; MOST]);
    }
}

/// What masks, partial loads and packed stores do, for all bits.
struct Masks;

impl Work for Masks {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let numbers: [f64; MOST] = std::array::from_fn(|k| k as f64 + 1.0);
        let all = (1_u32 << L::WIDTH) - 1;
        for bits in 0..=u32::from(u8::MAX) {
            let mask = lanes.mask(bits);
            assert_eq!(mask.bits(), bits & all, "bits beyond the lanes are none");
            assert_eq!(lanes.mask(bits | !all).bits(), bits & all);
            assert_eq!((!mask).bits(), !bits & all);
            assert_eq!(mask.any(), bits & all != 0);
            for other in [0, 0x55, 0xf0, u32::MAX] {
                assert_eq!((mask & lanes.mask(other)).bits(), bits & other & all);
                assert_eq!((mask | lanes.mask(other)).bits(), (bits | other) & all);
            }

            let x = lanes.load(&numbers);
            let chosen = mask.select(x, -x);
            for (k, number) in numbers.into_iter().enumerate().take(L::WIDTH) {
                let yes = bits & (1 << k) != 0;
                assert_eq!(chosen.lane(k), if yes { number } else { -number });
            }

            let mut packed = [-7.0; MOST + 1];
            let count = x.store_packed(mask, &mut packed);
            let wanted: Vec<f64> = lanes_of(bits & all).map(|k| numbers[k]).collect();
            assert_eq!(packed[..count], wanted, "{bits:b}");
            let beyond = &packed[L::WIDTH..];
            assert!(beyond.iter().all(|x| *x == -7.0), "nothing beyond the lanes is written to");
        }

        for count in 0..=MOST {
            let part = lanes.load_part(&numbers[..count], -1.0);
            for (k, number) in numbers.into_iter().enumerate().take(L::WIDTH) {
                assert_eq!(part.lane(k), if k < count { number } else { -1.0 });
            }
        }
        let mut stored = [-7.0; MOST + 1];
        lanes.splat(2.0).store(&mut stored);
        assert_eq!(stored[..L::WIDTH], [2.0; MOST][..L::WIDTH]);
        assert_eq!(stored[L::WIDTH..], [-7.0; MOST + 1][L::WIDTH..]);
    }
}

#[test]
fn masks_and_parts() {
    for width in Width::available() {
        dispatch(width, Masks);
    }
}

#[test]
fn bits_are_told_from_the_lowest() {
    assert_eq!(lanes_of(0).count(), 0);
    assert_eq!(lanes_of(0b1010_0001).collect::<Vec<_>>(), [0, 5, 7]);
    assert_eq!(lanes_of(u32::MAX).count(), 32);
}

/// Loads from, or stores to, one number less than there are lanes.
enum TooShort {
    Load,
    Store,
    StorePacked,
}

impl Work for TooShort {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let mut room = [0.0; MOST];
        let room = &mut room[..L::WIDTH - 1];
        let x = lanes.splat(1.0);
        match self {
            Self::Load => drop(lanes.load(room).lane(0)),
            Self::Store => x.store(room),
            Self::StorePacked => drop(x.store_packed(lanes.mask(1), room)),
        }
    }
}

#[test]
fn slices_that_are_too_short_are_refused() {
    for width in Width::available() {
        for work in [TooShort::Load, TooShort::Store, TooShort::StorePacked] {
            let outcome = catch_unwind(AssertUnwindSafe(|| dispatch(width, work)));
            assert!(outcome.is_err(), "{}", width.name());
        }
    }
}

#[test]
fn widths_have_names_and_an_order() {
    let all = Width::available();
    let counts: Vec<usize> = all.iter().map(|width| lanes(*width)).collect();
    assert!(counts.is_sorted() && counts[0] == 1 && counts.iter().all(|n| MOST.is_multiple_of(*n)));
    assert_eq!(Width::best().name(), all[all.len() - 1].name());
    for width in &all {
        assert_eq!(Width::by_name(width.name()).map(|found| found.name()), Ok(width.name()));
    }
    for wrong in ["", "AVX2", "avx", "scalar ", "sse2"] {
        let error = Width::by_name(wrong).expect_err("there are none of that name");
        assert_eq!(error.name, wrong);
        assert!(all.iter().all(|width| error.to_string().contains(width.name())), "{error}");
    }
}

struct InEights {
    a: [f64; 8],
    b: [f64; 8],
    bits: u32,
}

impl Work for InEights {
    type Output = (Vec<Vec<u64>>, Vec<u32>, Vec<u32>);

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Self::Output {
        let (a, b) = (lanes.doubles(&self.a), lanes.doubles(&self.b));
        let results = [a.least(b), a.most(b), a + b, a / b, -a, a.mul_add(b, a)];
        let results = results.map(|result| {
            let mut to = [0.0; 8];
            result.store(&mut to);
            to.map(f64::to_bits).to_vec()
        });
        let answers = [a.lt(b), a.le(b), a.gt(b), a.ge(b)].map(EightAnswers::bits);
        let mut packed = [0; 8];
        lanes.pack(&[0, 1, 2, 3, 4, 5, 6, 7], self.bits, &mut packed);
        let count = self.bits.count_ones() as usize;
        (results.to_vec(), answers.to_vec(), packed[..count].to_vec())
    }
}

/// Of eights, at every width, with what cannot be compared.
#[test]
fn eights_are_eight_numbers() {
    let mut rng = Rng::with_seed(8);
    for case in 0..256 {
        let mut number = || [0.0, -0.0, 1.5, f64::NAN, f64::INFINITY, rng.f64()][rng.usize(0..6)];
        let [a, b] = [[(); 8], [(); 8]].map(|eight| eight.map(|()| number()));
        let each = |f: fn(f64, f64) -> f64| (0..8).map(|i| f(a[i], b[i]).to_bits()).collect();
        let which = |f: fn(&f64, &f64) -> bool| {
            (0..8).filter(|&i| f(&a[i], &b[i])).map(|i| 1 << i).sum::<u32>()
        };
        let results: Vec<Vec<u64>> = vec![
            each(|a, b| if b < a { b } else { a }),
            each(|a, b| if b > a { b } else { a }),
            each(|a, b| a + b),
            each(|a, b| a / b),
            each(|a, _| -a),
            each(|a, b| a.mul_add(b, a)),
        ];
        let answers = vec![
            which(|a, b| a < b),
            which(|a, b| a <= b),
            which(|a, b| a > b),
            which(|a, b| a >= b),
        ];
        let packed: Vec<u32> = (0..8).filter(|i| case >> i & 1 == 1).collect();
        for width in Width::available() {
            let (found, found_answers, found_packed) =
                dispatch(width, InEights { a, b, bits: case });
            for (found, result) in found.iter().zip(&results) {
                for (found, result) in found.iter().zip(result) {
                    let both_nan =
                        f64::from_bits(*found).is_nan() && f64::from_bits(*result).is_nan();
                    assert!(found == result || both_nan, "{}: case {case}", width.name());
                }
            }
            assert_eq!((found_answers, found_packed), (answers.clone(), packed.clone()));
        }
    }
}
