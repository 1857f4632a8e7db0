//! `init`, `completions`, `man` and `report`.
use super::{folder, on_mikron};
use crate::cli::tools::{FLIP, status, str, text, trunnion, trunnion_in, write};
use std::{fs, path::Path, process::Command};
use tempfile::TempDir;

#[test]
fn init_writes_settings_that_check_reads() {
    let folder = TempDir::new().expect("a folder");
    write(&folder, "a.nc", super::GOOD);
    let output = trunnion(&["init", str(folder.path()), "--machine", "mill-3axis"]);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let settings = fs::read_to_string(folder.path().join("trunnion.toml")).expect("written");
    assert!(settings.contains("machine = \"mill-3axis\""), "{settings}");
    let checked = trunnion_in(folder.path(), &["check", "a.nc"]);
    assert!(
        text(&checked.stderr).contains("on mill-3axis"),
        "{}",
        text(&checked.stderr)
    );
    // everything that is commented out is valid, too
    let all: String = settings
        .lines()
        .map(|line| match line.strip_prefix("# ") {
            Some(rest) if rest.contains(" = ") || rest.starts_with('[') => format!("{rest}\n"),
            _ => format!("{line}\n"),
        })
        .filter(|line| !line.starts_with("dialect = \"fanuc-30i\"   #"))
        .collect();
    write(&folder, "trunnion.toml", &all);
    let checked = trunnion_in(folder.path(), &["check", "a.nc"]);
    assert_ne!(status(&checked), 2, "{}\n{all}", text(&checked.stderr));
    let again = trunnion(&["init", str(folder.path())]);
    assert_eq!(status(&again), 2);
    assert_eq!(
        fs::read_to_string(folder.path().join("trunnion.toml")).expect("there"),
        all
    );
}

/// Without a sign in the text the machine's control decides; a setting would take that away.
#[test]
fn init_leaves_the_dialect_open_where_no_text_shows_it() {
    let written = |text: &str| {
        let folder = TempDir::new().expect("a folder");
        write(&folder, "a.nc", text);
        assert_eq!(status(&trunnion(&["init", str(folder.path())])), 0);
        fs::read_to_string(folder.path().join("trunnion.toml")).expect("written")
    };
    let open = written("G21 G90\nG0 X1 Y2\nG1 X5 F100\nM30\n");
    assert!(!open.contains("\ndialect = "), "{open}");
    let shown = written("O0001\n#1 = 5\nG21 G90 G54\nG43 H1 Z50.\nIF [#1 GT 3] GOTO 10\nN10 G1 X[#1] F100.\nM30\n%\n");
    assert!(shown.contains("\ndialect = \"fanuc-30i\""), "{shown}");
}

#[test]
fn completions_and_the_manual_page_name_every_command() {
    let man = trunnion(&["man"]);
    assert_eq!(status(&man), 0);
    let man = text(&man.stdout);
    for command in ["CHECK", "REPORT", "FIX", "SCHEMA"] {
        assert!(man.contains(&format!("TRUNNION {command}")), "{command}");
    }
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let output = trunnion(&["completions", shell]);
        assert_eq!(status(&output), 0);
        assert!(text(&output.stdout).contains("write-baseline"), "{shell}");
    }
    let bash = trunnion(&["completions", "bash"]);
    let folder = TempDir::new().expect("a folder");
    let file = write(&folder, "trunnion.bash", &text(&bash.stdout));
    if let Ok(output) = Command::new("bash").args(["-n", str(&file)]).output() {
        assert!(output.status.success(), "{}", text(&output.stderr));
    }
}

/// What bash offers after some words.
fn offered(script: &Path, folder: &Path, words: &[&str]) -> Option<Vec<String>> {
    let ask = "source \"$1\"; shift; COMP_WORDS=(trunnion \"$@\"); COMP_CWORD=$#; _trunnion trunnion \"${COMP_WORDS[$#]}\" \
               \"${COMP_WORDS[$#-1]}\"; printf '%s\\n' \"${COMPREPLY[@]}\"";
    let mut bash = Command::new("bash");
    bash.args(["--norc", "-c", ask, "bash", str(script)]).args(words);
    let output = bash.current_dir(folder).output().ok()?;
    Some(text(&output.stdout).lines().map(str::to_owned).collect())
}

#[test]
fn completions_offer_the_names_of_machines_dialects_and_rules() {
    let folder = TempDir::new().expect("a folder");
    let script = write(
        &folder,
        "trunnion.bash",
        &text(&trunnion(&["completions", "bash"]).stdout),
    );
    write(&folder, "mill-own.toml", "");
    let mills = ["mill-3axis", "mill-4axis-a", "mill-turn-bc"];
    let cases: [(&[&str], &[&str]); 6] = [
        (
            &["check", "--machine", "mill-"],
            &[mills[0], mills[1], mills[2], "mill-own.toml"],
        ),
        (
            &["convert", "--to-machine", "mill-"],
            &[mills[0], mills[1], mills[2], "mill-own.toml"],
        ),
        (&["check", "--dialect", "okuma"], &["okuma-osp"]),
        (&["convert", "--to", "heid"], &["heidenhain-klartext"]),
        (&["explain", "pole-f"], &["pole-flip"]),
        (&["fix", "--rewrite", "unwind"], &["unwind-rotary"]),
    ];
    for (words, wanted) in cases {
        // where there is no bash, the other shells are still looked at
        if let Some(found) = offered(&script, folder.path(), words) {
            assert_eq!(found, wanted, "{words:?}");
        }
    }
    let zsh = text(&trunnion(&["completions", "zsh"]).stdout);
    assert!(zsh.contains("NAME|FILE:{compadd -- mikron-ucp710 ") && zsh.contains("; _files}'"));
    assert!(zsh.contains(":NAME:(iso-6983 linuxcnc "), "dialects");
    let fish = text(&trunnion(&["completions", "fish"]).stdout);
    assert!(fish.contains("-l machine ") && fish.contains("-r -F -a \"mikron-ucp710\\t''\n"));
    assert!(fish.contains("-r -f -a \"iso-6983\\t''\n"), "dialects");
}

fn page(folder: &Path, arguments: &[&str]) -> (String, i32) {
    let mut all = vec!["report"];
    all.extend(arguments);
    all.extend(["-o", "page.html"]);
    let output = trunnion_in(folder, &all);
    let page = fs::read_to_string(folder.join("page.html")).unwrap_or_else(|_| panic!("{}", text(&output.stderr)));
    (page, status(&output))
}

#[test]
fn a_report_holds_everything_in_one_page() {
    let folder = TempDir::new().expect("a folder");
    let file = super::flip(&folder);
    let (page, status) = page(folder.path(), &on_mikron(&file));
    assert_eq!(status, 1);
    for text in [
        "FAIL",
        "pole-flip",
        "Coverage",
        "in pictures, replay and set-up sheet; the check leaves it open",
        "Deviation: nothing to draw: the tip stays within 0.0001 mm",
        "Set-up sheet",
        "Joints",
        "Axis plane",
        "Deviation",
        "Feed",
        "Replay",
        "C52.595",
        "ball",
        "10 mm",
    ] {
        assert!(page.contains(text), "{text}");
    }
    assert_eq!(page.matches("<svg").count(), 4);
    // nothing is loaded from elsewhere: the only addresses are names of XML
    let addresses: Vec<&str> = page
        .split("http")
        .skip(1)
        .map(|rest| &rest[..rest.len().min(24)])
        .collect();
    let foreign: Vec<_> = addresses
        .iter()
        .filter(|rest| rest.starts_with("://") || rest.starts_with("s://"))
        .filter(|rest| !rest.starts_with("://www.w3.org/"))
        .collect();
    assert!(foreign.is_empty(), "{foreign:?}");
    assert!(page.contains("default-src 'none'"));
}

/// What was not looked at stands beside the verdict, as large as it.
#[test]
fn a_report_says_what_it_did_not_look_at() {
    let folder = TempDir::new().expect("a folder");
    let program = "%\nO1\nG21 G17 G40 G49 G80 G90 G94 G54\nT1 M6\nM3 S1000\nG0 G43 H1 X0. Y0. Z50.\nG1 Z40. F200.\nG0 Z50.\nM5\nM30\n%\n";
    write(&folder, "good.nc", program);
    let more = [
        "good.nc",
        "--dialect",
        "fanuc-30i",
        "--assume",
        "work-offset,tool-length",
    ];
    let (without, status) = page(folder.path(), &more);
    assert_eq!(status, 0, "{without}");
    let left = "Not looked at: axes, limits and speeds of a machine (no machine is named).";
    assert!(without.contains("<h1>PASS in scope motion (no machine): good.nc</h1>"));
    assert!(without.contains("<span class=\"badge pass\">PASS in scope motion (no machine)</span>"));
    assert!(without.contains(&format!("<p class=\"left unknown\">{left}</p>")));
    let (with, status) = page(folder.path(), &[&more[..], &["--machine", "mill-3axis"]].concat());
    assert_eq!(status, 0);
    assert!(with.contains("<h1>PASS on mill-3axis: good.nc</h1>") && !with.contains("Not looked at"));
    // of a folder, in the line of each program
    write(&folder, "other.nc", program);
    let (both, _) = page(folder.path(), &[&["."], &more[1..]].concat());
    assert_eq!(
        both.matches("<td class=\"pass\">PASS in scope motion (no machine)</td>")
            .count(),
        2
    );
    assert_eq!(
        both.matches("<td>axes, limits and speeds of a machine (no machine is named)</td>")
            .count(),
        2
    );
}

#[test]
fn a_report_of_a_folder_lists_its_programs() {
    let folder = folder();
    let (page, status) = page(folder.path(), &["."]);
    assert_eq!(status, 1);
    assert!(page.contains("1 pass, 1 fail, 0 unknown, 0 not checked"));
    assert!(page.contains("href=\"#p1\""));
}

/// Into a folder goes a page for each program, written as they come, and an index.
#[test]
fn a_report_into_a_folder_has_a_page_for_each_program() {
    let folder = folder();
    fs::create_dir(folder.path().join("more")).expect("made");
    write(&folder, "more/good one.nc", super::GOOD);
    let (whole, _) = page(folder.path(), &["."]);
    fs::remove_file(folder.path().join("page.html")).expect("removed");
    let output = trunnion_in(folder.path(), &["report", ".", "-o", "pages/"]);
    assert_eq!(status(&output), 1, "{}", text(&output.stderr));
    let mut names: Vec<String> = fs::read_dir(folder.path().join("pages"))
        .expect("there")
        .map(|entry| entry.expect("read").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    assert_eq!(
        names,
        ["bad.nc.html", "good.nc.html", "index.html", "more_good_one.nc.html"]
    );
    let read = |name: &str| fs::read_to_string(folder.path().join("pages").join(name)).expect("read");
    let index = read("index.html");
    assert!(index.contains("2 pass, 1 fail, 0 unknown, 0 not checked"));
    for name in &names {
        let text = read(name);
        let (link, has) = if name == "index.html" {
            (&names[0], 0)
        } else {
            assert!(index.contains(&format!("<a href=\"{name}\">")), "{name}");
            (&names[2], 1)
        };
        assert!(text.contains(&format!("<a href=\"{link}\">")), "{name}");
        assert_eq!(text.matches("<article").count(), has, "{name}");
        // a program says the same on its own page and on that of all
        let article = text.split_once("<section>").map_or("", |(_, rest)| rest);
        let article = article.split_once("<script>\n").map_or(article, |(before, _)| before);
        assert!(has == 0 || whole.contains(article), "{name}");
    }
    // again into the folder that is there now, without its slash
    let output = trunnion_in(folder.path(), &["report", ".", "-o", "pages"]);
    assert_eq!(status(&output), 1);
    // a page never replaces a program
    write(&folder, "good.nc.html", super::GOOD);
    let output = trunnion_in(folder.path(), &["report", "good.nc", "good.nc.html", "-o", "./"]);
    assert_eq!(status(&output), 2);
    assert!(
        text(&output.stderr).contains("also an input"),
        "{}",
        text(&output.stderr)
    );
    assert_eq!(
        fs::read_to_string(folder.path().join("good.nc.html")).expect("there"),
        super::GOOD
    );
}

#[test]
fn hostile_names_and_comments_stay_text() {
    let folder = TempDir::new().expect("a folder");
    let program = FLIP
        .replace(
            "M5\n",
            "(</pre></script><script>alert(1)</script><img src=x onerror=alert(2)>)\nM5\n",
        )
        .replace("G1 X-28.38197", "(<b>&amp;</script>) G1 X-28.38197")
        .replace("C52.595", "C52.595 (</script><script>alert(3)</script>)");
    write(&folder, "a<img src=x>&'\"b.nc", &program);
    let (page, _) = page(
        folder.path(),
        &[
            "a<img src=x>&'\"b.nc",
            "--machine",
            "mikron-ucp710",
            "--dialect",
            "fanuc-30i",
        ],
    );
    assert_eq!(page.matches("<script").count(), 2, "the data and the replay");
    assert!(!page.contains("<img") && !page.contains("<b>&amp;"));
    assert!(page.contains("a&lt;img src=x&gt;&amp;&#39;&quot;b.nc"));
}

/// Waits for a text to stand in a file so many times.
fn wait_for(file: &Path, text: &str, times: usize) {
    for _ in 0..1200 {
        if fs::read_to_string(file).is_ok_and(|all| all.matches(text).count() >= times) {
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    panic!("{text} does not stand {times} times in {:?}", fs::read_to_string(file));
}

#[test]
fn watching_checks_again_when_a_program_changes() {
    let folder = folder();
    let log = folder.path().join("watch.log");
    let written = fs::File::create(&log).expect("created");
    let mut child = Command::new(env!("CARGO_BIN_EXE_trunnion"))
        .args(["check", "bad.nc", "--watch"])
        .current_dir(folder.path())
        .stdout(std::process::Stdio::null())
        .stderr(written)
        .spawn()
        .expect("runs");
    wait_for(&log, "watching", 1);
    write(&folder, "bad.nc", super::GOOD);
    wait_for(&log, "watching", 2);
    child.kill().expect("ended");
    child.wait().expect("ended");
    let said = fs::read_to_string(&log).expect("read");
    assert!(said.contains("FAIL bad.nc") && said.contains("PASS bad.nc"), "{said}");
    // its own log is in the folder and is no reason to check again
    assert_eq!(said.matches("watching").count(), 2, "{said}");
}
