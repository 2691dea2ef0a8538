//! In which order are postures measured with short ways?

/// Orders runs so that the joints travel little: the nearest next, then turning round pieces of the way as long as that is shorter.
///
/// A way takes as long as its slowest joint; joints of which no speed is known turn alike.
pub(super) fn order<T>(runs: &mut Vec<T>, speeds: Option<[f64; 6]>, posture: impl Fn(&T) -> [f64; 6]) {
    let speed = speeds.unwrap_or([1.0; 6]);
    let time = |a: &T, b: &T| {
        let [from, to] = [a, b].map(&posture);
        (0..6).map(|i| (from[i] - to[i]).abs() / speed[i]).fold(0.0, f64::max)
    };
    let mut left = std::mem::take(runs);
    if left.is_empty() {
        return;
    }
    runs.push(left.remove(0));
    while !left.is_empty() {
        let last = &runs[runs.len() - 1];
        // Runs of one posture follow one another: their way is nothing.
        let next = (0..left.len()).min_by(|&i, &j| time(last, &left[i]).total_cmp(&time(last, &left[j]))).unwrap_or(0);
        let next = left.remove(next);
        runs.push(next);
    }
    let count = runs.len();
    loop {
        let mut improved = false;
        for start in 1..count {
            for end in start + 1..=count {
                let after = |runs: &[T], a: usize, b: usize| if b < count { time(&runs[a], &runs[b]) } else { 0.0 };
                let now = time(&runs[start - 1], &runs[start]) + after(runs, end - 1, end);
                let turned = time(&runs[start - 1], &runs[end - 1]) + after(runs, start, end);
                if turned < now - 1e-12 {
                    runs[start..end].reverse();
                    improved = true;
                }
            }
        }
        if !improved {
            return;
        }
    }
}
