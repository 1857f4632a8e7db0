//! Files that only define subprograms, judged alone: each subprogram is entered with unknown arguments.
use crate::flow_run::{run, unknown};
use trunnion_ngc::{Setup, Step};

/// Lines (from 1) of the rapids that were run, and how the run ended.
fn rapids(program: &str) -> (Vec<u32>, Step) {
    let setup = Setup {
        enter_definitions: true,
        any_ini: true,
        ..unknown()
    };
    let (_, heard, step) = run(program.as_bytes(), &setup, false);
    assert_eq!(heard.errors, [], "{program}");
    (heard.feeds.iter().map(|at| at.line + 1).collect(), step)
}

#[test]
fn each_definition_is_entered_once() {
    let two = "o<a> sub\ng0 x1\no<a> endsub\no<b> sub\ng0 x[#1+2]\no<b> return\ng0 x9\no<b> endsub\n";
    let percent = format!("%\n{two}%\n");
    let ended = format!("(two)\n\n{two}m2\ng0 x5\n");
    for (program, lines) in [(two, [2, 5]), (&percent, [3, 6]), (&ended, [4, 7])] {
        assert_eq!(rapids(program), (lines.to_vec(), Step::Ended), "{program}");
    }
    // what the first one calls does not run again
    let nested = "o1 sub\no2 call [3]\no1 endsub\no2 sub\ng0 x#1\no2 endsub\nm2\n";
    assert_eq!(rapids(nested), (vec![5], Step::Ended));
    // M2 in a subprogram ends it, and the next one follows
    let early = "o1 sub\ng0 x1\nm2\ng0 x2\no1 endsub\no2 sub\ng0 x3\no2 endsub\n";
    assert_eq!(rapids(early), (vec![2, 7], Step::Ended));
}

#[test]
fn a_program_that_does_something_enters_nothing_by_itself() {
    for program in [
        "o1 sub\ng0 x1\no1 endsub\ng0 x2\nm2\n",
        "o1 sub\ng0 x1\no1 endsub\no2 sub\ng0 x3\no2 endsub\no2 call\nm2\n",
    ] {
        let (lines, step) = rapids(program);
        assert_eq!((lines.len(), step), (1, Step::Ended), "{program}");
    }
    // without being asked, nothing is entered, as on the control
    let (_, heard, _) = run(b"o1 sub\ng0 x1\no1 endsub\nm2\n", &unknown(), false);
    assert_eq!(heard.feeds.len(), 0);
}

#[test]
fn what_depends_on_an_argument_is_not_decided() {
    let program = "o1 sub\ng0 x1\no2 if [#3 gt 0]\ng0 x2\no2 endif\no1 endsub\nm2\n";
    let (lines, step) = rapids(program);
    assert_eq!(lines, [2]);
    let Step::Undecided(text) = step else {
        panic!("{step:?}")
    };
    assert_eq!(
        text,
        "whether this branch runs depends on #3, an argument that the caller gives"
    );
}

/// The INI file is not known in a check: its numbers are unknown, and assigning to one may be an error.
#[test]
fn numbers_of_an_ini_file_that_is_not_known() {
    let setup = Setup {
        any_ini: true,
        ..unknown()
    };
    let program = b"g0 x#<_ini[probe]far>\n#<_ini[probe]far>=3\ng0 y#<_ini[probe]far>\nm2\n";
    let (_, heard, step) = run(program, &setup, false);
    assert_eq!((heard.feeds.len(), step), (2, Step::Ended));
    let said: Vec<&str> = heard.errors.iter().map(|error| error.1.as_str()).collect();
    assert_eq!(said.len(), 2, "{said:?}");
    assert!(said[0].contains("a value of the machine's INI file"), "{said:?}");
    assert!(
        said[1].contains("an error where the INI file has this number"),
        "{said:?}"
    );
}
