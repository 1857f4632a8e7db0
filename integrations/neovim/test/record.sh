#!/usr/bin/env bash
# Records a session of Neovim: record.sh FILE. The messages that the editor sends go into FILE (scripts/lsp_tee.py).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
record=$(realpath "$1")
scratch=$(mktemp -d "${TMPDIR:-/tmp}/trunnion-neovim.XXXXXX")
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/work"
cp "$root/vscode-extension/tests/e2e/programs/part.nc" "$scratch/work/"
echo 'machine = "mill-3axis"' >"$scratch/work/trunnion.toml"
rm -f "$record"
export TRUNNION_TEE_PROGRAM=${TRUNNION_BIN:-$(ls -t "$root"/target/{release,debug}/trunnion | head -1)} TRUNNION_TEE_FILE=$record TRUNNION_TEE_ROOT=$scratch/work
export TRUNNION_TEE=$root/scripts/lsp_tee.py TRUNNION_PLUGIN="$here/.." TRUNNION_TEST_FOLDER=$scratch/work
export XDG_STATE_HOME=$scratch/state XDG_DATA_HOME=$scratch/data XDG_CONFIG_HOME=$scratch/config XDG_CACHE_HOME=$scratch/cache
timeout 120 "${NVIM:-nvim}" --headless -u NONE -i NONE -c "luafile $here/session.lua"
