"use strict";
(() => {
  const picture = document.getElementById("pictures");
  const body = document.querySelector("#rocks tbody");
  const heads = [...document.querySelectorAll("#rocks thead th")];
  const told = document.getElementById("told");
  const shown = document.getElementById("shown");
  const rowOf = (number) => document.getElementById("row-" + number);
  const drawnOf = (number) => document.getElementById("rock-" + number);
  const numberOf = (element) => element.id.slice(element.id.indexOf("-") + 1);
  const off = document.getElementById("off").sheet;
  const boxes = new Map([...document.querySelectorAll("[data-column]")].map((box) => [box.dataset.column, box]));

  const words = (row) =>
    heads
      .map((head, place) => [head.dataset.name, row.cells[place].textContent])
      .filter(([name, text]) => text !== "" && boxes.get(name).checked)
      .map(([name, text]) => `${name} ${text}`)
      .join(", ");

  function choose(number, scroll) {
    for (const each of document.querySelectorAll(".chosen")) each.classList.remove("chosen");
    const row = rowOf(number);
    if (!row) return;
    row.classList.add("chosen");
    const drawn = drawnOf(number);
    if (drawn) drawn.classList.add("chosen");
    told.textContent = words(row);
    if (!scroll && drawn && picture.classList.contains("many")) enlarge(drawn.closest("figure"), true);
    if (scroll) row.scrollIntoView({ block: "nearest" });
  }

  function enlarge(figure, large) {
    figure.classList.toggle("open", large);
    figure.querySelector("figcaption button").setAttribute("aria-expanded", String(large));
    if (large) figure.scrollIntoView({ block: "nearest" });
  }

  picture.addEventListener("click", (event) => {
    const caption = event.target.closest("figcaption button");
    if (caption) enlarge(caption.closest("figure"), caption.getAttribute("aria-expanded") === "false");
    const rock = event.target.closest(".rock");
    if (rock) choose(numberOf(rock), true);
  });
  picture.addEventListener("mouseover", (event) => {
    const rock = event.target.closest(".rock");
    const row = rock && rowOf(numberOf(rock));
    if (row) told.textContent = words(row);
  });
  body.addEventListener("click", (event) => {
    const row = event.target.closest("tr");
    if (row) choose(numberOf(row), false);
  });
  for (const row of body.rows) row.tabIndex = -1;
  body.addEventListener("keydown", (event) => {
    const step = { ArrowDown: "nextElementSibling", ArrowUp: "previousElementSibling" }[event.key];
    let row = event.target.closest("tr");
    if (event.key === "Enter" && row) choose(numberOf(row), false);
    if (!step || !row) return;
    event.preventDefault();
    do row = row[step]; while (row && row.classList.contains("off"));
    if (row) { row.focus(); choose(numberOf(row), false); }
  });

  for (const box of document.querySelectorAll("[data-layer]")) {
    const apply = () => picture.classList.toggle("no-" + box.dataset.layer, !box.checked);
    box.addEventListener("change", apply);
    apply();
  }

  const value = (row, place) => {
    const text = row.cells[place].textContent;
    return text === "" ? NaN : Number(text);
  };

  heads.forEach((head, place) => {
    head.querySelector("button").addEventListener("click", () => {
      const down = head.getAttribute("aria-sort") === "ascending";
      heads.forEach((each) => each.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      const wordy = head.classList.contains("words");
      const sign = down ? -1 : 1;
      const rows = [...body.rows].map((row) => [wordy ? row.cells[place].textContent : value(row, place), row]);
      rows.sort(([one], [two]) => {
        if (wordy) return sign * one.localeCompare(two);
        if (Number.isNaN(one) || Number.isNaN(two)) return Number.isNaN(one) - Number.isNaN(two);
        return sign * (one - two);
      });
      body.append(...rows.map(([, row]) => row));
    });
  });

  const column = document.getElementById("column");
  const least = document.getElementById("least");
  const most = document.getElementById("most");
  function filter() {
    const place = heads.findIndex((head) => head.dataset.name === column.value);
    const low = least.value === "" ? null : Number(least.value);
    const high = most.value === "" ? null : Number(most.value);
    let count = 0;
    for (const row of body.rows) {
      const own = value(row, place);
      const kept = (low === null || own >= low) && (high === null || own <= high);
      row.classList.toggle("off", !kept);
      const drawn = drawnOf(numberOf(row));
      if (drawn) drawn.classList.toggle("off", !kept);
      count += kept;
    }
    shown.textContent = `${count} of ${body.rows.length} rocks`;
  }
  for (const each of [column, least, most]) each.addEventListener("input", filter);
  filter();

  for (const [name, box] of boxes) {
    const rule = `#rocks :is(th, td):nth-child(${heads.findIndex((head) => head.dataset.name === name) + 1})`;
    box.addEventListener("change", () => {
      for (let place = off.cssRules.length - 1; place >= 0; place--) {
        if (off.cssRules[place].selectorText === rule) off.deleteRule(place);
      }
      if (!box.checked) off.insertRule(`${rule} { display: none; }`);
    });
  }
})();
