//! From a table to a dialect: `extends`, ranges of codes, indexes, and every check that serde cannot make.
use crate::code::sort_key;
use crate::dialect::{Alarm, ArcTolerance, G_SLOTS, role_slot};
use crate::pattern::{Pattern, is_name, number_id, number_tenths};
use crate::schema::{AlarmRow, ArcToleranceRow, CodeRow, DialectError, FormatRow, Lex, Table};
use crate::{Code, CodeKind, Dialect, Role, builtin};
use core::ops::Range;
use std::collections::BTreeMap;
use toml::Spanned;
use trunnion_syntax::{Format, LexOptions};

const MM_PER_INCH: f64 = 25.4;

fn error<T>(span: Range<usize>, message: impl Into<String>) -> Result<T, DialectError> {
    Err(DialectError {
        message: message.into(),
        span: Some(span),
    })
}

/// Builds the dialect that `table` describes.
pub(crate) fn assemble(table: Table) -> Result<Dialect, DialectError> {
    let mut dialect = start(&table)?;
    dialect.name.clone_from(table.name.get_ref());
    dialect.title = table.title.clone().unwrap_or_else(|| dialect.name.clone());
    let source = table
        .source
        .clone()
        .unwrap_or_else(|| format!("the table {}", dialect.name));
    dialect.quirks = table.quirks.over(&dialect.quirks);
    dialect.quirks.arc_tolerance_relative = dialect.arc.relative;
    dialect.advice = table.check.over(&dialect.advice);
    if let Some(lex) = table.lex {
        dialect.lex = lex_options(lex);
    }
    if let Some(row) = &table.arc_tolerance {
        dialect.arc = arc_tolerance(row)?;
        dialect.quirks.arc_tolerance_relative = dialect.arc.relative;
    }
    dialect.extensions = extensions(&table.extensions)?;
    roles(&table.roles, &mut dialect)?;
    addresses(&table.addresses, &mut dialect)?;
    for (name, doc) in &table.groups {
        if !is_kebab(name.get_ref()) {
            return error(
                name.span(),
                format!("group `{}`: write lower-case words joined by `-`", name.get_ref()),
            );
        }
        dialect.groups.insert(name.get_ref().clone(), doc.clone());
    }
    for id in &table.remove {
        let pattern = Pattern::parse(id, dialect.lex.format)?;
        let before = dialect.codes.len();
        dialect.codes.retain(|code| !pattern.matches(code));
        if dialect.codes.len() == before {
            return error(
                id.span(),
                format!(
                    "`{}` is not in the extended table: there is nothing to remove",
                    id.get_ref()
                ),
            );
        }
    }
    if let Some(rows) = &table.alarms {
        dialect.alarms.clear();
        alarms(rows, &source, &mut dialect)?;
    }
    if !table.builder_codes.is_empty() {
        dialect.builder_codes.clear();
    }
    for id in &table.builder_codes {
        match Pattern::parse(id, dialect.lex.format)? {
            Pattern::Numbers(kind, tenths) => dialect.builder_codes.push((kind, tenths)),
            Pattern::Name(name) => {
                return error(
                    id.span(),
                    format!("`{name}`: only G and M codes can belong to the machine builder"),
                );
            }
        }
    }
    codes(table.codes, &source, &mut dialect)?;
    index(&mut dialect);
    Ok(dialect)
}

/// The dialect that is extended, or an empty one.
fn start(table: &Table) -> Result<Dialect, DialectError> {
    if !is_kebab(table.name.get_ref()) {
        return error(
            table.name.span(),
            "the name of a dialect must be lower-case words joined by `-`",
        );
    }
    if let Some(base) = &table.extends {
        if base.get_ref() == table.name.get_ref() {
            return error(base.span(), "a table cannot extend itself");
        }
        return match builtin(base.get_ref()) {
            Some(base) => Ok(base.clone()),
            None => error(
                base.span(),
                format!(
                    "unknown built-in dialect `{}`; known are {}",
                    base.get_ref(),
                    crate::BUILTIN_NAMES.join(", ")
                ),
            ),
        };
    }
    let missing = match (&table.lex, &table.arc_tolerance) {
        (None, _) => "[lex]",
        (_, None) => "[arc-tolerance]",
        _ => return Ok(Dialect::empty()),
    };
    error(
        table.name.span(),
        format!("a table that does not extend another one needs {missing}"),
    )
}

fn lex_options(lex: Lex) -> LexOptions {
    LexOptions {
        format: match lex.format {
            FormatRow::Iso => Format::Iso,
            FormatRow::Apt => Format::Apt,
            FormatRow::Klartext => Format::Klartext,
            FormatRow::Osp => Format::Osp,
        },
        paren_comment: lex.paren_comment,
        semicolon_comment: lex.semicolon_comment,
        slash_star_comment: lex.slash_star_comment,
        blanks_in_numbers: lex.blanks_in_numbers,
    }
}

fn arc_tolerance(row: &ArcToleranceRow) -> Result<ArcTolerance, DialectError> {
    let positive = |value: &Spanned<f64>| {
        if value.get_ref().is_finite() && *value.get_ref() > 0.0 {
            Ok(*value.get_ref())
        } else {
            error(
                value.span(),
                format!("{} is not a tolerance: write a number greater than 0", value.get_ref()),
            )
        }
    };
    if row.source.get_ref().trim().is_empty() {
        return error(row.source.span(), "name the source of the tolerance");
    }
    let mm = positive(&row.mm)?;
    Ok(ArcTolerance {
        mm,
        inch_mm: row
            .inch
            .as_ref()
            .map_or(Ok(mm), |inch| positive(inch).map(|inch| inch * MM_PER_INCH))?,
        relative: row.relative.as_ref().map_or(Ok(0.0), positive)?,
        relative_up_to: row.relative_up_to.as_ref().map_or(Ok(f64::INFINITY), positive)?,
        source: row.source.get_ref().clone(),
    })
}

fn extensions(rows: &[Spanned<String>]) -> Result<Vec<String>, DialectError> {
    for row in rows {
        let plain = row
            .get_ref()
            .bytes()
            .all(|b| b.is_ascii_lowercase() || b.is_ascii_digit());
        if row.get_ref().is_empty() || !plain {
            return error(
                row.span(),
                format!(
                    "`{}`: write a file name extension in lower case, without the dot",
                    row.get_ref()
                ),
            );
        }
    }
    Ok(rows.iter().map(|row| row.get_ref().clone()).collect())
}

fn roles(rows: &BTreeMap<Spanned<String>, Role>, dialect: &mut Dialect) -> Result<(), DialectError> {
    for (letter, &role) in rows {
        let slot = match letter.get_ref().as_bytes() {
            [one] => role_slot(*one),
            _ => None,
        };
        let Some(slot) = slot else {
            return error(
                letter.span(),
                format!("`{}` is not one upper-case letter, `@`, `^` or `$`", letter.get_ref()),
            );
        };
        if role == Role::Axis && !b"XYZABCUVW".contains(&letter.get_ref().as_bytes()[0]) {
            return error(
                letter.span(),
                format!("`{}` is not an axis; the axes are X Y Z A B C U V W", letter.get_ref()),
            );
        }
        dialect.roles[slot] = Some(role);
    }
    Ok(())
}

fn alarms(rows: &BTreeMap<Spanned<String>, AlarmRow>, source: &str, dialect: &mut Dialect) -> Result<(), DialectError> {
    for (mistake, row) in rows {
        if !is_kebab(mistake.get_ref()) || row.number.trim().is_empty() {
            return error(
                mistake.span(),
                format!(
                    "alarm `{}`: write the name of a mistake and its `number`",
                    mistake.get_ref()
                ),
            );
        }
        let alarm = Alarm {
            number: row.number.clone(),
            source: row.source.clone().unwrap_or_else(|| source.to_owned()),
        };
        dialect.alarms.insert(mistake.get_ref().clone(), alarm);
    }
    Ok(())
}

fn addresses(rows: &BTreeMap<Spanned<String>, Role>, dialect: &mut Dialect) -> Result<(), DialectError> {
    for (name, &role) in rows {
        let text = name.get_ref();
        let stem = text.strip_suffix('#').unwrap_or(text);
        if !is_name(stem) || (stem.len() != 1 && stem.len() != text.len()) {
            return error(
                name.span(),
                format!("`{text}`: write an upper-case name such as CR or A3, or one letter and `#`"),
            );
        }
        dialect.named.retain(|(known, _)| known != text);
        dialect.named.push((text.clone(), role));
    }
    dialect.named.sort_by(|a, b| a.0.cmp(&b.0));
    Ok(())
}

fn codes(rows: BTreeMap<Spanned<String>, CodeRow>, source: &str, dialect: &mut Dialect) -> Result<(), DialectError> {
    if source.trim().is_empty() {
        return Err(DialectError {
            message: "`source` is empty: name the standard or manual".to_owned(),
            span: None,
        });
    }
    for (id, row) in rows {
        let pattern = Pattern::parse(&id, dialect.lex.format)?;
        let code = check_row(&id, row, source, dialect)?;
        dialect.codes.retain(|known| !pattern.matches(known));
        match pattern {
            Pattern::Name(name) => dialect.codes.push(Code {
                id: name,
                kind: CodeKind::Name,
                ..code
            }),
            Pattern::Numbers(kind, tenths) => {
                let step = if tenths.start() == tenths.end() { 1 } else { 10 };
                let ids = tenths.step_by(step).map(|t| Code {
                    id: number_id(kind, t),
                    kind,
                    ..code.clone()
                });
                dialect.codes.extend(ids);
            }
        }
    }
    if dialect.codes.len() >= usize::from(u16::MAX) {
        return Err(DialectError {
            message: "the table has more than 65534 codes".to_owned(),
            span: None,
        });
    }
    Ok(())
}

fn check_row(id: &Spanned<String>, row: CodeRow, source: &str, dialect: &Dialect) -> Result<Code, DialectError> {
    if let Some(group) = &row.group
        && !dialect.groups.contains_key(group.get_ref())
    {
        return error(
            group.span(),
            format!("`{}`: [groups] has no group `{}`", id.get_ref(), group.get_ref()),
        );
    }
    let doc = row.doc.get_ref();
    if doc.trim().is_empty() || doc.contains('\n') {
        return error(
            row.doc.span(),
            format!("`{}`: describe in one line what the code does", id.get_ref()),
        );
    }
    let mut lengths = row.lengths.iter().flatten();
    if let Some(other) = lengths.find(|length| !row.words.contains(length.get_ref())) {
        return error(
            other.span(),
            format!(
                "`{}`: `{}` of `lengths` is not among its `words`",
                id.get_ref(),
                other.get_ref()
            ),
        );
    }
    let own = row.source.map(|own| (own.span(), own.into_inner()));
    if let Some((span, text)) = &own
        && text.trim().is_empty()
    {
        return error(span.clone(), format!("`{}`: the source is empty", id.get_ref()));
    }
    Ok(Code {
        id: String::new(),
        kind: CodeKind::Name,
        group: row.group.map(Spanned::into_inner),
        words: row.words,
        lengths: row
            .lengths
            .map(|lengths| lengths.into_iter().map(Spanned::into_inner).collect()),
        action: row.action,
        path: row.path,
        feed: row.feed.map(crate::schema::FeedRow::action),
        doc: row.doc.into_inner(),
        source: own.map_or_else(|| source.to_owned(), |(_, text)| text),
        owner: row.owner,
    })
}

/// Sorts the codes and fills the look-up tables.
fn index(dialect: &mut Dialect) {
    dialect.codes.sort_by(|a, b| sort_key(a).cmp(&sort_key(b)));
    dialect.g = vec![0; G_SLOTS];
    dialect.m = vec![0; G_SLOTS];
    dialect.names.clear();
    for (i, code) in dialect.codes.iter().enumerate() {
        let slot = i as u16 + 1;
        match (code.kind, number_tenths(&code.id)) {
            (CodeKind::G, Some(tenths)) => dialect.g[tenths as usize] = slot,
            (CodeKind::M, Some(tenths)) => dialect.m[tenths as usize] = slot,
            _ => dialect.names.push(slot - 1),
        }
    }
}

fn is_kebab(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_lowercase())
        && text
            .split('-')
            .all(|part| !part.is_empty() && part.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit()))
}
