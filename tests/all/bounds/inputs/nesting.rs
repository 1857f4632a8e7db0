//! Depth: brackets, functions, operators, loops and branches inside each other.
use super::{Input, cut, lines, repeat};

fn around(open: &str, inside: &str, close: &str, size: usize) -> String {
    format!("{}{inside}{}", repeat(open, size), repeat(close, size))
}

#[expect(clippy::too_many_lines, reason = "it is one list")]
pub(super) fn inputs() -> Vec<Input> {
    vec![
        Input::new("brackets", |n| cut(&format!("#1={}", around("[", "1", "]", n)))),
        Input::new("brackets-of-a-word", |n| {
            cut(&format!("G1 X{}", around("[", "1", "]", n)))
        }),
        Input::new("brackets-open", |n| cut(&format!("#1={}", repeat("[", n)))),
        Input::new("brackets-close", |n| cut(&format!("#1=1{}", repeat("]", n)))),
        Input::new("parentheses", |n| cut(&format!("R1={}", around("(", "1", ")", n)))),
        Input::new("parentheses-open", |n| cut(&format!("R1={}", repeat("(", n)))),
        Input::new("apt-parentheses", |n| {
            format!("PARTNO\nGOTO/{}\nFINI\n", around("(", "1", ")", n)).into()
        }),
        Input::new("functions", |n| cut(&format!("#1={}", around("SIN[", "1", "]", n)))),
        Input::new("functions-of-words", |n| {
            cut(&format!("R1={}", around("SIN(", "1", ")", n)))
        }),
        Input::new("hashes", |n| cut(&format!("#1={}1", repeat("#", n)))),
        Input::new("hashes-in-brackets", |n| {
            cut(&format!("#1={}", around("#[", "1", "]", n)))
        }),
        Input::new("array-indices", |n| cut(&format!("R1={}", around("R[", "1", "]", n)))),
        Input::new("minus-signs", |n| {
            cut(&format!("#1={}1\nR1={}1", repeat("-", n), repeat("-", n)))
        }),
        Input::new("powers", |n| cut(&format!("#1=1{}", repeat("**2", n)))),
        Input::new("sums", |n| {
            cut(&format!("#1=1{}\nR1=1{}", repeat("+1", n / 2), repeat("+1", n / 2)))
        }),
        Input::new("products-and-sums", |n| cut(&format!("#1=[1{}]", repeat("+1*2", n)))),
        Input::new("not-not", |n| cut(&format!("R1={}1", repeat("NOT ", n)))),
        Input::new("strings-joined", |n| {
            cut(&format!("DEF STRING[9] S\nS=\"A\"{}", repeat("<<\"B\"", n)))
        }),
        Input::new("nested-while-do", |n| {
            cut(&format!(
                "{}{}",
                lines(n, |i| format!("WHILE[#1LT1]DO{}", i % 3 + 1)),
                lines(n, |i| format!("END{}", i % 3 + 1))
            ))
        }),
        Input::new("nested-o-while", |n| {
            cut(&format!(
                "{}{}",
                lines(n, |i| format!("o{i} while [#1 LT 1]")),
                lines(n, |i| format!("o{} endwhile", n - 1 - i))
            ))
        }),
        Input::new("nested-o-if", |n| {
            cut(&format!(
                "{}{}",
                lines(n, |i| format!("o{i} if [#1 LT 1]")),
                lines(n, |i| format!("o{} endif", n - 1 - i))
            ))
        }),
        Input::new("nested-o-if-known", |n| {
            cut(&format!(
                "{}{}",
                lines(n, |i| format!("o{i} if [1]")),
                lines(n, |i| format!("o{} endif", n - 1 - i))
            ))
        }),
        Input::new("nested-o-sub", |n| {
            cut(&format!(
                "{}{}",
                lines(n, |i| format!("o{i} sub")),
                lines(n, |i| format!("o{} endsub", n - 1 - i))
            ))
        }),
        Input::new("nested-o-repeat", |_| {
            cut(&format!(
                "{}G1 X1.\n{}",
                lines(12, |i| format!("o{i} repeat [1000]")),
                lines(12, |i| format!("o{} endrepeat", 11 - i))
            ))
        }),
        Input::new("nested-if", |n| {
            cut(&format!("{}{}", repeat("IF R1==1\n", n), repeat("ENDIF\n", n)))
        }),
        Input::new("nested-if-known", |n| {
            cut(&format!("{}{}", repeat("IF 1==1\n", n), repeat("ENDIF\n", n)))
        }),
        Input::new("nested-while", |n| {
            cut(&format!("{}{}", repeat("WHILE R1==1\n", n), repeat("ENDWHILE\n", n)))
        }),
        Input::new("nested-for", |n| {
            cut(&format!(
                "{}{}",
                lines(n, |i| format!("FOR R{i}=1 TO 9")),
                repeat("ENDFOR\n", n)
            ))
        }),
        Input::new("nested-loop", |n| {
            cut(&format!("{}{}", repeat("LOOP\n", n), repeat("ENDLOOP\n", n)))
        }),
        Input::new("nested-repeat-until", |n| {
            cut(&format!("{}{}", repeat("REPEAT\n", n), repeat("UNTIL 1==1\n", n)))
        }),
        Input::new("nested-then-if", |n| {
            cut(&format!("{}{}", repeat("IF[#1EQ1]THEN\n", n), repeat("ENDIF\n", n)))
        }),
        Input::new("nested-case", |n| {
            cut(&format!("{}{}", repeat("CASE R1 OF 1 GOTOF A\n", n), "A:"))
        }),
        Input::new("ends-without-begin", |n| {
            cut(&lines(n, |i| {
                [
                    "ENDIF",
                    "ENDWHILE",
                    "END1",
                    "o1 endif",
                    "o1 endsub",
                    "ENDLOOP",
                    "ENDFOR",
                ][i % 7]
                    .to_owned()
            }))
        }),
        Input::new("else-chain", |n| {
            cut(&format!(
                "o1 if [#1]\n{}o1 endif",
                repeat("o1 elseif [#2]\nG1 X1.\n", n)
            ))
        }),
        Input::new("comment-in-comment", |n| cut(&around("(", "x", ")", n))),
        Input::new("comment-open", |n| cut(&format!("({}", repeat("x (", n)))),
        Input::new("string-open", |n| cut(&format!("MSG(\"{}", repeat("x", n)))),
        Input::new("quotes", |n| cut(&repeat("\"", n))),
        Input::new("apt-nested-macro", |n| {
            format!(
                "PARTNO\n{}{}FINI\n",
                lines(n, |i| format!("M{i}=MACRO/A")),
                repeat("TERMAC\n", n)
            )
            .into()
        }),
        Input::new("apt-nested-loop", |n| {
            format!("PARTNO\n{}{}FINI\n", repeat("LOOPST\n", n), repeat("LOOPND\n", n)).into()
        }),
    ]
}
