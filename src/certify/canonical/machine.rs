//! A machine: chain, limits, speeds, control and thresholds.
use super::{CanonicalV1, Encode};
use trunnion_machine::{
    Axis, AxisExtra, AxisSign, Branch, Control, Criterion, Footprint, Gantry, Home, Limits, Machine, Obstacle,
    ObstacleKind, Obstacles, PostureWords, Tolerances,
};

// The rest is prose, or the axes in a form made for speed, or bodies, or how the control plans speeds, which no proof looks at, or
// a bound of the run.
record! {
    Machine {
        id = 1, axes = 2, tool_axis = 3, gauge_point = 4, home = 5, control = 6, tolerances = 7, gantries = 8,
        absent = 9, obstacles = 10,
    } without {
        name, sources, rotary, linear, joint_of_letter, constants, bodies, not_used, warnings, checks, not_judged,
        most_turned,
    }
}

record! {
    Home {
        tool_axis = 1, gauge_point = 2,
    }
}

record! {
    Axis {
        letter = 1, kind = 2, side = 3, direction = 4, point = 5, sign = 6, limits = 7, max_speed = 8,
        max_acceleration = 9, extra = 10,
    } without {
        note, source,
    }
}

record! {
    AxisExtra {
        wrap = 1, clamp = 2, clamp_codes = 3, cable = 4, spindle = 5, diameter = 6, limits_declared = 7,
        limit_margin = 8, resolution = 9, max_jerk = 10, position_gain = 11, feed_forward = 12, point_uncertainty = 13,
        direction_uncertainty = 14, hold = 15,
    }
}

record! {
    Gantry {
        letter = 1, leader = 2,
    }
}

record! {
    Control {
        family = 1, tcp_great_circle = 2, tcp_declared = 3, rapid = 4, branch = 5, pole_cone = 6, pole_action = 7,
        feed = 8, corner_model = 9, block_time = 10, tcp_codes = 11, posture_words = 12, units = 13,
        reference_points = 14, peck_clearance_mm = 15, chip_break_retract_mm = 16, roughing_escape = 17, thread_pull_out = 18,
        roughing_retract_mm = 19, thread_least_cut_mm = 20, thread_finish_mm = 21, tool_change = 22, power_on = 23,
        spline_arcs_mm = 24, drilling_axis = 34, fixed_points = 35, main_spindle = 36,
    } without {
        planning,
    }
}

record! {
    Branch {
        rule = 1, declared = 2, order = 3, range = 4, passing_type = 5, solution_negative = 6,
    }
}

record! {
    PostureWords {
        turn = 1, status = 2, solutions = 3,
    }
}

record! {
    AxisSign {
        letter = 1, negative = 2,
    }
}

/// The default of `pole_touch` in deg, a tolerance of all versions up to 0.1 that no rule read: they wrote it.
const POLE_TOUCH_DEG: f64 = 0.01;

impl Encode for Tolerances {
    fn encode(&self, out: &mut CanonicalV1) {
        let Self {
            tip_mm,
            pole_cone,
            pole_angle,
            swap_excess,
            feed_drop_warning,
            feed_drop_error,
            orientation,
            swept_mm,
            rotary_ratio,
            linear_ratio,
            rapid_ratio,
            pivot_mm,
            near_mm,
            clearance_mm,
        } = self;
        out.record(|fields| {
            fields
                .field(1, tip_mm)
                .field(2, pole_cone)
                .field(3, pole_angle)
                .field(4, swap_excess)
                .field(5, &trunnion_geometry::rad(POLE_TOUCH_DEG))
                .field(6, feed_drop_warning)
                .field(7, feed_drop_error)
                .field(8, orientation)
                .field(9, swept_mm)
                .field(10, rotary_ratio)
                .field(11, linear_ratio)
                .field(12, rapid_ratio)
                .field(13, pivot_mm)
                .field(14, near_mm)
                .field(15, clearance_mm);
        });
    }
}

impl Encode for Limits {
    fn encode(&self, out: &mut CanonicalV1) {
        match self {
            Self::Unbounded => out.variant(1, |_| {}),
            Self::Range(lowest, highest) => out.variant(2, |fields| {
                fields.field(1, lowest).field(2, highest);
            }),
        }
    }
}

impl Encode for Criterion {
    fn encode(&self, out: &mut CanonicalV1) {
        match self {
            Self::Time => out.variant(1, |_| {}),
            Self::Move(axis) => out.variant(2, |fields| {
                fields.field(1, axis);
            }),
            Self::Value(axis) => out.variant(3, |fields| {
                fields.field(1, axis);
            }),
        }
    }
}

record! {
    Obstacle {
        axis = 1, footprint = 2, bottom = 3, top = 4, kind = 5,
    } without {
        // for people
        name,
    }
}

/// None: an obstacle of the versions that knew no parts.
impl Encode for ObstacleKind {
    fn encode(&self, out: &mut CanonicalV1) {
        out.variant(
            match self {
                Self::Body => 1,
                Self::Part => 2,
            },
            |_| {},
        );
    }
    fn is_nothing(&self) -> bool {
        *self == Self::Body
    }
}

/// None: a machine of the versions that knew no obstacles.
impl Encode for Obstacles {
    fn encode(&self, out: &mut CanonicalV1) {
        self.0.encode(out);
    }
    fn is_nothing(&self) -> bool {
        self.0.is_empty()
    }
}

impl Encode for Footprint {
    fn encode(&self, out: &mut CanonicalV1) {
        match self {
            Self::Polygon(polygon) => out.variant(1, |fields| {
                let corners: Vec<[f64; 2]> = polygon.corners().iter().map(|corner| [corner.x, corner.y]).collect();
                fields.field(1, &corners);
            }),
            Self::Circle { centre, radius } => out.variant(2, |fields| {
                fields.field(1, &[centre.x, centre.y]).field(2, radius);
            }),
        }
    }
}
