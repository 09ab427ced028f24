"""Templates compiled before, kept in the store under their text and the code that sets them."""

import sys

from jinja2 import BytecodeCache
from jinja2.bccache import Bucket

from atlas.build.sources import digest, release
from atlas.build.store import Store


class Compiled(BytecodeCache):
    """Compiled templates; `code` is the digest of what compiles and fills them."""

    def __init__(self, store: Store, code: str) -> None:
        self._store = store
        self._setting = [code, release("jinja2"), sys.implementation.cache_tag]

    def load_bytecode(self, bucket: Bucket) -> None:
        """Fill a bucket with what was compiled from the same text, if there is such."""
        content = self._store.recall(self._key(bucket))
        if content is not None:
            bucket.bytecode_from_string(content)

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Keep what was compiled."""
        self._store.keep(self._key(bucket), bucket.bytecode_to_string())

    def _key(self, bucket: Bucket) -> str:
        return digest("template", self._setting, bucket.key, bucket.checksum)
