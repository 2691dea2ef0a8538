//! The same question about many things, on all threads: answers are in the order of the things, whoever has finished first.
//!
//! Every question is called through a pointer, so that what shares the work among threads is compiled once. For questions of a microsecond or
//! more.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock};

use rayon::prelude::*;

/// All is shared in so many portions or more: what takes long keeps few others waiting.
const PORTIONS: usize = 128;

/// The answer about each of some things.
pub(crate) fn each<'t, T: Sync, R: Send + Sync>(things: &'t [T], ask: impl Fn(&'t T) -> R + Sync) -> Vec<R> {
    numbered(things.len(), &|i| ask(&things[i]))
}

/// The answer about each number below `count`.
pub(crate) fn each_of<R: Send + Sync>(count: usize, ask: impl Fn(usize) -> R + Sync) -> Vec<R> {
    numbered(count, &ask)
}

/// The answer about each of some things, or the first error in their order: those after it are left out.
pub(crate) fn try_each<'t, T: Sync, R: Send + Sync, E: Send + Sync>(
    things: &'t [T],
    ask: impl Fn(&'t T) -> Result<R, E> + Sync,
) -> Result<Vec<R>, E> {
    tried(things.len(), &|i| ask(&things[i]))
}

/// As [`try_each`], about each number below `count`.
pub(crate) fn try_each_of<R: Send + Sync, E: Send + Sync>(
    count: usize,
    ask: impl Fn(usize) -> Result<R, E> + Sync,
) -> Result<Vec<R>, E> {
    tried(count, &ask)
}

/// The answer about each of some things, which are given away; with its number.
pub(crate) fn take_each<T: Send, R: Send + Sync>(
    things: impl Iterator<Item = T>,
    ask: impl Fn(usize, T) -> R + Sync,
) -> Vec<R> {
    let things = given(things);
    numbered(things.len(), &|i| ask(i, taken(&things[i])))
}

/// As [`take_each`]; or the first error, as [`try_each`].
pub(crate) fn try_take_each<T: Send, R: Send + Sync, E: Send + Sync>(
    things: impl Iterator<Item = T>,
    ask: impl Fn(usize, T) -> Result<R, E> + Sync,
) -> Result<Vec<R>, E> {
    let things = given(things);
    tried(things.len(), &|i| ask(i, taken(&things[i])))
}

/// An answer about any number below `count` that has one; once it is found, no more are asked about.
pub(crate) fn any_of<R: Send + Sync>(count: usize, ask: impl Fn(usize) -> Option<R> + Sync) -> Option<R> {
    let found = OnceLock::new();
    shared(count, &|i| {
        if found.get().is_none()
            && let Some(answer) = ask(i)
        {
            found.get_or_init(|| answer);
        }
    });
    found.into_inner()
}

fn given<T>(things: impl Iterator<Item = T>) -> Vec<Mutex<Option<T>>> {
    things.map(|thing| Mutex::new(Some(thing))).collect()
}

fn taken<T>(thing: &Mutex<Option<T>>) -> T {
    thing.try_lock().ok().and_then(|mut thing| thing.take()).expect("each is taken once")
}

fn numbered<R: Send + Sync>(count: usize, ask: &(dyn Fn(usize) -> R + Sync)) -> Vec<R> {
    let answers: Vec<OnceLock<R>> = (0..count).map(|_| OnceLock::new()).collect();
    shared(count, &|i| {
        answers[i].get_or_init(|| ask(i));
    });
    answers.into_iter().map(|answer| answer.into_inner().expect("each was asked about")).collect()
}

fn tried<R: Send + Sync, E: Send + Sync>(
    count: usize,
    ask: &(dyn Fn(usize) -> Result<R, E> + Sync),
) -> Result<Vec<R>, E> {
    let first_error = AtomicUsize::new(usize::MAX);
    let answers = numbered(count, &|i| {
        if first_error.load(Ordering::Relaxed) < i {
            return None;
        }
        let answer = ask(i);
        if answer.is_err() {
            first_error.fetch_min(i, Ordering::Relaxed);
        }
        Some(answer)
    });
    answers.into_iter().flatten().collect()
}

fn shared(count: usize, work: &(dyn Fn(usize) + Sync)) {
    // To wake another thread takes longer than much of the work.
    if count == 1 {
        return work(0);
    }
    (0..count).into_par_iter().with_max_len(count.div_ceil(PORTIONS).max(1)).for_each(work);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_in_the_order_of_the_things() {
        let things: Vec<usize> = (0..5000).rev().collect();
        assert_eq!(each(&things, |thing| 3 * thing), things.iter().map(|thing| 3 * thing).collect::<Vec<_>>());
        assert_eq!(each_of(3, |i| i * i), [0, 1, 4]);
        assert!(each_of(0, |i| i).is_empty());
    }

    #[test]
    fn the_first_error_in_order_is_returned_and_all_before_it_are_asked_about() {
        let asked: Vec<AtomicUsize> = (0..5000).map(|_| AtomicUsize::new(0)).collect();
        let ask = |i: usize| {
            asked[i].fetch_add(1, Ordering::Relaxed);
            if i % 1000 == 777 { Err(i) } else { Ok(i) }
        };
        assert_eq!(try_each_of(5000, ask), Err(777));
        let times: Vec<usize> = asked.into_iter().map(AtomicUsize::into_inner).collect();
        assert!(times[..=777].iter().all(|times| *times == 1) && times[777..].iter().all(|times| *times <= 1));
        assert_eq!(try_each(&[1, 2], |thing| Ok::<_, ()>(*thing)), Ok(vec![1, 2]));
    }

    /// One thread asks in order.
    #[test]
    fn after_an_error_or_an_answer_that_is_enough_nothing_more_is_asked_about() {
        let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let asked = AtomicUsize::new(0);
        let ask = |i: usize| {
            asked.fetch_add(1, Ordering::Relaxed);
            if i == 777 { Err(i) } else { Ok(i) }
        };
        assert_eq!(alone.install(|| try_each_of(5000, ask)), Err(777));
        assert_eq!(asked.swap(0, Ordering::Relaxed), 778);
        assert_eq!(alone.install(|| any_of(5000, |i| ask(i).err())), Some(777));
        assert_eq!(asked.into_inner(), 778);
    }

    #[test]
    fn what_is_given_away_is_taken_once() {
        let mut values = vec![0; 1001];
        let lengths = take_each(values.chunks_mut(10), |run, values| {
            for value in &mut *values {
                *value += run + 1;
            }
            values.len()
        });
        assert_eq!(values, (0..1001).map(|i| i / 10 + 1).collect::<Vec<_>>());
        assert_eq!((lengths.len(), lengths.iter().sum()), (101, 1001));
        let halves =
            try_take_each([2, 4, 5, 6, 7].into_iter(), |i, value| if value % 2 == 0 { Ok(value / 2) } else { Err(i) });
        assert_eq!(halves, Err(2));
    }

    #[test]
    fn any_answer_is_one_of_those_there_are() {
        assert!(any_of(5000, |i| (i % 1000 == 999).then_some(i)).is_some_and(|i| i % 1000 == 999));
        assert_eq!(any_of(5000, |_| None::<()>), None);
    }
}
