use lancer_integrator::{Engine, RayCounts, Whitted};
use lancer_scene::*;
#[test]
fn probe() {
    let clear = Surface::glass(1.5).unwrap();
    let camera = Camera::new([0.3, -5.0, 2.0], [0.0; 3], 3.2, [24, 24]);
    let scene = Scene::builder().camera(camera).background(Spectrum::new([0.5; 3])).shape(Shape::torus([0.0; 3], [0.3, 0.2, 1.0], [0.9, 0.4], clear)).build().unwrap();
    for cutoff in [1e-2, 1e-3, 1e-4] {
    let engine = Whitted::with_cutoff(cutoff).unwrap();
    let tracer = engine.prepare(&scene);
    let mut worst = (0, 0, 0);
    let mut all = 0;
    for y in 0..24 { for x in 0..24 {
        let mut counts = RayCounts::default();
        let t = std::time::Instant::now();
        let p = tracer.pixel(x, y, &mut counts);
        all += counts.total();
        if counts.total() > worst.0 { worst = (counts.total(), x, y); }
        if counts.total() > 20000 || t.elapsed().as_millis() > 100 { eprintln!("{cutoff} {x} {y} {p:?} {counts:?} {:?}", t.elapsed()); }
    } }
    eprintln!("== {cutoff} worst {worst:?} all {all}");
    }
}
