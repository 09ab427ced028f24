"""A report of one page as one file: styles, fonts, figures and scripts stand in it, and it asks for nothing else."""

import re
from base64 import b64encode
from collections.abc import Mapping
from hashlib import sha256

from atlas.errors import AtlasError

TYPES = {
    "svg": "image/svg+xml", "png": "image/png", "pdf": "application/pdf", "gz": "application/gzip",
    "woff": "font/woff",
}  # fmt: skip
HANDED_OVER = """
// What this page would fetch by a script element stands in it as a block of data.
document.head.append = (...nodes) => {
  for (const node of nodes) {
    const inside = node.localName === "script" && document.querySelector(`script[data-file="${node.getAttribute("src")}"]`);
    if (inside) { node.removeAttribute("src"); node.text = inside.textContent; }
  }
  Element.prototype.append.apply(document.head, nodes);
};
"""  # noqa: E501  a line of a script
INDEX = "index.html"
_SCRIPT = re.compile(r'<script src="([^"]+)" defer></script>\n?')


def single(files: Mapping[str, bytes], name: str) -> bytes:
    """Put the files of a report of one page into one page. Raises AtlasError for a report of several.

    `files` has the page, index.html, and what belongs to it, by their places; `name` is that of the report, whose PDF
    may lie beside the page. Figures can be saved from it; its policy lets it run the scripts in it, by their digests.
    """
    pages = [file for file in files if file.endswith(".html")]
    if pages != [INDEX]:
        raise AtlasError(f"one file holds one page, but the report has {len(pages)}: leave out the format 'single'.")

    def data(place: str) -> str:
        kind = TYPES[place.rpartition(".")[2]]
        return f"data:{kind};base64,{b64encode(files[place]).decode()}"

    page = files[INDEX].decode()
    style = re.sub(r'url\("?([^")]+)"?\)', lambda matched: f'url("{data(matched[1])}")', files["style.css"].decode())
    first = _SCRIPT.findall(page)
    later = [file for file in files if file.endswith(".js") and file not in first]
    scripts = {file: _inline(files[file].decode()) for file in (*later, *first)}
    scripts |= {"index.js": scripts["index.js"].replace(f'"{INDEX}"', '""')}
    page = _SCRIPT.sub("", page)
    page = page.replace('<link rel="stylesheet" href="style.css">', f"<style>\n{style}</style>")
    # a browser saves the picture itself: no second copy of it
    page = re.sub(r'<a href="figures/[^"]+\.svg" aria-label[^>]*>SVG</a> ', "", page)
    page = re.sub(r'(<figure id="([^"]+)">\s*<div class="pictures">\s*<a href=")[^"]+', r"\1#\2", page)
    page = re.sub(r'<a href="(figures/([^"]+))"', lambda x: f'<a download="{x[2]}" href="{data(x[1])}"', page)
    page = re.sub(r'(src|srcset)="(figures/[^"]+\.(?:svg|png))"', lambda x: f'{x[1]}="{data(x[2])}"', page)
    page = re.sub(rf'href="{INDEX}(#[^"]*)?"', lambda matched: f'href="{matched[1] or "#page-index"}"', page)
    page = page.replace(f'href="../{name}.pdf"', f'href="{name}.pdf"')
    run = [HANDED_OVER, *(scripts[file] for file in first)]
    blocks = [f'<script type="text/plain" data-file="{file}">{scripts[file]}</script>' for file in later]
    blocks += [f"<script>{text}</script>" for text in run]
    page = page.replace("</body>", "\n".join([*blocks, "</body>"]))
    allowed = (sha256(text.encode()).digest() for text in (*run, *(scripts[file] for file in later)))
    digests = " ".join(f"'sha256-{b64encode(digest).decode()}'" for digest in allowed)
    policy = (
        f"default-src 'none'; img-src data:; font-src data:; style-src 'unsafe-inline'; script-src {digests}; "
        "base-uri 'none'; form-action 'none'"
    )
    return re.sub(r'(http-equiv="Content-Security-Policy" content=")[^"]*', rf"\g<1>{policy}", page).encode()


def _inline(script: str) -> str:
    """Return a script in which nothing ends or hides the element that it stands in."""
    return script.replace("</script", r"<\/script").replace("<!--", r"<\!--")
