// Keys in the view. They act where the view or a button of it has the focus; those of ALSO_FROM_PAGE also while nothing has it and
// the view is seen. Fields that one types into, lists and other sliders keep all of theirs.
const KEYS = [
  { keys: [" "], shown: "Space", does: "play, pause", act: function (viewer) { viewer.play(!viewer.playing); } },
  { keys: ["ArrowLeft"], shown: "←", does: "one frame back", act: function (viewer) { viewer.step(-1); } },
  { keys: ["ArrowRight"], shown: "→", does: "one frame on", act: function (viewer) { viewer.step(1); } },
  { keys: ["Home"], shown: "Home", does: "to the start", act: function (viewer) { viewer.goTo(0); } },
  { keys: ["End"], shown: "End", does: "to the end", act: function (viewer) { viewer.goTo(viewer.duration); } },
  { keys: ["Shift+ArrowLeft"], shown: "Shift ←", does: "turn left", act: function (viewer) { viewer.turn(-0.1, 0); } },
  { keys: ["Shift+ArrowRight"], shown: "Shift →", does: "turn right", act: function (viewer) { viewer.turn(0.1, 0); } },
  { keys: ["Shift+ArrowUp"], shown: "Shift ↑", does: "look from farther above", act: function (viewer) { viewer.turn(0, -0.1); } },
  { keys: ["Shift+ArrowDown"], shown: "Shift ↓", does: "look from farther below", act: function (viewer) { viewer.turn(0, 0.1); } },
  { keys: ["+", "="], shown: "+", does: "nearer", act: function (viewer) { viewer.approach(0.9); } },
  { keys: ["-"], shown: "−", does: "farther", act: function (viewer) { viewer.approach(1 / 0.9); } },
  { keys: ["1"], shown: "1", does: "from the front", act: function (viewer) { viewer.look("front"); } },
  { keys: ["2"], shown: "2", does: "from the side", act: function (viewer) { viewer.look("side"); } },
  { keys: ["3"], shown: "3", does: "from above", act: function (viewer) { viewer.look("top"); } },
  { keys: ["4"], shown: "4", does: "from a corner", act: function (viewer) { viewer.look("corner"); } },
  { keys: ["r"], shown: "R", does: "the view at the start", act: function (viewer) { viewer.look(viewer.firstView); } },
  { keys: ["f"], shown: "F", does: "full screen, and back", act: function (viewer) { viewer.fillScreen(); } },
  { keys: ["?"], shown: "?", does: "these keys", act: function (viewer) { viewer.help(); } },
];
const ALSO_FROM_PAGE = [" ", "ArrowLeft", "ArrowRight", "1", "2", "3", "4", "r", "f", "?"];

function isHalfSeen(element) {
  const box = element.getBoundingClientRect();
  return Math.min(box.bottom, window.innerHeight) - Math.max(box.top, 0) > 0.5 * Math.min(box.height, window.innerHeight);
}

// Does the focused element need the key itself?
function keepsKey(element, key) {
  if (element === part("time")) return false;
  if (element.matches("input:not([type=checkbox]), select, textarea, [contenteditable]")) return true;
  return (key === " " || key === "Enter") && element.matches("button, summary, a, input");
}

function listenToKeys(viewer) {
  document.addEventListener("keydown", function (event) {
    if (event.defaultPrevented || event.ctrlKey || event.altKey || event.metaKey || part("help").open) return;
    const name = event.key.length === 1 ? event.key.toLowerCase() : (event.shiftKey ? "Shift+" : "") + event.key;
    const from = event.target, within = holder.contains(from);
    if (!within && !(from === document.body && ALSO_FROM_PAGE.includes(name) && isHalfSeen(part("canvas")))) return;
    const entry = keepsKey(from, name) ? undefined : KEYS.find(function (candidate) { return candidate.keys.includes(name); });
    if (!entry) return;
    event.preventDefault();
    entry.act(viewer);
  });
  const rows = KEYS.map(function (entry) {
    const row = document.createElement("tr"), key = document.createElement("th"), what = document.createElement("td");
    key.scope = "row";
    key.textContent = entry.shown;
    what.textContent = entry.does;
    row.append(key, what);
    return row;
  });
  part("help").querySelector("tbody").replaceChildren(...rows);
}
