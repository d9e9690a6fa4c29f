"use strict";
/* Column, vase and frame or portal to scale, at one instant: Eqs. (4) and (7) for the cap beam. */

const SVG = "http://www.w3.org/2000/svg";

/** A new element of the drawing. */
function drawn(kind, attributes, parent) {
  const element = document.createElementNS(SVG, kind);
  for (const [key, text] of Object.entries(attributes)) element.setAttribute(key, text);
  parent.append(element);
  return element;
}

class Scene {
  constructor(svg) {
    this.svg = svg;
    this.measure();
  }

  /** Take the width on the screen, at the start and when it changes. */
  measure() {
    this.available = this.svg.clientWidth || 600;
    this.shown = "";
  }

  /** Build the bodies of a state at rest, so far apart that none leaves the picture or meets another.
      `found` are the histories; without them all stand. A narrow screen has two rows. */
  build(state, found, isNarrow) {
    const [b, h] = [state.width / 2, state.height / 2], { L } = state, depth = CAP_DEPTH * h, beam = L / 2 + b, cap = Math.max(2 * b, beam), fixed = state.cap === "fixed";
    const alpha = Math.atan2(b, h), across = (lean) => 2 * Math.hypot(b, h) * (Math.sin(alpha) + Math.sin(lean - alpha)); // Eq. (4)
    // Where what overturns comes to lie: on the ground, or the columns of a frame on each other.
    const corner = Math.PI / 2 - Math.atan2(cap / 2 - b, 2 * h);
    this.lying = [Math.PI / 2, corner, fixed ? Math.PI / 2 : Math.acos(Math.min(1, (2 * b) / L))];
    // How far each reaches from its middle at a lean, and how high.
    const body = (base, over, high) => ({
      wide: (lean) => base + over * Math.cos(lean) + high * Math.sin(lean),
      high: (lean) => Math.hypot(high, 2 * base + over) * Math.cos(Math.max(0, Math.atan2(2 * base + over, high) - lean)),
    });
    const single = body(b, 0, 2 * h);
    const whole = { wide: (lean) => beam + Math.max(across(lean), 2 * h * Math.sin(lean)), high: (lean) => depth + single.high(Math.min(lean, alpha)) };
    const shapes = [single, body(b, cap / 2 - b, 2 * h + depth), fixed ? body(beam, 0, 2 * h + depth) : whole];
    const leans = this.lying.map((most, k) => [-1, 1].map((side) => {
      const of = found?.structures[k], last = of?.theta.findLast((theta) => !Number.isNaN(theta));
      if (of?.overturned && side * last > 0) return most;
      return Math.min(most, of?.theta.reduce((peak, theta) => Math.max(peak, side * theta || 0), 0) ?? 0);
    }));
    const moved = Math.min(2 * h, found?.displacement.reduce((most, u) => Math.max(most, Math.abs(u)), 0) ?? 0);
    const step = 0.25 * h, coarse = (length) => step * Math.ceil(length / step); // so that it keeps its scale for a while
    const reach = shapes.map((shape, k) => leans[k].map((lean) => coarse(shape.wide(lean)) + step));
    const hasVase = state.vase === "shown", rows = isNarrow && hasVase ? [[0, 1], [2]] : [hasVase ? [0, 1, 2] : [0, 2]];
    const top = coarse(Math.max(...rows.flat().flatMap((k) => leans[k].map(shapes[k].high)))), total = (row) => row.reduce((sum, k) => sum + reach[k][0] + reach[k][1], 0);
    const width = Math.max(...rows.map(total)) + 2 * coarse(moved);

    // The names keep their size on the screen: a pixel is so many metres.
    const pixel = Math.max(width / this.available, (rows.length * (top + 0.2 * h)) / ((isNarrow ? 0.4 : 0.29) * innerHeight));
    const pitch = top + 0.2 * h + 24 * pixel, height = rows.length * pitch + 16 * pixel;
    const shown = String([b, h, L, state.g, fixed, hasVase, reach, top, width, pixel]);
    if (shown === this.shown) return;
    this.shown = shown;
    this.svg.replaceChildren();
    this.svg.setAttribute("viewBox", `0 ${-top} ${width} ${height}`);
    this.svg.style.setProperty("--weight", state.g === Infinity ? 1 : state.g / (0.5 + state.g));
    this.svg.style.aspectRatio = `${width} / ${height}`;
    this.moving = drawn("g", {}, this.svg);
    this.arrow = drawn("path", { class: "arrow" }, this.svg);
    Object.assign(this, { h, middle: width / 2, bottom: height - top - 10 * pixel, pixel, fixed, span: L, b, groups: [] });
    this.groups[1] = drawn("g", { visibility: "hidden" }, this.moving); // of a vase that is not shown
    rows.forEach((row, number) => {
      const ground = number * pitch;
      let left = (width - total(row)) / 2;
      this.soil(ground, width);
      for (const k of row) {
        const centre = left + reach[k][0];
        left = centre + reach[k][1];
        this.groups[k] = drawn("g", { transform: `translate(${centre} ${ground})` }, this.moving);
        const name = drawn("text", { x: centre, y: ground + 0.2 * h + 16 * pixel, "font-size": 14 * pixel }, this.svg);
        name.textContent = ["column", "fixed mass", fixed ? "portal" : "frame"][k];
      }
    });

    const box = (parent, left, bottom, wide, high, kind) => drawn("rect", { x: left, y: -bottom - high, width: wide, height: high, class: kind }, parent);
    const parts = this.groups.map((group) => drawn("g", {}, group)), [alone, pot, pair] = parts;
    const dowels = (parent, axis) => [-0.5, 0.5].forEach((share) => drawn("path", { class: "dowel", d: `M${axis + share * b} ${-2 * h - 0.5 * depth}v${depth}` }, parent));
    box(alone, -b, 0, 2 * b, 2 * h, "column");
    box(pot, -b, 0, 2 * b, 2 * h, "column");
    box(pot, -cap / 2, 2 * h, cap, depth, "cap");
    dowels(pot, 0);
    const [left, right] = [-L / 2, L / 2].map((axis) => {
      const turning = drawn("g", {}, drawn("g", { transform: `translate(${axis} 0)` }, pair));
      box(turning, -b, 0, 2 * b, 2 * h, "column");
      return turning;
    });
    const lid = drawn("g", {}, pair);
    box(lid, -beam, 2 * h, 2 * beam, depth, "cap");
    if (fixed) for (const axis of [-L / 2, L / 2]) dowels(lid, axis);
    Object.assign(this, { single: alone, pot, whole: pair, left, right, cap: lid });
  }

  /** Draw the ground of a row. */
  soil(ground, width) {
    const { h } = this, reach = 2 * width, soil = drawn("g", { class: "soil", transform: `translate(0 ${ground})` }, this.moving);
    drawn("rect", { x: -reach, y: 0, width: 5 * reach, height: 0.2 * h }, soil);
    const hatch = Array.from({ length: Math.min(400, Math.ceil((3 * reach) / (0.28 * h))) }, (_, k) => `M${-reach + 0.28 * h * k} ${0.2 * h}l${0.16 * h} ${-0.2 * h}`);
    drawn("path", { d: hatch.join("") }, soil);
    drawn("path", { class: "surface", d: `M${-reach} 0H${3 * reach}` }, soil);
  }

  /** Colour each structure by its outcome: overturns, survives, outside or open. */
  outcomes(words) {
    this.groups.forEach((group, k) => group.setAttribute("class", words[k]));
  }

  /** Show the rotations (rad), the ground displacement (m) and its acceleration over the largest. */
  pose(rotations, displacement, acceleration) {
    const [alone, fixed, framed] = rotations.map((theta, k) => Math.sign(theta) * Math.min(Math.abs(theta), this.lying[k]));
    const turn = (element, theta, pivot) =>
      element.setAttribute("transform", `rotate(${(theta * 180) / Math.PI} ${Math.sign(theta) * pivot} 0)`);
    turn(this.single, alone, this.b);
    turn(this.pot, fixed, this.b);
    if (this.fixed) turn(this.whole, framed, this.span / 2 + this.b);
    else {
      turn(this.left, framed, this.b);
      turn(this.right, framed, this.b);
      const { b, h } = this, alpha = Math.atan2(b, h), lean = alpha - Math.abs(framed), diagonal = 2 * Math.hypot(b, h);
      const u = Math.sign(framed) * diagonal * (Math.sin(alpha) - Math.sin(lean)); // Eq. (4)
      const v = diagonal * (Math.cos(lean) - Math.cos(alpha)); // Eq. (7)
      this.cap.setAttribute("transform", `translate(${u} ${-v})`);
    }
    this.moving.setAttribute("transform", `translate(${displacement} 0)`);
    const length = 2.2 * this.h * acceleration, y = this.bottom;
    const head = Math.sign(length) * Math.min(16 * this.pixel, Math.abs(length)), aside = 0.45 * Math.abs(head);
    this.arrow.setAttribute("d", Math.abs(acceleration) < 0.005 ? "" : `M${this.middle} ${y}h${length}m${-head} ${-aside}l${head} ${aside}l${-head} ${aside}`);
  }
}
