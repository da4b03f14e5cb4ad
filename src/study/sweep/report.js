"use strict";
(function () {
  // Tables: a click on a heading sorts, a second one the other way round. Cells without a number come last.
  function key(row, column) {
    const cell = row.cells[column];
    const value = cell.getAttribute("data-v");
    return value !== null ? Number(value) : cell.textContent.trim();
  }
  function compare(a, b) {
    const numbers = typeof a === "number" && typeof b === "number";
    if (numbers) return a - b;
    if (typeof a !== typeof b) return typeof a === "number" ? -1 : 1;
    return String(a).localeCompare(String(b), "en", { numeric: true });
  }
  function sort(table, column) {
    const heads = table.tHead.rows[0].cells;
    const down = heads[column].getAttribute("aria-sort") === "ascending";
    for (const head of heads) head.removeAttribute("aria-sort");
    heads[column].setAttribute("aria-sort", down ? "descending" : "ascending");
    const rows = Array.from(table.tBodies[0].rows).map((row, i) => ({ row, i, key: key(row, column) }));
    const empty = (one) => one.key === "";
    rows.sort((a, b) => empty(a) - empty(b) || (down ? -1 : 1) * compare(a.key, b.key) || a.i - b.i);
    for (const one of rows) table.tBodies[0].appendChild(one.row);
  }
  for (const table of document.querySelectorAll("table.sortable")) {
    Array.from(table.tHead.rows[0].cells).forEach((head, column) => {
      head.setAttribute("data-sorts", "");
      head.tabIndex = 0;
      head.addEventListener("click", () => sort(table, column));
      head.addEventListener("keydown", (event) => {
        if (event.key === "Enter" || event.key === " ") {
          event.preventDefault();
          sort(table, column);
        }
      });
    });
  }

  // Scenes and commands: copied by a button; a link to a row opens it.
  function copy(text) {
    const area = document.createElement("textarea");
    area.value = text;
    document.body.appendChild(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done;
  }
  for (const pre of document.querySelectorAll("#scenes pre")) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = "Copy";
    button.addEventListener("click", () => {
      button.textContent = copy(pre.textContent) ? "Copied" : "Select it by hand";
    });
    const around = document.createElement("div");
    around.className = "copied";
    pre.replaceWith(around);
    around.append(pre, button);
  }
  function openTarget() {
    const target = document.getElementById(location.hash.slice(1));
    if (target && target.tagName === "DETAILS") {
      target.open = true;
      target.scrollIntoView();
    }
  }
  window.addEventListener("hashchange", openTarget);
  openTarget();

  // Picture over reference.
  const viewer = document.getElementById("viewer");
  if (viewer) {
    const get = (name) => document.getElementById("viewer-" + name);
    const stage = get("stage");
    const above = stage.querySelector(".above");
    const below = stage.querySelector(".below");
    function update() {
      const option = get("row").selectedOptions[0].dataset;
      const mode = viewer.querySelector("input[name=viewer-mode]:checked").value;
      const share = Number(get("wipe").value);
      const room = Math.min(viewer.clientWidth - 34, 1100);
      let scale = Number(get("size").value);
      if (scale === 0) scale = Math.min(Math.max(1, Math.floor(512 / option.width)), room / option.width);
      viewer.dataset.mode = mode;
      stage.style.width = option.width * scale + "px";
      stage.style.height = option.height * scale + "px";
      for (const [svg, id] of [[above, option.picture], [below, option.reference]]) {
        svg.setAttribute("viewBox", "0 0 " + option.width + " " + option.height);
        svg.firstElementChild.setAttribute("href", "#" + id);
      }
      // The picture lies right of the line, the reference left of it.
      above.style.clipPath = mode === "wipe" ? "inset(0 0 0 " + (100 - share) + "%)" : "none";
      get("line").style.left = 100 - share + "%";
      stage.style.filter = mode === "difference" ? "brightness(" + get("gain").value + ")" : "none";
      get("text").textContent = mode === "wipe"
        ? "Left of the line the reference, right of it the picture; a drag over them moves the line."
        : "The absolute difference of every colour, brightened; what is equal is black.";
    }
    viewer.hidden = false;
    viewer.addEventListener("input", update);
    function drag(event) {
      if (event.buttons !== 1) return;
      const box = stage.getBoundingClientRect();
      get("wipe").value = 100 - (100 * (event.clientX - box.left)) / box.width;
      update();
    }
    stage.addEventListener("pointerdown", drag);
    stage.addEventListener("pointermove", drag);
    window.addEventListener("resize", update);
    update();
  }
  document.documentElement.dataset.script = "ran";
})();
