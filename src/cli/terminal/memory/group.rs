//! The memory limit of the process's control group and of the groups around it: versions 1 and 2 of Linux.
//!
//! `sysinfo` reads the same from its version 0.39 on, which needs a later Rust than ozols does.

use std::fs::read_to_string;
use std::path::{Path, PathBuf};

/// Returns the limit in bytes. `None` if there is no limit, and off Linux.
pub(super) fn group_limit() -> Option<u64> {
    let own = read_to_string("/proc/self/cgroup").ok()?;
    let mounts = read_to_string("/proc/self/mountinfo").ok()?;
    let limits = limit_files(&own, &mounts)
        .into_iter()
        .filter_map(|f| read_to_string(f).ok())
        // "max" is none.
        .filter_map(|text| text.trim().parse().ok());
    limits.min()
}

/// Returns the files that may hold a limit, those of the group itself first.
fn limit_files(own: &str, mounts: &str) -> Vec<PathBuf> {
    let mut out = Vec::new();
    for line in own.lines() {
        let mut parts = line.splitn(3, ':');
        let (Some(_), Some(controllers), Some(group)) = (parts.next(), parts.next(), parts.next())
        else {
            continue;
        };
        let (kind, name) = match controllers {
            "" => ("cgroup2", "memory.max"),
            c if c.split(',').any(|c| c == "memory") => ("cgroup", "memory.limit_in_bytes"),
            _ => continue,
        };
        for mount in mounts.lines().filter_map(Mount::read_mount) {
            if mount.kind == kind && (kind == "cgroup2" || mount.holds_memory) {
                let inner = Path::new(group).strip_prefix(&mount.root);
                // A group of another namespace is not seen: the mount itself is the nearest.
                let inner = inner
                    .ok()
                    .filter(|p| !p.starts_with(".."))
                    .unwrap_or(Path::new(""));
                let all = inner.ancestors().map(|p| mount.at.join(p).join(name));
                out.extend(all);
            }
        }
    }
    out
}

/// The place where a hierarchy of groups is mounted.
struct Mount<'a> {
    root: PathBuf,
    at: PathBuf,
    kind: &'a str,
    holds_memory: bool,
}

impl<'a> Mount<'a> {
    /// Reads a line of `mountinfo`: ID, parent, device, root, place, options, ... - kind, source, options of the hierarchy.
    fn read_mount(line: &'a str) -> Option<Mount<'a>> {
        let (first, second) = line.split_once(" - ")?;
        let mut first = first.split(' ').skip(3);
        let mut second = second.split(' ');
        let path = |word: &str| PathBuf::from(word.replace("\\040", " "));
        Some(Mount {
            root: path(first.next()?),
            at: path(first.next()?),
            kind: second.next()?,
            holds_memory: second.nth(1)?.split(',').any(|o| o == "memory"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::limit_files;

    fn found(own: &str, mounts: &str) -> Vec<String> {
        let all = limit_files(own, mounts).into_iter();
        all.map(|f| f.to_str().unwrap().to_owned()).collect()
    }

    #[test]
    fn the_second_version_is_read_from_the_group_up() {
        let mounts = "24 1 0:22 / /sys rw - sysfs sysfs rw\n\
                      30 24 0:26 / /sys/fs/cgroup rw,nosuid shared:9 - cgroup2 cgroup2 rw,nsdelegate\n";
        assert_eq!(
            found("0::/user.slice/a.scope\n", mounts),
            [
                "/sys/fs/cgroup/user.slice/a.scope/memory.max",
                "/sys/fs/cgroup/user.slice/memory.max",
                "/sys/fs/cgroup/memory.max"
            ]
        );
        assert_eq!(found("0::/\n", mounts), ["/sys/fs/cgroup/memory.max"]);
        // Seen from another namespace.
        assert_eq!(found("0::/../x\n", mounts), ["/sys/fs/cgroup/memory.max"]);
    }

    #[test]
    fn the_first_version_is_read_where_memory_is_mounted() {
        let own = "12:cpu,cpuacct:/docker/abc\n5:memory:/docker/abc\n0::/\n";
        let mounts = "33 30 0:28 /docker/abc /sys/fs/cgroup/memory ro - cgroup cgroup rw,memory\n\
                      34 30 0:29 /docker/abc /sys/fs/cgroup/cpu,cpuacct ro - cgroup cgroup rw,cpu,cpuacct\n";
        assert_eq!(
            found(own, mounts),
            ["/sys/fs/cgroup/memory/memory.limit_in_bytes"]
        );
        let mounts = "33 30 0:28 / /cg/my\\040memory rw - cgroup cgroup rw,memory\n";
        assert_eq!(
            found(own, mounts),
            [
                "/cg/my memory/docker/abc/memory.limit_in_bytes",
                "/cg/my memory/docker/memory.limit_in_bytes",
                "/cg/my memory/memory.limit_in_bytes"
            ]
        );
    }

    #[test]
    fn what_is_no_such_line_is_passed_over() {
        assert!(found("x\n1:name=systemd:/a\n", "y\n- - -\n").is_empty());
    }
}
