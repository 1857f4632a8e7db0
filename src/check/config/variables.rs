//! `[variables]` of `trunnion.toml`: what variables hold before a program runs.
use super::ConfigError;
use std::collections::BTreeMap;
use toml::{Spanned, Value};
use trunnion_dialect::{Dialect, Language};
use trunnion_interp::{NamedVariables, is_stored_global};
use trunnion_syntax::Format;

/// The section as written: `"#500" = 12.5`, `501 = "vacant"`, `R1 = 12.5`.
pub(super) type FileVariables = BTreeMap<Spanned<String>, Spanned<Value>>;

/// The largest number of a variable (Fanuc Series 30i operator's manual, custom macro: system variables of five and six digits).
const LARGEST: u32 = 999_999;
/// The largest number of an R parameter that is read.
const LARGEST_R: u32 = 99_999;
/// Q0 to Q1999, QR0 to QR499 (HEIDENHAIN TNC 640 user's manual, Q parameter programming).
const LARGEST_Q: u32 = 1999;
const LARGEST_QR: u32 = 499;
/// V1 to V200 and VC1 to VC200 (see `src/interp/osp/variables.rs`).
const LARGEST_V: u32 = 200;

/// The variables of a kind of control that keep their values between programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Family {
    /// `#500`: Fanuc, Haas and their like.
    Macro,
    /// `#500` and `#<_name>`.
    Linuxcnc,
    /// R parameters.
    Sinumerik,
    /// Q and QR.
    Klartext,
    /// V and VC.
    Okuma,
    /// The language has no variables.
    None,
}

impl Family {
    fn of(dialect: &Dialect) -> Self {
        match (dialect.lex.format, dialect.quirks.language) {
            (Format::Klartext, _) => Self::Klartext,
            (Format::Apt, _) | (_, Language::Words) => Self::None,
            (_, Language::MacroB) => Self::Macro,
            (_, Language::Linuxcnc) => Self::Linuxcnc,
            (_, Language::Sinumerik) => Self::Sinumerik,
            (_, Language::UserTask) => Self::Okuma,
        }
    }

    /// How its variables are written in the settings.
    fn form(self) -> &'static str {
        match self {
            Self::Macro => "`\"#500\" = 12.5`",
            Self::Linuxcnc => "`\"#500\" = 12.5` or `\"#<_name>\" = 12.5`",
            Self::Sinumerik => "`R1 = 12.5`",
            Self::Klartext => "`Q5 = 12.5` or `QR5 = 12.5`",
            Self::Okuma => "`V1 = 12.5` or `VC1 = 12.5`",
            Self::None => "",
        }
    }
}

/// What a name in the section stands for.
#[derive(Debug, PartialEq)]
enum Variable {
    Number(u32),
    Name(String, Family),
}

/// What the section declares.
pub(super) struct Declared {
    pub(super) numbered: Vec<(u32, Option<f64>)>,
    pub(super) named: NamedVariables,
}

/// Values by number, and by name, each sorted. `dialect`: the one that the settings name.
pub(super) fn variables(section: &FileVariables, dialect: Option<&Dialect>) -> Result<Declared, ConfigError> {
    let mut numbered: BTreeMap<u32, Option<f64>> = BTreeMap::new();
    let mut named: BTreeMap<String, f64> = BTreeMap::new();
    for (name, value) in section {
        let variable = read(name.get_ref(), dialect).map_err(|why| fault(name, why))?;
        let held = match value.get_ref() {
            Value::Float(number) if number.is_finite() => Some(*number),
            Value::Integer(number) if number.unsigned_abs() < 1 << 53 => Some(*number as f64),
            Value::String(text) if text == "vacant" && matches!(variable, Variable::Number(_)) => None,
            _ => {
                let or_vacant = match variable {
                    Variable::Number(_) => ", or \"vacant\"",
                    Variable::Name(..) => "",
                };
                let what = name.get_ref().trim();
                let key = if what.starts_with('#') {
                    format!("\"{what}\"")
                } else {
                    what.to_owned()
                };
                return Err(fault(
                    value,
                    format!("the value of a variable must be a number{or_vacant}: `{key} = 12.5`"),
                ));
            }
        };
        let twice = match (variable, held) {
            (Variable::Number(number), held) => numbered.insert(number, held).map(|_| format!("#{number}")),
            (Variable::Name(text, _), Some(held)) => named.insert(text.clone(), held).map(|_| text),
            (Variable::Name(..), None) => None,
        };
        if let Some(twice) = twice {
            return Err(fault(name, format!("{twice} is declared twice")));
        }
    }
    Ok(Declared {
        numbered: numbered.into_iter().collect(),
        named: NamedVariables(named.into_iter().collect()),
    })
}

fn fault<T>(place: &Spanned<T>, message: impl Into<String>) -> ConfigError {
    ConfigError {
        message: message.into(),
        span: Some(place.span()),
    }
}

/// A variable that can have a value before the program runs and keeps it until the program writes it, or why the text names none.
fn read(text: &str, dialect: Option<&Dialect>) -> Result<Variable, String> {
    let text = text.trim();
    let variable = recognised(text).map_err(|why| match (why, dialect) {
        (Some(why), _) => format!("`{text}` {why}"),
        (None, Some(dialect)) => format!("`{text}` is no variable{}", right_form(dialect)),
        (None, None) => format!(
            "`{text}` is no variable that can be declared: write `\"#500\" = 12.5` (Fanuc, Haas, LinuxCNC), `\"#<_name>\"` (LinuxCNC), `R1` (Sinumerik), \
             `Q5` or `QR5` (Klartext), `V1` or `VC1` (Okuma)"
        ),
    })?;
    let Some(dialect) = dialect else { return Ok(variable) };
    let family = Family::of(dialect);
    let fits = match &variable {
        Variable::Number(_) => matches!(family, Family::Macro | Family::Linuxcnc),
        Variable::Name(_, own) => *own == family,
    };
    if fits {
        return Ok(variable);
    }
    Err(format!("`{text}` is no variable{}", right_form(dialect)))
}

/// ` of sinumerik-840d: write ...`.
fn right_form(dialect: &Dialect) -> String {
    let form = Family::of(dialect).form();
    if form.is_empty() {
        format!(
            " of {}, whose programs have none that can be declared: remove it",
            dialect.name
        )
    } else {
        format!(" of {} that can be declared: write {form}", dialect.name)
    }
}

/// The variable of a name, of whatever control; else why it cannot be declared, `None` where it is no variable.
fn recognised(text: &str) -> Result<Variable, Option<&'static str>> {
    let digits = text.strip_prefix('#').unwrap_or(text);
    if !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit()) {
        let number = digits.parse().ok().filter(|number| *number <= LARGEST);
        return number.ok_or(None).and_then(|number| numbered(number).map_err(Some));
    }
    if let Some(inside) = text.strip_prefix("#<").and_then(|rest| rest.strip_suffix('>')) {
        let name = inside.split_whitespace().collect::<String>().to_ascii_lowercase();
        return if is_stored_global(&name) {
            Ok(Variable::Name(format!("#<{name}>"), Family::Linuxcnc))
        } else if name.starts_with('_') {
            Err(Some("belongs to the control, which alone gives it a value"))
        } else {
            Err(Some(
                "is local to a program and has no value when a program starts: a name that begins with `_` is global, `\"#<_name>\" = 12.5`",
            ))
        };
    }
    let upper = text.to_ascii_uppercase();
    let letters = upper.trim_end_matches(|last: char| last.is_ascii_digit());
    let digits = &upper[letters.len()..];
    let number: u32 = digits.parse().map_err(|_| None)?;
    let name = |family| Ok(Variable::Name(format!("{letters}{number}"), family));
    match letters {
        "R" if number <= LARGEST_R => name(Family::Sinumerik),
        "Q" if (100..200).contains(&number) => {
            Err(Some("is a value of the control, which changes while the program runs"))
        }
        "Q" if number <= LARGEST_Q => name(Family::Klartext),
        "QR" if number <= LARGEST_QR => name(Family::Klartext),
        "QL" => Err(Some(
            "is local to a program and has no value when a program starts: Q and QR keep theirs",
        )),
        "QS" => Err(Some("holds a text, which is not followed")),
        "V" | "VC" if (1..=LARGEST_V).contains(&number) => name(Family::Okuma),
        "V" | "VC" => Err(Some("is no common variable: they are V1 to V200 and VC1 to VC200")),
        _ => Err(None),
    }
}

/// A numbered variable, or why it cannot be declared.
fn numbered(number: u32) -> Result<Variable, &'static str> {
    match number {
        0..=33 => Err("is local to a program and has no value when a program starts"),
        3000..=3012 => Err("is an alarm, a message or a clock, not a stored value"),
        4000..=4199 => Err("is modal information, which changes while the program runs"),
        5001..=5160 => Err("is a position, which changes while the program runs"),
        5201..=5390 => Err("is a work offset: declare it in [work_offsets]"),
        number => Ok(Variable::Number(number)),
    }
}

/// What to write under `[variables]` for the first variable in a text whose value the settings can give: `R1 = 12.5`.
pub(crate) fn declaration(text: &str, dialect: &Dialect) -> Option<String> {
    let family = Family::of(dialect);
    let hash = matches!(family, Family::Macro | Family::Linuxcnc);
    let in_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let tokens: Vec<&str> = if hash {
        let ends = |rest: &str| match rest.strip_prefix('<') {
            Some(_) => rest.find('>').map_or(0, |end| end + 1),
            None => rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len()),
        };
        let starts = text.match_indices('#').map(|(at, _)| at);
        starts.map(|at| &text[at..=at + ends(&text[at + 1..])]).collect()
    } else {
        text.split(|c| !in_name(c)).collect()
    };
    tokens
        .into_iter()
        .find_map(|token| match read(token, Some(dialect)).ok()? {
            Variable::Number(number) if hash => Some(format!("\"#{number}\" = 12.5")),
            Variable::Name(name, Family::Linuxcnc) => Some(format!("\"{name}\" = 12.5")),
            Variable::Name(name, _) => Some(format!("{name} = 12.5")),
            Variable::Number(_) => None,
        })
}

#[cfg(test)]
mod tests {
    use super::declaration;
    use crate::Config;

    #[test]
    fn a_section_is_read_in_order() {
        let config = Config::parse(
            "[variables]\n\"#1005\" = 1\n500 = -2.5\n\"#101\" = \"vacant\"\nr2 = 7\nQR5=1\nq5 = 3.5\n\"#<_ My Depth>\" = -1\nvc1 = 2\n",
        )
        .expect("read");
        assert_eq!(
            config.setup.variables,
            [(101, None), (500, Some(-2.5)), (1005, Some(1.0))]
        );
        let named = [
            ("#<_mydepth>", -1.0),
            ("Q5", 3.5),
            ("QR5", 1.0),
            ("R2", 7.0),
            ("VC1", 2.0),
        ];
        assert_eq!(
            config.setup.named_variables.0,
            named.map(|(name, value)| (name.to_owned(), value))
        );
    }

    #[test]
    fn what_cannot_be_declared_is_refused_at_its_place() {
        for (text, wrong) in [
            ("[variables]\n\"#5\" = 1", "\"#5\""),
            ("[variables]\n\"#<a>\" = 1", "\"#<a>\""),
            ("[variables]\n\"#<_x>\" = 1", "\"#<_x>\""),
            ("[variables]\n\"#<_ini[a]b>\" = 1", "\"#<_ini[a]b>\""),
            ("[variables]\n\"#4001\" = 1", "\"#4001\""),
            ("[variables]\n\"#5061\" = 1", "\"#5061\""),
            ("[variables]\n\"#5221\" = 1", "\"#5221\""),
            ("[variables]\n\"#500\" = nan", "nan"),
            ("[variables]\n\"#500\" = \"empty\"", "\"empty\""),
            ("[variables]\n\"#500\" = true", "true"),
            ("[variables]\nR1 = \"vacant\"", "\"vacant\""),
            ("[variables]\nR1 = \"5\"", "\"5\""),
            ("[variables]\nQL1 = 5", "QL1"),
            ("[variables]\nQS1 = 5", "QS1"),
            ("[variables]\nQ108 = 5", "Q108"),
            ("[variables]\nQ2000 = 5", "Q2000"),
            ("[variables]\nVC201 = 5", "VC201"),
            ("[variables]\nDEPTH = 5", "DEPTH"),
            ("[variables]\nR = 5", "R"),
        ] {
            let error = Config::parse(text).expect_err(text);
            let span = error
                .span
                .clone()
                .unwrap_or_else(|| panic!("{text}: {error} has no place"));
            assert_eq!(text[span].trim_matches('"'), wrong.trim_matches('"'), "{error}");
        }
        assert!(Config::parse("[variables]\n500 = 1\n\"#500\" = 2\n").is_err(), "twice");
        assert!(Config::parse("[variables]\nR1 = 1\nr01 = 2\n").is_err(), "twice");
    }

    /// As many variables as a file can hold; each was compared with all before it.
    #[test]
    fn many_variables_are_read_in_their_order() {
        let lines: Vec<String> = (0..90_000).rev().map(|at| format!("R{at} = 1\n")).collect();
        let numbers = lines.concat();
        let config = Config::parse(&format!("[variables]\n{numbers}")).expect("valid");
        assert_eq!(config.setup.named_variables.0.len(), 90_000);
        let named = &config.setup.named_variables.0;
        assert!(named.is_sorted_by(|one, other| one.0 < other.0));
        let again = format!("[variables]\n{numbers}r0 = 2\n");
        assert_eq!(
            Config::parse(&again).expect_err("twice").message,
            "R0 is declared twice"
        );
    }

    /// A variable of another control than the one that the settings name is refused, with the form of that control.
    #[test]
    fn each_control_has_its_own_variables() {
        let names = [
            (
                "\"#500\"",
                &["fanuc-30i", "haas-ngc", "linuxcnc"][..],
                "`\"#500\" = 12.5`",
            ),
            ("\"#<_depth>\"", &["linuxcnc"], "`\"#<_name>\" = 12.5`"),
            ("R1", &["sinumerik-840d"], "`R1 = 12.5`"),
            ("Q5", &["heidenhain-klartext"], "`Q5 = 12.5`"),
            ("QR5", &["heidenhain-klartext"], "`QR5 = 12.5`"),
            ("VC1", &["okuma-osp"], "`VC1 = 12.5`"),
        ];
        let all = [
            "fanuc-30i",
            "haas-ngc",
            "linuxcnc",
            "sinumerik-840d",
            "heidenhain-klartext",
            "okuma-osp",
            "grbl",
        ];
        for dialect in all {
            let forms: Vec<&str> = (names.iter())
                .filter(|(_, own, _)| own.contains(&dialect))
                .map(|(.., form)| *form)
                .collect();
            for (name, own, _) in &names {
                let text = format!("dialect = \"{dialect}\"\n[variables]\n{name} = 1\n");
                match Config::parse(&text) {
                    Ok(_) => assert!(own.contains(&dialect), "{text}"),
                    Err(error) => {
                        assert!(!own.contains(&dialect), "{text}: {error}");
                        assert!(error.message.contains(dialect), "{error}");
                        assert!(forms.iter().all(|form| error.message.contains(form)), "{error}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_finding_names_what_can_be_declared() {
        let of = |text, dialect| declaration(text, trunnion_dialect::builtin(dialect).expect("embedded"));
        for (text, dialect, line) in [
            ("2*R12+R1", "sinumerik-840d", Some("R12 = 12.5")),
            ("XR1", "sinumerik-840d", None),
            ("#5 and #500, which", "fanuc-30i", Some("\"#500\" = 12.5")),
            ("#5", "fanuc-30i", None),
            ("#<depth> #<_depth> x", "linuxcnc", Some("\"#<_depth>\" = 12.5")),
            ("#", "linuxcnc", None),
            ("#<", "linuxcnc", None),
            ("Q108 of Q7: the program", "heidenhain-klartext", Some("Q7 = 12.5")),
            ("V3", "okuma-osp", Some("V3 = 12.5")),
            ("500", "fanuc-30i", None),
            ("500", "grbl", None),
        ] {
            assert_eq!(of(text, dialect).as_deref(), line, "{text}");
        }
    }
}
