//! The time of one motion.
use crate::Limit;
use trunnion_interp::ChainId;
use trunnion_syntax::BlockId;

/// How long a motion takes, and what holds it back. s, mm/min.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timed {
    /// Its block.
    pub block: BlockId,
    /// How the block came to run.
    pub chain: ChainId,
    /// Number of the motion in the run, from 0.
    pub motion: u32,
    /// Optimistic and planned time, s; `None`: unknown.
    pub seconds: [Option<f64>; 2],
    /// A motion from a position that is not known: it counts as nothing.
    pub from_nowhere: bool,
    /// Length of its path, mm; deg where `turns_only`.
    pub length: f64,
    /// Only rotary axes turn: feeds are deg/min.
    pub turns_only: bool,
    /// F, mm/min; `None` in rapid and where there is none.
    pub feed: Option<f64>,
    /// Highest planned feed, mm/min.
    pub reached: Option<f64>,
    /// Lowest planned feed, at an end of a piece, mm/min.
    pub lowest: Option<f64>,
    /// Planned feed at the end, mm/min.
    pub leaves: Option<f64>,
    /// What holds it back.
    pub limit: Limit,
    /// Planned time below 80 % of F, s.
    pub below: f64,
    /// Planned time below 5 % of F.
    pub crawl: Crawl,
    /// The speed that the control's time for a block allows, where it is below F, mm/min.
    pub block_time_feed: Option<f64>,
    /// The speed that bends allow, where it is below F, mm/min, and the joint.
    pub bend_feed: Option<(f64, u8)>,
    /// A feed motion with the spindle on.
    pub engaged: bool,
}

/// Stretches of a motion in which it is very slow, s.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Crawl {
    /// From its start on; the whole motion where it is never faster.
    pub enters: f64,
    /// The longest one that neither begins nor ends it.
    pub inside: f64,
    /// Up to its end, where it is faster before.
    pub leaves: f64,
    /// It is faster somewhere.
    pub faster: bool,
}

impl Crawl {
    /// A piece in which it is slow all the time.
    pub(crate) fn goes_on(&mut self, seconds: f64) {
        *(if self.faster {
            &mut self.leaves
        } else {
            &mut self.enters
        }) += seconds;
    }

    /// A piece in which it is slow at both ends.
    pub(crate) fn breaks(&mut self, [start, end]: [f64; 2]) {
        self.goes_on(start);
        if self.faster {
            self.inside = self.inside.max(self.leaves);
        }
        (self.faster, self.leaves) = (true, end);
    }
}

impl Timed {
    /// What is left of F, 0..=1; `None` where there is no F.
    pub fn share(&self) -> Option<f64> {
        let feed = self.feed.filter(|feed| *feed > 0.0)?;
        Some((self.length / (self.seconds[1]? * feed / 60.0)).min(1.0))
    }

    /// One word for tables, with the letter of the axis.
    pub fn limited_by(&self, machine: &trunnion_machine::Machine) -> String {
        let letter = |joint: u8| {
            machine
                .axes
                .get(usize::from(joint))
                .map_or('?', |axis| char::from(axis.letter))
        };
        match self.limit {
            Limit::Feed => "feed".to_owned(),
            Limit::Speed(joint) => format!("speed {}", letter(joint)),
            Limit::Bend(joint) => format!("bend {}", letter(joint)),
            Limit::Acceleration(joint) => format!("acceleration {}", letter(joint)),
            Limit::Jerk => "jerk".to_owned(),
            Limit::Corner => "corner".to_owned(),
            Limit::Stop => "stop".to_owned(),
            Limit::BlockTime => "block-time".to_owned(),
            Limit::LookAhead => "look-ahead".to_owned(),
            Limit::Wait => "wait".to_owned(),
        }
    }
}
