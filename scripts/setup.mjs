// Installs what a bare Debian 12 with Node lacks: `node scripts/setup.mjs [build|test|bench]`.
// The other scripts call setup() first. What is there is left alone, and looking costs milliseconds.

import { existsSync, readFileSync } from "node:fs";
import { delimiter, join } from "node:path";
import { attempt, Failure, heading, isProgram, main, root, run } from "./run.mjs";

const onPath = (tool) =>
  (process.env.PATH ?? "").split(delimiter).some((folder) => existsSync(join(folder, tool)));

const build = ["build", "test", "bench"];

// A package is there when what is used of it is there, whoever installed it. The paths are absolute
// where CMakePresets.json, CMakeLists.txt or the page tests name them so.
const debian = [
  { name: "cmake", for: build, present: () => onPath("cmake") },
  { name: "ninja-build", for: build, present: () => onPath("ninja") },
  {
    name: "emscripten", for: build,
    present: () => onPath("em++") &&
      existsSync("/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake"),
  },
  { name: "libeigen3-dev", for: build, present: () => existsSync("/usr/include/eigen3/Eigen/Core") },
  {
    name: "libboost-graph-dev", for: build,
    present: () => existsSync("/usr/include/boost/graph/boykov_kolmogorov_max_flow.hpp"),
  },
  { name: "libtinyobjloader-dev", for: build, present: () => existsSync("/usr/include/tiny_obj_loader.h") },
  { name: "libnanoflann-dev", for: build, present: () => existsSync("/usr/include/nanoflann.hpp") },
  { name: "zopfli", for: build, present: () => onPath("zopfli") },
  { name: "g++", for: ["test", "bench"], present: () => onPath("g++") },
  { name: "doctest-dev", for: ["test", "bench"], present: () => existsSync("/usr/include/doctest/doctest.h") },
  { name: "chromium", for: ["test"], present: () => existsSync("/usr/bin/chromium") },
];

const purposes = [...new Set(debian.flatMap((p) => p.for))];

/** Makes everything available that `purpose` ("build", "test" or "bench") needs, or says what is missing. */
export async function setup(purpose) {
  if (!purposes.includes(purpose)) {
    throw new Failure(`setup: unknown purpose "${purpose}": expected ${purposes.join(", ")}`);
  }
  checkNode();
  await installDebianPackages(purpose);
  await installNodePackages();
}

function checkNode() {
  const [major, minor] = process.versions.node.split(".").map(Number);
  // What Vite 8 asks for.
  const fits = (major === 20 && minor >= 19) || (major === 22 && minor >= 12) || major > 22;
  if (!fits) throw new Failure(`Node ${process.versions.node} is too old: expected 20.19, 22.12 or newer`);
}

const missing = (purpose) =>
  debian.filter((p) => p.for.includes(purpose) && !p.present()).map((p) => p.name);

async function installDebianPackages(purpose) {
  const names = missing(purpose);
  if (names.length === 0) return;
  const advice = `Install these packages (names of Debian 12):\n  sudo apt-get update\n` +
    `  sudo apt-get install --no-install-recommends ${names.join(" ")}`;
  const elevate = await elevation();
  if (!onPath("apt-get")) throw new Failure(`missing: ${names.join(", ")}, and there is no apt-get. ${advice}`);
  if (!elevate) {
    throw new Failure(`missing: ${names.join(", ")}, and installing needs root or sudo without a password. ${advice}`);
  }
  heading(`Installing Debian packages (a few minutes): ${names.join(" ")}`);
  const [command, ...first] = [...elevate, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "-q",
    "-o", "Dpkg::Use-Pty=0", "-o", "DPkg::Lock::Timeout=300"];
  // A source of the user's that cannot be reached fails the update, not always the installation.
  await attempt(command, [...first, "update"], { show: false });
  try {
    await run(command, [...first, "install", "-y", "--no-install-recommends", ...names], { show: false });
  } catch (error) {
    throw new Failure(`${error.message}\n${advice}`);
  }
  const left = missing(purpose);
  if (left.length > 0) {
    throw new Failure(`installed, and yet what is needed of these is not where Debian 12 has it: ${left.join(", ")}`);
  }
}

/** The prefix that makes a command run as root, or null where there is none that asks nothing. */
async function elevation() {
  if (process.getuid?.() === 0) return [];
  if (!onPath("sudo")) return null;
  const { code } = await attempt("sudo", ["-n", "true"], { show: false });
  return code === 0 ? ["sudo", "-n"] : null;
}

async function installNodePackages() {
  if (nodePackagesMatchLock()) return;
  heading("Installing npm packages");
  // Whatever the user's configuration leaves out, the build needs the development packages.
  await run("npm", [
    "ci", "--include=dev", "--include=optional", "--no-audit", "--no-fund", "--no-update-notifier", "--loglevel=error",
  ]);
}

/** npm writes node_modules/.package-lock.json last: what it lists was installed whole. */
function nodePackagesMatchLock() {
  const hidden = join(root, "node_modules/.package-lock.json");
  if (!existsSync(hidden)) return false;
  const packages = (path) => JSON.parse(readFileSync(path, "utf8")).packages;
  const installed = packages(hidden);
  const wanted = Object.entries(packages(join(root, "package-lock.json"))).filter(([path]) => path !== "");
  // An optional package may be of another platform.
  return wanted.every(([path, { version, optional }]) =>
    (installed[path] ? installed[path].version === version && existsSync(join(root, path)) : optional));
}

if (isProgram(import.meta.url)) {
  await main(async ([purpose = "test", ...rest]) => {
    if (rest.length > 0) {
      throw new Failure(`setup: unexpected "${rest[0]}"; usage: node scripts/setup.mjs [${purposes.join("|")}]`);
    }
    await setup(purpose);
    console.log(`Everything needed to ${purpose} is here.`);
  });
}
