//! Why coordinates say nothing: each reason has a bit of its own, and positions are known only where none holds.

/// One of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reason {
    /// A datum shift that is not known.
    Datum,
    /// A working plane that is not known.
    Plane,
    /// A cycle between definition and call that changes the system, and that nothing which is followed ends.
    Shape,
    /// Turning: X is a diameter.
    Turning,
    /// A system of coordinates that nothing which is followed ends: parallel axes, a correction table, a preset that the program writes.
    Other,
    /// A shift that belongs to a plane, or to the system outside of it: which one is not known.
    Inside,
    /// A preset that is not known.
    Preset,
    /// A length of the tool that is not known.
    Length,
    /// A direction of the tool that the machine does not have at home.
    ToolAxis,
    /// A rotation that is not known.
    Rotation,
    /// A scaling by cycle 11 that is not known.
    Scale,
    /// A scaling by cycle 26 that is not known.
    AxisScale,
    /// A scaling together with what no source says about both.
    ScaleWith,
    /// A mirror image and a rotation together: their order is not known.
    Order,
    /// A mirror image that is not known.
    Mirror,
}

impl Reason {
    /// The last of them.
    const LAST: Self = Self::Mirror;

    const fn bit(self) -> u16 {
        1 << self as u16
    }
}

/// Each has a bit.
const _: () = assert!((Reason::LAST as u32) < u16::BITS, "more reasons than bits");

/// Those that hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Reasons(u16);

impl Reasons {
    pub(crate) fn has(self, reason: Reason) -> bool {
        self.0 & reason.bit() != 0
    }

    pub(crate) fn any(self) -> bool {
        self.0 != 0
    }

    pub(crate) fn add(&mut self, reason: Reason) {
        self.0 |= reason.bit();
    }

    pub(crate) fn remove(&mut self, reason: Reason) {
        self.0 &= !reason.bit();
    }
}

#[cfg(test)]
mod tests {
    use super::{Reason, Reasons};

    const ALL: [Reason; Reason::LAST as usize + 1] = [
        Reason::Datum,
        Reason::Plane,
        Reason::Shape,
        Reason::Turning,
        Reason::Other,
        Reason::Inside,
        Reason::Preset,
        Reason::Length,
        Reason::ToolAxis,
        Reason::Rotation,
        Reason::Scale,
        Reason::AxisScale,
        Reason::ScaleWith,
        Reason::Order,
        Reason::Mirror,
    ];

    /// Two of them once had one bit: the end of one ended the other.
    #[test]
    fn the_end_of_one_reason_ends_no_other() {
        for ended in ALL {
            let mut reasons = Reasons::default();
            for reason in ALL {
                reasons.add(reason);
            }
            reasons.remove(ended);
            for reason in ALL {
                assert_eq!(reasons.has(reason), reason != ended, "{reason:?} after {ended:?}");
            }
        }
        let mut reasons = Reasons::default();
        assert!(!reasons.any());
        reasons.add(Reason::Order);
        assert!(reasons.any());
    }
}
