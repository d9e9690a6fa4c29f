"use strict";
/* Read a ground motion from the bytes of a file, PEER AT2 or CSV; the page sends it nowhere.

   It takes and refuses what the library's `read_record` does, with messages of its own. */

const LARGEST_FILE = 100e6; // bytes
const LONGEST_STEP = 0.2; // s: a longer one is in ms
const SMALLEST = 0.005; // g
const LARGEST = { acceleration: 5, stated: 2, velocity: 5 }; // g, g that the file calls g, and m/s
const DECIMAL = /^[-+]?(\d+\.?\d*|\.\d+)(E[-+]?\d+)?$/i;
const inC = (text) => text.replace(/(?<=[\d.])D(?=[-+\d])/gi, "E"); // 1.0D-02 of Fortran
const decimal = (text = "") => (DECIMAL.test(inC(text.trim())) ? Number(inC(text)) : NaN);
const brief = (number) => String(Number(number.toPrecision(4)));
const quoted = (text) => `“${text.length > 80 ? `${text.slice(0, 80)}…` : text}”`;

const UNITS = { "g": 1, "%g": 0.01, "mg": 1e-3 }; // in g
for (const [unit, metres] of Object.entries({ "gal": 0.01, "m/s2": 1, "cm/s2": 0.01, "mm/s2": 1e-3 })) UNITS[unit] = metres / GRAVITY;
const EXPECTED = Object.keys(UNITS).join(", ");

/** One unit of acceleration in g, and one of time in s; undefined for another text. */
function inG(unit) {
  const plain = unit.normalize("NFKC").replaceAll("−", "-").toLowerCase().replace(/[\s()^*]|['’]s/g, "").replaceAll("sec", "s").replaceAll("/s/s", "/s2");
  const name = plain.replace(/(?<=m)[.·⋅]?s-2$/, "/s2").replaceAll("gals", "gal");
  return Object.hasOwn(UNITS, name) ? UNITS[name] : undefined;
}
function inSeconds(unit) {
  const match = unit.match(/^\s*(m|milli)?s(ecs?|econds?)?\s*$/i);
  return match ? (match[1] ? 1e-3 : 1) : undefined;
}

// As in src/topheavy/ground/reading.py, whose regular expressions these are
const STEP = "(?<step>[^\\sA-Z(;]+(?:[ED][-+]?\\d+)?)[ \\t]*\\(?(?<unit>(?!NPTS|UNIT)[A-Z]*)";
const COUNT = /\bNPTS\s*[=:]\s*(?<size>\d+)/gi, TIME = new RegExp(`\\bDT\\s*(?:\\((?<before>\\w+)\\)\\s*)?[=:]\\s*${STEP}`, "gi");
const OLD = new RegExp(`^\\s*(?<size>\\d+)[ \\t,]+${STEP}[ \\t,)]*NPTS`, "gim");
const STATED = "\\bunits?\\s*(?:of\\s+acc\\w*\\s*)?(?:\\b(?:of|are|is|in)\\b\\s*[:=]?|[:=])\\s*[(\\[]?";
const UNIT = new RegExp(`(?:(${STATED})|[(\\[]|\\bacc\\w*\\s*[:=]\\s*|\\bunits?\\s+|\\bin\\s+(?!unit))(%\\s*g\\b|[^\\s,;()\\[\\]]+)(?!\\s*=)`, "gi");
const CELL = /^\s*(.*?)\s*(?:[([]([^()[\]]*)[)\]]|\bin\s+(\S+(?:\s+g)?))?\s*$/i;

/** An AT2 file: NPTS, DT and a unit in its first ten lines, then as many numbers. */
function readAt2(lines) {
  const head = lines.slice(0, 10).join("\n"), found = [COUNT, TIME, OLD].map((pattern) => [...head.matchAll(pattern)]);
  const [points, times] = found[0].length && found[1].length ? found : [found[2], found[2]];
  if (!points.length) throw new Error("expected “NPTS= n, DT= s SEC” in the first ten lines, as in PEER's AT2");
  const end = head.slice(0, Math.max(...[...points, ...times].map((match) => match.index + match[0].length))).split("\n").length;
  const size = onlyOne("NPTS", points.map(({ groups }) => Number(groups.size))), step = onlyOne("DT", times.map(({ groups }) => stepOf(groups)));
  const second = lines.findIndex((line, k) => k >= end && line.search(COUNT) >= 0);
  if (second >= 0) throw new Error(`line ${second + 1} is a second header; expected one record`);
  const texts = lines.slice(end).join(" ").match(/\S+/g) ?? [], values = texts.slice(0, size).map(decimal), wrong = values.findIndex(Number.isNaN);
  if (wrong >= 0) throw new Error(`sample ${wrong + 1} is ${quoted(texts[wrong])}; expected a number`);
  if (values.length < size || /^[-+.\d]/.test(texts[size] ?? "")) throw new Error(`NPTS is ${size}, and ${values.length < size ? `only ${values.length}` : "more"} values follow; expected as many`);
  return { step, values, ...unitOf(lines.slice(0, end)) };
}

/** The one value that a header states, once or more. */
function onlyOne(name, values) {
  const other = values.find((value) => Math.abs(value - values[0]) > 1e-6 * values[0]);
  if (other !== undefined) throw new Error(`the header states ${values[0]} and ${other} as ${name}; expected one value`);
  return values[0];
}

/** The time step that a header states, s. */
function stepOf({ step, unit, before }) {
  const text = step.replace(/,+$/, ""), word = unit || before, second = inSeconds(word || "s"), value = decimal(text) * (second ?? 1);
  if (!(value >= 0)) throw new Error(`DT is ${quoted(text)}; expected a number with a point, such as 0.01`);
  if (second === undefined || (!word && value > LONGEST_STEP)) throw new Error(`DT is ${text}${word ? ` ${word}` : ", without a unit"}; expected SEC or MSEC behind it`);
  return value;
}

/** The one unit of acceleration that the lines of a header state. */
function unitOf(header) {
  const units = new Map();
  for (const line of header) {
    for (const [, stated, text] of line.matchAll(UNIT)) {
      const unit = text.replace(/[.:]+$/, ""), factor = inG(unit);
      if (stated !== undefined ? !inSeconds(unit) : factor && !/\b(peak|pga|a?max\w*)\b/i.test(line)) units.set(factor, units.get(factor) ?? unit);
    }
  }
  const [[factor, unit] = []] = units;
  if (units.size !== 1 || !factor) throw new Error(`the header states ${[...units.values()].map(quoted).join(" and ") || "no unit"} of acceleration; expected one of ${EXPECTED}, as in “UNITS: G”`);
  return { factor, unit };
}

/** The cells of a line of CSV, without quotes. */
function cellsOf(line, mark) {
  if (!line.includes('"')) return line.split(mark);
  const cell = new RegExp(`(?:^|[${mark}])(?:"((?:[^"]|"")*)"([^${mark}]*)|([^${mark}]*))`, "g");
  return [...line.matchAll(cell)].map(([, inside, behind, plain]) => plain ?? inside.replaceAll('""', '"') + behind);
}

/** A CSV file: a line that names columns with units in its first thirty, then a line for each sample. */
function readCsv(lines) {
  const separator = lines[0].match(/^sep=(.)/)?.[1];
  let k = -1, mark, columns, times, samples;
  do {
    if (++k === Math.min(30, lines.length)) throw new Error(`no line names columns of times and of accelerations with units, ${EXPECTED}; expected, for example, “time (s),acceleration (g)”`);
    mark = separator ?? [";", "\t"].find((each) => lines[k].includes(each)) ?? ",";
    columns = cellsOf(lines[k].replace(/^[#% ]+/, ""), mark).map((cell) => cell.match(CELL) ?? []);
    columns = columns.map(([, name = "", one = "", other = ""]) => ({ name, unit: one + other }));
    times = [...columns.keys()].filter((j) => inSeconds(columns[j].unit));
    samples = [...columns.keys()].filter((j) => inG(columns[j].unit));
  } while (!times.length || !samples.length);
  const said = `line ${k + 1} is ${quoted(lines[k])}`, [time, value] = [times[0], samples[0]], { unit } = columns[value];
  if (/period|freq|\bp?sa\b|spectr/i.test([time, ...samples].map((j) => columns[j].name).join(" "))) throw new Error(`${said}, of a response spectrum; expected a ground motion`);
  if (samples.length > 1) throw new Error(`${said}; expected one column of acceleration: leave out the others`);
  const rows = lines.slice(k + 1).map((line, j) => ({ line, place: k + j + 2, cells: cellsOf(line, mark) })).filter(({ cells }) => cells.some((cell) => cell.trim()));
  for (const { line, place, cells } of rows) {
    if (cells.slice(columns.length).some((cell) => cell.trim())) throw new Error(`line ${place} is ${quoted(line)}, with more cells than line ${k + 1}: if its commas are decimal, separate the columns by semicolons`);
  }
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
  const step = (times.at(-1) - times[0]) / steps.length, sorted = steps.toSorted((one, other) => one - other), half = steps.length >> 1;
  const usual = steps.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2; // the median
  const wrong = steps.findIndex((each, k) => Math.abs(times[k + 1] - times[0] - step * (k + 1)) > digit + 0.01 * Math.abs(step) || !(Math.abs(each - usual) < 0.5 * usual));
  if (wrong < 0) return step;
  const why = digit > 0.5 * step ? `the times are printed to ${brief(digit)} only` : "is a sample missing? If the sampling is uneven, resample it to equal steps";
  throw new Error(`the time ${times[wrong + 1]} follows ${times[wrong]}; expected equal steps of about ${brief(step)}: ${why}`);
}

/** What is implausible in a ground motion, or "". */
function doubts({ step, samples, peak, unit }) {
  let velocity = 0, fastest = 0;
  for (let k = 1; k < samples.length; k++) {
    velocity += (GRAVITY * step * (samples[k - 1] + samples[k])) / 2;
    fastest = Math.max(fastest, Math.abs(velocity));
  }
  const sizes = samples.map(Math.abs), at = sizes.indexOf(peak), run = [...samples, NaN].slice(at).findIndex((a) => a !== samples[at]);
  return [
    [run < 4 && Math.max(sizes[at - 1] ?? 0, sizes[at + run] ?? 0) < peak / 2, `both neighbours of its peak, sample ${at + 1} of ${sizes.length}, are below half of it: does it stand for missing data?`],
    [peak < SMALLEST, `its peak is ${brief(peak)} g, and few peaks of interest are below ${SMALLEST} g: is its unit another?`],
    [Math.abs(velocity) > 0.3 * fastest, `its velocity at the end is ${brief(velocity)} m/s, with a peak of ${brief(fastest)} m/s: is its baseline not corrected?`],
    [fastest > LARGEST.velocity, `its velocity reaches ${brief(fastest)} m/s, and few exceed ${LARGEST.velocity} m/s: is its unit another?`],
    [samples.every((a) => a >= 0) || samples.every((a) => a <= 0), "no sample changes sign: is it a ground acceleration?"],
    [/^g$/i.test(unit) && peak > LARGEST.stated, `its peak is ${brief(peak)} g, and few exceed ${LARGEST.stated} g: is its unit another?`],
  ].filter(([is]) => is).map(([, text]) => text).join(" ");
}

/** The text of a file in UTF-8 or UTF-16, with or without its mark, or else of Windows. */
function textOf(bytes) {
  const encoding = { "255,254": "utf-16le", "254,255": "utf-16be" }[bytes.slice(0, 2).join()] ?? "utf-8";
  try {
    return new TextDecoder(encoding, { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder("windows-1252").decode(bytes);
  }
}

/** The record in a file: its name, time step (s), samples (g), their peak, and what is doubtful. */
function readRecord(file, bytes) {
  const [, name, ending = ""] = file.match(/^(.+)\.(at2|csv)$/is) ?? [], reader = { at2: readAt2, csv: readCsv }[ending.toLowerCase()];
  try {
    if (!reader) throw new Error("expected a file whose name ends in .AT2 or .csv");
    if (bytes.length > LARGEST_FILE) throw new Error(`${bytes.length} bytes; expected at most ${LARGEST_FILE}: shorten the record`);
    const { step, values, factor, unit } = reader(textOf(bytes).split(/\r\n|\r|\n/)), samples = Float64Array.from(values, (a) => a * factor);
    const peak = samples.reduce((most, a) => Math.max(most, Math.abs(a)), 0);
    if (samples.length < 2) throw new Error(`${samples.length} samples; expected at least two`);
    if (!(step > 0 && step <= LONGEST_STEP)) throw new Error(`the time step is ${brief(step)} s; expected more than 0 and at most ${LONGEST_STEP} s: is it in ms?`);
    if (!(peak > 0 && peak <= LARGEST.acceleration)) throw new Error(`the largest acceleration is ${brief(peak)} g; expected more than 0 and at most ${LARGEST.acceleration} g: is it in ${quoted(unit)}?`);
    return { name, file, step, samples, peak, doubt: doubts({ step, samples, peak, unit }) };
  } catch (error) {
    throw new Error(`${file}: ${error.message}`);
  }
}
