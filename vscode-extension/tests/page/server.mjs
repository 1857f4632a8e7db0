// Asks `trunnion lsp` for the path of a program, as the extension does.
import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

export async function path(trunnion, file, output, settings) {
  const server = spawn(trunnion, ['lsp'], { stdio: ['pipe', 'pipe', 'inherit'] });
  const waiting = new Map();
  let buffer = Buffer.alloc(0);
  let analysed;
  const ready = new Promise((resolve) => (analysed = resolve));
  server.stdout.on('data', (bytes) => {
    buffer = Buffer.concat([buffer, bytes]);
    for (;;) {
      const head = buffer.indexOf('\r\n\r\n');
      const length = head < 0 ? NaN : Number(/Content-Length: (\d+)/i.exec(buffer.subarray(0, head).toString())[1]);
      if (!(buffer.length >= head + 4 + length)) return;
      const message = JSON.parse(buffer.subarray(head + 4, head + 4 + length).toString());
      buffer = buffer.subarray(head + 4 + length);
      if (message.method === 'trunnion/status') analysed();
      if (message.id !== undefined && message.method) send({ id: message.id, result: null });
      else waiting.get(message.id)?.(message);
    }
  });
  const send = (message) => {
    const body = Buffer.from(JSON.stringify({ jsonrpc: '2.0', ...message }));
    server.stdin.write(`Content-Length: ${body.length}\r\n\r\n`);
    server.stdin.write(body);
  };
  let last = 0;
  const ask = (method, params) => {
    const id = (last += 1);
    const answer = new Promise((resolve) => waiting.set(id, resolve));
    send({ id, method, params });
    return answer;
  };
  const uri = pathToFileURL(file).href;
  await ask('initialize', { processId: null, rootUri: null, capabilities: {}, initializationOptions: settings });
  send({ method: 'initialized', params: {} });
  send({ method: 'textDocument/didOpen', params: { textDocument: { uri, languageId: 'gcode', version: 1, text: readFileSync(file, 'latin1') } } });
  await ready;
  const answer = await ask('trunnion/backplot', { textDocument: { uri }, file: output, most: 400_000 });
  await ask('shutdown', undefined);
  send({ method: 'exit' });
  server.stdin.end();
  if (answer.error) throw new Error(answer.error.message);
  return { summary: answer.result, bytes: readFileSync(output) };
}
