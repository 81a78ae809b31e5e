//! Outputs appear whole or not at all.

use slopegen::write::{Delivery, EncodeError, Outputs, Target, WriteError};
use std::fs;
use std::path::Path;
use std::sync::Mutex;

const NO_INPUTS: [&str; 0] = [];

/// One test removes the temporary files of the whole process.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

fn alone() -> impl Drop {
    ONE_AT_A_TIME.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

fn file(path: &Path) -> Target {
    Target::File(path.into())
}

fn open(targets: &[Target]) -> Result<Outputs, WriteError> {
    Outputs::open(targets, &NO_INPUTS)
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn put(outputs: &mut Outputs, index: usize, text: &str) -> Result<Delivery, WriteError> {
    outputs.write(index, |out| Ok(out.write_all(text.as_bytes())?))
}

#[test]
fn files_appear_together_at_commit() {
    let _guard = alone();
    let folder = tempfile::tempdir().unwrap();
    let (a, b, never) = (folder.path().join("a.obj"), folder.path().join("b.ply"), folder.path().join("never"));
    fs::write(&b, "old").unwrap();
    let mut outputs = open(&[file(&a), file(&b), file(&never)]).unwrap();
    assert_eq!(put(&mut outputs, 0, "A").unwrap(), Delivery::Complete);
    put(&mut outputs, 1, "B").unwrap();
    assert!(!a.exists());
    assert_eq!(fs::read_to_string(&b).unwrap(), "old");
    outputs.commit().unwrap();
    assert_eq!(names(folder.path()), ["a.obj", "b.ply"]);
    assert_eq!(fs::read_to_string(&a).unwrap() + &fs::read_to_string(&b).unwrap(), "AB");
}

#[test]
fn without_commit_nothing_changes() {
    let _guard = alone();
    let folder = tempfile::tempdir().unwrap();
    let (a, b) = (folder.path().join("a"), folder.path().join("b"));
    fs::write(&b, "old").unwrap();
    let mut outputs = open(&[file(&a), file(&b)]).unwrap();
    put(&mut outputs, 0, "A").unwrap();
    put(&mut outputs, 1, "B").unwrap();
    assert_eq!(names(folder.path()).len(), 3);
    drop(outputs);
    assert_eq!(names(folder.path()), ["b"]);
    assert_eq!(fs::read_to_string(&b).unwrap(), "old");
}

#[test]
fn an_output_not_written_to_the_end_does_not_appear() {
    let _guard = alone();
    let folder = tempfile::tempdir().unwrap();
    let mut outputs = open(&[file(&folder.path().join("a")), file(&folder.path().join("b"))]).unwrap();
    put(&mut outputs, 0, "A").unwrap();
    let error = outputs
        .write(1, |out| {
            out.write_all(b"half")?;
            Err(EncodeError::ReportNotFinite("volumes.cut".into()))
        })
        .unwrap_err();
    assert!(error.to_string().contains("report figure `volumes.cut` is not a finite number"), "{error}");
    outputs.commit().unwrap();
    assert_eq!(names(folder.path()), ["a"]);
}

#[test]
fn a_missing_folder_shows_at_once() {
    let _guard = alone();
    let folder = tempfile::tempdir().unwrap();
    let (a, b) = (folder.path().join("a"), folder.path().join("missing/b"));
    let error = open(&[file(&a), file(&b)]).unwrap_err();
    let expected = format!(
        "the output cannot be created\n  --> {0}/missing/b\n   = No such file or directory (os error 2)\n   \
         = help: make sure that the folder `{0}/missing` exists",
        folder.path().display()
    );
    assert_eq!(error.to_string(), expected);
    assert!(!error.is_usage());
    assert!(names(folder.path()).is_empty());
}

#[test]
fn folders_are_no_files() {
    let _guard = alone();
    let folder = tempfile::tempdir().unwrap();
    let error = open(&[file(folder.path())]).unwrap_err();
    assert!(matches!(error, WriteError::IsFolder(_)), "{error}");
    assert!(error.is_usage());
}

#[test]
fn two_outputs_to_one_place_are_refused() {
    let _guard = alone();
    let folder = tempfile::tempdir().unwrap();
    let plain = folder.path().join("a");
    let detour = folder.path().join("sub/../a");
    fs::create_dir(folder.path().join("sub")).unwrap();
    let same = |first: Target, second: Target| matches!(open(&[first, second]), Err(WriteError::SameFile { .. }));
    assert!(same(file(&plain), file(&detour)), "not existing yet");
    fs::write(&plain, "").unwrap();
    assert!(same(file(&plain), file(&detour)), "existing");
    assert!(same(Target::Stdout, Target::Stdout));
    assert!(!same(file(&plain), file(&folder.path().join("A"))) || cfg!(any(windows, target_os = "macos")));
}

#[test]
fn inputs_are_not_overwritten() {
    let _guard = alone();
    let folder = tempfile::tempdir().unwrap();
    let input = folder.path().join("road.geojson");
    fs::write(&input, "precious").unwrap();
    let error = Outputs::open(&[file(&input)], &[&input]).unwrap_err();
    assert!(matches!(error, WriteError::IsInput(_)), "{error}");
    assert_eq!(names(folder.path()), ["road.geojson"]);
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
    use std::process::Command;

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().mode() & 0o777
    }

    #[test]
    fn permissions_are_those_of_a_plain_create_or_of_the_file_replaced() {
        let _guard = alone();
        let folder = tempfile::tempdir().unwrap();
        let [new, old, plain] = ["new", "old", "plain"].map(|n| folder.path().join(n));
        fs::write(&plain, "").unwrap();
        fs::write(&old, "").unwrap();
        fs::set_permissions(&old, fs::Permissions::from_mode(0o640)).unwrap();
        let mut outputs = open(&[file(&new), file(&old)]).unwrap();
        put(&mut outputs, 0, "1").unwrap();
        put(&mut outputs, 1, "2").unwrap();
        outputs.commit().unwrap();
        assert_eq!(mode(&new), mode(&plain));
        assert_eq!(mode(&old), 0o640);
    }

    #[test]
    fn links_stay_links() {
        let _guard = alone();
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("deep")).unwrap();
        for (link, to) in [("to_new", "deep/new"), ("to_old", "deep/old")] {
            symlink(to, folder.path().join(link)).unwrap();
        }
        fs::write(folder.path().join("deep/old"), "old").unwrap();
        let mut outputs = open(&[file(&folder.path().join("to_new")), file(&folder.path().join("to_old"))]).unwrap();
        put(&mut outputs, 0, "1").unwrap();
        put(&mut outputs, 1, "2").unwrap();
        outputs.commit().unwrap();
        assert_eq!(names(&folder.path().join("deep")), ["new", "old"]);
        assert!(fs::symlink_metadata(folder.path().join("to_old")).unwrap().is_symlink());
        assert_eq!(fs::read_to_string(folder.path().join("to_old")).unwrap(), "2");
    }

    #[test]
    fn a_link_to_an_input_is_the_input() {
        let _guard = alone();
        let folder = tempfile::tempdir().unwrap();
        let (input, link) = (folder.path().join("in"), folder.path().join("link"));
        fs::write(&input, "precious").unwrap();
        symlink("in", &link).unwrap();
        assert!(matches!(Outputs::open(&[file(&link)], &[&input]), Err(WriteError::IsInput(_))));
    }

    #[test]
    fn devices_are_written_not_replaced() {
        let _guard = alone();
        let null = Path::new("/dev/null");
        let mut outputs = open(&[file(null), file(null)]).unwrap();
        put(&mut outputs, 0, "gone").unwrap();
        put(&mut outputs, 1, "gone too").unwrap();
        outputs.commit().unwrap();
        assert!(!fs::metadata(null).unwrap().is_file());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_reported() {
        let _guard = alone();
        let folder = tempfile::tempdir().unwrap();
        let good = folder.path().join("good");
        let mut outputs = open(&[file(&good), file(Path::new("/dev/full"))]).unwrap();
        put(&mut outputs, 0, "A").unwrap();
        let error = put(&mut outputs, 1, "no room").unwrap_err();
        assert_eq!(
            error.to_string(),
            "the output could not be written\n  --> /dev/full\n   = No space left on device (os error 28)\n   \
             = help: what came out is not complete; make room or name another place"
        );
        drop(outputs);
        assert!(names(folder.path()).is_empty());
    }

    #[test]
    fn a_reader_that_leaves_is_no_error() {
        let _guard = alone();
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let reader = std::thread::spawn({
            let pipe = pipe.clone();
            move || drop(fs::File::open(pipe).unwrap())
        });
        let other = folder.path().join("other");
        let mut outputs = open(&[file(&pipe), file(&other)]).unwrap();
        reader.join().unwrap();
        assert_eq!(put(&mut outputs, 0, "nobody reads").unwrap(), Delivery::PipeClosed);
        put(&mut outputs, 1, "still written").unwrap();
        outputs.commit().unwrap();
        assert_eq!(names(folder.path()), ["other", "pipe"]);
    }
}
