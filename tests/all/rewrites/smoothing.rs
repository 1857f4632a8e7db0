//! Rewrites on the published guide-vane rows, on hard cases, and on random chains.

use super::strategy_2::{
    ROWS, VECTORS, apt, axis, ball, certified, largest_c_step, refused, settings, sinumerik, smooth, tool, turned,
    words,
};
use trunnion::check::{Settings, Status, ValueKey, check};
use trunnion::interp::{Setup, ToolShape};
use trunnion::syntax::parse;

pub(super) fn near(value: f64, wanted: f64, within: f64) -> bool {
    (value - wanted).abs() <= within
}

/// Diagnostics of a rule as (block, values).
fn found(text: &str, settings: &Settings<'_>, rule: &str) -> Vec<Vec<(&'static str, ValueKey)>> {
    let report = check(&parse(text.as_bytes().to_vec(), settings.dialect.lex), settings);
    let fails = report
        .findings()
        .filter(|found| found.rule == rule && found.status == Status::Fail)
        .cloned()
        .collect::<Vec<_>>();
    fails.into_iter().map(|found| found.values).collect()
}

#[test]
fn tool_vectors_of_strategy_2_give_the_published_steps() {
    let settings = settings("apt", ball());
    for (tolerance, step) in [(0.02, 39.4), (0.05, 14.3), (0.06, 5.6), (0.08, 1.15)] {
        let (after, certificate) = certified(smooth(&apt(VECTORS), &settings, tolerance));
        let c = &certificate.rotary[0];
        assert_eq!(c.axis, "C");
        assert!(near(c.step_before_deg, 55.7, 0.05), "before {}", c.step_before_deg);
        assert!(
            near(c.step_after_deg, step, 0.06),
            "at {tolerance}: {}",
            c.step_after_deg
        );
        assert!(certificate.worst.axis_change_deg.value <= tolerance);
        assert!(
            certificate.worst.point_shift_mm.value <= 2e-5,
            "{}",
            certificate.worst.point_shift_mm.value
        );
        assert!(certificate.text.rest_identical);
        let kept = |text: &str, line: usize| text.lines().nth(line).map(str::to_owned);
        for line in [0, 1, 2, 3, 4, 8, 9] {
            assert_eq!(kept(&after, line), kept(&apt(VECTORS), line), "line {}", line + 1);
        }
    }
}

#[test]
fn machine_words_of_strategy_2_give_what_their_rounded_a_allows() {
    // The file says A0.081 where the tool vector is 0.0772 deg from the pole, so the same tolerance allows a smaller turn of C than
    // in the row above: 52.595 - 2 asin(sin(tol/2) / sin 0.081) + 3.086 + ... is the least step that any choice of C can reach.
    let settings = settings("sinumerik-840d", ball());
    for (tolerance, step) in [(0.02, 40.047), (0.05, 16.099), (0.06, 7.851), (0.08, 1.146)] {
        let (after, certificate) = certified(smooth(&sinumerik(ROWS), &settings, tolerance));
        let (before, after) = (words(ROWS), words(&after));
        assert!(near(largest_c_step(&before), 55.681, 1e-9));
        assert!(
            near(largest_c_step(&after), step, 0.002),
            "at {tolerance}: {}",
            largest_c_step(&after)
        );
        assert!(near(certificate.rotary[0].step_after_deg, largest_c_step(&after), 1e-9));
        assert_eq!((before[0], before[4]), (after[0], after[4]), "the ends stay");
        for (was, is) in before.iter().zip(&after) {
            assert_eq!(was[3], is[3], "A stays");
            let (u, v) = (axis(was[3], was[4]), axis(is[3], is[4]));
            assert!(turned(was, is) <= tolerance, "tool axis turns too far");
            for i in 0..3 {
                assert!(near(is[i], was[i] + 5.0 * (u[i] - v[i]), 6e-6), "P' = P + r (u - u')");
            }
        }
    }
}

#[test]
fn at_0_08_deg_the_flip_is_gone_and_the_feed_is_back() {
    let settings = settings("sinumerik-840d", ball());
    let before = sinumerik(ROWS);
    let (after, certificate) = certified(smooth(&before, &settings, 0.08));
    assert!(!found(&before, &settings, "pole-flip").is_empty());
    assert!(found(&after, &settings, "pole-flip").is_empty());
    // C reaches 1924 mm/min; what stays below that is A, which the rewrite does not touch
    let limited = |text: &str, axis: &str| {
        let all = found(text, &settings, "axis-overspeed").into_iter();
        let of_axis = all.filter(|values| values.contains(&("limiting_axis", ValueKey::Text(axis.to_owned()))));
        let number =
            |values: Vec<(&'static str, ValueKey)>| values.into_iter().find(|(key, _)| *key == "feed_limit_mm_min");
        let feeds = of_axis
            .filter_map(number)
            .map(|(_, value)| if let ValueKey::Number(feed) = value { feed } else { 0.0 });
        feeds.fold(f64::INFINITY, f64::min)
    };
    assert!(near(limited(&before, "C"), 33.0, 1.0));
    assert!(limited(&after, "C") >= 1900.0);
    assert!(near(limited(&after, "A"), 1571.0, 1.0));
    assert_eq!(certificate.text.words_inserted, 0);
    assert_eq!(
        certificate.motions.changed, 4,
        "three rows, and the way to the fixed end"
    );
    // only numbers of X, Y and C of the three inner rows differ
    for (index, (was, is)) in before.lines().zip(after.lines()).enumerate() {
        let differ: String = was
            .split(' ')
            .zip(is.split(' '))
            .filter(|(a, b)| a != b)
            .map(|(a, _)| &a[..1])
            .collect();
        let inner = (5..=7).contains(&index);
        assert!(
            if inner {
                ["XYC", "YC", "XC", "C"].contains(&differ.as_str())
            } else {
                differ.is_empty()
            },
            "line {index}: {differ}"
        );
        assert_eq!(was.len() - was.trim_end().len(), is.len() - is.trim_end().len());
    }
}

#[test]
fn a_tool_that_is_not_a_declared_ball_is_refused() {
    let text = sinumerik(ROWS);
    let reason = refused(smooth(&text, &settings("sinumerik-840d", Setup::default()), 0.08));
    assert!(
        reason.contains("shape is not declared") && reason.contains("--tool ball:10"),
        "{reason}"
    );
    let reason = refused(smooth(&text, &settings("sinumerik-840d", tool(ToolShape::Flat)), 0.08));
    assert!(reason.contains("not a ball"), "{reason}");
    let declared = format!("; trunnion: tool 1 ball diameter 10\nT1 D1\nM6\n{text}");
    certified(smooth(&declared, &settings("sinumerik-840d", Setup::default()), 0.08));
}

#[test]
fn what_cannot_be_proven_is_refused_with_its_reason() {
    let settings = settings("sinumerik-840d", ball());
    let rows = |text: String| refused(smooth(&sinumerik(&text), &settings, 0.08));
    let off = refused(smooth(&sinumerik(ROWS).replace("TRAORI\n", ""), &settings, 0.08));
    assert!(off.contains("tool centre point control is off"), "{off}");
    let reason = rows(ROWS.replace("C52.595", "C=52.5+0.095"));
    assert!(
        reason.contains("unknown") || reason.contains("not a plain number"),
        "{reason}"
    );
    let reason = rows(format!(
        "{}G91\nN2930 G1 X-0.00235 Y0.30476 Z0.02959 A-0.966 C47.773\nG90\n{}",
        head(2),
        tail(3)
    ));
    assert!(reason.contains("incremental"), "{reason}");
    let reason = refused(smooth(&sinumerik(ROWS), &settings, 0.0005));
    assert!(reason.contains("--tolerance-deg"), "{reason}");
    let coarse = sinumerik(ROWS)
        .replace("-28.38", "-28.4")
        .replace("Y-1.84041", "Y-1.8")
        .replace("Y-1.53565", "Y-1.5");
    let coarse: String = coarse.lines().map(|line| shorten(line) + "\n").collect();
    // where the program has too few digits, those are written that every control has
    let (_, certificate) = certified(smooth(&coarse, &settings, 0.08));
    assert!(certificate.worst.point_shift_mm.value < 0.001);
    let options = trunnion::rewrite::Options {
        tolerance_deg: 0.08,
        tolerance_mm: 1e-6,
        ..Default::default()
    };
    let reason = refused(super::strategy_2::run(
        "smooth-pole",
        &sinumerik(ROWS),
        &settings,
        &options,
    ));
    assert!(reason.contains("--tolerance-mm"), "{reason}");
}

/// One digit after the point for X, Y and Z.
fn shorten(line: &str) -> String {
    let short = |word: &str| match word.parse_number() {
        Some(value) => format!("{}{value:.1}", &word[..1]),
        None => word.to_owned(),
    };
    line.split(' ').map(short).collect::<Vec<_>>().join(" ")
}

trait Coordinate {
    fn parse_number(&self) -> Option<f64>;
}

impl Coordinate for str {
    fn parse_number(&self) -> Option<f64> {
        self.strip_prefix(['X', 'Y', 'Z'])?.parse().ok()
    }
}

fn head(count: usize) -> String {
    ROWS.split_inclusive('\n').take(count).collect()
}

fn tail(skip: usize) -> String {
    ROWS.split_inclusive('\n').skip(skip).collect()
}

#[test]
fn nothing_is_done_where_no_flip_is_reported() {
    let calm = "N1 G1 X0 Y0 Z50 A5 C10\nN2 G1 X1 Y0 Z50 A5.5 C11\n";
    assert!(matches!(
        smooth(&sinumerik(calm), &settings("sinumerik-840d", ball()), 0.08).outcome(),
        Ok(None)
    ));
}

#[test]
fn an_approach_and_a_retract_do_not_become_part_of_the_window() {
    let settings = settings("sinumerik-840d", ball());
    let alone = words(&certified(smooth(&sinumerik(ROWS), &settings, 0.08)).0);
    let framed =
        format!("G0 X-28.38197 Y-2.14469 Z79.86773 A2.042 C3.358\nG1 Z62.86773 F500\n{ROWS}G1 Z80 F5000\nG0 Z100\n");
    let after = certified(smooth(&sinumerik(&framed), &settings, 0.08)).0;
    let framed: String = after
        .split_inclusive('\n')
        .filter(|line| line.starts_with("N29"))
        .collect();
    assert_eq!(words(&framed), alone);
}

#[test]
fn words_left_out_are_written_where_they_are_needed() {
    let settings = settings("sinumerik-840d", ball());
    let rows =
        "N1 G1 X-28 Y-2.1 Z60.5 A2.1 C3\nN2 Y-1.8 A1.05 C5\nN3 Y-1.5 A0.08 C50\nN4 Y-1.25 A-0.8 C-3.1\nN5 Y-1 A-2.1\n";
    // X and Z are written once, with one digit more elsewhere so that there is something to round to
    let rows = format!("G1 X-28.00000 Y-3.00000 Z60.50000 A2.1 C3.000\n{rows}");
    let (after, certificate) = certified(smooth(&sinumerik(&rows), &settings, 0.08));
    let row = |number: &str| {
        after
            .lines()
            .find(|line| line.starts_with(number))
            .expect("the row")
            .to_owned()
    };
    assert!(row("N2 ").starts_with("N2 X-27.99"), "{}", row("N2 "));
    assert_eq!(row("N5 "), "N5 X-28.00000 Y-1 A-2.1 C-3.100");
    assert!(certificate.text.words_inserted >= 3, "{:?}", certificate.text);
    assert!(certificate.worst.point_shift_mm.value < 1e-4);
}

#[test]
fn inches_are_kept() {
    let inch: String = ROWS
        .lines()
        .map(|line| {
            let word = |word: &str| match word.parse_number() {
                Some(value) => format!("{}{:.6}", &word[..1], value / 25.4),
                None => word.to_owned(),
            };
            line.split(' ').map(word).collect::<Vec<_>>().join(" ") + "\n"
        })
        .collect();
    let settings = settings("sinumerik-840d", ball());
    let (_, certificate) = certified(smooth(&sinumerik(&format!("G70\n{inch}")), &settings, 0.08));
    assert!(
        certificate.worst.point_shift_mm.value < 3e-5,
        "{}",
        certificate.worst.point_shift_mm.value
    );
    assert!(near(certificate.rotary[0].step_after_deg, 1.146, 0.01));
}

#[test]
fn other_chains_and_work_offsets_keep_the_contact_too() {
    let rows = ROWS.replace(" A", " B");
    let on_ferrari = Settings {
        machine: trunnion::machine::builtin("ferrari-bc"),
        ..settings("sinumerik-840d", ball())
    };
    let (_, certificate) = certified(smooth(&sinumerik(&rows), &on_ferrari, 0.08));
    assert!(
        near(certificate.rotary[0].step_after_deg, 1.146, 0.001),
        "{:?}",
        certificate.rotary
    );
    assert!(certificate.worst.point_shift_mm.value < 1e-5);

    let with_offset = |turn: f64| {
        let mut setup = ball();
        let values = [10.0, 20.0, 30.0, 0.0, 0.0, turn, 0.0, 0.0, 0.0];
        setup.work_offsets.push(trunnion::interp::WorkOffset {
            name: "G54".into(),
            values,
        });
        let text = sinumerik(&format!("G54\n{ROWS}"));
        smooth(&text, &settings("sinumerik-840d", setup), 0.08)
    };
    // what an offset in C does to X Y Z of the tip depends on the control
    let reason = refused(with_offset(33.0));
    assert!(reason.contains("the work offset turns C"), "{reason}");
    let (after, certificate) = certified(with_offset(0.0));
    assert!(certificate.worst.point_shift_mm.value < 1e-5);
    let plain = certified(smooth(&sinumerik(ROWS), &settings("sinumerik-840d", ball()), 0.08)).0;
    let c = |text: &str| words(text).iter().map(|row| row[4]).collect::<Vec<_>>();
    assert_eq!(c(&after), c(&plain), "the offset shifts joints, not words");
}

#[test]
fn each_window_is_smoothed_and_lines_keep_their_ends() {
    let settings = settings("sinumerik-840d", ball());
    let away = "N3000 G1 X-28 Y0 Z60 A-12.5 C0\nN3010 G1 X-28 Y1 Z60 A2.5 C1\n";
    let text = sinumerik(&format!("{ROWS}{away}{}", ROWS.replace("N29", "N39"))).replace('\n', "\r\n");
    let (after, certificate) = certified(smooth(&text, &settings, 0.08));
    assert!(certificate.rotary[0].step_after_deg < 10.0);
    assert_eq!(after.matches("\r\n").count(), text.matches("\r\n").count());
    let inner = |number: &str| {
        words(&after).len() == 12 && after.contains(number) && !after.contains(&format!("{number} G1 X-28.38709"))
    };
    assert!(inner("N2930") && inner("N3930"), "{after}");
}

#[test]
fn the_samples_are_smoothed_between_their_first_and_last_row() {
    for (file, dialect) in [("strategy-2.mpf", "sinumerik-840d"), ("strategy-2.apt", "apt")] {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("samples/programs/guide-vane")
            .join(file);
        let before = std::fs::read_to_string(path).expect("the sample is there");
        let (after, certificate) = certified(smooth(&before, &settings(dialect, Setup::default()), 0.08));
        assert!(
            near(certificate.rotary[0].step_after_deg, 1.15, 0.005),
            "{file}: {:?}",
            certificate.rotary
        );
        let changed = before.lines().zip(after.lines()).filter(|(was, is)| was != is).count();
        assert_eq!(changed, 3, "{file}");
        assert_eq!(certificate.motions.changed, 4, "{file}");
    }
}
