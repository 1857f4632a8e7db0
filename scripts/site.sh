#!/usr/bin/env bash
# Builds the documentation site into target/site (or the folder given) and checks all links between its pages. Needs mdBook 0.5 and Python 3.
# TRUNNION_REPOSITORY=https://host/owner/trunnion/blob/main lets links to tables, samples and sources lead there; without it they are plain text.
set -euo pipefail
out=$(realpath -m "${1:-$(dirname "$0")/../target/site}")
cd "$(dirname "$0")/.."
if ! command -v mdbook >/dev/null; then
  echo "mdBook is not installed: cargo install mdbook --locked" >&2
  exit 2
fi
mdbook build --dest-dir "$out"
python3 scripts/site_check.py "$out"
