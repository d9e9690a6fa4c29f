"use strict";
/* Read a ground motion from the bytes of a file, PEER AT2 or CSV; the page sends it nowhere.

   It takes and refuses what the library's `read_record` does, with messages of its own. */

const LARGEST_FILE = 100e6; // bytes
const LONGEST_STEP = 0.2; // s: a longer one is in ms
const LARGEST = { acceleration: 5, stated: 2, velocity: 5 }; // g, g that the file calls g, and m/s
const DECIMAL = "[-+]?(?:\\d+\\.?\\d*|\\.\\d+)(?:[ED][-+]?\\d+)?", IS_DECIMAL = new RegExp(`^${DECIMAL}$`, "i");
const decimal = (text = "") => (IS_DECIMAL.test(text) ? Number(text.replace(/d/i, "e")) : NaN); // 1.0D-02 of Fortran, too
const brief = (number) => String(Number(number.toPrecision(4)));
const quoted = (text) => `“${text.length > 80 ? `${text.slice(0, 80)}…` : text}”`;

const SI = { "gal": 0.01, "m/s2": 1, "cm/s2": 0.01, "mm/s2": 1e-3 }, UNITS = { "g": 1, "%g": 0.01, "mg": 1e-3, "g/10": 0.1, "g/100": 0.01, "g/1000": 1e-3 }; // in g
for (const [unit, size] of Object.entries(SI)) UNITS[unit] = size / GRAVITY;
const EXPECTED = Object.keys(UNITS).join(", ");

/** One unit of acceleration in g, and one of time in s; undefined for another text. */
function inG(unit) {
  const plain = unit.normalize("NFKC").replace("−", "-").toLowerCase().replace(/[\s()^*'’]/g, "").replaceAll("sec", "s").replaceAll("/s/s", "/s2");
  const name = plain.replace(/(?<=m)[.·⋅]?s-2$/, "/s2").replace("gals", "gal");
  return Object.hasOwn(UNITS, name) ? UNITS[name] : undefined;
}
const inSeconds = (unit) => (/^(s|secs?|seconds?)$/i.test(unit) ? 1 : /^(ms|msecs?|milliseconds?)$/i.test(unit) ? 1e-3 : undefined);

/** An AT2 file: NPTS, DT and a unit in its first ten lines, then as many numbers. */
function readAt2(lines) {
  const find = (pattern) => lines.slice(0, 10).map((line, k) => ({ end: k + 1, ...line.match(new RegExp(pattern, "i"))?.groups })).find((found) => "at" in found);
  const old = find(`^\\s*(?<at>\\d+)[\\s,]+(?<step>${DECIMAL})\\s*(?<behind>[A-Z]*)[\\s,]*NPTS`);
  const points = find("\\bNPTS\\s*[=:]\\s*(?<at>\\d+)") ?? old, time = find(`\\bDT\\s*(?:\\((?<before>\\w+)\\)\\s*)?(?<at>[=:])\\s*(?<step>${DECIMAL})\\s*\\(?(?<behind>[A-Z]*)`) ?? old;
  if (!points || !time) throw new Error("expected “NPTS= n, DT= s SEC” in the first ten lines, as in PEER's AT2");
  const count = Number(points.at), end = Math.max(points.end, time.end);
  const [word] = [time.before, time.behind].filter((unit) => unit && !/^(npts|units)$/i.test(unit)), second = word ? inSeconds(word) : 1;
  if (second === undefined) throw new Error(`line ${time.end} gives DT in ${quoted(word)}; expected SEC or MSEC`);
  if (!word && decimal(time.step) > LONGEST_STEP) throw new Error(`line ${time.end} gives a DT of ${time.step} without a unit; expected SEC or MSEC behind it`);
  const texts = lines.slice(end).join(" ").match(/\S+/g) ?? [], values = texts.slice(0, count).map(decimal), wrong = values.findIndex(Number.isNaN);
  if (wrong >= 0) throw new Error(`sample ${wrong + 1} is ${quoted(texts[wrong])}; expected a number`);
  if (values.length < count || /^[-+.\d]/.test(texts[count] ?? "")) throw new Error(`NPTS is ${count}, and ${values.length < count ? `only ${values.length}` : "more"} values follow; expected as many`);
  return { step: decimal(time.step) * second, values, ...unitOf(lines.slice(0, end)) };
}

/** The one unit of acceleration that the lines of a header state. */
function unitOf(header) {
  const found = new Map(), add = (unit) => found.set(inG(unit), unit), bare = (match) => (match[1] ?? match[2]).replace(/[.:]+$/, "");
  for (const line of header) {
    const stated = [...line.matchAll(/\bunits?\s*(?:of\s+acc\w*\s*)?(?:\b(?:of|are|is|in)\b\s*[:=]?|[:=])\s*[([]?(%\s*g\b|[^\s,;)\]]+)/gi)].map(bare);
    const mentioned = [...line.matchAll(/[([]([^()[\]]+)[)\]]|(?:\bacc\w*\.?\s*[:=]|\bin)\s+(%\s*g\b|[^\s,;]+)/gi)].map(bare);
    stated.filter((unit) => inSeconds(unit) === undefined).forEach(add);
    if (!/\b(peak|pga|a?max\w*)\b/i.test(line)) mentioned.filter((unit) => inG(unit)).forEach(add);
  }
  const [[factor, unit] = []] = found;
  if (found.size !== 1 || !factor) throw new Error(`the header states ${[...found.values()].map(quoted).join(" and ") || "no unit"} of acceleration; expected one of ${EXPECTED}, as in “UNITS: G”`);
  return { factor, unit };
}

/** The cells of a line of CSV, without quotes. */
function cellsOf(line, mark) {
  if (!line.includes('"')) return line.split(mark).map((cell) => cell.trim());
  return line.split('"').map((part, k) => (k % 2 ? part : part.replaceAll(mark, "\n"))).join("").split("\n").map((cell) => cell.trim()); // every other part is quoted
}

/** A CSV file: a line that names columns with units in its first thirty, then a line for each sample. */
function readCsv(lines) {
  const separator = lines[0].match(/^sep=(.)/)?.[1];
  let k = -1, mark, columns, times, found;
  do {
    if (++k === Math.min(30, lines.length)) throw new Error(`no line names columns of times and of accelerations with units, ${EXPECTED}; expected, for example, “time (s),acceleration (g)”`);
    mark = separator ?? [";", "\t"].find((each) => lines[k].includes(each)) ?? ",";
    columns = cellsOf(lines[k].replace(/^[#%]+/, ""), mark).map((cell) => cell.match(/^(.*?)\s*(?:[([]([^()[\]]*)[)\]]|\bin\s+(\S+(?:\s+g)?))$/i) ?? []);
    columns = columns.map(([, name = "", one, other]) => ({ name, unit: (one ?? other ?? "").trim() }));
    times = [...columns.keys()].filter((j) => inSeconds(columns[j].unit));
    found = [...columns.keys()].filter((j) => inG(columns[j].unit));
  } while (!times.length || !found.length);
  const said = `line ${k + 1} is ${quoted(lines[k])}`, [time, value] = [times[0], found[0]], { unit } = columns[value];
  if (/period|freq/i.test(columns[time].name) || found.every((j) => /^(p?sa\b|spectr)/i.test(columns[j].name))) throw new Error(`${said}, of a response spectrum; expected a ground motion`);
  if (found.length > 1) throw new Error(`${said}; expected one column of acceleration: leave out the others`);
  const rows = lines.slice(k + 1).map((line, j) => ({ line, place: k + j + 2, cells: cellsOf(line, mark) })).filter(({ cells }) => cells.some(Boolean));
  const [printed, values] = [time, value].map((j) => rows.map(({ line, place, cells }) => {
    const number = decimal(mark === "," ? cells[j] : cells[j]?.replace(",", "."));
    if (Number.isNaN(number)) throw new Error(`line ${place} is ${quoted(line)}; expected numbers in its columns ${time + 1} and ${value + 1} of ${columns.length}`);
    return number;
  }));
  return { step: regularStep(printed) * inSeconds(columns[time].unit), values, factor: inG(unit), unit };
}

/** The step of times, which differ from equal steps by the rounding of their printed digits only. */
function regularStep(times) {
  if (times.length < 2) throw new Error(`${times.length} samples; expected at least two`);
  const digitOf = (time) => 10 ** ((String(time).match(/e(.*)$/)?.[1] ?? 0) - (String(time).match(/\.(\d+)/)?.[1].length ?? 0));
  const digit = times.reduce((least, time) => Math.min(least, digitOf(time)), 1), steps = times.slice(1).map((time, k) => time - times[k]);
  const step = (times.at(-1) - times[0]) / steps.length, usual = steps.toSorted((one, other) => one - other)[steps.length >> 1];
  const wrong = steps.findIndex((each, k) => Math.abs(times[k + 1] - times[0] - step * (k + 1)) > digit + 0.01 * Math.abs(step) || !(Math.abs(each - usual) < 0.5 * usual));
  if (wrong < 0) return step;
  const why = digit > 0.5 * step ? `the times are printed to ${brief(digit)} only` : "is a sample missing, or the file not sampled evenly?";
  throw new Error(`the time ${times[wrong + 1]} follows ${times[wrong]}; expected equal steps of about ${brief(step)}: ${why}`);
}

/** What is implausible in a ground motion, or "". */
function doubts({ step, samples, peak, unit }) {
  let velocity = 0, fastest = 0;
  for (let k = 1; k < samples.length; k++) {
    velocity += (GRAVITY * step * (samples[k - 1] + samples[k])) / 2;
    fastest = Math.max(fastest, Math.abs(velocity));
  }
  return [
    [Math.abs(velocity) > 0.3 * fastest, `its velocity at the end is ${brief(velocity)} m/s, with a peak of ${brief(fastest)} m/s: is its baseline not corrected?`],
    [fastest > LARGEST.velocity, `its velocity reaches ${brief(fastest)} m/s, and few exceed ${LARGEST.velocity} m/s: is its unit another?`],
    [samples.every((a) => a >= 0) || samples.every((a) => a <= 0), "no sample changes sign: is it a ground acceleration?"],
    [/^g$/i.test(unit) && peak > LARGEST.stated, `its peak is ${brief(peak)} g, and few exceed ${LARGEST.stated} g: is its unit another?`],
  ].filter(([is]) => is).map(([, text]) => text).join(" ");
}

/** The record in a file: its name, time step (s), samples (g), their peak, and what is doubtful. */
function readRecord(file, bytes) {
  const [, name, ending = ""] = file.match(/^(.+)\.(at2|csv)$/is) ?? [], reader = { at2: readAt2, csv: readCsv }[ending.toLowerCase()];
  const decoded = (encoding) => new TextDecoder(encoding).decode(bytes);
  try {
    if (!reader) throw new Error("expected a file whose name ends in .AT2 or .csv");
    if (bytes.length > LARGEST_FILE) throw new Error(`${bytes.length} bytes; expected at most ${LARGEST_FILE}: shorten the record`);
    const inUnicode = decoded("utf-8"), text = inUnicode.includes("\ufffd") ? decoded("windows-1252") : inUnicode;
    const { step, values, factor, unit } = reader(text.split(/\r\n|\r|\n/)), samples = Float64Array.from(values, (a) => a * factor);
    const peak = samples.reduce((most, a) => Math.max(most, Math.abs(a)), 0);
    if (samples.length < 2) throw new Error(`${samples.length} samples; expected at least two`);
    if (!(step > 0 && step <= LONGEST_STEP)) throw new Error(`the time step is ${brief(step)} s; expected more than 0 and at most ${LONGEST_STEP} s: is it in ms?`);
    if (!(peak > 0 && peak <= LARGEST.acceleration)) throw new Error(`the largest acceleration is ${brief(peak)} g; expected more than 0 and at most ${LARGEST.acceleration} g: is it in ${quoted(unit)}?`);
    return { name, file, step, samples, peak, doubt: doubts({ step, samples, peak, unit }) };
  } catch (error) {
    throw new Error(`${file}: ${error.message}`);
  }
}
