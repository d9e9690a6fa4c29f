"use strict";
/* The page: one state, the worker that computes from it, and everything that shows the results. */

const DATA = JSON.parse(byId("data").textContent);
const ENGINE = URL.createObjectURL(new Blob([...document.querySelectorAll("script.engine")].map((script) => script.textContent), { type: "text/javascript" }));
const CASES = DATA.cases.map((each) => encode({ ...DEFAULTS, ...each.state }));
const TITLES = { column: "Column", "fixed mass": "Fixed mass: on top of a column", frame: "Frame: mass carried freely", portal: "Portal: cap beam fixed to both" };
const NARROW = matchMedia("(max-width: 700px)"), CALM = matchMedia("(prefers-reduced-motion: reduce)");

const files = new Map(); // records by name; `opened` numbers those that were opened, so that a file of the same name is another
let state = { ...DEFAULTS };
let found = null; // the histories that are shown
let awaited = {}; // the record that the address names and the page has not, and the factor on it
let opened = 0; // how many files
let time = 0, isPlaying = false, wantsToPlay = true, before = 0;

const round = (number, digits = 3) => (Number.isNaN(number) ? "–" : number === Infinity ? "∞" : String(Number(number.toPrecision(digits))));

// The worker -------------------------------------------------------------------------------------

const worker = new Worker(ENGINE);

/** The record of the state, if that has one. */
const fileOf = ({ shape, record }) => (shape === "record" ? files.get(record) : undefined);

/** Take an answer: histories of any state, and maps of the same plane, follow while a slider is dragged. */
function hear({ data }) {
  const isOfState = data.id === encode(state);
  if (data.read) take(data.read);
  else if (data.unread) told(data.unread);
  else if (data.times) receive(data);
  else if (data.codes) spectrumChart.outcomes(data);
  if (!isOfState) return;
  if (data.error) controls.tell("shape", data.error);
  if (data.codes) progress(data.share);
  if ("isSensitive" in data) sensitive(data.index, data.isSensitive);
  if ("minimum" in data) {
    const cell = byId(`minimum${data.index}`);
    const block = structuresOf(state)[data.index], step = searchStep(block, data.minimum);
    const most = 30 * upliftAcceleration(block), decimals = Math.max(0, Math.round(-Math.log10(step)));
    const number = data.minimum === Infinity ? `> ${round(most)}` : data.minimum.toFixed(decimals);
    cell.textContent = data.leaves ? `leaves the ground from ${number}` : number;
    cell.title = `search step ${round(step, 2)} g`;
    cell.dataset.value = data.minimum;
    cell.classList.remove("pending");
  }
}
worker.onmessage = hear;

/** Set the plane of the map, and whom it compares. */
function frameMap() {
  const file = fileOf(state), other = state.cap === "fixed" ? "the portal, or where it leaves the ground" : "the frame";
  spectrumChart.frame(planeOf(state, file), planeKeys(state, file));
  byId("islands").hidden = !file;
  byId("across").textContent = file ? "" : "ω is 2π over the period, and p = √(3g/(4R)) is smaller for a larger column. ";
  byId("map-title").textContent = `Overturning of the column and of ${other}`;
  for (const name of document.querySelectorAll("#key .other")) name.textContent = other.split(",")[0];
}

/** Mark the numbers of a motion that nobody can compute to the digits that are shown. */
function sensitive(index, is) {
  for (const place of [byId("rows").children[index], byId(`caption${index}`)]) place.dataset.sensitive = is;
  byId("sensitive").hidden = !document.querySelector('figure:not([hidden]) > [data-sensitive="true"]');
}

function progress(share) {
  byId("progress").value = share;
  byId("computing").hidden = share === 1;
  document.documentElement.dataset.spectrum = share === 1 ? "done" : "computing";
}

// What is shown -----------------------------------------------------------------------------------

const controls = new Controls(change, open);
const scene = new Scene(byId("scene"));
const strips = ["history0", "history1", "history2", "ground"].map((id, k) => new Strip(byId(id), { label: k < 3 ? "θ/α" : "g", last: k > 1, band: k < 3 }));
const spectrumChart = new Spectrum(byId("spectrum"), pick);

/** Show new histories: charts, numbers, outcome and the pose at the present time. */
function receive(answer) {
  found = answer;
  const { times, structures } = answer;
  const toList = (values, scale) => Array.from(values, (value) => (Number.isNaN(value) ? null : value / scale));
  const list = Array.from(times), level = structures[0].uplift;
  structures.forEach((of, k) => {
    const reach = Math.max(1.4, of.overturned ? 0 : 1.15 * of.peak);
    strips[k].show(list, toList(of.theta, of.alpha), [-reach, reach]);
    byId(`history${k}`).setAttribute("aria-label", `Rotation of the ${of.name} over time`);
  });
  const largest = 1.15 * Math.max(answer.peak, level);
  strips[3].show(list, Array.from(answer.ground), [-largest, largest], [-level, level]);
  byId("ground").setAttribute("aria-label", `Ground acceleration over time, peak ${round(answer.peak)} g`);
  scene.build(state, found, NARROW.matches);
  table(structures);
  tellOutcomes(structures);
  show(time);
  document.documentElement.dataset.shown = answer.id; // of the state that was asked about
}

const word = (of) => (of.leaves ? "outside" : of.overturned ? "overturns" : "survives");
const outcome = (of) => (of.leaves ? "leaves the ground, outside the model" : of.overturned ? "overturns" : of.moved ? "survives" : "does not uplift");

/** Show the outcomes, before the film and the map. */
function tellOutcomes(structures) {
  const texts = structures.map((of) => `<span class="${word(of)}-word">${outcome(of)}</span>`);
  structures.forEach((of, k) => (byId(`caption${k}`).innerHTML = `${TITLES[of.name]} ${texts[k]}${k ? "" : " <small>rotation θ: at ±α, gravity no longer brings it back</small>"}`));
  byId("verdict").innerHTML = structures.map((of, k) => `The ${of.name} ${texts[k]}`).filter((_, k) => k !== 1 || state.vase === "shown").join(", ").replaceAll(", The", ", the");
  scene.outcomes(structures.map(word));
}

const cellsOfRow = (k) => Array.from({ length: 9 }, (_, i) => made("td", i === 2 ? { id: `minimum${k}` } : {}));
byId("rows").append(...[0, 1, 2].map((k) => made("tr", {}, made("th", { scope: "row" }), ...cellsOfRow(k))));

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
  const isFlat = (of) => time >= of.flatAt || Number.isNaN(of.theta[k + 1]), last = (of) => of.theta.findLast((theta) => !Number.isNaN(theta));
  const poses = structures.map((of) => (isFlat(of) ? (Math.sign(last(of)) * Math.PI) / 2 : between(of.theta)));
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

byId("toggle").addEventListener("click", () => (isPlaying ? (pause(), wantsToPlay = false) : play()));
byId("start").addEventListener("click", () => (show(0), isPlaying || play()));
byId("time").addEventListener("input", () => found && (pause(), show((Number(byId("time").value) / 1000) * found.times.at(-1))));

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
  state = next;
  if (isNew) update();
  if (isFinal && wantsToPlay && !CALM.matches) begin();
  return null;
}

let isUpdating = false, rested = 0;

/** Show the controls of the state at once, and the rest with the next picture of the screen. */
function update() {
  progress(0);
  for (const cell of document.querySelectorAll('[id^="minimum"]')) {
    cell.textContent = "…"; // the last number is of another state
    cell.classList.add("pending");
  }
  [0, 1, 2].forEach((k) => sensitive(k, false));
  controls.show(state);
  if (!isUpdating) requestAnimationFrame(redraw);
  isUpdating = true;
  clearTimeout(rested);
  rested = setTimeout(settle, 250);
}

function redraw() {
  isUpdating = false;
  worker.postMessage({ id: encode(state), state });
  for (const place of [byId("strip1"), byId("rows").children[1]]) place.hidden = state.vase === "hidden";
  frameMap();
  const same = CASES.indexOf(encode(state));
  byId("fixed").hidden = state.cap !== "fixed";
  byId("note").textContent = same >= 0 ? DATA.cases[same].note : "";
  [...byId("cases").children].forEach((button, k) => button.setAttribute("aria-pressed", String(k === same)));
}

/** When the state has rested for a moment: its address and its Python. */
function settle() {
  clearTimeout(rested);
  rested = 0;
  const { here } = planeOf(state, fileOf(state));
  byId("spectrum").setAttribute("aria-label", `${byId("map-title").textContent}; this case is at ${round(here.x)} and ${round(here.y)}`);
  byId("python").textContent = inPython(state, files.get(state.record)?.file);
  history.replaceState(null, "", `#${encode(state)}`);
}

/** Keep the present state for the browser's Back. */
const keep = () => ["replaceState", "pushState"].forEach((place) => history[place](null, "", `#${encode(state)}`));

/** Play the film of the state from its beginning, as soon as it is there. */
function begin() {
  pause();
  time = 0;
  if (found && document.documentElement.dataset.shown === encode(state)) play();
  else setTimeout(() => wantsToPlay && !isPlaying && begin(), 20);
}

/** Show a whole new state: its film, or the end of it to somebody who prefers that nothing moves. */
function start(next) {
  state = next;
  update();
  wantsToPlay = !CALM.matches;
  if (wantsToPlay) begin();
  else time = Infinity;
}

/** Go to a point of the spectrum. */
function pick(x, y) {
  const [alone] = structuresOf(state), short = (number) => Number(number.toPrecision(4));
  const a = y * Math.tan(alone.alpha);
  keep();
  if (state.shape === "record") {
    const sizes = Object.fromEntries(["width", "height", "L"].map((key) => [key, short((state[key] * x) / alone.lever)]));
    controls.apply({ ...sizes, x: short(a / fileOf(state).peak) }, true, "shape");
  } else controls.apply({ a: short(a), T: short((2 * Math.PI) / (x * alone.p)) }, true, "shape");
  spectrumChart.plane = planeOf(state, fileOf(state)); // a key may come before the next picture
}

/** Read a file that was opened or dropped, in the worker. */
function open(file) {
  byId("reading").textContent = `Reading ${file.name} …`;
  worker.postMessage({ file, opened: ++opened });
}

/** Say what is wrong or doubtful in a file. */
const told = (message) => (byId("reading").textContent = "", controls.tell("record", message));

/** Shake with a record that was read. */
function take(read) {
  const { name, file, peak, doubt } = read, isNew = !files.has(name);
  keep();
  files.set(name, read);
  if (isNew) controls.offer(name, `${file}, ${round(peak)} g`);
  state = { ...state, shape: "half-sine" }; // so that a file of the same name is taken anew
  controls.apply({ shape: "record", record: name, x: name === awaited.record ? awaited.x : 1 }, true, "shape");
  told(doubt && `${file} was read, but ${doubt}`);
}

/** Take the state from an address. */
function readAddress(hash) {
  const { state: next, faults } = decode(hash);
  if (next.shape === "record" && !files.has(next.record)) {
    awaited = { record: next.record, x: next.x };
    faults.shape = `The address: the record “${next.record}” is not in this page; open or drop its file`;
    Object.assign(next, { shape: DEFAULTS.shape, record: "" });
  }
  start(next);
  for (const [key, message] of Object.entries(faults)) controls.tell(key, message);
}

for (const each of DATA.records) {
  const record = { ...each, file: `${each.name}.AT2`, samples: Float64Array.from(each.samples) };
  files.set(each.name, record);
  worker.postMessage({ record });
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
byId("copy").addEventListener("click", () => {
  settle();
  const say = (text) => (byId("copy").textContent = text);
  const isOpened = state.shape === "record" && !DATA.records.some(({ name }) => name === state.record); // the address holds no samples
  const copied = () => {
    say(isOpened ? "Copied, without the record" : "Copied");
    setTimeout(say, 3000, "Copy link");
  };
  navigator.clipboard.writeText(location.href).then(copied, () => prompt("The address of this case", location.href));
});
addEventListener("hashchange", (event) => {
  const { hash } = new URL(event.newURL); // location may be that of a state that settles now
  if (hash.slice(1) !== encode(state)) readAddress(hash);
});
addEventListener("resize", () => {
  scene.measure();
  if (!isUpdating) requestAnimationFrame(redraw);
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  spectrumChart.chart.redraw(false, false);
  strips.forEach((strip) => strip.chart.redraw());
});
readAddress(location.hash);
