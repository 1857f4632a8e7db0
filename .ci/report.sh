#!/usr/bin/env bash
# The page of `report` on all samples in headless Chromium: no error of a script, no window that moves sideways (a phone of 390 pixels, a desk), a replay that
# draws, plays and turns, texts that are legible in light and in dark (.ci/report.mjs, with Node), and a PDF. Needs a built `trunnion` (TRUNNION_BIN, default target/debug/trunnion) and Chromium (CHROMIUM names another browser).
set -euo pipefail
cd "$(dirname "$0")/.."
binary=$(realpath "${TRUNNION_BIN:-target/debug/trunnion}")
browser=${CHROMIUM:-chromium}
if ! command -v "$browser" >/dev/null; then
  echo "report: SKIPPED: Chromium is not installed (CHROMIUM names another browser)"
  exit 0
fi
scratch=$(mktemp -d "${TMPDIR:-/tmp}/trunnion-report.XXXXXX")
trap 'rm -rf "$scratch"' EXIT
run() {
  timeout 120 "$browser" --headless --no-sandbox --disable-gpu --allow-file-access-from-files --user-data-dir="$scratch/profile" \
    --virtual-time-budget=20000 "$@" 2>/dev/null
}

status=0
"$binary" report samples -o "$scratch/page.html" --quiet || status=$?
[ "$status" = 1 ] || { echo "report: ended with status $status instead of 1"; exit 1; }

cat >"$scratch/look.html" <<'HTML'
<!doctype html><meta charset="utf-8"><body><script>
const told = [];
const sum = (canvas) => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.reduce((all, byte, at) => (all + byte * (at % 251)) % 1e9, 0);
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
const look = (width) => new Promise((done) => {
  const frame = document.createElement("iframe");
  frame.style = `width:${width}px;height:900px;border:0`;
  frame.addEventListener("load", async () => {
    const page = frame.contentDocument, root = page.documentElement;
    if (root.scrollWidth > root.clientWidth) told.push(`a window of ${width} pixels moves sideways: ${root.scrollWidth}`);
    const replays = [...page.querySelectorAll(".replay")];
    if (replays.length < 5) told.push(`${replays.length} replays`);
    for (const replay of replays) {
      const canvas = replay.querySelector("canvas"), name = replay.closest("article").querySelector("h2").textContent;
      const blank = document.createElement("canvas");
      [blank.width, blank.height] = [canvas.width, canvas.height];
      const first = sum(canvas);
      if (first === sum(blank)) told.push(`${name}: the replay is blank`);
      if (!/^Line \d+, .* tip .* (mm|in); joints /.test(replay.querySelector(".state").textContent)) told.push(`${name}: ${replay.querySelector(".state").textContent}`);
      const press = (what) => replay.querySelector(`[data-do="${what}"]`).click();
      press("top");
      const top = sum(canvas);
      press("front");
      if (top === first && sum(canvas) === top) told.push(`${name}: the views are the same`);
    }
    const one = replays[0], slider = one.querySelector("input"), from = Number(slider.value);
    one.querySelector('[data-do="play"]').click();
    await wait(400);
    if (!(Number(slider.value) > from)) told.push(`Play does not play: ${from}, ${slider.value}`);
    done(replays.length);
  });
  frame.src = "page.html";
  document.body.append(frame);
  frame.contentWindow.addEventListener("error", (event) => told.push(event.message));
});
(async () => {
  const counts = [];
  for (const width of [390, 1200]) counts.push(await look(width));
  document.title = "looked";
  document.body.innerHTML = `<pre id="told">${told.length ? told.join("\n") : `all well: ${counts.join(" and ")} replays`}</pre>`;
})();
</script>
HTML
said=$(run --dump-dom "file://$scratch/look.html" | sed -n 's/.*<pre id="told">\(.*\)/\1/p' | sed 's/<\/pre>.*//')
case $said in
"all well"*) echo "report: $said" ;;
*) echo "report: ${said:-the page says nothing}"; exit 1 ;;
esac

if command -v node >/dev/null; then
  CHROMIUM=$browser node .ci/report.mjs "$scratch/page.html"
else
  echo "report: light and dark are NOT TESTED: Node is not installed"
fi

run --no-pdf-header-footer --print-to-pdf="$scratch/page.pdf" "file://$scratch/page.html" || true
[ "$(head -c 5 "$scratch/page.pdf")" = "%PDF-" ] || { echo "report: no PDF"; exit 1; }
echo "report: the PDF has $(wc -c <"$scratch/page.pdf") bytes"
