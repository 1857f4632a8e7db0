"use strict";
// The replay: a path in orthographic projection on a canvas. Points come from the page; nothing is loaded.
for (const section of document.querySelectorAll(".replay")) {
  const data = JSON.parse(section.querySelector('script[type="application/json"]').textContent);
  const canvas = section.querySelector("canvas");
  const pen = canvas.getContext("2d");
  const slider = section.querySelector("input");
  const play = section.querySelector('[data-do="play"]');
  const count = data.lines.length;
  const width = 7;
  const point = (at) => data.points.slice(at * width, at * width + 3);
  const marked = new Map();
  for (const [line, rule] of data.marks) marked.set(line, rule);
  // The middle and the size of what is cut; rapids from far away must not make it small.
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  const measure = (kind) => {
    for (let at = 0; at < count; at++) {
      if (kind !== null && (data.kinds[at] & 1) !== kind) continue;
      const p = point(at);
      for (let k = 0; k < 3; k++) { low[k] = Math.min(low[k], p[k]); high[k] = Math.max(high[k], p[k]); }
    }
  };
  measure(0);
  if (low[0] > high[0]) measure(null);
  const middle = low.map((value, k) => (value + high[k]) / 2);
  const size = Math.max(Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]), 1e-3);
  const views = { iso: [-Math.PI / 4, 0.6155], front: [0, 0], right: [-Math.PI / 2, 0], top: [0, Math.PI / 2] };
  let [turn, tilt] = views.iso;
  let zoom = 1, shift = [0, 0], at = 0, playing = false, last = 0;

  const see = (p) => {
    const x = p[0] - middle[0], y = p[1] - middle[1], z = p[2] - middle[2];
    const c = Math.cos(turn), s = Math.sin(turn);
    const right = x * c - y * s, away = x * s + y * c;
    const up = z * Math.cos(tilt) + away * Math.sin(tilt);
    const scale = 0.85 * Math.min(canvas.width, canvas.height) / size * zoom;
    return [canvas.width / 2 + right * scale + shift[0], canvas.height / 2 - up * scale + shift[1]];
  };
  const colours = () => matchMedia("(prefers-color-scheme: dark)").matches && !matchMedia("print").matches
    ? { paper: "#16181b", ink: "#e8e8e8", feed: "#56b4e9", rapid: "#8b929b", past: "#e69f00", mark: "#ff8a80" }
    : { paper: "#ffffff", ink: "#1e1e1e", feed: "#0072b2", rapid: "#787878", past: "#d55e00", mark: "#b3261e" };
  const strokes = (from, to, rapid, colour, thick) => {
    pen.strokeStyle = colour;
    pen.lineWidth = thick;
    pen.setLineDash(rapid ? [6, 5] : []);
    pen.beginPath();
    for (let i = Math.max(from, 1); i <= to; i++) {
      if (Boolean(data.kinds[i] & 1) !== rapid || data.kinds[i] & 2) continue;
      pen.moveTo(...see(point(i - 1)));
      pen.lineTo(...see(point(i)));
    }
    pen.stroke();
    pen.setLineDash([]);
  };
  const draw = () => {
    const c = colours();
    pen.fillStyle = c.paper;
    pen.fillRect(0, 0, canvas.width, canvas.height);
    strokes(1, count - 1, true, c.rapid, 1);
    strokes(1, count - 1, false, c.feed, 1.5);
    strokes(1, at, false, c.past, 2);
    pen.fillStyle = c.mark;
    let before = 0;
    for (let i = 0; i < count; i++) {
      if (!marked.has(data.lines[i]) || data.lines[i] === before) continue;
      before = data.lines[i];
      const [x, y] = see(point(i));
      pen.fillRect(x - 3, y - 3, 6, 6);
    }
    // the tool: its axis, and a dot at the tip
    const tip = point(at), axis = data.points.slice(at * width + 3, at * width + 6);
    const top = tip.map((value, k) => value + axis[k] * size * 0.18);
    pen.strokeStyle = c.ink;
    pen.lineWidth = 4;
    pen.beginPath();
    pen.moveTo(...see(tip));
    pen.lineTo(...see(top));
    pen.stroke();
    pen.fillStyle = c.past;
    pen.beginPath();
    pen.arc(...see(tip), 5, 0, 2 * Math.PI);
    pen.fill();
    // the frame of the part, in the corner
    pen.font = "15px system-ui, sans-serif";
    pen.lineWidth = 1.5;
    pen.fillStyle = c.ink;
    const zero = see(middle), foot = [48, canvas.height - 48];
    ["X", "Y", "Z"].forEach((name, k) => {
      const end = middle.slice();
      end[k] += size;
      const to = see(end), length = 0.85 * Math.min(canvas.width, canvas.height) * zoom;
      const x = foot[0] + (to[0] - zero[0]) / length * 36, y = foot[1] + (to[1] - zero[1]) / length * 36;
      pen.beginPath();
      pen.moveTo(...foot);
      pen.lineTo(x, y);
      pen.stroke();
      if (Math.hypot(x - foot[0], y - foot[1]) > 6) pen.fillText(name, x + 4, y - 2);
    });
    const time = data.points[at * width + 6];
    const joints = data.letters.map((name, k) => `${name} ${data.joints[at * data.letters.length + k].toFixed(data.rotary[k] ? 3 : data.digits)}`);
    const rule = marked.has(data.lines[at]) ? `; finding: ${marked.get(data.lines[at])}` : "";
    section.querySelector(".state").textContent =
      `Line ${data.lines[at]}, ${data.kinds[at] & 1 ? "rapid" : "feed"}, ${time < 0 ? "time unknown" : time.toFixed(2) + " s"}; ` +
      `tip${data.radius ? " (X as radius)" : ""} ${tip.map((value) => value.toFixed(data.digits)).join(", ")} ${data.unit}; joints ${joints.join(", ")}${rule}`;
    section.querySelector(".now").textContent = data.texts[data.lines[at]];
    slider.value = String(Math.round(at / Math.max(count - 1, 1) * 1000));
  };
  const step = (now) => {
    if (!playing) return;
    // the whole program takes 20 s, whatever its length
    at = Math.min(count - 1, at + Math.max(1, Math.round((now - last) / 20000 * count)));
    last = now;
    draw();
    if (at === count - 1) { playing = false; play.textContent = "Play"; return; }
    requestAnimationFrame(step);
  };
  play.addEventListener("click", () => {
    playing = !playing;
    play.textContent = playing ? "Pause" : "Play";
    if (playing) { if (at === count - 1) at = 0; last = performance.now(); requestAnimationFrame(step); }
  });
  slider.addEventListener("input", () => { at = Math.round(slider.value / 1000 * (count - 1)); draw(); });
  for (const name of Object.keys(views)) {
    section.querySelector(`[data-do="${name}"]`).addEventListener("click", () => { [turn, tilt] = views[name]; zoom = 1; shift = [0, 0]; draw(); });
  }
  let held = null;
  canvas.addEventListener("pointerdown", (event) => { held = [event.clientX, event.clientY]; canvas.setPointerCapture(event.pointerId); });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    const [dx, dy] = [event.clientX - held[0], event.clientY - held[1]];
    held = [event.clientX, event.clientY];
    if (event.shiftKey) { shift = [shift[0] + dx, shift[1] + dy]; } else {
      turn += dx / 150;
      tilt = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, tilt + dy / 150));
    }
    draw();
  });
  canvas.addEventListener("pointerup", () => { held = null; });
  canvas.addEventListener("wheel", (event) => { event.preventDefault(); zoom *= Math.exp(-event.deltaY / 500); draw(); }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (by) { at = Math.max(0, Math.min(count - 1, at + by)); draw(); event.preventDefault(); }
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  // what is printed shows the whole path
  at = Math.floor((count - 1) / 2);
  draw();
}
