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

/** One history over time, with a line at the time that is shown. */
class Strip {
  constructor(place, { label, last, band }) {
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
    this.head = made("div", { class: "playhead" });
    this.chart.over.append(this.head);
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

  /** Mark a time. */
  at(time) {
    this.head.style.transform = `translateX(${this.chart.valToPos(time, "x")}px)`;
  }
}

/** The area in which a structure overturns, and its border, through the crossings between cells. */
function areaOf({ codes, crossings, columns, rows }, bit) {
  const fill = new Path2D(), line = new Path2D();
  const within = (k, most) => Math.min(most - 1, Math.max(0, k)), at = ([i, j]) => within(i, columns) + columns * within(j, rows);
  const middle = (k, most) => Math.min(most, Math.max(0, k + 0.5)), place = ([i, j]) => [middle(i, columns), middle(j, rows)];
  for (let i = -1; i < columns; i++) {
    for (let j = -1; j < rows; j++) {
      const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]], isIn = corners.map((corner) => codes[at(corner)] & bit);
      const outline = [], ends = [];
      corners.forEach((corner, n) => {
        const other = corners[(n + 1) % 4], [first, last] = n < 2 ? [corner, other] : [other, corner]; // to the right, or up
        if (isIn[n]) outline.push(place(corner));
        if (isIn[n] === isIn[(n + 1) % 4]) return;
        const share = crossings ? crossings[crossingAt(codes, at(first), bit, n % 2)] : 0.5, to = place(last);
        ends.push(place(first).map((from, axis) => from + share * (to[axis] - from)));
        outline.push(ends.at(-1));
      });
      outline.forEach((point, n) => (n ? fill.lineTo(...point) : fill.moveTo(...point)));
      fill.closePath();
      if (!isIn[0] && ends.length) ends.push(ends.shift()); // a line leads from where the outline leaves the area to where it is back
      ends.forEach((point, n) => (n % 2 ? line.lineTo(...point) : line.moveTo(...point)));
    }
  }
  return { fill, line };
}

/** The map of overturning: which of two structures overturn, their boundaries, and where the state is. */
class Spectrum {
  constructor(place, pick) {
    const here = made("div", { class: "here" }, made("span", {}, "you are here"));
    Object.assign(this, { place, pick, here });
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
  outcomes({ keys, codes, crossings, columns, rows }) {
    if (keys[0] !== this.keys?.[0]) return;
    const [column, frame] = [COLUMN_FALLS, FRAME_FALLS].map((bit) => areaOf({ codes, crossings, columns, rows }, bit));
    this.cells = { codes, crossings, columns, rows, fills: [column.fill, frame.fill], lines: [[frame.line, 1.5, []], [column.line, 2.8, [0, 99]]] }; // a dot for each cell
    this.chart?.redraw(false, false);
  }

  paint({ ctx, bbox }) {
    if (!this.cells) return;
    const { columns, rows, fills, lines } = this.cells;
    const scaled = new DOMMatrix([bbox.width / columns, 0, 0, -bbox.height / rows, bbox.left, bbox.top + bbox.height]);
    const onChart = (path) => {
      const scaledPath = new Path2D();
      scaledPath.addPath(path, scaled);
      return scaledPath;
    };
    const [column, frame] = fills.map(onChart);
    const paint = (name, path) => (ctx.fillStyle = colour(name), ctx.fill(path));
    ctx.save();
    ctx.fillStyle = colour("paper");
    ctx.fillRect(bbox.left, bbox.top, bbox.width, bbox.height);
    paint("prevented", column);
    paint("caused", frame);
    ctx.save();
    ctx.clip(column);
    paint("both", frame);
    ctx.restore();
    ctx.strokeStyle = colour("ink");
    ctx.lineCap = "round";
    for (const [line, width, dash] of lines) {
      ctx.lineWidth = width * devicePixelRatio;
      ctx.setLineDash(dash);
      ctx.stroke(onChart(line));
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
