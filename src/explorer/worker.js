"use strict";
/* From the state of the controls to histories, numbers and the map of overturning.

   The page's worker runs this file. It answers the question that came last: first with histories,
   then with parts of the map, then with minima. In between it looks whether another question came. */

const CAP_DEPTH = 0.2; // of h: as drawn; the friction of a frame depends on it, its motion does not
const SAMPLES = 1500;
const GRIDS = { pulse: [80, 60], record: [48, 36] }; // cells of the map

/** What a cell of the map holds: the sum of those that overturn. */
const [COLUMN_FALLS, FRAME_FALLS] = [1, 2];

/** Column, vase, and the frame with its cap beam free or fixed.

    Throws a RangeError that names the field when a structure cannot rock. */
function structuresOf(state, scale = 1) {
  const [b, h, span] = [state.width, state.height, 2 * state.L].map((length) => (length * scale) / 2);
  const found = [
    column(b, h),
    vase(b, h, state.g),
    state.cap === "fixed" ? portal(b, h, state.g, span) : frame(b, h, state.g, span, CAP_DEPTH * h),
  ];
  for (const block of found) {
    if (state.r !== null) block.restitution = state.r;
    block.linearised = state.eq === "linearised";
    if (block.restitution < 0) {
      const error = new RangeError(
        `√r of the ${block.name} is ${block.restitution.toFixed(3)}: it would not keep rocking after an `
        + "impact; expected a smaller width, a larger height, or a √r of your own",
      );
      throw Object.assign(error, { field: "width" });
    }
  }
  return found;
}

const omegaOf = (state) => (2 * Math.PI) / state.T;

/** The peak ground acceleration of a state, g. */
const accelerationOf = (state, file) => (state.shape === "record" ? state.x * file.peak : state.a);

/** The ground motion of a state, with another peak acceleration (g) or ω (rad/s) if given. */
function motionOf(state, file, a = accelerationOf(state, file), omega = omegaOf(state)) {
  if (state.shape === "record") return record(file, a / file.peak);
  // A displacement of the ground that begins with + sin ωt has this acceleration.
  if (state.shape === "harmonic") return pulse("harmonic", -a, omega, state.D);
  return pulse(state.shape, a, omega);
}

/** Whether the ground would have to pull the base of a portal: the model then has no answer. */
const leavesGround = (block, motion, found) => block.name === "portal" && largestFriction(block, motion, found) === Infinity;

/** Whether a structure overturns under a motion of peak a (g), or is a portal that leaves the ground. */
function failsAt(state, file, block, a, omega) {
  const motion = motionOf(state, file, a, omega), start = startOf(state, block, a, omega);
  if (block.name !== "portal") return rock(block, motion, start).overturned;
  const found = rock(block, motion, { ...start, until: motion.end + 10 / block.p });
  return found.overturned || leavesGround(block, motion, found);
}

/** How a structure starts: at rest, or with the velocity of an abrupt start. */
function startOf(state, block, a, omega = omegaOf(state)) {
  const abrupt = state.shape === "harmonic" && state.start === "abrupt";
  return abrupt ? { velocity: abruptStart(block, a, omega) } : {};
}

/** Histories of the three structures at common times, and their numbers. */
function histories(state, file) {
  const blocks = structuresOf(state), motion = motionOf(state, file), a = accelerationOf(state, file);
  const until = windowOf(state, motion, blocks), times = Float64Array.from({ length: SAMPLES }, (_, k) => (until * k) / (SAMPLES - 1));
  const structures = blocks.map((block) => {
    const found = rock(block, motion, { ...startOf(state, block, a), until });
    const theta = sample(found, times);
    return {
      name: block.name, alpha: block.alpha, p: block.p, size: equivalentSize(block), restitution: block.restitution,
      uplift: upliftAcceleration(block), theta, overturned: found.overturned, moved: found.moved,
      peak: found.peak / block.alpha, flatAt: found.flatAt, leaves: leavesGround(block, motion, found),
      friction: block.linearised ? NaN : largestFriction(block, motion, found),
    };
  });
  const ground = times.map((t) => motion.at(t));
  return { times, ground, displacement: displacementOf(times, ground), structures, peak: a };
}

/** How long a history is shown, s: the motion, and some swings after it. */
function windowOf(state, motion, blocks) {
  const after = state.shape === "harmonic" ? 0 : 10 / Math.min(...blocks.map((block) => block.p));
  return Math.min(motion.end + after, 300);
}

/** The ground displacement that is drawn, m: what a seismometer of long period would show of it. */
function displacementOf(times, ground) {
  const corner = 0.5, step = times[1] - times[0], moved = new Float64Array(times.length); // 1/s, critically damped
  let velocity = 0;
  for (let k = 1; k < times.length; k++) {
    const a = (GRAVITY * (ground[k] + ground[k - 1])) / 2;
    velocity += step * (a - 2 * corner * velocity - corner * corner * moved[k - 1]);
    moved[k] = moved[k - 1] + step * velocity;
  }
  return moved;
}

/** The minimum overturning acceleration of a structure under the motion of a state, g; of a portal
    that leaves the ground below, the least acceleration at which it does. */
async function minimumOf(state, file, block, turn) {
  const minimum = await minimumOverturning(block, async (a) => (await turn(), failsAt(state, file, block, a))), a = minimum * (1 + 1e-9);
  const leaves = block.name === "portal" && minimum < Infinity && !rock(block, motionOf(state, file, a), startOf(state, block, a)).overturned;
  return { minimum, leaves };
}

/** Whether a relative change of the motion by 10⁻⁹ changes the outcome, or the peak by α/1000. */
function isSensitive(state, file, block) {
  const a = accelerationOf(state, file);
  const [one, ...others] = [1, 1 - 1e-9, 1 + 1e-9].map((factor) => rock(block, motionOf(state, file, a * factor), startOf(state, block, a * factor)));
  return others.some((other) => other.overturned !== one.overturned || Math.abs(other.peak - one.peak) > 1e-3 * block.alpha);
}

/** The plane of the map: what its axes are, their ranges, and where the state is in it.

    Pulses: ω over p of the column. Records: the size R of the column, all lengths in proportion. The
    amplitude is over g tan α of the column. The ranges grow by doubling until they hold the state. */
function planeOf(state, file) {
  const [alone] = structuresOf(state), isRecord = state.shape === "record";
  const here = { x: isRecord ? alone.lever : omegaOf(state) / alone.p, y: accelerationOf(state, file) / Math.tan(alone.alpha) };
  const x = isRecord ? [0.5, 20] : [0.5, 6], y = [0.93, 12];
  for (let k = 0; k < 12; k++) {
    if (here.x > x[1]) x[1] *= 2;
    if (here.x < x[0]) x[0] /= 2;
    if (here.y > y[1]) y[1] *= 2;
    if (here.y < y[0] && here.y > 0) y[0] /= 2;
  }
  const [columns, rows] = GRIDS[isRecord ? "record" : "pulse"];
  return { isRecord, x, y, here, columns, rows };
}

/** Everything that the map depends on, as two texts: of the column, and of the other structure. While
    they stay, the map stays. */
function planeKeys(state, file) {
  const { x, y, isRecord } = planeOf(state, file), [alone, , other] = structuresOf(state);
  const digits = (...numbers) => numbers.map((number) => number.toPrecision(10));
  const isSteady = state.shape === "harmonic";
  return [
    [state.shape, state.eq, x, y, isRecord && [file.name, file.opened], isSteady && [state.start, digits(state.D * alone.p)], digits(alone.alpha, alone.restitution)],
    digits(other.alpha, other.restitution, other.p / alone.p),
  ].map(String);
}

/** Whether the column, or the frame (or portal), overturns at one point of the plane. */
function fallsAt(state, file, plane, blocks, bit, x, y) {
  const a = y * Math.tan(blocks[0].alpha), omega = plane.isRecord ? 1 : x * blocks[0].p;
  const [alone, , other] = plane.isRecord ? structuresOf(state, x / blocks[0].lever) : blocks;
  return failsAt(state, file, bit === COLUMN_FALLS ? alone : other, a, omega);
}

const crossingAt = (codes, k, bit, up) => (2 * (bit - 1) + up) * codes.length + k; // its place in their list

/** Where each boundary crosses the way from the middle of a cell to that of the next, to the right and
    up, as a share of this way: by bisection. */
async function crossingsOf({ codes }, columns, falls, turn) {
  const crossings = new Float32Array(4 * codes.length).fill(0.5);
  for (let k = 0; k < codes.length; k++) {
    const i = (k % columns) + 0.5, j = Math.floor(k / columns) + 0.5, nexts = [i + 1 < columns && k + 1, k + columns];
    for (const bit of [COLUMN_FALLS, FRAME_FALLS]) {
      for (const up of [0, 1]) {
        if (!nexts[up] || nexts[up] >= codes.length || !((codes[k] ^ codes[nexts[up]]) & bit)) continue;
        await turn();
        let [low, high] = [0, 1];
        for (let step = 0; step < 4; step++) {
          const middle = (low + high) / 2;
          if (falls(bit, i + (1 - up) * middle, j + up * middle) === (codes[k] & bit) > 0) low = middle;
          else high = middle;
        }
        crossings[crossingAt(codes, k, bit, up)] = (low + high) / 2;
      }
    }
  }
  return crossings;
}

let map = { key: "" }; // the last one, which goes on where it was left

/** Fill the map in four rounds, each twice as fine, and report each tenth of a second once all cells
    have a code; under pulses find its edges at last. `turn` is awaited before each cell, with the
    stride of the round. */
async function spectrum(state, file, report, turn = () => {}) {
  const plane = planeOf(state, file), { columns, rows, x, y } = plane, blocks = structuresOf(state), keys = planeKeys(state, file);
  if (map.key !== String(keys)) map = { key: String(keys), codes: new Uint8Array(columns * rows), isKnown: new Uint8Array(columns * rows), done: 0, crossings: null };
  const { codes, isKnown } = map, isWhole = () => map.crossings || (plane.isRecord && map.done === codes.length);
  const tell = () => report({ keys, codes: codes.slice(), crossings: map.crossings, columns, rows, share: isWhole() ? 1 : (0.8 * map.done) / codes.length });
  const place = ([low, high], share, isLog) => (isLog ? low * (high / low) ** share : low + (high - low) * share);
  const falls = (bit, i, j) => fallsAt(state, file, plane, blocks, bit, place(x, i / columns, plane.isRecord), place(y, j / rows, true));
  let reported = performance.now();
  for (let stride = 8; stride >= 1; stride /= 2) {
    for (let i = 0; i < columns; i += stride) {
      for (let j = 0; j < rows; j += stride) {
        if (isKnown[i + columns * j]) continue;
        await turn(stride);
        const code = [COLUMN_FALLS, FRAME_FALLS].reduce((sum, bit) => sum + (falls(bit, i + 0.5, j + 0.5) ? bit : 0), 0);
        for (let k = i; k < Math.min(i + stride, columns); k++) {
          for (let l = j; l < Math.min(j + stride, rows); l++) if (!isKnown[k + columns * l]) codes[k + columns * l] = code;
        }
        isKnown[i + columns * j] = 1;
        map.done += 1;
        if (stride < 8 && performance.now() - reported > 100) {
          reported = performance.now();
          tell();
        }
      }
    }
    if (stride <= 2) tell();
  }
  if (isWhole()) return;
  map.crossings = await crossingsOf(map, columns, falls, turn);
  tell();
}

/** Answer questions, `{id, state}`, one after the other, and read files. */
function serve() {
  const records = new Map(), channel = new MessageChannel();
  let latest = null, told = null, isBusy = false, paused = 0;
  const messages = () => new Promise((next) => (channel.port1.onmessage = next, channel.port2.postMessage(0)));
  const tell = () => {
    if (told !== latest) postMessage({ id: latest.id, ...histories(latest.state, records.get(latest.state.record)) });
    told = latest;
  };

  async function answer(question) {
    const { id, state } = question, file = records.get(state.record), blocks = structuresOf(state), { shape } = state;
    const post = (data) => postMessage({ id, ...data });
    /* Let messages in, and leave what is out of date; but a coarse map of a pulse, which takes a moment
       only, is finished, so that the map follows while a slider is dragged. */
    const turn = async (stride = 1) => {
      if (performance.now() - paused > 10) {
        await messages();
        tell();
        paused = performance.now();
      }
      if (latest !== question && (stride < 2 || shape === "record" || shape === "harmonic")) throw new Error("out of date");
    };
    tell();
    for (const [index, block] of blocks.entries()) {
      post({ index, isSensitive: isSensitive(state, file, block) });
      await turn(2);
    }
    await spectrum(state, file, post, turn);
    for (const [index, block] of blocks.entries()) post({ index, ...(await minimumOf(state, file, block, turn)) });
  }

  async function work() {
    isBusy = true;
    for (let question = null; question !== latest;) {
      question = latest;
      await answer(question).catch((error) => question === latest && postMessage({ id: question.id, error: error.message }));
    }
    isBusy = false;
  }

  onmessage = async ({ data: { record, file, opened, ...question } }) => {
    if (record) records.set(record.name, record);
    else if (file) {
      try {
        const { samples, ...read } = { ...readRecord(file.name, new Uint8Array(await file.arrayBuffer())), opened };
        records.set(read.name, { ...read, samples });
        postMessage({ read });
      } catch (error) {
        postMessage({ unread: error.message });
      }
    } else {
      latest = question;
      if (!isBusy) work();
    }
  };
}

if (typeof window === "undefined" && typeof postMessage === "function") serve();
