// Begins: unpacks the runs of the page and shows them, in three dimensions where the browser can.
async function unpackRuns() {
  const runs = [];
  for (const element of document.querySelectorAll("script.tower-data")) {
    const data = JSON.parse(element.textContent);
    element.remove();
    const packed = bytesOf(data.frames), forces = data.forces ? unpackForces(await inflate(bytesOf(data.forces)), data.blocks) : null;
    data.frames = data.forces = null;
    runs.push(new Run(data, unpack(await inflate(packed), data.times.length, data.blocks), forces));
  }
  return runs;
}

async function begin() {
  if (typeof DecompressionStream === "undefined") {
    say("This browser cannot unpack the blocks (no DecompressionStream); one of 2023 or later can.");
    return;
  }
  say("unpacking ...");
  const runs = await unpackRuns();
  let renderer = null;
  try {
    renderer = new THREE.WebGLRenderer({ canvas: part("canvas"), antialias: true, alpha: true, preserveDrawingBuffer: true });
  } catch (error) {
    showFlat(runs);
    say("This browser shows no WebGL (" + error.message + "): here are the blocks at the start, without motion; the plots are complete.");
  }
  if (renderer) {
    window.musimTower = new Viewer(runs, renderer);
    const still = runs.filter(function (run) { return !run.hasFrames && !run.stands; });
    say(still.length > 0 ? "start and end only: no frames were kept" : "");
  }
  holder.dataset.ready = "yes";
}

if (holder) begin().catch(function (error) { say("The blocks cannot be shown: " + error.message); throw error; });
