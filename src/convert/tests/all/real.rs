//! Real programs beside the repository: what can be converted is, and comes back; what cannot is refused with a place.
use crate::support::machine;
use std::path::{Path, PathBuf};
use trunnion_certify::conversion::Assume;
use trunnion_convert::{Converted, Options, Refused, Source, Target, builtin_post, convert};
use trunnion_interp::Setup;
use trunnion_machine::Machine;

fn data(path: &str) -> Option<PathBuf> {
    let found = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../shared/data")
        .join(path);
    if found.exists() {
        return Some(found);
    }
    println!("skipped: {path} is not there");
    None
}

fn run(
    text: &[u8],
    dialect: &str,
    from: Option<&Machine>,
    to: &str,
    on: Option<&Machine>,
) -> Result<Converted, Refused> {
    let mut setup = Setup::default();
    Machine::tell(from, &mut setup.control);
    let source = Source {
        text,
        dialect: trunnion_dialect::builtin(dialect).expect("built in"),
        machine: from,
        setup: &setup,
        assume: Assume::default(),
    };
    let options = Options {
        insert_is_remark: true,
        ..Options::default()
    };
    let target = match to {
        "apt" => Target::Apt,
        to => Target::Code {
            post: builtin_post(to).expect("built in"),
            machine: on,
        },
    };
    convert(&source, &target, &options)
}

/// To G-code, back to CL data, and from there to the same G-code again.
#[track_caller]
fn there_and_back(text: &[u8], dialect: &str, on: &Machine, to: &str) -> u64 {
    let made = run(text, dialect, None, to, Some(on)).unwrap_or_else(|refused| panic!("{refused}"));
    let back = run(made.text.as_bytes(), to, Some(on), "apt", None).unwrap_or_else(|refused| panic!("{refused}"));
    let again = run(back.text.as_bytes(), "apt", None, to, Some(on)).unwrap_or_else(|refused| panic!("{refused}"));
    let words = |text: &str| -> Vec<String> {
        let code = |line: &&str| line.contains(['X', 'Y', 'Z']) && !line.contains(['(', ';']);
        text.lines()
            .filter(code)
            .map(|line| line.trim_start_matches(|c: char| c != ' ').to_owned())
            .collect()
    };
    assert_eq!(words(&made.text), words(&again.text), "the second time nothing changes");
    made.proof.motions_before
}

#[test]
fn creo_roughing_goes_to_three_axes_and_back() {
    let Some(path) = data("apt/creo/schruppen_1.ncl.1") else {
        return;
    };
    let text = std::fs::read(path).expect("readable");
    let mill = machine("mill-3axis").expect("built in");
    for dialect in ["fanuc-30i", "linuxcnc"] {
        assert!(there_and_back(&text, "apt", mill, dialect) > 4000);
    }
}

#[test]
fn solidworks_parts_are_converted_or_refused_with_a_place() {
    let Some(folder) = data("apt/solidworks-cam") else {
        return;
    };
    let mill = machine("mill-3axis").expect("built in");
    let mut converted = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let Ok(text) = std::fs::read(entry.path().join(format!("{name}.apt"))) else {
            continue;
        };
        match run(&text, "apt", None, "linuxcnc", Some(mill)) {
            Ok(_) => {
                there_and_back(&text, "apt", mill, "haas-ngc");
                converted.push(name);
            }
            Err(refused) => {
                println!("{name}: {refused}");
                assert!(refused.place.is_some(), "{name}: {refused}");
            }
        }
    }
    // all eight have cycles, cutter compensation or systems of their own, which are not modelled
    println!("converted: {converted:?}");
}

/// The part of the boss before its first cutter compensation: pockets with lines and arcs of six numbers.
#[test]
fn the_boss_is_converted_as_far_as_it_is_modelled() {
    let Some(path) = data("apt/solidworks-cam/boss/boss.apt") else {
        return;
    };
    let text = std::fs::read_to_string(path).expect("readable");
    let head: Vec<&str> = text.lines().take_while(|line| !line.starts_with("CUTCOM")).collect();
    let text = head.join("\n") + "\nFINI\n";
    let mill = machine("mill-3axis").expect("built in");
    for dialect in ["linuxcnc", "haas-ngc"] {
        assert!(there_and_back(text.as_bytes(), "apt", mill, dialect) > 1000);
    }
}

#[test]
fn one_part_of_two_controls_gives_the_same_cl_data() {
    let (Some(fanuc), Some(siemens)) = (
        data("four-controls/fanuc/5X_MILLING.NC"),
        data("four-controls/siemens/5X_Milling.mpf"),
    ) else {
        return;
    };
    let mikron = trunnion_machine::builtin_source("mikron-ucp710").expect("built in");
    let wide = mikron
        .split("[[check]]")
        .next()
        .expect("a machine")
        .replace("limits = [-30, 120]", "limits = [-120, 120]");
    let machine = trunnion_machine::load("wide", &wide).expect("valid");
    let head = |path: PathBuf| {
        let text = std::fs::read(path).expect("readable");
        let lines: Vec<&[u8]> = text.split_inclusive(|byte| *byte == b'\n').take(3000).collect();
        lines.concat()
    };
    let points = |text: &str| -> Vec<String> {
        let joined = text.replace("$\n", "");
        let records = joined.lines().filter(|line| line.starts_with("GOTO"));
        records.map(str::to_owned).collect()
    };
    // G49 alone, whose way down the parameter TOS decides, is refused
    let fanuc = String::from_utf8_lossy(&head(fanuc)).replace("N110 G49", "N110");
    let one =
        run(fanuc.as_bytes(), "fanuc-30i", Some(&machine), "apt", None).unwrap_or_else(|refused| panic!("{refused}"));
    let two = run(&head(siemens), "sinumerik-840d", Some(&machine), "apt", None)
        .unwrap_or_else(|refused| panic!("{refused}"));
    let (one, two) = (points(&one.text), points(&two.text));
    let first = one
        .iter()
        .position(|point| point.starts_with("GOTO/25.443,100.88"))
        .expect("the first point");
    let same = two
        .iter()
        .position(|point| point.starts_with("GOTO/25.443,100.88"))
        .expect("the first point");
    let count = (one.len() - first).min(two.len() - same);
    assert!(count > 2900, "{count}");
    assert_eq!(one[first..first + count], two[same..same + count]);
}

#[test]
fn the_impeller_comes_back_from_cl_data() {
    let Some(path) = data("linuxcnc-5axis/impeller-7bl-xyzac.ngc") else {
        return;
    };
    let text = std::fs::read(path).expect("readable");
    let machine = trunnion_machine::builtin("linuxcnc-xyzac-trt").expect("built in");
    let made = run(&text, "linuxcnc", Some(machine), "apt", None).unwrap_or_else(|refused| panic!("{refused}"));
    assert!(made.proof.motions_before > 4300, "{:?}", made.proof);
    assert!(made.text.contains("INVERS"));
}

#[test]
fn pairs_of_programs_are_converted_or_refused_with_a_place() {
    let Some(folder) = data("five-axis-pairs") else { return };
    let machine = machine("mikron-ucp710").expect("built in");
    let mut converted = 0;
    for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        let dialect = if path.extension().is_some_and(|kind| kind == "mpf") {
            "sinumerik-840d"
        } else {
            "fanuc-30i"
        };
        let text = std::fs::read(&path).expect("readable");
        match run(&text, dialect, Some(machine), "apt", None) {
            Ok(_) => converted += 1,
            Err(refused) => {
                println!("{}: {refused}", path.display());
                assert!(
                    refused.place.is_some() || refused.message.contains("proved"),
                    "{}: {refused}",
                    path.display()
                );
            }
        }
    }
    println!("converted: {converted}");
}
