// The page of `report` in headless Chromium, in light and in dark: node .ci/report.mjs PAGE. PICTURES=FOLDER keeps pictures.
import { writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser } from "../npm/test/browser.mjs";
import { legibleInBoth } from "../npm/test/legible.mjs";

/** Runs in the page: how light pictures and replays are in their corner, 0 to 1, and how much lighter or darker the lines of a replay are. */
function drawings() {
  const light = (r, g, b) => (r + g + b) / 765;
  const inverted = [...document.querySelectorAll("figure svg")].map((svg) => getComputedStyle(svg).filter.includes("invert"));
  const replays = [...document.querySelectorAll(".replay canvas")].map((canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const paper = light(data[0], data[1], data[2]);
    let apart = 0;
    for (let at = 0; at < data.length; at += 4) apart = Math.max(apart, Math.abs(light(data[at], data[at + 1], data[at + 2]) - paper));
    return { paper, apart };
  });
  return { inverted, replays };
}

const browser = new Browser();
try {
  const page = await browser.page(pathToFileURL(resolve(process.argv[2])).href);
  await page.shows(/Report of trunnion/);
  await page.loaded();
  let count = 0;
  for (const scheme of ["dark", "light"]) {
    await page.scheme(scheme);
    const { inverted, replays } = await page.value(`(${drawings})()`);
    const dark = scheme === "dark";
    count = inverted.length;
    if (!count || inverted.some((one) => one !== dark)) throw new Error(`${scheme}: ${inverted.filter((one) => one !== dark).length} of ${count} pictures are not ${scheme}`);
    const wrong = replays.filter(({ paper, apart }) => paper < 0.5 !== dark || apart < 0.4);
    if (!replays.length || wrong.length) throw new Error(`${scheme}: ${wrong.length} of ${replays.length} replays: ${JSON.stringify(wrong.slice(0, 3))}`);
    if (process.env.PICTURES) writeFileSync(join(process.env.PICTURES, `report-${scheme}.png`), await page.picture());
  }
  await legibleInBoth(page);
  console.log(`report: light and dark: all texts are legible, ${count} pictures follow`);
} catch (error) {
  console.log(`report: ${error.message}`);
  process.exitCode = 1;
} finally {
  await browser.close();
}
