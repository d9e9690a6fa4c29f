"use strict";
/* Ground motions, in g over s: the value, the Taylor series and the monotone pieces of each.

   Pulses are those of Zhang & Makris (2001), Housner (1963) and Makris & Vassiliou (2013). */

const RICKER_CENTRE = 4.5 * Math.PI; // of the phase ωt: τ = t − 2.25 T
const around = (...offsets) => [...offsets.map((x) => -x), ...offsets].sort((x, y) => x - y).map((x) => x + RICKER_CENTRE);

/* Of each pulse in the phase x = ωt: its wave, its slope, its length, where its slope is zero, and
   the c, d of the equation a″ = −c a − d (x − centre) a′ that gives its Taylor series. */
const SHAPES = {
  "one-sine": { wave: Math.sin, slope: Math.cos, length: 2 * Math.PI, turns: [0.5 * Math.PI, 1.5 * Math.PI], c: 1, d: 0 },
  "one-cosine": { wave: Math.cos, slope: (x) => -Math.sin(x), length: 2 * Math.PI, turns: [Math.PI], c: 1, d: 0 },
  "half-sine": { wave: Math.sin, slope: Math.cos, length: Math.PI, turns: [0.5 * Math.PI], c: 1, d: 0 },
  "constant": { wave: () => 1, slope: () => 0, length: Math.PI, turns: [], c: 0, d: 0 },
  "harmonic": { wave: Math.sin, slope: Math.cos, length: Infinity, turns: null, c: 1, d: 0 },
  "ricker-symmetric": { ...ricker(2, 1 / 4, 1), length: 9 * Math.PI, turns: around(0, Math.sqrt(6)) },
  "ricker-antisymmetric": {
    ...ricker(3, 1 / 6, Math.SQRT2 / 1.3801), length: 9 * Math.PI, // 1.3801 makes the peak 1
    turns: around(Math.sqrt(9 - 3 * Math.sqrt(6)), Math.sqrt(9 + 3 * Math.sqrt(6))),
  },
};
/** A Ricker wavelet: the second or third derivative of exp(−y²), y² = k (x − centre)². */
function ricker(derivative, k, scale) {
  const root = Math.sqrt(k), y = (x) => root * (x - RICKER_CENTRE);
  const second = (z) => (1 - 2 * z * z) * Math.exp(-z * z);
  const third = (z) => z * (2 * z * z - 3) * Math.exp(-z * z);
  const slopes = [
    (z) => z * (4 * z * z - 6) * Math.exp(-z * z),
    (z) => (-3 + z * z * (12 - 4 * z * z)) * Math.exp(-z * z),
  ];
  return {
    wave: (x) => scale * (derivative === 2 ? second : third)(y(x)),
    slope: (x) => scale * root * slopes[derivative - 2](y(x)),
    c: 2 * (derivative + 1) * k, d: 2 * k, // Hermite's equation
  };
}

/** A pulse of amplitude (g, negative mirrors it) and ω (rad/s), cut off at `end` (s) if given. */
function pulse(shape, amplitude, omega, end = Infinity) {
  const of = SHAPES[shape];
  end = Math.min(end, of.length / omega);
  const turns = of.turns ?? Array.from({ length: Math.ceil((end * omega) / Math.PI) }, (_, k) => (k + 0.5) * Math.PI);
  return {
    end, order: 15, largest: Math.abs(amplitude) * 1.0001, steepest: 2 * Math.abs(amplitude) * omega,
    edges: [0, ...turns.map((phase) => phase / omega).filter((t) => t < end), end],
    at: (t) => (t < end ? amplitude * of.wave(omega * t) : 0),
    within: (t) => amplitude * of.wave(omega * t), // without the end, for the piece that ends there
    kink: () => end,
    series(t, a, order) {
      a[0] = amplitude * of.wave(omega * t);
      a[1] = amplitude * omega * of.slope(omega * t);
      const square = omega * omega, d1 = of.d * square, d0 = of.d * omega * (omega * t - RICKER_CENTRE);
      for (let n = 0; n + 2 <= order; n++) {
        a[n + 2] = -((of.c * square + d1 * n) * a[n] + d0 * (n + 1) * a[n + 1]) / ((n + 1) * (n + 2));
      }
    },
  };
}

/** A record of a file: sample k (g, times `factor`) at k·step, linear between, zero outside. */
function record(file, factor = 1) {
  const { samples, step } = file, last = samples.length - 1, end = last * step;
  if (!file.edges) { // once, since a map has thousands of motions of one file
    const steepest = samples.reduce((most, a, k) => Math.max(most, k ? Math.abs(a - samples[k - 1]) / step : 0), 0);
    Object.assign(file, { edges: samples.map((_, k) => k * step), steepest });
  }
  const piece = (t) => {
    const k = Math.floor(t / step);
    return Math.min((k + 1) * step <= t ? k + 1 : k, last - 1);
  };
  const slope = (k) => (factor * (samples[k + 1] - samples[k])) / step;
  const within = (t, k = piece(t)) => factor * samples[k] + slope(k) * (t - k * step);
  return {
    end, order: 9, largest: Math.abs(factor) * file.peak, steepest: Math.abs(factor) * file.steepest, within, edges: file.edges,
    at: (t) => (t < end ? within(t) : 0),
    kink: (t) => (piece(t) + 1) * step,
    series(t, a, order) {
      const k = piece(t);
      a.fill(0, 2, order + 1);
      a[0] = within(t, k);
      a[1] = slope(k);
    },
  };
}

/** Ground at rest from one time to another. */
const still = (end) => ({
  end, order: 15, largest: 0, steepest: 0, edges: [0, end], at: () => 0, within: () => 0,
  kink: () => end, series: (_, a, order) => a.fill(0, 0, order + 1),
});

/** The first time from `time` on at which |a| exceeds the level (`jump`: it does so at once), and the
    sign of a there. */
function uplift(motion, time, level) {
  const { edges, within } = motion;
  let k = 0;
  if (edges.length > 8) k = Math.max(0, Math.floor((time / motion.end) * (edges.length - 1)) - 1);
  while (k + 1 < edges.length && edges[k + 1] <= time) k++;
  for (; k + 1 < edges.length; k++) {
    const start = Math.max(time, edges[k]), stop = edges[k + 1];
    if (start >= motion.end) return null;
    if (Math.abs(within(start)) > level) return { time: start, jump: true, sign: Math.sign(within(start)) };
    // Between two edges a is monotone: it exceeds the level at the later edge, or nowhere.
    if (Math.abs(within(stop)) <= level) continue;
    let low = start, high = stop;
    for (let i = 0; i < 80 && high - low > 1e-16 * high; i++) {
      const middle = 0.5 * (low + high);
      if (Math.abs(within(middle)) > level) high = middle;
      else low = middle;
    }
    return { time: low, jump: false, sign: Math.sign(within(stop)) };
  }
  return null;
}
