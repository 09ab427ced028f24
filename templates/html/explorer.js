// The elementary motions with sliders: the quadric opens and closes, the point walks along the hyperbola, the body turns as
// R(t) says and its axis draws its trace. The closed forms below are to draw with; certified digits come from the command
// that is shown. The state stands in the address, so that a link shows a motion. Without this nothing is shown.
"use strict";
(root => {

const norm = (...a) => Math.hypot(...a);
const add = (a, b, s = 1) => a.map((x, i) => x + s * b[i]), dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);

// The motion at omega2 on the hyperbola, for B2 > 0: omega3 by (71), k by (79), phi by (72), and the square of the
// frequency of small nutations, negative where the motion is unstable (theorem-stability).
const motion = (I, B2, B3, omega2) => {
  const X = omega2 + B2, common = omega2 / X * (B3 / (I * B2)), less = (1 - I) * B2 * B2, slope = B3 * (X * X + less) / (B2 * X);
  return {omega3: common * (omega2 + (2 - I) * B2), k: omega2 * (norm(B2, B3) / B2), phi: common * (1 - I) * (omega2 + 2 * B2), stability: slope * slope + (X * X - less)};
};
// The turn about a unit vector, row by row; R(t) = R_B(kt) R_z(phi t), (84).
const turn = ([x, y, z], angle) => {
  const c = Math.cos(angle), s = Math.sin(angle), h = 2 * Math.sin(angle / 2) ** 2;
  return [[c + h * x * x, h * x * y - s * z, h * x * z + s * y], [h * y * x + s * z, c + h * y * y, h * y * z - s * x], [h * z * x - s * y, h * z * y + s * x, c + h * z * z]];
};
const product = (A, B) => A.map(row => [0, 1, 2].map(j => row[0] * B[0][j] + row[1] * B[1][j] + row[2] * B[2][j]));
const rotation = (B2, B3, k, phi, t) => product(turn([0, B2 / norm(B2, B3), B3 / norm(B2, B3)], k * t), turn([0, 0, 1], phi * t));
// The quadric (50) of constant Omega3 about its centre -B', as the symmetric form of y = omega + B' and 1, and its axis
// e'_2, at beta/2 + pi/4 from e2, (53).
const quadric = (I, B2, B3) => {
  const beta = Math.atan2(B3, I * B2), half = beta / 2 + Math.PI / 4;
  return {beta, form: [B3, 0, 0, 0, B3, -I * B2 / 2, 0, 0, 0, (I - 1) * B2 * B2 * B3], axis: [0, Math.cos(half), Math.sin(half)], other: [0, -Math.sin(half), Math.cos(half)]};
};
const kind = I => I > 1 ? "two-sheet hyperboloid" : I < 1 ? "one-sheet hyperboloid" : "cone";
// A motion from its table: R(t) = R_B(a t) Q(t) R_z(b t), where Q repeats itself.
const tabled = ({period, a, b, columns}, B2, B3) => t => {
  const place = (t / period - Math.floor(t / period)) * columns.length, i = Math.floor(place) % columns.length, next = columns[(i + 1) % columns.length], mixed = columns[i].map((x, j) => x + (place - Math.floor(place)) * (next[j] - x));
  const unit = v => v.map(x => x / norm(...v)), z = unit(mixed.slice(3)), first = mixed.slice(0, 3), x = unit(add(first, z, -dot(first, z))), y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]];
  return product(product(turn([0, B2 / norm(B2, B3), B3 / norm(B2, B3)], a * t), [0, 1, 2].map(j => [x[j], y[j], z[j]])), turn([0, 0, 1], b * t));
};
root.atlasMotion = {motion, rotation, quadric, kind, tabled};
if (!root.document || !root.atlasViewer) return;

const SCALE = 0.11, REACH = 0.42, INK = "#1a1a1a", RED = "#a8182a", NAVY = "#16325c", PLUM = "#9a58b0", TEXTS = [["e₁", 12], ["e₂", 12], ["e₃", 12], ["B′", 13], ["ω", 10], ["B", 9], ["R₃", 15]];
const frame = (azimuth, elevation) => {
  const [a, e] = [azimuth, elevation].map(x => x * Math.PI / 180), [ca, sa, ce, se] = [Math.cos(a), Math.sin(a), Math.cos(e), Math.sin(e)];
  return [-sa, ca, 0, -se * ca, -se * sa, ce, ce * ca, ce * sa, se];
};
const arrow = (colour, tube, tail, tip) => [colour, tube, 5 + tube, 0.3 * (5 + tube), tail, tip];
const circle = (middle, a, b, radius, from = 0, to = 2 * Math.PI) => Array.from({length: 73}, (_, i) => { const w = from + (to - from) * i / 72; return middle.map((x, j) => x + radius * (Math.cos(w) * a[j] + Math.sin(w) * b[j])); });
const empty = (azimuth, elevation) => ({frame: frame(azimuth, elevation), matt: 0, surfaces: [], lines: [], wires: [], arrows: [], dots: [], names: []});

// In the space of initial data: the quadric about its centre, the hyperbola, and the point on it.
const left = ({I, B2, B3, omega2}) => {
  const panel = empty(25, 14), {form, axis, other} = quadric(I, B2, B3), at = omega => omega.map((x, i) => SCALE * (x + [0, B2, B3][i])), size = Math.max(...form.map(Math.abs), 1e-9);
  const scaled = form.map((x, i) => (i === 9 ? x * SCALE * SCALE : x) / size), value = y => { const [a, , , , b, c] = scaled; return a * y[0] ** 2 + b * y[1] ** 2 + 2 * c * y[1] * y[2]; };
  const top = axis.map(x => REACH * x), across = d => Math.sqrt(Math.max(0, -(value(top) + scaled[9]) / value(d))), rim = [across([1, 0, 0]), across(other)], box = Math.max(REACH, ...rim) + 0.1;
  panel.surfaces.push([scaled, [...axis, REACH, ...axis.map(x => -x), REACH], [], "#4f8fd0", "#f0b25c", 0.4, [-box, -box, -box], [box, box, box]]);
  for (const side of [1, -1]) panel.lines.push([INK, 1.1, Array.from({length: 73}, (_, i) => { const w = Math.PI * i / 36; return [rim[0] * Math.cos(w), side * top[1] + rim[1] * Math.sin(w) * other[1], side * top[2] + rim[1] * Math.sin(w) * other[2]]; })]);
  let run = []; const flush = () => { if (run.length > 2) panel.lines.push(["#4b1f78", 2.8, run]); run = []; };
  for (let i = 1; i < 400; i++) {  // the two branches, by the angle seen from the pole
    const w = -B2 + B2 * Math.tan(Math.PI * (i / 400 - 0.5)), y = at([0, w, motion(I, B2, B3, w).omega3]);
    if (i === 200 || !y.every(Number.isFinite) || Math.abs(dot(axis, y)) > REACH) flush(); else run.push(y);
  } flush();
  const O = at([0, 0, 0]), omega = [0, omega2, motion(I, B2, B3, omega2).omega3], point = at(omega);
  [0, 1, 2].forEach(i => { const tip = O.map((x, j) => x + (i === j ? 0.3 : 0)); panel.arrows.push(arrow(INK, 1.5, O, tip)); panel.names.push([i, INK, tip, O]); });
  panel.arrows.push(arrow(RED, 3.6, O, at([0, B2, B3]))); panel.names.push([3, RED, at([0, B2, B3]), O]);
  if (norm(...point) < 1.2) { panel.arrows.push(arrow(PLUM, 2.6, O, point)); panel.dots.push(["#d4552b", 7, point]); panel.names.push([4, PLUM, point, O]); }
  panel.dots.push([RED, 4.4, [0, 0, 0]]); return panel;
};
// In space: a cylindrical shell with this I, its axis and the trace of that over a span of time.
const right = ({I, B2, B3, at, span}, t) => {
  const panel = empty(20, 15), R = at(t), [a, b, n] = [0, 1, 2].map(j => R.map(row => row[j])), less = n.map(x => -x);
  const h = Math.sqrt(12 * Math.max(1 / I - 0.5, 0)), r = 0.34 / norm(1, h / 2), half = Math.max(r * h / 2, 0.012), wood = "#dfb578", bark = "#b07a35", seam = "#6b4517", low = [-0.6, -0.6, -0.6], high = [0.6, 0.6, 0.6];
  const P = (i, j) => (i === j ? 1 : 0) - n[i] * n[j], side = [P(0, 0), P(0, 1), P(0, 2), 0, P(1, 1), P(1, 2), 0, P(2, 2), 0, -r * r], ends = [...n, half, ...less, half], wedge = s => [...add(b.map(x => s * x), a, -0.25), 0];
  panel.surfaces.push([side, ends, [], wood, bark, 1, low, high], [side.slice(), [...ends, ...wedge(1), ...wedge(-1)], [], seam, seam, 1, low, high]);
  for (const s of [1, -1]) panel.lines.push([INK, 1.1, circle(n.map(x => s * half * x), a, b, r)]);
  const B = [0, B2 / norm(B2, B3), B3 / norm(B2, B3)], gone = Math.min(t, span), rod = 0.46;
  if (gone) panel.lines.push(["#2a57a5", 2.6, Array.from({length: 145}, (_, i) => at(t - gone * i / 144).map(row => rod * row[2]))]);
  panel.arrows.push(arrow(NAVY, 2.6, [0, 0, 0], n.map(x => rod * x)), arrow(RED, 3.6, [0, 0, 0], B.map(x => 0.5 * x)));
  panel.names.push([5, RED, B.map(x => 0.5 * x), [0, 0, 0]], [6, NAVY, n.map(x => rod * x), [0, 0, 0]]); return panel;
};

// The names of a panel, as letters of the page; those that are there stay.
const write = panel => {
  const {names} = panel.data, SVG = "http://www.w3.org/2000/svg"; if (panel.letters.length === names.length && panel.letters[0].querySelector("text")) return;
  panel.letters.forEach(one => one.remove());
  panel.letters = names.map(([number, colour]) => {
    const [letters, width] = TEXTS[number], made = document.createElementNS(SVG, "svg"), text = document.createElementNS(SVG, "text"); made.setAttribute("viewBox", [-width / 2 - 3, -9, width + 6, 18].map(x => 16 * x).join(" "));
    for (const [name, value] of Object.entries({fill: colour, "font-size": 176, "font-weight": 700, "text-anchor": "middle", y: 60})) text.setAttribute(name, value);
    text.textContent = letters; made.append(text); panel.viewer.letters.append(made); return made;
  });
};
for (const section of document.querySelectorAll(".explorer")) {
  const form = section.querySelector("form"), out = section.querySelector("output"), line = section.querySelector("code"), box = section.querySelector(".stage"), calm = matchMedia("(prefers-reduced-motion: reduce)");
  const all = section.dataset.tables && JSON.parse(section.dataset.tables), [first, second] = section.dataset.field.split(" ").map(Number), b = Math.hypot(first, second), value = name => sliders.value(name);
  let seen = false, viewer;
  const state = () => {
    if (all) {
      const off = ([I, , , omega1]) => Math.abs(I - value("I")) + Math.abs(omega1 - value("omega1")), of = ({command}) => command.match(/-?[\d.]+(e-?\d+)?(?= |$)/g).map(Number);
      const table = all.reduce((best, one) => off(of(one)) < off(of(best)) ? one : best), [I, B2, B3] = of(table);
      return {I, B2, B3, at: tabled(table, B2, B3), span: 6 * table.period, says: table.says, command: table.command};
    }
    const I = value("I"), angle = value("angle") * Math.PI / 180, omega2 = value("omega2"), still = value("angle") === sliders.find("angle").start, B2 = still ? first : b * Math.cos(angle), B3 = still ? second : b * Math.sin(angle), {omega3, k, phi, stability} = motion(I, B2, B3, omega2), spin = Number.isFinite(phi) ? phi : 0;
    const digits = x => Number.isFinite(x) ? String(Number(x.toPrecision(6))).replace("-", "−") : "none, at the pole", says = `${kind(I)}; ω₃ = ${digits(omega3)}, k = ${digits(k)}, φ = ${digits(phi)}; ${stability > 0 ? "stable" : "unstable"}`;
    return {I, B2, B3, omega2, at: t => rotation(B2, B3, k, spin, t), span: 2 * Math.PI / Math.abs(k || 1), says, command: `atlas motion --ratio ${I} --field ${Number(B2.toPrecision(12))} ${Number(B3.toPrecision(12))} --omega2 ${omega2}`};
  };
  const read = () => { if (location.hash.startsWith("#motion:")) sliders.read(new URLSearchParams(location.hash.slice(8))); };  // the state that the address names
  const say = () => { const {says, command} = state(); out.textContent = says; line.textContent = command; };
  const panels = all ? [() => right(state(), value("t"))] : [() => left(state()), () => right(state(), value("t"))];
  const show = which => { (which ?? panels.keys()).forEach(i => viewer.panels[i].set(panels[i]())); viewer.hurry(sliders.playing && seen ? 1500 : 250); };
  const changed = name => { if (!viewer) return; if (name === "t") show([panels.length - 1]); else { say(); show(); } };
  const keep = () => history.replaceState(null, "", `#motion:${new URLSearchParams(sliders.entries())}`);
  const sliders = new root.atlasSliders.Sliders(form, JSON.parse(form.dataset.sliders), changed, keep, () => seen);
  read(); section.hidden = false;
  const narrow = matchMedia("(max-width: 36rem)"), half = (x, y, width, height) => [x, y, width, height, 300, 300, 300, 150, 150];
  const places = () => all ? [half(narrow.matches ? 0 : 0.25, 0, narrow.matches ? 1 : 0.5, 1)] : narrow.matches ? [half(0, 0, 1, 0.5), half(0, 0.5, 1, 0.5)] : [half(0, 0, 0.5, 1), half(0.5, 0, 0.5, 1)];
  try {
    const scene = box.appendChild(document.createElement("div")); scene.className = "scene";
    viewer = new root.atlasViewer.Viewer(scene, {wide: {places: places(), panels: panels.map(make => make())}, texts: TEXTS.map(([letters, width]) => [width, 12, "", letters])}, box.dataset.says);
  } catch (error) { section.hidden = true; console.warn(error.message); continue; }
  box.classList.toggle("single", Boolean(all)); narrow.addEventListener("change", () => { viewer.shown.places = places(); viewer.hurry(); });
  for (const panel of viewer.panels) { panel.write = () => write(panel); panel.write(); }
  say(); viewer.hurry();
  sliders.go(!calm.matches); calm.addEventListener("change", () => sliders.go(!calm.matches));
  addEventListener("hashchange", () => { read(); say(); show(); });
  new IntersectionObserver(([{isIntersecting}]) => { seen = isIntersecting; if (seen) sliders.go(sliders.playing); }).observe(box);
}
})(globalThis);
