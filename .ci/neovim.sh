#!/usr/bin/env bash
# The configuration for Neovim, in a Neovim without a screen. Installs Debian's (seconds); without apt-get and Neovim the test says that it is skipped.
set -euo pipefail
cd "$(dirname "$0")/.."
if ! command -v nvim >/dev/null && command -v apt-get >/dev/null; then
  sudo=
  [ "$(id -u)" -eq 0 ] || sudo="sudo -n"
  export DEBIAN_FRONTEND=noninteractive
  { $sudo apt-get -o DPkg::Lock::Timeout=240 update -q && $sudo apt-get -o DPkg::Lock::Timeout=240 install -y -q --no-install-recommends neovim; } \
    >"${TMPDIR:-/tmp}/trunnion-neovim.log" 2>&1 || tail -5 "${TMPDIR:-/tmp}/trunnion-neovim.log"
fi
bash integrations/neovim/test/run.sh
