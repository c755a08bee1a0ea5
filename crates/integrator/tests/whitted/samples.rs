//! Means of many samples.

use lancer_integrator::{
    Engine, MOST_SAMPLES, Plan, RayCounts, Sample, Sampler, Seen, Stream, Troubles, Whitted,
};
use lancer_scene::{Scene, SceneBuilder};

/// The mean of grey samples, and what it may be off by: four standard errors, as if the samples
/// were independent of one another.
pub(crate) struct Mean {
    pub(crate) value: f64,
    pub(crate) within: f64,
}

impl Mean {
    #[track_caller]
    pub(crate) fn assert_is(&self, expected: f64, what: &str) {
        let error = (self.value - expected).abs();
        let limit = self.within + 1e-6 * expected;
        // Not for NaN either.
        assert!(error <= limit, "{what}: {} is not {expected} within {limit:e}", self.value);
    }
}

/// What samples of the first pixel see: in sets of 256, all at its centre or anywhere in it.
pub(crate) fn see(scene: &Scene, count: u32, at_centre: bool, seed: u64) -> Vec<(Sample, Seen)> {
    let engine = Whitted::new();
    let tracer = engine.prepare(scene, &Plan::default());
    let sampler: &dyn Sampler = tracer.sampler().expect("it sees samples");
    let samples: Vec<Sample> = (0..count)
        .map(|k| {
            let stream = Stream::new(seed, (0, 0), k / 256, k % 256);
            if at_centre { Sample::at_centre((0, 0), stream) } else { Sample::new((0, 0), stream) }
        })
        .collect();
    let mut counts = RayCounts::default();
    let mut seen = vec![Seen::default(); samples.len()];
    for (samples, seen) in samples.chunks(MOST_SAMPLES).zip(seen.chunks_mut(MOST_SAMPLES)) {
        sampler.see(samples, seen, &mut counts);
    }
    assert_eq!(counts.troubles, Troubles::default());
    samples.into_iter().zip(seen).collect()
}

/// The mean of so many samples at the centre of the only pixel.
pub(crate) fn mean(builder: SceneBuilder, count: u32) -> Mean {
    let scene = builder.build().expect("valid");
    let (mut sum, mut squares) = (0.0, 0.0);
    for (_, seen) in see(&scene, count, true, 5) {
        let [red, green, blue] = seen.radiance.map(f64::from);
        assert!(red == green && green == blue, "({red}, {green}, {blue})");
        sum += red;
        squares += red * red;
    }
    let n = f64::from(count);
    let value = sum / n;
    let variance = (squares / n - value * value).max(0.0);
    Mean { value, within: 4.0 * (variance / n).sqrt() }
}
