#!/usr/bin/env bash
# The npm package: builds the checker for WebAssembly and puts npm/trunnion.wasm and npm/playground.html there. PROFILE=dist (default) or release.
# Needs the target wasm32-unknown-unknown (rustup target add) and Node 18 or newer.
set -euo pipefail
cd "$(dirname "$0")/.."
profile=${PROFILE:-dist}
target=wasm32-unknown-unknown
# a main thread has 8 MB of stack elsewhere, too
cargo rustc --locked --profile "$profile" --target "$target" -p trunnion-wasm --lib --crate-type cdylib -- -C link-arg=-zstack-size=8388608 -C strip=symbols
node npm/build.mjs "${CARGO_TARGET_DIR:-target}/$target/$profile/trunnion_wasm.wasm"
ls -l npm/trunnion.wasm
