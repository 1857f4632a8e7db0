//! Which files are replaced, written to or refused.
use super::*;
use tempfile::TempDir;

fn folder() -> TempDir {
    tempfile::tempdir().expect("a folder")
}

fn file(folder: &TempDir, name: &str, text: &str) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, text).expect("written");
    path
}

fn content(path: &Path) -> String {
    fs::read_to_string(path).expect("readable")
}

fn names(folder: &TempDir) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder.path())
        .expect("a folder")
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

fn put(path: &Path, text: &str) -> Result<(), FileError> {
    Outputs::new().output("-o", path)?.write(text.as_bytes(), None)
}

#[test]
fn a_file_is_made_or_replaced_and_nothing_is_left_beside_it() {
    let folder = folder();
    let path = folder.path().join("p.nc");
    put(&path, "one").expect("made");
    put(&path, "two").expect("replaced");
    assert_eq!(
        (content(&path).as_str(), names(&folder)),
        ("two", vec!["p.nc".to_owned()])
    );
}

#[test]
fn what_comes_piece_by_piece_replaces_the_file_when_all_is_there() {
    let folder = folder();
    let path = file(&folder, "all.json", "old");
    let target = Outputs::new().output("-o", &path).expect("there");
    let most = "a piece\n".repeat(4000);
    let filled: Result<u8, FileError> = target.fill(|out| {
        out.write_all(most.as_bytes()).expect("kept");
        // it is on the disk, not in memory, and the file is still the old one
        let beside = names(&folder);
        let temporary = beside.iter().find(|name| name.ends_with(temporary::ENDING));
        let temporary = folder.path().join(temporary.expect("a temporary file"));
        assert!(fs::metadata(temporary).expect("there").len() + 8192 >= most.len() as u64);
        assert_eq!(content(&path), "old");
        Ok(7)
    });
    assert_eq!(filled.expect("written"), 7);
    assert_eq!(content(&path), most);
    let failed: Result<(), FileError> = Outputs::new().output("-o", &path).expect("there").fill(|out| {
        out.write_all(b"half").expect("kept");
        Err(FileError::new(&path, "no more"))
    });
    assert!(failed.is_err());
    assert_eq!((content(&path), names(&folder)), (most, vec!["all.json".to_owned()]));
}

#[test]
fn an_input_is_no_output_under_any_name() {
    let folder = folder();
    let path = file(&folder, "p.nc", "old");
    let mut outputs = Outputs::new();
    outputs.input(&path);
    let error = outputs
        .output("-o", &folder.path().join("./p.nc"))
        .expect_err("the input");
    assert!(error.message.contains("also an input"), "{error}");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&path, folder.path().join("link.nc")).expect("a link");
        assert!(outputs.output("-o", &folder.path().join("link.nc")).is_err());
    }
    assert_eq!(content(&path), "old");
}

#[test]
fn two_outputs_are_two_files() {
    let folder = folder();
    let path = folder.path().join("new.nc");
    let mut outputs = Outputs::new();
    outputs.output("-o", &path).expect("the first");
    let error = outputs.output("--certificate", &path).expect_err("the same");
    assert!(error.message.contains("also the output of -o"), "{error}");
    let mut standard = Outputs::new();
    standard.output("-o", Path::new("-")).expect("the first");
    assert!(standard.output("--certificate", Path::new("-")).is_err());
}

#[test]
fn what_changed_since_it_was_read_is_not_replaced() {
    let folder = folder();
    let path = file(&folder, "p.nc", "old");
    let input = read(&path, 100).expect("readable").expect("small");
    let target = Target::in_place(&path, &input.seen, &input.bytes).expect("unchanged");
    // of the same length, and with the time that the file had
    let time = fs::metadata(&path)
        .and_then(|metadata| metadata.modified())
        .expect("a time");
    fs::write(&path, "new").expect("written");
    File::options()
        .write(true)
        .open(&path)
        .and_then(|file| file.set_modified(time))
        .expect("a time");
    let error = target.write(b"formatted", Some(&input.bytes)).expect_err("changed");
    assert!(error.message.contains("changed since it was read"), "{error}");
    assert_eq!(
        (content(&path).as_str(), names(&folder)),
        ("new", vec!["p.nc".to_owned()])
    );
}

#[test]
fn a_file_that_another_program_made_meanwhile_stays() {
    let folder = folder();
    let path = folder.path().join("p.nc");
    let target = Outputs::new().output("-o", &path).expect("new");
    fs::write(&path, "theirs").expect("written");
    assert!(target.write(b"ours", None).is_err());
    assert_eq!(content(&path), "theirs");
}

#[test]
fn a_missing_folder_is_named() {
    let folder = folder();
    let error = put(&folder.path().join("no/p.nc"), "x").expect_err("no folder");
    assert!(error.message.contains("there is no folder"), "{error}");
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};

    #[test]
    fn the_target_of_a_link_is_replaced_and_the_link_stays() {
        let folder = folder();
        let path = file(&folder, "p.nc", "old");
        let link = folder.path().join("link.nc");
        symlink("p.nc", &link).expect("a link");
        put(&link, "new").expect("replaced");
        assert!(fs::symlink_metadata(&link).is_ok_and(|metadata| metadata.is_symlink()));
        assert_eq!(content(&path), "new");
        symlink("later.nc", folder.path().join("dangling.nc")).expect("a link");
        put(&folder.path().join("dangling.nc"), "made").expect("made");
        assert_eq!(content(&folder.path().join("later.nc")), "made");
    }

    #[test]
    fn the_mode_is_kept() {
        let folder = folder();
        let path = file(&folder, "p.nc", "old");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).expect("a mode");
        put(&path, "new").expect("replaced");
        assert_eq!(
            fs::metadata(&path).map(|metadata| metadata.mode() & 0o777).ok(),
            Some(0o640)
        );
    }

    #[test]
    fn read_only_files_and_hard_links_are_refused() {
        let folder = folder();
        let path = file(&folder, "p.nc", "old");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o444)).expect("a mode");
        assert!(
            put(&path, "new")
                .expect_err("read-only")
                .message
                .contains("is read-only")
        );
        fs::set_permissions(&path, fs::Permissions::from_mode(0o644)).expect("a mode");
        fs::hard_link(&path, folder.path().join("other.nc")).expect("a link");
        let error = put(&path, "new").expect_err("two links");
        assert!(
            error.message.contains("2 hard links") && error.message.contains("-o FILE"),
            "{error}"
        );
        assert_eq!(content(&path), "old");
    }

    #[test]
    fn devices_are_written_to_and_never_replaced() {
        put(Path::new("/dev/null"), "gone").expect("written to");
        assert!(fs::metadata("/dev/null").is_ok_and(|metadata| special(&metadata) == Some("a device")));
        if Path::new("/dev/full").exists() {
            assert!(put(Path::new("/dev/full"), "no room").is_err());
        }
    }
}
