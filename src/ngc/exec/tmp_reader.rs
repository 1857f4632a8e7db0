#![allow(clippy::all, clippy::pedantic, clippy::print_stdout, unused)]
use crate::*;
use std::io::Write;
struct Out { text: Vec<u8>, listing: Listing }
impl Sink for Out {
    fn call(&mut self, call: &Canon, _: At, _: &State) { self.listing.write(call, b".....", &mut self.text).unwrap(); }
    fn error(&mut self, _: &Error, _: At) {}
}
fn group(code: i16) -> usize {
    match code {
        40 | 53 | 63 | 100 | 280 | 281 | 300 | 301 | 520 | 530 | 920 => 0,
        170..=191 => 2, 900 | 910 => 3, 901 | 911 => 4, 930 | 940 | 950 => 5, 200 | 210 => 6,
        400..=421 => 7, 430..=432 | 490 => 8, 980 | 990 => 10, 540..=593 => 12, 610 | 611 | 640 => 13, 960 | 970 => 14, 70 | 80 => 15,
        921..=923 => 16, _ => 1 }
}
fn mgroup(code: i16) -> usize {
    match code { 0 | 1 | 2 | 30 | 60 | 99 => 4, 62..=68 => 5, 6 | 61 => 6, 3 | 4 | 5 | 19 | 70..=73 => 7, 7 | 8 | 9 => 8, 48..=53 => 9, _ => 10 }
}
#[test]
#[ignore]
fn tmp() {
    let dir = std::env::var("NGC_DIR").unwrap();
    let mut setup = Setup::default();
    if let Ok(t) = std::env::var("NGC_TBL") { setup.tools = ToolTable::parse(&std::fs::read(t).unwrap()).0; }
    if let Ok(t) = std::env::var("NGC_VAR") { setup.parameters = Parameters::parse(&std::fs::read(t).unwrap()).unwrap(); }
    if let Ok(t) = std::env::var("NGC_INI") { setup.ini = Ini::parse(&std::fs::read(t).unwrap()); }
    for entry in std::fs::read_dir(&dir).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "ngc") { continue; }
        let text = std::fs::read_to_string(&path).unwrap();
        let mut engine = Engine::new(std::sync::Arc::new(Source::new(String::new(), std::sync::Arc::from(text.as_bytes()))), &setup);
        let mut out = Out { text: vec![], listing: Listing::default() };
        super::start(&mut engine, &mut out);
        let mut failed = None;
        'lines: for line in text.lines() {
            let low = line.to_ascii_lowercase();
            if let Some(rest) = low.strip_prefix("(debug,") {
                let words: Vec<String> = rest.trim_end_matches(')').split(' ').map(|w| w.strip_prefix('#').and_then(|n| n.parse::<usize>().ok()).map_or(w.to_string(), |n| format!("{:.6}", engine.parameter(n)))).collect();
                engine.emit(Canon::Message(std::sync::Arc::from(words.join(" ").as_bytes())), At::default(), &mut out);
                continue;
            }
            let mut block = Block::new();
            block.range = trunnion_syntax::TextRange::new(0, 0);
            let s: Vec<u8> = low.bytes().filter(|b| !b.is_ascii_whitespace()).collect();
            let mut i = 0;
            while i < s.len() {
                let letter = s[i].to_ascii_uppercase(); i += 1;
                let st = i;
                while i < s.len() && (s[i].is_ascii_digit() || b"+-.".contains(&s[i])) { i += 1; }
                let v: f64 = std::str::from_utf8(&s[st..i]).unwrap().parse().unwrap_or_else(|_| panic!("{path:?} {line}"));
                match letter {
                    b'G' => { let c = (v * 10.0).round() as i16; let g = group(c); if block.g[g] != -1 { failed = Some("Two g codes used from same modal group".to_string()); break 'lines; } block.g[g] = c; }
                    b'M' => { let c = v as i16; let g = mgroup(c); if block.m[g] != -1 { failed = Some("Two m codes used from same modal group".to_string()); break 'lines; } block.m[g] = c; block.m_count += 1; }
                    b'@' => block.radius = Some(v), b'^' => block.angle = Some(v), b'$' => block.spindle = Some(v as i32),
                    b'N' => block.number = Some(v),
                    b'F' if v < 0.0 => { failed = Some("Negative f word used".to_string()); break 'lines; }
                    b'S' if v < 0.0 => { failed = Some("Negative spindle speed used".to_string()); break 'lines; }
                    l => { let p = (l - b'A') as usize; if block.given & (1 << p) != 0 { failed = Some(format!("Multiple {} words on one line", (l as char).to_ascii_lowercase())); break 'lines; } block.given |= 1 << p; block.words[p] = v; }
                }
            }
            match super::check(&engine, &mut block).and_then(|()| super::execute(&mut engine, &mut block, At::default(), &mut out)) {
                Ok(super::After::Go) => {}
                Ok(super::After::Ended) => break,
                Err(e) => { failed = Some(e.message().to_string()); break; }
            }
        }
        if let Some(f) = failed { writeln!(out.text, "! {f}").unwrap(); }
        std::fs::write(path.with_extension("ours"), out.text).unwrap();
    }
}
