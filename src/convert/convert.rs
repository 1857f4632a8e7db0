//! One conversion: read, plan, write, read back, prove.
use crate::emit::{parts, parts_without};
use crate::emit_code::Written;
use crate::events::{job, refusal};
use crate::job::Job;
use crate::plan::{Out, Planner};
use crate::setting::Setting;
use crate::swaps::{control_swaps, swaps_are_allowed};
use crate::travel::{Beyond, Travel, travel, zeros_declared};
use crate::{Options, Post, Refused, Target};
use std::cell::OnceCell;
use trunnion_certify::Outcome;
use trunnion_certify::conversion::{
    Ask, Assume, ConversionClaim, ConversionProof, Own, Reading, Run, Terms, Told, Why, converted_on,
    holds_with_zeros_apart, left_behind, read,
};
use trunnion_dialect::Dialect;
use trunnion_interp::{AllClampCodes, Fault, FaultKind, Lacks, LengthOf};
use trunnion_machine::Machine;
use trunnion_syntax::{BlockId, Format, LineIndex, Program};

/// A program that is to be converted, with all it is read with.
pub type Source<'a> = Run<'a>;

/// A converted program, proved.
#[derive(Clone, Debug)]
pub struct Converted {
    /// The text.
    pub text: String,
    /// Its dialect.
    pub dialect: &'static Dialect,
    /// What was proved.
    pub claim: ConversionClaim,
    /// With which numbers.
    pub proof: ConversionProof,
    /// What has no counterpart and moves nothing (path modes, marks), with the line of its first use.
    pub left_out: Vec<(String, u32)>,
    /// A zero point that the target cannot name (a preset, G15 H1), and the work offset that stands for it.
    pub renamed_offset: Option<(String, String)>,
    /// Lines of cuts whose feed per revolution became a feed per minute at the speed that is programmed.
    pub feeds_per_minute: Vec<u32>,
    /// The first line with G41 or G42: the radius of the tool, as declared, is in the path that is written.
    pub radius_in_path: Option<u32>,
    /// Tools whose length the original compensates, where the target compensates none: the operator sets the zero of Z with each.
    pub set_by_hand: Vec<u32>,
    /// Lines of cuts in which the table turns to the other posture or winds back (only with `allow_swap`).
    pub swaps: Vec<u32>,
    /// Axes that leave their travel, each limit once, from an undeclared zero point. Where it is declared, such a program is refused.
    pub beyond: Vec<Beyond>,
    /// Lines of motions between whose ends the travel could not be decided.
    pub travel_undecided: Vec<u32>,
    /// Axes with a clamp whose codes are not written: the machine names none, or the control has no word. A remark in the text says so too.
    pub clamps: Vec<char>,
    /// What a certificate of it needs: with this the proof can be made again without the converter.
    pub told: Told,
}

/// So often coordinates that rounding takes beyond a limit are moved inside.
const MOST_TRIES: u32 = 4;

/// Converts a program and proves it.
///
/// # Errors
/// Why not, with the place in the program.
pub fn convert(source: &Source<'_>, target: &Target<'_>, options: &Options) -> Result<Converted, Refused> {
    let text = prepared(source, options);
    let machine = source.machine.filter(|_| source.dialect.lex.format != Format::Apt);
    if source.assume != Assume::default() && source.dialect.quirks.rs274() {
        return Err(Refused::new(
            "the state at the start of an excerpt cannot be given for a LinuxCNC program: write it into the program",
        ));
    }
    let run = Run {
        text: &text,
        machine,
        ..*source
    };
    let reading = read(&run);
    understood(&reading, options).and_then(|()| held(&reading, source.setup))?;
    let setting = Setting::new(target, options)?;
    // clamps are closed and opened again for the target machine
    let rewritten =
        Some(&source.setup.control.clamp_codes).filter(|_| setting.clamp_codes() != AllClampCodes::default());
    let job = job(&reading, source.dialect, options, rewritten, setting.post)
        .and_then(|job| drops_something(&reading, without_unused(&reading, job), options))?;
    let (tolerance_mm, axis_deg) = setting.tolerances(machine, options)?;
    let work_offset = options.work_offset(setting.post);
    let planner = Planner {
        reading: &reading,
        source: machine,
        mode: setting.mode,
        dialect: setting.dialect,
        inverse_time: setting.has("feed-inverse-time"),
        per_revolution: setting.has("feed-per-revolution"),
        compensates: setting.compensates(),
        apt: setting.post.is_none(),
        setup: source.setup,
        options,
        work_offset,
        tolerance_mm,
        axis_deg,
        known: OnceCell::new(),
        kept: OnceCell::new(),
    };
    setting.head_lengths(&reading, &job)?;
    let (mut outs, swaps) = planner.plan(&job)?;
    let stays = left_behind(&reading, &run);
    let claim = setting.claim(options, tolerance_mm, axis_deg);
    let (written, (proof, turned, travel, told)) =
        written((&reading, &run), &setting, (&job, &mut outs, &stays), options, &claim)?;
    swaps_are_allowed(&turned, &reading, &setting, options)?;
    let swaps = if turned.is_empty() { swaps } else { turned };
    let lines = LineIndex::new(reading.program.source());
    let line = |block| line_of(&reading, &lines, block);
    let declared = zeros_declared(&job, source.setup, work_offset);
    let (beyond, travel_undecided) = travel.judge(&reading, setting.machine, declared, line)?;
    Ok(Converted {
        text: written,
        dialect: setting.dialect,
        claim,
        proof,
        left_out: (job.left_out.iter().map(|(what, block)| (what.clone(), line(*block)))).collect(),
        set_by_hand: set_by_hand(&reading, &job, setting.post),
        renamed_offset: job.renamed_offset,
        feeds_per_minute: crate::feeds::per_minute(&reading, &outs, line),
        radius_in_path: crate::feeds::compensated(&reading, source.dialect).map(line),
        swaps: swaps
            .iter()
            .map(|&index| line(reading.motions[index].motion.block))
            .collect(),
        beyond,
        travel_undecided,
        clamps: setting.clamps_left(),
        told,
    })
}

fn line_of(reading: &Reading, lines: &LineIndex, block: BlockId) -> u32 {
    let start = reading.program.block(block).range().start;
    lines.line_column(reading.program.source(), start).0
}

/// See [`Converted::set_by_hand`].
fn set_by_hand(reading: &Reading, job: &Job, post: Option<&Post>) -> Vec<u32> {
    let compensates = reading.motions.iter().any(|posed| posed.length_of != LengthOf::Nothing);
    let none = |post: &Post| {
        let dialect = trunnion_dialect::builtin(&post.dialect);
        // elsewhere the call of the tool brings its length
        let brings = |dialect: &Dialect| dialect.quirks.edge_at_tool_change || !dialect.lex.format.has_words();
        post.template("length-on") == Some("") && !dialect.is_some_and(brings)
    };
    if !compensates || !post.is_some_and(none) {
        return Vec::new();
    }
    job.tools
        .iter()
        .map(|(number, _)| *number)
        .filter(|&number| number > 0)
        .collect()
}

/// The text; where INSERT is to be a remark, every such record becomes one of the same length.
fn prepared(source: &Source<'_>, options: &Options) -> Vec<u8> {
    let mut text = source.text.to_vec();
    if !options.insert_is_remark || source.dialect.lex.format != Format::Apt {
        return text;
    }
    let program = trunnion_syntax::parse(text.clone(), source.dialect.lex);
    for block in program.blocks() {
        if let Some(record) = block.record().filter(|record| record.is("INSERT")) {
            text[record.major.as_usize()].copy_from_slice(b"REMARK");
        }
    }
    text
}

/// Refuses a program whose effect is unknown.
fn understood(reading: &Reading, options: &Options) -> Result<(), Refused> {
    let program = &reading.program;
    // the worst first: what happens to a tap, not only that its cycle is not modelled
    for asked in &reading.asks {
        if let Ask::Own(Own {
            name,
            text,
            why: why @ Why::Synchronised,
        }) = &asked.ask
        {
            return Err(Refused::range(program, asked.range, refusal(name, text, *why)));
        }
    }
    if let Some(error) = program.errors().first() {
        let message = "this text is not understood; `trunnion check` explains it";
        return Err(Refused::range(program, error.range, message));
    }
    let dropped = |fault: &&Fault| {
        let text = program.text(fault.range);
        options.drop.iter().any(|drop| drop.eq_ignore_ascii_case(&text))
    };
    let feed_only = |fault: &&Fault| matches!(fault.kind, FaultKind::MissingFeed { .. });
    let mut faults: Vec<&Fault> = reading.faults.iter().filter(|fault| !dropped(fault)).collect();
    // a missing feed is reported where the cut is planned
    faults.retain(|fault| !feed_only(fault));
    let Some(fault) = faults.first() else { return Ok(()) };
    Err(Refused::range(program, fault.range, wording(program, fault)))
}

/// Words that nothing reads are left out.
fn without_unused(reading: &Reading, mut job: Job) -> Job {
    for fault in &reading.unused {
        job.leave_out(&reading.program.text(fault.range), fault.block);
    }
    job
}

/// Refuses a `--drop` that leaves out nothing: the user would think that the code is gone.
fn drops_something(reading: &Reading, job: Job, options: &Options) -> Result<Job, Refused> {
    let unused = options.drop.iter().find(|name| {
        let left_out = job.left_out.iter().any(|(what, _)| what.eq_ignore_ascii_case(name));
        let fault = |fault: &Fault| reading.program.text(fault.range).eq_ignore_ascii_case(name);
        !left_out && !reading.faults.iter().any(fault)
    });
    let Some(name) = unused else { return Ok(job) };
    Err(Refused::new(format!(
        "`--drop {name}` leaves out nothing: the program does not contain {name}, or it is a code that the conversion itself writes (spindle, \
         coolant, tool, stop, feed, coordinates), and the program would not do the same without it"
    )))
}

/// Refuses a program with more motions than are held.
fn held(reading: &Reading, setup: &trunnion_interp::Setup) -> Result<(), Refused> {
    let Some(block) = reading.given_up else { return Ok(()) };
    let most = setup.limits.held;
    let message = format!(
        "stopped: a conversion holds all motions (and faults) in memory, and there are more than {most}; raise `held` of [limits] in trunnion.toml (a \
         motion takes up to 4 kB)"
    );
    Err(Refused::at(&reading.program, block, message))
}

pub(crate) fn wording(program: &Program, fault: &Fault) -> String {
    let text: String = program.text(fault.range).chars().take(40).collect();
    match &fault.kind {
        FaultKind::NotModelled { what } if what.starts_with("INSERT") => {
            format!("{what}; if INSERT only carries remarks, add --insert-is-remark")
        }
        FaultKind::NotModelled { what } => {
            let remedy = match fault.kind.lacks() {
                Some(Lacks::ReferencePoint) => "; declare `reference_points` (G75: `fixed_points`) in [control] of the machine file or of trunnion.toml",
                Some(Lacks::Caller(_)) => "; convert the program that calls it",
                Some(Lacks::Radius(_)) => "; declare the radius in a comment or as a [[tool]] of trunnion.toml",
                Some(Lacks::Meaning(_)) | None => "",
            };
            format!("not modelled: {what}. The motion of the tool is unknown from here on{remedy}")
        }
        FaultKind::Rejected { message, .. } => format!("the control refuses this block: {message}"),
        FaultKind::NotDecided { what } => format!("what runs next depends on {what}, which is unknown"),
        FaultKind::AptUnknownRecord => "an unknown record: it may move the tool".to_owned(),
        FaultKind::UnknownCode { .. } => format!("{text} is an unknown code"),
        FaultKind::ProgramAlarm { .. } => {
            format!("{text} stops the program with an alarm, which is not carried over: remove it")
        }
        FaultKind::AmbiguousDecimal => {
            "a number without a decimal point: a parameter of the control decides what it means; declare it in trunnion.toml"
                .to_owned()
        }
        FaultKind::EndlessLoop { blocks, proved: false } => format!(
            "stopped: no end within {blocks} executed blocks; if the program is only long, raise `steps` and `held` of [limits] in \
             trunnion.toml"
        ),
        _ => format!("the program has an error at `{text}`; `trunnion check` names it"),
    }
}

/// The text and its proof. Where only rounding takes a coordinate beyond a limit of the machine, it is rounded to the other side.
fn written(
    (reading, source): (&Reading, &Run<'_>),
    setting: &Setting<'_>,
    (job, outs, stays): (&Job, &mut [Out], &[u16]),
    options: &Options,
    claim: &ConversionClaim,
) -> Result<(String, Found), Refused> {
    let step = setting.length_step(options);
    let mut tries = 0;
    loop {
        let Written { text, moved, .. } = setting.write(reading, job, (outs, stays), source.setup, options)?;
        let terms = (claim, &*options.drop);
        let found = prove((reading, source), setting, (&text, &moved), outs, terms)?;
        tries += 1;
        if tries == MOST_TRIES || !found.2.draw_in(outs, setting.machine, step) {
            return Ok((text, found));
        }
    }
}

/// A proof, the motions that change the posture, where axes leave their travel, and what the certificate tells.
type Found = (ConversionProof, Vec<usize>, Travel, Told);

fn prove(
    (reading, source): (&Reading, &Run<'_>),
    setting: &Setting<'_>,
    (text, moved): (&str, &[u32]),
    outs: &[Out],
    (claim, dropped): (&ConversionClaim, &[String]),
) -> Result<Found, Refused> {
    // vectors say by themselves where the tool points
    let machine = setting.mode.machine().or(setting.machine.filter(|_| setting.vectors));
    let mut setup = source.setup.clone();
    // codes of the builder of the target machine
    Machine::tell(setting.machine, &mut setup.control);
    let run = Run {
        text: text.as_bytes(),
        dialect: setting.dialect,
        machine,
        setup: &setup,
        assume: Assume::default(),
    };
    let after = read(&run);
    held(&after, source.setup)?;
    if let Some(error) = after.program.errors().first() {
        let (line, column) = LineIndex::new(text.as_bytes()).line_column(text.as_bytes(), error.range.start);
        return Err(Refused::new(format!(
            "line {line}, column {column} of the output is not understood: correct the templates of the post"
        )));
    }
    let parts = if setting.post.is_some() {
        parts_without(outs, &after, moved)
    } else {
        parts(outs)
    };
    let meanings = setting.meanings();
    let terms = Terms {
        dropped,
        meanings: &meanings,
    };
    let proof = converted_on((reading, source.machine), (&after, machine), &parts, claim, &terms).and_then(|proof| {
        holds_with_zeros_apart([(reading, source), (&after, &run)], &parts, claim, &terms)?;
        Ok(proof)
    });
    let proof = proof.map_err(|outcome| {
        let why = match outcome {
            Outcome::Refuted(witness) => witness.to_string(),
            Outcome::Unknown(gap) => gap.to_string(),
            Outcome::Proved(_) => String::new(),
        };
        if diameters(source.dialect, source.machine) || diameters(setting.dialect, setting.machine) {
            return Refused::new(format!(
                "this is a program for a lathe, or one for a machine whose X counts diameters. No post writes such programs (diameters, T with its offset, \
                 feed per revolution): change it by hand for the other control and compare both with `trunnion diff`. What the conversion found: {why}"
            ));
        }
        Refused::new(format!("the conversion could not be proved and was not written: {why}"))
    })?;
    let turned = control_swaps(&after, &parts, machine, setting.vectors);
    let travel = travel(&after, &parts, machine);
    let told = Told {
        read_on_machine: machine.is_some(),
        assume: source.assume,
        dropped: dropped.to_vec(),
        own_codes: meanings,
        parts,
    };
    Ok((proof, turned, travel, told))
}

/// Whether X of a program counts diameters.
fn diameters(dialect: &Dialect, machine: Option<&Machine>) -> bool {
    dialect.quirks.diameter || machine.is_some_and(|machine| machine.axes.iter().any(|axis| axis.extra.diameter))
}
