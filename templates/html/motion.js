// Figures that move in time: play, pause and a slider below each picture that has a table of its
// motion. What rides on a path of a scene is carried by it, turns and shifts between two moments of
// the table; marks of panels with two axes go over the still picture. Nothing moves before it is
// asked to. Without WebGL 2 what stands in space stays still.
"use strict";
((root) => {
  const FINE = 32767, SECONDS = 12, MOST = 1000;
  const numbers = (packed) =>
    new Int16Array(Uint8Array.from(atob(packed), (letter) => letter.charCodeAt(0)).buffer);
  // The rows between which a moment u of 0..1 lies, mixed; `count` numbers a row.
  const mixed = (table, count, u) => {
    const last = table.length / count - 1,
      at = Math.min(Math.max(u, 0), 1) * last,
      i = Math.min(Math.floor(at), last - 1);
    return Array.from(
      { length: count },
      (_, j) =>
        (table[count * i + j] + (at - i) * (table[count * (i + 1) + j] - table[count * i + j])) /
        FINE,
    );
  };
  // The rigid motion x -> R x + s of a path: R row by row, from the unit quaternion (w, x, y, z).
  const rigid = ([size, table], u) => {
    const row = mixed(table, 7, u),
      norm = Math.hypot(...row.slice(0, 4)),
      [w, x, y, z] = row.slice(0, 4).map((a) => a / norm);
    return {
      R: [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], [
        2 * (x * y + w * z),
        1 - 2 * (x * x + z * z),
        2 * (y * z - w * x),
      ], [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]],
      s: row.slice(4).map((a) => a * size),
    };
  };
  const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
  // The same in the coordinates (x - centre)/size of a panel.
  const within = ({ R, s }, [a, b, c, size]) => ({
    R,
    s: R.map((row, i) => (dot(row, [a, b, c]) + s[i] - [a, b, c][i]) / size),
  });
  const carry = ({ R, s }, x) => R.map((row, i) => dot(row, x) + s[i]);
  // Numbers of a panel, moved: points one after the other, half spaces n x <= d, and the upper
  // triangle of a quadric.
  const places = (move, flat) =>
    Array.from({ length: flat.length / 3 }, (_, i) => carry(move, flat.slice(3 * i, 3 * i + 3)))
      .flat();
  const planes = ({ R, s }, flat) =>
    Array.from({ length: flat.length / 4 }, (_, i) => {
      const n = R.map((row) => dot(row, flat.slice(4 * i, 4 * i + 3)));
      return [...n, flat[4 * i + 3] + dot(n, s)];
    }).flat();
  const form = ({ R, s }, [a, b, c, d, e, f, g, h, i, k]) => {
    const A = [[a, b, c], [b, e, f], [c, f, h]],
      l = [d, g, i],
      AR = A.map((row) => R.map((r) => dot(row, r))),
      M = R.map((r) => R.map((_, j) => dot(r, AR.map((row) => row[j]))));
    const v = R.map((r) => dot(r, l)), m = M.map((row, j) => v[j] - dot(row, s));
    return [
      M[0][0],
      M[0][1],
      M[0][2],
      m[0],
      M[1][1],
      M[1][2],
      m[1],
      M[2][2],
      m[2],
      k - dot(v, s) - dot(m, s),
    ];
  };
  const box = (move, low, high) => {
    const corners = Array.from(
      { length: 8 },
      (_, k) => carry(move, [0, 1, 2].map((i) => (k >> i & 1 ? low : high)[i])),
    );
    return [Math.min, Math.max].map((end) =>
      [0, 1, 2].map((i) => end(...corners.map((x) => x[i])))
    );
  };
  const KINDS = {
    surfaces: (
      move,
      [Q, clip, inside, front, back, dense, low, high],
    ) => [
      form(move, Q),
      planes(move, clip),
      inside.map((one) => form(move, one)),
      front,
      back,
      dense,
      ...box(move, low, high),
    ],
    lines: (move, [colour, tube, line]) => [colour, tube, line.map((x) => carry(move, x))],
    wires: (move, [colour, tube, line]) => [colour, tube, line.map((x) => carry(move, x))],
    arrows: (
      move,
      [colour, tube, head, broad, tail, tip],
    ) => [colour, tube, head, broad, carry(move, tail), carry(move, tip)],
    dots: (move, [colour, tube, at]) => [colour, tube, carry(move, at)],
    names: (
      move,
      [text, colour, at, stands],
    ) => [text, colour, places(move, at), stands.length === 3 ? carry(move, stands) : stands],
  };
  root.atlasMoves = { rigid, within, carry, form, planes, box };
  if (!root.document || !root.atlasViewer) return;

  const { load, open, points, webgl } = root.atlasViewer;
  const make = (tag, attributes, ...inside) => {
    const made = document.createElement(tag);
    Object.entries(attributes).forEach(([name, value]) => made.setAttribute(name, value));
    made.append(...inside);
    return made;
  };

  class Movement {
    constructor(link) {
      this.link = link;
      this.still = link.querySelector("img");
      this.u = 0;
      this.last = null;
      this.button = make("button", { type: "button" }, "Play");
      this.slider = make("input", {
        type: "range",
        min: 0,
        max: MOST,
        step: 1,
        value: 0,
        "aria-label": "time",
      });
      this.out = make("output", { "aria-live": "off" });
      const bar = make(
        "div",
        { class: "motion", role: "group", "aria-label": "Motion of the figure" },
        this.button,
        this.slider,
        this.out,
      );
      this.frame = link.closest(".turned") ?? make("div", { class: "turned" });
      if (!this.frame.isConnected) {
        link.replaceWith(this.frame);
        this.frame.append(link);
      }
      this.frame.after(bar);
      if (this.frame.parentElement.classList.contains("pictures")) {
        this.frame.parentElement.classList.add("moving");
      }
      this.button.addEventListener("click", () => this.go(!this.playing));
      this.slider.addEventListener("input", () => {
        this.u = this.slider.value / MOST;
        this.last = null;
        this.show();
      });
      this.still.addEventListener("load", () => this.overlay?.remove());
    }
    get viewer() {
      const { viewer } = this.link;
      return viewer?.box.isConnected ? viewer : null;
    }
    // What is needed to show a moment: the tables, and the scene opened if something in space
    // moves.
    async ready() {
      if (!this.data) {
        const data = await load(this.link.dataset.moves);
        for (const name of Object.keys(data.paths)) {
          data.paths[name][1] = numbers(data.paths[name][1]);
        }
        for (const layout of [data.wide, data.narrow]) {
          for (const mark of layout?.marks ?? []) mark[2] = numbers(mark[2]);
        }
        this.data = data;
      }
      if (this.layout.spaces.length && this.link.dataset.scene && !this.viewer && webgl()) {
        const { activeElement } = document;
        await open(this.link);
        activeElement?.focus({ preventScroll: true });
      }
      const { viewer } = this;
      if (viewer && this.shown !== viewer) {
        this.shown = viewer;
        this.bases = viewer.panels.map((panel) => this.base(panel));
      }
    }
    get layout() {
      return (this.still.currentSrc.includes("-narrow.") && this.data.narrow) || this.data.wide;
    }
    base(panel) {
      panel.write = () => {};
      return {
        ...panel.data,
        lines: panel.data.lines.map(([colour, tube, line]) => [colour, tube, points(line)]),
        wires: panel.data.wires.map(([colour, tube, line]) => [colour, tube, points(line)]),
      };
    }
    async show() {
      if (this.busy) {
        this.again = true;
        return;
      }
      this.busy = true;
      try {
        await this.ready();
      } catch (error) {
        console.warn(error.message);
        this.go(false);
        return;
      } finally {
        this.busy = false;
      }
      if (this.again) this.again = false;
      const { u, data, layout } = this, t = u * data.lasts;
      if (this.viewer) {
        layout.spaces.forEach(([frame, riders], number) => {
          if (!riders.length) return;
          const shown = { ...this.bases[number] }, moves = {};
          for (const [kind, from, to, path] of riders) {
            const move = moves[path] ??= within(rigid(data.paths[path], u), frame);
            if (shown[kind] === this.bases[number][kind]) shown[kind] = shown[kind].slice();
            for (let i = from; i < to; i++) shown[kind][i] = KINDS[kind](move, shown[kind][i]);
          }
          this.viewer.panels[number].set(shown);
        });
        this.viewer.hurry(this.playing ? 1500 : 250);
      }
      this.mark(layout);
      this.slider.value = Math.round(u * MOST);
      this.out.textContent = `t = ${t.toPrecision(3)}`;
      this.slider.setAttribute("aria-valuetext", this.out.textContent);
    }
    mark({ marks, size: [width, height] }) {
      if (!marks.length) return;
      const svg = (tag, attributes) => {
        const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
        Object.entries(attributes).forEach((pair) => made.setAttribute(...pair));
        return made;
      };
      if (!this.overlay?.isConnected) {
        this.overlay = svg("svg", {
          class: "marks",
          viewBox: `0 0 ${width} ${height}`,
          "aria-hidden": "true",
        });
        this.frame.append(this.overlay);
        for (const [colour, diameter] of marks) {
          this.overlay.append(
            svg("circle", {
              r: 0.5 * diameter + 0.6,
              fill: colour,
              stroke: "#fff",
              "stroke-width": 0.8,
            }),
          );
        }
      }
      marks.forEach(([, , table], i) => {
        const [x, y] = mixed(table, 2, this.u);
        this.overlay.children[i].setAttribute("cx", x * width);
        this.overlay.children[i].setAttribute("cy", y * height);
      });
    }
    go(wanted) {
      this.playing = wanted;
      this.button.textContent = wanted ? "Pause" : "Play";
      cancelAnimationFrame(this.asked);
      this.last = null;
      if (wanted) this.tick();
    }
    async tick() {
      await this.show();
      if (this.playing) {
        this.asked = requestAnimationFrame((clock) => {
          if (this.last !== null) {
            this.u = (this.u + Math.min(clock - this.last, 100) * 1e-3 / SECONDS) % 1;
          }
          this.last = clock;
          this.tick();
        });
      }
    }
  }
  for (const link of document.querySelectorAll("a[data-moves]")) {
    if (!link.dataset.scene || webgl()) new Movement(link);
  }
})(globalThis);
