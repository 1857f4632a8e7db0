#!/usr/bin/env bash
# The hook of .pre-commit-hooks.yaml in the real pre-commit: a bad program stops a commit, and its baseline lets it pass. Only the installation is left out:
# the hook takes the built `trunnion` (TRUNNION_BIN, default target/debug/trunnion). Needs git, Python 3 with venv and a package index.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
binary=$(realpath "${TRUNNION_BIN:-target/debug/trunnion}")
scratch=$(mktemp -d "${TMPDIR:-/tmp}/trunnion-pre-commit.XXXXXX")
trap 'rm -rf "$scratch"' EXIT
export PRE_COMMIT_HOME=$scratch/home GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_SYSTEM=/dev/null
export GIT_AUTHOR_NAME=ci GIT_AUTHOR_EMAIL=ci@example.org GIT_COMMITTER_NAME=ci GIT_COMMITTER_EMAIL=ci@example.org
python3 -m venv "$scratch/venv"
"$scratch/venv/bin/pip" --quiet --disable-pip-version-check install 'pre-commit>=4,<5'
mkdir "$scratch/bin" && ln -s "$binary" "$scratch/bin/trunnion"
export PATH=$scratch/bin:$scratch/venv/bin:$PATH

git init -q "$scratch/hooks" && cd "$scratch/hooks"
sed 's/^  language: rust$/  language: system/' "$root/.pre-commit-hooks.yaml" >.pre-commit-hooks.yaml
grep -q 'language: system' .pre-commit-hooks.yaml
git add -A && git commit -qm hooks

git init -q "$scratch/shop" && cd "$scratch/shop"
mkdir programs
printf '%%\nO1\nG17 G21 G90 G94\nT1 M6\nG54 G0 X0. Y0.\nG43 H1 Z-10.\nG1 X10.\nM30\n%%\n' >programs/bad.NC
printf 'machine = "mill-3axis"\n' >programs/trunnion.toml
printf 'repos:\n  - repo: %s\n    rev: %s\n    hooks:\n      - id: trunnion-check\n' "$scratch/hooks" "$(git -C "$scratch/hooks" rev-parse HEAD)" >.pre-commit-config.yaml
pre-commit install >/dev/null
git add -A
if git commit -qm bad 2>commit.log; then echo "pre-commit: a bad program was committed"; exit 1; fi
grep -q 'bad.NC:7:4: error\[missing-feed\]' commit.log || { cat commit.log; exit 1; }
echo "pre-commit: a bad program stops the commit"
trunnion check programs --quiet --write-baseline programs/baseline.json >/dev/null
printf '        args: [--baseline, programs/baseline.json]\n' >>.pre-commit-config.yaml
git add -A
git commit -qm accepted 2>commit.log || { cat commit.log; exit 1; }
echo "pre-commit: its baseline lets it pass"
