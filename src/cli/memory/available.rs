//! How much memory there is for a process that begins: the least of what the machine has free, of the limit of its control
//! group, and of what the shell allows.

use crate::model::{LimitedBy, Memory};
use std::path::Path;

/// What there is; without a limit where the system does not tell.
pub(super) fn memory() -> Memory {
    let read = |path: &Path| std::fs::read_to_string(path).ok();
    let found = [
        (shell(), LimitedBy::Shell),
        (read(Path::new("/proc/self/cgroup")).and_then(|text| groups(&text, &read)), LimitedBy::Group),
        (read(Path::new("/proc/meminfo")).and_then(|text| machine(&text)), LimitedBy::Machine),
    ];
    let least = found.into_iter().filter_map(|(bytes, by)| Some((bytes?, by))).min_by_key(|(bytes, _)| *bytes);
    least.map_or_else(Memory::default, |(bytes, by)| Memory::limited(bytes, by))
}

/// What the shell allows.
#[cfg(unix)]
fn shell() -> Option<u64> {
    use rustix::process::{Resource, getrlimit};
    [Resource::As, Resource::Data].into_iter().filter_map(|resource| getrlimit(resource).current).min()
}

#[cfg(not(unix))]
fn shell() -> Option<u64> {
    None
}

/// What can be had without others being ended for it: memory, and swap space.
fn machine(meminfo: &str) -> Option<u64> {
    let kib = |name: &str| {
        let value = meminfo.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(':'))?;
        value.split_whitespace().next()?.parse::<u64>().ok()
    };
    Some(1024 * (kib("MemAvailable")? + kib("SwapFree").unwrap_or(0)))
}

/// What the control groups of a process leave it, of both versions of the interface: the limit of each group and of those around
/// it, less what is in use there and cannot be given up.
fn groups(cgroup: &str, read: &impl Fn(&Path) -> Option<String>) -> Option<u64> {
    let number = |path: &Path| read(path)?.trim().parse::<u64>().ok();
    let mut least: Option<u64> = None;
    for line in cgroup.lines() {
        // Number, controllers, path.
        let mut fields = line.splitn(3, ':').skip(1);
        let (Some(controllers), Some(path)) = (fields.next(), fields.next()) else { continue };
        let (root, most, used, idle) = if controllers.is_empty() {
            ("/sys/fs/cgroup", "memory.max", "memory.current", "inactive_file ")
        } else if controllers.split(',').any(|name| name == "memory") {
            ("/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file ")
        } else {
            continue;
        };
        let inner = Path::new(root).join(path.trim_start_matches('/'));
        for folder in inner.ancestors().take_while(|folder| folder.starts_with(root)) {
            let Some(most) = number(&folder.join(most)) else { continue };
            let used = number(&folder.join(used)).unwrap_or(0);
            let stat = read(&folder.join("memory.stat")).unwrap_or_default();
            let idle = stat.lines().find_map(|line| line.strip_prefix(idle)?.trim().parse::<u64>().ok()).unwrap_or(0);
            let free = most.saturating_sub(used.saturating_sub(idle));
            least = Some(least.map_or(free, |least| least.min(free)));
        }
    }
    least
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn of_the_machine() {
        let text = "MemTotal:       24683520 kB\nMemFree:         2254848 kB\nMemAvailable:   24068096 kB\nSwapFree:           1024 kB\n";
        assert_eq!(machine(text), Some(1024 * (24_068_096 + 1024)));
        assert_eq!(machine("MemAvailable: 7 kB\n"), Some(7168));
        assert_eq!(machine("MemFree: 7 kB\n"), None);
    }

    #[test]
    fn of_groups() {
        let of = |cgroup: &str, files: &[(&str, &str)]| {
            let files: BTreeMap<&str, &str> = files.iter().copied().collect();
            groups(cgroup, &|path: &Path| files.get(path.to_str()?).map(|text| (*text).to_owned()))
        };
        // Version 2: the group itself has no limit, the one around it has; half of its use can be given up.
        let files = [
            ("/sys/fs/cgroup/a/b/memory.max", "max\n"),
            ("/sys/fs/cgroup/a/memory.max", "1000\n"),
            ("/sys/fs/cgroup/a/memory.current", "600\n"),
            ("/sys/fs/cgroup/a/memory.stat", "anon 300\ninactive_file 300\nactive_file 0\n"),
        ];
        assert_eq!(of("0::/a/b\n", &files), Some(700));
        assert_eq!(of("0::/\n", &[("/sys/fs/cgroup/memory.max", "5000")]), Some(5000));
        // Version 1; other controllers do not matter.
        let files = [
            ("/sys/fs/cgroup/memory/c/memory.limit_in_bytes", "400\n"),
            ("/sys/fs/cgroup/memory/c/memory.usage_in_bytes", "500\n"),
            ("/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n"),
        ];
        assert_eq!(of("5:cpu:/c\n4:cpuset,memory:/c\n0::/\n", &files), Some(0));
        assert_eq!(of("4:memory:/d\n", &files), Some(9_223_372_036_854_771_712));
        assert_eq!(of("", &files), None);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn this_machine_has_some() {
        assert!(memory().limit().is_some_and(|(bytes, _)| bytes > 1_000_000));
    }
}
