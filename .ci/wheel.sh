#!/usr/bin/env bash
# The Python wheel: built, installed in a clean environment in an empty folder, typed (mypy), and compared with the command line on all samples.
# PROFILE=dev (default) packs a quick build; scripts/release.sh packs the real one. Needs Python 3 with venv and a package index.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
profile=${PROFILE:-dev}
folder=$profile
[ "$profile" != dev ] || folder=debug
scratch=$(mktemp -d "${TMPDIR:-/tmp}/trunnion-wheel.XXXXXX")
trap 'rm -rf "$scratch"' EXIT
pip="pip --quiet --disable-pip-version-check"

python3 -m venv "$scratch/build"
"$scratch/build/bin/python" -m $pip install 'maturin>=1.7,<2'
[ -x "target/$folder/trunnion" ] || cargo build --locked --profile "$profile" --bin trunnion
# maturin links it anew, stripped, in the same place
cp "target/$folder/trunnion" "$scratch/trunnion"
(cd python && "$scratch/build/bin/maturin" build --locked --profile "$profile" --target-dir "$root/target" --out "$scratch/wheels")

python3 -m venv "$scratch/clean"
"$scratch/clean/bin/python" -m $pip install "$scratch"/wheels/*.whl mypy
mkdir "$scratch/empty" && cd "$scratch/empty"
"$scratch/clean/bin/trunnion" --version
"$scratch/clean/bin/mypy" --strict "$root/python/src/trunnion" "$root/python/tests/typed.py" "$root/python/tests/check_wheel.py"
"$scratch/clean/bin/python" -B "$root/python/tests/check_wheel.py" "$root" "$scratch/trunnion"
ls -sh "$scratch"/wheels/*.whl | sed 's/^/wheel: /'
