"use strict";
// Sorts and filters the tables of rocks, and shows a rock in all its views. Without it the page
// still reads: points and rows are links to each rock's own place in the page.
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  const make = (tag, settings = {}) => Object.assign(document.createElement(tag), settings);

  // Sorting: a header's button turns its column up, then down; what is no number stays last.
  const text = (cell) => (cell.firstChild ? cell.firstChild.textContent : "").trim();
  const value = (cell) => {
    const shown = text(cell).replaceAll("−", "-");
    return shown === "" || Number.isNaN(Number(shown)) ? null : Number(shown);
  };
  const words = new Intl.Collator("en", { numeric: true });

  function sort(header) {
    const table = header.closest("table"), body = table.tBodies[0], column = header.cellIndex;
    const up = header.ariaSort !== "ascending", numeric = header.dataset.sort === "number";
    const rows = [...body.rows].map((row) => {
      const cell = row.cells[column];
      return { row, key: numeric ? value(cell) : cell.textContent.trim() };
    });
    rows.sort((a, b) => {
      if (a.key === null || b.key === null) return (a.key === null) - (b.key === null);
      const order = numeric ? a.key - b.key : words.compare(a.key, b.key);
      return up ? order : -order;
    });
    body.append(...rows.map((each) => each.row));
    for (const other of all("th[data-sort]", table)) other.ariaSort = "none";
    header.ariaSort = up ? "ascending" : "descending";
  }

  function filter(table, wanted, count) {
    const parts = wanted.toLowerCase().match(/[a-z]+ +\d+|\S+/g) ?? []; // "view 3" is one thing
    let shown = 0;
    for (const row of table.tBodies[0].rows) {
      const found = [row.cells[0], row.cells[2]].map((c) => c.textContent).join(" ").toLowerCase();
      const tokens = ` ${found.replace(/[^a-z0-9-]+/g, " ")} `;
      row.hidden = !parts.every((part) => tokens.includes(` ${part.replace(/ +/g, " ")}`));
      shown += !row.hidden;
    }
    count.textContent = `${shown} of ${table.tBodies[0].rows.length} rows`;
  }

  function showMethod(table, wanted) {
    const heads = [...table.tHead.rows[1].cells];
    const off = heads.map((head) => Boolean(wanted && head.dataset.method && head.dataset.method !== wanted));
    for (const row of [table.tHead.rows[1], ...table.tBodies[0].rows])
      off.forEach((hidden, i) => { row.cells[i].hidden = hidden; });
    for (const head of all(".groups th[data-method]", table))
      head.hidden = Boolean(wanted && head.dataset.method !== wanted);
  }

  for (const tools of all(".tools")) {
    const table = document.getElementById(tools.dataset.for);
    for (const header of all("th[data-sort]", table)) {
      const button = make("button", { type: "button" });
      button.append(...header.childNodes);
      button.addEventListener("click", () => sort(header));
      header.append(button);
      header.ariaSort = "none";
    }
    const count = make("span", { className: "quiet" });
    count.setAttribute("role", "status");
    const search = make("input", { type: "search", placeholder: "seed 10002 view 3 missed" });
    search.addEventListener("input", () => filter(table, search.value, count));
    const find = make("label", { textContent: "Rows with " });
    find.append(search);
    const choice = make("select");
    choice.append(make("option", { value: "", textContent: "all" }));
    for (const head of all(".groups th[data-method]", table))
      choice.append(make("option", { value: head.dataset.method, textContent: head.dataset.method }));
    choice.addEventListener("change", () => showMethod(table, choice.value));
    const by = make("label", { textContent: "measured by " });
    by.append(choice);
    tools.append(find, by, count);
    tools.hidden = false;
    filter(table, "", count);
  }

  // A rock in all its views: its place in the page is moved into a dialog and back.
  const dialog = make("dialog"), bar = make("div", { className: "bar" }), body = make("div");
  const button = (label, sign, act) => {
    const made = make("button", { type: "button", textContent: sign, ariaLabel: label, title: label });
    made.addEventListener("click", act);
    bar.append(made);
  };
  button("the rock before", "‹", () => turn(-1));
  button("the next rock", "›", () => turn(1));
  button("close", "×", () => dialog.close());
  dialog.append(bar, body);
  document.body.append(dialog);
  let home = null;

  function putBack() {
    if (home) home.replaceWith(body.firstElementChild);
    home = null;
    body.replaceChildren();
  }

  function show(id, view) {
    putBack();
    const rock = document.getElementById(id);
    home = make("template");
    rock.replaceWith(home);
    body.append(rock);
    for (const head of all("thead th", rock)) head.classList.toggle("here", head.dataset.view === view);
    dialog.setAttribute("aria-labelledby", `${id}-h`);
    history.replaceState(null, "", `#${id}`);
    if (!dialog.open) dialog.showModal();
    dialog.scrollTop = 0;
    rock.querySelector("th.here")?.scrollIntoView({ block: "nearest", inline: "nearest" });
  }

  function say(words) {
    putBack();
    dialog.setAttribute("aria-labelledby", "said");
    body.append(make("h4", { id: "said", textContent: "This rock is not on the page" }));
    body.append(make("p", { textContent: `${words}. It is neither in a pictured scene nor among the farthest ` +
      "from their rank, so that the page has no picture of it. results.parquet has its row." }));
    if (!dialog.open) dialog.showModal();
  }

  function turn(step) {
    const shown = home && body.firstElementChild;
    if (!shown) return;
    const row = document.querySelector(`tr[data-rock="${shown.id}"]`);
    const ids = [...new Set(all("tr:not([hidden])", row.parentElement).map((each) => each.dataset.rock))];
    const at = ids.indexOf(shown.id);
    show(ids[(at + step + ids.length) % ids.length], null);
  }

  dialog.addEventListener("close", () => {
    putBack();
    history.replaceState(null, "", location.pathname + location.search);
  });
  dialog.addEventListener("click", (event) => { if (event.target === dialog) dialog.close(); });
  dialog.addEventListener("keydown", (event) => {
    if (event.key === "ArrowLeft") turn(-1);
    if (event.key === "ArrowRight") turn(1);
  });

  document.addEventListener("click", (event) => {
    const link = event.target.closest('a[href^="#rock-"], a.bare');
    const row = event.target.closest("tbody tr[data-rock]");
    if (!link && !row) return;
    event.preventDefault();
    if (link && link.classList.contains("bare")) say(link.querySelector("title").textContent);
    else if (link) show(link.getAttribute("href").slice(1), link.dataset.view);
    else show(row.dataset.rock, row.querySelector("a").dataset.view);
  });
  if (location.hash.startsWith("#rock-") && document.getElementById(location.hash.slice(1)))
    show(location.hash.slice(1), null);

  // In a chart one point takes the focus; arrows go on from there. A rock's points light up together.
  for (const chart of all(".chart")) {
    const points = all("a", chart);
    chart.addEventListener("keydown", (event) => {
      const at = points.indexOf(document.activeElement);
      const to = { ArrowRight: at + 1, ArrowUp: at + 1, ArrowLeft: at - 1, ArrowDown: at - 1,
        Home: 0, End: points.length - 1 }[event.key];
      if (at < 0 || to === undefined || !points[to]) return;
      event.preventDefault();
      points[at].setAttribute("tabindex", "-1");
      points[to].setAttribute("tabindex", "0");
      points[to].focus();
    });
  }
  const light = (on) => (event) => {
    const link = event.target.closest('.chart a[href^="#rock-"]');
    if (!link) return;
    for (const same of all(`.chart a[href="${link.getAttribute("href")}"]`)) same.classList.toggle("lit", on);
  };
  for (const [kind, on] of [["mouseover", true], ["mouseout", false], ["focusin", true], ["focusout", false]])
    document.addEventListener(kind, light(on));
})();
