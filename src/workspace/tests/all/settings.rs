//! `trunnion.toml` on disk: what a program is resolved with.
use std::fs;
use std::path::Path;
use trunnion_workspace::{Overrides, resolve};

fn write(folder: &Path, name: &str, text: &str) {
    let path = folder.join(name);
    fs::create_dir_all(path.parent().expect("a folder")).expect("made");
    fs::write(path, text).expect("written");
}

#[test]
fn called_programs_are_found_beside_the_program_and_on_the_path() {
    let folder = tempfile::tempdir().expect("a folder");
    write(
        folder.path(),
        "trunnion.toml",
        "subprogram_path = [\"subs\"]\nport_to = [\"linuxcnc\"]\n[limits]\ndepth = 7\n",
    );
    write(folder.path(), "jobs/main.nc", "M98 P100\n");
    write(folder.path(), "jobs/O0200.nc", "M99\n");
    write(folder.path(), "subs/O0100.nc", "M99\n");
    let main = folder.path().join("jobs/main.nc");
    let overrides = Overrides {
        port_to: vec!["iso-6983".to_owned()],
        ..Overrides::default()
    };
    let resolved = resolve(Some(&main), b"M98 P100\n", &overrides).expect("resolved");
    let files = resolved.setup.library.0.as_ref().expect("a library");
    assert!(files.load("100").is_ok() && files.load("200").is_ok());
    let searched = files.load("300").expect_err("not there");
    assert_eq!(searched.len(), 2, "{searched:?}");
    assert!(
        searched[0].folder.ends_with("jobs") && searched[1].folder.ends_with("subs"),
        "{searched:?}"
    );
    assert_eq!(resolved.port_to, ["linuxcnc", "iso-6983"]);
    assert_eq!(resolved.settings().port_to, resolved.port_to);
    assert_eq!(resolved.setup.limits.depth, 7);
}

#[test]
fn a_folder_that_is_not_there_is_an_error_with_its_place() {
    let folder = tempfile::tempdir().expect("a folder");
    write(
        folder.path(),
        "trunnion.toml",
        "machine = \"mill-3axis\"\nsubprogram_path = [\"nowhere\"]\n",
    );
    write(folder.path(), "main.nc", "M30\n");
    let main = folder.path().join("main.nc");
    let Err(error) = resolve(Some(&main), b"M30\n", &Overrides::default()) else {
        panic!("resolved")
    };
    assert!(error.place.ends_with("trunnion.toml:2:20"), "{error}");
    assert!(error.message.contains("does not exist"), "{error}");
}

#[test]
fn standard_input_has_no_folder_beside_it() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path(), "trunnion.toml", "");
    let overrides = Overrides {
        config: Some(folder.path().join("trunnion.toml")),
        ..Overrides::default()
    };
    let resolved = resolve(None, b"M98 P100\n", &overrides).expect("resolved");
    assert!(resolved.setup.library.0.is_none());
}

#[test]
fn a_table_of_ones_own_is_the_dialect() {
    let folder = tempfile::tempdir().expect("a folder");
    let table = "name = \"shop\"\nextends = \"fanuc-30i\"\n\n[codes]\nM321 = { action = \"no-motion\", doc = \"Opens the door\", source = \"shop\" }\n";
    write(folder.path(), "trunnion.toml", "dialect_table = \"shop.toml\"\n");
    write(folder.path(), "shop.toml", table);
    write(folder.path(), "main.nc", "M321\nM30\n");
    let main = folder.path().join("main.nc");
    let resolved =
        resolve(Some(&main), b"M321\nM30\n", &Overrides::default()).unwrap_or_else(|error| panic!("{error}"));
    assert!(resolved.dialect.m(3210).is_some());
    assert_eq!(resolved.dialect_reason, "the table shop.toml of trunnion.toml");
    let again = resolve(Some(&main), b"M30\n", &Overrides::default()).unwrap_or_else(|error| panic!("{error}"));
    assert!(std::ptr::eq(resolved.dialect, again.dialect), "one text is kept once");
    write(
        folder.path(),
        "shop.toml",
        "name = \"shop\"\nextends = \"fanuc-30i\"\nbogus = 1\n",
    );
    let Err(error) = resolve(Some(&main), b"M30\n", &Overrides::default()) else {
        panic!("resolved")
    };
    assert!(error.place.contains("shop.toml:3"), "{error}");
}

/// Obstacles in comments have the keys of `[[obstacle]]`, and come after those of the settings.
#[test]
fn comments_declare_obstacles() {
    let folder = tempfile::tempdir().expect("a folder");
    write(
        folder.path(),
        "trunnion.toml",
        "machine = \"mikron-ucp710\"\ndialect = \"fanuc-30i\"\n[[obstacle]]\nname = \"vice\"\nbox = [[0, 0, 0], [1, 1, 1]]\n",
    );
    let file = folder.path().join("main.nc");
    let with = |comment: &str| {
        resolve(
            Some(&file),
            format!("%\n{comment}\nM30\n").as_bytes(),
            &Overrides::default(),
        )
    };
    let resolved = with(
        "(TRUNNION: obstacle name = \"clamp\", polygon = [[0, 0], [9, 0], [0, 9]], z = [0, 5], axis = \"C\")\n\
         (trunnion:obstacle cylinder = { centre = [1, 2], radius = 3, z = [4, 5] })",
    )
    .expect("resolved");
    let machine = resolved.machine.expect("named");
    let names: Vec<&str> = machine.obstacles.0.iter().map(|one| one.name.as_str()).collect();
    assert_eq!(names, ["vice", "clamp", "obstacle 3"]);
    assert_eq!(machine.obstacles.0[1].axis, Some(b'C'));
    assert_eq!((machine.obstacles.0[2].bottom, machine.obstacles.0[2].top), (4.0, 5.0));
    for (wrong, why) in [
        ("name = \"vice\", box = [[0, 0, 0], [1, 1, 1]]", "declared twice"),
        ("box = [[0, 0, 0], [1, -1, 1]]", "each minimum below its maximum"),
        ("box = [[0, 0, 0], [1, 1, 1]], height = 3", "unknown field"),
        ("axis = \"W\", box = [[0, 0, 0], [1, 1, 1]]", "has no axis W"),
        ("box = [[0, 0, 0], [1, 1", ""),
        ("", "one shape"),
        ("box = [[0, 0, 0], [1, 1, 1]] }, obstacle = { part = true", ""),
    ] {
        let Err(error) = with(&format!("G1 X1 (trunnion: obstacle {wrong})")) else {
            panic!("{wrong} is read")
        };
        assert!(error.place.ends_with("main.nc:2:7"), "{error}");
        assert!(
            error.message.contains(why) && error.message.contains("[[obstacle]]"),
            "{error}"
        );
    }
    // other comments and other words stay what they are
    assert_eq!(
        with("(obstacle: box)\n(an obstacle)")
            .map(|found| found.machine.expect("named").obstacles.0.len())
            .expect("read"),
        1
    );
}

/// What a command or the server has read before does not hide a change of the file.
#[test]
fn settings_and_machine_that_changed_are_read_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let main = folder.path().join("main.nc");
    write(folder.path(), "main.nc", "M30\n");
    let own = trunnion_machine::builtin_source("mill-3axis").expect("built in");
    for (depth, name) in [(7, "first"), (7, "first"), (8, "second")] {
        write(
            folder.path(),
            "trunnion.toml",
            &format!("machine = \"own.toml\"\n[limits]\ndepth = {depth}\n"),
        );
        write(
            folder.path(),
            "own.toml",
            &format!("{own}\n[[obstacle]]\nname = \"{name}\"\nbox = [[0, 0, 0], [1, 1, 1]]\n"),
        );
        let resolved = resolve(Some(&main), b"M30\n", &Overrides::default()).expect("resolved");
        assert_eq!(resolved.setup.limits.depth, depth);
        let machine = resolved.machine.expect("named");
        assert!(machine.obstacles.0.iter().any(|obstacle| obstacle.name == name));
    }
    write(folder.path(), "trunnion.toml", "depth = 7\n");
    for _ in 0..2 {
        let Err(error) = resolve(Some(&main), b"M30\n", &Overrides::default()) else {
            panic!("resolved")
        };
        assert!(error.place.ends_with("trunnion.toml:1:1"), "{error}");
    }
}

/// The settings and the machine may declare as many obstacles together as one of them alone.
#[test]
fn obstacles_of_settings_and_machine_are_counted_together() {
    let folder = tempfile::tempdir().expect("a folder");
    let main = folder.path().join("main.nc");
    write(folder.path(), "main.nc", "M30\n");
    let boxes = |count: usize| "[[obstacle]]\nbox = [[0, 0, 0], [1, 1, 1]]\n".repeat(count);
    let own = trunnion_machine::builtin_source("mill-3axis").expect("built in");
    write(folder.path(), "own.toml", &format!("{own}\n{}", boxes(600)));
    let settle = |count: usize| {
        let text = format!("machine = \"own.toml\"\n{}", boxes(count));
        write(folder.path(), "trunnion.toml", &text);
        resolve(Some(&main), b"M30\n", &Overrides::default())
    };
    let machine = settle(400).expect("resolved").machine.expect("named");
    assert_eq!(machine.obstacles.0.len(), 1000);
    let Err(error) = settle(401) else { panic!("resolved") };
    assert!(error.place.ends_with("trunnion.toml"), "{error}");
    assert!(
        error.message.contains("declare 1001 obstacles, and 1000 are the most"),
        "{error}"
    );
    let Err(error) = settle(1001) else { panic!("resolved") };
    assert!(
        error.message.starts_with("more than 1000 obstacles are declared"),
        "{error}"
    );
}
