#!/bin/bash
# The packaged extension with the real server in a real VS Code: tests/e2e/run.sh [SUITE...]
# Suites: workbench newcomer host (the default, as in CI), large (a program of 400 000 lines, and one of 51 MB).
# TRUNNION_VSCODE: 1.139.1 (the default), or 1.100.3, the oldest that is tested. TRUNNION_RECORD: a file for the messages of the editor.
# Needs: npm ci done here, chromium, python3, and a built `trunnion` (TRUNNION_BIN, else the newer of ../target/release and debug).
# TRUNNION_VSCODE_LAB: where VS Code is installed (kept). TRUNNION_SHOTS: where the screenshots go.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
extension=$(cd "$here/../.." && pwd)
export LAB=${TRUNNION_VSCODE_LAB:-$HOME/.cache/trunnion-vscode}
export SHOTS=${TRUNNION_SHOTS:-$LAB/shots}
export CHROMIUM=${CHROMIUM:-$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)}
[ -n "$CHROMIUM" ] || { echo "e2e: no chromium (apt-get install chromium, or set CHROMIUM)"; exit 1; }

RUN=$(mktemp -d "${TMPDIR:-/tmp}/trunnion-e2e.XXXXXX")
export RUN
server=
stop() {
  if [ -n "$server" ]; then
    kill -TERM -- "-$server" 2>/dev/null || true
    for _ in $(seq 1 20); do kill -0 -- "-$server" 2>/dev/null || break; sleep 0.1; done
    kill -KILL -- "-$server" 2>/dev/null || true
    server=
  fi
}
finish() {
  stop
  rm -rf "$RUN"
}
trap finish EXIT
trap 'exit 130' INT TERM

version=${TRUNNION_VSCODE:-1.139.1}
case $version in
  1.139.1) node=$LAB/n24/bin home=$LAB/cs driver="--vscode-option enable-smoke-test-driver" ;;
  # takes the tests of the extension host without being asked to
  1.100.3) node=$(dirname "$(command -v node)") home=$LAB/cs100 driver= ;;
  *) echo "e2e: TRUNNION_VSCODE is 1.139.1 or 1.100.3"; exit 2 ;;
esac

code() {
  PATH="$node:$PATH" node "$home/node_modules/code-server/out/node/entry.js" --config "$RUN/config.yaml" \
    --user-data-dir "$RUN/data" --extensions-dir "$RUN/extensions" "$@"
}

# Starts the server on a port that the system chooses; sets PORT.
start() {
  local try
  for try in 1 2 3; do
    : >"$RUN/server.log"
    # shellcheck disable=SC2086
    PATH="$node:$PATH" setsid node "$home/node_modules/code-server/out/node/entry.js" --config "$RUN/config.yaml" \
      --user-data-dir "$RUN/data" --extensions-dir "$RUN/extensions" --auth none --bind-addr 127.0.0.1:0 \
      --disable-telemetry --disable-update-check --disable-workspace-trust --disable-getting-started-override \
      --ignore-last-opened $driver >"$RUN/server.log" 2>&1 </dev/null &
    server=$!
    for _ in $(seq 1 120); do
      PORT=$(sed -n 's|.*HTTP server listening on http://127\.0\.0\.1:\([0-9]*\).*|\1|p' "$RUN/server.log" | head -n 1)
      if [ -n "$PORT" ] && curl --silent --max-time 2 --output /dev/null "http://127.0.0.1:$PORT/healthz"; then
        export PORT
        return 0
      fi
      kill -0 "$server" 2>/dev/null || break
      sleep 0.25
    done
    echo "e2e: code-server did not start (attempt $try):"
    cat "$RUN/server.log"
    stop
  done
  return 1
}

# The workspace: copies of the programs, so that no test can change the originals, and each test file starts anew.
workspace() {
  rm -rf "$RUN/work"
  mkdir -p "$RUN/work/.vscode"
  cp "$here"/programs/* "$RUN/work/"
  if [ "$1" = host ]; then
    cp "$extension/../samples/machines/mill-3axis.toml" "$RUN/work/ours.toml"
    printf '[package]\nname = "G1 X1"\n' >"$RUN/work/other.toml"
  fi
  echo '{ "trunnion.machine": "mikron-ucp710" }' >"$RUN/work/.vscode/settings.json"
  # a new user has none
  [ "$1" != newcomer ] || rm -r "$RUN/work/.vscode"
}

test_with() {
  local name=$1 limit=$2
  workspace "$name"
  timeout --kill-after=15 "$limit" node "$here/$name.mjs" && return 0
  echo "e2e: $name failed; the end of the server's log:"
  tail -n 30 "$RUN/server.log"
  return 1
}

bash "$here/lab.sh" "$LAB" "$version"
mkdir -p "$RUN/data/User" "$RUN/extensions" "$SHOTS"
: >"$RUN/config.yaml"
cp "$here/settings.json" "$RUN/data/User/settings.json"
(cd "$extension" && timeout 120 scripts/package.sh "$RUN/trunnion.vsix")
timeout 120 bash -c "$(declare -p node home); $(declare -f code); code --install-extension '$RUN/trunnion.vsix'" || { echo "e2e: the .vsix does not install"; exit 1; }
PACKED=$(find "$RUN/extensions" -mindepth 1 -maxdepth 1 -type d -name 'trunnion.trunnion-*' | head -n 1)
export PACKED
if [ -n "${TRUNNION_RECORD:-}" ]; then
  export TRUNNION_TEE_PROGRAM=$PACKED/server/trunnion TRUNNION_TEE_FILE=$TRUNNION_RECORD TRUNNION_TEE_ROOT=$RUN/work
  rm -f "$TRUNNION_RECORD"
  node -e 'const fs = require("fs"), [file, path] = process.argv.slice(1); fs.writeFileSync(file, JSON.stringify({ ...JSON.parse(fs.readFileSync(file)), "trunnion.path": path }))' \
    "$RUN/data/User/settings.json" "$extension/../scripts/lsp_tee.py"
fi
start
failed=0
for suite in "${@:-workbench newcomer host}"; do
  for name in $suite; do
    test_with "$name" 240 || failed=1
  done
done
echo "e2e: screenshots in $SHOTS"
exit $failed
