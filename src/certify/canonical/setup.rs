//! What a program is run with: tools, work offsets, bounds, parameters of the control, variables.
use super::{CanonicalV1, Encode};
use trunnion_interp::{
    ClampCodes, ControlData, Limits, NamedVariables, Position, Setup, TcpCodes, Tool, ToolOffsets, ToolShape,
    WorkOffset,
};

// Each called program of the library has its own digest in the certificate.
record! {
    Setup {
        tools = 1, work_offsets = 2, limits = 3, control = 4, variables = 5, named_variables = 6,
        tool_offsets = 34,
    } without {
        // no proof asks for the others
        library, unnamed_stand, enter_definitions, progress,
    }
}

record! {
    Tool {
        number = 1, shape = 2, diameter_mm = 3, length_mm = 4, holder_mm = 5,
    }
}

record! {
    WorkOffset {
        name = 1, values = 2,
    }
}

/// `blocks` of all versions up to 0.1, which wrote it.
const BLOCKS: u64 = 10_000_000;

impl Encode for Limits {
    fn encode(&self, out: &mut CanonicalV1) {
        // the bounds of a run decide whether a proof reaches its end, not what it proves: a run that ends at one proves nothing. The depth of
        // calls stands for a limit of the control
        let Self {
            depth,
            blocks: _,
            steps: _,
            held: _,
        } = self;
        out.record(|fields| {
            fields.field(1, &BLOCKS).field(2, depth);
        });
    }
}

record! {
    ControlData {
        units = 1, implicit_decimals = 2, chip_break_retract_mm = 3, peck_clearance_mm = 4, bore_shift = 5,
        roughing_escape = 6, thread_pull_out = 7, outer_corner = 8, block_delete = 9, roll_pitch_yaw = 10,
        tcp_codes = 11, clamp_codes = 12, further_axes = 13, length_along = 14, reference_points = 15,
        absent_axis = 16, roughing_retract_mm = 17, thread_least_cut_mm = 18, thread_finish_mm = 19,
        tool_change = 20, power_on = 21, spline_arcs_mm = 22, frame_angles = 23, increment_adds_frame = 26,
        increment_adds_length = 27, drilling_axis = 34, fixed_points = 35, main_spindle = 36,
        splines = 37, scaled_axes = 38, chamfer_length = 39, hole_places = 40, positive_angles = 41,
    } without {
        // of the machine, which is encoded as a whole
        has_rotary, axes_declared, rotary_turns, x_diameter,
    }
}

/// Left out where there are none, as in older versions.
impl Encode for NamedVariables {
    fn encode(&self, out: &mut CanonicalV1) {
        self.0.encode(out);
    }
    fn is_nothing(&self) -> bool {
        self.0.is_empty()
    }
}

impl Encode for ToolOffsets {
    fn encode(&self, out: &mut CanonicalV1) {
        self.0.encode(out);
    }
    fn is_nothing(&self) -> bool {
        self.0.is_empty()
    }
}

record! {
    TcpCodes {
        on = 1, off = 2, at_start = 3,
    }
}

record! {
    ClampCodes {
        on = 1, off = 2,
    }
}

impl Encode for ToolShape {
    fn encode(&self, out: &mut CanonicalV1) {
        match self {
            Self::Ball => out.variant(1, |_| {}),
            Self::Flat => out.variant(2, |_| {}),
            Self::Bull(corner_mm) => out.variant(3, |fields| {
                fields.field(1, corner_mm);
            }),
            Self::Turning(nose) => out.variant(4, |fields| {
                fields.field(1, &nose.radius_mm);
                fields.field(2, &u32::from(nose.tip));
            }),
        }
    }
}

/// Each axis, in the order of `AXIS_LETTERS`, or nothing: the value stored for an unknown one means nothing.
impl Encode for Position {
    fn encode(&self, out: &mut CanonicalV1) {
        let Self { values, known: _ } = self;
        let axes: Vec<_> = (0..values.len()).map(|axis| self.get(axis)).collect();
        axes.encode(out);
    }
}
