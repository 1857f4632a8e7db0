//! Lints of expressions and flow: RS274/NGC against custom macro B.
use super::line::Line;
use super::{Hit, Route};
use trunnion_dialect::Expressions;

fn hit(line: &Line<'_>, at: usize, length: usize, message: &str, help: &'static str) -> Hit {
    Hit {
        range: line.range(at, length),
        message: message.to_owned(),
        help,
        once: None,
    }
}

/// FIX of a negative number: RS274/NGC rounds down (measured: FIX[-2.8] is -3), macro B truncates toward zero; FUP the other way.
pub(super) fn rounding(line: &Line<'_>, route: &Route<'_>, hits: &mut Vec<Hit>) {
    if !route.crosses() || !line.has_bracket() {
        return;
    }
    let to_macro = route.languages.1 == Expressions::MacroB;
    for (name, there) in [
        (
            "FIX",
            [
                "rounds down: FIX[-2.8] is -3 there, -2 here",
                "truncates toward zero: FIX[-2.8] is -2 there, -3 here",
            ],
        ),
        (
            "FUP",
            [
                "rounds up: FUP[-2.2] is -2 there, -3 here",
                "rounds away from zero: FUP[-2.2] is -3 there, -2 here",
            ],
        ),
    ] {
        for at in line.functions(name) {
            let message = format!("{name} {}", there[usize::from(to_macro)]);
            hits.push(hit(
                line,
                at,
                3,
                &message,
                "make sure that its argument is never negative, or use ABS",
            ));
        }
    }
}

/// MOD of a negative number: RS274/NGC gives a remainder of zero or more (measured: -5 MOD 3 is 1); macro B the sign of the dividend.
pub(super) fn remainder(line: &Line<'_>, route: &Route<'_>, hits: &mut Vec<Hit>) {
    if route.crosses() && line.has_bracket() {
        for at in line.found("MOD") {
            hits.push(hit(
                line,
                at,
                3,
                "MOD has another sign for negative numbers: LinuxCNC gives 1 for -5 MOD 3, Macro B works with whole numbers and keeps the sign",
                "make sure that both operands are whole numbers and never negative",
            ));
        }
    }
}

/// What a bracket holds at its own level.
#[derive(Clone, Copy, Default)]
struct Level {
    /// First AND, OR or XOR.
    logic: Option<(usize, usize)>,
    and: bool,
    or: bool,
    /// A comparison or arithmetic.
    other: bool,
}

impl Level {
    /// Whether the two languages group it differently.
    fn differs(self) -> Option<(usize, usize)> {
        self.logic.filter(|_| self.other || self.and && self.or)
    }
}

/// AND, OR, XOR: in RS274/NGC the weakest of all operators and of one rank; in macro B AND ranks with `*`, OR and XOR with `+`.
pub(super) fn precedence(line: &Line<'_>, route: &Route<'_>, hits: &mut Vec<Hit>) {
    const NAMES: [(&str, bool); 10] = [
        ("XOR", true),
        ("AND", true),
        ("OR", true),
        ("MOD", false),
        ("EQ", false),
        ("NE", false),
        ("GT", false),
        ("GE", false),
        ("LT", false),
        ("LE", false),
    ];
    if !route.crosses() || !line.has_bracket() {
        return;
    }
    let mut open: Vec<Level> = Vec::new();
    let mut found = Vec::new();
    let mut at = 0;
    let mut before = b'[';
    while let Some(&byte) = line.text.get(at) {
        let mut length = 1;
        match byte {
            b'<' => length = line.text[at..].iter().position(|&b| b == b'>').map_or(1, |end| end + 1),
            b'[' => open.push(Level::default()),
            b']' => found.extend(open.pop().and_then(Level::differs)),
            b'+' | b'-' | b'*' | b'/' => {
                let binary = before == b']' || before == b'>' || before == b'.' || before.is_ascii_digit();
                if let (Some(level), true) = (open.last_mut(), binary) {
                    level.other = true;
                }
            }
            b'A'..=b'Z' => {
                if let (Some(level), Some((name, logic))) = (
                    open.last_mut(),
                    NAMES
                        .iter()
                        .find(|(name, _)| line.text[at..].starts_with(name.as_bytes())),
                ) {
                    length = name.len();
                    if *logic {
                        level.logic = level.logic.or(Some((at, length)));
                        level.and |= *name == "AND";
                        level.or |= *name != "AND";
                    } else {
                        level.other = true;
                    }
                }
            }
            _ => {}
        }
        if !matches!(byte, b' ' | b'\t') {
            before = line.text[(at + length - 1).min(line.text.len() - 1)];
        }
        at += length;
    }
    for (at, length) in found {
        hits.push(hit(
            line,
            at,
            length,
            "this is grouped differently: in Macro B AND binds like `*` and OR like `+`, before any comparison; in RS274/NGC they come last, from left to right",
            "put each part in its own brackets",
        ));
    }
}

/// `**` is RS274/NGC.
pub(super) fn power(line: &Line<'_>, route: &Route<'_>, hits: &mut Vec<Hit>) {
    if route.languages == (Expressions::Rs274Ngc, Expressions::MacroB) {
        for at in line.found("**") {
            hits.push(hit(
                line,
                at,
                2,
                "there is no operator `**`",
                "write POW[base,exponent]",
            ));
        }
    }
}

/// `#<name>` is RS274/NGC.
pub(super) fn named_parameter(line: &Line<'_>, route: &Route<'_>, hits: &mut Vec<Hit>) {
    if route.languages == (Expressions::Rs274Ngc, Expressions::MacroB)
        && let Some(at) = line.found("#<").next()
    {
        let end = line.text[at..]
            .iter()
            .position(|&byte| byte == b'>')
            .map_or(2, |end| end + 1);
        let mut found = hit(
            line,
            at,
            end,
            "parameters cannot have names in `< >`",
            "use a number for each: #1 to #33 in a macro, #100 to #199, #500 to #999",
        );
        found.once = Some("named");
        hits.push(found);
    }
}

/// O-words against WHILE, IF and GOTO.
pub(super) fn flow(line: &Line<'_>, route: &Route<'_>, hits: &mut Vec<Hit>) {
    const O_WORDS: [&str; 14] = [
        "SUB",
        "ENDSUB",
        "CALL",
        "RETURN",
        "IF",
        "ELSEIF",
        "ELSE",
        "ENDIF",
        "WHILE",
        "ENDWHILE",
        "DO",
        "REPEAT",
        "ENDREPEAT",
        "BREAK",
    ];
    let text: &[u8] = &line.text;
    let first = text
        .iter()
        .position(|byte| !byte.is_ascii_whitespace())
        .unwrap_or(text.len());
    let mut found = match route.languages {
        (Expressions::Rs274Ngc, Expressions::MacroB) if text[first..].starts_with(b"O") => {
            let name = text[first + 1..]
                .iter()
                .position(|byte| byte.is_ascii_alphabetic() || *byte == b'<')
                .map_or(text.len(), |at| first + 1 + at);
            let word = match text.get(name) {
                Some(b'<') => text[name..]
                    .iter()
                    .position(|&byte| byte == b'>')
                    .map_or(text.len(), |end| name + end + 1),
                _ => name,
            };
            let rest = text[word..].trim_ascii_start();
            if !O_WORDS.iter().any(|known| rest.starts_with(known.as_bytes())) {
                return;
            }
            let length = text[first..].trim_ascii_end().len();
            hit(
                line,
                first,
                length,
                "there are no O-words for loops, branches and calls",
                "write WHILE [..] DO1 ... END1, IF [..] GOTO n, and G65 P or M98 P with one program per subprogram",
            )
        }
        (Expressions::MacroB, Expressions::Rs274Ngc) => {
            let known = ["WHILE", "GOTO", "IF"]
                .iter()
                .find_map(|name| Some((line.found(name).next()?, name.len())));
            let Some((at, length)) = known else { return };
            hit(
                line,
                at,
                length,
                "there is no WHILE, IF or GOTO without O-words",
                "write o1 while [..] ... o1 endwhile, o2 if [..] ... o2 endif; there is no jump to a number",
            )
        }
        _ => return,
    };
    found.once = Some("flow");
    hits.push(found);
}
