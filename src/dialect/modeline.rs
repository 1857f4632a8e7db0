//! The modeline: a comment near the top that says which dialect and machine a program is for.

/// How many lines are searched.
const LINES: usize = 10;

/// The contents of the modeline.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Modeline {
    /// `(trunnion: dialect NAME)`.
    pub dialect: Option<String>,
    /// `; trunnion: machine NAME`.
    pub machine: Option<String>,
    /// The line of `machine`, from 1.
    pub machine_line: u32,
}

/// Reads `trunnion: dialect NAME` and `trunnion: machine NAME` from comments in the first ten lines. The dialect is not known
/// yet, so any comment mark is accepted: what matters is the word `trunnion:` followed by a key and a name.
pub fn modeline(source: &[u8]) -> Modeline {
    let mut found = Modeline::default();
    let end = if source.contains(&b'\n') { b'\n' } else { b'\r' };
    for (number, line) in (1..).zip(source.split(|&b| b == end).take(LINES)) {
        let text = String::from_utf8_lossy(&line[..line.len().min(400)]);
        let Some(at) = text.to_ascii_lowercase().find("trunnion:") else {
            continue;
        };
        let rest: String = text
            .chars()
            .skip(text[..at].chars().count() + "trunnion:".len())
            .collect();
        let end = rest.find([')', '*']).unwrap_or(rest.len());
        let mut words = rest[..end].split_whitespace();
        let (Some(key), Some(name)) = (words.next(), words.next()) else {
            continue;
        };
        match key.to_ascii_lowercase().as_str() {
            "dialect" => found.dialect = found.dialect.or(Some(name.to_ascii_lowercase())),
            "machine" if found.machine.is_none() => {
                found.machine = Some(name.to_owned());
                found.machine_line = number;
            }
            _ => {}
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_comment_mark_will_do() {
        let all = modeline(b"%\n(TRUNNION: dialect LinuxCNC)\n; trunnion: machine samples/my.toml\nG1 X1\n");
        assert_eq!(
            all,
            Modeline {
                dialect: Some("linuxcnc".into()),
                machine: Some("samples/my.toml".into()),
                machine_line: 3
            }
        );
        assert_eq!(
            modeline(b"$$ trunnion: dialect apt\r\n").dialect.as_deref(),
            Some("apt")
        );
        assert_eq!(modeline(b"/* trunnion: machine m */").machine.as_deref(), Some("m"));
        assert_eq!(
            modeline(b"(trunnion: tool 1 ball diameter 10)\n(trunnion: dialect)"),
            Modeline::default()
        );
        assert_eq!(
            modeline(&[b"\n".repeat(10), b"(trunnion: dialect apt)".to_vec()].concat()),
            Modeline::default()
        );
        assert_eq!(
            modeline("\u{130}\u{e4}(trunnion: machine m)".as_bytes())
                .machine
                .as_deref(),
            Some("m")
        );
    }
}
