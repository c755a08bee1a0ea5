//! How sampling ends, and that nothing else matters to it.

use crate::painted::{picture, try_picture};
use crate::{asked, half_plane};
use lancer_integrator::{Rendered, Sampling, StopAt, Strategy, Why};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

fn assert_same(a: &Rendered, b: &Rendered) {
    assert_eq!(a.film.pixels(), b.film.pixels());
    assert_eq!(a.quality, b.quality);
    let [a, b] = [a, b].map(|rendered| rendered.accuracy.expect("sampled"));
    assert_eq!((a.predicted, a.samples, a.at), (b.predicted, b.samples, b.at));
}

#[test]
fn the_number_of_threads_does_not_matter() {
    for strategy in Strategy::ALL {
        let sampling = Sampling { strategy: *strategy, ..asked(0.01, 5) };
        let one = picture(70, sampling, 1, half_plane);
        for threads in [2, 3] {
            assert_same(&one, &picture(70, sampling, threads, half_plane));
        }
    }
}

#[test]
fn other_seeds_give_other_pictures_of_the_same() {
    let [a, b] = [1, 2].map(|seed| picture(64, asked(0.01, seed), 1, half_plane));
    assert_ne!(a.film.pixels(), b.film.pixels());
}

#[test]
fn so_many_samples_are_so_many() {
    for strategy in Strategy::ALL {
        for samples in [1, 2, 3, 7, 16] {
            let sampling =
                Sampling { strategy: *strategy, samples: Some(samples), ..Sampling::default() };
            let rendered = picture(20, sampling, 2, half_plane);
            let accuracy = rendered.accuracy.expect("sampled");
            assert_eq!(accuracy.samples, u64::from(samples) * 400, "{}", strategy.name());
            assert_eq!((accuracy.stopped, accuracy.unseen), (Why::Samples, 0));
            let quality = rendered.quality.expect("sampled");
            assert!(quality.pixels().iter().all(|known| known.samples == samples));
        }
    }
}

#[test]
fn it_stops_anywhere_and_there_again() {
    for at in [(0, 3), (1, 0), (1, 2), (4, 1)] {
        let at = StopAt { round: at.0, pieces: at.1 };
        let sampling = Sampling { stop_at: Some(at), ..Sampling::default() };
        let one = picture(70, sampling, 1, half_plane);
        let accuracy = one.accuracy.expect("sampled");
        assert_eq!((accuracy.at, accuracy.stopped), (at, Why::StopAt));
        // Three pieces of four tiles of the 25.
        assert_eq!(accuracy.unseen > 0, at.round == 0);
        assert_same(&one, &picture(70, sampling, 3, half_plane));
    }
}

#[test]
fn time_only_says_where_it_stops() {
    let sampling = Sampling { time: Some(Duration::from_millis(30)), ..Sampling::default() };
    let by_time = picture(64, sampling, 2, half_plane);
    let accuracy = by_time.accuracy.expect("sampled");
    assert_eq!(accuracy.stopped, Why::Time);
    let sampling = Sampling { stop_at: Some(accuracy.at), ..Sampling::default() };
    assert_same(&by_time, &picture(64, sampling, 1, half_plane));
}

#[test]
fn what_is_interrupted_is_a_picture() {
    let cancel = AtomicBool::new(true);
    let rendered = try_picture(64, asked(0.001, 0), Some(&cancel), half_plane).expect("rendered");
    let accuracy = rendered.accuracy.expect("sampled");
    assert_eq!((accuracy.stopped, accuracy.unseen, accuracy.samples), (Why::Interrupted, 4096, 0));
    assert_eq!(accuracy.predicted, 1.0);
}

#[test]
fn places_to_stop_at_are_read_and_written() {
    let at = StopAt { round: 3, pieces: 120 };
    assert_eq!(at.to_string().parse(), Ok(at));
    for bad in ["", "3", "3:", ":1", "3:-1", "3:1:2", "4294967296:0"] {
        assert!(bad.parse::<StopAt>().is_err(), "{bad}");
    }
}
