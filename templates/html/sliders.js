// Sliders for numbers, each with its value beside it, which can be typed; a button lets the time t
// run. Pages of a report and the explorer on the user's own machine share them.
"use strict";
((root) => {
  // Milliseconds between two frames that are counted; with fewer steps a slider has these values
  // and no others.
  const LONGEST = 200, FEW = 20;
  const make = (tag, attributes, ...inside) => {
    const made = document.createElement(tag);
    Object.entries(attributes).forEach(([name, value]) => made.setAttribute(name, value));
    made.append(...inside);
    return made;
  };

  class Sliders {
    // `given` are {name, symbol, says, low, high, step, start}; `changed` is told the name of what
    // moves, `rested` is called when a change is over. The time runs while `ready` says so.
    constructor(form, given, changed, rested = () => {}, ready = () => true) {
      Object.assign(this, {
        changed,
        rested,
        ready,
        playing: false,
        last: null,
        all: given.map((one) => this.add(one)),
      });
      form.replaceChildren(...this.all.map((one) => one.label));
      form.addEventListener("submit", (event) => event.preventDefault());
      this.time = this.find("t");
      if (this.time) {
        this.button = make("button", { type: "button", "aria-pressed": "false" }, "Play");
        this.button.addEventListener("click", () => this.go(!this.playing));
        form.append(this.button);
      }
    }
    add({ name, symbol, says, low, high, step, start }) {
      const range = make("input", {
          type: "range",
          name,
          min: low,
          max: high,
          step,
          "aria-label": says,
        }),
        exact = make("input", { type: "number", step: "any", "aria-label": `${says}, typed` });
      const one = {
        name,
        start,
        high: Number(high),
        label: make("label", { title: says }, make("span", {}, symbol || name), range, exact),
        set(value) {
          range.value = value;
          one.value = (high - low) / step < FEW ? Number(range.value) : value;
          exact.value = Number(Number(one.value).toPrecision(6));
        },
      };
      const moved = () => {
        if (one === this.time) this.last = null;
        this.changed(name);
      };
      range.addEventListener("input", () => {
        one.set(Number(range.value));
        moved();
      });
      exact.addEventListener("change", () => {
        if (exact.value !== "") {
          one.set(Number(exact.value));
          moved();
        }
      });
      for (const input of [range, exact]) input.addEventListener("change", () => this.rested());
      one.set(start);
      return one;
    }
    find(name) {
      return this.all.find((one) => one.name === name);
    }
    value(name) {
      return this.find(name).value;
    }
    entries() {
      return this.all.map((one) => [one.name, one.value]);
    }
    // Take the values of an address; what is no number there stays as it was.
    read(parameters) {
      for (const [name, value] of parameters) {
        const one = this.find(name);
        if (one && value !== "" && Number.isFinite(Number(value))) one.set(Number(value));
      }
    }
    go(wanted) {
      this.playing = wanted;
      this.button.textContent = wanted ? "Pause" : "Play";
      this.button.setAttribute("aria-pressed", String(wanted));
      cancelAnimationFrame(this.asked);
      this.last = null;
      if (wanted) this.asked = requestAnimationFrame((clock) => this.tick(clock));
      else this.changed("t");
    }
    tick(clock) {
      if (!this.playing || !this.ready()) {
        this.last = null;
        return;
      }
      if (this.last !== null) {
        this.time.set(
          Math.round(
            (this.time.value + Math.min(clock - this.last, LONGEST) * 1e-3) % this.time.high * 1e3,
          ) / 1e3,
        );
        this.changed("t");
      }
      this.last = clock;
      this.asked = requestAnimationFrame((next) => this.tick(next));
    }
  }
  root.atlasSliders = { Sliders, make };
})(globalThis);
