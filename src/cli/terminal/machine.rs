//! The machine that measurements run on, and its clocks.

use crate::accuracy::timing::Machine;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// Returns the time since the first call.
pub(crate) fn elapsed_time() -> Duration {
    static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);
    BEGUN.elapsed()
}

/// Returns the processor time that the threads of this process have used so far, which is independent of the load of the machine.
#[cfg(unix)]
pub(crate) fn processor_time() -> Duration {
    let told = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Duration::try_from(told).unwrap_or_default()
}

/// Returns the time on the clock, if no other is available.
#[cfg(not(unix))]
pub(crate) fn processor_time() -> Duration {
    elapsed_time()
}

/// Returns the value of a line such as `model name : AMD EPYC` of a file of the system.
fn read_value(file: &str, key: &str) -> Option<String> {
    let text = std::fs::read_to_string(file).ok()?;
    let line = text.lines().find(|l| l.starts_with(key))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

/// Returns the memory of the machine, in bytes.
#[cfg(target_os = "linux")]
pub(crate) fn total_memory() -> Option<u64> {
    let told = rustix::system::sysinfo();
    #[allow(
        clippy::useless_conversion,
        reason = "it has fewer bits on other processors"
    )]
    let (total, unit) = (u64::from(told.totalram), u64::from(told.mem_unit));
    total.checked_mul(unit)
}

/// Returns the memory of the machine, in bytes.
#[cfg(not(target_os = "linux"))]
pub(crate) fn total_memory() -> Option<u64> {
    let mut system = sysinfo::System::new();
    system.refresh_memory();
    Some(system.total_memory()).filter(|bytes| *bytes > 0)
}

/// Returns the size of the address space of this process, in bytes.
pub(crate) fn address_space() -> Option<u64> {
    read_kilobytes("/proc/self/status", "VmSize")
}

/// Returns the peak memory of this process, in bytes.
pub(crate) fn peak_memory() -> Option<u64> {
    read_kilobytes("/proc/self/status", "VmHWM")
}

/// Returns a number of kilobytes of a file of the system, in bytes.
fn read_kilobytes(file: &str, key: &str) -> Option<u64> {
    let kilobytes = read_value(file, key)?;
    Some(1024 * kilobytes.split(' ').next()?.parse::<u64>().ok()?)
}

/// Returns this machine, as far as its system describes it.
pub(crate) fn this_machine() -> Machine {
    let architecture = std::env::consts::ARCH;
    let named = ["model name", "Hardware", "cpu model"];
    let processor = named
        .iter()
        .find_map(|key| read_value("/proc/cpuinfo", key))
        .or_else(|| std::env::var("PROCESSOR_IDENTIFIER").ok());
    let threads = rayon::current_num_threads();
    Machine {
        processor: processor.unwrap_or_else(|| format!("{architecture} processor")),
        threads,
        cores: std::thread::available_parallelism().map_or(threads, usize::from),
        memory: total_memory(),
        system: format!("{} {architecture}", std::env::consts::OS),
        version: env!("CARGO_PKG_VERSION"),
        optimised: !cfg!(debug_assertions),
        clock: if cfg!(unix) { "processor time" } else { "time" },
    }
}
