// `npm start`: sets up, builds and serves the demo page.  npm start -- [--port N] [--host H] [--no-open]

import { spawn } from "node:child_process";
import { createReadStream, statSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, normalize, sep } from "node:path";
import { parseArgs } from "node:util";
import { build } from "./build.mjs";
import { Failure, main, root } from "./run.mjs";

const defaultPort = 5173;

const types = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".mjs": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".json": "application/json; charset=utf-8",
  ".map": "application/json; charset=utf-8",
  ".wasm": "application/wasm",
  ".svg": "image/svg+xml",
  ".png": "image/png",
  ".jpg": "image/jpeg",
  ".ico": "image/x-icon",
  ".glb": "model/gltf-binary",
};

function readOptions(args) {
  const options = { port: { type: "string" }, host: { type: "string" }, "no-open": { type: "boolean" } };
  let values;
  try {
    values = parseArgs({ args, options }).values;
  } catch (error) {
    throw new Failure(`start: ${error.message}`);
  }
  const port = Number(values.port ?? defaultPort);
  if (!/^\d+$/.test(values.port ?? "0") || port > 65535) {
    throw new Failure(`start: --port ${values.port}: expected a number from 0 (any free port) to 65535`);
  }
  return { port, chosen: values.port !== undefined, host: values.host ?? "127.0.0.1", open: !values["no-open"] };
}

/** The file of `folder` a request path names, or null where there is none inside the folder. */
function fileFor(folder, url) {
  let path;
  try {
    path = decodeURIComponent(url.replace(/[?#].*/, ""));
  } catch {
    return null;
  }
  const full = normalize(join(folder, path));
  if (path.includes("\0") || !(full + sep).startsWith(folder + sep)) return null;
  const file = path.endsWith("/") ? join(full, "index.html") : full;
  return statSync(file, { throwIfNoEntry: false })?.isFile() ? file : null;
}

function serve(folder) {
  return createServer((request, response) => {
    if (request.method !== "GET" && request.method !== "HEAD") {
      response.writeHead(405, { Allow: "GET, HEAD" }).end();
      return;
    }
    const file = fileFor(folder, request.url);
    if (!file) {
      response.writeHead(404, { "Content-Type": "text/plain" }).end("Not found\n");
      return;
    }
    response.writeHead(200, {
      "Content-Type": types[extname(file)] ?? "application/octet-stream",
      "Content-Length": statSync(file).size,
      "Cache-Control": "no-cache",
    });
    if (request.method === "HEAD") response.end();
    else createReadStream(file).on("error", () => response.destroy()).pipe(response);
  });
}

const listen = (server, port, host) => new Promise((resolve, reject) => {
  server.once("error", reject).listen(port, host, () => {
    server.off("error", reject);
    resolve(server.address().port);
  });
});

/** Listens on the port; where the default one is taken, on any free one. */
async function listenSomewhere(server, { port, chosen, host }) {
  try {
    return await listen(server, port, host);
  } catch (error) {
    if (error.code === "EADDRINUSE" && !chosen) return listen(server, 0, host);
    throw new Failure(error.code === "EADDRINUSE"
      ? `start: --port ${port} is taken on ${host}; choose another, or leave --port out for a free one`
      : `start: cannot listen on ${host} port ${port}: ${error.message}`);
  }
}

const nameOf = (host) => (host === "127.0.0.1" ? "localhost" : host.includes(":") ? `[${host}]` : host);

/** Opens the page where there is a desktop to open it on. */
function openBrowser(address) {
  if (!process.env.DISPLAY && !process.env.WAYLAND_DISPLAY) return;
  spawn("xdg-open", [address], { stdio: "ignore", detached: true }).on("error", () => {}).unref();
}

await main(async (args) => {
  const options = readOptions(args);
  await build();
  const server = serve(join(root, "dist/demo"));
  const port = await listenSomewhere(server, options);
  const address = `http://${nameOf(options.host)}:${port}/`;
  console.log(`\nThe demo is at ${address}  (Ctrl+C ends)`);
  if (options.open) openBrowser(address);
  const end = () => server.close(() => process.exit(0)).closeAllConnections?.();
  process.on("SIGINT", end).on("SIGTERM", end);
});
