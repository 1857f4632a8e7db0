//! What the lexers and the items promise, seen from outside.
mod apt_records;
mod files;
mod iso_items;
mod lines;
mod lossless;
mod numbers;
mod osp;
mod show;
