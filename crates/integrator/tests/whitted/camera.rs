//! Where in the picture things are.

use crate::help::{black, eye, grey, picture, scene, shining};
use lancer_film::LayerPixel;
use lancer_integrator::{Rendered, Whitted};
use lancer_math::Vector;
use lancer_scene::{Camera, Degrees, Direction, InvalidField, Shape};
use std::f64::consts::PI;

/// Shining balls of different colours on the axes, at distance 1 from a centre.
fn balls_around(camera: Result<Camera, InvalidField>, centre: [f64; 3]) -> Rendered {
    let mut balls = scene(camera, 0.0);
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let mut place = centre;
            place[axis] += side;
            // Bright on the positive side.
            let mut radiance = [0.0; 3];
            radiance[axis] = if side > 0.0 { 1.0 } else { 0.25 };
            balls = balls.shape(Shape::sphere(place, 0.25, shining(radiance)));
        }
    }
    picture(balls, Whitted::CUTOFF)
}

/// The colours in the middle of the right, upper, left and lower part of a picture
/// of 9 x 9 pixels.
fn around(rendered: &Rendered) -> [[f32; 3]; 4] {
    [(7, 4), (4, 1), (1, 4), (4, 7)].map(|(x, y)| rendered.film.pixel(x, y))
}

/// A camera that sees 1 from the middle in those pixels.
fn at(from: [f64; 3], target: [f64; 3]) -> Result<Camera, InvalidField> {
    Camera::new(from, target, 3.0, [9, 9]).and_then(|camera| camera.orthographic(3.0))
}

const X: [f32; 3] = [1.0, 0.0, 0.0];
const Y: [f32; 3] = [0.0, 1.0, 0.0];
const Z: [f32; 3] = [0.0, 0.0, 1.0];
const MINUS_X: [f32; 3] = [0.25, 0.0, 0.0];
const MINUS_Y: [f32; 3] = [0.0, 0.25, 0.0];
const MINUS_Z: [f32; 3] = [0.0, 0.0, 0.25];

#[test]
fn z_is_up_and_right_is_right() {
    let ahead = balls_around(at([0.0, -5.0, 0.0], [0.0; 3]), [0.0; 3]);
    assert_eq!(around(&ahead), [X, Z, MINUS_X, MINUS_Z]);
    let aside = balls_around(at([5.0, 0.0, 0.0], [0.0; 3]), [0.0; 3]);
    assert_eq!(around(&aside), [Y, Z, MINUS_Y, MINUS_Z]);
}

#[test]
fn straight_down_is_a_map_and_straight_up_a_map_of_the_stars() {
    let down = balls_around(at([0.0, 0.0, 5.0], [0.0; 3]), [0.0; 3]);
    assert_eq!(around(&down), [X, Y, MINUS_X, MINUS_Y]);
    let up = balls_around(at([0.0, 0.0, -5.0], [0.0; 3]), [0.0; 3]);
    assert_eq!(around(&up), [MINUS_X, Y, X, MINUS_Y]);
    // And nearly so it is the same, from the side on which y is ahead.
    for tilt in [1e-17, 1e-12, 1e-9, 1e-6, 1e-3] {
        let nearly = balls_around(at([0.0, 0.0, 5.0], [0.0, tilt, 0.0]), [0.0; 3]);
        assert_eq!(around(&nearly), around(&down), "{tilt}");
        let nearly = balls_around(at([0.0, 0.0, -5.0], [0.0, -tilt, 0.0]), [0.0; 3]);
        assert_eq!(around(&nearly), around(&up), "{tilt}");
    }
}

#[test]
fn straight_up_and_down_through_a_point_everything_is_finite() {
    for (from, target) in [([0.0, 0.0, 5.0], [0.0; 3]), ([0.0; 3], [0.0, 0.0, 5.0])] {
        let camera = Camera::new(from, target, 3.0, [16, 16]);
        let ground = Shape::plane([0.0, 0.0, target[2]], [0.0, 0.0, 1.0], shining([0.5; 3]));
        let rendered = picture(scene(camera, 0.0).shape(ground), Whitted::CUTOFF);
        assert!(rendered.film.pixels().iter().all(|pixel| *pixel == [0.5; 3]));
    }
}

#[test]
fn up_and_roll_turn_the_picture() {
    let turned = |up: [f64; 3], roll: f64| {
        let camera = at([0.0, -5.0, 0.0], [0.0; 3]).map(|mut camera| {
            camera.up = Direction::new(up).expect("not zero");
            camera.roll = Degrees::new(roll).expect("finite");
            camera
        });
        around(&balls_around(camera, [0.0; 3]))
    };
    assert_eq!(turned([0.0, 0.0, 1e-9], 0.0), [X, Z, MINUS_X, MINUS_Z]);
    assert_eq!(turned([7.0, 3.0, 0.0], 0.0), [MINUS_Z, X, Z, MINUS_X]);
    assert_eq!(turned([0.0, 2.0, -1.0], 0.0), [MINUS_X, MINUS_Z, X, Z]);
    // The camera is turned clockwise, so the picture counterclockwise.
    assert_eq!(turned([0.0, 0.0, 1.0], 90.0), [MINUS_Z, X, Z, MINUS_X]);
    assert_eq!(turned([0.0, 0.0, 1.0], -90.0), [Z, MINUS_X, MINUS_Z, X]);
    assert_eq!(turned([0.0, 0.0, 1.0], 540.0), [MINUS_X, MINUS_Z, X, Z]);
    // Along the view "up" says nothing, and another axis takes its place.
    assert_eq!(turned([0.0, -3.0, 0.0], 0.0), turned([0.0, 1.0, 0.0], 0.0));
}

/// The first hits of a wall at y = 4.
fn wall(camera: Result<Camera, InvalidField>) -> Vec<LayerPixel> {
    let wall = Shape::plane([0.0, 4.0, 0.0], [0.0, 1.0, 0.0], black());
    let layers = picture(scene(camera, 0.0).shape(wall), Whitted::CUTOFF).layers;
    layers.expect("asked for").pixels().to_vec()
}

/// The rays of pixel centres by how far away they meet a wall.
#[test]
fn widths_and_angles_of_view_are_from_edge_to_edge() {
    let camera = || Camera::new([0.0; 3], [0.0, 4.0, 0.0], 8.0, [4, 2]);
    // Columns at x = -3, -1, 1, 3 and rows at z = 1, -1, where the wall is.
    let expected = |x: f64, z: f64| (x * x + z * z + 16.0).sqrt();
    let by_width = wall(camera());
    // 8 wide at distance 4 is 90 degrees.
    let by_angle = wall(camera().and_then(|camera| camera.field_of_view(90.0)));
    // Another target on the way there, and the width in proportion.
    let nearer = wall(Camera::new([0.0; 3], [0.0, 1.0, 0.0], 2.0, [4, 2]));
    let parallel = wall(camera().and_then(|camera| camera.orthographic(8.0)));
    for (row, z) in [1.0, -1.0].into_iter().enumerate() {
        for (column, x) in [-3.0, -1.0, 1.0, 3.0].into_iter().enumerate() {
            let index = 4 * row + column;
            for seen in [&by_width, &by_angle, &nearer] {
                assert!((f64::from(seen[index].ray_depth) - expected(x, z)).abs() < 1e-6);
                assert!((seen[index].axis_depth - 4.0).abs() < 1e-6);
                assert_eq!(seen[index].normal, [0.0, -1.0, 0.0]);
            }
            assert_eq!((parallel[index].ray_depth, parallel[index].axis_depth), (4.0, 4.0));
        }
    }
    let narrow = wall(camera().and_then(|camera| camera.field_of_view(60.0)));
    let x = 3.0 * libm::tan(PI / 6.0);
    let z = libm::tan(PI / 6.0);
    assert!((f64::from(narrow[0].ray_depth) - expected(x, z)).abs() < 1e-6);
}

/// How many pixels show a shape, as a part of the picture.
fn shown(camera: Result<Camera, InvalidField>, shape: Result<Shape, InvalidField>) -> f64 {
    let film = picture(scene(camera, 0.0).shape(shape), Whitted::CUTOFF).film;
    let lit = film.pixels().iter().filter(|pixel| pixel[0] > 0.0).count();
    lit as f64 / film.pixels().len() as f64
}

/// The cone of rays that touch a ball has the half angle b, sin b = r / distance;
/// at an angle a to the axis the plane at distance f cuts it in an ellipse of area
/// pi f^2 sin^2 b cos b / (cos^2 a - sin^2 b)^(3/2).
#[test]
fn the_image_of_a_ball_is_the_ellipse_that_projection_says() {
    for (centre, radius) in
        [([0.0, 5.0, 0.0], 1.5), ([2.0, 5.0, 1.0], 1.5), ([-3.0, 5.0, 2.5], 1.0)]
    {
        let centre_vector = Vector::from(centre);
        let distance = centre_vector.norm();
        let sine = radius / distance;
        let cos_a = centre[1] / distance;
        let under = cos_a * cos_a - sine * sine;
        // f = 1, and the picture is 2 x 2.
        let area = PI * sine * sine * (1.0 - sine * sine).sqrt() / (under * under.sqrt());
        let camera = Camera::new([0.0; 3], [0.0, 1.0, 0.0], 2.0, [600, 600]);
        let found = 4.0 * shown(camera, Shape::sphere(centre, radius, shining([1.0; 3])));
        assert!((found / area - 1.0).abs() < 1e-3, "{centre:?}: {found} {area}");
    }
}

#[test]
fn a_ball_in_parallel_rays_is_a_circle() {
    let camera = Camera::new([0.0; 3], [1.0, 2.0, -0.5], 1.0, [600, 300])
        .and_then(|camera| camera.orthographic(8.0));
    let found = 32.0 * shown(camera, Shape::sphere([2.5, 4.0, -1.0], 1.5, shining([1.0; 3])));
    assert!((found / (PI * 2.25) - 1.0).abs() < 1e-3, "{found}");
}

/// Inside a ball and just outside: a part of it, and all of the view.
#[test]
fn an_eye_may_be_in_the_middle_of_things() {
    let inside = scene(eye([0.1, 0.2, 0.3], [1.0; 3]), 0.0);
    assert_eq!(grey(inside.shape(Shape::sphere([0.0; 3], 1.0, shining([1.0; 3])))), 1.0);
    let camera = Camera::new([0.0, -1.0 - 1e-9, 0.0], [0.0; 3], 2.0, [16, 16]);
    assert_eq!(shown(camera, Shape::sphere([0.0; 3], 1.0, shining([1.0; 3]))), 1.0);
}

/// A horizon is where it should be: the rows below the middle see the ground.
#[test]
fn the_ground_reaches_to_the_horizon() {
    let camera = Camera::new([0.0, 0.0, 1.0], [0.0, 1.0, 1.0], 2.0, [8, 8]);
    let ground = Shape::plane([0.0; 3], [0.0, 0.0, 1.0], shining([1.0; 3]));
    let film = picture(scene(camera, 0.0).shape(ground), Whitted::CUTOFF).film;
    for (index, pixel) in film.pixels().iter().enumerate() {
        assert_eq!(pixel[0] > 0.0, index >= 32, "{index}");
    }
}
