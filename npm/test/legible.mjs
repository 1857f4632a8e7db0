// Light and dark: what is too pale to read on a page. WCAG 2.2, criterion 1.4.3: a contrast of 4.5 to 1, of 3 to 1 for large texts.

/** Runs in the page: how light its paper is, 0 to 1, and a line for each text without contrast, at most 20. */
function illegible() {
  const pen = Object.assign(document.createElement("canvas"), { width: 1, height: 1 }).getContext("2d", { willReadFrequently: true });
  const read = (colour) => {
    pen.clearRect(0, 0, 1, 1);
    pen.fillStyle = colour;
    pen.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = pen.getImageData(0, 0, 1, 1).data;
    return [r, g, b, a / 255];
  };
  const over = (above, below) => [0, 1, 2].map((i) => above[i] * above[3] + below[i] * (1 - above[3])).concat(1);
  const paper = () => read(matchMedia("(prefers-color-scheme: dark)").matches ? "#121212" : "#ffffff");
  const ground = (element) => {
    const layers = [];
    for (let at = element; at; at = at.parentElement) layers.push(read(getComputedStyle(at).backgroundColor));
    return layers.reverse().reduce((below, above) => over(above, below), paper());
  };
  const light = ([r, g, b]) => {
    const [x, y, z] = [r, g, b].map((v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * x + 0.7152 * y + 0.0722 * z;
  };
  const told = [];
  for (const element of document.body.querySelectorAll("*")) {
    const own = [...element.childNodes].filter((node) => node.nodeType === Node.TEXT_NODE).map((node) => node.data.trim()).join(" ").trim();
    const text = own || (element.matches("textarea, select, input:not([type=range], [type=checkbox], [type=radio])") ? element.value : "");
    if (!text || element.closest("svg, script, style, noscript, template, [disabled]") || !element.checkVisibility?.()) continue;
    const style = getComputedStyle(element);
    let opacity = 1;
    for (let at = element; at; at = at.parentElement) opacity *= Number(getComputedStyle(at).opacity);
    const behind = ground(element);
    const ink = read(style.color);
    const [a, b] = [light(over([ink[0], ink[1], ink[2], ink[3] * opacity], behind)), light(behind)];
    const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    const size = parseFloat(style.fontSize);
    const wanted = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700) ? 3 : 4.5;
    if (contrast < wanted) told.push(`${element.tagName.toLowerCase()} "${text.slice(0, 40)}": ${contrast.toFixed(2)} to 1`);
  }
  return { paper: light(ground(document.body)), told: told.slice(0, 20) };
}

/** Throws unless every text of the page is legible in light and in dark, and the paper is light or dark as wanted. Ends in light. */
export async function legibleInBoth(page) {
  for (const scheme of ["dark", "light"]) {
    await page.scheme(scheme);
    const { paper, told } = await page.value(`(${illegible})()`);
    if (paper < 0.2 !== (scheme === "dark")) throw new Error(`${scheme}: the luminance of the paper is ${paper}`);
    if (told.length) throw new Error(`${scheme}: hard to read: ${told.join("; ")}`);
  }
}
