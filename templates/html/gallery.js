// Keys of the gallery: arrows go from figure to figure, Escape back to all of them.
const shown = () => document.querySelector(".plate:target");

function focus() {
  shown()?.focus({ preventScroll: true });
}

addEventListener("hashchange", focus);
addEventListener("keydown", (event) => {
  const plate = shown(), typing = event.target.matches("input, canvas, a[data-scene]");
  if (!plate || typing || event.altKey || event.ctrlKey || event.metaKey) return;
  const place = { Escape: "a", ArrowLeft: "a[rel=prev]", ArrowRight: "a[rel=next]" }[event.key];
  const link = place && plate.querySelector(`.steps ${place}`);
  if (!link) return;
  const back = event.key === "Escape" && document.querySelector(`.plates a[href="#${plate.id}"]`);
  link.click();
  if (back) back.focus();
});
focus();
