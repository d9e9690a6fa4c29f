"use strict";
/* The controls: a field for every number, typed or slid, with its message beside it. */

const byId = (id) => document.getElementById(id);
const SLIDER = 1000; // steps
const TOGETHER = ["width", "height", "g", "L", "r", "cap"]; // one of them may contradict another

/** A number as a place on its slider, and back; γ runs from 0 to ∞ with 2 in the middle. */
const toSlider = (key, number) => {
  const { slider, linear } = FIELDS[key];
  if (key === "g") return number === Infinity ? SLIDER : (SLIDER * number) / (2 + number);
  const [low, high] = slider;
  const share = linear ? (number - low) / (high - low) : Math.log(number / low) / Math.log(high / low);
  return SLIDER * Math.min(1, Math.max(0, share));
};
const fromSlider = (key, place) => {
  const share = place / SLIDER, { slider, linear } = FIELDS[key];
  if (key === "g") return share === 1 ? Infinity : Number(((2 * share) / (1 - share)).toPrecision(2));
  const [low, high] = slider;
  return Number((linear ? low + (high - low) * share : low * (high / low) ** share).toPrecision(3));
};

/** Make an element with attributes and children. */
function made(kind, attributes = {}, ...children) {
  const element = document.createElement(kind);
  for (const [key, text] of Object.entries(attributes)) element.setAttribute(key, text);
  element.append(...children);
  return element;
}

class Controls {
  /** `change(patch, isFinal)` takes a change of the state; it returns a contradiction or null. */
  constructor(change, open) {
    Object.assign(this, { change, open, state: { ...DEFAULTS }, refused: {} });
    const structure = byId("structure"), motion = byId("motion");
    structure.append(
      ...["width", "height", "g", "L"].map((key) => this.number(key)),
      this.choice("cap", "Cap beam", { free: "free: frame", fixed: "fixed: portal" }),
      this.choice("vase", "Fixed mass", { shown: "shown", hidden: "hidden" }),
      this.choice("eq", "Equation", { exact: "exact", linearised: "linearised" }), this.number("r"),
    );
    motion.append(this.shapes());
    for (const key of ["a", "T", "D"]) motion.append(this.number(key));
    motion.append(this.choice("start", "Table starts", { smooth: "smoothly", abrupt: "abruptly" }), this.number("x"), this.drop());
  }

  number(key) {
    const { label, unit, hint } = FIELDS[key];
    const text = made("input", { id: key, type: "text", inputmode: "decimal", placeholder: key === "r" ? "formula" : "", "aria-describedby": `${key}-error` });
    const slider = made("input", { id: `${key}-slider`, type: "range", min: 0, max: SLIDER, step: 1, "aria-label": `${label}, slider` });
    const field = made("div", { class: "field", id: `${key}-field` },
      made("label", { for: key }, label, ...(hint ? [made("small", {}, hint)] : [])), text, made("span", { class: "unit" }, unit), slider,
      made("p", { class: "error", id: `${key}-error`, role: "alert" }));
    const type = (isFinal) => {
      const isByFormula = key === "r" && !text.value.trim(), number = isByFormula ? null : typed(text.value);
      const message = isByFormula ? "" : fault(key, number, text.value);
      if (message) this.tell(key, `${message}; ${this.state[key] === null ? "the formula" : shown(this.state[key])} is kept`);
      else this.apply({ [key]: number }, isFinal, key);
    };
    text.addEventListener("input", () => type(false));
    text.addEventListener("change", () => type(true));
    const slide = (isFinal) => {
      const number = fromSlider(key, Number(slider.value));
      text.value = shown(number);
      slider.setAttribute("aria-valuetext", `${shown(number)} ${unit}`);
      this.tell(key, "");
      this.apply({ [key]: number }, isFinal, key);
    };
    slider.addEventListener("input", () => slide(false));
    slider.addEventListener("change", () => slide(true));
    return field;
  }

  choice(key, label, options) {
    const group = made("div", { class: "choice", id: `${key}-field`, role: "radiogroup", "aria-labelledby": `${key}-label` },
      made("span", { id: `${key}-label` }, label));
    for (const [option, words] of Object.entries(options)) {
      const radio = made("input", { type: "radio", name: key, value: option, id: `${key}-${option}` });
      radio.addEventListener("change", () => this.apply({ [key]: option }, true, key));
      group.append(made("label", {}, radio, words));
    }
    group.append(made("p", { class: "error", id: `${key}-error`, role: "alert" }));
    return group;
  }

  shapes() {
    const select = made("select", { id: "shape", "aria-describedby": "shape-error" });
    const pulses = made("optgroup", { label: "Pulses" });
    for (const [shape, name] of Object.entries(DATA.shapes)) pulses.append(made("option", { value: shape }, name));
    this.records = made("optgroup", { label: "Records" });
    select.append(pulses, this.records);
    select.addEventListener("change", () => {
      const [shape, name] = select.value.split(/:(.*)/s);
      this.apply(shape === "record" ? { shape, record: name } : { shape }, true, "shape");
    });
    return made("div", { class: "field", id: "shape-field" }, made("label", { for: "shape" }, "Shape"), select,
      made("p", { class: "error", id: "shape-error", role: "alert" }));
  }

  drop() {
    const file = made("input", { type: "file", multiple: "", accept: ".at2,.AT2,.csv", hidden: "", id: "file", "aria-label": "Record file" });
    const button = made("button", { type: "button" }, "Open a record…");
    button.addEventListener("click", () => file.click());
    file.addEventListener("change", () => {
      [...file.files].forEach(this.open);
      file.value = "";
    });
    addEventListener("dragover", (event) => event.preventDefault());
    addEventListener("drop", (event) => {
      event.preventDefault();
      [...event.dataTransfer.files].forEach(this.open);
    });
    return made("div", { id: "drop" }, button, " or drop a file, AT2 or CSV. It stays on this computer. ", made("span", { id: "reading", role: "status" }), file,
      made("p", { class: "error", id: "record-error", role: "alert" }));
  }

  /** Offer a record in the list of shapes. */
  offer(name, title) {
    this.records.append(made("option", { value: `record:${name}` }, title));
  }

  /** Put a message beside a field, or take it away. */
  tell(key, message) {
    const place = byId(`${key}-error`);
    if (place.textContent !== message) place.textContent = message;
    byId(key)?.setAttribute?.("aria-invalid", message ? "true" : "false");
  }

  /** Apply a change, and with it what was refused before: of two fields that contradict each other,
      the first waits for the second. A change of any other field drops it. */
  apply(patch, isFinal, key) {
    for (const each of [...Object.keys(FIELDS), "cap", "shape", "record"]) this.tell(each, "");
    const whole = { ...this.refused, ...patch };
    let wrong = this.change(whole, isFinal);
    if (wrong && !TOGETHER.includes(key)) wrong = this.change(patch, isFinal);
    this.refused = wrong ? whole : {};
    if (wrong) this.tell(byId(`${wrong.field}-field`).hidden ? key : wrong.field, wrong.message);
  }

  /** Show a state; a field in which somebody types keeps its text. */
  show(state) {
    Object.assign(this, { state, refused: {} });
    for (const key of Object.keys(FIELDS)) {
      const text = byId(key), slider = byId(`${key}-slider`);
      if (state[key] === null) { // √r by its formula
        if (document.activeElement !== text) text.value = "";
        slider.value = toSlider(key, structuresOf(state)[0].restitution);
        continue;
      }
      if (typed(text.value) !== state[key] && !(document.activeElement === text && fault(key, typed(text.value), text.value))) text.value = shown(state[key]);
      if (document.activeElement !== slider || fromSlider(key, Number(slider.value)) !== state[key]) slider.value = toSlider(key, state[key]);
      slider.setAttribute("aria-valuetext", `${shown(state[key])} ${FIELDS[key].unit}`);
    }
    for (const key of ["cap", "vase", "eq", "start"]) byId(`${key}-${state[key]}`).checked = true;
    byId("shape").value = state.shape === "record" ? `record:${state.record}` : state.shape;
    const isRecord = state.shape === "record", isSteady = state.shape === "harmonic";
    const visible = { a: !isRecord, T: !isRecord, D: isSteady, start: isSteady, x: isRecord };
    for (const [key, is] of Object.entries(visible)) byId(`${key}-field`).hidden = !is;
  }
}
