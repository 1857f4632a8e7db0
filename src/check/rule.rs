//! What a rule is: data, and functions that read what wakes them.
use crate::Severity;
use crate::event::AtPole;
use crate::wake::Wake;
use trunnion_machine::Machine;

/// What a machine file would have to declare before a rule judges anything on this machine; `None`: it does.
pub(crate) type Needs = fn(&Machine) -> Option<&'static str>;

/// What silence means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guarantee {
    /// Silence is a proof in the stated model; where the rule cannot decide it says unknown.
    Sound,
    /// Silence proves nothing.
    Heuristic,
}

/// What a rule file says about itself; name and documentation come from the file.
#[derive(Clone, Copy)]
pub(crate) struct Body {
    severity: Severity,
    guarantee: Guarantee,
    wakes: &'static [Wake],
    at_pole: Option<AtPole>,
    follows: Option<&'static str>,
    needs: Option<Needs>,
}

impl Body {
    /// A rule whose silence is a proof in the stated model. `severity`: unless a finding says otherwise.
    pub(crate) const fn sound(severity: Severity, wakes: &'static [Wake]) -> Self {
        Self {
            severity,
            guarantee: Guarantee::Sound,
            wakes,
            at_pole: None,
            follows: None,
            needs: None,
        }
    }

    /// A rule whose silence proves nothing.
    pub(crate) const fn heuristic(severity: Severity, wakes: &'static [Wake]) -> Self {
        Self {
            severity,
            guarantee: Guarantee::Heuristic,
            wakes,
            at_pole: None,
            follows: None,
            needs: None,
        }
    }

    /// Its findings say what happens at a pole: see [`AtPole::Cause`].
    pub(crate) const fn causes_pole_event(mut self, rank: u8) -> Self {
        self.at_pole = Some(AtPole::Cause(rank));
        self
    }

    /// Its findings say that something is near a pole: see [`AtPole::Nearness`].
    pub(crate) const fn nears_pole_event(mut self) -> Self {
        self.at_pole = Some(AtPole::Nearness);
        self
    }

    /// Its findings follow from what happens at a pole, where something does.
    pub(crate) const fn follows_pole_event(mut self) -> Self {
        self.at_pole = Some(AtPole::Effect);
        self
    }

    /// Its findings are part of those of another rule that name the same axis in the same blocks.
    pub(crate) const fn follows(mut self, rule: &'static str) -> Self {
        self.follows = Some(rule);
        self
    }

    /// It is silent on machines that do not declare something; the coverage of a check says so.
    pub(crate) const fn needs(mut self, needs: Needs) -> Self {
        self.needs = Some(needs);
        self
    }

    /// With its name and the header of its file.
    pub(crate) const fn named(self, name: &'static str, docs: &'static str) -> Rule {
        Rule {
            name,
            docs,
            severity: self.severity,
            guarantee: self.guarantee,
            wakes: self.wakes,
            at_pole: self.at_pole,
            follows: self.follows,
            needs: self.needs,
        }
    }
}

/// One rule. Its name is its file's name with dashes, its documentation its file's header.
#[derive(Clone, Copy)]
pub struct Rule {
    /// `pole-flip`.
    pub name: &'static str,
    /// The header of its file, Markdown, without the comment marks.
    pub docs: &'static str,
    /// Severity unless the message says otherwise.
    pub severity: Severity,
    /// What silence means.
    pub guarantee: Guarantee,
    pub(crate) wakes: &'static [Wake],
    pub(crate) at_pole: Option<AtPole>,
    pub(crate) follows: Option<&'static str>,
    pub(crate) needs: Option<Needs>,
}

impl Rule {
    /// The first sentence of the documentation: the rule in one line.
    pub fn summary(&self) -> &'static str {
        self.docs.lines().next().unwrap_or_default()
    }

    /// What it reads, in one word for lists: `text`, `program`, `motion`, `machine`.
    pub fn level(&self) -> &'static str {
        self.wakes.first().map_or("", |wake| wake.level())
    }

    /// Whether it finds something missing at the end: what another run has is not missing.
    pub(crate) fn finds_absences(&self) -> bool {
        self.wakes.iter().any(|wake| matches!(wake, Wake::End(_)))
    }
}
