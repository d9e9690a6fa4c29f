"use strict";
/* The page: one state, the workers that compute from it, and everything that shows what they found. */

const DATA = JSON.parse(byId("data").textContent);
const inWorkers = (scripts) => URL.createObjectURL(new Blob([...document.querySelectorAll(scripts)].map((script) => script.textContent), { type: "text/javascript" }));
const ENGINE = inWorkers("script.engine"), READER = inWorkers("script.engine, script.reader");
const CASES = DATA.cases.map((each) => encode({ ...DEFAULTS, ...each.state }));
const TITLES = { column: "Column", vase: "Vase: mass fixed to it", frame: "Frame: mass carried freely", portal: "Portal: cap beam fixed to both" };
const NARROW = matchMedia("(max-width: 700px)");

const files = new Map(); // records by name, the samples of those that were opened in a blob; `opened` numbers them, so that a file of the same name is another
let state = { ...DEFAULTS };
let found = null; // the histories that are shown
let awaited = {}; // the record that the address names and the page has not, and the factor on it
let opened = 0; // how many files
let time = 0, isPlaying = false, wantsToPlay = true, before = 0;

const round = (number, digits = 3) => {
  if (number === Infinity) return "∞";
  return Number.isFinite(number) ? String(Number(number.toPrecision(digits))) : "–";
};

// The workers ------------------------------------------------------------------------------------

let slow = null, reader = null, survey = 0; // the number of the only survey whose answers count

/** The record of the state, if that has one. */
const fileOf = ({ shape, record }) => (shape === "record" ? files.get(record) : undefined);

/** A worker with one task; while it computes, or is not ready, only the last question waits. */
class Quick {
  constructor(task, hear) {
    Object.assign(this, { task, worker: new Worker(ENGINE), isBusy: true, waits: false, held: null }); // the record that it has
    this.worker.onmessage = ({ data }) => {
      const began = performance.now();
      if (!data.error) hear(data);
      else if (data.id === encode(state)) controls.tell("shape", data.error);
      performance.measure("drawing", { start: began });
      this.ready();
    };
  }

  ask() {
    this.waits = this.isBusy;
    if (this.isBusy) return;
    this.isBusy = true;
    const file = fileOf(state), isNew = file && file !== this.held;
    this.worker.postMessage({ id: encode(state), task: this.task, state, ...(isNew ? { file } : {}) });
    this.held = file ?? this.held;
  }

  /** Ask what waited. */
  ready() {
    this.isBusy = false;
    if (this.waits) this.ask();
  }
}

const quick = new Quick("histories", receive), sketch = new Quick("sketch", outline);

/** Whether a map of the state takes a moment only, so that it follows while a slider is dragged. */
const isSketched = ({ shape }) => shape !== "record" && shape !== "harmonic";

/** Show a coarse map, unless it is of another plane or the survey has a finer one. */
function outline(data) {
  const { cells, keys } = spectrumChart;
  if (isSketched(state) && data.of === keys?.[0] && !cells?.isWhole && cells?.id !== survey) spectrumChart.outcomes(data);
}

/** Set the plane of the map, and whom it compares. */
function frameMap() {
  const file = fileOf(state), other = state.cap === "fixed" ? "the portal, or where it leaves the ground" : "the frame";
  spectrumChart.frame(planeOf(state, file), planeKeys(state, file), isSketched(state));
  byId("across").textContent = file ? "" : "ω is 2π over the period, and p = √(3g/(4R)) is smaller for a larger column. ";
  byId("map-title").textContent = `Overturning of the column and of ${other}`;
  for (const name of document.querySelectorAll("#key .other")) name.textContent = other.split(",")[0];
}

/** Start minima and map anew; the map only where it is not whole yet. */
function askSurvey() {
  const file = fileOf(state);
  frameMap();
  const needsSpectrum = !spectrumChart.cells?.isWhole;
  slow = new Worker(ENGINE);
  slow.onmessage = hear;
  progress(needsSpectrum ? 0 : 1);
  slow.postMessage({ id: survey, task: "survey", state, file, needsSpectrum });
}

/** Stop the survey of a state that is no longer shown; what it has sent already does not count. */
function dropSurvey() {
  survey += 1;
  slow?.terminate();
  minima.length = 0;
  for (const cell of document.querySelectorAll('[id^="minimum"]')) {
    cell.textContent = "…"; // the last number is of another state
    cell.classList.add("pending");
  }
  [...byId("rows").children].forEach((_, k) => sensitive(k, false));
}

const minima = [];

function hear({ data }) {
  if (data.id !== survey) return;
  if (data.error) controls.tell("shape", data.error);
  if ("isSensitive" in data) sensitive(data.index, data.isSensitive);
  if ("minimum" in data) {
    const cell = byId(`minimum${data.index}`);
    const block = structuresOf(state)[data.index], step = searchStep(block, data.minimum);
    const most = 30 * upliftAcceleration(block), decimals = Math.max(0, Math.round(-Math.log10(step)));
    const number = data.minimum === Infinity ? `> ${round(most)}` : data.minimum.toFixed(decimals);
    cell.textContent = data.leaves ? `leaves the ground from ${number}` : number;
    cell.title = `search step ${round(step, 2)} g`;
    minima[data.index] = cell.dataset.value = data.minimum;
    cell.classList.remove("pending");
  }
  if ("codes" in data) {
    spectrumChart.outcomes(data);
    progress(data.share);
  }
}

/** Mark the numbers of a motion that nobody can compute to the digits that are shown. */
function sensitive(index, is) {
  for (const place of [byId("rows").children[index], byId(`caption${index}`)]) place.dataset.sensitive = is;
  byId("sensitive").hidden = !document.querySelector('[data-sensitive="true"]');
}

function progress(share) {
  byId("progress").value = share;
  byId("progress").hidden = share === 1;
  document.documentElement.dataset.spectrum = share === 1 ? "done" : "computing";
}

// What is shown -----------------------------------------------------------------------------------

const controls = new Controls(change, open);
const scene = new Scene(byId("scene"));
const seek = (to) => {
  pause();
  show(to);
};
const strips = []; // three of rotations, then the ground's
const spectrumChart = new Spectrum(byId("spectrum"), pick);

/** Show new histories: charts, numbers, outcome and the pose at the present time. */
function receive(answer) {
  found = answer;
  const { times, structures } = answer, until = times[times.length - 1];
  const toList = (values, scale) => Array.from(values, (value) => (Number.isNaN(value) ? null : value / scale));
  const list = Array.from(times), level = structures[0].uplift;
  structures.forEach((of, k) => {
    const reach = Math.max(1.4, of.overturned ? 0 : 1.15 * of.peak);
    strips[k].show(list, toList(of.theta, of.alpha), [-reach, reach], word(of));
    byId(`caption${k}`).innerHTML = `${TITLES[of.name]} <span class="${word(of)}-word">${outcome(of)}</span>${k ? "" : " <small>rotation θ: at ±α, gravity no longer brings it back</small>"}`;
    byId(`history${k}`).setAttribute("aria-label", `Rotation of the ${of.name} over time: ${outcome(of)}`);
  });
  const largest = 1.15 * Math.max(answer.peak, level);
  strips[3].show(list, Array.from(answer.ground), [-largest, largest], "ink", [-level, level]);
  byId("ground").setAttribute("aria-label", `Ground acceleration over time, peak ${round(answer.peak)} g`);
  scene.build(state, found, NARROW.matches);
  scene.outcomes(structures);
  table(structures);
  byId("verdict").innerHTML = structures.map((of, k) => `${k ? of.name : "Column"} <span class="${word(of)}-word">${outcome(of)}</span>`).join(", ");
  show(Math.min(time, until));
  document.documentElement.dataset.shown = answer.id; // of the state that was asked about
}

const word = (of) => (of.leaves ? "outside" : of.overturned ? "overturns" : "survives");
const outcome = (of) => (of.leaves ? "leaves the ground, outside the model" : of.overturned ? "overturns" : of.moved ? "survives" : "does not uplift");

for (const k of [0, 1, 2]) {
  const row = made("tr", {}, made("th", { scope: "row" }));
  for (let i = 0; i < 9; i++) row.append(made("td"));
  row.children[3].id = `minimum${k}`;
  byId("rows").append(row);
}

function table(structures) {
  const rows = byId("rows");
  structures.forEach((of, k) => {
    const numbers = [
      TITLES[of.name].split(":")[0], outcome(of), of.overturned || of.leaves ? "–" : round(of.peak), null, round(of.uplift, 4), round((of.alpha * 180) / Math.PI, 4),
      `${k === 2 ? "p̂ = " : "p = "}${round(of.p, 4)}`, `${k === 2 ? "R̂ = " : "R = "}${round(of.size, 4)}`, round(of.restitution, 4), of.moved && !of.leaves ? round(of.friction) : "–",
    ];
    numbers.forEach((text, i) => text !== null && (rows.children[k].children[i].textContent = text));
    rows.children[k].children[1].className = `${word(of)}-word`;
  });
}

/** Show the instant t (s). */
function show(t) {
  if (!found) return;
  const { times, structures, ground, displacement, peak } = found, until = times[times.length - 1];
  time = Math.min(until, Math.max(0, t));
  const at = (time / until) * (times.length - 1), k = Math.min(times.length - 2, Math.floor(at)), rest = at - k;
  const between = (values) => values[k] + rest * (values[k + 1] - values[k]);
  const poses = structures.map((of) => {
    if (time >= of.flatAt || Number.isNaN(of.theta[k + 1])) {
      const last = of.theta.findLast((theta) => !Number.isNaN(theta));
      return (Math.sign(last) * Math.PI) / 2;
    }
    return between(of.theta);
  });
  scene.pose(poses, between(displacement), peak ? between(ground) / Math.max(peak, structures[0].uplift) : 0);
  strips.forEach((strip) => strip.at(time));
  byId("time").value = (1000 * time) / until;
  byId("time").setAttribute("aria-valuetext", `${time.toFixed(2)} s`);
  byId("clock").textContent = `${time.toFixed(2)} s`;
}

// Playback ----------------------------------------------------------------------------------------

function play() {
  if (!found) return;
  if (time >= found.times.at(-1)) show(0);
  isPlaying = wantsToPlay = true;
  reveal();
  byId("toggle").textContent = "Pause";
  before = performance.now();
  requestAnimationFrame(tick);
}

function pause() {
  isPlaying = false;
  byId("toggle").textContent = "Play";
}

function tick(now) {
  if (!isPlaying) return;
  show(time + (Math.max(0, now - before) / 1000) * Number(byId("speed").value));
  before = now;
  if (time >= found.times.at(-1)) pause();
  else requestAnimationFrame(tick);
}

const moveBy = (seconds) => seek(time + seconds);
const STEP = 0.02; // s
byId("toggle").addEventListener("click", () => {
  if (isPlaying) {
    wantsToPlay = false;
    pause();
  } else play();
});
byId("start").addEventListener("click", () => {
  show(0);
  if (!isPlaying) play();
});
byId("back").addEventListener("click", () => moveBy(-STEP));
byId("step").addEventListener("click", () => moveBy(STEP));
byId("time").addEventListener("input", () => found && seek((Number(byId("time").value) / 1000) * found.times.at(-1)));
addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest?.("input, select, button, summary, pre, .scroll")) return;
  const does = { " ": () => byId("toggle").click(), ",": () => moveBy(-STEP), ".": () => moveBy(STEP), Home: () => seek(0) }[event.key];
  if (!does) return;
  event.preventDefault();
  does();
});

// The guess of a first visit ------------------------------------------------------------------------

/** Whether nobody has been asked yet, and the address names no case. */
function isFirstVisit() {
  try {
    return !location.hash && localStorage.asked !== (localStorage.asked = "yes");
  } catch { // a browser that keeps nothing
    return !location.hash;
  }
}

/** Hide what would tell, and ask. */
function askFirst() {
  document.documentElement.classList.add("guessing");
  byId("guess").hidden = false;
}

/** Show what was hidden. */
function reveal() {
  if (byId("guess").hidden) return;
  document.documentElement.classList.remove("guessing");
  byId("guess").hidden = true;
  dispatchEvent(new Event("resize")); // the drawing has less room
}

[...document.querySelectorAll("#guess button")].forEach((button, guess) => button.addEventListener("click", () => {
  const of = encode(state);
  play();
  byId("toggle").focus();
  const answer = () => {
    if (encode(state) !== of) return;
    if (minima.length < 3 || minima.includes(undefined)) return void setTimeout(answer, 50);
    const order = [0, 1, 2].sort((one, other) => minima[one] - minima[other]), at = (k) => `the ${found.structures[order[k]].name}${k ? "" : " overturns"} from ${minima[order[k]].toFixed(3)} g`;
    byId("answer").textContent = `${guess === order[0] ? "Correct" : "No"}: ${at(0)}, ${at(1)}, ${at(2)}. Shown is one shaking, ${round(found.peak)} g. Drag the mass ratio: the boundary of the frame moves away from that of the column.`;
  };
  answer();
}));

// Changes of the state ------------------------------------------------------------------------------

/** Take a change of the state, or return what contradicts it; the picture then stays. */
function change(patch, isFinal) {
  const next = { ...state, ...patch };
  if (next.shape === "record" && !files.has(next.record)) {
    return { field: "shape", message: `the record “${next.record}” is not in this page; open or drop its file` };
  }
  const wrong = contradiction(next);
  if (wrong) return wrong;
  const isNew = encode(next) !== encode(state);
  if (isNew) reveal();
  state = next;
  if (isNew) update();
  if (isFinal && wantsToPlay && !matchMedia("(prefers-reduced-motion: reduce)").matches) {
    show(0);
    if (!isPlaying) play();
  }
  return null;
}

let isUpdating = false, rested = 0;

/** Show the controls of the state at once, and the rest with the next picture of the screen. */
function update() {
  document.documentElement.dataset.spectrum = "computing";
  dropSurvey();
  byId("answer").textContent = "";
  controls.show(state);
  if (!isUpdating) requestAnimationFrame(redraw);
  isUpdating = true;
  clearTimeout(rested);
  rested = setTimeout(settle, 250);
}

function redraw() {
  const began = performance.now();
  isUpdating = false;
  quick.ask();
  scene.build(state, found, NARROW.matches);
  if (found) {
    scene.outcomes(found.structures);
    show(time);
  }
  if (strips.length > 3) frameMap();
  if (isSketched(state) && !spectrumChart.cells?.isWhole) sketch.ask();
  const here = encode(state), same = CASES.indexOf(here);
  byId("note").textContent = same >= 0 ? DATA.cases[same].note : "";
  [...byId("cases").children].forEach((button, k) => button.setAttribute("aria-pressed", String(k === same)));
  performance.measure("frame", { start: began });
}

/** When the state has rested for a moment: its address, its Python, its minima and its spectrum. */
function settle() {
  clearTimeout(rested);
  rested = 0;
  const { here } = planeOf(state, fileOf(state));
  byId("spectrum").setAttribute("aria-label", `${byId("map-title").textContent}; this case is at ${round(here.x)} and ${round(here.y)}`);
  byId("python").textContent = inPython(state, files.get(state.record)?.file);
  history.replaceState(null, "", `#${encode(state)}`);
  askSurvey();
}

/** Keep the present state for the browser's Back. */
function keep() {
  for (const place of ["replaceState", "pushState"]) history[place](null, "", `#${encode(state)}`);
}

/** Show a whole new state, from its beginning. */
function start(next, isFirst = false) {
  state = next;
  time = 0;
  update();
  if (isFirst) return askFirst();
  reveal();
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) return;
  wantsToPlay = true;
  pause();
  const begin = () => (found && document.documentElement.dataset.shown === encode(state) ? play() : setTimeout(begin, 20));
  begin();
}

/** Go to a point of the spectrum. */
function pick(x, y) {
  const alone = column(state.b, state.h), short = (number) => Number(number.toPrecision(4));
  const a = y * Math.tan(alone.alpha);
  keep();
  if (state.shape === "record") {
    const scale = x / alone.lever;
    const sizes = Object.fromEntries(["b", "h", "L"].map((key) => [key, short(state[key] * scale)]));
    controls.apply({ ...sizes, x: short(a / fileOf(state).peak) }, true, "shape");
  } else controls.apply({ a: short(a), T: short((2 * Math.PI) / (x * alone.p)) }, true, "shape");
  spectrumChart.plane = planeOf(state, fileOf(state)); // a key may come before the next picture
}

/** Read a file that was opened or dropped, in a worker of its own, and shake with it. The last one counts;
    files that came with it are named. */
function open(file, ...others) {
  reader?.terminate();
  reader = new Worker(READER);
  byId("reading").textContent = `Reading ${file.name} …`;
  reader.onmessage = ({ data }) => {
    reader.terminate();
    byId("reading").textContent = "";
    controls.tell("record", data.error ?? "");
    if (data.read) take(data.read);
    if (others.length) controls.tell("record", `${data.error ?? `${file.name} was read`}; not ${others.map((one) => one.name).join(", ")}: drop one file at a time`);
  };
  reader.postMessage(file);
}

/** Shake with a record that was read. */
function take(read) {
  const { name, file, peak } = read, isNew = !files.has(name);
  keep();
  files.set(name, { ...read, opened: ++opened });
  if (isNew) controls.offer(name, `${file}, ${round(peak)} g`);
  state = { ...state, shape: "half-sine" }; // so that a file of the same name is taken anew
  controls.apply({ shape: "record", record: name, x: name === awaited.record ? awaited.x : 1 }, true, "shape");
}

/** Take the state from the address. */
function readAddress() {
  const { state: next, faults } = decode(location.hash);
  if (next.shape === "record" && !files.has(next.record)) {
    awaited = { record: next.record, x: next.x };
    faults.shape = `The address: the record “${next.record}” is not in this page; open or drop its file`;
    Object.assign(next, { shape: DEFAULTS.shape, record: "" });
  }
  start(next, isFirstVisit());
  for (const [key, message] of Object.entries(faults)) controls.tell(key, message);
}

for (const each of DATA.records) {
  const samples = Float64Array.from(each.samples), peak = samples.reduce((largest, a) => Math.max(largest, Math.abs(a)), 0);
  files.set(each.name, { ...each, file: `${each.name}.AT2`, samples, peak });
  controls.offer(each.name, each.title);
}
DATA.cases.forEach((each) => {
  const button = made("button", { type: "button" }, each.title);
  button.addEventListener("click", () => {
    const next = { ...DEFAULTS, ...each.state };
    if (encode(next) !== encode(state)) keep();
    start(next);
  });
  byId("cases").append(button);
});
byId("copy").addEventListener("click", async () => {
  const link = `${location.href.split("#")[0]}#${encode(state)}`;
  try {
    await navigator.clipboard.writeText(link);
    byId("copied").textContent = "Copied.";
  } catch {
    history.replaceState(null, "", `#${encode(state)}`);
    byId("copied").textContent = "It is in the address line: copy it from there.";
  }
});
addEventListener("hashchange", () => location.hash.slice(1) !== encode(state) && readAddress());
addEventListener("resize", () => {
  scene.measure();
  if (!isUpdating) requestAnimationFrame(redraw);
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  spectrumChart.recolour();
  strips.forEach((strip) => strip.chart.redraw());
});
readAddress();

/** Make the charts one after another, so that none of them holds the page up; then request what they show. */
async function makeCharts() {
  for (const id of ["history0", "history1", "history2", "ground"]) {
    await new Promise(soon);
    const isGround = id === "ground";
    strips.push(new Strip(byId(id), { label: isGround ? "g" : "θ/α", last: strips.length > 1, seek, band: !isGround }));
  }
  await new Promise(soon);
  frameMap();
  quick.ready();
  sketch.ready();
}
makeCharts();
