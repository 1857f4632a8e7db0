//! Subprograms of random programs: in files of their own, in Fanuc's style, with values and names.
use super::generate::Program;

impl Program {
    /// A subprogram in a file beside the program.
    pub(crate) fn called_file(&mut self) {
        let label = self.next_label();
        let own = core::mem::take(&mut self.case.text);
        self.line(&format!("o<part{label}> sub"));
        self.say_some(
            5,
            &[
                "G1 X#1 Y#2",
                "#<depth>={x}",
                "#<inside>=#1",
                "#<_size>=#1",
                "#5=[#1+#2]",
                "G91 G0 Z{w}",
                "M73",
                "G20",
                "o900 if [#1 GT 0]\no<NAME> return [#1*2]\no900 endif",
                "(debug, #1 #2 #3 #<_call_level> #<_line>)",
                "#<x>=EXISTS[#<depth>]",
            ],
        );
        self.say_one(&["", "(debug, end of the subprogram)"]);
        if self.random.one_in(14) {
            self.mistake();
        }
        self.say_one(&["o<NAME> endsub", "o<NAME> endsub [#1+1]", "o<NAME> endsub", "M2"]);
        let text = self.case.text.replace("<NAME>", &format!("<part{label}>"));
        self.case.text = own;
        self.case.files.push((format!("part{label}.ngc"), text));
        for _ in 0..=self.random.below(2) {
            let call = self.fill(&format!("o<part{label}> call [{{x}}] [{{w}}]"));
            self.line(&call);
        }
        self.line("(debug, #<_value> #<_value_returned> #<_size> #1 #5)");
        self.line("G21 G90");
    }

    /// M98 and M99.
    pub(crate) fn numbered(&mut self) {
        let label = self.next_label() + 1000;
        let own = core::mem::take(&mut self.case.text);
        self.line(&format!("O{label}"));
        self.say_some(
            3,
            &[
                "G91 G1 X{w}",
                "#1=[#1+1]",
                "G90",
                "(debug, #1 #<_call_level>)",
                "#<own>={w}",
                "G1 Y{v}",
            ],
        );
        self.say_one(&["M99", "M99", "M99 (back)", "G1 X1 M99"]);
        let text = core::mem::replace(&mut self.case.text, own);
        if self.random.one_in(2) {
            self.case.files.push((format!("{label}.ngc"), text));
        } else {
            self.behind.push_str(&text);
        }
        for _ in 0..=self.random.below(2) {
            let call = self.fill(&format!("M98 P{label} L{{3}}"));
            let call = if self.random.one_in(2) {
                format!("M98 P{label}")
            } else {
                call
            };
            self.line(&call);
        }
        self.line("G90");
        self.go();
    }
}
