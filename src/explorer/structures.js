"use strict";
/* Column, vase and frame as rocking blocks, and the friction that their contacts require.

   Plain JavaScript without a page: it runs in the page, in its workers and in tests. Equation numbers
   are those of Makris & Vassiliou (2014). Units are m, s and rad; ground accelerations are in g. */

const GRAVITY = 9.81; // m/s², as the paper computes

/** A free-standing column, half width b and half height h: p = √(3g/4R), √r = 1 − 3/2 sin²α. */
function column(b, h) {
  const size = Math.hypot(b, h), sine = b / size;
  return {
    name: "column", p: Math.sqrt((3 * GRAVITY) / (4 * size)), alpha: Math.atan2(b, h),
    restitution: 1 - 1.5 * sine * sine, lever: size, b, h,
  };
}

/** Two columns under a free cap beam, γ = m_b / 2 m_c: p̂ of Eq. (23), √r of Eq. (25). */
function frame(b, h, gamma, span, depth) {
  const alone = column(b, h);
  const cap = gamma === Infinity ? 1 : gamma / (1 / 3 + gamma); // 3γ/(1 + 3γ)
  const larger = gamma === Infinity ? 1.5 : 1 + (0.5 * gamma) / (0.5 + gamma); // R̂/R, Eq. (24)
  return {
    ...alone, name: "frame", p: alone.p / Math.sqrt(larger), gamma, span, depth,
    restitution: (1 - cap) * alone.restitution + cap * Math.cos(2 * alone.alpha), // Eq. (25)
  };
}

/** One body on the edges of its base: half base B, height H of its centre, I/M about an edge. */
function oneBody(name, B, H, inertia) {
  const lever = Math.hypot(B, H);
  return {
    name, p: Math.sqrt((GRAVITY * lever) / inertia), alpha: Math.atan2(B, H),
    restitution: 1 - (2 * B * B) / inertia, lever, b: B, h: H,
  };
}

/** The cap beam's mass fixed to the top of a column: γ is its mass over that of the column. */
function vase(b, h, gamma) {
  const cap = gamma === Infinity ? 1 : gamma / (1 + gamma);
  const inertia = (1 - cap) * ((4 / 3) * (b * b + h * h)) + cap * (b * b + 4 * h * h);
  return oneBody("fixed mass", b, (1 - cap) * h + cap * 2 * h, inertia);
}

/** The cap beam fixed to both columns: one body that rocks about its outer edges. */
function portal(b, h, gamma, span) {
  const cap = gamma === Infinity ? 1 : gamma / (1 + gamma), axis = span / 2, B = axis + b;
  const inertia = (1 - cap) * ((b * b + h * h) / 3 + B * B + axis * axis + h * h)
    + cap * ((4 * B * B) / 12 + B * B + 4 * h * h);
  return oneBody("portal", B, (1 - cap) * h + cap * 2 * h, inertia);
}

/** The ground acceleration above which a structure uplifts: tan α, linearised α. */
const upliftAcceleration = (block) => (block.linearised ? block.alpha : Math.tan(block.alpha));

/** The size of the solitary column with the same p, Eq. (24). */
const equivalentSize = (block) => (3 * GRAVITY) / (4 * block.p * block.p);

/** Force over weight of a body at a distance from the pivot: (ü_g + ẍ, g + z̈)/g, Eqs. (6), (9). */
function load(block, distance, side, lean, rate, a) {
  const sin = Math.sin(lean), cos = Math.cos(lean);
  const across = (-(block.p ** 2) * (side * sin + a * cos) * distance) / GRAVITY; // Eq. (23)
  const inward = (distance * rate * rate) / GRAVITY;
  return [a + across * cos + inward * side * sin, 1 + across * side * sin - inward * cos];
}

/** The required coefficient of friction of the contacts at one instant of rocking to a side.

    Column, vase and portal have one reaction. The cap beam of a frame shares its load between the
    column tops by Eqs. (10)–(18) and by its own balance of moments. */
function requiredFriction(block, side, phi, rate, a) {
  const demand = ([horizontal, vertical]) => (vertical > 0 ? Math.abs(horizontal) / vertical : Infinity);
  const lean = block.alpha - phi;
  if (block.name !== "frame") return demand(load(block, block.lever, side, lean, rate, a));
  const { gamma, b, span, depth, lever } = block;
  const each = gamma === Infinity ? 0 : 0.5 / (1 + gamma), beam = 1 - 2 * each;
  const [cx, cz] = load(block, lever, side, lean, rate, a).map((force) => each * force); // Eqs. (10), (11)
  const [bx, bz] = load(block, 2 * lever, side, lean, rate, a).map((force) => beam * force); // Eqs. (12), (13)
  const shift = (side * b * bz - (depth / 2) * bx) / span, aside = -side * Math.tan(lean) * shift;
  let largest = 0;
  for (const end of [-1, 1]) {
    const top = [bx / 2 + end * aside, bz / 2 + end * shift];
    if (beam > 0) largest = Math.max(largest, demand(top));
    largest = Math.max(largest, demand([top[0] + cx, top[1] + cz]));
  }
  return largest;
}
