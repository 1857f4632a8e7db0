#!/usr/bin/env python3
"""Records what an editor sends to the language server: a wrapper that editors start in place of `trunnion`.

TRUNNION_TEE_PROGRAM: the real program. TRUNNION_TEE_FILE: the record, one message a line. TRUNNION_TEE_ROOT: the folder of the session, which
becomes $ROOT in the record. The path of this wrapper becomes $SERVER. Process numbers and the
paths of temporary files are left out too.
tests/all/lsp_sessions.rs plays such records again; CONTRIBUTING.md says how they are made.
"""
import json
import os
import re
import subprocess
import sys
import threading


def frames(stream):
    """The messages of a stream: header and body, as they came."""
    while True:
        header = b""
        while not header.endswith(b"\r\n\r\n"):
            byte = stream.read(1)
            if not byte:
                return
            header += byte
        length = int(re.search(rb"content-length: *(\d+)", header, re.I).group(1))
        body = stream.read(length)
        if len(body) < length:
            return
        yield header, body


def clean(message, root):
    """A message without what belongs to one computer."""
    if message.get("method") == "initialize":
        message["params"]["processId"] = None
    if message.get("method") == "trunnion/backplot":
        message["params"]["file"] = "$TMP"
    text = json.dumps(message, ensure_ascii=False, separators=(",", ":"))
    # settings name the program that the editor started: this one
    return text.replace(sys.argv[0], "$SERVER").replace(root, "$ROOT")


def main():
    program, record = os.environ["TRUNNION_TEE_PROGRAM"], os.environ["TRUNNION_TEE_FILE"]
    if sys.argv[1:2] != ["lsp"]:
        os.execv(program, [program, *sys.argv[1:]])
    root = os.environ.get("TRUNNION_TEE_ROOT", os.getcwd())
    server = subprocess.Popen([program, *sys.argv[1:]], stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def answers():
        while chunk := server.stdout.read1(1 << 16):
            sys.stdout.buffer.write(chunk)
            sys.stdout.buffer.flush()

    threading.Thread(target=answers, daemon=True).start()
    with open(record, "a", encoding="utf-8") as out:
        for header, body in frames(sys.stdin.buffer):
            out.write(clean(json.loads(body), root) + "\n")
            out.flush()
            try:
                server.stdin.write(header + body)
                server.stdin.flush()
            except BrokenPipeError:
                break
    server.stdin.close()
    sys.exit(server.wait())


main()
