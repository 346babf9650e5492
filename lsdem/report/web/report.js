// Behaviour of every report beside its blocks: on paper the numbers of all plots are there, a pointer reads values off a plot, and plots
// over the time of the first run go with the view of the blocks: a line shows its time, a click on the plot sets it.
"use strict";
(function () {
  window.addEventListener("beforeprint", function () {
    document.querySelectorAll("details").forEach(function (details) { details.open = true; });
  });

  const SVG = "http://www.w3.org/2000/svg";

  // The value of an axis, as the frame gives it, at a share of its length.
  function valueAt(axis, share) {
    const parts = axis.split(" "), low = Number(parts[0]), high = Number(parts[1]);
    const value = low + share * (high - low);
    return parts[2] === "log" ? Math.pow(10, value) : value;
  }

  function readOff(frame, point) {
    const box = { x: Number(frame.getAttribute("x")), y: Number(frame.getAttribute("y")), width: Number(frame.getAttribute("width")), height: Number(frame.getAttribute("height")) };
    const right = (point.x - box.x) / box.width, up = 1 - (point.y - box.y) / box.height;
    if (right < 0 || right > 1 || up < 0 || up > 1) return null;
    const readAxis = function (name, axis, share) { return name + " = " + valueAt(axis, share).toPrecision(4); };
    const shown = [readAxis(frame.dataset.xName, frame.dataset.x, right)];
    if (frame.dataset.y) shown.push(readAxis(frame.dataset.yName, frame.dataset.y, up));
    return { text: shown.join(",  "), box: box };
  }

  document.querySelectorAll("figure").forEach(function (figure) {
    const plot = figure.querySelector(".plot svg"), caption = figure.querySelector("figcaption");
    const frames = plot ? Array.from(plot.querySelectorAll("rect.frame")) : [];
    if (frames.length === 0) return;
    const hair = document.createElementNS(SVG, "path"), readout = document.createElement("span");
    hair.setAttribute("fill", "none");
    hair.setAttribute("stroke", "#999");
    hair.setAttribute("pointer-events", "none");
    readout.className = "readout";
    readout.setAttribute("aria-hidden", "true");
    plot.appendChild(hair);
    caption.append(" ", readout);
    const clear = function () { hair.removeAttribute("d"); readout.textContent = ""; };
    plot.addEventListener("pointermove", function (event) {
      const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(plot.getScreenCTM().inverse());
      for (const frame of frames) {
        const found = readOff(frame, point);
        if (!found) continue;
        const box = found.box;
        hair.setAttribute("d", "M" + point.x + " " + box.y + "v" + box.height + "M" + box.x + " " + point.y + "h" + box.width);
        readout.textContent = found.text;
        return;
      }
      clear();
    });
    plot.addEventListener("pointerleave", clear);
  });

  document.querySelectorAll("figure[data-seconds-per-x]").forEach(function (figure) {
    const seconds = Number(figure.dataset.secondsPerX), plot = figure.querySelector(".plot svg"), line = document.createElementNS(SVG, "path");
    const frames = Array.from(plot.querySelectorAll("rect.frame")).filter(function (frame) { return frame.dataset.x.split(" ")[2] !== "log"; });
    line.setAttribute("class", "now");
    plot.appendChild(line);
    document.addEventListener("musim-time", function (event) {
      line.setAttribute("d", frames.map(function (frame) {
        const axis = frame.dataset.x.split(" ").map(Number), share = (event.detail / seconds - axis[0]) / (axis[1] - axis[0]);
        if (share < 0 || share > 1) return "";
        return "M" + (Number(frame.getAttribute("x")) + share * Number(frame.getAttribute("width"))) + " " + frame.getAttribute("y") + "v" + frame.getAttribute("height");
      }).join(""));
    });
    plot.addEventListener("click", function (event) {
      const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(plot.getScreenCTM().inverse());
      const frame = frames.find(function (candidate) { return readOff(candidate, point); });
      if (!frame) return;
      const share = (point.x - Number(frame.getAttribute("x"))) / Number(frame.getAttribute("width"));
      document.dispatchEvent(new CustomEvent("musim-seek", { detail: seconds * valueAt(frame.dataset.x, share) }));
    });
  });
})();
