#!/usr/bin/env bash
# The floors that touch nothing of the world compile for WebAssembly, where there are no files, processes or clocks.
# Skipped, with a message, where the target is not installed and cannot be had.
set -euo pipefail
cd "$(dirname "$0")/.."
target=wasm32-unknown-unknown
floors="syntax geometry pieces formula vocabulary dialect flow ngc interp machine same servo planner stats certify diff surface check layout plot scene ide rewrite convert"

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
