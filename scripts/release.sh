#!/usr/bin/env bash
# Builds what can be built on this computer into a folder (default: target/release-files), and lists what cannot, with the reason.
# PROFILE=dist (default) takes minutes; PROFILE=dev packs a quick build to try this script. What has its tools here and cannot be built is a failure:
# the script builds the rest, names it at the end, and ends with status 1. The VS Code package wants Node 22; with Node 20 it is built with warnings.
set -euo pipefail
cd "$(dirname "$0")/.."
profile=${PROFILE:-dist}
out=${1:-target/release-files}
mkdir -p "$out" && out=$(cd "$out" && pwd)
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -1)
host=$(rustc -vV | sed -n 's/^host: //p')
rest=()
failed=()

cargo build --locked --profile "$profile" --bin trunnion
built=$(realpath "${CARGO_TARGET_DIR:-target}")
folder=$built/$profile
[ "$profile" != dev ] || folder=$built/debug
name=trunnion-$version-$host
rm -rf "$out/$name"
mkdir -p "$out/$name/completions"
cp "$folder/trunnion" README.md CHANGELOG.md LICENSE-APACHE LICENSE-MIT "$out/$name/"
"$folder/trunnion" man >"$out/$name/trunnion.1"
for shell in bash zsh fish powershell elvish; do "$folder/trunnion" completions "$shell" >"$out/$name/completions/trunnion.$shell"; done
cp -r grammar/schemas "$out/$name/schemas"
tar -C "$out" -czf "$out/$name.tar.gz" "$name"

if command -v maturin >/dev/null; then
  (cd python && maturin build --locked --profile "$profile" --out "$out") ||
    failed+=("Python wheel: maturin failed (see above)")
else
  rest+=("Python wheel: maturin is not installed (pip install maturin; then: cd python && maturin build --release)")
fi
if [ -d "$(rustc --print sysroot)/lib/rustlib/wasm32-unknown-unknown/lib" ] && command -v npm >/dev/null; then
  # a debug module is too large for a page
  PROFILE=$([ "$profile" = dev ] && echo release || echo "$profile") bash scripts/wasm.sh &&
    (cd npm && npm pack --silent --pack-destination "$out" >/dev/null) && cp npm/playground.html "$out/" ||
    failed+=("npm package: scripts/wasm.sh or npm pack failed (see above)")
else
  rest+=("npm package: needs npm and the target wasm32-unknown-unknown (rustup target add wasm32-unknown-unknown)")
fi
if command -v npm >/dev/null; then
  (cd vscode-extension && npm ci --no-audit --no-fund >/dev/null && TRUNNION_BIN=$folder/trunnion npm run --silent package >/dev/null) &&
    cp vscode-extension/*.vsix "$out/" || failed+=("VS Code package: npm failed in vscode-extension with Node $(node --version 2>/dev/null || echo "(none)") (see above; its packer wants Node 22)")
else
  rest+=("VS Code package: npm is not installed")
fi
if command -v mdbook >/dev/null; then
  bash scripts/site.sh "$out/site" >/dev/null && tar -C "$out" -czf "$out/trunnion-$version-site.tar.gz" site && rm -r "$out/site" || failed+=("documentation site: scripts/site.sh failed (see above)")
else
  rest+=("documentation site: mdBook is not installed (cargo install mdbook --locked; then: bash scripts/site.sh)")
fi
for target in x86_64-unknown-linux-gnu aarch64-unknown-linux-gnu x86_64-apple-darwin aarch64-apple-darwin x86_64-pc-windows-msvc; do
  [ "$target" = "$host" ] || rest+=("binary, Python wheel and VS Code package for $target: build them on such a computer with this script")
done

echo "built in $out:"
(cd "$out" && find . -maxdepth 1 -type f -exec sha256sum {} + | sort -k2)
echo "not built here:"
printf '  %s\n' "${rest[@]}"
if [ ${#failed[@]} -gt 0 ]; then
  echo "FAILED:" >&2
  printf '  %s\n' "${failed[@]}" >&2
  exit 1
fi
