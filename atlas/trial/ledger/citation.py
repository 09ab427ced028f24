"""Where a text cites an entry of the ledger: "(72)", or a name such as theorem-pair.

A number in brackets is a citation unless it stands in a formula or in code, or follows a letter, a digit, a prime or
a closing bracket, as in f(3).
"""

import re
from collections.abc import Container

_CITED = re.compile(r"\$[^$]*\$|`[^`\n]*`|(?<![\w@)\]}'-])(\(\d{1,3}\)|(?:text|theorem)(?:-[a-z0-9]+)+\b)")


def cited(text: str) -> list[str]:
    """Return a list of the distinct names that a text cites, by first appearance: ["(72)", "theorem-pair"]."""
    return list(dict.fromkeys(name for name in _CITED.findall(text) if name))


def marked(text: str, names: Container[str]) -> str:
    """Return a text with @ before each citation whose name is in ``names``: in a report @(72) is a link."""
    return _CITED.sub(lambda match: f"@{match[1]}" if match[1] in names else match[0], text)
