"use strict";
/* The state of the controls: its fields, their checks, and how the address holds it. */

/* Numbers: what a slider covers, and what may be typed. γ has a scale of its own, from 0 to ∞. */
const FIELDS = {
  width: { label: "Column width", unit: "m", slider: [0.1, 4], least: 0.002, most: 2000 },
  height: { label: "Column height", unit: "m", slider: [0.4, 20], least: 0.002, most: 2000 },
  g: { label: "Mass ratio γ", unit: "", slider: null, least: 0, most: Infinity, hint: "cap beam / both columns" },
  L: { label: "Span of the frame", unit: "m", slider: [0.3, 20], least: 0.001, most: 1000, hint: "between column axes" },
  r: { label: "Restitution √r", unit: "", slider: [0, 1], least: 0, most: 1, linear: true, hint: "empty: by its formula" },
  a: { label: "Amplitude", unit: "g", slider: [0.02, 5], least: 0, most: 20 },
  T: { label: "Period", unit: "s", slider: [0.1, 10], least: 0.01, most: 100 },
  D: { label: "Duration", unit: "s", slider: [0.5, 60], least: 0.05, most: 120 },
  x: { label: "Factor on the record", unit: "", slider: [0.1, 10], least: 0, most: 100 },
};
const CHOICES = {
  cap: ["free", "fixed"], vase: ["shown", "hidden"], eq: ["exact", "linearised"], start: ["smooth", "abrupt"],
  shape: [...Object.keys(SHAPES), "record"],
};
const DEFAULTS = {
  width: 1, height: 6, g: 1, L: 5, r: null, cap: "free", vase: "shown", eq: "exact", shape: "one-cosine", a: 0.29, T: 1.5,
  D: 12, start: "smooth", x: 1, record: "",
};

/** A number as it is typed: a decimal comma, a fraction and ∞ are understood. NaN when it is none. */
function typed(text) {
  const plain = text.trim().replace("−", "-").replaceAll(",", ".");
  if (/^\+?(∞|inf|infinity)$/i.test(plain)) return Infinity;
  const [over, under = 1, ...more] = plain.split("/").map((part) => (/^\s*[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?\s*$/i.test(part) ? Number(part) : NaN));
  return under > 0 && under < Infinity && !more.length ? over / under : NaN;
}

/** What is wrong with a number for a field, or "". */
function fault(key, number, text) {
  const { least, most, unit } = FIELDS[key], range = `${least} to ${shown(most)}${unit && ` ${unit}`}`;
  if (!text.trim()) return `the field is empty; expected ${range}`;
  if (Number.isNaN(number)) return `“${text}” is not a number; expected ${range}`;
  if (number < least || number > most) return `${text} is out of range; expected ${range}`;
  return "";
}

/** What is wrong with a state as a whole: the field and the message, or null. */
function contradiction(state) {
  if (state.L <= state.width) return { field: "L", message: `the columns would touch; expected a span above their width, ${shown(state.width)} m` };
  try {
    structuresOf(state);
  } catch (error) {
    return { field: error.field, message: error.message };
  }
  return null;
}

/** A number as short as it can be without loss. */
const shown = (number) => (number === Infinity ? "∞" : String(Number(number.toPrecision(12))));

/** The address of a state: its part after #. */
function encode(state) {
  const isRecord = state.shape === "record", isSteady = state.shape === "harmonic";
  const unused = { r: state.r === null, a: isRecord, T: isRecord, x: !isRecord, record: !isRecord, D: !isSteady, start: !isSteady };
  const pairs = Object.keys(DEFAULTS).filter((key) => !unused[key]).map((key) => [key, state[key] === Infinity ? "inf" : String(state[key])]);
  return new URLSearchParams(pairs).toString();
}

/** The state that an address holds, and the faults in it by field; a faulty field keeps its default. */
function decode(hash) {
  const state = { ...DEFAULTS }, faults = {};
  for (const [key, text] of new URLSearchParams(hash.replace(/^#/, ""))) {
    if (!Object.hasOwn(DEFAULTS, key)) continue;
    const choices = CHOICES[key], isNumber = key in FIELDS;
    const wrong = isNumber ? fault(key, typed(text), text) : choices && !choices.includes(text) && `“${text}” is not known; expected ${choices.join(", ")}`;
    if (wrong) faults[key] = `The address: ${wrong}`;
    else state[key] = isNumber ? typed(text) : text;
  }
  const wrong = contradiction(state);
  if (!wrong) return { state, faults };
  const { width, height, L } = DEFAULTS;
  return { state: { ...state, width, height, L }, faults: { ...faults, [wrong.field]: `The address: ${wrong.message}` } };
}

/** The same case in Python, with the library; a record is read from its file. */
function inPython(state, file = `${state.record}.AT2`) {
  const float = (number) => (number === Infinity ? "math.inf" : String(number)), g = float(state.g);
  const isRecord = state.shape === "record", isSteady = state.shape === "harmonic", isAbrupt = isSteady && state.start === "abrupt";
  const structures = [
    ["column", "Column", `.of_dimensions(width=${float(state.width)}, height=${float(state.height)})`],
    ["vase", "FixedMassColumn", `(column, ${g})`],
    state.cap === "fixed" ? ["portal", "MonolithicPortal", `(column, ${g}, ${float(state.L)})`] : ["frame", "RockingFrame", `(column, ${g})`],
  ].filter(([name]) => name !== "vase" || state.vase === "shown");
  const names = ["simulate", isRecord ? "read_record" : "Pulse", ...structures.map(([, type]) => type)].sort();
  let motion = `Pulse("${state.shape}", ${isSteady ? "-" : ""}${float(state.a)}, period=${float(state.T)})`;
  if (isRecord) motion = `read_record(${JSON.stringify(`data/records/${file}`)}).scaled(${float(state.x)})  # the place of your file`;
  let options = isSteady ? `, duration=${float(state.D)}` : "";
  if (isAbrupt) options += ", velocity=block.frequency_parameter**2 * (1.0 if block.linearised else math.cos(block.slenderness)) * table";
  return [
    "import math", "", `from topheavy import ${names.join(", ")}`, "",
    ...structures.map(([name, type, values]) => `${name} = ${type}${values}`), `motion = ${motion}`,
    ...(isAbrupt ? ["table = float(motion.excitation(math.pi / 2 / motion.angular_frequency)) / motion.angular_frequency  # velocity / g"] : []),
    `for name, structure in {${structures.map(([name]) => `"${name}": ${name}`).join(", ")}}.items():`,
    `    block = structure.block(${state.r === null ? "" : float(state.r)})${state.eq === "linearised" ? ".linear()" : ""}`,
    `    response = simulate(block, motion${options})`,
    "    print(name, response.outcome, response.peak_rotation / block.slenderness)", "",
  ].join("\n");
}
