//! Lexer of ISO words.
