#!/bin/bash
# Packages the extension with a `trunnion` program inside: scripts/package.sh [OUT.vsix]
# The program: TRUNNION_BIN, else the newest of ../target/dist, release and debug.
set -euo pipefail
cd "$(dirname "$0")/.."

program=${TRUNNION_BIN:-}
for candidate in ../target/dist/trunnion ../target/release/trunnion ../target/debug/trunnion; do
  if [ -z "${TRUNNION_BIN:-}" ] && [ -x "$candidate" ] && { [ -z "$program" ] || [ "$candidate" -nt "$program" ]; }; then
    program=$candidate
  fi
done
if [ -z "$program" ] || [ ! -x "$program" ]; then
  echo "package: no trunnion program (${program:-build one with: cargo build --profile dist})" >&2
  exit 1
fi

target=$(node -p 'process.platform + "-" + process.arch')
out=${1:-trunnion-$target.vsix}
echo "package: with $program"
rm -rf server && mkdir server
cp "$program" server/trunnion
strip server/trunnion 2>/dev/null || true # smaller; where there is no strip it is only larger
chmod 755 server/trunnion
npx --no-install vsce package --target "$target" --no-dependencies --allow-missing-repository --no-rewrite-relative-links --out "$out"
