// A scene in a notebook: the viewer is put over its still picture as soon as that is there. Without
// WebGL 2 the still picture stays.
"use strict";
const box = document.createElement("div"), still = document.querySelector("img");
box.className = "scene";
still.parentElement.append(box);
const start = () => {
  try {
    const scene = JSON.parse(document.querySelector("#data").textContent),
      alt = `${still.alt} Arrow keys turn it, plus and minus zoom, 0 goes back.`;
    new atlasViewer.Viewer(box, scene, alt, false).hurry();
  } catch (error) {
    box.remove();
    console.warn(error.message);
  }
};
if (still.complete) start();
else still.addEventListener("load", start);
