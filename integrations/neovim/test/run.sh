#!/usr/bin/env bash
# Opens programs in a headless Neovim (0.7 or newer; NVIM names another than the one on PATH) with the built `trunnion`.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
nvim=${NVIM:-nvim}
if ! command -v "$nvim" >/dev/null; then
  echo "skipped: there is no $nvim (apt-get install neovim)"
  exit 0
fi
TRUNNION_BIN=${TRUNNION_BIN:-$(ls -t "$root"/target/{release,debug}/trunnion 2>/dev/null | head -1 || true)}
if [ ! -x "$TRUNNION_BIN" ]; then
  echo "skipped: there is no built trunnion (cargo build)"
  exit 0
fi
scratch=$(mktemp -d "${TMPDIR:-/tmp}/trunnion-neovim.XXXXXX")
trap 'rm -rf "$scratch"' EXIT
"$nvim" --version | head -1
export TRUNNION_BIN TRUNNION_PLUGIN="$here/.." TRUNNION_TEST_FOLDER=$scratch
export XDG_STATE_HOME=$scratch/state XDG_DATA_HOME=$scratch/data XDG_CONFIG_HOME=$scratch/config XDG_CACHE_HOME=$scratch/cache
timeout 300 "$nvim" --headless -u NONE -i NONE -c "luafile $here/editor.lua" 2>&1 | sed -e 's/\r//g' -e '/^$/d'
