"use strict";
/* Column, vase and frame to scale, at one instant: Eqs. (4) and (7) for the cap beam. */

const SVG = "http://www.w3.org/2000/svg";

/** A new element of the drawing. */
function drawn(kind, attributes, parent) {
  const element = document.createElementNS(SVG, kind);
  for (const [key, text] of Object.entries(attributes)) element.setAttribute(key, text);
  parent.append(element);
  return element;
}

class Scene {
  constructor(svg, names) {
    Object.assign(this, { svg, names });
  }

  /** Build the bodies of a state at rest. */
  build(state) {
    const { b, h, L } = state, depth = CAP_DEPTH * h, beam = L / 2 + b, margin = 0.95 * h; // half widths
    const vaseHalf = Math.max(b, beam / 2), top = 2 * Math.hypot(b, h) + depth + 0.15 * h, below = 0.62 * h;
    const centres = [margin + b, 0, 0];
    centres[1] = centres[0] + b + margin + vaseHalf;
    centres[2] = centres[1] + vaseHalf + margin + beam;
    const width = centres[2] + beam + margin;
    this.svg.replaceChildren();
    this.svg.setAttribute("viewBox", `0 ${-top} ${width} ${top + below}`);
    this.svg.style.setProperty("--weight", state.g === Infinity ? 1 : state.g / (0.5 + state.g));
    this.svg.style.aspectRatio = `${width} / ${top + below}`;
    this.names.forEach((name, k) => (name.style.left = `${(100 * centres[k]) / width}%`));

    this.moving = drawn("g", {}, this.svg);
    const soil = drawn("g", { class: "soil" }, this.moving), reach = 2 * width;
    drawn("rect", { x: -reach, y: 0, width: 5 * reach, height: 0.2 * h }, soil);
    const hatch = Array.from({ length: Math.min(400, Math.ceil((3 * reach) / (0.28 * h))) }, (_, k) => `M${-reach + 0.28 * h * k} ${0.2 * h}l${0.16 * h} ${-0.2 * h}`);
    drawn("path", { d: hatch.join("") }, soil);
    drawn("path", { class: "surface", d: `M${-reach} 0H${3 * reach}` }, soil);
    this.arrow = drawn("path", { class: "arrow" }, this.svg);
    Object.assign(this, { h, middle: width / 2, fixed: state.cap === "fixed", span: L, b });

    const body = (parent, left, bottom, wide, high, kind) => drawn("rect", { x: left, y: -bottom - high, width: wide, height: high, class: kind }, parent);
    const group = (k) => drawn("g", { transform: `translate(${centres[k]} 0)` }, this.moving);
    this.groups = centres.map((_, k) => group(k));
    const single = drawn("g", {}, this.groups[0]), pot = drawn("g", {}, this.groups[1]), whole = drawn("g", {}, this.groups[2]);
    body(single, -b, 0, 2 * b, 2 * h, "column");
    body(pot, -b, 0, 2 * b, 2 * h, "column");
    body(pot, -beam / 2, 2 * h, beam, depth, "cap");
    const [left, right] = [-L / 2, L / 2].map((axis) => {
      const place = drawn("g", { transform: `translate(${axis} 0)` }, whole), turning = drawn("g", {}, place);
      body(turning, -b, 0, 2 * b, 2 * h, "column");
      return turning;
    });
    const cap = drawn("g", {}, whole);
    body(cap, -beam, 2 * h, 2 * beam, depth, "cap");
    Object.assign(this, { single, pot, whole, left, right, cap });
    // Where what overturns comes to lie: on the ground, or the columns of a frame on each other.
    const corner = Math.PI / 2 - Math.atan2(beam / 2 - b, 2 * h);
    this.lying = [Math.PI / 2, corner, this.fixed ? Math.PI / 2 : Math.acos(Math.min(1, (2 * b) / L))];
  }

  /** Colour each structure by its outcome. */
  outcomes(structures) {
    this.groups.forEach((group, k) => group.setAttribute("class", structures[k].overturned ? "overturns" : "survives"));
  }

  /** Show the rotations (rad), the ground displacement (m) and its acceleration over the largest. */
  pose(rotations, displacement, acceleration) {
    const [alone, fixed, framed] = rotations.map((theta, k) => Math.sign(theta) * Math.min(Math.abs(theta), this.lying[k]));
    rotations.forEach((theta, k) => (this.groups[k].style.opacity = Math.abs(theta) < this.lying[k] ? 1 : 0.5)); // it lies
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
    const length = 2.2 * this.h * acceleration, y = 0.42 * this.h;
    const head = Math.sign(length) * Math.min(0.2 * this.h, Math.abs(length)), aside = 0.45 * Math.abs(head);
    this.arrow.setAttribute("d", Math.abs(acceleration) < 0.005 ? "" : `M${this.middle} ${y}h${length}m${-head} ${-aside}l${head} ${aside}l${-head} ${aside}`);
  }
}
