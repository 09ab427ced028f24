"""A scene as one document for a cell of a notebook: the still picture, and over it the viewer, if there is WebGL 2."""

import json
from base64 import b64encode
from html import escape
from io import BytesIO

from atlas.draw.panels import to_figure
from atlas.draw.viewer import data
from atlas.places import folder
from atlas.scene.layers import Scene

_DOTS, _SCREEN, _INCH = 192, 96, 25.4
_POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"
_STYLE = """
html, body { margin: 0; background: #fff; overflow: hidden; }
.turned { position: relative; }
img { display: block; width: 100%; }
.scene, .scene > :is(canvas, div) { position: absolute; inset: 0; width: 100%; height: 100%; }
.scene canvas { cursor: move; touch-action: none; }
.scene > div { pointer-events: none; overflow: hidden; }
.scene svg { position: absolute; left: 0; top: 0; will-change: transform; }
.scene :is(path, text) { stroke: #fff; stroke-width: 35px; stroke-linejoin: round; paint-order: stroke; }
"""
_START = """
const box = document.createElement("div"), still = document.querySelector("img");
box.className = "scene";
still.parentElement.append(box);
const start = () => {
  try {
    new atlasViewer.Viewer(box, JSON.parse(document.querySelector("#data").textContent), `${still.alt} Arrow keys turn it, plus and minus zoom, 0 goes back.`, false).hurry();
  } catch (error) { box.remove(); console.warn(error.message); }  // without WebGL 2 the still picture stays
};
still.complete ? start() : still.addEventListener("load", start);
"""  # noqa: E501  lines of a script


def mimebundle(scene: Scene) -> dict[str, str]:
    """Return what a notebook shows of a scene: a frame with the document, in words where it shows no HTML."""
    width, height = (round(_SCREEN * length / _INCH) for length in scene.size)
    frame = (
        f'<iframe width="{width}" height="{height}" style="border:0;max-width:100%" sandbox="allow-scripts" '
        f'title="{escape(scene.title)}" srcdoc="{escape(document(scene))}"></iframe>'
    )
    return {"text/html": frame, "text/plain": f"{scene.title}. {scene.alt}"}


def document(scene: Scene) -> str:
    """Return the document: it asks for nothing else, and its policy lets it ask for nothing."""
    file = BytesIO()
    to_figure(scene).savefig(file, format="png", dpi=_DOTS)
    still = b64encode(file.getvalue()).decode()
    viewer = (folder("templates") / "html" / "scene.js").read_text(encoding="utf-8")
    content = json.dumps(data(scene), ensure_ascii=False, separators=(",", ":")).replace("<", r"\u003c")
    return "\n".join(
        (
            f'<!DOCTYPE html><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="{_POLICY}">',
            f"<title>{escape(scene.title)}</title><style>{_STYLE}</style>",
            f'<div class="turned"><img alt="{escape(scene.alt)}" src="data:image/png;base64,{still}"></div>',
            f'<script type="application/json" id="data">{content}</script>',
            f"<script>{viewer}</script><script>{_START}</script>",
        )
    )
