#!/bin/bash
# The VS Code extension: types, manifest, grammars, the page of the backplot, the packaged .vsix, and the .vsix in a real VS Code.
# Needs Node 20 or newer, Python 3 with pip, and a built `trunnion` (TRUNNION_BIN, else the newer of target/release and
# target/debug; built here when there is none). Installs Debian packages when they are missing, and VS Code into
# ${TRUNNION_VSCODE_LAB:-$HOME/.cache/trunnion-vscode}, which is used again next time.
set -uo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root/vscode-extension" || exit 2
scratch=$(mktemp -d "${TMPDIR:-/tmp}/trunnion-ci.XXXXXX")
installing=
trap '[ -z "$installing" ] || kill "$installing" 2>/dev/null; rm -rf "$scratch"' EXIT
trap 'exit 130' INT TERM
passed=0
failed=0

# step NAME SECONDS COMMAND...: shows all that a failing step printed, and of a good one the lines that count.
step() {
  local name=$1 limit=$2 log=$scratch/log start=$SECONDS status
  shift 2
  timeout --kill-after=30 "$limit" "$@" >"$log" 2>&1 </dev/null
  status=$?
  if [ $status -eq 0 ]; then
    passed=$((passed + 1))
    grep -E '^(ok|not ok|✓) |passed, |^ℹ (pass|fail) |^lab: ' "$log" | sed 's/^/  /'
    echo "extension: $name: ok ($((SECONDS - start)) s)"
  else
    failed=$((failed + 1))
    cat "$log"
    echo "extension: $name: FAILED (exit status $status after $((SECONDS - start)) s, limit $limit s)"
  fi
  return $status
}

finish() {
  echo "extension: $passed passed, $failed failed"
  [ "$failed" -eq 0 ] || exit 1
  exit 0
}

# The browser, and what code-server's native modules are compiled with.
packages="chromium fonts-dejavu-core libkrb5-dev build-essential pkg-config curl util-linux"
python3 -m pip --version >/dev/null 2>&1 || packages="$packages python3-pip"
install_packages() {
  local sudo=
  [ "$(id -u)" -eq 0 ] || sudo="sudo -n"
  export DEBIAN_FRONTEND=noninteractive
  $sudo apt-get -o DPkg::Lock::Timeout=240 update -q &&
    $sudo apt-get -o DPkg::Lock::Timeout=240 install -y -q --no-install-recommends $packages
}
missing() {
  for package in $packages; do
    dpkg-query --show --showformat='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || return 0
  done
  return 1
}

if command -v apt-get >/dev/null && missing; then
  export packages
  export -f install_packages
  step "Debian packages" 300 bash -c install_packages || finish
fi
if [ -z "${TRUNNION_BIN:-}" ] && [ ! -x "$root/target/release/trunnion" ] && [ ! -x "$root/target/debug/trunnion" ]; then
  step "build of trunnion" 900 cargo build --manifest-path "$root/Cargo.toml" --bin trunnion || finish
fi

# VS Code is installed while the quick steps run: their work does not touch it
lab=${TRUNNION_VSCODE_LAB:-$HOME/.cache/trunnion-vscode}
timeout --kill-after=30 600 bash tests/e2e/lab.sh "$lab" >"$scratch/lab" 2>&1 </dev/null &
installing=$!

if step "npm ci" 180 npm ci --no-audit --no-fund; then
  step "types" 60 npm run --silent typecheck
  step "manifest" 60 npm run --silent test:manifest
  step "grammars" 60 npm run --silent test:grammar
  step "page of the backplot" 180 npm run --silent test:page
  # waits here; run.sh then finds it there, or says what is wrong with it
  wait "$installing" || cat "$scratch/lab"
  installing=
  step ".vsix in VS Code" 500 npm run --silent test:e2e
fi
finish
