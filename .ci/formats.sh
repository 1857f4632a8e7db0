#!/usr/bin/env bash
# What other tools make of the formats of `check`, on all samples: SARIF in the SARIF multitool (which holds the official schema) and in the viewer component
# of Azure DevOps in headless Chromium, JUnit against its schema and in junitparser. Needs a built `trunnion` (TRUNNION_BIN, default target/debug/trunnion), Node 20, Python 3 with venv,
# Chromium, and the registries of npm and Python.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
binary=$(realpath "${TRUNNION_BIN:-target/debug/trunnion}")
scratch=$(mktemp -d "${TMPDIR:-/tmp}/trunnion-formats.XXXXXX")
trap 'rm -rf "$scratch"' EXIT

for format in json sarif junit; do
  status=0
  "$binary" check samples --format "$format" -o "$scratch/samples.$format" 2>/dev/null || status=$?
  [ "$status" = 1 ] || { echo "formats: check --format $format ended with status $status instead of 1"; exit 1; }
done
findings=$(python3 -c 'import json, sys; print(sum(len(f["diagnostics"]) for f in json.load(open(sys.argv[1]))["files"]))' "$scratch/samples.json")

cd "$scratch"
npm init -y >/dev/null
npm install --silent --no-audit --no-fund --ignore-scripts -E @microsoft/sarif-multitool@5.7.0 @microsoft/sarif-multitool-linux@5.7.0 \
  @microsoft/sarif-web-component@0.6.0-29 react@16.14.0 react-dom@16.14.0 esbuild@0.28.2
multitool=node_modules/@microsoft/sarif-multitool-linux/Sarif.Multitool
chmod u+x "$multitool"
# no result of kind fail and level error may be left: the schema, and the rules of the standard
DOTNET_SYSTEM_GLOBALIZATION_INVARIANT=1 "$multitool" validate samples.sarif --output validated.sarif >multitool.log || { cat multitool.log; exit 1; }
if grep -E ': error ' multitool.log; then exit 1; fi
echo "formats: the SARIF multitool has no error"

cat >app.jsx <<'APP'
import * as React from "react";
import * as ReactDOM from "react-dom";
import { Viewer } from "@microsoft/sarif-web-component";
import log from "./samples.json";
ReactDOM.render(<Viewer logs={[log]} />, document.getElementById("root"));
APP
cp samples.sarif samples.json
node_modules/.bin/esbuild app.jsx --bundle --outfile=app.js --define:process.env.NODE_ENV='"production"' --log-level=error
echo '<!doctype html><meta http-equiv="content-type" content="text/html; charset=utf-8"><div id="root"></div><script src="app.js"></script>' >index.html
"${CHROMIUM:-chromium}" --headless --no-sandbox --disable-gpu --user-data-dir="$scratch/profile" --virtual-time-budget=20000 --dump-dom "file://$scratch/index.html" >dom.html 2>/dev/null
shown=$(grep -o 'trunnion<div class="bolt-pill[^>]*>.\{0,80\}role="presentation">[0-9]*<' dom.html | head -1 | grep -o '[0-9]*<$' | tr -d '<')
[ "$shown" = "$findings" ] || { echo "formats: the viewer shows ${shown:-nothing} of $findings results"; exit 1; }
echo "formats: the SARIF viewer shows all $findings results"

python3 -m venv venv
venv/bin/pip --quiet --disable-pip-version-check install 'junitparser>=4,<6' 'xmlschema>=4,<5'
venv/bin/python - samples.junit "$root/tests/schemas/junit.xsd" <<'PYTHON'
import sys
from junitparser import Failure, JUnitXml, Skipped
xml = JUnitXml.fromfile(sys.argv[1])
written = (xml.tests, xml.failures, xml.skipped, xml.errors)
cases = [case for suite in xml for case in suite]
counted = (len(cases), sum(any(isinstance(r, Failure) for r in c.result) for c in cases), sum(any(isinstance(r, Skipped) for r in c.result) for c in cases))
xml.update_statistics()
again = (xml.tests, xml.failures, xml.skipped, xml.errors)
assert written == again and counted == again[:3] and again[1] > 0 and again[2] > 0, (written, counted, again)
import xmlschema
xmlschema.XMLSchema(sys.argv[2]).validate(sys.argv[1])
print("formats: the JUnit report obeys tests/schemas/junit.xsd")
print(f"formats: junitparser reads {again[0]} cases, {again[1]} failures, {again[2]} skipped")
PYTHON
