//! `convert` on the command line: programs for each control, files written, refusals.
use super::tools::{json, status, str, text, trunnion, write};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn sample(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("samples/programs")
        .join(name);
    path.to_str().expect("UTF-8").to_owned()
}

#[test]
fn a_sample_for_every_control() {
    let (piece, plate) = (sample("apt/small-piece.apt"), sample("apt/plate.apt"));
    let five = ["--machine", "mikron-ucp710"];
    let three = ["--machine", "mill-3axis"];
    for (file, machine, more, sign) in [
        (&piece, five, &["--to", "sinumerik-840d"][..], "\nN70 TRAORI\n"),
        (
            &piece,
            five,
            &["--to", "sinumerik-840d", "--orientation", "vectors"],
            "A3=0.1 B3=0.1 C3=0.98994949",
        ),
        (
            &piece,
            five,
            &["--to", "fanuc-30i", "--program-number", "1234"],
            "%\nO1234 (SMALL PIECE)\n",
        ),
        (&piece, five, &["--to", "haas-ngc", "--units", "inch"], "G234 H1\n"),
        (&plate, three, &["--to", "iso-6983"], "G3 X20 Y10 I-10 J0\n"),
        (
            &plate,
            three,
            &["--to", "grbl"],
            "M5\nT2\nM0 (set the zero of Z with the tip of this tool)\nS8000 M4\n",
        ),
        (
            &plate,
            three,
            &["--to", "apt", "--lines-only", "--tolerance-mm", "0.5"],
            "OPSTOP\n",
        ),
    ] {
        let arguments = [&["convert", file.as_str()][..], &machine, more].concat();
        let output = trunnion(&arguments);
        let (program, summary) = (text(&output.stdout), text(&output.stderr));
        assert_eq!(status(&output), 0, "{summary}");
        assert!(program.contains(sign), "{more:?}\n{program}");
        assert!(summary.contains("and proved by running both"), "{summary}");
        assert!(!program.contains("CIRCLE"), "{program}");
    }
}

/// Program and summary for every post, and CL data.
#[test]
fn every_post_is_looked_at() {
    // away from the settings of the samples: no zero point is declared
    let folder = TempDir::new().expect("works");
    let copy = |name: &str| {
        let text = fs::read_to_string(sample(&format!("apt/{name}"))).expect("readable");
        str(&write(&folder, name, &text)).to_owned()
    };
    let (piece, plate) = (copy("small-piece.apt"), copy("plate.apt"));
    for (dialect, file, machine) in [
        ("sinumerik-840d", &piece, "mikron-ucp710"),
        ("fanuc-30i", &piece, "mikron-ucp710"),
        ("haas-ngc", &piece, "mikron-ucp710"),
        ("linuxcnc", &piece, "linuxcnc-xyzac-trt"),
        ("iso-6983", &plate, "mill-3axis"),
        ("grbl", &plate, "mill-3axis"),
        ("apt", &piece, "mikron-ucp710"),
    ] {
        let output = trunnion(&["convert", file, "--to", dialect, "--machine", machine]);
        assert_eq!(status(&output), 0, "{dialect}: {}", text(&output.stderr));
        let summary = text(&output.stderr).replace(file.as_str(), "FILE");
        insta::assert_snapshot!(
            format!("convert_{dialect}"),
            format!("{}---\n{summary}", text(&output.stdout))
        );
    }
}

/// The travel of the machine: reported if the zero point is not declared, refused if it is.
#[test]
fn a_program_that_leaves_the_travel_is_told_or_refused() {
    let folder = TempDir::new().expect("works");
    let file = write(
        &folder,
        "far.apt",
        "UNITS/MM\nLOADTL/1\nSPINDL/5000,CLW\nFEDRAT/500\nRAPID\nGOTO/0,0,50,0,0,1\nGOTO/400,0,50,0,0,1\nFINI\n",
    );
    let arguments = ["convert", str(&file), "--machine", "mikron-ucp710"];
    let told = trunnion(&arguments);
    let summary = text(&told.stderr);
    assert_eq!(status(&told), 0, "{summary}");
    assert!(
        summary.contains(":7: X would go to 400.0000 mm, its limit is 355.0000 mm; this assumes that the part zero is at machine zero"),
        "{summary}"
    );
    let document = json(&trunnion(&[&arguments[..], &["--format", "json"]].concat()));
    assert_eq!(document["beyond_travel"][0]["axis"], "X");
    write(
        &folder,
        "trunnion.toml",
        "[work_offsets]\nG54 = { X = 0, Y = 0, Z = 0 }\n",
    );
    let refused = trunnion(&arguments);
    let summary = text(&refused.stderr);
    assert_eq!(status(&refused), 1, "{summary}");
    assert!(
        text(&refused.stdout).is_empty() && summary.contains(":7:1: refused: the program would leave the travel"),
        "{summary}"
    );
}

#[test]
fn what_is_written_passes_check_and_goes_back() {
    let folder = TempDir::new().expect("works");
    let program = folder.path().join("piece.mpf");
    let back = folder.path().join("piece.apt");
    let machine = ["--machine", "mikron-ucp710"];
    let (piece, written) = (sample("apt/small-piece.apt"), str(&program).to_owned());
    let output = trunnion(&[&["convert", &piece, "-o", &written, "-q"][..], &machine].concat());
    assert_eq!((status(&output), text(&output.stderr).as_str()), (0, ""));
    let output = trunnion(&[&["convert", &written, "--to", "apt", "-o", str(&back)][..], &machine].concat());
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let goto = |text: &str| text.lines().filter(|line| line.starts_with("GOTO")).count();
    let text = fs::read_to_string(&back).expect("written");
    assert_eq!(goto(&text), goto(&fs::read_to_string(&piece).expect("there")), "{text}");
    // on another machine the program says B instead of A
    let output = trunnion(&[&["convert", &written, "--to-machine", "ferrari-bc"][..], &machine].concat());
    let moved = super::tools::text(&output.stdout);
    assert!(
        status(&output) == 0 && moved.contains(" B") && !moved.contains(" A"),
        "{moved}"
    );
}

#[test]
fn the_proof_is_a_document_too() {
    let piece = sample("apt/small-piece.apt");
    let output = trunnion(&[
        "convert",
        &piece,
        "--machine",
        "mikron-ucp710",
        "--no-tcp",
        "--to",
        "linuxcnc",
        "--format",
        "json",
    ]);
    let document = json(&output);
    assert_eq!(
        (status(&output), document["schema"].as_str()),
        (0, Some("trunnion-convert/1"))
    );
    let proof = &document["proof"];
    let number = |key: &str| proof[key].as_f64().expect("a number");
    assert!(
        number("path_mm") <= number("path_limit_mm") && number("path_limit_mm") == 0.01,
        "{proof}"
    );
    assert!(number("motions_after") > number("motions_before"), "{proof}");
    assert!(document["program"].as_str().is_some_and(|text| text.contains("G93")));
}

#[test]
fn a_refusal_writes_nothing_and_tells_the_place() {
    let folder = TempDir::new().expect("works");
    let file = write(
        &folder,
        "down.apt",
        "UNITS/MM\nFEDRAT/100\nRAPID\nGOTO/0,0,9,0,0,1\nGOTO/0,0,0,0,0,-1\nFINI\n",
    );
    let out = folder.path().join("down.mpf");
    let output = trunnion(&["convert", str(&file), "--machine", "mikron-ucp710", "-o", str(&out)]);
    let message = text(&output.stderr);
    assert_eq!(status(&output), 1, "{message}");
    assert!(
        message.contains("down.apt:5:1: refused: ") && message.contains("outside the travel"),
        "{message}"
    );
    assert!(!out.exists());
    for (arguments, why) in [
        (&["--to", "haas-lathe"][..], "no post for `haas-lathe`"),
        (&[], "the target is missing"),
        (&["--to", "apt", "--tolerance-mm", "-1"], "positive number"),
        (&["--to", "linuxcnc", "--to-machine", "nowhere"], "nowhere"),
    ] {
        let output = trunnion(&[&["convert", str(&file)][..], arguments].concat());
        let message = text(&output.stderr);
        assert_eq!(status(&output), 2, "{arguments:?}: {message}");
        assert!(message.contains(why), "{arguments:?}: {message}");
    }
}

#[test]
fn a_post_of_ones_own_is_read_and_its_mistakes_are_placed() {
    let folder = TempDir::new().expect("works");
    let plate = sample("apt/plate.apt");
    let good = write(
        &folder,
        "good.toml",
        "extends = \"linuxcnc\"\n[templates]\nfooter = \"\"\"\nG0 G53 Z0\nM30\n\"\"\"\n",
    );
    let machine = ["--machine", "mill-3axis"];
    let output = trunnion(&[&["convert", &plate, "--post", str(&good)][..], &machine].concat());
    let program = text(&output.stdout);
    assert!(
        status(&output) == 0 && program.ends_with("\nG0 G53 Z0\nM30\n"),
        "{}",
        text(&output.stderr)
    );
    // a motion that the post puts between two of the program belongs to neither
    let cut = write(
        &folder,
        "cut.toml",
        "extends = \"linuxcnc\"\n[templates]\noptional-stop = \"G1 Z-5\\nM1\"\n",
    );
    let output = trunnion(&[&["convert", &plate, "--post", str(&cut)][..], &machine].concat());
    assert!(
        status(&output) == 1 && text(&output.stdout).is_empty(),
        "{}",
        text(&output.stderr)
    );
    assert!(
        text(&output.stderr).contains("is not a positioning move"),
        "{}",
        text(&output.stderr)
    );
    let bad = write(
        &folder,
        "bad.toml",
        "extends = \"linuxcnc\"\n[templates]\nheader = \"\"\"\n%\n({prgram})\n\"\"\"\n",
    );
    let output = trunnion(&[&["convert", &plate, "--post", str(&bad)][..], &machine].concat());
    let message = text(&output.stderr);
    assert_eq!(status(&output), 2);
    assert!(
        message.contains("bad.toml:5:2: ") && message.contains("{prgram}"),
        "{message}"
    );
}

/// The certificate of a conversion is checked without the converter: by both texts, both machines and all that it says.
#[test]
fn a_conversion_is_certified() {
    let folder = TempDir::new().expect("works");
    let [cl, after, proof] = ["piece.apt", "piece.nc", "proof.json"].map(|name| folder.path().join(name));
    fs::copy(sample("apt/small-piece.apt"), &cl).expect("copied");
    for (before, to, machines) in [
        (&cl, "sinumerik-840d", ["mikron-ucp710", "mikron-ucp710"]),
        (&cl, "fanuc-30i", ["mikron-ucp710", "ferrari-bc"]),
        (&after, "apt", ["ferrari-bc", "ferrari-bc"]),
    ] {
        let last = folder.path().join(format!("{to}.out"));
        let machine = ["--machine", machines[0], "--to-machine", machines[1]];
        let made = trunnion(
            &[
                &[
                    "convert",
                    str(before),
                    "--to",
                    to,
                    "-o",
                    str(&last),
                    "--certificate",
                    str(&proof),
                ],
                &machine[..],
            ]
            .concat(),
        );
        assert_eq!(status(&made), 0, "{to}: {}", text(&made.stderr));
        let again = |file: &Path, proof: &Path, machine: &[&str]| {
            let output = trunnion(
                &[
                    &["certify", str(before), str(file), "--certificate", str(proof)],
                    machine,
                ]
                .concat(),
            );
            (status(&output), text(&output.stdout))
        };
        let (code, said) = again(&last, &proof, &machine);
        assert!(
            code == 0 && said.starts_with(&format!("PROVED the same motions in {to} as in ")),
            "{to}: {said}"
        );
        // another text
        let program = fs::read_to_string(&last).expect("readable");
        let other = folder.path().join("other.out");
        fs::write(&other, program.replacen("0.5", "0.4", 1) + "\n").expect("written");
        let (code, said) = again(&other, &proof, &machine);
        assert!(
            code == 1 && said.starts_with("REFUTED") && said.contains("another changed program"),
            "{to}: {said}"
        );
        // another machine
        let (code, said) = again(
            &last,
            &proof,
            &["--machine", "fork-head-ca", "--to-machine", "fork-head-ca"],
        );
        assert!(code == 1 && said.contains("machine"), "{to}: {said}");
        // every number and every term of it
        let certificate = fs::read_to_string(&proof).expect("readable");
        let value: serde_json::Value = serde_json::from_str(&certificate).expect("JSON");
        let changed = folder.path().join("changed.json");
        for (pointer, new) in [
            ("/claim/path_mm", serde_json::json!(1.0)),
            ("/proof/end_mm", serde_json::json!(0.0)),
            ("/assumes_tcp", serde_json::json!(true)),
            ("/parts/0/times", serde_json::json!(4_000_000_000_u32)),
            ("/tool_version", serde_json::json!("9")),
        ] {
            let mut value = value.clone();
            *value.pointer_mut(pointer).expect("a field") = new;
            fs::write(&changed, value.to_string()).expect("written");
            let (code, said) = again(&last, &changed, &machine);
            assert!(
                code == 1 && said.starts_with("REFUTED") && said.contains("seal"),
                "{to} {pointer}: {said}"
            );
        }
        if to == "fanuc-30i" {
            fs::copy(&last, &after).expect("copied");
        }
    }
}
