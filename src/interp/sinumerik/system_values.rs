//! System variables of a Sinumerik with a value that follows from the program: `$P_EP[X]`, `$P_F`, `$P_GG[6]`.
//!
//! Sources: SINUMERIK lists of system variables; $AA_IM, $P_TOOLR, $P_EP, $P_F, $P_S, $P_TOOL, $P_TOOLNO, $P_GG, $P_MC, $P_UIFR, $P_PFRAME, $AA_IW.
use crate::iso::Iso;
use std::collections::BTreeMap;
use std::fmt::Arguments;
use trunnion_syntax::Block;

impl Iso<'_> {
    /// What the control knows, for a block that may ask for it.
    pub(crate) fn note_system(&mut self, block: &Block<'_>) {
        let range = block.range();
        let text = block.program().bytes(range);
        let frames = !self.memory.own.scope.frames.is_empty() && text.contains(&b'[');
        if frames || text.contains(&b'$') {
            let known = self.system_values();
            let own = &mut self.memory.own;
            if known != own.system {
                own.changes += 1;
                own.system = known;
            }
            let axes = crate::arc::plane_axes(self.core.state.coordinates.plane());
            own.plane_letters = axes.map(|axis| crate::AXIS_LETTERS[axis].to_ascii_lowercase());
        }
    }

    /// The angles that a frame reads back as, in the order of machine data 10600.
    fn frame_angles(&self, frame: &super::FrameValue) -> Option<[f64; 3]> {
        let is_rpy = self.core.setup.control.frame_angles == Some(crate::FrameAngles::RollPitchYaw);
        let turn = frame.turn();
        (is_rpy && crate::frames::is_rigid(&turn)).then(|| crate::frames::angles_of(&turn))
    }

    /// Where an axis stands on the machine, mm or degrees, while words are its positions and zero point and tool length are declared.
    fn on_machine(&self, axis: usize) -> Option<f64> {
        let state = &self.core.state;
        let led = state.tool_axis.tcp() || self.memory.frames.active || self.memory.frames.tilt.is_some();
        let known = !led && !state.length.is_undeclared() && state.zero.undeclared() & (1 << axis) == 0;
        let along = self.core.setup.length_along().get(axis).copied().unwrap_or(0.0);
        let length = state.length.mm().unwrap_or(0.0) * along;
        let here = state.position.get(axis).filter(|_| known)?;
        Some(here + state.zero.values()[axis] + length)
    }

    /// The radius of the active tool, mm: of its edge 1, as it is declared.
    fn tool_radius(&self) -> Option<f64> {
        let first = self.memory.edge == Some(1);
        Some(self.core.state.tool.data().filter(|_| first)?.diameter_mm? / 2.0)
    }

    /// $P_UIFR: the shifts of the settable frames that are known, in program units.
    fn stored_shifts(&mut self, unit: f64) -> Vec<(String, f64)> {
        let mut shifts = Vec::new();
        for (number, name) in self.memory.frames.offset_names(&self.core.setup) {
            let Some(values) = self.offset_values(name) else {
                continue;
            };
            for axis in (0..9).filter(|axis| values.known & (1 << axis) != 0) {
                let linear = crate::core::LINEAR & (1 << axis) != 0;
                let scale = if linear { unit } else { 1.0 };
                let letter = char::from(crate::AXIS_LETTERS[axis].to_ascii_lowercase());
                shifts.push((format!("$p_uifr[{number},{letter},tr]"), values.values[axis] / scale));
            }
        }
        shifts
    }

    /// The shifts along an axis of the settable frame in effect, and of all frames, mm, where they are known.
    fn frames_in_effect(&self, axis: usize) -> [Option<f64>; 2] {
        let (zero, frames) = (&self.core.state.zero, &self.memory.frames);
        let known = zero.undeclared() & (1 << axis) == 0 && zero.offset().is_some();
        let settable = known.then_some(frames.selected[axis]);
        let alone =
            frames.tilt.is_none() && frames.swivel.is_none() && frames.turret == [0.0; 9] && !zero.is_set_here();
        [settable, settable.filter(|_| alone).map(|_| zero.values()[axis])]
    }

    /// The parts of variables of the type FRAME that are known, in program units.
    fn parts_of_variables(&self, unit: f64) -> Vec<(String, f64)> {
        let mut parts = Vec::new();
        for (name, frame) in &self.memory.own.scope.frames {
            let Some(frame) = frame.filter(|frame| !frame.fine) else {
                continue;
            };
            let angles = self.frame_angles(&frame);
            for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
                parts.push((format!("{name}[{letter},tr]"), frame.shift[axis] / unit));
                parts.extend(angles.map(|angles| (format!("{name}[{letter},rt]"), angles[axis])));
            }
        }
        parts
    }

    /// The spindle, the codes in effect, and how the program runs.
    fn codes_in_effect(&self, put: &mut impl FnMut(Arguments<'_>, Option<f64>)) {
        for (group, number) in self.memory.own.groups.known() {
            put(format_args!("$p_gg[{group}]"), Some(number));
        }
        let spindle = &self.core.state.spindle;
        let speed = spindle
            .rpm()
            .filter(|_| !spindle.surface_speed() && spindle.speed_programmed());
        put(format_args!("$p_s"), speed);
        if let Some(main) = self.memory.own.main_spindle {
            put(format_args!("$p_s[{main}]"), speed);
        }
        put(format_args!("$p_msnum"), self.memory.own.main_spindle.map(f64::from));
        put(
            format_args!("$p_gg[6]"),
            Some(plane_code(self.core.state.coordinates.plane())),
        );
        put(
            format_args!("$p_mc"),
            Some(f64::from(u8::from(self.memory.cycle.call.is_some()))),
        );
        for name in ["$p_sim", "$p_istest", "$p_search", "$p_dryrun"] {
            // in a run that cuts the part
            put(format_args!("{name}"), Some(0.0));
        }
    }

    /// System variables with a value that follows from the program; all others are unknown by name.
    fn system_values(&mut self) -> BTreeMap<Box<str>, f64> {
        let mut known: BTreeMap<Box<str>, f64> = BTreeMap::new();
        let mut put = |name: Arguments<'_>, value: Option<f64>| {
            if let Some(value) = value {
                known.insert(name.to_string().into(), value);
            }
        };
        let position = self.core.state.position;
        let here = self.memory.frames.programmed(&position);
        let unit = self.core.state.coordinates.unit_mm();
        let own_plane = self.memory.frames.tilt.is_none_or(|tilt| tilt.programmed);
        let plain = !self.core.unknown.any()
            && !self.core.state.zero.is_lost()
            && own_plane
            && self.memory.offset_open.is_none();
        let frame = self.programmable();
        let angles = self.frame_angles(&frame).filter(|_| plain);
        let cutting_on_path = self.core.state.compensation == 0 && !self.memory.corners.is_busy();
        for (axis, letter) in crate::AXIS_LETTERS.iter().enumerate() {
            if axis == 0 && self.program_sets_diameters() {
                continue;
            }
            let linear = crate::core::LINEAR & (1 << axis) != 0;
            let scale = if linear { unit } else { 1.0 };
            let letter = char::from(letter.to_ascii_lowercase());
            let value = here.get(axis).filter(|_| plain).map(|value| value / scale);
            put(format_args!("$p_ep[{letter}]"), value);
            put(format_args!("$aa_iw[{letter}]"), value.filter(|_| cutting_on_path));
            let machine = self.on_machine(axis).filter(|_| plain && cutting_on_path);
            put(format_args!("$aa_im[{letter}]"), machine.map(|value| value / scale));
            let shift = frame
                .shift()
                .get(axis)
                .copied()
                .unwrap_or(self.memory.frames.local[axis]);
            put(
                format_args!("$p_pframe[{letter},tr]"),
                Some(shift / scale).filter(|_| plain && !frame.fine && self.memory.frames.shape.linear.is_none()),
            );
            if linear && plain {
                let [settable, whole] = self
                    .frames_in_effect(axis)
                    .map(|value| value.map(|value| value / scale));
                put(format_args!("$p_iframe[{letter},tr]"), settable);
                put(format_args!("$p_actframe[{letter},tr]"), whole);
            }
            let angle = angles.and_then(|angles| angles.get(axis).copied());
            put(format_args!("$p_pframe[{letter},rt]"), angle);
        }
        for (name, value) in self
            .stored_shifts(unit)
            .into_iter()
            .chain(self.parts_of_variables(unit))
        {
            put(format_args!("{name}"), Some(value));
        }
        let feed = self
            .core
            .state
            .feed
            .value()
            .map(|feed| feed / self.core.state.feed.unit_mm());
        put(format_args!("$pi"), Some(core::f64::consts::PI));
        put(format_args!("$p_f"), feed);
        put(format_args!("$p_toolno"), self.core.state.tool.number().map(f64::from));
        put(format_args!("$p_toolr"), self.tool_radius().map(|radius| radius / unit));
        put(format_args!("$p_tool"), self.memory.edge.map(f64::from));
        self.codes_in_effect(&mut put);
        known
    }
}

/// The number of the plane's code in its group.
fn plane_code(plane: trunnion_dialect::Plane) -> f64 {
    match plane {
        trunnion_dialect::Plane::Xy => 1.0,
        trunnion_dialect::Plane::Zx => 2.0,
        trunnion_dialect::Plane::Yz => 3.0,
    }
}
