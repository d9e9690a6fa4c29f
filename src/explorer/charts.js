"use strict";
/* Histories and the map of overturning, drawn by uPlot in the colours of the page. */

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
const AXIS_FONT = "12px system-ui, sans-serif";

const axis = (more) => ({
  stroke: () => colour("quiet"), font: AXIS_FONT, labelFont: AXIS_FONT, labelSize: 16, labelGap: 0, gap: 4,
  grid: { stroke: () => colour("line"), width: 1 }, ticks: { stroke: () => colour("line"), width: 1, size: 4 }, ...more,
});

/** The size of a chart that fills its place. */
const sizeOf = (place) => ({ width: Math.max(120, place.clientWidth), height: Math.max(40, place.clientHeight) });

/** Keep a chart as large as its place. `chart` returns it, or nothing as long as there is none. */
const fit = (chart, place) => new ResizeObserver(() => setTimeout(() => chart()?.setSize(sizeOf(place)))).observe(place);

/** One history over time, with a line at the time that is shown; a press moves that time. */
class Strip {
  constructor(place, { label, last, seek, band }) {
    Object.assign(this, { range: [-1, 1], levels: [] });
    this.chart = new uPlot({
      ...sizeOf(place), legend: { show: false }, padding: [6, 8, last ? 0 : 6, 0],
      cursor: { y: false, points: { show: false }, drag: { x: false, y: false }, sync: { key: "time" } },
      scales: { x: { time: false }, y: { range: () => this.range } },
      axes: [
        axis({ show: last, size: 22, label: "Time (s)" }),
        axis({ size: 36, label, space: 18, ...(band ? { splits: () => [-1, 0, 1] } : {}) }),
      ],
      series: [{}, { stroke: () => colour("ink"), width: 1.5, spanGaps: false }],
      hooks: { drawClear: [(u) => this.shade(u, band)] },
    }, [[0, 1], [0, 0]], place);
    this.curtain = made("div", { class: "curtain" });
    this.head = made("div", { class: "playhead" });
    this.chart.over.append(this.curtain, this.head);
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

  show(times, values, range, levels = []) {
    Object.assign(this, { range, levels });
    this.chart.setData([times, values]);
  }

  /** Mark a time, and hide what comes after the time that was seen. */
  at(time, seen) {
    const move = (element, to) => (element.style.transform = `translateX(${this.chart.valToPos(to, "x")}px)`);
    move(this.head, time);
    move(this.curtain, Math.min(seen, 2 * this.chart.scales.x.max));
  }
}

/** The border of the cells whose code has a bit: an edge for each two neighbours that differ. */
function border(codes, columns, rows, bit) {
  const path = new Path2D(), has = (i, j) => codes[i + columns * j] & bit;
  const edge = (...ends) => (path.moveTo(...ends.slice(0, 2)), path.lineTo(...ends.slice(2)));
  for (let i = 0; i < columns; i++) {
    for (let j = 0; j < rows; j++) {
      if (i + 1 < columns && has(i, j) !== has(i + 1, j)) edge(i + 1, j, i + 1, j + 1);
      if (j + 1 < rows && has(i, j) !== has(i, j + 1)) edge(i, j + 1, i + 1, j + 1);
    }
  }
  return path;
}

/** The map of overturning: which of two structures overturn, their boundaries, and where the state is. */
class Spectrum {
  constructor(place, pick) {
    const here = made("div", { class: "here" }, made("span", {}, "you are here"));
    Object.assign(this, { place, pick, here, image: made("canvas") });
    fit(() => this.chart, place);
    place.addEventListener("keydown", (event) => {
      const [right, up] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key] ?? [];
      if (right === undefined) return;
      event.preventDefault();
      const { x, y, here, columns, rows, isRecord } = this.plane, ratio = ([low, high], cells) => (high / low) ** (1 / cells);
      pick(isRecord ? here.x * ratio(x, columns) ** right : Math.max(x[0], here.x + (right * (x[1] - x[0])) / columns), here.y * ratio(y, rows) ** up);
    });
  }

  /** Set the plane: its axes anew when they change. `keys` are two texts on which its cells depend; if
      only the second changes, the old cells wait for new. */
  frame(plane, keys) {
    const axes = JSON.stringify([plane.x, plane.y, plane.isRecord]);
    this.plane = plane;
    if (keys[0] !== this.keys?.[0]) this.cells = null;
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
      over.append(this.here);
      over.addEventListener("click", (event) => {
        const box = over.getBoundingClientRect();
        this.pick(this.chart.posToVal(event.clientX - box.left, "x"), this.chart.posToVal(event.clientY - box.top, "y"));
      });
    } else this.chart.redraw(false, false);
  }

  /** Take the outcomes of the plane's cells, row by row from the lowest amplitude up, unless they are of another plane. */
  outcomes({ keys, codes, columns, rows }) {
    if (keys[0] !== this.keys?.[0]) return;
    const solid = border(codes, columns, rows, FRAME_FALLS), dotted = border(codes, columns, rows, COLUMN_FALLS);
    this.cells = { codes, columns, rows, lines: [[solid, 1.5, []], [dotted, 2.8, [0, 99]]] }; // a dot for each edge
    this.recolour();
  }

  recolour() {
    if (!this.cells) return;
    const { codes, columns, rows } = this.cells;
    const palette = ["paper", "prevented", "caused", "both"].map(colour).map((hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16))); // by codes
    Object.assign(this.image, { width: columns, height: rows });
    const context = this.image.getContext("2d"), pixels = context.createImageData(columns, rows);
    codes.forEach((code, k) => pixels.data.set([...palette[code], 255], 4 * ((k % columns) + columns * (rows - 1 - Math.floor(k / columns)))));
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
    for (const [line, width, dash] of lines) {
      const path = new Path2D();
      path.addPath(line, scaled);
      ctx.lineWidth = width * devicePixelRatio;
      ctx.setLineDash(dash);
      ctx.stroke(path);
    }
    ctx.restore();
  }

  /** Put "you are here" to its place. */
  mark(u) {
    const { here } = this.plane, x = u.valToPos(here.x, "x"), y = Math.min(u.valToPos(here.y, "y"), u.over.clientHeight);
    this.here.hidden = !(here.y > 0);
    this.here.style.transform = `translate(${x}px, ${y}px)`;
    this.here.classList.toggle("left", x > 0.7 * u.over.clientWidth);
  }
}
