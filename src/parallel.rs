//! Loops over all cores.
//!
//! Rayon builds its iterators anew for every closure that they are given: with them in forty places, a fifth of the code that the compiler worked on
//! was theirs. Here one loop serves all.

use std::{
    ops::Range,
    sync::{Mutex, MutexGuard, PoisonError},
};

use rayon::prelude::*;

/// Parts of a loop for each core. With many small parts, no core stays idle for long while another one finishes.
const PARTS_PER_CORE: usize = 16;

/// The values of a function at `0..count`, in order.
pub fn map<T: Send>(count: usize, value: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let ranges = parts(count);
    let found: Vec<Mutex<Vec<T>>> = ranges.iter().map(|_| Mutex::default()).collect();
    each(ranges.len(), &|part| {
        let values = ranges[part].clone().map(&value).collect();
        *locked(&found[part]) = values;
    });
    let mut all = Vec::with_capacity(count);
    for part in found {
        all.append(&mut part.into_inner().unwrap_or_else(PoisonError::into_inner));
    }
    all
}

/// Changes a list in place, in chunks of a length, the last of which may be shorter. The function is told which chunk it is given; what it answers
/// for each is returned in order.
pub fn change<T: Send, R: Send>(list: &mut [T], length: usize, change: impl Fn(usize, &mut [T]) -> R + Sync) -> Vec<R> {
    let chunks: Vec<Mutex<&mut [T]>> = list.chunks_mut(length.max(1)).map(Mutex::new).collect();
    map(chunks.len(), |chunk| change(chunk, &mut locked(&chunks[chunk])))
}

/// Ranges of nearly equal lengths that make up `0..count`.
fn parts(count: usize) -> Vec<Range<usize>> {
    let parts = count.min(PARTS_PER_CORE * rayon::current_num_threads());
    (0..parts).map(|part| part * count / parts..(part + 1) * count / parts).collect()
}

fn each(count: usize, work: &(dyn Fn(usize) + Sync)) {
    (0..count).into_par_iter().for_each(work);
}

/// Each part is locked once. Where a function panics, so does the loop.
fn locked<T>(part: &Mutex<T>) -> MutexGuard<'_, T> {
    part.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_in_order_whatever_their_number() {
        for count in [0, 1, 2, 31, 1000, 12_345] {
            assert_eq!(map(count, |k| 3 * k), (0..count).map(|k| 3 * k).collect::<Vec<_>>());
        }
    }

    #[test]
    fn every_chunk_is_changed_once_and_knows_its_place() {
        let mut list = vec![0; 1003];
        let lengths = change(&mut list, 10, |chunk, values| {
            values.iter_mut().for_each(|value| *value += chunk + 1);
            values.len()
        });
        assert_eq!(lengths, [vec![10; 100], vec![3]].concat());
        assert_eq!(list, (0..1003).map(|k| k / 10 + 1).collect::<Vec<_>>());
        change(&mut [0; 0], 10, |_, _: &mut [i32]| unreachable!("there is nothing to change"));
    }
}
