"use strict";
/* Read a ground motion from the text of a file, PEER AT2 or two-column CSV: the page sends it nowhere. */

const NUMBER = "[-+]?(?:\\d+\\.?\\d*|\\.\\d+)(?:[eEdD][-+]?\\d+)?";
const PER_SECOND_SQUARED = "\\s*(?:\\/\\s*s(?:ec)?\\s*(?:\\^?2|\\*\\*2|²|\\/\\s*s(?:ec)?)|\\s*s\\^?-2)";
/* A unit of acceleration, and one of it in g. The order matters: longer ones come first. */
const UNITS = [
  ["%\\s*g", 0.01], ["g\\s*\\/\\s*10", 0.1], ["mg|milli-?g", 0.001], ["gals?", 0.01 / GRAVITY],
  [`mm${PER_SECOND_SQUARED}`, 0.001 / GRAVITY], [`cm${PER_SECOND_SQUARED}`, 0.01 / GRAVITY],
  [`m${PER_SECOND_SQUARED}`, 1 / GRAVITY], ["g(?:'s)?", 1],
];
const UNDERSTOOD = "g, % g, mg, g/10, gal, cm/s², m/s² or mm/s²";
const LARGEST = 5; // g: no record exceeds it

/** One unit of acceleration in g, or null. */
function inG(text) {
  const found = UNITS.find(([pattern]) => new RegExp(`^(?:${pattern})$`, "i").test(text.trim()));
  return found ? found[1] : null;
}

/** The unit that the header of an AT2 file states: after "units", after "in", or in brackets. */
function statedUnit(lines) {
  const unit = UNITS.map(([pattern]) => pattern).join("|");
  const stated = new RegExp(`(?:\\bunits?\\b(?:\\s+(?:of|are|is|in))?\\s*[:=]?\\s*[(\\[]?\\s*|\\bin\\s+|[(\\[]\\s*)(${unit})(?![\\w'^/*-])`, "gi");
  const found = lines.flatMap((line) => [...line.matchAll(stated)].map((match) => inG(match[1])));
  if (!found.length) throw new Error(`the first ${lines.length} lines state no unit of acceleration; expected ${UNDERSTOOD}: write, for example, "UNITS: G" into the header`);
  if (new Set(found).size > 1) throw new Error("the header states two units of acceleration; expected one");
  return found[0];
}

const numberOf = (text) => (new RegExp(`^${NUMBER}$`).test(text) ? Number(text.replace(/[dD]/, "e")) : NaN);

function readAt2(lines) {
  const header = lines.slice(0, 4).findIndex((line) => /\bNPTS\b/i.test(line));
  if (header < 0) throw new Error('no NPTS in lines 1 to 4; expected a PEER AT2 file, with a line "NPTS= n, DT= s SEC"');
  const line = lines[header];
  const named = [line.match(/\bNPTS\s*[=:]\s*(\d+)/i), line.match(new RegExp(`\\bDT\\s*[=:]\\s*(${NUMBER})\\s*(m?s(?:ec)?)?\\b`, "i"))];
  const old = line.match(new RegExp(`^\\s*(\\d+)[\\s,]+(${NUMBER})[\\s,]*NPTS\\s*,?\\s*DT\\b`, "i"));
  if (!old && !(named[0] && named[1])) throw new Error(`line ${header + 1} is "${line.trim()}"; expected "NPTS= n, DT= s SEC"`);
  const count = Number(old ? old[1] : named[0][1]);
  const unit = old ? "" : named[1][2] ?? "";
  const step = numberOf(old ? old[2] : named[1][1]) * (/^m/i.test(unit) ? 1e-3 : 1);
  const factor = statedUnit(lines.slice(0, header + 1)), samples = [];
  lines.slice(header + 1).forEach((text, k) => {
    for (const token of text.split(/\s+/).filter(Boolean)) {
      const number = numberOf(token);
      if (Number.isNaN(number)) throw new Error(`line ${header + k + 2}: "${token}" is not a number`);
      samples.push(number * factor);
    }
  });
  if (samples.length !== count) throw new Error(`line ${header + 1} says ${count} samples, and the lines after it hold ${samples.length}`);
  return { step, samples };
}

/** One unit of the last digit of each printed time: programs print so many decimals, or so many digits. */
function lastDigits(printed) {
  const numbers = printed.map((text) => {
    const [mantissa, power = "0"] = text.toLowerCase().replace("d", "e").split("e"), places = mantissa.split(".")[1]?.length ?? 0;
    const value = numberOf(text), last = Number(power) - places;
    return { last, first: value ? Number(Math.abs(value).toExponential().split("e")[1]) : null };
  });
  const least = numbers.reduce((low, { last }) => Math.min(low, last), Infinity);
  const digits = numbers.reduce((most, { first, last }) => Math.max(most, (first ?? least) - last), 0);
  return numbers.map(({ first }) => 10 ** Math.max(least, (first ?? least) - digits));
}

/** The step of the times, which are regular as `regular_step` of the library says. */
function regularStep(printed) {
  const times = printed.map(numberOf), step = (times.at(-1) - times[0]) / (times.length - 1), units = lastDigits(printed);
  const steps = times.slice(1).map((t, k) => t - times[k]), sorted = steps.toSorted((one, other) => one - other);
  const middle = (sorted.length - 1) / 2, usual = (sorted[Math.floor(middle)] + sorted[Math.ceil(middle)]) / 2;
  const isUneven = (t, k) => Math.abs(t - times[0] - step * k) > units[k] / 2 + Math.max(units[0], units.at(-1)) / 2 + 0.01 * Math.abs(step);
  const gap = 1 + steps.findIndex((each) => !(Math.abs(each - usual) < usual / 2));
  return { step, wrong: gap || times.findIndex(isUneven), usual };
}

function readCsv(lines) {
  const units = [...lines[0].matchAll(/[(\[]([^()\[\]]*)[)\]]/g)].map((match) => match[1].trim());
  const second = { s: 1, sec: 1, ms: 1e-3 }[(units[0] ?? "").toLowerCase()], factor = inG(units[1] ?? "");
  if (units.length !== 2 || !second || factor === null) throw new Error(`line 1 is "${lines[0]}"; expected, for example, "time (s),acceleration (g)"`);
  const times = [], samples = [];
  lines.slice(1).forEach((text, k) => {
    if (!text.trim()) return;
    const pair = text.split(",").map((part) => numberOf(part.trim()));
    if (pair.length !== 2 || pair.some(Number.isNaN)) throw new Error(`line ${k + 2} is "${text}"; expected a time and an acceleration with a comma between them`);
    times.push(text.split(",")[0].trim());
    samples.push(pair[1] * factor);
  });
  if (samples.length < 2) return { step: NaN, samples };
  const { step, wrong, usual } = regularStep(times);
  if (wrong > 0) throw new Error(`line ${wrong + 2}: the time ${times[wrong]} follows ${times[wrong - 1]}; expected equal steps of ${usual.toPrecision(3)}: is a sample missing, or the file not sampled evenly?`);
  return { step: step * second, samples };
}

/** The record in a file: its name without the ending, its step in s, its samples in g.

    Throws an Error with the fault, what was expected, and the line. */
function readRecord(file, text) {
  const lines = text.replace(/^\uFEFF/, "").split(/\r\n|\r|\n/), ending = file.split(".").at(-1).toLowerCase();
  const reader = { at2: readAt2, csv: readCsv }[ending];
  if (!reader) throw new Error(`${file}: expected a file whose name ends in .AT2 or .csv`);
  try {
    const { step, samples } = reader(lines), largest = Math.max(...samples.map(Math.abs));
    if (samples.length < 2) throw new Error(`it holds ${samples.length} samples; expected at least two`);
    if (!(step > 0)) throw new Error(`its time step is ${step} s; expected more than zero`);
    if (!(largest > 0)) throw new Error("all its samples are zero; expected a ground motion");
    if (largest > LARGEST) throw new Error(`its largest acceleration is ${largest.toPrecision(3)} g; expected at most ${LARGEST} g: is the unit another?`);
    return { name: file.replace(/\.[^.]*$/, ""), step, samples: Float64Array.from(samples) };
  } catch (error) {
    throw new Error(`${file}: ${error.message}`);
  }
}
