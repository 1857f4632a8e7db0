const EXAMPLES = [
  {
    title: "three axes, a cut without a feed", name: "first.nc", machine: "mill-3axis",
    text: "%\nO1\nG17 G21 G90 G94\nT1 M6\nG54 G0 X0. Y0.\nG43 H1 Z-10.\nG1 X10.\nS3000 M3\nG1 X20. F200.\nM5\nM30\n%\n",
  },
  {
    title: "five axes, a flip near the pole", name: "vane.mpf", machine: "mikron-ucp710",
    text: "; trunnion: tool 1 ball diameter 10 length 100\nN10 G710 G90 G17 G54 G94\nN20 T1 M6\nN30 S12000 M3\nN40 G0 SUPA Z350 D0\nN50 A2.042 C3.358 D1\n" +
      "N60 TRAORI\nN70 F2000\nN80 G0 X-28.38197 Y-2.14469 Z110 A2.042 C3.358\nN90 G0 Z61.86773\nN2910 G1 X-28.38197 Y-2.14469 Z59.86773 A2.042 C3.358\n" +
      "N2920 G1 X-28.38474 Y-1.84041 Z59.90263 A1.047 C4.822\nN2930 G1 X-28.38709 Y-1.53565 Z59.93222 A0.081 C52.595\n" +
      "N2940 G1 X-28.38873 Y-1.28023 Z59.95290 A-0.79 C-3.086\nN2950 G1 X-28.39015 Y-1.01049 Z59.97066 A-1.676 C-0.905\nN2960 G0 Z110\nN2970 TRAFOOF\n" +
      "N2980 G0 SUPA Z350 D0\nN2990 M5\nN3000 M30\n",
  },
];

const at = (id) => document.getElementById(id);
const program = at("program");
// above this a check runs when typing has stopped for longer
const LARGE = 200_000;
let name = EXAMPLES[0].name;
let bytes = null;
// called programs, settings and machine files, by name
let files = {};
let checker;
let timer;

function option(select, value, text) {
  const made = document.createElement("option");
  made.value = value;
  made.textContent = text;
  select.append(made);
}

function element(tag, className, text) {
  const made = document.createElement(tag);
  if (className) made.className = className;
  made.textContent = text;
  return made;
}

function numbers(marks) {
  const count = program.value.split("\n").length;
  const parts = [];
  for (let line = 1; line <= count; line += 1) {
    const mark = marks.get(line);
    parts.push(mark ? element("span", mark, `${line}\n`) : document.createTextNode(`${line}\n`));
  }
  at("numbers").replaceChildren(...parts);
  at("numbers").scrollTop = program.scrollTop;
}

function go(line) {
  const lines = program.value.split("\n");
  const start = lines.slice(0, line - 1).reduce((sum, text) => sum + text.length + 1, 0);
  program.focus();
  program.setSelectionRange(start, start + (lines[line - 1] ?? "").length);
  program.scrollTop = Math.max(0, (line - 5) * parseFloat(getComputedStyle(program).lineHeight));
}

const weight = (finding) => (finding.status === "unknown" ? "unknown" : finding.severity);

function shown(finding, pages) {
  const item = element("li", weight(finding), "");
  const place = element("button", "place", "");
  place.type = "button";
  place.append(element("span", "weight", `${weight(finding)}[${finding.rule}]`), ` line ${finding.line}: ${finding.message}`);
  if (finding.count) place.append(` (${finding.count} times, to line ${finding.last_line})`);
  place.addEventListener("click", () => go(finding.line));
  item.append(place);
  // the findings that it leads stand in its notes
  for (const note of finding.notes) item.append(element("p", "more", note));
  if (finding.help) item.append(element("p", "more", finding.help));
  const page = element("details", "", "");
  page.append(element("summary", "", `what ${finding.rule} means`), element("pre", "", pages.get(finding.rule) ?? ""));
  item.append(page);
  return item;
}

function run(pages) {
  const machine = at("machine").value || null;
  const dialect = at("dialect").value || undefined;
  const assume = at("assume").checked ? ["work-offset", "tool-length"] : undefined;
  let report;
  try {
    report = checker.check(bytes ?? program.value, name, machine, { dialect, assume, files });
  } catch (error) {
    at("verdict").className = "unknown";
    at("verdict").textContent = `NOT CHECKED: ${error.message}`;
    at("findings").replaceChildren();
    return;
  }
  const [file] = report.files;
  const verdict = at("verdict");
  if (!file) {
    verdict.className = "unknown";
    verdict.textContent = `NOT CHECKED: ${report.not_checked.map((one) => `${one.place} ${one.message}`).join("; ")}`;
    at("findings").replaceChildren();
    return;
  }
  verdict.className = file.verdict;
  const where = file.machine ? ` on ${file.machine}` : " (motions only: no machine is chosen)";
  verdict.textContent = `${file.verdict.toUpperCase()} ${file.path}${where}: ${file.coverage.blocks_run} of ${file.coverage.blocks} blocks run, ${file.motions} motions`;
  const about = [file.dialect ? `Read as ${file.dialect}: ${file.dialect_reason}.` : file.dialect_reason];
  if (file.assumptions.length) about.push(`Assumed: ${file.assumptions.join("; ")}.`);
  at("about").textContent = about.join(" ");
  const marks = new Map();
  for (const finding of file.diagnostics) if (!marks.has(finding.line) || weight(finding) === "error") marks.set(finding.line, weight(finding));
  numbers(marks);
  at("findings").replaceChildren(...file.diagnostics.map((finding) => shown(finding, pages)));
}

function text(bytes) {
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder("latin1").decode(bytes);
  }
}

function added(pages) {
  const names = Object.keys(files);
  at("added").replaceChildren();
  if (!names.length) return;
  const clear = element("button", "", "Remove");
  clear.type = "button";
  clear.addEventListener("click", () => {
    files = {};
    added(pages);
    run(pages);
  });
  at("added").append(`Added: ${names.join(", ")}. `, clear);
}

function later(pages) {
  clearTimeout(timer);
  timer = setTimeout(() => run(pages), program.value.length > LARGE ? 1500 : 200);
}

async function begin() {
  const module = Uint8Array.from(atob(at("module").textContent.trim()), (c) => c.charCodeAt(0));
  checker = await load(module);
  const lists = checker.lists();
  const pages = new Map(lists.rules.map((rule) => [rule.name, rule.page]));
  option(at("machine"), "", "none");
  for (const machine of lists.machines) option(at("machine"), machine.name, `${machine.name}: ${machine.title}`);
  option(at("dialect"), "", "found out");
  for (const dialect of lists.dialects) option(at("dialect"), dialect.name, dialect.name);
  EXAMPLES.forEach((example, number) => option(at("example"), String(number), example.title));
  const take = (example) => {
    ({ name } = example);
    bytes = null;
    program.value = example.text;
    at("machine").value = example.machine;
    run(pages);
  };
  at("example").addEventListener("change", () => take(EXAMPLES[Number(at("example").value)]));
  at("open").addEventListener("click", () => at("file").click());
  at("file").addEventListener("change", async () => {
    const [file] = at("file").files;
    if (!file) return;
    ({ name } = file);
    // the bytes as they lie on disk are checked, whatever their encoding
    bytes = new Uint8Array(await file.arrayBuffer());
    program.value = text(bytes).replaceAll("\r\n", "\n");
    run(pages);
  });
  at("add").addEventListener("click", () => at("more").click());
  at("more").addEventListener("change", async () => {
    for (const file of at("more").files) files[file.name] = text(new Uint8Array(await file.arrayBuffer()));
    // the same file can be added again when it has changed
    at("more").value = "";
    added(pages);
    run(pages);
  });
  program.addEventListener("input", () => {
    bytes = null;
    later(pages);
  });
  program.addEventListener("scroll", () => {
    at("numbers").scrollTop = program.scrollTop;
  });
  for (const id of ["machine", "dialect", "assume"]) at(id).addEventListener("change", () => run(pages));
  at("foot").append(` trunnion ${lists.version}.`);
  take(EXAMPLES[0]);
  document.documentElement.dataset.ready = "yes";
}

begin().catch((error) => {
  at("verdict").textContent = `This page could not start: ${error.message}`;
});
