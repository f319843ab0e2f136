// SPDX-License-Identifier: BSD-3-Clause
// Draws the pictures of a report from the JSON beside each: "@role" there is a colour of the
// present look. What is in the names and numbers of a report is never run as code.
(function () {
  "use strict";
  const kColours = {
    light: {
      ink: "#1b1f24", muted: "#57606a", grid: "#e1e5ea", paper: "#ffffff", clear: "rgba(0,0,0,0)",
      before: "#d55e00", after: "#0072b2", floor: "#1b1f24", other: "#98a2ad", chosen: "#0072b2",
      good: "#0b6e4f", low: "#0072b2", middle: "#f7f7f7", high: "#d55e00"
    },
    dark: {
      ink: "#e6e8eb", muted: "#9ba3ad", grid: "#2d343c", paper: "#14181d", clear: "rgba(0,0,0,0)",
      before: "#f0883e", after: "#58b4f5", floor: "#ffffff", other: "#6e7781", chosen: "#58b4f5",
      good: "#4cc38a", low: "#58b4f5", middle: "#1d2229", high: "#f0883e"
    }
  };
  // On paper two pictures stand side by side where several belong together (page.css), in px of a
  // page of A4 less its margins, and all are lower, so that more than one row fits on a page; those
  // of rows with names above them not as much.
  const kPrintWidth = 660, kPrintHalf = 322, kPrintHeight = 0.58, kPrintRows = 0.9, kPrintFont = 10;
  const canHover = window.matchMedia("(hover: hover)");
  const darkLook = window.matchMedia("(prefers-color-scheme: dark)");
  let printing = false;

  function coloured(value, colours) {
    if (typeof value === "string") {
      const role = value.charAt(0) === "@" ? value.slice(1) : "";
      return Object.prototype.hasOwnProperty.call(colours, role) ? colours[role] : value;
    }
    if (Array.isArray(value)) return value.map(function (item) { return coloured(item, colours); });
    if (value === null || typeof value !== "object") return value;
    const copy = {};
    Object.keys(value).forEach(function (key) { copy[key] = coloured(value[key], colours); });
    return copy;
  }

  // In space, all of a box is seen from above one corner, with room at its sides for the words.
  // From distance 1 a camera sees kSeen to each side of its middle, up and down. A legend of many
  // lines makes the picture lower, not its words smaller.
  const kSeen = Math.tan(Math.PI / 8), kNarrow = 400, kLegend = 100;
  const kFrom = [0.65, 0.65, 0.39], kRight = [-0.707, 0.707, 0], kUp = [-0.276, -0.276, 0.92];
  const kAt = [0, 0, -0.14];  // the near corner below is nearer than that above
  function dot(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

  function distanceTo(box, seenAcross, seenUp) {
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const p = box.map(function (length, k) { return (corner >> k & 1 ? 0.5 : -0.5) * length - kAt[k]; });
      const needed = Math.max(Math.abs(dot(p, kRight)) / seenAcross, Math.abs(dot(p, kUp)) / seenUp);
      distance = Math.max(distance, dot(p, kFrom) + needed);
    }
    return distance;
  }

  function inSpace(scene, width, height) {
    const isNarrow = Math.min(width, height) < kNarrow, room = isNarrow ? 42 : 30;
    const ratio = scene.aspectratio, lower = width < kNarrow ? height - kLegend : height;
    const distance = distanceTo(
      [ratio.x, ratio.y, ratio.z], kSeen * (width - 2 * room) / height, kSeen * (1 - 2 * room / lower));
    const copy = Object.assign({}, scene, {
      camera: {
        eye: { x: distance * kFrom[0], y: distance * kFrom[1], z: distance * kFrom[2] + kAt[2] },
        center: { x: 0, y: 0, z: kAt[2] }
      }
    });
    Object.keys(scene).filter(isAxis).forEach(function (key) {
      copy[key] = Object.assign({ nticks: isNarrow ? 5 : 7, tickfont: { size: isNarrow ? 10 : 11 } }, scene[key]);
    });
    return copy;
  }

  function isAxis(key) { return /^[xyz]axis[0-9]*$/.test(key); }

  function isHalf(plot) {
    const together = plot.closest(".figures");
    return together !== null && together.children.length > 1;
  }

  function styled(layout, colours, plot) {
    const full = Object.assign({
      autosize: true, margin: { l: 62, r: 16, t: 12, b: 46 }, hovermode: "closest", dragmode: "zoom",
      font: { family: "system-ui, DejaVu Sans, sans-serif", size: 13, color: colours.ink },
      paper_bgcolor: colours.clear, plot_bgcolor: colours.clear,
      modebar: { bgcolor: colours.clear, color: colours.muted, activecolor: colours.ink }
    }, layout);
    full.legend = Object.assign({ orientation: "h", x: 0, y: 1.02, yanchor: "bottom" }, layout.legend);
    if (!full.scene) {
      full.xaxis = full.xaxis || {};
      full.yaxis = full.yaxis || {};
    }
    Object.keys(full).filter(isAxis).forEach(function (key) {
      full[key] = Object.assign({
        gridcolor: colours.grid, zerolinecolor: colours.muted, linecolor: colours.grid, automargin: true,
        exponentformat: "power"  // 100 µ of a title's mm is no unit
      }, full[key]);
    });
    if (printing) {
      full.width = isHalf(plot) ? kPrintHalf : kPrintWidth;
      const part = plot.dataset.rows === undefined ? kPrintHeight : kPrintRows;
      full.height = Math.round(part * Number(plot.dataset.height));
      full.font = Object.assign({}, full.font, { size: kPrintFont });
    }
    if (full.scene) {
      full.scene = inSpace(full.scene, full.width || plot.clientWidth, full.height - full.margin.t);
    }
    return full;
  }

  // The chart libraries stand in the page as text and are run when the first picture needs them:
  // they are most of what opening would cost.
  function libraryOf(plot) {
    const name = plot.dataset.library === "3d" ? "hexcal3d" : "hexcal2d";
    const text = document.getElementById("library-" + plot.dataset.library);
    if (!window[name] && text) {
      const script = document.createElement("script");
      script.textContent = text.textContent;
      document.body.appendChild(script);
      script.remove();
    }
    return window[name];
  }

  function draw(plot) {
    const library = libraryOf(plot);
    if (!library) return;
    const spec = JSON.parse(document.getElementById(plot.dataset.spec).textContent);
    const colours = kColours[darkLook.matches && !printing ? "dark" : "light"];
    library.react(plot, coloured(spec.data, colours), styled(coloured(spec.layout, colours), colours, plot), {
      responsive: true, displaylogo: false, displayModeBar: canHover.matches ? "hover" : false,
      modeBarButtonsToRemove: ["select2d", "lasso2d"],
      showSendToCloud: false, plotlyServerURL: ""
    });
  }

  const plots = Array.from(document.querySelectorAll(".plot"));
  const waiting = new Set(plots);  // not drawn yet

  function show(plot) { if (waiting.delete(plot)) draw(plot); }
  function redraw() { plots.filter(function (plot) { return !waiting.has(plot); }).forEach(draw); }

  // Milliseconds from the start of the navigation, for whoever measures.
  function mark(name) { document.documentElement.dataset[name] = Math.round(performance.now()); }

  // What is out of sight is drawn when there is nothing else to do.
  function showRest() {
    if (waiting.size === 0) return mark("complete");
    show(waiting.values().next().value);
    later(showRest);
  }
  function later(work) {
    if (window.requestIdleCallback) window.requestIdleCallback(work, { timeout: 1000 });
    else window.setTimeout(work, 50);
  }

  function isInSight(plot) {
    const box = plot.getBoundingClientRect();
    return box.bottom > 0 && box.top < window.innerHeight;
  }
  plots.forEach(function (plot) { plot.style.minHeight = plot.dataset.height + "px"; });
  plots.filter(isInSight).forEach(show);
  mark("open");
  later(showRest);
  // Whoever scrolls faster than that does not wait.
  const watch = new IntersectionObserver(function (entries) {
    entries.filter(function (entry) { return entry.isIntersecting; })
      .forEach(function (entry) { show(entry.target); });
  });
  Array.from(waiting).forEach(function (plot) { watch.observe(plot); });

  darkLook.addEventListener("change", redraw);
  window.addEventListener("beforeprint", function () {
    printing = true;
    redraw();
    Array.from(waiting).forEach(show);
  });
  window.addEventListener("afterprint", function () { printing = false; redraw(); });
})();
