#!/usr/bin/env python3
"""Latency and memory of the language server over the wire.

    cargo build --release && python3 benches/lsp.py [BLOCKS [EDITS]]

Starts `trunnion lsp` (TRUNNION_BIN, else target/release/trunnion), opens a five-axis program of BLOCKS blocks (1 000 000) and types into
its middle EDITS times (100): it opens and closes a bracket, which the text alone shows, and turns an axis faster than it can and back,
which the machine shows. Each time it asks for colours and hover at once. Every tenth time it waits until the whole is checked.
Prints medians and 95th percentiles from the message sent to the message received, and the server's memory (Linux).
"""
import json
import os
import pathlib
import subprocess
import sys
import threading
import time

URI = "untitled:/bench.nc"
HEAD = "(trunnion: dialect fanuc-30i)\n(trunnion: machine mikron-ucp710)\nO1\nG21 G90 G17 G54\nT1 M6\nS12000 M3\nG43.4 H1\nG0 X0. Y0. Z80. A0. C0.\n"
PATIENCE = 120


def program(blocks):
    """A wavy five-axis path far from the pole; about 48 bytes a block."""
    lines = [HEAD]
    for i in range(blocks):
        x, y, turn = i % 1000 * 0.1, i // 1000 % 1000 * 0.1, abs(i % 100 - 50)
        lines.append(f"N{i % 90000 + 1} G1 X{x:.4f} Y{y:.4f} Z{60 + i % 7 * 0.01:.4f} A{20 + turn * 0.01:.3f} C{turn * 0.02:.3f} F2000.\n")
    lines.append("M30\n")
    return "".join(lines)


class Server:
    def __init__(self, binary):
        self.process = subprocess.Popen([binary, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.heard, self.answers, self.news, self.number = threading.Condition(), {}, [], 0
        threading.Thread(target=self.listen, daemon=True).start()
        self.ask("initialize", {"processId": None, "rootUri": None, "capabilities": {"general": {"positionEncodings": ["utf-8"]}}})
        self.tell("initialized", {})

    def listen(self):
        while True:
            length = 0
            while line := self.process.stdout.readline().strip():
                if line.lower().startswith(b"content-length:"):
                    length = int(line.split(b":")[1])
            if not length:
                return
            body = self.process.stdout.read(length)
            now = time.perf_counter()
            message = json.loads(body)
            with self.heard:
                if "method" in message:
                    self.news.append((now, message))
                else:
                    self.answers[message["id"]] = (now, message)
                self.heard.notify_all()

    @staticmethod
    def frame(message):
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        return b"Content-Length: %d\r\n\r\n" % len(body) + body

    def write(self, frame):
        self.process.stdin.write(frame)
        self.process.stdin.flush()

    def send(self, message):
        self.write(self.frame(message))

    def tell(self, method, params):
        self.send({"method": method, "params": params})

    def ask(self, method, params):
        """Seconds until the answer, and the answer."""
        self.number += 1
        number, begun = self.number, time.perf_counter()
        self.send({"id": number, "method": method, "params": params})
        with self.heard:
            if not self.heard.wait_for(lambda: number in self.answers, PATIENCE):
                sys.exit(f"no answer to {method}")
            at, message = self.answers.pop(number)
        return at - begun, message

    def when(self, version, method, holds):
        """When a message about a version came for which `holds` is true."""
        found = lambda: next((at for at, m in self.news if m["method"] == method and m["params"].get("version") == version and holds(m["params"])), None)
        with self.heard:
            if not self.heard.wait_for(lambda: found() is not None, PATIENCE):
                sys.exit(f"no {method} of version {version}")
            return found()

    def first(self, version):
        """When the first findings of a version came."""
        return self.when(version, "textDocument/publishDiagnostics", lambda _: True)

    def shown(self, version, line, wanted):
        """When findings of a version came with one at a line, or without."""
        at_line = lambda found: found["range"]["start"]["line"] == line
        return self.when(version, "textDocument/publishDiagnostics", lambda p: any(map(at_line, p["diagnostics"])) == wanted)

    def whole(self, version):
        """When the verdict of a version came, which follows all findings."""
        return self.when(version, "trunnion/status", lambda p: p["verdict"] != "checking")

    def memory(self):
        """Now and at most, MB."""
        text = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        value = lambda key: int(text.split(key)[1].split()[0]) / 1024
        return value("VmRSS:"), value("VmHWM:")


def show(name, times):
    times = sorted(times)
    at = lambda part: times[min(len(times) - 1, int(part * len(times)))] * 1000
    print(f"{name:42} {at(0.5):9.1f} ms {at(0.95):9.1f} ms (95 %)  {times[-1] * 1000:9.1f} ms (most)")


def main():
    blocks = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    edits = int(sys.argv[2]) if len(sys.argv) > 2 else 100
    root = pathlib.Path(__file__).resolve().parent.parent
    binary = os.environ.get("TRUNNION_BIN", str(root / "target/release/trunnion"))
    text = program(blocks)
    size = len(text) / 1e6
    print(f"{blocks} blocks, {size:.1f} MB, {binary}")
    server = Server(binary)
    document = {"uri": URI, "languageId": "gcode", "version": 1, "text": text}
    # the clock starts with the first byte: how long Python takes to write JSON is no property of the server
    opening = server.frame({"method": "textDocument/didOpen", "params": {"textDocument": document}})
    begun = time.perf_counter()
    server.write(opening)
    sent = time.perf_counter()
    print(f"sent in {sent - begun:.2f} s; first findings {server.first(1) - begun:.2f} s, all {server.whole(1) - begun:.2f} s after the open")
    print(f"memory {server.memory()[1]:.0f} MB at most so far: {server.memory()[1] / size:.1f} times the file")
    line = blocks // 2
    place = {"line": line, "character": 12}
    document = {"uri": URI}
    visible = {"start": {"line": line - 30, "character": 0}, "end": {"line": line + 30, "character": 0}}
    show("hover", [server.ask("textDocument/hover", {"textDocument": document, "position": place})[0] for _ in range(100)])
    show("range tokens", [server.ask("textDocument/semanticTokens/range", {"textDocument": document, "range": visible})[0] for _ in range(100)])
    text_rules, machine_rules, whole, hover, tokens = [], [], [], [], []
    row = text.splitlines()[line]
    # a bracket that does not close; C turns by 90 degrees
    marks = [(row.index("F2000") + 1, "["), (row.index(" C") + 2, "9")]
    for edit in range(edits):
        version, (column, mark), broken = edit + 2, marks[edit // 2 % 2], edit % 2 == 0
        end = column if broken else column + len(mark)
        span = {"start": {"line": line, "character": column}, "end": {"line": line, "character": end}}
        begun = time.perf_counter()
        change = {"range": span, "text": mark if broken else ""}
        server.tell("textDocument/didChange", {"textDocument": {"uri": URI, "version": version}, "contentChanges": [change]})
        tokens.append(server.ask("textDocument/semanticTokens/range", {"textDocument": document, "range": visible})[0])
        hover.append(server.ask("textDocument/hover", {"textDocument": document, "position": place})[0])
        (text_rules if mark == "[" else machine_rules).append(server.shown(version, line, broken) - begun)
        if edit % 10 == 9:
            whole.append(server.whole(version) - begun)
    show("range tokens right after an edit", tokens)
    show("hover right after an edit", hover)
    show("edit to findings of the text", text_rules)
    show("edit to findings of the machine", machine_rules)
    show("edit to the verdict", whole)
    now, most = server.memory()
    print(f"memory {now:.0f} MB now, {most:.0f} MB at most: {most / size:.1f} times the file")
    server.process.kill()


main()
