// What a page does beside being read: the contents are folded on a narrow screen, boxes that scroll can be focused, a
// search box, and an equation shown where its number is hovered or focused. Without this all content is still there.
"use strict";

const narrow = matchMedia("(max-width: 54rem)");
const contents = document.querySelector(".contents details");
const fold = () => { contents.open = !narrow.matches; };
narrow.addEventListener("change", fold);
fold();

const focusable = () => {
  for (const box of document.querySelectorAll(".formula, pre")) {
    if (box.scrollWidth > box.clientWidth) box.tabIndex = 0; else box.removeAttribute("tabindex");
  }
};
document.fonts.ready.then(focusable);
addEventListener("resize", focusable);

// index.js calls this with what can be searched and shown; it is loaded when it is first wanted.
let found;
let index = () => (found ??= new Promise((resolve, reject) => {
  window.atlasIndex = resolve;
  const script = document.createElement("script");
  script.src = "index.js";
  script.onerror = reject;
  document.head.append(script);
}));

const element = (tag, attributes = {}, ...children) => {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
};

// The search box.
const box = element("input", {type: "search", id: "search", placeholder: "Search", "aria-label": "Search this report", autocomplete: "off"});
const results = element("ul", {class: "results", "aria-live": "polite", "aria-label": "Results"});
document.querySelector(".contents .book").after(element("search", {}, box, results));
results.hidden = true;

const plain = text => text.normalize("NFKD").replace(/[\u0300-\u036f]/g, "").toLowerCase();
const look = async () => {
  const words = plain(box.value).split(/\s+/).filter(Boolean);
  const {sections} = await index();
  const hits = [];
  for (const [file, anchor, title, text] of words.length ? sections : []) {
    const head = plain(title), body = plain(text);
    if (!words.every(word => head.includes(word) || body.includes(word))) continue;
    hits.push([words.filter(word => head.includes(word)).length, file, anchor, title, text, body.indexOf(words[0])]);
  }
  hits.sort((a, b) => b[0] - a[0]);
  results.replaceChildren(...hits.slice(0, 12).map(([, file, anchor, title, text, place]) => {
    const from = Math.max(0, place - 30);
    const excerpt = `${from ? "…" : ""}${text.slice(from, from + 90)}…`;
    return element("li", {}, element("a", {href: `${file}#${anchor}`}, element("b", {}, title), element("span", {}, excerpt)));
  }));
  if (words.length && !hits.length) results.append(element("li", {}, "Nothing found."));
  results.hidden = !words.length;
};
box.addEventListener("focus", () => index());
box.addEventListener("input", look);
addEventListener("keydown", event => {
  if (event.key === "/" && document.activeElement.tagName !== "INPUT") { event.preventDefault(); box.focus(); }
  if (event.key === "Escape") { hide(); results.hidden = true; }
});

// The equation behind a number.
const card = element("div", {class: "shown", role: "tooltip", id: "shown"});
card.hidden = true;
document.body.append(card);
const hide = () => { card.hidden = true; };
const show = async link => {
  const name = decodeURIComponent(link.hash).replace(/^#(eq|ledger)-/, "");
  const {equations} = await index();
  if (!(name in equations) || !link.matches(":hover, :focus")) return;
  card.innerHTML = equations[name];
  if (link.title) { link.dataset.says = link.title; link.removeAttribute("title"); }
  if (link.dataset.says) card.append(element("p", {}, link.dataset.says));
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
  link.addEventListener("mouseleave", hide);
  link.addEventListener("blur", hide);
}
