//! Known failures that wait for something which Lancer does not do yet, with
//! the reason, so that none is forgotten; and that each of the others has a test.

use lancer_tests::paths::{all_with_extension, top};
use std::collections::BTreeSet;

/// Number of the failure, what it is, and what it waits for.
const DEFERRED: &[(&str, &str, &str)] = &[
    (
        "G1",
        "faces of solids that coincide where one is cut out of the other",
        "there are no solids combined by boolean operations yet",
    ),
    (
        "G2",
        "identities of combined solids, and as many entries as exits",
        "there are no solids combined by boolean operations yet",
    ),
];

/// All known failures: each group and how many there are in it.
const GROUPS: [(char, u32); 15] = [
    ('S', 6),
    ('P', 3),
    ('C', 7),
    ('B', 3),
    ('T', 5),
    ('V', 4),
    ('G', 2),
    ('K', 3),
    ('H', 5),
    ('R', 2),
    ('D', 7),
    ('X', 3),
    ('A', 4),
    ('O', 3),
    ('I', 3),
];

#[test]
fn each_has_a_reason() {
    for (number, what, why) in DEFERRED {
        assert!(!number.is_empty() && !what.is_empty() && !why.is_empty(), "{number}");
    }
}

/// The numbers with which names of tests begin, in the files beside this one and in those of the
/// crates: what lamps with a size and sampling do is tested there.
fn tested() -> BTreeSet<String> {
    let mut numbers = BTreeSet::new();
    let folders = ["tests/tests/stability", "crates"].map(|folder| top().join(folder));
    for path in folders.iter().flat_map(|folder| all_with_extension(folder, "rs")) {
        let text = std::fs::read_to_string(&path).expect("it is there");
        // What is not a test, like a function that tests call, does not count.
        for after in text.split("#[test]\n").skip(1) {
            let Some(name) = after.trim_start().strip_prefix("fn ") else { continue };
            if let Some((number, _)) = name.split_once('_') {
                numbers.insert(number.to_uppercase());
            }
        }
    }
    numbers
}

/// None is forgotten, and none is put off that has all that it waits for.
#[test]
fn each_failure_has_a_test_or_a_reason() {
    let all = GROUPS
        .iter()
        .flat_map(|(group, count)| (1..=*count).map(move |number| format!("{group}{number}")));
    let all: BTreeSet<String> = all.collect();
    assert_eq!(all.len(), 60);
    let deferred: BTreeSet<String> =
        DEFERRED.iter().map(|(number, _, _)| (*number).to_owned()).collect();
    assert!(deferred.is_subset(&all), "each is one that is known");
    let tested = tested();
    let forgotten: Vec<_> = all
        .iter()
        .filter(|number| !tested.contains(*number) && !deferred.contains(*number))
        .collect();
    assert!(forgotten.is_empty(), "neither tested nor put off: {forgotten:?}");
    let both: Vec<_> = deferred.intersection(&tested).collect();
    assert!(both.is_empty(), "tested although they are put off: {both:?}");
}
