// Properties of the chosen block: its values now, and one of them over time.
const HISTORY = { width: 300, height: 90, edge: 4 };

function makeSvg(name, attributes) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const key in attributes) element.setAttribute(key, attributes[key]);
  return element;
}

class BlockProperties {
  constructor(viewer) {
    this.viewer = viewer;
    this.cells = [];
  }

  // Anew for another block or another quantity.
  make() {
    const run = this.viewer.runs[this.viewer.chosen.run], b = this.viewer.chosen.block;
    if (b < 0) return;
    const table = document.createElement("table"), caption = document.createElement("caption");
    caption.textContent = "block " + (b + 1) + " of " + run.label + ", layer " + run.layer[b];
    table.appendChild(caption);
    this.cells = [];
    for (const quantity of QUANTITIES) {
      if (quantity.key === "layer" || (!run.hasFrames && quantity.moves) || (quantity.kept && !quantity.kept(run))) continue;
      const row = table.insertRow(), head = document.createElement("th"), cell = document.createElement("td");
      head.scope = "row";
      head.textContent = quantity.name;
      cell.className = "number";
      row.append(head, cell);
      this.cells.push({ quantity: quantity, cell: cell });
    }
    part("block-properties").replaceChildren(table, ...(run.times.length > 1 ? this.makeHistory(run, b) : []));
    this.show();
  }

  makeHistory(run, block) {
    const viewer = this.viewer, quantity = viewer.quantity, points = viewer.historyOf(run, block);
    const values = points.map(function (p) { return p[1]; }), least = Math.min.apply(null, values), most = Math.max.apply(null, values);
    const y = function (v) { return HISTORY.height - HISTORY.edge - (HISTORY.height - 2 * HISTORY.edge) * (most > least ? (v - least) / (most - least) : 0.5); };
    const picture = makeSvg("svg", { viewBox: "0 0 " + HISTORY.width + " " + HISTORY.height, role: "img", "aria-label": quantity.name + " of the block over time" });
    const line = points.map(function (p) { return viewer.properties.placeOf(p[0]).toFixed(1) + "," + y(p[1]).toFixed(1); }).join(" ");
    this.now = makeSvg("line", { y1: 0, y2: HISTORY.height, stroke: "currentColor", "stroke-dasharray": "2 3" });
    picture.append(makeSvg("polyline", { points: line, fill: "none", stroke: "currentColor" }), this.now);
    const below = document.createElement("p");
    below.className = "small";
    below.textContent = quantity.name + " over " + viewer.duration.toPrecision(3) + " s, from " + format(least, quantity) + " to " + format(most, quantity);
    return [picture, below];
  }

  placeOf(time) {
    return HISTORY.edge + (HISTORY.width - 2 * HISTORY.edge) * (this.viewer.duration > 0 ? time / this.viewer.duration : 0.5);
  }

  // The values at the time that is shown.
  show() {
    const run = this.viewer.runs[this.viewer.chosen.run], b = this.viewer.chosen.block;
    if (b < 0) return;
    for (const entry of this.cells) entry.cell.textContent = format(run.value(entry.quantity.key, b), entry.quantity);
    if (this.now) for (const end of ["x1", "x2"]) this.now.setAttribute(end, this.placeOf(this.viewer.time).toFixed(1));
  }
}
