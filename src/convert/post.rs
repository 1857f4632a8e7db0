//! Posts: number formats and templates of a control, as a TOML table in `grammar/posts` or your own file.
use crate::template::fill;
use core::ops::Range;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::OnceLock;
use toml::Spanned;
use trunnion_machine::Machine;

mod templates;
use templates::{TEMPLATES, check_template};

/// Names of the posts that are built in: those of their dialects.
pub const BUILTIN_POSTS: &[&str] = &[
    "iso-6983",
    "linuxcnc",
    "fanuc-30i",
    "haas-ngc",
    "sinumerik-840d",
    "grbl",
    "heidenhain-klartext",
    "okuma-osp",
];

/// Texts, in the order of [`BUILTIN_POSTS`]. A post may extend only one that comes before it.
const TEXTS: [&str; 8] = [
    include_str!("../../grammar/posts/iso-6983.toml"),
    include_str!("../../grammar/posts/linuxcnc.toml"),
    include_str!("../../grammar/posts/fanuc-30i.toml"),
    include_str!("../../grammar/posts/haas-ngc.toml"),
    include_str!("../../grammar/posts/sinumerik-840d.toml"),
    include_str!("../../grammar/posts/grbl.toml"),
    include_str!("../../grammar/posts/heidenhain-klartext.toml"),
    include_str!("../../grammar/posts/okuma-osp.toml"),
];

static LOADED: [OnceLock<Option<Post>>; 8] = [const { OnceLock::new() }; 8];

/// Why a post cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PostError {
    /// What is wrong and what to do.
    pub message: String,
    /// Bytes in the file, where known.
    pub span: Option<Range<usize>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct RawPost {
    dialect: Option<Spanned<String>>,
    extends: Option<Spanned<String>>,
    extension: Option<String>,
    #[serde(rename = "source")]
    _source: Option<String>,
    #[serde(default)]
    numbers: RawNumbers,
    #[serde(default)]
    text: RawText,
    #[serde(default)]
    templates: BTreeMap<Spanned<String>, Spanned<String>>,
    #[serde(default)]
    without: RawWithout,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct RawNumbers {
    length_mm: Option<Spanned<usize>>,
    length_inch: Option<Spanned<usize>>,
    angle: Option<Spanned<usize>>,
    vector: Option<Spanned<usize>>,
    feed: Option<Spanned<usize>>,
    feed_per_revolution: Option<Spanned<usize>>,
    speed: Option<Spanned<usize>>,
    inverse_time_digits: Option<Spanned<usize>>,
    point: Option<bool>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct RawText {
    number_from: Option<u32>,
    number_step: Option<u32>,
    upper_case: Option<bool>,
    arc: Option<ArcWords>,
    tcp_on: Option<String>,
    tcp_off: Option<String>,
    work_offset: Option<String>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawWithout {
    #[serde(default)]
    templates: Vec<Spanned<String>>,
}

/// How arcs are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum ArcWords {
    Centre,
    Radius,
}

/// A post: number formats and templates of a control.
#[derive(Clone, Debug)]
pub struct Post {
    /// Its dialect.
    pub dialect: String,
    /// Extension of its files.
    pub extension: String,
    /// Digits after the decimal point: mm, inch.
    pub(crate) length: [usize; 2],
    pub(crate) angle: usize,
    pub(crate) vector: usize,
    pub(crate) feed: usize,
    /// Of F per revolution: it is small, so it needs more of them.
    pub(crate) feed_per_revolution: usize,
    pub(crate) speed: usize,
    pub(crate) inverse_time_digits: usize,
    pub(crate) point: bool,
    pub(crate) number_from: u32,
    pub(crate) number_step: u32,
    pub(crate) upper_case: bool,
    pub(crate) arc: ArcWords,
    /// Codes for tool centre point control where the machine declares none.
    pub(crate) tcp_on: Option<String>,
    pub(crate) tcp_off: Option<String>,
    /// The work offset of a program that names none, or names it as another control does.
    pub(crate) work_offset: String,
    pub(crate) templates: BTreeMap<String, String>,
}

/// A built-in post by its name; loaded once.
pub fn builtin_post(name: &str) -> Option<&'static Post> {
    let index = BUILTIN_POSTS.iter().position(|&known| known == name)?;
    LOADED[index].get_or_init(|| load_post(TEXTS[index]).ok()).as_ref()
}

/// The text of a built-in post, as a start for your own.
pub fn builtin_post_source(name: &str) -> Option<&'static str> {
    let index = BUILTIN_POSTS.iter().position(|&known| known == name)?;
    Some(TEXTS[index])
}

/// Loads a post. Missing keys are as in the one that it `extends`.
///
/// # Errors
/// What is wrong with it, and where.
pub fn load_post(text: &str) -> Result<Post, PostError> {
    let raw: RawPost = toml::from_str(text).map_err(|error| PostError {
        message: error.message().to_owned(),
        span: error.span(),
    })?;
    let mut post = base(&raw)?;
    if let Some(name) = &raw.dialect {
        if trunnion_dialect::builtin(name.get_ref()).is_none() || name.get_ref() == "apt" {
            return Err(fault(
                name.span(),
                format!("no dialect of G-code is named {:?}", name.get_ref()),
            ));
        }
        post.dialect.clone_from(name.get_ref());
    }
    post.extension = raw.extension.unwrap_or(post.extension);
    post.numbers(&raw.numbers)?;
    let words = raw.text;
    post.number_from = words.number_from.unwrap_or(post.number_from);
    post.number_step = words.number_step.unwrap_or(post.number_step);
    post.upper_case = words.upper_case.unwrap_or(post.upper_case);
    post.arc = words.arc.unwrap_or(post.arc);
    post.tcp_on = words.tcp_on.or(post.tcp_on);
    post.tcp_off = words.tcp_off.or(post.tcp_off);
    post.work_offset = words.work_offset.unwrap_or(post.work_offset);
    for key in &raw.without.templates {
        if post.templates.remove(key.get_ref()).is_none() {
            let message = format!("there is no template {:?} to leave out", key.get_ref());
            return Err(fault(key.span(), message));
        }
    }
    for (key, value) in &raw.templates {
        check_template(text, key, value)?;
        post.templates.insert(key.get_ref().clone(), value.get_ref().clone());
    }
    for (key, _) in TEMPLATES.iter().take(3) {
        if !post.templates.contains_key(*key) {
            return Err(PostError {
                message: format!("the template {key} is missing; write it, or `extends = \"iso-6983\"`"),
                span: None,
            });
        }
    }
    Ok(post)
}

fn fault(span: Range<usize>, message: String) -> PostError {
    PostError {
        message,
        span: Some(span),
    }
}

/// The post that is extended, or an empty one.
fn base(raw: &RawPost) -> Result<Post, PostError> {
    if let Some(name) = &raw.extends {
        return builtin_post(name.get_ref()).cloned().ok_or_else(|| {
            let known = BUILTIN_POSTS.join(", ");
            fault(
                name.span(),
                format!("no post is named {:?}; built in are {known}", name.get_ref()),
            )
        });
    }
    let Some(dialect) = &raw.dialect else {
        return Err(PostError {
            message: "a post names its `dialect`, or a built-in post that it `extends`".to_owned(),
            span: None,
        });
    };
    Ok(Post {
        dialect: dialect.get_ref().clone(),
        extension: "nc".to_owned(),
        length: [4, 5],
        angle: 4,
        vector: 8,
        feed: 4,
        feed_per_revolution: 6,
        speed: 3,
        inverse_time_digits: 7,
        point: false,
        number_from: 10,
        number_step: 10,
        upper_case: false,
        arc: ArcWords::Centre,
        tcp_on: None,
        tcp_off: None,
        work_offset: "G54".to_owned(),
        templates: BTreeMap::new(),
    })
}

impl Post {
    fn numbers(&mut self, raw: &RawNumbers) -> Result<(), PostError> {
        let pairs = [
            (&raw.length_mm, &mut self.length[0], 0..=9),
            (&raw.angle, &mut self.angle, 0..=9),
            (&raw.vector, &mut self.vector, 3..=12),
            (&raw.feed, &mut self.feed, 0..=6),
            (&raw.feed_per_revolution, &mut self.feed_per_revolution, 0..=9),
            (&raw.speed, &mut self.speed, 0..=6),
            (&raw.inverse_time_digits, &mut self.inverse_time_digits, 4..=15),
        ];
        for (written, slot, range) in pairs {
            digits(written.as_ref(), slot, range)?;
        }
        digits(raw.length_inch.as_ref(), &mut self.length[1], 0..=9)?;
        self.point = raw.point.unwrap_or(self.point);
        Ok(())
    }

    /// A template with its names filled in, for programs that are not proved (test pieces, faults on purpose); `None`:
    /// the control has no such code.
    ///
    /// # Errors
    /// The first name in it that `value` does not know.
    pub fn fill(&self, key: &str, value: impl Fn(&str) -> Option<String>) -> Option<Result<String, &str>> {
        Some(fill(self.template(key)?, value))
    }

    /// Whether a length is called by a number that a program could get wrong (G43 H2).
    pub fn numbers_its_lengths(&self) -> bool {
        self.template("length-on").is_some_and(|text| text.contains("{tool}"))
    }

    /// The code that switches tool centre point control on or off: the one that the machine declares, else the post's. Empty where a
    /// machine always guides the tip; `None`: there is no such code.
    pub fn tcp_code(&self, machine: Option<&Machine>, on: bool) -> Option<String> {
        let Some(codes) = machine.and_then(|machine| machine.control.tcp_codes.as_ref()) else {
            return if on { &self.tcp_on } else { &self.tcp_off }.clone();
        };
        let code = if on { &codes.on } else { &codes.off }.first().cloned();
        let always = codes.at_start && codes.off.is_empty();
        code.or_else(|| always.then(String::new))
    }

    /// A template; `None`: the control has no such code.
    pub(crate) fn template(&self, key: &str) -> Option<&str> {
        self.templates.get(key).map(String::as_str)
    }
}

fn digits(
    written: Option<&Spanned<usize>>,
    slot: &mut usize,
    range: core::ops::RangeInclusive<usize>,
) -> Result<(), PostError> {
    let Some(written) = written else { return Ok(()) };
    if !range.contains(written.get_ref()) {
        let message = format!(
            "{} digits; {} to {} are possible",
            written.get_ref(),
            range.start(),
            range.end()
        );
        return Err(fault(written.span(), message));
    }
    *slot = *written.get_ref();
    Ok(())
}

#[cfg(test)]
mod tests;
