//! Words that are written with `=`: what they set, and what variables they write.
use crate::engine::Engine;
use crate::iso::Iso;
use crate::words::Words;
use crate::written::{Keep, Values, full_name, named_role, names, packed, resolved, stem, written};
use crate::{Argument, Effect, Reach, canonical_text};
use std::collections::HashMap;
use trunnion_dialect::{Action, CodeKind, Role};
use trunnion_syntax::{Address, Block, BlockId, Item, Value, Word};

/// What words written with `=` set: `ADIS=0.5`, `LIMS=2000`, `R1=5`; before them the number of the block, where it counts.
pub(crate) fn named_effects(run: &mut Iso<'_>, view: &Block<'_>, block: BlockId) {
    run.number_effect(view);
    let mut effects = Vec::new();
    for word in view.words() {
        if matches!(word.address, Address::Letter(_)) {
            continue;
        }
        // `S1=500 M1=3`: words of the main spindle, as S500 M3 are
        if let Address::Indexed(letter @ (b'S' | b'M'), index) = word.address
            && run.core.dialect.quirks.declares_names()
            && (index == 0 || run.memory.own.main_spindle == Some(u32::from(index)))
            && !run.memory.own.is_declared(&format!("{}{index}", char::from(letter)))
        {
            continue;
        }
        let stem = stem(view, &word);
        if stem.starts_with('#') {
            continue;
        }
        let argument = |name: String| {
            let text = view.program().text(word.value_range);
            match word.value {
                Value::Number(decimal) => Argument::number(name, decimal.to_f64()),
                _ => match run.value(&text) {
                    Some(value) => Argument::number(name, value),
                    None => Argument::text(name, &resolved(run, &text)),
                },
            }
        };
        let (full, index_known) = full_name(run, view, &word);
        // the block has written its variables by now
        let stored = |name: String| match run.memory.own.held(&name) {
            Some(value) => Argument::number(name, value),
            None => argument(name),
        };
        match named_role(run, view, &word) {
            Some(Role::Variable) if !index_known => {
                // it may be any of them
                let mut words = vec![argument(full)];
                words.extend(run.memory.own.all());
                effects.push(Effect::Unmodelled(words));
            }
            Some(Role::Variable) => effects.push(Effect::Store(stored(full))),
            Some(Role::Parameter | Role::FeedOverride | Role::RapidOverride) => {
                let key = match stem.as_str() {
                    "SPOS" | "SPOSA" | "SPCON" | "SPCOF" | "SVC" => "spindle".to_owned(),
                    "LIMS" => "speed limit".to_owned(),
                    _ => full.clone(),
                };
                let auxiliary = stem.starts_with('H') && stem[1..].bytes().all(|byte| byte.is_ascii_digit());
                if auxiliary {
                    effects.push(Effect::Event(vec![argument(full)]));
                } else if depends_on_unknown(run, view, &word) {
                    // two texts may have one value
                    effects.push(Effect::Unmodelled(vec![argument(full)]));
                    effects.push(Effect::left(key));
                } else {
                    effects.push(Effect::set(key, [argument(full)]));
                }
            }
            None if run
                .core
                .dialect
                .name(&stem)
                .is_some_and(|code| code.kind == CodeKind::Name) =>
            {
                effects.push(Effect::set(full.clone(), [argument(full)]));
            }
            None if stem.starts_with('$') => effects.push(Effect::Event(vec![argument(full)])),
            None if run.core.dialect.quirks.user_names() && !run.memory.own.is_declared(&stem) => {
                effects.push(Effect::Store(stored(full)));
            }
            _ => {}
        }
    }
    for effect in effects {
        // a setting of one axis or frame: `POS[X]=5`
        let of_axis = matches!(&effect, Effect::Set { key, .. } if key.contains('['));
        let reach = if of_axis { Reach::Place } else { effect.usual_reach() };
        run.core.effects.add_with(block, effect, reach);
    }
}

/// Whether the value of a word is a formula with variables of the program whose values are not known.
fn depends_on_unknown(run: &Iso<'_>, view: &Block<'_>, word: &Word) -> bool {
    if matches!(word.value, Value::Number(_)) {
        return false;
    }
    let text = view.program().text(word.value_range);
    let of_program = |name: &str| {
        // `R5`, and the R of `R[5]`
        let digits = name.strip_prefix('R');
        let is_parameter = digits.is_some_and(|digits| digits.bytes().all(|byte| byte.is_ascii_digit()));
        run.memory.own.is_declared(name) || is_parameter
    };
    let text = text.to_ascii_uppercase();
    let mut names = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
    run.core.dialect.quirks.declares_names() && run.value(&text).is_none() && names.any(of_program)
}

/// The comments of a block, for codes that read them.
pub(crate) fn comments(view: &Block<'_>) -> Vec<Argument> {
    let texts = view.items().filter_map(|item| match item {
        Item::Comment(comment) => Some(view.program().text(comment.range).trim().to_owned()),
        _ => None,
    });
    texts.map(|text| Argument::text("comment", &text)).collect()
}

/// Declarations whose values are not followed: texts, axes, frames, fields, unknown expressions, and names that stand for words (DEFINE).
pub(crate) fn declarations(run: &Iso<'_>, view: &Block<'_>) -> Vec<Argument> {
    let mut found = Vec::new();
    for item in view.items() {
        let Item::Call(call) = item else { continue };
        let name = packed(&view.program().text(call.name));
        let text = view.program().text(call.range);
        let rest = text.trim_start().get(name.len()..).unwrap_or_default().trim();
        if run
            .core
            .dialect
            .name(&name)
            .is_none_or(|code| code.action != Action::Declaration)
        {
            continue;
        }
        match name.as_str() {
            "DEFINE" => {
                let defined = rest.split(char::is_whitespace).next().unwrap_or_default();
                if is_used(run, view, defined) {
                    found.push(Argument::text(name, &crate::canonical_text(rest)));
                }
            }
            "DEF" => {
                let Some((kind, names)) = rest.split_once(char::is_whitespace) else {
                    continue;
                };
                for one in crate::own::arguments(names) {
                    let Some((variable, value)) = one.split_once('=') else {
                        continue;
                    };
                    let stem = variable.split('[').next().unwrap_or_default().trim();
                    if run.memory.own.held(variable.trim()).is_none()
                        && !run.memory.own.is_known_field(stem)
                        && is_used(run, view, stem)
                    {
                        let text = format!("{} {}={}", packed(kind), packed(variable), resolved(run, value));
                        found.push(Argument::text("DEF", &text));
                    }
                }
            }
            _ => {}
        }
    }
    found
}

/// Whether a name that the block declares is in the text of the program anywhere else.
fn is_used(run: &Iso<'_>, view: &Block<'_>, name: &str) -> bool {
    let text = view.program().source();
    let names = (run.memory.own.names).get_or_init(|| std::sync::Arc::new(Names::of(text)));
    if names.of.as_slice() == [text.as_ptr() as usize, text.len()] {
        return names.several(name.as_bytes());
    }
    // a called program
    Names::of(text).several(name.as_bytes())
}

/// The names in a text, and which of them it has more than once.
#[derive(Debug, Default)]
pub(crate) struct Names {
    /// Where the text is, and its length.
    of: [usize; 2],
    several: HashMap<Box<[u8]>, bool>,
}

impl Names {
    fn of(text: &[u8]) -> Self {
        let mut names: HashMap<Box<[u8]>, bool> = HashMap::new();
        let of_name = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
        for name in text.split(|byte| !of_name(byte)).filter(|name| is_name(name)) {
            let upper: Box<[u8]> = name.to_ascii_uppercase().into();
            names
                .entry(upper)
                .and_modify(|several| *several = true)
                .or_insert(false);
        }
        Self {
            of: [text.as_ptr() as usize, text.len()],
            several: names,
        }
    }

    fn several(&self, name: &[u8]) -> bool {
        // what is no plain name may be anywhere
        !is_name(name) || self.several.get(&*name.to_ascii_uppercase()).copied().unwrap_or(false)
    }
}

/// Letters, digits and underscores, with a letter or an underscore first.
fn is_name(text: &[u8]) -> bool {
    let plain = text.iter().all(|byte| byte.is_ascii_alphanumeric() || *byte == b'_');
    plain && text.first().is_some_and(|first| !first.is_ascii_digit())
}

/// The words of a block that writes a variable of the control (Fanuc and Haas: #1000 and above), with the operator's message in its
/// comment. A number that is computed may be any.
pub(crate) fn system_assignment(run: &Iso<'_>, view: &Block<'_>) -> Option<Effect> {
    if !run.core.dialect.quirks.macro_b() {
        return None;
    }
    let mut found = Vec::new();
    // a computed number, as the engine has found it
    let computed = run.flow.deep.as_ref().and_then(|deep| deep.assigned);
    let mut index_known = true;
    for item in view.items() {
        let range = match item {
            Item::Word(word) if matches!(word.address, Address::Named(_)) => word.range,
            Item::Other(range) => range,
            _ => continue,
        };
        let text = packed(&view.program().text(range));
        let Some((name, value)) = text.strip_prefix('#').and_then(|rest| rest.split_once('=')) else {
            continue;
        };
        let number = name.parse::<i64>().ok();
        let number = number.or_else(|| name.starts_with('[').then_some(computed)?);
        let name = match number {
            Some(0..=999) => continue,
            Some(number) => number.to_string(),
            None if name.starts_with('<') => continue,
            None => {
                index_known = false;
                resolved(run, name)
            }
        };
        found.push(Argument::text(format!("#{name}"), &resolved(run, value)));
    }
    if found.is_empty() {
        return None;
    }
    found.extend(comments(view));
    if index_known {
        return Some(Effect::Event(found));
    }
    // it may be any of them
    found.extend(run.flow.all_variables());
    Some(Effect::Unmodelled(found))
}

/// Whether a block reads the present machine coordinates (Series 30i operator's manual, custom macro: #5021 and following).
pub(crate) fn reads_machine_position(view: &Block<'_>) -> bool {
    let text = &view.program().source()[view.range().as_usize()];
    // digits may have blanks between them
    if !(text.contains(&b'#') && text.contains(&b'5')) {
        return false;
    }
    view.items().any(|item| match item {
        Item::Word(word) => names(&view.program().text(word.range))
            .iter()
            .any(|name| name.starts_with("#502") && name.len() == 5),
        _ => false,
    })
}

/// The words of a block that gives a variable a value which is not known.
pub(crate) fn unknown_assignment(run: &Iso<'_>, view: &Block<'_>, words: &Words) -> Option<Vec<Argument>> {
    let unknown = |text: &str| {
        names(text)
            .iter()
            .any(|name| run.variable(name).is_some_and(f64::is_nan))
    };
    let assigns = view.items().any(|item| match item {
        Item::Word(word) => match word.address {
            Address::Named(_) | Address::Indexed(..) if run.core.dialect.quirks.user_names() => {
                let variable = matches!(named_role(run, view, &word), None | Some(Role::Variable));
                let (name, _) = full_name(run, view, &word);
                let unknown = || {
                    !matches!(word.value, Value::Number(_))
                        && run.value(&view.program().text(word.value_range)).is_none()
                };
                // fields and texts of the program are not followed
                variable
                    && run.memory.own.held(&name).is_none()
                    && (run.memory.own.is_declared(&stem(view, &word)) || unknown())
            }
            // a variable of the program with one letter: DEF REAL Q
            Address::Letter(letter) if run.core.dialect.quirks.user_names() => {
                let name = char::from(letter).to_string();
                let assigned = run.memory.own.is_declared(&name) && !matches!(word.value, Value::Number(_));
                assigned && run.memory.own.held(&name).is_none()
            }
            _ => unknown(&view.program().text(word.range)),
        },
        Item::Call(call) => unknown(&view.program().text(call.range)),
        Item::Other(range) => unknown(&view.program().text(range)),
        _ => false,
    });
    assigns.then(|| written(view, run, words, Keep::All))
}

/// Words with a name in a block that reads them beside its codes: `M19 RS=30` of an Okuma gives the angle.
pub(crate) fn named_words(run: &Iso<'_>, view: &Block<'_>) -> Vec<Argument> {
    let words = view.items().filter_map(|item| match item {
        Item::Word(word) if matches!(word.address, Address::Named(_)) => Some(word.range),
        _ => None,
    });
    let said = |range| resolved(run, &canonical_text(&view.program().text(range)));
    words.map(|range| Argument::text("", &said(range))).collect()
}
