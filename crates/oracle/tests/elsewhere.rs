//! Against values that mpmath (Python) gave, with 60 digits, by other formulas:
//! unit axes and normalised equations, the quartic's companion matrix.

use lancer_math::{Placement, Point, Ray, Vector};
use lancer_oracle::{
    Line, Number, Refraction, Space, Triple, crossings, fresnel, pixel_line, refract, sheet,
};
use lancer_scene::{Camera, Colour, Geometry, InvalidField, Shape, Surface};

const BITS: usize = 300;

/// A number from its decimal digits.
fn digits(text: &str) -> Number {
    let (sign, text) = text.strip_prefix('-').map_or((1, text), |rest| (-1, rest));
    let (whole, fraction) = text.split_once('.').unwrap_or((text, ""));
    let ten = Number::from(10);
    let (mut number, mut scale) = (Number::zero(), Number::from(sign));
    for digit in whole.chars().chain(fraction.chars()) {
        let digit = i32::try_from(digit.to_digit(10).expect("a digit")).expect("below 10");
        number = number * &ten + Number::from(digit);
    }
    for _ in fraction.chars() {
        scale = scale * &ten;
    }
    number.over(&scale, 400)
}

/// To 38 digits of those that are written.
#[track_caller]
fn same(found: &Number, expected: &str) {
    let expected = digits(expected);
    let error = (found - &expected).abs();
    assert!(
        error <= expected.abs() * digits("0.00000000000000000000000000000000000001"),
        "{error:?} of {expected:?}"
    );
}

fn geometry(shape: Result<Shape, InvalidField>) -> Geometry {
    shape.expect("a valid shape").geometry
}

#[track_caller]
fn meets(shape: Result<Shape, InvalidField>, ray: ([f64; 3], [f64; 3]), expected: &[&str]) {
    let line = Line { origin: ray.0.into(), direction: ray.1.into() };
    let found = crossings(&geometry(shape), &Space::world(), &line, BITS).list;
    assert_eq!(found.len(), expected.len());
    for (crossing, expected) in found.iter().zip(expected) {
        same(&crossing.t, expected);
    }
}

fn red() -> Surface {
    Surface::new(Colour::RED)
}

#[test]
fn tori() {
    meets(
        Shape::torus([0.1, 0.05, -0.02], [0.2, -0.1, 1.3], [1.1, 0.35], red()),
        ([-3.1, 0.4, 0.2], [1.0, -0.07, 0.03]),
        &["1.795669652688475867186801559330545192831", "2.467903620574458889851748634969440847059"],
    );
    meets(
        Shape::torus([0.0; 3], [0.0, 0.0, 1.0], [1e5, 0.25], red()),
        ([-2e5, 0.1, 0.05], [1.0, 0.0, 0.0]),
        &[
            "99999.75505107572155971657219547282182742",
            "100000.2449490242784402840528156294129314",
            "299999.7550509757215597159471843705870686",
            "300000.2449489242784402834278045271781726",
        ],
    );
    let back = [0.9 + 3e6 / 7.0, 0.1 + 2e6 / 7.0, 0.05 + 6e6 / 7.0];
    meets(
        Shape::torus([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.25], red()),
        (back, [-3.0 / 7.0, -2.0 / 7.0, -6.0 / 7.0]),
        &["999999.7670979980722613348452288951173926", "1000000.233973236592943659392439748143098"],
    );
}

#[test]
fn frusta_and_cones() {
    let (base, top) = ([-0.2, -0.9, -0.4], [0.3, 1.1, 0.9]);
    meets(
        Shape::frustum((base, 0.8), (top, 0.3), red()),
        ([-2.3, 0.4, 0.3], [1.0, -0.1, 0.17]),
        &["1.972438821697349786075449168625123166087", "2.669570708733124864182918290069752503182"],
    );
    meets(
        Shape::cone(base, top, 0.8, red()),
        ([-2.3, 0.4, 0.3], [1.0, -0.1, -0.1]),
        &["1.959129863478947110434819968150026876242", "2.692257503413693140186661310579251418297"],
    );
}

/// Nearly parallel to a generator: the near root keeps all its digits.
#[test]
fn c4_generators_turned_a_little() {
    let half = 0.707_106_781_186_547_6;
    for (z, near, far) in [
        (
            0.707_813_887_967_734,
            "-5.654027235874442930159347196966269086479",
            "7.064003808057418199789041888777822495835",
        ),
        (
            0.707_106_781_893_654_4,
            "-5.656854246663952539755275446868527347184",
            "7.07106780479440659227994493296731863562",
        ),
        (
            0.707_106_781_187_254_8,
            "-5.656854249489550960248278874878782880583",
            "7.071067811858402639976922775380924933331",
        ),
        (
            0.707_106_781_186_548_3,
            "-5.656854249492376699890553408286117363114",
            "7.071067811865466989082605572316692556767",
        ),
    ] {
        meets(
            Shape::cone([0.0, 0.0, 10.0], [0.0; 3], 10.0, red()),
            ([0.0, 3.0, 5.0], [0.0, half, z]),
            &[near, far],
        );
    }
}

#[test]
fn a_sphere_that_is_stretched_and_moved() {
    let rows = [[1.0, 0.5, 0.0, 3.0], [0.0, 2.0, -1.0, 0.25], [0.3, 0.0, 1.5, -7.0]];
    let space = Space::world().inside(&Placement::from_rows(rows).expect("not flat"));
    let sphere = geometry(Shape::sphere([0.1, 0.2, -0.1], 0.9, red()));
    let ray = Ray::new(Point::new(-4.0, 0.3, -7.7), Vector::new(1.0, 0.05, 0.1));
    let found = crossings(&sphere, &space, &Line::from(&ray), BITS).list;
    assert_eq!(found.len(), 2);
    same(&found[0].t, "6.345618797743532507996740388486143780263");
    same(&found[1].t, "8.080387469349030568451944179566488766985");
    let normal = [
        "-0.92096674089858339877287620375837997986",
        "0.248891120051384567883267635829987982856",
        "0.2997890466948531245413983856292639801468",
    ];
    for (found, expected) in found[0].normal.0.iter().zip(normal) {
        same(found, expected);
    }
}

#[test]
fn d2_fresnel() {
    let at = |cosine: f64, n1, n2| fresnel(&cosine.into(), n1, n2, BITS);
    same(&at(0.5, 1.0, 1.5), "0.0891867128022127831153509268230123795478");
    same(&at(0.9, 1.5, 1.0), "0.04633264795403766077061735258735917100317");
    // Straight on: ((1.5 - 1) / (1.5 + 1))^2.
    same(&at(1.0, 1.0, 1.5), "0.04");
    assert_eq!(at(0.3, 1.5, 1.33), Number::one());
    // At Brewster's angle, whose tangent is the index: half of (5/13)^2.
    let cosine = Number::one().over(&Number::from(3.25).root(BITS), BITS);
    let brewster = fresnel(&cosine, 1.0, 1.5, BITS);
    same(&(brewster * Number::from(338)), "25.0");
    // The same from both sides, at the angles that belong together.
    let outside = Number::from(0.5);
    let deep = (Number::one() - Number::from(0.75).over(&Number::from(2.25), BITS)).root(BITS);
    let apart = at(0.5, 1.0, 1.5) - fresnel(&deep, 1.5, 1.0, BITS);
    assert!(apart.to_f64().abs() < 1e-80 && outside < deep);
}

#[test]
fn d1_at_the_critical_angle() {
    let mut cosine = 0.745_355_992_499_929_5_f64;
    let expected = [
        "1",
        "1",
        "1",
        "1",
        "1",
        "0.9999998882122212044209397",
        "0.9999998416240147988689156",
        "0.9999998059139443108974208",
        "0.9999997758218551471238717",
    ];
    for expected in expected {
        let found = fresnel(&cosine.into(), 1.5, 1.0, BITS);
        assert!((found - digits(expected)).abs().to_f64() < 1e-24, "{cosine}");
        let direction = Triple([
            (Number::one() - Number::from(cosine).squared()).root(BITS),
            Number::zero(),
            -Number::from(cosine),
        ]);
        let (bent, _) = refract(&direction, &Vector::z().into(), 1.5, 1.0, BITS);
        assert_eq!(matches!(bent, Refraction::Total), expected == "1");
        cosine = cosine.next_up();
    }
}

#[test]
fn d3_slabs_and_sheets() {
    let mirrored = sheet(&0.5.into(), 1.0, 1.5, BITS);
    let passed = Number::one() - mirrored;
    assert!((passed - digits("0.83623246271016832387000423677")).abs().to_f64() < 1e-28);
    let straight = Number::one() - sheet(&Number::one(), 1.0, 1.5, BITS);
    same(&(straight * Number::from(13)), "12.0");
    // The deviation at 60 degrees where the indices hardly differ: e tan(60).
    let sine = Number::from(0.75).root(BITS);
    let direction = Triple([sine, Number::zero(), Number::from(-0.5)]);
    let e = 1.000_000_000_001 - 1.0;
    let (bent, _) = refract(&direction, &Vector::z().into(), 1.0, 1.0 + e, BITS);
    let Refraction::Part { direction: bent, .. } = bent else { panic!("it is not mirrored") };
    let turned = direction.cross(&bent).norm(BITS).to_f64();
    assert!((turned / (e * 3.0_f64.sqrt()) - 1.0).abs() < 1e-11);
    // Into a slab and out of it the direction is what it was, and sines go with
    // indices.
    let refracted =
        |direction: &Triple, n1, n2| match refract(direction, &Vector::z().into(), n1, n2, BITS) {
            (Refraction::Part { direction, .. }, _) => direction,
            (Refraction::Total, _) => panic!("it is not mirrored"),
        };
    let inside = refracted(&direction, 1.0, 1.5);
    assert!((&inside.0[0] * Number::from(1.5) - &direction.0[0]).abs().to_f64() < 1e-80);
    let out = refracted(&inside, 1.5, 1.0);
    assert!((&out - &direction).norm(BITS).to_f64() < 1e-80);
    // Shifted by sin(60) - cos(60) tan(inside).
    let tangent = inside.0[0].over(&-&inside.0[2], BITS);
    let shift = &direction.0[0] - Number::from(0.5) * tangent;
    assert!((shift - digits("0.51247201319116488456")).abs().to_f64() < 1e-19);
}

#[test]
fn a_camera_with_a_field_of_view_that_is_rolled() {
    let camera = Camera::new([1.0, 0.0, 3.0], [4.0, 5.0, 2.0], 1.0, [400, 300]);
    let camera = camera.and_then(|c| c.field_of_view(50.0)).and_then(|c| c.roll(17.0));
    let line = pixel_line(&camera.expect("in range"), 10, 20, BITS);
    let expected = [
        "0.2264405947161809325721992710074224721403",
        "0.9501940431190413181860147685092282612541",
        "0.2141399950632103196795054383675615187383",
    ];
    for (found, expected) in line.direction.0.iter().zip(expected) {
        same(found, expected);
    }
}

/// Straight down, y is up; and so it is nearly down, whatever the tilt.
#[test]
fn k1_looking_straight_down() {
    for tilt in [0.0, 1e-17, 1e-12, 1e-6] {
        let camera = Camera::new([0.0, 0.0, 5.0], [0.0, tilt, 0.0], 2.0, [2, 2]);
        let line = pixel_line(&camera.expect("in range"), 1, 0, BITS);
        let [x, y, z] = line.direction.to_f64();
        assert!((x / z + 0.1).abs() < 1e-5 && (y / z + 0.1).abs() < 1e-5, "{tilt}");
    }
}
