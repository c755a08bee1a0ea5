//! The order of the description.

use crate::{SCENES, bits, picture, scene, seen};
use fastrand::Rng;

/// Not a bit, but where two surfaces are equally far away along a ray, of which the first in the
/// description is seen; these scenes have none in any pixel's centre. Numbers of shapes go along.
#[test]
fn shapes_in_another_order_change_no_bit() {
    for name in SCENES {
        let scene = scene(name);
        let expected = picture(&scene);
        for seed in 0..3 {
            let mut order: Vec<usize> = (0..scene.shapes.len()).collect();
            match seed {
                0 => order.reverse(),
                _ => Rng::with_seed(seed).shuffle(&mut order),
            }
            let mut other = scene.clone();
            other.shapes = order.iter().map(|&i| scene.shapes[i].clone()).collect();
            let found = picture(&other);
            assert!(bits(&found.film) == bits(&expected.film), "{name}, order {order:?}");
            for (found, expected) in seen(&found).iter().zip(seen(&expected)) {
                let number = match found.shape as usize {
                    0 => 0,
                    n if n <= order.len() => order[n - 1] + 1,
                    n => n,
                };
                assert_eq!(number, expected.shape as usize, "{name}, order {order:?}");
            }
        }
    }
}
