//! What the text of a program shows, and the control that it and the file name and machine point to.
use super::shape::{Lathe, Shape};
use super::text::{has_word, lines, strip_comments};
use super::votes::Votes;
use super::{Detected, Surroundings, brother, fadal, kernels, named, num, others, supported};

/// The weight of an extension that one control owns, compared with signs in the text.
const EXTENSION: u32 = 9;

/// The weight of the name of a control in a comment: more than that of a program number O, which many controls have.
const NAMED: u32 = 7;

/// What the text shows.
pub(super) struct Seen {
    votes: Votes,
    shape: Shape,
    /// What only an Okuma for turning, and only one for milling, has.
    okuma: (bool, bool),
}

/// Signs that distinguish a Haas from a Fanuc.
const HAAS: &[&str] = &["haas-ngc", supported::HAAS_HINT];

/// Controls that share their language; inside the first group brand and kind of machine decide.
const GROUPS: &[&[&str]] = &[
    &["fanuc-30i", "haas-ngc", "brother"],
    &["linuxcnc"],
    &["sinumerik-840d"],
    &["apt", "apt-source"],
    &["grbl"],
    &["heidenhain-klartext"],
    &["heidenhain-iso"],
    &["okuma-osp", "okuma-osp-lathe"],
    &["centroid"],
    &["eding"],
    &["fagor"],
    &["fadal"],
    &["acramatic"],
    &["num"],
    &["isg"],
    &["planetcnc"],
    &["fluidnc"],
    &["sender-macro"],
    &["sinumerik-iso"],
    &["wire-edm"],
    &["marlin"],
];

/// Names of controls as people write them in comments.
const IN_COMMENTS: &[(&str, &str)] = &[
    ("GRBL", "grbl"),
    ("LINUXCNC", "linuxcnc"),
    ("EMC2", "linuxcnc"),
    ("HAAS", "haas-ngc"),
    ("FANUC", "fanuc-30i"),
    ("PATHPILOT", "linuxcnc"),
    ("SINUMERIK", "sinumerik-840d"),
    ("SIEMENS", "sinumerik-840d"),
    ("840D", "sinumerik-840d"),
    ("HEIDENHAIN", "heidenhain-klartext"),
    ("OKUMA", "okuma-osp"),
    ("CENTROID", "centroid"),
    ("INTERCON", "centroid"),
    ("EDINGCNC", "eding"),
    ("FAGOR", "fagor"),
    ("SPEEDIO", "brother"),
    ("FADAL", "fadal"),
    ("ACRAMATIC", "acramatic"),
    ("MARLIN", "marlin"),
    ("ROBOFIL", "wire-edm"),
    ("SODICK", "wire-edm"),
];

/// The sign that a comment names a control.
fn in_comment(word: &str) -> String {
    format!("a comment with the name {word}")
}

/// Whether programs for one of two controls are read in nearly the same way by the other; which of them is meant, a text rarely shows.
pub(super) fn share_a_language(one: &str, other: &str) -> bool {
    // a lathe of a control is in the group of its mill
    let is_of = |member: &str, name: &str| {
        let brand = |text: &str| text.split('-').next().map(str::to_owned);
        member == name || (name.contains("-lathe") && brand(member) == brand(name))
    };
    let within = |group: &[&str], name: &str| group.iter().any(|member| is_of(member, name));
    one == other || GROUPS.iter().any(|group| within(group, one) && within(group, other))
}

impl Seen {
    /// Signs in an upper-case text.
    pub(super) fn of(text: &str) -> Self {
        let mut seen = Self {
            votes: Votes::default(),
            shape: Shape::default(),
            okuma: (false, false),
        };
        let votes = &mut seen.votes;
        for (at, line) in lines(text).map(str::trim).enumerate() {
            votes.line = at + 1;
            if line.is_empty() {
                continue;
            }
            supported::raw(line, votes);
            others::raw(line, votes);
            num::raw(line, votes);
            kernels::raw(line, votes);
            let stripped = strip_comments(line);
            let code = stripped.trim();
            if code.len() < line.len() {
                for (word, name) in IN_COMMENTS {
                    // a file of FreeCAD names its post: linuxcnc_post
                    let posted = || line.contains(&format!("{word}_POST"));
                    if (has_word(line, word) || posted()) && !has_word(code, word) {
                        votes.add(name, NAMED, &in_comment(word));
                    }
                }
            }
            // the name of a program may follow the percent sign
            let code = code.strip_prefix('%').map_or(code, str::trim);
            if code.is_empty()
                || line.starts_with("$$")
                || line.starts_with("%_N_")
                || line.starts_with('$')
                || line.starts_with("//")
            {
                continue;
            }
            let plain = code.strip_prefix('/').map_or(code, str::trim_start);
            supported::code(plain, votes);
            others::code(plain, votes);
            num::code(plain, votes);
            brother::code(plain, votes);
            fadal::code(plain, votes);
            seen.okuma.0 |= others::okuma_turns(plain);
            seen.okuma.1 |= others::okuma_mills(plain);
            seen.shape.look(plain, at + 1);
        }
        seen
    }

    /// The highest weight of the signs of one group.
    pub(super) fn most(&self) -> u32 {
        GROUPS
            .iter()
            .map(|group| self.votes.weight(group))
            .max()
            .unwrap_or_default()
    }

    /// The control whose signs weigh most, including name and machine; `None` where the text shows too little.
    pub(super) fn decide(&self, owner: Option<&'static str>, known: Surroundings<'_>) -> Option<Detected> {
        let lathe = self.shape.lathe(known.no_y).filter(|_| known.turns != Some(false));
        let shown = |group: &[&'static str]| {
            let fanuc = group.contains(&FANUC);
            let turned = fanuc && lathe.as_ref().is_some_and(|found| found.strong);
            let against = if fanuc {
                self.votes.weight(&[supported::NOT_FANUC])
            } else {
                0
            };
            (self.votes.weight(group) + if turned { 10 } else { 0 }).saturating_sub(against)
        };
        let (mut best, mut most, mut second) = (GROUPS[0], 0, 0);
        for group in GROUPS {
            let signs = shown(group);
            let named = owner.is_some_and(|name| group.contains(&name));
            let runs = signs > 0 && known.family.is_some_and(|family| group.contains(&family));
            let weight = signs + if named { EXTENSION } else { 0 } + if runs { 2 } else { 0 };
            if weight > most {
                (best, second, most) = (group, most, weight);
            } else {
                second = second.max(weight);
            }
        }
        let signs = shown(best);
        let family = known
            .family
            .filter(|family| *family != "iso-6983" && named(family, String::new(), true).is_some());
        let silent = owner.is_none() && family.is_none();
        if signs == 0 {
            // nothing but the shape of a lathe, in the manner of one control
            let found = lathe.filter(|found| silent && found.names_fanuc)?;
            return named("fanuc-30i-lathe-a", format!("content: {}", found.reason), false);
        }
        // a hint alone is not enough
        if signs < 4 {
            return None;
        }
        let agrees =
            owner.is_some_and(|name| best.contains(&name)) || family.is_some_and(|family| best.contains(&family));
        let certain = (signs >= 6 || agrees) && most >= second + 2;
        let (name, reason) = self.in_group(best, lathe.as_ref(), known)?;
        named(name, format!("content: {reason}"), certain)
    }

    /// Which Okuma an Okuma program is for. A lathe has signs of its own; one without them moves X and never Y, and has nothing that only a
    /// machining centre has. A name NAT1 is no sign beside what only a machining centre has.
    pub(super) fn okuma_name(&self, known: Surroundings<'_>) -> &'static str {
        let (turns, mills) = self.okuma;
        let habit = |sign: &str| (mills || self.shape.mill) && sign.starts_with(others::SEQUENCE_NAME);
        let voted = self
            .votes
            .strongest(&["okuma-osp-lathe"])
            .is_some_and(|vote| !habit(&vote.sign));
        let sign = turns || self.shape.turns() || voted;
        let flat = self.shape.is_flat() && !mills && !self.shape.mill && known.turns != Some(false);
        if sign || flat { "okuma-osp-lathe" } else { "okuma-osp" }
    }

    /// The control inside a group, and the sign that shows it.
    fn in_group(
        &self,
        group: &'static [&'static str],
        lathe: Option<&Lathe>,
        known: Surroundings<'_>,
    ) -> Option<(&'static str, String)> {
        let strongest = |of: &[&'static str]| self.votes.strongest(of).map(|vote| vote.sign.clone());
        match group[0] {
            FANUC if self.votes.weight(&["brother"]) >= 10 => Some(("brother", strongest(&["brother"])?)),
            FANUC => {
                // a comment that names the Fanuc outweighs one habit of a Haas, such as a program number of five digits
                let named = self.votes.weight_of(FANUC, &in_comment("FANUC"));
                let enough = named + if known.family == Some(FANUC) { 9 } else { 6 };
                let by_text = self.votes.weight(HAAS) >= enough;
                let haas = by_text || known.family.is_some_and(|family| family.starts_with("haas"));
                let brand = if by_text { strongest(HAAS) } else { strongest(group) };
                let (name, sign) = match (lathe, haas) {
                    (Some(found), true) => ("haas-lathe", Some(found.reason.clone())),
                    (Some(found), false) if found.system_b => ("fanuc-30i-lathe-b", Some(found.reason.clone())),
                    (Some(found), false) => ("fanuc-30i-lathe-a", Some(found.reason.clone())),
                    (None, true) => ("haas-ngc", brand.clone()),
                    (None, false) => (FANUC, strongest(&[FANUC]).or_else(|| brand.clone())),
                };
                let mut reason = sign?;
                if let (Some(_), true, Some(brand)) = (lathe, by_text, brand) {
                    reason = format!("{reason}, {brand}");
                }
                if lathe.is_none() && self.shape.lathe(known.no_y).is_some() {
                    reason.push_str("; no dialect of lathes, because the machine does not turn the part");
                }
                Some((name, reason))
            }
            // definitions and motions along surfaces: the text that an APT processor reads, not what it writes
            "apt" if self.votes.weight(&["apt-source"]) >= 30 => Some(("apt-source", strongest(&["apt-source"])?)),
            "okuma-osp" => Some((self.okuma_name(known), strongest(group)?)),
            name => Some((name, strongest(group)?)),
        }
    }
}

/// The control of the group that shares the most.
const FANUC: &str = "fanuc-30i";
