//! Tools, spindles, outputs, saved states, probing, polar words, names, comments of random programs.
use super::generate::{Program, number};

impl Program {
    pub(crate) fn tools(&mut self) {
        self.say_some(
            6,
            &[
                "T{tool}",
                "T{tool}",
                "M6",
                "T{tool} M6",
                "T{tool} M6 G43",
                "M6 T{tool} G43 H{tool}",
                "T0 M6",
                "M61 Q{tool}",
                "M61 Q0",
                "G43",
                "G43 H{tool}",
                "G43 H0",
                "G43.1 X{w} Z{w}",
                "G43.1 {axes}",
                "G43.2 H{tool}",
                "G43.2 H0",
                "M6 T{tool} G43.2 H0",
                "M61 Q{tool} G43",
                "M61 Q{tool} G43 H0",
                "G43.2 X{w} Z{w}",
                "G49",
                "G10 L1 P{tool} X{w} Z{w}",
                "G10 L1 P{tool} Z{w} R{p} I{angle} J{angle} Q{i}",
                "G10 L10 P{tool} X{w} Z{w}",
                "G10 L10 P{tool} {axes} R{p}",
                "G10 L11 P{tool} Z{w}",
                "G10 L11 P{tool} X{w} Y{w}",
                "G10 L0",
                "G20",
                "G21",
                "G59.3",
                "G92 X{w} Z{w}",
                "G0 {axes}",
            ],
        );
        self.line("(debug, #<_current_tool> #<_current_pocket> #<_selected_tool> #<_selected_pocket> #<_tool_offset>)");
        self.line("(debug, #5400 #5401 #5402 #5403 #5404 #5409 #5410 #5411 #5412 #5413)");
        self.line("(debug, #5420 #5421 #5422 #5423 #<_x> #<_z> #<_abs_x> #<_abs_z>)");
        self.go();
    }

    /// Compensation by the tool in the spindle or by a number of the table.
    pub(crate) fn compensated_by_tool(&mut self) {
        self.say_one(&["G17", "G18", "G17 G21", "G20"]);
        self.go();
        self.say_one(&[
            "G41 D{tool}",
            "G42 D{tool}",
            "G41",
            "G42",
            "G41.1 D{p} L{i}",
            "G42.1 D{p}",
        ]);
        for _ in 0..2 + self.random.below(5) {
            self.say_one(&[
                "G1 X{v} Y{v}",
                "G1 X{v} Z{v}",
                "G1 Z{v}",
                "G0 X{v} Y{v} Z{v}",
                "G91 G1 X{v} Y{v}",
                "G90 X{v}",
                "G2 X{v} Y{v} R{v}",
                "G3 X{v} Z{v} R50",
                "G93 G1 X{v} Y{v} F{p}",
                "X{v} Y{v} F{p}",
                "G94 F{feed}",
                "M61 Q{tool}",
                "G4 P{p}",
                "M{3}",
                "M8",
                "M3 S{speed}",
                "G40",
                "G1 A{v}",
                "G64 P{p}",
                "(debug, #<_x> #<_y> #<_z> #5420 #5421 #5422)",
            ]);
        }
        self.line("G40 G94 F100");
        self.go();
    }

    pub(crate) fn spindles(&mut self) {
        self.say_some(
            5,
            &[
                "M3 S{speed}",
                "M3 S{speed} ${spindle}",
                "M4 ${spindle}",
                "M5 ${spindle}",
                "S{speed} ${spindle}",
                "S{speed}",
                "M19",
                "M19 R{angle}",
                "M19 R{i} P{3} Q{p} ${spindle}",
                "G96 D{speed} S{speed}",
                "G96 S{speed} ${spindle}",
                "G97 S{speed} ${spindle}",
                "G97",
                "M51 P{3}",
                "M51 P{3} ${spindle}",
                "G95 F{p}",
                "G94 F{feed}",
                "M48",
                "M49",
                "M50 P{3}",
                "M52 P{3}",
                "M53 P{3}",
                "M5",
            ],
        );
        self.line("(debug, #<_rpm> #<_spindle_on> #<_spindle_cw> #<_spindle_css_mode> #<_feed> #<_speed_override>)");
    }

    pub(crate) fn signals(&mut self) {
        self.say_some(
            5,
            &[
                "M62 P{i}",
                "M63 P{i}",
                "M64 P{i}",
                "M65 P{i}",
                "M66 P{i} L{i} Q{w}",
                "M66 P{i}",
                "M66 E{i} L0",
                "M67 E{i} Q{w}",
                "M68 E{i} Q{w}",
                "M7",
                "M8",
                "M9",
                "M7 M8",
                "M64 P{i} M8 M3 S{speed}",
                "G4 P{p} M9",
                "M0",
                "M1",
                "M60",
                "G64 P{p} Q{p}",
                "G64 Q{p}",
                "G64",
                "G61",
                "G61.1",
                "(debug, #5399)",
            ],
        );
        self.go();
    }

    /// M70 to M73 around changes.
    pub(crate) fn saved(&mut self) {
        self.say_one(&["M70", "M70", "M73", "M71"]);
        self.say_some(
            5,
            &[
                "G20",
                "G21",
                "G91",
                "G90",
                "G18",
                "G17",
                "G19",
                "G93",
                "G94",
                "G95",
                "G55",
                "G59.3",
                "G43.1 Z{w}",
                "G49",
                "G64 P{p} Q{p}",
                "G61",
                "F{feed}",
                "S{speed}",
                "M3",
                "M4",
                "M5",
                "M7",
                "M8",
                "M9",
                "M48",
                "M49",
                "M50 P0",
                "M51 P0",
                "M52 P1",
                "M53 P0",
                "G7",
                "G8",
                "G98",
                "G99",
                "G90.1",
                "G91.1",
                "G96 D{speed} S{speed}",
                "G97",
                "G92 X{w}",
                "G92.2",
                "G92.3",
                "G52 X{w}",
            ],
        );
        self.say_one(&["M72", "M72", "M71", "M70"]);
        self.line("(debug, #<_metric> #<_absolute> #<_plane> #<_feed> #<_rpm> #<_mist> #<_flood> #<_motion_mode>)");
        self.line("G21 G90 G17 G94 F200");
        self.go();
    }

    pub(crate) fn probing(&mut self) {
        self.say_one(&["G38.2 {axes}", "G38.3 Z{v}", "G38.4 X{v} Y{v}", "G38.5 Z{v}"]);
        self.line("(debug, #5061 #5062 #5063 #5064 #5070)");
        self.go();
    }

    pub(crate) fn polar(&mut self) {
        self.line("G17");
        self.say_some(
            4,
            &[
                "G1 @{p} ^{angle}",
                "G0 @{p}",
                "G1 ^{angle}",
                "G91 G1 @{p} ^{angle}",
                "G90",
                "G91 ^{angle} Z{w}",
                "G90 G81 @{p} ^{angle} Z-3 R2",
                "G91 G81 @{p} ^{angle} Z-3 R2 L3",
                "G80",
                "G3 @{p} ^{angle} R{v}",
            ],
        );
        self.line("G80");
        self.line("G90");
        self.go();
    }

    pub(crate) fn names(&mut self) {
        self.say_some(
            6,
            &[
                "#<depth>={x}",
                "#<_size>={x}",
                "#<a b>={w}",
                "#1={x} #2=[#1+1] #3=#2",
                "#31=#31",
                "#[30+{3}]={x}",
                "#100=[#100+{w}]",
                "#3000={w}",
                "#<_own>=#<_ini[own]number>",
                "#1=EXISTS[#<_nothing>]",
                "#1=EXISTS[#<depth>]",
                "(debug, #1 #2 #3 #31 #100 #<depth> #<a b>)",
                "(debug, #<_line> #<_motion_mode> #<_plane> #<_ccomp> #<_metric> #<_imperial> #<_coord_system>)",
                "(debug, #<_absolute> #<_incremental> #<_inverse_time> #<_units_per_minute> #<_units_per_rev>)",
                "(debug, #<_vmajor> #<_vminor> #<_call_level> #<_remap_level> #<_task> #<_value> #<_value_returned>)",
                "(debug, #5211 #5220 #5221 #5222 #5230 #5241 #5161 #5181 #5181)",
                "(print, #1 %d#2 %.2f#3 %f#1 %%)",
                "(debug, %.1f #1 %.4f #2 %d #3)",
                "(log, #1)",
                "(logopen,x.log)",
                "(logclose)",
                "(msg, #1 is #1)",
                ";debug, #1 #2",
                ";msg, hello",
                "X{w} (debug, #5420)",
                "G1 X{w} ;print, #5420",
                "/ G1 X{w}",
                "/#1={x}",
                "N{i} G1 Y{w}",
            ],
        );
        self.go();
    }

    /// Coordinate systems, G92, G52, machine coordinates.
    pub(crate) fn systems(&mut self) {
        self.say_some(
            6,
            &[
                "G10 L2 P{system} {axes}",
                "G10 L2 P0 {axes}",
                "G10 L2 P{system} R{i}",
                "G10 L20 P{system} {axes}",
                "G10 L20 P0 {axes}",
                "G92 {axes}",
                "G52 {axes}",
                "G52 X0 Y0",
                "G92.1",
                "G92.2",
                "G92.3",
                "G54",
                "G55",
                "G5{i}",
                "G59.{3}",
                "G20",
                "G21",
                "G91 G0 {axes}",
                "G90",
                "G53 G1 {axes}",
                "G53 G0 X{v}",
                "G28 {axes}",
                "G30",
                "G28.1",
                "G30.1",
                "#52{i}{i}={w}",
                "G43.1 {axes}",
                "G7",
                "G8",
                "G0 {axes}",
            ],
        );
        self.line("(debug, #5220 #5221 #5222 #5223 #5224 #5211 #5213 #5210 #5420 #5421 #5422 #5423)");
        self.line("(debug, #5161 #5162 #5163 #5181 #5182 #5183 #<_abs_x> #<_abs_y> #<_abs_z> #<_abs_a>)");
        self.line("G8 G90");
        self.go();
    }

    /// Threads: G33, G33.1, G76.
    pub(crate) fn threads(&mut self) {
        self.line("M3 S200");
        self.say_one(&["G18", "G17", "G18 G7"]);
        let (x, z) = (
            number(self.random.between(5.0, 30.0)),
            number(self.random.between(-5.0, 5.0)),
        );
        self.line(&format!("G0 X{x} Z{z}"));
        self.say_some(
            3,
            &[
                "G33 Z{v} K{p}",
                "G33 X{w} Z{v} K{p}",
                "G33.1 Z{v} K{p}",
                "G33.1 Z{v} K{p} I{p}",
                "G33 Z{v} K{p} ${spindle}",
                "G76 P{p} Z{v} I-{p} J0.4 R1.5 K1.6 Q{i} H{3} E{p} L{3}",
                "G76 P{p} Z{v} I{p} J0.5 K1.2",
                "G76 P{p} Z{v} X{v} I{w} J0.3 K2 R{degression} Q29.5 H1 E{w} L3",
                "Z{v}",
                "G0 X{v} Z{v}",
            ],
        );
        self.line("G8 G17");
        self.go();
    }

    pub(crate) fn splines(&mut self) {
        self.say_one(&["G17", "G17", "G18"]);
        self.go();
        self.say_some(
            4,
            &[
                "G5 X{v} Y{v} I{v} J{v} P{v} Q{v}",
                "G5 X{v} Y{v} P{v} Q{v}",
                "G5.1 X{v} Y{v} I{v} J{v}",
                "G5.2 X{v} Y{v} P{p} L{i}",
                "G5.2 P{p}",
                "X{v} Y{v} P{p}",
                "X{v} Y{v}",
                "G5.3",
                "G91",
                "G90",
            ],
        );
        self.line("G5.2 X1 Y1 P1 L3");
        self.line("X2 Y3 P2");
        self.line("X3 Y1 P1");
        self.line("G5.3");
        self.line("G90 G17");
        self.go();
    }
}
