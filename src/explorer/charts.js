"use strict";
/* Histories and the map of overturning, drawn by uPlot in the colours of the page. */

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
const AXIS_FONT = "12px system-ui, sans-serif";

const axis = (more) => ({
  stroke: () => colour("quiet"), font: AXIS_FONT, labelFont: AXIS_FONT, labelSize: 16, labelGap: 0, gap: 4,
  grid: { stroke: () => colour("line"), width: 1 }, ticks: { stroke: () => colour("line"), width: 1, size: 4 }, ...more,
});

/** Do something in a task of its own, so that many such things never hold the page up together. */
const soon = (work) => setTimeout(work);

/** The size of a chart that fills its place. */
const sizeOf = (place) => ({ width: Math.max(120, place.clientWidth), height: Math.max(40, place.clientHeight) });

/** Keep a chart as large as its place. `chart` returns it, or nothing as long as there is none. */
function fit(chart, place) {
  new ResizeObserver(() => soon(() => {
    const { width, height } = sizeOf(place);
    if (chart() && (width !== chart().width || height !== chart().height)) chart().setSize({ width, height });
  })).observe(place);
}

/** One history over time, with a line at the time that is shown; a press moves that time. */
class Strip {
  constructor(place, { label, last, seek, band }) {
    this.range = [-1, 1];
    this.stroke = "ink";
    this.levels = [];
    this.chart = new uPlot({
      ...sizeOf(place), legend: { show: false }, padding: [6, 8, last ? 0 : 6, 0],
      cursor: { y: false, points: { show: false }, drag: { x: false, y: false }, sync: { key: "time" } },
      scales: { x: { time: false }, y: { range: () => this.range } },
      axes: [
        axis({ show: last, size: 22, label: "Time (s)" }),
        axis({ size: 36, label, space: 18, ...(band ? { splits: () => [-1, 0, 1] } : {}) }),
      ],
      series: [{}, { stroke: () => colour(this.stroke), width: 1.5, spanGaps: false }],
      hooks: { drawClear: [(u) => this.shade(u, band)] },
    }, [[0, 1], [0, 0]], place);
    this.head = document.createElement("div");
    this.head.className = "playhead";
    this.chart.over.append(this.head);
    const move = (event) => {
      if (event.buttons === 1) seek(this.chart.posToVal(event.clientX - this.chart.over.getBoundingClientRect().left, "x"));
    };
    this.chart.over.addEventListener("pointerdown", move);
    this.chart.over.addEventListener("pointermove", move);
    fit(() => this.chart, place);
  }

  /** Shade |θ| < α, or draw the levels of uplift. */
  shade(u, band) {
    const { ctx, bbox } = u, y = (level) => u.valToPos(level, "y", true);
    ctx.save();
    if (band) {
      ctx.fillStyle = colour("band");
      ctx.fillRect(bbox.left, y(1), bbox.width, y(-1) - y(1));
    }
    ctx.strokeStyle = colour("quiet");
    ctx.setLineDash([4 * devicePixelRatio, 3 * devicePixelRatio]);
    for (const level of this.levels) {
      ctx.beginPath();
      ctx.moveTo(bbox.left, y(level));
      ctx.lineTo(bbox.left + bbox.width, y(level));
      ctx.stroke();
    }
    ctx.restore();
  }

  show(times, values, range, stroke, levels = []) {
    soon(() => {
      Object.assign(this, { range, stroke, levels });
      this.chart.setData([times, values]);
      this.at(this.time);
    });
  }

  at(time) {
    this.time = time;
    this.head.style.transform = `translateX(${this.chart.valToPos(time, "x")}px)`;
  }
}

/** The boundary of the cells whose code has a bit: segments from and to the middle between neighbours. */
function boundary(codes, columns, rows, bit) {
  const segments = [], has = (i, j) => (codes[i + columns * j] & bit) !== 0;
  for (let i = 0; i + 1 < columns; i++) {
    for (let j = 0; j + 1 < rows; j++) {
      const a = has(i, j), b = has(i + 1, j), c = has(i + 1, j + 1), d = has(i, j + 1), crossed = [];
      if (a !== b) crossed.push([i + 1, j + 0.5]);
      if (b !== c) crossed.push([i + 1.5, j + 1]);
      if (c !== d) crossed.push([i + 1, j + 1.5]);
      if (d !== a) crossed.push([i + 0.5, j + 1]);
      for (let k = 0; k < crossed.length; k += 2) segments.push([crossed[k], crossed[k + 1]]);
    }
  }
  return segments;
}

/** The map of overturning: which of two structures overturn, their boundaries, and where the state is. */
class Spectrum {
  constructor(place, pick) {
    this.place = place;
    this.pick = pick;
    this.image = document.createElement("canvas");
    this.plane = null;
    fit(() => this.chart, place);
    place.addEventListener("keydown", (event) => {
      const [right, up] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key] ?? [];
      if (right === undefined) return;
      event.preventDefault();
      const { x, y, here, columns, rows, isRecord } = this.plane, ratio = ([low, high], cells) => (high / low) ** (1 / cells);
      pick(isRecord ? here.x * ratio(x, columns) ** right : Math.max(x[0], here.x + (right * (x[1] - x[0])) / columns), here.y * ratio(y, rows) ** up);
    });
  }

  /** Set the plane: its axes anew when they change, and no cells until its own come. `keys` are two
      texts on which its cells depend; if only the second changes and `keeps`, the old ones wait for new. */
  frame(plane, keys, keeps) {
    const axes = JSON.stringify([plane.x, plane.y, plane.isRecord]), [column, frame] = keys;
    this.plane = plane;
    if (this.cells && column === this.keys[0] && frame !== this.keys[1] && keeps) this.cells.isWhole = false;
    else if (column !== this.keys?.[0] || frame !== this.keys[1]) this.cells = null;
    this.keys = keys;
    if (axes !== this.axes) {
      this.axes = axes;
      this.chart?.destroy();
      const ticks = (low, high) => [0.1, 0.2, 0.5, 1, 2, 3, 5, 10, 20, 50, 100, 200, 500].filter((v) => v >= low && v <= high);
      const log = { distr: 3, log: 10 };
      this.chart = new uPlot({
        ...sizeOf(this.place), legend: { show: false }, padding: [8, 10, 0, 0], cursor: { drag: { x: false, y: false }, points: { show: false } },
        scales: {
          x: { time: false, range: () => this.plane.x, ...(plane.isRecord ? log : {}) },
          y: { range: () => this.plane.y, ...log },
        },
        axes: [
          axis({
            size: 22, label: plane.isRecord ? "Size of the column, R (m)" : "Frequency of the pulse, ω/p", grid: { show: false },
            ...(plane.isRecord ? { splits: () => ticks(...plane.x), filter: (_, all) => all, values: (_, all) => all.map(String) } : {}),
          }),
          axis({
            size: 36, label: plane.isRecord ? "Peak, PGA/(g tan α)" : "Amplitude, a/(g tan α)", grid: { show: false },
            splits: () => ticks(...plane.y), filter: (_, all) => all, values: (_, all) => all.map(String),
          }),
        ],
        series: [{}, { paths: () => null, points: { show: false } }],
        hooks: { drawClear: [(u) => this.paint(u)], draw: [(u) => this.mark(u)] },
      }, [[1], [1]], this.place);
      const { over } = this.chart;
      over.addEventListener("click", (event) => {
        const box = over.getBoundingClientRect();
        this.pick(this.chart.posToVal(event.clientX - box.left, "x"), this.chart.posToVal(event.clientY - box.top, "y"));
      });
    } else this.chart.redraw(false, false);
  }

  /** Take the outcomes of the plane's cells, row by row from the lowest amplitude up; `share` of them are known. */
  outcomes({ id, codes, columns, rows, share }) {
    const [solid, dotted] = [new Path2D(), new Path2D()]; // in cells
    for (const [from, to] of boundary(codes, columns, rows, FRAME_FALLS)) {
      solid.moveTo(...from);
      solid.lineTo(...to);
    }
    for (const [from] of boundary(codes, columns, rows, COLUMN_FALLS)) {
      dotted.moveTo(...from);
      dotted.lineTo(...from);
    }
    this.cells = { id, codes, columns, rows, lines: [[solid, 1.5], [dotted, 2.8]], isWhole: share === 1 };
    this.recolour();
  }

  recolour() {
    if (!this.cells) return;
    const { codes, columns, rows } = this.cells;
    const names = ["paper", "prevented", "caused", "both"]; // by their codes
    const probe = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
    const palette = names.map((name) => {
      probe.fillStyle = colour(name);
      probe.fillRect(0, 0, 1, 1);
      return [...probe.getImageData(0, 0, 1, 1).data];
    });
    Object.assign(this.image, { width: columns, height: rows });
    const context = this.image.getContext("2d"), pixels = context.createImageData(columns, rows);
    codes.forEach((code, k) => pixels.data.set(palette[code], 4 * ((k % columns) + columns * (rows - 1 - Math.floor(k / columns)))));
    context.putImageData(pixels, 0, 0);
    this.chart?.redraw(false, false);
  }

  paint({ ctx, bbox }) {
    if (!this.cells) return;
    const { columns, rows, lines } = this.cells;
    ctx.save();
    ctx.imageSmoothingEnabled = false;
    ctx.drawImage(this.image, bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.strokeStyle = colour("ink");
    ctx.lineCap = "round";
    const scaled = new DOMMatrix([bbox.width / columns, 0, 0, -bbox.height / rows, bbox.left, bbox.top + bbox.height]);
    for (const [line, width] of lines) {
      const path = new Path2D();
      path.addPath(line, scaled);
      ctx.lineWidth = width * devicePixelRatio;
      ctx.stroke(path);
    }
    ctx.restore();
  }

  /** Draw "you are here". */
  mark(u) {
    const { ctx, bbox } = u, { here } = this.plane, ratio = devicePixelRatio;
    if (!(here.y > 0)) return;
    const x = u.valToPos(here.x, "x", true), y = Math.min(u.valToPos(here.y, "y", true), bbox.top + bbox.height);
    ctx.save();
    for (const [width, ink] of [[5, "paper"], [2, "ink"]]) {
      ctx.lineWidth = width * ratio;
      ctx.strokeStyle = colour(ink);
      ctx.beginPath();
      ctx.arc(x, y, 6 * ratio, 0, 2 * Math.PI);
      ctx.stroke();
    }
    ctx.font = `600 ${12 * ratio}px system-ui, sans-serif`;
    const words = "you are here", toLeft = x > bbox.left + bbox.width * 0.7;
    ctx.textAlign = toLeft ? "right" : "left";
    ctx.textBaseline = "middle";
    ctx.lineWidth = 4 * ratio;
    ctx.lineJoin = "round";
    ctx.strokeStyle = colour("paper");
    ctx.fillStyle = colour("ink");
    const at = x + (toLeft ? -12 : 12) * ratio, height = Math.min(y, bbox.top + bbox.height - 8 * ratio);
    ctx.strokeText(words, at, height);
    ctx.fillText(words, at, height);
    ctx.restore();
  }
}
