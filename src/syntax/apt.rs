//! Lexer of APT / CL records.
