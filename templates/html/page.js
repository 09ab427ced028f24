// What a page does beside being read: the contents are folded on a narrow screen, boxes that scroll
// can be focused, a search box, and an equation shown where its number is hovered or focused.
// Without this all content is still there.
"use strict";

const narrow = matchMedia("(max-width: 54rem)");
const contents = document.querySelector(".contents details");
const fold = () => {
  contents.open = !narrow.matches;
};
narrow.addEventListener("change", fold);
fold();

const focusable = () => {
  for (const box of document.querySelectorAll(".formula, pre, .scroll")) {
    if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
    else box.removeAttribute("tabindex");
  }
};
document.fonts.ready.then(focusable);
addEventListener("resize", focusable);

const element = (tag, attributes = {}, ...children) => {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
};

// An index.js, that of this report or of one beside it, calls atlasIndex with what can be searched
// and shown; it is loaded when it is first wanted.
const waiting = new Map();
globalThis.atlasIndex = (content) => waiting.get(document.currentScript)(content);
const load = (folder) =>
  new Promise((resolve, reject) => {
    const script = element("script", { src: `${folder}index.js` });
    waiting.set(script, resolve);
    script.onerror = reject;
    document.head.append(script);
  });
let found;
const index = () => (found ??= load(""));

// The search box: in the head of the front page, else above the contents; the page keeps its place.
const box = element("input", {
  type: "search",
  id: "search",
  placeholder: "Search: words, I=3/2, omega2, (72)",
  "aria-label": "Search this report and those beside it",
  autocomplete: "off",
  role: "combobox",
  "aria-expanded": "false",
  "aria-controls": "results",
});
const results = element("ul", {
  class: "results",
  id: "results",
  "aria-live": "polite",
  "aria-label": "Results",
});
document.querySelector("search").append(box, results);
results.hidden = true;

// Letters as they are typed: Greek by name, no accents and primes, no space about the sign of a
// relation.
const GREEK = {
  α: "alpha",
  β: "beta",
  γ: "gamma",
  δ: "delta",
  ε: "epsilon",
  ϵ: "epsilon",
  ζ: "zeta",
  η: "eta",
  θ: "theta",
  ϑ: "theta",
  κ: "kappa",
  λ: "lambda",
  μ: "mu",
  ν: "nu",
  ξ: "xi",
  π: "pi",
  ρ: "rho",
  σ: "sigma",
  τ: "tau",
  φ: "phi",
  ϕ: "phi",
  χ: "chi",
  ψ: "psi",
  ω: "omega",
};
const plain = (text) =>
  text.normalize("NFKD").replace(/[\u0300-\u036f'’′_{}$\\]/g, "").replace(/[−–]/g, "-")
    .toLowerCase()
    .replace(/[α-ωϑϕϵ]/g, (letter) => GREEK[letter] ?? letter).replace(/\s*([=<>≤≥≈≠])\s*/g, "$1");
// A word, and of a formula its pieces too; a number in brackets is that of an equation and stays
// whole.
const pieces = (text) =>
  plain(text).split(/[\s,;:!?"“”]+/).flatMap((raw) => {
    const word = raw.replace(/[.…]+$/, "");
    if (/^\(\w{1,4}\)$/.test(word)) return [word];
    const bare = word.replace(/^[([]+(?=[^()[\]]*$)|(?<=^[^()[\]]*)[)\]]+$/g, "");
    const parts = bare.split(/[=<>≤≥≈≠+()[\]]/);
    const names = parts.filter((part) => /^[a-z]\w*(\.\w+)+$/.test(part)).flatMap((part) =>
      part.split(".")
    );
    return [
      ...new Set([
        bare,
        ...parts,
        ...names,
        ...(/^[a-z]+(-[a-z]+)+$/.test(bare) ? bare.split("-") : []),
      ]),
    ];
  }).filter(Boolean);

// The reports beside this one are searched too, those that are there: what they have comes after
// what this one has.
const beside = [...document.querySelectorAll("[data-beside]")].map(
  (link) => [link.dataset.beside, `${link.textContent}: `],
);
const sections = async () => {
  const rows = ([folder, of], content) =>
    content.sections.map(([file, anchor, title, text]) => ({
      file: folder + file,
      anchor,
      title: of + title,
      text,
      nearness: folder ? 0.5 : 1,
    }));
  const parts = [
    index().then((content) => rows(["", ""], content)),
    ...beside.map((one) => load(one[0]).then((content) => rows(one, content), () => [])),
  ];
  return (await Promise.all(parts)).flat();
};

let search;
const engine = () => (search ??= sections().then((rows) => {
  const made = new MiniSearch({
    fields: ["name", "title", "text"],
    storeFields: ["file", "anchor", "title", "text", "nearness"],
    tokenize: pieces,
    processTerm: (term) => term,
    searchOptions: {
      boost: { name: 3, title: 0.3 },
      boostDocument: (_id, term, { nearness, title }) =>
        nearness * (term.startsWith("(") && title.includes(term) ? 4 : 1),
      combineWith: "AND",
      prefix: (term) => term.length > 1 && !term.startsWith("("),
      fuzzy: (term) => /^[a-z]{4,}$/.test(term) ? 0.25 : false,
      tokenize: (text) => plain(text).split(/[\s,;]+/).filter(Boolean),
    },
  });
  made.addAll(
    rows.map((row, id) => ({ id, name: row.title.replace(/^\.|(?<=\w)\(.*\)/g, ""), ...row })),
  ); // without arguments
  return made;
}));
// "Equation 84", and 84 by itself, is (84). Words with a slip are found where there is none as typed;
// where no place has all the words, those that have most, but for words that any sentence has.
const EQUATION = /\b(?:eq|eqs|eqn|equations?)\b\.?\s*\(?(\d{1,3})\b\)?/gi,
  COMMON = new Set(
    ("a an and can do does for from get how i in is it make my of on own the to what where which " +
      "with you").split(" "),
  );
const SOME = {
  combineWith: "OR",
  tokenize: (text) => pieces(text).filter((word) => !COMMON.has(word)),
};
const find = (made, words) => {
  const asked = words.replace(EQUATION, "($1)");
  const number = asked.replace(/^\d{1,3}$/, "($&)");
  const tries = [[number, { fuzzy: false }], [asked, {}], [asked, SOME]];
  return tries.reduce((hits, one) => hits.length ? hits : made.search(...one), []);
};
const look = async () => {
  const asked = box.value.trim(), made = await engine();
  if (asked !== box.value.trim()) return;
  const hits = asked ? find(made, asked).slice(0, 12) : [];
  results.replaceChildren(...hits.map(({ file, anchor, title, text, terms }) => {
    const at = Math.max(0, ...terms.slice(0, 1).map((term) => plain(text).indexOf(term)));
    const from = Math.max(0, Math.min(at, text.length) - 30);
    const excerpt = `${from ? "…" : ""}${text.slice(from, from + 90)}…`;
    return element(
      "li",
      {},
      element(
        "a",
        { href: `${file}#${anchor}` },
        element("b", {}, title),
        element("span", {}, excerpt),
      ),
    );
  }));
  if (asked && !hits.length) results.append(element("li", {}, "Nothing found."));
  results.hidden = !asked;
  box.setAttribute("aria-expanded", String(!results.hidden));
};
box.addEventListener("focus", () => engine());
box.addEventListener("input", look);
// Arrows go through the results, Enter opens the first of them or the one with the focus.
const step = (event) => {
  const links = [...results.querySelectorAll("a")], now = links.indexOf(document.activeElement);
  if (event.key === "Enter" && event.currentTarget === box && links.length) {
    event.preventDefault();
    links[0].click();
  }
  if (event.key !== "ArrowDown" && event.key !== "ArrowUp" || !links.length) return;
  event.preventDefault();
  const next = now + (event.key === "ArrowDown" ? 1 : -1);
  (next < 0 ? box : links[Math.min(next, links.length - 1)]).focus();
};
box.addEventListener("keydown", step);
results.addEventListener("keydown", step);
addEventListener("keydown", (event) => {
  if (event.key === "/" && document.activeElement.tagName !== "INPUT") {
    event.preventDefault();
    box.focus();
  }
  if (event.key === "Escape") {
    hide();
    results.hidden = true;
  }
});

// The equation behind a number.
const card = element("div", { class: "shown", role: "tooltip", id: "shown" });
card.hidden = true;
document.body.append(card);
const hide = () => {
  card.hidden = true;
  card.dataset.of = "";
};
const leave = () => {
  if (!card.dataset.of) hide();
};
const show = async (link, tapped = false) => {
  const name = decodeURIComponent(link.hash).replace(/^#(eq|ledger)-/, "");
  const { equations } = await index();
  if (!(name in equations) || !link.matches(":hover, :focus")) return;
  card.innerHTML = equations[name];
  if (link.title) {
    link.dataset.says = link.title;
    link.removeAttribute("title");
  }
  if (link.dataset.says) card.append(element("p", {}, link.dataset.says));
  if (tapped) card.append(element("p", {}, element("a", { href: link.href }, "Go there")));
  card.dataset.of = tapped ? link.href : "";
  card.hidden = false;
  const at = link.getBoundingClientRect(), size = card.getBoundingClientRect();
  const left = Math.min(at.left, document.documentElement.clientWidth - size.width - 8);
  const above = at.top - size.height - 6;
  card.style.left = `${scrollX + Math.max(8, left)}px`;
  card.style.top = `${scrollY + (above > 0 ? above : at.bottom + 6)}px`;
  link.setAttribute("aria-describedby", "shown");
};
for (const link of document.querySelectorAll('main a[href*="#eq-"], main a[href*="#ledger-"]')) {
  if (link.closest(".labels, .tag")) continue;
  link.addEventListener("mouseenter", () => show(link));
  link.addEventListener("focus", () => show(link));
  // Without a mouse the first tap shows the equation, and the second, or a tap on "Go there",
  // follows the link.
  link.addEventListener("click", (event) => {
    if (!matchMedia("(hover: none)").matches || (!card.hidden && card.dataset.of === link.href)) {
      return;
    }
    event.preventDefault();
    link.focus();
    show(link, true);
  });
  link.addEventListener("mouseleave", leave);
  link.addEventListener("blur", leave);
}
// What was tapped stays until its link is followed, or until something else is tapped.
card.addEventListener("click", (event) => {
  if (event.target.closest("a")) hide();
});
addEventListener("pointerdown", (event) => {
  if (
    card.dataset.of && !card.contains(event.target) &&
    event.target.closest("a")?.href !== card.dataset.of
  ) hide();
});

// Rows of a table that sorts, by the column whose head is clicked: by numbers if they are, empty ones last.
const amount = (cell) =>
  Number.parseFloat(
    cell.textContent.replace(/×10/, "e").replaceAll("−", "-").replace(/\(.*?\)/, ""),
  );
for (const table of document.querySelectorAll("table.sorts")) {
  for (const [place, head] of [...table.tHead.rows[0].cells].entries()) {
    const button = element("button", { type: "button" }, ...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const up = head.ariaSort !== "ascending", rows = [...table.tBodies[0].rows];
      const order = (one, other) => {
        const [a, b] = [one, other].map((row) => row.cells[place]), [x, y] = [a, b].map(amount);
        if (Number.isNaN(x) && Number.isNaN(y)) {
          return a.textContent.localeCompare(b.textContent) * (up ? 1 : -1);
        }
        return Number.isNaN(x) - Number.isNaN(y) || (up ? x - y : y - x);
      };
      for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
      head.ariaSort = up ? "ascending" : "descending";
      table.tBodies[0].append(...rows.sort(order));
    });
  }
}
