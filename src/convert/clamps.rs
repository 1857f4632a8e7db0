//! Codes of the clamps of rotary axes: an axis is released before a motion that turns it, and clamped before cuts in which it stands still.
//!
//! Codes are written where the tool is out of the cut: motions between two rapids are one pass, in which a clamp does not change. The machine
//! names the codes; the clamp codes of the original program are not carried over.
use crate::Refused;
use crate::emit_code::Writer;
use trunnion_interp::AllClampCodes;
use trunnion_machine::Machine;
use trunnion_syntax::BlockId;

/// Something in the output program that clamps depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Step {
    /// A motion; bit per axis (in the order of `AXIS_LETTERS`) that it may turn.
    Motion { turns: u16, cuts: bool },
    /// An M code that the original program requested by its number.
    Code(u32),
}

/// Which codes go before which step: the index of the step, the number of the code; ascending.
pub(crate) type Plan = Vec<(usize, u16)>;

/// The clamps of an output program: it is written first without them, then with what was planned for its steps.
#[derive(Clone, Debug, Default)]
pub(crate) struct Clamping {
    /// What was written so far.
    steps: Vec<Step>,
    plan: Plan,
    /// How much of the plan is written.
    done: usize,
}

impl Clamping {
    /// For the second time, now that the steps are known.
    pub(crate) fn planned(codes: &AllClampCodes, first: &Self) -> Self {
        Self {
            plan: plan(codes, &first.steps),
            ..Self::default()
        }
    }

    /// The next step: the codes before it.
    fn next(&mut self, step: Step) -> Vec<u16> {
        let index = self.steps.len();
        self.steps.push(step);
        let rest = &self.plan[self.done..];
        let codes: Vec<u16> = rest
            .iter()
            .take_while(|(at, _)| *at == index)
            .map(|(_, code)| *code)
            .collect();
        self.done += codes.len();
        codes
    }
}

/// Axes that move together with each axis's clamp: those that have a code in common with it, and itself.
fn joined(codes: &AllClampCodes) -> [u16; 9] {
    let shares = |a: usize, b: usize| {
        let pair = codes[a].zip(codes[b]);
        pair.is_some_and(|(a, b)| [a.on, a.off].iter().any(|code| [b.on, b.off].contains(code)))
    };
    core::array::from_fn(|a| (0..9).filter(|&b| shares(a, b)).map(|b| 1 << b).sum())
}

/// The codes that the steps need.
fn plan(codes: &AllClampCodes, steps: &[Step]) -> Plan {
    let joined = joined(codes);
    let has = |turns: u16, axis: usize| turns & joined[axis] != 0;
    // closed or open; `None`: not programmed yet
    let mut stands: [Option<bool>; 9] = [None; 9];
    let mut plan: Plan = Vec::new();
    let mut in_pass = false;
    for (index, step) in steps.iter().enumerate() {
        let (turns, begins) = match *step {
            Step::Code(number) => {
                for (stands, codes) in stands.iter_mut().zip(codes) {
                    let Some(codes) = codes else { continue };
                    if number == u32::from(codes.on) || number == u32::from(codes.off) {
                        *stands = Some(number == u32::from(codes.on));
                    }
                }
                continue;
            }
            Step::Motion { turns, cuts: false } => {
                in_pass = false;
                (turns, false)
            }
            Step::Motion { turns, cuts: true } if in_pass => (turns, false),
            Step::Motion { cuts: true, .. } => {
                in_pass = true;
                (turns_of_pass(&steps[index..]), true)
            }
        };
        for axis in 0..9 {
            let Some(codes) = codes[axis] else { continue };
            let wanted = if has(turns, axis) {
                false
            } else if begins {
                true
            } else {
                continue;
            };
            if stands[axis] == Some(wanted) {
                continue;
            }
            stands[axis] = Some(wanted);
            let code = (index, if wanted { codes.on } else { codes.off });
            let known = plan
                .iter()
                .rev()
                .take_while(|(at, _)| *at == index)
                .any(|known| *known == code);
            if !known {
                plan.push(code);
            }
        }
    }
    plan
}

/// Axes that turn in cuts before the next rapid.
fn turns_of_pass(steps: &[Step]) -> u16 {
    let mut all = 0;
    for step in steps {
        match *step {
            Step::Motion { turns, cuts: true } => all |= turns,
            Step::Motion { cuts: false, .. } => break,
            Step::Code(_) => {}
        }
    }
    all
}

impl Writer<'_> {
    /// Writes the codes that a step needs before it.
    pub(crate) fn clamp(&mut self, step: Step, block: BlockId) -> Result<(), Refused> {
        for code in self.clamping.next(step) {
            self.template("auxiliary", Some(block), |name| {
                (name == "number").then(|| code.to_string())
            })?;
        }
        Ok(())
    }
}

/// The remark at the start of a program whose clamps are left to the operator.
pub(crate) fn remark(machine: &Machine, letter: char) -> String {
    let axis = machine.axes.iter().find(|axis| char::from(axis.letter) == letter);
    let known = axis.is_some_and(|axis| axis.extra.clamp_codes.is_some());
    let why = if known {
        "the target control has no such codes"
    } else {
        "the machine file does not name its codes"
    };
    format!("{letter} has a clamp. This program does not operate it: {why}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_interp::ClampCodes;

    const A: u16 = 1 << 3;
    const C: u16 = 1 << 5;

    fn codes(a: (u16, u16), c: (u16, u16)) -> AllClampCodes {
        let mut codes = AllClampCodes::default();
        codes[3] = Some(ClampCodes { on: a.0, off: a.1 });
        codes[5] = Some(ClampCodes { on: c.0, off: c.1 });
        codes
    }

    fn rapid(turns: u16) -> Step {
        Step::Motion { turns, cuts: false }
    }

    fn cut(turns: u16) -> Step {
        Step::Motion { turns, cuts: true }
    }

    #[test]
    fn an_axis_is_released_to_turn_and_clamped_for_a_pass() {
        let codes = codes((10, 11), (12, 13));
        let steps = [
            rapid(A | C),
            cut(0),
            cut(0),
            rapid(0),
            cut(0),
            rapid(C),
            cut(0),
            cut(C),
            cut(0),
            rapid(0),
            cut(0),
        ];
        let planned = [(0, 11), (0, 13), (1, 10), (1, 12), (5, 13), (10, 12)];
        assert_eq!(plan(&codes, &steps), planned);
    }

    #[test]
    fn what_the_program_closes_itself_is_opened_again() {
        let codes = codes((10, 11), (12, 13));
        let steps = [rapid(A), cut(A), Step::Code(10), cut(A), Step::Code(8), cut(A)];
        assert_eq!(plan(&codes, &steps), [(0, 11), (1, 12), (3, 11)]);
    }

    #[test]
    fn axes_with_one_clamp_are_released_together() {
        let steps = [rapid(A | C), cut(0), rapid(C), cut(A), rapid(0), cut(0)];
        let planned = [(0, 11), (1, 10), (2, 11), (5, 10)];
        assert_eq!(plan(&codes((10, 11), (10, 11)), &steps), planned);
    }
}
