//! RAPID and FEDRAT.
use crate::FaultKind;
use crate::FeedMode;
use crate::apt::{Apt, Args, is};
use crate::core::Report;
use trunnion_syntax::TextRange;

impl Apt<'_> {
    /// RAPID: the next motion. Words as OFF or MODAL are those of one post-processor, and no source says what they do.
    pub(super) fn rapid_record(&mut self, args: &Args, report: &mut Report<'_>) {
        if args.odd || !args.words().is_empty() || !args.numbers().is_empty() {
            let what = format!(
                "{}: which motions are rapids from here on",
                report.program.text(report.whole())
            );
            report.fault(report.whole(), FaultKind::NotModelled { what });
            self.kept.rapid_unread = true;
            return;
        }
        self.rapid(report);
    }

    fn rapid(&mut self, report: &mut Report<'_>) {
        if self.kept.circle.take().is_some() {
            report.fault(
                TextRange::default(),
                FaultKind::NotModelled {
                    what: "CIRCLE followed by RAPID".to_owned(),
                },
            );
        }
        self.kept.rapid = true;
    }

    /// FEDRAT/v, FEDRAT/v,MMPM, FEDRAT/MMPM,v; without a unit length units per minute.
    pub(super) fn fedrat(&mut self, args: &Args, report: &mut Report<'_>) {
        let program = report.program;
        if args.has(program, "RAPID") {
            return self.rapid(report);
        }
        let units = [
            ("MMPM", FeedMode::PerMinute, Some(1.0)),
            ("IPM", FeedMode::PerMinute, Some(25.4)),
            ("PERMIN", FeedMode::PerMinute, None),
            ("MMPR", FeedMode::PerRevolution, Some(1.0)),
            ("IPR", FeedMode::PerRevolution, Some(25.4)),
            ("PERREV", FeedMode::PerRevolution, None),
            ("INVERS", FeedMode::InverseTime, Some(1.0)),
        ];
        let length = self.core.state.feed.unit_mm();
        let unit = match args.words() {
            [] => {
                if let Some(&value) = args.numbers().first().filter(|_| !args.odd) {
                    return self.feed_without_unit(value, report);
                }
                None
            }
            words => units
                .iter()
                .find(|(name, ..)| words.iter().any(|&word| is(program, word, name)))
                .map(|&(_, mode, unit)| (mode, unit.unwrap_or(length))),
        };
        match (unit, args.numbers().first()) {
            (Some((mode, unit)), Some(value)) if !args.odd => {
                self.kept.feed_unit = Some((mode, unit));
                self.core.state.feed.switch_mode(mode);
                self.core.state.feed.set(Some(value * unit));
                self.core.feed_unread = false;
            }
            _ => {
                let what = program.text(report.whole()).into_owned();
                self.feed_not_read(what, report);
            }
        }
    }

    /// A feed without its unit: length units per minute, unless a FEDRAT before has named another. Whether that one holds is in no source that was
    /// found.
    pub(crate) fn feed_without_unit(&mut self, value: f64, report: &mut Report<'_>) {
        let unit = self.core.state.feed.unit_mm();
        let plain = (FeedMode::PerMinute, unit);
        if self.kept.feed_unit.is_some_and(|before| before != plain) {
            let what = "a feed without its unit after a FEDRAT with another unit: write the unit".to_owned();
            return self.feed_not_read(what, report);
        }
        self.core.state.feed.switch_mode(FeedMode::PerMinute);
        self.core.state.feed.set(Some(value * unit));
        self.core.feed_unread = false;
    }

    fn feed_not_read(&mut self, what: String, report: &mut Report<'_>) {
        report.fault(TextRange::default(), FaultKind::NotModelled { what });
        self.core.state.feed.set(None);
        self.core.feed_unread = true;
    }
}
