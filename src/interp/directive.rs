//! Comments that address Trunnion: `(trunnion: tool 1 ball diameter 10)`, `; trunnion: allow pole-flip because ...`.
use crate::{Tool, ToolShape};
use nom::branch::alt;
use nom::bytes::complete::{tag_no_case, take_while1};
use nom::character::complete::{multispace0, multispace1, u32 as integer};
use nom::combinator::{all_consuming, map, map_opt, opt, rest, value};
use nom::multi::many0;
use nom::number::complete::double;
use nom::sequence::{pair, preceded, terminated};
use nom::{IResult, Parser};
use trunnion_syntax::{Program, TextRange};

/// One directive.
#[derive(Clone, Debug, PartialEq)]
pub enum Directive {
    /// Declares a tool.
    Tool(Tool),
    /// `allow RULE because REASON` (reason may be empty: the check floor says so). On a line of its own it applies to the
    /// whole program, next to words to its block.
    Allow {
        /// Rule's name.
        rule: String,
        /// Text after `because`.
        reason: String,
    },
    /// `dialect NAME` or `machine NAME`: read before parsing; here only so that it is not an error.
    Mode {
        /// `dialect` or `machine`.
        key: String,
        /// The name.
        value: String,
    },
    /// `turned DEG`: a rewrite has turned the tool axes of this chain of motions by up to so much, deg.
    Turned(f64),
    /// `obstacle KEYS`: the keys of an `[[obstacle]]` of `trunnion.toml` in one line, not read here.
    Obstacle(String),
    /// Begins with `trunnion:` but cannot be read; the text says what is wrong.
    Broken(String),
}

/// The word that a directive begins with.
const MARK: &[u8] = b"trunnion:";

/// The key of an obstacle.
const OBSTACLE: &[u8] = b"obstacle";

/// All directives of a program with the range of their comment.
pub fn directives(program: &Program) -> Vec<(TextRange, Directive)> {
    // most programs have none: search for the mark before reading comments
    let source = program.source();
    let mut found = Vec::new();
    for at in memchr::memchr_iter(b':', source) {
        let marked = source[..=at]
            .last_chunk::<9>()
            .is_some_and(|text| text.eq_ignore_ascii_case(MARK));
        let Some(block) = marked.then(|| program.block_at(at as u32)).flatten() else {
            continue;
        };
        for comment in program
            .block(block)
            .comments()
            .filter(|comment| comment.inner.as_usize().contains(&at))
        {
            let text = program.text(comment.inner);
            let starts = comment.inner.start as usize + leading(&text) + MARK.len() == at + 1;
            if let Some(text) = after_mark(&text).filter(|_| starts) {
                found.push((comment.range, parse(text)));
            }
        }
    }
    found
}

/// Whether a comment may declare an obstacle: a cheap look at the bytes.
pub fn may_declare_obstacles(source: &[u8]) -> bool {
    memchr::memchr_iter(b':', source).any(|at| {
        let marked = source[..=at]
            .last_chunk::<9>()
            .is_some_and(|text| text.eq_ignore_ascii_case(MARK));
        let rest = source[at + 1..].trim_ascii_start();
        marked
            && rest
                .get(..OBSTACLE.len())
                .is_some_and(|word| word.eq_ignore_ascii_case(OBSTACLE))
    })
}

/// What the text of a comment says about turned tool axes, deg.
pub fn turned_deg(comment: &str) -> Option<f64> {
    match parse(after_mark(comment)?) {
        Directive::Turned(deg) => Some(deg),
        _ => None,
    }
}

/// Bytes of blank before the text.
fn leading(text: &str) -> usize {
    text.len() - text.trim_start().len()
}

/// What follows the mark at the start of a comment.
fn after_mark(text: &str) -> Option<&str> {
    let text = text.trim();
    let mark = text.as_bytes().get(..MARK.len())?;
    mark.eq_ignore_ascii_case(MARK).then(|| text[MARK.len()..].trim())
}

fn parse(text: &str) -> Directive {
    let key = text.split_whitespace().next().unwrap_or_default().to_ascii_lowercase();
    let parsed = match key.as_str() {
        "obstacle" => return Directive::Obstacle(text[OBSTACLE.len()..].trim().to_owned()),
        "tool" => all_consuming(tool).parse(text).map(|(_, tool)| tool),
        "allow" => all_consuming(allow).parse(text).map(|(_, allow)| allow),
        "turned" => all_consuming(turned).parse(text).map(|(_, turned)| turned),
        "dialect" | "machine" => all_consuming(mode).parse(text).map(|(_, mode)| mode),
        _ => {
            let known = "tool, obstacle, allow, turned, dialect and machine";
            return Directive::Broken(format!("`{key}` is not a directive; the directives are {known}"));
        }
    };
    parsed.unwrap_or_else(|_| {
        let form = match key.as_str() {
            "tool" => "tool NUMBER ball|flat|bull diameter MM [radius MM] [length MM]",
            "allow" => "allow RULE because REASON",
            "turned" => "turned DEGREES",
            _ => "dialect NAME, or machine NAME",
        };
        Directive::Broken(format!("cannot read `{text}`; write: {form}"))
    })
}

fn word(text: &str) -> IResult<&str, &str> {
    take_while1(|c: char| !c.is_whitespace()).parse(text)
}

fn mode(text: &str) -> IResult<&str, Directive> {
    let keys = alt((tag_no_case("dialect"), tag_no_case("machine")));
    map(
        pair(terminated(keys, multispace1), word),
        |(key, value): (&str, &str)| Directive::Mode {
            key: key.to_ascii_lowercase(),
            value: value.to_owned(),
        },
    )
    .parse(text)
}

fn turned(text: &str) -> IResult<&str, Directive> {
    let angle = preceded((tag_no_case("turned"), multispace1), terminated(double, multispace0));
    let sensible = |deg: f64| (deg > 0.0 && deg.is_finite()).then_some(Directive::Turned(deg));
    map_opt(angle, sensible).parse(text)
}

fn allow(text: &str) -> IResult<&str, Directive> {
    let reason = preceded((multispace1, tag_no_case("because")), rest);
    map(
        (
            preceded((tag_no_case("allow"), multispace1), word),
            opt(reason),
            multispace0,
        ),
        |(rule, reason, _)| Directive::Allow {
            rule: rule.to_ascii_lowercase(),
            reason: reason.unwrap_or_default().trim().to_owned(),
        },
    )
    .parse(text)
}

#[derive(Clone, Copy)]
enum Part {
    Ball,
    Flat,
    Bull,
    Diameter(f64),
    Radius(f64),
    Length(f64),
}

fn length<'t>(
    key: &'static str,
    part: fn(f64) -> Part,
) -> impl Parser<&'t str, Output = Part, Error = nom::error::Error<&'t str>> {
    map_opt(preceded((tag_no_case(key), multispace1), double), move |mm: f64| {
        (mm.is_finite() && (0.0..=1e6).contains(&mm)).then(|| part(mm))
    })
}

fn part(text: &str) -> IResult<&str, Part> {
    alt((
        value(Part::Ball, tag_no_case("ball")),
        value(Part::Flat, tag_no_case("flat")),
        value(Part::Bull, tag_no_case("bull")),
        length("diameter", Part::Diameter),
        length("radius", Part::Radius),
        length("length", Part::Length),
    ))
    .parse(text)
}

fn tool(text: &str) -> IResult<&str, Directive> {
    let number = preceded((tag_no_case("tool"), multispace1), integer);
    map_opt((number, many0(preceded(multispace1, part))), |(number, parts)| {
        assemble(number, &parts)
    })
    .parse(text)
}

/// A tool whose parts agree: a bull nose has a corner radius below half its diameter, a ball's is half its diameter, a flat has none.
fn assemble(number: u32, parts: &[Part]) -> Option<Directive> {
    let (mut name, mut diameter_mm, mut radius, mut length_mm) = (None, None, None, None);
    for &part in parts {
        let twice = match part {
            Part::Ball | Part::Flat | Part::Bull => name.replace(part).is_some(),
            Part::Diameter(mm) => diameter_mm.replace(mm).is_some(),
            Part::Radius(mm) => radius.replace(mm).is_some(),
            Part::Length(mm) => length_mm.replace(mm).is_some(),
        };
        if twice {
            return None;
        }
    }
    if diameter_mm.is_some_and(|mm| mm <= 0.0) || (name.is_some() && diameter_mm.is_none()) {
        return None;
    }
    let half = diameter_mm.unwrap_or(0.0) / 2.0;
    let shape = match (name, radius) {
        (None, None) => None,
        (Some(Part::Ball), None) => Some(ToolShape::Ball),
        (Some(Part::Ball), Some(radius)) if (radius - half).abs() <= 1e-9 => Some(ToolShape::Ball),
        (Some(Part::Flat), None | Some(0.0)) => Some(ToolShape::Flat),
        (Some(Part::Bull), Some(radius)) if radius < half => Some(ToolShape::Bull(radius)),
        _ => return None,
    };
    if shape.is_none() && diameter_mm.is_none() && length_mm.is_none() {
        return None;
    }
    Some(Directive::Tool(Tool {
        number,
        shape,
        diameter_mm,
        length_mm,
        holder_mm: None,
    }))
}
