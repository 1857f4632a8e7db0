//! Where in a TOML text a byte is: the table, the key whose value it is in, the lists around it.

/// See the module.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TomlPlace {
    /// The keys of the tables around it, from the top of the file.
    pub table: Vec<String>,
    /// The key before it in its table.
    pub key: Option<String>,
    /// Lists between the key and it.
    pub lists: usize,
}

/// What is open at a byte.
enum Open {
    /// `{`, with the key before it.
    Table(Option<String>),
    /// `[`.
    List,
}

/// The names in a line that is the header of a table: `[axis.dyn]`, `[[tool]]`, with the place of the byte behind it.
fn header(line: &str) -> Option<Vec<String>> {
    let line = line.trim_start();
    let inner = line.strip_prefix("[[").or_else(|| line.strip_prefix('['))?;
    let (inner, rest) = inner.split_at(inner.find(']')?);
    let rest = rest.trim_start_matches(']').trim_start();
    let is_name = |c: char| c.is_ascii_alphanumeric() || "_-. \"'".contains(c);
    let plain = !inner.trim().is_empty() && inner.chars().all(is_name) && (rest.is_empty() || rest.starts_with('#'));
    plain.then(|| names(inner))
}

/// The parts of a key: `dyn.vmax`, `"G54.1 P1".X`.
fn names(key: &str) -> Vec<String> {
    let mut parts = vec![String::new()];
    let mut quote = None;
    for c in key.trim().chars() {
        match (quote, c) {
            (Some(open), c) if c == open => quote = None,
            (None, '"' | '\'') => quote = Some(c),
            (None, '.') => parts.push(String::new()),
            (None, c) if c.is_whitespace() => {}
            (_, c) => parts.last_mut().unwrap_or(&mut String::new()).push(c),
        }
    }
    parts
}

impl TomlPlace {
    /// The place of a byte.
    pub fn of(text: &str, at: usize) -> Self {
        let before = text.get(..at).unwrap_or(text);
        let mut place = Self::default();
        let mut open: Vec<Open> = Vec::new();
        let mut key: Option<String> = None;
        let mut word_start = 0;
        let bytes = before.as_bytes();
        let mut next = 0;
        while next < bytes.len() {
            let line_start = next == 0 || bytes[next - 1] == b'\n';
            if line_start && open.is_empty() {
                (key, word_start) = (None, next);
                let line = text[next..].lines().next().unwrap_or_default();
                if let Some(mut in_header) = header(line) {
                    if next + line.len() > before.len() {
                        // the byte is in the header: around it are the names before its own
                        in_header = names(before[next..].trim_start().trim_start_matches('['));
                        in_header.pop();
                        return Self {
                            table: in_header,
                            ..Self::default()
                        };
                    }
                    place.table = in_header;
                    next += line.len();
                    continue;
                }
            }
            match bytes[next] {
                b'#' => next += before[next..].find('\n').unwrap_or(before.len() - next) - 1,
                quote @ (b'"' | b'\'') => next = end_of_text(bytes, next, quote),
                b'=' => key = before.get(word_start..next).map(|word| word.trim().to_owned()),
                b'{' => {
                    open.push(Open::Table(key.take()));
                    word_start = next + 1;
                }
                b'[' => open.push(Open::List),
                b'}' => {
                    while let Some(Open::List) = open.last() {
                        open.pop();
                    }
                    key = match open.pop() {
                        Some(Open::Table(outer)) => outer,
                        _ => None,
                    };
                }
                b']' => {
                    open.pop();
                }
                b',' if matches!(open.last(), Some(Open::Table(_))) => (key, word_start) = (None, next + 1),
                _ => {}
            }
            next += 1;
        }
        if open.is_empty() && before.ends_with('\n') {
            key = None;
        }
        for one in open {
            match one {
                Open::List => place.lists += 1,
                Open::Table(outer) => {
                    place.table.extend(outer.iter().flat_map(|outer| names(outer)));
                    place.lists = 0;
                }
            }
        }
        let mut own = key.map(|key| names(&key)).unwrap_or_default();
        place.key = own.pop();
        place.table.append(&mut own);
        place
    }

    /// The table of a text that begins at a byte with its header or its `{`.
    pub fn of_table(text: &str, at: usize) -> Vec<String> {
        let rest = text.get(at..).unwrap_or_default();
        if let Some(names) = header(rest.lines().next().unwrap_or_default()) {
            return names;
        }
        let place = Self::of(text, at);
        let mut table = place.table;
        if rest.starts_with('{') {
            table.extend(place.key);
        }
        table
    }
}

/// The last byte of a text in quotes.
fn end_of_text(bytes: &[u8], start: usize, quote: u8) -> usize {
    let mut at = start + 1;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'\\' if quote == b'"' => at += 1,
            b'\n' => return at - 1,
            byte if byte == quote => return at,
            _ => {}
        }
        at += 1;
    }
    bytes.len()
}

#[cfg(test)]
mod tests {
    use super::TomlPlace;

    #[test]
    fn a_byte_has_a_place() {
        for (text, table, key, lists) in [
            ("machine = |3", "", "machine", 0),
            ("a = 1 # [x] = {\n[limits]\nblocks = |0.5", "limits", "blocks", 0),
            (
                "[[axis]]\nletter = \"X\"\ndyn = { vmax = 5, amax = |\"fast\" }",
                "axis/dyn",
                "amax",
                0,
            ),
            (
                "axis = [\n  {letter=\"X\", dyn={vmax=1}, sign=|\"a\"}]",
                "axis",
                "sign",
                0,
            ),
            ("[work_offsets]\nG54 = |[0, 0]", "work_offsets", "G54", 0),
            (
                "[work_offsets]\n\"G54.1 P1\" = { X = |true }",
                "work_offsets/G54.1 P1",
                "X",
                0,
            ),
            ("sources = [ \"]{=\", |5 ]", "", "sources", 1),
            ("[control]\ntcp.path = |5", "control/tcp", "path", 0),
            ("polygon = [\n[0, 1],\n[|", "", "polygon", 2),
            ("[axis.dyn] # x\nvmax = 5\njmax = |1", "axis/dyn", "jmax", 0),
            ("a = \"open\nb = |1", "", "b", 0),
        ] {
            let at = text.find('|').expect("a mark");
            let place = TomlPlace::of(&text.replace('|', ""), at);
            assert_eq!(place.table.join("/"), table, "{text}");
            assert_eq!((place.key.as_deref(), place.lists), (Some(key), lists), "{text}");
        }
        // a line begins: the value before it is over
        let text = "[control]\nunits = \"mm\"\n";
        assert_eq!(TomlPlace::of(text, text.len()).key, None);
        for (text, table) in [("[a]\n[|b]", ""), ("[a]\n[[b.|c]]\nd = 1", "b"), ("[a]\n|b = 1", "a")] {
            let at = text.find('|').expect("a mark");
            assert_eq!(
                TomlPlace::of(&text.replace('|', ""), at).table.join("/"),
                table,
                "{text}"
            );
        }
        assert_eq!(TomlPlace::of_table("x = 1\n[[tool]]\nshape = \"ball\"", 6), ["tool"]);
        assert_eq!(TomlPlace::of_table("axis = [{ letter = \"X\" }]", 8), ["axis"]);
        assert_eq!(TomlPlace::of_table("name = \"x\"", 0), [""; 0]);
    }

    /// No text makes it panic, whatever is not closed.
    #[test]
    fn any_text_has_places() {
        let text = "[[a]]\n}{]=[\"x\\\n'#\n,=,{a=[}b=ä\n[é]\n";
        for at in 0..=text.len() + 3 {
            TomlPlace::of(text, at);
            TomlPlace::of_table(text, at);
        }
    }
}
