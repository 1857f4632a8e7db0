#!/usr/bin/env python3
"""A preprocessor of mdBook: links that leave docs/ lead to the repository, or become plain text.

The pages of docs/ are read in two places. In the repository a link such as ../grammar/README.md works as it stands. The site holds docs/ only:
with TRUNNION_REPOSITORY=https://host/owner/trunnion/blob/main such a link leads there; without it the text remains, with the path behind it.
"""

import json
import os
import posixpath
import re
import sys

LINK = re.compile(r"(!?)\[([^\]\n]*)\]\(([^)\s]+)\)")
README = re.compile(r"(^|/)README\.md(?=#|$)")
FENCE = re.compile(r"^(```.*?^```)", re.S | re.M)


def outside(page: str, target: str):
    """The path in the repository of a link that leaves docs/, else None. `page` is the name of the page below docs/."""
    if "://" in target or target.startswith(("#", "mailto:")):
        return None
    path, _, anchor = target.partition("#")
    full = posixpath.normpath(posixpath.join("docs", posixpath.dirname(page), path))
    if full == "docs" or full.startswith("docs/"):
        return None
    return full + ("#" + anchor if anchor else "")


def rewrite(page: str, text: str, repository: str) -> str:
    def link(match):
        image, words, target = match.groups()
        full = outside(page, target)
        if full is None:
            # mdBook writes README.md as index.html, and leaves links to it as they are
            inside = README.sub(r"\1index.md", target) if "://" not in target else target
            return f"{image}[{words}]({inside})"
        if repository:
            return f"{image}[{words}]({repository.rstrip('/')}/{full})"
        return f"`{full}`" if words.strip("`") == full else f"{words} (`{full}`)"

    # code stays as it is
    parts = FENCE.split(text)
    return "".join(part if part.startswith("```") else LINK.sub(link, part) for part in parts)


def walk(items, repository):
    for item in items:
        chapter = item.get("Chapter") if isinstance(item, dict) else None
        if chapter:
            if chapter.get("path"):
                chapter["content"] = rewrite(chapter["path"], chapter["content"], repository)
            walk(chapter.get("sub_items", []), repository)


def main() -> int:
    if sys.argv[1:2] == ["supports"]:
        return 0
    _, book = json.load(sys.stdin)
    walk(book.get("items", book.get("sections", [])), os.environ.get("TRUNNION_REPOSITORY", ""))
    json.dump(book, sys.stdout)
    return 0


if __name__ == "__main__":
    sys.exit(main())
