"use strict";
// Values, dates and small elements.

function significant(value) {
  const size = Math.abs(value);
  if (value === 0) return "0";
  if (size >= 1e6 || size < 1e-3) return value.toExponential(2).replace("e+", "e");
  return String(Number(value.toPrecision(4)));
}

// As the ledger's summary writes them.
function valueText(series, value) {
  if (series.form === "percent") return (value > 0 && series.better === "nearest zero" ? "+" : "") + (100 * value).toFixed(2) + " %";
  if (series.form === "milliseconds") return (value > 0 ? "+" : "") + (1000 * value).toFixed(1) + " ms";
  return significant(value) + (series.unit === "1" ? "" : " " + series.unit);
}

// Axis labels: without the unit, which stands beside the axis once.
function axisText(series, value, step) {
  const scale = series.form === "percent" ? 100 : series.form === "milliseconds" ? 1000 : 1;
  const digits = Math.max(0, -Math.floor(Math.log10(scale * step) + 1e-9));
  const scaled = scale * value;
  if (Math.abs(scaled) >= 1e5 || (scaled !== 0 && digits > 5)) return significant(scaled);
  return (Math.abs(scaled) < scale * step / 1e6 ? 0 : scaled).toFixed(Math.min(digits, 5));
}

function axisUnit(series) {
  if (series.form === "percent") return "%";
  if (series.form === "milliseconds") return "ms";
  return series.unit === "1" ? "" : series.unit;
}

function day(date) {
  return date.slice(0, 10);
}

// Between three and six round values that lie within [low, high], and their distance.
function ticks(low, high) {
  const raw = (high - low) / 4;
  const power = Math.pow(10, Math.floor(Math.log10(raw)));
  const step = [1, 2, 5, 10].map((k) => k * power).find((s) => s >= raw * 0.999);
  const values = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) values.push(k * step);
  return { values, step };
}

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

function drawn(name, attributes = {}, text = "") {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text) made.textContent = text;
  return made;
}

const flagShapes = { worse: "M0 -6 L6 5 L-6 5 Z", better: "M0 6 L6 -5 L-6 -5 Z", moved: "M0 -6 L5 0 L0 6 L-5 0 Z", missing: "M-5 -5 L5 5 M5 -5 L-5 5" };
const flagWords = { worse: "▲ worse", better: "▼ better", moved: "◆ moved", missing: "✕ missing" };

function isHollow(finding) {
  return finding.state === "accepted" || finding.state === "fixed";
}
