// The page: filters, lists, cards.

const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const cardsAtOnce = 24;
const page = { limit: cardsAtOnce, charts: [], errorCost: new ErrorCostChart(data), nights: [...new Set(data.runs.map((run) => run.date))].sort() };

function fillSelect(select, values) {
  select.append(element("option", { value: "" }, "all"));
  for (const value of [...new Set(values)].filter(Boolean).sort()) select.append(element("option", { value }, value));
}

function fits(series) {
  const words = byId("search").value.toLowerCase().split(/\s+/).filter(Boolean);
  const text = `${series.quantity} ${series.kind} ${series.id} ${series.machine}`.toLowerCase();
  const agrees = (id, value) => !byId(id).value || byId(id).value === value;
  const show = byId("show").value;
  return agrees("case", series.case) && agrees("solver", series.solver) && agrees("family", series.family) &&
    words.every((word) => text.includes(word)) &&
    (show !== "changed" || series.findings.length > 0) &&
    (show !== "open" || series.findings.some((finding) => finding.state === "open"));
}

function showOnly(series) {
  for (const id of ["case", "solver", "family", "show"]) byId(id).value = "";
  byId("search").value = series.id;
  refresh();
  byId("trends").scrollIntoView();
}

function findingRow(series, finding) {
  const run = data.runs[series.points[finding.first][0]];
  const name = element("button", { type: "button", class: "link" }, series.quantity);
  name.addEventListener("click", () => showOnly(series));
  const after = "after" in finding ? valueText(series, finding.after) : "no value";
  return element("tr", { class: `finding-row ${finding.state}` },
    element("td", {}, element("span", { class: `word ${finding.verdict}` }, flagWords[finding.verdict]), element("br"), finding.state),
    element("td", {}, name, element("br"), element("span", { class: "kind" }, series.kind)),
    element("td", { class: "n" }, `${valueText(series, finding.before)} to ${after}`),
    element("td", { class: "n" }, `since ${run.commit}, ${day(run.date)}`),
    element("td", {}, finding.detail, element("br"), element("span", { class: "kind" }, `series ${series.id}`)));
}

function refreshFindings(shown) {
  const order = { open: 0, accepted: 1, fixed: 2, note: 3 };
  const all = shown.flatMap((series) => series.findings.map((finding) => ({ series, finding, date: data.runs[series.points[finding.first][0]].date })));
  all.sort((a, b) => order[a.finding.state] - order[b.finding.state] || (a.date < b.date ? 1 : a.date > b.date ? -1 : 0));
  const open = all.filter(({ finding }) => finding.state === "open").length;
  byId("state").textContent = open ? `${open} open regression${open > 1 ? "s" : ""} in this selection` : "No open regression in this selection";
  byId("state").className = open ? "open" : "clear";
  if (!all.length) { byId("findings").replaceChildren(); return; }
  const head = element("tr", {}, ...["Change", "Of", "From, to", "Since", "By how much"].map((text) => element("th", {}, text)));
  byId("findings").replaceChildren(element("table", {}, element("thead", {}, head),
    element("tbody", {}, ...all.slice(0, 200).map(({ series, finding }) => findingRow(series, finding)))));
}

function card(series) {
  const readout = element("p", { class: "readout" });
  const chart = new TrendChart(series, data.runs, showProvenance, (text) => { readout.textContent = text; });
  const open = series.findings.some((finding) => finding.state === "open");
  const remarks = [series.kind, series.machine, `series ${series.id}`, series.alarms ? "" : "raises no alarm", series.stale ? "not seen lately" : ""];
  const made = element("article", { class: open ? "card open" : "card", id: `series-${series.id}` },
    element("h3", { title: series.meaning }, series.quantity), element("p", {}, remarks.filter(Boolean).join("; ")), chart.svg, readout);
  page.charts.push({ chart, card: made });
  return made;
}

function drawCharts() {
  for (const { chart, card: made } of page.charts) chart.draw(made.clientWidth - 24);
  refreshErrorCost();
}

function refreshErrorCost() {
  const until = page.nights[Number(byId("night").value)] || "";
  byId("night-name").textContent = day(until);
  const agrees = (id, value) => !byId(id).value || byId(id).value === value;
  const shown = page.errorCost.kinds.filter((kind) => agrees("case", kind.case) && agrees("solver", kind.solver));
  const there = page.errorCost.draw(byId("error-cost-chart").clientWidth, shown, until);
  byId("error-cost-key").replaceChildren(...there.map(({ kind, last }) =>
    element("li", {}, `${kind.name}: ${(100 * last.error).toFixed(2)} %, ${significant(last.cost)} s (${last.commit})`)));
  byId("error-cost").hidden = shown.length === 0;
}

function refresh() {
  const shown = data.series.filter(fits);
  refreshFindings(shown);
  page.charts = [];
  byId("cards").replaceChildren(...shown.slice(0, page.limit).map(card));
  byId("more").hidden = shown.length <= page.limit;
  byId("more").textContent = `Show more (${shown.length - page.limit} left)`;
  if (!shown.length) byId("cards").append(element("p", { class: "hint" }, "No series fits these filters."));
  drawCharts();
}

function linkTo(run) {
  return run.href ? element("a", { href: run.href }, run.link) : run.link;
}

function hideProvenance() {
  byId("provenance").hidden = true;
  document.body.classList.remove("telling");
  if (page.picked) page.picked.release();
  page.picked = null;
}

function showProvenance(chart, index) {
  const series = chart.series;
  if (page.picked && page.picked !== chart) page.picked.release();
  page.picked = chart;
  const [number, value, reason] = series.points[index];
  const run = data.runs[number];
  const rows = [["Value", value === null ? `none: ${reason}` : valueText(series, value)], ["Exactly", value === null ? "" : `${value} ${series.unit === "1" ? "" : series.unit}`],
    ["Run of", series.kind], ["Date", run.date], ["Commit", run.commit], ["Machine", run.threads ? `${run.machine}; ${run.threads} threads` : run.machine],
    ["Compiler", `${run.compiler} ${run.flags}`.trim()], ["Run", run.run], ["Look at", linkTo(run)],
    ...series.findings.filter((finding) => finding.first === index).map((finding) => ["Change", `${flagWords[finding.verdict]}, ${finding.state}: ${finding.detail}`])];
  byId("provenance-title").textContent = series.quantity;
  byId("provenance-list").replaceChildren(...rows.filter(([, content]) => content).flatMap(([name, content]) =>
    [element("dt", {}, name), element("dd", {}, content)]));
  byId("provenance").hidden = false;
  document.body.classList.add("telling");
}

function describe() {
  const last = page.nights[page.nights.length - 1];
  let text = `${data.series.length} series of ${data.runs.length} runs and benchmarks${last ? ", the last of " + day(last) : ""}; page made ${data.made}.`;
  if (data.damaged.length) text += ` ${data.damaged.length} damaged line(s) of the ledger left out: ${data.damaged.map(([line]) => line).join(", ")}.`;
  byId("subtitle").textContent = text;
}

function start() {
  describe();
  fillSelect(byId("case"), data.series.map((series) => series.case));
  fillSelect(byId("solver"), data.series.map((series) => series.solver));
  byId("night").max = String(Math.max(0, page.nights.length - 1));
  byId("night").value = byId("night").max;
  byId("error-cost-chart").append(page.errorCost.svg);
  const filter = () => { page.limit = cardsAtOnce; refresh(); };
  for (const id of ["case", "solver", "family", "show"]) byId(id).addEventListener("change", filter);
  byId("search").addEventListener("input", filter);
  byId("filters").addEventListener("submit", (event) => event.preventDefault());
  byId("clear").addEventListener("click", () => { byId("filters").reset(); filter(); });
  byId("more").addEventListener("click", () => { page.limit += cardsAtOnce; refresh(); });
  byId("night").addEventListener("input", refreshErrorCost);
  byId("close").addEventListener("click", hideProvenance);
  document.addEventListener("keydown", (event) => { if (event.key === "Escape") hideProvenance(); });
  window.addEventListener("resize", drawCharts);
  refresh();
}

start();
