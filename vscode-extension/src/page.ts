// The page of the backplot, without its script (src/webview).

/** Where the page finds its files, and what it may run. */
export interface Sources {
  script: string;
  style: string;
  /** The origin of the files, for the content security policy. */
  source: string;
  nonce: string;
}

export function page({ script, style, source, nonce }: Sources): string {
  return `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src ${source} 'unsafe-inline'; script-src 'nonce-${nonce}'; img-src ${source} data:">
<link rel="stylesheet" href="${style}">
<title>Backplot</title>
</head>
<body>
<header>
<label>Colours <select id="mode">
<option value="finding">findings</option><option value="deviation">deviation</option><option value="feed">feed</option><option value="posture">posture</option>
</select></label>
<span role="group" aria-label="View from"><button id="iso">Iso</button> <button id="top">Top</button> <button id="front">Front</button> <button id="right">Right</button></span>
<label><input type="checkbox" id="rapids" checked> rapids</label>
<label><input type="checkbox" id="normals" checked> tool axis</label>
<label><input type="checkbox" id="tool" checked> tool</label>
<label class="needs-machine" title="The part moves as the axes move it. An axis within 2 % of the end of its travel is drawn in vermilion."><input type="checkbox" id="machine"> machine moves</label>
</header>
<div id="notice" role="status" hidden></div>
<main>
<div id="space"><canvas id="view" role="img" aria-label="Path of the tool tip. The arrow keys turn the view, plus and minus change its size, Home shows all." tabindex="0"></canvas><div id="legend"></div></div>
<aside><canvas id="plane" role="img" aria-label="Tool axis seen along Z"></canvas><canvas id="joints" role="img" aria-label="Positions of the axes over the path"></canvas></aside>
</main>
<footer>
<button id="play">Play</button>
<input type="range" id="time" min="0" max="0" value="0" aria-label="Place in the program">
<span id="readout"></span>
</footer>
<script nonce="${nonce}" src="${script}"></script>
</body>
</html>`;
}
