#!/usr/bin/env python3
"""Reads all pages of a built site and reports each link, picture or anchor that leads nowhere. Status 1 if there is one."""

import html.parser
import os
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.names, self.links = set(), []

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.names.update(value for key, value in attributes if key in ("id", "name") and value)
        self.links += [values[key] for key in ("href", "src") if values.get(key) and tag in ("a", "img", "link", "script")]


def main(root: str) -> int:
    pages = {}
    for folder, _, files in os.walk(root):
        for name in files:
            if name.endswith(".html"):
                path = os.path.join(folder, name)
                pages[path] = Page()
                with open(path, encoding="utf-8") as file:
                    pages[path].feed(file.read())
    wrong, count = set(), 0
    for path, page in pages.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc or os.path.basename(path) in ("404.html", "print.html", "toc.html"):
                continue
            count += 1
            target = os.path.normpath(os.path.join(os.path.dirname(path), urllib.parse.unquote(parts.path))) if parts.path else path
            anchor = urllib.parse.unquote(parts.fragment)
            shown = f"{os.path.relpath(path, root)}: {link}"
            if not os.path.isfile(target):
                wrong.add(f"{shown}: no such file")
            elif anchor and target in pages and anchor not in pages[target].names:
                wrong.add(f"{shown}: no such heading")
    print("\n".join(sorted(wrong)) if wrong else f"{len(pages)} pages, {count} links, all lead somewhere")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
