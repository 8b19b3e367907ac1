// One series over time.

class TrendChart {
  // `choose(chart, index)` is called when a point is clicked, `tell(text)` when one is pointed at.
  constructor(series, runs, choose, tell) {
    this.series = series;
    this.runs = runs;
    this.choose = choose;
    this.tell = tell;
    this.current = -1;
    this.picked = -1;
    this.svg = drawn("svg", { role: "img", tabindex: "0", "aria-label": `${series.quantity}, ${series.points.length} runs` });
    this.svg.addEventListener("pointermove", (event) => this.pointAt(this.nearest(event)));
    this.svg.addEventListener("pointerleave", () => this.pointAt(this.picked));
    this.svg.addEventListener("click", (event) => this.pick(this.nearest(event)));
    this.svg.addEventListener("keydown", (event) => this.key(event));
  }

  draw(width) {
    this.width = Math.max(260, width);
    this.height = 190;
    this.frame = { left: 52, right: this.width - 12, top: 24, bottom: this.height - 22 };
    this.svg.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    this.svg.replaceChildren();
    this.scale();
    this.drawAxes();
    this.drawTrace();
    this.drawLevels();
    this.drawFindings();
    this.drawDots();
    this.ring = this.svg.appendChild(drawn("circle", { class: "ring", r: 6, visibility: "hidden" }));
    this.pointAt(this.picked);
  }

  scale() {
    const times = this.series.points.map(([run]) => Date.parse(this.runs[run].date));
    const values = this.series.points.map(([, value]) => value).filter((value) => value !== null);
    let low = Math.min(...values), high = Math.max(...values);
    if (!values.length) [low, high] = [0, 1];
    const margin = high > low ? 0.08 * (high - low) : 0.05 * Math.abs(high) || (this.series.form === "plain" ? 1 : 1e-3);
    this.low = low - margin;
    this.high = high + margin;
    const first = Math.min(...times), last = Math.max(...times);
    const span = Math.max(last - first, 864e5);
    const { left, right, top, bottom } = this.frame;
    this.x = times.map((time) => left + 6 + ((time - first) / span) * (right - left - 12));
    this.y = (value) => bottom - ((value - this.low) / (this.high - this.low)) * (bottom - top);
    this.firstTime = first;
    this.lastTime = last;
  }

  drawAxes() {
    const { left, right, top, bottom } = this.frame;
    const { values, step } = ticks(this.low, this.high);
    for (const value of values) {
      const at = this.y(value), isZero = Math.abs(value) < 1e-9 * step;
      this.svg.append(drawn("line", { class: isZero ? "zero" : "grid", x1: left, x2: right, y1: at, y2: at }),
                      drawn("text", { x: left - 5, y: at + 4, "text-anchor": "end" }, axisText(this.series, value, step)));
    }
    this.svg.append(drawn("text", { x: left - 5, y: top - 10, "text-anchor": "end" }, axisUnit(this.series)),
                    drawn("text", { x: left, y: bottom + 17 }, day(new Date(this.firstTime).toISOString())));
    if (this.lastTime > this.firstTime)
      this.svg.append(drawn("text", { x: right, y: bottom + 17, "text-anchor": "end" }, day(new Date(this.lastTime).toISOString())));
  }

  drawTrace() {
    let path = "", pen = "M";
    this.series.points.forEach(([, value], k) => {
      if (value === null) { pen = "M"; return; }
      path += `${pen}${this.x[k].toFixed(1)} ${this.y(value).toFixed(1)}`;
      pen = "L";
    });
    this.svg.append(drawn("path", { class: "trace", d: path }));
  }

  // The mean between one change and the next.
  drawLevels() {
    const edges = [0, ...this.series.findings.map((finding) => finding.first), this.series.points.length];
    for (let k = 0; k + 1 < edges.length; ++k) {
      const part = this.series.points.slice(edges[k], edges[k + 1]).map(([, value]) => value).filter((value) => value !== null);
      if (part.length < 2) continue;
      const level = this.y(part.reduce((sum, value) => sum + value, 0) / part.length);
      this.svg.append(drawn("line", { class: "level", x1: this.x[edges[k]], x2: this.x[edges[k + 1] - 1], y1: level, y2: level }));
    }
  }

  drawFindings() {
    for (const finding of this.series.findings) {
      const before = finding.first > 0 ? this.x[finding.first - 1] : this.x[finding.first];
      const at = (before + this.x[finding.first]) / 2;
      const flag = drawn("g", { class: `finding ${finding.verdict}`, transform: `translate(${at.toFixed(1)} 12)` });
      flag.append(drawn("title", {}, `${flagWords[finding.verdict]}, ${finding.state}: ${finding.detail}`), drawn("path", { class: isHollow(finding) ? "flag hollow" : "flag", d: flagShapes[finding.verdict] }));
      this.svg.append(drawn("line", { class: "change", x1: at, x2: at, y1: this.frame.top - 2, y2: this.frame.bottom }), flag);
    }
  }

  drawDots() {
    this.series.points.forEach(([, value], k) => {
      if (value === null) {
        const shape = { class: "missing flag", d: flagShapes.missing, transform: `translate(${this.x[k].toFixed(1)} ${this.frame.bottom - 6}) scale(0.6)` };
        this.svg.append(drawn("path", shape));
      } else {
        this.svg.append(drawn("circle", { class: "dot", r: 2.6, cx: this.x[k].toFixed(1), cy: this.y(value).toFixed(1) }));
      }
    });
  }

  heightOf(index) {
    const value = this.series.points[index][1];
    return value === null ? this.frame.bottom - 6 : this.y(value);
  }

  // The point that is nearest to the pointer.
  nearest(event) {
    const box = this.svg.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * this.width;
    const y = ((event.clientY - box.top) / box.height) * this.height;
    let best = -1, least = Infinity;
    this.x.forEach((at, k) => {
      const distance = Math.hypot(at - x, 0.3 * (this.heightOf(k) - y));
      if (distance < least) [best, least] = [k, distance];
    });
    return best;
  }

  pointAt(index) {
    this.current = index;
    this.ring.setAttribute("visibility", index < 0 ? "hidden" : "visible");
    if (index < 0) { this.tell(""); return; }
    const [run, value] = this.series.points[index];
    this.ring.setAttribute("cx", this.x[index]);
    this.ring.setAttribute("cy", this.heightOf(index));
    this.tell(`${day(this.runs[run].date)}  ${this.runs[run].commit}  ${value === null ? "no value" : valueText(this.series, value)}`);
  }

  pick(index) {
    if (index < 0) return;
    this.picked = index;
    this.pointAt(index);
    this.choose(this, index);
  }

  release() {
    this.picked = -1;
    this.pointAt(-1);
  }

  key(event) {
    const last = this.series.points.length - 1;
    const moves = { ArrowLeft: Math.max(0, this.current < 0 ? last : this.current - 1), ArrowRight: Math.min(last, this.current + 1), Home: 0, End: last };
    if (event.key in moves) this.pointAt(moves[event.key]);
    else if (event.key === "Enter" || event.key === " ") this.pick(this.current);
    else return;
    event.preventDefault();
  }
}

// Mean impulse error against processor time, by kind of run.
class ErrorCostChart {
  constructor(data) {
    this.runs = data.runs;
    this.kinds = this.join(data.series);
    this.svg = drawn("svg", { role: "img", "aria-label": "Error against cost" });
  }

  // Pairs the two metrics of each run.
  join(all) {
    const kinds = new Map();
    for (const series of all) {
      if (series.metric !== "mean_impulse_error" && series.metric !== "cpu_time_s") continue;
      if (!kinds.has(series.kind)) kinds.set(series.kind, { name: series.kind, case: series.case, solver: series.solver, byRun: new Map() });
      const byRun = kinds.get(series.kind).byRun;
      for (const [run, value] of series.points) {
        if (!byRun.has(run)) byRun.set(run, {});
        byRun.get(run)[series.metric] = value;
      }
    }
    for (const kind of kinds.values()) {
      kind.points = [...kind.byRun].filter(([, both]) => both.mean_impulse_error != null && both.cpu_time_s > 0)
        .map(([run, both]) => ({ date: this.runs[run].date, commit: this.runs[run].commit, error: both.mean_impulse_error, cost: both.cpu_time_s }))
        .sort((a, b) => (a.date < b.date ? -1 : 1));
    }
    return [...kinds.values()].filter((kind) => kind.points.length);
  }

  // `shown`: kinds to draw; `until`: the last date. Returns the kinds that have a point by then.
  draw(width, shown, until) {
    const frame = { left: 56, right: Math.max(260, width) - 16, top: 24, bottom: 276 };
    this.svg.setAttribute("viewBox", `0 0 ${Math.max(260, width)} 316`);
    this.svg.replaceChildren();
    const every = shown.flatMap((kind) => kind.points);
    if (!every.length) return [];
    const high = 1.08 * Math.max(...every.map((point) => point.error));
    const [cheap, dear] = [0.85 * Math.min(...every.map((p) => p.cost)), 1.18 * Math.max(...every.map((p) => p.cost))];
    const x = (cost) => frame.left + (Math.log(cost / cheap) / Math.log(dear / cheap)) * (frame.right - frame.left);
    const y = (error) => frame.bottom - (error / high) * (frame.bottom - frame.top);
    this.drawAxes(frame, x, y, high, cheap, dear);
    const there = [];
    for (const kind of shown) {
      const points = kind.points.filter((point) => point.date <= until);
      if (!points.length) continue;
      there.push({ kind, last: points[points.length - 1] });
      this.drawKind(points, kind.solver, there.length, x, y);
    }
    return there;
  }

  drawAxes(frame, x, y, high, cheap, dear) {
    const percent = { form: "percent", better: "smaller" };
    const { values, step } = ticks(0, high);
    for (const value of values)
      this.svg.append(drawn("line", { class: "grid", x1: frame.left, x2: frame.right, y1: y(value), y2: y(value) }),
                      drawn("text", { x: frame.left - 6, y: y(value) + 4, "text-anchor": "end" }, axisText(percent, value, step)));
    const costs = [];
    for (let power = Math.floor(Math.log10(cheap)); power <= Math.ceil(Math.log10(dear)); ++power)
      for (const k of [1, 2, 5]) if (k * 10 ** power >= cheap && k * 10 ** power <= dear) costs.push(k * 10 ** power);
    for (const cost of costs)
      this.svg.append(drawn("line", { class: "grid", x1: x(cost), x2: x(cost), y1: frame.top, y2: frame.bottom }),
                      drawn("text", { x: x(cost), y: frame.bottom + 17, "text-anchor": "middle" }, significant(cost)));
    this.svg.append(drawn("text", { x: 4, y: 13 }, "mean impulse error [%]"),
                    drawn("text", { x: frame.right, y: frame.bottom + 34, "text-anchor": "end" }, "processor time of a run [s]"));
  }

  drawKind(points, solver, number, x, y) {
    const [colour, shape] = { wcsph: ["#0072b2", "circle"], mps: ["#cc79a7", "square"] }[solver] || ["#e69f00", "diamond"];
    const mark = (point, size, faint) => {
      const shapes = { circle: `M-${size} 0 A${size} ${size} 0 1 0 ${size} 0 A${size} ${size} 0 1 0 -${size} 0`,
                       square: `M-${size} -${size} H${size} V${size} H-${size} Z`, diamond: `M0 -${size} L${size} 0 L0 ${size} L-${size} 0 Z` };
      const made = drawn("path", { d: shapes[shape], fill: colour, class: faint ? "faint" : "latest", transform: `translate(${x(point.cost).toFixed(1)} ${y(point.error).toFixed(1)})` });
      made.append(drawn("title", {}, `${day(point.date)} ${point.commit}: ${(100 * point.error).toFixed(2)} %, ${significant(point.cost)} s`));
      return made;
    };
    const last = points[points.length - 1];
    for (const point of points.slice(0, -1)) this.svg.append(mark(point, 3, true));
    this.svg.append(mark(last, 6, false),
                    drawn("text", { class: "number", x: x(last.cost) + 9, y: y(last.error) - 6 }, String(number)));
  }
}
