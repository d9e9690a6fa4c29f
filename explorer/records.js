"use strict";
/* Read a ground motion from the bytes of a file, PEER AT2 or two-column CSV. The page sends it nowhere.

   The rules are those of the library's `topheavy.records`, and tests hold both readers to one table of
   odd and bad files: what the library refuses, this page refuses in the same words. */

const LARGEST = 5; // g: no record exceeds it
const LONGEST_STEP = 0.2; // s: a longer DT without unit is in ms
const COMPUTED = 0.01; // of a step: additional tolerance for times that were computed in single precision
const UNDERSTOOD = "g, % g, mg, g/10, gal, cm/s², m/s² or mm/s²";

// Words and numbers in regular expressions: \w and \b of JavaScript know the letters of English alone.
const LETTER = "[\\p{L}\\p{Nl}\\p{No}]", WORD = "[\\p{L}\\p{N}_]", STARTS = `(?<!${WORD})`, ENDS = `(?!${WORD})`;
const NUMBER = "[-+]?(?:\\d+\\.?\\d*|\\.\\d+)(?:[eEdD][-+]?\\d+)?";
const expression = (pattern, flags = "iu") => new RegExp(pattern, flags);

// Numbers and units ---------------------------------------------------------------------------------

const DECIMAL = expression(`^${NUMBER}$`);

/** A decimal number as C and Fortran print it, with the exponent of Fortran (1.0D-02) also. */
function decimal(text) {
  const trimmed = text.trim(), number = DECIMAL.test(trimmed) ? Number(trimmed.replace(/d/i, "e")) : NaN;
  if (!Number.isFinite(number)) throw new Error(`'${trimmed}' is not a number`);
  return number;
}

const SECONDS = new Map([
  ...["s", "sec", "secs", "second", "seconds"].map((word) => [word, 1]),
  ...["ms", "msec", "msecs", "millisecond", "milliseconds"].map((word) => [word, 1e-3]),
]);

/** One unit of time in s, or undefined for a text that is no such unit. */
const inSeconds = (text) => SECONDS.get(text.trim().toLowerCase());

const S = "(?:seconds?|secs?|s)", PER = "(?:\\s*/\\s*|\\s+per\\s+)";
const SQUARED = "(?:(?:\\^|\\*\\*)?(?:2|\\(2\\))|\\s*squared)";
const METRES = "(?<metres>(?<prefix>milli-?|m|centi-?|c)?(?:met(?:er|re)s?|m))";
const ACCELERATION = "(?:(?<hundredth>%\\s*g|percent\\s+(?:of\\s+)?g)|g\\s*/\\s*(?<part>10{1,3})"
  + "|(?<thousandth>milli-?g|mg)|(?<gal>gals?)|g(?:'s)?"
  + `|${METRES}(?:${PER}${S}(?:${SQUARED}|${PER}${S})|${PER}\\(\\s*${S}${SQUARED}\\s*\\)`
  + `|${PER}(?:sq\\.?|square)\\s+${S}|[\\s·⋅*.]+${S}(?:\\^|\\*\\*)?(?:-2|\\(-2\\))))`
  + `(?!${WORD}|['^\\-]|\\s*[/*×·⋅^%=]|\\s*x\\s*\\d|\\s+per${ENDS}|\\.\\d)`;
const UNIT = expression(ACCELERATION, "iuy"), WHOLE_UNIT = expression(`^${ACCELERATION}$`);

/** A text with raised digits, wide letters and the true minus in ASCII. */
const inAscii = (text) => text.normalize("NFKC").replaceAll("−", "-").replaceAll("’", "'");

/** One of a unit of acceleration, as its match says, in g. */
function inG({ metres, prefix = "", gal, part, hundredth, thousandth }) {
  if (metres) return { "": 1, c: 0.01, m: 0.001 }[prefix.toLowerCase().slice(0, 1)] / GRAVITY;
  if (gal) return 0.01 / GRAVITY;
  if (part) return 1 / Number(part);
  return hundredth ? 0.01 : thousandth ? 0.001 : 1;
}

/** The unit of acceleration at a place in a line, and one of it in g; null where none is. */
function unitAt(line, place) {
  UNIT.lastIndex = place;
  const match = UNIT.exec(line);
  return match && { unit: match[0], inG: inG(match.groups) };
}

const STATED = expression(`${STARTS}units?(?:\\s+of\\s+(?:the\\s+)?acc${WORD}*\\.?)?\\s*(?:${STARTS}(?:of|are|is|in)${ENDS}\\s*[:=]?|[:=])\\s*[(\\[]?\\s*`, "giu");
const INTRODUCED = expression(`[(\\[{]\\s*|${STARTS}units?\\s+|${STARTS}acc(?:el${WORD}*)?${ENDS}\\.?\\s*[:=]\\s*`, "giu");
const SAMPLES_NAMED = expression(`${STARTS}(?:acc(?:el${WORD}*)?|data|values?|samples?|points?)${ENDS}`);
const IN = expression(`${STARTS}in\\s+`, "giu");
const OF_ONE_VALUE = expression(`${STARTS}(?:peak|pga|a?max${WORD}*)${ENDS}|\\d\\.\\d*\\s*$|\\.\\d+\\s*$`);
const NAMES_A_UNIT = expression(`${STARTS}(?:units?|acc${WORD}*)${ENDS}`);

const isTime = (text) => {
  const word = text.match(expression(`^[a-z]+${ENDS}(?!\\s*[/^*\\-])`));
  return word !== null && inSeconds(word[0]) !== undefined;
};
const ends = (matches) => matches.map((match) => match.index + match[0].length);

/** Where the unit of all samples may stand in a line. The unit of a peak, or behind a decimal number,
    is that of one value. */
function whereUnitsAre(line) {
  const samples = line.match(SAMPLES_NAMED), after = samples ? samples.index + samples[0].length : Infinity;
  const introductions = [...line.matchAll(INTRODUCED), ...[...line.matchAll(IN)].filter(({ index }) => index >= after)];
  const ofAll = introductions.filter(({ index }) => !OF_ONE_VALUE.test(line.slice(0, index)));
  return [...new Set([...ends([...line.matchAll(STATED)]), ...ends(ofAll)])].sort((one, other) => one - other);
}

/** The unit of acceleration that the lines of a header state: the unit, one of it in g, and the line.

    A statement is a unit after the word "units", after "acceleration in" or "values in", or in brackets. */
function statedAcceleration(lines) {
  const found = lines.map(inAscii).flatMap((line, k) => {
    for (const end of ends([...line.matchAll(STATED)])) {
      if (!unitAt(line, end) && !isTime(line.slice(end))) throw new Error(`line ${k + 1} states a unit that is not understood: '${line.trim()}'; expected ${UNDERSTOOD}`);
    }
    const units = whereUnitsAre(line).map((place) => unitAt(line, place)).filter(Boolean);
    return units.map((unit) => ({ ...unit, place: k + 1, line: line.trim() }));
  });
  if (!found.length) {
    const hint = lines.findIndex((line) => NAMES_A_UNIT.test(line));
    const seen = hint < 0 ? "no line names one" : `line ${hint + 1} is '${lines[hint].trim()}'`;
    throw new Error(`lines 1 to ${lines.length} state no unit of acceleration that is understood (${seen}); expected ${UNDERSTOOD}: write, for example, 'UNITS: G' into the header`);
  }
  const [first] = found, other = found.find((each) => each.inG !== first.inG);
  if (other) throw new Error(`line ${first.place} states '${first.unit}' ('${first.line}') and line ${other.place} states '${other.unit}' ('${other.line}'); expected one unit of acceleration: take the wrong one out`);
  return first;
}

// PEER's AT2: a header with NPTS and DT, then the samples -------------------------------------------

const NO_UNIT = `(?!(?:NPTS|UNITS?)${ENDS})`;
/* A number that is not given up again, then either a whole unit with its bracket, or nothing that could be one. */
const TIME_STEP = `(?=(?<step>${NUMBER}))\\k<step>(?![\\d.])`
  + `(?:\\s*[(\\[]?${NO_UNIT}(?<unit>${LETTER}+)(?!${LETTER})(?:[)\\]]|(?![)\\]]))|(?!\\s*[(\\[]?${NO_UNIT}${LETTER}))`
  + `(?!${WORD}|\\s*[/*^]|-|[.,]\\d)`;
const UNIT_BEFORE = `(?:\\s*[(\\[]\\s*(?<before>${LETTER}+)\\s*[)\\]])?`;
const COUNT = expression(`${STARTS}NPTS\\s*[=:]\\s*(?<count>\\d+)(?![\\d.]|,\\d)`);
const NAMED_STEP = expression(`${STARTS}DT${UNIT_BEFORE}\\s*[=:]\\s*${TIME_STEP}`);
const OLD_HEADER = expression(`^\\s*(?<count>\\d+)[\\s,]+${TIME_STEP}[\\s,]*NPTS\\s*,?\\s*DT${ENDS}${UNIT_BEFORE}`);

/** The number of samples and the time step, s, of the header's last line. */
function countAndStep(line, place) {
  let count = line.match(COUNT), step = line.match(NAMED_STEP);
  if (!count || !step) count = step = line.match(OLD_HEADER);
  if (!count) throw new Error(`line ${place} is '${line.trim()}'; expected 'NPTS= n, DT= s SEC' or 'n s NPTS, DT', n a whole number and s a time step`);
  const stated = [step.groups.before, step.groups.unit].filter(Boolean), factors = new Set(stated.map(inSeconds));
  if (factors.size > 1 || factors.has(undefined)) {
    throw new Error(`line ${place} gives DT the unit ${stated.map((unit) => `'${unit}'`).join(" and ")}, '${line.trim()}'; expected SEC, S, MSEC or MS`);
  }
  const number = decimal(step.groups.step), [factor = 1] = factors;
  if (!stated.length && number > LONGEST_STEP) {
    throw new Error(`line ${place} gives a DT of ${number} without a unit, '${line.trim()}'; expected at most ${LONGEST_STEP} s: write SEC or MSEC after it`);
  }
  return [Number(count.groups.count), number * factor];
}

function readAt2(lines) {
  const header = 1 + lines.slice(0, 4).findIndex((line) => expression(`${STARTS}NPTS${ENDS}`).test(line));
  if (!header) throw new Error("no NPTS in lines 1 to 4; expected a PEER AT2 file, with a line 'NPTS= n, DT= s SEC' after its title");
  const [count, step] = countAndStep(lines[header - 1], header);
  const unit = statedAcceleration(lines.slice(0, header)), values = [], places = [];
  lines.slice(header).forEach((text, k) => {
    for (const token of text.split(/\s+/).filter(Boolean)) {
      try {
        values.push(decimal(token));
      } catch (error) {
        throw new Error(`line ${header + k + 1}: ${error.message}; expected accelerations in ${unit.unit}`);
      }
      places.push(header + k + 1);
    }
  });
  if (values.length !== count) {
    throw new Error(`line ${header} says ${count} samples, '${lines[header - 1].trim()}', and the lines after it hold ${values.length}; ${values.length < count ? "the file is cut short" : "there are too many"}`);
  }
  return { step, values, places, unit };
}

// CSV: times and accelerations, with a line that names their units ----------------------------------

/** One unit of the last digit of each printed time, zeros that are left out counted: programs print
    either so many decimals or so many significant digits. */
function lastDigits(printed) {
  const numbers = printed.map((text) => {
    const [mantissa, power = "0"] = text.split(/[de]/i), digits = mantissa.replace(/^[-+]?[0.]*|\./g, "");
    const last = Number(power) - (mantissa.split(".")[1]?.length ?? 0);
    return { last, first: digits ? last + digits.length - 1 : null };
  });
  const least = numbers.reduce((low, { last }) => Math.min(low, last), Infinity);
  const digits = numbers.reduce((most, { first, last }) => Math.max(most, (first ?? least) - last), -Infinity);
  return numbers.map(({ first }) => 10 ** Math.max(least, (first ?? least) - digits));
}

/** The step of the times, which are regular if equal steps give them when rounded to their digits. */
function regularStep(printed, places) {
  const times = printed.map(decimal), step = (times.at(-1) - times[0]) / (times.length - 1), units = lastDigits(printed);
  const steps = times.slice(1).map((t, k) => t - times[k]), sorted = steps.toSorted((one, other) => one - other);
  const middle = (sorted.length - 1) / 2, usual = (sorted[Math.floor(middle)] + sorted[Math.ceil(middle)]) / 2;
  const isUneven = (t, k) => Math.abs(t - times[0] - step * k) > units[k] / 2 + Math.max(units[0], units.at(-1)) / 2 + COMPUTED * Math.abs(step);
  const gap = 1 + steps.findIndex((each) => !(Math.abs(each - usual) < usual / 2)), wrong = gap || times.findIndex(isUneven);
  if (wrong > 0) {
    throw new Error(`line ${places[wrong]}: the time ${printed[wrong]} follows ${printed[wrong - 1]} of line ${places[wrong - 1]}; expected equal steps of ${Number(usual.toPrecision(6))}, but for the rounding of the printed digits: is a sample missing, or the file not sampled evenly?`);
  }
  return step;
}

function readCsv([header, ...lines]) {
  const columns = header.split(",").map((part) => part.match(/^[^()[\]]*[([]([^()[\]]*)[)\]]\s*$/)?.[1].trim());
  if (columns.length !== 2 || columns.includes(undefined)) throw new Error(`line 1 is '${header}'; expected, for example, 'time (s),acceleration (g)'`);
  const second = inSeconds(columns[0]), match = inAscii(columns[1]).trim().match(WHOLE_UNIT);
  if (second === undefined || !match) {
    throw new Error(`line 1 is '${header}', with the units ${columns.join(" and ")}; expected s or ms for the times, and ${UNDERSTOOD} for the accelerations`);
  }
  const times = [], values = [], places = [];
  lines.forEach((text, k) => {
    if (!text.trim()) return;
    try {
      const pair = text.split(",");
      if (pair.length !== 2) throw new Error("not two");
      decimal(pair[0]);
      values.push(decimal(pair[1]));
      times.push(pair[0].trim());
    } catch {
      throw new Error(`line ${k + 2} is '${text}'; expected a time and an acceleration, two numbers with a comma between them`);
    }
    places.push(k + 2);
  });
  if (values.length < 2) throw new Error(`holds ${values.length} samples; expected at least two`);
  return { step: second * regularStep(times, places), values, places, unit: { unit: columns[1], inG: inG(match.groups), place: 1, line: header } };
}

// Both ----------------------------------------------------------------------------------------------

/** The lines of a UTF-8 file, with or without a mark of byte order. */
function textLines(bytes) {
  const lines = (text) => text.split(/\r\n|\r|\n/);
  try {
    return lines(new TextDecoder("utf-8", { fatal: true }).decode(bytes));
  } catch {
    const wrong = lines(new TextDecoder().decode(bytes)).findIndex((line) => line.includes("\uFFFD"));
    throw new Error(`line ${wrong + 1} is not UTF-8; expected a UTF-8 file: save it as such`);
  }
}

/** The record in a file, from its bytes: its name without the ending, its step in s, its samples in g.

    Throws an Error with the fault, what was expected, and the line. */
function readRecord(file, bytes) {
  const [, ending = ""] = file.match(/.\.(at2|csv)$/i) ?? [];
  const reader = { at2: readAt2, csv: readCsv }[ending.toLowerCase()];
  if (!reader) throw new Error(`${file}: expected a file whose name ends in .AT2 or .csv`);
  try {
    const { step, values, places, unit } = reader(textLines(bytes)), samples = Float64Array.from(values, (value) => value * unit.inG);
    if (!(step > 0)) throw new Error(`time_step is ${step} s; expected more than zero`);
    if (samples.length < 2) throw new Error(`holds ${samples.length} samples; expected at least two samples`);
    const largest = samples.reduce((found, a, k) => (Math.abs(a) > Math.abs(samples[found]) ? k : found), 0);
    const short = (number) => Number(number.toPrecision(6));
    if (Math.abs(samples[largest]) > LARGEST) {
      throw new Error(`line ${places[largest]}: the largest acceleration is ${short(values[largest])} ${unit.unit}, ${short(samples[largest])} g; expected at most ${LARGEST} g, which no record exceeds: line ${unit.place} states the unit, '${unit.line}'; is it another?`);
    }
    if (samples[largest] === 0) throw new Error("all its samples are zero; expected a ground motion");
    return { name: file.replace(/\.[^.]*$/, ""), step, samples };
  } catch (error) {
    throw new Error(`${file}: ${error.message}`);
  }
}
