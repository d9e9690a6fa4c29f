"use strict";
/* The rocking of a block on its edges, by Taylor series: uplift, impacts, rest, overturning.

   With φ = |θ|, the side s = sgn θ and the ground acceleration a(t), rocking on one side obeys

       φ̈ = −p² { sin(α − φ) + s a cos(α − φ) }     Eqs. (3) and (23)
       φ̈ =  p² { φ − α − s a }                     linearised (Allen et al. 1986)

   The push q = −s a − tan α (linearised: −s a − α) is exactly zero when |a| passes the uplift
   acceleration. With it the same equations have no terms that cancel:

       φ̈ = p² { sin φ / cos α + q cos(α − φ) },    φ̈ = p² { φ + q }

   Every step is a polynomial, whose roots give the impacts and the turning points. */

// Roots of the polynomial of one step -----------------------------------------------------------

const value = (c, order, t) => {
  let sum = c[order];
  for (let k = order - 1; k >= 0; k--) sum = sum * t + c[k];
  return sum;
};

const SHIFTED = Array.from({ length: 64 }, () => new Float64Array(17)); // one for each depth of `roots`

/** Append to `found`, ascending, where a polynomial changes its sign in (low, high]. */
function roots(c, order, low, high, found, depth = 0) {
  const middle = 0.5 * (low + high), radius = 0.5 * (high - low), d = SHIFTED[depth];
  for (let k = 0; k <= order; k++) d[k] = c[k];
  for (let k = 0; k < order; k++) for (let i = order - 1; i >= k; i--) d[i] += middle * d[i + 1];
  let others = 0, bend = 0, power = radius;
  for (let k = 1; k <= order; k++, power *= radius) {
    const size = Math.abs(d[k]) * power;
    others += size;
    if (k > 1) bend += k * size;
  }
  if (Math.abs(d[0]) > others) return; // no root: the first term outweighs all others
  if (Math.abs(d[1]) * radius > bend || depth > 50) { // monotone: one root or none
    const above = value(c, order, high) > 0;
    if (value(c, order, low) > 0 !== above) found.push(root(d, order, radius, above) + middle);
    return;
  }
  roots(c, order, low, middle, found, depth + 1);
  roots(c, order, middle, high, found, depth + 1);
}

/** The only root in [−radius, radius]: Newton's step where it stays inside, otherwise halving. */
function root(c, order, radius, above) {
  let low = -radius, high = radius, t = 0;
  for (let i = 0; i < 100; i++) {
    let height = c[order], slope = 0;
    for (let k = order - 1; k >= 0; k--) {
      slope = slope * t + height;
      height = height * t + c[k];
    }
    if (height > 0 === above) high = t;
    else low = t;
    let next = t - height / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (Math.abs(next - t) <= 1e-16 * radius || next === t) return next;
    t = next;
  }
  return t;
}

// The motion ------------------------------------------------------------------------------------

const TOLERANCE = 1e-12; // of the last two terms of φ in a step, over α
const SMALL = 1e-6; // over α: a smaller rotation is not counted, and may be the last
const MOST_STEPS = 4e6;
const [ROTATION, SINE, COSINE, TILT, GROUND] = Array.from({ length: 5 }, () => new Float64Array(17));
const WORK = new Float64Array(17), ROOTS = [];

/** Fill ROTATION with the Taylor coefficients of φ about a state, to `order`. */
function expand(block, motion, state, order) {
  const { p, alpha, linearised } = block, square = p * p, c = ROTATION, q = GROUND;
  motion.series(state.time, q, order);
  for (let n = 0; n <= order; n++) q[n] *= -state.side;
  q[0] = state.zeros === 3 ? 0 : q[0] - block.level; // |a| passes the uplift acceleration
  c[0] = state.rotation;
  c[1] = state.rate;
  if (linearised) {
    for (let n = 0; n + 2 <= order; n++) c[n + 2] = (square * (c[n] + q[n])) / ((n + 1) * (n + 2));
    return;
  }
  const sine = Math.sin(alpha), cosine = Math.cos(alpha);
  SINE[0] = Math.sin(c[0]);
  COSINE[0] = Math.cos(c[0]);
  for (let n = 0; n + 2 <= order; n++) {
    TILT[n] = cosine * COSINE[n] + sine * SINE[n]; // cos(α − φ)
    let force = SINE[n] / cosine, up = 0, down = 0;
    for (let i = 0; i <= n; i++) {
      const rate = (i + 1) * c[i + 1]; // of φ̇
      force += q[i] * TILT[n - i];
      up += rate * COSINE[n - i];
      down += rate * SINE[n - i];
    }
    c[n + 2] = (square * force) / ((n + 1) * (n + 2)); // Eq. (23)
    SINE[n + 1] = up / (n + 1);
    COSINE[n + 1] = -down / (n + 1);
  }
}

/** The longest step over which the last two terms of φ stay below the tolerance. */
function stepLength(order, scale, limit) {
  let step = limit;
  for (const k of [order - 1, order]) {
    const size = Math.abs(ROTATION[k]);
    if (size > 0) step = Math.min(step, ((TOLERANCE * scale) / size) ** (1 / k));
  }
  return step;
}

/** What ends a step, and where: "landing" (φ = 0), "flat" (φ = ceiling) or "". Raises the peaks. */
function follow(block, state, order, step) {
  const c = ROTATION, { zeros } = state;
  let others = 0, above = c[0], bend = 0, power = 1;
  for (let k = 1; k <= order; k++) {
    const size = Math.abs(c[k]);
    if (k > 1) bend += k * size * power; // of φ̇
    power *= step;
    above += size * power;
  }
  power = 1;
  for (let k = zeros + 1; k <= order; k++) others += Math.abs(c[k]) * (power *= step);
  let event = "", end = step;
  if (c[zeros] <= others && c[1] <= bend) { // neither φ / t^zeros nor φ̇ is proven positive
    ROOTS.length = 0;
    roots(c.subarray(zeros), order - zeros, 0, step, ROOTS);
    if (ROOTS.length) [end, event] = [ROOTS[0], "landing"];
  }
  if (above > state.ceiling) {
    ROOTS.length = 0;
    WORK.set(c);
    WORK[0] -= state.ceiling;
    roots(WORK, order, 0, step, ROOTS);
    if (ROOTS.length && ROOTS[0] < end) [end, event] = [ROOTS[0], "flat"];
  }
  if (above > state.height) {
    ROOTS.length = 0;
    const first = Math.max(0, zeros - 1); // of φ̇: its zero at t = 0 is no turn
    for (let k = first; k < order; k++) WORK[k - first] = (k + 1) * c[k + 1];
    if (Math.abs(c[1]) <= bend) roots(WORK, order - 1 - first, 0, step, ROOTS); // it may turn
    ROOTS.push(end);
    for (const t of ROOTS) if (t <= end) state.height = Math.max(state.height, value(c, order, t));
    state.peak = Math.max(state.peak, state.height);
  }
  return [end, event];
}

/** Whether the bounces that begin are negligible and die out before the ground can uplift again.
    With a restoring acceleration of at least d, all bounces together last 2 φ̇ / d (1 − √r). */
function comesToRest(block, motion, state) {
  const restoring = (a) => (block.linearised
    ? block.p ** 2 * (block.alpha - a)
    : block.p ** 2 * (Math.sin(block.alpha) - a * Math.cos(block.alpha)));
  const now = Math.abs(motion.at(state.time)), d = restoring(now);
  if (state.rate === 0) return true;
  if (d <= 0 || block.restitution === 1 || state.rate ** 2 > 2 * d * SMALL * block.alpha) return false;
  const lasts = (4 * state.rate) / (d * (1 - block.restitution));
  return restoring(Math.min(motion.largest, now + motion.steepest * lasts)) > d / 2;
}

/** Carry the motion to the end of a ground motion, or until the structure lies flat. */
function carry(block, motion, state, keep) {
  while (state.time < motion.end && !state.flat) {
    if (!state.moving) {
      const start = uplift(motion, state.time, block.level);
      if (!start) {
        state.time = motion.end;
        return;
      }
      Object.assign(state, { time: start.time, side: -start.sign, rotation: 0, rate: 0, height: 0 });
      Object.assign(state, { zeros: start.jump ? 2 : 3, moving: true, moved: true });
    }
    const { order } = motion, stop = Math.min(motion.kink(state.time), motion.end), longest = stop - state.time;
    expand(block, motion, state, order);
    const step = stepLength(order, Math.max(block.alpha, state.rotation), longest);
    const [end, event] = follow(block, state, order, step);
    if (keep) keep.push({ time: state.time, length: end, side: state.side, c: ROTATION.slice(0, order + 1) });
    for (let k = 0; k < order; k++) WORK[k] = (k + 1) * ROTATION[k + 1];
    state.rate = value(WORK, order - 1, end);
    state.rotation = event === "landing" ? 0 : value(ROTATION, order, end);
    state.time = end === longest ? stop : state.time + end;
    state.zeros = 0;
    state.flat = event === "flat";
    if (event === "landing" || state.rotation <= 0) {
      if (state.height > SMALL * block.alpha) state.impacts.push(state.time);
      state.rate = block.restitution * Math.max(0, -state.rate); // Eq. (25)
      Object.assign(state, { side: -state.side, rotation: 0, height: 0, zeros: 1 });
      state.moving = !comesToRest(block, motion, state);
    }
    if (++state.steps > MOST_STEPS) throw new RangeError("more than four million steps: a shorter motion, or a smaller √r, has fewer");
  }
}

/** How free rocking ends, by energy: e = φ̇²/2p² + w(φ) against the barrier w(α). */
function ending(block, rotation, rate) {
  const { alpha, linearised } = block;
  const potential = (phi) => (linearised ? phi * (alpha - phi / 2) : 2 * Math.sin(alpha - phi / 2) * Math.sin(phi / 2));
  const turning = (short) => alpha - (linearised ? Math.sqrt(2 * short) : 2 * Math.asin(Math.sqrt(short / 2)));
  const energy = 0.5 * (rate / block.p) ** 2 + potential(rotation), barrier = potential(alpha);
  const safe = (peak) => ({ overturned: false, peak, impacts: 0 });
  if (rate === 0 && rotation <= alpha) return safe(rotation);
  if (rotation > alpha && (rate > 0 || energy < barrier)) return { overturned: true, impacts: 0 };
  if (rate > 0) return energy >= barrier ? { overturned: true, impacts: 0 } : safe(turning(barrier - energy));
  const rebound = block.restitution ** 2 * energy; // after the impact that comes
  if (rebound >= barrier) return { overturned: true, impacts: 1 };
  return safe(Math.max(rotation, turning(barrier - rebound)));
}

/** Follow a structure that is at rest when the ground motion begins.

    `velocity` is θ̇ at t = 0 (rad/s), after an abrupt start. `until` (s) keeps the history. Returns
    whether it overturned, whether it moved, the peak of φ over the whole motion (NaN if overturned),
    the number of impacts until it was settled, and the steps of the history. */
function rock(block, motion, { velocity = 0, until = 0 } = {}) {
  block = { ...block, level: upliftAcceleration(block) };
  const state = {
    time: 0, side: Math.sign(velocity), rotation: 0, rate: Math.abs(velocity), zeros: 1, height: 0, peak: 0,
    moving: velocity !== 0, moved: velocity !== 0, flat: false, impacts: [], steps: 0,
    // Linearised, it is pushed outward for good beyond α + max |a|.
    ceiling: block.linearised ? Math.max(Math.PI / 2, block.alpha + motion.largest) : Math.PI / 2,
  };
  const steps = until ? [] : null;
  carry(block, motion, state, steps);
  let end = { overturned: state.flat, peak: 0, impacts: 0 };
  if (state.moving && !state.flat) end = ending(block, state.rotation, state.rate);
  const found = {
    overturned: end.overturned, moved: state.moved, impacts: state.impacts.length + end.impacts,
    peak: end.overturned ? NaN : Math.max(state.peak, end.peak),
  };
  if (!until) return found;
  if (state.moving && !state.flat) {
    state.ceiling = Math.PI / 2;
    carry(block, still(until), state, steps);
  }
  return { ...found, steps, times: state.impacts, flatAt: state.flat ? state.time : Infinity };
}

/** θ at times of a kept history; zero at rest, NaN after it lies flat. */
function sample(history, times) {
  const { steps } = history;
  let k = 0;
  return times.map((t) => {
    while (k + 1 < steps.length && steps[k + 1].time <= t) k++;
    const step = steps[k], since = step ? t - step.time : -1;
    if (t > history.flatAt) return NaN;
    return since >= 0 && since <= step.length * (1 + 1e-12) ? step.side * value(step.c, step.c.length - 1, since) : 0;
  });
}

// What is asked of a structure ---------------------------------------------------------------------

/** θ̇ at t = 0⁺ when a shake table starts at full velocity: a sine of displacement, amplitude a (g). */
function abruptStart(block, amplitude, omega) {
  return -(block.p ** 2) * (block.linearised ? 1 : Math.cos(block.alpha)) * (amplitude / omega);
}

/* Ranges over the uplift acceleration that are searched one after the other, and their steps. */
const WINDOWS = [[1, 1.5, 0.01], [1.5, 3, 0.03], [3, 30, 0.05]];

/** The step (g) of the search at a peak a (g): narrower ranges of peaks that overturn can be missed. */
function searchStep(block, a) {
  const level = upliftAcceleration(block);
  return level * (WINDOWS.find(([, last]) => a <= last * level) ?? WINDOWS.at(-1))[2];
}

/** The minimum overturning acceleration (g) by bisection, Infinity when none is found up to 30
    times the uplift acceleration. `overturns(a)` promises whether a motion of peak a (g) does. */
async function minimumOverturning(block, overturns) {
  const level = upliftAcceleration(block);
  for (const [first, last, step] of WINDOWS) {
    const count = Math.max(1, Math.ceil((last - first) / step - 1e-9));
    let low = first * level;
    if (await overturns(low)) return low;
    for (let k = 1; k <= count; k++) {
      let high = (first + ((last - first) * k) / count) * level;
      if (await overturns(high)) {
        for (let i = 0; i < 60 && high - low > 1e-10 * high; i++) {
          const middle = 0.5 * (low + high);
          if (await overturns(middle)) high = middle;
          else low = middle;
        }
        return 0.5 * (low + high);
      }
      low = high;
    }
  }
  return Infinity;
}

/** The largest required friction of a kept history, up to where |θ| passes α for good. */
function largestFriction(block, motion, history) {
  const parts = 8;
  let last = history.steps.length - 1;
  if (history.overturned) while (last >= 0 && value(history.steps[last].c, history.steps[last].c.length - 1, 0) > block.alpha) last--;
  let largest = 0;
  for (const { time, length, side, c } of history.steps.slice(0, last + 1)) {
    for (let k = 0; k <= parts; k++) {
      const since = (length * k) / parts, order = c.length - 1, phi = value(c, order, since);
      let rate = 0;
      for (let n = order; n >= 1; n--) rate = rate * since + n * c[n];
      if (history.overturned && phi > block.alpha) continue;
      const a = time + since < motion.end ? motion.within(time + since) : 0;
      largest = Math.max(largest, requiredFriction(block, side, Math.max(0, phi), rate, a));
    }
  }
  return history.steps.length ? largest : NaN;
}
