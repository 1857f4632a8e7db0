#!/usr/bin/env bash
# Licences, banned crates and origins of all dependencies (deny.toml), by cargo-deny. Advisories where RustSec's database can be reached.
set -euo pipefail
cd "$(dirname "$0")/.."
version=0.20.2
if [ "$(cargo deny --version 2>/dev/null || true)" != "cargo-deny $version" ]; then
  # unoptimised: it runs for a second, and compiling it takes a third of the time so
  CARGO_PROFILE_RELEASE_OPT_LEVEL=0 CARGO_PROFILE_RELEASE_LTO=off CARGO_PROFILE_RELEASE_STRIP=none CARGO_PROFILE_RELEASE_DEBUG=false \
    cargo install --quiet --locked cargo-deny --version "$version"
fi
cargo deny --locked check licenses bans sources
if timeout 60 cargo deny --locked fetch db 2>/dev/null; then
  cargo deny --locked check advisories
else
  echo "advisories: NOT CHECKED: RustSec's database of advisories cannot be reached from here"
fi
