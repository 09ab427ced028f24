"""A report file as typed records: what a user may write, and nothing else; the blocks are in `atlas.report.blocks`."""

from atlas.report.blocks import Block
from atlas.report.parameters import Parameters
from atlas.report.schema import Record, Slug


class Page(Record, frozen=True):
    """One page of the HTML, one section of the PDF; pages of one part stand together in the contents."""

    slug: Slug
    title: str
    blocks: tuple[Block, ...]
    summary: str = ""
    part: str = ""


class Report(Record, frozen=True):
    """The whole file."""

    name: str
    title: str
    pages: tuple[Page, ...]
    subtitle: str = ""
    authors: tuple[str, ...] = ()
    abstract: str = ""
    parameters: Parameters = Parameters()
