//! All tests of the whole program in one binary: one link instead of many. `cargo test --test all NAME` runs those whose path has NAME in it.
mod canon;
mod cli;
mod differential;
mod generated_docs;
mod generated_grammar;
mod generated_pages;
mod generated_rewrite_docs;
mod guide_vane;
mod independent;
mod lsp;
mod lsp_client;
mod mutations;
mod real_files;
mod rewrites;
mod rules;
mod samples;
mod tidy;
