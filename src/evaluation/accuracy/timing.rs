//! How long something takes: on which machine, by which clock, how often, and how far the times spread.
//!
//! The clock is the caller's, so that nothing here reads one by itself.

use serde::Serialize;
use std::fmt;
use std::hint::black_box;
use std::time::Duration;

/// Something slow is not repeated again once its timing has taken so long, and it was done [`LEAST`] times.
const PATIENCE: Duration = Duration::from_millis(200);
/// Or so long, however often.
const LONG: Duration = Duration::from_secs(2);
/// The least number of times that a median is taken of.
const LEAST: usize = 3;

/// The time since some moment, never less than before.
pub type Clock = fn() -> Duration;

/// What times are measured on: a figure of speed says nothing without it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Machine {
    /// The processor's name, or that of its kind.
    pub processor: String,
    /// Threads used.
    pub threads: usize,
    /// Processors there are.
    pub cores: usize,
    /// Bytes of memory, if the system reports it.
    #[serde(rename = "memory_bytes")]
    pub memory: Option<u64>,
    /// The operating system.
    pub system: String,
    /// The program's version.
    pub version: &'static str,
    /// Whether the program was compiled for speed.
    pub optimised: bool,
    /// What times are: "processor time", which other programs hardly change, or "time" on the wall.
    pub clock: &'static str,
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Machine {
            processor,
            threads,
            cores,
            system,
            version,
            ..
        } = self;
        write!(f, "{processor}, {threads} of {cores} cores")?;
        if let Some(bytes) = self.memory {
            write!(f, ", {} GB", (bytes + 500_000_000) / 1_000_000_000)?;
        }
        write!(f, ", {system}; ozols {version}")?;
        if !self.optimised {
            write!(
                f,
                ", a development build, which is slower than a release build"
            )?;
        }
        Ok(())
    }
}

/// Times of one thing, in seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// The middle of them.
    pub median: f64,
    /// The shortest.
    pub least: f64,
    /// The longest.
    pub most: f64,
    /// How many there are.
    pub repeats: usize,
}

impl Timing {
    /// Creates the timing from at least one time.
    pub fn of(times: &[f64]) -> Timing {
        let [least, median, most] = [0.0, 0.5, 1.0].map(|at| quantile(times, at));
        Timing {
            median,
            least,
            most,
            repeats: times.len(),
        }
    }
}

/// How times are taken.
#[derive(Debug, Clone, Copy)]
pub struct Stopwatch {
    /// The clock.
    pub clock: Clock,
    /// The largest number of repetitions. There is at least one.
    pub repeat: usize,
}

impl Stopwatch {
    /// Does something up to `repeat` times, and returns the last result with the times. If there are several, the first one does not
    /// count.
    pub fn time_repeatedly<T>(&self, mut f: impl FnMut() -> T) -> (T, Timing) {
        let begun = (self.clock)();
        let mut times = Vec::new();
        loop {
            let start = (self.clock)();
            let found = black_box(f());
            let end = (self.clock)();
            times.push((end - start).as_secs_f64());
            let (spent, counted) = (end - begun, times.len() - 1);
            let enough = counted >= LEAST && spent >= PATIENCE;
            if self.repeat <= 1 || counted >= self.repeat || enough || spent >= LONG {
                // The first finds caches cold.
                let warm = &times[usize::from(counted > 0)..];
                return (found, Timing::of(warm));
            }
        }
    }
}

/// Returns the value below which a share of some numbers lies, with linear interpolation between neighbours. Returns 0 if
/// there are no numbers.
pub(crate) fn quantile(of: &[f64], share: f64) -> f64 {
    let mut of = of.to_vec();
    of.sort_by(f64::total_cmp);
    let Some(last) = of.len().checked_sub(1) else {
        return 0.0;
    };
    let at = share * last as f64;
    let (low, part) = (at.floor() as usize, at.fract());
    of[low] + part * (of[(low + 1).min(last)] - of[low])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicU64, Ordering};

    #[test]
    fn quantiles_lie_between_neighbours() {
        let at = |share| quantile(&[4.0, 1.0, 3.0, 2.0], share);
        assert_eq!([0.0, 0.25, 0.5, 1.0].map(at), [1.0, 1.75, 2.5, 4.0]);
        assert_eq!((quantile(&[], 0.5), quantile(&[7.0], 0.9)), (0.0, 7.0));
    }

    #[test]
    fn something_slow_is_not_repeated() {
        static NOW: AtomicU64 = AtomicU64::new(0);
        fn clock() -> Duration {
            Duration::from_millis(NOW.fetch_add(10, Ordering::Relaxed))
        }
        let watch = |repeat| Stopwatch { clock, repeat }.time_repeatedly(|| ()).1;
        assert_eq!(watch(5).repeats, 5);
        assert_eq!(watch(0).repeats, 1);
        // Each repeat takes two readings of the clock, 20 ms; the first does not count.
        let many = watch(1000);
        assert_eq!((many.repeats, many.least, many.most), (9, 0.01, 0.01));
    }
}
