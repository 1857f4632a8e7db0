#!/usr/bin/env bash
# The floors that touch nothing of the world compile for WebAssembly, where there are no files, processes or clocks. The checker for browsers
# (src/wasm, npm) is built and compared with the command line on all samples, in Node and in headless Chromium.
# Needs Node 20 and a built `trunnion` (TRUNNION_BIN, default target/debug/trunnion). Skipped, with a message, where the target is not installed and cannot be had.
set -euo pipefail
cd "$(dirname "$0")/.."
target=wasm32-unknown-unknown
floors="syntax geometry pieces formula vocabulary dialect flow ngc interp machine same servo planner stats certify diff surface check layout plot scene ide rewrite convert document wasm"

installed() { [ -d "$(rustc --print sysroot)/lib/rustlib/$target/lib" ]; }
if ! installed && command -v rustup >/dev/null; then
  rustup target add "$target" || true
fi
if ! installed; then
  echo "wasm32: SKIPPED: this toolchain has no standard library for $target (rustup target add $target)"
  exit 0
fi
packages=()
for floor in $floors; do packages+=(-p "trunnion-$floor"); done
cargo check --locked --target "$target" "${packages[@]}"
echo "wasm32: these floors compile: $floors"

if ! command -v node >/dev/null; then
  echo "wasm32: the package is NOT TESTED: Node is not installed"
  exit 0
fi
if [ -z "${TRUNNION_BIN:-}" ] && [ ! -x target/debug/trunnion ]; then
  cargo build --locked --bin trunnion
fi
# hardly optimised, like the build that the tests run: compiling takes a third of the time so
CARGO_PROFILE_RELEASE_OPT_LEVEL=1 PROFILE=release bash scripts/wasm.sh
(cd npm && node --test test/node.test.mjs)
if command -v "${CHROMIUM:-chromium}" >/dev/null; then
  node npm/test/page.mjs
else
  echo "wasm32: the pages are NOT TESTED: Chromium is not installed (CHROMIUM names another browser)"
fi
