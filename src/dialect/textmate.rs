//! TextMate grammars made from the tables: first colours in an editor, before the language server answers.
//!
//! Only scopes that every theme colours are used. Expressions are written for Oniguruma, the engine of TextMate and VS Code.
use crate::{Action, Code, CodeKind, Dialect};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use trunnion_syntax::Format;

/// A grammar, as JSON text, that colours programs of all the `dialects`: `source.apt` if the first is APT, `source.klartext` if it is Klartext, else
/// `source.gcode`.
pub fn textmate(dialects: &[&Dialect]) -> String {
    let format = dialects.first().map(|dialect| dialect.lex.format);
    let grammar = match format {
        Some(Format::Apt) => apt_grammar(dialects),
        Some(Format::Klartext) => klartext_grammar(dialects),
        Some(Format::Iso | Format::Osp) | None => iso_grammar(dialects),
    };
    let mut text = format!("{grammar:#}");
    text.push('\n');
    text
}

fn klartext_grammar(dialects: &[&Dialect]) -> Value {
    let motion = |code: &Code| {
        matches!(
            code.action,
            Action::Linear | Action::ArcCounterClockwise | Action::ArcTangent | Action::Polynomial
        )
    };
    let moving = names(dialects, motion);
    let other = names(dialects, |code| !motion(code));
    let start = r"(?i)^[ \t]*/?[ \t]*(?:\d+[ \t]+)?/?[ \t]*";
    let number = r"[+-]?(?:\d+[.,]?\d*|[.,]\d+)";
    json!({
        "name": "HEIDENHAIN Klartext",
        "scopeName": "source.klartext",
        "patterns": [
            { "match": ";.*?(?=~?[ \\t]*$)", "name": "comment.line.semicolon.klartext" },
            { "match": r"^[ \t]*(?:\d+[ \t]+)?(\*.*)$", "captures": { "1": { "name": "markup.heading.klartext" } } },
            { "match": "\"[^\"\\n]*\"?", "name": "string.quoted.double.klartext" },
            { "match": format!(r"{start}({moving})(?=[ \t]|$)"), "captures": { "1": { "name": "keyword.control.motion.klartext" } } },
            { "match": format!(r"{start}({other})(?=[ \t\d]|$)"), "captures": { "1": { "name": "entity.name.function.klartext" } } },
            { "match": r"(?i)\bM\d+\b", "name": "entity.name.function.miscellaneous.klartext" },
            { "match": r"(?i)[+-]?\bQ[LRS]?\d+\b", "name": "variable.other.klartext" },
            { "match": format!(r"(?i)(?<![A-Z])(I?[XYZABCUVW]|I?P[AR]|[NT][XYZ])({number})"),
              "captures": { "1": { "name": "variable.parameter.axis.klartext" }, "2": { "name": "constant.numeric.klartext" } } },
            { "match": r"(?i)\b(?:FMAX|FAUTO|R0|RL|RR|DR[+-])(?![A-Z0-9])", "name": "variable.parameter.klartext" },
            { "match": number, "name": "constant.numeric.klartext" },
            { "match": "~[ \\t]*$", "name": "keyword.operator.continuation.klartext" }
        ]
    })
}

fn apt_grammar(dialects: &[&Dialect]) -> Value {
    let motion = |code: &Code| {
        matches!(
            code.action,
            Action::Rapid | Action::Linear | Action::ArcCounterClockwise | Action::CannedCycle
        )
    };
    let moving = names(dialects, motion);
    let other = names(dialects, |code| !motion(code));
    let start = r"(?i)^[ \t]*(?:\d+[ \t]+)?";
    json!({
        "name": "APT/CL",
        "scopeName": "source.apt",
        "patterns": [
            { "include": "#comment" },
            { "match": format!(r"{start}(PARTNO|PPRINT|REMARK|TITLES|LETTER|INSERT|DISPLY)\b(.*)$"),
              "captures": { "1": { "name": "entity.name.function.apt" }, "2": { "name": "string.unquoted.apt" } } },
            { "match": format!(r"{start}({moving})[ \t]*(?=/|$|\$)"), "captures": { "1": { "name": "keyword.control.motion.apt" } } },
            { "match": format!(r"{start}({other})[ \t]*(?=/|$|\$)"), "captures": { "1": { "name": "entity.name.function.apt" } } },
            { "match": r"(?i)^[ \t]*([A-Z][A-Z0-9_-]*)[ \t]*(?=/)", "captures": { "1": { "name": "invalid.illegal.unknown-record.apt" } } },
            { "match": r"\$(?=[ \t]*$)", "name": "keyword.operator.continuation.apt" },
            { "match": r"'[^'\n]*'?", "name": "string.quoted.single.apt" },
            { "match": r"(?<![A-Za-z0-9_.])[+-]?(?:\d+\.?\d*|\.\d+)(?:[Ee][+-]?\d+)?(?![A-Za-z_])", "name": "constant.numeric.apt" },
            { "match": r"(?i)\b[A-Z][A-Z0-9_]*\b", "name": "variable.parameter.apt" },
            { "match": r"[/,]", "name": "punctuation.separator.apt" },
            { "match": r"=", "name": "keyword.operator.assignment.apt" }
        ],
        "repository": {
            "comment": { "match": r"\$\$.*$", "name": "comment.line.double-dollar.apt" }
        }
    })
}

fn iso_grammar(dialects: &[&Dialect]) -> Value {
    json!({
        "name": "G-code",
        "scopeName": "source.gcode",
        "patterns": [
            { "include": "#program" }, { "include": "#comment" }, { "include": "#string" }, { "include": "#skip" },
            { "include": "#o-word" }, { "include": "#names" }, { "include": "#codes" }, { "include": "#words" },
            { "include": "#expression" }
        ],
        "repository": {
            "program": { "patterns": [
                { "match": r"^\s*%[^;(]*", "name": "keyword.control.program.gcode" },
                { "match": r"^\$[^%\s]*%", "name": "keyword.control.program.gcode" },
                { "match": r"^\$(?=\s)", "name": "keyword.operator.continuation.gcode" },
                { "match": r"(?i)^\s*/?\s*(?!NOEX|NCYL|OMIT)([NO][A-Z][A-Z0-9]{0,3})(?=[ \t(]|$)(?!\s*=)", "captures": { "1": { "name": "entity.name.function.label.gcode" } } },
                { "match": r"(?i)^\s*(?:N\d+\s*)?([A-Z_][A-Z0-9_]+:|:\d+)(?!=)", "name": "entity.name.function.label.gcode" }
            ] },
            "comment": { "patterns": [
                { "begin": ";", "end": "$", "name": "comment.line.semicolon.gcode", "patterns": [ { "include": "#directive" } ] },
                { "begin": r"/\*", "end": r"\*/", "name": "comment.block.gcode", "patterns": [ { "include": "#directive" } ] },
                { "begin": r"(?<![=*/+\-<>,(])\(", "end": r"\)|$", "name": "comment.block.parentheses.gcode",
                  "patterns": [ { "include": "#directive" } ] }
            ] },
            "directive": { "match": r"(?i)(?<=[(;*\s])trunnion:\s*[a-z]+", "name": "keyword.control.directive.gcode" },
            "string": { "match": "\"[^\"\\n]*\"?", "name": "string.quoted.double.gcode" },
            "skip": { "match": r"^\s*/\d?(?![*])", "name": "keyword.control.skip.gcode" },
            "o-word": { "match": r"(?i)^\s*(?:N\d+(?:\.\d+)?\s*)?(O\s*(?:\d+|<[^>\n]*>|(?=[#\[])))", "captures": { "1": { "name": "entity.name.function.gcode" } } },
            "names": names_part(dialects),
            "codes": codes_part(dialects),
            "words": words_part(),
            "arguments": { "patterns": [
                { "include": "#string" },
                { "begin": r"\(", "end": r"\)|$", "patterns": [ { "include": "#arguments" } ] },
                { "match": ",", "name": "punctuation.separator.gcode" },
                { "include": "#expression" }
            ] },
            "expression": expression_part()
        }
    })
}

fn names_part(dialects: &[&Dialect]) -> Value {
    let flow = |code: &Code| matches!(code.action, Action::SubprogramCall | Action::Declaration);
    let control = names(dialects, flow);
    let function = names(dialects, |code| !flow(code));
    json!({ "patterns": [
        { "match": format!(r"(?i)(?<![A-Za-z_$<#])({control})(?![A-Za-z_0-9])"), "name": "keyword.control.gcode" },
        { "begin": r"(?i)(?<![A-Za-z_$<#])([A-Z_$][A-Z_]+[A-Z0-9_]*)[ \t]*(\()", "end": r"\)|$",
          "beginCaptures": { "1": { "name": "entity.name.function.gcode" }, "2": { "name": "punctuation.section.arguments.gcode" } },
          "endCaptures": { "0": { "name": "punctuation.section.arguments.gcode" } },
          "patterns": [ { "include": "#arguments" } ] },
        { "match": format!(r"(?i)(?<![A-Za-z_$<#])({function})(?![A-Za-z_0-9])(?!\s*=[^=])"), "name": "entity.name.function.gcode" },
        { "match": r"(?i)([A-Z_$][A-Z_$]+[A-Z0-9_$]*(?:\[[^\]\n]*\])?|[A-Z]\d+)\s*(=)(?!=)",
          "captures": { "1": { "name": "variable.parameter.gcode" }, "2": { "name": "keyword.operator.assignment.gcode" } } }
    ] })
}

fn codes_part(dialects: &[&Dialect]) -> Value {
    let kind = |kind: CodeKind, wanted: &dyn Fn(&Code) -> bool| {
        let all = dialects.iter().flat_map(|dialect| dialect.codes());
        numbers(
            all.filter(|code| code.kind == kind && wanted(code))
                .map(|code| &code.id[1..]),
        )
    };
    let moves = |code: &Code| {
        matches!(
            code.action,
            Action::Rapid | Action::Linear | Action::ArcClockwise | Action::ArcCounterClockwise | Action::CannedCycle
        ) || (code.action == Action::NotModelled && code.group.as_deref() == Some("motion"))
    };
    let motion = kind(CodeKind::G, &moves);
    let g = kind(CodeKind::G, &|code| !moves(code));
    let m = kind(CodeKind::M, &|_| true);
    json!({ "patterns": [
        { "match": r"(?i)(?<![A-Z_.$<#])N\s*\d+(?:\.\d+)?", "name": "entity.name.tag.block-number.gcode" },
        { "match": format!(r"(?i)(?<![A-Z_.$<#])G\s*0*({motion})(?!\.?\d)"), "name": "keyword.control.motion.gcode" },
        { "match": format!(r"(?i)(?<![A-Z_.$<#])G\s*0*({g})(?!\.?\d)"), "name": "keyword.other.preparatory.gcode" },
        { "match": r"(?i)(?<![A-Z_.$<#])G\s*\d+(?:\.\d+)?", "name": "invalid.illegal.unknown-code.gcode" },
        { "match": format!(r"(?i)(?<![A-Z_.$<#])M\s*0*({m})(?!\.?\d)"), "name": "entity.name.function.miscellaneous.gcode" },
        { "match": r"(?i)(?<![A-Z_.$<#])M\s*\d+(?:\.\d+)?", "name": "entity.name.function.machine-builder.gcode" }
    ] })
}

fn words_part() -> Value {
    let number = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:EX[+-]?\d+)?";
    let word = |letters: &str, scope: &str| {
        json!({ "match": format!(r"(?i)(?<![A-Z_$<#])({letters})[ \t]*(?:({number})|(=)(?!=)|(?=[#\[+-]))"),
            "captures": { "1": { "name": scope }, "2": { "name": "constant.numeric.gcode" }, "3": { "name": "keyword.operator.assignment.gcode" } } })
    };
    json!({ "patterns": [
        { "match": r"(?i)(?<=[=*+/<>])\s*R\d+(?![\d.])", "name": "variable.other.gcode" },
        word("[XYZABCUVW]", "variable.parameter.axis.gcode"),
        word("[IJKR]", "variable.parameter.arc.gcode"),
        word("T", "entity.name.type.tool.gcode"),
        word("[DEFHLPQS]", "variable.parameter.gcode")
    ] })
}

fn expression_part() -> Value {
    json!({ "patterns": [
        { "match": r"#(?:\d+|<[^>\n]*>)?|\$[A-Za-z_][A-Za-z0-9_]*", "name": "variable.other.gcode" },
        { "match": r"(?i)(?<![A-Za-z_0-9])(?:SIN|COS|TAN|ASIN|ACOS|ATAN2?|SQRT|POT|ABS|ROUND|TRUNC|FIX|FUP|EXP|LN|POW|BIN|BCD|ADP|EXISTS|MINVAL|MAXVAL|BOUND)(?![A-Za-z_])",
          "name": "entity.name.function.math.gcode" },
        { "match": r"(?i)(?<![A-Za-z_])(?:EQ|NE|GT|GE|LT|LE|AND|OR|XOR|EOR|NOT|MOD|DIV)(?![A-Za-z_])|==|<>|<<|<=|>=|\*\*|[-+*/<>=]", "name": "keyword.operator.gcode" },
        { "match": r"(?:\d+\.?\d*|\.\d+)", "name": "constant.numeric.gcode" },
        { "match": r"[\[\]()]", "name": "punctuation.section.gcode" },
        { "match": r"[A-Za-z_][A-Za-z0-9_]+", "name": "variable.other.gcode" }
    ] })
}

/// Alternatives of all names that `wanted` takes, longest first so that none hides another; numbers may follow where the dialect
/// says so. Where there is none: an expression that never matches.
fn names(dialects: &[&Dialect], wanted: impl Fn(&Code) -> bool) -> String {
    let mut found = BTreeSet::new();
    for dialect in dialects {
        let digits = if dialect.quirks.numbers_follow_names {
            r"\d*"
        } else {
            ""
        };
        let codes = dialect
            .codes()
            .iter()
            .filter(|code| code.kind == CodeKind::Name && wanted(code));
        found.extend(codes.map(|code| format!("{}{digits}", code.id.replace('-', r"\-"))));
    }
    let mut found: Vec<String> = found.into_iter().collect();
    found.sort_by_key(|name| core::cmp::Reverse(name.len()));
    if found.is_empty() {
        "(?!)".to_owned()
    } else {
        found.join("|")
    }
}

/// Alternatives of code numbers: `43(?:\.[145])?`, longest first.
fn numbers<'a>(ids: impl Iterator<Item = &'a str>) -> String {
    // whole number: whether it is a code itself, and its decimals
    let mut wholes: BTreeMap<u32, (bool, BTreeSet<&str>)> = BTreeMap::new();
    for id in ids {
        let (whole, tenth) = id
            .split_once('.')
            .map_or((id, None), |(whole, tenth)| (whole, Some(tenth)));
        let entry = wholes.entry(whole.parse().unwrap_or_default()).or_default();
        match tenth {
            Some(tenth) => drop(entry.1.insert(tenth)),
            None => entry.0 = true,
        }
    }
    let alternative = |(whole, (itself, tenths)): (&u32, &(bool, BTreeSet<&str>))| {
        let digits: String = tenths.iter().copied().collect();
        match (itself, digits.len()) {
            (_, 0) => whole.to_string(),
            (true, _) => format!(r"{whole}(?:\.[{digits}])?"),
            (false, _) => format!(r"{whole}\.[{digits}]"),
        }
    };
    let all: Vec<String> = wholes.iter().rev().map(alternative).collect();
    if all.is_empty() {
        "(?!)".to_owned()
    } else {
        all.join("|")
    }
}
