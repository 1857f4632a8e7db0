//! Assignments to what belongs to the control: `$P_UIFR[1,X,TR]=200`, `$TC_DP3[1,1]=350`, `#5221=100`. They move zero points and
//! change tools in ways that are not modelled.
use crate::iso::Iso;
use trunnion_dialect::Dialect;

/// What an assignment to a variable of the control may change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum SystemWrite {
    /// Nothing that positions depend on, or a variable of the program itself.
    #[default]
    Nothing,
    /// It is not followed, but moves neither zero points nor tools (counters, outputs).
    Harmless,
    /// Zero points, tools or settings: what coordinates mean is unknown from here on.
    Meaning,
}

/// Variables of a Sinumerik that hold times, marks, free numbers and outputs (List Manual, System Variables).
const HARMLESS: [&[u8]; 5] = [b"$AC_TIMER", b"$AC_MARKER", b"$AC_PARAM", b"$A_OUT", b"$A_DB"];

/// Fanuc: interface signals, and alarms, clocks and messages (Series 30i operator's manual, system variables). On LinuxCNC these
/// numbers are the program's own.
fn without_position(number: u32) -> bool {
    matches!(number, 1000..=1999 | 3000..=3004 | 3006 | 3011..=3012)
}

/// What the assignment to `name` (`$P_PFRAME`, `#5221`, with its index, without `=`) changes.
pub(crate) fn system_write(dialect: &Dialect, name: &[u8]) -> SystemWrite {
    if dialect.quirks.user_task() {
        // which variables of an Okuma move zero points or tools is not known of all of them
        return if crate::osp::is_of_control(name) {
            SystemWrite::Meaning
        } else {
            SystemWrite::Nothing
        };
    }
    match name {
        [b'$', ..] => {
            let harmless = HARMLESS.iter().any(|known| {
                name.get(..known.len())
                    .is_some_and(|start| start.eq_ignore_ascii_case(known))
            });
            if harmless {
                SystemWrite::Harmless
            } else {
                SystemWrite::Meaning
            }
        }
        // names such as #<depth> are the program's own
        [b'#', rest @ ..] if rest.trim_ascii_start().first() != Some(&b'<') => {
            let digits = std::str::from_utf8(rest).unwrap_or_default().trim();
            match digits.parse::<u32>() {
                Ok(number) if number <= dialect.quirks.own_parameters_to => SystemWrite::Nothing,
                Ok(number) if without_position(number) => SystemWrite::Harmless,
                // a computed number may be any
                _ => SystemWrite::Meaning,
            }
        }
        _ => SystemWrite::Nothing,
    }
}

impl Iso<'_> {
    /// Zero points or tools have changed: no coordinate, linear or rotary, says where the machine is until the end of the program.
    pub(crate) fn system_changed(&mut self) {
        self.core.unknown.for_good();
        self.memory.tool_data_written = true;
        self.core.forget_position();
        self.core.state.zero.lose(true);
    }
}
