//! What a rule file imports.
