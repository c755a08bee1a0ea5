//! Known failures that wait for something which Lancer does not do yet, with
//! the reason, so that none is forgotten.

/// Number of the failure, what it is, and what it waits for.
const DEFERRED: &[(&str, &str, &str)] = &[];

#[test]
fn each_has_a_reason() {
    for (number, what, why) in DEFERRED {
        assert!(!number.is_empty() && !what.is_empty() && !why.is_empty(), "{number}");
    }
}
