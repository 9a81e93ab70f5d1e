//! Stable sorting that is compiled once.
//!
//! The sorts of the standard library are compiled anew for every order that they are given, as some 25 functions. A user's build compiles
//! the compiler of specs without optimization, and these copies were a sixth of some crates of it. Here only the comparison and the exchange of two elements
//! depend on the call.

use std::cmp::Ordering;

/// Sorts by an order; elements that are equal in it keep their places relative to each other. Takes memory for an index of each element.
pub fn sort_by<T>(list: &mut [T], mut order: impl FnMut(&T, &T) -> Ordering) {
    if list.len() < 2 {
        return;
    }
    let places = places(list.len(), &mut |a, b| order(&list[a], &list[b]));
    arrange(places, &mut |a, b| list.swap(a, b));
}

/// [`sort_by`] the order of a key, which is computed for both elements of every comparison.
pub fn sort_by_key<T, K: Ord>(list: &mut [T], mut key: impl FnMut(&T) -> K) {
    sort_by(list, |a, b| key(a).cmp(&key(b)));
}

/// For each element its place in the sorted list.
fn places(count: usize, order: &mut dyn FnMut(usize, usize) -> Ordering) -> Vec<usize> {
    let mut sorted: Vec<usize> = (0..count).collect();
    sorted.sort_by(|a, b| order(*a, *b));
    let mut places = vec![0; count];
    for (place, element) in sorted.into_iter().enumerate() {
        places[element] = place;
    }
    places
}

/// Brings each element to its place by exchanges, of which each brings at least one there.
fn arrange(mut places: Vec<usize>, exchange: &mut dyn FnMut(usize, usize)) {
    for here in 0..places.len() {
        while places[here] != here {
            let place = places[here];
            exchange(here, place);
            places.swap(here, place);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{sort_by, sort_by_key};

    /// The standard library's stable sort is the reference, on lists with many equal keys.
    #[test]
    fn lists_are_sorted_as_by_the_standard_library() {
        let mut state = 1_u64;
        let mut random = |below: u64| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 33) % below
        };
        for count in 0..60 {
            let list: Vec<(u64, usize)> = (0..count).map(|i| (random(9), i)).collect();
            let (mut by_key, mut by_order, mut expected) = (list.clone(), list.clone(), list);
            expected.sort_by_key(|(key, _)| *key);
            sort_by_key(&mut by_key, |(key, _)| *key);
            assert_eq!(by_key, expected);
            expected.sort_by_key(|b| std::cmp::Reverse(b.0 % 4));
            sort_by(&mut by_order, |a, b| a.0.cmp(&b.0));
            sort_by(&mut by_order, |a, b| (b.0 % 4).cmp(&(a.0 % 4)));
            assert_eq!(by_order, expected);
        }
    }
}
