#!/bin/bash
# The packaged extension with the real server in a real VS Code: tests/e2e/run.sh
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

code() {
  PATH="$LAB/n24/bin:$PATH" node "$LAB/cs/node_modules/code-server/out/node/entry.js" --config "$RUN/config.yaml" \
    --user-data-dir "$RUN/data" --extensions-dir "$RUN/extensions" "$@"
}

# Starts the server on a port that the system chooses; sets PORT.
start() {
  local try
  for try in 1 2 3; do
    : >"$RUN/server.log"
    PATH="$LAB/n24/bin:$PATH" setsid node "$LAB/cs/node_modules/code-server/out/node/entry.js" --config "$RUN/config.yaml" \
      --user-data-dir "$RUN/data" --extensions-dir "$RUN/extensions" --auth none --bind-addr 127.0.0.1:0 \
      --disable-telemetry --disable-update-check --disable-workspace-trust --disable-getting-started-override \
      --ignore-last-opened --vscode-option enable-smoke-test-driver >"$RUN/server.log" 2>&1 </dev/null &
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
  echo '{ "trunnion.machine": "mikron-ucp710" }' >"$RUN/work/.vscode/settings.json"
}

test_with() {
  local name=$1 limit=$2
  workspace
  timeout --kill-after=15 "$limit" node "$here/$name.mjs" && return 0
  echo "e2e: $name failed; the end of the server's log:"
  tail -n 30 "$RUN/server.log"
  return 1
}

bash "$here/lab.sh" "$LAB"
mkdir -p "$RUN/data/User" "$RUN/extensions" "$SHOTS"
: >"$RUN/config.yaml"
cp "$here/settings.json" "$RUN/data/User/settings.json"
(cd "$extension" && timeout 120 scripts/package.sh "$RUN/trunnion.vsix")
timeout 120 bash -c "$(declare -f code); code --install-extension '$RUN/trunnion.vsix'" || { echo "e2e: the .vsix does not install"; exit 1; }
PACKED=$(find "$RUN/extensions" -mindepth 1 -maxdepth 1 -type d -name 'trunnion.trunnion-*' | head -n 1)
export PACKED
start
failed=0
test_with workbench 150 || failed=1
test_with host 150 || failed=1
echo "e2e: screenshots in $SHOTS"
exit $failed
