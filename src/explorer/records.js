"use strict";
/* Read a ground motion from the bytes of a file, PEER AT2 or CSV. The page sends it nowhere:
   it runs this file in a worker only, since its expressions take long to compile.

   The rules are those of the library's `topheavy.ground.records`, and tests hold both readers to one table of
   odd and bad files: what the library refuses, this page refuses in the same words. */

const LARGEST = 5; // g: no record exceeds it
const LONGEST_STEP = 0.2; // s: a longer DT without unit is in ms
const SHORTEST_STEP = 1e-6; // s: a shorter step is in another unit
const HEADER_LINES = 4, LONGEST_HEADER_LINE = 1000; // characters
const MOST_SAMPLES = 2_000_000, LARGEST_FILE = 100_000_000; // bytes: fifty for each of so many samples
const SHOWN = 80; // characters of a faulty text that a message repeats
const COMPUTED = 0.01; // of a step: additional tolerance for times that were computed in single precision
const UNDERSTOOD = "g, % g, mg, g/10, gal, cm/s², m/s² or mm/s²";

/* Words, digits and blanks in regular expressions are those of Python: \w, \b and \d of JavaScript know
   English alone, and its blanks are others. Numbers have the digits of ASCII in both. */
const LETTER = "[\\p{L}\\p{Nl}\\p{No}]", WORD = "[\\p{L}\\p{N}_]", STARTS = `(?<!${WORD})`, ENDS = `(?!${WORD})`;
const BLANK = "\\t-\\r\\x1c-\\x20\\x85\\p{Z}", DIGIT = "\\p{Decimal_Number}";
const NUMBER = "[-+]?(?:[0-9]+\\.?[0-9]*|\\.[0-9]+)(?:[eEdD][-+]?[0-9]{1,4})?";
const expression = (pattern, flags = "iu") =>
  new RegExp(pattern.replaceAll("[\\s", `[${BLANK}`).replaceAll("\\s", `[${BLANK}]`).replaceAll("\\d", DIGIT), flags);

const TOKENS = new RegExp(`[^${BLANK}]+`, "gu"), AROUND = expression("^\\s+|(?<!\\s)\\s+$", "gu");
const trimmed = (text) => text.replace(AROUND, "");

/** The match of a sticky expression at a place in a line; null where none is. */
function matchAt(sticky, line, place) {
  sticky.lastIndex = place;
  return sticky.exec(line);
}

// Texts and numbers of messages ---------------------------------------------------------------------

const NAMED = { "\\": "\\\\", "\t": "\\t", "\n": "\\n", "\r": "\\r" };
const INVISIBLE = /[\\\p{C}]|(?! )\p{Z}/gu;

/** A text in quotes, with the codes of invisible characters, as Python's repr writes it. */
function repr(text) {
  const coded = text.replace(INVISIBLE, (sign) => {
    const code = sign.codePointAt(0).toString(16);
    const [letter, digits] = code.length < 3 ? ["x", 2] : code.length < 5 ? ["u", 4] : ["U", 8];
    return NAMED[sign] ?? `\\${letter}${code.padStart(digits, "0")}`;
  });
  if (!text.includes("'")) return `'${coded}'`;
  return text.includes('"') ? `'${coded.replaceAll("'", "\\'")}'` : `"${coded}"`;
}

/** A text in quotes, and only its beginning if it is long. */
function quoted(text) {
  const signs = [...text];
  return signs.length <= SHOWN ? repr(text) : `${repr(signs.slice(0, SHOWN).join(""))}…`;
}

/** A number of at most six digits, as Python's format g writes it. */
function short(number) {
  if (!Number.isFinite(number)) return number < 0 ? "-inf" : "inf";
  const sign = Object.is(number, -0) ? "-" : "", [digits, power] = number.toExponential(5).split("e");
  if (power >= -4 && power < 6) return `${sign}${Number(number.toPrecision(6))}`;
  return `${Number(digits)}e${power[0]}${power.slice(1).padStart(2, "0")}`;
}

// Numbers and units ---------------------------------------------------------------------------------

const DECIMAL = expression(`^${NUMBER}$`);

/** A decimal number as C and Fortran print it, with the exponent of Fortran (1.0D-02) also. */
function decimal(text) {
  const bare = trimmed(text), number = DECIMAL.test(bare) ? Number(bare.replace(/d/i, "e")) : NaN;
  if (!Number.isFinite(number)) throw new Error(`${quoted(bare)} is not a number`);
  return number;
}

const SECONDS = new Map([
  ...["s", "sec", "secs", "second", "seconds"].map((word) => [word, 1]),
  ...["ms", "msec", "msecs", "millisecond", "milliseconds"].map((word) => [word, 1e-3]),
]);

/** One unit of time in s, or undefined for a text that is no such unit. */
const inSeconds = (text) => SECONDS.get(trimmed(text).toLowerCase());

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

const STATED = expression(`${STARTS}units?(?:\\s+of\\s+(?:the\\s+)?acc${WORD}*\\.?)?\\s*(?:${STARTS}(?:of|are|is|in)${ENDS}\\s*[:=]?|[:=])\\s*[(\\[]?\\s*`, "giu");
const INTRODUCED = expression(`[(\\[{]\\s*|${STARTS}units?\\s+|${STARTS}acc(?:el${WORD}*)?${ENDS}\\.?\\s*[:=]\\s*`, "giu");
const SAMPLES_NAMED = expression(`${STARTS}(?:acc(?:el${WORD}*)?|data|values?|samples?|points?)${ENDS}`);
const IN = expression(`${STARTS}in\\s+`, "giu");
const PEAK = expression(`${STARTS}(?:peak|pga|a?max${WORD}*)${ENDS}`), FRACTION = expression("(?:(?<=\\d)\\.\\d*|\\.\\d+)\\s*", "gu");
const NAMES_A_UNIT = expression(`${STARTS}(?:units?|acc${WORD}*)${ENDS}`);
const NAMES_A_TIME = expression(`[A-Za-z]+${ENDS}(?!\\s*[/^*\\-])`, "uy");

const isTime = (line, place) => inSeconds(matchAt(NAMES_A_TIME, line, place)?.[0] ?? "") !== undefined;
const ends = (matches) => matches.map((match) => match.index + match[0].length);

/** Where the unit of all samples may stand in a line. The unit of a peak, or behind a decimal number,
    is that of one value. */
function whereUnitsAre(line) {
  const samples = line.match(SAMPLES_NAMED), after = samples ? samples.index + samples[0].length : Infinity;
  const introductions = [...line.matchAll(INTRODUCED), ...[...line.matchAll(IN)].filter(({ index }) => index >= after)];
  const peaksBegin = line.match(PEAK)?.index ?? line.length, numbersEnd = new Set(ends([...line.matchAll(FRACTION)]));
  const ofAll = introductions.filter(({ index }) => index < peaksBegin && !numbersEnd.has(index));
  return [...new Set([...ends([...line.matchAll(STATED)]), ...ends(ofAll)])].sort((one, other) => one - other);
}

/** The unit of acceleration that the lines of a header state: the unit, one of it in g, and the line.

    A statement is a unit after the word "units", after "acceleration in" or "values in", or in brackets. */
function statedAcceleration(lines) {
  const found = lines.map((line) => trimmed(inAscii(line))).flatMap((line, k) => {
    for (const end of ends([...line.matchAll(STATED)])) {
      if (!matchAt(UNIT, line, end) && !isTime(line, end)) throw new Error(`line ${k + 1} states a unit that is not understood: ${repr(line)}; expected ${UNDERSTOOD}`);
    }
    const units = whereUnitsAre(line).map((place) => matchAt(UNIT, line, place)).filter(Boolean);
    return units.map((match) => ({ unit: match[0], inG: inG(match.groups), place: k + 1, line }));
  });
  if (!found.length) {
    const hint = lines.findIndex((line) => NAMES_A_UNIT.test(line));
    const seen = hint < 0 ? "no line names one" : `line ${hint + 1} is ${repr(trimmed(lines[hint]))}`;
    throw new Error(`lines 1 to ${lines.length} state no unit of acceleration that is understood (${seen}); expected ${UNDERSTOOD}: write, for example, 'UNITS: G' into the header`);
  }
  const [first] = found, other = found.find((each) => each.inG !== first.inG);
  if (other) throw new Error(`line ${first.place} states ${repr(first.unit)} (${repr(first.line)}) and line ${other.place} states ${repr(other.unit)} (${repr(other.line)}); expected one unit of acceleration: take the wrong one out`);
  return first;
}

// PEER's AT2: a header with NPTS and DT, then the samples -------------------------------------------

const HAS_COUNT = expression(`${STARTS}NPTS${ENDS}`);
const NO_UNIT = `(?!(?:NPTS|UNITS?)${ENDS})`;
/* A number that is not given up again, then either a whole unit with its bracket, or nothing that could be one. */
const TIME_STEP = `(?=(?<step>${NUMBER}))\\k<step>(?![\\d.])`
  + `(?:\\s*[(\\[]?${NO_UNIT}(?<unit>${LETTER}+)(?!${LETTER})(?:[)\\]]|(?![)\\]]))|(?!\\s*[(\\[]?${NO_UNIT}${LETTER}))`
  + `(?!${WORD}|\\s*[/*^]|-|[.,]\\d)`;
const UNIT_BEFORE = `(?:\\s*[(\\[]\\s*(?<before>${LETTER}+)\\s*[)\\]])?`;
const COUNT = expression(`${STARTS}NPTS\\s*[=:]\\s*(?<count>[0-9]+)(?![\\d.]|,\\d)`);
const NAMED_STEP = expression(`${STARTS}DT${UNIT_BEFORE}\\s*[=:]\\s*${TIME_STEP}`);
const OLD_HEADER = expression(`^\\s*(?<count>[0-9]+)[\\s,]+${TIME_STEP}[\\s,]*NPTS\\s*(?:,\\s*)?DT${ENDS}${UNIT_BEFORE}`);

/** Refuse a record of too many samples; `says` is what gives the count. */
function checkCount(says, count) {
  if (count > MOST_SAMPLES) throw new Error(`${says} ${count}; expected at most ${MOST_SAMPLES} samples: shorten the record, or take fewer samples a second`);
}

/** Refuse a line of a header that is too long to be one. */
function checkHeader(lines) {
  lines.forEach((line, k) => {
    const { length } = [...line];
    if (length > LONGEST_HEADER_LINE) throw new Error(`line ${k + 1} has ${length} characters, ${quoted(line)}; expected at most ${LONGEST_HEADER_LINE} in a line of the header`);
  });
}

/** The number of samples and the time step, s, of the header's last line. */
function countAndStep(line, place) {
  let count = line.match(COUNT), step = line.match(NAMED_STEP);
  if (!count || !step) count = step = line.match(OLD_HEADER);
  if (!count) throw new Error(`line ${place} is ${repr(trimmed(line))}; expected 'NPTS= n, DT= s SEC' or 'n s NPTS, DT', n a whole number and s a time step`);
  const stated = [step.groups.before, step.groups.unit].filter(Boolean), factors = new Set(stated.map(inSeconds));
  if (factors.size > 1 || factors.has(undefined)) {
    throw new Error(`line ${place} gives DT the unit ${stated.map(repr).join(" and ")}, ${repr(trimmed(line))}; expected SEC, S, MSEC or MS`);
  }
  const number = decimal(step.groups.step), [factor = 1] = factors;
  if (!stated.length && number > LONGEST_STEP) {
    throw new Error(`line ${place} gives a DT of ${short(number)} without a unit, ${repr(trimmed(line))}; expected at most ${LONGEST_STEP} s: write SEC or MSEC after it`);
  }
  return [BigInt(count.groups.count), number * factor]; // a count may have a thousand digits
}

function readAt2(lines) {
  const header = 1 + lines.slice(0, HEADER_LINES).findIndex((line) => HAS_COUNT.test(line));
  if (!header) throw new Error(`no NPTS in lines 1 to ${HEADER_LINES}; expected a PEER AT2 file, with a line 'NPTS= n, DT= s SEC' after its title`);
  checkHeader(lines.slice(0, header));
  const [count, step] = countAndStep(lines[header - 1], header);
  const unit = statedAcceleration(lines.slice(0, header)), values = [], places = [];
  checkCount(`line ${header} gives NPTS as`, count);
  lines.slice(header).forEach((text, k) => {
    for (const [token] of text.matchAll(TOKENS)) {
      try {
        values.push(decimal(token));
      } catch (error) {
        throw new Error(`line ${header + k + 1}: ${error.message}; expected accelerations in ${unit.unit}`);
      }
      places.push(header + k + 1);
      checkCount(`line ${header + k + 1} holds sample`, values.length);
    }
  });
  if (BigInt(values.length) !== count) {
    throw new Error(`line ${header} says ${count} samples, ${repr(trimmed(lines[header - 1]))}, and the lines after it hold ${values.length}; ${values.length < count ? "the file is cut short" : "there are too many"}`);
  }
  if (count < 2) throw new Error(`line ${header} says ${count} samples; expected at least two`);
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
  const half = steps.length >> 1, usual = steps.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
  const isUneven = (t, k) => Math.abs(t - times[0] - step * k) > units[k] / 2 + Math.max(units[0], units.at(-1)) / 2 + COMPUTED * Math.abs(step);
  const gap = 1 + steps.findIndex((each) => !(Math.abs(each - usual) < usual / 2)), wrong = gap || times.findIndex(isUneven);
  if (wrong > 0) {
    throw new Error(`line ${places[wrong]}: the time ${printed[wrong]} follows ${printed[wrong - 1]} of line ${places[wrong - 1]}; expected equal steps of ${short(usual)}, but for the rounding of the printed digits: is a sample missing, or the file not sampled evenly?`);
  }
  return step;
}

const COLUMN = expression("^[^()[\\]]*[([](?<unit>[^()[\\]]*)[)\\]]\\s*$");

const SEPARATORS = { ";": "a semicolon", "\t": "a tab", ",": "a comma" }; // beside the first two, a comma is a decimal point

/** How the columns lie: what separates them, which two are read, and their units. */
function layoutOf(header, place) {
  const separator = Object.keys(SEPARATORS).find((mark) => header.includes(mark)) ?? ",", parts = header.split(separator);
  const units = parts.map((part) => trimmed(part.match(COLUMN)?.groups.unit ?? "")), said = `line ${place} is ${repr(header)}`;
  if (parts.length < 2 || (parts.length === 2 && !units.every(Boolean))) throw new Error(`${said}; expected, for example, 'time (s),acceleration (g)'`);
  const matches = units.map((unit) => trimmed(inAscii(unit)).match(WHOLE_UNIT)), places = [...units.keys()];
  let times = places.filter((k) => inSeconds(units[k]) !== undefined), found = places.filter((k) => matches[k]);
  if (parts.length === 2) [times, found] = [times.filter((k) => k === 0), found.filter((k) => k === 1)];
  if (!times.length || !found.length) {
    const listed = parts.length > 2 ? units.filter(Boolean).join(", ") : units.join(" and ");
    throw new Error(`${said}, with the units ${listed}; expected s or ms for the times, and ${UNDERSTOOD} for the accelerations`);
  }
  const names = found.map((k) => repr(trimmed(parts[k].split(/[([]/)[0])));
  if (found.length > 1) throw new Error(`${said}; expected one column of acceleration; those are ${names.join(", ")}: name one as \`column\`, or take the others out`);
  const [time] = times, [value] = found;
  return { separator, count: parts.length, time, value, second: inSeconds(units[time]), unit: { unit: units[value], inG: inG(matches[value].groups), place, line: header } };
}

function readCsv(all) {
  const above = all.findIndex((line) => !/^[#%]/.test(line)), begin = above < 0 ? all.length : above;
  const header = all[begin] ?? "", lines = all.slice(begin + 1);
  checkHeader([...all.slice(0, begin), header]);
  const { separator, count, time, value, second, unit } = layoutOf(header, begin + 1), times = [], values = [], places = [];
  lines.forEach((text, k) => {
    if (!trimmed(text)) return;
    const place = begin + k + 2;
    try {
      const parts = text.split(separator).map((part) => (separator === "," ? part : part.replaceAll(",", ".")));
      if (parts.length !== count) throw new Error("not as many");
      decimal(parts[time]);
      values.push(decimal(parts[value]));
      times.push(trimmed(parts[time]));
    } catch {
      throw new Error(`line ${place} is ${quoted(text)}; expected a time and an acceleration, ${count === 2 ? "two numbers" : `${count} columns`} with ${SEPARATORS[separator]} between them`);
    }
    places.push(place);
    checkCount(`line ${place} holds sample`, values.length);
  });
  if (values.length < 2) throw new Error(`holds ${values.length} samples; expected at least two`);
  return { step: second * regularStep(times, places), values, places, unit };
}

// Both ----------------------------------------------------------------------------------------------

/** The lines of a UTF-8 file, with or without a mark of byte order. */
function textLines(bytes) {
  const lines = (some) => new TextDecoder().decode(some).split(/\r\n|\r|\n/);
  // Written again, what is not UTF-8 is the sign for it, three bytes of which the first may agree.
  const again = new TextEncoder().encode(new TextDecoder("utf-8", { ignoreBOM: true }).decode(bytes));
  let wrong = again.findIndex((byte, k) => byte !== bytes[k]);
  if (wrong < 0) return lines(bytes);
  while ((again[wrong] & 0xc0) === 0x80) wrong -= 1;
  const before = lines(bytes.subarray(0, wrong)), place = new TextEncoder().encode(before.at(-1)).length + 1;
  throw new Error(`line ${before.length} is not UTF-8 at byte ${place} (0x${bytes[wrong].toString(16).padStart(2, "0")}); expected a UTF-8 file: save it as such`);
}

/** Refuse a file that is too large, before it is read. */
function checkSize(file, size) {
  if (size > LARGEST_FILE) throw new Error(`${file}: the file has ${size} bytes; expected at most ${LARGEST_FILE}, fifty for each of ${MOST_SAMPLES} samples: shorten the record`);
}

/** The record in a file, from its bytes: its name without the ending, its step in s, its samples in g,
    and the largest of them.

    Throws an Error with the fault, what was expected, and the line. */
function readRecord(file, bytes) {
  const [, ending = ""] = file.match(/.\.(at2|csv)$/i) ?? [];
  const reader = { at2: readAt2, csv: readCsv }[ending.toLowerCase()];
  if (!reader) throw new Error(`${file}: expected a file whose name ends in .AT2 or .csv`);
  try {
    const { step, values, places, unit } = reader(textLines(bytes)), samples = Float64Array.from(values, (value) => value * unit.inG);
    if (step > 0 && step < SHORTEST_STEP) throw new Error(`the time step is ${short(step)} s; expected at least ${short(SHORTEST_STEP)} s: is its unit another?`);
    const largest = samples.reduce((found, a, k) => (Math.abs(a) > Math.abs(samples[found]) ? k : found), 0);
    if (samples[largest] === 0) throw new Error(`all ${samples.length} accelerations are zero; expected a ground motion: is it another file or column?`);
    if (Math.abs(samples[largest]) > LARGEST) {
      throw new Error(`line ${places[largest]}: the largest acceleration is ${short(values[largest])} ${unit.unit}, ${short(samples[largest])} g; expected at most ${LARGEST} g, which no record exceeds: line ${unit.place} states the unit, ${repr(unit.line)}; is it another?`);
    }
    if (!Number.isFinite(step)) throw new Error(`time_step is ${short(step)}; expected a finite number`);
    if (!(step > 0)) throw new Error(`time_step is ${short(step)} s; expected more than zero`);
    return { name: file.replace(/\.[^.]*$/, ""), file, step, samples, peak: Math.abs(samples[largest]) };
  } catch (error) {
    throw new Error(`${file}: ${error.message}`);
  }
}

if (typeof window === "undefined" && typeof postMessage === "function") {
  onmessage = async ({ data: file }) => {
    try {
      checkSize(file.name, file.size);
      const read = readRecord(file.name, new Uint8Array(await file.arrayBuffer()));
      postMessage({ read: { ...read, samples: new Blob([read.samples]) } }); // which the page hands on without a copy
    } catch (error) {
      postMessage({ error: error.message });
    }
  };
}
