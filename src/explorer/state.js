"use strict";
/* The state of the controls: its fields, their checks, and how the address holds it. */

/* Numbers: what a slider covers, and what may be typed. γ has a scale of its own, from 0 to ∞. */
const FIELDS = {
  b: { label: "Half width b", unit: "m", slider: [0.05, 2], least: 0.001, most: 1000 },
  h: { label: "Half height h", unit: "m", slider: [0.2, 10], least: 0.001, most: 1000 },
  g: { label: "Mass ratio γ", unit: "", slider: null, least: 0, most: Infinity,
    hint: "cap beam over both columns, e.g. 1/4 or ∞" },
  L: { label: "Span L of the frame", unit: "m", slider: [0.3, 20], least: 0.001, most: 1000, hint: "between the axes of its columns" },
  r: { label: "Own √r", unit: "", slider: [0, 1], least: 0, most: 1, linear: true },
  a: { label: "Amplitude", unit: "g", slider: [0.02, 5], least: 0, most: 20 },
  T: { label: "Period", unit: "s", slider: [0.1, 10], least: 0.01, most: 100 },
  D: { label: "Duration", unit: "s", slider: [0.5, 60], least: 0.05, most: 120 },
  x: { label: "Factor on the record", unit: "", slider: [0.1, 10], least: 0, most: 100 },
};
const CHOICES = {
  cap: ["free", "fixed"], eq: ["exact", "linearised"], start: ["smooth", "abrupt"],
  shape: [...Object.keys(SHAPES), "record"],
};
const DEFAULTS = {
  b: 0.5, h: 3, g: 1, L: 5, r: null, cap: "free", eq: "exact", shape: "one-cosine", a: 0.31, T: 1.5,
  D: 12, start: "smooth", x: 1, record: "",
};

const MOST_PERIODS = 400; // of a steady sine, so that its spectrum takes minutes at most

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
  if (state.L <= 2 * state.b) {
    return { field: "L", message: `the columns would touch; expected a span above their width, ${shown(2 * state.b)} m` };
  }
  if (state.shape === "harmonic" && state.D > MOST_PERIODS * state.T) {
    return { field: "D", message: `the steady sine has more than ${MOST_PERIODS} periods; expected a duration of at most ${shown(MOST_PERIODS * state.T)} s` };
  }
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
    if (Object.hasOwn(FIELDS, key)) {
      const number = typed(text), message = fault(key, number, text);
      if (message) faults[key] = `The address: ${message}`;
      else state[key] = number;
    } else if (Object.hasOwn(CHOICES, key)) {
      if (CHOICES[key].includes(text)) state[key] = text;
      else faults[key] = `The address: “${text}” is not known; expected ${CHOICES[key].join(", ")}`;
    } else if (key === "record") state.record = text;
  }
  const wrong = contradiction(state);
  if (wrong) {
    faults[wrong.field] = `The address: ${wrong.message}`;
    Object.assign(state, { b: DEFAULTS.b, h: DEFAULTS.h, L: DEFAULTS.L, D: DEFAULTS.D, T: DEFAULTS.T });
  }
  return { state, faults };
}

/** The same case in Python, with the library; a record is read from its file. */
function inPython(state, file = `${state.record}.AT2`) {
  const float = (number) => (number === Infinity ? "math.inf" : String(number));
  const size = `${float(state.b)}, ${float(state.h)}`;
  const third = state.cap === "fixed" ? `MonolithicPortal(column, ${float(state.g)}, ${float(state.L)})` : `RockingFrame(column, ${float(state.g)})`;
  const name = state.cap === "fixed" ? "portal" : "frame";
  const classes = ["Column", "FixedMassColumn", state.cap === "fixed" ? "MonolithicPortal" : "RockingFrame", "simulate"];
  const own = state.r === null ? "" : float(state.r), linear = state.eq === "linearised" ? ".linear()" : "";
  const isRecord = state.shape === "record", isSteady = state.shape === "harmonic";
  classes.push(isRecord ? "read_record" : "Pulse");
  let motion = `motion = Pulse("${state.shape}", ${isSteady ? "-" : ""}${float(state.a)}, 2 * math.pi / ${float(state.T)})`;
  if (isRecord) motion = `motion = read_record(${JSON.stringify(`data/records/${file}`)}).scaled(${float(state.x)})  # the place of your file`;
  let options = isSteady ? `, duration=${float(state.D)}` : "";
  const lines = [
    "import math", "", `from topheavy import ${classes.sort().join(", ")}`, "",
    `column = Column(${size})`, `vase = FixedMassColumn(column, ${float(state.g)})`, `${name} = ${third}`, motion,
  ];
  if (isSteady && state.start === "abrupt") {
    lines.push("table = float(motion.excitation(math.pi / 2 / motion.angular_frequency)) / motion.angular_frequency  # velocity / g");
    options += ", velocity=block.frequency_parameter**2 * (1.0 if block.linearised else math.cos(block.slenderness)) * table";
  }
  lines.push(
    `for name, structure in {"column": column, "vase": vase, "${name}": ${name}}.items():`,
    `    block = structure.block(${own})${linear}`,
    `    response = simulate(block, motion${options})`,
    "    print(name, response.outcome, response.peak_rotation / block.slenderness)",
  );
  return `${lines.join("\n")}\n`;
}
