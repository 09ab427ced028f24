// The explorer on the user's own machine: sliders for a family or a figure, whose picture and
// numbers the server on this machine computes: doubles while a slider moves, proven digits when it
// rests. The state stands in the address.
"use strict";
(() => {
  const REST = 350,
    MOVING = 1500,
    byId = (id) => document.getElementById(id),
    [title, choice, stage, form, error, numbers, command] = [
      "title",
      "subject",
      "stage",
      "sliders",
      "error",
      "numbers",
      "command",
    ].map(byId);
  const { Sliders, make } = globalThis.atlasSliders;
  const ask = async (place, query = {}) => {
    const answer = await fetch(`${place}?${new URLSearchParams(query)}`);
    if (!answer.ok) throw new Error(await answer.text());
    return answer.json();
  };
  let sliders, viewer, busy = false, wanted = false, rest, shown = 0;

  const values = () => ({ subject: choice.value, ...Object.fromEntries(sliders.entries()) });
  const show = (proven, { scene, alt, size, numbers: rows, command: line }) => {
    error.textContent = "";
    command.textContent = line;
    stage.style.aspectRatio = `${size[0]} / ${size[1]}`;
    if (scene && viewer?.panels.length === scene.wide.panels.length) {
      viewer.data = scene;
      viewer.shown = scene.wide;
      viewer.panels.forEach((panel, i) => {
        panel.set(scene.wide.panels[i]);
      });
      viewer.hurry(proven ? 0 : MOVING);
    } else {
      viewer?.close();
      viewer = null;
      stage.replaceChildren();
      if (scene) {
        const box = make("div", { class: "scene" });
        stage.append(box);
        try {
          viewer = new globalThis.atlasViewer.Viewer(
            box,
            scene,
            `${alt} Arrow keys turn it, plus and minus zoom, 0 goes back.`,
            false,
          );
          viewer.hurry();
        } catch {
          box.remove();
        }
      }
    }
    if (!viewer) {
      const still = stage.querySelector("img") ?? stage.appendChild(make("img", {}));
      still.alt = alt;
      still.src = `figure?${new URLSearchParams({ ...values(), format: "svg" })}`;
    }
    numbers.hidden = !rows.length;
    numbers.tBodies[0].replaceChildren(
      ...rows.map(({ name, says, value, unit, sure }) =>
        make(
          "tr",
          {},
          make("th", { scope: "row", title: says }, name),
          make("td", {}, value),
          make("td", {}, unit.replace("^2", "²").replace("^3", "³")),
          make("td", {}, sure),
        )
      ),
    );
    for (const link of document.querySelectorAll("#save a")) {
      const { format } = link.dataset;
      link.href = `figure?${new URLSearchParams({ ...values(), format })}`;
      link.download = `${choice.value}.${format}`;
    }
    shown += 1;
    document.documentElement.dataset.shown = shown;
  };
  // One question at a time: what has changed meanwhile is asked for when the answer is there.
  const update = async (proven = 0) => {
    clearTimeout(rest);
    if (busy) {
      wanted = true;
      return;
    }
    busy = true;
    try {
      const state = values(), found = await ask("state", { ...state, proven });
      if (state.subject === choice.value) {
        if (found.error) error.textContent = found.error;
        else show(proven, found);
      }
    } catch (problem) {
      error.textContent = `The server does not answer: ${problem.message}`;
      sliders.playing && sliders.go(false);
    }
    busy = false;
    if (wanted) {
      wanted = false;
      update();
    } else if (!proven && !sliders.playing) {
      rest = setTimeout(() => {
        update(1);
        keep();
      }, REST);
    }
  };
  const keep = () => history.replaceState(null, "", `#${new URLSearchParams(values())}`);
  const open = async (given) => {
    const found = await ask("sliders", { subject: choice.value });
    if (found.error) {
      error.textContent = found.error;
      return;
    }
    title.textContent = found.title[0].toUpperCase() + found.title.slice(1);
    document.title = `${title.textContent} · atlas explore`;
    sliders?.playing && sliders.go(false);
    sliders = new Sliders(form, found.sliders, () => update());
    sliders.read(given);
    viewer?.close();
    viewer = null;
    stage.replaceChildren();
    update();
  };
  choice.addEventListener("change", () => open(new URLSearchParams()));
  ask("subjects").then(({ start, ...groups }) => {
    for (const [label, entries] of Object.entries(groups)) {
      choice.append(make(
        "optgroup",
        { label },
        ...entries.map(([name, says]) => make("option", { value: name }, `${name}: ${says}`)),
      ));
    }
    const given = new URLSearchParams(location.hash.slice(1)), name = given.get("subject") ?? start;
    if (![...choice.options].some((one) => one.value === name)) {
      choice.append(make("option", { value: name }, name));
    }
    choice.value = name;
    return open(given);
  }).catch((problem) => {
    error.textContent = problem.message;
  });
})();
