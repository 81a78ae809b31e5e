//! Jobs that would get in each other's way.

use super::target::{Identity, Target, follow_links};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What a job writes and reads.
#[derive(Clone, Debug, Default)]
pub struct Footprint {
    /// Its outputs.
    pub outputs: Vec<Target>,
    /// The files it reads.
    pub inputs: Vec<PathBuf>,
}

/// How two jobs of a list, named by their positions, get in each other's way.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Clash {
    /// Both write the same file.
    Outputs {
        /// The first job, and its name for the file.
        first: (usize, Target),
        /// The other.
        second: (usize, Target),
    },
    /// One writes what the other reads: what comes out would depend on which is done first.
    Input {
        /// The job that writes, and its name for the file.
        writer: (usize, Target),
        /// The job that reads, and its name for the file.
        reader: (usize, PathBuf),
    },
}

/// The first two jobs of a list that get in each other's way, if any do. Links are followed; devices such as `/dev/null` may be
/// shared. What cannot be found out, because a folder is missing, is left to the job itself.
pub fn first_clash(jobs: &[Footprint]) -> Option<Clash> {
    let mut written: BTreeMap<Identity, (usize, &Target)> = BTreeMap::new();
    for (job, footprint) in jobs.iter().enumerate() {
        for target in &footprint.outputs {
            let Some(identity) = identity(target).filter(|identity| *identity != Identity::Shared) else { continue };
            match written.get(&identity) {
                Some((first, name)) if *first != job => {
                    return Some(Clash::Outputs { first: (*first, (*name).clone()), second: (job, target.clone()) });
                }
                Some(_) => {}
                None => drop(written.insert(identity, (job, target))),
            }
        }
    }
    for (job, footprint) in jobs.iter().enumerate() {
        for path in &footprint.inputs {
            let Some((writer, target)) = of_path(path).and_then(|identity| written.get(&identity)) else { continue };
            if *writer != job {
                return Some(Clash::Input { writer: (*writer, (*target).clone()), reader: (job, path.clone()) });
            }
        }
    }
    None
}

fn identity(target: &Target) -> Option<Identity> {
    match target {
        Target::Stdout => Some(Identity::of_stdout()),
        Target::File(path) if target.is_stream() => Identity::of(path).ok(),
        Target::File(path) => of_path(path),
    }
}

fn of_path(path: &Path) -> Option<Identity> {
    Identity::of(&follow_links(path)).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn job(outputs: &[&PathBuf], inputs: &[&PathBuf]) -> Footprint {
        Footprint {
            outputs: outputs.iter().map(|path| Target::File((*path).clone())).collect(),
            inputs: inputs.iter().map(|path| (*path).clone()).collect(),
        }
    }

    #[test]
    fn names_for_the_same_file() {
        let folder = tempfile::tempdir().unwrap();
        let (a, b) = (folder.path().join("a.obj"), folder.path().join("b.obj"));
        let detour = folder.path().join(".").join("a.obj");
        let jobs = [job(&[&b], &[]), job(&[&a], &[]), job(&[&detour], &[])];
        // Neither file exists yet.
        let expected = Clash::Outputs { first: (1, Target::File(a.clone())), second: (2, Target::File(detour.clone())) };
        assert_eq!(first_clash(&jobs), Some(expected.clone()));
        std::fs::write(&a, "").unwrap();
        assert_eq!(first_clash(&jobs), Some(expected));
        assert_eq!(first_clash(&jobs[..2]), None);
        // Within one job the outputs themselves are checked when they are opened.
        assert_eq!(first_clash(&[job(&[&a, &detour], &[])]), None);
        let jobs = [job(&[], &[&a]), job(&[&a], &[])];
        let expected = Clash::Input { writer: (1, Target::File(a.clone())), reader: (0, a.clone()) };
        assert_eq!(first_clash(&jobs), Some(expected));
        assert_eq!(first_clash(&[job(&[&b], &[&a]), job(&[], &[&a])]), None);
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_devices_shared() {
        let folder = tempfile::tempdir().unwrap();
        let (a, link) = (folder.path().join("a.obj"), folder.path().join("link.obj"));
        std::os::unix::fs::symlink(&a, &link).unwrap();
        assert!(first_clash(&[job(&[&a], &[]), job(&[&link], &[])]).is_some());
        let null = PathBuf::from("/dev/null");
        assert_eq!(first_clash(&[job(&[&null], &[]), job(&[&null], &[])]), None);
        let nowhere = PathBuf::from("/nowhere/a");
        assert_eq!(first_clash(&[job(&[&nowhere], &[]), job(&[&nowhere], &[])]), None);
    }
}
