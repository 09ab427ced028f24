"""A report's template filled in by a process of its own, which ends after so much time, memory and text.

The parent sends values, head and body as JSON; the child, which runs this file, answers the same with all tags filled
in, or a sentence and its place. Values are data: no object of Python is in reach of a template.
"""

import json
import re
import resource
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

OPEN, CLOSE = "<$", "$>"
"""Signs around an expression: neither TeX nor Markdown has a meaning for them."""
MAX_SECONDS = 5
"""Largest processor time of an expansion, in seconds."""
MAX_LENGTH = 5_000_000
"""Largest number of characters of a report."""
MAX_MEMORY = 1 << 30
"""Largest memory of an expansion, in bytes."""
FIRST_MARK, LAST_MARK = 0xF0000, 0xFFFFD
"""Private characters that stand for the numbers of lines while a template is filled in."""
MARKS = re.compile(f"[{chr(FIRST_MARK)}-{chr(LAST_MARK)}]")


class ExpansionError(ValueError):
    """A message about a template, with its `line` in the body, from 1, or the head's `text` that has the mistake.

    The line is 0, or the text "", where the mistake is in the other or its place is unknown.
    """

    def __init__(self, sentence: str, line: int = 0, text: str = "") -> None:
        super().__init__(sentence)
        self.line, self.text = line, text


def expanded(values: Mapping[str, Any], head: Any, body: str) -> tuple[Any, str, list[int]]:
    """Return a report's head and body with their tags filled in, and the template's line for each new line.

    `values` are those that the tags name, `head` a nested dict or list, `body` the text below it; the third result
    is a list of lines from 1. A text of the head that is a single expression becomes the expression's value, such
    as a number.

    Raises
    ------
    ExpansionError
        For a mistake in a template, an unknown name, a forbidden attribute, and an expansion without an end.
    """
    request = json.dumps({"values": values, "head": head, "body": body})
    command = [sys.executable, "-P", __file__]
    child = subprocess.run(command, input=request, capture_output=True, encoding="utf-8", check=False)  # noqa: S603
    if child.returncode:
        raise ExpansionError(
            f"the template needs more than {MAX_SECONDS} s or {MAX_MEMORY >> 20} MB to be filled in: let its loops end."
        )
    answer = json.loads(child.stdout)
    if "error" in answer:
        raise ExpansionError(*answer["error"])
    return answer["head"], answer["body"], answer["lines"]


def fill(values: Mapping[str, Any], head: Any, body: str) -> dict[str, Any]:
    """Return {"head", "body", "lines"}: head and body filled in, and the template's line for each line of the body.

    The parameters are those of `expanded`. For a mistake the result is {"error": (message, line, text of the head
    or "")}.
    """
    environment = sandbox()

    def value(text: str) -> Any:
        inner = text.strip().removeprefix(OPEN).removesuffix(CLOSE)
        try:
            if f"{OPEN}{inner}{CLOSE}" == text.strip() and CLOSE not in inner:
                return json.loads(json.dumps(environment.compile_expression(inner, undefined_to_none=False)(**values)))
            return MARKS.sub("", joined(environment.from_string(text).generate(values)))
        except Exception as error:
            raise ExpansionError(sentence_of(error), text=text) from error

    try:
        filled = mapped(head, value)
        marked = joined(environment.from_string(body).generate(values))
    except ExpansionError as error:
        return {"error": (str(error), error.line, error.text)}
    except Exception as error:  # noqa: BLE001  whatever a template does is its own mistake
        return {"error": (sentence_of(error), line_of(error), "")}
    lines, line = list[int](), 1
    for text in marked.split("\n"):
        marks = MARKS.findall(text)
        line = ord(marks[-1]) - FIRST_MARK if marks else line
        lines.append(line)
    return {"head": filled, "body": MARKS.sub("", marked), "lines": lines}


def joined(pieces: Iterable[str]) -> str:
    """Return the joined pieces of a text. Raises ExpansionError above MAX_LENGTH characters."""
    texts, length = list[str](), 0
    for piece in pieces:
        texts.append(piece)
        length += len(piece)
        if length > MAX_LENGTH:
            raise ExpansionError(f"the report grows beyond {MAX_LENGTH} characters: let the loops of its template end.")
    return "".join(texts)


def mapped(value: Any, function: Callable[[str], Any]) -> Any:
    """Return a nested value of dicts and lists with `function` applied to each text with a tag <$, <% or <#."""
    if isinstance(value, dict):
        return {key: mapped(item, function) for key, item in value.items()}
    if isinstance(value, list):
        return [mapped(item, function) for item in value]
    return function(value) if isinstance(value, str) and re.search(r"<[$%#]", value) else value


def sentence_of(error: Exception) -> str:
    """Return the message of an error without its full stop, or the error's class. Raises a MemoryError again."""
    if isinstance(error, MemoryError):
        raise error
    return str(error).rstrip(".") or type(error).__name__


def line_of(error: BaseException) -> int:
    """Return the line of a template, counted from 1, on which an error came up; 1 if the error names none.

    The innermost frame of the template in the traceback counts, else the error's attribute ``lineno``.
    """
    line = getattr(error, "lineno", None) or 1
    trace = error.__traceback__
    while trace is not None:
        line = trace.tb_lineno if trace.tb_frame.f_code.co_filename == "<template>" else line
        trace = trace.tb_next
    return int(line)


def sandbox() -> Any:
    """Return the Jinja environment of templates, with the tags <$ $>, <% %> and <# #>.

    It marks each line of text by a private character for its number, and refuses unsafe attributes and unknown names.
    """
    from jinja2 import StrictUndefined
    from jinja2.ext import Extension
    from jinja2.lexer import Token, TokenStream
    from jinja2.sandbox import ImmutableSandboxedEnvironment

    class Lines(Extension):
        """Jinja extension that puts a mark with its number before each line of text."""

        def filter_stream(self, stream: TokenStream) -> Iterator[Token]:
            for token in stream:
                if token.type != "data":
                    yield token
                    continue
                texts = enumerate(token.value.split("\n"), token.lineno)
                marked = (chr(min(FIRST_MARK + number, LAST_MARK)) + text for number, text in texts)
                yield Token(token.lineno, "data", "\n".join(marked))

    return ImmutableSandboxedEnvironment(
        variable_start_string=OPEN, variable_end_string=CLOSE, block_start_string="<%", block_end_string="%>",
        comment_start_string="<#", comment_end_string="#>", undefined=StrictUndefined, trim_blocks=True,
        keep_trailing_newline=True, autoescape=False, extensions=[Lines],
    )  # fmt: skip


def main() -> None:
    """Read a request for `fill`, JSON on standard input, and write the answer as JSON on standard output.

    The process is ended beyond the limits of time and memory.
    """
    resource.setrlimit(resource.RLIMIT_CPU, (MAX_SECONDS, MAX_SECONDS))
    resource.setrlimit(resource.RLIMIT_AS, (MAX_MEMORY, MAX_MEMORY))
    sys.stdout.write(json.dumps(fill(**json.loads(sys.stdin.read()))))


if __name__ == "__main__":
    main()
