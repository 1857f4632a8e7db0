use trunnion_syntax::*;
fn main() {
    for p in std::env::args().skip(1) {
        let b = std::fs::read(&p).unwrap();
        let l = p.to_lowercase();
        let apt = l.ends_with(".apt") || l.ends_with(".cls") || l.contains(".ncl");
        let siemens = l.ends_with(".mpf") || l.ends_with(".spf") || l.contains("array_test.txt");
        let o = LexOptions { format: if apt {Format::Apt} else {Format::Iso}, paren_comment: !siemens, blanks_in_numbers: l.ends_with("ngc"), ..LexOptions::default() };
        let pr = parse(b, o);
        let li = LineIndex::new(pr.source());
        let mut n = 0;
        for e in pr.errors() { n += 1; if n > 12 { continue; } let (a,c) = li.line_column(pr.source(), e.range.start);
            let blk = pr.block(pr.block_at(e.range.start).unwrap());
            println!("{p}:{a}:{c}: {:?} `{}` in `{}`", e.kind, pr.text(e.range).chars().take(40).collect::<String>(), pr.text(blk.range()).chars().take(90).collect::<String>()); }
        if n > 12 { println!("{p}: {n} errors"); }
    }
}
